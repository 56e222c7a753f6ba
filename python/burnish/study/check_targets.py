"""Judge the advice: ``python -m burnish.study.check_targets`` asks for errors and measures what is reached.

Pictures of a sphere, by materials under environments that the error model was not fitted to. The error that
is reached is that of the very picture that was asked for, against a sum over every texel. Beside it stands
what the next cheaper count of the same sampler would have reached: the choice is too careful where that
meets the target too.
"""

import argparse
import math
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

import burnish
from burnish import _core
from burnish._device import default_device
from burnish.advice import Advice, advise
from burnish.advice.families import FAMILIES, sampler_text
from burnish.advice.reduced_maps import reduced_face_size
from burnish.advice.truth import draw_dense, draw_truth
from burnish.images.files import write_text
from burnish.rendering import render
from burnish.study.calibration_set import UNSEEN_LOBES, unseen_environments
from burnish.study.sampler_text import sampler_from_text

TARGETS = (0.05, 0.02, 0.01)
SIZE = (112, 112)
WITHIN, NEVER_ABOVE = 1.3, 2.0
ESTIMATED = ("matched:7", "matched:14", "matched:30", "importance:30:fibonacci")
"""Samplers whose error estimates are judged."""


@dataclass(frozen=True)
class Outcome:
    """One target in one combination.

    Parameters
    ----------
    environment, material : str
        Names.
    advice : Advice
        What was advised.
    reached : float
        Relative RMSE of the picture by the chosen sampler.
    cheaper : float or None
        That of the next smaller count of the same sampler; None where there is none.
    """

    environment: str
    material: str
    advice: Advice
    reached: float
    cheaper: float | None

    @property
    def ratio(self) -> float:
        """Error reached over the error that was asked for."""
        return self.reached / self.advice.target_error

    @property
    def is_too_careful(self) -> bool:
        """Whether the next cheaper count would have met the target with a margin, and less was reached."""
        return self.cheaper is not None and self.cheaper * WITHIN < self.advice.target_error


def next_cheaper(advice: Advice) -> str | None:
    """Name the next smaller count of the chosen sampler.

    Parameters
    ----------
    advice : Advice
        With its choice.
    """
    chosen = advice.chosen
    if chosen.family not in FAMILIES:
        return None
    below = [count for count in FAMILIES[chosen.family].counts if count < chosen.count]
    return sampler_text(chosen.family, below[-1]) if below else None


class Combination:
    """A sphere of one material under one environment, and what it should look like.

    Parameters
    ----------
    environment : Environment
        The light.
    lobe : KurtLobe
        Of the sphere.
    """

    def __init__(self, environment: _core.Environment, lobe: _core.KurtLobe) -> None:
        self.scene = _core.Scene.sphere(_core.Material(lobes=[lobe]))
        self.scene.environment = environment
        device, face_size = default_device(), reduced_face_size(list(self.scene.materials))
        dense = draw_dense(self.scene, None, SIZE, "gauss6", device)
        self.truth = draw_truth(self.scene, None, SIZE, "gauss6", device, face_size, dense)
        self._errors: dict[str, float] = {}

    def error(self, sampler: str) -> float:
        """Relative RMSE of the whole picture by a sampler.

        Parameters
        ----------
        sampler : str
            As text.
        """
        if sampler not in self._errors:
            frame = render(self.scene, size=SIZE, sampler=sampler_from_text(sampler))
            self._errors[sampler] = frame.error(self.truth)
        return self._errors[sampler]

    def check_target(self, target: float, has_probe: bool) -> tuple[Advice, float, float | None]:
        """Ask for a target and measure what is reached, and what the next cheaper count would have.

        Parameters
        ----------
        target : float
            Relative RMSE.
        has_probe : bool
            Whether the advice may measure on a small picture.
        """
        advice = advise(self.scene, target, SIZE, probe=has_probe)
        cheaper = next_cheaper(advice)
        return advice, self.error(advice.chosen.sampler), None if cheaper is None else self.error(cheaper)

    def check_estimate(self, sampler: str) -> tuple[float, float]:
        """Judge the error estimate of a sampler.

        Parameters
        ----------
        sampler : str
            As text.

        Returns
        -------
        rank : float
            Rank correlation of estimated and true error over the pixels with objects.
        ratio : float
            Estimated over true relative RMSE.
        """
        made = sampler_from_text(sampler)
        frame = render(self.scene, size=SIZE, sampler=made, error_estimate=True)
        assert frame.error_estimate is not None
        covered = frame.alpha > 0
        true = np.sum((frame.color.astype(np.float64) - self.truth.color) ** 2, axis=-1)
        estimated, exact = (
            np.argsort(np.argsort(values[covered])).astype(np.float64)
            for values in (frame.error_estimate, true)
        )
        rank = float(np.corrcoef(estimated, exact)[0, 1])
        return rank, frame.estimated_error() / self.error(sampler)


def _percent(value: float | None) -> str:
    return "-" if value is None else f"{100 * value:.2f}"


def format_outcomes(outcomes: Sequence[Outcome]) -> list[str]:
    """Lay outcomes out as the rows of a table, errors in per cent.

    Parameters
    ----------
    outcomes : sequence of Outcome
        In any order.
    """
    lines = [
        "| environment | material | target | sampler | predicted | reached | reached/target | next cheaper |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for one in outcomes:
        cells = [
            one.environment,
            one.material,
            f"{100 * one.advice.target_error:g}",
            one.advice.chosen.sampler,
            _percent(one.advice.predicted_error),
            _percent(one.reached),
            f"{one.ratio:.2f}",
            _percent(one.cheaper),
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return lines


def summarize_outcomes(outcomes: Sequence[Outcome]) -> list[str]:
    """Count what was met, one line for each target.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of all targets.
    """
    lines = []
    for target in dict.fromkeys(one.advice.target_error for one in outcomes):
        own = [one for one in outcomes if one.advice.target_error == target]
        met = sum(one.ratio <= WITHIN for one in own)
        worst = max(one.ratio for one in own)
        careful = sum(one.is_too_careful for one in own)
        off = [abs(math.log(one.reached / one.advice.predicted_error)) for one in own]
        median = math.exp(sorted(off)[len(off) // 2])
        lines.append(
            f"target {100 * target:g} %: at most {WITHIN} x target in {met} of {len(own)}, "
            f"largest {worst:.2f} x; too careful in {careful}; "
            f"predicted and reached differ by a factor of {median:.2f} (median)"
        )
    return lines


def holds(outcomes: Sequence[Outcome], target: float) -> bool:
    """Whether nine in ten are within `WITHIN` of the target and none beyond `NEVER_ABOVE`.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of all targets.
    target : float
        The one that is judged.
    """
    ratios = [one.ratio for one in outcomes if one.advice.target_error == target]
    return max(ratios) <= NEVER_ABOVE and sum(ratio <= WITHIN for ratio in ratios) >= 0.9 * len(ratios)


def format_estimates(estimates: Sequence[tuple[str, str, list[tuple[float, float]]]]) -> list[str]:
    """Lay out how well estimates rank the pixels' errors and give their size.

    Parameters
    ----------
    estimates : sequence of (environment, material, pairs)
        A pair (rank, ratio) for each sampler of `ESTIMATED`.
    """
    heads = " | ".join(f"{name}: rank | estimated/true" for name in ESTIMATED)
    lines = [f"| environment | material | {heads} |", "|---" * (2 + 2 * len(ESTIMATED)) + "|"]
    for environment, material, pairs in estimates:
        cells = [f"{value:.2f}" for pair in pairs for value in pair]
        lines.append(f"| {environment} | {material} | {' | '.join(cells)} |")
    means = [np.mean([pairs[k][0] for *_, pairs in estimates]) for k in range(len(ESTIMATED))]
    medians = [np.median([pairs[k][1] for *_, pairs in estimates]) for k in range(len(ESTIMATED))]
    cells = [f"{value:.2f}" for pair in zip(means, medians, strict=True) for value in pair]
    return [*lines, f"| mean rank, median ratio | | {' | '.join(cells)} |"]


def main() -> int:
    """Check all combinations; 0 where the promise holds."""
    parser = argparse.ArgumentParser(prog="python -m burnish.study.check_targets", description=__doc__)
    parser.add_argument("--no-probe", action="store_true", help="judge the error model alone")
    parser.add_argument("-o", "--output", type=Path, help="write the tables here as well")
    options = parser.parse_args()
    outcomes, estimates = [], []
    makers: dict[str, Callable[[], _core.Environment]] = unseen_environments()
    for environment_name, make in makers.items():
        environment = make()
        for lobe_name, lobe in UNSEEN_LOBES.items():
            combination = Combination(environment, lobe)
            for target in TARGETS:
                found = combination.check_target(target, not options.no_probe)
                outcomes.append(Outcome(environment_name, lobe_name, *found))
                print(format_outcomes(outcomes)[-1], flush=True)
            judged = [combination.check_estimate(sampler) for sampler in ESTIMATED]
            estimates.append((environment_name, lobe_name, judged))
    device = default_device()
    command = "python -m burnish.study.check_targets" + (" --no-probe" if options.no_probe else "")
    date = datetime.now(timezone.utc).date().isoformat()
    lines = [
        f"`{command}`, {date}, {device.name}, {device.driver}, burnish {burnish.__version__}; "
        f"{SIZE[1]} x {SIZE[0]} pixels.",
        "",
        *(f"- {line}" for line in summarize_outcomes(outcomes)),
        "",
        *format_outcomes(outcomes),
        "",
        *format_estimates(estimates),
    ]
    print("", *lines, sep="\n")
    if options.output:
        write_text(options.output, "\n".join(lines) + "\n")
    return 0 if all(holds(outcomes, target) for target in TARGETS) else 1


if __name__ == "__main__":
    sys.exit(main())

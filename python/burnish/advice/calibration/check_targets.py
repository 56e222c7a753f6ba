"""Judge the advice: ask for errors, and measure what is reached.

Pictures of scenes under environments that the error model was not fitted to. The error that is reached is
that of the very picture that was asked for: of lobes alone against a sum over every texel, with ``--diffuse``
of scenes with diffuse parts against a progressive reference of a third of the smallest target. Beside it
stands what the next cheaper count of the same sampler would have reached: the choice is too careful where
that meets the target too.
"""

import argparse
import itertools
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path

import numpy as np

from burnish._device import default_device
from burnish._version import __version__
from burnish.advice import Advice
from burnish.advice.calibration.target_combinations import SIZE, Combination, diffuse_cases, lobe_cases
from burnish.images.files import write_text

TARGETS = (0.05, 0.02, 0.01)
WITHIN, NEVER_ABOVE, LEAST_SHARE = 1.3, 2.0, 0.95
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
    """Whether `LEAST_SHARE` are within `WITHIN` of the target and none beyond `NEVER_ABOVE`.

    Parameters
    ----------
    outcomes : sequence of Outcome
        Of all targets.
    target : float
        The one that is judged.
    """
    ratios = [one.ratio for one in outcomes if one.advice.target_error == target]
    return max(ratios) <= NEVER_ABOVE and sum(ratio <= WITHIN for ratio in ratios) >= LEAST_SHARE * len(
        ratios
    )


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
    parser = argparse.ArgumentParser(
        prog="python -m burnish.advice.calibration.check_targets", description=__doc__
    )
    parser.add_argument("--no-probe", action="store_true", help="judge the error model alone")
    parser.add_argument("--diffuse", action="store_true", help="scenes with diffuse parts")
    parser.add_argument("--data", type=Path, help="folder of environments and scenes, for --diffuse")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every N-th combination")
    parser.add_argument("-o", "--output", type=Path, help="write the tables here as well")
    options = parser.parse_args()
    outcomes, estimates = [], []
    cases = diffuse_cases(options.data) if options.diffuse else lobe_cases()
    for case in itertools.islice(cases, 0, None, options.every):
        combination = Combination(case)
        for target in TARGETS:
            found = combination.check_target(target, not options.no_probe)
            outcomes.append(Outcome(case.environment, case.material, *found))
            print(format_outcomes(outcomes)[-1], flush=True)
        judged = [combination.check_estimate(sampler) for sampler in ESTIMATED]
        estimates.append((case.environment, case.material, judged))
    device = default_device()
    words = ["--diffuse"] * options.diffuse + ["--no-probe"] * options.no_probe
    words += [f"--every {options.every}"] if options.every > 1 else []
    command = " ".join(["python -m burnish.advice.calibration.check_targets", *words])
    date = datetime.now(timezone.utc).date().isoformat()
    lines = [
        f"`{command}`, {date}, {device.name}, {device.driver}, burnish {__version__}; "
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

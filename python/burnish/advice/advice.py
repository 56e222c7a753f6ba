"""What was advised, and why."""

from dataclasses import dataclass, field
from typing import Any

from burnish.advice.search import Candidate, pareto

SHOWN_NEIGHBOURS = 3
"""Candidates of the front on either side of the choice that a table shows."""


def _percent(error: float) -> str:
    return f"{100 * error:.3g} %"


def _milliseconds(value: float) -> str:
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


def _align(rows: list[tuple[str, ...]], sides: str) -> list[str]:
    """Pad every column to its widest cell, on the side that its letter says."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(
            f"{cell:{side}{width}}" for cell, side, width in zip(row, sides, widths, strict=True)
        ).rstrip()
        for row in rows
    ]


@dataclass(frozen=True)
class Advice:
    """The cheapest sampler that is predicted to meet an error, and what else there was.

    Parameters
    ----------
    target_error : float
        Relative RMSE that was asked for.
    size : (height, width)
        Of the picture that was priced.
    device : str
        Name of the device whose prices these are.
    candidates : list of Candidate
        All that were considered, cheapest first.
    chosen : Candidate
        The cheapest that meets the target; where none does, the one that comes closest.
    meets_target : bool
        Whether it is predicted to.
    notes : list of str
        How the errors were found.
    advice_ms : float
        What the advice itself took, on the wall clock.
    error_reached : float or None
        The relative RMSE that was really reached, where that was asked for.
    """

    target_error: float
    size: tuple[int, int]
    device: str
    candidates: list[Candidate]
    chosen: Candidate
    meets_target: bool
    notes: list[str] = field(default_factory=list)
    advice_ms: float = 0.0
    error_reached: float | None = None

    @property
    def sampler(self) -> Any:
        """The chosen sampler, for `burnish.render`."""
        from burnish.samplers import sampler_from_text

        return sampler_from_text(self.chosen.sampler)

    @property
    def predicted_error(self) -> float:
        """Relative RMSE that is predicted of the choice."""
        return self.chosen.predicted_error

    @property
    def predicted_ms(self) -> float:
        """Milliseconds of a frame that are predicted of the choice."""
        return self.chosen.predicted_ms

    @property
    def warning(self) -> str | None:
        """One sentence where no candidate meets the target; else None."""
        if self.meets_target:
            return None
        return (
            f"no sampler is predicted to meet an error of {_percent(self.target_error)}; the closest, "
            f"{self.chosen.sampler}, has {_percent(self.predicted_error)}. "
            f"Reference({self.target_error:g}) would meet it at its own price"
        )

    def pareto(self) -> list[Candidate]:
        """Candidates that no other beats in both error and price, by growing price."""
        return pareto(self.candidates)

    def to_dict(self) -> dict[str, Any]:
        """Give everything in a form that JSON can hold, the Pareto front for alternatives."""
        return {
            "target_error": self.target_error,
            "sampler": self.chosen.sampler,
            "predicted_error": self.predicted_error,
            "predicted_ms": self.predicted_ms,
            "meets_target": self.meets_target,
            "is_probed": self.chosen.is_probed,
            "error_reached": self.error_reached,
            "advice_ms": self.advice_ms,
            "notes": list(self.notes),
            "alternatives": [
                {
                    "sampler": one.sampler,
                    "predicted_error": one.predicted_error,
                    "predicted_ms": one.predicted_ms,
                    "is_probed": one.is_probed,
                }
                for one in self.pareto()
            ],
        }

    def __str__(self) -> str:
        height, width = self.size
        lines = [f"target {_percent(self.target_error)}, {width} x {height}, on {self.device}", ""]
        lines += self._table()
        lines += ["", f"take {self.chosen.sampler}: {self._reason()}"]
        if self.error_reached is not None:
            lines.append(f"error really reached: {_percent(self.error_reached)}")
        lines += [*self.notes, f"the advice took {_milliseconds(self.advice_ms)} ms"]
        if self.warning is not None:
            lines.append(f"warning: {self.warning}")
        return "\n".join(lines)

    def _reason(self) -> str:
        how = "measured on a small picture" if self.chosen.is_probed else "predicted by the model"
        error = f"error {_percent(self.predicted_error)}, {how}"
        if not self.meets_target:
            return f"the smallest error of all, {error}"
        return f"the cheapest that meets the target; {error}"

    def _table(self) -> list[str]:
        """The front around the choice, the best of every other family, and all that was probed."""
        front = self.pareto()
        places = [k for k, one in enumerate(front) if one.sampler == self.chosen.sampler]
        middle = places[0] if places else len(front) - 1
        shown = set(
            one.sampler for one in front[max(0, middle - SHOWN_NEIGHBOURS) :][: 2 * SHOWN_NEIGHBOURS + 1]
        )
        shown |= {one.sampler for one in self.candidates if one.is_probed} | {self.chosen.sampler}
        for family in dict.fromkeys(one.family for one in self.candidates):
            shown.add(self._best_of(family).sampler)
        on_front = {one.sampler for one in front}
        rows: list[tuple[str, ...]] = [("", "sampler", "error", "", "ms a frame", "")]
        for one in self.candidates:
            if one.sampler in shown:
                rows.append(
                    (
                        ">" if one.sampler == self.chosen.sampler else "",
                        one.sampler,
                        _percent(one.predicted_error),
                        "measured" if one.is_probed else "model",
                        _milliseconds(one.predicted_ms),
                        "Pareto" if one.sampler in on_front else "",
                    )
                )
        return _align(rows, "<<><><")

    def _best_of(self, family: str) -> Candidate:
        """The cheapest of a family that meets the target, or its most accurate one."""
        own = [one for one in self.candidates if one.family == family]
        meeting = [one for one in own if one.predicted_error <= self.target_error]
        if meeting:
            return min(meeting, key=lambda one: one.predicted_ms)
        return min(own, key=lambda one: one.predicted_error)

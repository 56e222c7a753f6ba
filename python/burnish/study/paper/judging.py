"""Statements beside figures: the form of a verdict, its tolerances, and the arithmetic of judging.

Pure functions of the numbers; nothing here knows the answer beforehand. The paper's tables are not in our
sources: where its own number is unknown, the statement is its abstract's, or what the figure is there to
show.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

from burnish.study.paper.settings import SHARES

Numbers = dict[str, Any]
Origin = Literal["abstract", "printed", "equations", "reading", "today"]

ORIGINS: dict[str, str] = {
    "abstract": "stated in the paper's abstract; how it is tested here is our choice",
    "printed": "a number that the paper prints",
    "equations": "what the paper's equations must give to be right",
    "reading": "what the table or figure is there to show, as we read it; its numbers are not in our sources",
    "today": "not the paper's: what this engine adds",
}

LEAST_LINEARITY = 0.99
"""R^2 from which a straight line is said to fit."""
SHARE_TOLERANCE = 0.2
"""Relative difference up to which times go with the covered share: the machine's noise is of that order."""
MOST_SCATTER = 0.1
"""Relative deviation of a time from which nothing is decided by it: others used the machine."""
REAL_TIME_MS = 1000.0 / 30.0
ALBEDO_TOLERANCE = 0.01
"""Relative error up to which an estimator that must be exact in the limit is said to be right."""
FOOTPRINT_TOLERANCE = 1.05
TYPICAL_COUNT = 14


@dataclass(frozen=True)
class Verdict:
    """One statement and what became of it.

    Parameters
    ----------
    item : str
        Table, figure or equation.
    claim : str
        The statement.
    origin : str
        A key of `ORIGINS`.
    holds : bool or None
        None: the noise leaves it open.
    measured : str
        The figures it was judged by.
    by : str
        By how much it holds or not.
    """

    item: str
    claim: str
    origin: Origin
    holds: bool | None
    measured: str
    by: str

    @property
    def word(self) -> str:
        """Give the verdict in words."""
        return {True: "holds", False: "does not hold", None: "not decided"}[self.holds]

    def __str__(self) -> str:
        return f"{self.item}: {self.claim} {self.word}: {self.by} ({self.measured})"


@dataclass(frozen=True)
class Line:
    """A straight line through times.

    Parameters
    ----------
    slope, intercept : float
        Milliseconds a sample, and at none.
    r_squared : float
        Share of the variance that it explains; 1 for times that are all equal.
    """

    slope: float
    intercept: float
    r_squared: float


def fit_line(xs: Sequence[float], ys: Sequence[float]) -> Line:
    """Fit a line by least squares.

    Parameters
    ----------
    xs, ys : sequence of float
        At least two different xs.
    """
    count = len(xs)
    mean_x, mean_y = sum(xs) / count, sum(ys) / count
    spread = sum((x - mean_x) ** 2 for x in xs)
    if count < 2 or spread == 0:
        raise ValueError(f"xs: expected at least two different values, got {list(xs)}")
    slope = sum((x - mean_x) * (y - mean_y) for x, y in zip(xs, ys, strict=True)) / spread
    intercept = mean_y - slope * mean_x
    total = sum((y - mean_y) ** 2 for y in ys)
    rest = sum((y - slope * x - intercept) ** 2 for x, y in zip(xs, ys, strict=True))
    return Line(slope, intercept, 1 - rest / total if total > 0 else 1.0)


def fit_frames(frames: Sequence[dict[str, Any]], role: str) -> dict[float, Line]:
    """Fit frame time against samples for each share of the screen."""
    lines = {}
    for share in SHARES:
        rows = [row for row in frames if row["role"] == role and row["share"] == share]
        if len({row["samples"] for row in rows}) > 1:
            lines[share] = fit_line([row["samples"] for row in rows], [row["frame"]["ms"] for row in rows])
    return lines


def geometric_mean(values: Sequence[float]) -> float:
    """Mean of factors."""
    return math.exp(sum(math.log(value) for value in values) / len(values))


def find_errors(numbers: Numbers, cell: str, role: str, error: str = "relative_rmse") -> dict[int, float]:
    """Give the errors of a role in a cell by seed, without those that were not measured or are 0."""
    return {
        row["seed"]: row[error]
        for row in numbers["pictures"]
        if row["cell"] == cell and row["role"] == role and row[error]
    }


def error_ratios(
    numbers: Numbers, cell: str, other: str, role: str, error: str = "relative_rmse"
) -> list[float]:
    """Give ``other``'s error over that of ``role`` under each environment; empty where one is missing."""
    above, below = (find_errors(numbers, cell, name, error) for name in (other, role))
    return [above[seed] / below[seed] for seed in above if seed in below]


def factor_text(ratios: Sequence[float]) -> str:
    """Write a mean factor and its range."""
    text = f"{geometric_mean(ratios):.2f} x"
    if len(ratios) == 1:
        return text
    least, most = min(ratios), max(ratios)
    remark = "; environments disagree" if least < 1 < most else ""
    return f"{text} ({least:.2f} to {most:.2f}{remark})"


def find_scatter(timings: Sequence[dict[str, Any]]) -> float:
    """Give the largest relative deviation of some times."""
    return max(float(timing["deviation_ms"] / timing["ms"]) for timing in timings)


def scatter_remark(scatter: float) -> str:
    """Say why nothing is decided; empty where the times are steady enough."""
    if scatter <= MOST_SCATTER:
        return ""
    return f"; times scatter by {percent_text(scatter)}: ask again on a quieter machine, with more --repeats"


def percent_text(share: float) -> str:
    """Write a share as percents with three significant digits."""
    return f"{100 * share:.3g} %"

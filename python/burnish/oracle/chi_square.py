"""Pearson's chi-square test without SciPy."""

import math

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array


def chi_square_p_value(statistic: float, degrees: int) -> float:
    """Chance of a statistic at least this large (Wilson and Hilferty: its cube root is nearly normal)."""
    spread = 2 / (9 * degrees)
    z = ((statistic / degrees) ** (1 / 3) - (1 - spread)) / math.sqrt(spread)
    return 0.5 * math.erfc(z / math.sqrt(2))


def sidak_level(significance: float, tests: int) -> float:
    """Level for each of `tests` tests so that all together raise a false alarm with chance `significance`."""
    return float(1 - (1 - significance) ** (1 / tests))


def pool_cells(
    observed: npt.ArrayLike, expected: npt.ArrayLike, smallest: float = 5.0
) -> tuple[Array, Array]:
    """Merge the cells of fewest expected counts, in rising order, until each holds at least `smallest`."""
    observed, expected = as_array(observed).ravel(), as_array(expected).ravel()
    order = np.argsort(expected, kind="stable")
    observed, expected = observed[order], expected[order]
    few = int(np.searchsorted(expected, smallest))
    pooled = few
    while 0 < pooled < len(expected) and np.sum(expected[:pooled]) < smallest:
        pooled += 1
    if pooled == 0:
        return observed, expected
    return (
        np.concatenate([[np.sum(observed[:pooled])], observed[pooled:]]),
        np.concatenate([[np.sum(expected[:pooled])], expected[pooled:]]),
    )


def chi_square_test(observed: npt.ArrayLike, expected: npt.ArrayLike) -> float:
    """P-value of counts against expected counts; cells below 5 expected are pooled.

    Counts where nothing at all is expected give 0. Expected counts must sum to the number of observations,
    cells for "anywhere else" included.
    """
    if np.any(as_array(observed)[as_array(expected) <= 0] > 0):
        return 0.0
    seen, due = pool_cells(observed, expected)
    if len(due) < 2:
        raise ValueError(f"expected: expected at least two cells after pooling, got {len(due)}")
    return chi_square_p_value(float(np.sum((seen - due) ** 2 / due)), len(due) - 1)

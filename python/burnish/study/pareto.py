"""The Pareto front: what nothing else beats."""

import math
from collections.abc import Sequence

from burnish.study.rows import Row


def pareto_front(rows: Sequence[Row], error: str, time: str) -> list[Row]:
    """Rows for which no other row is at least as good in both and better in one.

    Parameters
    ----------
    rows : sequence of dict
        Of one cell.
    error, time : str
        Keys of numbers, the smaller the better. A row without one of them is left out.

    Returns
    -------
    front : list of dict
        By growing time, so by falling error. Of equal rows the first is kept.
    """
    measured = [row for row in rows if row.get(error) is not None and row.get(time) is not None]
    front: list[Row] = []
    least = math.inf
    for row in sorted(measured, key=lambda row: (row[time], row[error])):
        if row[error] < least:
            front.append(row)
            least = row[error]
    return front

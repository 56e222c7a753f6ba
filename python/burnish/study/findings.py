"""A study in words: what was best, and what a reader must not overlook."""

from burnish.study.data import StudyData
from burnish.study.rows import Row, cell_title, format_value

COARSE_REFERENCE = 1 / 3
"""Share of the least error from which the reference's own standard error spoils the ranking."""


OWNED_BY_FEW = 0.5
"""Share of the squared error from which the worst .1 % of the pixels decide the ranking."""


def _of_cell(rows: list[Row]) -> list[str]:
    measured = [row for row in rows if row["relative_rmse"] is not None]
    if not measured:
        return [f"{cell_title(rows[0])}: the reference is black, so there are no relative errors."]
    best = min(measured, key=lambda row: row["relative_rmse"])
    least, time = format_value(best["relative_rmse"]), format_value(best["frame_ms"])
    lines = [
        f"{cell_title(rows[0])}: {best['sampler']} has the least error, {least} relative RMSE in {time} ms."
    ]
    owned = max(measured, key=lambda row: row.get("worst_share") or 0.0)
    if (owned.get("worst_share") or 0.0) > OWNED_BY_FEW:
        lines.append(
            f"Careful: the worst .1 % of the pixels have {owned['worst_share']:.0%} of {owned['sampler']}'s "
            "squared error; compare the errors of the rest as well."
        )
    noise = max(row["reference_standard_error"] for row in rows)
    if noise > COARSE_REFERENCE * best["relative_rmse"]:
        lines.append(
            f"Careful: the reference's own standard error there, {format_value(noise)}, is more than a third "
            "of the least error; a finer reference is needed to rank what is near it."
        )
    return lines


def list_findings(study: StudyData) -> list[str]:
    """Say what each cell's least error is, and what the reader must know.

    Parameters
    ----------
    study : StudyData
        Any.

    Returns
    -------
    lines : list of str
        One sentence or two each.
    """
    lines = [line for cell in study.cells() for line in _of_cell(cell)]
    if any(row["flip"] is None and row["height"] > 1 for row in study.rows):
        lines.append("FLIP is missing: the package flip-evaluator was not installed.")
    lines += study.notes
    warnings = dict.fromkeys(warning for row in study.rows for warning in row["warnings"])
    return lines + [f"The renderer warned: {warning}" for warning in warnings]

"""Rows of a study: flat dicts, one for each sampler in each cell."""

from typing import Any

Row = dict[str, Any]

CELL_KEYS = ("scene", "material", "environment", "filter", "height", "width", "spp")
"""Rows that agree in these were measured together and may be compared."""


def cell_of(row: Row) -> tuple[Any, ...]:
    """Name the cell that a row belongs to."""
    return tuple(row[key] for key in CELL_KEYS)


def cell_title(row: Row) -> str:
    """Name the cell of a row in one line."""
    parts = [row["scene"], row["material"], row["environment"], row["filter"]]
    size = f"{row['width']} x {row['height']}"
    return " · ".join([*(part for part in parts if part), *([size] if row["height"] > 1 else [])])


def format_value(value: Any) -> str:
    """Write a value as a table shows it: four significant digits, a dash for what is not there."""
    if value is None:
        return "-"
    return f"{value:.4g}" if isinstance(value, float) else str(value)

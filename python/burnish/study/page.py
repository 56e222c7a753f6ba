"""One HTML page of a study that needs no other file: curves, tables, pictures to compare by a slider."""

from collections.abc import Sequence
from datetime import datetime, timezone

from burnish._version import __version__
from burnish.study.data import Kind, StudyData
from burnish.study.differences import difference_figure
from burnish.study.findings import list_findings
from burnish.study.html_parts import COMPARE_NOTE, comparison, escape, figure_uri, fill_page
from burnish.study.pareto import pareto_front
from burnish.study.plots import ERROR_LABELS, curves_figure
from burnish.study.rows import Row, cell_title, format_value
from burnish.study.store import CellPictures

CURVES: tuple[tuple[Kind, str, str, str], ...] = (
    ("error-time", "relative_rmse", "frame_ms", "Error against the time of the whole frame"),
    ("error-time", "relative_rmse", "shade_ms", "Error against the time of the shade pass alone"),
    ("error-samples", "relative_rmse", "shade_ms", "Error against samples"),
    ("time-samples", "relative_rmse", "shade_ms", "Time of the shade pass against samples"),
)

COLUMNS = (
    ("sampler", "sampler", "as the command line takes it"),
    ("samples", "samples", "samples per lobe really taken"),
    ("relative_rmse", "rel. RMSE", ERROR_LABELS["relative_rmse"]),
    ("worst_share", "worst .1 %", "share of the squared error that the worst .1 % of the pixels have"),
    ("trimmed_rmse", "RMSE of the rest", ERROR_LABELS["trimmed_rmse"]),
    ("display_rms", "display RMS", "98th percentile of the reference at 1, clipped"),
    ("flip", "FLIP", "mean over the objects"),
    ("max_error", "max error", ERROR_LABELS["max_error"]),
    ("shade_ms", "shade ms", "median, by the device's clock"),
    ("frame_ms", "frame ms", "median of the sum of all passes"),
    ("frame_deviation_ms", "± ms", "median absolute deviation of the frame's time"),
    ("wall_ms", "wall ms", "median on the wall clock, to the arrays, without compilation"),
    ("compile_ms", "compile ms", "once, in the warm-up; in none of the times"),
    ("runs", "runs", "timed runs, samplers taking turns"),
)

DIFFER_NOTE = "Difference from the reference in displayed luminance: red is too bright, blue too dark."

CURVE_DPI = 110
DIFFERENCE_DPI = 100


def make_page(study: StudyData) -> str:
    """Make the page's text.

    Parameters
    ----------
    study : StudyData
        With at least one row.

    Returns
    -------
    text : str
        A whole HTML document, without a link to anything.
    """
    if not study.rows:
        raise ValueError("page: expected a study with at least one row, got none")
    names = {row["sampler"]: row for row in study.rows}
    pictures = [cell for cell in study.pictures if cell.pictures]
    return fill_page(
        "page.html",
        facts=_facts(study),
        findings="".join(f"<li>{escape(line)}</li>" for line in list_findings(study)),
        width="wide" if len(study.cells()) > 1 else "narrow",
        curves="".join(_curve(study, *curve) for curve in CURVES),
        comparisons=_section(
            "Compare",
            COMPARE_NOTE,
            [
                comparison(f"compare-{index}", cell_title(cell.cell), cell)
                for index, cell in enumerate(pictures)
            ],
        ),
        differences=_section(
            "Where they differ", DIFFER_NOTE, [_difference(cell, names) for cell in pictures]
        ),
        tables="".join(_table(cell, study) for cell in study.cells()),
    )


def _section(title: str, note: str, parts: Sequence[str]) -> str:
    """Put parts under a heading; nothing where there are none."""
    return f'<h2>{title}</h2><p class="note">{note}</p>{"".join(parts)}' if parts else ""


def _facts(study: StudyData) -> str:
    """Say where, when and how the numbers came about."""
    rows = study.rows
    facts = {
        "Device": _all_values(rows, "device"),
        "Driver": _all_values(rows, "driver"),
        "Measured": f"{min(row['date'] for row in rows)} to {max(row['date'] for row in rows)}",
        "Burnish": _all_values(rows, "version"),
        "Reference": _all_values(rows, "reference"),
        "Page made": datetime.now(timezone.utc).isoformat(timespec="seconds") + f" by burnish {__version__}",
    }
    if study.command:
        facts["Command"] = study.command
    return "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts.items())


def _all_values(rows: Sequence[Row], key: str) -> str:
    return ", ".join(dict.fromkeys(str(row[key]) for row in rows))


def _curve(study: StudyData, kind: Kind, error: str, time: str, title: str) -> str:
    uri = figure_uri(curves_figure(study.cells(), kind, error, time), CURVE_DPI)
    name = escape(title)
    return f'<figure><figcaption>{name}</figcaption><img src="{uri}" alt="{name}"></figure>'


def _difference(cell: CellPictures, names: dict[str, Row]) -> str:
    uri = figure_uri(difference_figure([cell], names), DIFFERENCE_DPI)
    return f'<figure><img src="{uri}" alt="differences, {escape(cell_title(cell.cell))}"></figure>'


def _table(cell: Sequence[Row], study: StudyData) -> str:
    """One table for each cell; rows of the Pareto front are marked."""
    head = "".join(f'<th title="{escape(meaning)}">{escape(name)}</th>' for _, name, meaning in COLUMNS)
    front = {row["key"] for row in pareto_front(cell, "relative_rmse", "frame_ms")}
    lines = []
    for row in cell:
        passes = "; ".join(f"{name} {format_value(time)} ms" for name, time in row["passes_ms"].items())
        cells = "".join(f"<td>{escape(format_value(row.get(key)))}</td>" for key, _, _ in COLUMNS)
        mark = ' class="front"' if row["key"] in front else ""
        lines.append(f'<tr{mark} title="{escape(passes)}">{cells}</tr>')
    return (
        f"<h3>{escape(cell_title(cell[0]))}</h3>"
        f'<div class="scroll"><table><thead><tr>{head}</tr></thead>'
        f"<tbody>{''.join(lines)}</tbody></table></div>"
    )

"""Curves of a study, drawn by matplotlib without a display."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from burnish.study.data import Kind, StudyData
from burnish.study.figure import new_figure
from burnish.study.pareto import pareto_front
from burnish.study.rows import Row, cell_title

ERROR_LABELS = {
    "relative_rmse": "relative RMSE of linear radiance",
    "display_rms": "RMS error of the displayed picture",
    "flip": "mean FLIP",
    "max_error": "largest error / RMS of the reference",
    "trimmed_rmse": "relative RMSE without the worst .1 % of the pixels",
}
TIME_LABELS = {
    "frame_ms": "frame time (ms)",
    "shade_ms": "shade time (ms)",
    "wall_ms": "time on the wall clock (ms)",
}

# Okabe and Ito 2008: told apart with every common kind of colour blindness. Yellow is too pale on white.
COLORS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
PANEL_INCHES = (5.2, 4.0)
MOST_COLUMNS = 3


def method_styles(rows: Sequence[Row]) -> dict[str, dict[str, Any]]:
    """Give every method its colour and marker: the same in all plots of a study."""
    methods = dict.fromkeys(row["method"] for row in rows)
    return {
        method: {"color": COLORS[i % len(COLORS)], "marker": MARKERS[i % len(MARKERS)]}
        for i, method in enumerate(methods)
    }


def _usable(rows: Sequence[Row], *keys: str) -> list[Row]:
    """Rows that a logarithmic axis can show."""
    return [row for row in rows if all(row.get(key) is not None and row[key] > 0 for key in keys)]


def _draw_curves(
    axes: Any, rows: Sequence[Row], styles: dict[str, Any], x: str, y: str, labels: bool
) -> None:
    for method, style in styles.items():
        # A curve goes from few samples to many, also where noise puts their times in another order.
        own = [row for row in rows if row["method"] == method]
        points = sorted(_usable(own, x, y), key=lambda row: row["samples"] or 0)
        if not points:
            continue
        xs, ys = [row[x] for row in points], [row[y] for row in points]
        axes.plot(xs, ys, label=method, linewidth=1.6, markersize=5.5, zorder=3, **style)
        for row in points if labels else ():
            text = str(row["samples"] or "")
            offset = {"xytext": (4, 4), "textcoords": "offset points"}
            axes.annotate(text, (row[x], row[y]), fontsize=7, color=style["color"], **offset)


def _draw_noise(axes: Any, rows: Sequence[Row], styles: dict[str, Any], time: str, error: str) -> None:
    """Bars as long as the median absolute deviation of the time, both ways."""
    deviation = time.replace("_ms", "_deviation_ms")
    for row in _usable(rows, time, error):
        color = styles[row["method"]]["color"]
        axes.errorbar(
            row[time], row[error], xerr=row[deviation], color=color, elinewidth=1, fmt="none", zorder=2
        )


def _draw_front(axes: Any, rows: Sequence[Row], error: str, time: str) -> None:
    """Draw the front as steps: at any time, the least error that can be had."""
    front = pareto_front(_usable(rows, error, time), error, time)
    if front:
        times, errors = [row[time] for row in front], [row[error] for row in front]
        style = {"color": "0.75", "linewidth": 5, "zorder": 1, "solid_joinstyle": "round"}
        axes.step(times, errors, where="post", label="Pareto front", **style)


def _draw_reference_noise(axes: Any, rows: Sequence[Row], error: str) -> None:
    """Shade what lies below the reference's own standard error: differences there mean nothing."""
    level = max(row["reference_standard_error"] for row in rows)
    lowest = min((row[error] for row in _usable(rows, error)), default=0.0)
    if error == "relative_rmse" and level > lowest / 3:
        axes.axhspan(0, level, color="0.93", zorder=0, label="noise of the reference")


def _error_time(axes: Any, rows: Sequence[Row], styles: dict[str, Any], error: str, time: str) -> None:
    _draw_reference_noise(axes, rows, error)
    _draw_front(axes, rows, error, time)
    _draw_noise(axes, rows, styles, time, error)
    _draw_curves(axes, rows, styles, time, error, labels=True)
    axes.set(xscale="log", yscale="log", xlabel=TIME_LABELS[time], ylabel=ERROR_LABELS[error])


def _error_samples(axes: Any, rows: Sequence[Row], styles: dict[str, Any], error: str, time: str) -> None:
    _draw_reference_noise(axes, rows, error)
    _draw_curves(axes, rows, styles, "samples", error, labels=False)
    axes.set(xscale="log", yscale="log", xlabel="samples per lobe", ylabel=ERROR_LABELS[error])


def _time_samples(axes: Any, rows: Sequence[Row], styles: dict[str, Any], error: str, time: str) -> None:
    _draw_curves(axes, rows, styles, "samples", time, labels=False)
    axes.set(xlabel="samples per lobe", ylabel=TIME_LABELS[time])
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)


PANELS: dict[str, Callable[[Any, Sequence[Row], dict[str, Any], str, str], None]] = {
    "error-time": _error_time,
    "error-samples": _error_samples,
    "time-samples": _time_samples,
}


def _plain_ticks(axes: Any) -> None:
    """Write 0.05 rather than 5 x 10^-2, and label few minor ticks: none where the axis spans decades."""
    from matplotlib.ticker import LogFormatter

    class PlainNumbers(LogFormatter):
        """Labels the ticks that its base class would, as plain numbers."""

        def __call__(self, value: float, position: int | None = None) -> str:
            return f"{value:g}" if super().__call__(value, position) else ""

    for axis in (axes.xaxis, axes.yaxis):
        if axis.get_scale() == "log":
            axis.set_major_formatter(PlainNumbers())
            axis.set_minor_formatter(PlainNumbers(minor_thresholds=(1.5, 0.6)))
        axis.set_tick_params(which="both", labelsize=8)


def curves_figure(cells: Sequence[Sequence[Row]], kind: Kind, error: str, time: str) -> Any:
    """Draw one panel for each cell, with one legend.

    Parameters
    ----------
    cells : sequence of sequences of dict
        Rows by cell.
    kind : str
        A key of `PANELS`.
    error, time : str
        Keys of the rows.

    Returns
    -------
    figure : matplotlib.figure.Figure
    """
    columns = min(MOST_COLUMNS, len(cells))
    lines = -(-len(cells) // columns)
    figure = new_figure(PANEL_INCHES[0] * columns, PANEL_INCHES[1] * lines + 0.6)
    styles = method_styles([row for cell in cells for row in cell])
    grid = figure.subplots(lines, columns, squeeze=False)
    for axes, cell in zip(grid.flat, cells, strict=False):
        PANELS[kind](axes, cell, styles, error, time)
        axes.set_title(wrap_title(cell_title(cell[0])), fontsize=9)
        axes.grid(True, which="both", color="0.9", linewidth=0.6, zorder=0)
        axes.set_axisbelow(True)
        _plain_ticks(axes)
    for axes in list(grid.flat)[len(cells) :]:
        axes.set_visible(False)
    entries: dict[str, Any] = {}
    for axes in list(grid.flat)[: len(cells)]:
        handles, names = axes.get_legend_handles_labels()
        entries |= dict(zip(names, handles, strict=True))
    if entries:
        figure.legend(
            entries.values(), entries.keys(), loc="outside lower center", ncols=2 * columns, fontsize=9
        )
    return figure


def wrap_title(title: str, most_characters: int = 60) -> str:
    """Break a title at its dots so that it fits above its panel."""
    lines = [""]
    for part in title.split(" · "):
        if lines[-1] and len(lines[-1]) + len(part) > most_characters:
            lines.append("")
        lines[-1] += f" · {part}" if lines[-1] else part
    return "\n".join(lines)


def make_figure(study: StudyData, kind: Kind, error: str, time: str) -> Any:
    """Draw what `Study.plot` names.

    Parameters
    ----------
    study : StudyData
        With at least one row.
    kind, error, time : str
        As for `Study.plot`.
    """
    kinds = [*PANELS, "difference"]
    for name, value, choices in (
        ("kind", kind, kinds),
        ("error", error, list(ERROR_LABELS)),
        ("time", time, list(TIME_LABELS)),
    ):
        if value not in choices:
            raise ValueError(f"{name}: expected one of {', '.join(choices)}, got {value!r}")
    if not study.rows:
        raise ValueError("plot: expected a study with at least one row, got none")
    if kind == "difference":
        from burnish.study.differences import difference_figure

        return difference_figure(study.pictures, {row["sampler"]: row for row in study.rows})
    return curves_figure(study.cells(), kind, error, time)


def draw(study: StudyData, path: Path, kind: Kind, error: str, time: str) -> None:
    """Write what `make_figure` draws."""
    from burnish.images.files import replacing

    if path.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise ValueError(f"path: expected a name ending in .png, .svg or .pdf, got {str(path)!r}")
    figure = make_figure(study, kind, error, time)
    with replacing(path) as temporary:
        figure.savefig(temporary, dpi=150)

"""One HTML page: every statement with its verdict, then tables, curves and pictures."""

from collections.abc import Sequence
from datetime import datetime, timezone
from typing import Any

from burnish._version import __version__
from burnish.study.differences import display_picture, object_box
from burnish.study.html_parts import COMPARE_NOTE, comparison, escape, figure_uri, fill_page, picture_uri
from burnish.study.metrics import display_scale
from burnish.study.paper.data import PaperData
from burnish.study.paper.figures import difference_figure, frame_figure
from burnish.study.paper.judging import ORIGINS, find_errors, fit_frames, geometric_mean
from burnish.study.paper.settings import CELLS, COMPARED, FILTERS, MATCHED_MOST, ROLE_NAMES, PaperCell
from burnish.study.paper.verdicts import list_verdicts
from burnish.study.rows import format_value
from burnish.study.store import CellPictures, StoredPicture

DPI = 110
SHOWN_ROLES = ("published", "importance", "importance_bias", "matched", "prefiltered")
SECTIONS = {
    "table1": ("Table 1",),
    "fig7": ("Fig. 7",),
    "fig8": ("Figs. 8 and 10", "Today"),
    "fig9": ("Fig. 9",),
}
"""Items whose verdicts stand in a section of the page as well."""


def make_page(paper: PaperData) -> str:
    """Make the page's text.

    Parameters
    ----------
    paper : PaperData
        With its pictures.

    Returns
    -------
    text : str
        A whole HTML document, without a link to anything.
    """
    numbers = paper.numbers
    labels = _labels(numbers)
    return fill_page(
        "paper.html",
        facts=_facts(numbers),
        summary=_summary(numbers),
        verdicts=_verdict_table(numbers),
        **{f"{key}_lines": _verdict_list(numbers, items) for key, items in SECTIONS.items()},
        origins="".join(f"<dt>{escape(name)}</dt><dd>{escape(text)}</dd>" for name, text in ORIGINS.items()),
        pyramids=_pyramid_table(numbers["pyramids"]),
        frames=_image(figure_uri(frame_figure(numbers["frames"]), DPI), "Frame time against samples"),
        fits=_fit_table(numbers["frames"]),
        pictures="".join(_picture_row(cell, paper, labels) for cell in CELLS if cell.name in COMPARED),
        errors=_error_table(numbers),
        note=COMPARE_NOTE,
        comparisons="".join(_comparison(cell, paper) for cell in CELLS if cell.name in COMPARED),
        differences=_image(figure_uri(difference_figure(paper.pictures, labels), DPI), "Differences"),
    )


def _facts(numbers: dict[str, Any]) -> str:
    settings = numbers["settings"]
    seeds = ", ".join(map(str, settings["seeds"]))
    height, width = settings["frame_size"]
    facts = {
        "Setup": f"{settings['face_size']}-texel faces, 40 discs of 2 to 10 degrees, 1:30 to 1:3000; "
        "6x6 Gaussian; r0 = 1, alpha = 0",
        "Errors": f"geometric means over environments of seeds {seeds}; pictures show the first",
        "Frames": f"{width} x {height}; medians of {settings['repeats']} runs that take turns, warm, "
        "compilation apart",
        "Device": f"{numbers['device']}, {numbers['driver']}",
        "Measured": numbers["date"],
        "Page made": datetime.now(timezone.utc).isoformat(timespec="seconds") + f" by burnish {__version__}",
    }
    if numbers["command"]:
        facts["Command"] = numbers["command"]
    return "".join(f"<dt>{escape(name)}</dt><dd>{escape(value)}</dd>" for name, value in facts.items())


def _summary(numbers: dict[str, Any]) -> str:
    verdicts = [verdict for verdict in list_verdicts(numbers) if verdict.origin != "today"]
    holding = sum(verdict.holds is True for verdict in verdicts)
    is_open = sum(verdict.holds is None for verdict in verdicts)
    undecided = f"; {is_open} are left open by noise" if is_open else ""
    return f"{holding} of {len(verdicts)} statements hold here{undecided}."


def _verdict_table(numbers: dict[str, Any]) -> str:
    lines = []
    for verdict in list_verdicts(numbers):
        kind = {True: "yes", False: "no", None: "open"}[verdict.holds]
        lines.append(
            f"<tr><td>{escape(verdict.item)}</td>"
            f"<td>{escape(verdict.claim)} <i>({escape(verdict.origin)})</i></td>"
            f'<td class="{kind}">{escape(verdict.word)}</td>'
            f"<td>{escape(verdict.by)}<br><small>{escape(verdict.measured)}</small></td></tr>"
        )
    head = (
        "<tr><th>item</th><th>statement</th><th>verdict</th><th>by how much, and what was measured</th></tr>"
    )
    return f'<table class="verdicts"><thead>{head}</thead><tbody>{"".join(lines)}</tbody></table>'


def _verdict_list(numbers: dict[str, Any], items: Sequence[str]) -> str:
    lines = []
    for verdict in list_verdicts(numbers):
        if verdict.item in items:
            kind = {True: "yes", False: "no", None: "open"}[verdict.holds]
            lines.append(
                f'<li>{escape(verdict.claim)} <b class="{kind}">{escape(verdict.word)}</b>: '
                f"{escape(verdict.by)}</li>"
            )
    return f'<ul class="lines">{"".join(lines)}</ul>'


def _table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    row = "".join(f"<th>{escape(name)}</th>" for name in head)
    body = "".join(f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in line)}</tr>" for line in lines)
    return f'<div class="scroll"><table><thead><tr>{row}</tr></thead><tbody>{body}</tbody></table></div>'


def _image(uri: str, name: str) -> str:
    return f'<figure><img src="{uri}" alt="{escape(name)}"></figure>'


def _pyramid_table(rows: Sequence[dict[str, Any]]) -> str:
    times = {(row["face_size"], row["filter"]): row for row in rows}
    lines = []
    for size in sorted({row["face_size"] for row in rows}):
        box = times[size, "box"]["ms"]
        cells = [
            f"{one['ms']:.2f} ± {one['deviation_ms']:.2f} ({one['ms'] / box:.2f})"
            for one in (times[size, name] for name in FILTERS)
        ]
        lines.append([str(size), *cells])
    return _table(["faces", "box 2x2", "Gauss 4x4", "Gauss 6x6"], lines)


def _fit_table(frames: Sequence[dict[str, Any]]) -> str:
    lines = []
    for role in dict.fromkeys(row["role"] for row in frames):
        for share, line in fit_frames(frames, role).items():
            fit = [f"{line.slope:.3f}", f"{line.intercept:.2f}", f"{line.r_squared:.4f}"]
            rows = [row for row in frames if row["role"] == role and row["share"] == share]
            times = ", ".join(f"{row['samples']}: {row['frame']['ms']:.1f}" for row in rows)
            lines.append([ROLE_NAMES[role], f"{rows[0]['covered']:.2%}", *fit, times])
    head = [
        "sampler",
        "covered",
        "ms a sample",
        "ms at none",
        "R²",
        "samples: ms of the frame",
    ]
    return _table(head, lines)


def _labels(numbers: dict[str, Any]) -> dict[tuple[str, str], str]:
    """What stands beside the pictures of the first environment."""
    first = numbers["settings"]["seeds"][0]
    return {
        (row["cell"], row["role"]): f"{ROLE_NAMES[row['role']]}, {row['samples']}\n"
        f"display RMS {row['display_rms']:.3g}, relative {row['relative_rmse']:.3g}"
        for row in numbers["pictures"]
        if row["seed"] == first and row["role"] in ROLE_NAMES
    }


def _cell_heading(cell: PaperCell) -> str:
    slopes = "/".join(dict.fromkeys(f"{slope:g}" for slope in cell.roughness))
    return f"{cell.printed_samples} samples, m {slopes}, xi0 {cell.threshold:g}"


def _picture_row(cell: PaperCell, paper: PaperData, labels: dict[tuple[str, str], str]) -> str:
    drawn = paper.pictures[cell.name]
    crop = object_box(drawn.reference.covered)
    scale = display_scale(drawn.reference.color[drawn.reference.covered])
    colors = {"reference": drawn.reference.color}
    colors |= {role: drawn.pictures[role] for role in SHOWN_ROLES if role in drawn.pictures}
    figures = []
    for role, color in colors.items():
        own = f"reference\nits own relative error about {drawn.reference.standard_error:.1g}"
        label = escape(labels.get((cell.name, role), own)).replace("\n", "<br>")
        uri = picture_uri(display_picture(color, scale)[crop])
        figures.append(f'<figure><img src="{uri}" alt="{label}"><figcaption>{label}</figcaption></figure>')
    return f'<h3>{escape(_cell_heading(cell))}</h3><div class="row">{"".join(figures)}</div>'


def _comparison(cell: PaperCell, paper: PaperData) -> str:
    drawn = paper.pictures[cell.name]
    crop = object_box(drawn.reference.covered)
    reference = StoredPicture(drawn.reference.color[crop], drawn.reference.covered[crop])
    colors = {ROLE_NAMES[role]: drawn.pictures[role][crop] for role in ROLE_NAMES if role in drawn.pictures}
    return comparison(
        f"compare-{cell.name}", _cell_heading(cell), CellPictures(drawn.cell, reference, colors)
    )


def _error_table(numbers: dict[str, Any]) -> str:
    """One line for each cell and role; means over the environments."""
    lines = []
    for cell in CELLS:
        for role, name in ROLE_NAMES.items():
            rows = [row for row in numbers["pictures"] if (row["cell"], row["role"]) == (cell.name, role)]
            if not rows:
                continue
            means = []
            for error in ("display_rms", "relative_rmse", "flip"):
                errors = list(find_errors(numbers, cell.name, role, error).values())
                means.append(format_value(geometric_mean(errors)) if errors else "-")
            bias = [row["mean_error"] for row in rows if row["mean_error"] is not None]
            brightness = f"{100 * sum(bias) / len(bias):+.2f} %" if bias else "-"
            lines.append([_cell_heading(cell), name, str(rows[0]["samples"]), *means, brightness])
    head = ["cell", "sampler", "samples", "display RMS", "rel. RMSE", "FLIP", "mean radiance"]
    remark = f"Matched has tables up to {MATCHED_MOST} samples; prefiltered is one lookup at any count."
    return _table(head, lines) + f'<p class="note">{remark}</p>'

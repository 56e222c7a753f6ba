"""Drawings of the reproduction: Fig. 7's curves and Fig. 9's false colours."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from burnish.study.differences import BACKGROUND, COLORMAP, difference_range, object_box
from burnish.study.figure import new_figure
from burnish.study.metrics import signed_difference
from burnish.study.paper.judging import fit_frames
from burnish.study.paper.settings import DIFFERENCES, ROLE_NAMES, SHARES
from burnish.study.plots import COLORS, MARKERS
from burnish.study.store import CellPictures

FRAME_ROLES = ("published", "importance", "matched", "prefiltered")
DIFFERENCE_ROLES = ("published", "importance", "matched")
PANEL_INCHES = (3.9, 3.3)
PICTURE_INCHES = 2.5


def frame_figure(frames: Sequence[dict[str, Any]]) -> Any:
    """Draw frame time against samples, one panel for each share of the screen, with fitted lines.

    Parameters
    ----------
    frames : sequence of dict
        As `measure_frames` gives them.

    Returns
    -------
    figure : matplotlib.figure.Figure
    """
    figure = new_figure(PANEL_INCHES[0] * len(SHARES), PANEL_INCHES[1] + 0.4)
    panels = figure.subplots(1, len(SHARES), sharey=True)
    for axes, share in zip(panels, SHARES, strict=True):
        for index, role in enumerate(FRAME_ROLES):
            rows = [row for row in frames if row["role"] == role and row["share"] == share]
            if not rows:
                continue
            style = {"color": COLORS[index], "label": ROLE_NAMES[role]}
            samples = [row["samples"] for row in rows]
            times = [row["frame"]["ms"] for row in rows]
            noise = [row["frame"]["deviation_ms"] for row in rows]
            axes.errorbar(samples, times, noise, fmt=MARKERS[index], markersize=5.5, zorder=3, **style)
            line = fit_frames(rows, role).get(share)
            if line is not None:
                ends = np.array([0.0, max(samples)])
                axes.plot(
                    ends, line.intercept + line.slope * ends, color=COLORS[index], linewidth=1.3, zorder=2
                )
        axes.set_title(f"{share:.0%} of the screen glossy", fontsize=10)
        axes.set_xlabel("samples per lobe")
        axes.grid(True, color="0.9", linewidth=0.6)
        axes.set_axisbelow(True)
        axes.set_xlim(left=0)
        axes.tick_params(labelsize=8)
    panels[0].set_ylabel("frame time (ms)")
    panels[0].set_ylim(bottom=0)  # only now: it would fix the top of the axis that all share
    handles, names = panels[-1].get_legend_handles_labels()
    figure.legend(handles, names, loc="outside lower center", ncols=len(FRAME_ROLES), fontsize=9)
    return figure


def difference_figure(pictures: Mapping[str, CellPictures], labels: Mapping[tuple[str, str], str]) -> Any:
    """Draw Fig. 9: how samplers differ from the reference, all with the same colours.

    Parameters
    ----------
    pictures : mapping of CellPictures
        By the name of the cell.
    labels : mapping of str
        By cell and role: what stands above the picture.

    Returns
    -------
    figure : matplotlib.figure.Figure
    """
    from matplotlib import colormaps

    cells = [pictures[name] for name in DIFFERENCES]
    roles = [role for role in DIFFERENCE_ROLES if all(role in cell.pictures for cell in cells)]
    differences = {
        (name, role): signed_difference(cell.pictures[role], cell.reference.color, cell.reference.covered)
        for name, cell in zip(DIFFERENCES, cells, strict=True)
        for role in roles
    }
    limit = difference_range(list(differences.values()))
    colors = colormaps[COLORMAP].with_extremes(bad=BACKGROUND)
    figure = new_figure(PICTURE_INCHES * len(cells) + 1.1, (PICTURE_INCHES + 0.35) * len(roles))
    grid = figure.subplots(len(roles), len(cells), squeeze=False)
    image = None
    for line, role in zip(grid, roles, strict=True):
        for axes, name, cell in zip(line, DIFFERENCES, cells, strict=True):
            shown = np.ma.masked_invalid(differences[name, role][object_box(cell.reference.covered)])
            image = axes.imshow(shown, cmap=colors, vmin=-limit, vmax=limit)
            axes.set_title(labels[name, role], fontsize=8)
            axes.axis("off")
    bar = figure.colorbar(image, ax=list(grid.flat), fraction=0.03, extend="both")
    bar.set_label(
        "too dark  $\\leftarrow$  $\\rightarrow$  too bright\n(luminance; the display's white is 1)",
        fontsize=8,
    )
    bar.ax.tick_params(labelsize=8)
    return figure

"""False-colour pictures of how samplers differ from the reference."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.study.metrics import display_scale, display_values, signed_difference
from burnish.study.rows import cell_title
from burnish.study.store import CellPictures

Box = tuple[slice, slice]

COLORMAP = "RdBu_r"
"""Blue too dark, white equal, red too bright; told apart with every common kind of colour blindness."""

BACKGROUND = "0.6"
SHOWN_PERCENTILE = 99.0
MOST_COLUMNS = 5
PICTURE_INCHES = 2.6


def difference_range(differences: Sequence[NDArray[Any]]) -> float:
    """Largest difference that the colours tell apart: nearly the largest of all, and a round number.

    Parameters
    ----------
    differences : sequence of (h, w) arrays
        In displayed units; NaN where nothing counts.
    """
    values = (
        np.concatenate([np.abs(one[np.isfinite(one)]) for one in differences]) if differences else np.zeros(0)
    )
    level = float(np.percentile(values, SHOWN_PERCENTILE)) if values.size else 0.0
    steps = (0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 1.0)
    return next((step for step in steps if step >= level), 1.0)


def display_picture(picture: NDArray[np.float32], scale: float) -> NDArray[np.float32]:
    """Scale, clip and encode a picture as sRGB, for showing."""
    from burnish.images import srgb_encode

    return srgb_encode(display_values(picture, scale))


def object_box(covered: NDArray[np.bool_], margin_px: int = 2) -> Box:
    """Find the rows and columns that hold all objects; all of the picture where there is none.

    Parameters
    ----------
    covered : (h, w) bool
        Where objects are.
    margin_px : int
        Added on all sides.
    """
    spans = []
    for axis, length in ((1, covered.shape[0]), (0, covered.shape[1])):
        used = np.flatnonzero(covered.any(axis=axis))
        first, last = (used[0], used[-1]) if used.size else (0, length - 1)
        spans.append(slice(max(int(first) - margin_px, 0), min(int(last) + margin_px + 1, length)))
    return spans[0], spans[1]


def difference_figure(cells: Sequence[CellPictures], rows: Mapping[str, Any]) -> Any:
    """Draw the reference and, for each sampler, its signed difference in displayed luminance.

    Parameters
    ----------
    cells : sequence of CellPictures
        One block each, with its own colour bar.
    rows : mapping
        Unused samplers are left out: only those named here are drawn.

    Returns
    -------
    figure : matplotlib.figure.Figure
    """
    from burnish.study.figure import new_figure

    if not cells:
        raise ValueError("plot: expected a study that kept its pictures, got none")
    counts = [1 + sum(text in rows for text in cell.pictures) for cell in cells]
    columns = min(MOST_COLUMNS, max(counts))
    lines = [-(-count // columns) for count in counts]
    crops = [object_box(cell.reference.covered) for cell in cells]
    heights = [
        count * (PICTURE_INCHES * (crop[0].stop - crop[0].start) / (crop[1].stop - crop[1].start) + 0.3) + 0.4
        for count, crop in zip(lines, crops, strict=True)
    ]
    figure = new_figure(PICTURE_INCHES * columns + 0.9, sum(heights))
    blocks = figure.subfigures(len(cells), 1, squeeze=False, height_ratios=heights)[:, 0]
    for block, cell, crop, line_count in zip(blocks, cells, crops, lines, strict=True):
        texts = [text for text in cell.pictures if text in rows]
        block.suptitle(cell_title(cell.cell), fontsize=9)
        _draw_block(block, block.subplots(line_count, columns, squeeze=False), cell, crop, texts)
    return figure


def _draw_block(block: Any, grid: Any, cell: CellPictures, crop: Box, texts: Sequence[str]) -> None:
    from matplotlib import colormaps

    truth, covered = cell.reference.color, cell.reference.covered
    differences = [signed_difference(cell.pictures[text], truth, covered) for text in texts]
    limit = difference_range(differences)
    colors = colormaps[COLORMAP].with_extremes(bad=BACKGROUND)
    axes = list(grid.flat)
    axes[0].imshow(display_picture(truth, display_scale(truth[covered]))[crop])
    axes[0].set_title("reference", fontsize=8)
    image = None
    for one, text, difference in zip(axes[1:], texts, differences, strict=False):
        image = one.imshow(np.ma.masked_invalid(difference[crop]), cmap=colors, vmin=-limit, vmax=limit)
        one.set_title(text, fontsize=8)
    for one in axes:
        one.axis("off")
    if image is not None:
        bar = block.colorbar(image, ax=axes, fraction=0.03, extend="both")
        bar.set_label(
            "too dark  $\\leftarrow$  $\\rightarrow$  too bright\n(luminance; the display's white is 1)",
            fontsize=8,
        )
        bar.ax.tick_params(labelsize=8)

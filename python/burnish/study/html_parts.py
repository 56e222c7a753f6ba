"""What the pages of a study share: pictures inside the page, the slider, one look."""

import base64
import html
import io
from importlib import resources
from string import Template
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from burnish.study.differences import display_picture
from burnish.study.metrics import display_scale
from burnish.study.store import CellPictures

COMPARE_NOTE = (
    "Drag across the picture, or use the arrow keys. Both sides are shown with the 98th percentile of the "
    "reference at white."
)


def read_resource(name: str) -> str:
    """Read a text file that lies beside this module."""
    return resources.files("burnish.study").joinpath(name).read_text(encoding="utf-8")


def fill_page(template: str, **parts: str) -> str:
    """Put parts into a template that lies beside this module.

    Parameters
    ----------
    template : str
        Name of the file.
    parts : str
        HTML by the name of its place. The look and the slider's script need not be given.
    """
    shared = {"style": read_resource("page.css"), "script": read_resource("slider.js")}
    return Template(read_resource(template)).substitute(shared | parts)


def escape(value: Any) -> str:
    """Write a value so that it shows as it is."""
    return html.escape(str(value))


def data_uri(data: bytes, kind: str = "png") -> str:
    """Put an image file into the text of an address."""
    return f"data:image/{kind};base64,{base64.b64encode(data).decode('ascii')}"


def figure_uri(figure: Any, dpi: int) -> str:
    """Draw a matplotlib figure into an address."""
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png", dpi=dpi)
    return data_uri(buffer.getvalue())


def picture_uri(shown: NDArray[np.float32]) -> str:
    """Put a picture of values in 0..1 into an address, pixel by pixel.

    Parameters
    ----------
    shown : (h, w, 3) float32
        Encoded for display.
    """
    buffer = io.BytesIO()
    Image.fromarray(np.rint(shown * 255).astype(np.uint8)).save(buffer, format="PNG", optimize=True)
    return data_uri(buffer.getvalue())


def comparison(identifier: str, title: str, cell: CellPictures) -> str:
    """Lay two pictures over one another, each chosen from a list, with a slider between them.

    Parameters
    ----------
    identifier : str
        Of the section, unique on the page.
    title : str
        Its heading.
    cell : CellPictures
        Pictures by name, and their reference.
    """
    truth, covered = cell.reference.color, cell.reference.covered
    scale = display_scale(truth[covered])
    pictures = {"reference": truth, **cell.pictures}
    uris = {escape(name): picture_uri(display_picture(color, scale)) for name, color in pictures.items()}
    images = "".join(f'<img data-name="{name}" src="{uri}" alt="{name}">' for name, uri in uris.items())
    left = next(iter(cell.pictures), "reference")
    height, width = truth.shape[:2]
    return (
        f'<section class="compare" id="{identifier}" style="--w:{width};--h:{height}">'
        f"<h3>{escape(title)}</h3>"
        f'<div class="choice"><label>left {_choices(pictures, left)}</label>'
        f"<label>right {_choices(pictures, 'reference')}</label></div>"
        f'<div class="stage"><img class="right" alt="right"><img class="left" alt="left">'
        '<span class="bar"></span><input type="range" min="0" max="100" value="50" step="0.1" '
        'aria-label="where the left picture ends"></div>'
        f'<div class="store" hidden>{images}</div></section>'
    )


def _choices(names: Any, chosen: str) -> str:
    options = "".join(
        f"<option{' selected' if name == chosen else ''}>{escape(name)}</option>" for name in names
    )
    return f"<select>{options}</select>"

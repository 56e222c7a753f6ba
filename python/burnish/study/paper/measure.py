"""Makes the paper's numbers and pictures, and keeps them together."""

import json
import os
from dataclasses import asdict
from datetime import datetime, timezone
from typing import Any

from burnish import _core, environments
from burnish._device import default_device
from burnish._version import __version__
from burnish.images.files import write_text
from burnish.study.paper.data import PaperData
from burnish.study.paper.formulas import examine_formulas
from burnish.study.paper.pictures import draw_cells, picture_steps
from burnish.study.paper.settings import FILTERS, PaperSettings
from burnish.study.paper.times import frame_steps, measure_frames, measure_pyramids
from burnish.study.paper.truth import truth_maps
from burnish.study.paper.verdicts import list_verdicts
from burnish.study.runner import step_bar
from burnish.study.store import CellPictures

FORMAT = 1
"""Of the JSON file; grows when a number changes its meaning."""


class Paper(PaperData):
    """The reproduction, and what can be made of it.

    Parameters
    ----------
    numbers : dict
        As JSON takes it: ``pyramids`` and ``frames`` (milliseconds), ``pictures`` (errors), ``formulas``,
        ``settings``, ``device``, ``driver``, ``is_software``, ``date``, ``version``, ``command``.
    pictures : dict of CellPictures
        By the name of the cell.
    """

    def __repr__(self) -> str:
        return f"Paper({len(self.numbers['pictures'])} pictures, {len(self.numbers['frames'])} frames)"

    def save_html(self, path: str | os.PathLike[str]) -> None:
        """Write one page that needs nothing else.

        Parameters
        ----------
        path : path
            Its folder must exist.

        Raises
        ------
        ImportError
            Without matplotlib, with the command that installs it.
        """
        from burnish.study.paper.page import make_page

        write_text(path, make_page(self))

    def save_json(self, path: str | os.PathLike[str]) -> None:
        """Write numbers and verdicts.

        Parameters
        ----------
        path : path
            Its folder must exist.
        """
        verdicts = [asdict(verdict) for verdict in list_verdicts(self.numbers)]
        data = {"burnish_paper": FORMAT, **self.numbers, "verdicts": verdicts}
        write_text(path, json.dumps(data, indent=1, allow_nan=False) + "\n")


def measure_paper(
    settings: PaperSettings | None = None,
    device: _core.Device | None = None,
    command: str = "",
    progress: bool = True,
) -> Paper:
    """Do the paper's evaluation again.

    Parameters
    ----------
    settings : PaperSettings or None
        Sizes. None: the paper's.
    device : Device or None
        None: the best one, opened once.
    command : str
        Command line, for the page.
    progress : bool
        Whether a bar is shown, on a terminal.

    Returns
    -------
    paper : Paper
        Nothing is written before it is complete.
    """
    settings = settings or PaperSettings()
    device = device or default_device()
    pyramid_steps = len(settings.pyramid_sizes) * len(FILTERS) * (1 + settings.repeats)
    steps = len(settings.seeds) + pyramid_steps + frame_steps(settings) + picture_steps(settings)
    numbers: dict[str, Any] = {
        "command": command,
        "device": device.name,
        "driver": device.driver,
        "is_software": device.is_software,
        "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
        "version": __version__,
        "settings": asdict(settings),
        "formulas": examine_formulas(),
        "pictures": [],
    }
    pictures: dict[str, CellPictures] = {}
    with step_bar(steps, progress) as step:
        for index, seed in enumerate(settings.seeds):
            step(0, f"environment {seed}")
            environment = environments.spots(seed, settings.face_size)
            step(1, f"environment {seed}")
            maps = truth_maps(environment, settings.reference_faces)
            edge = settings.further_px if index else settings.picture_px
            drawn = draw_cells(environment, maps, seed, edge, device, step)
            numbers["pictures"] += drawn.rows
            if index == 0:
                pictures = drawn.pictures
                numbers["frames"] = measure_frames(environment, settings, device, step)
        sizes = {size: environments.uniform(1.0, size) for size in settings.pyramid_sizes}
        numbers["pyramids"] = measure_pyramids(sizes, settings, device, step)
    return Paper(numbers, pictures)

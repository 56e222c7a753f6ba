"""Figs. 8 to 10: pictures of one sphere by every sampler, and their errors."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from burnish import _core
from burnish.frame import FloatArray
from burnish.rendering import Filter
from burnish.samplers import sampler_from_text
from burnish.study.measure import Step, largest_count
from burnish.study.metrics import measure_errors
from burnish.study.paper.scenes import glossy, sphere_camera, sphere_scene
from burnish.study.paper.settings import CELLS, FILTER_CELL, FILTERS, PaperCell, PaperSettings
from burnish.study.paper.truth import Truth, draw_truth
from burnish.study.store import CellPictures, StoredPicture
from burnish.study.subject import SceneSubject, Shot


@dataclass(frozen=True, eq=False)
class Drawn:
    """What one environment gave.

    Parameters
    ----------
    rows : list of dict
        Errors, one row for each cell and role.
    pictures : dict of CellPictures
        By the cell's name; pictures by role.
    """

    rows: list[dict[str, Any]]
    pictures: dict[str, CellPictures]


def _candidates(cell: PaperCell) -> Iterator[tuple[str, str, Filter]]:
    """Role, sampler and filter of everything that is drawn in a cell."""
    samplers = cell.samplers()
    for role, text in samplers.items():
        yield role, text, "gauss6"
    if cell.name == FILTER_CELL:
        for name in FILTERS[:-1]:
            yield f"published_{name}", samplers["published"], name


def picture_steps(settings: PaperSettings) -> int:
    """Count the pictures that `draw_cells` draws under all environments."""
    truths = len({cell.roughness for cell in CELLS})
    return len(settings.seeds) * (truths + sum(len(list(_candidates(cell))) for cell in CELLS))


def _mean_error(color: FloatArray, truth: FloatArray) -> float | None:
    """How much brighter all of the picture is, relative; None where the truth is black."""
    total = float(np.sum(truth, dtype=np.float64))
    return float(np.sum(color, dtype=np.float64)) / total - 1 if total > 0 else None


def _row(
    cell: PaperCell, seed: int, role: str, text: str, filter: str, shot: Shot, truth: Truth
) -> dict[str, Any]:
    covered = truth.shot.covered
    errors = measure_errors(shot.color, truth.shot.color, covered)
    return {
        "cell": cell.name,
        "seed": seed,
        "role": role,
        "sampler": text,
        "filter": filter,
        "samples": largest_count(shot.samples_used),
        **errors.as_dict(),
        "mean_error": _mean_error(shot.color[covered], truth.shot.color[covered]),
        "reference_error": truth.error,
    }


def draw_cells(
    environment: _core.Environment,
    maps: Sequence[_core.Environment],
    seed: int,
    edge_px: int,
    device: _core.Device,
    step: Step,
) -> Drawn:
    """Draw every cell under one environment and judge it.

    Parameters
    ----------
    environment : Environment
        The paper's.
    maps : sequence of Environment
        What the reference sums over; see `truth_maps`.
    seed : int
        Names the environment in the rows.
    edge_px : int
        Edge of the square pictures.
    device : Device
        Draws.
    step : callable
        Called after each picture, and during the reference.
    """
    camera, size = sphere_camera(), (edge_px, edge_px)
    truths: dict[tuple[float, float], Truth] = {}
    drawn = Drawn([], {})
    for cell in CELLS:
        scene = sphere_scene(glossy(cell.roughness), environment)
        truth = truths.get(cell.roughness)
        if truth is None:
            reference_scene = sphere_scene(glossy(cell.roughness), environment)
            truth = draw_truth(
                reference_scene,
                camera,
                size,
                list(maps),
                device,
                lambda share, _: step(0, f"reference {share:.0%}"),
            )
            truths[cell.roughness] = truth
            step(1, "reference")
        shots: dict[str, Shot] = {}
        for role, text, filter in _candidates(cell):
            subject = SceneSubject(scene, camera, size, 1, filter, device)
            shots[role] = subject.draw(sampler_from_text(text))
            drawn.rows.append(_row(cell, seed, role, text, filter, shots[role], truth))
            step(1, text)
        description = {"scene": "sphere", "cell": cell.name, "seed": seed}
        reference = StoredPicture(truth.shot.color, truth.shot.covered, truth.error)
        colors = {role: shot.color for role, shot in shots.items()}
        drawn.pictures[cell.name] = CellPictures(description, reference, colors)
    return drawn

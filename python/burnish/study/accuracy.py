"""One scene, or points of a surface: how wrong each sampler is, and what it costs."""

import os
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from burnish import _core
from burnish.frame import FloatArray, Frame, require_comparable
from burnish.rendering import Filter, require_filter, require_size
from burnish.samplers import sampler_from_text, sampler_to_text
from burnish.study.identity import digest
from burnish.study.measure import Cell
from burnish.study.runner import open_journal, run_cells
from burnish.study.sources import LiveSource
from burnish.study.store import PictureStore, StoredPicture
from burnish.study.study import Study
from burnish.study.subject import Points, Sampler, make_subject

DEFAULT_REPEATS = 5


def sampler_texts(samplers: Iterable[Sampler | str]) -> tuple[str, ...]:
    """Name samplers by their full text; ValueError where there are none, or two alike."""
    texts = tuple(
        sampler_to_text(sampler_from_text(sampler) if isinstance(sampler, str) else sampler)
        for sampler in samplers
    )
    twice = [text for text in texts if texts.count(text) > 1]
    if not texts or twice:
        raise ValueError(
            f"samplers: expected different samplers, got {f'{twice[0]} twice' if twice else 'none'}"
        )
    return texts


def require_repeats(repeats: int) -> None:
    """Raise ValueError unless there is at least one run."""
    if repeats < 1:
        raise ValueError(f"repeats: expected at least 1, got {repeats}")


def accuracy(
    scene_or_points: _core.Scene | Points | Sequence[Any],
    samplers: Iterable[Sampler | str],
    reference: Sampler | str | Frame | FloatArray | None = None,
    camera: _core.Camera | None = None,
    size: tuple[int, int] = (270, 480),
    spp: int = 1,
    filter: Filter = "gauss6",
    repeats: int = DEFAULT_REPEATS,
    device: _core.Device | None = None,
    journal: str | os.PathLike[str] | None = None,
    progress: bool = True,
) -> Study:
    """Measure error and time of samplers on one scene, or on points of a surface.

    Every sampler draws the picture once, which compiles its shaders and gives its error; then all take turns
    and are timed.

    Parameters
    ----------
    scene_or_points : Scene, Points or (environment, material, normals, tangents, views)
        What is drawn. Points are timed on the wall clock.
    samplers : iterable of samplers, or of texts such as "regular:14"
        No two alike.
    reference : sampler, text, Frame, array or None
        The truth, or how to draw it. An array is linear radiance, (h, w, 3) or (n, 3) float32; all of it
        counts, where of a frame only what objects cover does. None: ``Reference()``, which may take minutes;
        its standard error should be a tenth of the errors that it judges. A frame of another `spp` counts
        edges as errors, with a warning; one of another camera is refused.
    camera : Camera or None
        None: the scene's first, or one that sees all of it.
    size : (height, width)
        Pixels.
    spp : int
        Jittered frames to accumulate.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the environment's pyramid.
    repeats : int
        Timed runs of each sampler, at least 1.
    device : Device or None
        None: the best, opened once.
    journal : path or None
        File of JSON lines that gets every row when it is finished, with the pictures in a folder beside it.
        A later call with the same file takes up where this one stopped.
    progress : bool
        Whether a bar is shown, on a terminal.

    Returns
    -------
    study : Study

    Raises
    ------
    StudyInterrupted
        At Ctrl-C (it is a KeyboardInterrupt); its ``study`` holds the rows so far.
    """
    require_filter(filter)
    require_repeats(repeats)
    source = LiveSource(make_subject(scene_or_points, camera, size, spp, filter, device))
    rows, store = open_journal(journal)
    if reference is None:
        reference = _core.Reference()
    if isinstance(reference, Frame) and isinstance(scene_or_points, _core.Scene):
        seen_by = camera or next(iter(scene_or_points.cameras), None) or scene_or_points.default_camera()
        require_comparable(reference, require_size(size), seen_by, spp)
    if isinstance(reference, Frame | np.ndarray):
        cell = _cell_of_given_reference(source, sampler_texts(samplers), reference, repeats, store)
    else:
        cell = Cell(source, sampler_texts(samplers), sampler_texts([reference])[0], repeats)
    return run_cells([cell], rows, store, keeps_pictures=True, shows_progress=progress)


def _cell_of_given_reference(
    source: LiveSource,
    samplers: tuple[str, ...],
    reference: Frame | FloatArray,
    repeats: int,
    store: PictureStore,
) -> Cell:
    """Put a reference that is already there into the store, under a name made of its values."""
    if isinstance(reference, Frame):
        picture = StoredPicture(reference.color, reference.alpha > 0, reference.report.standard_error)
    else:
        picture = StoredPicture(reference, np.ones(reference.shape[:-1], bool))
    cell = Cell(source, samplers, f"given {digest(picture.color)}", repeats)
    store.put(cell.reference_key(), picture)
    return cell

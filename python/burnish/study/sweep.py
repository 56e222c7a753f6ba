"""A grid of scenes, materials, environments and filters, each drawn by all samplers."""

import os
from collections.abc import Iterable, Sequence

from burnish import _core
from burnish.rendering import Filter, require_filter
from burnish.study.accuracy import DEFAULT_REPEATS, require_repeats, sampler_texts
from burnish.study.identity import describe_material
from burnish.study.measure import Cell
from burnish.study.runner import open_journal, run_cells
from burnish.study.sources import EnvironmentSource, SceneSource, require_scene_name
from burnish.study.study import Study
from burnish.study.subject import Sampler


def make_cells(
    samplers: Iterable[Sampler | str],
    scenes: Sequence[str] = ("sphere",),
    environments: Sequence[str | EnvironmentSource] = ("studio",),
    materials: Sequence[_core.Material] | None = None,
    filters: Sequence[Filter] = ("gauss6",),
    reference: Sampler | str | None = None,
    camera: str | None = None,
    size: tuple[int, int] = (270, 480),
    spp: int = 1,
    repeats: int = DEFAULT_REPEATS,
    device: str = "",
) -> list[Cell]:
    """Describe the cells of a grid; the parameters are those of `sweep`."""
    texts = sampler_texts(samplers)
    truth = sampler_texts([_core.Reference() if reference is None else reference])[0]
    require_repeats(repeats)
    for filter in filters:
        require_filter(filter)
    for scene in scenes:
        require_scene_name(scene)
    lights = [
        light if isinstance(light, EnvironmentSource) else EnvironmentSource.from_text(light)
        for light in environments
    ]
    surfaces = [None] if materials is None else [describe_material(material) for material in materials]
    # Filters come innermost: they share a reference, and the store keeps only the last.
    return [
        Cell(SceneSource(scene, light, surface, filter, size, spp, camera, device), texts, truth, repeats)
        for scene in scenes
        for light in lights
        for surface in surfaces
        for filter in filters
    ]


def sweep(
    samplers: Iterable[Sampler | str],
    scenes: Sequence[str] = ("sphere",),
    environments: Sequence[str | EnvironmentSource] = ("studio",),
    materials: Sequence[_core.Material] | None = None,
    filters: Sequence[Filter] = ("gauss6",),
    reference: Sampler | str | None = None,
    camera: str | None = None,
    size: tuple[int, int] = (270, 480),
    spp: int = 1,
    repeats: int = DEFAULT_REPEATS,
    device: str = "",
    journal: str | os.PathLike[str] | None = None,
    keep_pictures: bool = False,
    progress: bool = True,
    scheduler: str | None = None,
    workers: int = 0,
    command: str = "",
) -> Study:
    """Measure error and time of samplers over a grid.

    Every cell of the grid, one scene with one environment, material and filter, is measured as `accuracy`
    does it. Scenes and environments are given by name, so that other processes can make them too.

    Parameters
    ----------
    samplers : iterable of samplers, or of texts such as "regular:14"
        No two alike.
    scenes : sequence of str
        Built-in scenes or glTF files.
    environments : sequence of str or EnvironmentSource
        Built-in environments, with arguments if need be (``spots:seed=2:face_size=512``), or files.
    materials : sequence of Material or None
        Each takes the place of the scene's first material; textures are not carried over. None: the scene's
        own.
    filters : sequence of "box", "gauss4" or "gauss6"
        Reduction filters of the pyramid.
    reference : sampler, text or None
        Draws the truth. None: ``Reference()``, which may take minutes a cell.
    camera : str or None
        Name or index of a camera. None: the scene's first, or one that sees all of it.
    size : (height, width)
        Pixels.
    spp : int
        Jittered frames to accumulate.
    repeats : int
        Timed runs of each sampler, at least 1.
    device : str
        Part of a Vulkan device's name; empty: the best one.
    journal : path or None
        File of JSON lines that gets every row when its cell is finished, with the pictures in a folder beside
        it. A later call with the same file takes up where this one stopped.
    keep_pictures : bool
        Whether the study gets its pictures, for a page; a large sweep would fill the memory with them.
    progress : bool
        Whether a bar is shown, on a terminal.
    scheduler : str or None
        Address of a dask scheduler such as ``tcp://host:8786``; its workers measure the cells.
    workers : int
        Start so many worker processes here, without a scheduler. 0: measure in this process. Several workers
        of one machine disturb one another's times. A script that starts workers needs the usual
        ``if __name__ == "__main__":``.
    command : str
        Command line to be shown on the page.

    Returns
    -------
    study : Study
        Rows in the order of the grid: scenes, environments, materials, filters, samplers; the same ones,
        apart from times, however many workers there were.

    Raises
    ------
    StudyInterrupted
        At Ctrl-C (it is a KeyboardInterrupt); its ``study`` holds the rows so far.
    ImportError
        With `scheduler` or `workers` but without dask.distributed.
    """
    cells = make_cells(
        samplers,
        scenes,
        environments,
        materials,
        filters,
        reference,
        camera,
        size,
        spp,
        repeats,
        device,
    )
    rows, store = open_journal(journal)
    if scheduler is None and workers == 0:
        return run_cells(cells, rows, store, keep_pictures, progress, command)
    from burnish.study.cluster import run_cells_on_cluster

    return run_cells_on_cluster(cells, rows, store, keep_pictures, progress, command, scheduler, workers)

"""Frames and shaded points: arguments are checked here, the work is the extension's."""

import warnings
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish._device import default_device
from burnish.filters import FILTERS
from burnish.filters import Filter as Filter
from burnish.frame import Frame
from burnish.report import Report
from burnish.samplers import Sampler

Output: TypeAlias = Literal["linear", "display"]
FloatArray: TypeAlias = NDArray[np.float32]
PlaceArray: TypeAlias = NDArray[np.float32] | NDArray[np.float64]
Progress: TypeAlias = Callable[[float, str], None]

LARGEST_EDGE_PX = 16384
LARGEST_EXPOSURE = 64.0


def require_filter(filter: str) -> None:
    """Raise ValueError unless the name is one of `FILTERS`."""
    if filter not in FILTERS:
        raise ValueError(f"filter: expected one of {', '.join(FILTERS)}, got {filter!r}")


def _require_rows(
    array: Any, name: str, count: int | None = None, types: Sequence[type] = (np.float32,)
) -> None:
    """Raise ValueError unless the array can be handed over as it is: nothing is cast or copied silently."""
    rows = "n" if count is None else str(count)
    names = " or ".join(one.__name__ for one in types)
    expected = f"{name}: expected C-contiguous {names} of shape ({rows}, 3), got "
    if not isinstance(array, np.ndarray):
        raise ValueError(f"{expected}{type(array).__name__}")
    if array.ndim != 2 or array.shape[1] != 3 or (count is not None and len(array) != count):
        raise ValueError(f"{expected}shape {array.shape}")
    if array.dtype not in types or not array.flags.c_contiguous:
        layout = "" if array.flags.c_contiguous else "non-contiguous "
        raise ValueError(f"{expected}{layout}{array.dtype} of shape {array.shape}")
    if not np.isfinite(array).all():
        row = int(np.argwhere(~np.isfinite(array).all(axis=1))[0, 0])
        raise ValueError(f"{name}: expected finite numbers, got {array[row].tolist()} in row {row}")


@overload
def shade(
    env: _core.Environment,
    material: _core.Material,
    sampler: Sampler,
    normals: FloatArray,
    tangents: FloatArray,
    views: FloatArray,
    filter: Filter = ...,
    device: _core.Device | None = ...,
    strict: bool = ...,
    report: Literal[False] = ...,
    positions: PlaceArray | None = ...,
    scene: _core.Scene | None = ...,
) -> FloatArray: ...


@overload
def shade(
    env: _core.Environment,
    material: _core.Material,
    sampler: Sampler,
    normals: FloatArray,
    tangents: FloatArray,
    views: FloatArray,
    filter: Filter = ...,
    device: _core.Device | None = ...,
    strict: bool = ...,
    *,
    report: Literal[True],
    positions: PlaceArray | None = ...,
    scene: _core.Scene | None = ...,
) -> tuple[FloatArray, Report]: ...


def shade(
    env: _core.Environment,
    material: _core.Material,
    sampler: Sampler,
    normals: FloatArray,
    tangents: FloatArray,
    views: FloatArray,
    filter: Filter = "gauss6",
    device: _core.Device | None = None,
    strict: bool = False,
    report: bool = False,
    positions: PlaceArray | None = None,
    scene: _core.Scene | None = None,
) -> FloatArray | tuple[FloatArray, Report]:
    """Shade surface points with the kernel that shades pictures.

    Parameters
    ----------
    env : Environment
        Distant light.
    material : Material
        One material for all points.
    sampler : Regular, Importance, Matched, Prefiltered or Reference
        How the lobes meet the light.
    normals : (n, 3) float32
        World frame, C-contiguous, of any length but 0.
    tangents : (n, 3) float32
        Of any length. Need not be orthogonal to the normals; one along its normal, or of length 0, is
        replaced by some perpendicular one.
    views : (n, 3) float32
        From the points toward the eye, of any length but 0. A point seen from behind is black; a cosine of
        the view below 1e-4 counts as 1e-4.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the environment's pyramid.
    device : Device or None
        None: the best one, opened once.
    strict : bool
        Raise where a value was not finite, instead of a black point and a warning.
    report : bool
        Give a report back as well, as pictures have one: passes, effects, samples that were taken, and what
        would else be warned of.
    positions : (n, 3) float32 or float64, or None
        Where the points are, world frame, C-contiguous. What `scene` adds asks for them.
    scene : Scene or None
        Its direct lights light the points, beside `env`; its objects do not hide anything from them.

    Returns
    -------
    radiance : (n, 3) float32
        Linear Rec. 709, toward the eye; (0, 3) where there are no points.
    report : Report
        Only where it was asked for.

    Warns
    -----
    RuntimeWarning
        If a progressive reference stopped short of its standard error, or values were not finite, and no
        report was asked for.

    Raises
    ------
    ValueError
        If an array has another type, shape or layout, or holds a number that is not finite.
    FloatingPointError
        If `strict` and a value was not finite; it says how many, where, and in which pass.
    VulkanError
        If no device can do it.
    """
    require_filter(filter)
    _require_rows(normals, "normals")
    _require_rows(tangents, "tangents", len(normals))
    _require_rows(views, "views", len(normals))
    if len(normals) == 0:
        none: FloatArray = np.zeros((0, 3), np.float32)
        return (none, Report({"filter": filter})) if report else none
    if positions is not None:
        _require_rows(positions, "positions", len(normals), (np.float32, np.float64))
    elif scene is not None and any(not isinstance(one, _core.DirectionalLight) for one in scene.lights):
        raise ValueError(
            "positions: expected an array beside a scene with lights that have a place, got None"
        )
    points = (normals, tangents, views)
    radiance, problems, data = _core.shade(
        device or default_device(), env, material, sampler, *points, filter, strict, report, positions, scene
    )
    if data is not None:
        return radiance, Report(data | {"points": len(radiance)})
    for text in problems:
        warnings.warn(text, RuntimeWarning, stacklevel=2)
    return radiance


def require_size(size: tuple[int, int]) -> tuple[int, int]:
    """Raise ValueError unless it is (height, width) within what is rendered; give it as two integers."""
    try:
        height, width = (int(edge) for edge in size)
        fits = (height, width) == tuple(size)
    except (TypeError, ValueError, OverflowError):
        fits = False
    if not fits or not (1 <= height <= LARGEST_EDGE_PX and 1 <= width <= LARGEST_EDGE_PX):
        raise ValueError(f"size: expected (height, width), integers in 1..{LARGEST_EDGE_PX}, got {size!r}")
    return height, width


def require_spp(spp: int) -> None:
    """Raise ValueError unless it is a number of frames that can be accumulated."""
    if isinstance(spp, bool) or not isinstance(spp, int | np.integer) or not 1 <= spp <= 65536:
        raise ValueError(f"spp: expected an integer in 1..65536, got {spp!r}")


def _stops(output: Output, display_exposure: float) -> float | None:
    """Exposure of 8-bit output; None where linear radiance is wanted."""
    if output not in ("linear", "display"):
        raise ValueError(f"output: expected one of linear, display, got {output!r}")
    try:
        stops = float(display_exposure)
    except (TypeError, ValueError):
        stops = float("nan")
    if not -LARGEST_EXPOSURE <= stops <= LARGEST_EXPOSURE:
        limit = f"{-LARGEST_EXPOSURE:g}..{LARGEST_EXPOSURE:g}"
        raise ValueError(f"display_exposure: expected a number in {limit}, got {display_exposure!r}")
    if output == "linear" and stops != 0.0:
        raise ValueError(f"display_exposure: expected 0 beside linear output, got {display_exposure!r}")
    return stops if output == "display" else None


def draw(
    scene: _core.Scene,
    camera: _core.Camera | None = None,
    size: tuple[int, int] = (540, 960),
    sampler: Sampler | None = None,
    device: _core.Device | None = None,
    spp: int = 1,
    filter: Filter = "gauss6",
    progress: Progress | None = None,
    strict: bool = False,
    output: Output = "linear",
    display_exposure: float = 0.0,
) -> Frame:
    """Draw one frame with a given sampler, as `burnish.render`, which documents the parameters, does.

    Returns
    -------
    frame : Frame
        Linear radiance and coverage, or pixels for a display; depth, normals and the report.
    """
    require_filter(filter)
    height, width = require_size(size)
    require_spp(spp)
    stops = _stops(output, display_exposure)
    sampler = _core.Matched() if sampler is None else sampler
    camera = view_of(scene, camera)
    device = device or default_device()
    data = _core.render(
        device, scene, camera, height, width, sampler, int(spp), filter, progress, strict, stops
    )
    surface = (lambda: data.depth, lambda: data.normal, Report(dict(data.report)))
    kept: dict[str, Any] = {"camera": camera, "position": lambda: data.position}
    if stops is not None:
        return Frame(None, None, *surface, display=data.display, **kept)
    return Frame(data.color, data.alpha, *surface, **kept)


def view_of(scene: _core.Scene, camera: _core.Camera | None) -> _core.Camera:
    """Give a camera, or the scene's first where there is none, or one that sees all of it."""
    if camera is None:
        return scene.cameras[0] if scene.cameras else scene.default_camera()
    return camera


def plan(
    scene: _core.Scene,
    sampler: Sampler | None = None,
    spp: int = 1,
    filter: Filter = "gauss6",
    is_software: bool = True,
    output: Output = "linear",
    device: _core.Device | None = None,
) -> dict[str, Any]:
    """Say what rendering a scene would do, without drawing it.

    Parameters
    ----------
    scene : Scene
        As `render` takes it.
    sampler : Regular, Importance, Matched, Prefiltered, Reference or None
        None: ``Matched()``.
    spp : int
        Jittered frames that would be accumulated.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the pyramid.
    is_software : bool
        Whether the device would be a CPU, where there is no `device`.
    output : "linear" or "display"
        As `render` takes it.
    device : Device or None
        The device that would draw: it knows how it reads maps. None: one without limits, whose lookups nobody
        measured.

    Returns
    -------
    plan : dict
        ``passes`` and ``effects`` with a reason each, ``classes`` of pipelines, ``warnings``.
    """
    require_filter(filter)
    require_spp(spp)
    sampler = _core.Matched() if sampler is None else sampler
    return _core.plan(scene, sampler, int(spp), filter, is_software, _stops(output, 0.0), device)

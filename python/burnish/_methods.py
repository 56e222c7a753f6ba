"""Methods that the extension's classes get from Python: they read files, or need the default device."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish._device import default_device
from burnish.environment_io import environment_from_file
from burnish.rendering import Filter, require_filter

FloatArray = NDArray[np.float32]


def pyramid(
    self: _core.Environment, filter: Filter = "gauss6", device: _core.Device | None = None
) -> list[FloatArray]:
    """Build the pyramid of prefiltered levels as the device uses it.

    Parameters
    ----------
    filter : "box", "gauss4" or "gauss6"
        Reduction filter from level to level; its taps cross the edges of faces.
    device : Device or None
        None: the best one, opened once.

    Returns
    -------
    levels : list of (6, n, n, 3) float32
        Level 0 first, half precision values, down to n = 1.
    """
    require_filter(filter)
    return _core.environment_pyramid(device or default_device(), self, filter)


def prefiltered(
    self: _core.Environment, filter: Filter = "gauss6", device: _core.Device | None = None
) -> list[tuple[float, FloatArray]]:
    """Build the prefiltered map that the sampler `Prefiltered` looks up.

    Parameters
    ----------
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the pyramid it is made from.
    device : Device or None
        None: the best one, opened once.

    Returns
    -------
    levels : list of (roughness, (6, n, n, 3) float32)
        Level 0, the map itself, has roughness 0. Every other level holds the map as a round lobe of that
        slope, 3/n, sees it along its normal: r0 = 1, alpha = 0, divided by the lobe's albedo.
    """
    require_filter(filter)
    return _core.environment_prefiltered(device or default_device(), self, filter)


def _object_index(scene: _core.Scene, key: str | int) -> int:
    names = [one.name for one in scene.objects]
    if isinstance(key, str):
        scene.find_object(key)  # raises ValueError that lists the names
        return names.index(key)
    if not 0 <= key < len(names):
        raise ValueError(f"object: expected a name or an index below {len(names)}, got {key!r}")
    return key


def _centroid(scene: _core.Scene, index: int) -> NDArray[np.float64]:
    """Centroid of an object's surface in the world; the middle of its box where it has no area."""
    one = scene.objects[index]
    mesh, matrix = scene.meshes[one.mesh], one.world_from_object.astype(np.float64)
    corners = (mesh.positions @ matrix[:3, :3].T + matrix[:3, 3])[mesh.indices]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    if not areas.sum() > 0:
        return np.asarray(np.mean(one.bounds(), axis=0))
    return np.asarray(np.average(corners.mean(axis=1), axis=0, weights=areas))


def capture(
    self: _core.Scene,
    point: Sequence[float] | None = None,
    object: str | int | None = None,
    face_size: int = 256,
    device: _core.Device | None = None,
) -> _core.Environment:
    """Render the surroundings of a point, or of an object, into an environment.

    Parameters
    ----------
    point : (x, y, z) or None
        World coordinates of the point. None: the centroid of the object's surface.
    object : str, int or None
        Name or index of the object that is left out. One of `point` and `object` must be given.
    face_size : int
        Texels along the edge of a face, a power of two in 1..2048.
    device : Device or None
        None: the best one, opened once.

    Returns
    -------
    environment : Environment
        Diffuse and emitted light of the other objects, and the scene's own environment behind them.

    Raises
    ------
    ValueError
        If neither `point` nor `object` is given, or there is no such object.
    """
    index = None if object is None else _object_index(self, object)
    if point is not None:
        center = np.asarray(point, np.float64)
    elif index is not None:
        center = _centroid(self, index)
    else:
        raise ValueError("capture: expected a point, an object, or both, got neither")
    if center.shape != (3,) or not np.isfinite(center).all():
        raise ValueError(f"point: expected three finite numbers, got {point!r}")
    x, y, z = (float(value) for value in center)
    return _core.capture(device or default_device(), self, (x, y, z), face_size, index)


def attach() -> None:
    """Add the methods to `Environment` and `Scene`; the stub declares them there."""
    for owner, name, function in (
        (_core.Environment, "from_file", staticmethod(environment_from_file)),
        (_core.Environment, "pyramid", pyramid),
        (_core.Environment, "prefiltered", prefiltered),
        (_core.Scene, "capture", capture),
    ):
        setattr(owner, name, function)

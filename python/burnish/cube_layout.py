"""Cube maps laid out in one picture, and cube maps of another size."""

import numpy as np
from numpy.typing import NDArray

Float64 = NDArray[np.float64]
Float32 = NDArray[np.float32]

# Where the faces +X -X +Y -Y +Z -Z stand in an unfolded cube, (row, column) in faces; -Z hangs upside down in
# a vertical one.
_HORIZONTAL_CROSS = ((1, 2), (1, 0), (0, 1), (2, 1), (1, 1), (1, 3))
_VERTICAL_CROSS = ((1, 2), (1, 0), (0, 1), (2, 1), (1, 1), (3, 1))

# OpenEXR draws the faces as mirror images of Vulkan's: those of +-Y upside down, the others left to right.
# For +X, say, its columns run along +z and its rows along -y (ImfEnvmap, pixelPosition); ours run along -z
# and -y.
_OPENEXR_FLIPS = (2, 2, 1, 1, 2, 2)


def faces_from_vertical_strip(pixels: Float32) -> Float32:
    """Cut (6 n, n, c) into (6, n, n, c), faces in Vulkan's order and orientation."""
    return pixels.reshape(6, pixels.shape[1], *pixels.shape[1:])


def faces_from_horizontal_strip(pixels: Float32) -> Float32:
    """Cut (n, 6 n, c) into (6, n, n, c), faces in Vulkan's order and orientation."""
    return np.stack(np.split(pixels, 6, axis=1))


def faces_from_cross(pixels: Float32) -> Float32:
    """Cut (3 n, 4 n, c) or (4 n, 3 n, c) into (6, n, n, c).

    +Z is in the middle column with +Y above and -Y below, -X to its left and +X to its right; -Z is at the
    far right of a horizontal cross, and at the foot of a vertical one, there turned by 180 degrees. Faces are
    as in Vulkan.
    """
    is_vertical = pixels.shape[0] > pixels.shape[1]
    size = min(pixels.shape[:2]) // 3
    cells = _VERTICAL_CROSS if is_vertical else _HORIZONTAL_CROSS
    faces = np.stack([pixels[r * size : (r + 1) * size, c * size : (c + 1) * size] for r, c in cells])
    if is_vertical:
        faces[5] = faces[5, ::-1, ::-1]
    return faces


def faces_from_openexr_cube(pixels: Float32) -> Float32:
    """Cut OpenEXR's cube layout, (6 n, n, c), into Vulkan's faces, (6, n, n, c)."""
    size = pixels.shape[1]
    faces = pixels[: 6 * size].reshape(6, size, *pixels.shape[1:])
    return np.stack([np.flip(face, axis - 1) for face, axis in zip(faces, _OPENEXR_FLIPS, strict=True)])


def _corner_solid_angle(u: Float64, v: Float64) -> Float64:
    """Solid angle of the rectangle from (0, 0) to (u, v) of a face."""
    return np.arctan2(u * v, np.sqrt(1.0 + u * u + v * v))


def _cell_solid_angles(edges: Float64) -> Float64:
    """Solid angles of the cells between grid lines that are the same in u and v."""
    return np.diff(np.diff(_corner_solid_angle(edges[None, :], edges[:, None]), axis=0), axis=1)


def cube_solid_angles(size: int) -> Float64:
    """Solid angle of each texel of one face, (size, size)."""
    return _cell_solid_angles(np.linspace(-1.0, 1.0, size + 1))


def resample_faces(faces: Float32, size: int) -> Float32:
    """Give cube faces another size by exact area: each new texel is the mean radiance over its solid angle.

    Parameters
    ----------
    faces : (6, n, n, c) float32
        Constant inside each texel.
    size : int
        The new edge.

    Returns
    -------
    faces : (6, size, size, c) float32
    """
    given = faces.shape[1]
    if given == size:
        return faces
    # Cut both grids by each other, in units of 1 / (given * size) so that lines which coincide are equal.
    lines = np.union1d(np.arange(given + 1) * size, np.arange(size + 1) * given)
    cells = _cell_solid_angles(2.0 * lines / (given * size) - 1.0)
    source = lines[:-1] // size
    starts = np.searchsorted(lines, np.arange(size) * given)
    weights = np.add.reduceat(np.add.reduceat(cells, starts, axis=0), starts, axis=1)
    resampled = np.empty((6, size, size, faces.shape[3]), np.float32)
    for face in range(6):
        for channel in range(faces.shape[3]):
            energy = faces[face, :, :, channel][np.ix_(source, source)] * cells
            sums = np.add.reduceat(np.add.reduceat(energy, starts, axis=0), starts, axis=1)
            resampled[face, :, :, channel] = sums / weights
    return resampled

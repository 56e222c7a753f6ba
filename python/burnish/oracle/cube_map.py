"""Cube maps in Vulkan's convention: directions, solid angles, and seamless trilinear lookups."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from .arrays import Array, IntArray, as_array, normalize

# Rows: the axis through the face's middle, and the directions in which u and v grow.
FACE_AXES = np.array(
    [
        [[1, 0, 0], [0, 0, -1], [0, -1, 0]],
        [[-1, 0, 0], [0, 0, 1], [0, -1, 0]],
        [[0, 1, 0], [1, 0, 0], [0, 0, 1]],
        [[0, -1, 0], [1, 0, 0], [0, 0, -1]],
        [[0, 0, 1], [1, 0, 0], [0, -1, 0]],
        [[0, 0, -1], [-1, 0, 0], [0, -1, 0]],
    ],
    dtype=np.float64,
)


def cube_direction(face: npt.ArrayLike, u: npt.ArrayLike, v: npt.ArrayLike) -> Array:
    """Unit direction through (u, v) in [-1, 1]^2 of a face."""
    axes = FACE_AXES[np.asarray(face)]
    u, v = as_array(u)[..., None], as_array(v)[..., None]
    return normalize(axes[..., 0, :] + u * axes[..., 1, :] + v * axes[..., 2, :])


def cube_face_uv(d: npt.ArrayLike) -> tuple[IntArray, Array, Array]:
    """Face that a direction of any length meets, and its (u, v) there. Of equal components z wins, then y."""
    d = as_array(d)
    size = np.abs(d)
    x, y, z = np.moveaxis(size, -1, 0)
    axis = np.where(z >= np.maximum(x, y), 2, np.where(y >= x, 1, 0))
    major = np.take_along_axis(d, axis[..., None], axis=-1)[..., 0]
    face = 2 * axis + (major < 0)
    scaled = d / np.abs(major)[..., None]
    axes = FACE_AXES[face]
    u: Array = np.sum(scaled * axes[..., 1, :], axis=-1)
    v: Array = np.sum(scaled * axes[..., 2, :], axis=-1)
    return face, u, v


def texel_centers(face_size: int) -> Array:
    """Coordinates of texel centres along one face axis: (2 k + 1)/N - 1."""
    centers: Array = (2 * np.arange(face_size) + 1) / face_size - 1
    return centers


def texel_directions(face_size: int) -> Array:
    """Unit directions of all texel centres, (6, N, N, 3)."""
    centers = texel_centers(face_size)
    return cube_direction(np.arange(6)[:, None, None], centers[None, None, :], centers[None, :, None])


def texel_solid_angle(face_size: int) -> Array:
    """Exact solid angles of one face's texels, (N, N) steradian; six faces sum to 4 pi.

    The part of a face between its middle and (x, y) subtends atan(x y / sqrt(x^2 + y^2 + 1)).
    """
    edges = 2 * np.arange(face_size + 1) / face_size - 1
    x, y = edges[None, :], edges[:, None]
    corner = np.arctan2(x * y, np.sqrt(x * x + y * y + 1))
    angles: Array = np.diff(np.diff(corner, axis=0), axis=1)
    return angles


def cube_stretch(d: npt.ArrayLike) -> Array:
    """Return r = |d| / |d|_inf: a level-0 texel met by `d` subtends 4/(face_texels r^3) steradian."""
    d = as_array(d)
    stretch: Array = np.linalg.norm(d, axis=-1) / np.max(np.abs(d), axis=-1)
    return stretch


@lru_cache(maxsize=32)
def border_indices(face_size: int, border: int) -> tuple[IntArray, IntArray]:
    """Where the texels of faces with a border of `border` texels around them come from.

    A tap beyond one edge reads the neighbouring face, folded over the edge: as deep inside it as the tap is
    outside, at the same place along the edge. A tap beyond two edges has two such folds,
    over the one edge or the other first.

    Returns
    -------
    first, second : (6, N + 2 border, N + 2 border)
        Indices into the flat (6 N N) texels; they differ only in the corner blocks.
    """
    at = (2 * np.arange(-border, face_size + border) + 1) / face_size - 1
    u, v = at[None, None, :, None], at[None, :, None, None]
    axes = FACE_AXES[:, None, None]
    outside_u, outside_v = np.maximum(np.abs(u) - 1, 0), np.maximum(np.abs(v) - 1, 0)
    side_u, side_v = np.sign(u) * axes[..., 1, :], np.sign(v) * axes[..., 2, :]
    inside_u, inside_v = np.minimum(np.abs(u), 1), np.minimum(np.abs(v), 1)
    # Over one edge the fold takes what is outside off the face's axis. Over v and then u it ends on the
    # face of side_u, where it takes outside_u off side_v; the other way round likewise.
    beyond_both = (outside_u > 0) & (outside_v > 0)
    lost = np.where(beyond_both, outside_v, outside_u + outside_v)
    first = (1 - lost) * axes[..., 0, :] + inside_u * side_u + (inside_v - beyond_both * outside_u) * side_v
    lost = np.where(beyond_both, outside_u, outside_u + outside_v)
    second = (1 - lost) * axes[..., 0, :] + (inside_u - beyond_both * outside_v) * side_u + inside_v * side_v
    return _texel_index(first, face_size), _texel_index(second, face_size)


def _texel_index(points: Array, face_size: int) -> IntArray:
    face, u, v = cube_face_uv(points)
    column = np.clip(np.floor((u + 1) / 2 * face_size), 0, face_size - 1)
    row = np.clip(np.floor((v + 1) / 2 * face_size), 0, face_size - 1)
    index: IntArray = (face * face_size * face_size + row * face_size + column).astype(np.int64)
    return index


def add_border(level: npt.ArrayLike, border: int) -> Array:
    """Faces (6, N, N, c) with `border` texels of their neighbours around them; corners mean both folds."""
    level = as_array(level)
    first, second = border_indices(level.shape[1], border)
    flat = level.reshape(-1, level.shape[-1])
    return 0.5 * (flat[first] + flat[second])


@dataclass(frozen=True)
class PaddedCube:
    """All levels of a cube map with a border of one texel, in one flat array: what `sample_cube` reads."""

    texels: Array
    offsets: IntArray
    sizes: IntArray

    @property
    def face_texels(self) -> int:
        """Level-0 texels of one face."""
        return int(self.sizes[0]) ** 2

    @property
    def last_level(self) -> int:
        """Index of the coarsest level."""
        return len(self.sizes) - 1


def pad_cube(levels: "PaddedCube | Sequence[npt.ArrayLike]") -> PaddedCube:
    """Prepare the levels of a cube map, a list of (6, n, n, 3), for many lookups.

    Where three faces meet there is no fourth texel: as in Mesa, the mean of the three stands for it.
    """
    if isinstance(levels, PaddedCube):
        return levels
    padded = []
    for level in map(as_array, levels):
        faces = add_border(level, 1)
        for row, column in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
            own = level[:, row, column]
            faces[:, row, column] = (2 * faces[:, row, column] + own) / 3
        padded.append(faces.reshape(-1, faces.shape[-1]))
    sizes = np.array([as_array(level).shape[1] for level in levels])
    offsets = np.concatenate([[0], np.cumsum([len(p) for p in padded])[:-1]])
    return PaddedCube(np.concatenate(padded), offsets, sizes)


def sample_cube(
    levels: PaddedCube | Sequence[npt.ArrayLike], directions: npt.ArrayLike, lod: npt.ArrayLike = 0.0
) -> Array:
    """Seamless trilinear lookup, as a sampler with linear filters and a linear mip map mode does it.

    Parameters
    ----------
    levels : list of (6, n, n, 3), finest first, or a `PaddedCube`
    directions : (..., 3), any length but zero
    lod : broadcasts with directions' leading shape
        Clamped to the levels there are.

    Returns
    -------
    radiance : (..., 3)
    """
    cube = pad_cube(levels)
    directions = as_array(directions)
    face, u, v = cube_face_uv(directions)
    lod = np.broadcast_to(np.clip(as_array(lod), 0, cube.last_level), face.shape)
    fine = np.floor(lod).astype(np.int64)
    coarse = np.minimum(fine + 1, cube.last_level)
    share = (lod - fine)[..., None]
    result: Array = (1 - share) * _bilinear(cube, fine, face, u, v) + share * _bilinear(
        cube, coarse, face, u, v
    )
    return result


def _bilinear(cube: PaddedCube, level: IntArray, face: IntArray, u: Array, v: Array) -> Array:
    size = cube.sizes[level]
    x, y = (u + 1) / 2 * size + 0.5, (v + 1) / 2 * size + 0.5  # texel k lies at k + 1, behind the border
    column = np.clip(np.floor(x).astype(np.int64), 0, size)
    row = np.clip(np.floor(y).astype(np.int64), 0, size)
    fx, fy = (x - column)[..., None], (y - row)[..., None]
    pitch = size + 2
    corner = cube.offsets[level] + (face * pitch + row) * pitch + column
    top = (1 - fx) * cube.texels[corner] + fx * cube.texels[corner + 1]
    bottom = (1 - fx) * cube.texels[corner + pitch] + fx * cube.texels[corner + pitch + 1]
    result: Array = (1 - fy) * top + fy * bottom
    return result

"""Light and surface points of the hard cases, small and the same in every run."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burnish.environments import cube_directions, spots

Float32 = NDArray[np.float32]
Points = tuple[Float32, Float32, Float32]

HALF_MAX = 65504.0
AXES = np.concatenate([np.eye(3), -np.eye(3)])


def float32(array: ArrayLike) -> Float32:
    """Return an array as `burnish.shade` takes it."""
    return np.ascontiguousarray(array, np.float32)


def unit(vectors: ArrayLike) -> NDArray[np.float64]:
    """Return vectors of length 1."""
    vectors = np.asarray(vectors, np.float64)
    result: NDArray[np.float64] = vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)
    return result


# --- points


def around(count: int = 48, least_cos: float = 0.05, seed: int = 7) -> Points:
    """Random frames seen from in front."""
    rng = np.random.default_rng(seed)
    normals, tangents, views = (unit(rng.standard_normal((8 * count, 3))) for _ in range(3))
    views *= np.where(np.sum(normals * views, axis=-1, keepdims=True) < 0, -1, 1)
    seen = np.flatnonzero(np.sum(normals * views, axis=-1) > least_cos)[:count]
    return float32(normals[seen]), float32(tangents[seen]), float32(views[seen])


def seen_at(cosines: Sequence[float], azimuths: int = 5) -> Points:
    """Frames along the axes, so that float32 holds even tiny cosines of the view exactly."""
    angle = 0.1 + 2 * np.pi * np.arange(azimuths) / azimuths
    rows = []
    for k, normal in enumerate(AXES):
        tangent = AXES[(k + 1) % 3]
        bitangent = np.cross(normal, tangent)
        for cosine in cosines:
            sine = np.sqrt(1 - cosine * cosine)
            for phi in angle:
                view = cosine * normal + sine * (np.cos(phi) * tangent + np.sin(phi) * bitangent)
                rows.append((normal, tangent, view))
    normals, tangents, views = (float32(column) for column in zip(*rows, strict=True))
    return normals, tangents, views


def from_above(count: int = 48) -> Points:
    """Views that are the normals, whose products with them round to either side of 1."""
    normals, tangents, _ = around(count)
    return normals, tangents, normals


def mirroring(directions: ArrayLike) -> Points:
    """Points that mirror the view exactly into the directions, seen at 1/3, 2/3 and all of the way up."""
    rows = []
    for direction in unit(directions):
        side = unit(np.cross(direction, AXES[np.argmin(np.abs(direction))]))
        for tilt in (0.0, 0.4, 1.0):
            normal = unit(direction + tilt * side)
            rows.append((normal, side, 2 * (normal @ direction) * normal - direction))
    normals, tangents, views = (float32(column) for column in zip(*rows, strict=True))
    return normals, tangents, views


def with_tangents(points: Points, tangents: ArrayLike) -> Points:
    """The same points with other tangents."""
    return points[0], float32(np.broadcast_to(tangents, points[0].shape)), points[2]


def turned(points: Points, rotation: ArrayLike) -> Points:
    """All vectors of the points multiplied by a matrix."""
    matrix = np.asarray(rotation, np.float64)
    normals, tangents, views = (float32(p @ matrix.T) for p in points)
    return normals, tangents, views


EDGES = np.array([d for d in np.ndindex(3, 3, 3) if np.sum(np.array(d) != 1) == 2]) - 1.0
CORNERS = np.array([d for d in np.ndindex(3, 3, 3) if np.sum(np.array(d) != 1) == 3]) - 1.0


# --- light: faces (6, n, n, 3)


def smooth(face_size: int = 32, seed: int = 3) -> Float32:
    """Radiance without edges, 0.2 to 5, different along every axis."""
    rng = np.random.default_rng(seed)
    d = cube_directions(face_size)
    waves = sum(np.sin(2 * (d @ rng.standard_normal((3, 3))) + rng.uniform(0, 6, 3)) for _ in range(3))
    return float32(np.exp(0.5 * waves))


def constant(radiance: float, face_size: int = 32) -> Float32:
    """The same radiance from everywhere; of the size of other maps, for which kernels are compiled."""
    return np.full((6, face_size, face_size, 3), radiance, np.float32)


def one_texel(radiance: float, background: float = 0.0, face_size: int = 32) -> Float32:
    """A map that is dark but for one texel beside the corner of a face."""
    faces = constant(background, face_size)
    faces[4, 1, 1] = radiance
    return faces


def spoilt(value: float) -> Float32:
    """Smooth light in which one texel has a value that no light has."""
    faces = smooth()
    faces[2, 5, 6, 1] = value
    return faces


SUN = np.array([0.3, 0.8, 0.5])


def sunny(face_size: int = 128) -> Float32:
    """Smooth light and a sun of half a degree's radius, 60000 times as bright."""
    faces = smooth(face_size)
    faces[cube_directions(face_size) @ unit(SUN) > np.cos(np.radians(0.5))] = (6e4, 5.6e4, 4e4)
    return faces


def noise(face_size: int) -> Float32:
    """Texels that know nothing of their neighbours."""
    return float32(np.exp(np.random.default_rng(9).normal(0, 1, (6, face_size, face_size, 3))))


LIGHTS: dict[str, Callable[[], Float32]] = {
    "smooth": smooth,
    "spots": lambda: spots(face_size=32).faces,
    "uniform": lambda: constant(1.0),
    "black": lambda: constant(0.0),
    "one texel": lambda: one_texel(HALF_MAX),
    "sun": lambda: np.maximum(smooth(), one_texel(1e7)),
    "sun of half a degree": sunny,
    "NaN": lambda: spoilt(np.nan),
    "infinite": lambda: spoilt(np.inf),
    "negative": lambda: spoilt(-5.0),
    "brightest": lambda: constant(HALF_MAX),
    "faintest": lambda: constant(2.0**-24),
    "faint": lambda: float32(smooth() * 2.0**-16),
    "faces of 1": lambda: noise(1),
    "faces of 2": lambda: noise(2),
    "noise": lambda: noise(32),
}

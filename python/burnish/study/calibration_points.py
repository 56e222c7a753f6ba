"""Points for calibration: they see all of a map under one angle, and its bright parts more often.

Of a map with a sun the relative RMSE is decided by the few points that reflect the sun. Points are therefore
drawn by a mixture: a part evenly over the sphere, parts in proportion to the squared radiance of the map at
the lobe's width and wider; weights undo it.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.cube_layout import cube_solid_angles, resample_faces
from burnish.environments import cube_directions

Float64 = NDArray[np.float64]
Float32 = NDArray[np.float32]


@dataclass(frozen=True)
class WeightedPoints:
    """Points as `burnish.shade` takes them, with weights.

    Parameters
    ----------
    normals, tangents, views : (n, 3) float32
        World frame.
    weights : (n,) float64
        Each point's share of an even distribution over the reflected directions; mean about 1.
    """

    normals: Float32
    tangents: Float32
    views: Float32
    weights: Float64

    def relative_rmse(self, color: Float32, truth: Float32) -> float:
        """Estimate the relative RMSE over the sphere.

        Parameters
        ----------
        color, truth : (n, 3) float32
            Radiance of the points.
        """
        exact = truth.astype(np.float64)
        squares = np.sum((color - exact) ** 2, axis=1) @ self.weights
        return math.sqrt(squares / (np.sum(exact**2, axis=1) @ self.weights))


def _bright_shares(environment: _core.Environment, face_size: int) -> Float64:
    """Share of the squared radiance that each texel of a reduced map has, (6, n, n)."""
    faces = resample_faces(environment.faces, face_size).astype(np.float64)
    energy = np.sum(faces**2, axis=-1) * cube_solid_angles(face_size)
    return np.asarray(energy / energy.sum())


def _unit(vectors: Float64) -> Float64:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def points_at_angle(
    environment: _core.Environment,
    width: float,
    cosine: float | Float64,
    count: int,
    rng: np.random.Generator,
) -> WeightedPoints:
    """Draw points that are seen under one angle, or each under its own.

    Parameters
    ----------
    environment : Environment
        Whose bright parts are reflected more often.
    width : float
        The lobe's deviation on the sphere, radians.
    cosine : float or (count,) float64
        Of the angle between normal and view.
    count : int
        How many.
    rng : Generator
        Source of randomness.
    """
    finest = 32
    sizes = [min(finest, max(1, 2 ** math.floor(math.log2(1.0 / width)) // scale)) for scale in (1, 2, 4)]
    shares = [np.full((6, finest, finest), 1.0) * cube_solid_angles(finest) / (4 * math.pi)]
    for size in sizes:
        even = np.broadcast_to(cube_solid_angles(size) / (4 * math.pi), (6, size, size))
        density = (
            (_bright_shares(environment, size) / even).repeat(finest // size, 1).repeat(finest // size, 2)
        )
        shares.append(density * shares[0])
    mixture = np.mean(shares, axis=0).ravel()
    chosen = rng.choice(mixture.size, count, p=mixture / mixture.sum())
    weights = shares[0].ravel()[chosen] / mixture[chosen]
    centers = cube_directions(finest).reshape(-1, 3)[chosen]
    mirror = _unit(centers + rng.uniform(-1.0, 1.0, (count, 3)) / finest)
    # The view lies at twice the angle from the mirror direction, anywhere around it; the normal is half-way.
    around = _unit(np.cross(mirror, _unit(rng.standard_normal((count, 3)))))
    cosines = np.broadcast_to(np.asarray(cosine, np.float64), count)[:, None]
    normals = _unit(mirror * cosines + around * np.sqrt(1.0 - cosines**2))
    views = _unit(2.0 * np.sum(mirror * normals, axis=1, keepdims=True) * normals - mirror)
    tangents = _unit(np.cross(normals, _unit(rng.standard_normal((count, 3)))))
    n, t, v = (np.ascontiguousarray(array, np.float32) for array in (normals, tangents, views))
    return WeightedPoints(n, t, v, weights)

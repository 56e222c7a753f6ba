"""Environments made by code, for machines without files and for measurements."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burnish._core import Environment
from burnish.cube_layout import cube_solid_angles

Float64 = NDArray[np.float64]


def cube_directions(face_size: int) -> Float64:
    """Unit directions through the texel centres of a cube.

    Returns
    -------
    directions : (6, n, n, 3) float64, n = face_size
    """
    centers = (2.0 * np.arange(face_size) + 1.0) / face_size - 1.0
    u, v = np.meshgrid(centers, centers)
    one = np.ones_like(u)
    faces = [(one, -v, -u), (-one, -v, u), (u, one, v), (u, -one, -v), (u, -v, one), (-u, -v, -one)]
    directions = np.stack([np.stack(face, axis=-1) for face in faces])
    unit: Float64 = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    return unit


def _finish(radiance: NDArray[np.floating], name: str) -> Environment:
    environment = Environment.from_faces(np.ascontiguousarray(radiance, np.float32))
    environment.name = name
    return environment


def _unit(direction: ArrayLike, name: str) -> Float64:
    vector = np.asarray(direction, np.float64)
    length = float(np.linalg.norm(vector)) if vector.shape == (3,) else 0.0
    if not (math.isfinite(length) and length > 0.0):
        raise ValueError(f"{name}: expected three finite numbers, not all 0, got {direction!r}")
    return vector / length


def _disc_coverage(directions: Float64, center: Float64, radius: float, face_size: int) -> Float64:
    """Share of each texel inside a disc of that angular radius: a ramp one texel wide across its edge."""
    # The chord keeps its precision where the arc cosine of the dot product has none.
    angle = 2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(directions - center, axis=-1), 0.0, 1.0))
    # A texel is 2/N wide on a face at distance 1; toward the corners it shrinks by r = |w|/|w|_inf, one way
    # by r, one by r^2.
    width = 2.0 / face_size * np.max(np.abs(directions), axis=-1) ** 1.5
    coverage: Float64 = np.clip((radius - angle) / width + 0.5, 0.0, 1.0)
    return coverage


def _smooth_step(low: float, high: float, value: Float64) -> Float64:
    t = np.clip((value - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def uniform(radiance: ArrayLike = 1.0, face_size: int = 1) -> Environment:
    """The same radiance from everywhere: a furnace.

    Parameters
    ----------
    radiance : float or three floats
        Linear RGB.
    face_size : int
        A power of two in 1..2048.
    """
    color = np.broadcast_to(np.asarray(radiance, np.float32), (6, face_size, face_size, 3))
    return _finish(color, "uniform")


def sky(
    sun_direction: ArrayLike = (0.5, 0.6, 0.62),
    sun_radiance: float = 20000.0,
    sun_diameter: float = 0.53,
    face_size: int = 256,
) -> Environment:
    """A clear sky over grey ground, with a sun.

    Parameters
    ----------
    sun_direction : three floats
        Toward the sun, y up; any length.
    sun_radiance : float
        Radiance of the disc; the sky overhead has about 0.6.
    sun_diameter : float
        Degrees. A disc narrower than two texels is drawn two texels wide and dimmer, of equal energy.
    face_size : int
        A power of two in 1..2048.
    """
    toward_sun = _unit(sun_direction, "sun_direction")
    directions = cube_directions(face_size)
    up = directions[..., 1]
    cos_sun = directions @ toward_sun
    height = np.clip(up, 0.0, 1.0)[..., None]
    zenith, horizon = np.array([0.16, 0.33, 0.75]), np.array([0.75, 0.85, 1.0])
    above = zenith + (horizon - zenith) * (1.0 - height) ** 4
    glow = np.exp(6.0 * (cos_sun - 1.0)) * 0.5 + np.exp(150.0 * (cos_sun - 1.0)) * 3.0
    above = above + glow[..., None] * np.array([1.0, 0.85, 0.6])
    ground = (
        np.array([0.22, 0.19, 0.16]) * (0.4 + 0.6 * max(toward_sun[1], 0.0)) * (1.0 + 0.3 * up)[..., None]
    )
    # The horizon is as soft as a texel and a little haze.
    blend = _smooth_step(-0.01 - 2.0 / face_size, 0.01 + 2.0 / face_size, up)[..., None]
    radiance = ground + (above - ground) * blend
    radius = math.radians(0.5 * sun_diameter)
    cover = _disc_coverage(directions, toward_sun, max(radius, 2.0 / face_size), face_size)
    # The drawn disc is soft and perhaps too wide: what it holds is scaled to what the true disc would.
    drawn = float((cover * cube_solid_angles(face_size)).sum())
    sun = cover[..., None] * blend * (2.0 * math.pi * (1.0 - math.cos(radius)) / drawn)
    return _finish(radiance + sun * sun_radiance * np.array([1.0, 0.93, 0.82]), "sky")


_SOFT_BOXES = (
    # centre, up, half width and half height as tangents of angles, radiance
    ((-0.8, 0.7, 0.5), (0.0, 1.0, 0.0), (0.35, 0.55), (14.0, 13.4, 12.5)),
    ((0.9, 0.35, 0.4), (0.0, 1.0, 0.0), (0.12, 0.8), (9.0, 9.4, 10.0)),
    ((0.1, 1.0, -0.1), (0.0, 0.0, -1.0), (0.7, 0.3), (6.0, 6.0, 6.0)),
    ((0.2, 0.25, -1.0), (0.0, 1.0, 0.0), (0.9, 0.07), (20.0, 17.0, 13.0)),
)


def studio(face_size: int = 256) -> Environment:
    """Four soft boxes in a dark grey room: key, rim, top and a bright strip behind.

    Parameters
    ----------
    face_size : int
        A power of two in 1..2048.
    """
    directions = cube_directions(face_size)
    up = directions[..., 1:2]
    radiance = np.array([0.09, 0.09, 0.1]) * (1.0 + 0.5 * up) + np.array([0.02, 0.018, 0.016]) * np.clip(
        -up, 0.0, 1.0
    )
    for center, upward, (half_width, half_height), color in _SOFT_BOXES:
        forward = _unit(center, "center")
        side = _unit(np.cross(upward, forward), "side")
        depth = directions @ forward
        front = np.where(depth > 0.05, depth, 1.0)
        x = np.abs(directions @ side) / front
        y = np.abs(directions @ np.cross(forward, side)) / front
        soft = 0.03 + 2.0 / face_size
        inside = (1.0 - _smooth_step(half_width - soft, half_width, x)) * (
            1.0 - _smooth_step(half_height - soft, half_height, y)
        )
        radiance = radiance + np.where(depth > 0.05, inside, 0.0)[..., None] * np.array(color)
    return _finish(radiance, "studio")


def spots(
    seed: int = 1,
    face_size: int = 1024,
    count: int = 40,
    contrast: tuple[float, float] = (30.0, 3000.0),
) -> Environment:
    """Bright discs over a varying background: the environment that separates samplers (maths.md, section 9).

    Parameters
    ----------
    seed : int
        The same seed gives the same map at every face size.
    face_size : int
        A power of two in 1..2048.
    count : int
        Discs, of 2 to 10 degrees in diameter, anywhere on the sphere; where they overlap the brighter one
        shows.
    contrast : (low, high)
        Their radiance against the background's mean of 1, spread evenly in its logarithm.
    """
    if not (0.0 < contrast[0] <= contrast[1]):
        raise ValueError(f"contrast: expected 0 < low <= high, got {contrast}")
    generator = np.random.default_rng(seed)
    directions = cube_directions(face_size)
    # A sum of waves along random axes: smooth, positive, its mean over the sphere 1 to about a tenth.
    waves = np.zeros((*directions.shape[:3], 3))
    for frequency in (1.0, 2.0, 3.0, 5.0, 8.0):
        axis = _unit(generator.standard_normal(3), "axis")
        phase = generator.uniform(0.0, 2.0 * np.pi)
        tint = generator.uniform(0.6, 1.4, 3)
        waves += (
            0.9
            / (1.0 + frequency)
            * np.sin(frequency * np.pi * (directions @ axis) + phase)[..., None]
            * tint
        )
    background = np.exp(waves)
    background /= background.mean(axis=(0, 1, 2), keepdims=True)
    radiance = background.copy()
    for _ in range(count):
        center = _unit(generator.standard_normal(3), "center")
        radius = 0.5 * math.radians(generator.uniform(2.0, 10.0))
        level = math.exp(generator.uniform(math.log(contrast[0]), math.log(contrast[1])))
        tint = generator.uniform(0.7, 1.0, 3)
        color = level * tint / tint.mean()
        # Only texels that the disc may touch: no texel is wider than 2/N, and there are millions of others.
        near = directions @ center > math.cos(min(radius + 4.0 / face_size, math.pi))
        cover = _disc_coverage(directions[near], center, radius, face_size)[..., None]
        behind = background[near]
        radiance[near] = np.maximum(radiance[near], behind + cover * (color - behind))
    return _finish(radiance, f"spots, seed {seed}")

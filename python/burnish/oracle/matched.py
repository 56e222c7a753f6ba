"""`matched`: mixtures whose centres and lookups together have the lobe's covariance."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo, directional_albedo
from .arrays import Array, as_array, dot, reflect
from .cube_map import PaddedCube, cube_direction, cube_face_uv, pad_cube, sample_cube
from .estimator import LocalFrame, local_frame
from .footprint import planar_level
from .kurt_lobe import LobeLike, grazing_factor, schlick_fresnel, slopes
from .lobe_map import cube_metric, lobe_map, principal_axes
from .matched_table import Mixture, closest_count, load_table, mixture_at
from .pyramid import Filter, build_pyramid
from .spherical_pyramid import build_spherical_pyramid
from .sun_split import Sun, shade_suns, split_suns

MapFilter = Filter | Literal["sphere"]

#: Variance per axis of a lookup at level l of the spherical pyramid, in 4^l (2/N)^2 steradian: .75 of the
#: level and what bilinear interpolation adds, 1/6 on a face and about .1 on the sphere.
SPHERICAL_VARIANCE = 0.85
#: How far lookups of planar pyramids move toward the middle of their face, in units of their variance.
INWARD_SHIFT = 0.6
# A mean of g below this is none: the sample lies below the horizon.
_SMALL = 1e-9


@dataclass(frozen=True)
class Matched:
    """Settings of the fitted mixtures, as `burnish.Matched`."""

    samples: int = 14
    filter: MapFilter = "sphere"  # what makes the levels it reads
    split_suns: bool = True


@dataclass(frozen=True)
class Lookups:
    """What is read: directions in the map's axes (..., n, 3), levels (..., n) and weights."""

    direction: Array
    level: Array
    weight: Array  # (..., n, 3), of any scale


_CORNER = np.sqrt(1.2)
#: Points of a mean, in units of the width of a sample, and their weights: exact to the third degree. At a
#: distance of sqrt(2.4) they give wide lobes and dielectrics less error than other rules of up to nine.
MEAN_POINTS = _CORNER * np.array([[0, 0], [1, 1], [1, -1], [-1, 1], [-1, -1]])
MEAN_WEIGHTS = np.array([4, 5, 5, 5, 5]) / 24
# The variance of a sample is at least this share of what the linear map makes of it.
_LEAST_VARIANCE = 0.5


@dataclass(frozen=True)
class Means:
    """Means over each sample's Gaussian of half-vectors, local axes."""

    gains: Array  # (..., n, 3), E[g]
    direction: Array  # (..., n, 3), unit
    variance: Array  # (..., n), per axis


def sample_means(
    omega_o: Array, lobe: LobeLike, mixture: Mixture, axes: tuple[Array, Array, Array, Array], stretch: Array
) -> Means:
    """Weight, direction and width of each sample: the means over its Gaussian of half-vectors.

    With g = F cos_i^(1-alpha) cos_o^-alpha/cos_h, 0 below the horizon, G = E[g] and M = E[g omega_i]: the
    direction is M/|M|, the weight G for each channel, the variance -ln(|M|/G) with F of the channels' mean.
    The variance is at least half of the linear map's at the centre, (s b)^2 (o.h) cos_h^3/c.

    Parameters
    ----------
    omega_o : (..., 3)
        Local views.
    axes : (a, b, v1, v2), (...) each
        From `principal_axes`.
    stretch : (...)
        From `lobe_map`.
    """
    mx, my = slopes(lobe)
    a, b, v1, v2 = (axis[..., None, None] for axis in axes)
    s = mixture.s[..., None]
    y1 = mixture.y1[..., None] + s * b / a * MEAN_POINTS[:, 0]
    y2 = mixture.y2[..., None] + s * MEAN_POINTS[:, 1]
    p = np.stack([mx * (v1 * y1 - v2 * y2), my * (v2 * y1 + v1 * y2), np.ones_like(y1)], axis=-1)
    length = np.linalg.norm(p, axis=-1)
    h = p / length[..., None]
    o = omega_o[..., None, None, :]
    o_h = dot(o, h)
    omega_i = reflect(o, h)
    grazing = grazing_factor(np.where(o_h > 0, omega_i[..., 2], 0.0), o[..., 2], lobe.alpha)
    value = MEAN_WEIGHTS * length * grazing
    schlick = schlick_fresnel(o_h, 0.0)
    r0 = np.broadcast_to(as_array(lobe.r0), 3)
    gains = blend_albedo(np.stack([np.sum(value, axis=-1), np.sum(value * schlick, axis=-1)], axis=-1), r0)
    grey = value * schlick_fresnel(o_h, np.mean(r0))
    gain = np.sum(grey, axis=-1)
    mean = np.sum(grey[..., None] * omega_i, axis=-2)
    seen = gain > _SMALL
    size = np.where(seen, np.linalg.norm(mean, axis=-1), 1.0)
    linear = (
        (mixture.s * b[..., 0]) ** 2 * np.maximum(o_h[..., 0], 0) / length[..., 0] ** 3 / stretch[..., None]
    )
    variance = -np.log(np.clip(size / np.where(seen, gain, 1.0), 1e-6, 1.0))
    direction = np.where(seen[..., None], mean / size[..., None], omega_o[..., None, :] * [-1.0, -1.0, 1.0])
    return Means(
        np.where(seen[..., None], gains, 0.0),
        direction,
        np.clip(np.maximum(variance, _LEAST_VARIANCE * linear), 1e-20, 1.0),
    )


def level_shift(rho: npt.ArrayLike, samples: int, roughness: float, filter: MapFilter = "sphere") -> Array:
    """Levels to add: centres that are far apart against their widths want wider lookups.

    With t = min(3, rho/n) and the wider roughness m, as measured on training environments:
    S = -.08 + .22 t + .3 max(0, t - 1) + .36 clamp(m - .15, 0, .45) on the spherical pyramid,
    S = -.05 + .16 t + .15 max(0, t - 1) + .27 clamp(m - .15, 0, .15) on planar ones.
    """
    t = np.minimum(3.0, as_array(rho) / samples)
    far, wide = np.maximum(0.0, t - 1), max(roughness - 0.15, 0.0)
    if filter == "sphere":
        shift: Array = -0.08 + 0.22 * t + 0.3 * far + 0.36 * min(wide, 0.45)
    else:
        shift = -0.05 + 0.16 * t + 0.15 * far + 0.27 * min(wide, 0.15)
    return shift


def spherical_level(variance: npt.ArrayLike, face_texels: int) -> Array:
    """Level of the spherical pyramid at which a lookup has this variance per axis of angle, not clamped.

    With x = variance face_texels/4 it is .5 log2(x/.85) from 1 upward. Level 0 is not filtered: below 1 the
    mix of levels 0 and 1 has a share of the variance of level 1, x/3.4.
    """
    share = as_array(variance) * (face_texels / (16 * SPHERICAL_VARIANCE))
    return np.where(share < 1, share, 1 + 0.5 * np.log2(np.maximum(share, 1)))


def move_inward(direction: Array, variance: Array) -> Array:
    """Move wide lookups of planar pyramids toward the middle of their face.

    Kernels of one width in (u, v) carry light toward the corners, where a face has more texels per steradian.
    (u, v) is scaled by 1 - k v/r^2, v the variance in (u, v), at most 1/2.
    """
    face, u, v = cube_face_uv(direction)
    r2 = 1 + u * u + v * v
    uv_variance = 2 * variance / (r2**-2 + 1 / r2)
    scale = 1 - INWARD_SHIFT * np.minimum(uv_variance, 0.5) / r2
    return cube_direction(face, u * scale, v * scale)


def matched_lookups(
    frame: LocalFrame,
    lobe: LobeLike,
    samples: int,
    rows: Array,
    face_texels: int,
    filter: MapFilter = "sphere",
) -> Lookups:
    """Place the mixture of one count at surface points (maths.md, section 6).

    Under the spherical pyramid nothing but the directions' rotation depends on the frame.
    """
    mx, my = slopes(lobe)
    matrix, t1, t2, stretch = lobe_map(frame.omega_o, mx, my)
    if filter != "sphere":
        mirror = frame.omega_o * [-1.0, -1.0, 1.0]
        world = frame.to_world(np.stack([mirror, t1, t2], axis=-2))
        power = 1 / (1 + (max(mx, my) / 0.25) ** 3)
        matrix = cube_metric(world[..., 0, :], world[..., 1, :], world[..., 2, :], power) @ matrix
    axes = principal_axes(matrix)
    rho = axes[0] / axes[1]
    mixture = mixture_at(rows, samples, rho)
    means = sample_means(frame.omega_o, lobe, mixture, axes, stretch)
    direction = frame.to_world(means.direction)
    shift = level_shift(rho, samples, max(mx, my), filter)[..., None]
    if filter == "sphere":
        level = spherical_level(4**shift * means.variance, face_texels)
    else:
        level = planar_level(means.variance, direction, face_texels, filter) + shift
        direction = move_inward(direction, means.variance)
    last = 0.5 * np.log2(face_texels)
    return Lookups(direction, np.clip(level, 0, last), mixture.w[..., None] * means.gains)


@dataclass(frozen=True)
class MatchedMap:
    """A map as `matched` reads it: levels, what made them, and the suns taken out."""

    cube: PaddedCube
    filter: MapFilter = "sphere"
    suns: Sequence[Sun] = ()


def read_matched(levels: Sequence[npt.ArrayLike], settings: Any) -> MatchedMap:
    """Take the suns out of a map and make the levels that `matched` reads.

    Parameters
    ----------
    levels : list of (6, n, n, 3)
        From `build_pyramid` with the filter of the settings, "gauss6" for "sphere".
    settings : Matched, the oracle's or burnish's
    """
    filter: MapFilter = getattr(settings, "filter", "sphere")
    suns, filled = split_suns(levels[0]) if getattr(settings, "split_suns", True) else ([], levels[0])
    if suns:
        levels = build_pyramid(filled, "gauss6" if filter == "sphere" else filter)
    return MatchedMap(
        pad_cube(build_spherical_pyramid(levels) if filter == "sphere" else levels), filter, suns
    )


def shade_matched(
    light_map: MatchedMap,
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: LobeLike,
    samples: int,
) -> Array:
    """Radiance of one lobe: sum w L/sum w times the directional albedo, exact under constant light; and suns.

    Parameters
    ----------
    light_map : MatchedMap
        From `read_matched`.
    n, t, omega_o : (..., 3)
        Normals, tangents and views in the map's axes.
    samples : int
        The closest of `COUNTS` is taken.

    Returns
    -------
    radiance : (..., 3)
    """
    frame = local_frame(n, t, omega_o, lobe.rotation)
    count = closest_count(samples)
    rows, cube = load_table()[count], light_map.cube
    lookups = matched_lookups(frame, lobe, count, rows, cube.face_texels, light_map.filter)
    radiance = sample_cube(cube, lookups.direction, lookups.level)
    total, weights = np.sum(lookups.weight * radiance, axis=-2), np.sum(lookups.weight, axis=-2)
    albedo = blend_albedo(directional_albedo(frame.omega_o, slopes(lobe), lobe.alpha), lobe.r0)
    mean = np.where(weights > 0, total / np.where(weights > 0, weights, 1.0) * albedo, 0.0)
    return as_array(lobe.weight) * (mean + shade_suns(light_map.suns, frame, lobe))

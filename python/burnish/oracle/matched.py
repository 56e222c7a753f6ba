"""`matched`: mixtures whose centres and lookups together have the lobe's covariance."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo
from .arrays import Array, as_array, dot, normalize
from .cube_map import PaddedCube, pad_cube, sample_cube
from .estimator import LocalFrame, local_frame
from .lobe.base import LobeLike, grazing_reflectance, normal_reflectance, rotation_of, slopes
from .lobe.models import model_of
from .matched_means import (
    Means,
    corner_means,
    linear_place,
    two_point_means,
    view_means,
    weighted_place,
)
from .matched_table import (
    MOST_VIEW_ASPECT,
    closest_count,
    load_student_tables,
    load_table,
    mixture_at,
    nearest_aspect,
    nearest_view,
    student_window,
)
from .pyramid import build_pyramid
from .spherical_pyramid import build_spherical_pyramid
from .sun_split import Sun, shade_suns, split_suns
from .weighted_lobe import lobe_drift

#: Variance per axis of a lookup at level l of the spherical pyramid, in 4^l (2/N)^2 steradian: .75 of the
#: level and what bilinear interpolation adds, 1/6 on a face and about .1 on the sphere.
SPHERICAL_VARIANCE = 0.85
# Of a cosine, below the horizon: where no sample of a table's row is lit at the point's own view, some are
# read all the same.
_LEAST_LIT = 1e-8


#: Samples are placed for every view of a table, or at every point with two points a sample, or with five.
Placement = Literal["view", "point", "wide point"]


@dataclass(frozen=True)
class Matched:
    """Settings of the fitted mixtures, as `burnish.Matched`."""

    samples: int = 14
    split_suns: bool = True
    diffuse: str = "cube"
    placement: Placement | None = None  # None: as of lobes that no texture varies


@dataclass(frozen=True)
class Lookups:
    """What is read: directions in the map's axes (..., n, 3), levels (..., n) and weights."""

    direction: Array
    level: Array
    weight: Array  # (..., n, 3), of any scale


def spherical_level(variance: npt.ArrayLike, face_texels: int) -> Array:
    """Level of the spherical pyramid at which a lookup has this variance per axis of angle, not clamped.

    With x = variance face_texels/4 it is .5 log2(x/.85) from 1 upward. Level 0 is not filtered: below 1 the
    mix of levels 0 and 1 has a share of the variance of level 1, x/3.4.
    """
    share = as_array(variance) * (face_texels / (16 * SPHERICAL_VARIANCE))
    return np.where(share < 1, share, 1 + 0.5 * np.log2(np.maximum(share, 1)))


_PLACEMENTS: dict[Placement, Any] = {
    "view": (weighted_place, view_means),
    "point": (linear_place, two_point_means),
    "wide point": (linear_place, corner_means),
}


def rows_of(lobe: LobeLike, samples: int) -> Array:
    """Rows of one of `COUNTS` for a lobe's density, (aspects, half, 4)."""
    if model_of(lobe).DENSITY == "gaussian":
        return load_table()[samples]
    return load_student_tables()[student_window(max(slopes(lobe)))][samples]


def placement_of(lobe: LobeLike) -> Placement:
    """How samples of a lobe are placed that no texture varies."""
    mx, my = slopes(lobe)
    if model_of(lobe).HAS_VIEW_TABLES and max(mx, my) <= MOST_VIEW_ASPECT * min(mx, my):
        return "view"
    return "point" if model_of(lobe).HAS_FIXED_HALF_VECTORS else "wide point"


def place_means(
    omega_o: Array, lobe: LobeLike, samples: int, rows: Array, placement: Placement | None = None
) -> Means:
    """Means of every sample at local views."""
    place_of, means_of = _PLACEMENTS[placement or placement_of(lobe)]
    place = place_of(omega_o, lobe)
    means: Means = means_of(omega_o, lobe, mixture_at(rows, samples, nearest_aspect(place.rho)), place)
    return means


def _along_plane(view: Array, near: Array, lobe: LobeLike) -> Array:
    """What o_x and o_y are from the table's view to the point's; of round lobes along the plane of view."""
    mx, my = slopes(lobe)
    if mx != my:
        return view[..., :2] - near[..., :2]
    sine, length = (np.linalg.norm(v[..., :2], axis=-1, keepdims=True) for v in (view, near))
    moved: Array = near[..., :2] * ((sine - length) / np.where(length > 0, length, 1.0))
    return moved


def matched_lookups(
    frame: LocalFrame,
    lobe: LobeLike,
    samples: int,
    rows: Array,
    face_texels: int,
    placement: Placement | None = None,
) -> Lookups:
    """Place the mixture of one count at surface points (maths.md, section 6).

    The spherical pyramid is the same everywhere: nothing but the directions' rotation depends on the frame.
    Samples depend on the lobe and the view in its frame: half-vectors and levels are those of the nearest
    view of a table, and so are weights but for their power of cos_i (`lit_exponent`), unless the lobe's
    aspect exceeds MOST_VIEW_ASPECT. Slopes of the half-vectors drift with the view, by `lobe_drift` for a
    unit of it.
    """
    mx, my = slopes(lobe)
    view = frame.omega_o
    placement = placement or placement_of(lobe)
    if placement == "view":
        near = nearest_view(view, is_round=mx == my)
        means = place_means(near, lobe, samples, rows, placement)
        half = near[..., None, :] + means.direction
        moved = (lobe_drift(lobe) * _along_plane(view, near, lobe))[..., None, :]
        slope = half[..., :2] / half[..., 2:] + moved
        h = normalize(np.concatenate([slope, np.ones_like(half[..., 2:])], axis=-1))
        direction = 2 * dot(view[..., None, :], h)[..., None] * h - view[..., None, :]
        lit, near_lit = (np.maximum(i[..., 2], _LEAST_LIT) for i in (direction, means.direction))
        weight = means.gains * ((lit / near_lit) ** model_of(lobe).lit_exponent(lobe))[..., None]
    else:
        means = place_means(view, lobe, samples, rows, placement)
        direction, weight = means.direction, means.gains
    level = spherical_level(means.variance, face_texels)
    last = 0.5 * np.log2(face_texels)
    return Lookups(frame.to_world(direction), np.clip(level, 0, last), weight)


@dataclass(frozen=True)
class MatchedMap:
    """A map as `matched` reads it: levels that are round on the sphere, and the suns taken out."""

    cube: PaddedCube
    suns: Sequence[Sun] = ()


def read_matched(levels: Sequence[npt.ArrayLike], settings: Any) -> MatchedMap:
    """Take the suns out of a map and make the levels that `matched` reads.

    Parameters
    ----------
    levels : list of (6, n, n, 3)
        From `build_pyramid` with "gauss6".
    settings : Matched, the oracle's or burnish's
    """
    suns, filled = split_suns(levels[0]) if getattr(settings, "split_suns", True) else ([], levels[0])
    if suns:
        levels = build_pyramid(filled, "gauss6")
    return MatchedMap(pad_cube(build_spherical_pyramid(levels)), suns)


def shade_matched(
    light_map: MatchedMap,
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: LobeLike,
    samples: int,
    placement: Placement | None = None,
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
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    count = closest_count(samples)
    rows, cube = rows_of(lobe, count), light_map.cube
    lookups = matched_lookups(frame, lobe, count, rows, cube.face_texels, placement)
    radiance = sample_cube(cube, lookups.direction, lookups.level)
    total, weights = np.sum(lookups.weight * radiance, axis=-2), np.sum(lookups.weight, axis=-2)
    albedo = blend_albedo(
        model_of(lobe).albedo(frame.omega_o, lobe), normal_reflectance(lobe), grazing_reflectance(lobe)
    )
    mean = np.where(weights > 0, total / np.where(weights > 0, weights, 1.0) * albedo, 0.0)
    return as_array(lobe.weight) * (mean + shade_suns(light_map.suns, frame, lobe))

"""Radiance leaving a surface point: the samplers, and the sum over every texel that judges them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo, directional_albedo
from .arrays import Array, as_array, dot, normalize, reflect
from .cube_map import PaddedCube, pad_cube, sample_cube
from .footprint import (
    Footprint,
    exact_texels,
    importance_texels,
    level_of_texels,
    published_area,
    published_texels,
)
from .frame import frame_from_tangent, rotate_frame
from .importance import Points
from .lobe.base import MIN_COS_O, KurtLike, normal_reflectance, rotation_of, schlick_fresnel, slopes
from .lobe.kurt import grazing_factor, kurt_d, kurt_pdf_omega_i
from .regular_pattern import lobe_solid_angle
from .spherical_harmonics import irradiance

Levels = PaddedCube | Sequence[npt.ArrayLike]
Normalization = Literal["published", "projected", "furnace"]


@dataclass(frozen=True)
class Regular:
    """Settings of the regular pattern, as `burnish.Regular`."""

    samples: int = 14
    threshold: float = 0.2
    footprint: Footprint = "exact"
    normalization: Normalization = "furnace"
    mip_bias: float = 0.0
    diffuse: str = "cube"


@dataclass(frozen=True)
class Importance:
    """Settings of filtered importance sampling, as `burnish.Importance`."""

    samples: int = 14
    points: Points = "hammersley"
    mip_bias: float = 0.0
    diffuse: str = "cube"


@dataclass(frozen=True)
class Reference:
    """Every texel of level 0."""


@dataclass(frozen=True)
class LocalFrame:
    """The lobe's axes in the world, (..., 3) each, and the view in them."""

    tangent: Array
    bitangent: Array
    normal: Array
    omega_o: Array

    def to_world(self, local: npt.ArrayLike) -> Array:
        """Directions (..., samples, 3) of the lobe's frame in the world."""
        axes = np.stack([self.tangent, self.bitangent, self.normal], axis=-2)
        result: Array = as_array(local) @ axes
        return result


def local_frame(
    n: npt.ArrayLike, t: npt.ArrayLike, omega_o: npt.ArrayLike, rotation: float = 0.0
) -> LocalFrame:
    """Return the lobe's frame at surface points.

    Normals and views may have any length. The view's cosine is raised to 1e-4 and the view made unit again:
    views from behind the shading normal graze the surface. Tangents of four numbers have the bitangent's sign
    in the last, as glTF's; those of three stand for right-handed frames.
    """
    t = as_array(t)
    sign = t[..., 3:] if t.shape[-1] == 4 else np.ones((*t.shape[:-1], 1))
    n, t, sign, omega_o = np.broadcast_arrays(normalize(n), t[..., :3], sign, normalize(omega_o))
    tangent, bitangent = frame_from_tangent(n, t)
    tangent, bitangent = rotate_frame(tangent, sign * bitangent, rotation)
    cos_o = np.maximum(dot(omega_o, n), MIN_COS_O)
    local = np.stack([dot(omega_o, tangent), dot(omega_o, bitangent), cos_o], axis=-1)
    return LocalFrame(tangent, bitangent, n, normalize(local))


def shade_regular(
    levels: Levels,
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: KurtLike,
    pattern: npt.ArrayLike,
    threshold: float,
    footprint: Footprint = "exact",
    normalization: Normalization = "furnace",
    mip_bias: float = 0.0,
) -> Array:
    """Radiance of one lobe by the regular pattern (RS eqs. 9, 17, 18).

    With w_k = D_k F cos_i^(1-alpha) cos_o^-alpha, 0 below the horizon:
    published: sum w L/sum D, which converges to the truth over E[1/cos_h];
    projected: sum w L/sum D cos_h, since int D cos_h = 1;
    furnace: sum w L/sum w times the directional albedo, each channel for itself; exact under constant light.

    Parameters
    ----------
    levels : the map's levels, or a `PaddedCube`
    n, t, omega_o : (..., 3)
        Normals, tangents and views in the map's axes.
    pattern : (count, 3)
        Half-vectors from `sample_pattern` with this threshold.

    Returns
    -------
    radiance : (..., 3)
    """
    cube = pad_cube(levels)
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    h = as_array(pattern)
    mx, my = slopes(lobe)
    local_o = frame.omega_o[..., None, :]
    local_i = reflect(local_o, h)
    o_h = dot(local_o, h)
    direction = frame.to_world(local_i)
    if footprint == "exact":
        texels = exact_texels(o_h, direction, lobe_solid_angle(mx, my, threshold), len(h), cube.face_texels)
    elif footprint == "published":
        area = published_area(local_o, mx, my, threshold)
        texels = published_texels(o_h, direction, area, len(h), cube.face_texels)
    else:
        raise ValueError(f'footprint: expected "published" or "exact", got {footprint!r}')
    radiance = sample_cube(cube, direction, level_of_texels(texels, cube.face_texels, mip_bias))

    d = kurt_d(h, mx, my)
    grazing = grazing_factor(local_i[..., 2], local_o[..., 2], lobe.alpha)
    w = (d * grazing)[..., None] * schlick_fresnel(o_h[..., None], normal_reflectance(lobe))
    total: Array = np.sum(w * radiance, axis=-2)
    if normalization == "published":
        mean = total / np.sum(d)
    elif normalization == "projected":
        mean = total / np.sum(d * h[:, 2])
    elif normalization == "furnace":
        weights = np.sum(w, axis=-2)
        albedo = blend_albedo(
            directional_albedo(frame.omega_o, (mx, my), lobe.alpha), normal_reflectance(lobe)
        )
        mean = np.where(weights > 0, total / np.where(weights > 0, weights, 1.0) * albedo, 0.0)
    else:
        names = '"published", "projected" or "furnace"'
        raise ValueError(f"normalization: expected {names}, got {normalization!r}")
    return as_array(lobe.weight) * mean


def shade_importance(
    levels: Levels,
    n: npt.ArrayLike,
    t: npt.ArrayLike,
    omega_o: npt.ArrayLike,
    lobe: KurtLike,
    half_vectors: npt.ArrayLike,
    mip_bias: float = 0.0,
) -> Array:
    """Radiance of one lobe by filtered importance sampling: mean F cos_i^(1-alpha) cos_o^-alpha L/cos_h."""
    cube = pad_cube(levels)
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    h = as_array(half_vectors)
    local_o = frame.omega_o[..., None, :]
    local_i = reflect(local_o, h)
    o_h = dot(local_o, h)
    direction = frame.to_world(local_i)
    pdf = kurt_pdf_omega_i(h, local_o, *slopes(lobe))
    texels = importance_texels(pdf, direction, len(h), cube.face_texels)
    radiance = sample_cube(cube, direction, level_of_texels(texels, cube.face_texels, mip_bias))
    grazing = grazing_factor(local_i[..., 2], local_o[..., 2], lobe.alpha) / h[:, 2]
    w = grazing[..., None] * schlick_fresnel(o_h[..., None], normal_reflectance(lobe))
    mean: Array = np.mean(w * radiance, axis=-2)
    return as_array(lobe.weight) * mean


def shade_diffuse(coefficients: npt.ArrayLike, n: npt.ArrayLike, diffuse: npt.ArrayLike) -> Array:
    """Radiance kd/pi E(n) of the diffuse part by harmonics: E from nine coefficients, never below 0."""
    return as_array(diffuse) / np.pi * np.maximum(irradiance(coefficients, normalize(n)), 0)

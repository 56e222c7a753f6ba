"""Patterns of the published samplers over any lobe, as points of its plane.

A lobe is f cos_i di = g(p) K(p) d^2p, K the density of its plane. A sampler gives points p with areas; a lobe
says which direction is there, its g, and by how much the plane is stretched on the sphere.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from .albedo import blend_albedo
from .arrays import Array, as_array, dot
from .cube_map import PaddedCube, cube_stretch, sample_cube
from .estimator import local_frame
from .footprint import level_of_texels
from .importance import point_set
from .lobe.base import MIN_X1, grazing_reflectance, normal_reflectance, rotation_of, slopes
from .lobe.models import model_of
from .regular_pattern import choose_pattern, lobe_solid_angle


def plane_density(p: Array, density: str) -> Array:
    """K (...) at points (..., 2)."""
    r2 = dot(p, p)
    result: Array = (np.exp(-r2) if density == "gaussian" else (1 + r2) ** -2) / np.pi
    return result


def _radius(x: Array, density: str) -> Array:
    """Radius outside of which a share x of a Gaussian lies, inside of which one of Student's density."""
    return np.sqrt(-np.log(np.maximum(x, MIN_X1))) if density == "gaussian" else np.sqrt(x / (1 - x))


def plane_points(sampler: Any, lobe: Any) -> tuple[Array, Array]:
    """Points (n, 2) and areas (n,).

    Importance: a share of K each, areas 1/(n K). Regular: the slopes of the published pattern down to
    K = threshold K(0), in units of roughness; half-vectors have equal solid angles, so that the area of a
    point is that over mx my cos_h^3.
    """
    density = model_of(lobe).DENSITY
    if type(sampler).__name__ == "Importance":
        x = point_set(sampler.points, sampler.samples)
        radius, azimuth = _radius(x[:, 0], density), 2 * np.pi * x[:, 1]
        p = radius[:, None] * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=-1)
        return p, 1 / (len(p) * plane_density(p, density))
    mx, my = slopes(lobe)
    # Kurt's threshold at which a radius is the one that K falls to the threshold at.
    threshold = float(sampler.threshold)
    if density != "gaussian":
        threshold = max(float(np.exp(1 - threshold**-0.5)), 1e-300)
    h = choose_pattern((mx, my), sampler.samples, threshold)
    area = lobe_solid_angle(mx, my, threshold) / (len(h) * mx * my * h[:, 2] ** 3)
    return h[:, :2] / h[:, 2:] / [mx, my], area


def shade_plane(
    cube: PaddedCube, n: npt.ArrayLike, t: npt.ArrayLike, omega_o: npt.ArrayLike, lobe: Any, sampler: Any
) -> Array:
    """Radiance of one lobe, (..., 3), by a pattern's points.

    Importance: sum g K area L. Regular, with w = g K area: projected: sum w L/sum K area; furnace: sum w L/
    sum w times the directional albedo, each channel for itself.
    """
    name = type(sampler).__name__
    model = model_of(lobe)
    p, area = plane_points(sampler, lobe)
    frame = local_frame(n, t, omega_o, rotation_of(lobe))
    slope = p * slopes(lobe)
    light = model.reflect(frame.omega_o[..., None, :], lobe, slope)
    mx, my = slopes(lobe)
    stretch = model.stretch(frame.omega_o[..., None, :], lobe, slope, slope) * (mx * my)
    direction = frame.to_world(light.omega_i)
    texels = 0.25 * cube.face_texels * cube_stretch(direction) ** 3 * area * stretch
    radiance = sample_cube(cube, direction, level_of_texels(texels, cube.face_texels, sampler.mip_bias))
    share = area * plane_density(p, model.DENSITY)
    r0, f90 = normal_reflectance(lobe), grazing_reflectance(lobe)
    w = (share * light.base)[..., None] * (r0 + (f90 - r0) * light.schlick[..., None])
    total: Array = np.sum(w * radiance, axis=-2)
    if name == "Regular" and sampler.normalization == "furnace":
        weights = np.sum(w, axis=-2)
        albedo = blend_albedo(model.albedo(frame.omega_o, lobe), r0, f90)
        total = np.where(weights > 0, total / np.where(weights > 0, weights, 1.0) * albedo, 0.0)
    elif name == "Regular":
        total = total / np.sum(share)
    return as_array(lobe.weight) * total

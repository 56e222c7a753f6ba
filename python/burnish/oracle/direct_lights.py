"""Direct lights: what of one arrives at a place, and what materials make of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize
from .estimator import LocalFrame, local_frame
from .lobe.base import grazing_reflectance, normal_reflectance, rotation_of, schlick_fresnel
from .lobe.models import model_of
from .shading import add_layers, energy_scale
from .sun_split import shade_small_light

#: Points of the sum over a light's disc.
DISC_POINTS = 40_000


@dataclass(frozen=True)
class Arriving:
    """Light at places, (..., 3) and (...)."""

    omega_i: Array  # unit, to the light's middle
    irradiance: Array  # across its way
    sine: Array  # of half the angle that it is seen under


def arriving_light(light: Any, positions: npt.ArrayLike) -> Arriving:
    """What of a light arrives at positions (..., 3).

    A sphere of radius R and intensity I has the radiance I/(pi R^2): at a distance d its irradiance across
    the way is I/d^2 and its sine R/d. Inside it both are those of its surface. Range and cone are those of
    KHR_lights_punctual.
    """
    positions = as_array(positions)
    if type(light).__name__ == "DirectionalLight":
        shape = positions.shape[:-1]
        toward = np.broadcast_to(-normalize(as_array(light.direction)), positions.shape)
        irradiance = np.broadcast_to(as_array(light.irradiance), positions.shape)
        return Arriving(toward, irradiance, np.full(shape, np.sin(0.5 * light.angle)))
    way = as_array(light.position) - positions
    distance = np.linalg.norm(way, axis=-1)
    omega_i = way / np.maximum(distance, 1e-300)[..., None]
    share = np.ones(distance.shape)
    if light.range is not None:
        share = np.clip(1 - (distance / light.range) ** 4, 0, 1)
    if type(light).__name__ == "SpotLight":
        inner, outer = np.cos(light.inner_angle), np.cos(light.outer_angle)
        cosine = dot(-omega_i, normalize(as_array(light.direction)))
        share = share * np.clip((cosine - outer) / max(inner - outer, 1e-4), 0, 1) ** 2
    outside = np.maximum(distance, light.radius)
    irradiance = as_array(light.intensity) * (share / outside**2)[..., None]
    return Arriving(omega_i, irradiance, light.radius / outside)


def lit_cosine(cosine: npt.ArrayLike, sine: npt.ArrayLike) -> Array:
    """Irradiance of a surface over that across the way to a sphere; broadcasts.

    `cosine` is that of the sphere's middle, `sine` that of half the angle it is seen under. Above the horizon
    cosine; where the horizon cuts it, with x = cot of half the angle and y = -x cot of the middle's,
    (cosine acos y - x sin (1 - y^2)^1/2 + atan(sin (1 - y^2)^1/2/x)/sine^2)/pi (Snyder 1996).
    """
    cosine, sine = np.broadcast_arrays(as_array(cosine), as_array(sine))
    is_cut = np.abs(cosine) < sine
    c, s = np.where(is_cut, cosine, 0.0), np.where(is_cut, sine, 0.5)
    x, across = np.sqrt(1 / s**2 - 1), np.sqrt(1 - c * c)
    y = np.clip(-x * c / across, -1, 1)
    rest = across * np.sqrt(1 - y * y)
    cut = (c * np.arccos(y) - x * rest + np.arctan2(rest, x) / s**2) / np.pi
    result: Array = np.where(is_cut, cut, np.maximum(cosine, 0.0))
    return result


def _widen(light: Arriving, frame: LocalFrame, lobe: Any) -> Array:
    value = shade_small_light(light.omega_i, 0.25 * light.sine**2, frame, lobe)
    result: Array = as_array(lobe.weight) * value * light.irradiance
    return result


def _sum_disc(light: Arriving, frame: LocalFrame, lobe: Any) -> Array:
    k = np.arange(DISC_POINTS) + 0.5
    azimuth = np.pi * (1 + 5**0.5) * k
    result = np.zeros(light.irradiance.shape)
    for point in np.ndindex(light.sine.shape):
        axes = np.stack([frame.tangent[point], frame.bitangent[point], frame.normal[point]])
        middle, sine = axes @ light.omega_i[point], float(light.sine[point])
        height = 1 - k / DISC_POINTS * (1 - np.sqrt(1 - sine * sine))
        across = np.sqrt(1 - height**2)
        first = normalize(np.cross(middle, [1.0, 0.0, 0.0] if abs(middle[0]) < 0.7 else [0.0, 1.0, 0.0]))
        basis = np.stack([first, np.cross(middle, first), middle])
        omega_i = np.stack([across * np.cos(azimuth), across * np.sin(azimuth), height], axis=-1) @ basis
        above = omega_i[:, 2] > 0
        values = model_of(lobe).values(omega_i[above].T, frame.omega_o[point], lobe)
        fresnel = schlick_fresnel(values.o_h[:, None], normal_reflectance(lobe), grazing_reflectance(lobe))
        # Of a sphere that is equally bright all over, E = pi L sine^2.
        solid_angle = 2 * np.pi * (1 - np.sqrt(1 - sine * sine))
        share = solid_angle / (np.pi * sine * sine) if sine > 0 else 1.0
        total = np.sum(values.value[:, None] * fresnel, axis=0) / DISC_POINTS * share
        result[point] = as_array(lobe.weight) * total * light.irradiance[point]
    return result


def shade_lights(
    material: Any,
    lights: Sequence[Any],
    positions: npt.ArrayLike,
    normals: npt.ArrayLike,
    tangents: npt.ArrayLike,
    views: npt.ArrayLike,
    *,
    is_truth: bool = False,
) -> Array:
    """Radiance (n, 3) under direct lights alone.

    Lobes as samplers see them are wider by the light; the truth sums them over each light's disc,
    `DISC_POINTS` evenly placed.
    """
    shade_lobe = _sum_disc if is_truth else _widen
    n, t, o = as_array(normals), as_array(tangents), as_array(views)
    arriving = [arriving_light(light, positions) for light in lights]
    below = np.zeros(n.shape)
    for light in arriving:
        cosine = dot(light.omega_i, normalize(n))
        below = below + light.irradiance * lit_cosine(cosine, light.sine)[..., None]
    below = below * as_array(material.diffuse) / np.pi
    parts = []
    for lobe in material.lobes:
        frame = local_frame(n, t, o, rotation_of(lobe))
        total = sum((shade_lobe(light, frame, lobe) for light in arriving), np.zeros(n.shape))
        parts.append(total * energy_scale(n, t, o, lobe))
    return add_layers(material, parts, below, n, t, o, has_emission=False)

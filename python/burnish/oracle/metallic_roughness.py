"""From glTF's metallic-roughness factors to a diffuse part and lobes."""

from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from .arrays import Array, as_array
from .lobe.ggx import GgxLobe
from .lobe.kurt import KurtLobe
from .lobe.sheen import SheenLobe

#: Smallest slope, or alpha, of a lobe.
MIN_ROUGHNESS = 1e-3
CLEARCOAT_R0 = 0.04


#: Of a layer: the shares of E_1 and E_s of its albedo that what lies below it lacks, None for all that it
#: reflects in the channel of which that is most; and whether emission lies below it.
Cover = tuple[tuple[float, float] | None, bool]


@dataclass(frozen=True)
class Material:
    """Diffuse reflectance, lobes and emitted radiance; without covers all parts add up."""

    diffuse: Any = 0.0
    lobes: list[Any] = field(default_factory=list)
    emissive: Any = 0.0
    double_sided: bool = False
    covers: tuple[Cover, ...] | None = None


@dataclass(frozen=True)
class MetallicRoughness:
    """Factors of glTF and its extensions for specular, index of refraction, anisotropy, clearcoat and
    sheen.
    """

    base_color: Any = 1.0
    metallic: float = 1.0
    roughness: float = 1.0  # perceptual
    ior: float = 1.5
    specular: float = 1.0
    specular_color: Any = 1.0
    anisotropy: float = 0.0
    anisotropy_rotation: float = 0.0
    clearcoat: float = 0.0
    clearcoat_roughness: float = 0.0
    sheen_color: Any = 0.0
    sheen_roughness: float = 0.0  # perceptual


def _mix(a: Any, b: Any, share: float) -> Array:
    return as_array(a) * (1 - share) + as_array(b) * share


def map_metallic_roughness(
    source: MetallicRoughness, emissive: Any = 0.0, model: Literal["ggx", "kurt"] = "ggx"
) -> Material:
    """Return diffuse part and lobes of a glTF material.

    m = max(roughness^2, 1e-3), f0 = min(((ior-1)/(ior+1))^2 specular_color, 1) specular. Base lobe:
    mix(f0, base, metallic) along the normal and mix(specular, 1, metallic) along the surface, none where that
    is 0. Anisotropy: m_x = mix(m, 1, strength^2). Clearcoat: one more lobe of r0 .04 and weight = factor.
    "ggx": alpha = m, diffuse = base (1 - metallic), in layers: the base lobe lies over the diffuse part with
    its dielectric share, of the channel with the largest f0; sheen over both, the coat over all, emission
    below all but the base.
    "kurt": slopes m, alpha = .5, lobes conserve energy and add up; diffuse = base (1 - metallic)
    (1 - max(f0)).
    """
    base = np.broadcast_to(as_array(source.base_color), 3)
    color = np.broadcast_to(as_array(source.specular_color), 3)
    f0 = np.minimum(((source.ior - 1) / (source.ior + 1)) ** 2 * color, 1.0) * source.specular
    lobes: list[Any] = []
    covers: list[Cover] = []

    def add(roughness: tuple[float, float], r0: Any, weight: float, rotation: float) -> None:
        if model == "kurt":
            lobes.append(KurtLobe(roughness, r0, 0.5, (weight,) * 3, rotation, True))
        else:
            lobes.append(GgxLobe(roughness, r0, 1.0, (weight,) * 3, rotation))

    weight = float(_mix(source.specular, 1.0, source.metallic))
    most = float(np.max(f0))
    if weight > 0:
        m = max(source.roughness**2, MIN_ROUGHNESS)
        mx = float(_mix(m, 1.0, source.anisotropy**2))
        r0 = np.clip(_mix(f0, base, source.metallic) / weight, 0.0, 1.0)
        add((mx, m), r0, weight, source.anisotropy_rotation)
        covers.append(((most, source.specular - most), False))
    if model != "kurt" and np.any(as_array(source.sheen_color) > 0):
        lobes.append(SheenLobe(source.sheen_roughness, source.sheen_color))
        covers.append((None, True))
    if source.clearcoat > 0:
        m = max(source.clearcoat_roughness**2, MIN_ROUGHNESS)
        add((m, m), CLEARCOAT_R0, source.clearcoat, 0.0)
        covers.append((None, True))
    diffuse = base * (1 - source.metallic)
    shining = np.broadcast_to(as_array(emissive), 3)
    if model == "kurt":
        return Material(diffuse * (1 - most), lobes, shining)
    return Material(diffuse, lobes, shining, covers=tuple(covers))

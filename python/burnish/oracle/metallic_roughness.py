"""From glTF's metallic-roughness factors to a diffuse part and Kurt lobes."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .arrays import Array, as_array
from .lobe.base import LobeLike
from .lobe.kurt import KurtLobe

#: Smallest slope of a lobe.
MIN_ROUGHNESS = 1e-3
CLEARCOAT_R0 = 0.04


@dataclass(frozen=True)
class Material:
    """Diffuse reflectance, lobes and emitted radiance."""

    diffuse: Any = 0.0
    lobes: list[LobeLike] = field(default_factory=list)
    emissive: Any = 0.0
    double_sided: bool = False


@dataclass(frozen=True)
class MetallicRoughness:
    """Factors of glTF and its extensions for specular, index of refraction, anisotropy and clearcoat."""

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


def _mix(a: Any, b: Any, share: float) -> Array:
    return as_array(a) * (1 - share) + as_array(b) * share


def map_metallic_roughness(source: MetallicRoughness, emissive: Any = 0.0) -> Material:
    """Return diffuse part and lobes of a glTF material.

    m = max(roughness^2, 1e-3), alpha = .5, f0 = min(((ior-1)/(ior+1))^2 specular_color, 1) specular.
    Base lobe: weight = mix(specular, 1, metallic), r0 = mix(f0, base, metallic)/weight, none for weight 0.
    Diffuse = base (1 - metallic)(1 - max(f0)). Anisotropy: m_x = mix(m, 1, strength^2).
    Clearcoat: one more lobe of r0 .04 and weight = factor. Lobes conserve energy.
    """
    base = np.broadcast_to(as_array(source.base_color), 3)
    color = np.broadcast_to(as_array(source.specular_color), 3)
    f0 = np.minimum(((source.ior - 1) / (source.ior + 1)) ** 2 * color, 1.0) * source.specular
    lobes: list[LobeLike] = []
    weight = float(_mix(source.specular, 1.0, source.metallic))
    if weight > 0:
        m = max(source.roughness**2, MIN_ROUGHNESS)
        mx = float(_mix(m, 1.0, source.anisotropy**2))
        r0 = np.clip(_mix(f0, base, source.metallic) / weight, 0.0, 1.0)
        lobes.append(KurtLobe((mx, m), r0, 0.5, (weight,) * 3, source.anisotropy_rotation, True))
    if source.clearcoat > 0:
        m = max(source.clearcoat_roughness**2, MIN_ROUGHNESS)
        lobes.append(KurtLobe((m, m), CLEARCOAT_R0, 0.5, (source.clearcoat,) * 3, 0.0, True))
    diffuse = base * (1 - source.metallic) * (1 - float(np.max(f0)))
    return Material(diffuse, lobes, np.broadcast_to(as_array(emissive), 3))

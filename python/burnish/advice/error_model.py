"""Errors of every sampler and count without rendering: from lobe, angle and the environment's spectrum.

A sampler replaces the lobe K by lookups whose sum differs from it by dK. Over a picture that reflects all of
the map, error^2 = sum over angular octaves of |dK|^2 P / E: P is the energy of the map's radiance in the
octave, E what the lobe leaves of the map's energy. With octaves counted from the lobe's own width, dK depends
on the sampler, the count n and the lobe's aspect rho alone:

    error^2 = rho^(2 g) (1 + h rho/n)^2 (1 + m^2/.1)^(2 w) q^2 sum_b exp(2 a_b) n^(-2 p_b) P_b / E + z^2 Z / E

The term in the slope m is for wide lobes, whose half-vectors are no longer mapped linearly; q is a factor for
Fresnel and one for alpha. A sampler that takes suns out of the map sees the contrast P of the rest, and errs
by z of the energy Z that the suns bring. The coefficients a, p, g, h, w, q, z of each family are fitted to
studies by ``python -m burnish.advice.calibration.calibrate``, which wrote error_model.json beside this file.
"""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.advice.contrast import Spectrum
from burnish.advice.families import FAMILIES
from burnish.lobes import Lobe, grazing_exponent, has_fresnel, width_of

Float64 = NDArray[np.float64]

BANDS = tuple(range(-4, 3))
"""Octaves: band b holds structure of 2^b to 2^(b+1) times the lobe's deviation on the sphere."""

BLURRED_AWAY = 2.5
"""Structure narrower than this many deviations is not left in the reflection."""

SPHERE_COSINES = (0.913, 0.707, 0.408)
"""View angles that stand for a sphere: each for a third of its pixels."""

TEXTURED_SLOPES = (0.1, 0.3)
"""Stand in for a roughness that a texture holds."""

LEAST_ERROR = 1e-5

CUBE_ERROR = 1e-3
"""Relative RMSE of diffuse light by the irradiance cube, of most maps; the report gives each map's."""

COSINE_WIDTH = 1.7
"""Radians: what is narrower is not left in diffuse light."""


@dataclass(frozen=True)
class LobeTraits:
    """What of a lobe its error depends on.

    Parameters
    ----------
    roughness : (along, across)
        Beckmann slopes.
    has_fresnel : bool
        Whether r0 is below 1 in a channel.
    alpha : float
        Exponent of the cosines.
    """

    roughness: tuple[float, float]
    has_fresnel: bool = False
    alpha: float = 0.0


def traits_of_lobe(lobe: Lobe) -> LobeTraits:
    """Read the traits of a lobe.

    Parameters
    ----------
    lobe : lobe
        Any. The model was fitted to Kurt's lobes; others have the errors of that of their widths, until a
        probe puts them right.
    """
    return LobeTraits(width_of(lobe), has_fresnel(lobe), grazing_exponent(lobe))


@dataclass(frozen=True)
class Features:
    """A lobe under one angle in one environment, with its brush along and across the view.

    Parameters
    ----------
    aspects : (..., 2) float64
        Ratio of the lobe's axes on the map, at least 1.
    energies : (..., 2, bands) float64
        P_b, mean square radiance in each octave.
    left : (..., 2) float64
        E, the mean square that the lobe leaves.
    suns : (..., 2) float64
        Z, the part of E that comes from suns which the sampler takes out; 0 where it takes none.
    width : (...) float64
        ln(1 + m^2/.1), m the geometric mean of the slopes.
    fresnel : (...) float64
        1 where r0 is below 1 in a channel, else 0.
    alpha : (...) float64
        Exponent of the cosines.
    """

    aspects: Float64
    energies: Float64
    left: Float64
    suns: Float64
    width: Float64
    fresnel: Float64
    alpha: Float64


def lobe_features(lobe: LobeTraits, cosine: float, spectrum: Spectrum, splits_suns: bool = False) -> Features:
    """Work out what the model needs.

    Parameters
    ----------
    lobe : LobeTraits
        The lobe.
    cosine : float
        Of the view's angle, above 0.
    spectrum : Spectrum
        Of the environment.
    splits_suns : bool
        Whether the sampler takes suns out of the map: they are then no contrast to it, but light.
    """
    along, across = lobe.roughness
    # Offsets from the mirror direction are 2 m in the plane of view and 2 m cos across it; a deviation is
    # that over sqrt 2.
    axes = math.sqrt(2.0) * np.array([(along, across * cosine), (across, along * cosine)])
    widths = np.sqrt(axes.prod(axis=1))
    edges = widths[:, None] * 2.0 ** np.arange(BANDS[0], BANDS[-1] + 2)
    energies = np.diff(spectrum.lost_below(edges, not splits_suns), axis=1)
    edge = BLURRED_AWAY * widths
    left = np.maximum(spectrum.total - spectrum.lost_below(edge), 1e-12)
    suns = np.maximum(spectrum.total - spectrum.lost_below(edge) - spectrum.left_without_suns(edge), 0.0)
    aspects = axes.max(axis=1) / axes.min(axis=1)
    width, fresnel, alpha = (
        np.asarray(value, np.float64)
        for value in (math.log1p(along * across / 0.1), lobe.has_fresnel, lobe.alpha)
    )
    return Features(aspects, energies, left, suns * splits_suns, width, fresnel, alpha)


def evaluate(
    coefficients: Mapping[str, Any], features: Features, count: Float64 | int
) -> tuple[Float64, Float64]:
    """Give the square of the error times E, and E: sums over several lobes are made of these.

    Parameters
    ----------
    coefficients : mapping
        Of a family: ``amplitude`` and ``power`` by band, ``aspect``, ``aspect_over_count``, ``width``,
        ``fresnel``, ``alpha``, and ``suns``, the logarithm of z.
    features : Features
        As `lobe_features` gives them, or many stacked along leading axes.
    count : int or (...) float64
        Lookups, by the leading axes.

    Returns
    -------
    squares, left : (...) float64
    """
    n = np.asarray(count, np.float64)[..., None]
    scale = np.exp(
        2.0 * (np.asarray(coefficients["amplitude"]) - np.asarray(coefficients["power"]) * np.log(n))
    )
    stretch = features.aspects ** (2.0 * coefficients["aspect"])
    stretch = stretch * (1.0 + coefficients["aspect_over_count"] * features.aspects / n) ** 2
    factors = ("width", "fresnel", "alpha")
    factor = np.exp(2.0 * sum(coefficients[name] * getattr(features, name) for name in factors))
    octaves = np.sum(features.energies * scale[..., None, :], axis=-1)
    squares = factor * np.mean(stretch * octaves, axis=-1)
    return squares + math.exp(2.0 * coefficients["suns"]) * features.suns.mean(axis=-1), features.left.mean(
        -1
    )


@cache
def committed_data() -> dict[str, Any]:
    """Read error_model.json: coefficients, shares for error estimates, and how they were made."""
    text = (files("burnish.advice") / "error_model.json").read_text(encoding="utf-8")
    data: dict[str, Any] = json.loads(text)
    return data


def diffuse_share_of(material: _core.Material) -> float:
    """Share of a material's light that its diffuse part reflects, beside those of `lobes_of`.

    Parameters
    ----------
    material : Material
        Any.
    """
    return 1.0 - sum(share for _, share in lobes_of(material)) if any(material.diffuse) else 0.0


def lobes_of(material: _core.Material) -> list[tuple[LobeTraits, float]]:
    """Lobes of a material with the share of its light that each reflects, roughly.

    Parameters
    ----------
    material : Material
        Its diffuse part takes the rest (`diffuse_share_of`). A textured roughness is unknown: two slopes
        stand for it.
    """
    parts: list[tuple[LobeTraits, float]] = []
    for lobe in material.lobes:
        r0 = np.array(getattr(lobe, "r0", 1.0))
        share = float(np.mean(np.array(lobe.weight) * (r0 + 0.05 * (1.0 - r0))))
        slopes = [width_of(lobe)]
        if material.is_metallic_roughness:
            slopes = [(slope, slope) for slope in TEXTURED_SLOPES]
        for pair in slopes:
            parts.append((replace(traits_of_lobe(lobe), roughness=pair), share / len(slopes)))
    total = sum(share for _, share in parts) + float(np.mean(material.diffuse))
    return [(traits, share / total) for traits, share in parts if total > 0]


class ErrorModel:
    """Predicts relative RMSE.

    Parameters
    ----------
    data : dict or None
        ``families``: coefficients by family. None: those that are part of burnish.
    """

    def __init__(self, data: dict[str, Any] | None = None) -> None:
        self._families: dict[str, dict[str, Any]] = (data or committed_data())["families"]

    def predict(
        self,
        family: str,
        count: int,
        parts: Iterable[tuple[LobeTraits, float]],
        spectrum: Spectrum,
        cosines: Sequence[float] = SPHERE_COSINES,
        diffuse_shares: Iterable[float] = (),
        diffuse_error: float = CUBE_ERROR,
    ) -> float:
        """Predict the relative RMSE over a picture.

        Parameters
        ----------
        family : str
            A key of ``burnish.advice.families.FAMILIES``.
        count : int
            Lookups a lobe.
        parts : iterable of (LobeTraits, share)
            Lobes with the share of the light that each reflects; they cover the picture alike.
        spectrum : Spectrum
            Of the environment.
        cosines : sequence of float
            View angles, all alike in weight.
        diffuse_shares : iterable of float
            Of the light, that diffuse parts reflect.
        diffuse_error : float
            Relative RMSE of the light on them, as reports give it.
        """
        coefficients, splits_suns = self._families[family], FAMILIES[family].splits_suns
        error = energy = 0.0
        for traits, share in parts:
            for cosine in cosines:
                square, left = evaluate(
                    coefficients, lobe_features(traits, cosine, spectrum, splits_suns), count
                )
                error, energy = error + share**2 * float(square), energy + share * float(left)
        left_of_diffuse = float(spectrum.total - spectrum.lost_below(np.array(COSINE_WIDTH)))
        for diffuse_share in diffuse_shares:
            diffuse = len(cosines) * diffuse_share**2 * left_of_diffuse
            error, energy = error + diffuse_error**2 * diffuse, energy + diffuse
        return max(math.sqrt(error / energy), LEAST_ERROR) if energy > 0 else LEAST_ERROR

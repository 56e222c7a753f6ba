"""What is measured of shaded points: error against the float64 twin, values that no light has, invariants."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from burnish import _core
from burnish.hardcases.bench import Bench, make_sampler
from burnish.hardcases.bounds import TWIN_BOUND, WILD_BOUND
from burnish.hardcases.case import BY_LOBE, SAMPLERS, Bound, HardCase, Quantity
from burnish.hardcases.inputs import Points, around
from burnish.oracle.albedo import blend_albedo, directional_albedo

#: Few, so that a driver compiles the unrolled kernels in a moment.
SAMPLES = 7


@dataclass(frozen=True)
class Shot:
    """Points, the lobes on them and the light around them.

    Parameters
    ----------
    light : str
        Of `inputs.LIGHTS`.
    points : callable
        Makes the points.
    lobes : tuple of dict
        Arguments of `burnish.KurtLobe`.
    samples : int
        Of samplers that have a count.
    settings : dict of dict
        Further arguments of samplers, by name.
    is_alone : bool
        Whether a single lobe of regular or importance has the kernel of one lobe. Else a second lobe of
        weight 0 is beside it: most cases share a few kernels.
    """

    light: str = "smooth"
    points: Callable[[], Points] = around
    lobes: tuple[Mapping[str, Any], ...] = ({"roughness": 0.1},)
    samples: int = SAMPLES
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    is_alone: bool = False

    def make_lobes(self, is_alone: bool = True) -> list[_core.KurtLobe]:
        """Return the lobes as the engine takes them."""
        lobes = [_core.KurtLobe(**lobe) for lobe in self.lobes]
        if len(lobes) == 1 and not is_alone:
            lobes.append(_core.KurtLobe(**{**self.lobes[0], "weight": 0.0}))
        return lobes

    def make_sampler(self, name: str) -> Any:
        """Return the sampler of that name with this shot's settings."""
        return make_sampler(name, self.samples, **self.settings.get(name, {}))

    def measure(self, bench: Bench, sampler: str, **changes: Any) -> Any:
        """Shade it on the device; `changes` replace the light, the points or the lobes."""
        light = changes.get("light", self.light)
        shot = replace(self, lobes=changes["lobes"]) if "lobes" in changes else self
        points = changes.get("points", None) or self.points()
        is_alone = self.is_alone or sampler not in ("regular", "importance")
        return bench.shade(light, shot.make_lobes(is_alone), self.make_sampler(sampler), points)


def difference(got: ArrayLike, expected: ArrayLike, slack: float = 0.0) -> float:
    """Largest difference relative to a point's own radiance, or to the mean of all where that is more.

    Parameters
    ----------
    got, expected : (..., 3)
        Where all that is expected is black, the difference is absolute.
    slack : float
        What the device's lookups may differ by.
    """
    got, expected = np.asarray(got, np.float64), np.asarray(expected, np.float64)
    scale = np.maximum(np.abs(expected).max(axis=-1), np.abs(expected).mean())
    scale = np.where(scale > 0, scale, 1.0)
    beyond = np.maximum(np.abs(got - expected).max(axis=-1) - slack, 0.0)
    # What is not a number must not pass for a small one.
    return float(np.max(np.where(np.isfinite(got).all(axis=-1), beyond / scale, np.inf)))


def wild_count(radiance: ArrayLike) -> float:
    """How many values are not finite, or negative."""
    radiance = np.asarray(radiance)
    return float(np.count_nonzero(~(np.isfinite(radiance) & (radiance >= 0))))


def shot_of(light: str, points: Callable[[], Points], is_alone: bool = False, **lobe: Any) -> Shot:
    """A shot of one lobe, the regular pattern scaled by its own sum: the albedo's table hides no rounding."""
    return Shot(
        light, points, (lobe,), settings={"regular": {"normalization": "projected"}}, is_alone=is_alone
    )


def twin_error(shot: Shot) -> Quantity:
    """Error against the float64 twin of the sampler, on the levels that the device made of the map."""

    def measure(bench: Bench, sampler: str) -> float:
        got = shot.measure(bench, sampler)
        expected = bench.twin(shot.light, shot.make_lobes(), shot.make_sampler(sampler), shot.points())
        return difference(got, expected, bench.lookup_slack(shot.light))

    return Quantity("relative error against the float64 twin", measure, TWIN_BOUND)


def wild_values(shot: Shot) -> Quantity:
    """Count of values that no light has, those included that the engine stopped and made black."""

    def measure(bench: Bench, sampler: str) -> float:
        before = bench.stopped
        return wild_count(shot.measure(bench, sampler)) + bench.stopped - before

    return Quantity("values not finite or negative", measure, WILD_BOUND)


def largest_value(shot: Shot) -> Quantity:
    """Return the largest value where black is right; values that the engine made black count as 1."""

    def measure(bench: Bench, sampler: str) -> float:
        before = bench.stopped
        largest = float(np.max(np.abs(shot.measure(bench, sampler))))
        return largest + bench.stopped - before

    return Quantity("largest value where all is black", measure, Bound(0.0, "nothing is reflected"))


def same_picture(name: str, shot: Shot, other: Callable[[Bench, str], Any], bound: Bound) -> Quantity:
    """Difference from what another way of asking for the same gives."""

    def measure(bench: Bench, sampler: str) -> float:
        got, expected = shot.measure(bench, sampler), other(bench, sampler)
        return difference(got, expected, 2 * bench.lookup_slack(shot.light))

    return Quantity(name, measure, bound)


def furnace_error(shot: Shot, bound: Bound) -> Quantity:
    """Error of the radiance under a light of 1 against the exact albedo."""

    def measure(bench: Bench, sampler: str) -> float:
        normals, tangents, views = (p.astype(np.float64) for p in shot.points())
        bitangents = np.cross(normals, tangents)
        local = np.stack([np.sum(views * axis, axis=-1) for axis in (tangents, bitangents, normals)], axis=-1)
        lobe = shot.make_lobes()[0]
        parts = directional_albedo(local, lobe.roughness, lobe.alpha)
        expected = blend_albedo(parts, lobe.r0)
        if lobe.conserve_energy:
            expected = expected / np.maximum(parts[..., :1], 1.0)
        return difference(shot.measure(bench, sampler, light="uniform"), expected)

    return Quantity("relative error against the exact albedo", measure, bound)


def refusal(make: Callable[[str], Any]) -> Quantity:
    """1 where an argument is taken that means nothing, 0 where it is refused."""

    def measure(bench: Bench, sampler: str) -> float:
        try:
            make(sampler)
        except ValueError:
            return 0.0
        return 1.0

    return Quantity("taken instead of refused", measure, Bound(0.0, "ValueError names the range"))


def twin_case(
    name: str,
    why: str,
    source: str,
    bound: Bound | None = None,
    points: Callable[[], Points] = around,
    is_alone: bool = False,
    **lobe: Any,
) -> HardCase:
    """One lobe under smooth light against its twin; the reference knows no lobe narrower than a texel."""
    samplers = SAMPLERS if min(np.atleast_1d(lobe.get("roughness", 0.1))) >= 0.05 else BY_LOBE
    return HardCase(
        name, why, twin_error(shot_of("smooth", points, is_alone, **lobe)), source, samplers, bound
    )

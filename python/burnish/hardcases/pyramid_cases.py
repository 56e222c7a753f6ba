"""Levels of maps: seams across the twelve edges, constants, mean, the ends of half precision."""

import itertools
from functools import partial

import numpy as np

from burnish import _core
from burnish.filters import FILTERS
from burnish.hardcases.bench import Bench
from burnish.hardcases.case import ONCE, Bound, HardCase, Quantity
from burnish.hardcases.inputs import HALF_MAX, Float32, constant, one_texel, smooth, spoilt
from burnish.oracle.cube_map import border_indices, texel_solid_angle
from burnish.oracle.pyramid import Filter, reduce_level


def edge_steps(level: Float32) -> tuple[float, float]:
    """Largest step across any of the 12 edges, and the largest within a face."""
    size = level.shape[1]
    flat = level.reshape(-1, 3)
    inner, _ = border_indices(size, 1)
    own = np.arange(6 * size * size).reshape(6, size, size)
    across = 0.0
    for face in range(6):
        for mine, other in (
            (own[face, :, 0], inner[face, 1:-1, 0]),
            (own[face, :, -1], inner[face, 1:-1, -1]),
            (own[face, 0], inner[face, 0, 1:-1]),
            (own[face, -1], inner[face, -1, 1:-1]),
        ):
            across = max(across, float(np.abs(flat[mine] - flat[other]).max()))
    within = max(float(np.abs(np.diff(level, axis=axis)).max()) for axis in (1, 2))
    return across, within


def _levels(bench: Bench, faces: Float32, kind: str) -> list[Float32]:
    environment = _core.Environment.from_faces(faces)
    if kind == "prefiltered":
        return [level for _, level in _core.environment_prefiltered(bench.device, environment, "gauss6")]
    if kind == "matched":
        return _core.environment_spherical(bench.device, environment, "gauss6")
    return _core.environment_pyramid(bench.device, environment, kind)


def seam(kind: str) -> Quantity:
    """The worst level's ratio of steps across edges and within faces."""

    def measure(bench: Bench, sampler: str) -> float:
        maps = [_levels(bench, smooth(64, seed), kind) for seed in range(8)]
        worst = 0.0
        for same_level in zip(*maps, strict=True):
            if same_level[0].shape[1] >= 2:
                across, within = np.max([edge_steps(level) for level in same_level], axis=0)
                worst = max(worst, float(across / within))
        return worst

    reason = (
        "texels beside an edge are closer on the sphere than those in the middle of a face; the largest of 8 "
        "maps, since a level of 2 x 2 has few steps"
    )
    return Quantity("step across edges over step within faces", measure, Bound(1.0, reason))


def flatness(radiance: float, kind: str) -> Quantity:
    """Largest relative change of a constant over all levels."""

    def measure(bench: Bench, sampler: str) -> float:
        levels = _levels(bench, constant(radiance, 32), kind)
        first = levels[0].flat[0]
        return max(float(np.abs(level / first - 1).max()) for level in levels)

    dyadic = "weights of the filters are dyadic: a constant stays to the last bit"
    value = 0.0 if kind in FILTERS else 2.0**-10
    reason = dyadic if kind in FILTERS else "weights divided by their sum, rounded to a half float"
    return Quantity("relative change of a constant", measure, Bound(value, reason))


def rounding(kind: Filter) -> Quantity:
    """Largest error of a level against the filter of the one above, in units of a half float's last digit."""

    def measure(bench: Bench, sampler: str) -> float:
        levels = _levels(bench, one_texel(1000.0, 0.125, 64), kind)
        worst = 0.0
        for finer, level in itertools.pairwise(levels):
            exact = reduce_level(finer, kind)
            step = 2.0 ** (np.floor(np.log2(np.maximum(np.abs(exact), 2.0**-14))) - 10)
            worst = max(worst, float((np.abs(level - exact) / step).max()))
        return worst

    reason = "rounded to the nearest half float, of a sum in float32 whose error is a thousandth of that"
    return Quantity("error in half floats' last digit", measure, Bound(0.51, reason))


def mean_change(kind: str) -> Quantity:
    """Relative change of the mean over the sphere from level 0 to the coarsest."""

    def measure(bench: Bench, sampler: str) -> float:
        levels = _levels(bench, smooth(64), kind)
        first, last = (
            np.sum(level.astype(np.float64) * texel_solid_angle(level.shape[1])[..., None], axis=(0, 1, 2))
            for level in (levels[0], levels[-1])
        )
        return float(np.abs(last / first - 1).max())

    reason = (
        "filters weigh texels alike whose solid angles differ by up to 5: some per cent of a map's contrast"
    )
    return Quantity("relative change of the mean", measure, Bound(0.06, reason))


def broken_texels(faces: Float32, kind: str) -> Quantity:
    """Texels of all levels that are not finite, negative or above half floats."""

    def measure(bench: Bench, sampler: str) -> float:
        levels = _levels(bench, faces, kind)
        return float(sum(np.count_nonzero(~((level >= 0) & (level <= HALF_MAX))) for level in levels))

    return Quantity("texels not finite, negative or above 65504", measure, Bound(0.0, "no such texel"))


def _cases() -> list[HardCase]:
    kinds = (*FILTERS, "prefiltered", "matched")
    once = partial(HardCase, source="maths 5", samplers=ONCE)
    return [
        *(once(f"seams, levels of {k}", "filters that stop at the edge of a face", seam(k)) for k in kinds),
        *(once(f"constant, levels of {k}", "weights that do not sum to 1", flatness(0.7, k)) for k in kinds),
        *(
            once(f"rounding, levels of {k}", "stores to RGBA16F truncate: 0.25 % darker", rounding(k))
            for k in FILTERS
        ),
        *(once(f"mean, levels of {k}", "light that gets lost", mean_change(k)) for k in FILTERS),
        *(
            once(
                f"65504 and a NaN, levels of {k}",
                "inf - inf",
                broken_texels(np.maximum(spoilt(np.nan), HALF_MAX), k),
            )
            for k in kinds
        ),
    ]


CASES = _cases()

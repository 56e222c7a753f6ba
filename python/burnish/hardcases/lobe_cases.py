"""Lobes: from a mirror to the widest, and as brushed as there are."""

from typing import Any

import numpy as np

from burnish import _core
from burnish.hardcases.bench import Bench, make_sampler
from burnish.hardcases.bounds import BRUSHED_BOUND
from burnish.hardcases.case import BY_LOBE, Bound, HardCase, Quantity
from burnish.hardcases.inputs import around
from burnish.hardcases.quantities import SAMPLES, Shot, difference, twin_case, twin_error
from burnish.oracle.cube_map import sample_cube

WITH_COUNTS = ("regular", "importance", "matched")
LADDER = (1e-6, 1e-5, 1e-4, 1e-3)


def mirror_error(roughnesses: tuple[float, ...]) -> Quantity:
    """Difference from the mirror picture, the largest over a ladder of ever narrower lobes."""

    def measure(bench: Bench, sampler: str) -> float:
        # The reference's sum over texels knows no lobe narrower than a texel; its other way does.
        how: Any = make_sampler(sampler, SAMPLES)
        if sampler == "reference":
            how = _core.Reference(standard_error=0.01, method="progressive", max_samples=1024)
        # Of Hammersley's points the first lies in the lobe's far tail: it stands for a wide part of the map.
        if sampler == "importance":
            how = _core.Importance(SAMPLES, points="fibonacci")
        points = around(least_cos=0.3)
        normals, _, views = (p.astype(np.float64) for p in points)
        cos_o = np.sum(normals * views, axis=-1, keepdims=True)
        level = bench.light("smooth").pyramid(device=bench.device)[:1]
        mirror = sample_cube(level, 2 * cos_o * normals - views) * cos_o
        slack = 2 * bench.lookup_slack("smooth")
        return max(
            difference(
                bench.shade("smooth", [_core.KurtLobe(roughness=m)] * 2, how, points), 2 * mirror, slack
            )
            for m in roughnesses
        )

    reason = (
        "a lobe of slope 1e-3 shows a map that changes by 2 within a radian 1e-3 radian wide; patterns are "
        "symmetric to the first order, 7 Fibonacci points and the reference's 1024 random ones are not"
    )
    values = dict.fromkeys(BY_LOBE, 2e-4) | {"importance": 5e-3, "reference": 5e-3}
    return Quantity("relative error against a mirror", measure, Bound(values, reason))


def agreement(roughness: float, samplers: dict[str, float]) -> Quantity:
    """Difference from the sum over every texel with as many samples as there may be."""

    def measure(bench: Bench, sampler: str) -> float:
        lobes, points = [_core.KurtLobe(roughness=roughness)], around(least_cos=0.3)
        truth = bench.shade("smooth", lobes, make_sampler("reference"), points)
        most = {"regular": 1024, "importance": 1024, "matched": 64}.get(sampler, 14)
        settings = {"threshold": 1e-4} if sampler == "regular" else {}
        got = bench.shade("smooth", lobes, make_sampler(sampler, most, **settings), points)
        return float(np.sqrt(np.mean((got - truth) ** 2) / np.mean(truth.astype(np.float64) ** 2)))

    reason = (
        "1024 samples: the pattern's end at q = 1e-4, lookups' own widths, texels that are bilinear here and "
        "points there; matched has 64 samples at most and 2 % at roughness 1"
    )
    return Quantity("relative RMSE against every texel", measure, Bound(samplers, reason))


def _published(name: str, why: str, roughness: float, threshold: float) -> HardCase:
    settings = {"threshold": threshold, "footprint": "published", "normalization": "published"}
    shot = Shot("smooth", around, ({"roughness": roughness},), settings={"regular": settings})
    return HardCase(f"published footprint, {name}", why, twin_error(shot), "RS eqs. 14-16", ("regular",))


def roughness_cases() -> list[HardCase]:
    """Lobes from a mirror to the widest, and as brushed as there are."""
    return [
        HardCase(
            "roughness 1e-6 to 1e-3: a mirror",
            "tan^2 from 1/cos^2 - 1 and acos of a dot product lose all digits",
            mirror_error(LADDER),
            "maths 7",
        ),
        twin_case("roughness 1e-6", "areas of 1e-12, densities of 1e12", "maths 7", roughness=1e-6),
        twin_case(
            "roughness 1e-3",
            "acos(dot) is 0 for most views: level -inf",
            "maths 7, RS eq. 14",
            roughness=1e-3,
        ),
        twin_case("roughness 0.01", "acos(dot) is 7 % off", "maths 7", roughness=0.01),
        twin_case("roughness 0.1", "where samplers are usually used", "RS", is_alone=True, roughness=0.1),
        twin_case("roughness 0.5", "tan(alpha) of eq. 15 passes 90 degrees", "maths 7", roughness=0.5),
        twin_case(
            "roughness 1", "half-vectors near the horizon: D is 0/0", "maths 7", is_alone=True, roughness=1.0
        ),
        twin_case(
            "aspect 10",
            "one axis as narrow as a texel",
            "RS section 5",
            BRUSHED_BOUND,
            is_alone=True,
            roughness=(0.5, 0.05),
            rotation=0.4,
        ),
        twin_case(
            "aspect 34",
            "the end of matched's table",
            "maths 6",
            BRUSHED_BOUND,
            roughness=(0.34, 0.01),
            rotation=0.4,
        ),
        twin_case(
            "aspect 100",
            "axes of the mirrored lobe by cancellation",
            "maths 6",
            BRUSHED_BOUND,
            roughness=(0.1, 0.001),
            rotation=-2.0,
        ),
        twin_case(
            "aspect 1000",
            "mx my of 1e-3, past every table",
            "issue",
            BRUSHED_BOUND,
            roughness=(1.0, 0.001),
            rotation=1.0,
        ),
        twin_case(
            "aspect 1000, across",
            "the other axis",
            "issue",
            BRUSHED_BOUND,
            roughness=(0.001, 1.0),
            rotation=1.0,
        ),
        _published("roughness 1", "tan(alpha) of eq. 15 past 90 degrees: a negative area", 1.0, 0.01),
        _published("roughness 1e-3", "acos of a dot product of nearly 1: an area of 0", 1e-3, 0.2),
        HardCase(
            "samplers agree, roughness 0.1",
            "one image, many ways",
            agreement(0.1, {"regular": 0.003, "importance": 0.004, "matched": 0.002}),
            "maths 3",
            WITH_COUNTS,
        ),
        HardCase(
            "samplers agree, roughness 1",
            "the widest lobe, next to diffuse",
            agreement(1.0, {"regular": 0.006, "importance": 0.004, "matched": 0.025}),
            "maths 3",
            WITH_COUNTS,
        ),
    ]


CASES = roughness_cases()

"""Light: spots, suns, darkness, values that no light has, the smallest and the largest maps."""

from functools import partial
from typing import Any

import numpy as np

from burnish import _core
from burnish.environments import cube_directions
from burnish.hardcases.bench import Bench
from burnish.hardcases.case import BY_LOBE, ONCE, SAMPLERS, Bound, HardCase, Quantity
from burnish.hardcases.inputs import (
    HALF_MAX,
    SUN,
    Float32,
    Points,
    around,
    constant,
    float32,
    mirroring,
    one_texel,
    unit,
)
from burnish.hardcases.quantities import (
    Shot,
    difference,
    largest_value,
    shot_of,
    twin_error,
    wild_count,
    wild_values,
)
from burnish.rendering import shade

LOBE: dict[str, Any] = {"roughness": 0.1, "alpha": 0.5}


def about_the_texel() -> Points:
    """Points that mirror the view into the one bright texel and around it."""
    middle = cube_directions(32)[4, 1, 1]
    rng = np.random.default_rng(2)
    return mirroring(unit(middle + rng.normal(0, 0.06, (12, 3))))


def about_the_sun() -> Points:
    """Points that mirror the view within some degrees of the sun of half a degree."""
    return mirroring(unit(unit(SUN) + np.random.default_rng(2).normal(0, 0.05, (12, 3))))


def into_the_texel() -> Points:
    """Points that mirror the view within 1e-3 radian of the middle of the one bright texel."""
    middle = cube_directions(32)[4, 1, 1]
    rng = np.random.default_rng(2)
    return mirroring(unit(middle + rng.normal(0, 5e-4, (12, 3))))


def diffuse_error(bench: Bench, sampler: str) -> float:
    """Values of a diffuse surface, in both forms, that are not finite or negative, all around a sun."""
    environment = _core.Environment.from_faces(one_texel(HALF_MAX))
    normals = float32(cube_directions(8).reshape(-1, 3))
    material = _core.Material(diffuse=(1.0, 0.5, 0.1))
    return sum(
        wild_count(shade(environment, material, one, normals, normals, normals, device=bench.device))
        for one in (_core.Regular(), _core.Regular(diffuse="harmonics"))
    )


def scaled_light(factor: float) -> Quantity:
    """Difference of the picture under k times the light from k times the picture."""

    def measure(bench: Bench, sampler: str) -> float:
        shot = Shot("uniform", around, (LOBE,))
        other = _core.Environment.from_faces(constant(factor))
        got = shot.measure(bench, sampler, light=other).astype(np.float64) / factor
        return difference(got, shot.measure(bench, sampler))

    reason = "a constant survives every filter, and a factor rounds a sum of 7 samples some 20 times by 6e-8"
    return Quantity("relative difference from the picture under 1", measure, Bound(3e-6, reason))


def linear_light(face_size: int) -> Float32:
    """Radiance that is linear in the direction: at any size the same light."""
    centers = float32((2 * np.arange(face_size) + 1) / face_size - 1)
    u, v = np.meshgrid(centers, centers)
    one = np.ones_like(u)
    half = np.float32(0.5) / np.sqrt(u * u + v * v + 1)
    faces = [(one, -v, -u), (-one, -v, u), (u, one, v), (u, -one, -v), (u, -v, one), (-u, -v, -one)]
    return np.stack([np.stack([1 + half * c for c in face], axis=-1) for face in faces])


def size_error(sampler_light: int) -> Quantity:
    """Difference between a map of faces of 2048 and one of 64 of the same light."""

    def measure(bench: Bench, sampler: str) -> float:
        shot = Shot("uniform", partial(around, 48, 0.2), ({"roughness": 0.2},))
        small, large = (
            shot.measure(bench, sampler, light=_core.Environment.from_faces(linear_light(size)))
            for size in (64, sampler_light)
        )
        return difference(large, small)

    reason = "light linear in the direction: bilinear lookups and levels of either map are within 5e-4 of it"
    return Quantity("relative difference from faces of 64", measure, Bound(1e-3, reason))


def map_cases() -> list[HardCase]:
    """Maps that break filters and sums, with every sampler."""
    spot_bound = Bound(
        {"regular": 5e-5, "importance": 5e-5, "matched": 1e-3, "prefiltered": 1e-4, "reference": 1e-3},
        "a texel of 65504 over black: radiance changes by 1e5 within a texel, in which a lookup is placed "
        "within 1e-6 of its face; matched takes it for a sun, whose lobe of slope 1e-3 lies within roundings "
        "of the half-vector; the reference as ever",
    )
    table = Bound(
        {"regular": 5e-6, "importance": 5e-6, "matched": 2e-4, "prefiltered": 2e-4, "reference": 1.2e-3},
        "as ever; the albedo's table is within 2e-4 for a round lobe of alpha 0.5",
        corners=1e-4,
    )
    return [
        HardCase(
            "spot of one texel",
            "a lobe sees all or nothing",
            twin_error(shot_of("one texel", about_the_texel, **LOBE)),
            "maths 9",
            SAMPLERS,
            spot_bound,
        ),
        HardCase(
            "spot of one texel, mirror",
            "level 0, nothing averaged",
            twin_error(shot_of("one texel", about_the_texel, roughness=1e-3)),
            "maths 9",
            BY_LOBE,
            spot_bound,
        ),
        HardCase(
            "lobe of slope 1e-3 about a texel",
            "tan^2 by a difference is 7 % off",
            twin_error(shot_of("one texel", into_the_texel, roughness=1e-3)),
            "maths 7",
            ("reference",),
            Bound(
                3e-3,
                "half-vectors within 6e-8 of slopes of 1e-3: exponents to 3 within 4e-4; texels as ever",
            ),
        ),
        HardCase(
            "diffuse part under a sun",
            "nine harmonics ring below 0",
            Quantity("values not finite or negative", diffuse_error, Bound(0.0, "light is never negative")),
            "SH",
            ONCE,
        ),
        HardCase(
            "sun of half a degree, split off",
            "a point of light that a narrow lobe sees or does not",
            twin_error(shot_of("sun of half a degree", about_the_sun, roughness=0.02)),
            "maths 6",
            ("matched",),
            Bound(
                1e-3, "a lobe of slope 0.02, as wide as the sun makes it, within roundings of the half-vector"
            ),
        ),
        HardCase(
            "sun of 1e7",
            "beyond half floats: inf, then NaN in every level",
            twin_error(shot_of("sun", about_the_texel, **LOBE)),
            "maths 7",
            SAMPLERS,
            spot_bound,
        ),
        HardCase(
            "sun of 1e7, all values",
            "inf * 0",
            wild_values(Shot("sun", partial(around, 96), (LOBE, {"roughness": 1.0}))),
            "maths 7",
        ),
        HardCase(
            "map of zeros",
            "0/0 where sums are divided",
            largest_value(Shot("black", around, (LOBE,))),
            "issue",
        ),
        HardCase(
            "one NaN texel",
            "poisons every level",
            wild_values(Shot("NaN", partial(around, 96), (LOBE, {"roughness": 1.0}))),
            "maths 7",
        ),
        HardCase(
            "one infinite texel",
            "inf - inf in every filter",
            wild_values(Shot("infinite", partial(around, 96), (LOBE, {"roughness": 1.0}))),
            "maths 7",
        ),
        HardCase(
            "one negative texel",
            "dark blooms",
            wild_values(Shot("negative", partial(around, 96), (LOBE, {"roughness": 1.0}))),
            "maths 7",
        ),
        HardCase("65504 everywhere", "a sum of two overflows half floats", scaled_light(HALF_MAX), "maths 7"),
        HardCase(
            "2^-24 everywhere",
            "the smallest half float: squares of it vanish",
            scaled_light(2.0**-24),
            "maths 7",
        ),
        HardCase(
            "light of 1e-5",
            "subnormal half floats",
            twin_error(shot_of("faint", around, **LOBE)),
            "maths 7",
            SAMPLERS,
            table,
        ),
        HardCase(
            "faces of 1 texel",
            "no level below, no neighbour within the face",
            twin_error(shot_of("faces of 1", around, **LOBE)),
            "issue",
            BY_LOBE,
            table,
        ),
        HardCase(
            "faces of 2 texels",
            "filters wider than a face",
            twin_error(shot_of("faces of 2", around, **LOBE)),
            "issue",
            BY_LOBE,
            table,
        ),
        HardCase(
            "faces of 2048 texels",
            "more texels than float32 counts",
            size_error(2048),
            "driver facts",
            ("regular",),
        ),
    ]


CASES = map_cases()

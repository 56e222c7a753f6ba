"""Loaders: what they repair, and that they say so."""

from collections.abc import Callable

import numpy as np

from burnish import _core
from burnish.hardcases.bench import Bench
from burnish.hardcases.case import ONCE, Bound, HardCase, Quantity
from burnish.hardcases.inputs import HALF_MAX, Float32, spoilt
from burnish.oracle.cube_map import texel_solid_angle


def repaired(faces: Callable[[], Float32], count: str, value: float) -> Quantity:
    """How far the report and the texel are from what they must be."""

    def measure(bench: Bench, sampler: str) -> float:
        environment = _core.Environment.from_faces(faces())
        texel = environment.faces[2, 5, 6, 1]
        reported = getattr(environment.texel_report, count)
        return float(abs(reported - 1) + abs(texel - np.float32(value)))

    return Quantity(
        "texels not counted or not repaired", measure, Bound(0.0, "one texel, and what it becomes")
    )


def lat_long_sun_error(bench: Bench, sampler: str) -> float:
    """Light lost of a sun above half floats whose mean over a texel of the cube is below."""
    image = np.zeros((256, 512, 3), np.float32)
    image[100, 200] = 1e6
    environment = _core.Environment.from_lat_long(image, face_size=16)
    polar = np.pi * (np.arange(257)) / 256
    band = np.cos(polar[100]) - np.cos(polar[101])
    sent = 1e6 * band * 2 * np.pi / 512
    kept = float(np.sum(environment.faces[..., 0].astype(np.float64) * texel_solid_angle(16)))
    return abs(kept / float(sent) - 1)


def loader_cases() -> list[HardCase]:
    """What loaders repair and say."""
    return [
        HardCase(
            "NaN texel, loaded",
            "spreads over the map",
            repaired(lambda: spoilt(np.nan), "not_a_number", 0.0),
            "maths 7",
            ONCE,
        ),
        HardCase(
            "infinite texel, loaded",
            "spreads over the map",
            repaired(lambda: spoilt(np.inf), "infinite", HALF_MAX),
            "maths 7",
            ONCE,
        ),
        HardCase(
            "texel of -infinity, loaded",
            "spreads over the map",
            repaired(lambda: spoilt(-np.inf), "infinite", 0.0),
            "maths 7",
            ONCE,
        ),
        HardCase(
            "negative texel, loaded",
            "light that takes light away",
            repaired(lambda: spoilt(-5.0), "negative", 0.0),
            "maths 7",
            ONCE,
        ),
        HardCase(
            "texel of 1e7, loaded",
            "inf in half floats",
            repaired(lambda: spoilt(1e7), "above_half", 1e7),
            "maths 7",
            ONCE,
        ),
        HardCase(
            "lat-long sun of 1e6",
            "clamped before it is averaged: most of its light is lost",
            Quantity(
                "share of its light lost",
                lat_long_sun_error,
                Bound(1e-6, "areas in double; the mean is rounded to float32 once a texel"),
            ),
            "maths 7",
            ONCE,
        ),
    ]


CASES = loader_cases()

"""Frames and lookups: tangents, normals, lengths, edges, corners, levels, counts and thresholds."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from burnish import _core
from burnish.hardcases.bench import make_sampler
from burnish.hardcases.bounds import BRUSHED_BOUND
from burnish.hardcases.case import BY_LOBE, SAMPLERS, Bound, HardCase
from burnish.hardcases.inputs import (
    CORNERS,
    EDGES,
    Points,
    around,
    float32,
    mirroring,
    seen_at,
    with_tangents,
)
from burnish.hardcases.quantities import Shot, refusal, shot_of, twin_error, wild_values

Settings = dict[str, dict[str, Any]]
BRUSHED: dict[str, Any] = {"roughness": (0.3, 0.1), "rotation": 0.4}


def _scaled(lengths: tuple[float, float, float]) -> Points:
    """Points whose normals, tangents and views have these lengths."""
    normals, tangents, views = (float32(p * np.float64(k)) for p, k in zip(around(), lengths, strict=True))
    return normals, tangents, views


def _parallel(tilt: float, sign: float = 1.0) -> Points:
    """Tangents along the normals but for a tilt."""
    points = around()
    side = np.cross(points[0], points[2])
    return with_tangents(points, sign * points[0] + tilt * side)


def _downward(z: float) -> Points:
    """Normals about straight down, tilted to z within rounding: where frames built around +z break."""
    points = seen_at((0.7,))
    down = points[0][:, 2] < -0.5
    tilted = [float32(p[down]) for p in points]
    tilted[0][:, 0] += np.float32(np.sqrt(max(0.0, 1 - z * z)))
    return tilted[0], float32(0 * tilted[1]), tilted[2]


def _level_slope(name: str, why: str, bias: float, source: str = "maths 7") -> HardCase:
    settings: Settings = {
        "regular": {"mip_bias": bias, "normalization": "projected"},
        "importance": {"mip_bias": bias},
    }
    shot = Shot("noise", around, ({"roughness": 0.3},), settings=settings)
    return HardCase(name, why, twin_error(shot), source, ("regular", "importance"))


def _counts(name: str, why: str, samples: int, matched: int | None) -> HardCase:
    shot = Shot("smooth", around, ({"roughness": 0.2},), samples, {"regular": {"normalization": "projected"}})
    samplers = ("regular", "importance", "matched")[: 2 if matched is None else 3]
    return HardCase(name, why, twin_error(shot), "RS section 5", samplers)


def _threshold(value: float, why: str) -> HardCase:
    settings = {"regular": {"threshold": value, "normalization": "projected"}}
    shot = Shot("smooth", around, ({"roughness": (0.3, 0.2)},), settings=settings)
    return HardCase(f"threshold {value:g}", why, twin_error(shot), "RS eq. 11", ("regular",))


def _no_samples(sampler: str) -> Any:
    if sampler == "reference":
        return _core.Reference(standard_error=0.0)
    return make_sampler(sampler, 0)


def frame_cases() -> list[HardCase]:
    """Tangents, normals and views as meshes and callers give them."""

    def twin(
        name: str, why: str, points: Callable[[], Points], source: str = "maths 7", **lobe: Any
    ) -> HardCase:
        return HardCase(
            name,
            why,
            twin_error(shot_of("smooth", points, **(lobe or BRUSHED))),
            source,
            SAMPLERS,
            BRUSHED_BOUND,
        )

    round_lobe: dict[str, Any] = {"roughness": 0.1}
    loose = Bound(
        {"regular": 1e-4, "importance": 2e-3, "matched": 1e-4, "prefiltered": 1e-4, "reference": 1.2e-3},
        "what is left of the tangent is 3e-3 off by rounding; a round lobe does not mind, but for the "
        "pattern's azimuth",
    )
    return [
        twin("tangent zero", "0/0 in its length", lambda: with_tangents(around(), 0.0)),
        twin("tangent along the normal", "what is left of it is rounding", partial(_parallel, 0.0)),
        twin("tangent against the normal", "the same", partial(_parallel, 0.0, -1.0)),
        twin(
            "tangent 1e-3 off the normal",
            "one Gram-Schmidt step keeps a share of the normal",
            partial(_parallel, 1e-3),
        ),
        HardCase(
            "tangent 2e-5 off the normal, round lobe",
            "the same: a frame that is not orthogonal",
            twin_error(shot_of("smooth", partial(_parallel, 2e-5), **round_lobe)),
            "maths 7",
            SAMPLERS,
            loose,
        ),
        twin("tangent of length 1e30", "its square overflows", partial(_scaled, (1.0, 1e30, 1.0))),
        twin("tangent of length 1e-30", "its square vanishes", partial(_scaled, (1.0, 1e-30, 1.0))),
        twin(
            "normals of length 0.3",
            "interpolated ones are shorter than 1",
            partial(_scaled, (0.3, 1.0, 1.0)),
            **round_lobe,
        ),
        twin(
            "normals of length 1e-20",
            "the square vanishes",
            partial(_scaled, (1e-20, 1.0, 1.0)),
            **round_lobe,
        ),
        twin(
            "views of length 1e20", "the square overflows", partial(_scaled, (1.0, 1.0, 1e20)), **round_lobe
        ),
        twin("normal straight down", "a basis around +z divides by 1 + n.z = 0", partial(_downward, -1.0)),
        twin("normal 1e-4 off straight down", "1 + n.z of 5e-9", partial(_downward, -1 + 5e-9)),
        twin("normals along the axes", "components of zero, of either sign", partial(seen_at, (0.7,))),
        HardCase(
            "normal zero",
            "no direction at all",
            wild_values(Shot("spots", partial(_scaled, (0.0, 1.0, 1.0)), (BRUSHED,))),
            "issue",
        ),
        HardCase(
            "view zero",
            "no direction at all",
            wild_values(Shot("spots", partial(_scaled, (1.0, 1.0, 0.0)), (BRUSHED,))),
            "issue",
        ),
    ]


def lookup_cases() -> list[HardCase]:
    """Where on the map a lookup falls, how wide it is, and how many there are."""
    edges, corners = partial(mirroring, EDGES), partial(mirroring, CORNERS)
    mirror: dict[str, Any] = {"roughness": 1e-3}
    wide: dict[str, Any] = {"roughness": 0.3, "alpha": 0.5}
    corner = Bound(
        {"regular": 1e-5, "importance": 1e-5, "matched": 1e-5, "prefiltered": 1e-5},
        "a lookup placed within 1e-6 of its face; the software lookup is up to 1.2e-4 off at a corner itself",
        corners=1.2e-4,
    )
    cube = partial(mirroring, np.concatenate([np.eye(3), -np.eye(3)]))
    return [
        HardCase(
            "lookups on the 12 edges",
            "a direction on two faces at once",
            twin_error(shot_of("smooth", edges, **mirror)),
            "maths 5",
            BY_LOBE,
        ),
        HardCase(
            "lookups on the 8 corners",
            "three faces, no fourth texel",
            twin_error(shot_of("noise", corners, **mirror)),
            "maths 5",
            BY_LOBE,
            corner,
        ),
        HardCase(
            "wide lobes about the edges",
            "levels of few texels across an edge",
            twin_error(shot_of("noise", edges, **wide)),
            "maths 5",
        ),
        HardCase(
            "wide lobes about the corners",
            "levels of few texels across a corner",
            twin_error(shot_of("noise", corners, **wide)),
            "maths 5",
        ),
        HardCase(
            "lookups along the axes",
            "components of exactly zero",
            twin_error(shot_of("noise", cube, **mirror)),
            "maths 5",
            BY_LOBE,
        ),
        _level_slope("levels 16 below the finest", "log2 of a negative level's size", -16.0),
        _level_slope("levels 16 above the coarsest", "reads beyond the last level", 16.0),
        _counts("one sample", "a lobe of one lookup", 1, None),
        _counts("two samples", "the smallest mixture", 2, 2),
        _counts("64 samples", "the most of a mixture; patterns in a loop", 64, None),
        _counts("1024 samples", "the largest table", 1024, None),
        _threshold(1e-6, "half-vectors near the horizon"),
        _threshold(0.9, "a lobe cut to its peak"),
        _threshold(0.999999, "an area of next to nothing"),
        HardCase(
            "no samples",
            "a mean of nothing",
            refusal(_no_samples),
            "maths 7",
            ("regular", "importance", "matched", "reference"),
        ),
        HardCase(
            "threshold 0",
            "theta_max of 90 degrees",
            refusal(lambda _: _core.Regular(threshold=0.0)),
            "maths 7",
            ("regular",),
        ),
        HardCase(
            "threshold 1",
            "theta_max of 0",
            refusal(lambda _: _core.Regular(threshold=1.0)),
            "maths 7",
            ("regular",),
        ),
    ]


CASES = [*frame_cases(), *lookup_cases()]

"""What must stay the same: energy, scale, rotation, mirror images, repetition, order."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from burnish import _core
from burnish.hardcases.bench import Bench
from burnish.hardcases.bounds import SAME_BITS
from burnish.hardcases.case import SAMPLERS, Bound, HardCase, Quantity
from burnish.hardcases.inputs import Float32, Points, around, float32, seen_at, smooth, turned, with_tangents
from burnish.hardcases.quantities import Shot, difference, furnace_error, same_picture
from burnish.oracle.cube_map import cube_face_uv, texel_directions
from burnish.oracle.reference import LEAST_QUADRATURE_FACE

QUARTER_TURNS = {
    "x": np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]),
    "y": np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
    "z": np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]),
}
MIRRORED = np.diag([-1, 1, 1])
BRUSHED: dict[str, Any] = {"roughness": (0.3, 0.1), "alpha": 0.5, "r0": (0.9, 0.5, 0.04)}
ROUND: dict[str, Any] = {"roughness": 0.2, "alpha": 0.5}
ROUNDINGS = (
    "the same numbers added in another order: some twenty roundings of 6e-8, and level fractions that follow"
)


def moved(faces: Float32, matrix: ArrayLike) -> Float32:
    """The map turned or mirrored by a matrix that maps axes to axes: texels change places, nothing else."""
    size = faces.shape[1]
    face, u, v = cube_face_uv(texel_directions(size) @ np.asarray(matrix, np.float64))
    column, row = (np.clip(((w + 1) / 2 * size).astype(int), 0, size - 1) for w in (u, v))
    return float32(faces[face, row, column])


def _after(shot: Shot, matrix: ArrayLike) -> Callable[[Bench, str], Any]:
    """The picture after map and points were moved together."""

    def shade(bench: Bench, sampler: str) -> Any:
        light = _core.Environment.from_faces(moved(smooth(), matrix))
        return shot.measure(bench, sampler, light=light, points=turned(shot.points(), matrix))

    return shade


def _turned_lookups(shot: Shot, angle: float) -> Callable[[Bench, str], Any]:
    """The picture with the map's own rotation, points turned along."""

    def shade(bench: Bench, sampler: str) -> Any:
        c, s = np.cos(angle), np.sin(angle)
        matrix = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
        light = _core.Environment.from_faces(smooth(), rotation=matrix)
        return shot.measure(bench, sampler, light=light, points=turned(shot.points(), matrix))

    return shade


def scale_error(factor: float, exposure: float, bound: Bound) -> Quantity:
    """Difference of k times the picture from the picture under k times the light."""

    def measure(bench: Bench, sampler: str) -> float:
        shot = Shot("smooth", around, (BRUSHED,))
        light = _core.Environment.from_faces(smooth() * np.float32(factor), exposure=exposure)
        got = shot.measure(bench, sampler, light=light).astype(np.float64) / (factor * 2.0**exposure)
        return difference(got, shot.measure(bench, sampler))

    return Quantity("relative difference from the scaled picture", measure, bound)


def energy_excess(bench: Bench, sampler: str) -> float:
    """Most that a white lobe of alpha 0 gives back of a light of 1, over all angles."""
    points = partial(seen_at, (1.0, 0.9, 0.5, 0.1, 0.01))
    return max(
        float(Shot("uniform", points, ({"roughness": m},), 256).measure(bench, sampler).max())
        for m in (0.1, 1.0)
    )


def reordered(bench: Bench, sampler: str) -> float:
    """Difference after points were shaded in another order."""
    shot = Shot("smooth", partial(around, 96), (ROUND,))
    order = np.random.default_rng(1).permutation(96)
    points = shot.points()
    mixed: Points = (points[0][order], points[1][order], points[2][order])
    return difference(shot.measure(bench, sampler, points=mixed), shot.measure(bench, sampler)[order])


def repeated(bench: Bench, sampler: str) -> float:
    """Share of values that differ in any bit when the same is asked for twice."""
    shot = Shot("spots", partial(around, 96), (BRUSHED,))
    first, second = (shot.measure(bench, sampler) for _ in range(2))
    return float(np.mean(first != second))


def reciprocity_error(bench: Bench, sampler: str) -> float:
    """Difference of f(i, o) and f(o, i): light in one texel and the eye in another's middle, and swapped."""
    lobes = [_core.KurtLobe(roughness=(0.5, 0.3), alpha=0.5, r0=0.04, rotation=0.3)]
    size = LEAST_QUADRATURE_FACE  # texels of coarser maps are taken in parts
    directions = texel_directions(size)
    texels = [((4, 28, 44), (2, 52, 28)), ((4, 12, 12), (0, 36, 20)), ((2, 36, 52), (4, 20, 20))]
    normal, tangent = float32([[0.2, 0.5, 0.8]]), float32([[1.0, 0.0, 0.0]])
    normal /= np.linalg.norm(normal)
    worst = 0.0
    for pair in texels:
        values = []
        for lit, eye in (pair, pair[::-1]):
            faces = np.zeros((6, size, size, 3), np.float32)
            faces[lit] = 1024.0
            view = float32(directions[eye][None])
            light = _core.Environment.from_faces(faces)
            got = bench.shade(light, lobes, _core.Reference(method="quadrature"), (normal, tangent, view))
            solid_angle = np.max(np.abs(directions[lit])) ** 3
            values.append(float(got[0, 0]) / (solid_angle * float(directions[lit] @ normal[0])))
        worst = max(worst, abs(values[0] / values[1] - 1))
    return worst


def energy_cases() -> list[HardCase]:
    """What comes back of a light of 1."""

    def furnace(name: str, why: str, **lobe: Any) -> HardCase:
        bound = Bound(
            {"regular": 2e-4, "importance": 0.03, "prefiltered": 2e-4},
            "the albedo's table, within 2e-4; 256 Hammersley points",
        )
        shot = Shot("uniform", partial(seen_at, (1.0, 0.7, 0.3, 0.1)), (lobe,), 256)
        samplers = ("regular", "importance", "prefiltered")
        return HardCase(name, why, furnace_error(shot, bound), "maths 1", samplers)

    return [
        furnace("furnace, alpha 0", "published pattern: 13 % low at roughness 0.6", roughness=0.6),
        furnace("furnace, alpha 0.5", "the albedo about 1", roughness=0.3, alpha=0.5),
        furnace("furnace, alpha 1", "gains energy: 1/cos_o", roughness=0.3, alpha=1.0),
        furnace(
            "furnace, kept energy",
            "divided by the albedo where that exceeds 1",
            roughness=0.3,
            alpha=1.0,
            conserve_energy=True,
        ),
        HardCase(
            "energy of alpha 0",
            "a sum of weights beyond 1",
            Quantity("most of a light of 1", energy_excess, Bound(1.0, "the model promises it for alpha 0")),
            "maths 1",
            ("regular", "importance", "prefiltered"),
        ),
        HardCase(
            "reciprocity",
            "a lobe that is not symmetric loses or gains by path",
            Quantity(
                "relative difference of f(i, o) and f(o, i)",
                reciprocity_error,
                Bound(1e-5, "exp is 10 ULP off, of exponents to 10"),
            ),
            "RS eq. 1",
            ("reference",),
        ),
    ]


def symmetry_cases() -> list[HardCase]:
    """Scale, rotation, mirror images, repetition and order."""
    brushed = Shot("smooth", around, (BRUSHED,))
    round_shot = Shot("smooth", around, (ROUND,))
    two = Shot("smooth", around, (BRUSHED, ROUND))
    rounding = Bound(2e-5, ROUNDINGS)
    turn_bound = Bound(
        {**dict.fromkeys(SAMPLERS, 2e-5), "matched": 1.5e-3, "prefiltered": 1.2e-2},
        f"{ROUNDINGS}; samples that make prefiltered maps, 1 %, and matched's, 1e-3, are placed in a basis "
        "that knows the z axis",
    )
    other_lanes = Bound(
        5e-7,
        "none with the software lookup; in lavapipe's sampler the last digit depends on what other lanes "
        "read",
    )
    half = Bound(1.5e-3, "half floats round each texel and each level once, by 2^-11")

    def same(
        name: str,
        why: str,
        shot: Shot,
        other: Callable[[Bench, str], Any],
        bound: Bound,
        samplers: tuple[str, ...] = SAMPLERS,
    ) -> HardCase:
        return HardCase(name, why, same_picture("relative difference", shot, other, bound), "issue", samplers)

    def order(bench: Bench, sampler: str) -> Any:
        return two.measure(bench, sampler, lobes=two.lobes[::-1])

    def halves(bench: Bench, sampler: str) -> Any:
        return round_shot.measure(bench, sampler, lobes=tuple({**ROUND, "weight": w} for w in (0.25, 0.75)))

    def about_normal(bench: Bench, sampler: str) -> Any:
        normals, tangents, _ = points = round_shot.points()
        return round_shot.measure(bench, sampler, points=with_tangents(points, np.cross(normals, tangents)))

    def half_turn(bench: Bench, sampler: str) -> Any:
        return brushed.measure(bench, sampler, lobes=({**BRUSHED, "rotation": np.pi},))

    def swapped(bench: Bench, sampler: str) -> Any:
        normals, tangents, _ = points = brushed.points()
        lobe = BRUSHED | {"roughness": BRUSHED["roughness"][::-1]}
        across = with_tangents(points, np.cross(tangents, normals))
        return brushed.measure(bench, sampler, points=across, lobes=(lobe,))

    symmetric = ("matched", "prefiltered", "reference")
    return [
        HardCase(
            "light times 2^10",
            "scale that is not carried through",
            scale_error(2.0**10, 0.0, SAME_BITS),
            "issue",
        ),
        HardCase("light times 2^-6", "the same, downward", scale_error(2.0**-6, 0.0, SAME_BITS), "issue"),
        HardCase("light times 3", "through half precision", scale_error(3.0, 0.0, half), "issue"),
        HardCase("exposure of 20 stops", "a factor of a million", scale_error(1.0, 20.0, SAME_BITS), "issue"),
        *(
            same(
                f"a quarter turn about {axis}",
                "faces that are not alike",
                brushed,
                _after(brushed, turn),
                turn_bound,
            )
            for axis, turn in QUARTER_TURNS.items()
        ),
        same(
            "map turned, points along",
            "a rotation that is not the same everywhere",
            brushed,
            _turned_lookups(brushed, 0.7),
            rounding,
        ),
        same(
            "mirror image",
            "handedness",
            Shot("smooth", around, ({**BRUSHED},)),
            _after(brushed, MIRRORED),
            turn_bound,
            ("regular", *symmetric),
        ),
        same(
            "frame turned about the normal, round lobe",
            "a pattern that depends on the tangent",
            round_shot,
            about_normal,
            rounding,
            symmetric,
        ),
        same(
            "brushed lobe turned by half a turn",
            "a lobe that is not symmetric",
            brushed,
            half_turn,
            rounding,
            symmetric,
        ),
        same(
            "axes of a brushed lobe swapped", "axes that are not alike", brushed, swapped, rounding, symmetric
        ),
        same("order of lobes", "sums that depend on it", two, order, rounding),
        same("a lobe in two parts", "weights that do not add", round_shot, halves, rounding),
        HardCase(
            "order of points",
            "lanes that talk to each other",
            Quantity("relative difference", reordered, other_lanes),
            "issue",
        ),
        HardCase(
            "the same again",
            "memory that is not written",
            Quantity("share of values that differ", repeated, SAME_BITS),
            "issue",
        ),
    ]


CASES = [*energy_cases(), *symmetry_cases()]

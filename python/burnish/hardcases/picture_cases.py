"""Whole pictures: geometry that is tiny, huge, degenerate, mirrored or around the camera."""

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.frame import Frame
from burnish.hardcases.bench import Bench
from burnish.hardcases.bounds import SAME_BITS
from burnish.hardcases.case import ONCE, Bound, HardCase, Quantity
from burnish.hardcases.inputs import float32
from burnish.hardcases.quantities import SAMPLES, difference, refusal, wild_count
from burnish.rendering import draw, shade

SIZE = (24, 32)
MATERIAL = _core.Material(diffuse=(0.3, 0.2, 0.1), lobes=[_core.KurtLobe(roughness=0.1, alpha=0.5)])
BRUSHED = _core.Material(lobes=[_core.KurtLobe(roughness=(0.3, 0.05), alpha=0.5)])
Transform = NDArray[np.float64]
Picture = Callable[[Bench], Frame]


def _scaled(factor: float) -> Transform:
    return np.diag([factor, factor, factor, 1.0])


def _moved(x: float, y: float, z: float) -> Transform:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def picture_of(
    bench: Bench,
    *objects: tuple[_core.Mesh, _core.Material, Transform],
    eye: tuple[float, float, float] = (0.0, 1.0, 4.0),
    near: float = 0.01,
    light: str = "smooth",
    size: tuple[int, int] = SIZE,
) -> Frame:
    """Render objects as seen from a place, looking at the origin."""
    scene = _core.Scene()
    for mesh, material, transform in objects:
        scene.add(mesh, material, transform)
    scene.environment = bench.light(light)
    camera = _core.Camera.look_at(eye, (0.0, 0.0, 0.0), near_plane=near)
    return draw(scene, camera, size, _core.Regular(SAMPLES), bench.device)


def sphere(bench: Bench, factor: float = 1.0, mirror: float = 1.0) -> Frame:
    """A sphere and all about it scaled alike; `mirror` -1 mirrors the object in x."""
    place = _scaled(factor) @ np.diag([mirror, 1.0, 1.0, 1.0])
    eye = (0.0, factor, 4 * factor)
    return picture_of(bench, (_core.Mesh.sphere(segments=24), MATERIAL, place), eye=eye, near=0.01 * factor)


def _triangles(positions: list[list[float]], normals: list[list[float]] | None = None) -> _core.Mesh:
    indices = np.arange(len(positions), dtype=np.uint32).reshape(-1, 3)
    return _core.Mesh(float32(positions), indices, None if normals is None else float32(normals))


def wild_pixels(picture: Picture) -> Quantity:
    """Pixels that are not finite or negative, and values that the engine stopped."""

    def measure(bench: Bench, sampler: str) -> float:
        frame = picture(bench)
        return wild_count(frame.color) + wild_count(frame.alpha) + float(frame.report.non_finite)

    return Quantity("values not finite or negative", measure, Bound(0.0, "radiance is a number, always"))


def unlike(picture: Picture, other: Picture, bound: Bound) -> Quantity:
    """Difference of two pictures that must be the same."""

    def measure(bench: Bench, sampler: str) -> float:
        return difference(picture(bench).color, other(bench).color)

    return Quantity("relative difference", measure, bound)


def uncovered(picture: Picture, expected: float) -> Quantity:
    """How far the share of the picture that is covered is from what it must be."""

    def measure(bench: Bench, sampler: str) -> float:
        return abs(float(picture(bench).alpha.mean()) - expected)

    return Quantity("share of pixels wrongly covered", measure, Bound(0.0, "all of it, or none"))


def _tiny_triangles(bench: Bench) -> Frame:
    return picture_of(bench, (_core.Mesh.sphere(segments=128), BRUSHED, _scaled(0.02)), size=(16, 16))


def _degenerate(bench: Bench) -> Frame:
    a, b = [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]
    long = [[-1e6, 0.0, 0.0], [1e6, 0.0, 0.0], [0.0, 1e6, 1.0]]
    mesh = _triangles([a, a, b, a, b, [2.0, 0.0, 0.0], *long], [[0.0, 0.0, 1.0]] * 9)
    return picture_of(bench, (mesh, BRUSHED, np.eye(4)))


def _opposed_normals(bench: Bench) -> Frame:
    mesh = _triangles([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[-0.8, 0, 0.6], [0.8, 0, -0.6], [0, 0, 1]])
    return picture_of(bench, (mesh, BRUSHED, np.eye(4)))


def _black_share(bench: Bench, sampler: str) -> float:
    """Share of the pixels of a triangle, whose normals face away, that are black."""
    mesh = _triangles([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 0, -1]] * 3)
    frame = picture_of(bench, (mesh, BRUSHED, np.eye(4)))
    return float(np.mean(frame.color[frame.alpha > 0].max(axis=-1) <= 0))


def _inside(bench: Bench) -> Frame:
    return picture_of(bench, (_core.Mesh.sphere(segments=24), BRUSHED, _scaled(10.0)))


def _wall(bench: Bench, distance: float) -> Frame:
    mesh = _triangles([[-9, -9, 0], [9, -9, 0], [0, 18, 0]], [[0, 0, 1]] * 3)
    place = _moved(0.0, 0.0, -distance) @ _scaled(distance)
    return picture_of(bench, (mesh, MATERIAL, place), eye=(0.0, 0.0, 1.0))


def _horizon(bench: Bench) -> Frame:
    return picture_of(
        bench, (_core.Mesh.plane(size=2e6), BRUSHED, np.eye(4)), eye=(0.0, 1e-3, 1.0), near=1e-6
    )


def _touching(bench: Bench) -> Frame:
    return picture_of(
        bench, (_core.Mesh.sphere(segments=24), BRUSHED, np.eye(4)), eye=(0.0, 0.0, 1.0), near=1e-6
    )


def _quad(bench: Bench, tangent: tuple[float, float, float, float], rotation: float = 0.5) -> Frame:
    """A brushed square whose vertices all have this tangent and handedness."""
    corners = float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    normals, tangents = float32([[0, 0, 1]] * 4), float32([tangent] * 4)
    mesh = _core.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.uint32), normals, tangents)
    lobe = _core.KurtLobe(roughness=(0.3, 0.05), alpha=0.5, rotation=rotation)
    return picture_of(bench, (mesh, _core.Material(lobes=[lobe]), np.eye(4)))


def _facet(bench: Bench, mirror: float) -> Frame:
    """A facet of a sphere, 18 x 14 pixels, whose corners lie between pixels; `mirror` as of `sphere`."""
    corners = float32([[-9, -7, 0], [9, -7, 0], [9, 7, 0], [-9, 7, 0]])
    normals = corners + float32([0, 0, 12])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    mesh = _core.Mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], np.uint32), normals)
    scene = _core.Scene()
    scene.add(mesh, MATERIAL, np.diag([mirror, 1.0, 1.0, 1.0]))
    scene.environment = bench.light("smooth")
    distance = 16.0
    camera = _core.Camera(_moved(0.0, 0.0, distance), 2 * np.arctan(0.5 * SIZE[0] / distance))
    return draw(scene, camera, SIZE, _core.Regular(SAMPLES), bench.device)


def _two(bench: Bench, is_reversed: bool) -> Frame:
    objects = [
        (_core.Mesh.sphere(segments=24), m, _moved(x, 0, 0)) for m, x in ((MATERIAL, -0.5), (BRUSHED, 0.5))
    ]
    return picture_of(bench, *(objects[::-1] if is_reversed else objects))


def _captured(bench: Bench) -> float:
    """Texels of a map captured inside an object that no light has."""
    scene = _core.Scene.sphere(MATERIAL)
    scene.environment = bench.light("NaN")
    return wild_count(_core.capture(bench.device, scene, (0.0, 0.0, 0.0), 8, None).faces)


def _points(value: float) -> object:
    normals = float32([[0, 0, 1]])
    return shade(
        _core.Environment.from_faces(np.ones((6, 1, 1, 3), np.float32)),
        MATERIAL,
        _core.Regular(),
        normals,
        normals,
        normals * np.float32(value),
    )


def _faces(*shape: int) -> object:
    return _core.Environment.from_faces(np.ones(shape, np.float32))


def _cases() -> list[HardCase]:
    def case(name: str, why: str, quantity: Quantity, source: str = "issue") -> HardCase:
        return HardCase(name, why, quantity, source, ONCE)

    def wild(name: str, why: str, picture: Picture) -> HardCase:
        return case(name, why, wild_pixels(picture))

    base = partial(sphere)
    facets = Bound(
        5e-4,
        "the same sphere from mirrored facets: interpolated normals differ by rounding of positions; a "
        "rasteriser with a grid of 1/16 pixel, which Vulkan allows, moves the four corners of a facet each "
        "on its own, so that it matters which diagonal splits it: a sixteenth of what differs from pixel to "
        "pixel, 1.3 at most, is 0.08",
        snapped=0.08,
    )
    on_grid = Bound(5e-4, "corners lie on every rasteriser's grid: normals differ by their 16 bits alone")
    return [
        wild("triangles of 1/50 pixel", "attributes beyond the triangle", _tiny_triangles),
        wild("triangles without area, and of 1e6", "0/0 in barycentric weights", _degenerate),
        wild("normals that cancel between vertices", "an interpolated normal of length 0", _opposed_normals),
        case(
            "normals facing away",
            "views from behind every pixel: black",
            Quantity(
                "share of covered pixels that are black",
                _black_share,
                Bound(0.0, "bent back to just face the eye"),
            ),
        ),
        wild("camera inside a sphere", "every surface from behind", _inside),
        wild("camera on a surface", "depths of zero", _touching),
        wild("plane to the horizon", "views of 90 degrees, depth without end", _horizon),
        case("wall at distance 1e6", "a far plane cuts it off", uncovered(lambda b: _wall(b, 1e6), 1.0)),
        case(
            "wall at distance 1e18", "squares of distances overflow", uncovered(lambda b: _wall(b, 1e18), 1.0)
        ),
        case("scene of 1e-6", "absolute tolerances", unlike(base, lambda b: sphere(b, 2.0**-20), SAME_BITS)),
        case("scene of 1e6", "absolute tolerances", unlike(base, lambda b: sphere(b, 2.0**20), SAME_BITS)),
        case(
            "mirrored object", "winding and handedness", unlike(base, lambda b: sphere(b, 1.0, -1.0), facets)
        ),
        case(
            "mirrored facet, corners on pixels",
            "winding and handedness, on rasterisers with a coarse grid, too",
            unlike(lambda b: _facet(b, 1.0), lambda b: _facet(b, -1.0), on_grid),
        ),
        case(
            "mirrored tangents",
            "handedness lost on the way through the G-buffer",
            unlike(
                lambda b: _quad(b, (0.6, 0.8, 0.0, 1.0)),
                lambda b: _quad(b, (0.6, 0.8, 0.0, -1.0), -0.5),
                Bound(2e-5, "the pattern is symmetric about the tangent: the same samples in another order"),
            ),
        ),
        wild("tangents of zero", "0/0 in every pixel", lambda b: _quad(b, (0.0, 0.0, 0.0, 1.0))),
        wild("tangents along the normals", "the same", lambda b: _quad(b, (0.0, 0.0, 1.0, -1.0))),
        case(
            "order of objects",
            "pictures that depend on it",
            unlike(lambda b: _two(b, False), lambda b: _two(b, True), SAME_BITS),
        ),
        case("the same picture again", "memory that is not written", unlike(base, base, SAME_BITS)),
        wild(
            "picture of one pixel",
            "tiles beyond the picture",
            lambda b: picture_of(b, (_core.Mesh.sphere(segments=8), BRUSHED, np.eye(4)), size=(1, 1)),
        ),
        wild(
            "NaN texel behind",
            "the background reads it, too",
            lambda b: picture_of(b, (_core.Mesh.sphere(segments=8), BRUSHED, np.eye(4)), light="NaN"),
        ),
        case(
            "map captured inside an object",
            "lookups of length 0",
            Quantity("texels not finite or negative", lambda b, _: _captured(b), Bound(0.0, "no such texel")),
        ),
        case("view of NaN", "would be black without a word", refusal(lambda _: _points(float("nan")))),
        case("view of infinity", "would be black without a word", refusal(lambda _: _points(float("inf")))),
        case("roughness 0", "D is a delta", refusal(lambda _: _core.KurtLobe(roughness=0.0)), "maths 7"),
        case(
            "roughness NaN",
            "passes comparisons that it should fail",
            refusal(lambda _: _core.KurtLobe(roughness=float("nan"))),
            "maths 7",
        ),
        case("faces of 3", "levels that do not halve", refusal(lambda _: _faces(6, 3, 3, 3))),
        case("five faces", "reads beyond the map", refusal(lambda _: _faces(5, 4, 4, 3))),
    ]


CASES = _cases()

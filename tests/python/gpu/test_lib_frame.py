"""Frames: shader against oracle, at every normal and for tangents that are none."""

import numpy as np
import pytest
from probe import ULP, assert_close, probe, rows, units

from burnish.oracle import frame
from burnish.oracle.arrays import dot

HARD_NORMALS = [
    *([0, 0, 1], [0, 0, -1], [-0.0, -0.0, -1], [0, 1, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0]),
    *([1, 1, 0], [1, 1, -0.0], [-3, 4, 0], [3, -4, -0.0], [1, 1, 1], [-1, -1, -1]),
    *([1e-4, 0, -1], [0, 3e-4, -1], [1e-20, 0, -1], [1e-6, -1e-6, -1], [1, 1, 1e-30], [1, 1, -1e-30]),
    *([1e-6, 1, 0], [0, 1, 1e-6], [3e-5, -1, 0], [1e-5, -1, 3e-6], [1e-20, 1, 1e-20]),
]


@pytest.fixture
def normals(rng):
    """Unit normals, hard ones first, then some on the equators of the packing and near the poles."""
    equator = rng.normal(size=(2000, 3)) * [1, 1, 0]
    poles = [0, 0, -1] + rng.normal(size=(2000, 3)) * 10.0 ** rng.uniform(-8, -1, (2000, 1))
    return units(np.concatenate([HARD_NORMALS, equator, poles, rng.normal(size=(20000, 3))]))


def columns(results):
    return results[:, 0, :3], results[:, 1, :3], results[:, 2, :3]


def assert_orthonormal(name, results, handedness=1.0, **inputs):
    """Unit columns at right angles: rounding of dot products and cross products of unit vectors."""
    t, b, n = (c.astype(float) for c in columns(results))
    for one, other, expected in ((t, t, 1), (b, b, 1), (t, b, 0), (t, n, 0), (b, n, 0)):
        assert_close(f"{name} dot products", dot(one, other), np.full(len(t), expected), 8 * ULP, **inputs)
    turned = np.broadcast_to(np.asarray(handedness, float)[..., None], t.shape)
    assert_close(f"{name} handedness", np.cross(n, t) * turned, b, 4 * ULP, **inputs)


def test_orthonormal_basis(device, normals):
    results = probe(device, "orthonormal_basis", normals)
    tangent, bitangent, normal = columns(results)
    expected = frame.orthonormal_basis(normals)
    # Entries of at most 1: four roundings, and a quotient that enters once.
    assert_close("orthonormal_basis", tangent, expected[0], 5 * ULP, normal=normals)
    assert_close("orthonormal_basis", bitangent, expected[1], 5 * ULP, normal=normals)
    np.testing.assert_array_equal(normal, normals)
    assert_orthonormal("orthonormal_basis", results, normal=normals)


def slanted_tangents(normals, rng):
    """Tangents of any length, from orthogonal to almost parallel to the normal, and that angle's sine."""
    along, across = frame.orthonormal_basis(normals)
    turn = rng.uniform(0, 2 * np.pi, (len(normals), 1))
    sine = 10.0 ** rng.uniform(-7, 0, (len(normals), 1))
    direction = sine * (np.cos(turn) * along + np.sin(turn) * across)
    direction = direction + rng.choice((-1, 1), sine.shape) * np.sqrt(1 - sine**2) * normals
    tangents = (direction * 10.0 ** rng.uniform(-17, 18, sine.shape)).astype(np.float32)
    unit = tangents / np.linalg.norm(tangents.astype(float), axis=-1, keepdims=True)
    return tangents, np.linalg.norm(np.cross(unit, normals), axis=-1)


def test_frame_from_tangent(device, normals, rng):
    tangents, sine = slanted_tangents(normals, rng)
    handedness = rng.choice((-1.0, 1.0), len(normals)).astype(np.float32)
    results = probe(device, "frame_from_tangent", normals, tangents, handedness)
    assert_orthonormal("frame_from_tangent", results, handedness, normal=normals, tangent=tangents)
    # Beside the limit rounding decides between the tangent's part and the replacement.
    decided = np.abs(sine / frame.PARALLEL_LIMIT - 1) > 0.1
    assert np.count_nonzero(sine[decided] < frame.PARALLEL_LIMIT) > 1000
    normals, tangents, handedness, sine = (a[decided] for a in (normals, tangents, handedness, sine))
    tangent, bitangent, _ = (c[decided] for c in columns(results))
    expected = frame.frame_from_tangent(normals, tangents)
    # What is left of a unit vector after its part along n went has an error of 3 ulp: relative to its length.
    allowed = ULP * (6 + 3 / np.maximum(sine, frame.PARALLEL_LIMIT))[:, None]
    inputs = {"normal": normals, "tangent": tangents, "sine": sine}
    assert_close("frame_from_tangent", tangent, expected[0], allowed, **inputs)
    assert_close("frame_from_tangent", bitangent, handedness[:, None] * expected[1], allowed, **inputs)


@pytest.mark.parametrize(
    "tangent",
    [
        (0, 0, 0),
        (-0.0, 0, 0),
        (np.nan, 0, 0),
        (np.inf, 0, 0),
        (0, -np.inf, np.inf),
        (1e-30, 0, 0),
        (1e30, 0, 0),
    ],
    ids=str,
)
def test_frame_from_a_useless_tangent_is_the_basis(device, normals, tangent):
    tangents = np.tile(np.array(tangent, np.float32), (len(normals), 1))
    results = probe(device, "frame_from_tangent", normals, tangents, np.ones(len(normals), np.float32))
    basis = probe(device, "orthonormal_basis", normals)
    np.testing.assert_array_equal(results[:, 0], basis[:, 0])
    assert_orthonormal("frame_from_tangent", results, normal=normals)


@pytest.mark.parametrize("scale", [1.0, -3.0, 1e-12])
def test_frame_from_a_parallel_tangent_is_the_basis(device, normals, scale):
    tangents = (normals * np.float32(scale)).astype(np.float32)
    results = probe(device, "frame_from_tangent", normals, tangents, np.ones(len(normals), np.float32))
    np.testing.assert_array_equal(results[:, 0], probe(device, "orthonormal_basis", normals)[:, 0])


def test_longitude_frame(device, normals, rng):
    turn = rng.uniform(0, 2 * np.pi, 3000)
    reach = 10.0 ** rng.uniform(-8, 0, 3000)
    poles = np.stack([reach * np.cos(turn), rng.choice((-1, 1), 3000), reach * np.sin(turn)], axis=-1)
    normals = rows(normals, units(poles))
    results = probe(device, "longitude_frame", normals)
    assert_orthonormal("longitude_frame", results, normal=normals)
    reach = np.hypot(normals[:, 0], normals[:, 2]).astype(float)
    decided = np.abs(reach / frame.PARALLEL_LIMIT - 1) > 1e-5
    expected = frame.longitude_frame(normals[decided])
    # Components over a length: two squares, a sum, an inverse root and a product; the basis has 5 ulp.
    for actual, twin in zip(columns(results), expected, strict=False):
        assert_close("longitude_frame", actual[decided], twin, 5 * ULP, normal=normals[decided])


def test_longitude_frame_points_east(device):
    """On the equator of y, longitude grows from +z toward +x."""
    results = probe(device, "longitude_frame", np.array([[0, 0, 1], [1, 0, 0], [0.6, 0.8, 0]], np.float32))
    np.testing.assert_allclose(results[:, 0, :3], [[1, 0, 0], [0, 0, -1], [0, 0, -1]], atol=ULP)


def test_sign_not_zero(device):
    values = np.array([0.0, -0.0, 1e-30, -1e-30, 5, -5, np.inf, -np.inf], np.float32)
    actual = probe(device, "sign_not_zero", (values, values[::-1].copy()))[:, 0, :2]
    np.testing.assert_array_equal(actual, frame.sign_not_zero(np.stack([values, values[::-1]], -1)))


def test_octahedral_encode(device, normals):
    actual = probe(device, "octahedral_encode", normals)[:, 0, :2]
    # Two sums, a quotient, and a difference from 1, of numbers of size 1 at most.
    assert_close("octahedral_encode", actual, frame.octahedral_encode(normals), 5 * ULP, normal=normals)


def test_octahedral_decode(device, normals, rng):
    points = rows(
        [[0, 0], [1, 1], [-1, 1], [1, 0], [0, -1], [0.5, 0.5], [0.25, -0.75], [-0.5, -0.5], [-0.0, -0.0]],
        rng.uniform(-1, 1, (20000, 2)),
        frame.octahedral_encode(normals),
    )
    actual = probe(device, "octahedral_decode", points)[:, 0, :3]
    # 1 - |x| - |y| rounds twice; the vector is 1/sqrt 3 long at least.
    assert_close("octahedral_decode", actual, frame.octahedral_decode(points), 6 * ULP, point=points)


def test_octahedral_round_trip(device, normals):
    points = probe(device, "octahedral_encode", normals)[:, 0, :2]
    back = probe(device, "octahedral_decode", points)[:, 0, :3]
    # The map stretches by at most 3, in the middle of the octahedron's faces.
    assert_close("octahedral round trip", back, normals, (3 * 5 + 6) * ULP, normal=normals)

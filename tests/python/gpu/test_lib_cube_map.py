"""Cube faces: shader against oracle, also on edges and corners."""

import itertools

import numpy as np
import pytest
from probe import ULP, assert_close, probe, rows, units, words

from burnish.oracle import cube_map

EDGES_AND_CORNERS = [d for d in itertools.product((-1, 0, 1), repeat=3) if any(d)]


@pytest.fixture
def directions(rng):
    """Any length; on and beside edges and corners, with components of very different size."""
    random = rng.normal(size=(20000, 3)) * 10.0 ** rng.uniform(-3, 3, (20000, 1))
    lopsided = rng.choice((-1, 1), (2000, 3)) * 10.0 ** rng.uniform(-12, 0, (2000, 3))
    ties = np.array(EDGES_AND_CORNERS, float)
    beside = np.repeat(ties, 20, axis=0) * (1 + ULP * rng.integers(-2, 3, (20 * len(ties), 3)))
    return rows(ties, 3 * ties, beside, random, lopsided)


def test_cube_direction(device, rng):
    face = np.repeat(np.arange(6), 500)
    at = rng.choice((-1.0, -1 + ULP, 0.0, 1.0), (3000, 2)).astype(np.float32)
    at[::2] = rng.uniform(-1, 1, (1500, 2))
    actual = probe(device, "cube_direction", (face, at[:, 0], at[:, 1]))[:, 0, :3]
    axes = cube_map.FACE_AXES[face]
    expected = axes[:, 0] + at[:, :1] * axes[:, 1] + at[:, 1:] * axes[:, 2]
    np.testing.assert_array_equal(actual, expected)  # signs and a 1: no rounding
    # The oracle's is of unit length.
    np.testing.assert_allclose(units(actual), cube_map.cube_direction(face, at[:, 0], at[:, 1]), atol=2 * ULP)


def test_cube_face_uv(device, directions):
    results = probe(device, "cube_face_uv", directions)[:, 0]
    face, u, v = cube_map.cube_face_uv(directions)
    np.testing.assert_array_equal(words(results)[:, 0], face)
    # One quotient of size at most 1.
    assert_close("cube_face_uv", results[:, 1:3], np.stack([u, v], -1), 2.5 * ULP, direction=directions)


def test_faces_and_places_lead_back(device, directions):
    results = probe(device, "cube_face_uv", directions)[:, 0]
    back = probe(device, "cube_direction", (words(results)[:, 0], results[:, 1], results[:, 2]))[:, 0, :3]
    largest = np.max(np.abs(directions), axis=-1, keepdims=True)
    assert_close("cube_direction", back, directions / largest, 3 * ULP, direction=directions)


def test_cube_stretch(device, directions):
    actual = probe(device, "cube_stretch", directions)[:, 0, 0]
    expected = cube_map.cube_stretch(directions)
    # length: three squares, two sums, a square root of 9/2 ulp; then a quotient.
    assert_close("cube_stretch", actual, expected, 8 * ULP * expected, direction=directions)


def test_texel_solid_angle(device, directions, rng):
    face_texels = (4.0 ** rng.integers(0, 12, len(directions))).astype(np.float32)
    actual = probe(device, "texel_solid_angle", face_texels, directions)[:, 0, 0]
    expected = 4 / (face_texels * cube_map.cube_stretch(directions) ** 3)
    # Three times the error of the stretch, three products and a quotient.
    assert_close("texel_solid_angle", actual, expected, 29 * ULP * expected, direction=directions)


def test_texel_solid_angle_is_that_of_texels(device):
    size = 64
    centers = cube_map.texel_directions(size)[0].reshape(-1, 3).astype(np.float32)
    actual = probe(device, "texel_solid_angle", np.full(len(centers), float(size * size)), centers)[:, 0, 0]
    exact = cube_map.texel_solid_angle(size).ravel()
    # Midpoint rule over texels of edge d = 2/size: d^2/24 of the Laplacian, at most 6 times the value.
    assert_close("texel_solid_angle", actual, exact, exact * (2 / size) ** 2 / 24 * 6.1, direction=centers)

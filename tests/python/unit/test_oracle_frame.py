import numpy as np
import pytest

from burnish.oracle.arrays import dot, normalize
from burnish.oracle.frame import (
    frame_from_tangent,
    octahedral_decode,
    octahedral_encode,
    orthonormal_basis,
    rotate_frame,
)
from burnish.oracle.tangent_space import brushed_tangent, mapped_normal, seen_from_behind

HARD_NORMALS = normalize(
    [
        [0, 0, 1],
        [0, 0, -1],
        [1e-9, 0, -1],
        [0, 1e-12, -1],
        [1, 0, 0],
        [0, -1, 0],
        [1, 1, 1e-300],
        [1, 1, -1e-300],
    ]
)


def assert_right_handed(t, b, n):
    for vector in (t, b):
        np.testing.assert_allclose(np.linalg.norm(vector, axis=-1), 1, atol=1e-14)
        np.testing.assert_allclose(dot(vector, n), 0, atol=1e-14)
    np.testing.assert_allclose(np.cross(t, b), n, atol=1e-13)


def test_basis_is_right_handed_everywhere(rng):
    n = np.concatenate([HARD_NORMALS, normalize(rng.normal(size=(1000, 3)))])
    assert_right_handed(*orthonormal_basis(n), n)


def test_frame_keeps_the_tangents_side(rng):
    n, t = (
        normalize(rng.normal(size=(1000, 3))),
        rng.normal(size=(1000, 3)) * 10.0 ** rng.uniform(-6, 6, (1000, 1)),
    )
    tangent, bitangent = frame_from_tangent(n, t)
    assert_right_handed(tangent, bitangent, n)
    assert np.all(dot(tangent, t) > 0)
    np.testing.assert_allclose(dot(bitangent, t) / np.linalg.norm(t, axis=-1), 0, atol=1e-12)


@pytest.mark.parametrize("t", [[0, 0, 0], [np.nan, 0, 0], [np.inf, 0, 0]], ids=["zero", "nan", "infinite"])
def test_frame_replaces_a_useless_tangent(t):
    tangent, bitangent = frame_from_tangent(HARD_NORMALS, t)
    assert_right_handed(tangent, bitangent, HARD_NORMALS)
    np.testing.assert_array_equal(tangent, orthonormal_basis(HARD_NORMALS)[0])


def test_frame_replaces_a_parallel_tangent():
    tangent, bitangent = frame_from_tangent(HARD_NORMALS, -3 * HARD_NORMALS)
    assert_right_handed(tangent, bitangent, HARD_NORMALS)


def test_frame_is_orthogonal_for_an_almost_parallel_tangent(rng):
    n = normalize(rng.normal(size=(1000, 3)))
    tangent, bitangent = frame_from_tangent(n, n + 1e-5 * rng.normal(size=(1000, 3)))
    assert_right_handed(tangent, bitangent, n)


def test_rotation_turns_tangent_toward_bitangent():
    t, b = rotate_frame([1, 0, 0], [0, 1, 0], np.pi / 6)
    np.testing.assert_allclose(t, [np.cos(np.pi / 6), 0.5, 0], atol=1e-15)
    np.testing.assert_allclose(b, [-0.5, np.cos(np.pi / 6), 0], atol=1e-15)


def test_octahedral_round_trip(rng):
    n = np.concatenate([HARD_NORMALS, normalize(rng.normal(size=(1000, 3)))])
    p = octahedral_encode(n)
    assert np.all(np.abs(p) <= 1 + 1e-15)
    np.testing.assert_allclose(octahedral_decode(p), n, atol=1e-14)


def test_octahedral_corners():
    np.testing.assert_allclose(
        octahedral_encode([[0, 0, 1], [1, 0, 0], [0, -1, 0]]), [[0, 0], [1, 0], [0, -1]]
    )
    np.testing.assert_allclose(np.abs(octahedral_encode([0, 0, -1])), [1, 1])


def test_textures_of_directions_follow_tangent_and_bitangent():
    up, frame = [0.0, 0.0, 1.0], [0.0, 1.0, 0.0, -1.0]  # tangent +y, bitangent -(z cross y) = +x
    np.testing.assert_allclose(mapped_normal(up, frame, [0.5, 0.5, 1.0]), up, atol=1e-15)
    np.testing.assert_allclose(mapped_normal(up, frame, [0.8, 0.5, 0.9]), [0, 0.6, 0.8], atol=1e-12)
    np.testing.assert_allclose(mapped_normal(up, frame, [0.5, 0.8, 0.9]), [0.6, 0, 0.8], atol=1e-12)
    np.testing.assert_allclose(mapped_normal(up, frame, [0.5, 1.0, 0.9], 0.6), [0.6, 0, 0.8], atol=1e-12)
    np.testing.assert_allclose(brushed_tangent(up, frame, [0.8, 0.9]), [0.8, 0.6, 0, -1], atol=1e-12)
    np.testing.assert_allclose(brushed_tangent(up, frame, [0.502, 0.498]), frame, atol=1e-12)


def test_both_sides_of_a_surface_are_brushed_the_same_way():
    normal, frame = [0.0, 0.6, 0.8], [1.0, 0.0, 0.0, 1.0]
    back, turned = seen_from_behind(normal, frame)
    np.testing.assert_array_equal(back, [0, -0.6, -0.8])
    texel = [0.7, 0.9]
    np.testing.assert_allclose(
        brushed_tangent(back, turned, texel)[:3], brushed_tangent(normal, frame, texel)[:3], atol=1e-12
    )

import itertools

import numpy as np
import pytest

from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import (
    add_border,
    cube_direction,
    cube_face_uv,
    cube_stretch,
    sample_cube,
    texel_directions,
    texel_solid_angle,
)

# The table of the Vulkan specification as environment.h states it.
STATED = [
    lambda u, v: (1, -v, -u),
    lambda u, v: (-1, -v, u),
    lambda u, v: (u, 1, v),
    lambda u, v: (u, -1, -v),
    lambda u, v: (u, -v, 1),
    lambda u, v: (-u, -v, -1),
]


def test_directions_follow_the_stated_table(rng):
    for face, stated in enumerate(STATED):
        u, v = rng.uniform(-1, 1, 2)
        np.testing.assert_allclose(cube_direction(face, u, v), normalize(stated(u, v)), rtol=1e-15)


def test_face_and_uv_invert_directions(rng):
    face = rng.integers(0, 6, 1000)
    u, v = rng.uniform(-1, 1, (2, 1000))
    found, fu, fv = cube_face_uv(7.5 * cube_direction(face, u, v))
    np.testing.assert_array_equal(found, face)
    np.testing.assert_allclose([fu, fv], [u, v], atol=1e-14)


@pytest.mark.parametrize("size", [1, 2, 64, 1024])
def test_solid_angles_sum_to_the_sphere(size):
    angles = texel_solid_angle(size)
    assert np.all(angles > 0)
    assert 6 * np.sum(angles) == pytest.approx(4 * np.pi, rel=1e-12)


def test_solid_angle_of_small_texels_is_that_of_the_stretch():
    size = 512
    expected = 4 / size**2 / cube_stretch(texel_directions(size))[0] ** 3
    np.testing.assert_allclose(texel_solid_angle(size), expected, rtol=1e-5)


def test_border_continues_directions_over_edges():
    # The folded neighbour of an edge texel is one texel away, never more.
    size = 32
    bordered = add_border(texel_directions(size), 1)
    for edge, inner in ((bordered[:, 0], bordered[:, 1]), (bordered[:, -1], bordered[:, -2])):
        np.testing.assert_array_less(np.linalg.norm(edge - inner, axis=-1)[:, 1:-1], 2.1 / size)
    for edge, inner in ((bordered[:, :, 0], bordered[:, :, 1]), (bordered[:, :, -1], bordered[:, :, -2])):
        np.testing.assert_array_less(np.linalg.norm(edge - inner, axis=-1)[:, 1:-1], 2.1 / size)


def test_border_reads_as_deep_as_it_is_outside():
    # Beyond +X's edge at u = +1 lies -Z: its columns from the side of u = -1, rows unchanged.
    size = 8
    faces = np.arange(6 * size * size, dtype=np.float64).reshape(6, size, size, 1)
    bordered = add_border(faces, 3)
    np.testing.assert_array_equal(bordered[0, 3:-3, -3:], faces[5, :, :3])
    # Above +X's edge at v = -1 lies +Y, turned: its columns from the side of u = +1.
    np.testing.assert_array_equal(bordered[0, 2, 3:-3, 0], faces[2, ::-1, -1, 0])
    np.testing.assert_array_equal(bordered[0, 0, 3:-3, 0], faces[2, ::-1, -3, 0])


def test_corner_of_the_border_is_the_mean_of_the_two_folds(rng):
    # Beyond +X's top left corner, (1, 1, 1), lie +Y (its bottom right) and +Z (its top right).
    faces = rng.random((6, 4, 4, 1))
    y, z = faces[2, ..., 0], faces[4, ..., 0]
    corner = add_border(faces, 2)[0, :2, :2, 0]
    assert corner[1, 1] == (y[3, 3] + z[0, 3]) / 2
    # One to the left and two above: over +Y and then onto +Z it is two from +X and one from +Y, and so on.
    assert corner[0, 1] == (z[0, 2] + y[2, 3]) / 2
    assert corner[1, 0] == (z[1, 3] + y[3, 2]) / 2
    assert corner[0, 0] == (z[1, 2] + y[2, 2]) / 2


def test_lookup_at_a_texel_centre_is_the_texel(rng):
    faces = rng.random((6, 8, 8, 3))
    np.testing.assert_allclose(sample_cube([faces], texel_directions(8)), faces, atol=1e-12)


def test_lookup_of_one_texel_faces_is_finite_and_seamless(rng):
    faces = rng.random((6, 1, 1, 3))
    directions = normalize(rng.normal(size=(100, 3)))
    values = sample_cube([faces], directions)
    assert np.all(values >= faces.min() - 1e-12) and np.all(values <= faces.max() + 1e-12)


EDGES = [
    (axis, a, b) for axis in range(3) for a, b in itertools.product((-1, 1), repeat=2)
]  # the edge along `axis`, at signs a and b of the other two


@pytest.mark.parametrize(("axis", "a", "b"), EDGES)
def test_lookup_is_continuous_across_each_edge(rng, axis, a, b):
    faces = rng.random((6, 8, 8, 3))
    along = np.linspace(-0.999, 0.999, 101)
    direction = np.insert(np.broadcast_to([a, b], (101, 2)).astype(float), axis, along, axis=1)
    first, second = [k for k in range(3) if k != axis]
    nudge = np.zeros((101, 3))
    nudge[:, first], nudge[:, second] = -1e-9 * a, 1e-9 * b
    left, right = sample_cube([faces], direction + nudge), sample_cube([faces], direction - nudge)
    # Within half a texel of a corner the missing fourth texel leaves a small step that the hardware has too.
    inner = np.abs(along) < 1 - 1 / 8
    np.testing.assert_allclose(left[inner], right[inner], atol=1e-6)


@pytest.mark.parametrize("corner", list(itertools.product((-1, 1), repeat=3)))
def test_lookup_at_each_corner_is_the_mean_of_three_texels(rng, corner):
    faces = rng.random((6, 4, 4, 3))
    touching = []
    for axis in range(3):
        nudged = np.array(corner, dtype=float)
        nudged[axis] *= 1.001
        face, u, v = cube_face_uv(nudged)
        touching.append(faces[face, 0 if v < 0 else -1, 0 if u < 0 else -1])
    np.testing.assert_allclose(sample_cube([faces], corner), np.mean(touching, axis=0), atol=1e-12)


def test_levels_blend_linearly_and_are_clamped(rng):
    levels = [rng.random((6, 4, 4, 3)), rng.random((6, 2, 2, 3)), rng.random((6, 1, 1, 3))]
    d = normalize(rng.normal(size=(50, 3)))
    fine, middle, coarse = (sample_cube([level], d) for level in levels)
    np.testing.assert_allclose(sample_cube(levels, d, 0.25), 0.75 * fine + 0.25 * middle, atol=1e-12)
    np.testing.assert_allclose(sample_cube(levels, d, 1.5), 0.5 * middle + 0.5 * coarse, atol=1e-12)
    np.testing.assert_allclose(sample_cube(levels, d, -3), fine)
    np.testing.assert_allclose(sample_cube(levels, d, 99), coarse)

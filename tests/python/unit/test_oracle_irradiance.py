"""Cosine sums and the cube of them, against closed forms."""

import numpy as np
import pytest

from burnish.oracle.arrays import dot, normalize
from burnish.oracle.cube_map import texel_directions
from burnish.oracle.estimator import shade_diffuse
from burnish.oracle.irradiance import cosine_sum, diffuse_light, irradiance_cube
from burnish.oracle.spherical_harmonics import project_cube


def disc(middle, degrees, face_size, radiance=300.0, background=0.0):
    inside = dot(texel_directions(face_size), normalize(middle)) > np.cos(np.radians(degrees))
    return np.where(inside[..., None], radiance, background) * np.ones(3)


@pytest.mark.parametrize("face_size", [1, 4, 16, 128])
def test_constant_light_gives_itself(rng, face_size):
    faces = np.ones((6, face_size, face_size, 3)) * (1, 2, 0.5)
    n = rng.normal(size=(30, 3))
    np.testing.assert_allclose(cosine_sum(faces, n), np.broadcast_to((1, 2, 0.5), (30, 3)), rtol=5e-4)


def test_linear_and_quadratic_light(rng):
    # The clamped cosine takes band 1 by 2 pi/3 and band 2 by pi/4.
    a, c, n = normalize(rng.normal(size=(3, 3)))
    d = texel_directions(128)
    faces = 1 + dot(d, a)[..., None] + (dot(d, c)[..., None] ** 2 - 1 / 3)
    expected = 1 + 2 / 3 * (a @ n) + 1 / 4 * ((c @ n) ** 2 - 1 / 3)
    assert cosine_sum(faces, n)[0] == pytest.approx(expected, rel=1e-4)


def test_a_disc_above_the_horizon_gives_its_projected_solid_angle(rng):
    # Seen under the angle t from its middle, a disc of half-angle r above the horizon has pi sin^2 r cos t.
    middle = normalize(rng.normal(size=3))
    side = normalize(np.cross(middle, [0.3, 0.5, 0.8]))
    faces = disc(middle, 20, 256)
    for degrees in (0, 30, 60):
        t = np.radians(degrees)
        n = np.cos(t) * middle + np.sin(t) * side
        expected = 300 * np.sin(np.radians(20)) ** 2 * np.cos(t)
        assert cosine_sum(faces, n)[0] == pytest.approx(expected, rel=3e-3)
    assert np.all(cosine_sum(faces, -middle) == 0)


def test_the_cube_s_lookups_are_close_to_the_sums(rng):
    n = normalize(np.concatenate([rng.normal(size=(400, 3)), np.eye(3), -np.eye(3), np.ones((1, 3))]))
    faces = disc([0.3, 0.8, 0.52], 8, 64, background=0.3)
    exact, found = cosine_sum(faces, n), diffuse_light(faces, n, "cube")
    assert np.sqrt(np.mean((found - exact) ** 2) / np.mean(exact**2)) <= 5e-4
    assert np.min(found) >= 0.3 * 0.995  # what is taken off the texels swings a little below
    texels = np.maximum(irradiance_cube(faces), 0)
    np.testing.assert_allclose(diffuse_light(faces, texel_directions(32), "cube"), texels)


def test_forms_are_named(rng):
    faces, n = rng.uniform(0, 2, (6, 8, 8, 3)), normalize(rng.normal(size=(9, 3)))
    np.testing.assert_array_equal(diffuse_light(faces, n, None), cosine_sum(faces, n))
    np.testing.assert_allclose(
        diffuse_light(faces, n, "harmonics"), shade_diffuse(project_cube(faces), n, 1.0)
    )
    with pytest.raises(ValueError, match=r'diffuse: expected "cube" or "harmonics", got \'sum\''):
        diffuse_light(faces, n, "sum")

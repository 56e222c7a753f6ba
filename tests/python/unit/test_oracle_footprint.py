import numpy as np
import pytest

from burnish.oracle.arrays import dot, normalize, reflect
from burnish.oracle.cube_map import cube_face_uv
from burnish.oracle.footprint import (
    exact_texels,
    importance_texels,
    level_of_texels,
    published_area,
    published_texels,
)
from burnish.oracle.lobe.kurt import kurt_pdf_omega_i


def test_level_of_a_texel_count():
    assert level_of_texels(1.0, 256**2) == 0
    assert level_of_texels(64.0, 256**2) == 3
    assert level_of_texels(64.0, 256**2, -0.5) == 2.5


@pytest.mark.parametrize(("texels", "level"), [(0.0, 0), (-1.0, 0), (1e30, 8)])
def test_level_is_clamped_to_those_there_are(texels, level):
    assert level_of_texels(texels, 256**2) == level


def test_exact_texels_equal_the_area_of_a_reflected_patch(rng):
    # A small triangle of half-vectors, reflected and projected onto the face it falls on; the face is 2 x 2.
    h = normalize(rng.normal(size=(200, 3)) * 0.3 + [0, 0, 1])
    o = normalize(rng.normal(size=(200, 3)) * 0.5 + [0, 0, 1])
    i = reflect(o, h)
    step = 1e-5
    t = normalize(np.cross(h, [0.3, 1, 0.2]))
    patch = normalize(np.stack([h, h + step * t, h + step * np.cross(h, t)]))
    face, u, v = cube_face_uv(reflect(o, patch))
    same = np.all(face == face[0], axis=0) & (dot(i, h) > 0)
    area = 0.5 * np.abs((u[1] - u[0]) * (v[2] - v[0]) - (u[2] - u[0]) * (v[1] - v[0]))
    expected = area / 4 * 256**2
    found = exact_texels(dot(i, h), i, 0.5 * step * step, 1, 256**2)
    np.testing.assert_allclose(found[same], expected[same], rtol=1e-3)
    assert np.sum(same) > 180


def test_importance_footprint_is_the_exact_one_of_a_uniform_density():
    # Samples of density 1/Omega_h over half-vectors: p_i = 1/(4 (o.h) Omega_h).
    h, o = normalize([0.1, 0.2, 1]), normalize([0.5, 0, 1])
    i = reflect(o, h)
    pdf = 1 / (4 * dot(o, h) * 0.3)
    assert importance_texels(pdf, i, 14, 64**2) == pytest.approx(exact_texels(dot(o, h), i, 0.3, 14, 64**2))
    assert kurt_pdf_omega_i(h, o, 0.3, 0.3) > 0


def test_published_area_is_that_of_the_chords():
    # Half the chord between the mirror direction and that of a half-vector tilted by theta_U.
    m, threshold = 0.2, 0.1
    o = normalize([0.5, -0.3, 0.8])
    theta = np.arctan(m * np.sqrt(-np.log(threshold)))
    mirror = reflect(o, [0, 0, 1])
    along_t = reflect(o, [np.sin(theta), 0, np.cos(theta)])
    along_b = reflect(o, [0, np.sin(theta), np.cos(theta)])
    half_chords = [np.linalg.norm(along_t - mirror) / 2, np.linalg.norm(along_b - mirror) / 2]
    assert published_area(o, m, m, threshold) == pytest.approx(4 * np.pi * np.prod(half_chords), rel=1e-12)


@pytest.mark.parametrize(("degrees", "ratio"), [(60, 1.25), (85, 5.78)])
def test_published_area_depends_on_the_views_azimuth(degrees, ratio):
    theta = np.radians(degrees)
    along = np.array([np.sin(theta), 0, np.cos(theta)])
    between = np.array([np.sin(theta) / np.sqrt(2), np.sin(theta) / np.sqrt(2), np.cos(theta)])
    area = [published_area(o, 0.1, 0.1, 0.1) for o in (along, between)]
    assert area[1] / area[0] == pytest.approx(ratio, abs=0.01)


def test_published_and_exact_agree_for_a_narrow_lobe_seen_from_above():
    # There i.h = 1 and r = 1, so the three errors vanish: areas 4 pi theta^2 and 4 Omega_h.
    m, threshold = 1e-3, 0.1
    z = np.array([0, 0, 1.0])
    published = published_texels(1.0, z, published_area(z, m, m, threshold), 14, 256**2)
    omega = np.pi * m * m * -np.log(threshold)
    assert published == pytest.approx(float(exact_texels(1.0, z, omega, 14, 256**2)), rel=1e-4)

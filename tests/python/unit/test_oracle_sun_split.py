"""Suns taken out of a map and shaded directly."""

import numpy as np
import pytest

from burnish.oracle.arrays import normalize, reflect
from burnish.oracle.cube_map import texel_directions, texel_solid_angle
from burnish.oracle.estimator import local_frame
from burnish.oracle.frame import orthonormal_basis
from burnish.oracle.lobe.kurt import KurtLobe, grazing_factor, kurt_d
from burnish.oracle.matched import Matched, read_matched, shade_matched
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.sun_split import Sun, shade_suns, split_suns

SIZE = 128


def map_with_suns(centers, radius=0.012, radiance=20000.0):
    d = texel_directions(SIZE)
    faces = 1 + 0.3 * d
    for center in centers:
        angle = np.linalg.norm(d - normalize(center), axis=-1)
        cover = np.clip((radius - angle) / 0.01 + 0.5, 0, 1)[..., None]
        faces = faces * (1 - cover) + cover * radiance * np.array([1, 0.9, 0.7])
    return faces


def test_suns_are_found_with_their_flux_and_place():
    centers = [(0.3, 0.8, 0.2), (1, 0.02, -0.97), (-0.2, -0.3, 0.9)]
    faces = map_with_suns(centers)
    suns, filled = split_suns(faces)
    assert len(suns) == 3
    weight = texel_solid_angle(SIZE)[None, :, :, None]
    lost = np.sum((faces - filled) * weight, axis=(0, 1, 2))
    np.testing.assert_allclose(sum(sun.flux for sun in suns), lost, rtol=1e-6)
    for center in centers:
        closest = max(suns, key=lambda sun: sun.direction @ normalize(center))
        assert np.linalg.norm(closest.direction - normalize(center)) < 0.002
        # A disc's variance per axis is radius^2/4.
        assert closest.variance == pytest.approx(0.012**2 / 4, rel=0.8)
    assert np.max(filled) < 2


def test_at_most_four_suns_are_taken():
    centers = normalize(np.random.default_rng(3).normal(size=(6, 3)))
    suns, filled = split_suns(map_with_suns(centers))
    assert len(suns) == 4 and np.max(filled) > 1000


def test_discs_and_gentle_maps_have_no_sun():
    assert split_suns(map_with_suns([(0, 0, 1)], radius=0.06))[0] == []
    assert split_suns(map_with_suns([(0, 0, 1)], radiance=20))[0] == []
    assert split_suns(np.zeros((6, 16, 16, 3)))[0] == []
    assert split_suns(np.ones((6, 1, 1, 3)))[0] == []


@pytest.mark.parametrize("roughness", [0.1, 0.3, (0.2, 0.075)])
def test_split_suns_shade_like_the_reference(roughness, rng):
    faces = map_with_suns([(0.3, 0.8, 0.2)])
    sun = normalize([0.3, 0.8, 0.2])
    n = normalize(sun + 0.25 * rng.normal(size=(80, 3)))
    t = rng.normal(size=(80, 3))
    o = normalize(2 * np.sum(sun * n, axis=-1, keepdims=True) * n - sun + 0.1 * rng.normal(size=(80, 3)))
    keep = np.sum(o * n, axis=-1) > 0.1
    n, t, o = n[keep], t[keep], o[keep]
    lobe, levels = KurtLobe(roughness, (1, 0.5, 0.04)), build_pyramid(faces)
    truth = shade_reference(faces, n, t, o, lobe)
    with_split, without = (
        shade_matched(read_matched(levels, Matched(split_suns=split)), n, t, o, lobe, 14)
        for split in (True, False)
    )
    error = [np.sqrt(np.mean((x - truth) ** 2)) / np.mean(truth) for x in (with_split, without)]
    assert error[0] < 0.01 and error[0] < 0.3 * error[1]


@pytest.mark.parametrize("roughness", [(0.05, 0.05), (0.2, 0.05), (0.3, 0.3)])
@pytest.mark.parametrize("cosine", [0.04, 0.15, 0.6])
def test_a_sun_widens_the_lobe_as_the_mean_over_its_disc(roughness, cosine, rng):
    # At grazing views a disc's width counts across the plane of view 1/(o.h) times as much as along it.
    radius, lobe = 0.006, KurtLobe(roughness)
    views, got, expected = 40, [], []
    for _ in range(views):
        azimuth = rng.uniform(0, 2 * np.pi)
        sine = np.sqrt(1 - cosine**2)
        o = np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine])
        h = normalize([*(0.5 * np.array(roughness) * rng.standard_normal(2)), 1.0])
        middle = reflect(o, h)
        if middle[2] < 2 * radius:
            continue
        t, b = orthonormal_basis(middle)
        distance, angle = radius * np.sqrt(rng.random(4000)), rng.uniform(0, 2 * np.pi, 4000)
        i = normalize(middle + distance[:, None] * (np.cos(angle)[:, None] * t + np.sin(angle)[:, None] * b))
        half = normalize(i + o)
        value = kurt_d(half, *roughness) / (4 * (half @ o)) * grazing_factor(i[:, 2], o[2], 0.0)
        expected.append(np.mean(value))
        frame = local_frame([0, 0, 1.0], [1.0, 0, 0], o)
        got.append(shade_suns([Sun(middle, np.ones(3), radius**2 / 4)], frame, lobe)[0])
    assert len(got) > 10
    error = np.sqrt(np.sum((np.array(got) - expected) ** 2) / np.sum(np.square(expected)))
    assert error < 0.08


@pytest.mark.parametrize("height", [-0.002, 0.0001, 0.004, 0.01])
@pytest.mark.parametrize("alpha", [0.0, 0.5])
def test_a_sun_on_the_horizon_beside_the_plane_of_view_reflects_next_to_nothing(height, alpha):
    # Its half-vector lies along the surface: a linear change of slope would reach the lobe from there.
    o, sun = normalize([-0.2612, -0.9652, 0.0076]), normalize([0.0453, 0.999, height])
    frame = local_frame([0, 0, 1.0], [1.0, 0, 0], o)
    light = [Sun(sun, np.ones(3), 1.7e-5)]
    for roughness in (0.1, 0.3, (0.2, 0.075), (0.3, 0.1), (0.4, 0.03)):
        assert np.all(shade_suns(light, frame, KurtLobe(roughness, alpha=alpha)) < 1e-2)

"""Suns taken out of a map and shaded directly."""

import numpy as np
import pytest

from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import texel_directions, texel_solid_angle
from burnish.oracle.kurt_lobe import KurtLobe
from burnish.oracle.matched import Matched, read_matched, shade_matched
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.sun_split import split_suns

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

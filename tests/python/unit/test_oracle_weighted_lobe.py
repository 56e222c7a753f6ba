"""Mean and covariance of what is reflected of a lobe, and the mixtures that lie over it."""

import numpy as np
import pytest

from burnish.oracle.arrays import normalize
from burnish.oracle.lobe.kurt import KurtLobe, kurt_sample, slopes
from burnish.oracle.matched import place_means
from burnish.oracle.matched_means import mean_points, view_means, weighted_place
from burnish.oracle.matched_table import load_table, mixture_at, nearest_aspect, nearest_view
from burnish.oracle.weighted_lobe import lobe_drift, lobe_moments, moment_share, reflect_slopes, sum_moments

LOBES = {
    "round": KurtLobe(0.2),
    "wide": KurtLobe(0.9),
    "dielectric": KurtLobe(0.4, 0.04, 0.5),
    "brushed": KurtLobe((0.3, 0.1), (1, 0.5, 0.04), 0.25),
}
VIEWS = {"normal": (1.0, 0.0), "slanting": (0.6, 0.7), "grazing": (0.08, 2.0), "rim": (0.01, -1.0)}


def view(cosine, azimuth):
    sine = np.sqrt(1 - cosine**2)
    return np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine])


def sampled_moments(omega_o, lobe, count=400_000):
    rng = np.random.default_rng(5)
    mx, my = slopes(lobe)
    h = kurt_sample(rng.random(count), rng.random(count), mx, my)
    slope = h[:, :2] / h[:, 2:]
    # kurt_sample draws slopes by their density: what is left is what they reflect.
    grey = reflect_slopes(np.broadcast_to(omega_o, h.shape), lobe, slope).grey
    p, share = slope / [mx, my], grey / np.sum(grey)
    mean = share @ p
    return mean, (share[:, None] * p).T @ p - np.outer(mean, mean)


@pytest.mark.parametrize("place", VIEWS)
@pytest.mark.parametrize("name", LOBES)
def test_moments_are_those_of_reflected_samples(name, place):
    omega_o = view(*VIEWS[place])
    mean, covariance = sampled_moments(omega_o, LOBES[name])
    moments = lobe_moments(omega_o, LOBES[name])
    np.testing.assert_allclose(moments.mean, mean, atol=0.03)
    np.testing.assert_allclose(moments.covariance, covariance, atol=0.03)


@pytest.mark.parametrize("name", LOBES)
def test_moments_between_nodes_are_close_to_their_sums(name, rng):
    views = np.stack([view(c**2, a) for c, a in zip(rng.random(40), rng.uniform(-3, 3, 40), strict=True)])
    exact, moments = sum_moments(views, LOBES[name]), lobe_moments(views, LOBES[name])
    np.testing.assert_allclose(moments.mean, exact.mean, atol=0.035)
    np.testing.assert_allclose(moments.covariance, exact.covariance, atol=0.035)


def test_at_grazing_views_the_horizon_cuts_a_lobe_in_half():
    moments = lobe_moments(view(1e-3, 0.0), KurtLobe(0.1))
    # Half a Gaussian times the distance from the edge: mean .5 sqrt(pi), second moment 1.
    assert moments.mean[0] == pytest.approx(0.5 * np.sqrt(np.pi), abs=0.06)
    assert moments.covariance[0, 0] == pytest.approx(1 - np.pi / 4, abs=0.04)
    assert moments.covariance[1, 1] == pytest.approx(0.5, abs=0.02)


def test_points_of_a_mean_have_the_moments_of_the_normal_density():
    for is_wide, count in ((False, 7), (True, 37)):
        points, shares = mean_points(is_wide=is_wide)
        assert len(points) == count
        x, y = points.T
        assert shares @ np.ones(count) == pytest.approx(1)
        for power, expected in ((2, 1.0), (4, 3.0)):
            assert shares @ x**power == pytest.approx(expected, rel=0.08 if is_wide else 1e-9)
            assert shares @ y**power == pytest.approx(expected, rel=0.08 if is_wide else 1e-9)
        assert shares @ (x * y) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("place", VIEWS)
@pytest.mark.parametrize("name", LOBES)
def test_the_mixture_reflects_what_the_lobe_does(name, place):
    # Weights hold the lobe's density over the mixture's: their sum is the albedo, of many samples exactly.
    lobe, omega_o = LOBES[name], nearest_view(view(*VIEWS[place]), is_round=False)
    rng = np.random.default_rng(6)
    mx, my = slopes(lobe)
    h = kurt_sample(rng.random(200_000), rng.random(200_000), mx, my)
    slope = h[:, :2] / h[:, 2:]
    grey = np.mean(reflect_slopes(np.broadcast_to(omega_o, h.shape), lobe, slope).base)
    over = weighted_place(omega_o, lobe)
    mixture = mixture_at(load_table()[64], 64, nearest_aspect(over.rho))
    metal = KurtLobe(lobe.roughness, 1.0, lobe.alpha)
    assert np.sum(view_means(omega_o, metal, mixture, over).gains[..., 0]) == pytest.approx(grey, rel=0.05)


@pytest.mark.parametrize("cosine", [0.01, 0.1, 0.2])
@pytest.mark.parametrize("roughness", [0.4, 0.6])
def test_no_sample_that_counts_is_narrow_because_its_centre_reflects_the_horizon(roughness, cosine):
    for lobe in (KurtLobe(roughness), KurtLobe(roughness, 0.04, 0.5)):
        means = place_means(view(cosine, 0.3), lobe, 5, load_table()[5])
        share = means.gains[..., 0] / np.sum(means.gains[..., 0])
        assert np.all(means.variance[share > 0.02] > 5e-4)


def test_slopes_drift_as_the_middle_of_the_mixture_does():
    lobe = KurtLobe((0.8, 0.4))
    drift = lobe_drift(lobe)
    near, far = (weighted_place(view(c, a), lobe).center for c, a in ((0.999, 0.4), (0.99, 0.4)))
    step = view(0.99, 0.4)[:2] - view(0.999, 0.4)[:2]
    np.testing.assert_allclose(far - near, drift * step, rtol=0.15)
    assert 0 < moment_share((0.9, 0.9)) < moment_share((0.1, 0.1)) < 1


def test_round_lobes_have_the_plane_of_view_for_an_axis():
    for azimuth in (0.0, 1.0, -2.5):
        place = weighted_place(view(0.9, azimuth), KurtLobe(0.9))
        along = view(0.9, azimuth)[:2]
        assert abs(normalize(place.axis1) @ normalize(along)) == pytest.approx(1, abs=1e-9)
        assert place.rho >= 1

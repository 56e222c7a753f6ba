"""The per-pixel estimate: its arithmetic by hand."""

import numpy as np
import pytest

import burnish
from burnish.advice.error_estimate import companion, estimate_errors, own_share
from burnish.frame import Frame
from burnish.report import Report


def test_a_companion_is_the_same_sampler_with_fewer_lookups():
    assert companion(burnish.Matched(14)).samples == 9
    assert companion(burnish.Matched(4)).samples == 2
    assert companion(burnish.Matched(2)).samples == 3
    other = companion(burnish.Importance(30, points="fibonacci", mip_bias=0.5))
    assert (other.samples, other.points, other.mip_bias) == (19, "fibonacci", 0.5)
    other = companion(burnish.Regular(20, threshold=0.1, footprint="published", normalization="projected"))
    assert (other.samples, other.footprint, other.normalization) == (13, "published", "projected")
    assert other.threshold == pytest.approx(0.1)
    assert isinstance(companion(burnish.Prefiltered()), burnish.Matched)


@pytest.mark.parametrize("sampler", [burnish.Regular(1), burnish.Importance(1), burnish.Importance(2)])
def test_a_companion_differs_from_its_sampler(sampler):
    assert companion(sampler).samples != sampler.samples


def test_a_reference_has_no_companion():
    with pytest.raises(
        ValueError, match=r"error_estimate: expected a sampler with a number of samples, .* got Ref"
    ):
        companion(burnish.Reference())


@pytest.fixture
def pictures(rng):
    color = rng.random((12, 17, 3), np.float32)
    fewer = color + 0.1 * rng.standard_normal(color.shape).astype(np.float32)
    alpha = np.zeros((12, 17), np.float32)
    alpha[2:10, 3:15] = 1.0
    return color, fewer, alpha


def test_the_estimate_keeps_the_sum_of_squares(pictures):
    color, fewer, alpha = pictures
    sampler = burnish.Matched(14)
    estimate = estimate_errors(sampler, color, fewer, alpha)
    assert estimate.dtype == np.float32 and estimate.shape == alpha.shape
    assert (estimate[alpha == 0] == 0).all() and (estimate[alpha > 0] > 0).all()
    expected = own_share(sampler) ** 2 * np.mean((color.astype(float) - fewer)[alpha > 0] ** 2)
    assert np.mean(estimate[alpha > 0].astype(float) ** 2) == pytest.approx(expected, rel=1e-5)


def test_without_a_neighbourhood_every_pixel_is_its_own_difference(pictures):
    color, fewer, alpha = pictures
    sampler = burnish.Importance(30)
    estimate = estimate_errors(sampler, color, fewer, alpha, radius_px=0)
    expected = (
        own_share(sampler) * np.sqrt(np.mean((color.astype(float) - fewer) ** 2, axis=-1)) * (alpha > 0)
    )
    np.testing.assert_allclose(estimate, expected, rtol=1e-5)


def test_equal_pictures_have_no_error(pictures):
    color, _, alpha = pictures
    assert (estimate_errors(burnish.Matched(14), color, color, alpha) == 0).all()
    assert (estimate_errors(burnish.Matched(14), color, color, alpha * 0) == 0).all()


def test_a_frame_sums_its_estimate_up(pictures):
    color, fewer, alpha = pictures
    estimate = estimate_errors(burnish.Matched(14), color, fewer, alpha)
    frame = Frame(color, alpha, alpha, color, Report({}), estimate)
    other = Frame(fewer, alpha, alpha, color, Report({}))
    # The companion in place of the truth: then the whole difference is the error.
    assert frame.estimated_error() == pytest.approx(
        own_share(burnish.Matched(14)) * other.error(Frame(color, alpha, alpha, color, Report({}))),
        rel=1e-5,
    )
    with pytest.raises(
        ValueError, match="error_estimate: expected a frame rendered with error_estimate=True"
    ):
        other.estimated_error()
    dark = Frame(color, alpha * 0, alpha, color, Report({}), estimate)
    assert np.isnan(dark.estimated_error())

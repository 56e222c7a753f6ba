import numpy as np
import pytest

from burnish.oracle.importance import fibonacci, hammersley, point_set, radical_inverse
from burnish.oracle.lobe.kurt import kurt_q
from burnish.oracle.regular_pattern import choose_pattern, largest_angle, lobe_solid_angle, sample_pattern


@pytest.mark.parametrize(
    ("roughness", "spacing", "circles", "threshold", "count"),
    [
        (0.1, "s1", 3, 0.1, 19),
        (0.1, "s2", 3, 0.1, 30),
        (0.3, "s2", 3, 0.1, 30),
        (0.1, "s2", 2, 0.2, 14),
        ((0.2, 0.075), "s1", 4, 0.2, 17),
        (0.15, "s2", 3, 0.1, 30),
        (0.15, "s1", 10, 0.01, 271),
    ],
)
def test_published_counts(roughness, spacing, circles, threshold, count):
    assert len(sample_pattern(roughness, spacing, circles, threshold)) == count


@pytest.mark.parametrize(
    ("roughness", "samples", "threshold", "count"),
    [
        (0.1, 19, 0.1, 19),
        (0.1, 30, 0.1, 30),
        (0.1, 14, 0.2, 14),
        ((0.2, 0.075), 17, 0.2, 17),
        (0.15, 270, 0.01, 271),
    ],
)
def test_budget_finds_the_published_patterns(roughness, samples, threshold, count):
    assert len(choose_pattern(roughness, samples, threshold)) == count


def rings(pattern):
    return np.unique(np.round(np.arccos(np.clip(pattern[:, 2], -1, 1)), 9), return_counts=True)


def test_circles_of_an_anisotropic_lobe_lose_samples():
    assert list(rings(sample_pattern((0.2, 0.075), "s1", 4, 0.2))[1]) == [1, 6, 6, 4]


def test_spacings_are_those_of_the_paper():
    reach = largest_angle(0.3, 0.3, 0.1)
    theta, counts = rings(sample_pattern(0.3, "s1", 3, 0.1))
    np.testing.assert_allclose(theta, np.array([0, 1, 2]) * reach / 2.5, atol=1e-8)
    assert list(counts) == [1, 6, 12]
    theta, counts = rings(sample_pattern(0.3, "s2", 3, 0.1))
    np.testing.assert_allclose(theta, np.array([2, 5, 8]) / 3 * reach / (3 + 1 / 6), atol=1e-8)
    assert list(counts) == [4, 10, 16]


@pytest.mark.parametrize("roughness", [(1e-3, 1e-3), (1.0, 1.0), (1.0, 1e-2), (0.05, 0.3), (1.0, 1e-3)])
@pytest.mark.parametrize("threshold", [1e-6, 0.1, 0.999])
def test_patterns_are_unit_vectors_inside_the_lobe(roughness, threshold):
    pattern = choose_pattern(roughness, 30, threshold)
    np.testing.assert_allclose(np.linalg.norm(pattern, axis=-1), 1, atol=1e-14)
    assert np.all(kurt_q(pattern, *roughness) >= threshold)


@pytest.mark.parametrize("samples", [1, 2, 5, 14, 64, 200])
def test_budget_is_met_closely(samples):
    for roughness in (0.05, 0.6, (0.3, 0.05)):
        assert abs(len(choose_pattern(roughness, samples, 0.1)) - samples) <= max(1, 0.15 * samples)


@pytest.mark.parametrize("threshold", [0.0, 1.0, 1.5, -0.1, float("nan")])
def test_threshold_out_of_range_is_refused(threshold):
    with pytest.raises(ValueError, match=r"threshold: expected a number in \(0, 1\)"):
        sample_pattern(0.1, threshold=threshold)


def test_wrong_arguments_are_refused():
    with pytest.raises(ValueError, match="roughness: expected finite slopes > 0"):
        sample_pattern((0.1, 0.0))
    with pytest.raises(ValueError, match="circles: expected an integer >= 1, got 0"):
        sample_pattern(0.1, circles=0)
    with pytest.raises(ValueError, match='spacing: expected "s1" or "s2"'):
        sample_pattern(0.1, spacing="s3")
    with pytest.raises(ValueError, match="samples: expected an integer >= 1, got 0"):
        choose_pattern(0.1, 0)


@pytest.mark.parametrize(("mx", "my"), [(0.1, 0.1), (1.0, 1.0), (1.0, 0.01), (1e-3, 1e-3)])
@pytest.mark.parametrize("threshold", [1e-6, 0.1, 0.9])
def test_solid_angle_of_the_lobe(mx, my, threshold):
    reach = np.sqrt(-np.log(threshold))
    if mx == my:
        # A round cone: 2 pi (1 - cos theta_max), without the cancellation.
        expected = 4 * np.pi * np.sin(np.arctan(reach * mx) / 2) ** 2
    else:
        x, w = np.polynomial.legendre.leggauss(2000)
        px = mx * reach * np.sin(np.pi / 2 * x)[:, None]
        half = my * reach * np.cos(np.pi / 2 * x)[:, None]
        py = half * x[None, :]
        jacobian = mx * reach * np.cos(np.pi / 2 * x) * np.pi / 2
        expected = np.sum(w[:, None] * jacobian[:, None] * w[None, :] * half / (1 + px**2 + py**2) ** 1.5)
    assert lobe_solid_angle(mx, my, threshold) == pytest.approx(expected, rel=1e-9)


def test_radical_inverse_mirrors_bits():
    np.testing.assert_array_equal(
        radical_inverse([0, 1, 2, 3, 4, 2**31]), [0, 0.5, 0.25, 0.75, 0.125, 2.0**-32]
    )


@pytest.mark.parametrize("count", [1, 14, 1000])
def test_point_sets_fill_the_square_evenly(count):
    for points in (hammersley(count), fibonacci(count)):
        assert points.shape == (count, 2)
        assert np.all((points[:, 0] >= 2.0**-24) & (points < 1).all(axis=1) & (points[:, 1] >= 0))
        if count == 1000:
            counts = np.histogram2d(points[:, 0], points[:, 1], bins=5, range=[[0, 1], [0, 1]])[0]
            assert np.max(np.abs(counts - 40)) <= 4


def test_first_points_of_the_sets():
    np.testing.assert_allclose(hammersley(4), [[2.0**-24, 0], [0.25, 0.5], [0.5, 0.25], [0.75, 0.75]])
    golden = (5**0.5 - 1) / 2
    np.testing.assert_allclose(fibonacci(3), [[1 / 6, 0], [0.5, golden], [5 / 6, 2 * golden - 1]])


def test_unknown_point_set_is_refused():
    with pytest.raises(ValueError, match='points: expected "hammersley" or "fibonacci"'):
        point_set("sobol", 4)

"""Errors against values worked out by hand."""

import math

import numpy as np
import pytest

from burnish.study import metrics
from burnish.study.metrics import measure_errors

pytest.importorskip("flip_evaluator")


def grey(*values):
    """(n, 3) float32 with three equal channels."""
    return np.repeat(np.array(values, np.float32)[:, None], 3, axis=1)


def test_errors_of_equal_points_are_zero():
    errors = measure_errors(grey(1, 2, 3), grey(1, 2, 3))
    assert (errors.relative_rmse, errors.display_rms, errors.max_error) == (0.0, 0.0, 0.0)
    assert errors.flip is None


def test_relative_rmse_and_max_error_follow_their_definitions():
    # differences 1 and 0, reference 3 and 4: sqrt((1 + 0) / (9 + 16)); largest 1 over sqrt(25 / 2)
    errors = measure_errors(grey(4, 4), grey(3, 4))
    assert errors.relative_rmse == pytest.approx(0.2)
    assert errors.max_error == pytest.approx(1 / math.sqrt(12.5))


def test_the_tail_of_an_error_is_that_of_the_worst_pixel_in_a_thousand():
    reference = np.ones((2000, 3), np.float32)
    color = reference * np.float32(1.125)
    # even errors: the worst two of 2000 pixels have a thousandth, and the rest errs as much as all
    assert metrics.error_tail(color, reference) == pytest.approx((1e-3, 0.125))
    color[[7, 1999]] = 11.0
    # two pixels of 10 against 1998 of 1/8
    assert metrics.error_tail(color, reference) == pytest.approx((200 / (200 + 1998 / 64), 0.125))
    errors = measure_errors(color, reference)
    assert (errors.worst_share, errors.trimmed_rmse) == metrics.error_tail(color, reference)


def test_the_tail_of_few_or_equal_pixels_is_a_number_or_said_not_to_be():
    assert metrics.error_tail(grey(1, 2), grey(1, 2)) == (0.0, 0.0)
    # one pixel of two is the worst; without it nothing is wrong
    assert metrics.error_tail(grey(4, 4), grey(3, 4)) == (1.0, 0.0)
    share, rest = metrics.error_tail(grey(4), grey(3))
    assert share == 1.0 and math.isnan(rest)
    assert all(math.isnan(value) for value in metrics.error_tail(grey(), grey()))


def test_display_scale_puts_the_98th_percentile_at_one():
    # 101 values 0..100 in each channel: the 98th percentile is 98 exactly
    assert metrics.display_scale(grey(*range(101))) == pytest.approx(1 / 98)
    assert metrics.display_scale(grey(0, 0)) == 1.0
    assert metrics.display_scale(np.zeros((0, 3), np.float32)) == 1.0


def test_display_rms_clips_what_is_brighter_than_the_display():
    reference = grey(*[1.0] * 99, 1000.0)
    brighter = reference.copy()
    brighter[-1] = 5000.0
    assert metrics.display_rms(brighter, reference) == 0.0
    darker = reference.copy()
    darker[0] = 0.5
    # one of a hundred values differs by a half
    assert metrics.display_rms(darker, reference) == pytest.approx(0.5 / 10)


def test_only_covered_pixels_count(rng):
    reference = rng.random((8, 8, 3), np.float32)
    color = reference.copy()
    color[0] += 7.0
    covered = np.ones((8, 8), bool)
    covered[0] = False
    errors = measure_errors(color, reference, covered, with_flip=False)
    assert (errors.relative_rmse, errors.display_rms, errors.max_error) == (0.0, 0.0, 0.0)
    assert measure_errors(color, reference, ~covered, with_flip=False).relative_rmse > 1.0


def test_flip_is_zero_for_equal_pictures_and_grows_with_the_difference(rng):
    reference = rng.random((32, 32, 3), np.float32)
    assert measure_errors(reference, reference).flip == 0.0
    little, much = (measure_errors(reference * scale, reference).flip for scale in (0.95, 0.5))
    assert 0.0 < little < much <= 1.0


def test_flip_is_that_of_the_package(rng):
    import flip_evaluator

    reference = rng.random((16, 24, 3), np.float32) * 0.5
    color = reference[::-1].copy()
    scale = metrics.display_scale(reference)
    shown = [
        metrics.srgb_encode(np.clip(image * scale, 0, 1).astype(np.float32)) for image in (reference, color)
    ]
    _, mean, _ = flip_evaluator.evaluate(*shown, "LDR")
    assert measure_errors(color, reference).flip == pytest.approx(mean, rel=1e-4)
    assert metrics.flip_map(color, reference, scale).shape == (16, 24)


def test_black_references_give_no_number():
    errors = measure_errors(grey(1, 1), grey(0, 0))
    assert math.isnan(errors.relative_rmse) and math.isnan(errors.max_error)


def test_a_missing_flip_package_is_named_with_its_command(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "flip_evaluator", None)
    assert not metrics.has_flip()
    picture = np.ones((4, 4, 3), np.float32)
    assert measure_errors(picture, picture).flip is None
    with pytest.raises(
        ImportError, match=r"FLIP needs the package flip-evaluator; install it with: pip install"
    ):
        measure_errors(picture, picture, with_flip=True)


@pytest.mark.parametrize(
    ("color", "covered", "message"),
    [
        (
            np.ones((3, 3), np.float32),
            None,
            r"color: expected shape \(h, w, 3\) or \(n, 3\) as the reference",
        ),
        (np.ones((2, 3), np.float32), np.ones(3, bool), r"covered: expected shape \(2,\), got \(3,\)"),
    ],
)
def test_wrong_shapes_are_refused(color, covered, message):
    with pytest.raises(ValueError, match=message):
        measure_errors(color, np.ones((2, 3), np.float32), covered)


def test_signed_differences_say_where_a_picture_is_too_bright():
    reference = np.full((2, 2, 3), 0.5, np.float32)
    color = reference.copy()
    color[0, 0], color[0, 1] = 0.25, 0.0
    covered = np.array([[True, True], [True, False]])
    difference = metrics.signed_difference(color, reference, covered)
    # the display's white is the percentile, 0.5
    np.testing.assert_allclose(difference[0], [-0.5, -1.0], rtol=1e-6)
    assert difference[1, 0] == 0.0 and np.isnan(difference[1, 1])

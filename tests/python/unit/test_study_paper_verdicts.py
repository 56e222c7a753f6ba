"""Verdicts on the paper: each can come out either way, by the numbers alone."""

import copy

import pytest

from burnish.study.paper.formula_verdicts import (
    judge_counts,
    judge_energy,
    judge_estimator,
    judge_footprint,
    judge_today,
)
from burnish.study.paper.formulas import examine_formulas
from burnish.study.paper.judging import ORIGINS, Verdict, error_ratios, factor_text, fit_frames, fit_line
from burnish.study.paper.settings import COMPARED, DIFFERENCES, FILTERS, SHARES
from burnish.study.paper.verdicts import (
    judge_comparison,
    judge_differences,
    judge_frames,
    judge_pyramids,
    list_verdicts,
)

ERRORS = {
    "published": 0.1,
    "importance": 0.2,
    "importance_bias": 0.15,
    "footprint": 0.1,
    "exact": 0.1,
    "matched": 0.02,
    "prefiltered": 0.4,
    "published_box": 0.12,
    "published_gauss4": 0.11,
}
COUNTS = (5, 14, 30)


def frame(role, samples, share, ms):
    timing = {"ms": ms, "deviation_ms": 0.0, "runs": 3}
    return {
        "role": role,
        "samples": samples,
        "share": share,
        "covered": share,
        "frame": timing,
        "shade": timing,
    }


def picture(cell, role, error, seed=1):
    return {
        "cell": cell,
        "role": role,
        "seed": seed,
        "relative_rmse": error,
        "display_rms": error / 2,
        "mean_error": 0.0,
    }


@pytest.fixture
def numbers():
    """Numbers under which everything that is measured holds."""
    cells = dict.fromkeys([*COMPARED, *DIFFERENCES])
    pictures = [picture(cell, role, error) for cell in cells for role, error in ERRORS.items()]
    for row in pictures:
        if row["role"] == "published" and row["cell"] in DIFFERENCES:
            for error in ("relative_rmse", "display_rms"):
                row[error] /= 1 + DIFFERENCES.index(row["cell"])
    return {
        "pyramids": [
            {"face_size": size, "filter": name, "ms": 0.01 * size + index + 1, "deviation_ms": 0.1}
            for size in (64, 128)
            for index, name in enumerate(FILTERS)
        ],
        "frames": [
            frame("published", samples, share, 1 + samples * share) for samples in COUNTS for share in SHARES
        ],
        "pictures": pictures,
        "formulas": examine_formulas(),
        "settings": {"frame_size": [1080, 1920]},
        "is_software": True,
    }


def holds(verdicts):
    return [verdict.holds for verdict in verdicts]


def published_frames(numbers, share):
    return [row for row in numbers["frames"] if row["share"] == share]


def set_error(numbers, cell, role, factor):
    for row in numbers["pictures"]:
        if (row["cell"], row["role"]) == (cell, role):
            row["relative_rmse"] *= factor
            row["display_rms"] *= factor


def test_a_line_is_found_and_its_fit_judged():
    line = fit_line([1, 2, 4], [5, 7, 11])
    assert (line.slope, line.intercept, line.r_squared) == pytest.approx((2, 3, 1))
    assert fit_line([1, 2, 3], [1, 3, 1]).r_squared == pytest.approx(0, abs=1e-12)
    assert fit_line([1, 2], [4, 4]).r_squared == 1
    with pytest.raises(ValueError, match=r"xs: expected at least two different values, got \[2, 2\]"):
        fit_line([2, 2], [1, 3])


def test_a_sampler_of_one_count_gets_no_line(numbers):
    rows = [frame("prefiltered", 1, share, 5.0) for share in SHARES]
    assert fit_frames(rows, "prefiltered") == {}
    assert set(fit_frames(numbers["frames"], "published")) == set(SHARES)


def test_everything_can_hold(numbers):
    measured = [
        judge_pyramids,
        judge_frames,
        judge_comparison,
        judge_differences,
        judge_footprint,
        judge_today,
    ]
    for judge in measured:
        verdicts = judge(numbers)
        assert verdicts and all(holds(verdicts)), [str(verdict) for verdict in verdicts]


def test_filtering_dearer_than_a_frame_is_not_efficient(numbers):
    for row in numbers["pyramids"]:
        row["ms"] *= 100
    verdict = judge_pyramids(numbers)[0]
    assert verdict.holds is False and verdict.word == "does not hold"


def test_noise_decides_nothing(numbers):
    for row in [*numbers["pyramids"], *(row["frame"] for row in numbers["frames"])]:
        row["deviation_ms"] = 0.5 * row["ms"]
    assert holds(judge_pyramids(numbers)) == [True, None, True]
    assert holds(judge_frames(numbers)) == [None, None, True]
    assert "times scatter by 50 %" in judge_frames(numbers)[0].by


def test_filters_out_of_order_by_more_than_their_noise_are_seen(numbers):
    gauss4 = next(row for row in numbers["pyramids"] if row["filter"] == "gauss4")
    gauss6 = next(row for row in numbers["pyramids"] if row["filter"] == "gauss6")
    gauss4["ms"] = gauss6["ms"] + 0.15
    assert judge_pyramids(numbers)[1].holds is True
    gauss4["ms"] = gauss6["ms"] + 0.25
    assert judge_pyramids(numbers)[1].holds is False


def test_a_filter_that_makes_errors_larger_is_not_worth_it(numbers):
    set_error(numbers, "14", "published_box", 0.1)
    assert judge_pyramids(numbers)[2].holds is False


def test_frame_times_can_bend_lean_and_be_too_long(numbers):
    bent = copy.deepcopy(numbers)
    published_frames(bent, 0.5)[1]["frame"]["ms"] += 10
    assert judge_frames(bent)[0].holds is False
    leaning = copy.deepcopy(numbers)
    for row in published_frames(leaning, 0.25):
        row["frame"]["ms"] = 1 + row["samples"] * 0.4
    assert holds(judge_frames(leaning))[:2] == [True, False]
    slow = copy.deepcopy(numbers)
    for row in slow["frames"]:
        row["frame"]["ms"] *= 10
    assert holds(judge_frames(slow)) == [True, True, False]
    numbers["frames"] = numbers["frames"][:1]
    assert judge_frames(numbers) == []


def test_regular_sampling_must_beat_importance_sampling_at_its_better_bias(numbers):
    set_error(numbers, "17", "importance_bias", 0.5)
    verdicts = judge_comparison(numbers)
    assert holds(verdicts) == [True, True, False, False, True, True]
    assert "0.75 x" in verdicts[3].by


def test_the_difference_must_shrink_at_every_step_and_leave_no_bias(numbers):
    set_error(numbers, DIFFERENCES[1], "published", 3)
    assert holds(judge_differences(numbers)) == [False, True]
    for row in numbers["pictures"]:
        row["mean_error"] = -0.02
    verdict = judge_differences(numbers)[1]
    assert verdict.holds is False and "off by 2 %" in verdict.by


def test_counts_are_compared_exactly(numbers):
    verdicts = {verdict.claim: verdict for verdict in judge_counts(numbers)}
    assert verdicts["m 0.1, xi0 0.2 gives 14 samples."].holds
    wrong = verdicts["m 0.15, xi0 0.01 gives 270 samples."]
    assert not wrong.holds and wrong.by == "by 1 of 270" and wrong.measured == "271 samples"


def test_the_estimator_is_judged_by_its_albedo(numbers):
    assert holds(judge_estimator(numbers)) == [True, False, False, False]
    for row in [*numbers["formulas"]["furnace"], *numbers["formulas"]["horizon"]]:
        row["clamped"] = row["printed"] = 1.0
    assert all(holds(judge_estimator(numbers)))


def test_the_lobe_is_judged_by_what_it_returns(numbers):
    assert holds(judge_energy(numbers)) == [True, False, False]
    for row in numbers["formulas"]["energy"]:
        row["albedo"] = 0.9
    assert all(holds(judge_energy(numbers)))


def test_a_footprint_of_larger_error_is_seen(numbers):
    set_error(numbers, "14", "footprint", 0.5)
    assert holds(judge_footprint(numbers)) == [False, True, True]


def test_what_is_added_today_can_lose(numbers):
    set_error(numbers, "270", "matched", 20)
    set_error(numbers, "14", "prefiltered", 0.01)
    assert holds(judge_today(numbers)) == [True, True, False, False, True, True]


def test_a_sampler_that_this_build_lacks_gets_no_verdict(numbers):
    numbers["pictures"] = [
        row for row in numbers["pictures"] if row["role"] not in ("matched", "prefiltered")
    ]
    assert judge_today(numbers) == []


def test_ratios_pair_environments(numbers):
    numbers["pictures"] += [picture("14", "published", 0.1, 2), picture("14", "importance", 0.8, 2)]
    numbers["pictures"] += [picture("14", "published", 0.1, 3)]
    ratios = error_ratios(numbers, "14", "importance", "published")
    assert ratios == pytest.approx([2, 8])
    assert factor_text([2.0, 8.0]) == "4.00 x (2.00 to 8.00)"
    assert factor_text([3.0]) == "3.00 x"
    assert factor_text([0.5, 2.0]) == "1.00 x (0.50 to 2.00; environments disagree)"


def test_every_verdict_says_where_its_statement_comes_from(numbers):
    verdicts = list_verdicts(numbers)
    assert {verdict.origin for verdict in verdicts} == set(ORIGINS)
    assert all(verdict.by and verdict.measured for verdict in verdicts)
    assert Verdict("a", "b", "reading", None, "c", "d").word == "not decided"

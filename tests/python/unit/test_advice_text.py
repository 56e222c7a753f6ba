"""What an advice says, as text and as JSON, and what a report makes of it."""

import json

import pytest

import burnish
from burnish.advice.advice import Advice
from burnish.advice.last_resort import MOST_MS, with_last_resort
from burnish.advice.search import Candidate
from burnish.report import Report

CANDIDATES = [
    Candidate("matched:5", "matched", 5, 0.05, 3.0),
    Candidate("matched:14", "matched", 14, 0.018, 6.0, is_probed=True),
    Candidate("regular:30", "regular", 30, 0.04, 9.0),
    Candidate("matched:30", "matched", 30, 0.009, 12.0),
]


def make(meets_target=True, chosen=1, **fields):
    return Advice(0.02, (540, 960), "a device", CANDIDATES, CANDIDATES[chosen], meets_target, **fields)


def test_an_advice_is_a_table_with_its_choice_and_why():
    text = str(make(notes=["measured somehow"], advice_ms=321.0))
    assert text.startswith("target 2 %, 960 x 540, on a device")
    (chosen,) = (line for line in text.splitlines() if line.startswith(">"))
    assert chosen.split() == [">", "matched:14", "1.8", "%", "measured", "6.00", "Pareto"]
    assert (
        "take matched:14: the cheapest that meets the target; error 1.8 %, measured on a small picture"
        in text
    )
    (beaten,) = (line for line in text.splitlines() if "regular:30" in line)
    assert "Pareto" not in beaten and "model" in beaten
    assert "measured somehow" in text and "the advice took 321 ms" in text and "warning" not in text


def test_an_advice_that_fails_says_what_would_not():
    advice = make(meets_target=False, chosen=3)
    assert "no sampler is predicted to meet an error of 2 %" in advice.warning
    assert "matched:30, has 0.9 %" in advice.warning and "Reference(0.02)" in advice.warning
    assert f"warning: {advice.warning}" in str(advice)


def test_an_advice_gives_its_sampler():
    advice = make()
    assert isinstance(advice.sampler, burnish.Matched) and advice.sampler.samples == 14
    assert (advice.predicted_error, advice.predicted_ms, advice.warning) == (0.018, 6.0, None)


def test_a_report_shows_the_prediction():
    advice = make(error_reached=0.0175)
    given = json.loads(json.dumps(advice.to_dict()))
    assert [one["sampler"] for one in given["alternatives"]] == ["matched:5", "matched:14", "matched:30"]
    report = Report({"prediction": given})
    assert report.prediction["sampler"] == "matched:14"
    text = str(report)
    assert "target error 2 %: matched:14, predicted 1.8 % (measured on a small picture), 6.00 ms" in text
    assert "error really reached: 1.75 %" in text
    assert Report({}).prediction is None


@pytest.mark.parametrize(
    ("error", "ms", "taken"), [(0.005, 1000.0, True), (0.005, 2 * MOST_MS, False), (0.5, 1000.0, False)]
)
def test_the_reference_is_the_last_resort_while_it_is_affordable(error, ms, taken):
    candidates, closest = list(CANDIDATES), CANDIDATES[3]
    last = Candidate("reference:0.005", "reference", 4096, error, ms)
    chosen, is_reference = with_last_resort(candidates, closest, last)
    assert is_reference == taken and chosen is (last if taken else closest)
    assert candidates[-1] is last

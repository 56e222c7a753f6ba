"""The decision: the cheapest candidate that meets the target, with few measurements; by made-up numbers."""

import pytest

from burnish.advice.search import Candidate, correct_errors, find_cheapest, pareto


def candidate(family, count, error, ms):
    return Candidate(f"{family}:{count}", family, count, error, ms)


def family(name, factor=1.0, ns=1.0, counts=(4, 8, 16, 32, 64)):
    """Errors of factor/n, prices of ns n."""
    return [candidate(name, n, factor / n, ns * n) for n in counts]


class Truth:
    """Measures true errors that differ from the model's, and counts how often it is asked."""

    def __init__(self, candidates, factors):
        self.errors = {one.sampler: one.predicted_error * factors[one.family] for one in candidates}
        self.asked = []

    def __call__(self, sampler):
        self.asked.append(sampler)
        return self.errors[sampler]


def test_without_measurements_the_model_decides():
    choice = find_cheapest([*family("good"), *family("bad", 4.0)], 0.07)
    assert (choice.chosen.sampler, choice.meets_target) == ("good:16", True)
    assert not any(one.is_probed for one in choice.candidates)


def test_the_cheapest_wins_whatever_its_name_and_order():
    dear, cheap = family("dear", 1.0, 3.0), family("cheap", 2.0, 1.0)
    assert find_cheapest([*dear, *cheap], 0.07).chosen.sampler == "cheap:32"
    assert find_cheapest([*cheap, *dear], 0.07).chosen.sampler == "cheap:32"


@pytest.mark.parametrize("factor", [0.3, 0.6, 1.0, 1.7, 3.0])
def test_the_choice_is_the_cheapest_that_truly_meets_the_target(factor):
    candidates = family("a", counts=tuple(range(2, 65)))
    measure = Truth(candidates, {"a": factor})
    choice = find_cheapest(candidates, 0.05, measure)
    assert choice.meets_target and choice.chosen.is_probed
    assert choice.chosen.count == next(n for n in range(2, 65) if factor / n <= 0.05)
    assert len(measure.asked) <= 5


def test_a_family_that_is_better_than_its_model_is_found_through_its_neighbours():
    candidates = [*family("a"), *family("b", 1.1)]
    measure = Truth(candidates, {"a": 2.0, "b": 0.5})
    choice = find_cheapest(candidates, 0.06, measure)
    assert choice.chosen.sampler == "b:16"
    assert len(set(measure.asked)) == len(measure.asked)


def test_what_nobody_meets_gives_the_closest_and_says_so():
    candidates = [*family("a"), *family("b", 3.0)]
    measure = Truth(candidates, {"a": 4.0, "b": 0.5})
    choice = find_cheapest(candidates, 1e-4, measure)
    assert (choice.chosen.sampler, choice.meets_target) == ("b:64", False)
    assert choice.chosen.predicted_error == pytest.approx(1.5 / 64)


def test_measurements_end():
    candidates = family("a", counts=tuple(range(2, 65)))
    asked = []

    def worse_and_worse(sampler):
        asked.append(sampler)
        return 0.051

    assert not find_cheapest(candidates, 0.05, worse_and_worse, most_probes=6).chosen.is_probed
    assert len(asked) == 6


def test_corrections_are_interpolated_in_the_logarithm_of_the_count():
    candidates = family("a")
    corrected = {one.count: one for one in correct_errors(candidates, {"a:8": 2.0 / 8, "a:32": 0.5 / 32})}
    assert corrected[8].is_probed and not corrected[16].is_probed
    assert corrected[16].predicted_error == pytest.approx(1.0 / 16)
    assert corrected[4].predicted_error == pytest.approx(2.0 / 4)
    assert corrected[64].predicted_error == pytest.approx(0.5 / 64)


def test_other_families_keep_the_models_errors():
    candidates = [*family("a"), *family("b")]
    corrected = correct_errors(candidates, {"a:8": 1.0})
    assert [one.predicted_error for one in corrected if one.family == "b"] == [
        1 / n for n in (4, 8, 16, 32, 64)
    ]


def test_an_error_of_nothing_corrects_without_a_fault():
    candidates = [candidate("a", 4, 1e-5, 1.0), candidate("a", 8, 0.0, 2.0)]
    assert find_cheapest(candidates, 0.01, lambda sampler: 0.0).chosen.count == 4


def test_the_front_holds_what_nothing_beats():
    candidates = [*family("a"), *family("b", 2.0, 1.5), candidate("c", 1, 0.9, 0.5)]
    assert [one.sampler for one in pareto(candidates)] == ["c:1", "a:4", "a:8", "a:16", "a:32", "a:64"]


def test_nothing_to_choose_from_is_refused():
    with pytest.raises(ValueError, match="candidates: expected at least one, got none"):
        find_cheapest([], 0.1)

"""Samplers as text, there and back."""

import contextlib
import typing

import pytest

import burnish
from burnish.oracle.matched_table import COUNTS
from burnish.samplers import (
    FORMS,
    Sampler,
    expand_counts,
    grammar,
    sampler_from_text,
    sampler_parameters,
    sampler_to_text,
)

PAIRS = [
    (lambda: burnish.Regular(14), "regular:14"),
    (lambda: burnish.Regular(30, footprint="published", normalization="published"), "regular:30:published"),
    (lambda: burnish.Regular(7, footprint="published"), "regular:7:footprint=published"),
    (lambda: burnish.Regular(14, threshold=0.1, mip_bias=-0.5), "regular:14:mip_bias=-0.5:threshold=0.1"),
    (lambda: burnish.Importance(5), "importance:5"),
    (
        lambda: burnish.Importance(30, points="fibonacci", mip_bias=1.0),
        "importance:30:fibonacci:mip_bias=1",
    ),
    (lambda: burnish.Matched(14, diffuse="harmonics"), "matched:14:diffuse=harmonics"),
    (lambda: burnish.Regular(5, diffuse="harmonics"), "regular:5:diffuse=harmonics"),
    (lambda: burnish.Importance(5, diffuse="harmonics"), "importance:5:diffuse=harmonics"),
    (lambda: burnish.Prefiltered(diffuse="harmonics"), "prefiltered:diffuse=harmonics"),
    (lambda: burnish.Reference(0.01), "reference:0.01"),
    (lambda: burnish.Reference(0.01, max_samples=512), "reference:0.01:max_samples=512"),
]


@pytest.mark.parametrize(("make", "text"), PAIRS, ids=[text for _, text in PAIRS])
def test_a_text_makes_the_sampler_again(make, text):
    sampler = make()
    assert sampler_to_text(sampler) == text
    again = sampler_from_text(text)
    assert type(again) is type(sampler)
    assert sampler_parameters(again) == sampler_parameters(sampler)


def test_the_method_is_the_text_without_the_count():
    published = burnish.Regular(30, footprint="published", normalization="published")
    assert sampler_to_text(published, with_count=False) == "regular:published"
    assert sampler_to_text(burnish.Importance(9), with_count=False) == "importance"


@pytest.mark.parametrize("name", ["Matched", "Prefiltered"])
def test_every_sampler_of_the_engine_has_a_text(name):
    kind = getattr(burnish._core, name, None)
    if kind is None:
        pytest.skip(f"this build has no {name}")
    text = sampler_to_text(kind())
    assert text.startswith(name.lower())
    assert sampler_parameters(sampler_from_text(text)) == sampler_parameters(kind())


def test_counts_are_written_out():
    assert expand_counts("regular:5,14:published") == ["regular:5:published", "regular:14:published"]
    assert expand_counts("importance:30:fibonacci") == ["importance:30:fibonacci"]
    assert expand_counts("regular") == ["regular"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("regulr:14", "expected matched"),
        ("regular:14:circles=3", "regular:14:circles=3: expected one of .*samples.*, got 'circles'"),
        ("regular:14:threshold=much", "regular:14:threshold=much: "),
        ("regular:14:threshold=2", "threshold"),
        ("matched:14:diffuse=sum", 'diffuse: expected one of "cube", "harmonics", got "sum"'),
        ("reference:diffuse=cube", "expected one of .*standard_error.*, got 'diffuse'"),
    ],
)
def test_wrong_texts_are_refused(text, message):
    with pytest.raises(ValueError, match=message):
        sampler_from_text(text)


def test_the_engine_takes_the_counts_that_mixtures_were_fitted_for():
    taken = []
    for samples in range(1, 100):
        with contextlib.suppress(ValueError):
            burnish.Matched(samples)
            taken.append(samples)
    assert tuple(taken) == COUNTS


def test_the_grammar_names_every_sampler_of_the_engine():
    assert {form.make for form in FORMS.values()} == set(typing.get_args(Sampler))
    assert all(name in grammar() for name in FORMS)

"""The catalogue of hard cases is complete, and its table tells passes from failures."""

import importlib.util
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from burnish import hardcases
from burnish.cli import main
from burnish.hardcases import SAMPLERS, Bound, HardCase, Measurement, Quantity, Table

CASES = hardcases.CASES


def test_every_case_says_why_and_whence_and_what_its_bound_rests_on():
    names = [case.name for case in CASES]
    assert len(names) == len(set(names))
    for case in CASES:
        assert case.why and case.source and case.limit.reason, case.name
        assert set(case.samplers) <= set(SAMPLERS) or case.samplers == ("",)
        assert all(case.limit.of(sampler) >= 0 for sampler in case.samplers)


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_every_sampler_meets_sixty_cases(sampler):
    """Those that concern no sampler hold for each."""
    assert sum(sampler in case.samplers or case.samplers == ("",) for case in CASES) >= 60


def test_a_case_that_raises_fails_and_says_what():
    def broken(bench, sampler):
        raise RuntimeError("no such thing")

    device = SimpleNamespace(driver="some", name="thing", lookup="software", limits={"sub_pixel_bits": 8})
    case = HardCase("x", "y", Quantity("z", broken, Bound(1.0, "r")), "s", ("regular",))
    found = hardcases.measure(case, "regular", hardcases.Bench(device))
    assert not found.passed and found.verdict == "fail" and found.note == "RuntimeError: no such thing"


@pytest.fixture
def table():
    rows = (
        Measurement("a", "regular", "error", 1e-3, 1e-4),
        Measurement("a", "matched", "error", 1e-3, 2e-3),
        Measurement("b", "", "count", 0.0, 1.0, known="counts twice"),
    )
    return Table("some device", "some driver", "sampler", rows)


def test_table_marks_what_failed(table):
    assert [m.case for m in table.failures] == ["a"]
    assert "1 of 3 rows, of 2 cases, within their bounds; 1 known to fail on this driver" in str(table)
    text = table.to_markdown()
    assert "| a | error | 0.0001 / 0.001 |  | **0.002 / 0.001 fail** |  |  |" in text
    assert "| b | count | **1 / 0 known failure** |" in text and "Known failures: counts twice." in text


def test_page_lists_each_case_with_its_reason(table):
    text = hardcases.page([table], CASES)
    for case in CASES:
        assert f"| {case.name} | {case.why} |" in text and f"{case.limit.reason}." in text


def test_a_known_failure_holds_for_its_driver_and_lookup_alone():
    from burnish.hardcases.catalogue import known_failure

    def device(name, lookup):
        return type("Device", (), {"name": name, "driver": "", "lookup": lookup})()

    swift = device("SwiftShader Device", "software")
    assert known_failure(swift, "regular") == known_failure(swift, "") == ""
    assert "stale texels" in known_failure(device("SwiftShader Device", "sampler"), "regular")
    assert known_failure(device("llvmpipe", "sampler"), "regular") == ""


def test_find_case_names_what_it_does_not_find():
    assert hardcases.find_case("map of zeros").name == "map of zeros"
    with pytest.raises(ValueError, match="name: expected that of a hard case, got 'no such case'"):
        hardcases.find_case("no such case")


def test_command_line_wants_hard_cases_where_it_writes_them(capsys):
    assert main(["doctor", "-o", "x.md"]) == 2
    assert "--hard-cases: expected it beside --output and --lookup" in capsys.readouterr().err


def load_mutations():
    path = Path(__file__).resolve().parents[3] / "scripts/mutations.py"
    spec = importlib.util.spec_from_file_location("mutations", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules["mutations"] = module  # its dataclass looks there for itself
    spec.loader.exec_module(module)
    return path.parents[1], module.MUTATIONS


def test_mutations_fit_the_shaders_and_name_cases():
    repository, mutations = load_mutations()
    assert len(mutations) >= 20
    for mutation in mutations:
        assert (repository / mutation.file).read_text().count(mutation.stable) == 1, mutation.name
        for name in mutation.cases:
            samplers = hardcases.find_case(name).samplers
            assert not mutation.samplers or set(mutation.samplers) & set(samplers), (mutation.name, name)


def test_bounds_allow_for_corners_of_the_software_lookup_and_for_coarse_grids():
    from burnish.hardcases.case import Bound

    def device(lookup, bits):
        return SimpleNamespace(lookup=lookup, limits={"sub_pixel_bits": bits})

    bound = Bound({"regular": 1.0}, "reason", corners=2.0, snapped=4.0)
    assert [bound.on(device(*one), "regular") for one in (("sampler", 8), ("software", 8))] == [1.0, 3.0]
    assert [bound.on(device(*one), "regular") for one in (("sampler", 4), ("software", 4))] == [5.0, 7.0]

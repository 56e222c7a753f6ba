"""The worst inputs, each within its bound: the table that `burnish doctor --hard-cases` prints."""

from dataclasses import replace

import numpy as np
import pytest

import burnish
from burnish import hardcases
from hardcase_perturbation import measure_and_perturb, without_device


@pytest.fixture(scope="module")
def bench(device):
    return hardcases.Bench(device)


ROWS = hardcases.rows()


@pytest.mark.parametrize(("case", "sampler"), ROWS, ids=[f"{c.name}-{s}" if s else c.name for c, s in ROWS])
def test_hard_case_is_within_its_bound_and_notices_ten_times_that(bench, case, sampler, monkeypatch):
    found, perturbed = measure_and_perturb(case, sampler, bench)
    if found.known and not found.passed:
        pytest.xfail(found.known)
    assert found.passed, f"{case.quantity.name}: {found.measured:.3g}, at most {found.bound:.3g} {found.note}"
    if not perturbed:
        assert not without_device(case, monkeypatch) <= found.bound
    if hardcases.driver_class(bench.device) == "exact":  # else lookups alone may be off by more
        for one in perturbed:
            assert not one.passed and not one.note, f"{case.quantity.name}: {one.measured:.3g} {one.note}"


@pytest.mark.parametrize(
    "name", ["roughness 0.1", "light times 3", "energy of alpha 0", "rounding, levels of box"]
)
def test_a_scale_wrong_by_a_thousand_is_found(bench, name):
    case = hardcases.find_case(name)

    def lenient(bench, sampler):
        return case.quantity.measure(bench, sampler) / 1000

    wrong = replace(case, quantity=replace(case.quantity, measure=lenient))
    found, perturbed = measure_and_perturb(wrong, case.samplers[0], bench)
    assert found.passed and perturbed and all(one.passed for one in perturbed)


def test_doctor_measures_the_table_and_judges_by_it(device, monkeypatch):
    from burnish.doctor import doctor
    from burnish.hardcases import run

    wanted = [hardcases.find_case(name) for name in ("map of zeros", "roughness 0")]
    monkeypatch.setattr("burnish.hardcases.run", lambda device, progress: run(device, wanted, progress))
    steps = []
    report = doctor(device, hard_cases=True, progress=lambda share, step: steps.append((share, step)))
    assert [m.case for m in report.hard_cases[0].measurements] == ["map of zeros"] * 5 + ["roughness 0"]
    assert steps[0] == (0.0, "map of zeros, regular") and len(steps) == 6
    assert "6 of 6 rows, of 2 cases, within their bounds" in str(report)
    assert report.sections["hard cases"][0].status == "ok"


def test_shaders_of_a_folder_stand_in_for_those_built_in(monkeypatch, tmp_path, uniform):
    """A module that is none is refused by name; what the folder lacks is as ever."""
    monkeypatch.setenv("BURNISH_SPIRV_DIR", str(tmp_path))
    (tmp_path / "shade_shade_prefiltered_comp.spv").write_bytes(b"")
    other, up = burnish.Device(), np.float32([[0, 0, 1]])
    material = burnish.Material(lobes=[burnish.KurtLobe()])
    with pytest.raises(ValueError, match=r"BURNISH_SPIRV_DIR: expected SPIR-V, got .*prefiltered_comp\.spv"):
        burnish.shade(uniform, material, burnish.Prefiltered(), up, up, up, device=other)
    assert burnish.shade(uniform, material, burnish.Importance(2), up, up, up, device=other).min() > 0.5

"""The worst inputs, each within its bound: the table that `burnish doctor --hard-cases` prints."""

import pytest

from burnish import hardcases


@pytest.fixture(scope="module")
def bench(device):
    return hardcases.Bench(device)


ROWS = hardcases.rows()


@pytest.mark.parametrize(("case", "sampler"), ROWS, ids=[f"{c.name}-{s}" if s else c.name for c, s in ROWS])
def test_hard_case_is_within_its_bound(bench, case, sampler):
    found = hardcases.measure(case, sampler, bench)
    if found.known and not found.passed:
        pytest.xfail(found.known)
    assert found.passed, f"{case.quantity.name}: {found.measured:.3g}, at most {found.bound:.3g} {found.note}"


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

"""The doctor names what is missing and the command that installs it, also where nothing can be loaded."""

import os
import subprocess
import sys

import pytest

import burnish
from burnish import _extension
from burnish.doctor import DoctorReport, Finding
from burnish.doctor.examination import _packages

WITHOUT_EXTENSION = """
import sys
class Blocked:
    def find_spec(self, name, path, target=None):
        if name == "burnish._core":
            raise {error}
sys.meta_path.insert(0, Blocked())
"""
NOT_BUILT = "ModuleNotFoundError(\"No module named 'burnish._core'\", name=name)"
NO_LOADER = 'ImportError("libvulkan.so.1: cannot open shared object file: No such file or directory")'


def run(code, **environment):
    return subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        timeout=240,
        env={**os.environ, **environment},
    )


def test_verdict_follows_the_findings():
    good = DoctorReport({"a": [Finding("x", "ok", "fine"), Finding("y", "note", "slow")]})
    assert good.can_render and str(good).endswith("This machine can render.")
    bad = DoctorReport({"a": [Finding("x", "missing", "gone", "sudo apt-get install x")]})
    assert not bad.can_render
    assert "[missing] x: gone" in str(bad) and "-> sudo apt-get install x" in str(bad)
    assert str(bad).endswith("This machine cannot render: 1 problem above.")


def test_missing_packages_are_named_with_the_command(monkeypatch):
    from importlib import metadata

    asked = [
        "numpy>=1.24",
        "absent-thing>=2",
        "matplotlib-absent>=3 ; extra == 'study'",
        "x ; extra == 'test'",
    ]
    monkeypatch.setattr(metadata, "requires", lambda name: asked)
    found = {finding.name: finding for finding in _packages()}
    assert set(found) == {"numpy", "absent-thing", "matplotlib-absent"}
    assert found["numpy"].status == "ok"
    assert (found["absent-thing"].status, found["absent-thing"].remedy) == (
        "missing",
        "pip install 'absent-thing>=2'",
    )
    assert found["matplotlib-absent"].status == "note"


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (NOT_BUILT, "the compiled module burnish._core is missing; build it with: scripts/setup"),
        (NO_LOADER, "libvulkan.so.1 is not installed; install it with: sudo apt-get install libvulkan1"),
        ('ImportError("undefined symbol: vkFoo")', "cannot be loaded: undefined symbol: vkFoo"),
    ],
)
def test_use_without_the_extension_says_what_to_do(error, message):
    result = run(WITHOUT_EXTENSION.format(error=error) + "from burnish import Scene")
    assert result.returncode == 1
    assert result.stderr.splitlines()[-1].startswith("ImportError: burnish.Scene: ")
    assert message in result.stderr.splitlines()[-1]


@pytest.mark.parametrize("error", [NOT_BUILT, NO_LOADER])
def test_doctor_and_help_run_without_the_extension(error):
    block = WITHOUT_EXTENSION.format(error=error)
    call = "from burnish.cli import main; sys.exit(main({arguments}))"
    result = run(block + call.format(arguments=["doctor"]))
    assert result.returncode == 1
    assert "This machine cannot render" in result.stdout
    assert result.stderr == ""
    result = run(block + call.format(arguments=["render", "sphere"]))
    assert result.returncode == 2
    assert result.stderr.startswith("burnish render: error: the ") and result.stderr.count("\n") == 1
    assert run(block + call.format(arguments=["render", "--help"])).returncode == 0


def test_oracle_needs_no_extension():
    code = "import burnish.oracle.lobe.kurt; print('fine')"
    assert run(WITHOUT_EXTENSION.format(error=NOT_BUILT) + code).stdout == "fine\n"


def test_doctor_without_a_driver_names_the_package(tmp_path):
    nowhere = str(tmp_path / "none.json")
    code = "import burnish, sys; r = burnish.doctor(); print(r); sys.exit(0 if r.can_render else 1)"
    result = run(code, VK_DRIVER_FILES=nowhere, VK_ICD_FILENAMES=nowhere)
    assert result.returncode == 1, result.stdout + result.stderr
    assert "sudo apt-get install mesa-vulkan-drivers" in result.stdout


def test_doctor_passes_here(device):
    report = burnish.doctor(device)
    assert report.can_render, str(report)
    text = str(report)
    assert device.name in text and device.driver in text
    for name in (
        "furnace, Regular",
        "furnace, Reference",
        "furnace, diffuse",
        "grazing view",
        "rate",
        "numpy",
    ):
        assert name in text


def test_doctor_reports_an_engine_that_breaks(device, monkeypatch):
    def broken(device):
        raise RuntimeError("lost\nit")

    monkeypatch.setattr(sys.modules["burnish.doctor.self_test"], "run_self_test", broken)
    report = burnish.doctor(device)
    assert not report.can_render
    assert "RuntimeError: lost it" in str(report)


def test_the_reason_of_a_failed_import_is_one_sentence():
    text = _extension.explain(ImportError("libvulkan.so.1: cannot open shared object file"))
    assert text == _extension.LOADER_MISSING and "\n" not in text

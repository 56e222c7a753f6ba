"""Memory that is never given back fails the run, even where its device is closed after the last test."""

import os
import subprocess
import sys

import pytest

import burnish

LEAKING = """
import burnish
from burnish import _core

KEPT = []


def leak(keeps):
    device = burnish.Device(validation=True)
    _core.inject_fault(device, "vkFreeMemory", -13)
    KEPT.extend([device] if keeps else [])


def test_one():
    leak({keeps})
"""


@pytest.mark.parametrize(
    ("code", "told"),
    [
        (LEAKING.format(keeps=False), "1 passed, 1 error"),
        (LEAKING.format(keeps=True), "while closing"),
        (LEAKING.format(keeps=True) + "\n\ndef test_two():\n    KEPT.clear()\n", "2 passed, 1 error"),
        (LEAKING.replace("_core.inject", "False and _core.inject").format(keeps=True), "1 passed"),
    ],
    ids=["in a test", "after the last", "by a later test", "none"],
)
@pytest.mark.slow
def test_memory_that_is_not_given_back_fails_the_run(tmp_path, code, told):
    if not burnish.Device().features["validation"]:
        pytest.skip("the validation layer is not installed")
    (tmp_path / "test_leak.py").write_text(code)
    folder = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "closing_check",
        "-p",
        "no:cacheprovider",
        "test_leak.py",
    ]
    found = subprocess.run(
        command,
        cwd=tmp_path,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([folder, *sys.path])},
        capture_output=True,
        text=True,
        timeout=240,
    )
    said = found.stdout + found.stderr
    assert told in said
    assert found.returncode == (0 if told == "1 passed" else 1), said
    assert ("vkDestroyDevice" in said) == (told != "1 passed")

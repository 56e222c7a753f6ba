"""Every function of glsl/lib and glsl/lobe is probed, and every probe is used by a test."""

import re
from pathlib import Path

import numpy as np
import pytest
from probe import FUNCTION, REPOSITORY, assert_close, lib_functions, probe_numbers

from burnish import _core


def test_every_lib_function_has_a_number():
    numbers = probe_numbers()
    assert set(lib_functions()) == set(numbers)
    assert sorted(numbers.values()) == list(range(len(numbers)))


@pytest.mark.parametrize("name", lib_functions())
def test_every_lib_function_is_run_by_its_probe(name):
    text = (REPOSITORY / f"glsl/probe/{lib_functions()[name]}.comp.glsl").read_text()
    case = re.search(rf"case PROBE_{name.upper()}:(.*?)break;", text, re.DOTALL)
    assert case, f"no case PROBE_{name.upper()}"
    called = [case[1], *(body for helper, body in helpers(text) if re.search(rf"\b{helper}\(", case[1]))]
    assert any(re.search(rf"\b{name}\(", body) for body in called)


def helpers(text):
    """(name, body) of the functions an entry point defines, run() itself left out."""
    found = re.findall(r"^void (\w+)\([^)]*\) \{\n(.*?)^\}", text, re.MULTILINE | re.DOTALL)
    return [(name, body) for name, body in found if name != "run"]


@pytest.mark.parametrize("name", lib_functions())
def test_every_lib_function_is_compared(name):
    tests = "".join(p.read_text() for p in Path(__file__).parent.glob("test_lib_*.py") if p != Path(__file__))
    assert re.search(rf'\(\s*device, "{name}"', tests)


def test_functions_of_any_type_are_found():
    text = (
        "MappedMaterial f(vec3 a,\n    float b) {\nfloat g() { return 1.0; }\nvoid h(int a);\n    int k() {\n"
    )
    assert FUNCTION.findall(text) == ["f", "g"]


def test_a_difference_names_its_input():
    with pytest.raises(AssertionError, match=r"(?s)1 of 3 values.*a = .*7\.0.*error 1, allowed 0\.5"):
        assert_close("f", [1.0, 2, 3], [1.0, 3, 3], 0.5, a=np.array([6.0, 7.0, 8.0]))
    with pytest.raises(AssertionError, match="nan"):
        assert_close("f", [np.nan], [0.0], 1.0)


def test_wrong_arguments_are_refused(device):
    items = np.zeros((2, 1, 4), np.float32)
    with pytest.raises(ValueError, match=r"library: expected one of cube_map, .*, got nothing"):
        _core.probe(device, "nothing", 0, items)
    with pytest.raises(
        ValueError, match=r"arguments: expected C-contiguous float32 of shape \(n, n, 4\), got float64"
    ):
        _core.probe(device, "frame", 0, np.zeros((2, 1, 4)))
    with pytest.raises(ValueError, match=r"arguments: expected 1\.\.16 vec4 an item, got 17"):
        _core.probe(device, "frame", 0, np.zeros((2, 17, 4), np.float32))
    with pytest.raises(ValueError, match=r"arguments: expected 1\.\.\d+ items, got 0"):
        _core.probe(device, "frame", 0, items[:0])

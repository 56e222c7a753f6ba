"""Lists that C++ leads: filters of the pyramid and kinds of textures."""

import re
from pathlib import Path

import pytest

from burnish.filters import FILTERS
from burnish.oracle import pyramid

REPOSITORY = Path(__file__).resolve().parents[3]


def read(path):
    return (REPOSITORY / path).read_text()


def cpp_filters():
    """Name, taps and lookup's variance, by the table of pyramid_filter.h."""
    table = read("cpp/burnish/light/pyramid_filter.h")
    rows = re.findall(r'\{PyramidFilter::(\w+), "(\w+)", (\d), ([\d.]+)f / ([\d.]+)f\}', table)
    assert rows and len(rows) == table.count("{PyramidFilter::")
    assert all(value == name for value, name, *_ in rows)
    return [(name, int(taps), float(over) / float(under)) for _, name, taps, over, under in rows]


def test_filters_are_those_of_cpp():
    names = [name for name, *_ in cpp_filters()]
    assert list(FILTERS) == names
    assert list(pyramid.TAPS) == list(pyramid.LOOKUP_VARIANCE) == names
    assert set(pyramid.Filter.__args__) == set(names)


def test_filters_have_the_numbers_of_the_oracle():
    for name, taps, variance in cpp_filters():
        assert taps == len(pyramid.TAPS[name])
        assert variance == pytest.approx(pyramid.LOOKUP_VARIANCE[name], rel=1e-12)


def test_no_other_list_of_filters_is_written_down():
    """A second tuple of all names would not follow a new filter."""
    written = re.compile(r'"box", "gauss4", "gauss6"')
    allowed = {"python/burnish/filters.py", "python/burnish/oracle/pyramid.py", __file__}
    for folder in ("python", "scripts", "tests/python"):
        for path in (REPOSITORY / folder).rglob("*.py*"):
            name = str(path.relative_to(REPOSITORY))
            if path.suffix in {".py", ".pyi"} and name not in allowed and str(path) not in allowed:
                assert not written.search(path.read_text()), name


def test_kinds_of_textures_are_those_of_the_shaders():
    """A kind is its constant, a row of texture_kinds.h and a field of the material."""
    numbers = dict(re.findall(r"uint TEXTURE_(\w+) = (\d+)u;", read("glsl/shared/constants.h")))
    count = int(numbers.pop("KINDS"))
    assert [int(number) for number in numbers.values()] == list(range(count))
    rows = re.findall(
        r"\{shared::TEXTURE_(\w+),\s*\"[^\"]+\",\s*&MetallicRoughness::(\w+)_texture",
        read("cpp/burnish/scene/texture_kinds.h"),
    )
    assert [kind for kind, _ in rows] == list(numbers)
    assert all(kind.lower() == field for kind, field in rows)
    fields = re.findall(r"TextureUse (\w+)_texture;", read("cpp/burnish/scene/material.h"))
    assert fields == [field for _, field in rows]


def test_every_kind_of_texture_is_read_from_files_and_by_the_shader():
    loader = read("cpp/burnish/scene/gltf/material.cpp")
    shader = read("glsl/surface/surface_varying.glsl")
    for kind, field in re.findall(
        r"\{shared::TEXTURE_(\w+),\s*\"[^\"]+\",\s*&MetallicRoughness::(\w+)_texture",
        read("cpp/burnish/scene/texture_kinds.h"),
    ):
        assert f"source.{field}_texture = " in loader, field
        assert f"(TEXTURE_{kind}," in shader or f"(TEXTURE_{kind})" in shader, kind

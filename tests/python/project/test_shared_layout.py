"""Structs of glsl/shared lie in memory as the shaders see them: SPIR-V offsets against C++ offsetof."""

import os
import re
import struct
from collections import defaultdict
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]
MAGIC = 0x07230203
OP_NAME, OP_MEMBER_NAME, OP_MEMBER_DECORATE = 5, 6, 72
DECORATION_OFFSET = 35
# Shade kernels load these as rows of 16 bytes, which SPIR-V does not know as members.
LOADED_BY_ROWS = {
    "LightRecord",
    "LobeRecord",
    "MapRecord",
    "MaterialRecord",
    "SurfaceRecord",
    "TextureRecord",
}
WHOLE_ROW = re.compile(r"\w+\.(\w+)(?:\[k\])? = uintBitsToFloat\(ROW\(\w+, \w+, (\d+)(?: \+ k)?\)\);")
NEXT_ROW = re.compile(r"row = ROW\(\w+, \w+, (\d+)\);")
PART_OF_ROW = re.compile(r"\w+\.(\w+) = (?:uintBitsToFloat\()?row\.([xyzw]+)\)?;")


def instructions(binary):
    """Opcode and operand words of every instruction of a SPIR-V module."""
    words = struct.unpack(f"<{len(binary) // 4}I", binary)
    assert words[0] == MAGIC
    position = 5
    while position < len(words):
        length, opcode = words[position] >> 16, words[position] & 0xFFFF
        assert length > 0
        yield opcode, words[position + 1 : position + length]
        position += length


def text_of(words):
    return struct.pack(f"<{len(words)}I", *words).split(b"\0", 1)[0].decode()


def struct_layouts(binary):
    """(name, {member: offset}) of every struct that has offsets; one may occur under several layouts."""
    names, members, offsets = {}, defaultdict(dict), defaultdict(dict)
    for opcode, words in instructions(binary):
        if opcode == OP_NAME:
            names[words[0]] = text_of(words[1:])
        elif opcode == OP_MEMBER_NAME:
            members[words[0]][words[1]] = text_of(words[2:])
        elif opcode == OP_MEMBER_DECORATE and words[2] == DECORATION_OFFSET:
            offsets[words[0]][words[1]] = words[3]
    for type_id, found in offsets.items():
        yield names.get(type_id, ""), {members[type_id][index]: offset for index, offset in found.items()}


def mismatches(expected, shader, binary):
    """Differences between C++ and one shader, a sentence each, and the structs that were compared."""
    wrong, seen = [], set()
    for name, layout in struct_layouts(binary):
        if name in expected:
            seen.add(name)
            if layout != expected[name]:
                wrong.append(f"{shader}: {name} is {layout} in the shader, {expected[name]} in C++")
    return wrong, seen


@pytest.fixture(scope="module")
def shaders():
    glsl = REPOSITORY / "glsl"
    # A build folder keeps modules whose sources are gone.
    sources = {
        str(path.relative_to(glsl).with_suffix("")).replace("/", "_").replace(".", "_")
        for path in glsl.rglob("*.glsl")
    }
    folder = os.environ.get("BURNISH_SPIRV_DIR")
    candidates = [Path(folder)] if folder else sorted(REPOSITORY.glob("build/*/spirv"))
    for candidate in candidates:
        found = sorted(path for path in candidate.rglob("*.spv") if path.stem in sources)
        if found:
            return found
    pytest.fail(
        f"no .spv files in {', '.join(map(str, candidates)) or 'build/*/spirv'}; run scripts/setup --test"
    )


@pytest.fixture(scope="module")
def expected():
    from burnish import _core

    return _core.shared_layout()


def test_shared_structs_lie_as_shaders_see_them(shaders, expected):
    wrong = [line for path in shaders for line in mismatches(expected, path.name, path.read_bytes())[0]]
    assert not wrong, "\n".join(wrong)


def test_every_shared_struct_is_in_some_shader(shaders, expected):
    seen = set().union(*(mismatches(expected, path.name, path.read_bytes())[1] for path in shaders))
    assert expected
    assert expected.keys() - seen == LOADED_BY_ROWS


@pytest.mark.parametrize("name", sorted(LOADED_BY_ROWS))
def test_records_are_loaded_from_where_they_lie(expected, name):
    text = "".join((REPOSITORY / f"glsl/{area}/records.glsl").read_text() for area in ("shade", "surface"))
    body = text.split(f"\n{name} load_")[1].split("return")[0]
    offsets, row = {}, None
    for line in body.splitlines():
        if whole := WHOLE_ROW.search(line):
            offsets[whole[1]] = 16 * int(whole[2])
        elif part := PART_OF_ROW.search(line):
            offsets[part[1]] = 16 * row + 4 * "xyzw".index(part[2][0])
        elif following := NEXT_ROW.search(line):
            row = int(following[1])
    fields = {field: offset for field, offset in expected[name].items() if not field.startswith("pad")}
    assert offsets == fields


def test_every_struct_of_the_shared_headers_is_exported(expected):
    """A struct that C++ forgets to export would never be compared."""
    declared = set()
    for path in (REPOSITORY / "glsl/shared").glob("*.h"):
        for line in path.read_text().splitlines():
            if line.startswith("struct "):
                declared.add(line.split()[1])
    assert declared == set(expected)


def test_a_member_out_of_place_is_found(shaders, expected):
    for path in shaders:
        _, seen = mismatches(expected, path.name, path.read_bytes())
        if seen:
            break
    name = min(seen)
    moved = {name: {member: offset + 4 for member, offset in expected[name].items()}}
    assert mismatches(moved, path.name, path.read_bytes())[0]


def test_the_oracle_takes_texels_in_the_parts_that_shaders_do():
    from burnish.oracle.reference import LEAST_QUADRATURE_FACE

    text = (REPOSITORY / "glsl/shared/constants.h").read_text()
    assert f"LEAST_QUADRATURE_FACE = {LEAST_QUADRATURE_FACE}u;" in text

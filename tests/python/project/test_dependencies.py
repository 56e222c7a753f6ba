"""Who may include or import whom."""

import ast
import re
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]

# bindings -> render -> plan -> {sampler, scene} -> {lobe, light} -> error; render -> vulkan -> error;
# all -> glsl/shared.
ALLOWED_CPP = {
    "error": set(),
    "light": {"error", "shared"},
    "lobe": {"error", "shared"},
    "sampler": {"light", "lobe", "error", "shared"},
    "scene": {"light", "lobe", "error", "shared"},
    "plan": {"scene", "sampler", "light", "lobe", "error", "shared"},
    "vulkan": {"error", "shared"},
    "render": {"plan", "scene", "sampler", "light", "lobe", "vulkan", "error", "shared", "spirv"},
}
ALLOWED_CPP["bindings"] = {"render", *ALLOWED_CPP["render"]} - {"spirv"}
MAY_NAME_VULKAN = {"vulkan", "render"}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def cpp_area(path):
    """Folder under cpp/burnish, "bindings", or "error" for the files beside the folders."""
    parts = path.relative_to(REPOSITORY / "cpp").parts
    if parts[0] == "bindings":
        return "bindings"
    return parts[1] if len(parts) > 2 else "error"


def cpp_violations(area, text):
    for quote, name in INCLUDE.findall(text):
        if quote == "<":
            if name.startswith("vulkan/") and area not in MAY_NAME_VULKAN:
                yield f"{area} includes <{name}>"
            continue
        parts = name.split("/")
        if parts[0] == "burnish":
            target = parts[1] if len(parts) > 2 else "error"
        else:
            target = parts[0] if len(parts) > 1 else area
        if target != area and target not in ALLOWED_CPP[area]:
            yield f'{area} includes "{name}"'


def glsl_violations(area, text):
    """Entry points may include their own folder, lookup, lobe, light, lib, shared; lib knows none of them."""
    own = {"shared": {"shared"}, "lib": {"lib", "shared"}}
    own |= {name: {name, "lib", "shared"} for name in ("lobe", "light")}
    allowed = own.get(area, {area, "lookup", "lobe", "light", "lib", "shared"})
    for _, name in INCLUDE.findall(re.sub(r"#ifdef __cplusplus.*?#(else|endif)", "", text, flags=re.DOTALL)):
        if name.split("/")[0] not in allowed:
            yield f'{area} includes "{name}"'


def imported_modules(text, package):
    """Absolute names of everything a module imports, also inside functions."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package.split(".")[: len(package.split(".")) - node.level + 1] if node.level else []
            yield ".".join([*base, *([node.module] if node.module else [])])


def oracle_violations(text, package="burnish.oracle"):
    for name in imported_modules(text, package):
        root = name.split(".")[0]
        if root == "burnish" and not name.startswith("burnish.oracle"):
            yield f"oracle imports {name}"
        elif root not in {"burnish", "numpy", "__future__"} and root not in sys.stdlib_module_names:
            yield f"oracle imports {name}"


def test_cpp_folders_include_only_what_lies_below_them():
    files = [p for p in (REPOSITORY / "cpp").rglob("*") if p.suffix in {".h", ".cpp"}]
    assert len(files) > 20
    unknown = {cpp_area(p) for p in files} - set(ALLOWED_CPP)
    assert not unknown, f"folders without a rule: {unknown}"
    found = [
        f"{p.relative_to(REPOSITORY)}: {v}" for p in files for v in cpp_violations(cpp_area(p), p.read_text())
    ]
    assert not found, "\n".join(found)


def test_glsl_entries_include_lib_and_lib_includes_shared():
    root = REPOSITORY / "glsl"
    files = [p for p in root.rglob("*") if p.suffix in {".glsl", ".h"}]
    assert len(files) > 10
    found = [
        f"{p.relative_to(root)}: {v}"
        for p in files
        for v in glsl_violations(p.relative_to(root).parts[0], p.read_text())
    ]
    assert not found, "\n".join(found)


def test_oracle_imports_numpy_only():
    files = list((REPOSITORY / "python/burnish/oracle").rglob("*.py"))
    assert len(files) > 5
    found = [
        f"{p.name}: {v}"
        for p in files
        for v in oracle_violations(p.read_text(), ".".join(p.parent.relative_to(REPOSITORY / "python").parts))
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize(
    ("area", "line"),
    [
        ("scene", '#include "burnish/vulkan/device.h"'),
        ("vulkan", '#include "burnish/scene/scene.h"'),
        ("scene", "#include <vulkan/vulkan.h>"),
        ("plan", "#include <vulkan/vulkan.h>"),
        ("plan", '#include "burnish/render/renderer.h"'),
        ("sampler", '#include "burnish/plan/plan.h"'),
        ("vulkan", '#include "spirv/shade_shade_pattern_comp.h"'),
    ],
)
def test_a_forbidden_include_is_found(area, line):
    assert list(cpp_violations(area, line))


def test_a_forbidden_glsl_include_or_oracle_import_is_found():
    assert list(glsl_violations("lib", '#include "shade/lobe.glsl"'))
    assert list(glsl_violations("lib", '#include "lobe/kurt.glsl"'))
    assert list(glsl_violations("shared", '#include "lib/frame.glsl"'))
    assert list(glsl_violations("shade", '#include "surface/view.glsl"'))
    assert list(oracle_violations("import scipy.special"))
    assert list(oracle_violations("from burnish import images"))
    assert list(oracle_violations("def f():\n    from .. import _core"))
    assert not list(oracle_violations("import math\nfrom .arrays import Array\nimport numpy.typing as npt"))

"""Each row of the table of effects has its constant in the kernels, and everything is asked of the table."""

import re
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[3]
ROW = re.compile(r'Effect\{shared::(SPEC_\w+),\s*"([^"]+)"')


def test_every_effect_has_a_constant_that_a_kernel_reads():
    rows = ROW.findall((REPOSITORY / "cpp/burnish/plan/effects.cpp").read_text())
    assert len(rows) > 8
    kernels = "\n".join(p.read_text() for p in (REPOSITORY / "glsl").rglob("*.glsl"))
    assert [name for constant, name in rows if f"constant_id = {constant})" not in kernels] == []


def test_every_constant_is_read_by_some_kernel():
    declared = re.findall(
        r"SHARED_CONST uint (SPEC_\w+) =",
        "\n".join(p.read_text() for p in (REPOSITORY / "glsl/shared").rglob("*.h")),
    )
    kernels = "\n".join(p.read_text() for p in (REPOSITORY / "glsl").rglob("*.glsl"))
    assert len(declared) > 25
    assert [one for one in declared if not re.search(rf"\b{one}\b", kernels)] == []


def test_plan_and_renderer_ask_no_sampler_which_it_is():
    found = [
        f"{path.name}: {line.strip()}"
        for folder in ("plan", "render")
        for path in sorted((REPOSITORY / "cpp/burnish" / folder).glob("*"))
        for line in path.read_text().splitlines()
        if "holds_alternative" in line or "get_if<" in line
    ]
    assert found == []


def test_plan_and_renderer_name_no_model_of_a_lobe():
    listed = (REPOSITORY / "cpp/burnish/lobe/lobe.h").read_text()
    models = re.findall(r"\w+Lobe\b", re.search(r"using Lobe = std::variant<([^>]+)>", listed)[1])
    assert models
    found = [
        f"{path.name}: {model}"
        for folder in ("plan", "render")
        for path in sorted((REPOSITORY / "cpp/burnish" / folder).glob("*"))
        for model in models
        if model in path.read_text()
    ]
    assert found == []

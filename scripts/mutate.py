"""Mutation test of the hard cases: see scripts/mutate."""

import argparse
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mutations import MUTATIONS, Mutation

REPOSITORY = Path(__file__).resolve().parents[1]

# Prints the rows beyond their bounds, "case, sampler", as JSON.
MEASURE = """
import json, sys
import burnish
from burnish import hardcases

cases, samplers = json.loads(sys.argv[1])
bench = hardcases.Bench(burnish.Device())
wanted = [hardcases.find_case(name) for name in cases]
done = [hardcases.measure(c, s, bench) for c, s in hardcases.rows(wanted) if not samplers or s in samplers]
print(json.dumps([f"{m.case}, {m.sampler}" if m.sampler else m.case for m in done if not m.passed]))
"""

INTRODUCTION = """# Mutations

Each stable form of a shader is replaced by the naive formula, in a copy, and hard cases are measured
with it: a case that cannot fail proves nothing. Made by `scripts/mutate -o docs/mutations.md`.

| naive formula | in | caught by |
|---|---|---|
"""


def entry_points(glsl: Path, changed: str) -> list[Path]:
    """Entry points that are, or include by any way, the changed file of a glsl folder."""

    def reaches(path: Path) -> bool:
        if path == glsl / changed:
            return True
        return any(reaches(glsl / name) for name in re.findall(r'#include "([^"]+)"', path.read_text()))

    stages = ("*.comp.glsl", "*.vert.glsl", "*.frag.glsl")
    return [p for stage in stages for p in sorted(glsl.rglob(stage)) if "probe" not in p.parts and reaches(p)]


def compile_shader(glsl: Path, entry: Path, folder: Path) -> None:
    """Compile an entry point to the module that BURNISH_SPIRV_DIR takes in its place."""
    stem = entry.relative_to(glsl).as_posix().removesuffix(".glsl")
    stage = stem.rsplit(".", 1)[1]
    target = folder / (stem.replace("/", "_").replace(".", "_") + ".spv")
    command = ["glslangValidator", "-V", "--quiet", "--target-env", "vulkan1.3", "-S", stage, f"-I{glsl}"]
    done = subprocess.run([*command, "-o", str(target), str(entry)], capture_output=True, text=True)
    if done.returncode != 0:
        raise ValueError(f"{entry.name}: expected code that compiles, got {done.stdout[-1000:]}")


def measure(spirv: Path, cases: tuple[str, ...], samplers: tuple[str, ...]) -> list[str]:
    """Return the rows that fail with the modules of a folder; one of the driver counts as a failure."""
    environment = os.environ | {"BURNISH_SPIRV_DIR": str(spirv)}
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, json.dumps([cases, samplers])],
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    if done.returncode < 0:
        return [f"a crash, {signal.Signals(-done.returncode).name}"]
    if done.returncode != 0:
        raise RuntimeError(f"cases could not be measured: {done.stderr[-1000:]}")
    failed: list[str] = json.loads(done.stdout.splitlines()[-1])
    return failed


def try_one(mutation: Mutation) -> list[str]:
    """Return the rows that fail with the naive formula in place, in a copy of the shaders."""
    with tempfile.TemporaryDirectory(prefix="burnish-mutate-") as folder:
        glsl, spirv = Path(folder) / "glsl", Path(folder) / "spirv"
        shutil.copytree(REPOSITORY / "glsl", glsl)
        spirv.mkdir()
        name = mutation.file.removeprefix("glsl/")
        text = (glsl / name).read_text()
        if text.count(mutation.stable) != 1:
            raise ValueError(f"{mutation.name}: expected its stable form once in {mutation.file}")
        (glsl / name).write_text(text.replace(mutation.stable, mutation.naive))
        for entry in entry_points(glsl, name):
            compile_shader(glsl, entry, spirv)
        return measure(spirv, mutation.cases, mutation.samplers)


def run(mutations: list[Mutation], output: str | None) -> int:
    """Try mutations one after the other; 0 if all are caught."""
    with tempfile.TemporaryDirectory() as empty:
        for mutation in mutations:
            before = measure(Path(empty), mutation.cases, mutation.samplers)
            if before:
                raise ValueError(f"{mutation.name}: expected cases that pass without it, got {before}")
    lines, missed = [], 0
    for mutation in mutations:
        began = time.monotonic()
        failed = try_one(mutation)
        missed += not failed
        verdict = "; ".join(failed) if failed else "**missed**"
        lines.append(f"| {mutation.name} | {mutation.file} | {verdict} |")
        seconds = time.monotonic() - began
        print(f"{'caught' if failed else 'MISSED'}: {mutation.name} ({seconds:.0f} s): {verdict}", flush=True)
    summary = f"{len(mutations) - missed} of {len(mutations)} caught."
    print(summary)
    if output:
        Path(output).write_text(INTRODUCTION + "\n".join(lines) + f"\n\n{summary}\n", encoding="utf-8")
    return 1 if missed else 0


def main() -> int:
    parser = argparse.ArgumentParser(prog="scripts/mutate", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="NAME", help="parts of names of mutations (default: all)")
    parser.add_argument("--list", action="store_true", help="name the mutations and try none")
    parser.add_argument("-o", "--output", metavar="FILE", help="write the table as Markdown")
    options = parser.parse_args()
    wanted = [m for m in MUTATIONS if not options.names or any(name in m.name for name in options.names)]
    if options.list:
        print("\n".join(f"{m.name}  ({m.file})" for m in wanted))
        return 0
    return run(wanted, options.output)


if __name__ == "__main__":
    sys.exit(main())

"""Mutation test of the hard cases: see scripts/mutate."""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from mutations import MUTATIONS, Mutation

REPOSITORY = Path(__file__).resolve().parents[1]

# Prints one JSON object: rows beyond their bounds, as "case, sampler".
MEASURE = """
import json, sys
import burnish
from burnish import hardcases

cases, samplers = json.loads(sys.argv[1])
bench = hardcases.Bench(burnish.Device())
wanted = [hardcases.find_case(name) for name in cases]
done = [hardcases.measure(c, s, bench) for c, s in hardcases.rows(wanted) if not samplers or s in samplers]
print(json.dumps({"rows": len(done), "failed": [f"{m.case}, {m.sampler}" for m in done if not m.passed]}))
"""

INTRODUCTION = """# Mutations

Each stable form of a shader is replaced by the naive formula, in a copy of the tree, and hard cases are
measured with it: a case that cannot fail proves nothing. Made by `scripts/mutate -o docs/mutations.md`.

| naive formula | in | caught by |
|---|---|---|
"""


def copy_tree(target: Path) -> None:
    """Copy what git tracks or would track."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=REPOSITORY,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.splitlines()
    for name in listed:
        if (REPOSITORY / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(REPOSITORY / name, target / name)


def configure(tree: Path) -> None:
    """Configure a build that puts the extension beside the copy's Python files."""
    folder = subprocess.run(
        [sys.executable, "-m", "pybind11", "--cmakedir"], check=True, capture_output=True, text=True
    ).stdout.strip()
    options = [
        "-G",
        "Ninja",
        "-DCMAKE_BUILD_TYPE=Release",
        "-DBURNISH_IN_PLACE=ON",
        f"-Dpybind11_DIR={folder}",
        f"-DPython_EXECUTABLE={sys.executable}",
    ]
    subprocess.run(["cmake", "-S", tree, "-B", tree / "build", *options], check=True, capture_output=True)


def build(tree: Path) -> str:
    """Build the copy; return the compiler's complaint, "" where there is none."""
    done = subprocess.run(
        ["cmake", "--build", tree / "build", "--target", "_core"], capture_output=True, text=True
    )
    return "" if done.returncode == 0 else (done.stdout + done.stderr)[-2000:]


def measure(tree: Path, cases: tuple[str, ...], samplers: tuple[str, ...]) -> dict:
    """Measure cases on the copy; a crash counts as a failure of all."""
    environment = os.environ | {"PYTHONPATH": str(tree / "python"), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, "-c", MEASURE, json.dumps([cases, samplers])],
        env=environment,
        capture_output=True,
        text=True,
        timeout=600,
    )
    if done.returncode != 0:
        return {"rows": 1, "failed": [f"crash: {done.stderr.strip().splitlines()[-1:]}"]}
    return json.loads(done.stdout.splitlines()[-1])


def try_one(tree: Path, mutation: Mutation) -> list[str]:
    """Return the rows that fail with the naive formula in place; the copy is as before afterwards."""
    path = tree / mutation.file
    text = path.read_text()
    if text.count(mutation.stable) != 1:
        raise ValueError(f"{mutation.name}: expected its stable form once in {mutation.file}")
    path.write_text(text.replace(mutation.stable, mutation.naive))
    try:
        complaint = build(tree)
        if complaint:
            raise ValueError(f"{mutation.name}: expected code that compiles, got {complaint}")
        return measure(tree, mutation.cases, mutation.samplers)["failed"]
    finally:
        path.write_text(text)


def run(mutations: list[Mutation], output: str | None) -> int:
    """Try mutations one after the other; 0 if all are caught."""
    with tempfile.TemporaryDirectory(prefix="burnish-mutate-") as folder:
        tree = Path(folder)
        print("building a copy of the tree", flush=True)
        copy_tree(tree)
        configure(tree)
        complaint = build(tree)
        if complaint:
            print(complaint, file=sys.stderr)
            return 2
        cases = tuple(dict.fromkeys(name for mutation in mutations for name in mutation.cases))
        before = measure(tree, cases, ())
        if before["failed"]:
            print(f"cases that fail without any mutation: {before['failed']}", file=sys.stderr)
            return 2
        lines, missed = [], 0
        for mutation in mutations:
            began = time.monotonic()
            failed = try_one(tree, mutation)
            missed += not failed
            verdict = "; ".join(failed) if failed else "**missed**"
            lines.append(f"| {mutation.name} | {mutation.file} | {verdict} |")
            seconds = time.monotonic() - began
            print(
                f"{'caught' if failed else 'MISSED'}: {mutation.name} ({seconds:.0f} s): {verdict}",
                flush=True,
            )
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

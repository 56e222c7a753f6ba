"""What the README prints as code runs as it is printed, in an empty folder."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from burnish.cli import make_parser

README = Path(__file__).parents[3] / "README.md"
pytestmark = pytest.mark.slow

TESTED_ELSEWHERE = {
    "burnish study --paper -o paper.html": "test_study_paper_run.py",
    "burnish doctor --hard-cases": "test_hardcases.py",
}
"""Commands that take minutes, and the tests of what they do; here only their arguments are read."""


def blocks(language):
    """Code blocks of the README in that language."""
    return re.findall(rf"```{language}\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)


def commands():
    """Lines of the command line's block, without their comments."""
    lines = [line.split("  #")[0].strip() for block in blocks("sh") for line in block.splitlines()]
    return [line for line in lines if line.startswith("burnish ")]


def run(folder, *arguments):
    """Run Python there, on the package under test."""
    done = subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        timeout=900,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "BURNISH_VALIDATION": "0"},
    )
    assert done.returncode == 0, f"exit {done.returncode}: {done.stderr[-2000:]}"


def test_the_snippets_run_one_after_the_other(tmp_path):
    pytest.importorskip("matplotlib")
    assert len(blocks("python")) >= 3
    (tmp_path / "snippets.py").write_text("\n".join(blocks("python")), encoding="utf-8")
    run(tmp_path, "snippets.py")
    made = {path.name for path in tmp_path.iterdir()}
    assert {"picture.exr", "picture.png", "curves.png", "page.html", "rows.jsonl"} <= made


@pytest.mark.parametrize("line", commands())
def test_a_shell_line_runs(line, tmp_path):
    words = shlex.split(line)
    if line in TESTED_ELSEWHERE:
        assert (Path(__file__).parent / TESTED_ELSEWHERE[line]).is_file()
        make_parser().parse_args(words[1:])
        return
    run(tmp_path, "-m", *words)
    options = make_parser().parse_args(words[1:])
    outputs = getattr(options, "output", None) or []
    for name in [outputs] if isinstance(outputs, str) else outputs:
        assert (tmp_path / name).stat().st_size > 0


def test_the_block_of_shell_lines_was_found():
    assert {shlex.split(line)[1] for line in commands()} == {"render", "explain", "study", "advise", "doctor"}

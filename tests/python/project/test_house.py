"""House rules that a machine can hold."""

import re
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]
SOURCES = ("cpp", "glsl", "python", "tests", "scripts", "cmake")
SUFFIXES = {".cpp", ".h", ".glsl", ".py", ".pyi", ".cmake", ".txt", ""}
# Style asks for 300 lines and one job; beyond this a file must be split.
MOST_LINES = 400
# Numbers made by a script beside them.
DATA_FILES = {"python/burnish/tables/matched.txt", "python/burnish/tables/student.txt"}
# Spelled in parts so that this file passes its own test.
UNFINISHED = re.compile(r"\b(TO" r"DO|FIX" r"ME|X" r"XX)\b(?!\(?\s*#\d+)")
DEAD_CODE = re.compile(r"^\s*#\s*if 0\b", re.MULTILINE)
HOME_PATHS = re.compile(r"/(home/[a-z]\w*|Users/\w+|ro" r"ot|wo" r"rk)/")
ANY_ERROR = re.compile(r"pytest\.raises\((Exception|Base" r"Exception)\b")


def text_files():
    for folder in SOURCES:
        for path in sorted((REPOSITORY / folder).rglob("*")):
            parts = path.relative_to(REPOSITORY).parts
            if (
                path.is_file()
                and path.suffix in SUFFIXES
                and not any(p.startswith((".", "__")) for p in parts[:-1])
            ):
                yield path


@pytest.fixture(scope="module")
def texts():
    found = {
        path.relative_to(REPOSITORY).as_posix(): path.read_text(encoding="utf-8") for path in text_files()
    }
    assert len(found) > 50
    return found


def test_no_file_is_too_long(texts):
    long = {
        name: text.count("\n")
        for name, text in texts.items()
        if text.count("\n") > MOST_LINES and name not in DATA_FILES
    }
    assert not long


@pytest.mark.parametrize(
    ("rule", "pattern"),
    [
        ("what is unfinished names its issue: #number", UNFINISHED),
        ("dead code is deleted", DEAD_CODE),
        ("no path of one machine", HOME_PATHS),
        ("tests name the error they expect", ANY_ERROR),
    ],
)
def test_nothing_of_the_forbidden_is_written(texts, rule, pattern):
    found = [
        f"{name}:{text.count(chr(10), 0, match.start()) + 1}: {match.group()}"
        for name, text in texts.items()
        for match in pattern.finditer(text)
    ]
    assert not found, f"{rule}\n" + "\n".join(found)


def test_the_patterns_find_what_they_are_for():
    assert UNFINISHED.search("// TO" + "DO later") and not UNFINISHED.search("// TO" + "DO(#12) later")
    assert DEAD_CODE.search("#if 0\n") and not DEAD_CODE.search("#if 0x10\n#ifdef A")
    assert HOME_PATHS.search("/ho" + "me/someone/x") and not HOME_PATHS.search("/usr/share/x")


def test_text_files_end_in_one_newline_and_hold_no_tabs(texts):
    wrong = [
        name for name, text in texts.items() if text and (not text.endswith("\n") or text.endswith("\n\n"))
    ]
    assert not wrong
    assert not [name for name, text in texts.items() if "\t" in text]


@pytest.mark.parametrize(
    "script",
    [
        "scripts/setup",
        "scripts/demo",
        "scripts/test",
        "scripts/lint",
        "scripts/fuzz",
        "scripts/sanitize",
        "scripts/newer-driver",
        ".ci/run",
    ],
)
def test_scripts_are_executable_and_parse(script):
    path = REPOSITORY / script
    assert path.stat().st_mode & 0o111
    assert path.read_text().splitlines()[0] == "#!/usr/bin/env bash"
    assert "set -euo pipefail" in path.read_text()
    subprocess.run(["bash", "-n", path], check=True)


def test_ci_runs_the_same_tests_as_people_do():
    assert "scripts/test" in (REPOSITORY / ".ci/run").read_text()
    for script in ("scripts/test", "scripts/demo"):
        assert "scripts/setup" in (REPOSITORY / script).read_text()


def test_lint_versions_are_the_same_everywhere():
    hooks = (REPOSITORY / ".pre-commit-config.yaml").read_text()
    pinned = dict(
        line.split("==")
        for line in (REPOSITORY / "scripts/lint-requirements.txt").read_text().splitlines()
        if "==" in line
    )
    assert f"rev: v{pinned['ruff']}" in hooks
    assert f"rev: v{pinned['clang-format']}" in hooks

"""The script that unpacks a newer driver says in one sentence why it cannot; its tests are then skipped."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[3]
TOOLS = ("bash", "dirname", "sed", "grep", "head", "mkdir", "rm", "id", "tail")


@pytest.fixture
def checkout(tmp_path):
    """A tree that nothing was unpacked in."""
    (tmp_path / "scripts").mkdir()
    shutil.copy(REPOSITORY / "scripts/newer-driver", tmp_path / "scripts")
    return tmp_path


def run(checkout, *arguments, **environment):
    done = subprocess.run(
        ["bash", checkout / "scripts/newer-driver", *arguments],
        capture_output=True,
        text=True,
        env=os.environ | environment,
    )
    return done.returncode, done.stdout, done.stderr


def test_help_and_arguments(checkout):
    status, text, _ = run(checkout, "--help")
    assert status == 0 and "VK_DRIVER_FILES" in text and not text.startswith("#")
    assert run(checkout, "--aside") == (1, "", "newer-driver: expected no argument, got '--aside'\n")


def test_without_apt_it_says_so(checkout, tmp_path):
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in TOOLS:
        (tools / name).symlink_to(shutil.which(name))
    expected = "newer-driver: no newer driver without apt-get, which is not here\n"
    assert run(checkout, PATH=str(tools)) == (1, "", expected)


@pytest.mark.skipif(shutil.which("apt-get") is None, reason="needs apt-get")
@pytest.mark.parametrize(
    ("sources", "words"),
    [
        ("", "apt has no source for"),
        ("deb [trusted=yes] file:/nowhere/at/all {codename} main\n", "apt-get update failed: E: "),
    ],
)
def test_without_backports_it_says_why(checkout, tmp_path, sources, words):
    release = dict(
        line.split("=", 1) for line in Path("/etc/os-release").read_text().splitlines() if "=" in line
    )
    if release.get("ID") != "debian":
        pytest.skip("only Debian has these backports")
    (tmp_path / "sources.list").write_text(sources.format(codename=release["VERSION_CODENAME"]))
    (tmp_path / "apt.conf").write_text(
        f'Dir::Etc::SourceList "{tmp_path}/sources.list"; Dir::Etc::SourceParts "/dev/null";\n'
    )
    status, text, said = run(checkout, APT_CONFIG=str(tmp_path / "apt.conf"))
    assert status == 1 and text == ""
    assert said.splitlines()[-1].startswith("newer-driver: no newer driver: ") and words in said


def test_one_that_is_unpacked_is_named_again(checkout):
    folder = checkout / "build/newer-driver"
    folder.mkdir(parents=True)
    (folder / "libvulkan_lvp_aside.so").touch()
    (folder / "lvp_icd.json").write_text(f'{{"library_path": "{folder}/libvulkan_lvp_aside.so"}}')
    assert run(checkout) == (0, f"VK_DRIVER_FILES={folder}/lvp_icd.json\n", "")


def test_ci_runs_tests_on_it_as_people_do():
    assert "scripts/test --newer-driver" in (REPOSITORY / ".ci/run").read_text()
    assert "scripts/newer-driver" in (REPOSITORY / "scripts/test").read_text()

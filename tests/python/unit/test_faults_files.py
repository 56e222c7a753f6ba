"""A full disk, and a process that is killed while it saves: the old file or the whole new one."""

import json
import os
import resource
import signal
import stat
import subprocess
import sys
import textwrap
import time
from contextlib import contextmanager

import numpy as np
import pytest

import burnish
from burnish.frame import Frame
from burnish.images.files import replacing, write_text
from burnish.report import Report
from burnish.study.journal import Journal
from burnish.study.runner import run_cells
from burnish.study.store import PictureStore
from study_support import FakeSubject, grey_picture, make_cell


@pytest.fixture(scope="module")
def frame():
    random = np.random.default_rng(7)
    color = random.random((64, 80, 3), np.float32)  # noise, so that no compression makes it small
    ones = np.ones((64, 80), np.float32)
    report = Report({"passes": [{"name": "shade " + 99 * "x", "milliseconds": k} for k in range(99)]})
    return Frame(color, ones, ones, color, report)


@pytest.fixture(scope="module")
def study():
    samplers = [f"regular:{count}" for count in range(5, 30)]
    return run_cells([make_cell(FakeSubject(), samplers, 1)], Journal(), PictureStore(), True, False)


SAVERS = {
    "frame.exr": lambda frame, study, path: frame.save(path),
    "frame.png": lambda frame, study, path: frame.save(path),
    "report.json": lambda frame, study, path: frame.report.save(path),
    "study.json": lambda frame, study, path: study.save_json(path),
    "study.csv": lambda frame, study, path: study.save_csv(path),
    "study.html": lambda frame, study, path: study.save_html(path),
    "plot.svg": lambda frame, study, path: study.plot(path),
    "plot.png": lambda frame, study, path: study.plot(path),
    "picture.npz": lambda frame, study, path: PictureStore(path.parent).put(
        path.stem, grey_picture(shape=(64, 80))
    ),
}


@contextmanager
def file_size_limit(size_bytes):
    """Let the system refuse to write beyond this size, as it does where the disk is full."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size_bytes, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture(scope="module")
def warm(frame, study, tmp_path_factory):
    """Every saver has run once: fonts and caches that a library writes must not meet the full disk first."""
    folder = tmp_path_factory.mktemp("warm")
    for name, save in SAVERS.items():
        save(frame, study, folder / name)
        assert (folder / name).stat().st_size > 2048, "must be more than the full disk takes"


@pytest.mark.parametrize("has_old", [True, False], ids=["over an old file", "new"])
@pytest.mark.parametrize("name", SAVERS)
def test_a_full_disk_is_told_and_leaves_what_was_there(frame, study, warm, tmp_path, name, has_old):
    path = tmp_path / name
    if has_old:
        path.write_bytes(b"old")
    with file_size_limit(2048), pytest.raises(burnish.FileError, match=f"{name}: cannot be written: "):
        SAVERS[name](frame, study, path)
    assert [one.name for one in tmp_path.iterdir()] == ([name] if has_old else [])
    assert not has_old or path.read_bytes() == b"old"
    SAVERS[name](frame, study, path)
    assert path.stat().st_size > 2048


@pytest.mark.parametrize("name", [name for name in SAVERS if name != "picture.npz"])
def test_the_words_of_the_system_are_passed_on(frame, study, warm, tmp_path, name):
    """The device that is always full stands in for a disk, behind a name with the right ending."""
    path = tmp_path / name
    path.symlink_to("/dev/full")
    with pytest.raises(
        burnish.FileError, match=rf"{name}: cannot be written: .*(No space left on device|28)"
    ):
        SAVERS[name](frame, study, path)
    assert stat.S_ISCHR(os.stat("/dev/full").st_mode) and path.is_symlink()


def test_links_stay_links(tmp_path):
    path, link = tmp_path / "file.txt", tmp_path / "link.txt"
    link.symlink_to(path)
    for text in ("one", "two"):
        write_text(link, text)
        assert path.read_text() == text and link.is_symlink()


def test_a_new_file_has_the_rights_of_any_new_file(tmp_path):
    (tmp_path / "plain").touch()
    write_text(tmp_path / "written", "text")
    assert (tmp_path / "written").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_an_interruption_leaves_what_was_there(tmp_path):
    path = tmp_path / "file.txt"
    path.write_text("old")
    with pytest.raises(KeyboardInterrupt), replacing(path) as temporary:
        with open(temporary, "w") as stream:
            stream.write("half")
        raise KeyboardInterrupt
    assert [(one.name, one.read_text()) for one in tmp_path.iterdir()] == [("file.txt", "old")]


KILLED = """
    import sys
    from pathlib import Path
    import numpy as np
    from burnish.frame import Frame
    from burnish.images.files import write_text
    from burnish.report import Report

    path = Path(sys.argv[1])
    color = np.random.default_rng(7).random((1024, 1024, 3), np.float32)
    frame = Frame(color, color[..., 0], color[..., 1], color, Report({"passes": []}))
    text = "line\\n" * 20_000_000
    print("ready", flush=True)
    while True:
        write_text(path, text) if path.suffix == ".json" else frame.save(path)
"""


@pytest.mark.parametrize("name", ["frame.exr", "frame.png", "report.json"])
def test_a_process_that_is_killed_while_saving_leaves_the_old_file(tmp_path, name):
    """It is killed as soon as anything in the folder changes, long before so much is written."""
    path = tmp_path / name
    path.write_bytes(b"old")
    before = path.stat().st_mtime_ns
    child = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(KILLED), str(path)],
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
    )
    try:
        assert child.stdout.readline() == b"ready\n"
        limit = time.monotonic() + 100
        while len(os.listdir(tmp_path)) == 1 and path.stat().st_mtime_ns == before:
            assert child.poll() is None and time.monotonic() < limit, "nothing was saved"
    finally:
        child.kill()
        child.communicate()
    assert child.returncode == -signal.SIGKILL
    assert path.read_bytes() == b"old"
    left = [one.name for one in tmp_path.iterdir() if one.name != name]
    assert len(left) == 1 and left[0].startswith(f".{name}-") and left[0].endswith(f".part{path.suffix}")


def row(key):
    return {"key": key, "runs": 5, "text": 100 * "x"}


def test_a_journal_on_a_full_disk_ends_with_a_whole_row(tmp_path):
    path = tmp_path / "rows.jsonl"
    journal = Journal(path)
    journal.append(row("a"))
    with (
        file_size_limit(path.stat().st_size + 50),
        pytest.raises(burnish.FileError, match=r"rows\.jsonl: cannot be written: File too large"),
    ):
        journal.append(row("b"))
    assert journal.find("b") is None
    journal.append(row("c"))
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == ["a", "c"]
    assert Journal(path).find("c") == row("c")


def test_a_study_on_a_full_disk_goes_on_when_there_is_room(tmp_path):
    path = tmp_path / "rows.jsonl"
    cells = [make_cell(FakeSubject("one")), make_cell(FakeSubject("two"))]
    run_cells(cells[:1], Journal(path), PictureStore(), False, False)
    with (
        file_size_limit(path.stat().st_size + 50),
        pytest.raises(burnish.FileError, match="cannot be written"),
    ):
        run_cells(cells, Journal(path), PictureStore(), False, False)
    assert len(path.read_text().splitlines()) == 3
    study = run_cells(cells, Journal(path), PictureStore(), False, False)
    assert [one["scene"] for one in study.rows] == ["one"] * 3 + ["two"] * 3
    assert cells[0].source.open().drawn.count(5) == 4, "what was kept is not measured again"


@pytest.mark.parametrize("option", ["-o", "--report"])
def test_the_command_line_names_the_file_in_one_line(tmp_path, option):
    path = tmp_path / "out.png"
    path.symlink_to("/dev/full")
    arguments = ["render", "sphere", "--face-size", "8", "--size", "16x16", "-q", option, str(path)]
    result = subprocess.run(
        [sys.executable, "-m", "burnish", *arguments], capture_output=True, text=True, timeout=240
    )
    assert (result.returncode, result.stdout) == (2, "")
    expected = f"burnish render: error: {path}: cannot be written: No space left on device\n"
    assert result.stderr == expected

"""What a study keeps on disk, whatever happens to the process."""

import json

import numpy as np
import pytest

import burnish
from burnish.study.journal import Journal
from burnish.study.store import PictureStore
from study_support import grey_picture


def row(key, runs=5):
    return {"key": key, "runs": runs, "relative_rmse": 0.1}


def test_rows_are_found_again(tmp_path):
    path = tmp_path / "study.jsonl"
    journal = Journal(path)
    assert journal.find("a") is None and not path.exists()
    journal.append(row("a"))
    journal.append(row("b", runs=2))
    again = Journal(path)
    assert again.find("a") == row("a")
    assert again.find("b") == row("b", 2) and again.find("b", least_runs=3) is None
    again.append(row("b", runs=7))
    assert Journal(path).find("b", least_runs=3) == row("b", 7)


def test_a_row_that_was_cut_short_is_dropped_and_the_next_is_whole(tmp_path):
    path = tmp_path / "study.jsonl"
    Journal(path).append(row("a"))
    with open(path, "a") as stream:
        stream.write('{"key": "b", "ru')
    journal = Journal(path)
    assert journal.find("a") and journal.find("b") is None
    journal.append(row("c"))
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == ["a", "c"]


@pytest.mark.parametrize("text", ["nonsense\n", "[1, 2]\n", '{"key": "a"}\n', "\xff\n"])
def test_other_files_are_refused_and_left_alone(tmp_path, text):
    path = tmp_path / "notes.txt"
    path.write_text(text)
    with pytest.raises(burnish.FileError, match=r"notes.txt: line 1: expected a row of a study, got"):
        Journal(path)
    assert path.read_text() == text


def test_the_folder_must_exist(tmp_path):
    with pytest.raises(burnish.FileError, match="expected an existing folder"):
        Journal(tmp_path / "absent" / "study.jsonl")


def test_pictures_are_found_again(tmp_path):
    picture = grey_picture(0.5)
    PictureStore(tmp_path / "pictures").put("key", picture)
    found = PictureStore(tmp_path / "pictures").get("key")
    np.testing.assert_array_equal(found.color, picture.color)
    np.testing.assert_array_equal(found.covered, picture.covered)
    assert (found.color.dtype, found.covered.dtype, found.standard_error) == (np.float32, bool, 0.25)
    assert PictureStore(tmp_path / "pictures").get("other") is None
    assert [path.name for path in (tmp_path / "pictures").iterdir()] == ["key.npz"]


def test_a_damaged_picture_is_as_good_as_none(tmp_path):
    store = PictureStore(tmp_path)
    store.put("key", grey_picture())
    path = tmp_path / "key.npz"
    path.write_bytes(path.read_bytes()[:100])
    assert PictureStore(tmp_path).get("key") is None


def test_what_is_forgotten_is_read_from_its_file(tmp_path):
    for store, is_kept in ((PictureStore(), False), (PictureStore(tmp_path), True)):
        store.put("key", grey_picture())
        assert store.get("key") is not None
        store.forget("key")
        assert (store.get("key") is not None) == is_kept

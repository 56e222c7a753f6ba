"""What is drawn how often, what the rows say, and what an interruption leaves."""

import math

import numpy as np
import pytest

from burnish.study.journal import Journal
from burnish.study.runner import StudyInterrupted, run_cells
from burnish.study.store import PictureStore
from study_support import FakeSubject, grey_picture, make_cell


def run(cells, journal=None, store=None, keeps_pictures=True):
    return run_cells(cells, journal or Journal(), store or PictureStore(), keeps_pictures, False)


def stripped(row):
    return {key: value for key, value in row.items() if key != "date"}


def test_samplers_are_warmed_up_and_then_take_turns():
    subject = FakeSubject()
    run([make_cell(subject, repeats=2)])
    assert subject.drawn == [0, 5, 10, 20, 5, 10, 20, 5, 10, 20]


def test_a_row_says_what_was_measured():
    first, second, third = run([make_cell(FakeSubject())]).rows
    assert [row["sampler"] for row in (first, second, third)] == ["regular:5", "regular:10", "importance:20"]
    assert (third["method"], third["requested_samples"], third["samples"]) == ("importance", 20, 20)
    # too bright by 1/5 where the reference is 1; the background of 100 would hide it
    assert first["relative_rmse"] == pytest.approx(0.2) and first["max_error"] == pytest.approx(0.2)
    assert first["display_rms"] == 0.0
    # the warm-up takes 5 ms and does not count; then 6, 7, 8
    assert (first["frame_ms"], first["frame_deviation_ms"], first["runs"]) == (7.0, 1.0, 3)
    assert (first["shade_ms"], first["wall_ms"], first["compile_ms"]) == (5.0, 8.0, 7.0)
    assert first["passes_ms"] == {"shade 0": 5.0}
    assert (first["reference"], first["reference_standard_error"]) == ("reference:0.01", 0.001)
    assert (first["device"], first["driver"]) == ("a <fast> device", "its driver")
    assert len({row["key"] for row in (first, second, third)}) == 3


def test_the_study_has_the_pictures_in_the_order_of_the_rows():
    study = run([make_cell(FakeSubject("one")), make_cell(FakeSubject("two"))])
    assert [cell.cell["scene"] for cell in study.pictures] == ["one", "two"]
    assert list(study.pictures[0].pictures) == ["regular:5", "regular:10", "importance:20"]
    assert study.pictures[0].pictures["regular:10"][0, 1, 0] == pytest.approx(1.1)
    assert not run([make_cell(FakeSubject())], keeps_pictures=False).pictures


def test_cells_that_share_a_reference_draw_it_once():
    one, two = FakeSubject(), FakeSubject()
    two.fingerprint = lambda with_filter=True: "fake gauss6" if with_filter else "fake "
    for keeps_pictures in (True, False):
        one.drawn, two.drawn = [], []
        run([make_cell(one), make_cell(two)], keeps_pictures=keeps_pictures)
        assert (one.drawn.count(0), two.drawn.count(0)) == (1, 0)


def test_pictures_that_are_not_kept_are_nowhere(tmp_path):
    store = PictureStore(tmp_path)
    cells = [make_cell(FakeSubject("one")), make_cell(FakeSubject("two"))]
    run(cells, store=store, keeps_pictures=False)
    assert not store._pictures
    # references are dear, so their files stay
    assert {path.stem for path in tmp_path.iterdir()} == {cell.reference_key() for cell in cells}


def test_pictures_that_a_journal_lacks_are_said_to(tmp_path):
    cells = [make_cell(FakeSubject())]
    journal, store = Journal(tmp_path / "j.jsonl"), PictureStore(tmp_path)
    assert run(cells, journal, store, keeps_pictures=False).notes == []
    study = run(cells, Journal(tmp_path / "j.jsonl"), store)
    assert study.notes == ["Some rows come from a journal that kept no pictures of them."]
    assert study.pictures[0].pictures == {}
    assert run([make_cell(FakeSubject("other"))], keeps_pictures=True).notes == []


@pytest.mark.parametrize("with_pictures", [True, False])
def test_a_journal_takes_up_where_it_stopped(tmp_path, with_pictures):
    path = tmp_path / "study.jsonl"

    def open_store():
        return PictureStore(tmp_path / "pictures" if with_pictures else None)

    whole = run([make_cell(FakeSubject())])
    run([make_cell(FakeSubject(), samplers=["regular:10"])], Journal(path), open_store())
    subject = FakeSubject()
    study = run([make_cell(subject)], Journal(path), open_store())
    assert 10 not in subject.drawn and subject.drawn.count(5) == 4
    assert (0 in subject.drawn) == (not with_pictures)
    assert [stripped(row) for row in study.rows] == [stripped(row) for row in whole.rows]

    idle = FakeSubject()
    again = run([make_cell(idle)], Journal(path), open_store())
    assert idle.drawn == [] and again.rows == study.rows
    assert bool(again.pictures) == with_pictures and bool(again.notes) == (not with_pictures)


def test_more_runs_are_measured_anew(tmp_path):
    path = tmp_path / "study.jsonl"
    run([make_cell(FakeSubject(), repeats=2)], Journal(path))
    fewer, more = FakeSubject(), FakeSubject()
    assert run([make_cell(fewer, repeats=1)], Journal(path)).rows[0]["runs"] == 2
    assert run([make_cell(more, repeats=4)], Journal(path)).rows[0]["runs"] == 4
    assert fewer.drawn == [] and more.drawn


def test_an_interruption_keeps_the_rows_of_finished_cells(tmp_path):
    path = tmp_path / "study.jsonl"
    cells = [make_cell(FakeSubject("one")), make_cell(FakeSubject("two", fails_at=2))]
    with pytest.raises(StudyInterrupted) as caught:
        run(cells, Journal(path))
    assert [row["scene"] for row in caught.value.study.rows] == ["one"] * 3
    assert isinstance(caught.value, KeyboardInterrupt)
    study = run(cells, Journal(path))
    assert cells[0].source.open().drawn.count(5) == 4
    assert [row["scene"] for row in study.rows] == ["one"] * 3 + ["two"] * 3


def test_an_interruption_amid_the_runs_keeps_what_their_rounds_say(tmp_path):
    path = tmp_path / "study.jsonl"
    # reference, three warm-ups, two rounds of three, and one picture of the third round
    cell = make_cell(FakeSubject(fails_at=1 + 3 + 6 + 1), repeats=5)
    with pytest.raises(StudyInterrupted) as caught:
        run([cell], Journal(path))
    assert [row["runs"] for row in caught.value.study.rows] == [2, 2, 2]
    assert caught.value.study.rows[0]["frame_ms"] == 6.5
    # they are not what was asked for, so the next attempt measures them
    assert [row["runs"] for row in run([cell], Journal(path)).rows] == [5, 5, 5]


def test_black_references_give_no_number_that_json_cannot_hold():
    store = PictureStore()
    cell = make_cell(FakeSubject())
    black = grey_picture(0.0)
    store.put(cell.reference_key(), black)
    rows = run([cell], store=store).rows
    assert [row["relative_rmse"] for row in rows] == [None] * 3
    assert not any(isinstance(value, float) and math.isnan(value) for row in rows for value in row.values())
    assert np.all(black.color == 0)

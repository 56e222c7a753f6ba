"""Studies on several workers: the same rows, and none lost with a worker."""

import logging
import os
import signal
import threading
import time

import pytest

import burnish
from burnish.study import sweep
from burnish.study.cluster import measure_remotely
from burnish.study.sweep import make_cells

distributed = pytest.importorskip("distributed")

MATERIALS = [burnish.Material(lobes=[burnish.KurtLobe(roughness=m)]) for m in (0.1, 0.4)]
GRID = {
    "samplers": ["regular:5", "importance:5"],
    "environments": ["studio:face_size=16", "spots:face_size=16:seed=2", "sky:face_size=16"],
    "materials": MATERIALS,
    "reference": "reference:0.1",
    "size": (24, 32),
    "repeats": 1,
}


def without_times(study):
    return [
        {key: value for key, value in row.items() if not key.endswith("_ms") and key != "date"}
        for row in study.rows
    ]


@pytest.fixture(scope="module")
def alone():
    return sweep(**GRID, progress=False)


@pytest.fixture
def two_workers():
    """Two worker processes that are restarted when they die."""
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with distributed.LocalCluster(**options, silence_logs=logging.CRITICAL) as cluster:
        yield cluster


def test_cells_travel_to_other_processes():
    from distributed.protocol import deserialize, serialize

    (cell,) = make_cells(["regular:5"], materials=MATERIALS[:1], reference="reference:0.1")
    again = deserialize(*serialize(cell))
    assert again.row_key("regular:5") == cell.row_key("regular:5")
    assert again.reference_key() == cell.reference_key()


def test_a_worker_measures_what_this_process_does(alone):
    cells = make_cells(**GRID)
    rows, pictures = measure_remotely(cells[0], cells[0].samplers, True)
    study = type(alone)(rows)
    assert without_times(study) == without_times(alone)[:2]
    assert set(pictures) == {"reference", "regular:5", "importance:5"}
    assert measure_remotely(cells[0], ["regular:5"], False)[1] == {}


@pytest.mark.slow
def test_two_workers_give_the_rows_of_one_process(alone, tmp_path):
    study = sweep(**GRID, workers=2, keep_pictures=True, journal=tmp_path / "j.jsonl", progress=False)
    assert without_times(study) == without_times(alone)
    assert len(study.pictures) == 6 and all(len(cell.pictures) == 2 for cell in study.pictures)
    assert study.notes and "2 workers measured at the same time on 127.0.0.1" in study.notes[0]
    # all is in the journal: no cluster is needed any more
    assert sweep(**GRID, workers=2, journal=tmp_path / "j.jsonl", progress=False).rows == study.rows


@pytest.mark.slow
def test_a_killed_worker_loses_nothing(alone, two_workers, tmp_path):
    journal = tmp_path / "j.jsonl"
    victim = next(iter(two_workers.workers.values())).pid
    killed = []

    def kill_amid_the_work():
        limit = time.monotonic() + 120
        while time.monotonic() < limit:
            if journal.exists() and journal.read_text().count("\n") >= 2:
                os.kill(victim, signal.SIGKILL)
                killed.append(journal.read_text().count("\n"))
                return
            time.sleep(0.005)

    killer = threading.Thread(target=kill_amid_the_work)
    killer.start()
    study = sweep(**GRID, scheduler=two_workers.scheduler_address, journal=journal, progress=False)
    killer.join()
    assert killed and killed[0] < len(alone.rows), "the worker was not killed amid the work"
    assert without_times(study) == without_times(alone)


def test_an_absent_scheduler_is_an_error_with_its_address(monkeypatch):
    monkeypatch.setattr("burnish.study.cluster.CONNECT_TIMEOUT_S", 0.5)
    with pytest.raises(OSError, match=r"127\.0\.0\.1:9"):
        sweep(**GRID, scheduler="tcp://127.0.0.1:9", progress=False)

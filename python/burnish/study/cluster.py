"""Cells measured by the workers of dask.distributed, on this machine or on many."""

import logging
import signal
import threading
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

from burnish.study.extras import missing_extra
from burnish.study.journal import Journal
from burnish.study.measure import Cell, measure_cell
from burnish.study.rows import Row
from burnish.study.runner import (
    StudyInterrupted,
    collect,
    forget_reference,
    missing_samplers,
    step_bar,
)
from burnish.study.store import PictureStore, StoredPicture
from burnish.study.study import Study

CONNECT_TIMEOUT_S = 20
RETRIES = 1
"""Of a cell that failed with an error. A cell whose worker was lost goes to another one in any case."""

# One process may have several worker threads; two cells at the same time would spoil each other's times.
_one_at_a_time = threading.Lock()
_worker_store = PictureStore()
_finished_cells: list[Cell] = []


def measure_remotely(
    cell: Cell, samplers: Sequence[str], wants_pictures: bool
) -> tuple[list[Row], dict[str, StoredPicture]]:
    """Measure a cell in a worker's process, with a device of its own.

    Parameters
    ----------
    cell : Cell
        What is drawn.
    samplers : sequence of str
        Those of the cell's that are still missing.
    wants_pictures : bool
        Whether pictures travel back.

    Returns
    -------
    rows : list of dict
        One for each sampler.
    pictures : dict of StoredPicture
        By sampler, and ``reference``; empty if they are not wanted.
    """
    with _one_at_a_time:
        while _finished_cells:  # the reference of the cell before may serve this one as well
            forget_reference(_worker_store, _finished_cells.pop(), [cell])
        rows = measure_cell(cell, samplers, _worker_store, lambda count, what: None, wants_pictures).rows
        _finished_cells.append(cell)
        keys = {text: cell.picture_key(text) for text in samplers} if wants_pictures else {}
        found = {name: _worker_store.get(key) for name, key in keys.items()}
        for key in keys.values():
            _worker_store.forget(key)
        if wants_pictures:
            found["reference"] = _worker_store.get(cell.reference_key())
    return rows, {name: picture for name, picture in found.items() if picture is not None}


@contextmanager
def _connect(scheduler: str | None, workers: int) -> Iterator[Any]:
    """Give a client of the scheduler, or of a cluster of processes that ends with the block."""
    try:
        from distributed import Client, LocalCluster
    except ImportError as error:
        raise missing_extra("dask[distributed]", "cluster", "A study on several workers") from error
    if scheduler is not None:
        with Client(scheduler, timeout=CONNECT_TIMEOUT_S, set_as_default=False) as client:
            yield client
        return
    local: dict[str, Any] = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None}
    with (
        LocalCluster(**local, silence_logs=logging.CRITICAL) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        client.register_worker_callbacks(_ignore_interrupts)
        yield client


def _ignore_interrupts() -> None:
    """Let Ctrl-C, which a terminal sends to all processes, end the study here and not its workers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _shared_machines(client: Any) -> list[str]:
    """Say which machines several workers share: there they disturb one another's times."""
    hosts = Counter(urlsplit(address).hostname or address for address in client.ncores())
    return [
        f"{count} workers measured at the same time on {host}: their times are longer than one's alone."
        for host, count in sorted(hosts.items())
        if count > 1
    ]


def run_cells_on_cluster(
    cells: Sequence[Cell],
    journal: Journal,
    store: PictureStore,
    keeps_pictures: bool,
    shows_progress: bool,
    command: str = "",
    scheduler: str | None = None,
    workers: int = 2,
) -> Study:
    """Measure what the journal does not have yet on the workers of a cluster.

    Parameters
    ----------
    cells : sequence of Cell
        Their sources must be descriptions, and files must be found under the same names by every worker.
    journal : Journal
        Gets every row as soon as its cell is finished, in the order in which they are.
    store : PictureStore
        Gets the pictures, if they are kept.
    keeps_pictures : bool
        Whether pictures travel back.
    shows_progress : bool
        Whether a bar is shown on a terminal.
    command : str
        Command line that made the study.
    scheduler : str or None
        Address such as ``tcp://host:8786``. None: worker processes are started here.
    workers : int
        How many, without a scheduler.

    Returns
    -------
    study : Study
        Rows in the cells' order.

    Raises
    ------
    StudyInterrupted
        At Ctrl-C, with the rows so far.
    """
    missing = {
        index: samplers for index, cell in enumerate(cells) if (samplers := missing_samplers(cell, journal))
    }
    pictures = store if keeps_pictures else None
    if not missing:
        return collect(cells, journal, pictures, command)
    steps = sum(cells[index].steps(len(samplers)) for index, samplers in missing.items())
    notes: list[str] = []
    with _connect(scheduler, workers) as client, step_bar(steps, shows_progress) as advance:
        futures = {
            client.submit(
                measure_remotely,
                cells[index],
                samplers,
                keeps_pictures,
                pure=False,
                retries=RETRIES,
                priority=-index,
            ): index
            for index, samplers in missing.items()
        }
        try:
            for index, rows, drawn in _finished(client, futures):
                cell = cells[index]
                _keep(cell, rows, drawn, journal, store)
                advance(cell.steps(len(missing[index])), rows[-1]["environment"])
            notes += _shared_machines(client)
        except KeyboardInterrupt as interruption:
            client.cancel(list(futures))
            raise StudyInterrupted(collect(cells, journal, pictures, command, notes)) from interruption
    return collect(cells, journal, pictures, command, notes)


def _finished(
    client: Any, futures: dict[Any, int]
) -> Iterator[tuple[int, list[Row], dict[str, StoredPicture]]]:
    """Give the results as they come."""
    from distributed import KilledWorker, as_completed

    for future in as_completed(list(futures), loop=client.loop):
        try:
            rows, drawn = future.result()
        except KilledWorker as error:
            raise RuntimeError(
                "study: a cell ended the process of every worker that tried it; its workers' logs say why"
            ) from error
        yield futures[future], rows, drawn
        future.release()


def _keep(
    cell: Cell, rows: Sequence[Row], drawn: dict[str, StoredPicture], journal: Journal, store: PictureStore
) -> None:
    """Take in a finished cell, under the names it has here: a worker may see other times of files."""
    reference = drawn.pop("reference", None)
    if reference is not None:
        store.put(cell.reference_key(), reference)
    for text, picture in drawn.items():
        store.put(cell.picture_key(text), picture)
    for row in rows:
        journal.append(row | {"key": cell.row_key(row["sampler"])})

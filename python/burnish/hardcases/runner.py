"""Measure cases on a device."""

import math
from collections.abc import Callable, Sequence

import numpy as np

from burnish._core import Device
from burnish.hardcases.bench import Bench
from burnish.hardcases.case import HardCase, Measurement
from burnish.hardcases.catalogue import CASES, known_failure
from burnish.hardcases.table import Table


def rows(cases: Sequence[HardCase] = CASES) -> list[tuple[HardCase, str]]:
    """Return every case with every sampler that it runs with, "" for none: the rows of the table."""
    return [(case, sampler) for case in cases for sampler in case.samplers]


def measure(case: HardCase, sampler: str, bench: Bench) -> Measurement:
    """Measure one case with one sampler.

    Parameters
    ----------
    case : HardCase
        One of ``CASES``.
    sampler : str
        One of ``case.samplers``.
    bench : Bench
        Keeps maps between cases: ``Bench(device)``.

    Returns
    -------
    measurement : Measurement
        Where the case raised an error, it failed and the note says which.
    """
    bound = case.limit.on(bench.device, sampler)
    measured, note = math.nan, ""
    try:
        with np.errstate(all="ignore"):
            measured = case.quantity.measure(bench, sampler)
    except Exception as error:  # the table goes on, whatever broke
        note = f"{type(error).__name__}: {' '.join(str(error).split())}"
    known = known_failure(bench.device, sampler)
    return Measurement(case.name, sampler, case.quantity.name, bound, measured, known, note)


def run(
    device: Device,
    cases: Sequence[HardCase] = CASES,
    progress: Callable[[float, str], None] | None = None,
) -> Table:
    """Measure all cases.

    Parameters
    ----------
    device : Device
        The device under test.
    cases : sequence of HardCase
        Those to measure.
    progress : callable or None
        Called with the share done, 0..1, and the case's name; an exception that it raises stops the run.

    Returns
    -------
    table : Table
        Printable, and as Markdown.
    """
    bench = Bench(device)
    wanted = rows(cases)
    measurements = []
    for k, (case, sampler) in enumerate(wanted):
        if progress is not None:
            progress(k / len(wanted), f"{case.name}, {sampler}" if sampler else case.name)
        measurements.append(measure(case, sampler, bench))
    return Table(device.name, device.driver, device.lookup, tuple(measurements))

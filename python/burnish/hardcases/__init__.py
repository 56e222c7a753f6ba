"""The worst inputs, each with a bound: tests and ``burnish doctor --hard-cases`` measure them on any device.

``CASES`` is the catalogue; `measure` runs one case with one sampler, `run` all of them.
"""

from burnish.hardcases.bench import Bench
from burnish.hardcases.case import SAMPLERS, Bound, HardCase, Measurement, Quantity
from burnish.hardcases.catalogue import CASES, KNOWN_FAILURES, find_case
from burnish.hardcases.driver import driver_class
from burnish.hardcases.runner import measure, rows, run
from burnish.hardcases.table import Table, page

__all__ = [
    "CASES",
    "KNOWN_FAILURES",
    "SAMPLERS",
    "Bench",
    "Bound",
    "HardCase",
    "Measurement",
    "Quantity",
    "Table",
    "driver_class",
    "find_case",
    "measure",
    "page",
    "rows",
    "run",
]

"""All cases, and what drivers are known to fail."""

from burnish.hardcases import (
    frame_cases,
    invariant_cases,
    loader_cases,
    lobe_cases,
    map_cases,
    picture_cases,
    pyramid_cases,
    view_cases,
)
from burnish.hardcases.case import HardCase

CASES: tuple[HardCase, ...] = (
    *lobe_cases.CASES,
    *view_cases.CASES,
    *frame_cases.CASES,
    *map_cases.CASES,
    *loader_cases.CASES,
    *invariant_cases.CASES,
    *pyramid_cases.CASES,
    *picture_cases.CASES,
)

#: (part of the driver's name, case, sampler) -> why it fails there and by how much.
KNOWN_FAILURES: dict[tuple[str, str, str], str] = {}


def find_case(name: str) -> HardCase:
    """Return the case of that name.

    Parameters
    ----------
    name : str
        As in the table.

    Raises
    ------
    ValueError
        If there is none.
    """
    for case in CASES:
        if case.name == name:
            return case
    raise ValueError(f"name: expected that of a hard case, got {name!r}")


def known_failure(driver: str, case: str, sampler: str) -> str:
    """Return the reason why this driver fails a case, "" where it must pass."""
    for (part, failing, which), reason in KNOWN_FAILURES.items():
        if part in driver.lower() and failing == case and which == sampler:
            return reason
    return ""

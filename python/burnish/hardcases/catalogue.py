"""All cases, and what drivers are known to fail."""

from dataclasses import dataclass

from burnish._core import Device
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
from burnish.hardcases.case import ONCE, SAMPLERS, HardCase

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


@dataclass(frozen=True)
class KnownFailure:
    """Rows that a driver fails for a reason of its own; where one passes all the same, it passes.

    Parameters
    ----------
    driver : str
        Part of the device's or the driver's name, in lower case.
    lookup : str
        How maps are read; "": any way.
    samplers : tuple of str
        Those of the rows.
    reason : str
        Why, and by how much.
    """

    driver: str
    lookup: str
    samplers: tuple[str, ...]
    reason: str

    def fits(self, device: Device, sampler: str) -> bool:
        """Whether it says anything of a row on a device."""
        return (
            self.driver in f"{device.name} {device.driver}".lower()
            and self.lookup in ("", device.lookup)
            and sampler in self.samplers
        )


_STALE = (
    "in compute shaders SwiftShader's sampler reads stale texels beyond the edges of cube faces: nothing is "
    "lost in the middle of faces, 5 % where lookups are wide, up to all in levels of few texels"
)
KNOWN_FAILURES = (KnownFailure("swiftshader", "sampler", (*SAMPLERS, *ONCE), _STALE),)


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


def known_failure(device: Device, sampler: str) -> str:
    """Return the reason why this device fails a sampler's rows, "" where they must pass."""
    return next((known.reason for known in KNOWN_FAILURES if known.fits(device, sampler)), "")

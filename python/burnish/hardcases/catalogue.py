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
    cases : tuple of str
        Names of the rows' cases; empty: any.
    """

    driver: str
    lookup: str
    samplers: tuple[str, ...]
    reason: str
    cases: tuple[str, ...] = ()

    def fits(self, device: Device, case: str, sampler: str) -> bool:
        """Whether it says anything of a row on a device."""
        return (
            self.driver in f"{device.name} {device.driver}".lower()
            and self.lookup in ("", device.lookup)
            and sampler in self.samplers
            and (not self.cases or case in self.cases)
        )


_STALE = (
    "in compute shaders SwiftShader's sampler reads stale texels beyond the edges of cube faces: nothing is "
    "lost in the middle of faces, 5 % where lookups are wide, up to all in levels of few texels"
)
_PICTURES = (
    KnownFailure(
        "swiftshader",
        "",
        ONCE,
        "SwiftShader drops triangles whose corners lie 1e18 away",
        ("wall at distance 1e18",),
    ),
    KnownFailure(
        "swiftshader",
        "",
        ONCE,
        "SwiftShader moves corners of triangles to a grid of 1/16 pixel: mirrored facets differ by 5 %",
        ("mirrored object",),
    ),
)
KNOWN_FAILURES = (
    *_PICTURES,
    KnownFailure(
        "swiftshader",
        "software",
        ("regular", "matched"),
        "SwiftShader's texel buffers hold 65536 elements: VulkanError refuses faces of 128 and more",
        ("faces of 2048 texels", "sun of half a degree, split off"),
    ),
    KnownFailure("swiftshader", "sampler", (*SAMPLERS, *ONCE), _STALE),
)


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


def known_failure(device: Device, case: str, sampler: str) -> str:
    """Return the reason why this device fails a row, "" where it must pass."""
    return next((known.reason for known in KNOWN_FAILURES if known.fits(device, case, sampler)), "")

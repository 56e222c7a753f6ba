"""ICC profiles of RGB and grey pictures: a curve a channel, and a matrix.

Profiles that hold tables in place of those are refused by a ValueError, and the reader says so.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.images import primaries

Curve = Callable[[NDArray[np.float64]], NDArray[np.float64]]
# Parameters of a parametric curve by its kind (ICC.1:2022, 10.18).
_PARAMETERS = (1, 3, 4, 5, 7)


@dataclass
class Profile:
    """What a profile says."""

    name: str
    curves: list[Curve]
    """One, or one a channel: encoded share to linear share."""
    rec709: NDArray[np.float64] | None
    """Matrix from its linear RGB; None for grey, which needs none."""


def _tags(profile: bytes) -> dict[bytes, bytes]:
    if len(profile) < 132 or profile[36:40] != b"acsp":
        raise ValueError("ICC profile: expected the mark 'acsp', got none")
    (count,) = struct.unpack_from(">I", profile, 128)
    tags = {}
    for i in range(min(count, 256)):
        entry = profile[132 + 12 * i : 144 + 12 * i]
        if len(entry) < 12:
            raise ValueError("ICC profile: expected more tags, got its end")
        name, offset, size = struct.unpack(">4sII", entry)
        tags[name] = profile[offset : offset + size]
    return tags


def _numbers(content: bytes, start: int, count: int) -> NDArray[np.float64]:
    """Read numbers of 16 bits before and 16 behind the point."""
    if len(content) < start + 4 * count:
        raise ValueError("ICC profile: expected more numbers, got the end of a tag")
    return np.frombuffer(content, ">i4", count, start).astype(np.float64) / 65536.0


def _xyz(content: bytes) -> NDArray[np.float64]:
    return _numbers(content, 8, 3)


def _parametric(content: bytes) -> Curve:
    kind = struct.unpack_from(">H", content, 8)[0] if len(content) >= 12 else 9
    if kind >= len(_PARAMETERS):
        raise ValueError(f"ICC profile: expected a parametric curve of kind 0..4, got {kind}")
    g, a, b, c, d, e, f = [*_numbers(content, 12, _PARAMETERS[kind]), *([0.0] * 7)][:7]
    if kind == 0:
        a, b, d = 1.0, 0.0, -1.0
    if kind in (1, 2):
        if a == 0.0:
            raise ValueError("ICC profile: expected a parametric curve with a slope, got 0")
        # Y = (aX + b)^g + c from -b/a on, and c below.
        e, c, d = (c if kind == 2 else 0.0), 0.0, -b / a
        f = e

    def curve(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(np.where(x >= d, np.maximum(a * x + b, 0.0) ** g + e, c * x + f))

    return curve


def _curve(content: bytes) -> Curve:
    if content[:4] == b"para":
        return _parametric(content)
    if content[:4] != b"curv" or len(content) < 12:
        raise ValueError(f"ICC profile: expected a curve of kind 'curv' or 'para', got {content[:4]!r}")
    (count,) = struct.unpack_from(">I", content, 8)
    if len(content) < 12 + 2 * count:
        raise ValueError("ICC profile: expected more entries of a curve, got its end")
    values = np.frombuffer(content, ">u2", count, 12).astype(np.float64)
    if count <= 1:
        gamma = 1.0 if count == 0 else float(values[0]) / 256.0
        return lambda x: np.asarray(x**gamma)
    places, shares = np.linspace(0.0, 1.0, count), values / 65535.0
    return lambda x: np.asarray(np.interp(x, places, shares))


def _name(content: bytes) -> str:
    if content[:4] == b"desc":
        text = content[12:].split(b"\0")[0].decode("latin-1")
    elif content[:4] == b"mluc" and len(content) >= 28:
        size, offset = struct.unpack_from(">II", content, 20)
        text = content[offset : offset + size].decode("utf-16-be", "replace")
    else:
        text = ""
    return "".join(c if c.isprintable() else "?" for c in text[:60]) or "without a name"


def read_profile(content: bytes) -> Profile:
    """Read a profile of curves and a matrix.

    Parameters
    ----------
    content : bytes
        All of it.

    Raises
    ------
    ValueError
        If it is broken, of another colour space than RGB or grey, or made of tables.
    """
    profile = _read(content)
    shares = np.linspace(0.0, 1.0, 33)
    with np.errstate(all="ignore"):
        values = np.concatenate([curve(shares) for curve in profile.curves])
    # Also false where one is not finite.
    if not (np.abs(values - 0.5) < 1.0).all():
        raise ValueError(f"ICC profile '{profile.name}': expected curves from 0 to 1, got {values.max():.3g}")
    return profile


def _read(content: bytes) -> Profile:
    tags = _tags(content)
    space = content[16:20]
    name = _name(tags.get(b"desc", b""))
    if space == b"GRAY" and b"kTRC" in tags:
        return Profile(name, [_curve(tags[b"kTRC"])], None)
    needed = [b"rXYZ", b"gXYZ", b"bXYZ", b"rTRC", b"gTRC", b"bTRC"]
    if space != b"RGB " or not all(tag in tags for tag in needed):
        raise ValueError(
            f"ICC profile '{name}': expected RGB or grey by curves and a matrix, got another kind"
        )
    xyz = np.stack([_xyz(tags[tag]) for tag in needed[:3]], axis=1)
    if not (np.abs(xyz.sum(axis=1) - primaries.D50) < 0.05).all():
        raise ValueError(f"ICC profile '{name}': expected columns that add up to D50, got {xyz.sum(axis=1)}")
    return Profile(
        name, [_curve(tags[tag]) for tag in needed[3:]], primaries.rec709_from_xyz(primaries.D50) @ xyz
    )

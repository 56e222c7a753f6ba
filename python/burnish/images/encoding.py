"""What the encoded values of a PNG or JPEG mean: curve and primaries, by the fields of the file."""

import struct
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from burnish.images import primaries
from burnish.images.display import srgb_decode
from burnish.images.files import file_error
from burnish.images.icc import Curve, read_profile
from burnish.images.png_chunks import unpack_profile
from burnish.images.source import Source

# Values that the sRGB chunk's specification gives beside it, as many files have them alone.
_SRGB_GAMMA = 45455
# Of ITU-T H.273: code of cICP to what is done here.
_CICP_PRIMARIES = {1: primaries.REC_709, 9: primaries.REC_2020, 12: primaries.P3_D65}
_CICP_GAMMA = {4: 2.2, 5: 2.8, 8: 1.0}
_CICP_SRGB = 13


@dataclass
class Encoding:
    """How shares in [0, 1] become linear Rec. 709."""

    curves: list[Curve] = field(default_factory=lambda: [_srgb])
    """One for all channels, or one a channel."""
    rec709: NDArray[np.float64] | None = None
    """Matrix from its linear RGB; None: they are Rec. 709."""
    notes: list[str] = field(default_factory=list)
    ignored: list[str] = field(default_factory=list)

    def decode(self, encoded: NDArray[np.uint8] | NDArray[np.uint16]) -> NDArray[np.float32]:
        """Turn samples (h, w, 1 to 4) into (h, w, 3) or, with alpha, (h, w, 4) linear Rec. 709."""
        shares = np.linspace(0.0, 1.0, int(np.iinfo(encoded.dtype).max) + 1)
        colors = 1 if encoded.shape[2] < 3 else 3
        has_alpha = encoded.shape[2] in (2, 4)
        pixels = np.empty((*encoded.shape[:2], 3 + has_alpha), np.float32)
        tables = [np.asarray(curve(shares), np.float32) for curve in self.curves]
        for channel in range(3):
            table = tables[min(channel, len(tables) - 1)]
            pixels[..., channel] = table[encoded[..., min(channel, colors - 1)]]
        if has_alpha:
            pixels[..., 3] = shares.astype(np.float32)[encoded[..., -1]]
        if self.rec709 is not None and colors == 3:  # grey has the white of whatever primaries
            primaries.convert(pixels, self.rec709)
        return pixels


def _srgb(shares: NDArray[np.float64]) -> NDArray[np.float64]:
    return srgb_decode(shares.astype(np.float32)).astype(np.float64)


def _power(exponent: float) -> Curve:
    return lambda shares: np.asarray(shares**exponent)


def _use_profile(encoding: Encoding, content: bytes, what: str) -> bool:
    """Take curve and primaries from an ICC profile; say so, or why not."""
    try:
        profile = read_profile(content)
    except ValueError as error:
        encoding.ignored.append(f"{what}: {error}; values are read as sRGB.")
        return False
    shares = np.linspace(0.0, 1.0, 33)
    is_srgb_curve = all(np.allclose(c(shares), _srgb(shares), rtol=0.0, atol=2e-3) for c in profile.curves)
    is_rec709 = profile.rec709 is None or np.allclose(profile.rec709, np.eye(3), rtol=0.0, atol=5e-3)
    if not (is_srgb_curve and is_rec709):
        encoding.curves, encoding.rec709 = profile.curves, profile.rec709
        encoding.notes.append(f"{what}: ICC profile '{profile.name}' turned into linear Rec. 709.")
    return True


def _use_cicp(source: Source, encoding: Encoding, chunk: bytes) -> None:
    codes = tuple(chunk[:4])
    if len(codes) < 4 or codes[0] not in _CICP_PRIMARIES or codes[2] != 0 or codes[3] != 1:
        raise file_error(
            source.name, f"PNG: cICP: expected primaries 1, 9 or 12, RGB and full range, got {codes}"
        )
    if codes[1] != _CICP_SRGB and codes[1] not in _CICP_GAMMA:
        raise file_error(
            source.name, f"PNG: cICP: expected the curve of sRGB, 2.2, 2.8 or linear, got transfer {codes[1]}"
        )
    if codes[1] in _CICP_GAMMA:
        encoding.curves = [_power(_CICP_GAMMA[codes[1]])]
    chromaticities = _CICP_PRIMARIES[codes[0]]
    encoding.rec709 = primaries.rec709_from_rgb(chromaticities)
    encoding.notes.append(f"PNG: cICP {codes}: {primaries.describe(chromaticities)}, transfer {codes[1]}.")


def _use_gamma_and_chromaticities(encoding: Encoding, chunks: dict[str, bytes]) -> None:
    if len(chunks.get("gAMA", b"")) == 4:
        (gamma,) = struct.unpack(">I", chunks["gAMA"])
        if not 1000 <= gamma <= 1000000:
            encoding.ignored.append(f"PNG: gAMA {gamma / 1e5:g} is no exponent: values are read as sRGB.")
        elif abs(gamma - _SRGB_GAMMA) <= 50:
            encoding.notes.append(
                f"PNG: gAMA {gamma / 1e5:g} is read as the curve of sRGB, which it stands for."
            )
        else:
            encoding.curves = [_power(1e5 / gamma)]
            encoding.notes.append(f"PNG: gAMA {gamma / 1e5:g} taken out.")
    if len(chunks.get("cHRM", b"")) == 32:
        white_x, white_y, *colors = (value / 1e5 for value in struct.unpack(">8I", chunks["cHRM"]))
        chromaticities = (*colors, white_x, white_y)
        try:
            encoding.rec709 = primaries.rec709_from_rgb(chromaticities)
        except ValueError as error:
            encoding.ignored.append(f"PNG: cHRM: {error}; values are read as Rec. 709.")
            return
        if encoding.rec709 is not None:
            encoding.notes.append(
                f"PNG: cHRM: {primaries.describe(chromaticities)} turned into linear Rec. 709 (Bradford)."
            )


def png_encoding(source: Source, chunks: dict[str, bytes]) -> Encoding:
    """Find out what the values of a PNG mean: by cICP, iCCP, sRGB, or gAMA and cHRM, in this order.

    Raises
    ------
    FileError
        If cICP names a curve or primaries that are not known here: those of HDR video.
    """
    encoding = Encoding()
    if "cICP" in chunks:
        _use_cicp(source, encoding, chunks["cICP"])
    elif "iCCP" in chunks:
        try:
            profile = unpack_profile(chunks["iCCP"])
        except ValueError as error:
            encoding.ignored.append(f"PNG: {error}; values are read as sRGB.")
        else:
            _use_profile(encoding, profile, "PNG")
    elif "sRGB" not in chunks:
        _use_gamma_and_chromaticities(encoding, chunks)
    return encoding


def jpeg_encoding(profile: bytes | None) -> Encoding:
    """Find out what the values of a JPEG mean: by its ICC profile, else sRGB."""
    encoding = Encoding()
    if profile:
        _use_profile(encoding, profile, "JPEG")
    return encoding

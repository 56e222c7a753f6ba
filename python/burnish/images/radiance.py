"""Radiance pictures as linear Rec. 709."""

from burnish._core import decode_hdr
from burnish.images import primaries
from burnish.images.files import file_error
from burnish.images.pixels import Picture
from burnish.images.source import Source


def _use_primaries(picture: Picture, numbers: list[float], is_xyz: bool) -> None:
    if is_xyz:
        picture.notes.append("PRIMARIES is passed over: XYZE needs none.")
        return
    if not any(numbers):
        picture.notes.append("PRIMARIES of zeros, as Photoshop writes it, is passed over.")
        return
    try:
        turned = primaries.convert_to_rec709(picture.pixels, numbers)
    except ValueError as error:
        picture.ignored.append(f"PRIMARIES: {error}; values are read as linear Rec. 709.")
        return
    if turned:
        picture.notes.append(f"PRIMARIES {turned}")


def read_radiance(source: Source) -> Picture:
    """Read a Radiance picture; `read_picture` says what it raises."""
    try:
        pixels, header = decode_hdr(source.read(), source.name)
    except MemoryError as error:
        raise file_error(source.name, "expected memory for the declared pixels, got none") from error
    picture = Picture(pixels, "Radiance")
    if header["is_xyz"]:
        picture.notes.append("CIE XYZ (FORMAT 32-bit_rle_xyze) turned into linear Rec. 709.")
    if header["divisor"] != (1.0, 1.0, 1.0):
        factors = ", ".join(f"{factor:.6g}" for factor in header["divisor"])
        picture.notes.append(f"EXPOSURE and COLORCORR divided out: {factors} (red, green, blue).")
    if header["gamma"] != 1.0:
        picture.notes.append(f"GAMMA {header['gamma']:.4g} taken out: stored values to that power.")
    if header["pixel_aspect"] != 1.0:
        picture.ignored.append(f"PIXASPECT {header['pixel_aspect']:.4g} is not applied: pixels are square.")
    if header["primaries"]:
        _use_primaries(picture, header["primaries"], header["is_xyz"])
    return picture

"""OpenEXR pictures: the part and layer that is one, in linear Rec. 709."""

import numpy as np
from numpy.typing import NDArray

from burnish.images import primaries
from burnish.images.exr_choice import ExrChoice, choose_picture
from burnish.images.exr_header import read_exr_header
from burnish.images.exr_parts import CUBE, LATLONG, ExrPart
from burnish.images.exr_samples import read_samples
from burnish.images.exr_writer import write_exr
from burnish.images.pixels import Picture
from burnish.images.source import PictureFile, Source, open_source

__all__ = ["read_exr", "read_exr_picture", "write_exr"]

# Of the Color Interop Forum, as OpenEXR 3.5 lists them.
_INTEROP_IDS = {
    "lin_rec709_scene": primaries.REC_709,
    "lin_ap0_scene": primaries.AP0,
    "lin_ap1_scene": primaries.AP1,
    "lin_p3d65_scene": primaries.P3_D65,
    "lin_rec2020_scene": primaries.REC_2020,
    "lin_adobergb_scene": primaries.ADOBE_RGB,
}


def _to_display_window(part: ExrPart, pixels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Crop to the display window, and fill with zeros what it has beyond the data window."""
    if part.display_window == part.data_window:
        return pixels
    x0, y0, x1, y1 = part.display_window
    left, top, right, bottom = part.data_window
    shown = np.zeros((y1 - y0 + 1, x1 - x0 + 1, pixels.shape[2]), np.float32)
    low_x, low_y, high_x, high_y = max(x0, left), max(y0, top), min(x1, right) + 1, min(y1, bottom) + 1
    if low_x < high_x and low_y < high_y:
        shown[low_y - y0 : high_y - y0, low_x - x0 : high_x - x0] = pixels[
            low_y - top : high_y - top, low_x - left : high_x - left
        ]
    return shown


def _color_space(part: ExrPart, choice: ExrChoice) -> tuple[float, ...] | None:
    """What the part says its R, G, B are, in this order: chromaticities, a known colour space, ACES."""
    known = _INTEROP_IDS.get(part.color_interop_id)
    if part.chromaticities is not None:
        if known is not None and not primaries.are_same(known, part.chromaticities):
            choice.ignored.append(
                f"colorInteropID '{part.color_interop_id}' contradicts chromaticities, which are used."
            )
        return part.chromaticities
    if known is not None:
        return known
    if part.color_interop_id:
        choice.ignored.append(
            f"colorInteropID '{part.color_interop_id}' is none of linear primaries known here: values "
            "are read as linear Rec. 709."
        )
    return primaries.AP0 if part.aces_container == 1 else None


def _to_rec709(pixels: NDArray[np.float32], part: ExrPart, choice: ExrChoice) -> None:
    """Convert in place, where the part says what its colours are."""
    if choice.is_xyz:
        primaries.convert(pixels, primaries.rec709_from_xyz())
        return
    chromaticities = _color_space(part, choice)
    if chromaticities is None or len(set(choice.color)) == 1:  # grey has the white of whatever primaries
        return
    try:
        turned = primaries.convert_to_rec709(pixels, chromaticities)
    except ValueError as error:
        choice.ignored.append(f"{error}; values are read as linear Rec. 709.")
        return
    if turned:
        choice.notes.append(f"chromaticities of {turned}")


def _note_fields(part: ExrPart, choice: ExrChoice) -> None:
    """Say which attributes change what is seen and are not used, and which windows are."""
    if part.pixel_aspect_ratio != 1.0:
        choice.ignored.append(
            f"pixelAspectRatio {part.pixel_aspect_ratio:.4g} is not applied: pixels are square."
        )
    if part.adopted_neutral is not None:
        x, y = part.adopted_neutral
        if part.chromaticities is None or not np.allclose(
            (x, y), part.chromaticities[6:], rtol=0.0, atol=1e-3
        ):
            choice.ignored.append(f"adoptedNeutral {x:.4g}, {y:.4g} is not applied: no white is balanced.")
    if part.white_luminance is not None:
        choice.notes.append(
            f"whiteLuminance {part.white_luminance:.4g} cd/m2 is not applied: radiance stays relative."
        )
    if part.envmap is not None and part.envmap not in (LATLONG, CUBE):
        choice.ignored.append(f"envmap {part.envmap} is no layout that is known: proportions decide.")
    if part.display_window != part.data_window:
        what = "data window" if part.envmap in (LATLONG, CUBE) else "display window"
        choice.notes.append(
            f"the {what} is read (data {part.data_window}, display {part.display_window}), 0 beyond the data."
        )


def read_exr_picture(source: Source, part: str | int | None = None, layer: str | None = None) -> Picture:
    """Read the picture of an OpenEXR file together with what is said about it; as `read_exr`."""
    header = read_exr_header(source)
    choice = choose_picture(source.name, header.parts, part, layer)
    chosen = header.parts[choice.index]
    names = [*choice.color, *([choice.alpha] if choice.alpha else [])]
    pixels = read_samples(source, header, choice.index, names)
    _to_rec709(pixels, chosen, choice)
    _note_fields(chosen, choice)
    envmap = chosen.envmap if chosen.envmap in (LATLONG, CUBE) else None
    if envmap is None:
        pixels = _to_display_window(chosen, pixels)
    return Picture(pixels, "OpenEXR", envmap, choice.notes, choice.ignored)


def read_exr(
    path: PictureFile, part: str | int | None = None, layer: str | None = None
) -> tuple[NDArray[np.float32], int | None]:
    """Read the picture of an OpenEXR file.

    Half, float and uint samples, scan lines and tiles (level 0), any compression the OpenEXR package knows. A
    missing colour is 0; luminance alone gives grey. Other primaries are turned into linear Rec. 709. The
    picture is what the display window shows, 0 where there is no data; environment maps, marked by the
    attribute envmap, are their data window. ``burnish.images`` has the table of all fields.

    Parameters
    ----------
    path : path, bytes, or binary file object
        Any name; the magic number decides.
    part : str, int or None
        Name, view or index of a part. None: the first that is a picture.
    layer : str or None
        What stands before the last dot of its channels, empty for those without one. None: the channels
        without a layer, or the only layer of colour.

    Returns
    -------
    pixels : (h, w, 3) or (h, w, 4) float32
        Linear Rec. 709: NaN and infinities are kept.
    envmap : int or None
        The attribute: `exr_header.LATLONG`, `exr_header.CUBE`, or None where there is none.

    Raises
    ------
    FileError
        If the file is damaged, deep, luminance-chroma, or declares more than it can hold.
    ValueError
        If there is no such part or layer.
    """
    picture = read_exr_picture(open_source(path), part, layer)
    return picture.pixels, picture.envmap

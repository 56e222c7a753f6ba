"""A case of every field of OpenEXR.

(format, field): the fate, the file, its pixels, what is said; of those refused only what is said.
"""

import struct

import numpy as np
import OpenEXR
from field_values import AP1, FROM_2020, FROM_AP0, FROM_AP1, FROM_XYZ, PROPER, RGB

import picture_support as made


def exr(**header):
    return made.exr(PROPER, header)


def exr_of_part(kind: str):
    view = {"view": "right"} if kind == "view" else {}
    depth, flat = {"name": "depth"} | ({"view": "left"} if view else {}), {"name": "rgb"} | view
    return made.exr_parts((depth, {"Z": RGB[..., 0] + 1}), (flat, PROPER))


def layers(*names):
    return {f"{name}.{c}": RGB[..., i] + k for k, name in enumerate(names) for i, c in enumerate("RGB")}


def tiled():
    tiles = OpenEXR.TileDescription()
    tiles.xSize = tiles.ySize = 3
    return exr(type=OpenEXR.tiledimage, tiles=tiles)


WINDOW = {"displayWindow": (np.array([1, 0], np.int32), np.array([8, 3], np.int32))}
CROPPED = np.concatenate([RGB[:, 1:], np.zeros((4, 1, 3), np.float32)], axis=1)

CASES = {
    ("OpenEXR", "chromaticities"): ("used", exr(chromaticities=AP1), RGB @ FROM_AP1.T, r"ACEScg \(AP1\)"),
    ("OpenEXR", "bad chromaticities"): (
        "warned",
        exr(chromaticities=(0.0,) * 8),
        RGB,
        "chromaticities: expected a",
    ),
    ("OpenEXR", "colorInteropID"): (
        "used",
        exr(colorInteropID="lin_rec2020_scene"),
        RGB @ FROM_2020.T,
        "Rec. 2020",
    ),
    ("OpenEXR", "other colorInteropID"): (
        "warned",
        exr(colorInteropID="g22_rec709_scene"),
        RGB,
        "g22_rec709_scene",
    ),
    ("OpenEXR", "acesImageContainerFlag"): (
        "used",
        exr(acesImageContainerFlag=1),
        RGB @ FROM_AP0.T,
        r"\(AP0\)",
    ),
    ("OpenEXR", "whiteLuminance"): ("noted", exr(whiteLuminance=100.0), RGB, "whiteLuminance 100 cd/m2"),
    ("OpenEXR", "adoptedNeutral"): (
        "warned",
        made.with_attribute(exr(), "adoptedNeutral", "v2f", struct.pack("<2f", 0.3, 0.3)),
        RGB,
        "adoptedNeutral 0.3, 0.3 is not applied",
    ),
    ("OpenEXR", "pixelAspectRatio"): ("warned", exr(pixelAspectRatio=2.0), RGB, "pixelAspectRatio 2 is not"),
    ("OpenEXR", "envmap"): ("used", exr(envmap=OpenEXR.ENVMAP_LATLONG, **WINDOW), RGB, "data window is read"),
    ("OpenEXR", "bad envmap"): (
        "warned",
        made.with_attribute(exr(), "envmap", "envmap", b"\7"),
        RGB,
        "envmap 7 is no layout",
    ),
    ("OpenEXR", "displayWindow"): ("used", exr(**WINDOW), CROPPED, "display window is read"),
    ("OpenEXR", "parts"): (
        "used",
        exr_of_part("name"),
        RGB,
        r"part 1 'rgb' \(B, G, R\) is read, left out are parts 0 'depth' \(Z\)",
    ),
    ("OpenEXR", "layers"): (
        "used",
        made.exr({**layers("diffuse"), "Z": RGB[..., 0]}),
        RGB,
        "layer 'diffuse' is read",
    ),
    ("OpenEXR", "several layers"): (
        "refused",
        made.exr(layers("a", "b")),
        None,
        "one layer of colour, or the argument layer to say which: a, b",
    ),
    ("OpenEXR", "multiView"): (
        "used",
        made.with_attribute(
            made.exr({**PROPER, **layers("right")}),
            "multiView",
            "stringvector",
            b"".join(struct.pack("<i", len(view)) + view for view in (b"left", b"right")),
        ),
        RGB,
        "views left, right 'left' is read",
    ),
    ("OpenEXR", "view"): ("used", exr_of_part("view"), RGB, "part 1 'rgb', view 'right'"),
    ("OpenEXR", "deep"): (
        "refused",
        made.exr_parts(made.deep_part(2, 2)),
        None,
        "expected a flat picture, got deep data",
    ),
    ("OpenEXR", "some of R, G, B"): (
        "warned",
        made.exr({"R": RGB[..., 0]}),
        RGB * [1, 0, 0],
        "channels G, B are missing and read as 0",
    ),
    ("OpenEXR", "Y"): ("used", made.exr({"Y": RGB[..., 0]}), RGB[..., [0, 0, 0]], "Y alone is read as grey"),
    ("OpenEXR", "Y, RY, BY"): (
        "refused",
        made.exr({name: RGB[..., 0] for name in ("Y", "RY", "BY")}),
        None,
        "luminance-chroma",
    ),
    ("OpenEXR", "X, Y, Z"): (
        "used",
        made.exr({name: RGB[..., i] for i, name in enumerate("XYZ")}),
        RGB @ FROM_XYZ.T,
        "CIE XYZ",
    ),
    ("OpenEXR", "other channels"): (
        "noted",
        made.exr({**PROPER, "Z": RGB[..., 0], "id": RGB[..., 1]}),
        RGB,
        "channels left out are Z, id",
    ),
    ("OpenEXR", "subsampled channels"): (
        "refused",
        made.exr_with_sampling(exr(), 2),
        None,
        r"channel B: expected sampling 1, 1, got \(2, 1\)",
    ),
    ("OpenEXR", "half, float"): (
        "used",
        made.exr({n: p.astype(np.float16) for n, p in PROPER.items()}),
        RGB,
        None,
    ),
    ("OpenEXR", "uint"): (
        "noted",
        made.exr({n: (256 * p).astype(np.uint32) for n, p in PROPER.items()}),
        256 * RGB,
        "holds integers",
    ),
    ("OpenEXR", "tiles and levels"): ("used", tiled(), RGB, None),
    ("OpenEXR", "lineOrder"): ("used", exr(lineOrder=OpenEXR.DECREASING_Y), RGB, None),
    ("OpenEXR", "other attributes"): (
        "harmless",
        exr(owner="nobody", isoSpeed=100.0, strange="x"),
        RGB,
        None,
    ),
}

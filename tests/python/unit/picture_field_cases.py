"""A case of every field of Radiance, PNG and JPEG; the columns are those of exr_field_cases."""

import io
import struct
import zlib

import numpy as np
from field_values import FROM_2020, FROM_P3, FROM_XYZ, LINEAR, REC_2020, RGB, SAMPLES
from PIL import Image

import picture_support as made
from burnish import images


def cicp(*codes):
    return made.png(SAMPLES, (b"cICP", bytes(codes)))


def chrm(values):
    x = [round(1e5 * value) for value in (*values[6:], *values[:6])]
    return (b"cHRM", struct.pack(">8I", *x))


def gamma(value):
    return (b"gAMA", struct.pack(">I", value))


def iccp(profile):
    return (b"iCCP", b"name\0\0" + zlib.compress(profile))


def exif(orientation):
    fields = Image.Exif()
    fields[0x0112] = orientation
    return fields.tobytes()


def packed_png(bits, color_type, row, *chunks):
    return (
        b"\x89PNG\r\n\x1a\n"
        + made.png_chunk(b"IHDR", struct.pack(">2I5B", 4, 1, bits, color_type, 0, 0, 0))
        + b"".join(made.png_chunk(*chunk) for chunk in chunks)
        + made.png_chunk(b"IDAT", zlib.compress(b"\0" + row))
        + made.png_chunk(b"IEND", b"")
    )


def grey_row(shares):
    return np.repeat(images.srgb_decode(np.array([shares]))[..., None], 3, axis=2)


def jpeg(mode="RGB", **options):
    stream = io.BytesIO()
    color = {"RGB": (200, 100, 50), "L": 188, "CMYK": (10, 20, 30, 40)}[mode]
    Image.new(mode, (16, 8), color).save(stream, "JPEG", quality=100, subsampling=0, **options)
    return stream.getvalue()


def jpeg_pixels(*rgb):
    return np.broadcast_to(images.srgb_decode(np.array(rgb) / 255.0), (8, 16, 3))


# Columns of P3 with white D65, adapted to D50, as such profiles hold them.
P3_PROFILE = made.icc_profile(
    [(0.51512, 0.2412, -0.00105), (0.29198, 0.69225, 0.04189), (0.1571, 0.06657, 0.78407)], 2.2
)
SWAPPED = np.ascontiguousarray(RGB[::-1])

CASES = {
    ("Radiance", "FORMAT rgbe"): ("used", made.hdr(RGB, "FORMAT=32-bit_rle_rgbe"), RGB, None),
    ("Radiance", "FORMAT xyze"): (
        "used",
        made.hdr(RGB, "FORMAT=32-bit_rle_xyze"),
        RGB @ FROM_XYZ.T,
        "CIE XYZ",
    ),
    ("Radiance", "other FORMAT"): (
        "refused",
        made.hdr(RGB, "FORMAT=float"),
        None,
        "FORMAT: expected 32-bit_rle_rgbe",
    ),
    ("Radiance", "EXPOSURE"): (
        "used",
        made.hdr(RGB, "EXPOSURE=2", "EXPOSURE=4"),
        RGB / 8,
        "divided out: 8, 8, 8",
    ),
    ("Radiance", "COLORCORR"): (
        "used",
        made.hdr(RGB, "COLORCORR=1 2 4"),
        RGB / [1, 2, 4],
        "divided out: 1, 2, 4",
    ),
    ("Radiance", "GAMMA"): ("used", made.hdr(RGB, "GAMMA=2"), RGB**2, "GAMMA 2 taken out"),
    ("Radiance", "PRIMARIES"): (
        "used",
        made.hdr(RGB, "PRIMARIES=" + " ".join(map(str, REC_2020))),
        RGB @ FROM_2020.T,
        "Rec. 2020",
    ),
    ("Radiance", "PRIMARIES of zeros"): (
        "noted",
        made.hdr(RGB, "PRIMARIES=0 0 0 0 0 0 0 0"),
        RGB,
        "Photoshop",
    ),
    ("Radiance", "bad PRIMARIES"): (
        "warned",
        made.hdr(RGB, "PRIMARIES=.3 .3 red"),
        RGB,
        "read as linear Rec. 709",
    ),
    ("Radiance", "PIXASPECT"): ("warned", made.hdr(RGB, "PIXASPECT=2"), RGB, "PIXASPECT 2 is not applied"),
    ("Radiance", "resolution line"): ("used", made.hdr(RGB, resolution="+Y 4 +X 8"), SWAPPED, None),
    ("Radiance", "runs"): (
        "used",
        made.hdr(RGB[:1, :1], resolution="-Y 1 +X 6") + bytes([1, 1, 1, 5]),
        np.broadcast_to(RGB[:1, :1], (1, 6, 3)),
        None,
    ),
    ("Radiance", "other lines"): (
        "harmless",
        made.hdr(RGB, "SOFTWARE=x", "VIEW= -vtv", "a command"),
        RGB,
        None,
    ),
    ("PNG", "1, 2, 4, 8 bits"): ("used", packed_png(2, 0, b"\x1b"), grey_row([0, 1 / 3, 2 / 3, 1]), None),
    ("PNG", "16 bits"): (
        "used",
        made.png(np.uint16(257) * SAMPLES + 1),
        images.srgb_decode((257.0 * SAMPLES + 1) / 65535),
        None,
    ),
    ("PNG", "palette"): (
        "used",
        packed_png(2, 3, b"\x1b", (b"PLTE", bytes([0, 0, 0, 9, 9, 9, 99, 99, 99, 255, 255, 255]))),
        grey_row(np.array([0, 9, 99, 255]) / 255),
        None,
    ),
    ("PNG", "tRNS"): (
        "used",
        packed_png(8, 0, bytes([0, 9, 99, 255]), (b"tRNS", b"\0\x63")),
        np.concatenate([grey_row(np.array([0, 9, 99, 255]) / 255), np.array([[[1], [1], [0], [1]]])], axis=2),
        None,
    ),
    ("PNG", "cICP"): ("used", cicp(12, 13, 0, 1), LINEAR @ FROM_P3.T, "P3 with white D65"),
    ("PNG", "other cICP"): (
        "refused",
        cicp(9, 16, 0, 1),
        None,
        "cICP: expected the curve .* got transfer 16",
    ),
    ("PNG", "iCCP"): (
        "used",
        made.png(SAMPLES, iccp(P3_PROFILE)),
        (SAMPLES / 255) ** 2.2 @ FROM_P3.T,
        "'made by code' turned",
    ),
    ("PNG", "other iCCP"): ("warned", made.png(SAMPLES, iccp(b"x" * 200)), LINEAR, "read as sRGB"),
    ("PNG", "sRGB"): (
        "used",
        made.png(SAMPLES, (b"sRGB", b"\0"), gamma(100000), chrm(REC_2020)),
        LINEAR,
        None,
    ),
    ("PNG", "gAMA"): ("used", made.png(SAMPLES, gamma(100000)), SAMPLES / 255, "gAMA 1 taken out"),
    ("PNG", "bad gAMA"): ("warned", made.png(SAMPLES, gamma(0)), LINEAR, "gAMA 0 is no exponent"),
    ("PNG", "cHRM"): ("used", made.png(SAMPLES, chrm(REC_2020)), LINEAR @ FROM_2020.T, "Rec. 2020"),
    ("PNG", "bad cHRM"): (
        "warned",
        made.png(SAMPLES, chrm((0.0,) * 8)),
        LINEAR,
        "cHRM: chromaticities: expected",
    ),
    ("PNG", "eXIf"): ("used", made.png(SAMPLES, (b"eXIf", exif(3)[6:])), LINEAR[::-1, ::-1], "orientation 3"),
    ("PNG", "pHYs"): (
        "warned",
        made.png(SAMPLES, (b"pHYs", struct.pack(">IIB", 1, 2, 0))),
        LINEAR,
        "pHYs 1 x 2",
    ),
    ("PNG", "acTL"): (
        "noted",
        made.png(SAMPLES, (b"acTL", struct.pack(">II", 1, 0))),
        LINEAR,
        "an animation",
    ),
    ("PNG", "other chunks"): (
        "harmless",
        made.png(SAMPLES, (b"sBIT", b"\5\5\5"), (b"tEXt", b"a\0b"), (b"abCd", b"")),
        LINEAR,
        None,
    ),
    ("JPEG", "grey and colour"): ("used", jpeg("L"), jpeg_pixels(188, 188, 188), None),
    ("JPEG", "CMYK"): ("warned", jpeg("CMYK"), None, "CMYK is turned into RGB by the plain formula"),
    ("JPEG", "ICC profile"): (
        "used",
        jpeg(icc_profile=P3_PROFILE),
        np.broadcast_to((np.array([200, 100, 50]) / 255) ** 2.2 @ FROM_P3.T, (8, 16, 3)),
        "ICC profile 'made by code'",
    ),
    ("JPEG", "other ICC profile"): (
        "warned",
        jpeg(icc_profile=made.icc_profile([(1, 1, 1)] * 3, 1.0, space=b"CMYK")),
        jpeg_pixels(200, 100, 50),
        "expected RGB or grey",
    ),
    ("JPEG", "Exif"): (
        "used",
        jpeg(exif=exif(6)),
        np.swapaxes(jpeg_pixels(200, 100, 50), 0, 1),
        "orientation 6",
    ),
    ("JPEG", "other segments"): ("harmless", jpeg(comment=b"x"), jpeg_pixels(200, 100, 50), None),
}

"""ICC profiles of curves and matrices, made by code."""

import struct

import numpy as np
import pytest

import picture_support as made
from burnish import images
from burnish.images import icc

# Rec. 709 adapted to D50, as profiles of sRGB hold it.
SRGB_COLUMNS = [(0.43607, 0.22249, 0.01392), (0.38515, 0.71687, 0.09708), (0.14307, 0.06061, 0.7141)]
SHARES = np.linspace(0.0, 1.0, 101)


def fixed(*values):
    return b"".join(struct.pack(">i", round(65536 * value)) for value in values)


def parametric(kind, *values):
    return b"para\0\0\0\0" + struct.pack(">HH", kind, 0) + fixed(*values)


def table(*values):
    return b"curv\0\0\0\0" + struct.pack(f">I{len(values)}H", len(values), *values)


# a, b, c, d of sRGB; by IEC 61966-2-1.
SRGB = (2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045)
CURVES = {
    "power": (parametric(0, 2.0), SHARES**2),
    "kind 1": (parametric(1, 2.0, 2.0, -1.0), np.maximum(2 * SHARES - 1, 0) ** 2),
    "kind 2": (parametric(2, 2.0, 1.0, -0.5, 0.25), np.maximum(SHARES - 0.5, 0) ** 2 + 0.25),
    "kind 3": (parametric(3, *SRGB), images.srgb_decode(SHARES)),
    "kind 4": (
        parametric(4, *SRGB, 0.1, 0.2),
        images.srgb_decode(SHARES) + np.where(SHARES < 0.04045, 0.2, 0.1),
    ),
    "identity": (table(), SHARES),
    "gamma": (table(round(1.5 * 256)), SHARES**1.5),
    "table": (table(0, 16384, 65535), np.interp(SHARES, [0, 0.5, 1], [0, 16384 / 65535, 1])),
}


@pytest.mark.parametrize("name", CURVES)
def test_curves_are_those_of_the_specification(name):
    content, expected = CURVES[name]
    profile = icc.read_profile(made.icc_profile(SRGB_COLUMNS, content))
    for curve in profile.curves:
        np.testing.assert_allclose(curve(SHARES), expected, rtol=0.0, atol=1e-4)
    np.testing.assert_allclose(profile.rec709, np.eye(3), rtol=0.0, atol=1e-3)
    assert profile.name == "made by code"


def broken(curve, columns=SRGB_COLUMNS, **options):
    return made.icc_profile(columns, curve, **options)


BROKEN = {
    "nothing": (b"", "expected the mark 'acsp', got none"),
    "another space": (broken(table(), space=b"CMYK"), "expected RGB or grey"),
    "another curve": (broken(b"sf32\0\0\0\0" + bytes(8)), "of kind 'curv' or 'para'"),
    "another kind": (broken(parametric(7, 1.0)), "of kind 0..4, got 7"),
    "a table cut short": (broken(table()[:8] + b"\xff" * 4), "more entries of a curve"),
    "few parameters": (broken(parametric(4, 1.0)), "expected more numbers"),
    "no slope": (broken(parametric(1, 1.0, 0.0, 0.0)), "with a slope, got 0"),
    "a curve without end": (broken(parametric(0, -2.0)), "expected curves from 0 to 1"),
    "a black white": (broken(table(), [(0, 0, 0)] * 3), "expected columns that add up to D50"),
    "a cut": (broken(table())[:140], "expected more tags, got its end"),
}


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_profile_is_refused_in_words(name):
    content, message = BROKEN[name]
    with pytest.raises(ValueError, match=f"^ICC profile.*{message}"):
        icc.read_profile(content)

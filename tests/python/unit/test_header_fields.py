"""Every field of the table in burnish.images has the fate that the table says."""

import io
import re

import exr_field_cases
import numpy as np
import picture_field_cases
import pytest
from field_values import LINEAR, RGB, SAMPLES
from picture_field_cases import exif, gamma, iccp
from PIL import Image, ImageCms, ImageOps

import picture_support as made
from burnish import FileError, images

CASES = exr_field_cases.CASES | picture_field_cases.CASES


def table():
    """(format, field) to fate, from the docstring."""
    rows = {}
    for line in images.__doc__.splitlines():
        match = re.match(r"(OpenEXR|Radiance|PNG|JPEG) +(.{22}) +(\w+) +\S", line)
        if match:
            rows[match[1], match[2].strip()] = match[3]
    return rows


def test_every_row_of_the_table_has_a_case():
    assert table() == {row: case[0] for row, case in CASES.items()}
    assert len(CASES) > 50


@pytest.mark.parametrize("row", CASES, ids=" ".join)
def test_a_field_has_its_fate(row):
    fate, data, expected, said = CASES[row]
    if fate == "refused":
        with pytest.raises(FileError, match=said):
            images.read_picture(data)
        return
    picture = images.read_picture(data)
    assert picture.format == row[0]
    if expected is not None:
        # Published matrices have five digits or four; JPEG rounds to a step.
        tolerance = 5e-4 if row[0] != "JPEG" else 8e-3
        np.testing.assert_allclose(picture.pixels, expected, rtol=0.0, atol=tolerance)
    sentences = {"used": picture.notes, "noted": picture.notes, "warned": picture.ignored}.get(fate, [])
    if said is None:
        assert not picture.notes + picture.ignored
    else:
        assert any(re.search(said, sentence) for sentence in sentences), (picture.notes, picture.ignored)
    assert bool(picture.ignored) == (fate == "warned")


def test_what_is_ignored_is_warned_of():
    with pytest.warns(UserWarning, match=r"picture in memory: PIXASPECT 2 is not applied"):
        images.read_image(made.hdr(RGB, "PIXASPECT=2"))


@pytest.mark.parametrize("orientation", range(1, 9))
def test_exif_orientations_are_those_of_pillow(orientation):
    data = made.png(SAMPLES, (b"eXIf", exif(orientation)[6:]))
    turned = np.asarray(ImageOps.exif_transpose(Image.open(io.BytesIO(data))))
    np.testing.assert_allclose(images.read_image(data), images.srgb_decode(turned / 255.0), atol=1e-6)


def test_the_profile_of_srgb_changes_nothing():
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    plain, tagged = (images.read_picture(made.png(SAMPLES, *chunks)) for chunks in ((), (iccp(profile),)))
    np.testing.assert_array_equal(tagged.pixels, plain.pixels)
    assert not tagged.notes + tagged.ignored


def test_a_gamma_near_that_of_srgb_is_its_curve():
    picture = images.read_picture(made.png(SAMPLES, gamma(45455)))
    np.testing.assert_allclose(picture.pixels, LINEAR, atol=1e-6)
    assert picture.notes == ["PNG: gAMA 0.45455 is read as the curve of sRGB, which it stands for."]

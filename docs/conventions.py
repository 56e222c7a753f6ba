"""Draw docs/conventions.png: where the axes lie in a lat-long map and on the faces of a cube."""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from burnish.oracle.cube_map import cube_direction

AXES = {
    "+X": ((1, 0, 0), (214, 70, 60)),
    "-X": ((-1, 0, 0), (120, 40, 36)),
    "+Y": ((0, 1, 0), (90, 180, 80)),
    "-Y": ((0, -1, 0), (48, 96, 44)),
    "+Z": ((0, 0, 1), (70, 110, 220)),
    "-Z": ((0, 0, -1), (40, 58, 120)),
}
FACE = 150


def color_of(directions: np.ndarray) -> np.ndarray:
    """Color of the axis each direction is nearest to, lighter toward the axis."""
    axes = np.array([axis for axis, _ in AXES.values()], float)
    colors = np.array([color for _, color in AXES.values()], float)
    cosines = directions @ axes.T / np.linalg.norm(directions, axis=-1, keepdims=True)
    nearest = cosines.argmax(axis=-1)
    shade = np.clip((cosines.max(axis=-1, keepdims=True) - 0.55) / 0.45, 0, 1)
    return (colors[nearest] * (0.75 + 0.25 * shade) + 60 * (shade > 0.97)).clip(0, 255).astype(np.uint8)


def lat_long(height: int) -> Image.Image:
    """Latitude +90 in the top row, longitude +180 at the left edge falling to -180, +x at +90."""
    row, column = np.mgrid[0:height, 0 : 2 * height] + 0.5
    latitude, longitude = np.pi * (0.5 - row / height), np.pi * (1 - column / height)
    x, z = np.cos(latitude) * np.sin(longitude), np.cos(latitude) * np.cos(longitude)
    return Image.fromarray(color_of(np.stack([x, np.sin(latitude), z], -1)))


def face(index: int) -> Image.Image:
    """One face, as its texels lie in memory: row 0 at the top."""
    row, column = (2 * np.mgrid[0:FACE, 0:FACE] + 1) / FACE - 1
    return Image.fromarray(color_of(cube_direction(np.full((FACE, FACE), index), column, row)))


def main() -> None:
    font, small = ImageFont.load_default(22), ImageFont.load_default(15)
    sheet = Image.new("RGB", (6 * FACE + 70, 560), (250, 250, 250))
    draw = ImageDraw.Draw(sheet)
    title = "Lat-long map: longitude +180 (left) to -180 (right), latitude +90 in the top row"
    draw.text((10, 8), title, "black", small)
    height = 280
    sheet.paste(lat_long(height), (10, 32))
    for name, longitude in (("+Z", 0), ("+X", 90), ("-X", -90), ("-Z", 172), ("-Z", -172)):
        draw.text((10 + height * (1 - longitude / 180), 32 + height / 2), name, "white", font, anchor="mm")
    draw.text((10 + height, 48), "+Y", "white", font, anchor="mm")
    draw.text((10 + height, 16 + height), "-Y", "white", font, anchor="mm")
    draw.multiline_text(
        (2 * height + 30, 60),
        "Right-handed, y up (glTF).\nA camera looks along its own -z.\nPictures: row 0 at the top.\n"
        "Radiance: linear Rec. 709 RGB.\nAngles: radians; environment\nrotation: degrees about +y.",
        "black",
        small,
        spacing=8,
    )
    title = "Cube faces in array order, as Environment.from_faces takes them; labels where an axis meets"
    draw.text((10, 330), title, "black", small)
    for index, name in enumerate(AXES):
        left = 10 + index * (FACE + 10)
        sheet.paste(face(index), (left, 356))
        draw.text((left + FACE / 2, 356 + FACE / 2), name, "white", font, anchor="mm")
        center, toward_u, toward_v = (
            cube_direction(np.array(index), np.array(u), np.array(v))
            for u, v in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        u, v = toward_u - center, toward_v - center
        label = {tuple(axis): key for key, (axis, _) in AXES.items()}
        right, down = (label[tuple(int(c) for c in np.round(d))] for d in (u, v))
        draw.text(
            (left + FACE / 2, 356 + FACE + 6), f"right {right}  down {down}", "black", small, anchor="ma"
        )
    sheet.save(Path(__file__).parent / "conventions.png")


if __name__ == "__main__":
    main()

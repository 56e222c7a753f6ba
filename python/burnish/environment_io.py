"""Environments from picture files."""

import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish import cube_layout
from burnish._core import Environment
from burnish.images import exr_header
from burnish.images.files import file_error
from burnish.images.picture import Picture, read_picture
from burnish.images.source import PictureFile, open_source

MAX_FACE_SIZE = 2048


def _power_of_two_at_least(size: float) -> int:
    return min(MAX_FACE_SIZE, 1 << max(0, int(np.ceil(np.log2(max(size, 1.0))))))


def _cube_faces(picture: Picture) -> tuple[NDArray[np.float32], str] | None:
    """The faces of a cube map and the name of its layout; None where the shape is none of a cube map's."""
    pixels = picture.pixels[..., :3]
    height, width = pixels.shape[:2]
    if picture.envmap == exr_header.CUBE and height >= 6 * width:
        return cube_layout.faces_from_openexr_cube(pixels), "OpenEXR cube"
    if height == 6 * width:
        return cube_layout.faces_from_vertical_strip(pixels), "vertical strip"
    if width == 6 * height:
        return cube_layout.faces_from_horizontal_strip(pixels), "horizontal strip"
    if height % 3 == 0 and width % 4 == 0 and height // 3 == width // 4:
        return cube_layout.faces_from_cross(pixels), "horizontal cross"
    if height % 4 == 0 and width % 3 == 0 and height // 4 == width // 3:
        return cube_layout.faces_from_cross(pixels), "vertical cross"
    return None


def environment_from_file(
    path: PictureFile,
    face_size: int | None = None,
    exposure: float = 0.0,
    rotation: Any = None,
    part: str | int | None = None,
    layer: str | None = None,
) -> Environment:
    """Load an environment from an OpenEXR, Radiance, PNG or JPEG file.

    The attribute envmap of OpenEXR decides what the picture is; without it, its proportions do: 2:1 is a
    lat-long map, 1:6 and 6:1 are strips of faces in Vulkan's order and orientation, 3:4 and 4:3 are crosses
    around +Z with +X to its right (Vulkan's faces unfolded). Lat-long maps have latitude +90 in the top row
    and longitude +180 falling to -180 from left to right, with 0, in the middle, at +z and +90 at +x. OpenEXR
    samples its environment maps up to the border: lat-long maps are read so; the faces of its cubes keep
    their texels, which lie up to half a texel further inside here.

    Colours become linear Rec. 709. What else the file says is used, or said in the notes of the environment;
    ``help(burnish.images)`` has a table of all fields.

    Parameters
    ----------
    path : path, bytes, or binary file object
        The first bytes decide the format, not the name. An open file is read from where it stands to its end.
    face_size : int or None
        A power of two in 1..2048. None takes the least that loses no detail: for a lat-long map of width w
        the least power of two >= w/4, for a cube the least one >= its faces, both at most 2048. A map whose
        own size differs is resampled by exact area, and the notes of the environment say so.
    exposure : float
        Stops; the radiance is multiplied by 2**exposure when it is looked up.
    rotation : None, float or (3, 3) array
        Turns the map in the world: degrees about +y, or the matrix world_from_environment.
    part : str, int or None
        Name, view or index of a part of an OpenEXR file. None: the first that is a picture.
    layer : str or None
        What stands before the last dot of an OpenEXR file's channels, empty for those without one. None: the
        channels without a layer, or the only layer of colour.

    Returns
    -------
    environment : Environment
        Named after the file.

    Raises
    ------
    FileError
        If the file is missing, damaged, or no environment by its shape.
    ValueError
        If `path` is none of these, or there is no such part or layer.

    Warns
    -----
    UserWarning
        For PNG and JPEG, which hold no radiance above 1, and for what a file says that would change the map
        and is not used.
    """
    source = open_source(path)
    picture = read_picture(source, part, layer)
    height, width = picture.pixels.shape[:2]
    notes = [*picture.notes]
    ignored = [*picture.ignored]
    if picture.pixels.shape[2] == 4 and not (picture.pixels[..., 3] == 1.0).all():
        notes.append("alpha is left out: the colours are read as they stand.")
    cube = None if picture.envmap == exr_header.LATLONG else _cube_faces(picture)
    if cube is not None:
        faces, layout = cube
        given = faces.shape[1]
        if layout == "OpenEXR cube":
            notes.append("OpenEXR cube, sampled up to the edges of its faces: up to half a texel off there.")
        size = _power_of_two_at_least(given) if face_size is None else face_size
        if size != given:
            _require_face_size(size)
            faces = cube_layout.resample_faces(faces, size)
            notes.append(f"{layout} with faces of {given} texels resampled by area to {size}.")
        environment = Environment.from_faces(np.ascontiguousarray(faces), exposure, rotation)
    elif width == 2 * height or picture.envmap == exr_header.LATLONG:
        size = _power_of_two_at_least(width / 4) if face_size is None else face_size
        pixels = np.ascontiguousarray(picture.pixels[..., :3])
        is_marked = picture.envmap == exr_header.LATLONG and min(height, width) >= 2
        environment = Environment.from_lat_long(pixels, size, exposure, rotation, border_samples=is_marked)
        notes.append(f"lat-long map of {width} x {height} resampled by area to faces of {size}.")
    else:
        raise file_error(
            source.name,
            "expected an environment of width:height 2:1 (lat-long), 1:6 or 6:1 (strip of faces), "
            f"3:4 or 4:3 (cross), got {width} x {height}",
        )
    if not picture.is_high_dynamic_range:
        ignored.append(f"{picture.format} holds no radiance above 1: lights in it are far too dim.")
    for sentence in ignored:
        warnings.warn(f"{source.name}: {sentence}", UserWarning, stacklevel=2)
    environment.name = source.label
    environment.notes = notes + ignored
    return environment


def _require_face_size(size: int) -> None:
    if not 1 <= size <= MAX_FACE_SIZE or size & (size - 1):
        raise ValueError(f"face_size: expected a power of two in 1..{MAX_FACE_SIZE}, got {size}")

"""Environments from picture files."""

import os
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish import cube_layout
from burnish._core import Environment
from burnish.images import exr_header
from burnish.images.files import file_error
from burnish.images.picture import Picture, read_picture

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
    path: str | os.PathLike[str],
    face_size: int | None = None,
    exposure: float = 0.0,
    rotation: Any = None,
) -> Environment:
    """Load an environment from an OpenEXR, Radiance, PNG or JPEG file.

    The attribute envmap of OpenEXR decides what the picture is; without it, its proportions do: 2:1 is a
    lat-long map, 1:6 and 6:1 are strips of faces in Vulkan's order and orientation, 3:4 and 4:3 are crosses
    around +Z with +X to its right (Vulkan's faces unfolded). Lat-long maps have latitude +90 in the top row
    and longitude +180 falling to -180 from left to right, with 0, in the middle, at +z and +90 at +x. OpenEXR
    samples its environment maps up to the border: lat-long maps are read so; the faces of its cubes keep
    their texels, which lie up to half a texel further inside here.

    Parameters
    ----------
    path : path
        The first bytes decide the format, not the name.
    face_size : int or None
        A power of two in 1..2048. None takes the least that loses no detail: for a lat-long map of width w
        the least power of two >= w/4, for a cube the least one >= its faces, both at most 2048. A map whose
        own size differs is resampled by exact area, and the notes of the environment say so.
    exposure : float
        Stops; the radiance is multiplied by 2**exposure when it is looked up.
    rotation : None, float or (3, 3) array
        Turns the map in the world: degrees about +y, or the matrix world_from_environment.

    Returns
    -------
    environment : Environment
        Named after the file.

    Raises
    ------
    FileError
        If the file is missing, damaged, or no environment by its shape.

    Warns
    -----
    UserWarning
        For PNG and JPEG, which hold no radiance above 1.
    """
    picture = read_picture(path)
    height, width = picture.pixels.shape[:2]
    notes = []
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
            path,
            "expected an environment of width:height 2:1 (lat-long), 1:6 or 6:1 (strip of faces), "
            f"3:4 or 4:3 (cross), got {width} x {height}",
        )
    if not picture.is_high_dynamic_range:
        notes.append(f"{picture.format} holds no radiance above 1: lights in it are far too dim.")
        warnings.warn(f"{os.fspath(path)}: {notes[-1]}", UserWarning, stacklevel=2)
    environment.name = os.path.basename(os.fspath(path))
    environment.notes = notes
    return environment


def _require_face_size(size: int) -> None:
    if not 1 <= size <= MAX_FACE_SIZE or size & (size - 1):
        raise ValueError(f"face_size: expected a power of two in 1..{MAX_FACE_SIZE}, got {size}")

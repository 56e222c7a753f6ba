"""Maps that diffuse light is judged under: built-in ones, a lamp made by code, and the shared real ones."""

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.environments import cube_directions

FACE_SIZE = 64
REAL_MAPS = (
    "KernerEnvCube.exr",
    "KernerEnvLatLong.exr",
    "OrientationLatLong.exr",
    "lebombo_1k.hdr",
    "rooitou_park_1k.hdr",
    "studio_small_03_1k.hdr",
    "venice_sunset_1k.hdr",
)


def lamp(toward=(0.3, 0.8, 0.52), degrees=8.0, radiance=300.0, background=0.3, face_size=FACE_SIZE):
    """Even light with one bright round lamp of so many degrees from its middle."""
    d = cube_directions(face_size).astype(np.float64)
    toward = np.asarray(toward) / np.linalg.norm(toward)
    cosines = (d @ toward) / np.linalg.norm(d, axis=-1)
    faces = np.where((cosines > np.cos(np.radians(degrees)))[..., None], radiance, background)
    return burnish.Environment.from_faces(np.ascontiguousarray(faces * np.ones(3), np.float32))


MADE_MAPS = {
    "spots": lambda: environments.spots(3, FACE_SIZE),
    "sky and sun": lambda: environments.sky(face_size=FACE_SIZE),
    "studio": lambda: environments.studio(FACE_SIZE),
    "lamp": lamp,
    "one texel a face": lambda: burnish.Environment.from_faces(
        np.arange(18, dtype=np.float32).reshape(6, 1, 1, 3)
    ),
}


def make_map(name, shared_data_of, face_size=FACE_SIZE):
    """Make a map by name; a real one is skipped where it is not there."""
    if name in MADE_MAPS:
        return MADE_MAPS[name]()
    path = shared_data_of() / "environments" / name
    if not path.is_file():
        pytest.skip(f"needs {path}")
    return burnish.Environment.from_file(path, face_size=face_size)

"""Scenes and their cameras by name."""

from pathlib import Path
from typing import Literal

from burnish import builtin
from burnish._core import Camera, Scene


def open_scene(name: str, model: Literal["ggx", "kurt"] = "ggx") -> Scene:
    """Make the built-in scene of that name, or load a glTF file.

    Parameters
    ----------
    name : str
        A key of `builtin.SCENES`, or a path.
    model : str
        Of the materials of a file, see `Scene.from_file`.

    Raises
    ------
    ValueError
        If it is neither.
    """
    if name in builtin.SCENES:
        return builtin.make_scene(name)
    if Path(name).suffix == "" and not Path(name).exists():
        raise ValueError(f"SCENE: expected a file or one of {', '.join(builtin.SCENES)}, got {name!r}")
    return Scene.from_file(name, model)


def find_camera(scene: Scene, key: str | None) -> Camera | None:
    """Find a camera by name, or by index where no name fits; None for no key.

    Parameters
    ----------
    scene : Scene
        Whose cameras they are.
    key : str or None
        A name or an index.

    Raises
    ------
    ValueError
        If there is no such camera; it lists those there are.
    """
    if key is None:
        return None
    cameras = scene.cameras
    for camera in cameras:
        if camera.name == key:
            return camera
    if key.isdecimal() and int(key) < len(cameras):
        return cameras[int(key)]
    names = ", ".join(f"{i} ({camera.name or 'no name'})" for i, camera in enumerate(cameras))
    raise ValueError(f"--camera: expected one of {names or 'none: the scene has no camera'}, got {key!r}")

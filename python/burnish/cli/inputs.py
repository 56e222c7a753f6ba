"""Scenes and environments that arguments name."""

import argparse
from pathlib import Path

from burnish import builtin
from burnish._core import Environment, Scene
from burnish._progress import progress_bar
from burnish.scenes import open_scene


def open_environment(
    name: str,
    face_size: int | None,
    rotation_degrees: float,
    part: str | None = None,
    layer: str | None = None,
) -> Environment:
    """Load an environment file, or make the built-in environment of that name, turned about the y axis.

    Parameters
    ----------
    name : str
        A key of `builtin.ENVIRONMENTS`, or a path.
    face_size : int or None
        Texels along the edge of a face; None: as the file has, 256 of a built-in one.
    rotation_degrees : float
        About +y.
    part, layer : str or None
        Of an .exr file that has several.
    """
    if name in builtin.ENVIRONMENTS:
        if part is not None or layer is not None:
            raise ValueError(f"--env-part, --env-layer: expected a file as --env beside them, got {name!r}")
        environment = builtin.make_environment(name, face_size or 256)
    elif Path(name).suffix == "" and not Path(name).exists():
        raise ValueError(f"--env: expected a file or one of {', '.join(builtin.ENVIRONMENTS)}, got {name!r}")
    else:
        with progress_bar(f"loading {Path(name).name}"):
            environment = Environment.from_file(name, face_size=face_size, part=part, layer=layer)
    if rotation_degrees:
        environment.rotation = rotation_degrees
    return environment


def prepare_scene(options: argparse.Namespace) -> Scene:
    """Load the scene and the environment that the arguments name.

    Parameters
    ----------
    options : Namespace
        Of a command with `add_scene_arguments`.
    """
    with progress_bar(f"loading {Path(options.scene).name}"):
        scene = open_scene(options.scene, options.model)
    scene.environment = open_environment(
        options.env, options.face_size, options.rotate_env, options.env_part, options.env_layer
    )
    if options.no_background:
        scene.show_background = False
    return scene

"""Descriptions of what is drawn: small, comparable, and the same in every process that opens them."""

import os
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Protocol

from burnish import _core, builtin
from burnish.rendering import Filter
from burnish.samplers import parse_value
from burnish.scenes import find_camera, open_scene
from burnish.study.identity import digest, make_material
from burnish.study.subject import SceneSubject, Subject

Parameters = tuple[tuple[str, Any], ...]

CACHED_ENVIRONMENTS = 4
"""Environments kept in memory: the cells of a sweep come one after another through few of them."""


class Source(Protocol):
    """Something that a process can open and draw."""

    def key(self) -> str:
        """Digest of all that decides the values."""

    def reference_key(self) -> str:
        """Digest of all that decides the reference: no filter, since references read the texels."""

    def open(self) -> Subject:
        """Load it."""


@dataclass(frozen=True, eq=False)
class LiveSource:
    """A subject that is open already. It cannot travel to another process.

    Parameters
    ----------
    subject : Subject
        What is drawn.
    """

    subject: Subject

    def key(self) -> str:
        """Digest of all that decides the values."""
        return self.subject.fingerprint()

    def reference_key(self) -> str:
        """Digest of all that decides the reference."""
        return self.subject.fingerprint(with_filter=False)

    def open(self) -> Subject:
        """Give the subject."""
        return self.subject


def _file_state(name: str) -> list[Any]:
    """Size and time of a file, so that a file that was replaced is another one."""
    state = os.stat(name)
    return [name, state.st_size, state.st_mtime_ns]


@dataclass(frozen=True)
class EnvironmentSource:
    """An environment by name.

    Parameters
    ----------
    name : str
        A key of ``builtin.ENVIRONMENTS``, or a file.
    parameters : tuple of (name, value)
        Arguments of the built-in function, or ``face_size`` of a file.
    rotation_degrees : float
        Turned about +y.
    """

    name: str
    parameters: Parameters = ()
    rotation_degrees: float = 0.0

    @classmethod
    def from_text(
        cls, text: str, face_size: int | None = None, rotation_degrees: float = 0.0
    ) -> "EnvironmentSource":
        """Read ``studio``, ``spots:seed=2:face_size=512`` or a path.

        Parameters
        ----------
        text : str
            Name of a built-in environment with its arguments, or a file.
        face_size : int or None
            Where the text names none. None: 256 for a built-in environment, the file's own for a file.
        rotation_degrees : float
            Turned about +y.
        """
        name, *options = text.split(":")
        if name not in builtin.ENVIRONMENTS:
            if Path(text).suffix == "" and not Path(text).exists():
                names = ", ".join(builtin.ENVIRONMENTS)
                raise ValueError(f"environment: expected a file or one of {names}, got {text!r}")
            parameters: dict[str, Any] = {} if face_size is None else {"face_size": face_size}
            return cls(text, tuple(parameters.items()), rotation_degrees)
        wrong = [option for option in options if "=" not in option]
        if wrong:
            raise ValueError(f"environment: expected NAME:KEY=VALUE, got {wrong[0]!r} in {text!r}")
        given = {key: parse_value(value) for key, value in (option.split("=", 1) for option in options)}
        parameters = {"face_size": face_size or 256} | given
        return cls(name, tuple(sorted(parameters.items())), rotation_degrees)

    def open(self) -> _core.Environment:
        """Load it, or take it from the few that were loaded last."""
        return _open_environment(self)

    def state(self) -> list[Any]:
        """Everything that decides its texels."""
        file = [] if self.name in builtin.ENVIRONMENTS else _file_state(self.name)
        return [self.name, [list(pair) for pair in self.parameters], self.rotation_degrees, file]


@lru_cache(maxsize=CACHED_ENVIRONMENTS)
def _open_environment(source: EnvironmentSource) -> _core.Environment:
    parameters = dict(source.parameters)
    if source.name in builtin.ENVIRONMENTS:
        try:
            environment = builtin.ENVIRONMENTS[source.name](**parameters)
        except TypeError as error:
            raise ValueError(f"environment {source.name}: {error}") from error
    else:
        environment = _core.Environment.from_file(source.name, **parameters)
        environment.name = environment.name or Path(source.name).stem
    if source.rotation_degrees:
        environment.rotation = source.rotation_degrees
    return environment


def require_scene_name(name: str) -> None:
    """Raise ValueError unless a scene of that name can be looked for."""
    if name not in builtin.SCENES and Path(name).suffix == "" and not Path(name).exists():
        raise ValueError(f"scene: expected a file or one of {', '.join(builtin.SCENES)}, got {name!r}")


@dataclass(frozen=True, eq=False)
class SceneSource:
    """A scene by name, with its light and its view.

    Parameters
    ----------
    scene : str
        A key of ``builtin.SCENES``, or a glTF file.
    environment : EnvironmentSource
        Its light.
    material : dict or None
        As `describe_material` gives it, in place of the scene's first. None: the scene's own.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the pyramid.
    size : (height, width)
        Pixels.
    spp : int
        Jittered frames to accumulate.
    camera : str or None
        Name or index. None: the scene's first, or one that sees all of it.
    device : str
        Part of a Vulkan device's name; empty: the best one.
    """

    scene: str
    environment: EnvironmentSource
    material: dict[str, Any] | None = None
    filter: Filter = "gauss6"
    size: tuple[int, int] = (270, 480)
    spp: int = 1
    camera: str | None = None
    device: str = ""

    def _state(self) -> dict[str, Any]:
        state = asdict(self) | {"environment": self.environment.state()}
        del state["device"]
        file = [] if self.scene in builtin.SCENES else _file_state(self.scene)
        return state | {"size": list(self.size), "file": file}

    def key(self) -> str:
        """Digest of all that decides the values."""
        return digest(self._state())

    def reference_key(self) -> str:
        """Digest of all that decides the reference."""
        return digest({name: value for name, value in self._state().items() if name != "filter"})

    def open(self) -> Subject:
        """Load scene and environment and open a device."""
        scene = open_scene(self.scene)
        scene.name = Path(self.scene).stem
        if self.material is not None:
            scene.set_material(0, make_material(self.material))
        scene.environment = self.environment.open()
        camera = find_camera(scene, self.camera)
        device = _open_device(self.device) if self.device else None
        return SceneSubject(scene, camera, self.size, self.spp, self.filter, device)


@lru_cache(maxsize=2)
def _open_device(name: str) -> _core.Device:
    return _core.Device(name=name)

"""What a study draws again and again: a scene seen by a camera, or points of a surface."""

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish._device import default_device
from burnish.frame import FloatArray
from burnish.rendering import Filter, draw, shade
from burnish.study import identity
from burnish.study.timing import frame_times

Sampler: TypeAlias = Any
"""Any of the engine's samplers; a study knows none of them by name."""


Progress: TypeAlias = Callable[[float, str], None]

PIPELINES_A_SAMPLER = 40
"""Most that one picture uses: a shade class each, the background, and the steps around them."""


@dataclass(frozen=True, eq=False)
class Points:
    """Points of one material under one environment, as `burnish.shade` takes them.

    Parameters
    ----------
    environment : Environment
        Distant light.
    material : Material
        One for all points.
    normals, tangents, views : (n, 3) float32
        World frame, C-contiguous; views point toward the eye.
    """

    environment: _core.Environment
    material: _core.Material
    normals: FloatArray
    tangents: FloatArray
    views: FloatArray


@dataclass(frozen=True, eq=False)
class Shot:
    """One drawing: values and what they cost.

    Parameters
    ----------
    color : (h, w, 3) or (n, 3) float32
        Linear radiance.
    covered : (h, w) or (n,) bool
        What counts in an error.
    times : dict
        Milliseconds by name, as `frame_times` gives them.
    compile_ms : float
        Spent making pipelines, in none of the times.
    samples_used : str
        Samples really taken, as the report says it.
    standard_error : float
        Of a progressive reference, relative; else 0.
    warnings : list of str
        What the renderer had to say.
    """

    color: FloatArray
    covered: NDArray[np.bool_]
    times: dict[str, float]
    compile_ms: float = 0.0
    samples_used: str = ""
    standard_error: float = 0.0
    warnings: list[str] = field(default_factory=list)


class Subject(Protocol):
    """Something that can be drawn with any sampler."""

    def draw(self, sampler: Sampler, progress: Progress | None = None) -> Shot:
        """Draw it once; `progress` is called with the share done and the step's name."""

    def device_names(self) -> dict[str, Any]:
        """Give ``device``, ``driver``, ``is_software`` and ``lookup``."""

    def keeping_pipelines(self, sampler_count: int) -> AbstractContextManager[None]:
        """Have the device keep what so many samplers need while they take turns."""

    def describe(self) -> dict[str, Any]:
        """Name what is drawn, for people: scene, material, environment, filter, size."""

    def fingerprint(self, with_filter: bool = True) -> str:
        """Digest of all that decides the values: equal for equal subjects, in every process."""


@contextmanager
def _keeping_pipelines(device: _core.Device, sampler_count: int) -> Iterator[None]:
    before = device.pipeline_budget
    device.pipeline_budget = max(before, PIPELINES_A_SAMPLER * sampler_count)
    try:
        yield
    finally:
        device.pipeline_budget = before


def _device_names(device: _core.Device) -> dict[str, Any]:
    return {
        "device": device.name,
        "driver": device.driver,
        "is_software": device.is_software,
        "lookup": device.lookup,
    }


class SceneSubject:
    """A scene, seen by a camera.

    Parameters
    ----------
    scene : Scene
        With its environment.
    camera : Camera or None
        None: the scene's first, or one that sees all of it.
    size : (height, width)
        Pixels.
    spp : int
        Jittered frames to accumulate.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the pyramid.
    device : Device or None
        None: the best one.
    """

    def __init__(
        self,
        scene: _core.Scene,
        camera: _core.Camera | None = None,
        size: tuple[int, int] = (270, 480),
        spp: int = 1,
        filter: Filter = "gauss6",
        device: _core.Device | None = None,
    ) -> None:
        self._scene, self._camera, self._size = scene, camera, size
        self._spp, self._filter = spp, filter
        self._device = device or default_device()

    def draw(self, sampler: Sampler, progress: Progress | None = None) -> Shot:
        """Render one frame."""
        frame = draw(
            self._scene, self._camera, self._size, sampler, self._device, self._spp, self._filter, progress
        )
        report = frame.report
        return Shot(
            frame.color,
            frame.alpha > 0,
            frame_times(report),
            report.compile_ms,
            report.samples_used,
            report.standard_error,
            report.warnings,
        )

    def device_names(self) -> dict[str, Any]:
        """Give ``device``, ``driver``, ``is_software`` and ``lookup``."""
        return _device_names(self._device)

    def keeping_pipelines(self, sampler_count: int) -> AbstractContextManager[None]:
        """Have the device keep what so many samplers need while they take turns.

        Parameters
        ----------
        sampler_count : int
        """
        return _keeping_pipelines(self._device, sampler_count)

    def describe(self) -> dict[str, Any]:
        """Name scene, materials, environment, filter and size."""
        height, width = self._size
        return {
            "scene": self._scene.name or "scene",
            "material": identity.materials_label(self._scene.materials),
            "environment": identity.environment_label(self._scene.environment),
            "filter": self._filter,
            "height": height,
            "width": width,
            "spp": self._spp,
        }

    def fingerprint(self, with_filter: bool = True) -> str:
        """Digest of scene, camera, size and filter."""
        camera = self._camera or (self._scene.cameras[0] if self._scene.cameras else None)
        return identity.digest(
            identity.describe_scene(self._scene),
            identity.describe_camera(camera),
            [*self._size, self._spp, self._filter if with_filter else ""],
        )


class PointsSubject:
    """Points of a surface, shaded by the kernel that shades pictures.

    Their times are the wall clock's, from the call to the array: a call of `burnish.shade` has no report.

    Parameters
    ----------
    points : Points
        What to shade.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the pyramid.
    device : Device or None
        None: the best one.
    """

    def __init__(self, points: Points, filter: Filter = "gauss6", device: _core.Device | None = None) -> None:
        self._points, self._filter = points, filter
        self._device = device or default_device()

    def draw(self, sampler: Sampler, progress: Progress | None = None) -> Shot:
        """Shade all points once; nothing is heard of it until it is done."""
        points = self._points
        began = time.perf_counter()
        color, report = shade(
            points.environment,
            points.material,
            sampler,
            points.normals,
            points.tangents,
            points.views,
            self._filter,
            self._device,
            report=True,
        )
        wall_ms = 1e3 * (time.perf_counter() - began)
        times = {"frame_ms": wall_ms, "shade_ms": wall_ms, "wall_ms": wall_ms}
        return Shot(color, np.ones(len(color), bool), times, samples_used=report.samples_used)

    def device_names(self) -> dict[str, Any]:
        """Give ``device``, ``driver``, ``is_software`` and ``lookup``."""
        return _device_names(self._device)

    def keeping_pipelines(self, sampler_count: int) -> AbstractContextManager[None]:
        """Have the device keep what so many samplers need while they take turns.

        Parameters
        ----------
        sampler_count : int
        """
        return _keeping_pipelines(self._device, sampler_count)

    def describe(self) -> dict[str, Any]:
        """Name material, environment and filter; the scene is the number of points."""
        count = len(self._points.normals)
        return {
            "scene": f"{count} points",
            "material": identity.materials_label([self._points.material]),
            "environment": identity.environment_label(self._points.environment),
            "filter": self._filter,
            "height": 1,
            "width": count,
            "spp": 1,
        }

    def fingerprint(self, with_filter: bool = True) -> str:
        """Digest of environment, material, points and filter."""
        points = self._points
        return identity.digest(
            identity.describe_environment(points.environment),
            identity.describe_material(points.material),
            [points.normals, points.tangents, points.views],
            [self._filter if with_filter else ""],
        )


def make_subject(
    scene_or_points: _core.Scene | Points | Sequence[Any],
    camera: _core.Camera | None,
    size: tuple[int, int],
    spp: int,
    filter: Filter,
    device: _core.Device | None,
) -> Subject:
    """Wrap a scene, `Points`, or a tuple (environment, material, normals, tangents, views)."""
    if isinstance(scene_or_points, _core.Scene):
        return SceneSubject(scene_or_points, camera, size, spp, filter, device)
    if isinstance(scene_or_points, Points):
        return PointsSubject(scene_or_points, filter, device)
    if isinstance(scene_or_points, tuple) and len(scene_or_points) == 5:
        return PointsSubject(Points(*scene_or_points), filter, device)
    forms = "a Scene, Points, or a tuple (environment, material, normals, tangents, views)"
    raise ValueError(f"scene_or_points: expected {forms}, got {type(scene_or_points).__name__}")

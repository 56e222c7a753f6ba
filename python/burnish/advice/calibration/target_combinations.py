"""What targets are checked on: scenes under environments that no model was fitted to, and their truth."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from burnish import _core, environments
from burnish._device import default_device
from burnish.advice import Advice, advise
from burnish.advice.families import FAMILIES, sampler_text
from burnish.advice.reduced_maps import reduced_face_size
from burnish.advice.truth import draw_dense, draw_truth
from burnish.environments import cube_directions
from burnish.frame import Frame
from burnish.render import render
from burnish.samplers import sampler_from_text
from burnish.study.calibration_set import FACE_SIZE, UNSEEN_LOBES, unseen_environments

SIZE = (112, 112)
STANDARD_ERROR, MOST_SAMPLES = 0.003, 1 << 16
"""Of the truth of scenes with diffuse parts: its noise adds 4 % to what is found at the smallest target."""

REAL_MAPS = (
    "lebombo_1k.hdr",
    "rooitou_park_1k.hdr",
    "studio_small_03_1k.hdr",
    "venice_sunset_1k.hdr",
    "KernerEnvLatLong.exr",
)
"""Under ``environments`` of the folder of data."""

GLTF_SCENES = (
    "Suzanne/Suzanne.gltf",
    "WaterBottle/WaterBottle.gltf",
    "SpecularTest/SpecularTest.glb",
    "ClearCoatCarPaint/ClearCoatCarPaint.glb",
)
"""Under ``scenes`` of the folder of data; each under the first two real maps."""


def _dielectric(roughness: float) -> _core.KurtLobe:
    return _core.KurtLobe(roughness, r0=0.04, alpha=0.5)


DIFFUSE_MATERIALS: dict[str, _core.Material] = {
    "diffuse .7": _core.Material(diffuse=0.7),
    "plastic, m .3": _core.Material(diffuse=(0.6, 0.5, 0.3), lobes=[_dielectric(0.3)]),
    "lacquer, m .08": _core.Material(diffuse=(0.4, 0.02, 0.02), lobes=[_dielectric(0.08)]),
    "satin, m .25/.1": _core.Material(diffuse=0.3, lobes=[_core.KurtLobe((0.25, 0.1), weight=0.4)]),
}


@dataclass(frozen=True)
class Case:
    """A scene that targets are checked on.

    Parameters
    ----------
    environment, material : str
        Names.
    make_scene : callable
        Makes it.
    draw_truth : callable
        Draws what it should look like.
    """

    environment: str
    material: str
    make_scene: Callable[[], _core.Scene]
    draw_truth: Callable[[_core.Scene], Frame]


def sum_texels(scene: _core.Scene) -> Frame:
    """Draw a scene by the sums over every texel that the advice itself is judged by.

    Parameters
    ----------
    scene : Scene
        Of lobes.
    """
    device, face_size = default_device(), reduced_face_size(list(scene.materials))
    dense = draw_dense(scene, None, SIZE, "gauss6", device)
    return draw_truth(scene, None, SIZE, "gauss6", device, face_size, dense)


def sample_truth(scene: _core.Scene) -> Frame:
    """Draw a scene by a progressive reference, which shares neither maps nor lookups with the advice.

    Parameters
    ----------
    scene : Scene
        Any.
    """
    return render(scene, size=SIZE, sampler=_core.Reference(STANDARD_ERROR, "progressive", MOST_SAMPLES))


def lamp_behind(face_size: int = FACE_SIZE) -> _core.Environment:
    """Make dim even light with a round lamp of 8 degrees behind what the camera looks at.

    Parameters
    ----------
    face_size : int
        Texels along a face.
    """
    d = cube_directions(face_size)
    cosines = d @ (0.25, 0.3, -0.9) / np.linalg.norm(d, axis=-1) / np.linalg.norm((0.25, 0.3, -0.9))
    faces = np.where((cosines > np.cos(np.radians(4.0)))[..., None], 1000.0, 0.1) * np.ones(3)
    return _core.Environment.from_faces(np.ascontiguousarray(faces, np.float32))


def _real_map(path: Path) -> Callable[[], _core.Environment]:
    return lambda: _core.Environment.from_file(path, face_size=FACE_SIZE)


def _lit(scene: _core.Scene, environment: _core.Environment) -> _core.Scene:
    scene.environment = environment
    return scene


def _model(file: Path, make: Callable[[], _core.Environment]) -> Callable[[], _core.Scene]:
    return lambda: _lit(_core.Scene.from_file(file), make())


def _sphere(material: _core.Material, make: Callable[[], _core.Environment]) -> Callable[[], _core.Scene]:
    return lambda: _lit(_core.Scene.sphere(material), make())


def lobe_cases() -> Iterator[Case]:
    """Give spheres of one lobe."""
    for environment, make in unseen_environments().items():
        for name, lobe in UNSEEN_LOBES.items():
            yield Case(environment, name, _sphere(_core.Material(lobes=[lobe]), make), sum_texels)


def diffuse_cases(data: Path | None) -> Iterator[Case]:
    """Give scenes with diffuse parts: spheres under every map, then glTF scenes.

    Parameters
    ----------
    data : path or None
        Folder with ``environments`` and ``scenes``; what is absent is left out.
    """
    maps: dict[str, Callable[[], _core.Environment]] = {
        "spots, seed 1": lambda: environments.spots(1, FACE_SIZE),
        "sky, sun behind": lambda: environments.sky((-0.4, 0.5, -0.7), 5000.0, 1.0, FACE_SIZE),
        "lamp behind": lamp_behind,
    }
    real = [data / "environments" / name for name in REAL_MAPS] if data else []
    for path in real:
        if path.is_file():
            maps[path.stem] = _real_map(path)
    for environment, make in maps.items():
        for name, material in DIFFUSE_MATERIALS.items():
            yield Case(environment, name, _sphere(material, make), sample_truth)
    files = [data / "scenes" / name for name in GLTF_SCENES] if data else []
    for file in files:
        for environment, make in list(maps.items())[3:5]:
            if file.is_file():
                yield Case(environment, file.stem, _model(file, make), sample_truth)


def next_cheaper(advice: Advice) -> str | None:
    """Name the next smaller count of the chosen sampler.

    Parameters
    ----------
    advice : Advice
        With its choice.
    """
    chosen = advice.chosen
    if chosen.family not in FAMILIES:
        return None
    below = [count for count in FAMILIES[chosen.family].counts if count < chosen.count]
    return sampler_text(chosen.family, below[-1]) if below else None


class Combination:
    """A scene under one environment, and what it should look like.

    Parameters
    ----------
    case : Case
        That is made.
    """

    def __init__(self, case: Case) -> None:
        self.scene = case.make_scene()
        self.truth = case.draw_truth(self.scene)
        self._errors: dict[str, float] = {}

    def error(self, sampler: str) -> float:
        """Relative RMSE of the whole picture by a sampler.

        Parameters
        ----------
        sampler : str
            As text.
        """
        if sampler not in self._errors:
            frame = render(self.scene, size=SIZE, sampler=sampler_from_text(sampler))
            self._errors[sampler] = frame.error(self.truth)
        return self._errors[sampler]

    def check_target(self, target: float, has_probe: bool) -> tuple[Advice, float, float | None]:
        """Ask for a target and measure what is reached, and what the next cheaper count would have.

        Parameters
        ----------
        target : float
            Relative RMSE.
        has_probe : bool
            Whether the advice may measure on a small picture.
        """
        advice = advise(self.scene, target, SIZE, probe=has_probe)
        cheaper = next_cheaper(advice)
        return advice, self.error(advice.chosen.sampler), None if cheaper is None else self.error(cheaper)

    def check_estimate(self, sampler: str) -> tuple[float, float]:
        """Judge the error estimate of a sampler.

        Parameters
        ----------
        sampler : str
            As text.

        Returns
        -------
        rank : float
            Rank correlation of estimated and true error over the pixels with objects.
        ratio : float
            Estimated over true relative RMSE.
        """
        made = sampler_from_text(sampler)
        frame = render(self.scene, size=SIZE, sampler=made, error_estimate=True)
        assert frame.error_estimate is not None
        covered = frame.alpha > 0
        true = np.sum((frame.color.astype(np.float64) - self.truth.color) ** 2, axis=-1)
        estimated, exact = (
            np.argsort(np.argsort(values[covered])).astype(np.float64)
            for values in (frame.error_estimate, true)
        )
        rank = float(np.corrcoef(estimated, exact)[0, 1])
        return rank, frame.estimated_error() / self.error(sampler)

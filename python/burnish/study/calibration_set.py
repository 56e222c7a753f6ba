"""What the error model is fitted to, and what it is judged on: no environment or material is in both."""

from collections.abc import Callable
from pathlib import Path

from burnish import environments
from burnish._core import Environment, KurtLobe

WORLDS = Path("/usr/share/blender/datafiles/studiolights/world")
"""From Debian's package blender-data; what is absent is left out, and said."""

FACE_SIZE = 256


def _world(name: str) -> Callable[[], Environment]:
    return lambda: Environment.from_file(WORLDS / f"{name}.exr", face_size=FACE_SIZE)


def _is_there(name: str) -> bool:
    return (WORLDS / f"{name}.exr").is_file()


def _worlds(*names: str) -> dict[str, Callable[[], Environment]]:
    return {name: _world(name) for name in names if _is_there(name)}


def training_environments() -> dict[str, Callable[[], Environment]]:
    """Give environments by name, each made when it is called."""
    low_sun = {"sun_radiance": 2000.0, "sun_diameter": 3.0}
    return {
        "spots, seed 11": lambda: environments.spots(11, FACE_SIZE),
        "spots, seed 12": lambda: environments.spots(12, FACE_SIZE),
        "studio": lambda: environments.studio(FACE_SIZE),
        "sky": lambda: environments.sky(face_size=FACE_SIZE),
        "sky, low wide sun": lambda: environments.sky((1.0, 0.25, 0.3), face_size=FACE_SIZE, **low_sun),
        **_worlds("city", "forest", "night", "interior"),
    }


def unseen_environments() -> dict[str, Callable[[], Environment]]:
    """Give the environments that acceptance is judged on."""
    return {
        "spots, seed 1": lambda: environments.spots(1, FACE_SIZE),
        "spots, seed 2": lambda: environments.spots(2, FACE_SIZE, contrast=(5.0, 200.0)),
        "sky, sun behind": lambda: environments.sky((-0.4, 0.5, -0.7), 5000.0, 1.0, FACE_SIZE),
        **_worlds("courtyard", "sunset"),
    }


def _dielectric(roughness: float) -> KurtLobe:
    return KurtLobe(roughness, r0=0.04, alpha=0.5)


TRAINING_LOBES: dict[str, KurtLobe] = {
    "m .05": KurtLobe(0.05),
    "m .1": KurtLobe(0.1),
    "m .2": KurtLobe(0.2),
    "m .4": KurtLobe(0.4),
    "m .7": KurtLobe(0.7),
    "m .2/.075": KurtLobe((0.2, 0.075)),
    "m .3/.05": KurtLobe((0.3, 0.05)),
    "m .1/.04": KurtLobe((0.1, 0.04)),
    "m .15, r0 .04, alpha .5": _dielectric(0.15),
    "m .35, r0 .04, alpha .5": _dielectric(0.35),
    "m .3/.1, gold, alpha .5": KurtLobe((0.3, 0.1), r0=(1.0, 0.8, 0.4), alpha=0.5),
}

UNSEEN_LOBES: dict[str, KurtLobe] = {
    "m .07": KurtLobe(0.07),
    "m .3": KurtLobe(0.3),
    "m .25/.08": KurtLobe((0.25, 0.08)),
    "m .12, r0 .04, alpha .5": _dielectric(0.12),
}

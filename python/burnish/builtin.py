"""Scenes and environments that need no file, by name."""

from collections.abc import Callable

from burnish import environments
from burnish._core import Environment, KurtLobe, Material, Scene

Color = tuple[float, float, float]

GOLD: Color = (1.0, 0.77, 0.34)
COPPER: Color = (0.96, 0.64, 0.54)
STEEL: Color = (0.62, 0.60, 0.58)


def metal(color: Color, roughness: tuple[float, float], rotation: float = 0.0) -> Material:
    """Make a metal: one Kurt lobe with Fresnel, nothing diffuse.

    Parameters
    ----------
    color : (r, g, b)
        Reflectance at normal incidence.
    roughness : (along, across)
        Beckmann slopes along the tangent and the bitangent.
    rotation : float
        Radians, turns the tangent.
    """
    return Material(lobes=[KurtLobe(roughness=roughness, r0=color, alpha=0.5, rotation=rotation)])


def lacquer(color: Color, roughness: float) -> Material:
    """Make a coated colour: diffuse below a lobe of 4 % reflectance.

    Parameters
    ----------
    color : (r, g, b)
        Diffuse reflectance.
    roughness : float
        Beckmann slope of the coat.
    """
    return Material(diffuse=color, lobes=[KurtLobe(roughness=(roughness, roughness), r0=0.04, alpha=0.5)])


def _sphere() -> Scene:
    return Scene.sphere(metal(GOLD, (0.2, 0.075)))


def _spheres() -> Scene:
    """Roughness grows to the right; brushed metals below isotropic ones."""
    slopes = [0.02, 0.05, 0.1, 0.2, 0.4]
    rows = [
        [metal(STEEL, (m, m)) for m in slopes],
        [lacquer((0.45, 0.03, 0.03), m) for m in slopes],
        [metal(COPPER, (m, m / 4)) for m in slopes],
    ]
    return Scene.spheres([material for row in rows for material in row], len(slopes))


def _plane() -> Scene:
    return Scene.plane(metal(STEEL, (0.25, 0.05)))


def _shader_ball() -> Scene:
    return Scene.shader_ball(metal(COPPER, (0.25, 0.06)), lacquer((0.2, 0.2, 0.22), 0.15))


SCENES: dict[str, Callable[[], Scene]] = {
    "sphere": _sphere,
    "spheres": _spheres,
    "plane": _plane,
    "shaderball": _shader_ball,
}


def make_scene(name: str) -> Scene:
    """Make a built-in scene.

    Parameters
    ----------
    name : str
        A key of `SCENES`.
    """
    if name not in SCENES:
        raise ValueError(f"scene: expected one of {', '.join(SCENES)}, got {name!r}")
    return SCENES[name]()


ENVIRONMENTS: dict[str, Callable[..., Environment]] = {
    "studio": environments.studio,
    "sky": environments.sky,
    "spots": environments.spots,
    "uniform": environments.uniform,
}


def make_environment(name: str, face_size: int = 256) -> Environment:
    """Make a built-in environment.

    Parameters
    ----------
    name : str
        A key of `ENVIRONMENTS`.
    face_size : int
        Texels along the edge of a face, a power of two in 1..2048.
    """
    if name not in ENVIRONMENTS:
        raise ValueError(f"environment: expected one of {', '.join(ENVIRONMENTS)}, got {name!r}")
    return ENVIRONMENTS[name](face_size=face_size)

"""Scenes of the reproduction: a sphere that fills the picture, a wall that covers a share of it exactly."""

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.frame import FloatArray

WALL_SEGMENTS = 64
WALL_BEND = 0.8
"""Tangent of the largest tilt of the wall's normals, along both axes."""


def glossy(roughness: tuple[float, float]) -> _core.Material:
    """Make the paper's material: one lobe, r0 = 1, alpha = 0."""
    return _core.Material(lobes=[_core.KurtLobe(roughness=roughness)])


def sphere_scene(material: _core.Material, environment: _core.Environment) -> _core.Scene:
    """Put one sphere into an environment."""
    scene = _core.Scene.sphere(material)
    scene.name = "sphere"
    scene.environment = environment
    return scene


def sphere_camera() -> _core.Camera:
    """Look at the sphere so that it just fits a square picture; seen from everywhere at once, to its rim."""
    return _core.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.02, near_plane=0.1, far_plane=10.0)


def _wall(left: float, right: float) -> _core.Mesh:
    """Make a flat wall of height 2 with the normals of a bulge: neighbouring pixels reflect other directions.

    Under a flat wall's one normal every pixel would read the same texels, which no picture does.
    """
    u, v = np.meshgrid(np.linspace(-1, 1, WALL_SEGMENTS + 1), np.linspace(-1, 1, WALL_SEGMENTS + 1))
    x = left + (right - left) * 0.5 * (u + 1)
    positions = np.stack([x, v, np.zeros_like(x)], axis=-1).reshape(-1, 3)
    normals = np.stack([WALL_BEND * u, WALL_BEND * v, np.ones_like(u)], axis=-1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    corner = np.arange(WALL_SEGMENTS * (WALL_SEGMENTS + 1)).reshape(WALL_SEGMENTS, -1)[:, :-1].reshape(-1, 1)
    above = corner + WALL_SEGMENTS + 1
    quads = np.concatenate([corner, corner + 1, above + 1, corner, above + 1, above], axis=1)
    tangents = np.tile(np.array([1, 0, 0, 1], np.float32), (len(positions), 1))

    def single(array: NDArray[np.floating]) -> FloatArray:
        return np.ascontiguousarray(array, np.float32)

    indices = np.ascontiguousarray(quads.reshape(-1, 3), np.uint32)
    return _core.Mesh(single(positions), indices, single(normals), tangents)


def wall_scene(
    share: float, size: tuple[int, int], material: _core.Material, environment: _core.Environment
) -> _core.Scene:
    """Cover a share of the picture, from its left edge, and leave the rest empty.

    Parameters
    ----------
    share : float in (0, 1]
        Of the columns; exact where it makes a whole number of them.
    size : (height, width)
        Of the picture that `wall_camera` sees.
    material : Material
        Of the wall.
    environment : Environment
        Its light; not drawn behind it.
    """
    aspect = size[1] / size[0]
    # Past the picture's own edges, so that only the inner edge decides; it lies between two columns.
    margin = 0.05
    right = aspect * (2 * share - 1) if share < 1 else aspect + margin
    scene = _core.Scene()
    transform = np.diag([1.0, 1.0 + margin, 1.0, 1.0])
    scene.add(_wall(-aspect - margin, right), material, transform, "wall")
    scene.environment = environment
    scene.show_background = False
    return scene


def wall_camera() -> _core.Camera:
    """Look straight at the wall; the picture is 2 high."""
    return _core.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, near_plane=0.1, far_plane=10.0)

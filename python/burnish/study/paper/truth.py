"""The reference for pictures under a large environment: every texel of reduced maps, extrapolated.

Summing all 6 x 1024^2 texels in every pixel takes hours. Glossy lobes are much wider than those texels, so a
smaller map gives nearly the same sum. It is made by the transpose of linear interpolation: each texel's flux
goes to its four nearest large texels so that its position stays. What is left is a blur whose variance is
proportional to the square of the texels' size; two sizes tell its effect, and extrapolation removes it.
"""

from dataclasses import dataclass

import numpy as np

from burnish import _core
from burnish.cube_layout import cube_solid_angles
from burnish.environments import Float64
from burnish.study.subject import Progress, SceneSubject, Shot

EXTRAPOLATION_GAIN = 8.0
"""Extrapolated from 32 and 64 faces, the error was 1/12, 1/8 and 1/12 of the correction for m = .1, .2/.075
and .15, judged by sums over 256 faces."""


@dataclass(frozen=True, eq=False)
class Truth:
    """A reference picture.

    Parameters
    ----------
    shot : Shot
        Values and cover.
    error : float
        Estimate of its own relative RMSE; 0 where every texel of the map itself was summed.
    method : str
        How it came about, for people.
    """

    shot: Shot
    error: float
    method: str


def _spread(size: int, reduced: int) -> Float64:
    """Shares (reduced, size) in which texels of a row go to the row's large texels."""
    position = np.clip((np.arange(size) + 0.5) * reduced / size - 0.5, 0, reduced - 1)
    lower = np.minimum(position.astype(int), max(reduced - 2, 0))
    upper = np.minimum(lower + 1, reduced - 1)
    shares: Float64 = np.zeros((reduced, size))
    np.add.at(shares, (lower, np.arange(size)), 1 - (position - lower))
    np.add.at(shares, (upper, np.arange(size)), position - lower)
    return shares


def reduce_environment(environment: _core.Environment, face_size: int) -> _core.Environment:
    """Make a smaller map of the same flux, each texel's where it was.

    Parameters
    ----------
    environment : Environment
        With faces of at least that size.
    face_size : int
        A power of two.

    Returns
    -------
    reduced : Environment
        Flux does not cross the edges of faces: along these, texels are displaced by up to half a large one.
    """
    faces = environment.faces
    size = faces.shape[1]
    if face_size > size:
        raise ValueError(f"face_size: expected at most {size}, got {face_size}")
    shares = _spread(size, face_size)
    weights = cube_solid_angles(size)[..., None]
    # One face and one axis at a time: a face of 1024 texels is 25 MB in double precision.
    flux = np.stack(
        [np.einsum("iy,jx,yxc->ijc", shares, shares, face * weights, optimize=True) for face in faces]
    )
    radiance = flux / cube_solid_angles(face_size)[None, ..., None]
    reduced = _core.Environment.from_faces(np.ascontiguousarray(radiance, np.float32))
    reduced.name = environment.name
    reduced.rotation = environment.rotation
    return reduced


def draw_truth(
    scene: _core.Scene,
    camera: _core.Camera,
    size: tuple[int, int],
    maps: list[_core.Environment],
    device: _core.Device,
    progress: Progress | None = None,
) -> Truth:
    """Draw the reference.

    Parameters
    ----------
    scene : Scene
        Its environment is replaced.
    camera : Camera
        What sees it.
    size : (height, width)
        Pixels.
    maps : list of Environment
        The scene's own map, or two reductions of it, the larger first and twice as large as the other.
    device : Device
        Draws.
    progress : callable or None
        Called with the share done and the step's name.
    """
    shots = []
    for one in maps:
        scene.environment = one
        subject = SceneSubject(scene, camera, size, device=device)
        shots.append(subject.draw(_core.Reference(method="quadrature"), progress))
    shot = shots[0]
    faces = maps[0].face_size
    if len(maps) == 1:
        return Truth(shot, 0.0, f"every texel of {faces}-texel faces")
    fine, coarse = (one.color.astype(np.float64) for one in shots)
    correction = (fine - coarse) / 3
    color = np.maximum(fine + correction, 0)
    covered = shot.covered
    moved = float(np.sqrt(np.mean(correction[covered] ** 2) / np.mean(color[covered] ** 2)))
    exact = Shot(color.astype(np.float32), covered, shot.times)
    method = f"every texel of the map reduced to {maps[1].face_size} and {faces} texels a face, extrapolated"
    return Truth(exact, moved / EXTRAPOLATION_GAIN, method)


def truth_maps(environment: _core.Environment, face_size: int) -> list[_core.Environment]:
    """Give the maps that `draw_truth` sums over: the map itself where it is that small, else two reductions.

    Parameters
    ----------
    environment : Environment
        The full map.
    face_size : int
        Faces of the larger reduction, at least 2.
    """
    if environment.face_size <= face_size:
        return [environment]
    return [reduce_environment(environment, size) for size in (face_size, face_size // 2)]

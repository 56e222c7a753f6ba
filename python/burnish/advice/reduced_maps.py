"""Maps of fewer texels in place of a scene's own, for sums over every texel.

A mean over four texels moves the light of a small lamp to their middle, by half of a large texel, and what a
surface sees of it changes in proportion. Here each texel shares its light out between the four larger ones
around it, so that the middle of the light stays where it is: what is left is a blur, which changes in
proportion to its square and is extrapolated away.
"""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.cube_layout import cube_solid_angles, resample_faces
from burnish.lobes import width_of
from burnish.oracle.cube_map import add_border

LOBE_TEXELS = 10.0
"""Roughness in texels of the reduced maps: extrapolated sums are then off by some .3 %, under suns."""

COARSEST_FACE = 32
DIFFUSE_FACE = 64
"""Least where something is diffuse: extrapolated cosine sums are .05 % off then, under a small lamp."""

MEAN_FACE = 512
"""Larger maps are averaged to this size first; half of such a texel does not matter."""

TEXTURED_FACE = 128
LEAST_ROUGHNESS = 1e-3


def reduced_face_size(materials: Sequence[_core.Material]) -> int:
    """Texels along a face that the narrowest lobe of the materials needs, a power of two.

    Parameters
    ----------
    materials : sequence of Material
        Where roughness comes from a texture it is unknown: then at least `TEXTURED_FACE`.
    """
    slopes = [min(width_of(lobe)) for material in materials for lobe in material.lobes]
    needed = LOBE_TEXELS / max(min(slopes, default=1.0), LEAST_ROUGHNESS)
    is_textured = any(material.is_metallic_roughness for material in materials)
    least = TEXTURED_FACE if is_textured else COARSEST_FACE
    if any(any(material.diffuse) for material in materials):
        least = max(least, DIFFUSE_FACE)
    return max(1 << math.ceil(math.log2(needed)), least)


def largest_face_size(scene: _core.Scene) -> int:
    """Texels along a face of the finest map that lights the scene; 1 where there is none.

    Parameters
    ----------
    scene : Scene
        With its environment, and maps of its objects' own.
    """
    maps = [scene.environment, *(one.reflects for one in scene.objects)]
    return max((one.face_size for one in maps if one is not None), default=1)


def halve_faces(faces: NDArray[np.float64]) -> NDArray[np.float64]:
    """Halve a map, its light shared out so that light and its middle stay the same.

    Along each axis a texel gives three quarters to the larger one that it lies in and the rest to the next,
    over the edges of faces too.

    Parameters
    ----------
    faces : (6, n, n, 3) float64
        Radiance, n even.

    Returns
    -------
    faces : (6, n/2, n/2, 3) float64
    """
    size = faces.shape[1]
    light = add_border(faces * cube_solid_angles(size)[..., None], 1)
    for axis in (1, 2):
        taps = [np.take(light, np.arange(k, k + size, 2), axis) for k in range(4)]
        light = 0.25 * (taps[0] + taps[3]) + 0.75 * (taps[1] + taps[2])
    return np.asarray(light / cube_solid_angles(size // 2)[..., None])


def reduce_environment(environment: _core.Environment, face_size: int) -> _core.Environment:
    """Give an environment larger texels; one that is as small already is given back.

    Parameters
    ----------
    environment : Environment
        To reduce.
    face_size : int
        A power of two.
    """
    if environment.face_size <= face_size:
        return environment
    faces = environment.faces
    if faces.shape[1] > max(MEAN_FACE, face_size):
        faces = resample_faces(faces, max(MEAN_FACE, face_size))
    halved = faces.astype(np.float64)
    while halved.shape[1] > face_size:
        halved = halve_faces(halved)
    return _core.Environment.from_faces(
        np.ascontiguousarray(halved, np.float32), environment.exposure, environment.rotation
    )


@contextmanager
def reduced_maps(scene: _core.Scene, face_size: int) -> Iterator[None]:
    """Put reduced maps in place of the scene's own for a while.

    Parameters
    ----------
    scene : Scene
        Gets its own maps back at the end, whatever happens.
    face_size : int
        A power of two.
    """
    environment, own = scene.environment, [one.reflects for one in scene.objects]
    reduced: dict[int, _core.Environment] = {}

    def reduce(given: _core.Environment) -> _core.Environment:
        if id(given) not in reduced:
            reduced[id(given)] = reduce_environment(given, face_size)
        return reduced[id(given)]

    try:
        if environment is not None:
            scene.environment = reduce(environment)
        for one, reflects in zip(scene.objects, own, strict=True):
            if reflects is not None:
                one.reflects = reduce(reflects)
        yield
    finally:
        scene.environment = environment
        for one, reflects in zip(scene.objects, own, strict=True):
            if reflects is not None:
                one.reflects = reflects

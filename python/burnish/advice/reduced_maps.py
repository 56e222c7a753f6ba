"""Maps of fewer texels in place of a scene's own, for sums over every texel."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np

from burnish import _core
from burnish.cube_layout import resample_faces

LOBE_TEXELS = 10.0
"""Roughness in texels of the reduced maps: extrapolated sums are then off by some .3 %, under suns."""

COARSEST_FACE = 32
TEXTURED_FACE = 128
LEAST_ROUGHNESS = 1e-3


def reduced_face_size(materials: Sequence[_core.Material]) -> int:
    """Texels along a face that the narrowest lobe of the materials needs, a power of two.

    Parameters
    ----------
    materials : sequence of Material
        Where roughness comes from a texture it is unknown: then at least `TEXTURED_FACE`.
    """
    slopes = [min(lobe.roughness) for material in materials for lobe in material.lobes]
    needed = LOBE_TEXELS / max(min(slopes, default=1.0), LEAST_ROUGHNESS)
    is_textured = any(material.is_metallic_roughness for material in materials)
    return max(1 << math.ceil(math.log2(needed)), TEXTURED_FACE if is_textured else COARSEST_FACE)


def largest_face_size(scene: _core.Scene) -> int:
    """Texels along a face of the finest map that lights the scene; 1 where there is none.

    Parameters
    ----------
    scene : Scene
        With its environment, and maps of its objects' own.
    """
    maps = [scene.environment, *(one.reflects for one in scene.objects)]
    return max((one.face_size for one in maps if one is not None), default=1)


def reduce_environment(environment: _core.Environment, face_size: int) -> _core.Environment:
    """Average an environment over larger texels; one that is as small already is given back.

    Parameters
    ----------
    environment : Environment
        To reduce.
    face_size : int
        A power of two.
    """
    if environment.face_size <= face_size:
        return environment
    faces = np.ascontiguousarray(resample_faces(environment.faces, face_size))
    return _core.Environment.from_faces(faces, environment.exposure, environment.rotation)


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

"""What a picture should look like: sums over every texel of reduced maps, put right where those fail.

Reducing the maps blurs the light by a texel; the change grows with the square of the texel, so two sizes
give what neither would (Richardson): t = t_F + (t_F - t_{F/2})/3. Along the rim of an object a lobe is
narrower than a texel in one direction however small the texels, and a sum over them is off by any factor:
there the two sizes disagree, and a dense sampler of the lobe stands in.
"""

import math

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.advice.reduced_maps import LEAST_ROUGHNESS, largest_face_size, reduced_maps
from burnish.frame import FloatArray, Frame
from burnish.lobes import width_of
from burnish.rendering import Filter, draw
from burnish.samplers import sampler_from_text

DENSE = "importance:1024:fibonacci"
RIM_TEXELS = 1.3
"""Roughness times the view's cosine in texels of the finer map, below which a lobe may slip through: its
deviation across is then .9 texels, that in the coarser map half of it, where sums begin to alias."""

DISAGREEMENT = 0.03
"""Relative difference of the two sizes beyond which a pixel of the rim is not resolved."""


def draw_truth(
    scene: _core.Scene,
    camera: _core.Camera | None,
    size: tuple[int, int],
    filter: Filter,
    device: _core.Device,
    face_size: int,
    dense: Frame,
) -> Frame:
    """Draw a picture by sums over every texel.

    While it does, the scene holds reduced maps: no other thread may use it then.

    Parameters
    ----------
    scene, camera, size, filter, device
        As for `burnish.render`.
    face_size : int
        Texels along a face of the finer of the two reduced maps. Where the scene's own are no finer, they are
        summed as they are, and nothing is extrapolated.
    dense : Frame
        The same picture by `DENSE`.

    Returns
    -------
    frame : Frame
    """
    quadrature = _core.Reference(method="quadrature")
    with reduced_maps(scene, face_size):
        fine = draw(scene, camera, size, quadrature, device, 1, filter)
    is_exact = face_size >= largest_face_size(scene)
    if not is_exact:
        with reduced_maps(scene, face_size // 2):
            coarse = draw(scene, camera, size, quadrature, device, 1, filter)
    slopes = [min(width_of(lobe)) for material in scene.materials for lobe in material.lobes]
    finest = min(face_size, largest_face_size(scene))
    largest_cosine = RIM_TEXELS / (finest * max(min(slopes, default=1.0), LEAST_ROUGHNESS))
    is_rim = view_cosines(fine.normal, camera or scene.default_camera()) < largest_cosine
    other = None if is_exact else coarse.color
    color = extrapolate(fine.color, other, dense.color, is_rim)
    surface = (lambda: fine.depth, lambda: fine.normal, fine.report)
    return Frame(color, fine.alpha, *surface, camera=fine.camera, position=lambda: fine.position)


def view_cosines(normal: FloatArray, camera: _core.Camera) -> NDArray[np.float64]:
    """Cosine between normal and view in every pixel, 0 where there is no object.

    Parameters
    ----------
    normal : (h, w, 3) float32
        World frame.
    camera : Camera
        That sees them.

    Returns
    -------
    cosines : (h, w) float64
    """
    height, width = normal.shape[:2]
    world_from_camera = camera.world_from_camera[:3, :3].astype(np.float64)
    toward_eye = np.zeros((height, width, 3))
    toward_eye[..., 2] = 1.0
    if not camera.is_orthographic:
        half = math.tan(0.5 * camera.vertical_fov)
        toward_eye[..., 0] = -half * ((2.0 * np.arange(width) + 1.0 - width) / height)[None, :]
        toward_eye[..., 1] = half * ((2.0 * np.arange(height) + 1.0) / height - 1.0)[:, None]
        toward_eye /= np.linalg.norm(toward_eye, axis=-1, keepdims=True)
    return np.asarray(np.abs(np.sum(normal * (toward_eye @ world_from_camera.T), axis=-1)))


def extrapolate(
    fine: FloatArray, coarse: FloatArray | None, dense: FloatArray, is_rim: NDArray[np.bool_]
) -> FloatArray:
    """Put the three pictures together.

    Parameters
    ----------
    fine, coarse, dense : (..., 3) float32
        Linear radiance: by the finer maps, by those of half the size, and by the dense sampler. Without
        coarse ones the fine are exact, but for the rim.
    is_rim : (...) bool
        Where the dense sampler may stand in.

    Returns
    -------
    color : (..., 3) float32
    """
    difference = np.linalg.norm(fine - (dense if coarse is None else coarse), axis=-1, keepdims=True)
    is_off = difference > DISAGREEMENT * np.linalg.norm(fine, axis=-1, keepdims=True)
    extrapolated = fine if coarse is None else np.maximum(fine + (fine - coarse) / 3.0, 0.0)
    return np.asarray(np.where(is_off & is_rim[..., None], dense, extrapolated), np.float32)


def draw_dense(
    scene: _core.Scene,
    camera: _core.Camera | None,
    size: tuple[int, int],
    filter: Filter,
    device: _core.Device,
) -> Frame:
    """Draw a picture by the dense sampler.

    Parameters
    ----------
    scene, camera, size, filter, device
        As for `burnish.render`.
    """
    return draw(scene, camera, size, sampler_from_text(DENSE), device, 1, filter)

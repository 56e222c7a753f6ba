"""Steps between neighbouring pixels of smooth pictures, which tell candidates of equal error apart.

Where samples of a wide lobe turn or move from one view to the next, a picture of a sphere shows it around
the normal, as rings or as a pinwheel. Steps are compared with those of the truth.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import PaddedCube, pad_cube, sample_cube, texel_directions
from burnish.oracle.estimator import LocalFrame, local_frame
from burnish.oracle.kurt_lobe import KurtLobe, slopes
from burnish.oracle.matched import matched_lookups
from burnish.oracle.matched_table import Mixture
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.spherical_pyramid import build_spherical_pyramid

Float64 = NDArray[np.float64]

#: Lobes that steps are looked for in.
LOBES = (KurtLobe(0.9), KurtLobe((0.8, 0.6)))
#: Steps of so many times the truth's are not counted.
ALLOWED = 1.25
_FACE_SIZE = 32
_MAPS = 9
# A picture of a sphere 540 pixels high, in units of its radius, out to 20 degrees.
_PIXEL = 1 / 250
_REACH = 0.34
# Samples of round lobes turn with the plane of view, which has no direction along the normal: there, some
# pixels wide, they are not compared.
_LEAST_SINE = 0.03


@dataclass(frozen=True)
class StepTraining:
    """Lines of pixels of a sphere under smooth maps, one channel each."""

    cube: PaddedCube
    starts: NDArray[np.int64]  # of lines among the points
    sine: Float64
    frames: list[LocalFrame]  # of each of LOBES
    albedos: list[Float64]
    truths: list[Float64]  # (points, channels)


def _lines() -> list[Float64]:
    """Places on the picture, (n, 2) each: lines in three directions, through the middle and beside it."""
    along = np.arange(-_REACH, _REACH, _PIXEL)
    lines = []
    for angle in np.radians([7, 45, 116]):
        cosine, sine = np.cos(angle), np.sin(angle)
        for shift in (_PIXEL / 2, 0.04, 0.08, 0.12, 0.25):
            line = np.stack([along * cosine - shift * sine, along * sine + shift * cosine], axis=-1)
            lines.append(line[np.linalg.norm(line, axis=-1) < _REACH])
    return lines


def _waves(seed: int) -> Float64:
    """Smooth maps (6, N, N, channels)."""
    rng = np.random.default_rng([seed, 77])
    directions = texel_directions(_FACE_SIZE)
    faces = np.ones((*directions.shape[:-1], _MAPS))
    for k in range(_MAPS):
        for frequency in (1.0, 2.0, 3.0):
            phase = directions @ normalize(rng.normal(size=3)) * np.pi * frequency
            faces[..., k] += 0.4 / (1 + frequency) * np.sin(phase + rng.uniform(0, 2 * np.pi))
    return faces


def make_step_training(seed: int, prefilter: Mixture) -> StepTraining:
    """Make maps, points and their truth; `prefilter` makes the spherical pyramid."""
    lines = _lines()
    places = np.concatenate(lines)
    normals = np.concatenate([places, np.sqrt(1 - np.sum(places**2, axis=-1, keepdims=True))], axis=-1)
    tangents = normalize(np.cross([0.0, 1.0, 0.0], normals))
    views = np.broadcast_to([0.0, 0.0, 1.0], normals.shape)
    faces = _waves(seed)
    frames = [local_frame(normals, tangents, views, lobe.rotation) for lobe in LOBES]
    albedos = []
    for frame, lobe in zip(frames, LOBES, strict=True):
        parts = directional_albedo(frame.omega_o, slopes(lobe), lobe.alpha)
        albedos.append(blend_albedo(parts, lobe.r0)[..., :1])
    return StepTraining(
        pad_cube(build_spherical_pyramid(build_pyramid(faces), prefilter)),
        np.cumsum([0, *map(len, lines)])[:-1],
        np.linalg.norm(places, axis=-1),
        frames,
        albedos,
        [_truth(faces, normals, tangents, views, lobe) for lobe in LOBES],
    )


def _truth(faces: Float64, n: Float64, t: Float64, o: Float64, lobe: KurtLobe) -> Float64:
    parts = np.split(faces, _MAPS // 3, axis=-1)
    return np.concatenate([shade_reference(part, n, t, o, lobe) for part in parts], axis=-1)


def _largest(training: StepTraining, radiance: Float64) -> Float64:
    """Largest step under each map."""
    change = np.abs(np.diff(radiance, axis=0))
    change[training.starts[1:] - 1] = 0  # from one line to the next
    largest: Float64 = np.max(change[0.5 * (training.sine[1:] + training.sine[:-1]) >= _LEAST_SINE], axis=0)
    return largest


def excess_steps(training: StepTraining, samples: int, rows: Float64) -> float:
    """Mean over lobes and maps of what the largest step exceeds ALLOWED times the truth's by."""
    excess = []
    for lobe, frame, albedo, truth in zip(
        LOBES, training.frames, training.albedos, training.truths, strict=True
    ):
        lookups = matched_lookups(frame, lobe, samples, rows, training.cube.face_texels)
        light = sample_cube(training.cube, lookups.direction, lookups.level)
        weight = lookups.weight[..., :1]
        shaded = np.sum(weight * light, axis=-2) / np.sum(weight, axis=-2) * albedo
        ratio = _largest(training, shaded) / _largest(training, truth)
        excess.append(np.maximum(ratio - ALLOWED, 0.0))
    return float(np.mean(excess))

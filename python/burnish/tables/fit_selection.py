"""Measured error of candidate mixtures on training environments: it chooses among minima of equal loss."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import PaddedCube, cube_stretch, pad_cube, sample_cube, texel_directions
from burnish.oracle.estimator import LocalFrame, local_frame
from burnish.oracle.frame import frame_from_tangent
from burnish.oracle.lobe.kurt import KurtLobe
from burnish.oracle.matched import matched_lookups
from burnish.oracle.matched_table import Mixture
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.spherical_pyramid import build_spherical_pyramid

Float64 = NDArray[np.float64]

#: Edge of the training maps in texels.
FACE_SIZE = 256
#: Lobes of the training points, and bands of the view's cosine: a cell of each pair counts alike. Averages
#: over a sphere would hide grazing views of brushed lobes.
ROUGHNESSES = (
    (0.05, 0.05),
    (0.1, 0.1),
    (0.3, 0.3),
    (0.6, 0.6),
    (0.2, 0.075),
    (0.3, 0.06),
    (0.4, 0.03),
    (0.1, 0.02),
)
BANDS = ((0.005, 0.1), (0.1, 0.3), (0.3, 1.0))
# Environments per kind, each one channel, and what the logarithm of a kind's error weighs.
_PER_KIND = 6
KIND_WEIGHTS = {"spots": 1.0, "smooth": 0.15, "suns": 0.5}
# In each band.
_POINTS = 100


@dataclass(frozen=True)
class TrainingPoints:
    """Points of one lobe and their true radiance, (points, channels), as a mean under the lobe.

    The points of a band follow those of the one before.
    """

    lobe: KurtLobe
    frame: LocalFrame
    truth: Float64


@dataclass(frozen=True)
class Training:
    """Environments, one channel each in the order of `KIND_WEIGHTS`, and points under them."""

    cube: PaddedCube
    points: list[TrainingPoints]


def _discs(
    faces: Float64, directions: Float64, sizes: Float64, levels: Float64, rng: np.random.Generator
) -> None:
    # The ramp across an edge is one texel wide: a texel shrinks toward the corners by about r^1.5.
    width = 2 / FACE_SIZE * cube_stretch(directions) ** -1.5
    for diameter, level in zip(sizes, levels, strict=True):
        center = normalize(rng.normal(size=3))
        angle = 2 * np.arcsin(np.clip(0.5 * np.linalg.norm(directions - center, axis=-1), 0, 1))
        cover = np.clip((0.5 * np.radians(diameter) - angle) / width + 0.5, 0, 1)
        np.maximum(faces, faces + cover * (level - faces), out=faces)


def training_environments(seed: int) -> Float64:
    """Grey maps (6, N, N, channels): discs over waves, waves alone, and suns over waves of mean 1."""
    directions = texel_directions(FACE_SIZE)
    channels = []
    for kind in KIND_WEIGHTS:
        for k in range(_PER_KIND):
            rng = np.random.default_rng([seed, k, len(kind)])
            faces = np.zeros(directions.shape[:-1])
            for frequency in (1.0, 2.0, 3.0, 5.0, 8.0):
                wave = directions @ normalize(rng.normal(size=3)) * np.pi * frequency
                faces += 0.9 / (1 + frequency) * np.sin(wave + rng.uniform(0, 2 * np.pi))
            faces = np.exp(faces)
            faces /= np.mean(faces)
            if kind == "spots":
                levels = np.exp(rng.uniform(np.log(30), np.log(3000), 40))
                _discs(faces, directions, rng.uniform(2, 10, 40), levels, rng)
            elif kind == "suns":
                # Several, so that enough points see one.
                _discs(faces, directions, np.full(12, 0.8), np.full(12, 20000.0), rng)
            channels.append(faces)
    return np.stack(channels, axis=-1)


def make_training(seed: int, prefilter: Mixture) -> Training:
    """Make maps, points and their truth, which takes a minute; `prefilter` makes the spherical pyramid."""
    faces = training_environments(seed)
    points = []
    for k, roughness in enumerate(ROUGHNESSES):
        rng = np.random.default_rng([seed, 1000 + k])
        total = _POINTS * len(BANDS)
        n = normalize(rng.normal(size=(total, 3)))
        t, b = frame_from_tangent(n, rng.normal(size=(total, 3)))
        cosine = np.concatenate([rng.uniform(low, high, _POINTS) for low, high in BANDS])
        azimuth = rng.uniform(0, 2 * np.pi, total)
        sine = np.sqrt(1 - cosine**2)
        local = np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=-1)
        o = local[:, :1] * t + local[:, 1:2] * b + local[:, 2:] * n
        lobe = KurtLobe(roughness)
        light = shade_reference(np.concatenate([faces, np.ones_like(faces[..., :1])], axis=-1), n, t, o, lobe)
        points.append(TrainingPoints(lobe, local_frame(n, t, o), light[:, :-1] / light[:, -1:]))
    return Training(pad_cube(build_spherical_pyramid(build_pyramid(faces), prefilter)), points)


def errors(training: Training, samples: int, rows: Float64) -> list[Float64]:
    """Error over the cell's mean truth of one count's rows: per lobe and band (points, channels)."""
    result = []
    for points in training.points:
        lookups = matched_lookups(points.frame, points.lobe, samples, rows, training.cube.face_texels)
        light = sample_cube(training.cube, lookups.direction, lookups.level)
        weight = lookups.weight[..., :1]
        shaded = np.sum(weight * light, axis=-2) / np.sum(weight, axis=-2)
        for part, truth in zip(np.split(shaded, len(BANDS)), np.split(points.truth, len(BANDS)), strict=True):
            result.append((part - truth) / np.mean(truth, axis=0))
    return result


def score(training: Training, samples: int, rows: Float64) -> float:
    """Mean over cells, lobe by band, of the weighted logarithms of errors; the less, the better.

    A kind's error is the mean over its maps of the logarithm of the RMSE, and of the RMSE of errors clipped
    at 4.5 medians: a few points beside bright discs make most of the former and its noise.
    """
    total = 0.0
    weights = np.array(list(KIND_WEIGHTS.values()))
    cells = errors(training, samples, rows)
    for error in cells:
        size = np.abs(error)
        clipped = np.minimum(size, 4.5 * np.median(size, axis=0))
        for values in (size, clipped):
            logarithm = 0.5 * np.log(np.mean(values**2, axis=0))
            total += float(np.mean(logarithm.reshape(len(weights), -1), axis=1) @ weights)
    return total / len(cells)

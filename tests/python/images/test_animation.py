"""No visible jumps: a sphere turning and growing rougher over 90 frames changes as its reference does."""

from collections.abc import Callable

import numpy as np
import pytest

import burnish
from burnish.environments import spots

FRAMES = 90
# Of the largest change of any pixel between two frames, against the reference's.
LIMIT = 1.5


def round_roughness(share):
    return 0.12 + 0.28 * share


def brushed_roughness(share):
    return 0.2 + 0.2 * share, 0.1 + 0.05 * share


def frames(environment, roughness: Callable, sampler, device):
    """Render the animation: colours (frames, h, w, 3), and where the sphere covers whole pixels in all."""
    colors, covered = [], True
    for k in range(FRAMES):
        share = k / (FRAMES - 1)
        lobe = burnish.KurtLobe(roughness=roughness(share))
        scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
        scene.environment, scene.show_background = environment, False
        angle = np.radians(45 * share)
        camera = burnish.Camera.look_at((4 * np.sin(angle), 0.8, 4 * np.cos(angle)), (0, 0, 0))
        frame = burnish.render(scene, camera, (36, 36), sampler, device)
        colors.append(frame.color)
        # The rim is left out: there a pixel's view changes by many degrees from frame to frame.
        covered = covered & (frame.alpha > 0.999) & (frame.depth < 3.9)
    return np.stack(colors), covered


# Samples of the brushed lobe are narrower than a texel of faces of 64: a spot that passes there is a step
# that no sampler of a few texels can hide. The truth is the same light's, from the smaller map for speed.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("roughness", "face_size"),
    [(round_roughness, 64), (brushed_roughness, 128)],
    ids=["round", "brushed"],
)
def test_matched_pictures_change_no_faster_than_the_truth(roughness, face_size, device):
    truth, covered = frames(spots(5, 64), roughness, burnish.Reference(method="quadrature"), device)
    assert covered.sum() > 100
    largest = np.abs(np.diff(truth, axis=0))[:, covered].max()
    environment = spots(5, face_size)
    for samples in (5, 14):
        got, _ = frames(environment, roughness, burnish.Matched(samples), device)
        assert np.abs(np.diff(got, axis=0))[:, covered].max() <= LIMIT * largest

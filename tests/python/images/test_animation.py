"""No visible jumps: a sphere turning and growing rougher over 90 frames changes as its reference does."""

import numpy as np
import pytest

import burnish
from burnish.environments import spots

FRAMES = 90
# Of the largest change of any pixel between two frames, against the reference's.
LIMIT = 1.5


def frames(environment, sampler, device):
    """Render the animation: colours (frames, h, w, 3), and where the sphere covers whole pixels in all."""
    colors, covered = [], True
    for k in range(FRAMES):
        share = k / (FRAMES - 1)
        lobe = burnish.KurtLobe(roughness=0.12 + 0.28 * share)
        scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
        scene.environment, scene.show_background = environment, False
        angle = np.radians(45 * share)
        camera = burnish.Camera.look_at((4 * np.sin(angle), 0.8, 4 * np.cos(angle)), (0, 0, 0))
        frame = burnish.render(scene, camera, (36, 36), sampler, device)
        colors.append(frame.color)
        # The rim is left out: there a pixel's view changes by many degrees from frame to frame.
        covered = covered & (frame.alpha > 0.999) & (frame.depth < 3.9)
    return np.stack(colors), covered


@pytest.mark.slow
def test_matched_pictures_change_no_faster_than_the_truth(device):
    environment = spots(5, 64)
    truth, covered = frames(environment, burnish.Reference(method="quadrature"), device)
    assert covered.sum() > 100
    largest = np.abs(np.diff(truth, axis=0))[:, covered].max()
    for samples in (5, 14):
        got, _ = frames(environment, burnish.Matched(samples), device)
        assert np.abs(np.diff(got, axis=0))[:, covered].max() <= LIMIT * largest

"""No rings: beside each other, pixels of a sphere under smooth light differ as those of its reference do."""

import numpy as np
import pytest

import burnish
from engine_support import smooth_environment_faces, unit

# Of the largest difference of neighbouring pixels, against the reference's.
LIMIT = 1.5
PIXEL = 1 / 250  # of a sphere's radius: 540 pixels high, a picture of one
# Samples of a round lobe turn with the plane of view, which has no direction along the normal.
LEAST_ANGLE_ROUND = 0.03
# Cosines of the view; beyond, along the rim, pixels differ by many degrees.
REGIONS = {"around the normal": (0.94, 1.0), "between": (0.5, 0.94), "toward the horizon": (0.12, 0.5)}
MATERIALS = {
    ".99/.124": burnish.KurtLobe(roughness=(0.99, 0.124)),
    ".99/.124, dielectric": burnish.KurtLobe(roughness=(0.99, 0.124), r0=0.04, alpha=0.25),
    ".7/.09": burnish.KurtLobe(roughness=(0.7, 0.09), rotation=0.6),
    ".3/.1": burnish.KurtLobe(roughness=(0.3, 0.1)),
    ".2/.075": burnish.KurtLobe(roughness=(0.2, 0.075), alpha=0.5),
    "round": burnish.KurtLobe(roughness=0.9),
}


def lines_of_pixels():
    """Lines of places on a sphere's picture, in units of its radius, (n, 2) each: through the middle, close
    by and farther out, in six directions.
    """
    rim = np.sqrt(1 - 0.12**2)
    along = np.arange(-rim, rim, PIXEL)
    lines = []
    for angle in np.radians([0, 17, 45, 90, 116, 153]):
        for shift in (0.0, PIXEL / 2, 3 * PIXEL, 0.08, 0.25, 0.6):
            x, y = along, np.full_like(along, shift)
            turned = np.stack(
                [x * np.cos(angle) - y * np.sin(angle), x * np.sin(angle) + y * np.cos(angle)], -1
            )
            lines.append(turned[np.hypot(x, y) < rim])
    return lines


def points_of(places):
    """Normals, tangents along the parallels of a sphere and views of an orthographic picture."""
    normals = np.concatenate([places, np.sqrt(1 - np.sum(places**2, -1, keepdims=True))], axis=-1)
    tangents = unit(np.cross([0.0, 1.0, 0.0], normals))
    views = np.broadcast_to([0.0, 0.0, 1.0], normals.shape)
    return tuple(np.ascontiguousarray(one, np.float32) for one in (normals, tangents, views))


@pytest.fixture(scope="module")
def light():
    return burnish.Environment.from_faces(smooth_environment_faces(32))


def largest_steps(radiance, lines, least_angle):
    """Of neighbours in a line, in each region, all channels."""
    starts = np.cumsum([0, *map(len, lines)])
    steps = {name: 0.0 for name in REGIONS}
    for line, start in zip(lines, starts, strict=False):
        change = np.abs(np.diff(radiance[start : start + len(line)].astype(np.float64), axis=0)).max(axis=-1)
        sine = np.linalg.norm((line[1:] + line[:-1]) / 2, axis=-1)
        cosine = np.sqrt(1 - sine**2)
        for name, (low, high) in REGIONS.items():
            inside = change[(cosine >= low) & (cosine <= high) & (sine >= least_angle)]
            steps[name] = max(steps[name], inside.max(initial=0.0))
    return steps


@pytest.mark.parametrize("name", MATERIALS)
def test_neighbouring_pixels_differ_no_more_than_the_reference_s(device, light, name):
    lines = lines_of_pixels()
    points = points_of(np.concatenate(lines))
    material = burnish.Material(lobes=[MATERIALS[name]])
    truth = burnish.shade(light, material, burnish.Reference(method="quadrature"), *points, device=device)
    least_angle = LEAST_ANGLE_ROUND if np.ptp(MATERIALS[name].roughness) == 0 else 0.0
    wanted = largest_steps(truth, lines, least_angle)
    found = {}
    for samples in (5, 14, 64):
        got = burnish.shade(light, material, burnish.Matched(samples), *points, device=device)
        steps = largest_steps(got, lines, least_angle)
        found |= {(samples, region): steps[region] / wanted[region] for region in REGIONS}
    assert max(found.values()) <= LIMIT, found

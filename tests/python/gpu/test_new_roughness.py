"""Pipelines of patterns serve every roughness: a new one is drawn without compiling anything."""

import numpy as np
import pytest

import burnish
from burnish.environments import spots
from engine_support import random_points

SIZE = (24, 32)


def material(roughness, **fields):
    return burnish.Material(lobes=[burnish.KurtLobe(roughness=roughness, **fields)])


def draw(device, *materials, sampler):
    scene = burnish.Scene.spheres(list(materials), columns=len(materials))
    scene.environment = spots(face_size=32)
    return burnish.render(scene, size=SIZE, sampler=sampler, device=device)


SAMPLERS = [
    burnish.Regular(samples=14),
    burnish.Regular(samples=20, footprint="published", normalization="published"),
    burnish.Importance(samples=20),
]


@pytest.fixture
def fresh(device):
    """A device without pipelines."""
    return burnish.Device(name=device.name, lookup=device.lookup)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=str)
def test_a_new_roughness_compiles_nothing(fresh, sampler):
    assert draw(fresh, material(0.2), sampler=sampler).report.compile_ms > 0
    count = fresh.pipeline_count
    for roughness in (0.05, 0.21, 0.6):
        assert draw(fresh, material(roughness), sampler=sampler).report.compile_ms == 0
    assert fresh.pipeline_count == count


def test_points_of_a_new_roughness_compile_nothing(fresh, rng):
    points = random_points(rng, 100)

    def shade(roughness):
        arguments = (spots(face_size=32), material(roughness), burnish.Regular(), *points)
        return burnish.shade(*arguments, device=fresh, report=True)[1]

    assert shade(0.2).compile_ms > 0
    assert shade(0.3).compile_ms == 0


def test_brushed_lobes_compile_once_for_each_count(fresh):
    """Their patterns have some samples more or less with each roughness."""
    frames = [
        draw(fresh, material((float(m), 0.1)), sampler=burnish.Regular()) for m in np.linspace(0.15, 0.6, 20)
    ]
    counts = {frame.report.samples_used for frame in frames}
    assert {"14", "15", "16"} <= counts
    assert sum(frame.report.compile_ms > 0 for frame in frames) <= len(counts)


def test_lobes_of_different_counts_look_as_they_do_alone(fresh):
    """Beside a longer table a shorter one is read on, with samples of weight zero."""
    brushed = [material((m, 0.1), r0=0.5, alpha=0.5) for m in (0.2, 0.4, 0.6)]
    together = draw(fresh, *brushed, sampler=burnish.Regular())
    assert len(together.report.classes) == 1 and " or " in together.report.samples_used
    labels = draw(fresh, *[burnish.Material(emissive=k + 1.0) for k in range(3)], sampler=burnish.Regular())
    for k, one in enumerate(brushed):
        alone = draw(fresh, one, one, one, sampler=burnish.Regular())
        shown = (labels.alpha > 0) & (labels.color[..., 0] == k + 1)
        assert shown.sum() > 10
        np.testing.assert_allclose(together.color[shown], alone.color[shown], rtol=1e-5)


def test_what_earlier_versions_chose_is_taken_and_changes_nothing(device):
    assert device.compile == "shared"
    wanted = draw(device, material(0.2), sampler=burnish.Regular()).color
    for name in ("wait", "background", "shared"):
        with pytest.warns(DeprecationWarning, match="compile has no effect: pipelines do not depend"):
            other = burnish.Device(name=device.name, lookup=device.lookup, compile=name)
        np.testing.assert_array_equal(draw(other, material(0.2), sampler=burnish.Regular()).color, wanted)
        other.finish_compiling()
    with pytest.raises(ValueError, match="compile: expected wait, background or shared, got 'later'"):
        burnish.Device(name=device.name, compile="later")

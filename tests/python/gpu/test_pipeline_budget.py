"""What a device keeps for later pictures is bounded: pipelines by a budget, the longest unused first."""

import gc

import numpy as np
import pytest

import burnish
from burnish import builtin, environments
from burnish.study import accuracy

SMALL = {"size": (8, 8)}


def resident_mb():
    with open("/proc/self/status") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmRSS")) / 1024


def sphere(roughness, environment, **lobe):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=roughness, **lobe)]))
    scene.environment = environment
    return scene


def draw(device, samples, environment):
    """A picture whose shade pipeline is that of the count alone."""
    sampler = burnish.Importance(samples)
    return burnish.render(sphere(0.1, environment), sampler=sampler, device=device, **SMALL)


def test_pictures_of_ever_new_counts_keep_the_count_at_the_budget(uniform):
    device = burnish.Device(pipeline_budget=8)
    assert device.pipeline_budget == 8 and device.pipeline_count == 0
    for k in range(8):
        draw(device, 1 + k, uniform)
        assert device.pipeline_count <= 8 + 1, "and what the last picture added"
    assert device.pipeline_count >= 8
    device.pipeline_budget = 10
    for k in range(5):
        draw(device, 20 + k, uniform)
    assert 10 <= device.pipeline_count <= 10 + 1


def test_those_used_last_stay(uniform):
    device = burnish.Device(pipeline_budget=8)
    draw(device, 1, uniform)
    for k in range(6):
        draw(device, 2 + k, uniform)
        assert draw(device, 1, uniform).report.compile_ms == 0, "drawn in turns: never given back"
    assert draw(device, 2, uniform).report.compile_ms > 0, "not drawn for long: made again"


def test_a_picture_keeps_all_it_uses_whatever_the_budget(uniform):
    device = burnish.Device(pipeline_budget=1)
    lobes = [burnish.KurtLobe(r0=r0, alpha=alpha) for r0 in (1.0, 0.5) for alpha in (0.0, 0.5)]
    scene = burnish.Scene.spheres([burnish.Material(lobes=[one]) for one in lobes], columns=2)
    scene.environment = uniform
    sampler = burnish.Regular(2)
    first = burnish.render(scene, sampler=sampler, device=device, **SMALL)
    assert len(first.report.classes) == 4
    again = burnish.render(scene, sampler=sampler, device=device, **SMALL)
    assert again.report.compile_ms == 0
    np.testing.assert_array_equal(first.color, again.color)
    draw(device, 7, uniform)
    draw(device, 7, uniform)
    assert device.pipeline_count < 8


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"pipeline_budget": 0}, "pipeline_budget: expected 1 or more pipelines, got 0"),
        ({"pipeline_budget": -3}, "pipeline_budget: expected 1 or more pipelines, got -3"),
    ],
)
def test_budgets_that_mean_nothing_are_refused(settings, message):
    with pytest.raises(ValueError, match=message):
        burnish.Device(**settings)


def test_budget_comes_from_the_environment(monkeypatch):
    monkeypatch.setenv("BURNISH_PIPELINES", "11")
    assert burnish.Device().pipeline_budget == 11
    assert burnish.Device(pipeline_budget=3).pipeline_budget == 3
    monkeypatch.setenv("BURNISH_PIPELINES", "many")
    with pytest.raises(ValueError, match="BURNISH_PIPELINES: expected a number of pipelines, 1 or more"):
        burnish.Device()


def test_a_study_keeps_the_pipelines_of_all_its_samplers(uniform):
    device = burnish.Device(pipeline_budget=1)
    study = accuracy(
        sphere(0.3, uniform),
        ["regular:2", "importance:2", "prefiltered"],
        reference="reference:0.1",
        size=(8, 8),
        repeats=3,
        device=device,
    )
    assert len(study.rows) == 3 and device.pipeline_budget == 1
    assert device.pipeline_count > 4


@pytest.mark.slow
def test_memory_stays_flat_over_pictures_of_changing_materials(uniform):
    """Roughness, Fresnel, sampler, map and size change with every picture."""
    device = burnish.Device(pipeline_budget=10, validation=False)
    samplers = [burnish.Regular(2), burnish.Matched(2), burnish.Prefiltered(), burnish.Importance(2)]
    resident = []
    for k in range(160):
        light = environments.uniform(1.0, face_size=2 << (k % 5))
        scene = sphere(0.1 + 0.001 * k, light, r0=0.5 if k % 3 else 1.0, alpha=0.001 * (k % 500))
        burnish.render(scene, size=(8 + k % 7, 8), sampler=samplers[k % 4], device=device)
        if k in (79, 159):
            gc.collect()
            resident.append(resident_mb())
    assert resident[1] - resident[0] < 30, f"{resident} MB after 80 and 160 pictures"


@pytest.mark.slow
def test_maps_of_living_environments_are_given_back(device):
    """They stay on the device as long as they are few: 1 GiB."""
    scene = builtin.make_scene("sphere")
    kept = [environments.uniform(1.0, face_size=512) for _ in range(70)]
    reserved = []
    for light in kept:
        scene.environment = light
        burnish.render(scene, size=(8, 8), sampler=burnish.Prefiltered(), device=device)
        reserved.append(device.memory_statistics()["bytes_used"])
    assert max(reserved) < 1.3 * 2**30

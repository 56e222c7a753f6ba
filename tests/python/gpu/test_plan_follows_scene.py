"""Only what the scene calls for runs: each effect is off with a reason, or on where something asks."""

import itertools

import numpy as np
import pytest

import burnish
from burnish.rendering import plan as plan_of

LOBE = burnish.KurtLobe(roughness=0.2)


def material(*lobes, **rest):
    return burnish.Material(lobes=list(lobes), **rest)


def scene_of(*materials, environment=None):
    scene = burnish.Scene.spheres(list(materials), columns=max(1, len(materials)))
    scene.environment = environment
    return scene


def effects(plan):
    return {line["name"]: line for line in plan["effects"]}


def is_on(plan, name):
    line = effects(plan)[name]
    assert line["reason"], f"{name} gives no reason"
    return line["on"]


ASKING = {
    "lobe": (material(LOBE), material(diffuse=1.0)),
    "lobe 2": (material(LOBE, LOBE), material(LOBE)),
    "lobe 3": (material(LOBE, LOBE, LOBE), material(LOBE, LOBE)),
    "lobe 4": (material(*[LOBE] * 4), material(LOBE, LOBE, LOBE)),
    "fresnel": (material(burnish.KurtLobe(r0=(1, 1, 0.9))), material(LOBE)),
    "alpha": (material(burnish.KurtLobe(alpha=0.3)), material(LOBE)),
    "anisotropy": (material(burnish.KurtLobe(roughness=(0.2, 0.1))), material(LOBE)),
    "diffuse": (material(LOBE, diffuse=(0, 0, 0.1)), material(LOBE)),
    "emissive": (material(LOBE, emissive=(0, 1, 0)), material(LOBE)),
}


@pytest.mark.parametrize("name", ASKING)
def test_effect_is_on_only_where_a_material_asks_for_it(name, spots64):
    asking, silent = ASKING[name]
    assert is_on(plan_of(scene_of(asking, environment=spots64)), name)
    assert is_on(plan_of(scene_of(silent, asking, environment=spots64)), name)
    assert not is_on(plan_of(scene_of(silent, environment=spots64)), name)


def test_effect_of_a_material_that_no_object_shows_is_off(spots64):
    scene = scene_of(material(LOBE), material(LOBE, emissive=1.0), environment=spots64)
    assert is_on(plan_of(scene), "emissive")
    scene.objects[1].material = 0
    assert not is_on(plan_of(scene), "emissive")


def test_every_effect_has_a_reason_and_one_line(spots64):
    lines = plan_of(scene_of(material(LOBE), environment=spots64))["effects"]
    names = [line["name"] for line in lines]
    assert len(names) == len(set(names)) > 15
    assert all(line["reason"] for line in lines)


def passes(plan):
    return [line["name"] for line in plan["passes"]]


def test_accumulation_is_added_by_spp(spots64):
    scene = scene_of(material(LOBE), environment=spots64)
    assert not is_on(plan_of(scene), "accumulation")
    assert "accumulate" not in passes(plan_of(scene))
    assert is_on(plan_of(scene, spp=4), "accumulation")
    assert "accumulate" in passes(plan_of(scene, spp=4))


def test_pyramid_is_built_only_for_lookups_of_lobes(spots64):
    assert "pyramid" in passes(plan_of(scene_of(material(LOBE), environment=spots64)))
    assert "pyramid" not in passes(plan_of(scene_of(material(diffuse=1.0), environment=spots64)))
    plan = plan_of(scene_of(material(LOBE), environment=spots64), burnish.Reference())
    assert "pyramid" not in passes(plan)


def test_background_is_off_without_environment_or_when_hidden(spots64):
    scene = scene_of(material(LOBE), environment=spots64)
    assert is_on(plan_of(scene), "background") and "background" in passes(plan_of(scene))
    scene.show_background = False
    assert not is_on(plan_of(scene), "background") and "background" not in passes(plan_of(scene))
    dark = plan_of(scene_of(material(LOBE)))
    assert not is_on(dark, "background")
    assert any("no environment" in warning for warning in dark["warnings"])


def test_turned_environment_is_an_effect():
    plain = burnish.environments.uniform()
    turned = burnish.Environment.from_faces(plain.faces, rotation=np.diag([-1.0, 1.0, -1.0]))
    assert not is_on(plan_of(scene_of(material(LOBE), environment=plain)), "map rotation")
    assert is_on(plan_of(scene_of(material(LOBE), environment=turned)), "map rotation")


def test_materials_of_equal_needs_share_a_pipeline(spots64):
    red, blue = burnish.KurtLobe(weight=(1, 0, 0)), burnish.KurtLobe(weight=(0, 0, 1))
    assert len(plan_of(scene_of(material(red), material(blue), environment=spots64))["classes"]) == 1
    other = material(blue, diffuse=0.5)
    assert len(plan_of(scene_of(material(red), other, environment=spots64))["classes"]) == 2


@pytest.fixture(scope="module")
def many_materials():
    """98 metals and lacquers, as the glTF scene of 98 spheres has them: every roughness its own."""
    roughness = np.linspace(0.02, 1.0, 49)
    metals = [material(burnish.KurtLobe(roughness=float(m), r0=0.9, alpha=0.5)) for m in roughness]
    lacquers = [
        material(burnish.KurtLobe(roughness=float(m), r0=0.04, alpha=0.5), diffuse=0.5) for m in roughness
    ]
    return burnish.Scene.spheres(metals + lacquers, 14)


def test_many_materials_read_their_samples_from_a_buffer(device, many_materials, smooth64):
    many_materials.environment = smooth64
    sampler = burnish.Regular()
    plan = plan_of(many_materials, sampler)
    assert {one["table"] for one in plan["classes"]} == {"buffer"} and len(plan["classes"]) <= 2
    frame = burnish.render(many_materials, size=(64, 128), sampler=sampler, device=device)
    assert {one["table"] for one in frame.report.classes} == {"buffer"}
    assert frame.report.non_finite == 0
    # One sphere alone looks the same.
    alone = scene_of(many_materials.materials[20], environment=smooth64)
    matrix = many_materials.objects[20].world_from_object
    alone.objects[0].world_from_object = matrix
    single = burnish.render(alone, many_materials.default_camera(), (64, 128), sampler, device)
    both = (single.alpha > 0) & np.isclose(single.depth, frame.depth)
    assert both.sum() > 10
    np.testing.assert_allclose(frame.color[both], single.color[both], rtol=1e-4)


def test_several_lobes_are_read_in_a_loop_only_where_they_are_many(spots64):
    scene = scene_of(material(LOBE, LOBE), environment=spots64)
    few, many = (plan_of(scene, burnish.Regular(count))["classes"][0] for count in (40, 41))
    assert few["table"] == many["table"] == "buffer"
    assert "in a loop" not in few["reason"] and "in a loop" in many["reason"]


def test_too_many_kinds_of_material_share_pipelines(spots64):
    kinds = itertools.product((0.0, 0.5, 0.3), (1.0, 0.5), (0.2, (0.2, 0.1)), (0.0, 0.5), (0.0, 1.0))
    others = [
        material(burnish.KurtLobe(roughness=m, r0=r0, alpha=alpha), LOBE, diffuse=diffuse, emissive=emissive)
        for alpha, r0, m, diffuse, emissive in kinds
    ]
    scene = scene_of(material(LOBE), *others, environment=spots64)
    classes = plan_of(scene, burnish.Regular())["classes"]
    assert {one["table"] for one in classes} == {"buffer"} and len(classes) == 2


def by_name(effects):
    """All but why maps are read as they are: a device may have been asked for it, a plan is not."""
    return {one["name"]: one for one in effects if one["name"] != "software lookup"}


def test_frame_reports_what_the_plan_said(device):
    # No earlier frame has made anything of this map.
    own = burnish.environments.uniform(face_size=16)
    scene = scene_of(material(LOBE, diffuse=0.2), material(LOBE, emissive=2.0), environment=own)
    plan = plan_of(scene, spp=2, is_software=device.lookup == "software")
    report = burnish.render(scene, size=(24, 32), spp=2, device=device).report
    planned, reported = by_name(plan["effects"]), by_name(report.effects)
    # How good the light on diffuse surfaces is, is known when it is made.
    said, then = planned.pop("diffuse"), reported.pop("diffuse")
    assert reported == planned
    assert then["on"] and then["reason"].startswith(said["reason"] + ", ")
    assert [one["effects"] for one in report.classes] == [one["effects"] for one in plan["classes"]]
    ran = {entry["name"] for entry in report.passes}
    assert set(passes(plan)) <= ran, f"planned {passes(plan)}, ran {sorted(ran)}"
    assert all(entry["milliseconds"] >= 0 for entry in report.passes)
    assert report.size == (24, 32) and report.spp == 2


def test_frame_runs_no_pass_that_was_not_planned(device):
    """Also on an environment that no earlier frame has brought to the device."""
    cases = [
        (material(diffuse=1.0), burnish.Regular()),
        (material(emissive=1.0), burnish.Regular()),
        (material(LOBE), burnish.Reference(0.05)),
        (material(LOBE), burnish.Regular()),
    ]
    environment = burnish.environments.uniform(face_size=4)
    for shown, sampler in cases:
        scene = scene_of(shown, environment=environment)
        planned = set(passes(plan_of(scene, sampler, is_software=device.lookup == "software")))
        report = burnish.render(scene, size=(16, 16), sampler=sampler, device=device).report
        assert {entry["name"] for entry in report.passes} <= planned | {"upload"}
    # The last case needs levels that the ones before it did without.
    assert "pyramid" in {entry["name"] for entry in report.passes}


def test_plan_renders_nothing(monkeypatch, spots64):
    """Explaining needs no device: none is opened."""
    monkeypatch.setattr(burnish._core, "render", None)
    monkeypatch.setattr(burnish._core, "Device", None)
    assert plan_of(scene_of(material(LOBE), environment=spots64))["passes"]


def table_of(*materials, sampler, environment):
    (one,) = plan_of(scene_of(*materials, environment=environment), sampler=sampler)["classes"]
    return one["table"], one["reason"]


def brushed(x, y):
    return material(burnish.KurtLobe(roughness=(x, y)))


def test_samples_are_placed_by_view_where_a_table_can_hold_them(spots64):
    matched = burnish.Matched(14)
    for one in (material(LOBE), brushed(0.2, 0.0125), brushed(0.025, 0.4)):
        assert table_of(one, sampler=matched, environment=spots64)[0] == "matched by view"
    table, reason = table_of(brushed(0.2, 0.0124), sampler=matched, environment=spots64)
    assert table == "matched" and "so brushed" in reason
    many = [brushed(0.2, 0.1 + 0.001 * k) for k in range(40)]
    assert table_of(*many[:30], sampler=matched, environment=spots64)[0] == "matched by view"
    table, reason = table_of(*many, sampler=matched, environment=spots64)
    assert table == "matched" and "memory" in reason


def test_both_placements_of_brushed_samples_agree(device, spots64):
    """As many lobes as tables cannot hold: their samples are placed at every point."""
    few = [brushed(0.25, 0.1)]
    many = few + [brushed(0.2, 0.1 + 0.001 * k) for k in range(40)]
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=0.9, near_plane=0.1, far_plane=10)
    colors = []
    for materials in (few, many):
        scene = burnish.Scene()
        sphere = burnish.Mesh.sphere(segments=64)
        scene.add(sphere, materials[0])
        for one in materials[1:]:
            scene.add(sphere, one, transform=np.diag([1e-3, 1e-3, 1e-3, 1.0]))  # inside the first
        scene.environment = spots64
        scene.show_background = False
        frame = burnish.render(scene, camera, (96, 96), sampler=burnish.Matched(14), device=device)
        colors.append(np.array(frame.color))
    difference = np.sqrt(np.mean((colors[0] - colors[1]) ** 2)) / np.sqrt(np.mean(colors[1] ** 2))
    # By view they lie over what is reflected of the lobe, at a point over the lobe: both err more than this.
    assert 1e-4 < difference < 0.04


def test_points_get_a_report_as_pictures_do(device):
    lobe = burnish.KurtLobe((0.3, 0.1), r0=0.5, alpha=0.5)
    up, right = (np.tile(np.float32(axis), (5, 1)) for axis in ((0, 0, 1), (1, 0, 0)))
    light = burnish.environments.uniform(face_size=4)
    points = (light, burnish.Material(lobes=[lobe], emissive=1.0), burnish.Regular(14), up, right, up)
    radiance, report = burnish.shade(*points, device=device, report=True)
    np.testing.assert_array_equal(radiance, burnish.shade(*points, device=device))
    values = report.classes[0]["values"]
    assert (values["lobe"], values["fresnel"], values["alpha"], values["emissive"]) == (1, 1, 1, 1)
    assert values["diffuse"] == values["sun split"] == 0
    assert report.points == 5 and str(report).startswith("5 points, regular:14")
    assert report.samples_used and any(one["name"] == "shade 0" for one in report.passes)


def test_points_that_are_none_get_a_report(device):
    none = np.zeros((0, 3), np.float32)
    light = burnish.environments.uniform(face_size=4)
    radiance, report = burnish.shade(
        light, burnish.Material(), burnish.Regular(), none, none, none, device=device, report=True
    )
    assert radiance.shape == (0, 3) and report.passes == []

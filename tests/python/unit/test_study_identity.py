"""Names and digests of materials, environments and cells."""

import dataclasses
import os

import numpy as np
import pytest

import burnish
from burnish import environments
from burnish.study.identity import describe_material, digest, environment_label, make_material, material_label
from burnish.study.measure import Cell
from burnish.study.sources import EnvironmentSource, SceneSource, require_scene_name
from burnish.study.sweep import make_cells

LOBE = {"roughness": (0.2, 0.075), "r0": (1.0, 0.5, 0.25), "alpha": 0.5, "weight": 2.0, "rotation": 0.25}


def test_materials_are_made_again_from_their_description():
    material = burnish.Material(
        diffuse=(0.5, 0.25, 0.125),
        lobes=[
            burnish.KurtLobe(**LOBE),
            burnish.KurtLobe(0.5, conserve_energy=True),
            burnish.GgxLobe((0.5, 0.25), r0=0.25, f90=0.5),
        ],
        emissive=(0.0, 1.0, 0.0),
        name="lacquer",
        double_sided=True,
    )
    description = describe_material(material)
    assert describe_material(make_material(description)) == description
    assert description["lobes"][0]["alpha"] == 0.5 and description["double_sided"] is True


@pytest.mark.parametrize(
    ("material", "label"),
    [
        ({"lobes": [burnish.KurtLobe(0.05)]}, "m 0.05"),
        ({"lobes": [burnish.KurtLobe((0.2, 0.075))]}, "m 0.2/0.075"),
        (
            {"lobes": [burnish.KurtLobe(0.1, r0=0.04, alpha=0.5)], "diffuse": 0.5},
            "diffuse + m 0.1, r0 0.04, alpha 0.5",
        ),
        ({"lobes": [burnish.GgxLobe((0.4, 0.1), r0=0.04)]}, "ggx 0.4/0.1, r0 0.04"),
        ({"lobes": [burnish.KurtLobe(0.1)], "name": "brass"}, "brass"),
        ({}, "black"),
    ],
)
def test_materials_are_labelled_by_what_matters(material, label):
    assert material_label(burnish.Material(**material)) == label


def test_digests_tell_values_shapes_and_nesting_apart():
    values = [
        [1, 2],
        [[1], 2],
        [12],
        ["1", 2],
        [np.zeros(4)],
        [np.zeros((2, 2))],
        [np.zeros(4, np.float32)],
        [{"a": 1}],
        [{"a": 2}],
        [None],
        [],
    ]
    assert len({digest(*value) for value in values}) == len(values)
    assert digest({"a": 1, "b": 2}) == digest({"b": 2, "a": 1})


def test_environments_are_read_from_text():
    source = EnvironmentSource.from_text("spots:seed=2:face_size=16", face_size=64)
    environment = source.open()
    assert environment.face_size == 16
    np.testing.assert_array_equal(environment.faces, environments.spots(2, 16).faces)
    assert source.open() is environment
    assert EnvironmentSource.from_text("studio", 8).open().face_size == 8
    turned = EnvironmentSource.from_text("studio", 8, rotation_degrees=90.0)
    assert turned.state() != EnvironmentSource.from_text("studio", 8).state()
    assert environment_label(environment) == "spots, seed 2 (16)"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("fog", "environment: expected a file or one of studio, sky, spots, uniform, got 'fog'"),
        ("spots:2", "environment: expected NAME:KEY=VALUE, got '2' in 'spots:2'"),
    ],
)
def test_wrong_environments_are_refused(text, message):
    with pytest.raises(ValueError, match=message):
        EnvironmentSource.from_text(text)


def test_wrong_arguments_of_environments_are_refused():
    with pytest.raises(ValueError, match=r"environment spots: .*radius"):
        EnvironmentSource.from_text("spots:radius=2").open()


def test_wrong_scenes_are_refused():
    with pytest.raises(ValueError, match=r"scene: expected a file or one of sphere, .*, got 'cube'"):
        require_scene_name("cube")


def scene_source(**changes):
    source = SceneSource("sphere", EnvironmentSource.from_text("studio", 8), None, "box", (4, 8))
    return dataclasses.replace(source, **changes)


def test_every_part_of_a_description_is_in_its_key():
    changes = [
        {},
        {"scene": "plane"},
        {"environment": EnvironmentSource.from_text("studio", 16)},
        {"material": describe_material(burnish.Material())},
        {"filter": "gauss4"},
        {"size": (8, 8)},
        {"spp": 2},
        {"camera": "0"},
    ]
    keys = [scene_source(**change).key() for change in changes]
    assert len(set(keys)) == len(changes)
    assert scene_source().key() == keys[0]
    # the device is in the row: another one does not make other work
    assert scene_source(device="llvmpipe").key() == keys[0]


def test_the_reference_does_not_depend_on_the_filter():
    assert scene_source(filter="box").reference_key() == scene_source(filter="gauss6").reference_key()
    assert scene_source(spp=1).reference_key() != scene_source(spp=2).reference_key()


def test_a_file_that_was_replaced_is_another_one(tmp_path):
    path = tmp_path / "scene.glb"
    path.write_bytes(b"first")
    before = scene_source(scene=str(path)).key()
    assert scene_source(scene=str(path)).key() == before
    path.write_bytes(b"other")
    os.utime(path, ns=(0, 0))
    assert scene_source(scene=str(path)).key() != before


def test_sampler_reference_and_source_are_in_the_key_of_a_row():
    cell = Cell(scene_source(), ("regular:5", "regular:14"), "reference:0.01", 3)
    keys = {
        cell.row_key("regular:5"),
        cell.row_key("regular:14"),
        dataclasses.replace(cell, reference="reference:0.02").row_key("regular:5"),
        dataclasses.replace(cell, source=scene_source(spp=2)).row_key("regular:5"),
    }
    assert len(keys) == 4
    assert dataclasses.replace(cell, repeats=9).row_key("regular:5") in keys


def test_a_grid_is_laid_out_scene_by_scene_with_filters_innermost():
    materials = [burnish.Material(name="a"), burnish.Material(name="b")]
    cells = make_cells(
        ["regular:5"], ["sphere", "plane"], ["studio", "sky"], materials, ["box", "gauss6"], "reference:0.1"
    )
    assert len(cells) == 16
    sources = [cell.source for cell in cells]
    assert [source.filter for source in sources[:4]] == ["box", "gauss6", "box", "gauss6"]
    assert [source.material["name"] for source in sources[:4]] == ["a", "a", "b", "b"]
    assert [source.environment.name for source in sources[:8:4]] == ["studio", "sky"]
    assert sources[8].scene == "plane"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"samplers": []}, "samplers: expected different samplers, got none"),
        ({"samplers": ["regular:5", burnish.Regular(5)]}, "got regular:5 twice"),
        ({"repeats": 0}, "repeats: expected at least 1, got 0"),
        ({"filters": ["tent"]}, "filter: expected one of box, gauss4, gauss6, got 'tent'"),
    ],
)
def test_wrong_grids_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        make_cells(**{"samplers": ["regular:5"], **arguments})

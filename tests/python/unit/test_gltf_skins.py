"""Skins: vertices stand where the joints of the file's own pose put them, whatever their node does."""

import numpy as np
import pytest

import burnish
from gltf_support import SQUARE, GltfFile

ROOT_HALF = float(np.sqrt(0.5))


def rotation_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])


def move(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def world(scene):
    """Positions, normals and front sides of the scene's one object in the world."""
    (one,) = scene.objects
    mesh = scene.meshes[one.mesh]
    matrix = one.world_from_object
    positions = mesh.positions.astype(float) @ matrix[:3, :3].T + matrix[:3, 3]
    corners = positions[np.asarray(mesh.indices).reshape(-1, 3)]
    return (
        positions,
        mesh.normals @ matrix[:3, :3].T,
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
    )


def skinned_square(joints, weights, joint_nodes, bind=None, skin_node=None, **attributes):
    """The square with a skin; its own node is number 0, the joints follow."""
    file = GltfFile()
    mesh = file.square(JOINTS_0=joints, WEIGHTS_0=weights, **attributes)
    nodes = [{"mesh": mesh, "skin": 0, **(skin_node or {})}, *joint_nodes]
    children = {child for node in nodes for child in node.get("children", [])}
    file.document |= {
        "nodes": nodes,
        "scenes": [{"nodes": [k for k in range(len(nodes)) if k not in children]}],
    }
    skin = {"joints": list(range(1, len(nodes)))}
    if bind is not None:
        skin["inverseBindMatrices"] = file.accessor(np.float32(bind))
    file.add("skins", skin)
    return file


def all_on(joint, count=4):
    return np.tile(np.uint8([joint, 0, 0, 0]), (count, 1)), np.tile(np.float32([1, 0, 0, 0]), (count, 1))


def test_joints_place_the_mesh_and_its_node_does_not(tmp_path):
    """The sum over joints of weight, joint's world matrix and inverse bind matrix; glTF 2.0, 3.7.3.3."""
    joints = np.uint16([[0, 1, 0, 0]] * 4)
    weights = np.float32([[1, 0, 0, 0], [0.75, 0.25, 0, 0], [0, 1, 0, 0], [0.5, 0.5, 0, 0]])
    turn = [0, 0, ROOT_HALF, ROOT_HALF]
    nodes = [{"translation": [1, 2, 3], "children": [2]}, {"translation": [0, 1, 0], "rotation": turn}]
    bind = [move(0, 1, 0), move(0.5, -1, 0)]
    file = skinned_square(joints, weights, nodes, bind, {"translation": [50, 60, 70], "scale": [9, 9, 9]})
    scene = burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))
    matrices = np.stack([move(1, 2, 3) @ bind[0], move(1, 3, 3) @ rotation_z(np.pi / 2) @ bind[1]])
    blended = np.einsum("vj,jrc->vrc", weights[:, :2].astype(float), matrices)
    expected = np.einsum("vrc,vc->vr", blended, np.c_[SQUARE["POSITION"], np.ones(4)])[:, :3]
    np.testing.assert_allclose(world(scene)[0], expected, atol=1e-6)
    assert scene.warnings == []


def test_normals_and_tangents_turn_with_their_joint(tmp_path):
    turn_about_x = [ROOT_HALF, 0, 0, ROOT_HALF]
    file = skinned_square(*all_on(0), [{"rotation": turn_about_x, "scale": [2, 1, 1]}])
    scene = burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))
    np.testing.assert_allclose(scene.meshes[0].normals, [[0, -1, 0]] * 4, atol=1e-6)
    np.testing.assert_allclose(scene.meshes[0].tangents, [[1, 0, 0, 1]] * 4, atol=1e-6)
    flat = skinned_square(*all_on(0), [{"rotation": turn_about_x}], NORMAL=None, TANGENT=None)
    scene = burnish.Scene.from_file(flat.write(tmp_path / "flat.gltf"))
    np.testing.assert_allclose(scene.meshes[0].normals, [[0, -1, 0]] * 6, atol=1e-6)


def test_mirroring_joints_keep_the_front_in_front(tmp_path):
    file = skinned_square(*all_on(0), [{"scale": [-1, 1, 1]}])
    positions, normals, fronts = world(burnish.Scene.from_file(file.write(tmp_path / "skin.gltf")))
    np.testing.assert_allclose(positions, SQUARE["POSITION"] * [-1, 1, 1])
    np.testing.assert_allclose(normals, SQUARE["NORMAL"])
    assert (fronts[:, 2] > 0).all()


@pytest.mark.parametrize(
    "weight", [np.uint8([51, 204, 0, 0]), np.uint16([13107, 52428, 0, 0]), np.float32([0.4, 1.6, 0, 0])]
)
def test_weights_of_every_type_are_shares_of_their_sum(tmp_path, weight):
    file = skinned_square(
        np.uint8([[0, 1, 0, 0]] * 4),
        np.tile(weight, (4, 1)),
        [{"translation": [10, 0, 0]}, {"translation": [20, 0, 0]}],
    )
    positions, _, _ = world(burnish.Scene.from_file(file.write(tmp_path / "skin.gltf")))
    np.testing.assert_allclose(positions, SQUARE["POSITION"] + [18, 0, 0], atol=1e-6)


def test_a_second_set_of_joints_counts(tmp_path):
    joints, weights = all_on(0)
    more = {"JOINTS_1": np.uint8([[1, 0, 0, 0]] * 4), "WEIGHTS_1": np.float32([[0.5, 0, 0, 0]] * 4)}
    file = skinned_square(joints, weights / 2, [{}, {"translation": [4, 0, 0]}], **more)
    positions, _, _ = world(burnish.Scene.from_file(file.write(tmp_path / "skin.gltf")))
    np.testing.assert_allclose(positions, SQUARE["POSITION"] + [2, 0, 0], atol=1e-6)


def test_far_joints_keep_the_digits_of_the_mesh(tmp_path):
    file = skinned_square(*all_on(0), [{"translation": [1e7, -1e7, 1e7]}])
    scene = burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))
    np.testing.assert_array_equal(scene.meshes[0].positions, SQUARE["POSITION"])
    np.testing.assert_array_equal(world(scene)[0], SQUARE["POSITION"] + [1e7, -1e7, 1e7])


def test_nodes_share_a_mesh_by_skin(tmp_path):
    file = skinned_square(*all_on(0), [{"translation": [5, 0, 0]}])
    file.document["nodes"] += [{"mesh": 0, "skin": 0}, {"mesh": 0, "translation": [0, 7, 0]}]
    file.document["scenes"] = [{"nodes": [0, 1, 2, 3]}]
    scene = burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))
    skinned, same, plain = scene.objects
    assert skinned.mesh == same.mesh != plain.mesh
    np.testing.assert_allclose(np.mean(skinned.bounds(), 0), [5, 0, 0])
    np.testing.assert_allclose(np.mean(plain.bounds(), 0), [0, 7, 0])


def test_vertices_and_meshes_without_joints_say_where_they_are_drawn(tmp_path):
    joints, weights = all_on(1)
    weights[2] = 0
    joints[2] = 0
    file = skinned_square(joints, weights, [{}, {"translation": [0, 0, 3]}])
    scene = burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))
    assert any("1 vertices without weight are placed by their first joint" in text for text in scene.warnings)
    np.testing.assert_allclose(world(scene)[0][:, 2], [3, 3, 0, 3])

    bare = GltfFile()
    bare.document |= {"nodes": [{"mesh": bare.square(), "skin": 0, "translation": [1, 0, 0]}, {}]}
    bare.add("skins", {"joints": [1]})
    scene = burnish.Scene.from_file(bare.write(tmp_path / "bare.gltf"))
    assert any(
        "has a skin, but it has no JOINTS_0: placed by the node alone" in text for text in scene.warnings
    )
    np.testing.assert_allclose(np.mean(scene.objects[0].bounds(), 0), [1, 0, 0])


def broken(**attributes):
    joints, weights = all_on(0)
    return {"JOINTS_0": joints, "WEIGHTS_0": weights} | attributes


@pytest.mark.parametrize(
    ("attributes", "bind", "text"),
    [
        (broken(JOINTS_0=all_on(1)[0]), None, "JOINTS_0: expected each below the skin's 1 joints, got 1"),
        (broken(JOINTS_0=np.float32(all_on(0)[0])), None, "JOINTS_0: expected unsigned bytes or shorts"),
        (broken(WEIGHTS_0=np.int16(all_on(0)[1])), None, "WEIGHTS_0: expected 32-bit floats or normalized"),
        (broken(WEIGHTS_0=all_on(0, 3)[1]), None, r"WEIGHTS_0: expected as many as POSITION \(4\), got 3"),
        (broken(WEIGHTS_0=None), None, "JOINTS_0: expected WEIGHTS_0 beside it, got none"),
        (broken(), np.zeros((1, 4, 4)), r"skins\[0\].joints\[0\]: expected a finite affine transform"),
    ],
)
def test_broken_skins_are_named(tmp_path, attributes, bind, text):
    file = GltfFile()
    mesh = file.square(**{name: values for name, values in attributes.items() if values is not None})
    file.document["nodes"] = [{"mesh": mesh, "skin": 0}, {}]
    skin = {"joints": [1]}
    if bind is not None:
        skin["inverseBindMatrices"] = file.accessor(np.float32(bind))
    file.add("skins", skin)
    with pytest.raises(burnish.FileError, match=text):
        burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))


def test_rounded_last_rows_of_bind_matrices_are_taken_as_what_they_are(tmp_path):
    bind = move(0, 2, 0)
    bind[3] = [1e-7, -1e-8, 0, 1 - 1e-6]
    file = skinned_square(*all_on(0), [{}], [bind])
    positions, _, _ = world(burnish.Scene.from_file(file.write(tmp_path / "skin.gltf")))
    np.testing.assert_array_equal(positions, SQUARE["POSITION"] + np.float32([0, 2, 0]))


def test_too_few_bind_matrices_are_named(tmp_path):
    file = skinned_square(*all_on(0), [{}, {}], [np.eye(4)])
    with pytest.raises(
        burnish.FileError, match=r"inverseBindMatrices: expected as many as joints \(2\), got 1"
    ):
        burnish.Scene.from_file(file.write(tmp_path / "skin.gltf"))

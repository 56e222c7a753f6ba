"""A scene's files may only lie in or below its folder, whatever links say."""

import json
import os
import struct
from pathlib import Path

import pytest
from PIL import Image

import burnish

OUTSIDE = "expected a file in or below the scene's folder, got a link to one outside"


@pytest.fixture
def folder(tmp_path):
    """The scene's folder, beside a buffer and a picture that are none of its business."""
    inside = tmp_path / "scene"
    inside.mkdir()
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "data.bin").write_bytes(struct.pack("<9f", 0, 0, 0, 7, 0, 0, 0, 7, 0))
    Image.new("RGB", (1, 1)).save(outside / "picture.png")
    return inside


def write_scene(path: Path, buffer: str | None, picture: str | None = None) -> Path:
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, **({"uri": buffer} if buffer else {})}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{}],
        "nodes": [{"mesh": 0}],
    }
    if picture is not None:
        document |= {
            "images": [{"uri": picture}],
            "textures": [{"source": 0}],
            "materials": [{"emissiveTexture": {"index": 0}}],
        }
    path.write_text(json.dumps(document))
    return path


@pytest.mark.parametrize("link", ["relative", "absolute", "through another link", "folder", "up and down"])
def test_buffer_behind_a_link_out_of_the_folder_is_refused(folder, link):
    target = folder.parent / "outside" / "data.bin"
    uri = "data.bin"
    if link == "relative":
        (folder / uri).symlink_to("../outside/data.bin")
    elif link == "absolute":
        (folder / uri).symlink_to(target)
    elif link == "through another link":
        (folder / "first").symlink_to(target)
        (folder / uri).symlink_to("first")
    elif link == "folder":
        (folder / "sub").symlink_to(target.parent)
        uri = "sub/data.bin"
    else:  # by name it stays inside; the folder that it turns around in does not
        (folder / "sub").symlink_to(target.parent)
        (folder.parent / "data.bin").write_bytes(target.read_bytes())
        uri = "sub/../data.bin"
    path = write_scene(folder / "scene.gltf", uri)
    with pytest.raises(burnish.FileError, match=f'buffers\\[0\\] "{uri}": {OUTSIDE}'):
        burnish.Scene.from_file(path)


def test_picture_behind_a_link_out_of_the_folder_is_left_out(folder):
    (folder / "data.bin").write_bytes((folder.parent / "outside" / "data.bin").read_bytes())
    (folder / "picture.png").symlink_to("../outside/picture.png")
    scene = burnish.Scene.from_file(write_scene(folder / "scene.gltf", "data.bin", "picture.png"))
    assert scene.image_count == 0
    assert any(OUTSIDE in sentence for sentence in scene.warnings)


def test_links_within_the_folder_are_followed(folder):
    (folder / "deep").mkdir()
    (folder / "deep" / "real.bin").write_bytes((folder.parent / "outside" / "data.bin").read_bytes())
    (folder / "data.bin").symlink_to("deep/real.bin")
    (folder / "also").symlink_to("deep")
    for uri in ("data.bin", "also/real.bin"):
        assert burnish.Scene.from_file(write_scene(folder / "scene.gltf", uri)).bounds()[1] == (7, 7, 0)


def test_scene_and_its_folder_may_be_links(folder, monkeypatch):
    (folder / "data.bin").write_bytes((folder.parent / "outside" / "data.bin").read_bytes())
    elsewhere = write_scene(folder.parent / "outside" / "scene.gltf", "data.bin")
    (folder / "scene.gltf").symlink_to(elsewhere)  # its own data lie beside the name it is asked for by
    linked = folder.parent / "linked"
    linked.symlink_to(folder)
    for path in (folder / "scene.gltf", linked / "scene.gltf"):
        assert burnish.Scene.from_file(path).bounds()[1] == (7, 7, 0)
    monkeypatch.chdir(linked)
    assert burnish.Scene.from_file("scene.gltf").bounds()[1] == (7, 7, 0)


def test_a_link_in_a_circle_and_a_dangling_one_are_named(folder):
    (folder / "round.bin").symlink_to("round.bin")
    (folder / "gone.bin").symlink_to("nowhere.bin")
    for uri, reason in (("round.bin", os.strerror(40)), ("gone.bin", "no such file")):
        with pytest.raises(burnish.FileError, match=f'"{uri}": {reason}'):
            burnish.Scene.from_file(write_scene(folder / "scene.gltf", uri))

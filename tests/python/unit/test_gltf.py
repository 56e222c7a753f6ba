"""glTF scenes: the real ones of the shared set, and small ones about pictures."""

import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import burnish

SCENES = Path(__file__).parents[3].parent / "shared" / "data" / "scenes"
needs_scenes = pytest.mark.skipif(not SCENES.is_dir(), reason=f"{SCENES} is absent")

# file, objects, triangles, extent (x, y, z), pictures read, words of the one warning or None
EXPECTED = [
    ("AlphaBlendModeTest/AlphaBlendModeTest.glb", 9, 61, (8.6, 2.4, 1.3), 4, "BLEND is drawn as MASK"),
    ("AnisotropyBarnLamp/AnisotropyBarnLamp.gltf", 3, 10203, (0.191, 0.255, 0.227), 1, "KTX2"),
    ("AnisotropyStrengthTest/AnisotropyStrengthTest.glb", 50, 97240, (7.57, 7.387, 0.8), 1, None),
    ("Box/Box.glb", 1, 12, (1, 1, 1), 0, None),
    ("Cameras/Cameras.gltf", 1, 2, (1, 0.707, 0.708), 0, None),
    ("ClearCoatCarPaint/ClearCoatCarPaint.glb", 1, 3072, (1, 0.98, 1), 1, None),
    ("ClearCoatTest/ClearCoatTest.glb", 27, 37116, (10.458, 13.105, 1.11), 6, "BLEND is drawn as MASK"),
    ("EmissiveStrengthTest/EmissiveStrengthTest.glb", 6, 90, (16.004, 10.01, 3.999), 1, None),
    (
        "GlamVelvetSofa/GlamVelvetSofa.glb",
        3,
        4196,
        (2.188, 0.788, 1.023),
        2,
        None,
    ),
    (
        "MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb",
        123,
        1040409,
        (0.007, 0.008, 0.004),
        0,
        None,
    ),
    ("NormalTangentTest/NormalTangentTest.glb", 1, 7774, (2.22, 2.15, 0.09), 3, None),
    ("OrientationTest/OrientationTest.glb", 13, 524, (10.661, 10.661, 10.661), 0, None),
    ("SheenCloth/SheenCloth.gltf", 1, 115200, (0.072, 0.04, 0.071), 3, "sheenColorTexture: not read"),
    ("SpecularTest/SpecularTest.glb", 24, 44828, (1.126, 0.76, 0.1), 4, None),
    ("Suzanne/Suzanne.gltf", 1, 3936, (2.674, 1.925, 1.626), 2, None),
    ("TextureCoordinateTest/TextureCoordinateTest.glb", 5, 10, (2.4, 2.4, 0.053), 1, None),
    ("TextureEncodingTest/TextureEncodingTest.glb", 14, 3844, (15.5, 12, 2), 8, None),
    ("TextureSettingsTest/TextureSettingsTest.glb", 10, 72, (10.323, 10.072, 0.25), 3, None),
    ("Triangle/Triangle.gltf", 1, 1, (1, 1, 0), 0, None),
    ("VertexColorTest/VertexColorTest.glb", 2, 36, (2, 2, 0.074), 2, None),
    ("WaterBottle/WaterBottle.gltf", 1, 4510, (0.109, 0.26, 0.109), 4, None),
    ("shaderball/shaderball.glb", 2, 88264, (2.143, 2.087, 2.082), 0, None),
]


@needs_scenes
@pytest.mark.parametrize(("name", "objects", "triangles", "extent", "images", "warning"), EXPECTED)
def test_gltf_real_scene_loads_whole(name, objects, triangles, extent, images, warning):
    scene = burnish.Scene.from_file(SCENES / name)
    assert len(scene.objects) == objects
    assert scene.triangle_count == triangles
    low, high = np.array(scene.bounds())
    np.testing.assert_allclose(high - low, extent, atol=6e-4)
    assert scene.image_count == images
    if warning is None:
        assert scene.warnings == []
    else:
        assert any(warning in sentence for sentence in scene.warnings)
    for mesh in {placed.mesh: scene.meshes[placed.mesh] for placed in scene.objects}.values():
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-5)


@needs_scenes
def test_gltf_every_shared_scene_is_listed():
    found = {str(path.relative_to(SCENES)) for suffix in ("*.glb", "*.gltf") for path in SCENES.rglob(suffix)}
    assert found == {row[0] for row in EXPECTED}


@needs_scenes
def test_gltf_lists_extensions_without_effect():
    scene = burnish.Scene.from_file(str(SCENES / "GlamVelvetSofa" / "GlamVelvetSofa.glb"))
    assert scene.ignored_extensions == ["KHR_materials_variants"]


@needs_scenes
def test_gltf_cameras_are_read():
    scene = burnish.Scene.from_file(SCENES / "Cameras" / "Cameras.gltf")
    assert [camera.is_orthographic for camera in scene.cameras] == [False, True]
    np.testing.assert_allclose(scene.cameras[0].world_from_camera[:3, 3], [0.5, 0.5, 3])


@needs_scenes
def test_gltf_derived_tangents_are_frames():
    mesh = burnish.Scene.from_file(SCENES / "NormalTangentTest" / "NormalTangentTest.glb").meshes[0]
    np.testing.assert_allclose(np.linalg.norm(mesh.tangents[:, :3], axis=1), 1, atol=1e-5)
    np.testing.assert_allclose((mesh.tangents[:, :3] * mesh.normals).sum(1), 0, atol=1e-5)
    assert set(np.unique(mesh.tangents[:, 3])) <= {-1.0, 1.0}


def write_textured(folder: Path, uri: str, name: str = "picture") -> Path:
    positions = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32)
    (folder / "data.bin").write_bytes(positions.tobytes())
    document = {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": "data.bin"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "images": [{"uri": uri, "name": name}],
        "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "nodes": [{"mesh": 0}],
    }
    path = folder / "scene.gltf"
    path.write_text(json.dumps(document))
    return path


def picture_warnings(path: Path) -> list[str]:
    """Warnings about the picture; the missing texture coordinates warn too."""
    return [sentence for sentence in burnish.Scene.from_file(path).warnings if "TEXCOORD" not in sentence]


@pytest.mark.parametrize("uri", ["a b.png", "a%20b.png", "./a b.png", "sub/../a b.png"])
def test_gltf_finds_pictures_by_escaped_names(tmp_path, uri):
    Image.new("RGB", (3, 5)).save(tmp_path / "a b.png")
    (tmp_path / "sub").mkdir()
    path = write_textured(tmp_path, uri)
    assert picture_warnings(path) == []
    assert burnish.Scene.from_file(path).image_count == 1


@pytest.mark.parametrize(
    ("uri", "text"),
    [
        ("gone.png", "no such file"),
        ("../up.png", "expected a file in or below the scene's folder"),
        ("%2e%2e%2fup.png", "expected a file in or below the scene's folder"),
        ("https://example.com/a.png", "expected a relative file name or base64 data"),
        ("data:image/png;base64,AAAA", "expected a PNG or JPEG, got something else"),
        ("scene.gltf", "expected a PNG or JPEG, got something else"),
        ("sub", "expected a file, got a folder or device"),
    ],
)
def test_gltf_picture_that_cannot_be_read_is_named(tmp_path, uri, text):
    (tmp_path / "sub").mkdir()
    Image.new("RGB", (1, 1)).save(tmp_path.parent / "up.png")
    (sentence,) = picture_warnings(write_textured(tmp_path, uri))
    assert sentence.startswith('images[0] "picture"')
    assert text in sentence


def test_gltf_16_bit_picture_warns(tmp_path):
    Image.fromarray(np.full((2, 2), 40000, np.uint16)).save(tmp_path / "deep.png")
    (sentence,) = picture_warnings(write_textured(tmp_path, "deep.png"))
    assert "16 bits per channel read as 8" in sentence


def png(width: int, height: int, raw: bytes) -> bytes:
    def chunk(kind: bytes, body: bytes) -> bytes:
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", header)
        + chunk(b"IDAT", zlib.compress(raw, 9))
        + chunk(b"IEND", b"")
    )


@pytest.mark.parametrize(
    ("size", "text"),
    [
        ((20000, 1), "expected sides of 1..16384 texels, got 20000 x 1"),
        ((16000, 16000), "expected at most 67108864 texels"),
    ],
)
def test_gltf_picture_size_is_checked_before_decoding(tmp_path, size, text):
    (tmp_path / "large.png").write_bytes(png(*size, b""))
    (sentence,) = picture_warnings(write_textured(tmp_path, "large.png"))
    assert text in sentence


def test_gltf_picture_that_inflates_without_end_is_stopped(tmp_path):
    (tmp_path / "bomb.png").write_bytes(png(1, 1, bytes(100_000_000)))
    (sentence,) = picture_warnings(write_textured(tmp_path, "bomb.png"))
    assert "damaged picture" in sentence


def test_gltf_jpeg_with_an_impossible_huffman_table_is_refused(tmp_path):
    path = tmp_path / "huffman.jpg"
    Image.new("RGB", (8, 8)).save(path)
    jpeg = bytearray(path.read_bytes())
    table = jpeg.index(b"\xff\xc4") + 5
    jpeg[table : table + 16] = b"\xff" * 16
    path.write_bytes(jpeg)
    (sentence,) = picture_warnings(write_textured(tmp_path, path.name))
    assert "a Huffman table of more than 256 codes" in sentence

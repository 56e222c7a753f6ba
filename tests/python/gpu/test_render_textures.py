"""Textures of a small glTF against the mapping evaluated in numpy, texel by texel."""

import base64
import io
import json

import numpy as np
import pytest
from PIL import Image

import burnish
from burnish.oracle.metallic_roughness import Material, MetallicRoughness, map_metallic_roughness
from burnish.oracle.shading import shade as oracle_shade
from engine_support import HARDWARE_WEIGHTS, smooth_environment_faces, unit

# The G-buffer holds colours and slopes in half precision: 2^-11 each; the picture under smooth light no more.
LIMIT = 4e-3
# Lobes scaled to their albedo read it, where roughness varies, from a table with steps of 36 %.
ALBEDO_LIMIT = 1.2e-2
SMOOTH_BRIGHTEST = 5.0
TEXELS, PIXELS = 4, 16
CENTERS = np.arange(PIXELS // TEXELS // 2, PIXELS, PIXELS // TEXELS)
NEAREST, REPEAT = 9728, 10497


def data_uri(mime, data):
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


def png(texels):
    file = io.BytesIO()
    Image.fromarray(np.round(np.asarray(texels) * 255).astype(np.uint8)).save(file, "PNG")
    return data_uri("image/png", file.getvalue())


def quantized(texels):
    return np.round(np.asarray(texels) * 255) / 255


def write_quad(path, material, images, extensions=()):
    """A square of edge 2 in the plane z = 0, rows of pictures along those of textures."""
    positions = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    uv = np.float32([[0, 1], [1, 1], [1, 0], [0, 0]])
    normals = np.float32([[0, 0, 1]] * 4)
    tangents = np.float32([[1, 0, 0, 1]] * 4)
    arrays = [positions, normals, tangents, uv, np.uint16([0, 1, 2, 0, 2, 3])]
    kinds = ["VEC3", "VEC3", "VEC4", "VEC2", "SCALAR"]
    data, views, accessors = b"", [], []
    for array, kind in zip(arrays, kinds, strict=True):
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        accessor = {"bufferView": len(accessors), "type": kind, "count": len(array)}
        accessor["componentType"] = 5126 if array.dtype == np.float32 else 5123
        accessors.append(accessor)
        data += array.tobytes()
    accessors[0] |= {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()}
    attributes = {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3}
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": list(extensions),
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 4, "material": 0}]}],
        "materials": [material],
        "buffers": [{"uri": data_uri("application/octet-stream", data), "byteLength": len(data)}],
        "bufferViews": views,
        "accessors": accessors,
        "samplers": [{"magFilter": NEAREST, "minFilter": NEAREST, "wrapS": REPEAT, "wrapT": REPEAT}],
        "images": [{"uri": png(image)} for image in images],
        "textures": [{"source": k, "sampler": 0} for k in range(len(images))],
    }
    path.write_text(json.dumps(document))
    return burnish.Scene.from_file(path)


def srgb_to_linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


@pytest.fixture(scope="module")
def environment():
    return burnish.Environment.from_faces(smooth_environment_faces(64))


def texel_colors(device, scene, environment, sampler):
    """The picture of the square from straight above, at the middle of each texel; the frame too."""
    scene.environment = environment
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    frame = burnish.render(scene, camera, (PIXELS, PIXELS), sampler, device=device)
    assert frame.alpha.all() and frame.report.non_finite == 0
    return frame.color[np.ix_(CENTERS, CENTERS)], frame


def expected_colors(device, environment, materials, normals=None, sampler=None):
    """Oracle's radiance (4, 4, 3) of one material a texel, seen along +z."""
    sampler = burnish.Importance() if sampler is None else sampler
    if isinstance(sampler, burnish.Prefiltered):
        levels = [level for _, level in environment.prefiltered(device=device)]
    else:
        levels = environment.pyramid(device=device)
    result = np.zeros((TEXELS, TEXELS, 3))
    for row, column in np.ndindex(TEXELS, TEXELS):
        normal = np.array([0.0, 0.0, 1.0]) if normals is None else normals[row, column]
        # Lobes without direction are sampled in the frame along growing longitude.
        tangent = np.array([normal[2], 0.0, -normal[0]])
        view = np.array([0.0, 0.0, 1.0])
        result[row, column] = oracle_shade(levels, materials(row, column), sampler, normal, tangent, view)
    return result


def assert_close(device, got, expected, limit=LIMIT):
    # Of materials' textures as well, which every device reads by its sampler.
    limit += 0.0 if device.is_software else HARDWARE_WEIGHTS * SMOOTH_BRIGHTEST / expected.mean()
    error = np.abs(got - expected) / expected.mean()
    worst = np.unravel_index(np.argmax(error), error.shape)
    assert error.max() <= limit, f"texel {worst}: got {got[worst]:.5f}, expected {expected[worst]:.5f}"


def is_on(frame, name):
    return next(line["on"] for line in frame.report.effects if line["name"] == name)


def test_base_color_texture_is_decoded_and_upright(device, environment, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    pbr = {
        "baseColorTexture": {"index": 0},
        "baseColorFactor": [0.5, 1.0, 0.8, 1.0],
        "metallicFactor": 0.0,
        "roughnessFactor": 0.6,
    }
    scene = write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": pbr}, [texels])
    got, frame = texel_colors(device, scene, environment, burnish.Importance())
    base = srgb_to_linear(texels) * [0.5, 1.0, 0.8]

    def material(row, column):
        return map_metallic_roughness(
            MetallicRoughness(base_color=base[row, column], metallic=0.0, roughness=0.6)
        )

    assert_close(device, got, expected_colors(device, environment, material))
    assert is_on(frame, "base colour texture") and not is_on(frame, "normal mapping")


@pytest.mark.parametrize("sampler", [burnish.Importance(), burnish.Prefiltered()], ids=repr)
def test_metallic_roughness_texture_drives_the_lobe(device, environment, sampler, rng, tmp_path):
    texels = quantized(rng.uniform(0.2, 1.0, (TEXELS, TEXELS, 3)))
    pbr = {"metallicRoughnessTexture": {"index": 0}, "roughnessFactor": 0.9, "metallicFactor": 0.7}
    pbr["baseColorFactor"] = [0.9, 0.6, 0.2, 1.0]
    scene = write_quad(tmp_path / "quad.gltf", {"pbrMetallicRoughness": pbr}, [texels])
    got, frame = texel_colors(device, scene, environment, sampler)

    def material(row, column):
        _, green, blue = texels[row, column]
        source = MetallicRoughness(base_color=(0.9, 0.6, 0.2), metallic=0.7 * blue, roughness=0.9 * green)
        return map_metallic_roughness(source)

    limit = ALBEDO_LIMIT if isinstance(sampler, burnish.Prefiltered) else LIMIT
    assert_close(device, got, expected_colors(device, environment, material, sampler=sampler), limit)
    assert is_on(frame, "metallic-roughness texture")


def test_normal_texture_bends_the_normal(device, environment, rng, tmp_path):
    slopes = rng.uniform(-0.6, 0.6, (TEXELS, TEXELS, 2))
    bent = unit(np.concatenate([slopes, np.ones((TEXELS, TEXELS, 1))], -1))
    texels = quantized(0.5 * bent + 0.5)
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.5},
        "normalTexture": {"index": 0, "scale": 0.8},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels])
    got, frame = texel_colors(device, scene, environment, burnish.Importance())
    normals = unit((2 * texels - 1) * [0.8, 0.8, 1.0])
    np.testing.assert_allclose(frame.normal[np.ix_(CENTERS, CENTERS)], normals, atol=3e-4)
    same = map_metallic_roughness(MetallicRoughness(metallic=1.0, roughness=0.5))
    assert_close(device, got, expected_colors(device, environment, lambda row, column: same, normals))
    assert is_on(frame, "normal mapping")


def test_emissive_texture_and_strength_are_added(device, environment, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7},
        "emissiveTexture": {"index": 0},
        "emissiveFactor": [1.0, 0.5, 0.25],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 12.0}},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels], ["KHR_materials_emissive_strength"])
    got, frame = texel_colors(device, scene, environment, burnish.Importance())
    base = map_metallic_roughness(MetallicRoughness(metallic=0.0, roughness=0.7))
    emitted = 12.0 * srgb_to_linear(texels) * [1.0, 0.5, 0.25]

    def glowing(row, column):
        return Material(base.diffuse, base.lobes, emitted[row, column])

    assert_close(device, got, expected_colors(device, environment, glowing))
    assert is_on(frame, "emissive texture")


@pytest.mark.parametrize("sampler", [burnish.Importance(), burnish.Prefiltered()], ids=repr)
def test_clear_coat_adds_a_lobe(device, environment, sampler, rng, tmp_path):
    texels = quantized(rng.random((TEXELS, TEXELS, 3)))
    coat = {"clearcoatFactor": 0.8, "clearcoatTexture": {"index": 0}, "clearcoatRoughnessFactor": 0.4}
    material = {
        "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 0.7},
        "extensions": {"KHR_materials_clearcoat": coat},
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels], ["KHR_materials_clearcoat"])
    got, frame = texel_colors(device, scene, environment, sampler)

    def coated(row, column):
        source = MetallicRoughness(
            metallic=0.0, roughness=0.7, clearcoat=0.8 * texels[row, column, 0], clearcoat_roughness=0.4
        )
        return map_metallic_roughness(source)

    assert_close(device, got, expected_colors(device, environment, coated, sampler=sampler))
    assert is_on(frame, "clear coat texture") and is_on(frame, "lobe 2")


def test_alpha_mask_cuts_texels_out(device, environment, tmp_path):
    texels = np.ones((TEXELS, TEXELS, 4))
    texels[..., 3] = np.indices((TEXELS, TEXELS)).sum(0) % 2
    material = {
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
        "alphaMode": "MASK",
        "alphaCutoff": 0.5,
    }
    scene = write_quad(tmp_path / "quad.gltf", material, [texels])
    scene.environment = environment
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    frame = burnish.render(scene, camera, (PIXELS, PIXELS), device=device)
    expected = np.repeat(np.repeat(texels[..., 3], PIXELS // TEXELS, 0), PIXELS // TEXELS, 1)
    np.testing.assert_array_equal(frame.alpha, expected)
    assert is_on(frame, "alpha mask")


def test_textured_and_plain_pictures_agree_where_the_texture_is_flat(device, environment, tmp_path):
    """A white texture changes nothing but the way: the wide G-buffer gives what the narrow one does."""
    pbr = {"baseColorFactor": [0.9, 0.5, 0.2, 1.0], "metallicFactor": 0.6, "roughnessFactor": 0.5}
    plain = write_quad(tmp_path / "plain.gltf", {"pbrMetallicRoughness": pbr}, [])
    white = np.ones((TEXELS, TEXELS, 3))
    textured = {"pbrMetallicRoughness": pbr | {"baseColorTexture": {"index": 0}}}
    other = write_quad(tmp_path / "textured.gltf", textured, [white])
    for sampler in (burnish.Importance(), burnish.Prefiltered(), burnish.Reference(method="quadrature")):
        expected, _ = texel_colors(device, plain, environment, sampler)
        got, _ = texel_colors(device, other, environment, sampler)
        assert_close(device, got, expected)

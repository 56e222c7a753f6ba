"""Features of glTF two by two: right alone, they must be right together, pixel by pixel of a closed form.

A square fills the picture under light a + b.w of the direction w, of which a surface of diffuse reflectance
kd and normal n gives back kd (a + 2/3 b.n). Its material has no lobe but the clear coat.
"""

from itertools import combinations

import numpy as np
import pytest

import burnish
from burnish.environments import cube_directions
from burnish.oracle.metallic_roughness import Material, MetallicRoughness, map_metallic_roughness
from burnish.oracle.shading import lobe_through
from burnish.oracle.shading import shade as oracle_shade
from engine_support import HARDWARE_WEIGHTS, unit
from gltf_support import NEAREST, GltfFile

FEATURES = [
    "unlit",
    "vertex colour",
    "coat",
    "normal map",
    "mask",
    "skin",
    "emission",
    "texture transform",
    "double-sided",
    "mirrored",
]
PAIRS = [*((one,) for one in FEATURES), *combinations(FEATURES, 2)]

TEXELS, PIXELS = 4, 16
# Colours pass through half precision, 2^-11 each; the light is held in texels of 1/32.
LIMIT = 4e-3
AMBIENT, SLOPE = 1.0, np.array([0.5, 0.35, 0.25])
BASE, BASE_ALPHA, CUTOFF = np.array([0.6, 0.5, 0.4]), 0.9, 0.5
VERTEX_COLOR = np.float32([0.25, 0.5, 0.75, 0.8])
EMITTED = 5.0 * np.array([0.1, 0.2, 0.3])
COAT, COAT_ROUGHNESS = 0.8, 0.5
# uv' = offset + rotation * scale * uv, a quarter turn counter-clockwise as seen.
TRANSFORM = {"offset": [0.25, 0.5], "rotation": np.pi / 2, "scale": [1.0, -1.0]}


@pytest.fixture(scope="module")
def environment():
    return burnish.Environment.from_faces(
        np.float32(AMBIENT + cube_directions(32) @ SLOPE)[..., None].repeat(3, -1)
    )


@pytest.fixture(scope="module")
def pictures():
    """Texels of base colour and its alpha, and of the normal map, as 8 bits hold them."""
    rng = np.random.default_rng(20140619)
    color = rng.uniform(0.2, 1.0, (TEXELS, TEXELS, 4))
    color[..., 3] = np.array([0.2, 0.6, 0.8, 1.0])[rng.integers(0, 4, (TEXELS, TEXELS))]
    slopes = rng.uniform(-0.5, 0.5, (TEXELS, TEXELS, 2))
    normals = 0.5 + 0.5 * unit(np.concatenate([slopes, np.ones((TEXELS, TEXELS, 1))], -1))
    return tuple(np.round(texels * 255) / 255 for texels in (color, normals))


def placement(features):
    """World from object: turns by half and quarter, and a mirror."""
    matrix = np.eye(3)
    if "mirrored" in features:
        matrix = np.diag([-1.0, 1.0, 1.0]) @ matrix
    if "skin" in features:
        matrix = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]) @ matrix
    if "double-sided" in features:  # seen from behind
        matrix = np.diag([-1.0, 1.0, -1.0]) @ matrix
    return matrix


def write(path, features, pictures):
    file = GltfFile()
    info = {}
    if "texture transform" in features:
        info = {"extensions": {"KHR_texture_transform": TRANSFORM}}
    extensions = {"KHR_materials_specular": {"specularFactor": 0.0}}
    pbr = {"baseColorFactor": [*BASE, BASE_ALPHA], "metallicFactor": 0.0}
    material = {"pbrMetallicRoughness": pbr, "extensions": extensions}
    nearest = {"magFilter": NEAREST, "minFilter": NEAREST}
    if {"mask", "texture transform"} & set(features):
        pbr["baseColorTexture"] = {"index": file.texture(pictures[0], **nearest), **info}
    if "mask" in features:
        material |= {"alphaMode": "MASK", "alphaCutoff": CUTOFF}
    if "normal map" in features:
        material["normalTexture"] = {"index": file.texture(pictures[1], **nearest), **info}
    if "emission" in features:
        material["emissiveFactor"] = list(EMITTED / 5.0)
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": 5.0}
    if "coat" in features:
        extensions["KHR_materials_clearcoat"] = {
            "clearcoatFactor": COAT,
            "clearcoatRoughnessFactor": COAT_ROUGHNESS,
        }
    if "unlit" in features:
        extensions["KHR_materials_unlit"] = {}
    if "double-sided" in features:
        material["doubleSided"] = True
    attributes = {}
    if "vertex colour" in features:
        attributes["COLOR_0"] = np.tile(VERTEX_COLOR, (4, 1))
    if "skin" in features:
        attributes["JOINTS_0"] = np.tile(np.uint8([0, 0, 0, 0]), (4, 1))
        attributes["WEIGHTS_0"] = np.tile(np.float32([1, 0, 0, 0]), (4, 1))
    matrix = np.eye(4)
    matrix[:3, :3] = placement(features)
    placed = {"matrix": matrix.T.reshape(-1).tolist()}
    mesh = {"mesh": file.square(material, **attributes)}
    if "skin" in features:
        file.add("skins", {"joints": [1]})
        file.document["nodes"] = [mesh | {"skin": 0, "translation": [0.0, 100.0, 0.0]}, placed]
    else:
        file.document["nodes"] = [mesh | placed]
    return burnish.Scene.from_file(file.write(path))


def srgb_to_linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def expected_picture(features, pictures, coat, through):
    """Colour (PIXELS, PIXELS, 3) and whether something shows; `coat` is what the coat adds seen face on,
    `through` what it leaves of what lies below.
    """
    matrix = placement(features)
    centers = (2 * np.arange(PIXELS) + 1) / PIXELS - 1
    x, y = np.meshgrid(centers, -centers)
    x, y, _ = np.moveaxis(
        np.stack([x, y, np.zeros_like(x)], -1) @ matrix, -1, 0
    )  # by the inverse of an orthogonal matrix
    uv = np.stack([(x + 1) / 2, (1 - y) / 2], -1)
    if "texture transform" in features:
        scaled = uv * TRANSFORM["scale"]
        c, s = np.cos(TRANSFORM["rotation"]), np.sin(TRANSFORM["rotation"])
        uv = np.stack([c * scaled[..., 0] + s * scaled[..., 1], -s * scaled[..., 0] + c * scaled[..., 1]], -1)
        uv += TRANSFORM["offset"]
    column, row = np.moveaxis(np.floor(uv % 1 * TEXELS).astype(int), -1, 0)

    base, alpha = np.broadcast_to(BASE, (PIXELS, PIXELS, 3)), np.full((PIXELS, PIXELS), BASE_ALPHA)
    if {"mask", "texture transform"} & set(features):
        texels = pictures[0][row, column]
        base, alpha = base * srgb_to_linear(texels[..., :3]), alpha * texels[..., 3]
    if "vertex colour" in features:
        base, alpha = base * VERTEX_COLOR[:3], alpha * VERTEX_COLOR[3]
    shows = alpha >= CUTOFF if "mask" in features else np.ones_like(alpha, bool)
    if "unlit" in features:
        return base, shows

    mapped = np.array([0.0, 0.0, 1.0])
    if "normal map" in features:
        mapped = unit(2 * pictures[1][row, column] - 1)
    normal = np.broadcast_to(mapped @ matrix.T, base.shape)
    if "double-sided" in features:  # its back is seen, where the whole mapped normal turns around
        normal = -normal
    color = base * (AMBIENT + 2 / 3 * normal @ SLOPE)[..., None]
    if "emission" in features:
        color = color + EMITTED
    if "coat" in features:
        color = color * through + coat
    return color, shows


@pytest.mark.parametrize("features", PAIRS, ids=" and ".join)
def test_pair_of_features_has_its_closed_form(device, environment, pictures, features, tmp_path):
    scene = write(tmp_path / "pair.gltf", features, pictures)
    scene.environment = environment
    scene.show_background = False
    sampler = burnish.Importance()
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    frame = burnish.render(scene, camera, (PIXELS, PIXELS), sampler, device=device)

    face_on = np.array([0.0, 0.0, 1.0])
    source = MetallicRoughness(metallic=0.0, specular=0.0, clearcoat=COAT, clearcoat_roughness=COAT_ROUGHNESS)
    coat = Material(0.0, map_metallic_roughness(source).lobes)
    levels = environment.pyramid(device=device)
    # The coat lies on the square itself, whatever the normal map beneath it does.
    added = oracle_shade(levels, coat, sampler, face_on, np.array([1.0, 0.0, 0.0]), face_on)
    frame_of_view = (face_on, np.array([1.0, 0.0, 0.0]), face_on)
    through = lobe_through(*frame_of_view, coat.lobes[0], None)
    expected, shows = expected_picture(features, pictures, added, through)
    np.testing.assert_array_equal(frame.alpha, shows)
    assert 0 < shows.sum() and ("mask" in features) == (not shows.all())
    limit = LIMIT + (0.0 if device.is_software else HARDWARE_WEIGHTS)
    error = np.abs(frame.color - expected)[shows] / expected[shows].mean()
    assert error.max() <= limit, f"{error.max():.4f}: {frame.color[shows][0]}, expected {expected[shows][0]}"
    assert scene.warnings == []

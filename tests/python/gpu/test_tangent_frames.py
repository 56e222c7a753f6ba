"""Which way textures of directions point, against one table worked out by hand."""

import numpy as np
import pytest

import burnish
from burnish.oracle.shading import shade as oracle_shade
from burnish.oracle.tangent_space import brushed_tangent, mapped_normal
from engine_support import unit
from textured_quad import LIMIT, levels_of, middle_color, quantized, write_quad

X, Y, Z = np.eye(3)
HALF_PI = np.pi / 2
MIRRORED = {"scale": [-1, 1, 1]}
QUARTER_TURN = {"rotation": [0, 0, 0.5**0.5, 0.5**0.5]}  # counter-clockwise, seen from +z
# The square's picture lies upright: u grows along +x, v along -y, and green points to the picture's top.
# KHR_texture_transform, TANGENT and node; then where red and green of a texel point in the world.
CASES = {
    "upright": ({}, None, {}, X, Y),
    # Coordinates that turn counter-clockwise make a picture that turns clockwise.
    "turned by 90 degrees": ({"rotation": HALF_PI}, None, {}, -Y, X),
    "turned by 180 degrees": ({"rotation": np.pi}, None, {}, -X, -Y),
    "turned by 45 degrees": ({"rotation": np.pi / 4}, None, {}, unit(X - Y), unit(X + Y)),
    "mirrored in u": ({"scale": [-1, 1]}, None, {}, -X, Y),
    "mirrored in v": ({"scale": [1, -1]}, None, {}, X, -Y),
    "scaled, turned, mirrored": ({"scale": [2, -3], "rotation": HALF_PI}, None, {}, Y, X),
    "w = 1": ({}, (1, 0, 0, 1), {}, X, Y),
    "w = -1": ({}, (1, 0, 0, -1), {}, X, -Y),
    "along y, w = 1": ({}, (0, 1, 0, 1), {}, Y, -X),
    "along y, w = -1": ({}, (0, 1, 0, -1), {}, Y, X),
    "given tangents stand, however the texture turns": ({"rotation": HALF_PI}, (1, 0, 0, 1), {}, X, Y),
    "mirrored node": ({}, None, MIRRORED, -X, Y),
    "mirrored node, w = 1": ({}, (1, 0, 0, 1), MIRRORED, -X, Y),
    "mirrored node, w = -1": ({}, (1, 0, 0, -1), MIRRORED, -X, -Y),
    "mirrored node, turned by 90 degrees": ({"rotation": HALF_PI}, None, MIRRORED, -Y, -X),
    "mirrored node, mirrored in u": ({"scale": [-1, 1]}, None, MIRRORED, X, Y),
    "turned node": ({}, None, QUARTER_TURN, Y, -X),
    "turned node, w = -1": ({}, (1, 0, 0, -1), QUARTER_TURN, Y, X),
}
SIDES = (1.0, -1.0)
BUMP = quantized(np.array([0.8, 0.65, 0.85]))
STEEP_BUMP = quantized(np.array([0.85, 0.8, 0.7]))  # frames that are not made orthogonal show
DIRECTION = quantized(np.array([0.85, 0.3, 0.9]))
# Of normals in the G-buffer, from vertices whose tangents have 16 bits as well.
NORMAL_LIMIT = 4e-4


def slot(transform):
    return {"index": 0, "extensions": {"KHR_texture_transform": transform}}


def brushed(**anisotropy):
    return {
        "pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.45},
        "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.8} | anisotropy},
        "doubleSided": True,
    }


def brushed_lobe(strength):
    m = 0.45**2
    slopes = (m + (1 - m) * strength**2, m)
    return burnish.Material(lobes=[burnish.GgxLobe(slopes)])


def square(path, material, texels, tangent, node):
    images = [np.tile(texel, (4, 4, 1)) for texel in texels]
    extensions = ["KHR_texture_transform", "KHR_materials_anisotropy"]
    return write_quad(path / "quad.gltf", material, images, extensions, tangent, node)


def along(red, green, x, y, side):
    """Tangent (4,) of the line that has x along red and y along green, of a surface seen from `side`."""
    return [*unit(x * red + y * green), np.sign(side * np.cross(red, green)[2])]


def assert_brushed(device, scene, environment, strength, normal, tangent):
    view = np.array([0.0, 0.0, np.sign(normal[2])])
    sampler = burnish.Importance()
    got, _ = middle_color(device, scene, environment, sampler, view)
    levels = levels_of(device, environment, sampler)
    expected = oracle_shade(levels, brushed_lobe(strength), sampler, normal, tangent, view)
    np.testing.assert_allclose(got, expected, rtol=0, atol=LIMIT * expected.mean())


@pytest.mark.parametrize("case", CASES)
def test_normal_map_follows_the_table(device, smooth64, case, tmp_path):
    transform, tangent, node, red, green = CASES[case]
    material = {"doubleSided": True, "normalTexture": slot(transform)}
    scene = square(tmp_path, material, [BUMP], tangent, node)
    expected = unit((2 * BUMP - 1) @ [red, green, Z])
    for side in SIDES:
        _, frame = middle_color(device, scene, smooth64, burnish.Prefiltered(), side * Z)
        np.testing.assert_allclose(frame.normal[4, 4], side * expected, atol=NORMAL_LIMIT)


@pytest.mark.parametrize("case", CASES)
def test_anisotropy_texture_follows_the_table(device, smooth64, case, tmp_path):
    transform, tangent, node, red, green = CASES[case]
    material = brushed(anisotropyTexture=slot(transform))
    scene = square(tmp_path, material, [DIRECTION], tangent, node)
    x, y = 2 * DIRECTION[:2] - 1
    for side in SIDES:
        line = along(red, green, x, y, side)
        assert_brushed(device, scene, smooth64, 0.8 * DIRECTION[2], side * Z, line)


@pytest.mark.parametrize("case", [case for case in CASES if not CASES[case][0]])
@pytest.mark.parametrize("is_textured", [False, True], ids=["plain", "textured"])
def test_rotation_turns_from_red_to_green(device, smooth64, case, is_textured, tmp_path):
    _, tangent, node, red, green = CASES[case]
    angle = 0.6
    texture = {"anisotropyTexture": {"index": 0}} if is_textured else {}
    material = brushed(anisotropyRotation=angle, **texture)
    scene = square(tmp_path, material, [DIRECTION] if is_textured else [], tangent, node)
    if is_textured:
        angle += np.arctan2(*(2 * DIRECTION[1::-1] - 1))
    strength = 0.8 * (DIRECTION[2] if is_textured else 1.0)
    for side in SIDES:
        line = along(red, green, np.cos(angle), np.sin(angle), side)
        assert_brushed(device, scene, smooth64, strength, side * Z, line)


@pytest.mark.parametrize("case", ["upright", "w = -1", "turned by 90 degrees", "mirrored node, w = -1"])
def test_brushed_lobe_lies_on_the_bent_normal(device, smooth64, case, tmp_path):
    transform, tangent, node, red, green = CASES[case]
    material = brushed(anisotropyTexture={"index": 1}) | {"normalTexture": slot(transform)}
    scene = square(tmp_path, material, [STEEP_BUMP, DIRECTION], tangent, node)
    frame = [*red, np.sign(np.cross(red, green)[2])]
    normal = mapped_normal(Z, frame, STEEP_BUMP)
    line = brushed_tangent(normal, frame, DIRECTION)
    for side in SIDES:
        seen = line * [1, 1, 1, side]
        assert_brushed(device, scene, smooth64, 0.8 * DIRECTION[2], side * normal, seen)


def test_anisotropy_texture_is_read_in_the_frame_of_the_normal_map(device, smooth64, tmp_path):
    """There is one frame: where both textures turn, tangents follow the normal map's coordinates."""
    turned = {"index": 1, "extensions": {"KHR_texture_transform": {"rotation": HALF_PI}}}
    material = brushed(anisotropyTexture=turned) | {"normalTexture": slot({})}
    scene = square(tmp_path, material, [np.array([0.5, 0.5, 1.0]), DIRECTION], None, {})
    _, frame = middle_color(device, scene, smooth64, burnish.Prefiltered(), Z)
    line = along(X, Y, *(2 * DIRECTION[:2] - 1), 1.0)
    assert_brushed(device, scene, smooth64, 0.8 * DIRECTION[2], frame.normal[4, 4].astype(float), line)


def test_texture_may_make_the_roundest_factors_brushed(device, smooth64, tmp_path):
    """roughnessFactor 1 alone is round however anisotropic; a texture that lowers it brings the direction."""
    material = brushed()
    texel = quantized(np.array([1.0, 0.45, 1.0]))
    material["pbrMetallicRoughness"] = {"metallicRoughnessTexture": {"index": 0}}
    scene = square(tmp_path, material, [texel], (0.6, 0.8, 0, 1), {})
    sampler = burnish.Importance()
    m = texel[1] ** 2
    lobe = burnish.GgxLobe((m + (1 - m) * 0.8**2, m))
    got, frame = middle_color(device, scene, smooth64, sampler, Z)
    levels = levels_of(device, smooth64, sampler)
    expected = oracle_shade(levels, burnish.Material(lobes=[lobe]), sampler, Z, [0.6, 0.8, 0.0], Z)
    np.testing.assert_allclose(got, expected, rtol=0, atol=LIMIT * expected.mean())
    assert next(line["on"] for line in frame.report.effects if line["name"] == "anisotropy")


def plane(uv0):
    positions = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    normals = np.float32([[0, 0, 1]] * 4)
    return burnish.Mesh(positions, np.uint32([[0, 1, 2], [0, 2, 3]]), normals, uv0=uv0, name="plate")


def test_brushed_mesh_without_tangents_takes_them_from_its_texture_coordinates(device, smooth64):
    """The same mesh first with a round lobe, which asks for none."""
    diagonal = np.float32([[0, 1], [1, 2], [2, 1], [1, 0]]) / 2  # u grows along x + y
    scene = burnish.Scene()
    scene.add(plane(diagonal), burnish.Material(lobes=[burnish.KurtLobe(0.2)]))
    middle_color(device, scene, smooth64, burnish.Importance(), Z)
    scene.set_material(0, brushed_lobe(0.8))
    assert_brushed(device, scene, smooth64, 0.8, Z, [*unit(X + Y), 1.0])
    _, frame = middle_color(device, scene, smooth64, burnish.Importance(), Z)
    assert frame.report.warnings == []


def test_brushed_mesh_without_any_direction_is_reported(device, smooth64):
    scene = burnish.Scene()
    scene.add(plane(None), brushed_lobe(0.8))
    _, frame = middle_color(device, scene, smooth64, burnish.Importance(), Z)
    assert frame.report.warnings == [
        'mesh "plate": expected tangents or texture coordinates, got none: what is brushed on it follows the '
        "longitude around its y axis"
    ]
    scene.set_material(0, burnish.Material(lobes=[burnish.KurtLobe(0.2)]))
    _, frame = middle_color(device, scene, smooth64, burnish.Importance(), Z)
    assert frame.report.warnings == []

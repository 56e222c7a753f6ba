"""Layers share energy: what a lobe reflects does not reach what lies below it."""

import numpy as np
import pytest

import burnish
from burnish.oracle.metallic_roughness import MetallicRoughness, map_metallic_roughness
from burnish.oracle.shading import shade as oracle_shade
from engine_support import compare_radiance, lookup_error, random_points, views_about_z
from textured_quad import levels_of, middle_color, write_quad

FROM_ABOVE_TO_GRAZING = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0])
SAMPLERS = [
    burnish.Matched(5),
    burnish.Matched(14),
    burnish.Regular(14),
    burnish.Importance(64),
    burnish.Prefiltered(),
]
# Of importance sampling without a scale to the albedo, over a lobe of roughness .05 and more.
LIMITS = {burnish.Importance: 1.05}


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
@pytest.mark.parametrize("metallic", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("clearcoat", [0.0, 0.5, 1.0])
def test_white_furnace_never_gives_more_than_it_gets(device, uniform, sampler, metallic, clearcoat):
    views = views_about_z(FROM_ABOVE_TO_GRAZING, np.array([0.3]))
    for roughness in (0.05, 0.2, 0.5, 1.0):
        for coat_roughness in (0.0, 0.5) if clearcoat else (0.0,):
            material = burnish.Material.metallic_roughness(
                1.0, metallic, roughness, clearcoat=clearcoat, clearcoat_roughness=coat_roughness
            )
            got = burnish.shade(uniform, material, sampler, *views, device=device)
            assert got.max() <= LIMITS.get(type(sampler), 1.01) + lookup_error(device, 1.0)
            # A smooth white dielectric gives all of it back.
            if metallic == 0 and clearcoat == 0 and type(sampler) is burnish.Matched:
                np.testing.assert_allclose(got, 1.0, atol=1e-4 + lookup_error(device, 1.0))


@pytest.mark.parametrize(
    "sampler", [burnish.Matched(5), burnish.Regular(14), burnish.Prefiltered()], ids=repr
)
@pytest.mark.parametrize("clearcoat", [0.0, 1.0])
def test_white_cloth_never_gives_more_than_it_gets(device, uniform, sampler, clearcoat):
    """The published sheen of .1 alone gives back 1.6 of a grazing view's light."""
    views = views_about_z(FROM_ABOVE_TO_GRAZING, np.array([0.3]))
    for sheen_roughness in (0.1, 0.3, 0.6, 1.0):
        for metallic in (0.0, 1.0):
            material = burnish.Material.metallic_roughness(
                1.0, metallic, 0.5, clearcoat, sheen=1.0, sheen_roughness=sheen_roughness
            )
            assert len(material.lobes) == 2 + (clearcoat > 0)
            got = burnish.shade(uniform, material, sampler, *views, device=device)
            assert got.max() <= 1.01 + lookup_error(device, 1.0)
            if metallic == 0 and clearcoat == 0 and type(sampler) is burnish.Matched:
                assert got.min() >= 1.0 - 1e-3 - lookup_error(device, 1.0)


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(77), 120)


BY_HAND = burnish.Material(
    diffuse=(0.8, 0.6, 0.3),
    lobes=[
        burnish.GgxLobe((0.4, 0.2), r0=(0.3, 0.04, 0.5), f90=0.9, rotation=0.4),
        burnish.KurtLobe(0.3, r0=0.1, alpha=0.5, weight=(0.5, 0.7, 0.2), conserve_energy=True),
        burnish.GgxLobe(0.1, r0=0.04, weight=0.6),
        burnish.GgxLobe(0.5, r0=(0.2, 0.5, 0.1), f90=0.8, weight=0.3, compensate="scale"),
    ],
    emissive=(0.3, 0.2, 0.1),
    layered=True,
)
MAPPED = {"base_color": (0.8, 0.5, 0.2), "metallic": 0.3, "roughness": 0.6, "clearcoat": 0.7, "ior": 1.8,
          "clearcoat_roughness": 0.3, "specular": 0.8, "specular_color": (0.9, 0.7, 1.0), "anisotropy": 0.5,
          "anisotropy_rotation": 0.4}  # fmt: skip


@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Matched(14),
        burnish.Importance(20),
        burnish.Prefiltered(),
        burnish.Reference(method="quadrature"),
    ],
    ids=repr,
)
@pytest.mark.parametrize("material", ["by hand", "glTF's numbers", "glTF's numbers by Kurt", "glTF's cloth"])
def test_layers_equal_the_oracle(device, smooth64, points, sampler, material):
    if material == "by hand":
        given = expected_material = BY_HAND
    else:
        model = "kurt" if "Kurt" in material else "ggx"
        sheen = (0.6, 0.2, 0.4) if "cloth" in material else 0.0
        given = burnish.Material.metallic_roughness(
            **MAPPED, emissive=0.2, model=model, sheen=sheen, sheen_roughness=0.6
        )
        source = MetallicRoughness(**MAPPED, sheen_color=sheen, sheen_roughness=0.6)
        expected_material = map_metallic_roughness(source, 0.2, model)
    expected = oracle_shade(levels_of(device, smooth64, sampler), expected_material, sampler, *points)
    got = burnish.shade(smooth64, given, sampler, *points, device=device)
    compare_radiance(got, expected, 4e-3 if lookup_error(device, 1) == 0 else 2e-2, 0.03, 20)


@pytest.mark.parametrize("model", ["ggx", "kurt", "cloth"])
@pytest.mark.parametrize("sampler", [burnish.Matched(14), burnish.Prefiltered(), burnish.Regular()], ids=repr)
def test_a_texture_of_ones_changes_no_layer(device, smooth64, sampler, model, tmp_path):
    """Emission, diffuse part, base and coat in the textured kernel are those of the plain one."""
    material = {
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.8, 0.5, 0.2, 1],
            "metallicFactor": 0.3,
            "roughnessFactor": 0.6,
        },
        "emissiveFactor": [0.2, 0.1, 0.3],
        "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.4}},
    }
    extensions = ["KHR_materials_clearcoat"]
    if model == "cloth":
        model, extensions = "ggx", [*extensions, "KHR_materials_sheen"]
        sheen = {"sheenColorFactor": [0.6, 0.2, 0.4], "sheenRoughnessFactor": 0.5}
        material["extensions"]["KHR_materials_sheen"] = sheen
    plain = write_quad(tmp_path / "plain.gltf", material, [], extensions, model=model)
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
    textured = write_quad(tmp_path / "quad.gltf", material, [np.ones((4, 4, 3))], extensions, model=model)
    for view in ([0.0, 0.0, 1.0], [0.6, 0.3, 0.3], [0.9, 0.1, 0.15]):
        view = np.array(view) / np.linalg.norm(view)
        (got, _), (expected, _) = (
            middle_color(device, scene, smooth64, sampler, view) for scene in (textured, plain)
        )
        np.testing.assert_allclose(got, expected, rtol=1.5e-2)


def test_layers_are_an_effect_of_what_lies_over_something(device, uniform):
    def layers(material):
        scene = burnish.Scene.sphere(material)
        scene.environment = uniform
        report = burnish.render(scene, size=(8, 8), sampler=burnish.Matched(5), device=device).report
        return next(line for line in report.effects if line["name"] == "layers")

    lobe = burnish.GgxLobe(0.2)
    assert layers(burnish.Material(0.5, [lobe], layered=True))["on"]
    assert layers(burnish.Material(0.0, [lobe, lobe], layered=True))["on"]
    assert not layers(burnish.Material(0.0, [lobe], emissive=1.0, layered=True))["on"]  # of its own surface
    alone = layers(burnish.Material(0.5, [lobe]))
    assert not alone["on"] and alone["reason"] == "no material is layered"


def test_emission_lies_below_a_coat_alone(device):
    black = burnish.Environment.from_faces(np.zeros((6, 1, 1, 3), np.float32))
    views = views_about_z(np.array([0.1, 0.5, 1.0]), np.array([0.0]))

    def emitted(**numbers):
        material = burnish.Material.metallic_roughness(emissive=2.0, **numbers)
        return burnish.shade(black, material, burnish.Matched(5), *views, device=device)[:, 0]

    np.testing.assert_allclose(emitted(), 2.0, rtol=1e-6)
    coated = emitted(clearcoat=1.0)
    schlick = 0.04 + 0.96 * (1 - np.array([0.1, 0.5, 1.0])) ** 5
    np.testing.assert_allclose(coated, 2.0 * (1 - schlick), atol=0.02)
    # A coat over a surface that reflects nothing itself.
    np.testing.assert_allclose(emitted(clearcoat=1.0, specular=0.0), coated, rtol=1e-5)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
@pytest.mark.parametrize("roughness", [0.1, 0.5, 1.0, (1.0, 0.3)], ids=str)
def test_compensated_metal_gives_back_all_it_gets(device, uniform, sampler, roughness):
    views = views_about_z(FROM_ABOVE_TO_GRAZING[1:], np.array([0.3, 1.2]))

    def albedo(**numbers):
        material = burnish.Material(lobes=[burnish.GgxLobe(roughness, **numbers)])
        return burnish.shade(uniform, material, sampler, *views, device=device)

    # Importance sampling sums with its own error.
    limit = 0.05 if type(sampler) is burnish.Importance else 5e-3
    np.testing.assert_allclose(albedo(compensate="scale"), 1.0, atol=limit + lookup_error(device, 1.0))
    half, lost = albedo(r0=0.5, f90=0.5, compensate="scale"), albedo()
    np.testing.assert_allclose(half, 0.5 * lost * (1 + 1.0 * (1 / lost - 1)), atol=limit)
    if roughness == 1.0:
        assert lost.min() < 0.5


def test_compensation_has_two_forms():
    assert burnish.GgxLobe(0.2).compensate == "none"
    assert "compensate='scale'" in repr(burnish.GgxLobe(0.2, compensate="scale"))
    with pytest.raises(ValueError, match="compensate: expected 'none' or 'scale', got 'kulla-conty'"):
        burnish.GgxLobe(0.2, compensate="kulla-conty")


def test_covers_say_what_a_lobe_takes():
    assert burnish.Material(0.5, [burnish.GgxLobe(0.2)]).covers is None
    assert burnish.Material(0.5, [burnish.GgxLobe(0.2)] * 2, layered=True).covers == (
        (None, False),
        (None, True),
    )
    material = burnish.Material.metallic_roughness(specular=0.5, clearcoat=1.0)
    (share, is_over_emission), coat = material.covers
    assert material.layered and not is_over_emission and coat == (None, True)
    np.testing.assert_allclose(share, (0.02, 0.48), rtol=1e-5)
    assert not burnish.Material.metallic_roughness(model="kurt").layered


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"metallic": 1.5}, r"source.metallic: expected 0..1, got 1.5"),
        ({"base_color": (0.5, -0.1, 0.5)}, r"source.base_color: expected 0..1"),
        ({"roughness": float("nan")}, r"source.roughness: expected 0..1, got nan"),
        ({"ior": 0.5}, r"source.ior: expected 0 or a finite number >= 1, got 0.5"),
        ({"model": "phong"}, r"model: expected 'ggx' or 'kurt', got 'phong'"),
    ],
)
def test_numbers_out_of_range_are_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        burnish.Material.metallic_roughness(**wrong)

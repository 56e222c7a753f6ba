"""Every model of lobe on every sampler against the oracle: a new model is one entry of MODELS."""

import numpy as np
import pytest

import burnish
from burnish import _core
from burnish.environments import sky
from burnish.lobes import width_of
from burnish.oracle.albedo import blend_albedo
from burnish.oracle.cube_map import pad_cube
from burnish.oracle.estimator import Reference
from burnish.oracle.lobe.base import grazing_reflectance, normal_reflectance, rotation_of
from burnish.oracle.lobe.models import model_of
from burnish.oracle.matched import MatchedMap
from burnish.oracle.shading import shade as oracle_shade
from burnish.oracle.shading import shade_matched_lobes
from burnish.oracle.sun_split import split_suns
from engine_support import compare_radiance, lookup_error, random_points, views_about_z

MODELS = {
    "Kurt": {
        "round": burnish.KurtLobe(0.1),
        "dielectric": burnish.KurtLobe(0.4, r0=0.04, alpha=0.5),
        "brushed": burnish.KurtLobe((0.3, 0.1), r0=(0.9, 0.5, 0.04), weight=(0.5, 1, 0.2), rotation=0.7),
    },
    "GGX": {
        "narrow": burnish.GgxLobe(0.02),
        "round": burnish.GgxLobe(0.1),
        "dielectric": burnish.GgxLobe(0.3, r0=0.04, f90=0.8),
        "wide": burnish.GgxLobe(0.9),
        "brushed": burnish.GgxLobe((0.3, 0.1), r0=(0.9, 0.5, 0.04), weight=(0.5, 1, 0.2), rotation=0.7),
        "brushed across": burnish.GgxLobe((0.05, 0.6), r0=0.04),
    },
    "Lafortune": {
        "phong": burnish.PhongLobe(40.0),
        "mirror": burnish.PhongLobe(1e4, weight=(1, 0.5, 0.2)),
        "back": burnish.LafortuneLobe((0.9, 0.9, 0.7), 3.0, weight=(0.5, 1, 0.2)),
        "brushed": burnish.LafortuneLobe((-1.1, -0.4, 0.8), 12.0, rotation=0.7),
        "uniform": burnish.LafortuneLobe(exponent=0.0, weight=0.2),
    },
    "Sheen": {
        "rough": burnish.SheenLobe(0.9, weight=(0.5, 1, 0.2)),
        "smooth": burnish.SheenLobe(0.3),
    },
}
LOBES = {f"{model}, {name}": lobe for model, lobes in MODELS.items() for name, lobe in lobes.items()}
# Relative to a point's radiance, or the mean where that is more; see test_matched_vs_oracle.
LIMIT, LIMIT_HARDWARE = 1e-3, 2e-2
SHARE_BEYOND, FACTOR_BEYOND = 0.03, 50


@pytest.fixture(scope="module")
def points():
    return random_points(np.random.default_rng(31), 160)


def compare(device, got, expected):
    limit = LIMIT if lookup_error(device, 1) == 0 else LIMIT_HARDWARE
    compare_radiance(got, expected, limit, SHARE_BEYOND, FACTOR_BEYOND)


def shade(device, environment, lobes, sampler, points):
    return burnish.shade(environment, burnish.Material(lobes=lobes), sampler, *points, device=device)


@pytest.mark.parametrize("name", LOBES)
@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Importance(14),
        burnish.Importance(100, points="fibonacci", mip_bias=-0.5),
        burnish.Regular(20),
        burnish.Regular(14, normalization="projected", mip_bias=0.5),
        burnish.Regular(14, threshold=1e-7),
    ],
    ids=["importance", "importance in a loop", "regular", "regular projected", "regular to the end"],
)
def test_patterns_equal_the_oracle(device, spots64, points, name, sampler):
    material = burnish.Material(lobes=[LOBES[name]])
    expected = oracle_shade(spots64.pyramid("gauss6", device=device), material, sampler, *points)
    compare(device, shade(device, spots64, material.lobes, sampler, points), expected)


@pytest.mark.parametrize("name", LOBES)
@pytest.mark.parametrize("samples", [2, 5, 14, 64])
def test_matched_equals_the_oracle(device, spots64, points, name, samples):
    material = burnish.Material(lobes=[LOBES[name]])
    levels = _core.environment_spherical(device, spots64, "gauss6")
    expected = shade_matched_lobes(MatchedMap(pad_cube(levels)), material, samples, *points)
    compare(device, shade(device, spots64, material.lobes, burnish.Matched(samples), points), expected)


@pytest.mark.parametrize("name", LOBES)
def test_prefiltered_equals_the_oracle(device, spots64, points, name):
    material = burnish.Material(lobes=[LOBES[name]])
    levels = [level for _, level in _core.environment_prefiltered(device, spots64, "gauss6")]
    expected = oracle_shade(levels, material, burnish.Prefiltered(), *points)
    compare(device, shade(device, spots64, material.lobes, burnish.Prefiltered(), points), expected)


@pytest.mark.parametrize("name", LOBES)
def test_quadrature_equals_the_oracle(device, spots64, points, name):
    material = burnish.Material(lobes=[LOBES[name]])
    few = tuple(p[:60] for p in points)
    expected = oracle_shade([spots64.faces], material, Reference(), *few)
    got = shade(device, spots64, material.lobes, burnish.Reference(method="quadrature"), few)
    compare(device, got, expected)


# Narrower than a texel: quadrature takes a texel's middle for all of it.
WIDE = [name for name, lobe in LOBES.items() if min(width_of(lobe)) > 0.03]


@pytest.mark.parametrize("name", WIDE)
@pytest.mark.filterwarnings("ignore:the reference stopped")
def test_progressive_is_quadrature(device, spots64, points, name):
    """Both parts of the sampling are right: the lobe's own, and its density against the map's."""
    few = tuple(p[:60] for p in points)
    lobes = [LOBES[name]]
    exact = shade(device, spots64, lobes, burnish.Reference(method="quadrature"), few)
    sampler = burnish.Reference(0.002, method="progressive", max_samples=8192)
    got = shade(device, spots64, lobes, sampler, few)
    # A lookup between texels is a blur of them: the difference of single points is of the map, not of chance.
    assert got.mean() == pytest.approx(exact.mean(), rel=0.02)
    np.testing.assert_allclose(got, exact, rtol=0.25, atol=0.1 * exact.mean())


@pytest.mark.parametrize("name", LOBES)
@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Matched(5),
        burnish.Regular(14),
        burnish.Prefiltered(),
        burnish.Reference(0.001, method="quadrature"),
    ],
    ids=["matched", "regular", "prefiltered", "reference"],
)
def test_a_white_map_shows_the_albedo(device, uniform, name, sampler):
    lobe = LOBES[name]
    views = views_about_z(np.linspace(0.05, 1, 12), np.linspace(0, np.pi / 2, 5))
    is_sum = type(sampler) is burnish.Reference
    if is_sum and min(width_of(lobe)) < 0.25:
        return  # a sum over 64 points along a face is for lobes wider than they are
    rotation = rotation_of(lobe)
    got = shade(device, uniform, [lobe], sampler, views)
    o = np.asarray(views[2], float)
    cos, sin = np.cos(rotation), np.sin(rotation)
    local = o @ np.array([[cos, -sin, 0], [sin, cos, 0], [0, 0, 1.0]])
    albedo = blend_albedo(
        model_of(lobe).albedo(local, lobe), normal_reflectance(lobe), grazing_reflectance(lobe)
    )
    np.testing.assert_allclose(got, albedo * np.asarray(lobe.weight), rtol=2e-2 if is_sum else 3e-3)


@pytest.mark.parametrize("name", LOBES)
def test_suns_equal_the_oracle(device, points, name):
    environment = sky(face_size=128)
    suns, filled = split_suns(environment.faces)
    assert len(suns) == 1
    rest = burnish.Environment.from_faces(np.float32(filled))
    levels = _core.environment_spherical(device, rest, "gauss6")
    material = burnish.Material(lobes=[LOBES[name]])
    expected = shade_matched_lobes(MatchedMap(pad_cube(levels), suns), material, 14, *points)
    compare(device, shade(device, environment, material.lobes, burnish.Matched(14), points), expected)


@pytest.mark.parametrize(
    "sampler", [burnish.Matched(5), burnish.Importance(14), burnish.Regular(14)], ids=repr
)
def test_models_share_a_material(device, spots64, points, sampler):
    lobes = [MODELS["GGX"]["round"], MODELS["Kurt"]["brushed"], MODELS["GGX"]["dielectric"]]
    alone = sum(shade(device, spots64, [lobe], sampler, points).astype(float) for lobe in lobes)
    compare(device, shade(device, spots64, lobes, sampler, points), alone)


def test_models_share_a_picture(device, spots64):
    """A sphere beside one of another model looks as it does beside one of its own."""
    lobes = [MODELS["GGX"]["round"], MODELS["Kurt"]["round"]]

    def draw(*chosen):
        scene = burnish.Scene.spheres([burnish.Material(lobes=[lobe]) for lobe in chosen], 2)
        scene.environment = spots64
        return burnish.render(scene, size=(40, 80), sampler=burnish.Matched(5), device=device).color

    ggx, kurt = (draw(lobe, lobe) for lobe in lobes)
    both = draw(*lobes)
    np.testing.assert_allclose(both[:, :40], ggx[:, :40], rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(both[:, 40:], kurt[:, 40:], rtol=1e-5, atol=1e-5)


# Of every window of Student's density; too brushed for a table by view.
AT_POINTS = {
    "narrow": burnish.GgxLobe((0.1, 0.004)),
    "middle": burnish.GgxLobe((0.02, 0.35), r0=(0.9, 0.5, 0.04), f90=0.8, weight=(0.5, 1, 0.2), rotation=0.7),
    "wide": burnish.GgxLobe((1.0, 0.05), r0=0.04),
}


@pytest.mark.parametrize("name", AT_POINTS)
@pytest.mark.parametrize("samples", [5, 64])
def test_mixtures_at_points_equal_the_oracle(device, spots64, points, name, samples):
    material = burnish.Material(lobes=[AT_POINTS[name]])
    levels = _core.environment_spherical(device, spots64, "gauss6")
    light_map = MatchedMap(pad_cube(levels))
    expected = shade_matched_lobes(light_map, material, samples, *points, "wide point")
    compare(device, shade(device, spots64, material.lobes, burnish.Matched(samples), points), expected)


def test_tables_by_view_beyond_their_memory_give_way_to_points(device, spots64):
    """Few lobes have tables, many of them are placed at points: pictures differ by what that changes."""
    lobes = [burnish.GgxLobe((0.3, 0.1 + 0.001 * k), r0=0.04) for k in range(8)]

    def draw(chosen):
        scene = burnish.Scene.spheres([burnish.Material(lobes=[lobe]) for lobe in chosen], 4)
        scene.environment = spots64
        return burnish.render(scene, size=(48, 96), sampler=burnish.Matched(64), device=device)

    # The upper row of spheres is of the same lobes in both.
    few, many = (draw(chosen).color[:24] for chosen in (lobes[:4] * 2, lobes))
    assert np.mean(many != few) > 0.1
    assert np.sqrt(np.sum((many - few) ** 2) / np.sum(few**2)) < 0.01


@pytest.mark.parametrize("wrong", [{"normalization": "published"}, {"footprint": "published"}])
def test_printed_forms_are_refused_where_none_is_printed(device, spots64, points, wrong):
    sampler = burnish.Regular(14, **wrong)
    with pytest.raises(ValueError, match='expected others than "published" for a GGX lobe'):
        shade(device, spots64, [burnish.GgxLobe(0.2)], sampler, points)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"roughness": 0.0}, "roughness: expected"),
        ({"roughness": float("nan")}, "roughness: expected"),
        ({"roughness": 1.5}, "roughness: expected"),
        ({"r0": 1.5}, "r0: expected 0..1, got 1.5"),
        ({"f90": -0.5}, "f90: expected 0..1, got -0.5"),
        ({"weight": -1.0}, "weight: expected"),
        ({"rotation": float("inf")}, "rotation: expected a finite number"),
    ],
)
def test_numbers_out_of_range_are_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        burnish.GgxLobe(**wrong)


@pytest.mark.parametrize("roughness", [1e-6, 1e-3, (1e-3, 1.0), (1.0, 1e-3), 1.0], ids=str)
@pytest.mark.parametrize(
    "sampler",
    [burnish.Matched(5), burnish.Regular(14), burnish.Importance(14), burnish.Prefiltered()],
    ids=["matched", "regular", "importance", "prefiltered"],
)
def test_hard_lobes_are_finite_from_every_view(device, spots64, roughness, sampler):
    lobe = burnish.GgxLobe(roughness, r0=0.04)
    views = views_about_z(
        np.array([0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]), np.linspace(0, 2 * np.pi, 9)
    )
    got = shade(device, spots64, [lobe], sampler, views)
    assert np.isfinite(got).all() and got.min() >= 0
    assert got.max() <= 1.2 * spots64.faces.max()


HARD_DIRECTIONS = {
    "uniform": burnish.PhongLobe(0.0),
    "mirror": burnish.PhongLobe(1e6),
    "long": burnish.LafortuneLobe((-1.4, -1.4, 1.4), 300.0, weight=1e-30),
    "short": burnish.LafortuneLobe((-0.5, -0.5, 0.5), 1000.0),
    "below the horizon": burnish.LafortuneLobe((-1, -1, -1), 20.0),
    "nowhere": burnish.LafortuneLobe((0, 0, 0), 5.0),
    "along the tangent": burnish.LafortuneLobe((1, 0, 0), 30.0),
    "largest": burnish.LafortuneLobe((-1e3, -1e3, 1e3), 1e6, weight=1e-30),
    "smoothest cloth": burnish.SheenLobe(0.0),
    "roughest cloth": burnish.SheenLobe(1.0),
}


@pytest.mark.parametrize("name", HARD_DIRECTIONS)
def test_hard_lobes_of_directions_are_finite_from_every_view(device, spots64, name):
    views = views_about_z(
        np.array([0.0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0]), np.linspace(0, 2 * np.pi, 9)
    )
    scene = burnish.Scene()
    scene.lights = [burnish.DirectionalLight((0, -1, -1), angle=0.1), burnish.DirectionalLight((0, 0, -1))]
    for sampler in (burnish.Matched(5), burnish.Regular(14), burnish.Importance(14), burnish.Prefiltered()):
        material = burnish.Material(lobes=[HARD_DIRECTIONS[name]])
        got = burnish.shade(
            spots64, material, sampler, *views, device=device, scene=scene, strict=name != "largest"
        )
        assert np.isfinite(got).all() and got.min() >= 0


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"exponent": -1.0}, "exponent: expected"),
        ({"exponent": float("nan")}, "exponent: expected"),
        ({"c": (0, float("inf"), 0)}, "c: expected"),
        ({"weight": -1.0}, "weight: expected"),
        ({"rotation": float("nan")}, "rotation: expected a finite number"),
    ],
)
def test_numbers_of_lafortune_out_of_range_are_refused(wrong, message):
    with pytest.raises(ValueError, match=message):
        burnish.LafortuneLobe(**wrong)


def test_numbers_of_sheen_out_of_range_are_refused():
    with pytest.raises(ValueError, match=r"roughness: expected 0..1, got 1.5"):
        burnish.SheenLobe(1.5)
    with pytest.raises(ValueError, match=r"weight: expected finite numbers >= 0, got -1"):
        burnish.SheenLobe(0.5, -1.0)

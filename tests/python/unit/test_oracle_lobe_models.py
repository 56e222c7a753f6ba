"""Every model of lobe: its plane, values and albedo agree with each other; GGX's with golden numbers."""

import numpy as np
import pytest

from burnish.oracle.albedo import blend_albedo
from burnish.oracle.arrays import dot, normalize
from burnish.oracle.cube_map import pad_cube, texel_directions
from burnish.oracle.estimator import Importance, Regular, local_frame
from burnish.oracle.lobe.base import grazing_reflectance, normal_reflectance
from burnish.oracle.lobe.base import slopes as slopes_of
from burnish.oracle.lobe.ggx import GgxLobe, ggx_brdf, ggx_d, ggx_pdf_omega_i, ggx_sample
from burnish.oracle.lobe.kurt import KurtLobe, kurt_brdf
from burnish.oracle.lobe.lafortune import LafortuneLobe, lafortune_brdf
from burnish.oracle.lobe.models import model_of
from burnish.oracle.lobe.sheen import SheenLobe, sheen_brdf
from burnish.oracle.plane import plane_density, plane_points, shade_plane
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.sun_split import Sun, shade_suns

BRDF = {
    "KurtLobe": kurt_brdf,
    "GgxLobe": ggx_brdf,
    "LafortuneLobe": lafortune_brdf,
    "SheenLobe": sheen_brdf,
}
LOBES = {
    "Kurt, narrow": KurtLobe(0.1),
    "Kurt, brushed dielectric": KurtLobe((0.4, 0.1), 0.04, 0.5),
    "GGX, narrow": GgxLobe(0.1),
    "GGX, wide": GgxLobe(0.8, (0.9, 0.5, 0.04)),
    "GGX, brushed dielectric": GgxLobe((0.4, 0.1), 0.04, 0.5),
    "Phong": LafortuneLobe(exponent=40.0),
    "Lafortune, back": LafortuneLobe((0.9, 0.9, 0.7), 3.0),
    "Lafortune, brushed": LafortuneLobe((-1.1, -0.4, 0.8), 12.0),
    "sheen": SheenLobe(0.5),
}


@pytest.fixture
def views(rng):
    """Local views from 3 degrees above the horizon to the normal."""
    cosine, azimuth = rng.uniform(0.05, 1, 40), rng.uniform(0, 2 * np.pi, 40)
    sine = np.sqrt(1 - cosine**2)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=-1)


@pytest.fixture
def places(rng):
    """Places of the plane, in units of the lobe's widths."""
    return rng.normal(size=(40, 2)) * 0.7


def differences(lobe, views, slopes, step=1e-6):
    """Change of the direction for a unit of slope along x and y, (n, 3, 2)."""
    model = model_of(lobe)
    moved = [
        (model.reflect(views, lobe, slopes + d).omega_i - model.reflect(views, lobe, slopes - d).omega_i)
        / (2 * step)
        for d in step * np.eye(2)
    ]
    return np.stack(moved, axis=-1)


@pytest.mark.parametrize("name", LOBES)
def test_stretch_is_the_area_that_directions_cover(name, views, places):
    lobe = LOBES[name]
    slopes = places * slopes_of(lobe)
    change = differences(lobe, views, slopes)
    area = np.linalg.norm(np.cross(change[..., 0], change[..., 1]), axis=-1)
    stretch = model_of(lobe).stretch(views, lobe, slopes, slopes)
    above = model_of(lobe).reflect(views, lobe, slopes).base > 0
    assert above.sum() > 20
    np.testing.assert_allclose(stretch[above], area[above], rtol=1e-5)


@pytest.mark.parametrize("name", LOBES)
def test_linear_map_is_the_derivative_of_the_direction(name, views):
    lobe, middle = LOBES[name], np.zeros((len(views), 2))
    change = differences(lobe, views, middle)
    linear = model_of(lobe).linear_map(views, lobe, middle, np.broadcast_to(np.eye(2), (len(views), 2, 2)))
    # Bases across the direction differ by a turn.
    np.testing.assert_allclose(
        np.swapaxes(linear, -1, -2) @ linear, np.swapaxes(change, -1, -2) @ change, rtol=1e-5, atol=1e-7
    )


@pytest.mark.parametrize("name", LOBES)
def test_a_plane_has_the_reflectance(name, views, places):
    """base K is f cos_i times the stretch, Fresnel apart."""
    lobe, model = LOBES[name], model_of(LOBES[name])
    slopes = places * slopes_of(lobe)
    light = model.reflect(views, lobe, slopes)
    lit = light.base > 0
    fresnel = blend_albedo(
        np.stack([np.ones_like(light.schlick), light.schlick], -1),
        normal_reflectance(lobe),
        grazing_reflectance(lobe),
    )
    stretch = model.stretch(views, lobe, slopes, slopes) * np.prod(slopes_of(lobe))
    value = (light.base * plane_density(places, model.DENSITY))[..., None] * fresnel
    brdf = BRDF[type(lobe).__name__](light.omega_i, views, lobe) * (
        light.omega_i[..., 2:] * stretch[..., None]
    )
    np.testing.assert_allclose(value[lit], brdf[lit], rtol=1e-9)


@pytest.mark.parametrize("name", LOBES)
def test_values_are_the_reflectance(name, views, rng):
    lobe = LOBES[name]
    directions = normalize(rng.normal((0.0, 0.0, 1.0), size=(400, 3)))
    directions = directions[directions[:, 2] > 0]
    for view in views[:8]:
        values = model_of(lobe).values(directions.T, view, lobe)
        fresnel = blend_albedo(
            np.stack([np.ones_like(values.o_h), (1 - values.o_h) ** 5], -1),
            normal_reflectance(lobe),
            grazing_reflectance(lobe),
        )
        near = directions[values.near]
        expected = BRDF[type(lobe).__name__](near, view, lobe) * near[:, 2:]
        np.testing.assert_allclose(values.value[:, None] * fresnel, expected, rtol=1e-9, atol=1e-14)


@pytest.mark.parametrize("name", LOBES)
def test_the_albedo_is_the_light_that_a_white_map_gives(name, views):
    lobe = LOBES[name]
    n = np.broadcast_to([0.0, 0.0, 1.0], views.shape)
    t = np.broadcast_to([1.0, 0.0, 0.0], views.shape)
    steep = views[:, 2] > 0.2
    truth = shade_reference(np.ones((6, 256, 256, 3)), n[steep], t[steep], views[steep], lobe)
    albedo = blend_albedo(
        model_of(lobe).albedo(views[steep], lobe), normal_reflectance(lobe), grazing_reflectance(lobe)
    )
    np.testing.assert_allclose(truth, albedo, rtol=2e-3)


@pytest.mark.parametrize("name", LOBES)
def test_many_points_of_a_plane_are_the_truth(name, views):
    d = texel_directions(32)
    faces = 1 + 0.4 * d + 0.3 * d[..., [1, 2, 0]] * d[..., [2, 0, 1]]
    lobe, steep = LOBES[name], views[views[:, 2] > 0.2]
    n, t = (np.broadcast_to(v, steep.shape) for v in ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]))
    truth = shade_reference(faces, n, t, steep, lobe, parts=4)
    cube = pad_cube(build_pyramid(faces))
    for sampler, limit in ((Importance(2048, "fibonacci"), 6e-3), (Regular(1000, threshold=1e-4), 6e-3)):
        got = shade_plane(cube, n, t, steep, lobe, sampler)
        np.testing.assert_allclose(got, truth, rtol=limit, err_msg=str(sampler))


def test_points_of_a_plane_have_its_area(rng):
    for lobe in LOBES.values():
        p, area = plane_points(Importance(4000, "fibonacci"), lobe)
        share = area * plane_density(p, model_of(lobe).DENSITY)
        assert np.sum(share) == pytest.approx(1, abs=1e-12)
        p, area = plane_points(Regular(2000, threshold=0.01), lobe)
        # K falls to a hundredth at the edge: a Gaussian has .99 within, Student's density 1 - .01^1/2.
        inside = 0.99 if model_of(lobe).DENSITY == "gaussian" else 0.9
        assert np.sum(area * plane_density(p, model_of(lobe).DENSITY)) == pytest.approx(inside, abs=0.02)


# E1 and E5 of height-correlated GGX at these cosines of the view (float64 quadrature, +- 1e-6).
COSINES = np.array([0.05, 0.1, 0.3, 0.5, 0.7, 1.0])
GOLDEN = {
    0.01: ([0.976208, 0.994124, 0.999361, 0.999742, 0.999845, 0.999898], [0.733660, 0.578354, 0.167620]),
    0.1: ([0.911765, 0.883457, 0.936252, 0.969205, 0.981418, 0.988304], [0.345814, 0.300913, 0.130186]),
    0.3: ([0.931421, 0.888804, 0.818123, 0.821711, 0.844531, 0.877360], [0.135849, 0.114622, 0.053245]),
    0.6: ([0.900186, 0.841028, 0.707447, 0.642666, 0.609686, 0.591522], [0.060128, 0.048229, 0.020287]),
    1.0: ([0.847773, 0.760211, 0.560100, 0.450693, 0.378888, 0.306853], [0.032090, 0.023867, 0.008449]),
}


def views_at(cosines, azimuth=0.0):
    sine = np.sqrt(1 - cosines**2)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosines], axis=-1)


@pytest.mark.parametrize("alpha", GOLDEN)
def test_ggx_albedo_has_the_golden_values(alpha):
    albedo = model_of(GgxLobe(alpha)).albedo(views_at(COSINES), GgxLobe(alpha))
    first, schlick = GOLDEN[alpha]
    np.testing.assert_allclose(albedo[:, 0], first, atol=3e-4)
    np.testing.assert_allclose(albedo[:3, 1], schlick, atol=3e-4)


def test_ggx_albedo_of_alpha_1_is_closed():
    albedo = model_of(GgxLobe(1.0)).albedo(views_at(COSINES), GgxLobe(1.0))[:, 0]
    np.testing.assert_allclose(albedo, 1 - COSINES * np.log(1 + 1 / COSINES), atol=1e-4)


def test_brushed_ggx_albedo_has_the_golden_values():
    lobe, cosines = GgxLobe((0.2, 0.05)), np.array([0.1, 0.3, 0.7])
    for azimuth, golden in ((0.0, [0.9081, 0.8845, 0.9483]), (np.pi / 2, [0.8852, 0.9554, 0.9701])):
        albedo = model_of(lobe).albedo(views_at(cosines, azimuth), lobe)[:, 0]
        np.testing.assert_allclose(albedo, golden, atol=2e-4)


def test_ggx_is_reciprocal(views, rng):
    other = views[rng.permutation(len(views))]
    lobe = GgxLobe((0.4, 0.1), 0.04)
    np.testing.assert_allclose(ggx_brdf(other, views, lobe), ggx_brdf(views, other, lobe), rtol=1e-9)


def test_ggx_samples_have_their_density(rng):
    """The mean of a smooth function over samples is its integral under the density."""
    ax, ay = 0.5, 0.2
    view = views_at(np.array([0.3]), 0.7)[0]
    h = ggx_sample(view, rng.random(400_000), rng.random(400_000), ax, ay)
    drawn = 2 * dot(view, h)[:, None] * h - view
    directions = normalize(rng.normal(size=(1_000_000, 3)))
    half = normalize(directions + view)
    half *= np.sign(half[:, 2:])
    density = ggx_pdf_omega_i(half, view, ax, ay) * (dot(view, half) > 0)
    for power in ([1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]):
        smooth = np.prod(np.asarray(power) * drawn + (1 - np.asarray(power)), axis=-1)
        wanted = np.prod(np.asarray(power) * directions + (1 - np.asarray(power)), axis=-1)
        assert np.mean(smooth) == pytest.approx(4 * np.pi * np.mean(wanted * density), abs=0.02)


def test_ggx_d_integrates_to_one_over_projected_normals():
    for ax, ay in ((0.3, 0.3), (0.8, 0.2)):
        slope = np.sinh(np.linspace(-9, 9, 1201))
        x, y = np.meshgrid(slope, slope)
        g = np.stack([x, y, np.ones_like(x)], axis=-1)
        h = normalize(g)
        weight = (
            np.outer(np.cosh(np.linspace(-9, 9, 1201)), np.cosh(np.linspace(-9, 9, 1201))) * (18 / 1200) ** 2
        )
        # dh = cos_h^3 ds.
        assert np.sum(ggx_d(h, ax, ay) * h[..., 2] ** 4 * weight) == pytest.approx(1, abs=2e-3)


@pytest.mark.parametrize("name", ["GGX, narrow", "GGX, brushed dielectric", "Kurt, narrow"])
def test_a_lobe_under_a_sun_is_that_of_many_points_of_it(name, views, rng):
    """From the peak to where a hundredth of it is left a wider lobe is within 15 % of a mean over the sun."""
    lobe = LOBES[name]
    view = views[views[:, 2] > 0.3][:1]
    spread = 0.02
    frame = local_frame(np.array([[0.0, 0.0, 1.0]]), np.array([[1.0, 0.0, 0.0]]), view)
    mirror = view[0] * [-1, -1, 1]
    for shift in (0.0, 0.05, 0.1, 0.2):
        middle = normalize(mirror + shift * np.array([0.6, -0.3, 0.7]))
        points = normalize(middle + spread * rng.normal(size=(20_000, 3)))
        truth = np.mean(BRDF[type(lobe).__name__](points, view, lobe) * np.maximum(points[:, 2:], 0), axis=0)
        got = shade_suns([Sun(middle, np.ones(3), spread**2)], frame, lobe)[0]
        np.testing.assert_allclose(got, truth, rtol=0.15)


# H(c, n), the mean of the cosine over a power lobe whose axis has the cosine c (+-2e-6).
LAFORTUNE_COSINES = np.array([-0.3, 0.0, 0.1, 0.3, 0.7, 1.0])
LAFORTUNE_GOLDEN = {
    0.5: (0.144036, 0.228828, 0.259401, 0.324036, 0.468972, 0.6),
    1: (0.121830, 0.212207, 0.246602, 0.321830, 0.500060, 0.666667),
    10: (0.023164, 0.112793, 0.164229, 0.298164, 0.641947, 0.916667),
    100: (0.000028, 0.039405, 0.107150, 0.297087, 0.693137, 0.990196),
}


@pytest.mark.parametrize("exponent", LAFORTUNE_GOLDEN)
def test_lafortune_albedo_has_the_golden_values(exponent):
    """Of c = (1, 1, 1) the axis is the view; one below the horizon is that of c = (1, 1, -1)."""
    for cosine, golden in zip(LAFORTUNE_COSINES, LAFORTUNE_GOLDEN[exponent], strict=True):
        lobe = LafortuneLobe((1.0, 1.0, np.sign(cosine) or 1.0), exponent)
        view = views_at(np.abs(np.array([cosine])))
        got = model_of(lobe).albedo(view, lobe)[0, 0] * (exponent + 1) / (2 * np.pi)
        assert got == pytest.approx(golden, abs=4e-6)


SHEEN_GOLDEN = {
    0.07: (0.733510, 0.545766, 0.197578, 0.067878, 0.018416, 0.000257),
    0.3: (0.693220, 0.583653, 0.344337, 0.210523, 0.124610, 0.039083),
    1: (0.827248, 0.720510, 0.490911, 0.356289, 0.264321, 0.163764),
}


@pytest.mark.parametrize("alpha", SHEEN_GOLDEN)
def test_sheen_albedo_has_the_golden_values(alpha):
    lobe = SheenLobe(alpha**0.5)
    albedo = model_of(lobe).albedo(views_at(np.array([0.05, 0.1, 0.3, 0.5, 0.7, 1.0])), lobe)[:, 0]
    np.testing.assert_allclose(albedo, SHEEN_GOLDEN[alpha], rtol=1e-3, atol=1e-5)


def test_lafortune_and_sheen_are_reciprocal(views, rng):
    other = views[rng.permutation(len(views))]
    for lobe in (LafortuneLobe((-1.1, -0.4, 0.8), 12.0), SheenLobe(0.4)):
        brdf = BRDF[type(lobe).__name__]
        np.testing.assert_allclose(brdf(other, views, lobe), brdf(views, other, lobe), rtol=1e-9)

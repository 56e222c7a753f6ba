import numpy as np
import pytest

from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import texel_directions
from burnish.oracle.estimator import (
    Importance,
    Reference,
    Regular,
    local_frame,
    shade_importance,
    shade_regular,
)
from burnish.oracle.frame import frame_from_tangent
from burnish.oracle.importance import importance_half_vectors
from burnish.oracle.lobe.kurt import KurtLobe, kurt_d
from burnish.oracle.metallic_roughness import Material
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.regular_pattern import choose_pattern, sample_pattern
from burnish.oracle.shading import shade

Z = np.array([0.0, 0.0, 1.0])
X = np.array([1.0, 0.0, 0.0])
LOBES = {
    "narrow": KurtLobe(0.1),
    "wide": KurtLobe(0.6, 0.04, 0.5),
    "brushed": KurtLobe((0.3, 0.05), (1, 0.5, 0.04), 0.25, (0.5, 1, 2), 0.7),
}


def constant(value, size=16):
    return build_pyramid(np.broadcast_to(np.asarray(value, float), (6, size, size, 3)), "box")


def view(degrees, azimuth=0.0):
    theta = np.radians(degrees)
    return np.array([np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), np.cos(theta)])


@pytest.fixture
def points(rng):
    """Normals, tangents and views up to 75 degrees from the normal."""
    n = normalize(rng.normal(size=(60, 3)))
    t, b = frame_from_tangent(n, rng.normal(size=(60, 3)))
    angles = zip(rng.uniform(0, 75, 60), rng.uniform(0, 2 * np.pi, 60), strict=True)
    local = np.stack([view(a, p) for a, p in angles])
    return n, t, local[:, :1] * t + local[:, 1:2] * b + local[:, 2:] * n


@pytest.fixture
def smooth():
    d = texel_directions(64)
    return 1 + 0.4 * d + 0.3 * d[..., [1, 2, 0]] * d[..., [2, 0, 1]]


@pytest.mark.parametrize("name", LOBES)
@pytest.mark.parametrize("samples", [3, 14, 30])
def test_furnace_is_exact_under_constant_light(name, samples, points):
    n, t, o = points
    lobe = LOBES[name]
    pattern = choose_pattern(lobe.roughness, samples, 0.2)
    shaded = shade_regular(constant((1, 2, 3)), n, t, o, lobe, pattern, 0.2)
    frame = local_frame(n, t, o, lobe.rotation)
    albedo = blend_albedo(directional_albedo(frame.omega_o, lobe.roughness, lobe.alpha), lobe.r0)
    np.testing.assert_allclose(shaded, np.array([1, 2, 3]) * albedo * np.asarray(lobe.weight), rtol=1e-12)


def test_parts_of_texels_serve_lobes_narrower_than_a_texel(rng):
    lobe, o = KurtLobe(0.02), normalize([0.4, 0.1, 1])
    n = normalize(rng.normal(size=(20, 3)))
    t, b = frame_from_tangent(n, X)
    views = o[0] * t + o[1] * b + o[2] * n
    albedo = directional_albedo(o, 0.02, 0.0)[0]
    coarse = shade_reference(constant(1, 16)[0], n, t, views, lobe)[:, 0] / albedo - 1
    fine = shade_reference(constant(1, 16)[0], n, t, views, lobe, parts=8)[:, 0] / albedo - 1
    assert np.max(np.abs(coarse)) > 0.5 and np.max(np.abs(fine)) < 2e-3


def test_samples_below_the_horizon_weigh_nothing():
    # Light from below alone must not reach a surface seen at 85 degrees.
    faces = np.zeros((6, 16, 16, 3))
    faces[texel_directions(16)[..., 2] < -0.3] = 1
    levels, lobe = [faces], KurtLobe(0.3)
    pattern = choose_pattern(0.3, 30, 0.1)
    for normalization in ("published", "projected", "furnace"):
        shaded = shade_regular(levels, Z, X, view(85), lobe, pattern, 0.1, normalization=normalization)
        np.testing.assert_array_equal(shaded, 0)
    half_vectors = importance_half_vectors(0.3, "fibonacci", 30)
    np.testing.assert_array_equal(shade_importance(levels, Z, X, view(85), lobe, half_vectors), 0)
    np.testing.assert_array_equal(shade_reference(faces, Z, X, view(85), lobe), 0)


def test_without_the_horizon_clamp_published_would_lose_most_light():
    # The figure of the paper's pseudo-code at 85 degrees, m = .3: negative cosines cancel light.
    m, o = 0.3, view(85)
    pattern = sample_pattern(m, "s1", 60, 1e-6)
    d = kurt_d(pattern, m, m)
    cos_i = 2 * (pattern @ o) * pattern[:, 2] - o[2]
    truth = directional_albedo(o, m, 0.0)[0]
    assert np.sum(d * cos_i) / np.sum(d) / truth == pytest.approx(0.366, abs=0.005)
    assert np.sum(d * np.maximum(cos_i, 0)) / np.sum(d) / truth == pytest.approx(0.958, abs=0.005)


def test_rotation_turns_the_lobe_counter_clockwise(smooth):
    lobe, turned = KurtLobe((0.3, 0.05)), KurtLobe((0.3, 0.05), rotation=np.pi / 6)
    t = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6), 0])
    o = view(50, 1.0)
    np.testing.assert_allclose(
        shade_reference(smooth, Z, X, o, turned), shade_reference(smooth, Z, t, o, lobe), rtol=1e-12
    )
    pattern, levels = choose_pattern((0.3, 0.05), 20, 0.2), build_pyramid(smooth)
    a, b = (
        shade_regular(levels, Z, axis, o, which, pattern, 0.2) for axis, which in ((X, turned), (t, lobe))
    )
    np.testing.assert_allclose(a, b, rtol=1e-12)
    assert not np.allclose(a, shade_regular(levels, Z, X, o, lobe, pattern, 0.2), rtol=1e-3)


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("roughness", [(1e-3, 1e-3), (1.0, 1.0), (1.0, 1e-3)])
def test_every_sampler_is_finite_at_the_hard_views(alpha, roughness, smooth):
    views = [view(0), view(89.99), view(90), view(120, 0.3), -Z, [0, 1, 1e-9]]
    material = Material(0.5, [KurtLobe(roughness, 0.04, alpha)])
    levels = build_pyramid(smooth)
    samplers = [Reference(), Importance(14), Importance(1, "fibonacci")]
    samplers += [
        Regular(5, 0.1, f, z) for f in ("published", "exact") for z in ("published", "projected", "furnace")
    ]
    for sampler in samplers:
        shaded = shade(levels, material, sampler, [0, 0, 1.0], [0, 0, 0.0], views)
        assert np.all(np.isfinite(shaded)) and np.all(shaded >= 0), sampler


def test_lobes_diffuse_and_emission_add_up(smooth, points):
    levels = build_pyramid(smooth)
    parts = [Material((0.1, 0.2, 0.3)), Material(lobes=[LOBES["narrow"]]), Material(lobes=[LOBES["brushed"]])]
    parts.append(Material(emissive=(1, 0, 2)))
    whole = Material((0.1, 0.2, 0.3), [LOBES["narrow"], LOBES["brushed"]], (1, 0, 2))
    for sampler in (Regular(14), Importance(14), Reference()):
        total = sum(shade(levels, part, sampler, *points) for part in parts)
        np.testing.assert_allclose(shade(levels, whole, sampler, *points), total, rtol=1e-12)


def test_unknown_settings_are_refused(smooth):
    with pytest.raises(
        ValueError, match="sampler: expected Regular, Importance, Matched or Reference, got str"
    ):
        shade([smooth], Material(lobes=[KurtLobe()]), "regular", Z, X, Z)
    with pytest.raises(ValueError, match='footprint: expected "published" or "exact"'):
        shade_regular([smooth], Z, X, Z, KurtLobe(), [Z], 0.1, footprint="wide")
    with pytest.raises(ValueError, match='normalization: expected "published", "projected" or "furnace"'):
        shade_regular([smooth], Z, X, Z, KurtLobe(), [Z], 0.1, normalization="none")

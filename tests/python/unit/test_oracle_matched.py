"""The sampler `matched`: its table, its map from half-vectors to directions, and whole points."""

import hashlib

import numpy as np
import pytest

from burnish.oracle.albedo import blend_albedo, directional_albedo
from burnish.oracle.arrays import dot, normalize, reflect
from burnish.oracle.cube_map import texel_directions
from burnish.oracle.estimator import local_frame
from burnish.oracle.frame import frame_from_tangent
from burnish.oracle.lobe.kurt import KurtLobe, kurt_sample
from burnish.oracle.lobe_map import lobe_map, principal_axes
from burnish.oracle.matched import Matched, matched_lookups, read_matched, shade_matched
from burnish.oracle.matched_table import (
    ASPECT_COUNT,
    COUNTS,
    LARGEST_ASPECT,
    TABLE_PATH,
    TABLE_SHA256,
    closest_count,
    load_table,
    mixture_at,
)
from burnish.oracle.metallic_roughness import Material
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.reference import shade_reference
from burnish.oracle.shading import shade
from burnish.oracle.spherical_pyramid import SPHERICAL_LEVEL_VARIANCE, build_spherical_pyramid

ASPECTS = LARGEST_ASPECT ** (np.arange(ASPECT_COUNT) / (ASPECT_COUNT - 1))
LOBES = {
    "narrow": KurtLobe(0.1),
    "wide": KurtLobe(0.6, 0.04, 0.5),
    "brushed": KurtLobe((0.3, 0.05), (1, 0.5, 0.04), 0.25, (0.5, 1, 2), 0.7),
}


def view(degrees, azimuth=0.0):
    theta = np.radians(degrees)
    return np.array([np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), np.cos(theta)])


def constant(value, size=32):
    return build_pyramid(np.broadcast_to(np.asarray(value, float), (6, size, size, 3)))


@pytest.fixture
def points(rng):
    """Normals, tangents and views up to 80 degrees from the normal."""
    n = normalize(rng.normal(size=(60, 3)))
    t, b = frame_from_tangent(n, rng.normal(size=(60, 3)))
    angles = zip(rng.uniform(0, 80, 60), rng.uniform(0, 2 * np.pi, 60), strict=True)
    local = np.stack([view(a, p) for a, p in angles])
    return n, t, local[:, :1] * t + local[:, 1:2] * b + local[:, 2:] * n


@pytest.fixture(scope="module")
def smooth():
    d = texel_directions(64)
    return build_pyramid(1 + 0.4 * d + 0.3 * d[..., [1, 2, 0]] * d[..., [2, 0, 1]])


def test_the_table_is_the_one_the_script_made():
    for path, wanted in TABLE_SHA256.items():
        assert hashlib.sha256(path.read_bytes()).hexdigest() == wanted, path.name
    lines = TABLE_PATH.read_text(encoding="ascii").splitlines()
    rows = [line for line in lines if not line.startswith("//")]
    assert len(rows) == ASPECT_COUNT * sum((count + 1) // 2 for count in COUNTS)
    # What an array initialiser of C++ reads: four numbers and a comma each.
    assert all(row.count(",") == 4 and row.endswith(",") for row in rows)
    assert TABLE_PATH.stat().st_size < 400_000


@pytest.mark.parametrize("count", COUNTS)
def test_rows_are_mixtures(count):
    rows = load_table()[count]
    assert np.all(np.isfinite(rows)) and np.all(rows[..., 3] >= 0)
    # Along lobes longer than n samples can fill they may be as wide as they lie apart.
    most = np.maximum(1.2, 2 * ASPECTS / count)[:, None]
    assert np.all((rows[..., 2] >= 0.0199) & (rows[..., 2] <= most + 1e-4))
    if count % 2:
        np.testing.assert_array_equal(rows[:, 0, :2], 0)
    copies = np.full(rows.shape[1], 2.0)
    copies[: count % 2] = 1
    np.testing.assert_allclose(np.sum(copies * rows[..., 3], axis=1), 1, atol=2e-5)


@pytest.mark.parametrize("count", COUNTS)
def test_centres_and_lookups_together_have_the_lobes_covariance(count):
    mixture = mixture_at(load_table()[count], count, ASPECTS)
    across = np.sum(mixture.w * (mixture.y2**2 + mixture.s**2), axis=-1)
    along = np.sum(mixture.w * (mixture.y1**2 + (mixture.s / ASPECTS[:, None]) ** 2), axis=-1)
    mixed = np.sum(mixture.w * mixture.y1 * mixture.y2, axis=-1)
    # Along longer lobes few samples would leave gaps: there the fit gives up the covariance across.
    short = count >= 2 * ASPECTS
    assert np.max(np.abs(across - 0.5)[short]) < 0.02
    assert np.max(np.abs(along - 0.5)[short]) < 0.02
    assert np.max(np.abs(mixed)[short]) < 0.05
    assert np.all((across > 0.48) & (across < 1 + 0.7 * (ASPECTS / count) ** 2))
    assert np.all((along > 0.25) & (along < 0.6))


@pytest.mark.parametrize("count", [n for n in COUNTS if n >= 4])
def test_samples_leave_no_gaps_along_a_long_lobe(count):
    # Light four minor axes wide sees the lobe from end to end, not n narrow spots with less than a tenth of
    # it in between, as of samples that fit the lobe alone.
    aspect = min(2.0 * count, LARGEST_ASPECT)
    mixture = mixture_at(load_table()[count], count, aspect)
    blur = (4 / aspect) ** 2
    y = np.linspace(-1, 1, 101)[:, None]
    v = (mixture.s / aspect) ** 2 + blur
    density = np.sum(mixture.w * np.exp(-0.5 * (y - mixture.y1) ** 2 / v) / np.sqrt(2 * np.pi * v), axis=1)
    lobe = np.exp(-0.5 * y[:, 0] ** 2 / (0.5 + blur)) / np.sqrt(2 * np.pi * (0.5 + blur))
    assert np.min(density / lobe) > 0.75 and np.max(density / lobe) < 1.25


@pytest.mark.parametrize("count", COUNTS)
def test_rows_change_little_along_the_aspect(count):
    rows = load_table()[count].copy()
    rows[..., 3] *= count
    # Widths of long lobes grow in proportion to the distance of their samples.
    rows[..., 2] /= np.maximum(1.0, ASPECTS / count)[:, None]
    assert np.max(np.abs(np.diff(rows, axis=0))) < 1.5
    assert np.mean(np.abs(np.diff(rows, axis=0))) < 0.05


def test_interpolated_rows_are_the_tables_at_the_nodes():
    rows = load_table()[5]
    mixture = mixture_at(rows, 5, ASPECTS)
    np.testing.assert_allclose(mixture.y1, rows[:, [0, 1, 2, 1, 2], 0] * [1, 1, 1, -1, -1], atol=1e-9)
    beyond = mixture_at(rows, 5, 1e3)
    np.testing.assert_allclose(beyond.s, rows[-1, [0, 1, 2, 1, 2], 2])


@pytest.mark.parametrize(
    ("samples", "count"), [(1, 2), (11, 12), (14, 14), (18, 17), (22, 24), (27, 30), (500, 64)]
)
def test_the_closest_count_serves(samples, count):
    assert closest_count(samples) == count


def test_no_samples_are_refused():
    with pytest.raises(ValueError, match="samples: expected an integer >= 1, got 0"):
        closest_count(0)


def test_isotropic_lobes_are_round_at_normal_incidence():
    matrix, t1, t2, _ = lobe_map(view(0), 0.2, 0.2)
    a, b, v1, v2 = principal_axes(matrix)
    assert a / b == pytest.approx(1, abs=1e-3)
    assert a == pytest.approx(0.4, rel=1e-3) and v1 * v1 + v2 * v2 == pytest.approx(1)
    assert dot(t1, t2) == pytest.approx(0)


def test_the_linear_map_is_the_derivative_of_reflection():
    step = 1e-6
    for o, mx, my in ((view(50, 0.7), 0.2, 0.05), (view(20, -2.0), 0.3, 0.3), (view(70, 2.0), 0.01, 0.1)):
        matrix, t1, t2, stretch = lobe_map(o, mx, my)
        h = normalize([[mx * step, 0, 1], [-mx * step, 0, 1], [0, my * step, 1], [0, -my * step, 1]])
        i = reflect(o, h)
        columns = np.stack([i[0] - i[1], i[2] - i[3]], axis=-1) / (2 * step)
        exact = np.stack([t1, t2]) @ columns
        # c is oz and what the lobe's width adds to it.
        np.testing.assert_allclose(matrix[0], exact[0], atol=1e-8)
        np.testing.assert_allclose(matrix[1] * o[2] / stretch, exact[1], atol=1e-8)


def test_principal_axes_are_those_of_the_singular_value_decomposition(rng):
    matrix = rng.normal(size=(200, 2, 2))
    a, b, v1, v2 = principal_axes(matrix)
    singular = np.linalg.svd(matrix, compute_uv=False)
    np.testing.assert_allclose(np.stack([a, b], axis=-1), singular, rtol=1e-9)
    long = np.einsum("kij,kj->ki", matrix, np.stack([v1, v2], axis=-1))
    np.testing.assert_allclose(np.linalg.norm(long, axis=-1), a, rtol=1e-9)


@pytest.mark.parametrize("name", LOBES)
def test_constant_light_gives_the_albedo(name, points):
    n, t, o = points
    lobe = LOBES[name]
    albedo = blend_albedo(
        directional_albedo(local_frame(n, t, o, lobe.rotation).omega_o, lobe.roughness, lobe.alpha), lobe.r0
    )
    for samples in (2, 5, 14):
        shaded = shade_matched(read_matched(constant((1, 2, 3)), Matched()), n, t, o, lobe, samples)
        np.testing.assert_allclose(shaded, np.array([1, 2, 3]) * albedo * np.asarray(lobe.weight), rtol=1e-9)


def test_the_lobes_covariance_is_that_of_lookups_in_directions():
    # Narrow enough that the map to directions is linear: covariance of centres and lookups is L L^T/2.
    o, lobe = view(55, 0.4), KurtLobe((0.02, 0.01))
    frame = local_frame([0, 0, 1.0], [1.0, 0, 0], o)
    lookups = matched_lookups(frame, lobe, 30, load_table()[30], 1024**2)
    matrix, t1, t2, _ = lobe_map(o, 0.02, 0.01)
    w = lookups.weight[..., 0] / np.sum(lookups.weight[..., 0])
    offset = lookups.direction @ np.stack([t1, t2], axis=-1)
    centred = offset - w @ offset
    exact = 0.5 * matrix @ matrix.T
    h = kurt_sample(
        np.random.default_rng(1).random(200_000), np.random.default_rng(2).random(200_000), 0.02, 0.01
    )
    sampled = np.cov((reflect(o, h) @ np.stack([t1, t2], axis=-1)).T)
    np.testing.assert_allclose(exact, sampled, rtol=0.05, atol=2e-5)
    width = exact - (w * centred.T) @ centred
    # What is left for the lookups is round and positive.
    assert np.all(np.linalg.eigvalsh(width) > 0)
    assert width[0, 0] == pytest.approx(width[1, 1], rel=0.25)


@pytest.mark.parametrize("name", LOBES)
def test_close_to_the_truth_on_smooth_light(name, points, smooth):
    n, t, o = points
    truth = shade_reference(smooth[0], n, t, o, LOBES[name])
    shaded = shade(smooth, Material(lobes=[LOBES[name]]), Matched(14), n, t, o)
    error = np.sqrt(np.mean((shaded - truth) ** 2)) / np.mean(truth)
    assert error < (0.05 if name == "wide" else 0.015)


def test_turning_the_tangent_by_180_degrees_changes_nothing(points, smooth):
    # Pairs (y, -y) make the signs of the singular vectors irrelevant.
    n, t, o = points
    light_map = read_matched(smooth, Matched())
    lobe = KurtLobe((0.3, 0.05))
    one = shade_matched(light_map, n, t, o, lobe, 14)
    np.testing.assert_allclose(shade_matched(light_map, n, -t, o, lobe, 14), one, rtol=1e-9)


def test_swapped_roughness_in_a_frame_turned_by_90_degrees_changes_nothing(points, smooth):
    n, t, o = points
    light_map = read_matched(smooth, Matched())
    one = shade_matched(light_map, n, t, o, KurtLobe((0.3, 0.05)), 14)
    other = shade_matched(light_map, n, np.cross(n, t), o, KurtLobe((0.05, 0.3)), 14)
    np.testing.assert_allclose(other, one, rtol=1e-9)


@pytest.mark.parametrize("alpha", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("roughness", [1e-4, 1e-2, 1.0, (1.0, 1e-2), (1e-3, 0.1)])
def test_finite_at_the_hard_views(roughness, alpha, smooth):
    views = [view(0), view(1e-7), view(89.99, 1.0), view(90), view(120, 0.3), [0, 0, -1.0], [0, 1, 1e-9]]
    light_map = read_matched(smooth, Matched())
    for samples in (2, 5, 14):
        lobe = KurtLobe(roughness, (1, 0.5, 0.04), alpha)
        shaded = shade_matched(light_map, [0, 0, 1.0], [0, 0, 0.0], views, lobe, samples)
        assert np.all(np.isfinite(shaded)) and np.all(shaded >= 0)


def test_a_spherical_level_has_its_variance_everywhere():
    # Of light d the mean under a Gaussian of variance v per axis is about (1 - v) d, wherever it lies.
    levels = build_spherical_pyramid(build_pyramid(texel_directions(64)))
    for level, size in ((1, 32), (2, 16), (3, 8)):
        length = np.linalg.norm(levels[level], axis=-1)
        variance = -np.log(length)
        np.testing.assert_allclose(variance, SPHERICAL_LEVEL_VARIANCE * (2 / size) ** 2, rtol=0.12)
        along = normalize(levels[level])
        assert np.max(np.linalg.norm(along - texel_directions(size), axis=-1)) < 0.02 * 2 / size * 10

"""The lobe: shader against oracle from mirrors to matt, isotropic to 1000:1, from the pole to the horizon."""

import numpy as np
import pytest
from probe import LEAST_NORMAL, ULP, assert_close, pow_error, probe, rows, units
from widened import covariances, densities, full

from burnish.oracle.arrays import dot, normalize
from burnish.oracle.lobe import kurt
from burnish.oracle.lobe.base import quadratic_form

COUNT = 20000
EDGES = [(1, 1), (1e-3, 1e-3), (1, 1e-3), (1e-3, 1), (0.2, 0.075), (10, 10)]


def roughnesses(rng, count=COUNT):
    """Slopes along both axes up to the 10 a material may have, the corners of their range first."""
    m = 10.0 ** rng.uniform(-3, 1, (count, 2))
    m[::2, 1] = m[::2, 0]
    m[: len(EDGES)] = EDGES
    return m.astype(np.float32)


def half_vectors(rng, m):
    """Half-vectors from the pole to where q leaves float32, at all azimuths; some anywhere, also below."""
    count = len(m)
    radius = np.sqrt(rng.uniform(0, 95, count) * rng.choice((1e-6, 0.01, 1), count))
    turn = rng.uniform(0, 2 * np.pi, count)
    slope = m * np.stack([radius * np.cos(turn), radius * np.sin(turn)], -1)
    h = np.concatenate([slope, np.ones((count, 1))], axis=-1)
    anywhere = rng.random(count) < 0.2
    h[anywhere] = rng.normal(size=(np.count_nonzero(anywhere), 3))
    horizon = rng.random(count) < 0.05
    h[horizon, 2] = rng.choice(
        (0, -0.0, 1e-30, 1e-12, 1e-11, 1e-8, 1e-4, -1e-8, -0.5), np.count_nonzero(horizon)
    )
    h[len(EDGES) : 2 * len(EDGES)] = 0, 0, 1
    return units(h)


def exponent_of(h, m):
    return kurt.kurt_exponent(h, m[:, 0], m[:, 1])


def q_error(exponent):
    """Relative: two quotients, squares and a sum, 9 ulp, in the exponent; then exp."""
    return (9 * exponent + 3 + 2 * exponent) * ULP


def test_schlick_weight(device, rng):
    u = rows(
        [0, 1, -0.5, 1.5, 1 - ULP / 2, 1 - ULP],
        rng.uniform(0, 1, COUNT),
        1 - 10.0 ** rng.uniform(-7, 0, COUNT),
    )
    actual = probe(device, "schlick_weight", u)[:, 0, 0]
    expected = kurt.schlick_fresnel(u, 0.0)
    # A difference that enters to the fifth power, and three products of which one enters twice.
    assert_close("schlick_weight", actual, expected, 4.5 * ULP * expected + LEAST_NORMAL, u=u)


def test_schlick_fresnel(device, rng):
    u = rows([0, 1, -0.5, 1.5], rng.uniform(0, 1, COUNT))
    r0 = rng.choice((0, 0.04, 1), len(u)).astype(np.float32)
    r0[::2] = rng.uniform(0, 1, len(r0[::2]))
    actual = probe(device, "schlick_fresnel", (u, r0))[:, 0, 0]
    expected = kurt.schlick_fresnel(u, r0)
    assert_close("schlick_fresnel", actual, expected, 6 * ULP * expected + LEAST_NORMAL, u=u, r0=r0)


def test_kurt_q(device, rng):
    m = roughnesses(rng)
    h = half_vectors(rng, m)
    actual = probe(device, "kurt_q", h, m)[:, 0, 0]
    expected = kurt.kurt_q(h, m[:, 0], m[:, 1])
    allowed = q_error(exponent_of(h, m)) * expected + LEAST_NORMAL
    assert_close("kurt_q", actual, expected, allowed, h=h, m=m)
    assert np.all(actual[h[:, 2] <= 0] == 0)
    assert np.count_nonzero(expected > 0.5) > 1000 and np.count_nonzero(expected < 1e-30) > 1000


def d_allowed(h, m, expected):
    """q's error, and six operations; where q flushes to zero, so does D."""
    cos_h = np.maximum(h[:, 2].astype(float), 1e-11)
    lost = LEAST_NORMAL / (np.pi * m[:, 0].astype(float) * m[:, 1] * cos_h**4)
    return (q_error(exponent_of(h, m)) + 6 * ULP) * expected + np.where(expected > 0, lost, LEAST_NORMAL)


def test_kurt_d(device, rng):
    m = roughnesses(rng)
    h = half_vectors(rng, m)
    actual = probe(device, "kurt_d", h, m)[:, 0, 0]
    expected = kurt.kurt_d(h, m[:, 0], m[:, 1])
    assert_close("kurt_d", actual, expected, d_allowed(h, m, expected), h=h, m=m)
    assert np.all(actual[h[:, 2] <= 0] == 0)


def test_kurt_pdf(device, rng):
    m = roughnesses(rng)
    h = half_vectors(rng, m)
    omega_o = units(rng.normal(size=h.shape))
    omega_o *= np.where(dot(omega_o, h) > 0, 1, -1)[:, None].astype(np.float32)
    cos_d = dot(omega_o, h).astype(np.float32)
    actual = probe(device, "kurt_pdf", h, m, cos_d)[:, 0, 0]
    expected = kurt.kurt_pdf_omega_i(h, omega_o, m[:, 0], m[:, 1])
    # The density's error times what is applied to it, and the cosine as float32 has it: half an ulp.
    scale = np.maximum(h[:, 2], 0) / (4 * cos_d.astype(float))
    density = kurt.kurt_d(h, m[:, 0], m[:, 1])
    allowed = d_allowed(h, m, density) * scale + 4 * ULP * expected + LEAST_NORMAL
    assert_close("kurt_pdf", actual, expected, allowed, h=h, m=m, omega_o=omega_o)


def test_kurt_pdf_is_finite_where_the_view_grazes_the_half_vector(device):
    h, m = np.tile(np.float32([0, 0, 1]), (3, 1)), np.full((3, 2), 1e-3, np.float32)
    assert np.all(np.isfinite(probe(device, "kurt_pdf", h, m, np.float32([0, -1, 1e-20]))))


@pytest.mark.parametrize("alpha", [0.0, 0.25, 0.5, 0.9, 1.0])
def test_grazing_term(device, rng, alpha):
    special = [1, 0.5, 1 - ULP / 2, 1e-4, 9.9e-5, 1e-30, 0, -0.0, -1e-8, -1]
    cos_i = rows(special, 10.0 ** rng.uniform(-8, 0, COUNT), rng.uniform(-1, 1, COUNT))
    cos_o = rows(
        [1, 1e-4, 1e-5, 0, -1], 10.0 ** rng.uniform(-8, 0, COUNT), rng.uniform(0, 1, COUNT), np.ones(5)
    )
    alpha = np.float32(alpha)
    actual = probe(device, "grazing_term", (cos_i, cos_o, alpha))[:, 0, 0]
    expected = kurt.grazing_factor(cos_i, cos_o, float(alpha))
    above = np.maximum(cos_i.astype(float), 1e-30)
    relative = pow_error(above, 1 - float(alpha)) + pow_error(np.maximum(cos_o, 1e-4), float(alpha)) + ULP
    assert_close(
        "grazing_term", actual, expected, relative * expected + LEAST_NORMAL, cos_i=cos_i, cos_o=cos_o
    )
    assert np.all(actual[cos_i <= 0] == 0)


def random_squares(rng, count):
    """Points of the unit square, with its corners and what recurrences of 24 bits reach beside them."""
    x = rng.random((count, 2))
    x[: count // 4, 0] = 1 - 10.0 ** rng.uniform(-7, 0, count // 4)
    x[count // 4 : count // 2, 0] = 10.0 ** rng.uniform(-7.2, 0, count // 4)
    special = np.array([0, 2.0**-24, 2.0**-23, 0.25, 0.5, 0.75, 1 - 2.0**-23, 1 - 2.0**-24, 1])
    corners = np.stack(np.meshgrid(special, special), -1).reshape(-1, 2)
    x[-len(corners) :] = corners
    return x.astype(np.float32)


def test_sample_kurt(device, rng):
    m = roughnesses(rng)
    x = random_squares(rng, COUNT)
    actual = probe(device, "sample_kurt", x, m)[:, 0, :3]
    x1, x2 = x.astype(float).T
    expected = kurt.kurt_sample(x1, x2, m[:, 0], m[:, 1])
    # Beside 1 the logarithm errs by 2^-21, thus the radius by up to 2^-10.5 of the roughness: seen by the few
    # samples of this share. Sine and cosine err by 2^-21 on every driver met so far (Vulkan promises 2^-11).
    log = -np.log(np.maximum(x1, 2.0**-24))
    log_error = np.where(x1 < 0.5, 3 * ULP * log, 2.0**-21)
    radius_error = np.sqrt(log + log_error) - np.sqrt(np.maximum(log - log_error, 0)) + 5 * ULP * np.sqrt(log)
    slope = np.linalg.norm(m * np.sqrt(log)[:, None], axis=-1)
    slope_error = m.max(axis=-1) * (radius_error + np.sqrt(log) * (2.0**-21 + 2 * ULP))
    # A direction turns by at most the slope's change over its length.
    turned = slope_error / np.sqrt(1 + (m.min(axis=-1) * slope / m.max(axis=-1)) ** 2)
    assert_close("sample_kurt", actual, expected, (turned + 5 * ULP)[:, None], x=x, m=m)
    assert np.all(actual[:, 2] > 0)
    np.testing.assert_allclose(np.linalg.norm(actual.astype(float), axis=-1), 1, atol=4 * ULP)


def test_kurt_value(device, rng):
    """By f cos_i of the whole reflectance; the half-vector is rebuilt from the directions."""
    m = roughnesses(rng)
    alpha = rng.choice((0.0, 0.5, 1.0), COUNT).astype(np.float32)
    omega_o = rng.normal(size=(COUNT, 3)) * [1, 1, 0] + 10.0 ** rng.uniform(-6, 1, (COUNT, 1)) * [0, 0, 1]
    omega_o = normalize(omega_o)
    h = half_vectors(rng, m).astype(float)
    omega_i = units(2 * dot(omega_o, h)[:, None] * h - omega_o)
    omega_o = units(omega_o)
    actual = probe(device, "kurt_value", omega_i, omega_o, (m[:, 0], m[:, 1], alpha))[:, 0, 0]
    expected = np.zeros(COUNT)
    for k in range(COUNT):
        lobe = kurt.KurtLobe(m[k].astype(float), alpha=float(alpha[k]))
        expected[k] = kurt.kurt_brdf(omega_i[k], omega_o[k], lobe)[0] * max(omega_i[k, 2], 0)
    assert np.all(np.isfinite(actual)) and np.all(actual >= 0)
    assert np.all(actual[omega_i[:, 2] <= 0] == 0)
    # The sum's rounding turns h by `turn`; ln D changes with it by 2 sqrt(exponent)/(m cos_h^2) and 4/cos_h,
    # the cosine below by 1/(o.h). Compared where that is small.
    total = omega_i.astype(float) + omega_o
    length = np.linalg.norm(total, axis=-1)
    above = (omega_i[:, 2] > 0) & (length > 1e-5)
    h = total / np.maximum(length, 1e-5)[:, None]
    cos_h, cos_d = np.maximum(h[:, 2], 1e-11), np.maximum(length / 2, 1e-5)
    turn = 4 * ULP / np.maximum(length, 1e-5)
    exponent = exponent_of(h, m.astype(float))
    relative = 2 * np.sqrt(exponent) * turn / (m.min(axis=-1).astype(float) * cos_h**2) + 4 * turn / cos_h
    relative += (turn + 3 * ULP) / cos_d + q_error(exponent) + 10 * ULP
    relative += pow_error(np.maximum(omega_i[:, 2], 1e-30).astype(float), 1 - alpha.astype(float))
    relative += pow_error(np.clip(omega_o[:, 2], 1e-4, 1).astype(float), alpha.astype(float))
    judged = above & (relative < 0.1) & (exponent < 80)
    assert np.count_nonzero(judged & (expected > 0)) > COUNT / 4
    allowed = relative * expected + LEAST_NORMAL * 1e12
    inputs = {"omega_i": omega_i[judged], "omega_o": omega_o[judged], "m": m[judged], "alpha": alpha[judged]}
    assert_close("kurt_value", actual[judged], expected[judged], allowed[judged], **inputs)


def test_kurt_value_of_directions_that_cancel_is_zero(device):
    """Along the surface, with the eye behind it, and where the sum is too short to have a direction."""
    omega_o = units([[1, 0, 0], [0.6, 0, 0.8], [0.6, 0, -0.8], [0, 0, -1], [1, 0, -1e-8], [1, 0, 1e-8]])
    omega_i = -omega_o
    omega_i[-1, 2] = 1e-8
    lobe = np.tile(np.float32([0.1, 0.1, 1]), (len(omega_o), 1))
    actual = probe(device, "kurt_value", omega_i, omega_o, lobe)
    np.testing.assert_array_equal(actual[:, 0, 0], 0)


def test_widened_form(device, rng):
    a = roughnesses(rng)
    slope, wider = covariances(rng, a)
    actual = probe(device, "widened_form", slope, wider, (a[:, 0] ** 2, a[:, 1] ** 2, np.float32(1.0)))[
        :, 0, :2
    ]
    own = np.zeros((len(a), 2, 2))
    own[:, 0, 0], own[:, 1, 1] = (a**2).astype(float).T
    square, _ = quadratic_form(full(wider) + own, slope.astype(float))
    reach = np.sum(slope.astype(float) ** 2 / a.astype(float) ** 2, axis=-1)
    assert_close(
        "widened_form", actual[:, 0], square, 1e-3 * (square + reach) + 1e-6, slope=slope, wider=wider, a=a
    )


def test_kurt_widened_d(device, rng):
    a = np.maximum(roughnesses(rng, 4000), np.float32(1e-3))
    slope, wider = covariances(rng, a)
    actual = probe(device, "kurt_widened_d", slope, wider, a)[:, 0, 0]
    expected = densities(kurt, kurt.KurtLobe, slope, wider, a)
    np.testing.assert_allclose(actual, expected, rtol=2e-2, atol=1e-3 * np.median(expected))

"""GGX: shader against oracle from mirrors to matt, round to 1000:1, from the normal to the horizon."""

import numpy as np
from probe import LEAST_NORMAL, ULP, assert_close, directions_above, probe, rows, units
from widened import covariances, densities

from burnish.oracle.arrays import dot
from burnish.oracle.lobe import ggx

COUNT = 20000


def roughnesses(rng, count=COUNT):
    """Alphas along both axes, the corners of their range first."""
    a = 10.0 ** rng.uniform(-6, 0, (count, 2))
    a[::2, 1] = a[::2, 0]
    a[:4] = (1, 1), (1e-6, 1e-6), (1, 1e-6), (1e-6, 1)
    return a.astype(np.float32)


def views(rng, count=COUNT):
    return directions_above(rng, count)


def places(rng, count=COUNT):
    """Places of the plane from its middle to where a millionth of the lobe is left."""
    radius = np.sqrt(1 / 10.0 ** rng.uniform(-6, 0, count) - 1)
    turn = rng.uniform(0, 2 * np.pi, count)
    return rows(np.zeros((4, 2)), np.stack([radius * np.cos(turn), radius * np.sin(turn)], -1)[4:])


def per_item(function, *arguments):
    """Run an oracle function whose widths are numbers, item by item of few distinct ones."""
    return np.array([function(*one) for one in zip(*arguments, strict=True)])


def half_vectors(rng, a):
    """Half-vectors over the lobe and its tail, some anywhere above the horizon."""
    h = np.concatenate([a * places(rng, len(a)), np.ones((len(a), 1))], axis=-1)
    anywhere = rng.random(len(a)) < 0.2
    h[anywhere] = rng.normal(size=(np.count_nonzero(anywhere), 3))
    h[:, 2] = np.abs(h[:, 2])
    return units(h)


def d_error(h, a):
    """Relative: quotients, squares and sums enter q twice; three products, a quotient and pi."""
    return 2 * 9 * ULP + 8 * ULP


def test_ggx_d(device, rng):
    a = roughnesses(rng)
    h = half_vectors(rng, a)
    actual = probe(device, "ggx_d", h, 0.0, a)[:, 0, 0]
    expected = ggx.ggx_d(h, a[:, 0], a[:, 1])
    assert_close("ggx_d", actual, expected, d_error(h, a) * expected + LEAST_NORMAL, h=h, a=a)


def test_projected_width(device, rng):
    a, v = roughnesses(rng), views(rng)
    actual = probe(device, "projected_width", v, 0.0, a)[:, 0, 0]
    x, y, z = v.astype(float).T
    expected = np.sqrt(z * z + (a[:, 0].astype(float) * x) ** 2 + (a[:, 1].astype(float) * y) ** 2)
    assert_close("projected_width", actual, expected, 8 * ULP * expected, v=v, a=a)


def test_ggx_rest(device, rng):
    a, i, o = roughnesses(rng), views(rng), views(rng)
    actual = probe(device, "ggx_rest", i, o, a)[:, 0, 0]
    expected = per_item(
        lambda i, o, a: ggx.ggx_visibility(i, o, *a) * i[2], *(v.astype(float) for v in (i, o, a))
    )
    assert_close("ggx_rest", actual, expected, 24 * ULP * expected, i=i, o=o, a=a)


def normals(o, p, a):
    """Half-vectors by the oracle."""
    return per_item(lambda o, p, a: ggx.half_vectors(o, p, *a), *(v.astype(float) for v in (o, p, a)))


def test_ggx_normal(device, rng):
    o, p, a = views(rng), places(rng), roughnesses(rng)
    result = probe(device, "ggx_normal", o, p, a)[:, 0]
    h = normals(o, p, a)
    # Of the stretched hemisphere's unit normal, each component is off by some ulp of 1; alpha scales them,
    # and where it lies along the surface its height is all of the half-vector's length.
    wide = np.concatenate([a.astype(float), np.ones((len(a), 1))], axis=-1)
    normal = h / wide
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    allowed = 20 * ULP * length * (wide + np.abs(h) * h[:, 2:]) + 4 * ULP * np.abs(h)
    assert_close("ggx_normal", result[:, :3], h, allowed, o=o, p=p, a=a)
    q = np.sum(normal**2, axis=-1)
    height = np.abs(normal[:, 2]) / length[:, 0]
    assert_close("q", result[:, 3], q, 80 * ULP * q / np.maximum(height, 1e-3) + 1e-6 * q, o=o, p=p, a=a)


def test_ggx_disc(device, rng):
    o, a = views(rng, 4000), roughnesses(rng, 4000)
    result = probe(device, "ggx_disc", o, 0.0, a).astype(float)
    stretched = o * np.concatenate([a.astype(float), np.ones((len(a), 1))], axis=-1)
    view = stretched / np.linalg.norm(stretched, axis=-1, keepdims=True)
    sine = np.hypot(view[:, 0], view[:, 1])
    np.testing.assert_allclose(result[:, 0, :3], view, atol=4 * ULP)
    np.testing.assert_allclose(result[:, 0, 3], 0.5 * (1 + view[:, 2]), atol=4 * ULP)
    # The rest has all its digits where the disc is nearly whole.
    rest = 0.5 * sine**2 / (1 + view[:, 2])
    np.testing.assert_allclose(result[:, 1, 3], rest, rtol=16 * ULP, atol=LEAST_NORMAL)
    turned = sine > 1e-6
    level = np.stack([-view[:, 1], view[:, 0]], axis=-1)[turned] / sine[turned, None]
    np.testing.assert_allclose(result[turned, 2, :2], level, atol=8 * ULP)
    other = np.cross(view[turned], np.concatenate([level, np.zeros((len(level), 1))], axis=-1))
    np.testing.assert_allclose(result[turned, 1, :3], other, atol=16 * ULP)


def test_ggx_linear_map(device, rng):
    """Two columns across the direction: their products are those of any two other axes."""
    o, a = views(rng, 4000), roughnesses(rng, 4000)
    # Narrower ones differ by less than a view's rounding.
    a = np.maximum(a, np.float32(1e-4))
    result = probe(device, "ggx_linear_map", o, 0.0, a)[:, :2, :3].astype(float)
    got = result @ np.swapaxes(result, 1, 2)
    maps = per_item(
        lambda o, a: ggx.linear_map(o, ggx.GgxLobe(tuple(a)), np.zeros(2), np.diag(a)),
        o.astype(float),
        a.astype(float),
    )
    expected = np.swapaxes(maps, 1, 2) @ maps
    size = np.sqrt(np.einsum("nii->ni", expected))
    error = np.abs(got - expected) / (size[:, :, None] * size[:, None, :])
    assert error.max() < 1e-3, (o[error.max((1, 2)).argmax()], a[error.max((1, 2)).argmax()])


def test_sample_ggx(device, rng):
    o, a = views(rng), roughnesses(rng)
    x = rows([(0, 0), (1, 0.5), (0.5, 1)], rng.random((COUNT - 3, 2)))
    h = probe(device, "sample_ggx", o, x, a)[:, 0, :3]
    assert np.isfinite(h).all() and np.all(h[:, 2] > 0)
    np.testing.assert_allclose(np.linalg.norm(h.astype(float), axis=-1), 1, atol=4 * ULP)
    expected = per_item(
        lambda o, x, a: ggx.ggx_sample(o, x[0], x[1], *a), *(v.astype(float) for v in (o, x, a))
    )
    # sin and cos are good to 2^-11 of the circle at worst.
    wide = np.concatenate([a.astype(float), np.ones((len(a), 1))], axis=-1)
    size = np.linalg.norm(expected / wide, axis=-1, keepdims=True)
    assert_close("sample_ggx", h, expected, 1e-3 * wide * size + 1e-6, o=o, x=x, a=a)


def test_ggx_pdf(device, rng):
    a, o = roughnesses(rng), views(rng)
    h = half_vectors(rng, a)
    actual = probe(device, "ggx_pdf", h, o, a)[:, 0, 0]
    o64, a64 = o.astype(float), a.astype(float)
    width = np.sqrt(o64[:, 2] ** 2 + (a64[:, 0] * o64[:, 0]) ** 2 + (a64[:, 1] * o64[:, 1]) ** 2)
    expected = ggx.ggx_d(h, a[:, 0], a[:, 1]) / (2 * (np.maximum(o64[:, 2], 1e-4) + width))
    assert_close(
        "ggx_pdf", actual, expected, (d_error(h, a) + 16 * ULP) * expected + LEAST_NORMAL, h=h, o=o, a=a
    )


def test_ggx_at(device, rng):
    """The base where light does not graze so that rounding is all that is left of its cosine."""
    o, p, a = views(rng), places(rng), roughnesses(rng)
    result = probe(device, "ggx_at", o, p, a)
    h = normals(o, p, a)
    o64 = o.astype(float)
    cos_d = dot(o64, h)
    omega_i = 2 * cos_d[:, None] * h - o64
    near = np.linalg.norm(p, axis=-1) < 30
    np.testing.assert_allclose(result[near, 0, 3], cos_d[near], atol=1e-4)
    np.testing.assert_allclose(result[near, 0, :3], omega_i[near], atol=1e-4)
    above = near & (omega_i[:, 2] > 0.02)
    base = per_item(
        lambda i, o, a: (
            2 * i[2] * ggx.ggx_visibility(i, o, *a) * (ggx.projected_width(o, *a) + max(o[2], 1e-4))
        ),
        omega_i[above],
        o64[above],
        a[above].astype(float),
    )
    np.testing.assert_allclose(result[above, 1, 0], base, rtol=2e-2, atol=1e-4)
    assert np.all(result[omega_i[:, 2] < -1e-3, 1, 0] == 0)


def test_ggx_widened_d(device, rng):
    a = np.maximum(roughnesses(rng, 4000), np.float32(1e-3))
    slope, wider = covariances(rng, a)
    actual = probe(device, "ggx_widened_d", slope, wider, a)[:, 0, 0]
    expected = densities(ggx, ggx.GgxLobe, slope, wider, a)
    np.testing.assert_allclose(actual, expected, rtol=1e-2)

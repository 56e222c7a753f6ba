"""Surfaces packed into 8 bytes: shader against oracle, and what the packing loses."""

import numpy as np
import pytest
from probe import ULP, assert_close, probe, rows, units, words

from burnish.oracle import frame, surface
from burnish.oracle.arrays import dot

# Radians. A coordinate is off by half a step of 1/32767; the octahedral map stretches by at most 3.
NORMAL_LOSS = 3 * np.sqrt(2) * 0.5 / surface.NORMAL_STEPS
# The angle turns by at most 4 radians a unit of the diamond's way, in the middle of its edges.
ANGLE_LOSS = 4 * 0.5 / (surface.ANGLE_STEPS / 2)


@pytest.fixture
def points(rng):
    """Normal, tangent, handedness and material of surface points, the hard ones first."""
    hard = [
        [0, 0, 1],
        [0, 0, -1],
        [1, 0, 0],
        [0, -1, 0],
        [-0.6, 0.8, 0],
        [1, 1, 1],
        [1e-5, 0, -1],
        [0, 1e-4, -1],
    ]
    equator = rng.normal(size=(5000, 3)) * [1, 1, 0]
    normal = units(np.concatenate([np.repeat(hard, 50, axis=0), equator, rng.normal(size=(20000, 3))]))
    tangent = units(frame.frame_from_tangent(normal, rng.normal(size=normal.shape))[0])
    handedness = rng.choice((-1.0, 1.0), len(normal)).astype(np.float32)
    material = rng.integers(0, 65535, len(normal)).astype(np.uint32)
    material[:2] = 0, 65534
    return normal, tangent, handedness, material


def angle_between(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), dot(a, b))


def half_counts(word):
    """Two signed 16-bit integers."""
    return np.ascontiguousarray(word).view(np.int16).reshape(-1, 2)


def test_diamond_encode(device, rng):
    v = rows(
        [[1, 0], [0, 1], [-1, 0], [-1, -0.0], [0, -1], [0, 0], [-1, -1e-20], [1e-20, 1], [3e18, -4e18]],
        rng.normal(size=(20000, 2)) * 10.0 ** rng.uniform(-15, 15, (20000, 1)),
    )
    actual = probe(device, "diamond_encode", v)[:, 0, 0]
    # A sum and a quotient of size 1 at most, halved; 2 - a.
    assert_close("diamond_encode", actual, surface.diamond_encode(v), 2.5 * ULP, v=v)


def test_diamond_decode(device, rng):
    d = rows(np.linspace(-1, 1, 65), rng.uniform(-1, 1, 20000))
    actual = probe(device, "diamond_decode", d)[:, 0, :2]
    # Differences from 1 and 2 of numbers that are exact; the vector is 1/sqrt 2 long at least.
    assert_close("diamond_decode", actual, surface.diamond_decode(d), 5 * ULP, d=d)


def test_diamond_round_trip(device, rng):
    turn = rng.uniform(-np.pi, np.pi, 20000)
    v = units(np.stack([np.cos(turn), np.sin(turn)], axis=-1))
    back = probe(device, "diamond_decode", probe(device, "diamond_encode", v)[:, 0, 0])[:, 0, :2]
    # The angle turns by at most 4 radians a unit.
    assert_close("diamond round trip", back, v, (4 * 2.5 + 5) * ULP, v=v)


def test_pack_surface(device, points):
    normal, tangent, handedness, material = points
    packed = words(probe(device, "pack_surface", normal, tangent, handedness, material))[:, 0, :2]
    stored = probe(device, "unpack_normal", packed)[:, 0, :3]
    # The basis turns over at z = 0, where float32 may see another sign than float64: ask the shader.
    counts, angle = surface.surface_counts(normal, tangent, stored)
    # Rounded to the nearest step: half of one, and the error of the coordinate before.
    allowed = 0.5 + surface.NORMAL_STEPS * 6 * ULP
    inputs = {"normal": normal, "tangent": tangent}
    assert_close("pack_surface normal", half_counts(packed[:, 0]), counts, allowed, **inputs)
    got = (packed[:, 1] >> 17).astype(float)
    off = (got - angle + surface.ANGLE_STEPS / 2) % surface.ANGLE_STEPS - surface.ANGLE_STEPS / 2
    # Half a step; the tangent's components are good to 8 ulp, their diamond angle to 12.
    allowed = 0.5 + surface.ANGLE_STEPS / 2 * 12 * ULP
    assert_close("pack_surface angle", off, np.zeros(len(off)), allowed, **inputs)
    np.testing.assert_array_equal(packed[:, 1] >> 16 & 1, handedness < 0)
    np.testing.assert_array_equal(packed[:, 1] & 0xFFFF, material + 1)


def test_pack_surface_makes_the_oracles_words(device, points):
    """All but the few whose coordinates lie on the border between two steps, or on the basis's border."""
    packed = words(probe(device, "pack_surface", *points))[:, 0, :2]
    inside = np.abs(points[0][:, 2]) > 1e-4
    same = np.all(packed[inside] == surface.pack_surface(*(p[inside] for p in points)), axis=-1)
    assert np.mean(same) > 0.97


def test_what_packing_loses(device, points):
    normal, tangent, handedness, material = points
    packed = words(probe(device, "pack_surface", *points))[:, 0, :2]
    results = probe(device, "unpack_frame", packed)
    got_tangent, got_bitangent, got_normal = (results[:, k, :3].astype(float) for k in range(3))
    rounding = 8 * ULP
    inputs = {"normal": normal, "tangent": tangent}
    lost = angle_between(got_normal, normal)
    assert_close("lost angle of the normal", lost, 0 * lost, NORMAL_LOSS + rounding, **inputs)
    # Turned within the stored normal's plane, which itself is tilted by what the normal lost.
    lost = angle_between(got_tangent, tangent)
    assert_close(
        "lost angle of the tangent", lost, 0 * lost, NORMAL_LOSS + ANGLE_LOSS + 2 * rounding, **inputs
    )
    expected = handedness[:, None] * np.cross(got_normal, got_tangent)
    assert_close("bitangent", got_bitangent, expected, 4 * ULP, **inputs)
    np.testing.assert_array_equal(words(probe(device, "unpack_material", packed))[:, 0, 0], material)
    assert np.all(words(probe(device, "has_surface", packed))[:, 0, 0] == 1)


@pytest.fixture
def any_words(rng):
    """Words as they may come: also those that packing never makes, and the empty one."""
    drawn = rng.integers(0, 2**32, (20000, 2), dtype=np.uint64)
    drawn[:1000, 1] &= 0xFFFF0000
    special = [
        [0, 0],
        [0x80008000, 0xFFFFFFFF],
        [0x7FFF7FFF, 0x0001FFFF],
        [0x80017FFF, 1],
        [0x00007FFF, 0x10000],
    ]
    return np.concatenate([special, drawn]).astype(np.uint32)


def test_has_surface(device, any_words):
    actual = words(probe(device, "has_surface", any_words))[:, 0, 0]
    np.testing.assert_array_equal(actual == 1, surface.has_surface(any_words))
    assert actual[0] == 0


def test_unpack_material(device, any_words):
    actual = words(probe(device, "unpack_material", any_words))[:, 0, 0]
    filled = surface.has_surface(any_words)
    np.testing.assert_array_equal(actual[filled], surface.unpack_material(any_words)[filled])


def test_unpack_normal(device, any_words):
    actual = probe(device, "unpack_normal", any_words)[:, 0, :3]
    # Each coordinate is a quotient; then octahedral_decode.
    assert_close("unpack_normal", actual, surface.unpack_normal(any_words), 10 * ULP, word=any_words)


def test_unpack_frame(device, any_words):
    results = probe(device, "unpack_frame", any_words)
    decided = np.abs(surface.unpack_normal(any_words)[:, 2]) > ULP  # see test_pack_surface
    assert np.count_nonzero(~decided) < 10
    for k, expected in enumerate(surface.unpack_frame(any_words)):
        # A normal of 10 ulp, a basis of 5 more and its dependence on the normal, two products.
        actual = results[decided, k, :3]
        assert_close("unpack_frame", actual, expected[decided], 24 * ULP, word=any_words[decided])

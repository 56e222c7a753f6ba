"""Eight bits of sRGB: shader against oracle."""

import numpy as np
from probe import ULP, assert_close, probe, rows, words

from burnish.oracle import display


def colors(rng, count=20000):
    edge = np.float32(0.0031308) * (1 + ULP * np.arange(-8, 9))
    grey = rows(np.repeat([[0.0], [1.0]], 3, axis=1), np.repeat(edge[:, None], 3, axis=1))
    return rows(grey, rng.uniform(0, 1, (count, 3)), 10.0 ** rng.uniform(-8, 0, (count, 3)))


def test_srgb_encode(device, rng):
    linear = colors(rng)
    actual = probe(device, "srgb_encode", linear)[:, 0, :3]
    expected = display.srgb_encode(linear)
    # exp2(log2(x) / 2.4): log2 within 2^-21 or 3 ULP of up to 8.4, then 3 + 2|x| ULP. The difference has the
    # rounding of its larger term.
    allowed = 1.055 * np.maximum(expected, 0.1) * (3 * 8.4 * ULP + 2.0**-21 + 10 * ULP) + 4 * ULP
    assert_close("srgb_encode", actual, expected, allowed, linear=linear)


def test_display_pixel(device, rng):
    linear = colors(rng)
    color = np.concatenate([linear * 4, rng.uniform(0, 1, (len(linear), 1))], axis=1).astype(np.float32)
    color[:4, :3] = [[-1, 3e38, 1e-30], [0, 1, 0.5], [-3e38, 0, 2], [1e-42, 0.25, 0.3]]
    scale = np.float32(0.3)
    codes = words(probe(device, "display_pixel", color, np.full(len(color), scale)))[:, 0, 0]
    actual = np.ascontiguousarray(codes).view(np.uint8).reshape(-1, 4)
    expected = display.display_pixel(color, float(scale))
    difference = np.abs(actual.astype(int) - expected)
    # Only where the encoded value lies within its rounding of half a code.
    assert difference.max() <= 1 and np.mean(difference > 0) < 2e-3

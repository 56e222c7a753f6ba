"""Lobes under lights of some extent: what widens them, and what the oracle makes of it."""

import numpy as np


def covariances(rng, a):
    """Slopes, and what widens a lobe: nothing, as much as it has itself, or a hundred times as much."""
    steps = rng.normal(size=(2, len(a), 2)) * a * 10.0 ** rng.uniform(-3, 1, (len(a), 1))
    (x1, y1), (x2, y2) = (np.moveaxis(step, -1, 0) for step in steps)
    wider = np.stack([x1 * x1 + x2 * x2, y1 * y1 + y2 * y2, x1 * y1 + x2 * y2, x1 * y2 - y1 * x2], -1)
    return (a * rng.normal(size=(len(a), 2))).astype(np.float32), wider.astype(np.float32)


def full(wider, k=1.0):
    """The matrix that `wider` is twice of."""
    w = wider.astype(float) * k
    return np.stack([w[:, 0], w[:, 2], w[:, 2], w[:, 1]], -1).reshape(-1, 2, 2)


def densities(module, lobe, slope, wider, a):
    own = full(wider, 0.5)
    return np.array(
        [
            module.widened_d(s, lobe(roughness=tuple(m)), c)
            for s, m, c in zip(slope.astype(float), a, own, strict=True)
        ]
    )

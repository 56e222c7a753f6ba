"""Loss of Gaussian mixtures against an elliptic Gaussian lobe, its gradient, and where to start.

A mixture has n samples of centre y, width s and weight w; all aspects of the lobe are fitted together. Only
half of the samples are unknown: pairs (y, -y) share s and w, and an odd n has one sample at 0.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

Float64 = NDArray[np.float64]

#: Aspects of the lobe that have a row of the table.
ASPECTS: Float64 = 34.0 ** (np.arange(40) / 39)
#: Least and greatest width of a sample, in units of the minor axis.
WIDTHS = (0.02, 1.2)
# Greatest weight of a sample, in units of 1/n.
_MOST_WEIGHT = 4.0
# Weight of the roughness along the aspect.
_SMOOTHNESS = 1e-3
# A trilinear lookup's error is correlated over this share of the variance of the lookups.
_CORRELATION = 0.3


@dataclass(frozen=True)
class Mixtures:
    """Half of the samples at every aspect: (aspects, half) each; `share` is the weight times n."""

    samples: int
    y1: Float64  # along the major axis, in its unit
    y2: Float64  # along the minor axis, in its unit
    log_s: Float64  # s in units of the minor axis
    share: Float64

    @property
    def unknowns(self) -> Float64:
        """All of them in one row."""
        return np.stack([self.y1, self.y2, self.log_s, self.share]).ravel()


def unpack(samples: int, unknowns: Float64) -> Mixtures:
    """Inverse of `Mixtures.unknowns`."""
    return Mixtures(samples, *unknowns.reshape(4, len(ASPECTS), -1))


def copies(samples: int) -> Float64:
    """How many samples each half-sample stands for: 2, but 1 for the centre of an odd count."""
    count = np.full((samples + 1) // 2, 2.0)
    if samples % 2:
        count[0] = 1.0
    return count


def node_weights(samples: int) -> Float64:
    """Weight of each aspect's loss: the more, the smaller the loss that is within reach."""
    reach = 0.3 * (1 - 1 / (1 + (ASPECTS / samples) ** 2))
    result: Float64 = 1 / (50 * np.maximum(0.01, reach))
    return result


def loss_and_gradient(
    unknowns: Float64, samples: int, kernel_error: float, moment_weight: float
) -> tuple[float, Float64]:
    """Sum of the losses of all aspects, and its gradient.

    With the lobe K = N(0, diag(rho^2, 1)/2), x = (rho y1, y2), G_k = N(x_k, s_k^2 I), v_jk = s_j^2 + s_k^2:

        E = (|K - sum w G|^2 + eps^2 sum_jk w_j w_k exp(-d_jk^2/(2 hc v_jk))/(2 pi v_jk))/|K|^2
            + lambda |moments|^2,
        moments = (sum w - 1, sum w (x1^2 + s^2)/rho^2 - 1/2, sum w (x2^2 + s^2) - 1/2);

    the first moments vanish by symmetry. The term of eps is the expected error of lookups whose kernel
    differs from a Gaussian by a relative eps, alike for neighbours. Neighbouring aspects are drawn together
    by mu/n |p_{j+1} - p_j|^2/ln(rho_{j+1}/rho_j). `kernel_error` is eps, `moment_weight` lambda.
    """
    mixtures = unpack(samples, unknowns)
    rho = ASPECTS[:, None]
    count = copies(samples)
    x1, x2 = rho * mixtures.y1, mixtures.y2
    s2 = np.exp(2 * mixtures.log_s)
    mass = count * mixtures.share / samples

    # Products with the lobe.
    v1, v2 = 0.5 * rho**2 + s2, 0.5 + s2
    product = np.exp(-0.5 * (x1**2 / v1 + x2**2 / v2)) / (2 * np.pi * np.sqrt(v1 * v2))
    d_mass = -2 * product
    d_x1, d_x2 = 2 * mass * product * x1 / v1, 2 * mass * product * x2 / v2
    d_s2 = -mass * product * (x1**2 / v1**2 + x2**2 / v2**2 - 1 / v1 - 1 / v2)
    loss = np.sum(mass * d_mass, axis=1)

    # Products with each other: x_j with x_k and with -x_k, half of the copies each.
    v = s2[:, :, None] + s2[:, None, :]
    both = mass[:, :, None] * mass[:, None, :]
    inverse = 1 / v
    for sign in (-1.0, 1.0):
        e1, e2 = (x[:, :, None] + sign * x[:, None, :] for x in (x1, x2))
        distance = (e1**2 + e2**2) * inverse
        exact = np.exp(-0.5 * distance) * inverse / (2 * np.pi)
        error = kernel_error**2 * np.exp(-0.5 / _CORRELATION * distance) * inverse / (2 * np.pi)
        value = exact + error
        slope = exact + error / _CORRELATION  # -2 d value/d distance
        loss += 0.5 * np.sum(both * value, axis=(1, 2))
        d_mass += np.sum(mass[:, None, :] * value, axis=2)
        pull = both * slope * inverse
        d_x1 -= np.sum(pull * e1, axis=2)
        d_x2 -= np.sum(pull * e2, axis=2)
        d_s2 += np.sum(both * inverse * (0.5 * slope * distance - value), axis=2)

    norm = 1 / (2 * np.pi * ASPECTS)
    loss = loss / norm + 1
    for gradient in (d_mass, d_x1, d_x2, d_s2):
        gradient /= norm[:, None]

    total = np.sum(mass, axis=1) - 1
    spread1 = np.sum(mass * (x1**2 + s2), axis=1) / ASPECTS**2 - 0.5
    spread2 = np.sum(mass * (x2**2 + s2), axis=1) - 0.5
    loss += moment_weight * (total**2 + spread1**2 + spread2**2)
    m0, m1, m2 = (2 * moment_weight * m[:, None] for m in (total, spread1 / ASPECTS**2, spread2))
    d_mass += m0 + m1 * (x1**2 + s2) + m2 * (x2**2 + s2)
    d_x1 += 2 * mass * x1 * m1
    d_x2 += 2 * mass * x2 * m2
    d_s2 += mass * (m1 + m2)

    weight = node_weights(samples)
    gradient = np.stack([d_x1 * rho, d_x2, 2 * s2 * d_s2, d_mass * count / samples]) * weight[:, None]
    if samples % 2:
        gradient[:2, :, 0] = 0
    p = unknowns.reshape(4, len(ASPECTS), -1)
    step = np.diff(p, axis=1)
    scale = _SMOOTHNESS / samples * count / np.diff(np.log(ASPECTS))[:, None]
    bend = 2 * scale * step
    gradient[:, 1:] += bend
    gradient[:, :-1] -= bend
    return float(np.sum(weight * loss) + np.sum(scale * step**2)), gradient.ravel()


def quantiser(samples: int, aspect: float, seed: int) -> Mixtures:
    """Symmetric k-means of the lobe at one aspect, the same at every node; a start for `fit`."""
    rng = np.random.default_rng([seed, samples, round(100 * aspect)])
    points = rng.normal(size=(6000, 2)) * np.sqrt(0.5) * [aspect, 1.0]
    half = (samples + 1) // 2
    best: tuple[float, Any] = (np.inf, None)
    for _ in range(3):
        centres = points[rng.choice(len(points), half, replace=False)]
        for _ in range(40):
            if samples % 2:
                centres[0] = 0
            # |p -+ c|^2 = |p|^2 + |c|^2 -+ 2 p.c: the nearer of c and -c has p.c >= 0.
            along = points @ centres.T
            distance = np.sum(centres**2, axis=1) - 2 * np.abs(along)
            owner = np.argmin(distance, axis=1)
            near = points * np.where(along[np.arange(len(points)), owner] < 0, -1.0, 1.0)[:, None]
            size = np.maximum(np.bincount(owner, minlength=half), 1)
            centres = np.stack([np.bincount(owner, near[:, k], half) / size for k in (0, 1)], axis=1)
        off = near - centres[owner]
        if samples % 2:
            off = np.where(owner[:, None] == 0, points, off)
        spread = np.bincount(owner, np.sum(off**2, axis=1), half)
        if np.sum(spread) < best[0]:
            best = float(np.sum(spread)), (centres, size, spread)
    centres, size, spread = best[1]
    if samples % 2:
        centres[0] = 0
    # A little off the axis: on it the gradient across is 0 by symmetry.
    centres = centres + 1e-3 * rng.normal(size=centres.shape) * (np.arange(half) >= samples % 2)[:, None]
    share = samples * size / len(points) / copies(samples)
    log_s = np.log(np.clip(np.sqrt(0.5 * spread / size), 2 * WIDTHS[0], 0.9 * WIDTHS[1]))
    rows = np.ones((len(ASPECTS), 1))
    return Mixtures(samples, centres[:, 0] / aspect * rows, centres[:, 1] * rows, log_s * rows, share * rows)


def fit(
    start: Mixtures, kernel_error: float, moment_weight: float, iterations: int
) -> tuple[float, Mixtures]:
    """Minimise the loss from a start by L-BFGS within the bounds; return the loss and the mixtures."""
    size = start.y1.size
    bounds = (
        [(None, None)] * (2 * size)
        + [(float(np.log(WIDTHS[0])), float(np.log(WIDTHS[1])))] * size
        + [(0.0, _MOST_WEIGHT)] * size
    )
    result = minimize(
        loss_and_gradient,
        start.unknowns,
        args=(start.samples, kernel_error, moment_weight),
        jac=True,
        method="L-BFGS-B",
        bounds=bounds,
        options={"maxiter": iterations, "maxfun": 2 * iterations, "maxcor": 20, "ftol": 1e-10, "gtol": 1e-7},
    )
    return float(result.fun), unpack(start.samples, np.asarray(result.x))

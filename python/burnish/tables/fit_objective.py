"""Loss of Gaussian mixtures against an elliptic lobe, its gradient, and where to start.

A mixture has n samples of centre y, width s and weight w; all aspects of the lobe are fitted together. Only
half of the samples are unknown: pairs (y, -y) share s and w, and an odd n has one sample at 0.

Closeness is measured as light sees it. Up to an aspect of about n/5 round samples can fill the lobe, and the
least difference from it is the best mixture. Along longer lobes that minimum has narrow samples with gaps in
between, and light in a gap is missed: there the difference is measured at several scales, blurred by as many
Gaussians, and the mixture may be wider than the lobe.

The lobe is a sum of Gaussians itself (`fit_target`), so that all products are in closed form.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize

from burnish.tables.fit_target import ASPECTS, GAUSSIAN, Target

Float64 = NDArray[np.float64]

#: Least width of a sample, in units of the minor axis.
LEAST_WIDTH = 0.02
# Greatest one along lobes that samples do not fill, a multiple of rho/n.
_MOST_WIDTH_LONG = 2.0
# Deviations of the blurs, in minor axes; the first compares the mixture itself.
_SCALES = (0.0, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0)
# Weight of the unblurred difference against the blurred ones', along long lobes and, added, on short ones.
_SHARP, _SHARP_SHORT = 0.05, 1000.0
# Lobes are short up to this share of n, for the weight of sharpness; and the power.
_SHORT_SHARP = (0.2, 4)
#: The same for the minor axis' moment.
SHORT_MOMENT = (0.55, 8)
# Of points of starts, in minor axes.
_FARTHEST_START = 5.0
# Greatest weight of a sample, in units of 1/n.
_MOST_WEIGHT = 4.0
# Weight of the roughness along the aspect.
_SMOOTHNESS = 3e-3
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


def short_share(samples: int, until: tuple[float, int]) -> Float64:
    """How far each aspect counts as short: 1/(1 + (rho/(c n))^p) with (c, p) = `until`."""
    result: Float64 = 1 / (1 + (ASPECTS / (until[0] * samples)) ** until[1])
    return result


def greatest_widths(samples: int, target: Target) -> Float64:
    """Greatest width of a sample at each aspect, in units of the minor axis."""
    return np.maximum(target.most_width, _MOST_WIDTH_LONG * ASPECTS / samples)


def scale_weights(samples: int) -> Float64:
    """Weights c of the differences, (scales, aspects).

    Natural light has about as much energy in every octave, a spectrum of 1/f^2 = int 2 c exp(-c f^2) dc with
    c = sigma^2: blurs an octave apart count by their variance. That of 0 is what small lights see.
    """
    weights = np.repeat(np.array(_SCALES)[:, None] ** 2, len(ASPECTS), axis=1)
    weights[0] = _SHARP + _SHARP_SHORT * short_share(samples, _SHORT_SHARP)
    return weights


def loss_and_gradient(
    unknowns: Float64, samples: int, kernel_error: float, moment_weight: float, target: Target = GAUSSIAN
) -> tuple[float, Float64]:
    """Sum of the losses of all aspects, and its gradient.

    With the lobe K of `target`, x = (rho y1, y2), G_k = N(x_k, s_k^2 I), v_jk = s_j^2 + s_k^2 and blurs N_i
    of variance sigma_i^2, sigma_0 = 0:

        E = (sum_i c_i |(K - sum w G)*N_i|^2 + c_0 eps^2 sum_jk w_j w_k exp(-d_jk^2/(2 hc v_jk))/(2 pi v_jk))
            / sum_i c_i |K*N_i|^2 + lambda (m0^2 + m1^2 + short m2^2),
        m0 = sum w - 1, m1 = sum w (x1^2 + s^2)/rho^2 - 1/2, m2 = sum w (x2^2 + s^2) - 1/2;

    the first moments vanish by symmetry. For a lobe without second ones, roundness short ((m1 - m2)^2 +
    4 (sum w x1 x2/rho)^2) stands for the last two. A blur adds its variance to each Gaussian's. The term of
    eps is the expected error of lookups whose kernel differs from a Gaussian by a relative eps, alike for
    neighbours. Neighbouring aspects are drawn together by mu/n |p_{j+1} - p_j|^2/ln(rho_{j+1}/rho_j).
    `kernel_error` is eps, `moment_weight` lambda.
    """
    mixtures = unpack(samples, unknowns)
    rho = ASPECTS[:, None]
    count = copies(samples)
    x1, x2 = rho * mixtures.y1, mixtures.y2
    s2 = np.exp(2 * mixtures.log_s)
    mass = count * mixtures.share / samples

    # Products with each other: x_j with x_k and with -x_k, half of the copies each.
    v = s2[:, :, None] + s2[:, None, :]
    both = mass[:, :, None] * mass[:, None, :]
    offsets = [tuple(x[:, :, None] + sign * x[:, None, :] for x in (x1, x2)) for sign in (-1.0, 1.0)]
    squared = [e1**2 + e2**2 for e1, e2 in offsets]
    value, pull, widen = ([np.zeros_like(v), np.zeros_like(v)] for _ in range(3))
    loss, norm = np.zeros(len(ASPECTS)), np.zeros(len(ASPECTS))
    d_mass, d_x1, d_x2, d_s2 = (np.zeros_like(x1) for _ in range(4))
    for c, sigma in zip(scale_weights(samples), _SCALES, strict=True):
        blur = 2 * sigma**2
        # Products with the lobe.
        for part, spread in zip(target.share, target.spread, strict=True):
            v1, v2 = 0.5 * spread * rho**2 + s2 + blur, 0.5 * spread + s2 + blur
            peak = part * c[:, None] / (2 * np.pi * np.sqrt(v1 * v2))
            product = peak * np.exp(-0.5 * (x1**2 / v1 + x2**2 / v2))
            d_mass -= 2 * product
            d_x1 += 2 * mass * product * x1 / v1
            d_x2 += 2 * mass * product * x2 / v2
            d_s2 -= mass * product * (x1**2 / v1**2 + x2**2 / v2**2 - 1 / v1 - 1 / v2)
            loss -= 2 * np.sum(mass * product, axis=1)
        norm += c * target.squares(sigma)
        inverse = 1 / (v + blur)
        peak = c[:, None, None] * inverse / (2 * np.pi)
        for k in (0, 1):
            distance = squared[k] * inverse
            exact = peak * np.exp(-0.5 * distance)
            slope = exact  # -2 d value/d distance
            if sigma == 0:
                error = kernel_error**2 * peak * np.exp(-0.5 / _CORRELATION * distance)
                exact = exact + error
                slope = slope + error / _CORRELATION
            value[k] += exact
            pull[k] += slope * inverse
            widen[k] += inverse * (0.5 * slope * distance - exact)
    for k, (e1, e2) in enumerate(offsets):
        loss += 0.5 * np.sum(both * value[k], axis=(1, 2))
        d_mass += np.sum(mass[:, None, :] * value[k], axis=2)
        d_x1 -= np.sum(both * pull[k] * e1, axis=2)
        d_x2 -= np.sum(both * pull[k] * e2, axis=2)
        d_s2 += np.sum(both * widen[k], axis=2)

    loss = loss / norm + 1
    for gradient in (d_mass, d_x1, d_x2, d_s2):
        gradient /= norm[:, None]

    short = short_share(samples, SHORT_MOMENT)
    total = np.sum(mass, axis=1) - 1
    spread1 = np.sum(mass * (x1**2 + s2), axis=1) / ASPECTS**2
    spread2 = np.sum(mass * (x2**2 + s2), axis=1)
    skew = np.sum(mass * x1 * x2, axis=1) / ASPECTS
    if target.has_moments:
        spread1, spread2, skew = spread1 - 0.5, spread2 - 0.5, np.zeros_like(skew)
        loss += moment_weight * (total**2 + spread1**2 + short * spread2**2)
        slopes = (total, spread1 / ASPECTS**2, short * spread2, skew)
    else:
        uneven = target.roundness * short * (spread1 - spread2)
        skew = target.roundness * short * skew
        loss += moment_weight * (total**2 + uneven * (spread1 - spread2))
        loss += moment_weight * 4 * skew * np.sum(mass * x1 * x2, axis=1) / ASPECTS
        slopes = (total, uneven / ASPECTS**2, -uneven, 4 * skew / ASPECTS)
    m0, m1, m2, m12 = (2 * moment_weight * m[:, None] for m in slopes)
    d_mass += m0 + m1 * (x1**2 + s2) + m2 * (x2**2 + s2) + m12 * x1 * x2
    d_x1 += mass * (2 * x1 * m1 + x2 * m12)
    d_x2 += mass * (2 * x2 * m2 + x1 * m12)
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


def _draw(target: Target, count: int, rng: np.random.Generator) -> Float64:
    """Points of a round lobe, those of tails too far for a centre left out."""
    points: Float64 = rng.normal(size=(count, 2)) * np.sqrt(0.5)
    if len(target.share) == 1:
        return points
    spread = target.spread[rng.choice(len(target.share), size=count, p=target.share)]
    points = points * np.sqrt(spread)[:, None]
    near: Float64 = points[np.sum(points**2, axis=1) < _FARTHEST_START**2]
    return near


def quantiser(samples: int, aspect: float, seed: int, target: Target = GAUSSIAN) -> Mixtures:
    """Symmetric k-means of the lobe at one aspect, the same at every node; a start for `fit`."""
    rng = np.random.default_rng([seed, samples, round(100 * aspect)])
    points = _draw(target, 6000, rng) * [aspect, 1.0]
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
    log_s = np.log(np.clip(np.sqrt(0.5 * spread / size), 2 * LEAST_WIDTH, 0.9 * GAUSSIAN.most_width))
    rows = np.ones((len(ASPECTS), 1))
    return Mixtures(samples, centres[:, 0] / aspect * rows, centres[:, 1] * rows, log_s * rows, share * rows)


def fit(
    start: Mixtures, kernel_error: float, moment_weight: float, iterations: int, target: Target = GAUSSIAN
) -> tuple[float, Mixtures]:
    """Minimise the loss from a start by L-BFGS within the bounds; return the loss and the mixtures."""
    size = start.y1.size
    widest = np.repeat(np.log(greatest_widths(start.samples, target)), start.y1.shape[1])
    bounds = (
        [(None, None)] * (2 * size)
        + [(float(np.log(LEAST_WIDTH)), float(most)) for most in widest]
        + [(0.0, _MOST_WEIGHT)] * size
    )
    result = minimize(
        loss_and_gradient,
        start.unknowns,
        args=(start.samples, kernel_error, moment_weight, target),
        jac=True,
        method="L-BFGS-B",
        bounds=bounds,
        options={"maxiter": iterations, "maxfun": 2 * iterations, "maxcor": 20, "ftol": 1e-10, "gtol": 1e-7},
    )
    return float(result.fun), unpack(start.samples, np.asarray(result.x))

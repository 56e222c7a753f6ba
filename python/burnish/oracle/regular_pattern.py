"""Half-vectors on equally spaced circles around the normal (Regular Sampling 2014, section 5)."""

import math
from functools import lru_cache
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array
from .lobe.kurt import kurt_q

Spacing = Literal["s1", "s2"]

# More circles than this are never asked for: a lobe of aspect 1000 keeps 64 samples of some 150 circles.
_MAX_CIRCLES = 512


def _checked(roughness: npt.ArrayLike, threshold: float) -> tuple[float, float]:
    mx, my = (float(m) for m in np.broadcast_to(as_array(roughness), 2))
    if not (mx > 0 and my > 0 and math.isfinite(mx) and math.isfinite(my)):
        raise ValueError(f"roughness: expected finite slopes > 0, got {(mx, my)}")
    if not 0 < threshold < 1:
        raise ValueError(f"threshold: expected a number in (0, 1), got {threshold}")
    return mx, my


def largest_angle(mx: float, my: float, threshold: float) -> float:
    """Polar angle at which q falls to the threshold along the wider axis (eq. 11), radians."""
    return math.atan(math.sqrt(-math.log(threshold)) * max(mx, my))


def sample_pattern(
    roughness: npt.ArrayLike, spacing: Spacing = "s1", circles: int = 3, threshold: float = 0.1
) -> Array:
    """Place half-vectors on equally spaced circles around the normal.

    Parameters
    ----------
    roughness : float > 0, or two
        Slopes along tangent and bitangent.
    spacing : "s1" or "s2"
        s1: one sample at the normal and circles at i s, i = 1..circles-1, s = theta_max/(circles - 1/2), 6
        samples on the first. s2: circles at (i + 2/3) s, i = 0..circles-1, s = theta_max/(circles + 1/6), 4
        on the first.
    circles : int >= 1
        For s1 the sample at the normal counts as one.
    threshold : float in (0, 1)
        Half-vectors whose q falls below it are dropped (xi_0 in the paper).

    Returns
    -------
    half_vectors : (n, 3)
        Unit vectors in the tangent frame, from the normal outward, counter-clockwise on each circle.

    Notes
    -----
    Samples on a circle go with its circumference (eq. 13), ceil(n0 sin theta_i/sin theta_0): rounded to
    nearest the published 271 would be 269. For anisotropic lobes each circle is also tried turned
    by half a step; it stays turned if the samples it keeps then sum to more q.
    """
    mx, my = _checked(roughness, threshold)
    if circles < 1:
        raise ValueError(f"circles: expected an integer >= 1, got {circles}")
    if spacing == "s1":
        step = largest_angle(mx, my, threshold) / (circles - 0.5)
        angles, first_count = [i * step for i in range(1, circles)], 6
        kept = [np.array([[0.0, 0.0, 1.0]])]
    elif spacing == "s2":
        step = largest_angle(mx, my, threshold) / (circles + 1 / 6)
        angles, first_count = [(i + 2 / 3) * step for i in range(circles)], 4
        kept = []
    else:
        raise ValueError(f'spacing: expected "s1" or "s2", got {spacing!r}')
    for theta in angles:
        # The first circle's quotient is a whole number that rounding must not push up.
        count = math.ceil(first_count * math.sin(theta) / math.sin(angles[0]) - 1e-9)
        kept.append(_ring(theta, count, mx, my, threshold))
    return np.concatenate(kept)


def _ring(theta: float, count: int, mx: float, my: float, threshold: float) -> Array:
    best = np.empty((0, 3))
    best_sum = 0.0
    for shift in (0.0, 0.5) if mx != my else (0.0,):
        azimuth = 2 * np.pi * (np.arange(count) + shift) / count
        x, y = np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth)
        h = np.stack([x, y, np.full(count, np.cos(theta))], axis=-1)
        q = kurt_q(h, mx, my)
        survives = q >= threshold
        total = float(np.sum(q[survives]))
        # Both can be equal but for rounding: then the circle stays as it is.
        if total > best_sum * (1 + 1e-9):
            best, best_sum = h[survives], total
    return best


def choose_pattern(roughness: npt.ArrayLike, samples: int, threshold: float = 0.1) -> Array:
    """Return the pattern whose count is closest to `samples`, over both spacings and all numbers of circles.

    Of equally close ones the larger count wins, then s1, then fewer circles.
    """
    _checked(roughness, threshold)
    if samples < 1:
        raise ValueError(f"samples: expected an integer >= 1, got {samples}")
    mx, my = np.broadcast_to(as_array(roughness), 2)
    return _choose(float(mx), float(my), samples, threshold)[2].copy()


@lru_cache(maxsize=64)
def _choose(mx: float, my: float, samples: int, threshold: float) -> tuple[Spacing, int, Array]:
    best: tuple[Any, ...] | None = None
    found: tuple[Spacing, int, Array] | None = None
    spacings: tuple[Spacing, ...] = ("s1", "s2")
    for spacing in spacings:
        for circles in range(1, _MAX_CIRCLES + 1):
            pattern = sample_pattern((mx, my), spacing, circles, threshold)
            rank = (abs(len(pattern) - samples), -len(pattern), spacing, circles)
            if len(pattern) > 0 and (best is None or rank < best):
                best, found = rank, (spacing, circles, pattern)
            if len(pattern) > 2 * samples + 8:
                break
    assert found is not None  # s1 with one circle always has its one sample
    return found


def lobe_solid_angle(mx: float, my: float, threshold: float) -> float:
    """Solid angle of the half-vectors with q >= threshold, steradian.

    They fill an ellipse of semi-axes a = mx sqrt(-ln threshold), b likewise, in the plane of slopes. With
    x = a s cos psi, y = b s sin psi the integral over s is closed, leaving a b integral dpsi/(w (w + 1)),
    w^2 = 1 + (a cos psi)^2 + (b sin psi)^2.
    """
    mx, my = _checked((mx, my), threshold)
    reach = math.sqrt(-math.log(threshold))
    a, b = mx * reach, my * reach
    psi = 2 * np.pi * np.arange(1024) / 1024  # the rule converges geometrically on periodic functions
    w = np.sqrt(1 + (a * np.cos(psi)) ** 2 + (b * np.sin(psi)) ** 2)
    return float(a * b * 2 * np.pi * np.mean(1 / (w * (w + 1))))

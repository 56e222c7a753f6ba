"""Lobes that mixtures are fitted to: sums of Gaussians themselves."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burnish.oracle.matched_table import ASPECT_COUNT, LARGEST_ASPECT

Float64 = NDArray[np.float64]

#: Aspects of the lobe that have a row of the table.
ASPECTS: Float64 = LARGEST_ASPECT ** (np.arange(ASPECT_COUNT) / (ASPECT_COUNT - 1))
# Greatest width of a sample where samples fill the lobe, in units of the minor axis.
_MOST_WIDTH = 1.2
# Of a lobe with a tail, which one or two wide samples stand for.
_MOST_WIDTH_STUDENT = 12.0
# Weight of their variances being equal on short lobes: what differs would turn with the plane of view.
_STUDENT_ROUNDNESS = 0.3


@dataclass(frozen=True)
class Target:
    """A lobe sum_a c_a N(0, t_a/2 diag(rho^2, 1)), its minor axis the unit."""

    share: Float64  # c, of sum 1
    spread: Float64  # t
    has_moments: bool  # whether the mixture keeps its variances
    most_width: float  # of a sample where samples fill the lobe
    roundness: float = 0.0  # weight of variances being equal on short lobes, where they are not kept

    def squares(self, sigma: float) -> Float64:
        """Integrals of the squares of the lobes of all ASPECTS, blurred by a deviation."""
        spread = 0.5 * (self.spread[:, None] + self.spread)[..., None]
        areas = (spread * ASPECTS**2 + 2 * sigma**2) * (spread + 2 * sigma**2)
        shares = (self.share[:, None] * self.share)[..., None]
        result: Float64 = np.sum(shares / (2 * np.pi * np.sqrt(areas)), axis=(0, 1))
        return result


#: exp(-r^2)/pi.
GAUSSIAN = Target(np.ones(1), np.ones(1), has_moments=True, most_width=_MOST_WIDTH)


def student_target(window: float) -> Target:
    """(1 + r^2)^-2 exp(-r^2/(2 R^2)), R = `window`, infinite for none.

    (1 + r^2)^-2/pi = int_0^inf u exp(-u) (u/pi) exp(-u r^2) du/u: Gaussians of variance 1/(2u), on a grid
    even in ln u. The window adds 1/(2 R^2) to each u. Variances are infinite without it.
    """
    u = np.exp(np.linspace(math.log(1e-3), math.log(14.0), 15))
    windowed = u + 0.5 / window**2
    share = u * np.exp(-u) * u / windowed
    return Target(
        share / np.sum(share),
        1 / windowed,
        has_moments=False,
        most_width=_MOST_WIDTH_STUDENT,
        roundness=_STUDENT_ROUNDNESS,
    )

"""Which candidate to take: the cheapest whose error meets the target, found with few measurements."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

MOST_PROBES = 12
DOUBT, CORRECTED_DOUBT = 1.15, 1.04
"""A candidate whose error is only estimated is tried up to this factor above the target: it may do better.

The second is for families that have been measured at another count.
"""


@dataclass(frozen=True)
class Candidate:
    """A sampler with a count, what it is predicted to cost and how wrong it is predicted to be.

    Parameters
    ----------
    sampler : str
        As text, such as ``matched:14``.
    family : str
        The sampler without its count: errors of one family fall together.
    count : int
        Lookups per lobe and pixel.
    predicted_error : float
        Relative RMSE.
    predicted_ms : float
        Of the whole frame.
    is_probed : bool
        Whether the error was measured on a small picture of this scene; else it is the model's, corrected by
        what was measured of the family.
    """

    sampler: str
    family: str
    count: int
    predicted_error: float
    predicted_ms: float
    is_probed: bool = False


@dataclass(frozen=True)
class Choice:
    """What a search found.

    Parameters
    ----------
    candidates : list of Candidate
        All of them, with the errors as they are known in the end, cheapest first.
    chosen : Candidate
        The cheapest that meets the target, or the one that comes closest.
    meets_target : bool
        Whether it does.
    """

    candidates: list[Candidate]
    chosen: Candidate
    meets_target: bool


def correct_errors(candidates: Sequence[Candidate], measured: dict[str, float]) -> list[Candidate]:
    """Put measured errors in, and correct those of the same family by the same factor.

    The factor of a count between two measured ones is interpolated in the logarithms; beyond them it is that
    of the nearest.

    Parameters
    ----------
    candidates : sequence of Candidate
        With the model's errors.
    measured : dict
        Errors by sampler text.
    """
    known: dict[str, list[tuple[float, float]]] = {}
    for one in candidates:
        if one.sampler in measured:
            factor = math.log(max(measured[one.sampler], 1e-12) / max(one.predicted_error, 1e-12))
            known.setdefault(one.family, []).append((math.log(one.count), factor))
    corrected = []
    for one in candidates:
        if one.sampler in measured:
            corrected.append(replace(one, predicted_error=measured[one.sampler], is_probed=True))
        elif one.family in known:
            factor = _interpolate(sorted(known[one.family]), math.log(one.count))
            corrected.append(replace(one, predicted_error=one.predicted_error * math.exp(factor)))
        else:
            corrected.append(one)
    return corrected


def _interpolate(points: list[tuple[float, float]], x: float) -> float:
    for (x0, y0), (x1, y1) in pairwise(points):
        if x0 <= x <= x1 and x1 > x0:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return points[0][1] if x < points[0][0] else points[-1][1]


def _doubt(candidate: Candidate, measured_families: set[str]) -> float:
    if candidate.is_probed:
        return 1.0
    return CORRECTED_DOUBT if candidate.family in measured_families else DOUBT


def find_cheapest(
    candidates: Sequence[Candidate],
    target_error: float,
    measure: Callable[[str], float] | None = None,
    most_probes: int = MOST_PROBES,
) -> Choice:
    """Find the cheapest candidate whose error is at most the target.

    Candidates are tried by price, the cheapest first, as far as their estimate is within `DOUBT` of the
    target; what is measured corrects the estimates of the family. The first that is measured to meet the
    target is the choice: no cheaper one is left that is expected to.

    Parameters
    ----------
    candidates : sequence of Candidate
        At least one.
    target_error : float
        Relative RMSE.
    measure : callable or None
        Gives the error of a sampler, by its text. None: the estimates are all there is.
    most_probes : int
        Measurements that are worth the wait.

    Returns
    -------
    choice : Choice
    """
    if not candidates:
        raise ValueError("candidates: expected at least one, got none")
    by_price = sorted(candidates, key=lambda one: (one.predicted_ms, one.predicted_error))
    measured: dict[str, float] = {}
    while True:
        current = correct_errors(by_price, measured)
        can_probe = measure is not None and len(measured) < most_probes
        families = {one.family for one in current if one.is_probed}
        hopeful = [
            one
            for one in current
            if one.predicted_error <= target_error * (_doubt(one, families) if can_probe else 1.0)
        ]
        if hopeful and (hopeful[0].is_probed or not can_probe):
            return Choice(current, hopeful[0], True)
        if hopeful:
            unsure = hopeful[0]
        else:
            closest = min(current, key=lambda one: one.predicted_error)
            if closest.is_probed or not can_probe:
                return Choice(current, closest, False)
            unsure = closest
        assert measure is not None
        measured[unsure.sampler] = measure(unsure.sampler)


def pareto(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Candidates that no other beats in both error and price, by growing price.

    Parameters
    ----------
    candidates : sequence of Candidate
        In any order.
    """
    front: list[Candidate] = []
    for one in sorted(candidates, key=lambda c: (c.predicted_ms, c.predicted_error)):
        if not front or one.predicted_error < front[-1].predicted_error:
            front.append(one)
    return front

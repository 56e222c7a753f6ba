"""What a frame will take, from a small picture of the same view and the rates of the device."""

from dataclasses import dataclass

import numpy as np

from burnish.advice.cost_model import SHADE_KIND, CostModel, Traits, traits_of_class
from burnish.frame import Frame

ONCE = ("upload", "pyramid", "prefilter", "irradiance", "pack")
"""Kinds of passes that run when something has changed, not in every frame."""


@dataclass(frozen=True)
class FrameCost:
    """Prices of one view at one size.

    Parameters
    ----------
    costs : CostModel
        Rates of the device.
    fixed_ms : float
        What does not depend on the sampler: surface, tiles, background, read-back.
    shaded : tuple of (Traits, pixels)
        What objects cover, by kind of material.
    """

    costs: CostModel
    fixed_ms: float
    shaded: tuple[tuple[Traits, float], ...]

    def frame_ms(self, family: str, count: int) -> float:
        """Predict the milliseconds of a frame by the device's clock, without what is done once.

        Parameters
        ----------
        family : str
            A key of ``burnish.advice.families.FAMILIES``.
        count : int
            Lookups a lobe.
        """
        shade_ns = sum(
            pixels * self.costs.shade_ns(family, count, traits)
            for traits, pixels in self.shaded
            if pixels > 0
        )
        return self.fixed_ms + 1e-6 * shade_ns


def learn_frame_cost(
    costs: CostModel, survey: Frame, family: str, count: int, size: tuple[int, int]
) -> FrameCost:
    """Learn from a small, warm picture what covers a large one of the same view.

    The shares of the kinds of material are those of the time that their passes took, each over its rate.

    Parameters
    ----------
    costs : CostModel
        Rates of the device.
    survey : Frame
        The small picture.
    family, count
        The sampler that drew it.
    size : (height, width)
        Of the large picture.
    """
    report = survey.report
    small_pixels, pixels = survey.alpha.size, size[0] * size[1]
    covered = pixels * float(np.mean(survey.alpha > 0))
    small_fixed = sum(one["milliseconds"] for one in report.passes if one["kind"] not in (SHADE_KIND, *ONCE))
    fixed_ms = small_fixed + 1e-6 * costs.fixed_ns() * max(0, pixels - small_pixels)
    # One pass for each class, in their order.
    times = [one["milliseconds"] for one in report.passes if one["kind"] == SHADE_KIND]
    shares = []
    for one, shade_ms in zip(report.classes, times, strict=True):
        traits = traits_of_class(one["values"])
        rate = costs.shade_ns(family, count, traits)
        shares.append((traits, shade_ms / rate if rate > 0 else 0.0))
    total = sum(share for _, share in shares)
    shaded = tuple((traits, covered * share / total) for traits, share in shares if total > 0)
    return FrameCost(costs, fixed_ms, shaded)


def equal_shares(costs: CostModel, traits: list[Traits], pixels: float) -> FrameCost:
    """Price a picture of which nothing is known yet: every kind of material covers as much.

    Parameters
    ----------
    costs : CostModel
        Rates of the device.
    traits : list of Traits
        Kinds of material.
    pixels : float
        Of the picture.
    """
    return FrameCost(costs, 0.0, tuple((one, pixels / len(traits)) for one in traits))

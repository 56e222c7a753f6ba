"""A small picture of the scene itself, judged against the truth: what the error model cannot know.

The truth is made of sums over every texel of the scene's maps, reduced to the fewest texels that the
narrowest lobe leaves nearly unchanged (`truth`): coarse maps cost a hundredth. They still allow a thousand
pixels or so, of which one may happen to be a bright rim, or none. So the picture is drawn in the size that
was asked for as well, against a dense sampler, and the two are put together by a ratio:

    error^2 = (sum |c - s|^2 / sum |s|^2 on the large) (sum |c - t|^2 / sum |c - s|^2 on the small)

with c the candidate, s the dense sampler, t the truth. Where s errs more than c on the small one, as it does
under a small sun, c - s says little of c, and the small picture has to do: but for a highlight that only the
large one shows, where c is farther from s than s can be from the truth.
"""

import math
import warnings
from typing import Any

import numpy as np

from burnish import _core
from burnish.advice.reduced_maps import largest_face_size, reduced_face_size
from burnish.advice.truth import DENSE, draw_dense, draw_truth
from burnish.frame import Frame
from burnish.rendering import Filter, draw
from burnish.samplers import sampler_from_text

SURVEY_PIXELS = 1500
COVERED_PIXELS = 1000
MOST_COVERED = 100_000
"""Pixels with objects that the dense sampler may draw: about two seconds on two cores. A picture of more is
judged by a smaller one."""

MOST_PIXELS = 1_000_000
MOST_TERMS = 2.5e8
"""Pixels times texels that the sum over every texel may take: some seconds on two cores."""

HALF_DENSE = "importance:512:fibonacci"

LEAST_PIXELS = 250
"""With fewer for the sum over every texel the ratio is chance: the dense sampler is better."""

SURE = 2.0
"""Errors of the dense sampler that a candidate may be away from it without a doubt about the candidate."""

LARGEST_RATIO = 2.0
"""The dense sampler may err as much as the candidate, not more: a larger ratio is one pixel's chance."""


def scaled_size(size: tuple[int, int], pixels: float) -> tuple[int, int]:
    """Give a picture of about so many pixels the shape of another.

    Parameters
    ----------
    size : (height, width)
        Whose shape it gets.
    pixels : float
        How many there shall be.
    """
    height, width = size
    scale = math.sqrt(pixels / (height * width))
    return max(1, round(height * scale)), max(1, round(width * scale))


def squared_distance(one: Frame, other: Frame) -> float:
    """Sum of squared differences where the other shows objects, in double precision.

    Parameters
    ----------
    one, other : Frame
        Of the same view and size.
    """
    covered = other.alpha > 0
    difference = one.color[covered].astype(np.float64) - other.color[covered]
    return float(np.sum(difference**2))


def relative_distance(one: Frame, other: Frame) -> float:
    """Relative RMSE of one picture against another where the other shows objects.

    Parameters
    ----------
    one, other : Frame
        Of the same view and size.
    """
    return math.sqrt(squared_distance(one, other) / max(energy_of(other), 1e-30))


def energy_of(frame: Frame) -> float:
    """Sum of squared radiance where objects are.

    Parameters
    ----------
    frame : Frame
        Any.
    """
    return float(np.sum(np.square(frame.color[frame.alpha > 0], dtype=np.float64)))


class Probe:
    """Small pictures of one view, and their truth.

    While a probe draws its truth the scene holds reduced maps: no other thread may use it then.

    Parameters
    ----------
    scene : Scene
        As it will be rendered.
    camera : Camera or None
        As for `burnish.render`.
    size : (height, width)
        Of the picture that is asked for.
    filter : "box", "gauss4" or "gauss6"
        Of the pyramid.
    device : Device
        Where.
    covered_pixels : int
        Pixels with objects that the small picture aims at.
    most_terms : float
        Pixels times texels that its truth may take.
    """

    def __init__(
        self,
        scene: _core.Scene,
        camera: _core.Camera | None,
        size: tuple[int, int],
        filter: Filter,
        device: _core.Device,
        covered_pixels: int = COVERED_PIXELS,
        most_terms: float = MOST_TERMS,
    ) -> None:
        self._scene, self._camera, self._filter, self._device = scene, camera, filter, device
        self._wanted, self._covered_pixels = size, covered_pixels
        self._most_terms = most_terms
        self._face_size = min(reduced_face_size(list(scene.materials)), largest_face_size(scene))
        self._can_sum = False
        self._own_errors: dict[tuple[int, int], float] = {}
        self._coverage = 1.0
        self._small = self._large = scaled_size(size, SURVEY_PIXELS)
        self._truth: Frame | None = None
        self._dense: tuple[Frame, Frame] | None = None
        self.truth_text = ""

    @property
    def size(self) -> tuple[int, int]:
        """Height and width of the small picture."""
        return self._small

    def survey(self, sampler: str) -> Frame:
        """Draw a first picture, warm, to learn coverage and cost; it sets the sizes of the others.

        Parameters
        ----------
        sampler : str
            As text.
        """
        self.draw(sampler_from_text(sampler), self._small)
        frame = self.draw(sampler_from_text(sampler), self._small)
        self._coverage = max(float(np.mean(frame.alpha > 0)), 1e-6)
        affordable = self._most_terms / (6 * self._face_size**2)
        self._can_sum = affordable >= LEAST_PIXELS
        wanted = self._covered_pixels
        self._small = self._fit(min(wanted, int(affordable)) if self._can_sum else wanted)
        self._large = self._fit(MOST_COVERED)
        return frame

    def _fit(self, covered_pixels: int) -> tuple[int, int]:
        """Give the size that was asked for, or a smaller one in which objects cover so many pixels."""
        pixels = min(covered_pixels / self._coverage, MOST_PIXELS)
        is_small = self._wanted[0] * self._wanted[1] <= pixels
        return self._wanted if is_small else scaled_size(self._wanted, pixels)

    def draw(self, sampler: Any, size: tuple[int, int]) -> Frame:
        """Draw a picture of the view.

        Parameters
        ----------
        sampler : Regular, Importance, Matched, Prefiltered or Reference
            Any.
        size : (height, width)
            Pixels.
        """
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)
            return draw(self._scene, self._camera, size, sampler, self._device, 1, self._filter)

    def error(self, sampler: str) -> float:
        """Measure the relative RMSE of a sampler where objects are.

        Parameters
        ----------
        sampler : str
            As text.
        """
        made = sampler_from_text(sampler)
        small, truth = self.draw(made, self._small), self.truth
        exact = squared_distance(small, truth)
        of_small = relative_distance(small, truth)
        if self._small == self._large and self._can_sum:
            return of_small
        dense_small, dense_large = self._dense_pictures()
        proxy = relative_distance(self.draw(made, self._large), dense_large)
        if self._can_sum and squared_distance(dense_small, truth) >= exact:
            if proxy <= of_small:
                return of_small
            return max(of_small, proxy - SURE * self._dense_error(self._large))
        if not self._can_sum:
            # The dense sampler sees the same diffuse light, whose error is known.
            own = self._dense_error(self._small)
            return math.hypot(proxy, own, dense_large.report.diffuse_error)
        ratio = exact / max(squared_distance(small, dense_small), 1e-30)
        return proxy * math.sqrt(min(ratio, LARGEST_RATIO))

    def _dense_error(self, size: tuple[int, int]) -> float:
        """Estimate the relative RMSE of the dense sampler in one of the pictures, from half its lookups."""
        if size not in self._own_errors:
            dense = self._dense_pictures()[0 if size == self._small else 1]
            half = self.draw(sampler_from_text(HALF_DENSE), size)
            # Its error falls nearly as 1/n: what the two differ by is about that of the better one.
            self._own_errors[size] = relative_distance(half, dense)
        return self._own_errors[size]

    @property
    def truth(self) -> Frame:
        """The small picture by a sum over every texel, or by the dense sampler where that takes too long."""
        if self._truth is None:
            self._truth = self._draw_truth()
        return self._truth

    def _dense_pictures(self) -> tuple[Frame, Frame]:
        if self._dense is None:
            small, large = (
                draw_dense(self._scene, self._camera, size, self._filter, self._device)
                for size in (self._small, self._large)
            )
            self._dense = (small, large)
        return self._dense

    def _draw_truth(self) -> Frame:
        dense = self._dense_pictures()[0]
        if not self._can_sum:
            self.truth_text = DENSE
            return dense
        self.truth_text = f"sums over every texel of {self._face_size}-texel faces"
        view = (self._scene, self._camera, self._small, self._filter, self._device)
        return draw_truth(*view, self._face_size, dense)

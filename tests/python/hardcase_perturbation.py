"""Whether a hard case can fail: what the device gave is replayed to it with an error, and it must notice.

An error is ten times what the case allows: a measure that is a thousand times too small passes it by.
"""

from collections.abc import Callable
from contextlib import contextmanager
from functools import partial
from types import SimpleNamespace

import numpy as np
import pytest

from burnish import _core, hardcases
from burnish.frame import Frame
from burnish.hardcases import map_cases, picture_cases, pyramid_cases
from burnish.hardcases.loader_cases import lat_long_sun_error
from burnish.hardcases.quantities import refusal

TIMES_BOUND = 10.0
LEAST_ERROR, LARGEST_ERROR = 1e-5, 0.5
LAST_DIGIT = 2.0**-10  # of a half float, relative

Change = Callable[[np.ndarray], np.ndarray]


def scaled(factor: float, values: np.ndarray) -> np.ndarray:
    return np.asarray(values * np.asarray(factor, values.dtype))


def with_one(value: float, values: np.ndarray) -> np.ndarray:
    """The largest replaced: light that nobody would miss otherwise."""
    changed = values.copy()
    changed.flat[np.argmax(values)] = value
    return changed


def added(value: float, values: np.ndarray) -> np.ndarray:
    return values + np.asarray(value, values.dtype)


def of_levels(which: slice, change: Change, levels: list[np.ndarray]) -> list[np.ndarray]:
    chosen = range(len(levels))[which]
    return [change(level) if k in chosen else level for k, level in enumerate(levels)]


def of_frame(frame: Frame, color: Change = np.asarray, alpha: Change = np.asarray) -> SimpleNamespace:
    return SimpleNamespace(color=color(frame.color), alpha=alpha(frame.alpha), report=frame.report)


def of_any(change: Change, given: object) -> object:
    """Change the radiance of whatever the device gives."""
    if isinstance(given, Frame):
        return of_frame(given, change)
    if isinstance(given, _core.Environment):
        return SimpleNamespace(faces=change(given.faces))
    if isinstance(given, list):
        return of_levels(slice(-1, None), change, given)
    return change(given)


def one_black_pixel(frame: Frame) -> SimpleNamespace:
    color = frame.color.copy()
    color[np.unravel_index(np.argmax(frame.alpha), frame.alpha.shape)] = 0.0
    return of_frame(frame, lambda _: color)


def changes(quantity: str, bound: float) -> list[Callable[[object], object]]:
    """Errors of which the case must notice every one."""
    if "not finite or negative" in quantity or "not finite, negative" in quantity:
        return [partial(of_any, partial(with_one, value)) for value in (np.nan, np.inf, -1e-3)]
    if quantity == "largest value where all is black":
        return [partial(of_any, partial(added, LEAST_ERROR))]
    if quantity == "share of pixels wrongly covered":
        return [lambda frame: of_frame(frame, alpha=partial(with_one, 0.0))]
    if quantity == "share of covered pixels that are black":
        return [one_black_pixel]
    if quantity == "step across edges over step within faces":
        lift = partial(scaled, 1 + LARGEST_ERROR)
        return [
            lambda levels: of_levels(
                slice(None), lambda level: np.concatenate([lift(level[:1]), level[1:]]), levels
            )
        ]
    if quantity == "error in half floats' last digit":
        return [partial(of_levels, slice(1, 2), partial(scaled, 1 + TIMES_BOUND * bound * LAST_DIGIT))]
    error = np.clip(TIMES_BOUND * bound, LEAST_ERROR, LARGEST_ERROR)
    return [partial(of_any, partial(scaled, 1 + error))]


class Replay:
    """Calls of the device, recorded once; then given again, the first of them changed."""

    def __init__(self) -> None:
        self.results: list[object] = []
        self.next = -1  # recording
        self.change: Callable[[object], object] | None = None

    def watch(self, function, is_truth=False):
        def call(*arguments, **named):
            if self.next < 0:
                self.results.append(function(*arguments, **named))
                return self.results[-1]
            given = self.results[self.next]
            self.next += 1
            if self.change is None or is_truth:
                return given
            change, self.change = self.change, None
            return change(given)

        return call

    @contextmanager
    def watching(self, bench):
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(bench, "shade", self.watch(bench.shade))
            patch.setattr(bench, "twin", self.watch(bench.twin, is_truth=True))
            patch.setattr(picture_cases, "draw", self.watch(picture_cases.draw))
            patch.setattr(map_cases, "shade", self.watch(map_cases.shade))
            patch.setattr(pyramid_cases, "_levels", self.watch(pyramid_cases._levels))
            patch.setattr(_core, "capture", self.watch(_core.capture))
            yield


def measure_and_perturb(case, sampler, bench):
    """The measurement, and those of the same case with an error each."""
    replay = Replay()
    with replay.watching(bench):
        found = hardcases.measure(case, sampler, bench)
        perturbed = []
        for change in changes(found.quantity, found.bound) if replay.results else []:
            replay.next, replay.change = 0, change
            perturbed.append(hardcases.measure(case, sampler, bench))
    return found, perturbed


def without_device(case, patch):
    """Measure a case that asks no device: loaders that repair nothing, arguments that are not refused."""
    if case.quantity.measure.__code__ is refusal(lambda _: None).measure.__code__:
        return refusal(lambda _: None).measure(None, "")
    from_lat_long = _core.Environment.from_lat_long

    class Careless:
        """Keeps what it is given, counts nothing, and loses a millionth of a sun's light ten times."""

        @staticmethod
        def from_faces(faces):
            return SimpleNamespace(faces=faces, texel_report=SimpleNamespace(**dict.fromkeys(COUNTS, 0)))

        @staticmethod
        def from_lat_long(image, face_size):
            return SimpleNamespace(faces=from_lat_long(image, face_size).faces * np.float32(1 - 1e-5))

    patch.setattr("burnish.hardcases.loader_cases._core", SimpleNamespace(Environment=Careless))
    assert case.quantity.measure is lat_long_sun_error or case.quantity.name.startswith("texels not counted")
    return case.quantity.measure(None, "")


COUNTS = ("not_a_number", "infinite", "negative", "above_half")

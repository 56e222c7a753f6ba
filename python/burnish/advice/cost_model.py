"""Milliseconds of a frame: a fixed part, and for every shaded pixel of a class a + b n nanoseconds a lobe.

The rates are measured on the device when they are first needed, in about a second for each kind of material,
and kept in the user's cache folder, in one file for each device, driver and version of burnish.
"""

import hashlib
import json
import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any

from burnish import _core, builtin
from burnish._version import __version__
from burnish.advice.families import FAMILIES, sampler_text
from burnish.images.files import write_text
from burnish.rendering import draw
from burnish.samplers import sampler_from_text

SIZE = (96, 256)
"""Pixels of the pictures that are timed, all of them covered."""

RUNS = 3
SHADE_KIND = "shade"
ALPHA_OF_FORM = (0.0, 0.5, 0.3)
"""Grazing exponents that stand for the forms of a pipeline: none, a square root, a power."""
FIXED = "fixed"


@dataclass(frozen=True)
class Traits:
    """What of a material decides the time of a pixel.

    Parameters
    ----------
    lobe_count : int
        Lobes; each takes all lookups.
    has_fresnel : bool
        Whether any r0 is below 1.
    alpha : float
        0, .5, or another, .3 standing for all of them.
    is_brushed : bool
        Whether a lobe is anisotropic.
    """

    lobe_count: int
    has_fresnel: bool
    alpha: float
    is_brushed: bool

    def key(self) -> str:
        """Name them in the cache; the number of lobes multiplies and is no part of it."""
        words = ["brushed" if self.is_brushed else "round"]
        words += ["fresnel"] if self.has_fresnel else []
        return ", ".join([*words, f"alpha {self.alpha:g}"])


def traits_of_class(values: Mapping[str, int]) -> Traits:
    """Read the traits of a shade pipeline from the values of effects that a report or a plan gives.

    Parameters
    ----------
    values : dict
        By effect, such as ``{"lobe": 1, "fresnel": 1, "alpha": 1, "anisotropy": 0}``.
    """
    alpha = ALPHA_OF_FORM[values["alpha"]]
    return Traits(values["lobe"], bool(values["fresnel"]), alpha, bool(values["anisotropy"]))


def cache_path(device: _core.Device) -> Path | None:
    """File that holds the rates of a device, in the engine's cache; None where that is switched off.

    Parameters
    ----------
    device : Device
        Its name, driver and lookup and the version of burnish decide the file's name.
    """
    name = f"{device.name}|{device.driver}|{device.lookup}|{__version__}"
    folder = _core.cache_folder()
    return folder / f"cost-{hashlib.sha256(name.encode()).hexdigest()[:12]}.json" if folder else None


class CostModel:
    """Nanoseconds a pixel on one device.

    Parameters
    ----------
    device : Device
        Where the frames will run.
    path : path or None
        File that keeps the rates. None: `cache_path`.
    """

    def __init__(self, device: _core.Device, path: Path | None = None) -> None:
        self._device = device
        self._path = path or cache_path(device)
        self._rates: dict[str, dict[str, float]] = self._load()

    def shade_ns(self, family: str, count: int, traits: Traits) -> float:
        """Nanoseconds of one pixel in the shade pass; measured now if they are not known yet.

        Parameters
        ----------
        family : str
            A key of `FAMILIES`.
        count : int
            Lookups a lobe.
        traits : Traits
            Of the material. Without a lobe nothing depends on the sampler: 0.
        """
        if traits.lobe_count == 0:
            return 0.0
        rates = self._find(family, traits)
        return traits.lobe_count * interpolate_rate({int(n): ns for n, ns in rates.items()}, count)

    def fixed_ns(self) -> float:
        """Nanoseconds of one pixel in everything else: surface, tiles, background, read-back."""
        if FIXED not in self._rates:
            self._rates[FIXED] = {"1": measure_fixed_ns(self._device)}
            self._save()
        return self._rates[FIXED]["1"]

    def _find(self, family: str, traits: Traits) -> dict[str, float]:
        key = f"{family} | {traits.key()}"
        if key not in self._rates:
            self._rates[key] = measure_rates(self._device, family, traits)
            self._save()
        return self._rates[key]

    def _load(self) -> dict[str, dict[str, float]]:
        if self._path is None:
            return {}
        try:
            return dict(json.loads(self._path.read_text(encoding="utf-8"))["rates_ns"])
        except (OSError, ValueError, KeyError, TypeError):
            return {}  # absent or damaged: it is measured again

    def _save(self) -> None:
        if self._path is None:
            return
        data = {
            "device": self._device.name,
            "driver": self._device.driver,
            "lookup": self._device.lookup,
            "version": __version__,
            "date": datetime.now(timezone.utc).isoformat(timespec="seconds"),
            "rates_ns": self._rates,
        }
        try:
            self._path.parent.mkdir(parents=True, exist_ok=True)
            write_text(self._path, json.dumps(data, indent=1) + "\n")
        except OSError:
            pass  # a read-only home: the rates last as long as the process

    def forget(self) -> None:
        """Delete what is known, so that it is measured again."""
        self._rates = {}
        if self._path is not None:
            self._path.unlink(missing_ok=True)


def interpolate_rate(rates: dict[int, float], count: int) -> float:
    """Nanoseconds at a count, by straight lines through the measured ones, and along the outer ones beyond.

    Parameters
    ----------
    rates : dict
        Nanoseconds by count.
    count : int
        Lookups.
    """
    points = sorted(rates.items())
    if len(points) == 1:
        return points[0][1]
    upper = next((k for k in range(1, len(points)) if count <= points[k][0]), len(points) - 1)
    (n0, t0), (n1, t1) = points[upper - 1], points[upper]
    value = t0 + (t1 - t0) * (count - n0) / (n1 - n0)
    return max(value, 0.1 * min(t0, t1))


def measure_fixed_ns(device: _core.Device) -> float:
    """Time what does not depend on the sampler, by pictures of two sizes; nanoseconds a pixel.

    Parameters
    ----------
    device : Device
        Where.
    """
    scene, camera = _timed_scene(Traits(1, False, 0.0, False))
    scales = (1, 2)
    times: dict[int, list[float]] = {scale: [] for scale in scales}
    for run in range(RUNS + 1):
        for scale in scales:
            size = (scale * SIZE[0], scale * SIZE[1])
            passes = draw(scene, camera, size, _core.Matched(5), device).report.passes
            if run > 0:
                others = [one["milliseconds"] for one in passes if one["kind"] != SHADE_KIND]
                times[scale].append(sum(others))
    small, large = (statistics.median(times[scale]) for scale in scales)
    return max(0.0, 1e6 * (large - small) / (3 * SIZE[0] * SIZE[1]))


def _timed_scene(traits: Traits) -> tuple[_core.Scene, _core.Camera]:
    """A sphere so near that it fills the picture: every pixel is shaded, seen under 0 to 50 degrees."""
    lobe = _core.KurtLobe(
        roughness=(0.2, 0.06) if traits.is_brushed else 0.15,
        r0=0.5 if traits.has_fresnel else 1.0,
        alpha=traits.alpha,
    )
    scene = _core.Scene.sphere(_core.Material(lobes=[lobe]))
    scene.environment = builtin.make_environment("studio", 128)
    half_height = 0.75 * SIZE[0] / SIZE[1]
    return scene, _core.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=half_height)


def measure_rates(device: _core.Device, family: str, traits: Traits) -> dict[str, float]:
    """Time a family on a material: medians of alternating runs, warm.

    Parameters
    ----------
    device : Device
        Where.
    family, traits
        As for `CostModel.shade_ns`.

    Returns
    -------
    rates : dict
        Nanoseconds a pixel and lobe, by count as text.
    """
    scene, camera = _timed_scene(traits)
    counts = FAMILIES[family].timed_counts
    times: dict[int, list[float]] = {count: [] for count in counts}
    for run in range(RUNS + 1):
        for count in counts:
            sampler: Any = sampler_from_text(sampler_text(family, count))
            report = draw(scene, camera, SIZE, sampler, device).report
            if run > 0:  # the first compiles and uploads
                passes = report.passes
                times[count].append(sum(one["milliseconds"] for one in passes if one["kind"] == SHADE_KIND))
    pixels = SIZE[0] * SIZE[1]
    return {str(count): 1e6 * statistics.median(run) / pixels for count, run in times.items()}

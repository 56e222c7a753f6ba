"""`Matched` against the published samplers, cell by cell: lobe, band of the view's cosine, map, count.

An average over a sphere hides grazing views of brushed lobes: they are few pixels, and the worst ones. Here a
cell's error is compared with the least of all rivals' at the same count, their mip bias tuned for that cell.
"""

import hashlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.lobes import Lobe, model_of, width_of
from burnish.rendering import shade
from burnish.samplers import Sampler
from burnish.study.calibration_points import WeightedPoints, points_at_angle

Float32 = NDArray[np.float32]

BANDS = ((0.005, 0.1), (0.1, 0.3), (0.3, 1.0))
"""Of the cosine between normal and view: grazing, slanting, from above."""

COUNTS = (5, 8, 14, 30)

LOBES: dict[str, _core.KurtLobe] = {
    "m .05": _core.KurtLobe(0.05),
    "m .1": _core.KurtLobe(0.1),
    "m .3": _core.KurtLobe(0.3),
    "m .6": _core.KurtLobe(0.6),
    "m .4, r0 .04, alpha .5": _core.KurtLobe(0.4, r0=0.04, alpha=0.5),
    "m .2/.075": _core.KurtLobe((0.2, 0.075)),
    "m .3/.1, alpha .5": _core.KurtLobe((0.3, 0.1), alpha=0.5),
    "m .3/.06": _core.KurtLobe((0.3, 0.06)),
    "m .1/.02": _core.KurtLobe((0.1, 0.02)),
    "m .4/.03": _core.KurtLobe((0.4, 0.03)),
}

MODELS: dict[str, dict[str, Lobe]] = {
    "kurt": dict(LOBES),
    "ggx": {
        "alpha .03": _core.GgxLobe(0.03),
        "alpha .1": _core.GgxLobe(0.1),
        "alpha .1, r0 .04": _core.GgxLobe(0.1, r0=0.04),
        "alpha .2": _core.GgxLobe(0.2),
        "alpha .3": _core.GgxLobe(0.3),
        "alpha .6": _core.GgxLobe(0.6),
        "alpha 1": _core.GgxLobe(1.0),
        "alpha .2/.05": _core.GgxLobe((0.2, 0.05)),
        "alpha .4/.1": _core.GgxLobe((0.4, 0.1)),
        "alpha .4/.05": _core.GgxLobe((0.4, 0.05)),
    },
}
"""Lobes of every model that `Matched` is judged with."""

WORST_RATIOS = ((6.0, 1.0), (float("inf"), 1.1))
"""Largest aspect of a lobe, and what its cells' ratios are held to."""


@dataclass(frozen=True)
class Cell:
    """One cell; errors are relative RMSE of linear radiance over its points."""

    lobe: str
    band: int
    environment: str
    samples: int
    matched: float
    rivals: tuple[tuple[str, float], ...]
    """Settings of the published samplers, and their errors."""

    @property
    def rival_sampler(self) -> str:
        """Of all rivals the one that errs least."""
        return min(self.rivals, key=lambda rival: rival[1])[0]

    @property
    def rival(self) -> float:
        """The least error of a rival."""
        return min(error for _, error in self.rivals)

    @property
    def ratio(self) -> float:
        """Error of `Matched` over the best rival's: above 1 it loses."""
        return self.matched / self.rival

    @property
    def name(self) -> str:
        """Lobe, band, map and count."""
        low, high = BANDS[self.band]
        return f"{self.lobe}, cosine {low:g} to {high:g}, {self.environment}, n = {self.samples}"


def rivals(samples: int, model: str = "kurt") -> list[Sampler]:
    """Settings of the published samplers at one count: footprints, point sets and mip biases.

    The published footprint is printed for Kurt's lobe alone.
    """
    return [
        *(
            _core.Regular(samples, footprint=footprint, mip_bias=bias)
            for footprint in ("published", "exact")
            if footprint == "exact" or model == "kurt"
            for bias in (-1.0, 0.0)
        ),
        *(
            _core.Importance(samples, points=points, mip_bias=bias)
            for points in ("hammersley", "fibonacci")
            for bias in (-1.0, 0.0, 1.0)
        ),
    ]


def band_points(
    environment: _core.Environment, lobe: Lobe, count: int, rng: np.random.Generator
) -> list[WeightedPoints]:
    """Draw points of each band, cosines of the view even within it.

    They reflect bright parts of the map more often, and weights undo it: of even points a cell under a small
    lamp would have one or two that decide it.
    """
    width = float(np.sqrt(2.0 * np.prod(width_of(lobe))))
    return [points_at_angle(environment, width, rng.uniform(*band, count), count, rng) for band in BANDS]


def _truth(
    environment: _core.Environment,
    material: _core.Material,
    reference: Sampler,
    points: tuple[Float32, Float32, Float32],
    device: _core.Device | None,
    folder: Path | None,
) -> Float32:
    """The reference's radiance, from `folder` where it has been there before."""
    if folder is None:
        return shade(environment, material, reference, *points, device=device)
    key = hashlib.sha256(f"{material.lobes[0]}, {reference}".encode())
    for array in (environment.faces, *points):
        key.update(np.ascontiguousarray(array).tobytes())
    path = folder / f"{key.hexdigest()[:32]}.npy"
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        np.save(path, shade(environment, material, reference, *points, device=device))
    stored: Float32 = np.load(path)
    return stored


def _errors(color: Float32, truth: Float32, groups: Sequence[WeightedPoints]) -> list[float]:
    """Relative RMSE of each band."""
    parts = zip(groups, np.split(color, len(groups)), np.split(truth, len(groups)), strict=True)
    return [group.relative_rmse(part, exact) for group, part, exact in parts]


def judge(
    environments: Mapping[str, Callable[[], _core.Environment]],
    lobes: Mapping[str, Lobe] = LOBES,
    counts: Sequence[int] = COUNTS,
    points: int = 240,
    seed: int = 31,
    reference: Sampler | None = None,
    device: _core.Device | None = None,
    truths: Path | None = None,
    progress: Callable[[Iterable[str]], Iterable[str]] = lambda names: names,
) -> list[Cell]:
    """Measure every cell.

    Parameters
    ----------
    environments : mapping
        Maps by name, each made when it is called.
    lobes : mapping
        Lobes by name.
    counts : sequence of int
        Samples, each one that `Matched` has a mixture of.
    points : int
        In each band.
    seed : int
        Of the points.
    reference : Reference or None
        What counts as the truth; None: `Reference(0.004)`.
    device : Device or None
        None: the best one.
    truths : Path or None
        Folder in which the reference's radiance is kept for later runs.
    progress : callable
        Wraps the names of maps, as `tqdm` does.
    """
    truth_sampler = reference if reference is not None else _core.Reference(0.004)
    cells = []
    for name in progress(list(environments)):
        environment = environments[name]()
        for lobe_name, lobe in lobes.items():
            material = _core.Material(lobes=[lobe])
            groups = band_points(environment, lobe, points, np.random.default_rng(seed))
            normals, tangents, views = (
                np.concatenate([getattr(group, part) for group in groups])
                for part in ("normals", "tangents", "views")
            )
            places = normals, tangents, views
            truth = _truth(environment, material, truth_sampler, places, device, truths)
            for count in counts:
                others = rivals(count, model_of(lobe))
                ours, *theirs = (
                    _errors(shade(environment, material, sampler, *places, device=device), truth, groups)
                    for sampler in (_core.Matched(count), *others)
                )
                for band in range(len(BANDS)):
                    errors = zip(map(str, others), (rival[band] for rival in theirs), strict=True)
                    cells.append(Cell(lobe_name, band, name, count, ours[band], tuple(errors)))
    return cells


def merge_kinds(cells: Iterable[Cell], kinds: Mapping[str, str]) -> list[Cell]:
    """Cells of kinds of maps: geometric means of errors over a kind's maps, for every setting by itself.

    Parameters
    ----------
    cells : iterable of Cell
        Of single maps.
    kinds : mapping
        Kind of each map; it takes the place of the map's name.
    """
    groups: dict[tuple[str, int, str, int], list[Cell]] = {}
    for cell in cells:
        key = cell.lobe, cell.band, kinds[cell.environment], cell.samples
        groups.setdefault(key, []).append(cell)
    merged = []
    for key, group in groups.items():
        theirs = np.array([[error for _, error in cell.rivals] for cell in group])
        names = (name for name, _ in group[0].rivals)
        errors = zip(names, np.exp(np.mean(np.log(theirs), axis=0)).tolist(), strict=True)
        ours = float(np.exp(np.mean(np.log([cell.matched for cell in group]))))
        merged.append(Cell(*key, ours, tuple(errors)))
    return merged


def limit(lobe: Lobe) -> float:
    """What the ratios of a lobe's cells are held to."""
    slopes = np.asarray(width_of(lobe))
    aspect = float(np.max(slopes) / np.min(slopes))
    return next(ratio for largest, ratio in WORST_RATIOS if aspect <= largest)


def as_rows(cells: Iterable[Cell]) -> list[dict[str, object]]:
    """For JSON."""
    return [
        {**asdict(cell), "rival": cell.rival, "rival_sampler": cell.rival_sampler, "ratio": cell.ratio}
        for cell in cells
    ]

"""Random hostile shading points: what they give must be finite and not negative, whatever the sampler.

Everything of a block follows from its number, so a block that fails is run again by that number alone.
"""

import itertools
import re
import sys
import warnings
from collections import Counter
from dataclasses import dataclass, field

import numpy as np
from tqdm import tqdm

import burnish
from burnish.filters import FILTERS

POINTS_PER_BLOCK = 1 << 18
# Up to so many lookups of a point are written out: seconds on a CPU device for each kind of material.
MOST_WRITTEN_OUT_SAMPLES = 80
# Every texel for every point: larger faces would take minutes.
LARGEST_QUADRATURE_FACE = 4
SUN = 1e7


def least_roughness() -> float:
    """Give the smallest roughness that a lobe takes."""
    for exponent in range(-6, 0):
        try:
            burnish.KurtLobe(roughness=(10.0**exponent, 1.0))
            return 10.0**exponent
        except ValueError:
            continue
    raise AssertionError("expected a lobe to take some roughness below 1")


def random_lobe(rng: np.random.Generator) -> burnish.KurtLobe:
    """Make a lobe from mirror to widest, round to 1000:1, at the ends of its ranges half of the time."""
    least = least_roughness()
    wide = 10.0 ** rng.uniform(np.log10(least), 0.0)
    narrow = wide / 10.0 ** rng.uniform(0.0, 3.0) if rng.random() < 0.5 else wide
    roughness = np.clip([wide, narrow] if rng.random() < 0.5 else [narrow, wide], least, 1.0)
    if rng.random() < 0.2:
        roughness = rng.choice([least, 1.0], 2)
    ends = [0.0, 1.0, float(rng.random())]
    return burnish.KurtLobe(
        roughness=(float(roughness[0]), float(roughness[1])),
        r0=tuple(map(float, rng.choice([*ends, 0.04], 3))) if rng.random() < 0.3 else float(rng.choice(ends)),
        alpha=float(rng.choice([*ends, 0.5])),
        weight=float(rng.choice([0.0, 1.0, 1e-6, 1e3])) if rng.random() < 0.3 else 1.0,
        rotation=float(rng.choice([0.0, rng.uniform(-7, 7), 1e4])),
        conserve_energy=bool(rng.random() < 0.5),
    )


def random_material(rng: np.random.Generator) -> burnish.Material:
    lobes = [random_lobe(rng) for _ in range(rng.choice([0, 1, 1, 1, 1, 2, 4]))]
    return burnish.Material(diffuse=float(rng.choice([0.0, 0.0, 0.5, 1.0])), lobes=lobes)


def random_environment(rng: np.random.Generator, largest_face: int = 256) -> burnish.Environment:
    """Make a map of one of the kinds that break sums, blurs and divisions."""
    size = 2 ** int(rng.integers(0, int(np.log2(largest_face)) + 1))
    faces = np.zeros((6, size, size, 3), np.float32)
    texels = faces.reshape(-1, 3)
    kind = rng.integers(0, 8)
    if kind == 1:  # one texel, all else black
        texels[rng.integers(len(texels))] = 1.0
    elif kind == 2:  # a sun in a dim sky
        texels[:] = rng.random(texels.shape) * 1e-3
        texels[rng.integers(len(texels))] = SUN
    elif kind == 3:
        texels[:] = SUN
    elif kind == 4:  # half of the texels as bright as half floats go
        texels[rng.random(len(texels)) < 0.5] = 65504.0
    elif kind == 5:  # every magnitude there is
        texels[:] = 10.0 ** rng.uniform(-44, 5, texels.shape)
    elif kind == 6:  # what broken files hold; it is repaired on the way in
        texels[:] = rng.random(texels.shape)
        texels.reshape(-1)[:: max(1, texels.size // 9)] = rng.choice([np.nan, np.inf, -np.inf, -1.0])
    elif kind == 7:
        texels[:] = 10.0 ** rng.normal(0, 1.5, texels.shape)
    rotation = float(rng.uniform(-360, 360)) if rng.random() < 0.5 else None
    return burnish.Environment.from_faces(
        faces, exposure=float(rng.choice([0, 0, -20, 10])), rotation=rotation
    )


def random_sampler(rng: np.random.Generator, block: int):
    """Take the samplers in turn, with random settings."""
    samples = int(rng.choice([1, 2, 5, 14, 30] if rng.random() < 0.3 else [80, 100]))
    bias = float(rng.choice([0.0, 0.0, -16.0, 16.0]))
    match block % 5:
        case 0:
            return burnish.Regular(
                samples=samples,
                threshold=float(rng.choice([0.2, 1e-6, 0.999])),
                footprint=str(rng.choice(["published", "exact"])),
                normalization=str(rng.choice(["published", "projected", "furnace"])),
                mip_bias=bias,
            )
        case 1:
            points = str(rng.choice(["hammersley", "fibonacci"]))
            return burnish.Importance(samples=samples, points=points, mip_bias=bias)
        case 2:
            return burnish.Matched(samples=int(rng.choice([2, 5, 14, 30, 64])))
        case 3:
            return burnish.Prefiltered()
        case _:
            method = str(rng.choice(["quadrature", "progressive"]))
            return burnish.Reference(standard_error=0.5, method=method, max_samples=64)


def _directions(rng: np.random.Generator, count: int) -> np.ndarray:
    """Unit vectors: anywhere, along axes, through edges and corners of the cube, and beside them."""
    anywhere = rng.standard_normal((count, 3))
    exact = rng.integers(-1, 2, (count, 3)).astype(float)
    exact[~exact.any(axis=1)] = (0.0, 0.0, -1.0)
    beside = exact + rng.standard_normal((count, 3)) * 10.0 ** rng.uniform(-9, -2, (count, 1))
    kind = rng.integers(0, 4, (count, 1))
    vectors = np.where(kind < 2, anywhere, np.where(kind == 2, exact, beside))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def random_points(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Make normals, tangents and views: half of them unit, the others as hostile as finite floats go."""
    normals, tangents, anywhere = (_directions(rng, count) for _ in range(3))
    across = np.cross(normals, anywhere) + 1e-12
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    tilt = 10.0 ** rng.uniform(-9, -1, (count, 1)) * rng.choice([-1.0, 0.0, 1.0], (count, 1))
    kind = rng.integers(0, 5, (count, 1))
    views = np.select(
        [kind == 0, kind == 1, kind == 2], [across + tilt * normals, normals, -normals], anywhere
    )
    broken = rng.random((count, 1)) < 0.5
    sizes = np.array([0.0, 1e-44, 1e-30, 1e-12, 1e-3, 0.3, 1.0, 1.0, 1.0, 1.0, 1.001, 1e3, 1e18, 3e38])
    along = rng.integers(0, 3, (count, 1))
    tangents = np.where(broken & (along == 0), normals, tangents)
    tangents = np.where(broken & (along == 1), normals + 1e-7 * tangents, tangents)

    def sized(vectors):
        return np.ascontiguousarray(
            np.where(broken, vectors * rng.choice(sizes, (count, 1)), vectors), np.float32
        )

    return sized(normals), sized(tangents), sized(views)


@dataclass
class Result:
    """What points gave: how many values, and how many of them must not be."""

    points: int = 0
    counts: Counter = field(default_factory=Counter)
    complaints: list[str] = field(default_factory=list)


def shade_hostile(environment, material, sampler, points, filter, device, result: Result, where: str) -> None:
    """Shade points and add what they give to the result; `where` says how to do it again."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        radiance = burnish.shade(environment, material, sampler, *points, filter=filter, device=device)
    stopped = [re.match(r"(\d+) values were not finite", str(warning.message)) for warning in caught]
    found = {
        "not finite": int(np.count_nonzero(~np.isfinite(radiance))),
        "negative": int(np.count_nonzero(radiance < 0)),
        "stopped on the device": sum(int(match[1]) for match in stopped if match),
    }
    result.points += len(radiance)
    result.counts.update(found)
    if any(found.values()):
        rows = np.flatnonzero(~(np.isfinite(radiance) & (radiance >= 0)).all(axis=1))
        first = (
            "" if not len(rows) else f", first normal, tangent, view: {[p[rows[0]].tolist() for p in points]}"
        )
        result.complaints.append(f"{where}: {found}, {sampler}, {material}, {environment}, {filter}{first}")


def compiles_long(sampler) -> bool:
    """Say whether lookups of a lobe are written out."""
    return (
        isinstance(sampler, burnish.Regular | burnish.Importance)
        and sampler.samples <= MOST_WRITTEN_OUT_SAMPLES
    )


def run_block(block: int, device: burnish.Device, result: Result, count: int = POINTS_PER_BLOCK) -> None:
    """Shade the points of one block: one sampler, a few materials, each in a few environments."""
    rng = np.random.default_rng(block)
    sampler = random_sampler(rng, block)
    material_count, environment_count = (1, 2) if compiles_long(sampler) else (3, 3)
    materials = [random_material(rng) for _ in range(material_count)]
    is_quadrature = getattr(sampler, "method", "") == "quadrature"
    largest_face = LARGEST_QUADRATURE_FACE if is_quadrature else 256
    environments = [random_environment(rng, largest_face) for _ in range(environment_count)]
    each = max(1, count // (len(materials) * len(environments)))
    for material, environment in itertools.product(materials, environments):
        filter = str(rng.choice(FILTERS))
        points = random_points(rng, each)
        shade_hostile(environment, material, sampler, points, filter, device, result, f"seed {block}")


def fuzz(count: int, seed: int) -> bool:
    """Shade `count` points or more in blocks from number `seed` on; print sums; say whether all is well."""
    device = burnish.Device()
    result = Result()
    block = seed
    with tqdm(total=count, desc="points", unit=" points", unit_scale=True, disable=None) as bar:
        while result.points < count:
            told = len(result.complaints)
            run_block(block, device, result)
            for complaint in result.complaints[told:]:
                tqdm.write(complaint, file=sys.stdout)
            bar.update(result.points - bar.n)
            block += 1
    print(
        f"{result.points} points, blocks {seed}..{block - 1}, on {device.name}, lookups by {device.lookup}: "
        + ", ".join(f"{number} values {name}" for name, number in result.counts.items())
    )
    if result.complaints:
        print("a block is run again by: scripts/fuzz points --count 1 --seed N")
    return not result.complaints

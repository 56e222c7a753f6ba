"""Measure relative RMSE over unseen spot environments for every sampler: the table of docs/accuracy.md."""

import argparse
import json
from collections.abc import Iterable
from datetime import date
from pathlib import Path

import numpy as np
from tqdm import tqdm

import burnish
from burnish import environments
from burnish.frame import relative_rmse

SEEDS = (1, 2, 3)  # the fit trains on others
SLOPES = ((0.05, 0.05), (0.1, 0.1), (0.15, 0.15), (0.3, 0.3), (0.6, 0.6), (0.2, 0.075), (0.3, 0.05))
COUNTS = (14, 30)
BIASES = tuple(np.arange(-1.5, 1.01, 0.25))
Points = tuple[np.ndarray, np.ndarray, np.ndarray]


def sphere_points(seed: int, count: int) -> Points:
    """Normals, tangents and views as the pixels of a sphere's picture have them, turned at random."""
    rng = np.random.default_rng(seed)

    def unit(vectors: np.ndarray) -> np.ndarray:
        return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)

    normals = unit(rng.standard_normal((count, 3)))
    tangents = unit(np.cross(normals, unit(rng.standard_normal((count, 3)))))
    cosine = np.sqrt(rng.uniform(0.01, 1, count))  # pixels are even in cos^2; the rim is left out
    azimuth = rng.uniform(0, 2 * np.pi, count)
    sine = np.sqrt(1 - cosine**2)
    across = np.cross(normals, tangents)
    views = (
        (sine * np.cos(azimuth))[:, None] * tangents
        + (sine * np.sin(azimuth))[:, None] * across
        + cosine[:, None] * normals
    )
    normals, tangents, views = (np.ascontiguousarray(one, np.float32) for one in (normals, tangents, views))
    return normals, tangents, views


def families(count: int, biases: Iterable[float]) -> dict[str, list[object]]:
    """Named settings of each sampler; of several the best one counts."""
    published = {"footprint": "published", "normalization": "published"}
    return {
        "Regular, published": [burnish.Regular(count, **published)],
        "Regular, exact": [burnish.Regular(count)],
        "Regular, best bias": [
            burnish.Regular(count, mip_bias=bias, **form) for bias in biases for form in ({}, published)
        ],
        "Importance, Hammersley, 0": [burnish.Importance(count)],
        "Importance, Hammersley, +1": [burnish.Importance(count, mip_bias=1)],
        "Importance, Fibonacci": [burnish.Importance(count, points="fibonacci")],
        "Importance, best bias": [
            burnish.Importance(count, points=points, mip_bias=bias)
            for bias in biases
            for points in ("hammersley", "fibonacci")
        ],
        "Prefiltered": [burnish.Prefiltered()],
        "Matched": [burnish.Matched(count)],
    }


def measure(face_size: int, point_count: int) -> list[dict[str, object]]:
    """One row for each sampler family, count and lobe; errors are means over the environments."""
    scenes = [(environments.spots(seed, face_size), sphere_points(seed, point_count)) for seed in SEEDS]
    rows: list[dict[str, object]] = []
    for slopes in tqdm(SLOPES, desc="lobes"):
        material = burnish.Material(lobes=[burnish.KurtLobe(roughness=slopes)])
        truths = [
            burnish.shade(environment, material, burnish.Reference(method="quadrature"), *points)
            for environment, points in scenes
        ]
        for count in COUNTS:
            for name, settings in families(count, BIASES).items():
                errors = [
                    [
                        relative_rmse(burnish.shade(environment, material, sampler, *points), truth)
                        for (environment, points), truth in zip(scenes, truths, strict=True)
                    ]
                    for sampler in settings
                ]
                means = np.mean(errors, axis=1)
                best = int(np.argmin(means))
                rows.append(
                    {
                        "sampler": name,
                        "samples": count,
                        "slopes": slopes,
                        "error": float(means[best]),
                        "by_environment": errors[best],
                        "settings": str(settings[best]),
                    }
                )
    return rows


def markdown(rows: list[dict[str, object]]) -> str:
    """Tables by count: samplers down, lobes across; then how far Matched is below the others' best."""
    lines = []
    for count in COUNTS:
        table = {
            (row["sampler"], row["slopes"]): float(str(row["error"]))
            for row in rows
            if row["samples"] == count
        }
        names = list(families(count, (0.0,)))
        heads = [f"{x:g}" if x == y else f"{x:g}/{y:g}" for x, y in SLOPES]
        lines += [f"| n = {count} | " + " | ".join(heads) + " |", "|---" * (len(SLOPES) + 1) + "|"]
        for name in names:
            cells = " | ".join(f"{table[name, slopes]:.4f}" for slopes in SLOPES)
            lines.append(f"| {name} | {cells} |")
        for other in ("Regular, best bias", "Importance, best bias"):
            cells = " | ".join(f"{table[other, one] / table['Matched', one]:.2f}" for one in SLOPES)
            lines.append(f"| {other} : Matched | {cells} |")
        lines.append("")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--face-size", type=int, default=1024, help="texels along a face (default: 1024)")
    parser.add_argument("--points", type=int, default=300, help="points under each map (default: 300)")
    parser.add_argument("--json", metavar="FILE", help="write all rows as JSON")
    options = parser.parse_args()
    rows = measure(options.face_size, options.points)
    device = burnish.Device()
    print(
        f"{device.name}, {device.driver}; {date.today()}; faces {options.face_size}, {options.points} points"
    )
    print()
    print(markdown(rows))
    if options.json:
        Path(options.json).write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

"""Judge `Matched` by cells against the best published sampler: tables of docs/accuracy.md.

A cell is a lobe, a band of the view's cosine, a kind of map and a count; its errors are geometric means over
the maps of a kind. Exits with 1 while the error of `Matched` over the best rival's is above its limit in any.
"""

import argparse
import json
import math
import sys
import warnings
from collections.abc import Callable
from datetime import date
from pathlib import Path

from tqdm import tqdm

import burnish
from burnish import environments
from burnish.study.cells import BANDS, COUNTS, MODELS, Cell, as_rows, judge, limit, merge_kinds

LOBES = {name: lobe for lobes in MODELS.values() for name, lobe in lobes.items()}
Maps = dict[str, tuple[str, Callable[[], burnish.Environment]]]
KINDS = ("real", "spots", "smooth", "suns")


def maps(files: list[Path], face_size: int) -> Maps:
    """Maps by name, with their kinds; the fit has seen none of them."""
    made: Maps = {}
    for path in files:
        made[path.stem] = "real", lambda path=path: burnish.Environment.from_file(path, face_size=face_size)
    for seed in (41, 42):
        made[f"spots {seed}"] = "spots", lambda seed=seed: environments.spots(seed, face_size)
    made["waves 43"] = "smooth", lambda: environments.spots(43, face_size, count=0)
    made["studio"] = "spots", lambda: environments.studio(face_size)
    made["sky"] = "suns", lambda: environments.sky(face_size=face_size)
    return made


def markdown(cells: list[Cell]) -> str:
    """Tables by count: lobes down, kinds of maps by bands across."""
    present = [kind for kind in KINDS if any(cell.environment == kind for cell in cells)]
    ratios = {(cell.lobe, cell.band, cell.samples, cell.environment): cell.ratio for cell in cells}
    lines = []
    for count in sorted({cell.samples for cell in cells}):
        heads = [f"{kind} {low:g}-{high:g}" for kind in present for low, high in BANDS]
        lines += [f"| n = {count} | " + " | ".join(heads) + " |", "|---" * (len(heads) + 1) + "|"]
        for lobe in dict.fromkeys(cell.lobe for cell in cells):
            row = []
            for kind in present:
                for band in range(len(BANDS)):
                    ratio = ratios[lobe, band, count, kind]
                    mark = "**" if ratio > limit(LOBES[lobe]) else ""
                    row.append(f"{mark}{ratio:.2f}{mark}")
            lines.append(f"| {lobe} | " + " | ".join(row) + " |")
        worst = max((cell for cell in cells if cell.samples == count), key=lambda cell: cell.ratio)
        lines += [
            "",
            f"Worst: {worst.name}: {worst.matched:.4f} against {worst.rival:.4f} of {worst.rival_sampler}.",
            "",
        ]
    return "\n".join(lines)


def print_behind(title: str, cells: list[Cell]) -> int:
    """Name the cells above their limit, with both errors; return how many there are."""
    behind = [cell for cell in cells if cell.ratio > limit(LOBES[cell.lobe])]
    mean = math.exp(sum(math.log(cell.ratio) for cell in cells) / len(cells))
    print(f"{title}: {len(behind)} of {len(cells)} above their limit, ", end="")
    print(f"{mean:.3f} of the best rival in the mean")
    for cell in sorted(behind, key=lambda cell: -cell.ratio):
        print(f"- {cell.name}: {cell.matched:.4f} against {cell.rival:.4f} of {cell.rival_sampler}")
    return len(behind)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("files", nargs="*", type=Path, help="real maps: .hdr or .exr files")
    parser.add_argument("--face-size", type=int, default=256, help="texels along a face (default: 256)")
    parser.add_argument("--model", choices=MODELS, default="kurt", help="of the lobes (default: kurt)")
    parser.add_argument("--points", type=int, default=240, help="points in each band (default: 240)")
    parser.add_argument("--counts", type=int, nargs="+", default=COUNTS, help="samples")
    parser.add_argument(
        "--truths", type=Path, help="folder that keeps the reference's radiance for later runs"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write all cells as JSON")
    options = parser.parse_args()
    # The reference of a lobe narrower than a texel may stop short of its standard error, and says so.
    warnings.simplefilter("ignore", RuntimeWarning)
    device = burnish.Device()
    made = maps(options.files, options.face_size)
    cells = judge(
        {name: make for name, (_, make) in made.items()},
        MODELS[options.model],
        counts=options.counts,
        points=options.points,
        device=device,
        truths=options.truths,
        progress=lambda names: tqdm(names, desc="maps"),
    )
    if options.json:
        options.json.write_text(json.dumps(as_rows(cells), indent=1) + "\n", encoding="utf-8")
    print(f"{device.name}, {device.driver}; {date.today()}; faces {options.face_size}, ", end="")
    print(f"{options.points} points a cell\n")
    kinds = merge_kinds(cells, {name: kind for name, (kind, _) in made.items()})
    print(markdown(kinds))
    behind = print_behind("Cells", kinds)
    print_behind("Cells of single maps, in which one point may decide", cells)
    sys.exit(int(behind > 0))


if __name__ == "__main__":
    main()

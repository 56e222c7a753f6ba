"""The command line of scripts/bench."""

import argparse
import json
import os
import sys
from collections.abc import Callable
from datetime import date
from pathlib import Path

from . import scaling
from .bench import Bench
from .changing_maps import bench_changing_maps, bench_one_of_many
from .compare import SLOWER, compare, read_run, table
from .compilation import bench_compilation
from .drivers import bench_drivers
from .effects import bench_effects
from .guards import bench_guards
from .hand_loop import bench_loop
from .lookups import bench_lookups
from .machine import bench_machine
from .samplers import bench_maps, bench_samplers
from .scaling_plot import plot_curves
from .shading import bench_display, bench_pyramids, bench_shading

PARTS: dict[str, tuple[Callable[[Bench], None], str]] = {
    "machine": (bench_machine, "memory copies"),
    "shading": (bench_shading, "a full 1080p frame, its passes, its lookups alone, its shading alone"),
    "lookups": (bench_lookups, "the driver's sampler against our own lookup, in a loop and written out"),
    "drivers": (bench_drivers, "both lookups on this driver and on a newer one, and which each is given"),
    "loop": (bench_loop, "the lookup of our own against a loop by hand in C++, one core and all"),
    "samplers": (bench_samplers, "Matched against Regular at equal counts"),
    "maps": (bench_maps, "levels that Matched and Prefiltered read"),
    "changing": (bench_changing_maps, "a new map in every frame against one that stays"),
    "many": (bench_one_of_many, "one of 24 maps replaced, and all of them"),
    "display": (bench_display, "8-bit sRGB made on the device or in numpy"),
    "pyramids": (bench_pyramids, "pyramids by three filters"),
    "compile": (bench_compilation, "the first picture of a roughness against its second"),
    "guards": (bench_guards, "shading with and without looking for values that are not finite"),
    "effects": (bench_effects, "every effect absent, present but zero, present"),
}
CURVES: dict[str, tuple[Callable[[Bench, bool], None], str]] = {
    "cores": (lambda bench, _: scaling.curve_of_cores(bench), "1, 2, 4, ... and all cores, a process each"),
    "pixels": (scaling.curve_of_pixels, "480p to 2160p; --full: 4320p, 1 GB"),
    "triangles": (scaling.curve_of_triangles, "1 k to 1 M; --full: 10 M, 3 GB"),
    "materials": (lambda bench, _: scaling.curve_of_materials(bench), "1 to 64 in view"),
    "lobes": (lambda bench, _: scaling.curve_of_lobes(bench), "1 to 4 a material"),
}


def _help() -> str:
    lines = [f"  {name:<12}{text}" for name, (_, text) in [*PARTS.items(), *CURVES.items()]]
    return "\n".join(
        [
            "parts, and curves (--scaling):",
            *lines,
            "",
            "Every measure is warm, and measures that are compared take turns, so that a machine that",
            "slows down slows down all of them: trust ratios of one run. What a change of the engine costs:",
            "",
            "  scripts/bench lookups samplers --json before.json",
            "  (change the engine)",
            "  scripts/bench lookups samplers --json after.json",
            "  scripts/bench --compare before.json after.json",
            "",
            "--compare calls slower or faster what lies farther than --margin from before with all of the",
            "99 % interval of the ratio of medians (bootstrap over all runs); it exits with 1 if anything is",
            "slower. Machines drift from minute to minute: to judge small changes go back and forth, always",
            "with the same two files, which then hold the runs of all times.",
            "On a CPU device every measure has a figure `cpu`, the time of all threads, which other work",
            "hardly changes: these are compared if both runs have them. What waits is not seen there;",
            "--figures '*' compares all.",
        ]
    )


def main() -> int:
    names = [*PARTS, *CURVES]
    parser = argparse.ArgumentParser(
        prog="scripts/bench",
        description="Measure the engine here.",
        epilog=_help(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("parts", nargs="*", metavar="PART", help="what to measure (default: all but curves)")
    parser.add_argument("--scaling", action="store_true", help="measure the curves and draw them")
    parser.add_argument("--full", action="store_true", help="also the dear ends of the curves, minutes")
    parser.add_argument("--repeats", type=int, default=9, help="runs of each (default: 9; curves take half)")
    parser.add_argument("--device", default="", help="part of a device's name")
    parser.add_argument(
        "--json", type=Path, metavar="FILE", help="write all runs, after those of FILE if it is of today"
    )
    parser.add_argument("--plot", type=Path, metavar="PNG", help="draw the curves, --json's FILE included")
    parser.add_argument(
        "--compare", type=Path, nargs="+", metavar="JSON", help="BEFORE AFTER, or BEFORE against this run"
    )
    parser.add_argument("--margin", type=float, default=0.05, help="least change (default: .05)")
    parser.add_argument("--figures", default="", metavar="PATTERN", help='compare these: "*" for all')
    options = parser.parse_args()
    if unknown := set(options.parts) - set(names):
        parser.error(f"PART: expected any of {', '.join(names)}, got {', '.join(sorted(unknown))}")
    if options.compare and len(options.compare) > 2:
        parser.error(f"--compare: expected BEFORE or BEFORE AFTER, got {len(options.compare)} files")
    if options.repeats < 1:
        parser.error(f"--repeats: expected at least 1, got {options.repeats}")

    files = [read_run(path) for path in options.compare or ()]
    if len(files) == 2:
        run = files.pop()
    else:
        run = measure(options)
    return judge(files[0], run, options.margin, options.figures) if files else 0


def measure(options: argparse.Namespace) -> dict:
    """Measure what is asked for, print, write, draw."""
    # Measures that take turns must not give back one another's pipelines.
    os.environ.setdefault("BURNISH_PIPELINES", "1000")
    bench = Bench(options.device, options.repeats)
    earlier = read_run(options.json) if options.json and options.json.exists() else {}
    print(f"{bench.device.name}, {bench.device.driver}; {date.today()}; medians of {options.repeats}")
    for name in options.parts or (CURVES if options.scaling else PARTS):
        if name in PARTS:
            PARTS[name][0](bench)
        else:
            CURVES[name][0](bench, options.full)
        sys.stdout.flush()
        run = add_runs(earlier, bench.to_dict())
        # After every part, so that what ends early leaves what it has.
        if options.json:
            options.json.write_text(json.dumps(run, indent=1) + "\n")
    plot = options.plot or (options.json.with_suffix(".png") if options.scaling and options.json else None)
    if plot and run["curves"]:
        plot_curves(run, plot)
    return run


def add_runs(earlier: dict, run: dict) -> dict:
    """Put what was measured earlier before it, if that was the same device, driver and day."""
    if not all(earlier.get(key) == run[key] for key in ("device", "driver", "date")):
        return run
    figures = {name: earlier["figures"].get(name, []) + runs for name, runs in run["figures"].items()}
    return (
        run
        | {key: earlier[key] | run[key] for key in ("statements", "curves")}
        | {"figures": earlier["figures"] | figures}
    )


def judge(before: dict, after: dict, margin: float, pattern: str) -> int:
    """Print the comparison; the exit status."""
    changes = compare(before, after, margin, pattern)
    print(table(before, after, changes, margin))
    return int(any(change.verdict == SLOWER for change in changes))


if __name__ == "__main__":
    sys.exit(main())

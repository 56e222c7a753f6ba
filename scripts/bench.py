"""Measure the engine here. Medians of alternating runs after a warm-up; compile time is never inside."""

import argparse
import json
import statistics
import tempfile
import time
from collections.abc import Callable
from datetime import date
from pathlib import Path

from bench_lookups import bench_lookups
from bench_samplers import bench_maps, bench_samplers
from bench_scenes import effect_scenes
from tqdm import tqdm

import burnish
from burnish import _core, environments

CAMERA = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=0.45, near_plane=0.1, far_plane=10)
PUBLISHED = burnish.Regular(samples=20, footprint="published", normalization="published")
SIZE = (1080, 1920)
PIXELS = SIZE[0] * SIZE[1]
ROUGHNESS = 0.1

Measure = Callable[[], dict[str, float]]


def alternate(measures: dict[str, Measure], repeats: int, text: str) -> dict[str, dict[str, float]]:
    """Run each once as a warm-up, then all in turn; medians of every number they give."""
    for measure in measures.values():
        measure()
    runs: dict[str, list[dict[str, float]]] = {name: [] for name in measures}
    for _ in tqdm(range(repeats), desc=text, delay=2, leave=False):
        for name, measure in measures.items():
            runs[name].append(measure())
    return {
        name: {key: statistics.median(run.get(key, 0.0) for run in rows) for key in rows[0]}
        for name, rows in runs.items()
    }


def pass_times(report: dict) -> dict[str, float]:
    return {entry["name"]: entry["milliseconds"] for entry in report["passes"]}


def frame_measure(device: burnish.Device, scene: burnish.Scene, sampler: object, spp: int = 1) -> Measure:
    def measure() -> dict[str, float]:
        began = time.perf_counter()
        data = _core.render(device, scene, CAMERA, *SIZE, sampler, spp, "gauss6", None)
        wall = 1e3 * (time.perf_counter() - began)
        times = pass_times(data.report)
        shade = sum(value for name, value in times.items() if name.startswith("shade"))
        fixed = {name: times[name] for name in ("surface", "tiles", "read back")}
        return {"wall": wall, "shade": shade, **fixed}

    return measure


def bench_shading(device: burnish.Device, repeats: int) -> dict:
    environment = environments.spots(1, 256)
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=ROUGHNESS)]))
    scene.environment = environment

    def shading(has_lookups: bool) -> Measure:
        return lambda: {
            "ms": pass_times(_core.time_shading(device, scene, CAMERA, PUBLISHED, has_lookups))["shade 0"]
        }

    def lookups() -> dict[str, float]:
        return {"ms": statistics.median(_core.time_lookups(device, environment, PUBLISHED, ROUGHNESS, 3)[1:])}

    result = alternate(
        {
            "frame": frame_measure(device, scene, PUBLISHED),
            "frame, exact + furnace": frame_measure(device, scene, burnish.Regular(samples=20)),
            "lookups alone": lookups,
            "shading alone": shading(False),
        },
        repeats,
        "shading",
    )
    samples = int(burnish.render(scene, CAMERA, (16, 16), PUBLISHED, device).report.samples_used)
    frame, alone = result["frame"], result["lookups alone"]["ms"]
    fixed = frame["surface"] + frame["tiles"] + frame["read back"]
    exact = result["frame, exact + furnace"]["shade"]
    print("\n1920 x 1080, every pixel shaded, one Kurt lobe, 256^2 faces, trilinear;")
    print(f"m = {ROUGHNESS}, regular, {samples} of 20 samples, footprint and normalization as published")
    for name, value, remark in (
        ("raw loop", samples * PIXELS / alone / 1e3, "M cube lookups/s"),
        ("whole frame", frame["wall"], "ms, to numpy"),
        ("shade pass", frame["shade"], f"ms, {frame['shade'] / alone:.2f} x lookups alone (target 1.35)"),
        ("lookups alone", alone, "ms"),
        ("shading alone", result["shading alone"]["ms"], "ms"),
        (
            "fixed part",
            fixed,
            f"ms: surface, tiles, read back: {fixed / frame['wall']:.1%} of the frame (target 20 %)",
        ),
        ("shade, exact", exact, f"ms, exact footprint and furnace: {exact / frame['shade']:.2f} x published"),
    ):
        print(f"  {name:<14}{value:10.4g} {remark}")
    return result


def bench_pyramids(device: burnish.Device, repeats: int) -> dict:
    result = {}
    print("\npyramid, RGBA16F, all levels, ms (ratio to box)")
    print("  faces " + "".join(f"{name:>20}" for name in ("box", "gauss4", "gauss6")))
    for size in (256, 512, 1024):
        environment = environments.uniform(1.0, size)

        def build(name: str, environment: burnish.Environment = environment) -> Measure:
            return lambda: {"ms": dict(_core.pyramid_times(device, environment, name))["pyramid"]}

        times = alternate(
            {name: build(name) for name in ("box", "gauss4", "gauss6")}, repeats, f"pyramid {size}"
        )
        result[size] = times
        box = times["box"]["ms"]
        print(f"  {size:5} " + "".join(f"{t['ms']:12.2f} ({t['ms'] / box:4.2f})" for t in times.values()))
    return result


def bench_effects(device: burnish.Device, repeats: int) -> dict:
    result = {}
    print("\nan effect absent, present but zero, present: ms at 1920 x 1080, regular 14")
    print(
        f"  {'effect':<26}{'absent':>10}{'zero':>10}{'present':>10}   zero/absent  present/absent   time of"
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, keys, scenes, spp in effect_scenes(Path(folder), environments.spots(1, 256)):
            measures = {
                state: frame_measure(device, scene, burnish.Regular(samples=14), frames)
                for state, scene, frames in zip(("absent", "zero", "present"), scenes, spp, strict=True)
            }
            result[name] = times = alternate(measures, repeats, name)
            for key in keys:
                absent, zero, present = (values[key] for values in times.values())
                print(
                    f"  {name:<26}{absent:10.3g}{zero:10.3g}{present:10.3g}"
                    f"   {zero / absent:11.2f}  {present / absent:14.2f}   {key}"
                )
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=9, help="runs of each (default: 9)")
    parser.add_argument("--json", type=Path, help="also write the numbers here")
    parser.add_argument("--device", default="", help="part of a device's name")
    options = parser.parse_args()
    device = burnish.Device(options.device)
    print(f"{device.name}, {device.driver}; {date.today()}; medians of {options.repeats}")
    result = {
        "device": device.name,
        "driver": device.driver,
        "date": str(date.today()),
        "shading": bench_shading(device, options.repeats),
        **(
            {"lookups": bench_lookups(options.device, alternate, options.repeats)}
            if device.is_software
            else {}
        ),
        "samplers": bench_samplers(device, frame_measure, alternate, options.repeats),
        "maps": bench_maps(device, alternate, max(3, options.repeats // 2)),
        "pyramids": bench_pyramids(device, options.repeats),
        "effects": bench_effects(device, max(3, options.repeats // 2)),
    }
    if options.json:
        options.json.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()

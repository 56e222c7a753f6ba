"""A full 1080p frame and its parts; 8 bits for a display; pyramids."""

import statistics
import time

import burnish
from burnish import _core, environments
from burnish.filters import FILTERS
from burnish.images import display_image

from .bench import PIXELS, PUBLISHED, ROUGHNESS, SIZE, Bench, Measure, camera, frame_measure, pass_times

PYRAMID_SIZES = (256, 512, 1024)


def bench_shading(bench: Bench) -> None:
    device = bench.device
    environment = environments.spots(1, 256)
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=ROUGHNESS)]))
    scene.environment = environment

    def without_lookups() -> dict[str, float]:
        report = _core.time_shading(device, scene, camera(), PUBLISHED, False)
        return {"ms": pass_times(report)["shade 0"]}

    def lookups() -> dict[str, float]:
        return {"ms": statistics.median(_core.time_lookups(device, environment, PUBLISHED, ROUGHNESS, 3)[1:])}

    times = bench.alternate(
        "shading",
        {
            "frame": frame_measure(device, scene, PUBLISHED),
            "frame, exact + furnace": frame_measure(device, scene, burnish.Regular(samples=20)),
            "lookups alone": lookups,
            "shading alone": without_lookups,
        },
    )
    samples = int(burnish.render(scene, camera(), (16, 16), PUBLISHED, device).report.samples_used)
    frame, alone = times["frame"], times["lookups alone"]["ms"]
    fixed = frame["surface"] + frame["tiles"] + frame["read back"]
    exact = times["frame, exact + furnace"]["shade"]
    print("\n1920 x 1080, every pixel shaded, one Kurt lobe, 256^2 faces, trilinear;")
    print(f"m = {ROUGHNESS}, regular, {samples} of 20 samples, footprint and normalization as published")
    for name, value, remark in (
        ("raw loop", samples * PIXELS / alone / 1e3, "M cube lookups/s"),
        ("whole frame", frame["wall"], "ms, to numpy"),
        ("shade pass", frame["shade"], "ms"),
        ("lookups alone", alone, "ms"),
        ("shading alone", times["shading alone"]["ms"], "ms"),
        ("fixed part", fixed, "ms: surface, tiles, read back"),
        ("shade, exact", exact, f"ms, exact footprint and furnace: {exact / frame['shade']:.2f} x published"),
    ):
        print(f"  {name:<14}{value:10.4g} {remark}")
    bench.state("shade pass / lookups alone", frame["shade"] / alone, 1.35, at_least=False)
    bench.state("fixed part / whole frame", fixed / frame["wall"], 0.2, at_least=False)


def bench_display(bench: Bench) -> None:
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=ROUGHNESS)]))
    scene.environment = environments.spots(1, 256)

    def picture(spp: int, output: burnish.rendering.Output, is_encoded: bool) -> Measure:
        def run() -> dict[str, float]:
            began = time.perf_counter()
            frame = burnish.render(
                scene, camera(1.2), SIZE, burnish.Matched(5), bench.device, spp=spp, output=output
            )
            if is_encoded:
                display_image(frame.color)
            return {"wall": 1e3 * (time.perf_counter() - began)}

        return run

    measures = {}
    for spp in (1, 4):
        measures |= {
            f"{spp} spp, linear": picture(spp, "linear", False),
            f"{spp} spp, linear, then display_image": picture(spp, "linear", True),
            f"{spp} spp, display output": picture(spp, "display", False),
        }
    print("\ndisplay: a sphere and the background, matched 5, 1920 x 1080")
    for name, row in bench.alternate("display", measures).items():
        print(f"  {name:<40}" + "".join(f"{key:>8}{value:8.1f} ms" for key, value in row.items()))


def bench_pyramids(bench: Bench) -> None:
    print("\npyramid, RGBA16F, all levels, ms (ratio to box); blit: the device's own, not seamless")
    print("  faces " + "".join(f"{name:>20}" for name in (*FILTERS, "blit")))
    for size in PYRAMID_SIZES:
        environment = environments.uniform(1.0, size)

        def build(name: str, environment: burnish.Environment = environment) -> Measure:
            return lambda: {"ms": dict(_core.pyramid_times(bench.device, environment, name))["pyramid"]}

        def blit(environment: burnish.Environment = environment) -> dict[str, float]:
            return {"ms": _core.time_blits(bench.device, environment)}

        measures = {name: build(name) for name in FILTERS} | {"blit": blit}
        times = bench.alternate(f"pyramid {size}", measures)
        box = times["box"]["ms"]
        print(f"  {size:5} " + "".join(f"{t['ms']:12.2f} ({t['ms'] / box:4.2f})" for t in times.values()))

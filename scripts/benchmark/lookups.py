"""The two lookups of CPU devices, the device's sampler and our own, as ratios in one run."""

import math
from collections.abc import Callable

import burnish
from burnish import _core, environments

from .bench import (
    CPU,
    PIPELINES,
    PUBLISHED,
    ROUGHNESS,
    SIZE,
    SMALL,
    Bench,
    Measure,
    camera,
    frame_measure,
    pass_times,
)
from .bench import sphere_scene as scene_of

ROUND = burnish.KurtLobe(roughness=ROUGHNESS)
BRUSHED = burnish.KurtLobe(roughness=(0.2, 0.075))
# Matched to Regular with 20 samples, as the prototype of the fast path had it.
PROTOTYPE = {5: 0.37, 8: 0.52, 14: 0.84, 20: 1.14}
BASELINE, OURS = "sampler, in a loop", "software, written out"

Devices = dict[str, list[burnish.Device]]


def covering(share: float) -> burnish.Camera:
    """View of the unit sphere that covers a share of the picture."""
    return camera(math.sqrt(math.pi * SIZE[0] / (4 * share * SIZE[1])))


def bench_lookups(bench: Bench) -> None:
    if not bench.device.is_software:
        print("\nboth lookups: left out, the device has a sampler in hardware")
        return
    devices = {
        name: [burnish.Device(bench.device_name, lookup=name) for _ in range(PIPELINES)]
        for name in ("sampler", "software")
    }
    environment = environments.spots(1, 256)
    _shade_passes(bench, devices, environment)
    _matched(bench, devices, environment)
    _frames(bench, devices, environment)


def _shade_passes(bench: Bench, devices: Devices, environment: burnish.Environment) -> None:
    scene = scene_of(ROUND, environment)

    def shading(lookup: str, is_written_out: bool) -> Callable[[int], Measure]:
        def run(k: int) -> dict[str, float]:
            report = _core.time_shading(devices[lookup][k], scene, camera(), PUBLISHED, True, is_written_out)
            return {"ms": pass_times(report)["shade 0"]}

        return lambda k: lambda: run(k)

    def raw(lookup: str) -> Callable[[int], Measure]:
        return lambda k: (
            lambda: {"ms": min(_core.time_lookups(devices[lookup][k], environment, PUBLISHED, ROUGHNESS, 2))}
        )

    times = bench.best_of(
        "lookups",
        {
            BASELINE: shading("sampler", False),
            "sampler, written out": shading("sampler", True),
            "software, in a loop": shading("software", False),
            OURS: shading("software", True),
            "lookups alone, sampler": raw("sampler"),
            "lookups alone, software": raw("software"),
        },
    )
    base = times[BASELINE]["ms"]
    print(
        "\nboth lookups: regular 20 as published, m = .1, 256^2 faces, every pixel of 1920 x 1080, shade"
        f"\npass; the better of {PIPELINES} pipelines each, medians of {bench.repeats} alternating runs"
    )
    for name, row in times.items():
        print(
            f"  {name:<32}{row['ms']:8.1f} ms   {base / row['ms']:5.2f} x as fast as the first;"
            f" of all threads, all passes {row[CPU]:8.1f} ms"
        )
    text = f"speed of the software lookup : {BASELINE}"
    bench.state(text, base / times[OURS]["ms"], 2.1)
    bench.state(f"{text}, by the time of all threads", times[BASELINE][CPU] / times[OURS][CPU])


def _matched(bench: Bench, devices: Devices, environment: burnish.Environment) -> None:
    scenes = {"round": scene_of(ROUND, environment), "brushed": scene_of(BRUSHED, environment)}

    def frame(scene: burnish.Scene, sampler: object) -> Callable[[int], Measure]:
        return lambda k: frame_measure(devices["software"][k], scene, sampler, first_size=SMALL)

    makers = {"regular 20": frame(scenes["round"], burnish.Regular(20))}
    makers |= {
        f"{name} {count}": frame(scene, burnish.Matched(count))
        for name, scene in scenes.items()
        for count in PROTOTYPE
    }
    times = bench.best_of("matched", makers)
    print(
        "\nmatched : regular 20 (exact, furnace), shade pass, software lookup (prototype, plain centre rule)"
    )
    for name in scenes:
        line = f"  {name:<10}"
        for count, wanted in PROTOTYPE.items():
            ratio = times[f"{name} {count}"]["shade"] / times["regular 20"]["shade"]
            line += f"  n {count}: {ratio:4.2f} ({wanted:4.2f})"
        print(line)


def _frames(bench: Bench, devices: Devices, environment: burnish.Environment) -> None:
    scene = scene_of(ROUND, environment)

    def frame(
        lookup: str, sampler: object, view: burnish.Camera, scene: burnish.Scene = scene
    ) -> Callable[[int], Measure]:
        return lambda k: frame_measure(devices[lookup][k], scene, sampler, view, first_size=SMALL)

    small, matched = covering(0.44), burnish.Matched(5)
    times = bench.best_of(
        "frames",
        {
            "sampler, regular 20": frame("sampler", PUBLISHED, small),
            "software, regular 20": frame("software", PUBLISHED, small),
            "software, matched 5": frame("software", matched, small),
            "software, regular 20, all covered": frame("software", PUBLISHED, camera()),
            "software, regular 20, 39 % covered": frame("software", PUBLISHED, covering(0.39)),
            "software, matched 5, 88 k triangles": frame(
                "software", matched, small, scene_of(ROUND, environment, 298)
            ),
            "software, matched 5, 1 M triangles": frame(
                "software", matched, small, scene_of(ROUND, environment, 1000)
            ),
        },
    )
    base = times["sampler, regular 20"]["wall"]
    print("\nframes to numpy, a sphere on 44 % of 1920 x 1080, no background: ms, shading, rest; ratio")
    for name, one in times.items():
        print(
            f"  {name:<36}{one['wall']:8.1f}{one['shade']:8.1f}{one['rest']:8.1f}   {one['wall'] / base:5.2f}"
        )

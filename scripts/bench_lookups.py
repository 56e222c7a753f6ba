"""The two lookups of CPU devices, the device's sampler and our own: a part of scripts/bench."""

import math
import time
from collections.abc import Callable

import burnish
from burnish import _core, environments

Measures = dict[str, Callable[[], dict[str, float]]]
Alternate = Callable[[Measures, int, str], dict[str, dict[str, float]]]
PUBLISHED = burnish.Regular(samples=20, footprint="published", normalization="published")
SIZE = (1080, 1920)
# The driver's compiler places about one pipeline in forty badly, for good: each is made twice, the better one
# counts.
PIPELINES = 2
ROUND = burnish.KurtLobe(roughness=0.1)
BRUSHED = burnish.KurtLobe(roughness=(0.2, 0.075))
# Matched to Regular with 20 samples, as the prototype of the fast path had it.
PROTOTYPE = {5: 0.37, 8: 0.52, 14: 0.84, 20: 1.14}


def camera(half_height: float) -> burnish.Camera:
    return burnish.Camera.orthographic(
        (0, 0, 3), (0, 0, 0), half_height=half_height, near_plane=0.1, far_plane=10
    )


FULL = camera(0.45)


def covering(share: float) -> burnish.Camera:
    """View of the unit sphere that covers a share of the picture."""
    return camera(math.sqrt(math.pi * SIZE[0] / (4 * share * SIZE[1])))


def sphere_scene(
    lobe: burnish.KurtLobe, environment: burnish.Environment, segments: int = 128
) -> burnish.Scene:
    scene = burnish.Scene()
    scene.add(burnish.Mesh.sphere(segments=segments), burnish.Material(lobes=[lobe]))
    scene.environment = environment
    scene.show_background = False
    return scene


def times_of(report: dict) -> dict[str, float]:
    return {entry["name"]: entry["milliseconds"] for entry in report["passes"]}


def best_of(
    makers: dict[str, Callable[[int], Callable[[], dict[str, float]]]],
    alternate: Alternate,
    repeats: int,
    text: str,
) -> dict[str, dict[str, float]]:
    """Medians of each measure with every one of its pipelines; the better of them, by the first number."""
    measures = {f"{name}|{k}": make(k) for name, make in makers.items() for k in range(PIPELINES)}
    times = alternate(measures, repeats, text)
    return {
        name: min((times[f"{name}|{k}"] for k in range(PIPELINES)), key=lambda one: next(iter(one.values())))
        for name in makers
    }


def bench_lookups(device_name: str, alternate: Alternate, repeats: int) -> dict:
    """Shade passes and whole frames with both lookups, as ratios in one run."""
    devices = {
        name: [burnish.Device(device_name, lookup=name) for _ in range(PIPELINES)]
        for name in ("sampler", "software")
    }
    environment = environments.spots(1, 256)
    scenes = {"round": sphere_scene(ROUND, environment), "brushed": sphere_scene(BRUSHED, environment)}

    def shading(lookup: str, has_constants: bool) -> Callable[[int], Callable[[], dict[str, float]]]:
        def run(k: int) -> dict[str, float]:
            report = _core.time_shading(
                devices[lookup][k], scenes["round"], FULL, PUBLISHED, True, has_constants
            )
            return {"ms": times_of(report)["shade 0"]}

        return lambda k: lambda: run(k)

    def raw(lookup: str) -> Callable[[int], Callable[[], dict[str, float]]]:
        return lambda k: (
            lambda: {"ms": min(_core.time_lookups(devices[lookup][k], environment, PUBLISHED, 0.1, 2))}
        )

    def frame(
        lookup: str, scene: burnish.Scene, view: burnish.Camera, sampler: object
    ) -> Callable[[int], Callable[[], dict[str, float]]]:
        def run(k: int) -> dict[str, float]:
            # Other scenes came between: the first frame brings this one back to the device.
            _core.render(devices[lookup][k], scene, view, 64, 64, sampler, 1, "gauss6", None)
            began = time.perf_counter()
            data = _core.render(devices[lookup][k], scene, view, *SIZE, sampler, 1, "gauss6", None)
            _ = data.color
            wall = 1e3 * (time.perf_counter() - began)
            shade = times_of(data.report)["shade 0"]
            return {"wall": wall, "shade": shade, "rest": wall - shade}

        return lambda k: lambda: run(k)

    result = best_of(
        {
            "sampler, table from a buffer": shading("sampler", False),
            "sampler, table in constants": shading("sampler", True),
            "software, table from a buffer": shading("software", False),
            "software, table in constants": shading("software", True),
            "lookups alone, sampler": raw("sampler"),
            "lookups alone, software": raw("software"),
        },
        alternate,
        repeats,
        "lookups",
    )
    base = result["sampler, table from a buffer"]["ms"]
    print(
        "\nboth lookups: regular 20 as published, m = .1, 256^2 faces, every pixel of 1920 x 1080, shade pass"
    )
    for name, times in result.items():
        print(f"  {name:<32}{times['ms']:8.1f} ms   {base / times['ms']:5.2f} x as fast as the first")

    matched = {
        f"{name} {count}": frame("software", scenes[name], FULL, burnish.Matched(count))
        for name in scenes
        for count in PROTOTYPE
    }
    regular = {"regular 20": frame("software", scenes["round"], FULL, burnish.Regular(20))}
    times = best_of(regular | matched, alternate, repeats, "matched")
    result["matched"] = times
    print(
        "\nmatched : regular 20 (exact, furnace), shade pass, software lookup (prototype, plain centre rule)"
    )
    for name in scenes:
        ratios = [times[f"{name} {count}"]["shade"] / times["regular 20"]["shade"] for count in PROTOTYPE]
        print(
            f"  {name:<10}"
            + "".join(
                f"  n {count}: {ratio:4.2f} ({wanted:4.2f})"
                for (count, wanted), ratio in zip(PROTOTYPE.items(), ratios, strict=True)
            )
        )

    small = covering(0.44)
    dense = {
        count: sphere_scene(ROUND, environment, segments) for count, segments in ((88, 298), (1000, 1000))
    }
    times = best_of(
        {
            "sampler, regular 20": frame("sampler", scenes["round"], small, PUBLISHED),
            "software, regular 20": frame("software", scenes["round"], small, PUBLISHED),
            "software, matched 5": frame("software", scenes["round"], small, burnish.Matched(5)),
            "software, regular 20, all covered": frame("software", scenes["round"], FULL, PUBLISHED),
            "software, regular 20, 39 % covered": frame(
                "software", scenes["round"], covering(0.39), PUBLISHED
            ),
            "software, matched 5, 88 k triangles": frame("software", dense[88], small, burnish.Matched(5)),
            "software, matched 5, 1 M triangles": frame("software", dense[1000], small, burnish.Matched(5)),
        },
        alternate,
        repeats,
        "frames",
    )
    result["frames"] = times
    base = times["sampler, regular 20"]["wall"]
    print("\nframes to numpy, a sphere on 44 % of 1920 x 1080, no background: ms, shading, rest; ratio")
    for name, one in times.items():
        print(
            f"  {name:<36}{one['wall']:8.1f}{one['shade']:8.1f}{one['rest']:8.1f}   {one['wall'] / base:5.2f}"
        )
    return result

"""Cost curves: how time grows with cores, pixels, triangles, materials and lobes."""

from collections.abc import Mapping, Sequence

import burnish
from burnish import environments

from .bench import CPU, PUBLISHED, ROUGHNESS, SMALL, Bench, Measure, camera, frame_measure, sphere_scene
from .workers import CoreWorker, core_counts

HEIGHTS = (480, 720, 1080, 1440, 2160)
FULL_HEIGHTS = (4320,)
TRIANGLES = (1_000, 10_000, 100_000, 1_000_000)
FULL_TRIANGLES = (10_000_000,)
MATERIALS = (1, 2, 4, 6, 8, 16, 32, 64)
LOBES = (1, 2, 3, 4)
SPHERES = 64
KEYS = ("wall", "shade", "surface")
SAMPLERS = {"regular 14": burnish.Regular(14), "matched 14": burnish.Matched(14)}


def keep_curve(
    bench: Bench,
    curve: str,
    points: Mapping[int, str],
    times: Mapping[str, Mapping[str, float]],
    keys: Sequence[str] = KEYS,
    sampler: str = "",
) -> None:
    """Note the lines through `points` (how many: name of the measure) and print them."""
    part = f"{curve}, {sampler}" if sampler else curve
    lines = bench.curves.setdefault(curve, {})
    keys = [*keys, CPU] if bench.is_on_cpu else keys
    for key in keys:
        text = f"{sampler}, {key}" if sampler else key
        lines[text] = [[x, f"{part}: {measure}: {key}"] for x, measure in points.items()]
    print(f"  {curve:<12}" + "".join(f"{key + ' ms':>14}" for key in keys))
    for x, measure in points.items():
        print(f"  {x:<12}" + "".join(f"{times[measure][key]:14.4g}" for key in keys))


def curve_of_cores(bench: Bench) -> None:
    workers = {cores: CoreWorker(cores) for cores in core_counts()}

    def frame(worker: CoreWorker) -> Measure:
        return lambda: worker.frame(bench.device_name)

    times = bench.alternate("cores", {str(cores): frame(worker) for cores, worker in workers.items()})
    for worker in workers.values():
        worker.close()
    print("\ncores: a process each, regular 20 as published, every pixel of 1920 x 1080")
    keep_curve(bench, "cores", {cores: str(cores) for cores in workers}, times)
    most = max(workers)
    bench.state(f"shade pass, 1 : {most} cores", times["1"]["shade"] / times[str(most)]["shade"])


def curve_of_pixels(bench: Bench, is_full: bool) -> None:
    scene = sphere_scene(burnish.KurtLobe(roughness=ROUGHNESS), environments.spots(1, 256))
    sizes = {(h, h * 16 // 9): f"{h}p" for h in (*HEIGHTS, *(FULL_HEIGHTS if is_full else ()))}
    measures = {
        name: frame_measure(bench.device, scene, PUBLISHED, size=size, first_size=size)
        for size, name in sizes.items()
    }
    times = bench.alternate("pixels", measures, _few(bench))
    print("\npixels: regular 20 as published, every pixel of 480p to 2160p (--full: 4320p)")
    keep_curve(bench, "pixels", {h * w: name for (h, w), name in sizes.items()}, times)
    _print_each("ns a pixel", {h * w: times[name] for (h, w), name in sizes.items()}, ("wall", "shade"))


def curve_of_triangles(bench: Bench, is_full: bool) -> None:
    environment = environments.spots(1, 256)
    lobe = burnish.KurtLobe(roughness=ROUGHNESS)
    points, times = {}, {}
    # One mesh at a time: the largest takes some gigabytes.
    for wanted in (*TRIANGLES, *(FULL_TRIANGLES if is_full else ())):
        scene = sphere_scene(lobe, environment, segments=round(wanted**0.5))
        count = sum(len(mesh.indices) for mesh in scene.meshes)
        view = camera(1.1)  # all of the sphere is in the picture
        times |= bench.alternate(
            "triangles", {str(count): frame_measure(bench.device, scene, PUBLISHED, view)}, _few(bench)
        )
        points[count] = str(count)
    print("\ntriangles: a sphere in a 1920 x 1080 picture, regular 20 as published, the mesh on the device")
    keep_curve(bench, "triangles", points, times)
    _print_each("ns a triangle", {x: times[name] for x, name in points.items()}, ("wall", "surface"))


def curve_of_materials(bench: Bench) -> None:
    print(f"\nmaterials: {SPHERES} spheres on 1920 x 1080 that share 1 to {SPHERES} materials")

    def scene(count: int) -> burnish.Scene:
        materials = [
            burnish.Material(lobes=[burnish.KurtLobe(roughness=0.05 + 0.3 * (k % count) / SPHERES)])
            for k in range(SPHERES)
        ]
        distinct = {k: materials[k] for k in range(count)}
        result = burnish.Scene.spheres([distinct[k % count] for k in range(SPHERES)], columns=8)
        result.environment = environments.spots(1, 256)
        result.show_background = False
        return result

    _curves_by_sampler(bench, "materials", {count: scene(count) for count in MATERIALS}, None)


def curve_of_lobes(bench: Bench) -> None:
    print("\nlobes: a material of 1 to 4 lobes on every pixel of 1920 x 1080")

    def scene(count: int) -> burnish.Scene:
        lobes = [burnish.KurtLobe(roughness=0.1 + 0.05 * k, weight=1 / count) for k in range(count)]
        result = burnish.Scene.sphere(burnish.Material(lobes=lobes))
        result.environment = environments.spots(1, 256)
        return result

    _curves_by_sampler(bench, "lobes", {count: scene(count) for count in LOBES}, camera())


def _curves_by_sampler(
    bench: Bench, name: str, scenes: Mapping[int, burnish.Scene], view: burnish.Camera | None
) -> None:
    for sampler_name, sampler in SAMPLERS.items():
        measures = {
            str(x): frame_measure(
                bench.device, scene, sampler, view or scene.default_camera(), first_size=SMALL
            )
            for x, scene in scenes.items()
        }
        times = bench.alternate(f"{name}, {sampler_name}", measures, _few(bench))
        print(f"  {sampler_name}")
        keep_curve(bench, name, {x: str(x) for x in scenes}, times, ("wall", "shade"), sampler_name)


def _few(bench: Bench) -> int:
    return max(3, bench.repeats // 2)


def _print_each(text: str, rows: Mapping[int, Mapping[str, float]], keys: Sequence[str]) -> None:
    """Print nanoseconds for each of what grows: where that is not flat in the end, there is a cliff."""
    for x, row in rows.items():
        line = "".join(f"  {key} {1e6 * row[key] / x:9.4g}" for key in (*keys, CPU) if key in row)
        print(f"  {x:<12}{line}  {text}")

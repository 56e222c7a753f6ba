"""A new map in every frame against one that stays."""

import time
from collections.abc import Mapping

import numpy as np

import burnish
from burnish import _core

from .bench import CPU, SIZE, Bench, camera, pass_times, sphere_scene

FACE_SIZES = (128, 256, 512, 1024)
MAP_PASSES = ("upload", "pyramid", "pack", "prefilter")
MANY = 24
SAMPLERS = (burnish.Matched(5), burnish.Regular(14), burnish.Prefiltered())


def bench_changing_maps(bench: Bench) -> None:
    """Frames of a sphere under Matched 5, each with a map of its own, and all with the same."""
    lobe, sampler = burnish.KurtLobe(roughness=0.1), burnish.Matched(5)
    print(
        "\na sphere at 1920 x 1080, matched 5, ms: one map for all frames, a new one in each, the difference,"
    )
    print(
        "  of which"
        + "".join(f" {name}," for name in MAP_PASSES)
        + " in no pass; before each, the Environment"
    )
    for size in FACE_SIZES:
        faces = np.random.default_rng(size).random((6, size, size, 3), dtype=np.float32)
        static = sphere_scene(lobe, burnish.Environment.from_faces(faces))
        changing = sphere_scene(lobe, burnish.Environment.from_faces(faces))

        def frame(scene: burnish.Scene) -> dict[str, float]:
            began = time.perf_counter()
            data = _core.render(bench.device, scene, camera(), *SIZE, sampler, 1, "gauss6", None)
            _ = data.color
            return {"wall": 1e3 * (time.perf_counter() - began), **pass_times(data.report)}

        def frame_under_a_new_map(scene: burnish.Scene = changing, faces: np.ndarray = faces) -> dict:
            began = time.perf_counter()
            scene.environment = burnish.Environment.from_faces(faces)
            made = 1e3 * (time.perf_counter() - began)
            return {**frame(scene), "environment": made}

        times = bench.alternate(
            f"changing {size}",
            {"static": lambda scene=static: frame(scene), "changing": frame_under_a_new_map},
        )
        one, new = times["static"], times["changing"]
        passes = [new[name] for name in MAP_PASSES if name in new]
        rest = (new["wall"] - sum(passes) - _of_others(new)) - (one["wall"] - _of_others(one))
        print(
            f"  {size:5}{one['wall']:8.1f}{new['wall']:8.1f}{new['wall'] - one['wall']:8.1f}"
            + "".join(f"{ms:8.1f}" for ms in [*passes, rest, new["environment"]])
        )


def bench_one_of_many(bench: Bench) -> None:
    """Map passes of a frame for which one of many maps was replaced, and of one for which all were."""
    print(f"\nmap passes of {MANY} objects, each with a map of 256, ms: all new, one new, its share of one")
    scene = burnish.Scene.spheres([burnish.Material(lobes=[burnish.KurtLobe(0.2)])] * MANY, columns=6)
    seeds = iter(range(10**6))

    def frame(sampler: burnish.rendering.Sampler, changed: int) -> dict[str, float]:
        for one in scene.objects[:changed]:
            one.reflects = burnish.environments.spots(next(seeds), 256)
        data = _core.render(bench.device, scene, scene.default_camera(), 64, 64, sampler, 1, "gauss6", None)
        times = pass_times(data.report)
        return {"maps": sum(ms for name, ms in times.items() if name in MAP_PASSES)}

    for sampler in SAMPLERS:
        name = type(sampler).__name__
        times = bench.alternate(
            f"one of {MANY}, {name}",
            {"all": lambda by=sampler: frame(by, MANY), "one": lambda by=sampler: frame(by, 1)},
        )
        everything, one = times["all"]["maps"], times["one"]["maps"]
        print(f"  {name:12}{everything:8.1f}{one:8.2f}{MANY * one / everything:8.2f}")
        bench.state(f"one of {MANY} maps, {name}", MANY * one / everything, 1.5, at_least=False)


def _of_others(times: Mapping[str, float]) -> float:
    """Passes that both frames have."""
    return sum(ms for name, ms in times.items() if name not in (*MAP_PASSES, "wall", "environment", CPU))

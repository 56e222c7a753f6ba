"""What it costs to look at every pixel for values that are not finite."""

import os
import shutil
import statistics
import tempfile
from pathlib import Path

from mutate import REPOSITORY, compile_shader, entry_points

import burnish
from burnish import _core, environments

from .bench import CPU, ROUGHNESS, Bench, Measure, camera, pass_times, sphere_scene

STORE = "shade/surface_point.glsl"
PLACE = "COUNTS_NON_FINITE ? point.index : guarded_place(radiance, point.index)"
SAMPLERS = {
    "regular 20": burnish.Regular(20),
    "matched 5": burnish.Matched(5),
    "matched 2": burnish.Matched(2),
}
WITH, WITHOUT = "with", "without"
# Code that differs in nothing that matters takes up to 2 % more or less, by where a driver puts it.
PIPELINES_EACH = 10


def _without_guard(folder: Path) -> Path:
    """Compile the kernels that store radiance so that all of it goes to its pixel."""
    glsl, modules = folder / "glsl", folder / "modules"
    shutil.copytree(REPOSITORY / "glsl", glsl)
    modules.mkdir()
    text = (glsl / STORE).read_text()
    if text.count(PLACE) != 1:
        raise ValueError(f"{STORE}: expected {PLACE} once")
    (glsl / STORE).write_text(text.replace(PLACE, "point.index"))
    for entry in entry_points(glsl, STORE):
        compile_shader(glsl, entry, modules)
    return modules


def bench_guards(bench: Bench) -> None:
    scene = sphere_scene(burnish.KurtLobe(roughness=ROUGHNESS), environments.spots(1, 256))
    with tempfile.TemporaryDirectory() as folder:
        modules = {WITH: "", WITHOUT: str(_without_guard(Path(folder)))}

        def shading(sampler: object, kind: str) -> Measure:
            device = burnish.Device(bench.device_name)

            def run() -> dict[str, float]:
                report = _core.time_shading(device, scene, camera(), sampler, True, True)
                return {"ms": pass_times(report)["shade 0"]}

            os.environ["BURNISH_SPIRV_DIR"] = modules[kind]  # modules are read when they are first used
            run()
            del os.environ["BURNISH_SPIRV_DIR"]
            return run

        measures = {
            f"{name} {kind} {k}": shading(sampler, kind)
            for name, sampler in SAMPLERS.items()
            for k in range(PIPELINES_EACH)
            for kind in modules
        }
        times = bench.alternate("guards", measures)
    print(
        "\nguards: every pixel of 1920 x 1080, m = .1, 256^2 faces, shade pass;"
        f"\nmeans of {PIPELINES_EACH} pipelines each, of medians of {bench.repeats} alternating runs"
    )
    for name in SAMPLERS:

        def ratio(key: str, name: str = name) -> float:
            with_guard, without = (
                statistics.mean(times[f"{name} {kind} {k}"][key] for k in range(PIPELINES_EACH))
                for kind in (WITH, WITHOUT)
            )
            return with_guard / without

        bench.state(f"{name}, with guard : without", ratio("ms"), 1.02, at_least=False)
        if bench.is_on_cpu:
            bench.state(f"{name}, by the time of all threads and all passes", ratio(CPU))

"""What it costs to look at every pixel for values that are not finite."""

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from mutate import REPOSITORY, compile_shader, entry_points

import burnish
from burnish import _core, environments

from .bench import CPU, PIPELINES, ROUGHNESS, Bench, Measure, camera, pass_times, sphere_scene

STORE = "shade/surface_point.glsl"
SIGN = "    leave_sign(radiance);\n"
SAMPLERS = {
    "regular 20": burnish.Regular(20),
    "matched 5": burnish.Matched(5),
    "matched 2": burnish.Matched(2),
}
WITH, WITHOUT = "with", "without"


def _without_signs(folder: Path) -> Path:
    """Compile the kernels that store radiance without what they leave for the guard."""
    glsl, modules = folder / "glsl", folder / "modules"
    shutil.copytree(REPOSITORY / "glsl", glsl)
    modules.mkdir()
    text = (glsl / STORE).read_text()
    if text.count(SIGN) != 1:
        raise ValueError(f"{STORE}: expected {SIGN.strip()} once")
    (glsl / STORE).write_text(text.replace(SIGN, ""))
    for entry in entry_points(glsl, STORE):
        compile_shader(glsl, entry, modules)
    return modules


def bench_guards(bench: Bench) -> None:
    scene = sphere_scene(burnish.KurtLobe(roughness=ROUGHNESS), environments.spots(1, 256))
    with tempfile.TemporaryDirectory() as folder:
        modules = {WITH: "", WITHOUT: str(_without_signs(Path(folder)))}

        def shading(sampler: object, kind: str) -> Callable[[int], Measure]:
            def make(k: int) -> Measure:
                device = burnish.Device(bench.device_name)

                def run() -> dict[str, float]:
                    report = _core.time_shading(device, scene, camera(), sampler, True, True)
                    return {"ms": pass_times(report)["shade 0"]}

                os.environ["BURNISH_SPIRV_DIR"] = modules[kind]  # modules are read when they are first used
                run()
                del os.environ["BURNISH_SPIRV_DIR"]
                return run

            return make

        makers = {f"{name} {kind}": shading(s, kind) for name, s in SAMPLERS.items() for kind in modules}
        times = bench.best_of("guards", makers)
    print(
        "\nguards: every pixel of 1920 x 1080, m = .1, 256^2 faces, shade pass;"
        f"\nthe better of {PIPELINES} pipelines each, medians of {bench.repeats} alternating runs"
    )
    for name in SAMPLERS:
        ours, bare = times[f"{name} {WITH}"], times[f"{name} {WITHOUT}"]
        bench.state(f"{name}, with guard : without", ours["ms"] / bare["ms"], 1.02, at_least=False)
        bench.state(f"{name}, by the time of all threads and all passes", ours[CPU] / bare[CPU])

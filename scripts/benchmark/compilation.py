"""What a picture takes whose roughness was never drawn, as when somebody drags a slider."""

import random
import time

import burnish
from burnish import _core, environments

from .bench import Bench, Measure, camera, sphere_scene

SIZE = (540, 960)
SAMPLERS = {"regular 20": burnish.Regular(samples=20), "importance 20": burnish.Importance(samples=20)}


def bench_compilation(bench: Bench) -> None:
    """Time the first pictures of a roughness on a device that has drawn others."""
    environment = environments.spots(1, 256)

    def measure_by(sampler: object) -> Measure:
        def picture(scene: burnish.Scene) -> tuple[float, float]:
            began = time.perf_counter()
            data = _core.render(bench.device, scene, camera(), *SIZE, sampler, 1, "gauss6", None)
            _ = data.color
            return 1e3 * (time.perf_counter() - began), data.report["compile_ms"]

        def measure() -> dict[str, float]:
            # Drivers keep what they compiled on the disk: no run may have had this one.
            roughness = random.SystemRandom().uniform(0.1, 0.6)
            scene = sphere_scene(burnish.KurtLobe(roughness=roughness), environment)
            first, compiling = picture(scene)
            return {"first": first, "compiling": compiling, "second": picture(scene)[0]}

        return measure

    times = bench.alternate("compile", {name: measure_by(sampler) for name, sampler in SAMPLERS.items()})
    print("\npictures of a new roughness at 960 x 540, ms; of the first, what was compiled for it")
    print(f"  {'sampler':<16}{'first':>8}{'compiling':>11}{'second':>8}")
    for name, one in times.items():
        print(f"  {name:<16}{one['first']:8.1f}{one['compiling']:11.1f}{one['second']:8.1f}")
        bench.state(f"first picture of a roughness, {name}, against its second", one["first"] / one["second"])

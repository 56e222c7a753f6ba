"""What a picture takes whose roughness no pipeline was made for, as when somebody drags a slider."""

import random
import time

import burnish
from burnish import _core, environments

from .bench import Bench, Measure, camera, sphere_scene

SIZE = (540, 960)
SAMPLER = burnish.Regular(samples=20)


def bench_compilation(bench: Bench) -> None:
    """Time the first pictures of a roughness where a device waits for its pipeline and where not."""
    environment = environments.spots(1, 256)

    def picture_ms(device: burnish.Device, scene: burnish.Scene) -> float:
        began = time.perf_counter()
        _ = _core.render(device, scene, camera(), *SIZE, SAMPLER, 1, "gauss6", None).color
        return 1e3 * (time.perf_counter() - began)

    def measure_on(device: burnish.Device) -> Measure:
        def measure() -> dict[str, float]:
            # Drivers keep what they compiled on the disk: no run may have had this one.
            roughness = random.SystemRandom().uniform(0.1, 0.6)
            scene = sphere_scene(burnish.KurtLobe(roughness=roughness), environment)
            first = picture_ms(device, scene)
            device.finish_compiling()
            return {"first": first, "second": picture_ms(device, scene), "third": picture_ms(device, scene)}

        return measure

    modes = ("wait", "background")
    devices = {mode: burnish.Device(bench.device_name, compile=mode) for mode in modes}
    times = bench.alternate("compile", {mode: measure_on(device) for mode, device in devices.items()})
    print(
        "\npictures of a new roughness at 960 x 540, ms, regular 20; the second once its pipeline is compiled"
    )
    print(f"  {'compile':<12}{'first':>8}{'second':>8}{'third':>8}")
    for mode in modes:
        print(f"  {mode:<12}" + "".join(f"{times[mode][key]:8.1f}" for key in ("first", "second", "third")))
    bench.state(
        "first picture of a roughness, background against wait",
        times["background"]["first"] / times["wait"]["first"],
    )

"""Samplers at equal counts, and what the maps they read cost."""

from collections.abc import Callable

import burnish
from burnish import _core, environments

from .bench import Bench, frame_measure

COUNTS = (5, 14, 20)
MAP_SIZES = (256, 1024)
LOBES = {
    "round .1": burnish.KurtLobe(roughness=0.1),
    "round .3": burnish.KurtLobe(roughness=0.3),
    "round .1, r0 .04, alpha .5": burnish.KurtLobe(roughness=0.1, r0=0.04, alpha=0.5),
    "brushed .2/.075": burnish.KurtLobe(roughness=(0.2, 0.075)),
    "brushed .3/.05": burnish.KurtLobe(roughness=(0.3, 0.05)),
}


def bench_samplers(bench: Bench) -> None:
    """Shade passes of a full 1080p picture: Regular with as many real samples as Matched has, per sample."""
    device = bench.device
    print("\nshade pass at 1920 x 1080, ms: Matched against Regular (exact, furnace), per sample")
    print(f"  {'lobe':<28}" + "".join(f"{f'n = {n}':>26}" for n in COUNTS))
    for name, lobe in LOBES.items():
        scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
        scene.environment = environments.spots(1, 256)
        line = f"  {name:<28}"
        for count in COUNTS:
            regular = burnish.Regular(count)
            used = int(
                burnish.render(scene, size=(16, 16), sampler=regular, device=device).report.samples_used
            )
            times = bench.alternate(
                f"samplers, {name}, n {count}",
                {
                    "regular": frame_measure(device, scene, regular),
                    "matched": frame_measure(device, scene, burnish.Matched(count)),
                },
            )
            matched_ms, regular_ms = times["matched"]["shade"], times["regular"]["shade"]
            # A pattern may miss its budget: its time is taken to grow with its samples.
            ratio = matched_ms / regular_ms * used / count
            line += f"{matched_ms:9.3g}/{regular_ms:6.3g}({used:2}) {ratio:5.2f}x"
        print(line)


def bench_maps(bench: Bench) -> None:
    """Making the levels that Matched and Prefiltered read, once for each map."""
    print("\nlevels of one map, made once, ms: pyramid gauss6, round on the sphere, prefiltered")
    for size in MAP_SIZES:
        environment = environments.uniform(1.0, size)

        def build(is_spherical: bool, environment: burnish.Environment = environment) -> Callable[[], dict]:
            return lambda: dict(_core.prefilter_times(bench.device, environment, "gauss6", is_spherical))

        times = bench.alternate(
            f"maps {size}", {"spherical": build(True), "lobe": build(False)}, max(3, bench.repeats // 2)
        )
        print(
            f"  {size:5}{times['spherical']['pyramid']:12.1f}{times['spherical']['prefilter']:12.1f}"
            f"{times['lobe']['prefilter']:12.1f}"
        )

"""What an effect costs: absent, present but zero, present."""

import tempfile
from pathlib import Path

import burnish
from burnish import environments

from .bench import Bench, frame_measure
from .effect_scenes import effect_scenes

STATES = ("absent", "zero", "present")


def bench_effects(bench: Bench) -> None:
    print("\nan effect absent, present but zero, present: ms at 1920 x 1080, regular 14")
    print(
        f"  {'effect':<26}{'absent':>10}{'zero':>10}{'present':>10}   zero/absent  present/absent   time of"
    )
    with tempfile.TemporaryDirectory() as folder:
        for name, keys, scenes, spp in effect_scenes(Path(folder), environments.spots(1, 256)):
            measures = {
                state: frame_measure(bench.device, scene, burnish.Regular(samples=14), spp=frames)
                for state, scene, frames in zip(STATES, scenes, spp, strict=True)
            }
            times = bench.alternate(f"effect {name}", measures, max(3, bench.repeats // 2))
            for key in keys:
                absent, zero, present = (times[state][key] for state in STATES)
                print(
                    f"  {name:<26}{absent:10.3g}{zero:10.3g}{present:10.3g}"
                    f"   {zero / absent:11.2f}  {present / absent:14.2f}   {key}"
                )

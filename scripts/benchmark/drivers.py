"""Both lookups of CPU devices, on the driver in use and on a newer one, and which each driver is given."""

import os
import subprocess
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from pathlib import Path

import burnish
from burnish import environments

from .bench import CPU, SMALL, Bench, Measure, camera, frame_measure, sphere_scene

NEWER = Path(__file__).resolve().parents[1] / "newer-driver"
LOOKUPS = ("sampler", "software")
SAMPLERS: dict[str, burnish.Matched | burnish.Regular] = {
    "matched 5": burnish.Matched(5),
    "matched 14": burnish.Matched(14),
    "regular 20": burnish.Regular(20),
}
# Most that the chosen lookup may take of the faster one's time.
MOST = 1.05


class DriverWorker:
    """A process with its own engine, on the driver that `files` name: a process chooses it once."""

    def __init__(self, device_name: str, files: str = "") -> None:
        self._pool = ProcessPoolExecutor(
            1, mp_context=get_context("spawn"), initializer=_use_driver, initargs=(files,)
        )
        self.device_name = device_name
        self.driver, self.lookup, self.reason = self._pool.submit(_describe, device_name).result()

    def shade(self, lookup: str, sampler: str, pipeline: int) -> dict[str, float]:
        """Shade pass of a full 1080p picture, and the time of all threads for all of its passes."""
        return self._pool.submit(_shade, self.device_name, lookup, sampler, pipeline).result()

    def close(self) -> None:
        self._pool.shutdown()


def _use_driver(files: str) -> None:
    if files:
        os.environ["VK_DRIVER_FILES"] = files


def _describe(device_name: str) -> tuple[str, str, str]:
    device = burnish.Device(device_name)
    return device.driver, device.lookup, device.lookup_reason


@cache
def _measure(device_name: str, lookup: str, sampler: str, _pipeline: int) -> Measure:
    scene = sphere_scene(burnish.KurtLobe(roughness=0.1), environments.spots(1, 256))
    device = burnish.Device(device_name, lookup=lookup)
    return frame_measure(device, scene, SAMPLERS[sampler], camera(), first_size=SMALL)


def _shade(device_name: str, lookup: str, sampler: str, pipeline: int) -> dict[str, float]:
    row = _measure(device_name, lookup, sampler, pipeline)()
    return {"ms": row["shade"], CPU: row[CPU]}


def newer_driver() -> str:
    """Unpack the newer driver where it is not yet; RuntimeError with the reason where it cannot be had."""
    done = subprocess.run([NEWER], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip().splitlines()[-1])
    return done.stdout.strip().partition("=")[2]


def bench_drivers(bench: Bench) -> None:
    """Measure shade passes by both lookups on both drivers, all in turn."""
    if not bench.device.is_software:
        print("\ndrivers: left out, the device has a sampler in hardware")
        return
    workers = [DriverWorker(bench.device_name)]
    try:
        workers.append(DriverWorker("", newer_driver()))
    except RuntimeError as error:
        print(f"\ndrivers: only the one in use; {error}")

    def shading(worker: DriverWorker, lookup: str, sampler: str) -> Callable[[int], Measure]:
        return lambda k: lambda: worker.shade(lookup, sampler, k)

    times = bench.best_of(
        "drivers",
        {
            f"{worker.driver}, {sampler}, {lookup}": shading(worker, lookup, sampler)
            for sampler in SAMPLERS
            for worker in workers
            for lookup in LOOKUPS
        },
    )
    for worker in workers:
        worker.close()
    print(
        "\nboth lookups, shade pass of 1920 x 1080, all covered, 256^2 faces, m = .1: ms by the clock; in"
        "\nbrackets the time of all threads for all passes, which other work hardly changes"
    )
    for worker in workers:
        print(f"\n  {worker.driver}: {worker.lookup}; {worker.reason}")
        for sampler in SAMPLERS:
            rows = {lookup: times[f"{worker.driver}, {sampler}, {lookup}"] for lookup in LOOKUPS}
            texts = [f"{lookup} {row['ms']:7.1f} ({row[CPU]:7.1f})" for lookup, row in rows.items()]
            ratios = [rows["software"][key] / rows["sampler"][key] for key in ("ms", CPU)]
            print(
                f"  {sampler:<12}{'   '.join(texts)}   software : sampler {ratios[0]:.2f} ({ratios[1]:.2f})"
            )
        for sampler in SAMPLERS:
            cpu = {lookup: times[f"{worker.driver}, {sampler}, {lookup}"][CPU] for lookup in LOOKUPS}
            text = f"{worker.driver}, {sampler}, chosen lookup : faster one, by the time of all threads"
            bench.state(text, cpu[worker.lookup] / min(cpu.values()), MOST, at_least=False)

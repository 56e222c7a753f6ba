"""Engines held to a number of cores. Lavapipe reads that number when it starts: a process for each."""

import os
import time
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context

import burnish
from burnish import _core, environments

from .bench import CPU, PUBLISHED, ROUGHNESS, camera, frame_measure, pass_times, sphere_scene


def core_count() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0))


def core_counts() -> list[int]:
    """1, 2, 4, ... and all cores."""
    return sorted({min(1 << k, core_count()) for k in range(core_count().bit_length() + 1)})


class CoreWorker:
    """A process with its own engine, held to `cores` cores where the driver is lavapipe."""

    def __init__(self, cores: int) -> None:
        # Threads that are started later inherit what the first one may use.
        self._pool = ProcessPoolExecutor(
            1, mp_context=get_context("spawn"), initializer=_hold_to, initargs=(cores,)
        )

    def shade(self, device_name: str, lookup: str, pipeline: int = 0) -> dict[str, float]:
        """Shade pass of the full 1080p picture of Regular with 20 samples, as published."""
        return self._pool.submit(_shade, device_name, lookup, pipeline).result()

    def frame(self, device_name: str) -> dict[str, float]:
        """The frame of the same picture and its parts."""
        return self._pool.submit(_frame, device_name).result()

    def close(self) -> None:
        self._pool.shutdown()


def _hold_to(cores: int) -> None:
    os.environ["LP_NUM_THREADS"] = str(cores)
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:cores])


@cache
def _device(name: str, lookup: str, _pipeline: int) -> burnish.Device:
    return burnish.Device(name, lookup=lookup)


@cache
def _scene() -> burnish.Scene:
    return sphere_scene(burnish.KurtLobe(roughness=ROUGHNESS), environments.spots(1, 256))


def _shade(device_name: str, lookup: str, pipeline: int) -> dict[str, float]:
    device, scene = _device(device_name, lookup, pipeline), _scene()
    began = time.process_time()
    report = _core.time_shading(device, scene, camera(), PUBLISHED, True)
    return {"ms": pass_times(report)["shade 0"], CPU: 1e3 * (time.process_time() - began)}


def _frame(device_name: str) -> dict[str, float]:
    return dict(frame_measure(_device(device_name, "auto", 0), _scene(), PUBLISHED)())

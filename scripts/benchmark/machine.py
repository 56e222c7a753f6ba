"""What the machine can do without the engine."""

import os
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from .bench import Bench, Measure
from .workers import core_count

# Far beyond every cache.
COPY_BYTES = 256 << 20


def bench_machine(bench: Bench) -> None:
    """Copy memory with one thread and with as many as there are cores."""
    source, target = np.ones(COPY_BYTES, np.uint8), np.empty(COPY_BYTES, np.uint8)

    def copy(threads: int) -> Measure:
        parts = list(zip(np.array_split(target, threads), np.array_split(source, threads), strict=True))

        def measure() -> dict[str, float]:
            with ThreadPoolExecutor(threads) as pool:
                began = time.perf_counter()
                list(pool.map(lambda part: np.copyto(*part), parts))
                return {"ms": 1e3 * (time.perf_counter() - began)}

        return measure

    times = bench.alternate("machine", {f"copy, {k} threads": copy(k) for k in sorted({1, core_count()})})
    print(f"\nthe machine: {core_count()} cores of {os.cpu_count()}")
    for name, row in times.items():
        rate = 2 * COPY_BYTES / row["ms"] / 1e6
        print(f"  {name:<20}{row['ms']:8.1f} ms for {COPY_BYTES >> 20} MiB, {rate:.3g} GB/s read and written")

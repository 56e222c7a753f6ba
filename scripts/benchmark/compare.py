"""Two runs of the benchmark side by side: what became faster or slower, and what is noise."""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

import numpy as np

from .bench import CPU

FASTER, SLOWER, NOISE, TOO_FEW = "faster", "slower", "noise", "too few runs"
CONFIDENCE = 0.99
RESAMPLES = 4000
LEAST_RUNS = 3
# Clocks of devices do not see less.
LEAST_MS = 1e-3


@dataclass(frozen=True)
class Change:
    """One figure of two runs: medians, ratio after/before of the medians with its interval, verdict."""

    figure: str
    before_ms: float
    after_ms: float
    ratio: float
    low: float
    high: float
    verdict: str


def ratio_interval(before: Sequence[float], after: Sequence[float]) -> tuple[float, float]:
    """Interval of median(after)/median(before) at CONFIDENCE: percentile bootstrap, always the same draws."""
    rng = np.random.default_rng(0)

    def medians(runs: Sequence[float]) -> np.ndarray:
        values = np.asarray(runs, float)
        return np.median(values[rng.integers(len(values), size=(RESAMPLES, len(values)))], axis=1)

    tail = 100 * (1 - CONFIDENCE) / 2
    low, high = np.percentile(medians(after) / medians(before), [tail, 100 - tail])
    return float(low), float(high)


def compare_runs(figure: str, before: Sequence[float], after: Sequence[float], margin: float) -> Change:
    """Judge one figure. A change is one whose whole interval lies farther than `margin` from a ratio of 1."""
    before_ms, after_ms = float(np.median(before)), float(np.median(after))
    ratio = after_ms / before_ms
    if min(len(before), len(after)) < LEAST_RUNS:
        return Change(figure, before_ms, after_ms, ratio, 0.0, float("inf"), TOO_FEW)
    low, high = ratio_interval(before, after)
    verdict = SLOWER if low > 1 + margin else FASTER if high < 1 / (1 + margin) else NOISE
    return Change(figure, before_ms, after_ms, ratio, low, high, verdict)


def compare(before: dict, after: dict, margin: float, pattern: str = "") -> list[Change]:
    """Judge the figures that both runs have and that take any time, in the order of the second.

    Without a pattern these are the times of all threads, if both runs have such: the same code compared with
    itself on a machine with other work was off by 30 % by the clock, by 4 % in these.
    """
    pattern = pattern or usual_pattern(before, after)
    common = [name for name in after["figures"] if name in before["figures"] and fnmatch(name, pattern)]
    runs = [(name, before["figures"][name], after["figures"][name]) for name in common]
    return [compare_runs(name, a, b, margin) for name, a, b in runs if min(*a, *b) > LEAST_MS]


def usual_pattern(before: dict, after: dict) -> str:
    """Return what `compare` takes without a pattern."""
    has_cpu = all(any(name.endswith(f": {CPU}") for name in run["figures"]) for run in (before, after))
    return f"*: {CPU}" if has_cpu else "*"


def table(before: dict, after: dict, changes: Sequence[Change], margin: float) -> str:
    """Lay the judgement out as text."""
    named = (("before", before, after), ("after", after, before))
    lines = [f"{name}: {run['device']}, {run['driver']}, {run['date']}" for name, run, _ in named]
    if before["device"] != after["device"] or before["driver"] != after["driver"]:
        lines.append("these are not the same device and driver: what changed may not be the engine")
    lines.append(
        f"ratio of medians, interval at {CONFIDENCE:.0%}; a change is more than {margin:.0%} with all of its"
        " interval"
    )
    width = max((len(change.figure) for change in changes), default=6)
    lines.append(f"{'figure':<{width}}{'before ms':>12}{'after ms':>12}{'ratio':>8}  interval       verdict")
    lines += [
        f"{c.figure:<{width}}{c.before_ms:12.4g}{c.after_ms:12.4g}{c.ratio:8.3f}  [{c.low:.3f}, {c.high:.3f}]"
        f"  {c.verdict if c.verdict != SLOWER else c.verdict.upper()}"
        for c in changes
    ]
    for name, run, other in named:
        if missing := len(set(run["figures"]) - set(other["figures"])):
            lines.append(f"{missing} figures are in {name} only")
    if changes:
        together = float(np.median([change.ratio for change in changes]))
        lines.append(f"median of all ratios: {together:.3f}; where all moved alike, it may be the machine")
    counts = [(v, sum(c.verdict == v for c in changes)) for v in (SLOWER, FASTER, NOISE, TOO_FEW)]
    lines.append(", ".join(f"{count} {verdict}" for verdict, count in counts))
    return "\n".join(lines)


def read_run(path: Path) -> dict:
    """Load what --json wrote."""
    run = json.loads(path.read_text())
    if not isinstance(run, dict) or not isinstance(run.get("figures"), dict):
        raise ValueError(f"{path}: expected what --json writes, all runs of every figure, got another file")
    return run

"""Runs functions of glsl/lib on the device by name, and compares them with their float64 twins.

Tolerances are in units of ULP and count what Vulkan allows each operation: 1/2 for + - *, 5/2 for a quotient,
2 for inversesqrt, 3 + 2|x| for exp(x) and exp2(x), 3 for log2 outside [1/2, 2] and 2^-21 within it.
"""

import re
from pathlib import Path

import numpy as np

from burnish import _core

REPOSITORY = Path(__file__).resolve().parents[3]
# Relative spacing of float32.
ULP = 2.0**-23
# Below it, results may become zero.
LEAST_NORMAL = 2.0**-126
FUNCTION = re.compile(r"^\w+\s+(\w+)\s*\([^;{)]*\)\s*\{", re.MULTILINE)
CONSTANT = re.compile(r"PROBE_(\w+) = (\d+)u;")


def lib_functions():
    """Name of every function of glsl/lib and glsl/lobe, and its probe: of its file, or of its lobe.

    lobe.glsl is a switch between models, which test_lobe_models runs on every sampler.
    """
    probes = {path: path.stem for path in sorted((REPOSITORY / "glsl/lib").glob("*.glsl"))}
    lobes = [path for path in sorted((REPOSITORY / "glsl/lobe").glob("*.glsl")) if path.stem != "lobe"]
    probes |= {path: f"{'kurt' if path.stem == 'interface' else path.stem}_lobe" for path in lobes}
    return {name: probe for path, probe in probes.items() for name in FUNCTION.findall(path.read_text())}


def probe_numbers():
    """Numbers of the probed functions, as C++ and GLSL have them."""
    text = (REPOSITORY / "glsl/shared/probe.h").read_text().split("SPEC_PROBE_FUNCTION")[1]
    return {name.lower(): int(number) for name, number in CONSTANT.findall(text)}


def probe(device, name, *arguments):
    """Run a function once for each item.

    `arguments` are arrays of shape (n,) or (n, 1..4), or one value for all items: one for each vec4 the probe
    reads. Integers are passed as the floats of the same bits. Returns (n, 3, 4) float32.
    """
    columns = [as_column(a) for a in arguments]
    count = max(len(c) for c in columns)
    packed = np.zeros((count, len(columns), 4), np.uint32)
    for k, column in enumerate(columns):
        packed[:, k, : column.shape[1]] = column
    return _core.probe(device, lib_functions()[name], probe_numbers()[name], packed.view(np.float32))


def as_column(argument):
    """Bits of one vec4, (n, 1..4). A tuple stacks columns of different kinds."""
    if isinstance(argument, tuple):
        return np.concatenate(np.broadcast_arrays(*[as_column(part)[:, :1] for part in argument]), axis=1)
    values = np.asarray(argument)
    kind = np.float32 if values.dtype.kind == "f" else np.uint32
    values = np.ascontiguousarray(values, kind).view(np.uint32)
    return values.reshape(-1, 1) if values.ndim < 2 else values


def words(results):
    """Results that are integers."""
    return np.ascontiguousarray(results).view(np.uint32)


def rows(*parts):
    """Float32 vectors stacked: random ones below hand-picked ones."""
    return np.concatenate([np.asarray(p, np.float32) for p in parts])


def directions_above(rng, count, lowest=-4):
    """Directions above the horizon, half of them as close to it as 10^lowest, some along the normal."""
    cosine = np.where(rng.random(count) < 0.5, 10.0 ** rng.uniform(lowest, 0, count), rng.random(count))
    cosine[:8] = 1
    azimuth = rng.uniform(0, 2 * np.pi, count)
    sine = np.sqrt(1 - cosine**2)
    return units(np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=-1))


def units(vectors):
    """Unit vectors as float32 has them."""
    vectors = np.asarray(vectors, np.float64)
    return (vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)).astype(np.float32)


def assert_close(name, actual, expected, allowed, **inputs):
    """Demand |actual - expected| <= allowed everywhere, and show the inputs of the worst item otherwise."""
    actual, expected = np.asarray(actual, np.float64), np.asarray(expected, np.float64)
    assert actual.shape == expected.shape, f"{name}: shapes {actual.shape} and {expected.shape}"
    allowed = np.broadcast_to(allowed, actual.shape)
    assert np.all(allowed > 0), f"{name}: no tolerance"
    with np.errstate(all="ignore"):
        share = np.abs(actual - expected) / allowed
    share = np.where(np.isfinite(actual), share, np.inf)
    worst = np.unravel_index(np.argmax(share), share.shape)
    print(f"{name}: worst error is {share[worst]:.2f} of the tolerance of {allowed[worst]:.2g}")
    if share[worst] <= 1:
        return
    lines = [f"  {key} = {np.asarray(value)[worst[0]]!r}" for key, value in inputs.items()]
    raise AssertionError(
        f"{name}: {np.count_nonzero(share > 1)} of {share.size} values differ too much; worst at {worst}:\n"
        + "\n".join(lines)
        + f"\n  got {actual[worst[0]]!r}\n  expected {expected[worst[0]]!r}"
        + f"\n  error {abs(actual[worst] - expected[worst]):.3g}, allowed {allowed[worst]:.3g}"
    )


def pow_error(x, y):
    """Relative error that Vulkan allows x^y = exp2(y log2 x), x in (0, 1]."""
    log = np.log2(x)
    exponent = np.abs(y * log)
    log_error = np.where(np.asarray(x) < 0.5, 3 * ULP * np.abs(log), 2.0**-21)
    return np.log(2) * (np.abs(y) * log_error + exponent * ULP / 2) + (3 + 2 * exponent) * ULP

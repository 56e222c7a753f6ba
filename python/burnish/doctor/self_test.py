"""The doctor's trials: cases with known answers, cases known to break float32, and the rate of samples."""

import time

import numpy as np
from numpy.typing import NDArray

from burnish._core import Device, Environment, Importance, KurtLobe, Material, Reference, Regular
from burnish.doctor.finding import Finding
from burnish.oracle.albedo import directional_albedo
from burnish.rendering import shade

FloatArray = NDArray[np.float32]

RADIANCE = 2.0
FACE_SIZE = 16
# Half floats carry 11 bits (5e-4); Monte Carlo weights at 30 samples scatter a few per cent.
TOLERANCES = {"Regular": 0.005, "Importance": 0.05, "Reference": 0.01}
# A lobe may send out a little more than comes in (maths of the model); ten times as much is a failure.
WILD = 10.0
RATE_POINTS = 1 << 16


def _constant_light() -> Environment:
    return Environment.from_faces(np.full((6, FACE_SIZE, FACE_SIZE, 3), RADIANCE, np.float32))


def _rows(*rows: tuple[float, float, float]) -> FloatArray:
    return np.array(rows, np.float32)


def _furnace(device: Device) -> list[Finding]:
    """A white lobe in constant light returns radiance times its albedo; white paint returns the radiance."""
    angles = np.radians([0.0, 30.0, 60.0])
    views = np.stack([np.sin(angles), 0.0 * angles, np.cos(angles)], axis=1).astype(np.float32)
    normals, tangents = np.tile(_rows((0, 0, 1)), (3, 1)), np.tile(_rows((1, 0, 0)), (3, 1))
    roughness = (0.3, 0.1)
    white_lobe = Material(lobes=[KurtLobe(roughness=roughness, r0=1.0, alpha=0.0)])
    albedo = directional_albedo(views, roughness, 0.0)[:, 0]
    findings = []
    for sampler in (Regular(samples=30), Importance(samples=64), Reference()):
        name = type(sampler).__name__
        radiance = shade(_constant_light(), white_lobe, sampler, normals, tangents, views, device=device)
        error = float(np.max(np.abs(radiance.mean(axis=1) / (RADIANCE * albedo) - 1.0)))
        findings.append(_judged(f"furnace, {name}", error, TOLERANCES[name]))
    paint = Material(diffuse=(1, 1, 1))
    radiance = shade(_constant_light(), paint, Regular(), normals, tangents, views, device=device)
    error = float(np.max(np.abs(radiance / RADIANCE - 1.0)))
    return [*findings, _judged("furnace, diffuse", error, 0.005)]


def _judged(name: str, error: float, tolerance: float) -> Finding:
    text = f"off by {100 * error:.2f} %, {100 * tolerance:.1f} % allowed"
    return Finding(name, "ok" if error <= tolerance else "failed", text)


def _hard_cases(device: Device) -> list[Finding]:
    up, right = (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    grazing = (0.99999, 0.0, 0.00447)
    cases = {
        "grazing view": ((0.3, 0.3), up, right, grazing),
        "mirror-like lobe": ((1e-3, 1e-3), up, right, (0.6, 0.0, 0.8)),
        "very wide lobe": ((1.0, 1.0), up, right, (0.6, 0.0, 0.8)),
        "34:1 anisotropy": ((0.34, 0.01), up, right, (0.6, 0.0, 0.8)),
        "normal straight down": ((0.1, 0.1), (0.0, 0.0, -1.0), right, (0.6, 0.0, -0.8)),
        "tangent along the normal": ((0.2, 0.05), up, up, (0.6, 0.0, 0.8)),
        "tangent of zero": ((0.2, 0.05), up, (0.0, 0.0, 0.0), (0.6, 0.0, 0.8)),
        "view from behind": ((0.1, 0.1), up, right, (0.0, 0.6, -0.8)),
    }
    findings = []
    for name, (roughness, normal, tangent, view) in cases.items():
        material = Material(lobes=[KurtLobe(roughness=roughness, r0=(0.9, 0.5, 0.04), alpha=0.5)])
        point = (_rows(normal), _rows(tangent), _rows(view))
        radiance = shade(_constant_light(), material, Regular(), *point, device=device)
        is_sane = bool(((radiance >= 0) & (radiance <= WILD * RADIANCE)).all())  # False for NaN
        text = ", ".join(f"{value:.3f}" for value in radiance[0])
        findings.append(Finding(name, "ok" if is_sane else "failed", f"radiance {text}"))
    return findings


def _rate(device: Device) -> Finding:
    normals = np.tile(_rows((0, 0, 1)), (RATE_POINTS, 1))
    tangents = np.tile(_rows((1, 0, 0)), (RATE_POINTS, 1))
    angle = np.linspace(0.0, 1.4, RATE_POINTS)
    views = np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=1).astype(np.float32)
    material = Material(lobes=[KurtLobe(roughness=(0.1, 0.1))])
    environment, sampler = (
        _constant_light(),
        Regular(samples=14, threshold=0.2),
    )  # exactly 14 at this roughness
    times = []
    for _ in range(4):  # the first one compiles
        began = time.perf_counter()
        shade(environment, material, sampler, normals, tangents, views, device=device)
        times.append(time.perf_counter() - began)
    rate = RATE_POINTS * 14 / min(times)
    return Finding("rate", "ok", f"{rate / 1e6:.0f} million samples per second, with upload and read-back")


def run_self_test(device: Device) -> list[Finding]:
    """Try the engine; a result out of bounds is a finding of status ``failed``.

    Parameters
    ----------
    device : Device
        The device to try.
    """
    return [*_furnace(device), *_hard_cases(device), _rate(device)]

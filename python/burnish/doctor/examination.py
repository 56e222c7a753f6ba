"""Looks for what is missing on this machine, names what installs it, and tries the engine."""

import ctypes
import os
import platform
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import metadata
from pathlib import Path
from typing import TYPE_CHECKING

from burnish._extension import INSTALL_LOADER, load_failure
from burnish.doctor.finding import Finding, Status

if TYPE_CHECKING:
    from burnish._core import Device
    from burnish.hardcases import Table

Progress = Callable[[float, str], None]

INSTALL_DRIVER = "sudo apt-get install mesa-vulkan-drivers"
INSTALL_LAYERS = "sudo apt-get install vulkan-validationlayers"
SHOWN_LIMITS = ("max_image_dimension_2d", "max_image_dimension_cube", "max_allocation_bytes")


@dataclass
class DoctorReport:
    """What the doctor found; ``print`` it.

    Parameters
    ----------
    sections : dict
        Findings under headings, in order.
    hard_cases : list of Table
        The tables of hard cases, where they were asked for.
    """

    sections: dict[str, list[Finding]] = field(default_factory=dict)
    hard_cases: list["Table"] = field(default_factory=list)

    @property
    def findings(self) -> list[Finding]:
        """All findings of all sections."""
        return [finding for section in self.sections.values() for finding in section]

    @property
    def can_render(self) -> bool:
        """Whether nothing that is needed is missing and no test failed."""
        return all(finding.status in ("ok", "note") for finding in self.findings)

    def __str__(self) -> str:
        lines = [line for table in self.hard_cases for line in (str(table), "")]
        for title, findings in self.sections.items():
            lines += [f"{title}:", *map(str, findings), ""]
        if self.can_render:
            return "\n".join([*lines, "This machine can render."])
        count = sum(finding.status in ("missing", "failed") for finding in self.findings)
        problems = "1 problem" if count == 1 else f"{count} problems"
        return "\n".join([*lines, f"This machine cannot render: {problems} above."])


def _machine() -> list[Finding]:
    try:
        system = platform.freedesktop_os_release()["PRETTY_NAME"]
    except OSError:
        system = platform.system()
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    python = f"Python {platform.python_version()}"
    return [Finding("system", "ok", f"{system}, {platform.machine()}, {cores} cores, {python}")]


def _packages() -> list[Finding]:
    """The packages that burnish's own metadata asks for, and those of the extra `study`."""
    try:
        requirements = metadata.requires("burnish") or []
    except metadata.PackageNotFoundError:
        return [Finding("burnish", "note", "used from a source tree, its requirements are unknown")]
    findings = []
    for requirement in requirements:
        name = re.split(r"[^A-Za-z0-9_.-]", requirement, maxsplit=1)[0]
        extra = re.search(r"extra\s*==\s*['\"](\w+)['\"]", requirement)
        if extra is not None and extra[1] != "study":
            continue
        try:
            findings.append(Finding(name, "ok", metadata.version(name)))
        except metadata.PackageNotFoundError:
            remedy = f"pip install '{requirement.split(';')[0].strip()}'"
            what: tuple[Status, str] = ("missing", "not installed")
            if extra is not None:
                what = ("note", f"not installed; only burnish[{extra[1]}] needs it")
            findings.append(Finding(name, *what, remedy))
    return findings


def _loader() -> Finding:
    try:
        ctypes.CDLL("libvulkan.so.1")
    except OSError:
        return Finding("Vulkan loader", "missing", "libvulkan.so.1 is not installed", INSTALL_LOADER)
    return Finding("Vulkan loader", "ok", "libvulkan.so.1")


def _validation_layer() -> Finding:
    data = os.environ.get("XDG_DATA_DIRS") or "/usr/local/share:/usr/share"
    folders = [Path(p) / "vulkan/explicit_layer.d" for p in ["/etc", *data.split(":")]]
    folders += [Path(p) for p in os.environ.get("VK_LAYER_PATH", "").split(":") if p]
    if any(folder.is_dir() and any(folder.glob("*khronos_validation*.json")) for folder in folders):
        return Finding("validation layer", "ok", "installed; BURNISH_VALIDATION=1 switches it on")
    return Finding("validation layer", "note", "not installed; only tests need it", INSTALL_LAYERS)


def _drivers() -> list[Finding]:
    """Every device of every driver, with the reasons why it cannot be used."""
    from burnish._core import VulkanError, list_devices

    try:
        devices = list_devices()
    except VulkanError as error:
        return [Finding("drivers", "missing", str(error), INSTALL_DRIVER)]
    if not devices:
        return [Finding("drivers", "missing", "no driver offers a device", INSTALL_DRIVER)]
    findings = []
    for device in devices:
        kind = "CPU" if device.is_software else "GPU"
        text = f"{kind}, driver {device.driver}, Vulkan {device.api_version}"
        if device.refusals:
            findings.append(
                Finding(device.name, "note", f"{text}; cannot be used: {'; '.join(device.refusals)}")
            )
        else:
            findings.append(Finding(device.name, "ok", text))
    return findings


def _chosen(device: "Device") -> list[Finding]:
    limits = ", ".join(f"{name} {device.limits[name]}" for name in SHOWN_LIMITS if name in device.limits)
    switches = {name: value for name, value in device.features.items() if isinstance(value, bool)}
    features = [name for name, value in switches.items() if value]
    absent = [name for name, value in switches.items() if not value]
    findings = [Finding("device", "ok", f"{device.name}, driver {device.driver}")]
    if device.is_software:
        findings.append(Finding("speed", "note", "a CPU; a GPU with a Vulkan 1.3 driver is much faster"))
    measured = device.lookup_measurement
    kept = f"; kept in {measured['kept_in']}" if measured and measured["kept_in"] else ""
    findings.append(Finding("lookup", "ok", f"{device.lookup}: {device.lookup_reason}{kept}"))
    if limits:
        findings.append(Finding("limits", "ok", limits))
    findings.append(Finding("features", "ok", ", ".join(features) or "none beyond what is required"))
    if absent:
        findings.append(Finding("absent", "note", ", ".join(absent)))
    return findings


def _hard_cases(device: "Device", lookup: str, progress: Progress | None) -> "list[Table]":
    """Tables of hard cases on the device, and with other lookups on others of the same name."""
    from burnish._core import Device
    from burnish.hardcases import run

    lookups = {"auto": [device.lookup], "both": ["sampler", "software"]}.get(lookup, [lookup])
    devices = [device if device.lookup == one else Device(name=device.name, lookup=one) for one in lookups]
    tables: list[Table] = []
    for one in devices:

        def advance(share: float, step: str, done: int = len(tables)) -> None:
            if progress is not None:
                progress((done + share) / len(devices), step)

        tables.append(run(one, progress=advance))
    return tables


def _judge(table: "Table") -> Finding:
    return Finding(f"lookup {table.lookup}", "failed" if table.failures else "ok", table.summary)


def examine(
    name: str = "",
    device: "Device | None" = None,
    hard_cases: str = "",
    progress: Progress | None = None,
) -> DoctorReport:
    """Examine this machine as far as it goes: each step needs the one before.

    Parameters
    ----------
    name : str
        Part of the name of the device to try; empty for the best one.
    device : Device or None
        An open device to try instead.
    hard_cases : str
        Measure the table of hard cases too, with maps read by "auto", "sampler", "software" or "both".
    progress : callable or None
        Called with the share of the hard cases that is done, 0..1, and the case's name.
    """
    report = DoctorReport({"machine": _machine(), "Python packages": _packages()})
    report.sections["Vulkan"] = vulkan = [_loader(), _validation_layer()]
    failure = load_failure()
    if failure is not None:
        if vulkan[0].status == "ok":
            text, _, remedy = failure.partition("; build it with: ")
            vulkan.append(Finding("burnish._core", "missing", text, remedy))
        return report
    drivers = _drivers()
    vulkan += drivers
    if not any(finding.status == "ok" for finding in drivers):
        if all(finding.status == "note" for finding in drivers):
            vulkan.append(Finding("drivers", "missing", "none of the devices can be used", INSTALL_DRIVER))
        return report

    from burnish._core import Device, VulkanError
    from burnish.doctor.self_test import run_self_test

    try:
        device = device or Device(name=name)
        report.sections["chosen device"] = _chosen(device)
        report.sections["self-test"] = run_self_test(device)
        if hard_cases:
            report.hard_cases = _hard_cases(device, hard_cases, progress)
            report.sections["hard cases"] = [_judge(table) for table in report.hard_cases]
    except VulkanError as error:
        report.sections.setdefault("self-test", []).append(
            Finding("device", "failed", " ".join(str(error).split()))
        )
    except Exception as error:  # a doctor reports what breaks, whatever it is
        text = f"{type(error).__name__}: {' '.join(str(error).split())}"
        report.sections.setdefault("self-test", []).append(Finding("engine", "failed", text))
    return report


def doctor(
    device: "Device | None" = None, hard_cases: bool = False, progress: Progress | None = None
) -> DoctorReport:
    """Look for what is missing on this machine, and try the engine on cases with known answers.

    Parameters
    ----------
    device : Device or None
        The device to try; None for the best one.
    hard_cases : bool
        Also measure the table of hard cases, ``report.hard_cases``: minutes on a CPU.
    progress : callable or None
        Called with the share of the hard cases that is done, 0..1, and the case's name; an exception that it
        raises stops them.

    Returns
    -------
    report : DoctorReport
        Printable: packages and versions, drivers with the reasons of refusal, the device chosen and its
        features, hard cases and the rate of samples, and for what is missing the command that installs it.
        ``report.can_render`` is the verdict.
    """
    return examine(device=device, hard_cases="auto" if hard_cases else "", progress=progress)

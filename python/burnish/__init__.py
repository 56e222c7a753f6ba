"""Glossy materials under environment light on Vulkan: the picture, its price in milliseconds, and its error.

Load or build a `Scene`, give it an `Environment`, and call `render`; or call `shade` on points of your own.
What a frame cost and what was left out is in ``frame.report``; how far it is from the truth,
``frame.error(reference)`` says.
"""

from burnish._extension import load_failure as _load_failure
from burnish._version import __version__
from burnish.doctor import DoctorReport, doctor
from burnish.frame import Frame
from burnish.report import Report

__all__ = [
    "Advice",
    "Camera",
    "Device",
    "DirectionalLight",
    "DoctorReport",
    "Environment",
    "FileError",
    "Frame",
    "GgxLobe",
    "Importance",
    "KurtLobe",
    "LafortuneLobe",
    "Matched",
    "Material",
    "Mesh",
    "Object",
    "PhongLobe",
    "PointLight",
    "Prefiltered",
    "Reference",
    "Regular",
    "Report",
    "Scene",
    "SheenLobe",
    "SpotLight",
    "VulkanError",
    "__version__",
    "advise",
    "doctor",
    "images",
    "list_devices",
    "render",
    "sample_pattern",
    "shade",
    "study",
]

if _load_failure() is None:
    from burnish import images
    from burnish._core import (
        Camera,
        Device,
        DirectionalLight,
        Environment,
        FileError,
        GgxLobe,
        Importance,
        KurtLobe,
        LafortuneLobe,
        Matched,
        Material,
        Mesh,
        Object,
        PointLight,
        Prefiltered,
        Reference,
        Regular,
        Scene,
        SheenLobe,
        SpotLight,
        VulkanError,
        list_devices,
        sample_pattern,
    )
    from burnish._methods import attach as _attach
    from burnish.advice import Advice, advise
    from burnish.lobes import PhongLobe
    from burnish.render import render
    from burnish.rendering import shade

    _attach()
    from burnish import study


def __getattr__(name: str) -> object:
    # `burnish doctor` must run without the compiled part, so only the use of what needs it fails.
    reason = _load_failure()
    if name in __all__ and reason is not None:
        raise ImportError(f"burnish.{name}: {reason}")
    raise AttributeError(f"module 'burnish' has no attribute {name!r}")

"""Types of what measures the compiled part; see _core.pyi."""

from typing import Any

from burnish._core import Camera, Device, Environment, Scene
from burnish._samplers import Importance, Matched, Prefiltered, Reference, Regular

def prefilter_times(
    device: Device, environment: Environment, filter: str, is_spherical: bool = False
) -> list[tuple[str, float]]: ...
def time_blits(device: Device, environment: Environment) -> float: ...
def pyramid_times(device: Device, environment: Environment, filter: str) -> list[tuple[str, float]]: ...
def time_lookups(
    device: Device, environment: Environment, sampler: Regular, roughness: float, repeats: int
) -> list[float]: ...
def time_shading(
    device: Device,
    scene: Scene,
    camera: Camera,
    sampler: Regular | Importance | Matched | Prefiltered | Reference,
    has_lookups: bool,
    is_written_out: bool = True,
) -> dict[str, Any]: ...

"""Types of the compiled part. Its docstrings say what the names mean; tests hold this file against it."""

from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from burnish._devices import Device as Device
from burnish._devices import DeviceInfo as DeviceInfo
from burnish._devices import cache_folder as cache_folder
from burnish._devices import list_devices as list_devices
from burnish._lights import DirectionalLight as DirectionalLight
from burnish._lights import PointLight as PointLight
from burnish._lights import SpotLight as SpotLight
from burnish._lobes import GgxLobe as GgxLobe
from burnish._lobes import KurtLobe as KurtLobe
from burnish._lobes import LafortuneLobe as LafortuneLobe
from burnish._lobes import SheenLobe as SheenLobe
from burnish._samplers import Importance as Importance
from burnish._samplers import Matched as Matched
from burnish._samplers import Prefiltered as Prefiltered
from burnish._samplers import Reference as Reference
from burnish._samplers import Regular as Regular
from burnish._texels import HalfRange as HalfRange
from burnish._texels import TexelReport as TexelReport
from burnish._timings import prefilter_times as prefilter_times
from burnish._timings import pyramid_times as pyramid_times
from burnish._timings import time_blits as time_blits
from burnish._timings import time_lookups as time_lookups
from burnish._timings import time_shading as time_shading
from burnish.filters import Filter as _Filter
from burnish.images.source import FilePath as _Path
from burnish.images.source import PictureFile as _PictureFile

_Float32: TypeAlias = NDArray[np.float32]
_Float64: TypeAlias = NDArray[np.float64]
_Prefiltered: TypeAlias = list[tuple[float, _Float32]]
_Pair: TypeAlias = float | Sequence[float]
_Color: TypeAlias = float | Sequence[float]
_Rotation: TypeAlias = float | ArrayLike | None
_Progress: TypeAlias = Callable[[float, str], None] | None
_Lobe: TypeAlias = KurtLobe | GgxLobe | LafortuneLobe | SheenLobe
_Light: TypeAlias = PointLight | DirectionalLight | SpotLight
_Sampler: TypeAlias = Regular | Importance | Matched | Prefiltered | Reference

class FileError(OSError): ...
class VulkanError(RuntimeError): ...

class Material:
    def __init__(
        self,
        diffuse: _Color = 0.0,
        lobes: Sequence[_Lobe] = (),
        emissive: _Color = 0.0,
        name: str = "",
        double_sided: bool = False,
        layered: bool = False,
    ) -> None: ...
    @staticmethod
    def metallic_roughness(
        base_color: _Color = 1.0,
        metallic: float = 0.0,
        roughness: float = 0.5,
        clearcoat: float = 0.0,
        clearcoat_roughness: float = 0.0,
        sheen: _Color = 0.0,
        sheen_roughness: float = 0.0,
        anisotropy: float = 0.0,
        anisotropy_rotation: float = 0.0,
        ior: float = 1.5,
        specular: float = 1.0,
        specular_color: _Color = 1.0,
        emissive: _Color = 0.0,
        model: Literal["ggx", "kurt"] = "ggx",
        name: str = "",
        double_sided: bool = False,
    ) -> Material: ...
    def replace(
        self,
        *,
        diffuse: _Color | None = None,
        lobes: Sequence[_Lobe] | None = None,
        emissive: _Color | None = None,
        name: str | None = None,
        double_sided: bool | None = None,
        layered: bool | None = None,
    ) -> Material: ...
    @property
    def left_out(self) -> list[str]: ...
    @property
    def layered(self) -> bool: ...
    @property
    def covers(self) -> tuple[tuple[tuple[float, float] | None, bool], ...] | None: ...
    @property
    def diffuse(self) -> tuple[float, float, float]: ...
    @property
    def lobes(self) -> tuple[_Lobe, ...]: ...
    @property
    def emissive(self) -> tuple[float, float, float]: ...
    @property
    def name(self) -> str: ...
    @property
    def double_sided(self) -> bool: ...
    @property
    def alpha_mode(self) -> Literal["opaque", "mask", "blend"]: ...
    @property
    def alpha_cutoff(self) -> float: ...
    @property
    def is_metallic_roughness(self) -> bool: ...

class Mesh:
    def __init__(
        self,
        positions: _Float32,
        indices: NDArray[np.uint32],
        normals: _Float32 | None = None,
        tangents: _Float32 | None = None,
        uv0: _Float32 | None = None,
        name: str = "",
    ) -> None: ...
    @property
    def positions(self) -> _Float32: ...
    @property
    def normals(self) -> _Float32: ...
    @property
    def tangents(self) -> _Float32 | None: ...
    @property
    def uv0(self) -> _Float32 | None: ...
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def name(self) -> str: ...
    @staticmethod
    def sphere(radius: float = 1.0, segments: int = 128) -> Mesh: ...
    @staticmethod
    def torus(radius: float = 1.0, tube_radius: float = 0.4, segments: int = 128) -> Mesh: ...
    @staticmethod
    def plane(size: float = 2.0, segments: int = 1) -> Mesh: ...

class Camera:
    def __init__(
        self,
        world_from_camera: ArrayLike,
        vertical_fov: float = 0.8,
        near_plane: float = 0.01,
        name: str = "",
    ) -> None: ...
    @staticmethod
    def look_at(
        eye: Sequence[float],
        target: Sequence[float],
        up: Sequence[float] = (0, 1, 0),
        vertical_fov: float = 0.8,
        near_plane: float = 0.01,
    ) -> Camera: ...
    @staticmethod
    def orthographic(
        eye: Sequence[float],
        target: Sequence[float],
        up: Sequence[float] = (0, 1, 0),
        half_height: float = 1.0,
        near_plane: float = 0.0,
        far_plane: float = 1000.0,
    ) -> Camera: ...
    @property
    def world_from_camera(self) -> _Float64: ...
    @property
    def is_orthographic(self) -> bool: ...
    @property
    def vertical_fov(self) -> float: ...
    @property
    def half_height(self) -> float: ...
    @property
    def near_plane(self) -> float: ...
    @property
    def far_plane(self) -> float: ...
    @property
    def name(self) -> str: ...

class Object:
    @property
    def name(self) -> str: ...
    @property
    def mesh(self) -> int: ...
    @property
    def material(self) -> int: ...
    @material.setter
    def material(self, index: int) -> None: ...
    @property
    def world_from_object(self) -> _Float64: ...
    @world_from_object.setter
    def world_from_object(self, transform: ArrayLike) -> None: ...
    @property
    def reflects(self) -> Environment | None: ...
    @reflects.setter
    def reflects(self, environment: Environment | None) -> None: ...
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]: ...

class Scene:
    name: str
    show_background: bool
    def __init__(self) -> None: ...
    @staticmethod
    def from_file(
        path: _Path, model: Literal["ggx", "kurt"] = "ggx", leave_out_idle: bool = True
    ) -> Scene: ...
    @staticmethod
    def sphere(material: Material) -> Scene: ...
    @staticmethod
    def spheres(materials: Sequence[Material], columns: int) -> Scene: ...
    @staticmethod
    def plane(material: Material) -> Scene: ...
    @staticmethod
    def shader_ball(material: Material, ground: Material | None = None) -> Scene: ...
    def add(
        self, mesh: Mesh, material: Material, transform: ArrayLike | None = None, name: str = ""
    ) -> int: ...
    def set_material(self, index: int, material: Material) -> None: ...
    def add_camera(self, camera: Camera) -> None: ...
    def find_object(self, name: str) -> Object: ...
    def default_camera(self) -> Camera: ...
    def bounds(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]: ...
    @property
    def meshes(self) -> tuple[Mesh, ...]: ...
    @property
    def materials(self) -> tuple[Material, ...]: ...
    @property
    def cameras(self) -> tuple[Camera, ...]: ...
    @property
    def objects(self) -> tuple[Object, ...]: ...
    @property
    def image_count(self) -> int: ...
    @property
    def triangle_count(self) -> int: ...
    @property
    def environment(self) -> Environment | None: ...
    @environment.setter
    def environment(self, environment: Environment | None) -> None: ...
    @property
    def lights(self) -> tuple[_Light, ...]: ...
    @lights.setter
    def lights(self, lights: Sequence[_Light]) -> None: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def ignored_extensions(self) -> list[str]: ...
    # Added by burnish._methods.
    def capture(
        self,
        point: Sequence[float] | None = None,
        object: str | int | None = None,
        face_size: int = 256,
        device: Device | None = None,
    ) -> Environment: ...

class Environment:
    name: str
    exposure: float
    notes: list[str]
    @staticmethod
    def from_faces(faces: _Float32, exposure: float = 0.0, rotation: _Rotation = None) -> Environment: ...
    @staticmethod
    def from_lat_long(
        img: _Float32,
        face_size: int = 512,
        exposure: float = 0.0,
        rotation: _Rotation = None,
        border_samples: bool = False,
    ) -> Environment: ...
    @property
    def faces(self) -> _Float32: ...
    @property
    def face_size(self) -> int: ...
    @property
    def rotation(self) -> _Float32: ...
    @rotation.setter
    def rotation(self, rotation: _Rotation) -> None: ...
    @property
    def texel_report(self) -> TexelReport: ...
    @property
    def half_range(self) -> HalfRange: ...
    # Added by burnish._methods.
    @staticmethod
    def from_file(
        path: _PictureFile,
        face_size: int | None = None,
        exposure: float = 0.0,
        rotation: Any = None,
        part: str | int | None = None,
        layer: str | None = None,
    ) -> Environment: ...
    def pyramid(self, filter: _Filter = "gauss6", device: Device | None = None) -> list[_Float32]: ...
    def prefiltered(self, filter: _Filter = "gauss6", device: Device | None = None) -> _Prefiltered: ...

def decode_hdr(data: bytes, name: str) -> tuple[_Float32, dict[str, Any]]: ...
def decode_png16(data: bytes, name: str) -> NDArray[np.uint16]: ...

class FrameData:
    @property
    def color(self) -> _Float32: ...
    @property
    def alpha(self) -> _Float32: ...
    @property
    def display(self) -> NDArray[np.uint8]: ...
    @property
    def depth(self) -> _Float32: ...
    @property
    def normal(self) -> _Float32: ...
    @property
    def position(self) -> _Float64: ...
    @property
    def report(self) -> dict[str, Any]: ...

def filter_offsets(count: int) -> NDArray[np.float32]: ...
def sample_pattern(
    roughness: _Pair, spacing: Literal["s1", "s2"] = "s1", circles: int = 3, threshold: float = 0.1
) -> NDArray[np.float64]: ...
def shade(
    device: Device,
    environment: Environment,
    material: Material,
    sampler: _Sampler,
    normals: _Float32,
    tangents: _Float32,
    views: _Float32,
    filter: str,
    is_strict: bool = False,
    wants_report: bool = False,
    positions: _Float32 | _Float64 | None = None,
    scene: Scene | None = None,
) -> tuple[_Float32, list[str], dict[str, Any] | None]: ...
def environment_pyramid(device: Device, environment: Environment, filter: str) -> list[_Float32]: ...
def environment_prefiltered(device: Device, environment: Environment, filter: str) -> _Prefiltered: ...
def environment_spherical(device: Device, environment: Environment, filter: str) -> list[_Float32]: ...
def plan(
    scene: Scene,
    sampler: _Sampler,
    spp: int,
    filter: str,
    is_software: bool,
    display_exposure: float | None = None,
    device: Device | None = None,
) -> dict[str, Any]: ...
def render(
    device: Device,
    scene: Scene,
    camera: Camera | None,
    height: int,
    width: int,
    sampler: _Sampler,
    spp: int,
    filter: str,
    progress: _Progress,
    is_strict: bool = False,
    display_exposure: float | None = None,
) -> FrameData: ...
def capture(
    device: Device,
    scene: Scene,
    point: tuple[float, float, float],
    face_size: int,
    without_object: int | None,
) -> Environment: ...
def shared_layout() -> dict[str, dict[str, int]]: ...
def inject_fault(device: Device, call: str, result: int, skip: int = 0, times: int = 1) -> None: ...
def closing_messages() -> list[str]: ...
def exit_on_closing_messages() -> None: ...
def probe(device: Device, library: str, function: int, arguments: _Float32) -> _Float32: ...

"""Types of the compiled part: direct lights."""

from collections.abc import Sequence
from typing import TypeAlias

_Color: TypeAlias = float | Sequence[float]
_Triple: TypeAlias = tuple[float, float, float]

class PointLight:
    def __init__(
        self,
        position: Sequence[float],
        intensity: _Color = 1.0,
        radius: float = 0.0,
        range: float | None = None,
    ) -> None: ...
    @property
    def position(self) -> _Triple: ...
    @property
    def intensity(self) -> _Triple: ...
    @property
    def radius(self) -> float: ...
    @property
    def range(self) -> float | None: ...

class DirectionalLight:
    def __init__(self, direction: Sequence[float], irradiance: _Color = 1.0, angle: float = 0.0) -> None: ...
    @property
    def direction(self) -> _Triple: ...
    @property
    def irradiance(self) -> _Triple: ...
    @property
    def angle(self) -> float: ...

class SpotLight:
    def __init__(
        self,
        position: Sequence[float],
        direction: Sequence[float],
        intensity: _Color = 1.0,
        inner_angle: float = 0.0,
        outer_angle: float = 0.785398163,
        radius: float = 0.0,
        range: float | None = None,
    ) -> None: ...
    @property
    def position(self) -> _Triple: ...
    @property
    def direction(self) -> _Triple: ...
    @property
    def intensity(self) -> _Triple: ...
    @property
    def inner_angle(self) -> float: ...
    @property
    def outer_angle(self) -> float: ...
    @property
    def radius(self) -> float: ...
    @property
    def range(self) -> float | None: ...

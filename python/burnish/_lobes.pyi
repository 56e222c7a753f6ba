"""Types of the compiled part: models of lobes."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

_Pair: TypeAlias = float | Sequence[float]
_Color: TypeAlias = float | Sequence[float]

class KurtLobe:
    def __init__(
        self,
        roughness: _Pair = 0.2,
        r0: _Color = 1.0,
        alpha: float = 0.0,
        weight: _Color = 1.0,
        rotation: float = 0.0,
        conserve_energy: bool = False,
    ) -> None: ...
    @property
    def roughness(self) -> tuple[float, float]: ...
    @property
    def r0(self) -> tuple[float, float, float]: ...
    @property
    def alpha(self) -> float: ...
    @property
    def weight(self) -> tuple[float, float, float]: ...
    @property
    def rotation(self) -> float: ...
    @property
    def conserve_energy(self) -> bool: ...
    @property
    def is_anisotropic(self) -> bool: ...
    @property
    def has_fresnel(self) -> bool: ...

class GgxLobe:
    def __init__(
        self,
        roughness: _Pair = 0.2,
        r0: _Color = 1.0,
        f90: _Color = 1.0,
        weight: _Color = 1.0,
        rotation: float = 0.0,
        compensate: Literal["none", "scale"] = "none",
    ) -> None: ...
    @property
    def compensate(self) -> Literal["none", "scale"]: ...
    @property
    def roughness(self) -> tuple[float, float]: ...
    @property
    def r0(self) -> tuple[float, float, float]: ...
    @property
    def f90(self) -> tuple[float, float, float]: ...
    @property
    def weight(self) -> tuple[float, float, float]: ...
    @property
    def rotation(self) -> float: ...
    @property
    def is_anisotropic(self) -> bool: ...
    @property
    def has_fresnel(self) -> bool: ...

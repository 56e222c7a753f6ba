"""Types of the samplers, which the compiled part makes: `_core.pyi` names them; there is no such module."""

from typing import Literal

class Regular:
    def __init__(
        self,
        samples: int = 14,
        threshold: float = 0.2,
        footprint: Literal["published", "exact"] = "exact",
        normalization: Literal["published", "projected", "furnace"] = "furnace",
        mip_bias: float = 0.0,
    ) -> None: ...
    @property
    def samples(self) -> int: ...
    @property
    def threshold(self) -> float: ...
    @property
    def footprint(self) -> Literal["published", "exact"]: ...
    @property
    def normalization(self) -> Literal["published", "projected", "furnace"]: ...
    @property
    def mip_bias(self) -> float: ...

class Importance:
    def __init__(
        self,
        samples: int = 14,
        points: Literal["hammersley", "fibonacci"] = "hammersley",
        mip_bias: float = 0.0,
    ) -> None: ...
    @property
    def samples(self) -> int: ...
    @property
    def points(self) -> Literal["hammersley", "fibonacci"]: ...
    @property
    def mip_bias(self) -> float: ...

class Matched:
    def __init__(self, samples: int = 14) -> None: ...
    @property
    def samples(self) -> int: ...

class Prefiltered:
    def __init__(self) -> None: ...

class Reference:
    def __init__(
        self,
        standard_error: float = 0.002,
        method: Literal["auto", "quadrature", "progressive"] = "auto",
        max_samples: int = 65536,
    ) -> None: ...
    @property
    def standard_error(self) -> float: ...
    @property
    def method(self) -> Literal["auto", "quadrature", "progressive"]: ...
    @property
    def max_samples(self) -> int: ...

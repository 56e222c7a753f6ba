"""What a hard case is: data, one number measured on a device, and the bound that number must keep."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from burnish._core import Device
    from burnish.hardcases.bench import Bench

#: The samplers that a case runs with, by the names of the table; "" stands for a case without one.
SAMPLERS = ("regular", "importance", "matched", "prefiltered", "reference")
#: All but the reference, whose sum over texels knows no lobe narrower than a texel.
BY_LOBE = SAMPLERS[:4]
ONCE = ("",)

#: Rasterisers move corners of triangles to a grid of 2^-bits pixels: 8 on GPUs and lavapipe, 4 at the least.
FINE_SUB_PIXEL_BITS = 8


@dataclass(frozen=True)
class Bound:
    """The most that a case may measure, and the reason why it is that much and not more.

    Parameters
    ----------
    value : float, or dict of float by sampler
        In the unit of the case's quantity.
    reason : str
        Where that figure comes from.
    corners : float
        What the software lookup adds: the mean of three texels that stands for a corner's fourth is kept as a
        half float, up to 2^-12 off, of which a lookup sees a quarter at the corner and less elsewhere.
    snapped : float
        What rasterisers add that move corners of triangles to a grid of less than `FINE_SUB_PIXEL_BITS`.
    """

    value: float | Mapping[str, float]
    reason: str
    corners: float = 0.0
    snapped: float = 0.0

    def of(self, sampler: str) -> float:
        """Return the bound for one sampler, "" for a case without."""
        return self.value[sampler] if isinstance(self.value, Mapping) else self.value

    def on(self, device: "Device", sampler: str) -> float:
        """Return the same with what is allowed to this device."""
        value = self.of(sampler)
        if device.lookup == "software":
            value += self.corners
        if device.limits["sub_pixel_bits"] < FINE_SUB_PIXEL_BITS:
            value += self.snapped
        return value


@dataclass(frozen=True)
class Quantity:
    """What is measured: its name in the table, how it is measured, and the bound that it usually has."""

    name: str
    measure: "Callable[[Bench, str], float]"
    bound: Bound


@dataclass(frozen=True)
class HardCase:
    """One of the worst inputs.

    Parameters
    ----------
    name : str
        Unique; a sentence's beginning, as the table shows it.
    why : str
        What breaks here without the stable form.
    quantity : Quantity
        What is measured.
    source : str
        Section of the maths, equation or chapter that the case comes from.
    samplers : tuple of str
        Those that it runs with, of `SAMPLERS`; ``("",)``: it concerns none and runs once.
    bound : Bound or None
        None: the quantity's own.
    """

    name: str
    why: str
    quantity: Quantity
    source: str
    samplers: tuple[str, ...] = SAMPLERS
    bound: Bound | None = None

    @property
    def limit(self) -> Bound:
        """The bound that holds for this case."""
        return self.bound or self.quantity.bound


@dataclass(frozen=True)
class Measurement:
    """One row of the table.

    Parameters
    ----------
    case : str
        Name of the case.
    sampler : str
        "" where none is concerned.
    quantity : str
        What was measured.
    bound, measured : float
        In the quantity's unit; `measured` is NaN where nothing could be measured.
    known : str
        Why this driver is known to fail; "" where it must pass.
    note : str
        The error that kept the case from being measured.
    """

    case: str
    sampler: str
    quantity: str
    bound: float
    measured: float
    known: str = ""
    note: str = field(default="", compare=False)

    @property
    def passed(self) -> bool:
        """Whether the number is within its bound; never for NaN."""
        return self.measured <= self.bound

    @property
    def verdict(self) -> str:
        """Return "pass", "fail" or "known failure"."""
        return "pass" if self.passed else "known failure" if self.known else "fail"

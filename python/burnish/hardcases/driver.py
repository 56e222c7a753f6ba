"""What lookups of a driver are worth."""

from typing import Literal

from burnish._core import Device

DriverClass = Literal["exact", "rounded"]

#: Hardware rounds the weights of a lookup, along x, along y and between levels, to 8 bits.
ROUNDED_WEIGHTS = 3 * 2.0**-9


def driver_class(device: Device) -> DriverClass:
    """What a device's lookups are worth, which decides what is allowed for them.

    "exact": weights in float32, as CPU drivers and the software lookup have them; "rounded": weights of 8
    bits, as the samplers of GPUs have them. What one driver does wrong is in ``KNOWN_FAILURES``.

    Parameters
    ----------
    device : Device
        An open device.
    """
    return "exact" if device.is_software or device.lookup == "software" else "rounded"

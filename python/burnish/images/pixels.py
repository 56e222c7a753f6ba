"""A picture that was read, and what its file says about it."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass
class Picture:
    """A picture and what its file says about it."""

    pixels: NDArray[np.float32]
    """(h, w, 3) or (h, w, 4), linear Rec. 709."""
    format: str
    """"OpenEXR", "Radiance", "PNG" or "JPEG"."""
    envmap: int | None = None
    """OpenEXR's attribute of that name: `exr_header.LATLONG`, `exr_header.CUBE` or None."""
    notes: list[str] = field(default_factory=list)
    """What was used of the file's fields and left out of its channels, a sentence each."""
    ignored: list[str] = field(default_factory=list)
    """What the file says that would change the picture and is not used; readers warn of it."""

    @property
    def is_high_dynamic_range(self) -> bool:
        """Whether the format can hold radiance above 1."""
        return self.format in ("OpenEXR", "Radiance")

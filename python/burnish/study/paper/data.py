"""What was measured of the paper."""

from dataclasses import dataclass, field
from typing import Any

from burnish.study.store import CellPictures


@dataclass(eq=False)
class PaperData:
    """What was measured of the paper; `Paper` says what its fields are."""

    numbers: dict[str, Any]
    pictures: dict[str, CellPictures] = field(default_factory=dict)

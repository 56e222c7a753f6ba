"""Models of lobes: each is one file, and a name in this list."""

from types import ModuleType
from typing import Any

from . import ggx, kurt, lafortune, sheen

MODELS: dict[str, ModuleType] = {
    "KurtLobe": kurt,
    "GgxLobe": ggx,
    "LafortuneLobe": lafortune,
    "SheenLobe": sheen,
}


def model_of(lobe: Any) -> ModuleType:
    """The model of a lobe, the oracle's or burnish's own."""
    name = type(lobe).__name__
    if name not in MODELS:
        raise ValueError(f"lobe: expected one of {', '.join(MODELS)}, got {name}")
    return MODELS[name]

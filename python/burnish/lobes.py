"""Models of lobes as Python code names them: their parameters, and what is said of them."""

from collections.abc import Sequence
from typing import Any, TypeAlias

from burnish._core import GgxLobe, KurtLobe, LafortuneLobe, SheenLobe

Lobe: TypeAlias = KurtLobe | GgxLobe | LafortuneLobe | SheenLobe

#: Model, its class, and its parameters as the constructor takes them.
MODELS: dict[str, tuple[type, tuple[str, ...]]] = {
    "kurt": (KurtLobe, ("roughness", "r0", "alpha", "weight", "rotation", "conserve_energy")),
    "ggx": (GgxLobe, ("roughness", "r0", "f90", "weight", "rotation", "compensate")),
    "lafortune": (LafortuneLobe, ("c", "exponent", "weight", "rotation")),
    "sheen": (SheenLobe, ("roughness", "weight")),
}


def PhongLobe(  # noqa: N802  it stands beside the models' classes
    exponent: float = 10.0, weight: float | Sequence[float] = 1.0
) -> LafortuneLobe:
    """Make Phong's lobe, a power of the cosine around the mirrored view: Lafortune's of c = (-1, -1, 1).

    Parameters
    ----------
    exponent : float
        In 0..1e6.
    weight : float or (float, float, float)
        Colour, >= 0.

    Raises
    ------
    ValueError
        If a number is out of its range.
    """
    return LafortuneLobe((-1.0, -1.0, 1.0), exponent, weight)


def width_of(lobe: Lobe) -> tuple[float, float]:
    """How wide a lobe is along its axes, as slopes of half-vectors."""
    return lobe.roughness if isinstance(lobe, KurtLobe | GgxLobe) else lobe.width


def model_of(lobe: Lobe) -> str:
    """Name the model of a lobe."""
    return next(name for name, (kind, _) in MODELS.items() if type(lobe) is kind)


def describe_lobe(lobe: Lobe) -> dict[str, Any]:
    """Give a lobe's parameters in a form that JSON can hold, and its model where that is not Kurt's."""
    model = model_of(lobe)
    values = {name: getattr(lobe, name) for name in MODELS[model][1]}
    named = {} if model == "kurt" else {"model": model}
    return named | {k: list(v) if isinstance(v, tuple) else v for k, v in values.items()}


def make_lobe(description: dict[str, Any]) -> Lobe:
    """Make the lobe that `describe_lobe` described.

    Parameters
    ----------
    description : dict
        ``model``, Kurt's where there is none, and what its constructor takes.

    Raises
    ------
    ValueError
        Of a model that there is not.
    """
    parameters = dict(description)
    model = parameters.pop("model", "kurt")
    if model not in MODELS:
        raise ValueError(f"model: expected one of {', '.join(MODELS)}, got {model!r}")
    lobe: Lobe = MODELS[model][0](**parameters)
    return lobe


def has_fresnel(lobe: Lobe) -> bool:
    """Whether a lobe reflects more toward grazing by Schlick's term."""
    return isinstance(lobe, KurtLobe | GgxLobe) and lobe.has_fresnel


def name_lobe(lobe: Lobe) -> str:
    """Name a lobe in few words, such as ``m 0.05, r0 0.04, alpha 0.5`` or ``lafortune -1/-1/1, n 10``."""

    def listed(values: Sequence[float]) -> str:
        return "/".join(dict.fromkeys(f"{value:.4g}" for value in values))

    if isinstance(lobe, LafortuneLobe):
        return f"lafortune {'/'.join(f'{c:.4g}' for c in lobe.c)}, n {lobe.exponent:.4g}"
    if isinstance(lobe, SheenLobe):
        return f"sheen {lobe.roughness:.4g}"
    words = [f"{'m' if isinstance(lobe, KurtLobe) else 'ggx'} {listed(lobe.roughness)}"]
    if any(value != 1.0 for value in lobe.r0):
        words.append(f"r0 {listed(lobe.r0)}")
    if grazing_exponent(lobe):
        words.append(f"alpha {grazing_exponent(lobe):.4g}")
    return ", ".join(words)


def grazing_exponent(lobe: Lobe) -> float:
    """Power of cosines in the lobe, 0 of models that have none."""
    return lobe.alpha if isinstance(lobe, KurtLobe) else 0.0

"""Models of lobes as Python code names them: their parameters, and what is said of them."""

from typing import Any, TypeAlias

from burnish._core import GgxLobe, KurtLobe

Lobe: TypeAlias = KurtLobe | GgxLobe

#: Model, its class, and its parameters as the constructor takes them.
MODELS: dict[str, tuple[type, tuple[str, ...]]] = {
    "kurt": (KurtLobe, ("roughness", "r0", "alpha", "weight", "rotation", "conserve_energy")),
    "ggx": (GgxLobe, ("roughness", "r0", "f90", "weight", "rotation", "compensate")),
}


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


def grazing_exponent(lobe: Lobe) -> float:
    """Power of cosines in the lobe, 0 of models that have none."""
    return lobe.alpha if isinstance(lobe, KurtLobe) else 0.0

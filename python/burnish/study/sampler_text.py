"""Samplers as text: one line names all that was asked for, and makes the sampler again elsewhere.

The command line's form, then ``key=value`` for what it has no word for: ``regular:14:published``,
``importance:30:fibonacci:mip_bias=1``, ``regular:14:threshold=0.1``.
"""

from typing import Any

from burnish import _core
from burnish._cli_arguments import parse_sampler

WORDS: dict[str, dict[str, dict[str, Any]]] = {
    "regular": {"published": {"footprint": "published", "normalization": "published"}},
    "importance": {"fibonacci": {"points": "fibonacci"}},
}
"""What a word of the command line stands for."""


def sampler_parameters(sampler: Any) -> dict[str, Any]:
    """Read every parameter that a sampler was made with.

    Parameters
    ----------
    sampler : Regular, Importance, Reference or a sampler like them
        Its properties are named as its constructor's parameters are.
    """
    kind = type(sampler)
    names = [name for name in dir(kind) if not name.startswith("_")]
    return {
        name: _shortest(getattr(sampler, name)) for name in names if isinstance(getattr(kind, name), property)
    }


def _shortest(value: Any) -> Any:
    """Give the short decimal number that a float32 was made from: 0.2, not 0.20000000298."""
    return float(f"{value:.6g}") if isinstance(value, float) else value


def _short_text(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _leading_parameter(name: str) -> str | None:
    """Name the parameter that stands right behind the sampler's name, if any."""
    kind = getattr(_core, name.capitalize())
    for parameter in ("samples", "standard_error"):
        try:
            kind(**{parameter: getattr(kind(), parameter)})
        except (AttributeError, TypeError):
            continue
        return parameter
    return None


def sampler_to_text(sampler: Any, with_count: bool = True) -> str:
    """Name a sampler and all of its parameters that are not the default.

    Parameters
    ----------
    sampler : Regular, Importance, Reference or a sampler like them
        What to name.
    with_count : bool
        False: leave the number of samples out, which names the method: the curve it belongs to.

    Returns
    -------
    text : str
        Such as ``regular:14:published``; `sampler_from_text` makes an equal sampler of it.
    """
    name = type(sampler).__name__.lower()
    default = sampler_parameters(type(sampler)())
    parameters = sampler_parameters(sampler)
    parts = [name]
    leading = _leading_parameter(name)
    if leading is not None:
        value = parameters.pop(leading)
        if with_count:
            parts.append(_short_text(value))
    for word, meaning in WORDS.get(name, {}).items():
        if all(parameters[key] == value for key, value in meaning.items()):
            parts.append(word)
            parameters |= {key: default[key] for key in meaning}
    parts += [f"{key}={_short_text(value)}" for key, value in parameters.items() if value != default[key]]
    return ":".join(parts)


def parse_value(text: str) -> int | float | str:
    """Read a number, an integer where it is one; else the text itself.

    Parameters
    ----------
    text : str
        The right side of ``key=value``.
    """
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def sampler_from_text(text: str) -> Any:
    """Make the sampler that a text names.

    Parameters
    ----------
    text : str
        As `sampler_to_text` writes it.

    Raises
    ------
    ValueError
        If there is no such sampler or parameter, or a value is out of its range.
    """
    parts = text.split(":")
    sampler = parse_sampler(":".join(part for part in parts if "=" not in part))
    given = dict(part.split("=", 1) for part in parts if "=" in part)
    if not given:
        return sampler
    parameters = sampler_parameters(sampler)
    unknown = [key for key in given if key not in parameters]
    if unknown:
        raise ValueError(f"{text}: expected one of {', '.join(parameters)}, got {unknown[0]!r}")
    try:
        return type(sampler)(**parameters | {key: parse_value(value) for key, value in given.items()})
    except (ValueError, TypeError) as error:
        raise ValueError(f"{text}: {str(error).splitlines()[0]}") from error


def expand_counts(text: str) -> list[str]:
    """Write ``regular:5,14:published`` out as ``regular:5:published`` and ``regular:14:published``.

    Parameters
    ----------
    text : str
        A sampler whose second part may be several, with commas.
    """
    name, *options = text.split(":")
    if not options or "," not in options[0]:
        return [text]
    return [":".join([name, count, *options[1:]]) for count in options[0].split(",")]

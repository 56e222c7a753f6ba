"""The grammar of samplers: one line names a sampler and all of its parameters, and makes it again elsewhere.

The name, what leads it, a word, then ``key=value`` for what there is no word for: ``regular:14:published``,
``importance:30:fibonacci:mip_bias=1``, ``regular:14:threshold=0.1``.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from burnish import _core

Sampler: TypeAlias = _core.Regular | _core.Importance | _core.Matched | _core.Prefiltered | _core.Reference


@dataclass(frozen=True)
class Form:
    """How a sampler is written.

    Parameters
    ----------
    make : type
        The sampler; its properties are named as its constructor's parameters are.
    leading : str or None
        The parameter that stands right behind the name.
    kind : type
        Of that parameter.
    words : dict of dict
        Parameters that a word stands for.
    """

    make: type[Sampler]
    leading: str | None = None
    kind: type[int] | type[float] = int
    words: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)


FORMS: dict[str, Form] = {
    "matched": Form(_core.Matched, "samples"),
    "regular": Form(
        _core.Regular,
        "samples",
        words={"published": {"footprint": "published", "normalization": "published"}},
    ),
    "importance": Form(
        _core.Importance,
        "samples",
        words={"hammersley": {"points": "hammersley"}, "fibonacci": {"points": "fibonacci"}},
    ),
    "prefiltered": Form(_core.Prefiltered),
    "reference": Form(_core.Reference, "standard_error", float),
}
DEFAULT_SAMPLER = "matched:14"


def grammar() -> str:
    """Say in one line how samplers are written."""
    texts = []
    for name, form in FORMS.items():
        words = f"[:{'|'.join(form.words)}]" if form.words else ""
        leading = "COUNT" if form.leading == "samples" else str(form.leading).upper()
        texts.append(f"{name}[:{leading}{words}]" if form.leading else name)
    return (
        f"{', '.join(texts[:-1])} or {texts[-1]}, and KEY=VALUE for its other parameters, "
        "as matched:14:diffuse=harmonics"
    )


def sampler_parameters(sampler: Sampler) -> dict[str, Any]:
    """Read every parameter that a sampler was made with.

    Parameters
    ----------
    sampler : Regular, Importance, Matched, Prefiltered or Reference
        Any.
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


def sampler_to_text(sampler: Sampler, with_count: bool = True) -> str:
    """Name a sampler and all of its parameters that are not the default.

    Parameters
    ----------
    sampler : Regular, Importance, Matched, Prefiltered or Reference
        What to name.
    with_count : bool
        False: leave the number of samples out, which names the method: the curve it belongs to.

    Returns
    -------
    text : str
        Such as ``regular:14:published``; `sampler_from_text` makes an equal sampler of it.
    """
    name, form = next((name, form) for name, form in FORMS.items() if isinstance(sampler, form.make))
    default, parameters = sampler_parameters(form.make()), sampler_parameters(sampler)
    parts = [name]
    if form.leading is not None:
        value = parameters.pop(form.leading)
        if with_count:
            parts.append(_short_text(value))
    for word, meaning in form.words.items():
        is_meant = all(parameters[key] == value for key, value in meaning.items())
        if is_meant and any(default[key] != value for key, value in meaning.items()):
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


def sampler_from_text(text: str, option: str = "sampler") -> Sampler:
    """Make the sampler that a text names.

    Parameters
    ----------
    text : str
        As `sampler_to_text` writes it.
    option : str
        What errors call it: the argument that the text was given for.

    Raises
    ------
    ValueError
        If there is no such sampler or parameter, or a value is out of its range.
    """
    name, *options = text.split(":")
    form = FORMS.get(name)
    plain = [one for one in options if "=" not in one]
    try:
        if form is None:
            raise KeyError(name)
        parameters = _plain_parameters(form, plain)
        sampler = form.make(**parameters)
    except KeyError:
        raise ValueError(f"{option}: expected {grammar()}, got {text!r}") from None
    except (ValueError, TypeError) as error:
        reason = str(error).splitlines()[0]
        raise ValueError(f"{option}: expected {grammar()}, got {text!r}: {reason}") from error
    given = dict(one.split("=", 1) for one in options if "=" in one)
    known = sampler_parameters(sampler)
    unknown = [key for key in given if key not in known]
    if unknown:
        raise ValueError(f"{option}: {text}: expected one of {', '.join(known)}, got {unknown[0]!r}")
    try:
        return form.make(**parameters | {key: parse_value(value) for key, value in given.items()})
    except (ValueError, TypeError) as error:
        raise ValueError(f"{option}: {text}: {str(error).splitlines()[0]}") from error


def _plain_parameters(form: Form, plain: list[str]) -> dict[str, Any]:
    """Read what leads and a word; KeyError for more of them, or another word."""
    if form.leading is None or not plain:
        if plain:
            raise KeyError(plain[0])
        return {}
    parameters: dict[str, Any] = {form.leading: form.kind(plain[0])}
    if len(plain) > 2:
        raise KeyError(plain[2])
    return parameters | dict(form.words[plain[1]]) if len(plain) == 2 else parameters


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

"""Which part and which channels of an OpenEXR file are the picture."""

from dataclasses import dataclass, field

from burnish.images.exr_parts import UINT, ExrPart
from burnish.images.files import file_error

# What renderers call the finished picture, where a part has several layers of colour.
_BEAUTY = ("beauty", "combined", "rgba", "rgb", "color", "colour", "image", "c")
_MOST_NAMES = 8


@dataclass
class ExrChoice:
    """One picture of a file."""

    index: int
    """Of its part."""
    layer: str
    """Text before the last dot of its channels; empty: they have none."""
    color: tuple[str, str, str]
    """Channels of red, green, blue, or of X, Y, Z; an empty name is a channel that is missing."""
    alpha: str = ""
    is_xyz: bool = False
    notes: list[str] = field(default_factory=list)
    ignored: list[str] = field(default_factory=list)


def _layers(part: ExrPart) -> dict[str, set[str]]:
    """Components by layer: text after the last dot by the text before it."""
    layers: dict[str, set[str]] = {}
    for channel in part.channels:
        layer, _, component = channel.name.rpartition(".")
        layers.setdefault(layer, set()).add(component)
    return layers


def _is_color(components: set[str], layer: str) -> bool:
    return bool({"R", "G", "B"} & components) or (not layer and "Y" in components)


def _default_layer(part: ExrPart) -> str | None:
    """The layer without a name if it is a picture, or the only coloured one, or the one named so."""
    layers = _layers(part)
    colored = [layer for layer, components in layers.items() if _is_color(components, layer)]
    if "" in colored or len(colored) == 1:
        return "" if "" in colored else colored[0]
    beauty = [layer for layer in colored if layer.rpartition(".")[2].lower() in _BEAUTY]
    return beauty[0] if len(beauty) == 1 else None


def _rank(part: ExrPart) -> int:
    """How much a part is a picture; the least is taken."""
    layer, layers = _default_layer(part), _layers(part)
    if part.is_deep:
        return 6
    if layer is None:  # several layers of colour may still be asked for by name
        return 4 if any(_is_color(components, name) for name, components in layers.items()) else 5
    if {"R", "G", "B"} <= layers[layer]:
        return 0 if not layer else 1
    return 3 if {"RY", "BY"} & layers[layer] else 2


def _listed(names: list[str]) -> str:
    shown = ", ".join(names[:_MOST_NAMES])
    return shown + (f" and {len(names) - _MOST_NAMES} more" if len(names) > _MOST_NAMES else "")


def _describe(index: int, part: ExrPart) -> str:
    name = f" '{part.name}'" if part.name else ""
    view = f", view '{part.view}'" if part.view else ""
    channels = "deep" if part.is_deep else _listed([channel.name for channel in part.channels])
    return f"{index}{name}{view} ({channels})"


def _find_part(parts: list[ExrPart], key: str | int) -> int:
    """Index of the part of that name, view or number."""
    for names in ([part.name for part in parts], [part.view for part in parts]):
        if isinstance(key, str) and key and key in names:
            return names.index(key)
    number = int(key) if isinstance(key, int) or key.isdecimal() else -1
    if 0 <= number < len(parts):
        return number
    shown = ", ".join(_describe(i, part) for i, part in enumerate(parts))
    raise ValueError(f"part: expected one of {shown}, got {key!r}")


def _choose_part(parts: list[ExrPart], key: str | int | None, layer: str | None) -> int:
    if key is not None:
        return _find_part(parts, key)
    if layer is not None:
        holding = [i for i, part in enumerate(parts) if not part.is_deep and layer in _layers(part)]
        colored = [i for i in holding if _is_color(_layers(parts[i])[layer], layer)]
        if colored or holding:
            return (colored or holding)[0]
    return min(range(len(parts)), key=lambda i: _rank(parts[i]))


def _choose_layer(path: str, part: ExrPart, layer: str | None, where: str) -> str:
    layers = _layers(part)
    if layer is not None:
        if layer not in layers:
            raise ValueError(
                f"layer: expected one of {_listed(sorted(map(repr, layers)))}{where}, got {layer!r}"
            )
        return layer
    default = _default_layer(part)
    if default is not None:
        return default
    colored = sorted(layer for layer, components in layers.items() if _is_color(components, layer))
    names = _listed([channel.name for channel in part.channels])
    if colored:
        raise file_error(
            path,
            f"expected one layer of colour, or the argument layer to say which{where}: {_listed(colored)}",
        )
    raise file_error(path, f"expected channels R, G, B or Y, or one layer of them, got {names}{where}")


def _channels(path: str, part: ExrPart, layer: str, where: str) -> ExrChoice:
    components = _layers(part)[layer]
    prefix = layer + "." if layer else ""
    choice = ExrChoice(0, layer, ("", "", ""), prefix + "A" if "A" in components else "")
    if {"RY", "BY"} & components:
        raise file_error(
            path,
            f"expected RGB or Y, got luminance-chroma channels (Y, RY, BY){where}; convert the file to RGB",
        )
    if {"R", "G", "B"} & components:
        red, green, blue = (prefix + c if c in components else "" for c in "RGB")
        choice.color = (red, green, blue)
        missing = [c for c in "RGB" if c not in components]
        if missing:
            choice.ignored.append(f"channels {', '.join(missing)} are missing and read as 0.")
    elif not layer and {"X", "Y", "Z"} <= components:
        choice.color, choice.is_xyz = ("X", "Y", "Z"), True
        choice.notes.append("channels X, Y, Z are read as CIE XYZ and turned into linear Rec. 709.")
    elif "Y" in components:
        choice.color = (prefix + "Y",) * 3
        choice.notes.append("luminance Y alone is read as grey.")
    else:
        names = _listed(sorted(components))
        raise file_error(path, f"expected channels R, G, B or Y in layer '{layer}', got {names}{where}")
    return choice


def _require_samples(path: str, part: ExrPart, choice: ExrChoice) -> None:
    for channel in part.channels:
        if channel.name in (*choice.color, choice.alpha):
            if channel.sampling != (1, 1):
                raise file_error(
                    path, f"channel {channel.name}: expected sampling 1, 1, got {channel.sampling}"
                )
            if channel.sample_type == UINT:
                choice.notes.append(f"channel {channel.name} holds integers, read as the numbers they are.")


def choose_picture(
    path: str, parts: list[ExrPart], part: str | int | None = None, layer: str | None = None
) -> ExrChoice:
    """Find the picture of a file: what was asked for, or the part and layer that is one.

    Of several parts the first flat one with channels R, G, B is taken, else the first with one layer of
    colour, else one with fewer colours or luminance. What is left out is named in the notes.

    Parameters
    ----------
    path : str
        For messages.
    parts : list of ExrPart
        All of them.
    part : str, int or None
        Name or index.
    layer : str or None
        Text before the last dot of its channels' names; empty for channels without one.

    Raises
    ------
    FileError
        If no part is a picture, or several layers may be.
    ValueError
        If there is no such part or layer.
    """
    index = _choose_part(parts, part, layer)
    chosen = parts[index]
    is_single = len(parts) == 1
    where = "" if is_single else f" in part {_describe(index, chosen)}"
    if chosen.is_deep:
        others = "" if is_single else f"; parts are {', '.join(_describe(i, p) for i, p in enumerate(parts))}"
        raise file_error(
            path, f"expected a flat picture, got deep data (many samples per pixel){where}{others}"
        )
    choice = _channels(path, chosen, _choose_layer(path, chosen, layer, where), where)
    choice.index = index
    _require_samples(path, chosen, choice)
    if not is_single:
        others = ", ".join(_describe(i, p) for i, p in enumerate(parts) if i != index)
        choice.notes.append(f"part {_describe(index, chosen)} is read, left out are parts {others}.")
    left = [c.name for c in chosen.channels if c.name not in (*choice.color, choice.alpha)]
    if left:
        what = f"layer '{choice.layer}' is" if choice.layer else "R, G, B, A are"
        choice.notes.append(f"{what} read, channels left out are {_listed(left)}.")
    if chosen.views:
        # Channels of the first view have no layer.
        view = choice.layer or chosen.views[0]
        choice.notes.append(f"of the views {_listed(chosen.views)} '{view}' is read.")
    return choice

"""Every public name says what it is, and every parameter is mentioned."""

import dataclasses
import inspect
import operator
import re

import pytest

import burnish

DATA = {"__version__"}
DIRECT_BASES = {"FileError", "VulkanError"}


def members(owner):
    """Public methods and properties that a class defines itself; the default of a field is neither."""
    fields = {field.name for field in dataclasses.fields(owner)} if dataclasses.is_dataclass(owner) else set()
    return {
        name: value for name, value in vars(owner).items() if not name.startswith("_") and name not in fields
    }


def public_things():
    """(dotted name, object, docstring that must cover its parameters)."""
    names = [name for name in burnish.__all__ if name not in DATA]
    for name in [*names, *(f"study.{name}" for name in burnish.study.__all__)]:
        thing = operator.attrgetter(name)(burnish)
        yield name, thing
        if inspect.isclass(thing):
            for member, value in members(thing).items():
                yield f"{name}.{member}", value


THINGS = dict(public_things())


def unwrapped(thing):
    return thing.__func__ if isinstance(thing, staticmethod | classmethod) else thing


def parameters_of(thing):
    """Names of parameters: by the signature, or by the first line that pybind11 writes into docstrings."""
    thing = unwrapped(thing)
    if inspect.isfunction(thing):
        return [name for name in inspect.signature(thing).parameters if name not in ("self", "cls")]
    first_line = (inspect.getdoc(thing) or "").splitlines()[:1]
    match = re.match(r"\w+\((.*)\) -> ", first_line[0]) if first_line else None
    if match is None:
        return []
    names = re.findall(r"(?:^|, )(\w+): ", re.sub(r"\[[^][]*(\[[^][]*\][^][]*)*\]", "", match[1]))
    return [name for name in names if name != "self"]


def constructor_of(thing):
    """__init__ of a class, where it takes more than nothing."""
    return thing.__init__ if inspect.isclass(thing) and not issubclass(thing, BaseException) else None


def prose(thing):
    """The docstring without the signature line of pybind11."""
    text = inspect.getdoc(unwrapped(thing)) or ""
    lines = text.splitlines()
    if lines and re.match(r"\w+\(.*\) -> ", lines[0]):
        lines = lines[1:]
    return "\n".join(lines).strip()


@pytest.mark.parametrize("name", THINGS)
def test_a_public_name_has_a_docstring(name):
    assert prose(THINGS[name]), f"burnish.{name} has no docstring"


@pytest.mark.parametrize("name", [n for n, t in THINGS.items() if parameters_of(t) or constructor_of(t)])
def test_every_parameter_is_mentioned(name):
    thing = THINGS[name]
    text = prose(thing)
    parameters = parameters_of(thing)
    constructor = constructor_of(thing)
    if constructor is not None:
        parameters = parameters_of(constructor)
        text += prose(constructor)
    missing = [p for p in parameters if not re.search(rf"\b{p}\b", text)]
    assert not missing, f"burnish.{name} does not mention: {', '.join(missing)}"


def test_parameters_are_found_where_there_are_some():
    assert parameters_of(burnish.render)[:3] == ["scene", "camera", "size"]
    assert parameters_of(burnish.Environment.from_faces)[0] == "faces"
    assert "roughness" in parameters_of(burnish.KurtLobe.__init__)

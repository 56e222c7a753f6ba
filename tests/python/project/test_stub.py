"""The stub of the extension names what the extension has, class by class."""

import ast
from pathlib import Path

from burnish import _core

REPOSITORY = Path(__file__).resolve().parents[3]
# The first names all that the extension has, and takes what stands in the others from there.
STUBS = ("_core", "_devices", "_lights", "_lobes", "_samplers", "_texels", "_timings")
# pybind11 gives every class these; the stub says nothing about them.
IGNORED = {"__init__", "__repr__", "__str__", "__module__", "__doc__"}


def names_in_stub(body):
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            yield node.target.id
        elif isinstance(node, ast.ImportFrom) and node.module in {f"burnish.{name}" for name in STUBS}:
            yield from (alias.asname for alias in node.names if alias.asname == alias.name)


def public(names):
    return {name for name in names if not name.startswith("_")} - IGNORED


def test_stub_and_extension_agree():
    tree, *others = (
        ast.parse((REPOSITORY / "python/burnish" / f"{name}.pyi").read_text(encoding="utf-8"))
        for name in STUBS
    )
    assert public(names_in_stub(tree.body)) == public(vars(_core))
    for other in others:
        assert public(names_in_stub(other.body)) <= public(names_in_stub(tree.body))
    for node in [node for stub in (tree, *others) for node in stub.body]:
        if isinstance(node, ast.ClassDef):
            assert public(names_in_stub(node.body)) == public(vars(getattr(_core, node.name))), node.name

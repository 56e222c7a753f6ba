"""The stub of the extension names what the extension has, class by class."""

import ast
from pathlib import Path

from burnish import _core

REPOSITORY = Path(__file__).resolve().parents[3]
# pybind11 gives every class these; the stub says nothing about them.
IGNORED = {"__init__", "__repr__", "__str__", "__module__", "__doc__"}


def names_in_stub(body):
    for node in body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            yield node.target.id


def public(names):
    return {name for name in names if not name.startswith("_")} - IGNORED


def test_stub_and_extension_agree():
    tree = ast.parse((REPOSITORY / "python/burnish/_core.pyi").read_text())
    assert public(names_in_stub(tree.body)) == public(vars(_core))
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            assert public(names_in_stub(node.body)) == public(vars(getattr(_core, node.name))), node.name

"""A module imports from its own layer and those below, inside functions and for types, too."""

import ast
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[3] / "python" / "burnish"
EXTENSION = {"_core", "_lobes", "_samplers", "_texels", "_timings"}
# From the bottom; names are modules or packages, and the longest that fits counts.
LAYERS = (
    (*sorted(EXTENSION), "_extension", "_progress", "_version", "cube_layout", "filters"),
    ("oracle", "images", "_device"),
    ("samplers", "lobes", "environments", "environment_io", "report", "frame"),
    ("builtin", "rendering"),
    ("scenes", "_methods", "study"),
    ("advice",),
    ("render",),
    ("hardcases", "tables", "advice.calibration"),
    ("doctor",),
    ("",),  # the package itself: its public names
    ("demo", "cli", "__main__"),
)


def module_name(path):
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@pytest.fixture(scope="module")
def modules():
    return {module_name(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def imports_of(path, name, known):
    """Names of the package's modules that a file imports anywhere."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = node.module or ""
            if node.level:
                parts = package.split(".") if package else []
                kept = parts[: len(parts) - node.level + 1]
                base = ".".join(["burnish", *kept, *([node.module] if node.module else [])])
            found |= {f"{base}.{alias.name}" for alias in node.names}
    targets = set()
    for one in found:
        if one.split(".")[0] != "burnish":
            continue
        target = one.removeprefix("burnish").removeprefix(".")
        while target and target not in known and target not in EXTENSION:
            target = target.rpartition(".")[0]
        targets.add(target)
    return targets - {name}


@pytest.fixture(scope="module")
def imports(modules):
    return {name: imports_of(path, name, modules) for name, path in modules.items()}


def layer_of(name):
    best = max(
        ((len(one), i) for i, layer in enumerate(LAYERS) for one in layer if is_within(name, one)),
        default=None,
    )
    return None if best is None else best[1]


def is_within(name, owner):
    return name == owner or (owner != "" and name.startswith(f"{owner}."))


def test_every_module_has_a_layer(modules):
    assert [name for name in modules if layer_of(name) is None] == []


def test_modules_import_from_their_layer_and_below(imports):
    wrong = [
        f"{name} imports {target}"
        for name, targets in imports.items()
        for target in sorted(targets)
        if layer_of(target) > layer_of(name)
    ]
    assert wrong == []


def test_modules_do_not_import_each_other_in_circles(imports):
    reached = {}

    def below(name, path):
        assert name not in path, " -> ".join([*path[path.index(name) :], name])
        if name not in reached:
            reached[name] = True
            for target in sorted(imports.get(name, ())):
                below(target, [*path, name])

    # A name is searched once its whole subtree is: a circle is met on the way.
    for name in imports:
        below(name, [])


def test_the_oracle_imports_nothing_of_the_engine(imports):
    for name, targets in imports.items():
        if name.split(".")[0] == "oracle":
            assert {t.split(".")[0] for t in targets} <= {"oracle"}, name

"""Arrows between the modules of the package, those within functions too: one way, and between folders only where they are drawn."""

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "python/freebody"
CORE = {"core", "symbolic", "formats"}
SOLVED = CORE | {"model", "solve", "run", "impact"}
MAY_USE = {
    "core": set(),
    "symbolic": set(),
    "document": {"symbolic", "formats"},
    "model": CORE,
    "solve": CORE | {"model"},
    "impact": CORE | {"model", "solve"},
    "run": CORE | {"model", "solve", "impact"},
    "find": SOLVED | {"stability"},
    "stability": SOLVED,
    "periodic": SOLVED | {"document", "equations", "find"},
    "inverse": SOLVED,
    "views": SOLVED | {"document", "stability"},
    "codegen": CORE | {"model", "solve", "document"},
    "equations": SOLVED | {"document", "codegen", "stability"},
    "check": SOLVED | {"equations", "stability"},
    "catalogue": SOLVED | {"document", "equations", "check", "mechanism"},
    "site": SOLVED | {"document", "check", "views", "catalogue", "mechanism"},
    "cli": SOLVED
    | {
        "site",
        "document",
        "codegen",
        "equations",
        "check",
        "find",
        "stability",
        "periodic",
        "inverse",
        "views",
        "catalogue",
        "mechanism",
    },
}
"""What a folder may use; of those not named here, only that there are no circles of modules."""


def modules() -> dict[str, Path]:
    """The modules by their names within the package."""
    files = (file for file in PACKAGE.rglob("*.py") if "systems" not in file.relative_to(PACKAGE).parts)
    return {".".join(file.relative_to(PACKAGE).with_suffix("").parts).removesuffix(".__init__"): file for file in files}


def imported(module: str, file: Path, known: dict[str, Path]) -> set[str]:
    """The modules of the package that a module imports, but for types only."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    branches = [node for node in ast.walk(tree) if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)]
    typing = {id(inner) for branch in branches for inner in ast.walk(branch)}
    own = module.split(".") if file.stem == "__init__" else module.split(".")[:-1]
    found = set()
    for node in ast.walk(tree):
        if not isinstance(node, ast.ImportFrom) or id(node) in typing:
            continue
        above = ["freebody", *own[: len(own) - node.level + 1]] if node.level else []
        path = [*above, *(node.module or "").split(".")] if node.module else above
        if path[0] == "freebody":
            start = ".".join(path[1:])
            names = [f"{start}.{alias.name}".lstrip(".") for alias in node.names]
            found |= {name if name in known else start for name in names}
    return (found & known.keys()) - {module}


MODULES = modules()
ARROWS = {module: imported(module, file, MODULES) for module, file in MODULES.items()}


def test_there_are_no_circles():
    assert len(list(TopologicalSorter(ARROWS).static_order())) == len(MODULES)  # raises CycleError, which names the circle


@pytest.mark.parametrize("folder", MAY_USE)
def test_a_folder_uses_only_what_is_below_it(folder):
    used = {(module, to) for module, tos in ARROWS.items() for to in tos if module.split(".")[0] == folder}
    assert {(module, to) for module, to in used if to.split(".")[0] not in MAY_USE[folder] | {folder, "__init__"}} == set()

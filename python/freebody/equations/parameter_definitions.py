"""Parameters that a model defines by others, as trees of those: h = w tan α/3."""

from __future__ import annotations

from collections.abc import Collection

from freebody.core import CompiledModel
from freebody.equations.language import NoForm, read_text
from freebody.symbolic.tree import PI, Sym, Tree, symbols
from freebody.symbolic.tree import replace as replaced


def definitions(source: CompiledModel, free: Collection[str]) -> dict[str, Tree]:
    """Every parameter that is defined by others, by those that are not or are ``free``; one without a symbolic form, as a least
    of two, stays a letter."""
    found: dict[str, Tree] = {}
    for parameter in source.spec["parameters"]:
        name, value = parameter["name"], parameter["value"]
        if name in free or not isinstance(value, str):
            continue
        try:
            tree = replaced(read_text(value), {Sym(x): known for x, known in found.items()})
        except NoForm:
            continue
        if symbols(tree) - {Sym(PI)}:
            found[name] = tree
    return found

"""Parameters that a model defines by others, as trees of those: h = w tan α/3."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Mapping
from typing import Any

from freebody.equations.measured import exact
from freebody.equations.tree import PI, Fn, Num, Sym, Tree, add, minus, mul, negative, over, power
from freebody.equations.tree import replace as replaced
from freebody.equations.tree import symbols
from freebody.model import syntax
from freebody.source import Source

_SAME = ("sin", "cos", "exp", "ln", "atan2")


class _NoForm(ValueError):
    """An expression that has no form in letters."""


def definitions(source: Source, free: Collection[str]) -> dict[str, Tree]:
    """Every parameter that is defined by others, by those that are not or are ``free``; one without a form in letters, as a least
    of two, stays a letter."""
    found: dict[str, Tree] = {}
    for parameter in json.loads(source.spec)["parameters"]:
        name, value = parameter["name"], parameter["value"]
        if name in free or not isinstance(value, str):
            continue
        try:
            tree = replaced(_tree(syntax.parse(value).tree), {Sym(x): known for x, known in found.items()})
        except _NoForm:
            continue
        if symbols(tree) - {Sym(PI)}:
            found[name] = tree
    return found


def _tree(of: Mapping[str, Any]) -> Tree:
    match of:
        case {"number": value}:
            return exact(float(value))
        case {"name": name}:
            return Sym(name)
        case {"negate": inner}:
            return negative(_tree(inner))
        case {"call": ["sqrt", [inner]]}:
            return power(_tree(inner), "1/2")
        case {"call": ["hypot", sides]}:
            return power(add(*(power(_tree(side), 2) for side in sides)), "1/2")
        case {"call": ["tan", [angle]]}:
            return over(Fn("sin", (_tree(angle),)), Fn("cos", (_tree(angle),)))
        case {"call": [name, arguments]} if name in _SAME:
            return Fn(name, tuple(map(_tree, arguments)))
        case {"chain": [first, rest]}:
            total = _tree(first)
            for operator, part in rest:
                total = _joined(operator, total, _tree(part))
            return total
    raise _NoForm


def _joined(operator: str, left: Tree, right: Tree) -> Tree:
    if operator == "^" and isinstance(right, Num):
        return power(left, right.value)
    if operator not in _OPERATORS:
        raise _NoForm
    return _OPERATORS[operator](left, right)


_OPERATORS: Mapping[str, Callable[[Tree, Tree], Tree]] = {"+": add, "-": minus, "*": mul, "/": over}

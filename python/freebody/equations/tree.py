"""Expressions in letters, as trees: read from JSON, evaluated with NumPy."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np

FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "exp": np.exp, "ln": np.log,
    "atan2": np.arctan2, "abs": np.abs, "sign": np.sign,
}  # fmt: skip
"""What the names of functions mean; any other name is a table of the model."""
PI = "pi"
"""The one letter whose value is known."""


@dataclass(frozen=True, slots=True)
class Num:
    """A number, exact (``Fraction``) or measured (``float``)."""

    value: Fraction | float


@dataclass(frozen=True, slots=True)
class Sym:
    """A letter, differentiated ``dots`` times with respect to time (0, 1 or 2)."""

    name: str
    dots: int = 0


@dataclass(frozen=True, slots=True)
class Add:
    """A sum."""

    terms: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Mul:
    """A product."""

    factors: tuple[Tree, ...]


@dataclass(frozen=True, slots=True)
class Pow:
    """A power with a rational exponent: −1 divides, 1/2 is the square root."""

    base: Tree
    exponent: Fraction


@dataclass(frozen=True, slots=True)
class Fn:
    """A function: sin, cos, tan, exp, ln, atan2, abs, sign, or a table of the model by its name."""

    name: str
    args: tuple[Tree, ...]


Tree: TypeAlias = Num | Sym | Add | Mul | Pow | Fn
ZERO, ONE, MINUS_ONE = Num(Fraction(0)), Num(Fraction(1)), Num(Fraction(-1))


def number(value: str | float | Fraction) -> Num:
    """A number as a leaf: texts, whole numbers and fractions are exact, ``"3/2"``; floats are measured."""
    return Num(value if isinstance(value, float) else Fraction(value))


def add(*terms: Tree) -> Tree:
    """The sum, flat, without zeros; not collected."""
    flat = [inner for term in terms for inner in (term.terms if isinstance(term, Add) else (term,))]
    kept = tuple(term for term in flat if not _is(term, 0))
    return Add(kept) if len(kept) > 1 else kept[0] if kept else ZERO


def mul(*factors: Tree) -> Tree:
    """The product, flat, with one exact number in front; 1 is left out, 0 is all."""
    flat = [inner for factor in factors for inner in (factor.factors if isinstance(factor, Mul) else (factor,))]
    exact = math.prod((f.value for f in flat if isinstance(f, Num) and isinstance(f.value, Fraction)), start=Fraction(1))
    rest = [f for f in flat if not (isinstance(f, Num) and isinstance(f.value, Fraction))]
    if exact == 0:
        return ZERO
    kept = tuple(([] if exact == 1 else [Num(exact)]) + rest)
    return Mul(kept) if len(kept) > 1 else kept[0] if kept else ONE


def power(base: Tree, exponent: int | str | Fraction) -> Tree:
    """The power; exponent 1 gives the base."""
    exponent = Fraction(exponent)
    return base if exponent == 1 else ONE if exponent == 0 else Pow(base, exponent)


def negative(tree: Tree) -> Tree:
    """−tree, term by term for a sum."""
    return Add(tuple(mul(MINUS_ONE, term) for term in tree.terms)) if isinstance(tree, Add) else mul(MINUS_ONE, tree)


def minus(left: Tree, right: Tree) -> Tree:
    """left − right."""
    return add(left, negative(right))


def over(above: Tree, below: Tree) -> Tree:
    """above / below."""
    return mul(above, power(below, -1))


def is_zero(tree: Tree) -> bool:
    """Whether the tree is the number 0 (not: whether it is identically zero)."""
    return _is(tree, 0)


def is_negative(term: Tree) -> bool:
    """Whether a term has a minus sign: a number below 0 is its first factor."""
    first = term.factors[0] if isinstance(term, Mul) else term
    return isinstance(first, Num) and first.value < 0


def children(tree: Tree) -> tuple[Tree, ...]:
    """The trees directly below."""
    match tree:
        case Add(parts) | Mul(parts) | Fn(_, parts):
            return parts
        case Pow(base, _):
            return (base,)
        case _:
            return ()


def walk(tree: Tree) -> Iterator[Tree]:
    """The tree and everything below it."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        waiting.extend(reversed(children(node)))


def operations(tree: Tree) -> int:
    """How many sums, products, powers and functions an expression has."""
    return sum(max(1, len(children(node)) - 1) for node in walk(tree) if children(node))


def symbols(*trees: Tree) -> set[Sym]:
    """All letters that occur, rates and accelerations for themselves."""
    found, seen, waiting = set(), set(), list(trees)
    while waiting:
        node = waiting.pop()
        if isinstance(node, Sym):
            found.add(node)
        elif id(node) not in seen:  # a part may be shared by many
            seen.add(id(node))
            waiting.extend(children(node))
    return found


def replace(tree: Tree, new: Mapping[Sym, Tree]) -> Tree:
    """The tree with letters replaced."""
    match tree:
        case Sym():
            return new.get(tree, tree)
        case Num():
            return tree
        case Add(terms):
            return add(*(replace(term, new) for term in terms))
        case Mul(factors):
            return mul(*(replace(factor, new) for factor in factors))
        case Pow(base, exponent):
            return Pow(replace(base, new), exponent)
        case Fn(name, args):
            return Fn(name, tuple(replace(arg, new) for arg in args))


def rebuilt(tree: Tree, put: Callable[[Tree], Tree | None]) -> Tree:
    """The tree with every part for which ``put`` has another exchanged for that, from above."""
    new = put(tree)
    if new is not None:
        return new
    match tree:
        case Add(terms):
            return add(*(rebuilt(term, put) for term in terms))
        case Mul(factors):
            return mul(*(rebuilt(factor, put) for factor in factors))
        case Pow(base, exponent):
            return power(rebuilt(base, put), exponent)
        case Fn(name, args):
            return Fn(name, tuple(rebuilt(arg, put) for arg in args))
    return tree


def evaluate(tree: Tree, values: Mapping[Sym, Any], tables: Mapping[str, Callable[..., Any]] | None = None) -> Any:
    """The value of the tree: a number, or an array if the values are arrays (they are broadcast).

    ``tables`` has the tables of the model by name. A letter or a table without a value is a ``KeyError`` that names it."""
    match tree:
        case Num(value):
            return float(value)
        case Sym():
            return _value(tree, values)
        case Add(terms):
            return sum(evaluate(term, values, tables) for term in terms)
        case Mul(factors):
            return math.prod(evaluate(factor, values, tables) for factor in factors)
        case Pow(base, exponent):
            return raised(evaluate(base, values, tables), exponent)
        case Fn(name, args):
            function = FUNCTIONS.get(name) or (tables or {}).get(name)
            if function is None:
                raise KeyError(f"no table {name!r} is given; pass it in `tables`")
            return function(*(evaluate(arg, values, tables) for arg in args))


def raised(base: Any, exponent: Fraction) -> Any:
    """base to the power of a fraction, roots and reciprocals by their own operations."""
    if exponent == -1:
        return 1.0 / base
    if exponent == Fraction(1, 2):
        return np.sqrt(base)
    return np.power(np.asarray(base, dtype=float), float(exponent))[()]


def read(data: Mapping[str, Any]) -> Tree:
    """A tree from JSON: ``{"add": [{"sym": "x", "dots": 2}, {"num": "3/2"}]}``."""
    match data:
        case {"num": value}:
            return number(value)
        case {"sym": name, **rest}:
            return Sym(name, rest.get("dots", 0))
        case {"add": terms}:
            return Add(tuple(map(read, terms)))
        case {"mul": factors}:
            return Mul(tuple(map(read, factors)))
        case {"pow": [base, exponent]}:
            return Pow(read(base), Fraction(exponent))
        case {"fn": name, "args": args}:
            return Fn(name, tuple(map(read, args)))
    raise ValueError(f"not an expression: {data!r}; expected one of num, sym, add, mul, pow, fn")


def write(tree: Tree) -> dict[str, Any]:
    """The tree as JSON data, such that ``read(write(tree)) == tree``."""
    match tree:
        case Num(value):
            return {"num": str(value) if isinstance(value, Fraction) else value}
        case Sym(name, dots):
            return {"sym": name, "dots": dots}
        case Add(terms):
            return {"add": [write(term) for term in terms]}
        case Mul(factors):
            return {"mul": [write(factor) for factor in factors]}
        case Pow(base, exponent):
            return {"pow": [write(base), str(exponent)]}
        case Fn(name, args):
            return {"fn": name, "args": [write(arg) for arg in args]}


def _is(tree: Tree, value: int) -> bool:
    return isinstance(tree, Num) and tree.value == value


def _value(letter: Sym, values: Mapping[Sym, Any]) -> Any:
    if letter in values:
        return values[letter]
    if letter == Sym(PI):
        return math.pi
    raise KeyError(f"no value for {letter.name!r} differentiated {letter.dots} times")


Entries: TypeAlias = Tree | Sequence["Entries"]
"""A tree, a vector of trees, a matrix of trees (rows)."""

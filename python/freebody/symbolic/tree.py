"""Expressions as trees. What is computed with is made of ``Num``, ``Sym``, ``Add``, ``Mul``, ``Pow`` and ``Fn``; what a person wrote
has quotients, signs, units, vectors and matrices besides, and every node knows its place in the text."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields
from dataclasses import replace as _with
from fractions import Fraction
from functools import cache, cached_property, lru_cache
from typing import Any, TypeAlias, TypeVar

Span = tuple[int, int]
"""Start and end in a text, in characters."""
PI = "pi"
"""The one symbol whose value is known."""


@dataclass(frozen=True)
class Node:
    """A piece of an expression; ``span`` is its place in the text that it was read from, which does not count in comparisons."""

    span: Span = field(default=(0, 0), compare=False, kw_only=True, repr=False)

    @cached_property
    def symbols(self) -> frozenset[Sym]:
        """All symbols that occur in it; kept, since a part may be shared by many."""
        return frozenset().union(*(child.symbols for child in children(self)))


@dataclass(frozen=True)
class Num(Node):
    """A number, exact (``Fraction``) or measured (``float``); the digits as written, where it was read from a text."""

    value: Fraction | float
    text: str = field(default="", compare=False, repr=False)


@dataclass(frozen=True)
class Sym(Node):
    """A symbol, differentiated ``dots`` times with respect to time."""

    name: str
    dots: int = 0

    @property
    def key(self) -> str:
        """In one word: ``theta``, ``thetadot``, ``thetaddot``."""
        return self.name + ("d" * (self.dots - 1) + "dot" if self.dots else "")

    @cached_property
    def symbols(self) -> frozenset[Sym]:
        """Itself."""
        return frozenset((self,))


@dataclass(frozen=True)
class Add(Node):
    """A sum; what is taken away is a ``Negative``, or has a negative number in front."""

    terms: tuple[Node, ...]


@dataclass(frozen=True)
class Mul(Node):
    """A product, from left to right."""

    factors: tuple[Node, ...]


@dataclass(frozen=True)
class Pow(Node):
    """A power. A rational exponent is a ``Fraction``: −1 divides, 1/2 is the square root; a written one is a node."""

    base: Node
    exponent: Fraction | Node


@dataclass(frozen=True)
class Fn(Node):
    """A function of numbers: sin, cos, tan, exp, ln, atan2, abs, sign, …, or a table of the model by its name."""

    name: str
    args: tuple[Node, ...]


@dataclass(frozen=True)
class Negative(Node):
    """The opposite."""

    of: Node


@dataclass(frozen=True)
class Quotient(Node):
    """Top over bottom."""

    top: Node
    bottom: Node


@dataclass(frozen=True)
class Unit(Node):
    """A unit behind a number or a bracket, as a factor: its size in SI."""

    size: float
    text: str


@dataclass(frozen=True)
class Cross(Node):
    """The sign ×: the cross product of vectors; between numbers, times."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Dot(Node):
    """The sign ·: the scalar product of vectors; otherwise, times."""

    left: Node
    right: Node


@dataclass(frozen=True)
class Column(Node):
    """A column of numbers, written (a, b)."""

    items: tuple[Node, ...]


@dataclass(frozen=True)
class Matrix(Node):
    """Rows of numbers, written [a, b; c, d]."""

    rows: tuple[tuple[Node, ...], ...]


Tree: TypeAlias = Num | Sym | Add | Mul | Pow | Fn
N = TypeVar("N", bound=Node)
ZERO, ONE, MINUS_ONE = Num(Fraction(0)), Num(Fraction(1)), Num(Fraction(-1))


def number(value: str | float | Fraction) -> Num:
    """A number as a leaf: texts, whole numbers and fractions are exact, ``"3/2"``; floats are measured."""
    return Num(value if isinstance(value, float) else Fraction(value))


def add(*terms: Tree) -> Tree:
    """The sum, flat, without zeros; not collected."""
    flat = [inner for term in terms for inner in (term.terms if isinstance(term, Add) else (term,))]
    kept = tuple(term for term in flat if not is_zero(term))
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
    return add(*(mul(MINUS_ONE, term) for term in tree.terms)) if isinstance(tree, Add) else mul(MINUS_ONE, tree)


def unsigned(node: Node) -> Node:
    """What a minus stands before; else the node itself."""
    return node.of if isinstance(node, Negative) else node


def minus(left: Tree, right: Tree) -> Tree:
    """left − right."""
    return add(left, negative(right))


def over(above: Tree, below: Tree) -> Tree:
    """above / below."""
    return mul(above, power(below, -1))


def is_zero(tree: Tree) -> bool:
    """Whether the tree is the number 0 (not: whether it is identically zero)."""
    return isinstance(tree, Num) and tree.value == 0


def is_negative(term: Tree) -> bool:
    """Whether a term has a minus sign: a number below 0 is its first factor."""
    first = term.factors[0] if isinstance(term, Mul) else term
    return isinstance(first, Num) and first.value < 0


def children(tree: Node) -> tuple[Node, ...]:
    """The nodes directly below, in the order of the text."""
    match tree:
        case Add(parts) | Mul(parts) | Fn(_, parts):
            return parts
        case Num() | Sym():
            return ()
        case Pow(base, Fraction()):
            return (base,)
    return tuple(_nodes([getattr(tree, name) for name in _names(type(tree))]))


@cache
def _names(kind: type[Node]) -> tuple[str, ...]:
    """The fields in which nodes can stand."""
    return tuple(f.name for f in fields(kind) if f.name not in ("span", "text"))


def _nodes(values: object) -> Iterator[Node]:
    if isinstance(values, Node):
        yield values
    elif isinstance(values, tuple | list):
        for value in values:
            yield from _nodes(value)


def walk(tree: Node) -> Iterator[Node]:
    """The node and everything below it, outer ones first."""
    waiting = [tree]
    while waiting:
        node = waiting.pop()
        yield node
        waiting.extend(reversed(children(node)))


def exchange(tree: N, old: Node, new: Node) -> N:
    """The same with ``new`` in the place of ``old``: that very node, not others that read alike. Rows of nodes are tuples."""
    if tree is old:
        return new  # type: ignore[return-value]
    if isinstance(tree, tuple):
        after = tuple(exchange(part, old, new) for part in tree)
        return after if any(x is not y for x, y in zip(after, tree, strict=True)) else tree
    values = {name: getattr(tree, name) for name in _names(type(tree))} if isinstance(tree, Node) else {}
    changed = {name: after for name, value in values.items() if (after := exchange(value, old, new)) is not value}
    return _with(tree, **changed) if changed else tree


def substitute(tree: N, expressions: Mapping[Sym, Node]) -> N:
    """The same with an expression in the place of each of these symbols, otherwise as it was written."""
    found = [n for n in walk(tree) if isinstance(n, Sym) and n in expressions]
    for symbol in found:
        tree = exchange(tree, symbol, expressions[symbol])
    return tree


def addends(node: Node, expand: bool = False) -> list[tuple[int, Node]]:
    """The signed terms of a sum, those of sums in it among them, zeros left out; ``expand`` multiplies brackets out."""
    match node:
        case Num(value=0):
            return []
        case Add(terms=inside):
            return [found for term in inside for found in addends(term, expand)]
        case Negative(of=of):
            return [(-sign, term) for sign, term in addends(of, expand)]
        case Quotient(top=top, bottom=bottom) if expand:
            return [(sign, Quotient(term, bottom, span=term.span)) for sign, term in addends(top, expand)]
        case Cross(left=a, right=b) | Dot(left=a, right=b) if expand:
            return [(s * r, type(node)(x, y, span=node.span)) for s, x in addends(a, expand) for r, y in addends(b, expand)]
        case Mul(factors=factors) if expand:
            out: list[tuple[int, tuple[Node, ...]]] = [(1, ())]
            for factor in factors:
                out = [(s * r, (*done, term)) for s, done in out for r, term in addends(factor, expand)]
            return [(sign, Mul(done, span=node.span)) for sign, done in out]
    return [(1, node)]


def canonical(
    tree: Node, leaf: Callable[[Any], Tree] = lambda leaf: leaf, function: Callable[[str, tuple[Tree, ...]], Tree] = Fn
) -> Tree:
    """What a person wrote in numbers, sums, products and rational powers; vectors, matrices and units are none of these. A number or
    symbol stands as ``leaf`` has it, a function as ``function`` makes it of its name and arguments."""
    of = lambda node: canonical(node, leaf, function)
    match tree:
        case Num() | Sym():
            return leaf(tree)
        case Add(terms):
            return add(*map(of, terms))
        case Mul(factors):
            return mul(*map(of, factors))
        case Negative(inner):
            return negative(of(inner))
        case Quotient(top, bottom):
            return over(of(top), of(bottom))
        case Pow(base, Fraction() as exponent):
            return power(of(base), exponent)
        case Pow(base, exponent) if isinstance(number := of(exponent), Num):
            return power(of(base), Fraction(number.value))
        case Fn(name, args):
            return function(name, tuple(map(of, args)))
    raise ValueError(f"{type(tree).__name__} has no canonical form")


def operations(tree: Tree) -> int:
    """How many sums, products, powers and functions an expression has."""
    return sum(max(1, len(children(node)) - 1) for node in walk(tree) if children(node))


def symbols(*trees: Tree) -> set[Sym]:
    """All symbols that occur, rates and accelerations for themselves."""
    return set().union(*(tree.symbols for tree in trees))


def replace(tree: Tree, new: Mapping[Sym, Tree]) -> Tree:
    """The tree with symbols replaced."""
    return rebuilt(tree, lambda part: new.get(part) if isinstance(part, Sym) else None)


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


def read(data: Mapping[str, Any]) -> Tree:
    """A tree from JSON: ``{"add": [{"sym": "x", "dots": 2}, {"num": "3/2"}]}``."""
    for kind, of in data.items():
        match kind:
            case "mul":
                return Mul(tuple(map(read, of)))
            case "add":
                return Add(tuple(map(read, of)))
            case "num":
                return _number(of)
            case "sym":
                return _symbol(of, data.get("dots", 0))
            case "pow":
                return Pow(read(of[0]), Fraction(of[1]))
            case "fn":
                return Fn(of, tuple(map(read, data["args"])))
    raise ValueError(f"not an expression: {data!r}; expected one of num, sym, add, mul, pow, fn")


_number, _symbol = lru_cache(number), lru_cache(Sym)  # they occur many times


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


Entries: TypeAlias = Tree | Sequence["Entries"]
"""A tree, a vector of trees, a matrix of trees (rows)."""

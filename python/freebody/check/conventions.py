"""Edits of a whole equation at once: what a symbol measures and in which sense, and what was mistaken wherever it stands."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations, groupby

from freebody.symbolic.dimensions import FORCE, LENGTH, MASS, NUMBER_ONLY, Dimension
from freebody.symbolic.tree import Add, Cross, Dot, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, exchange, substitute, walk

from .edits import OTHER, Edit, exchanged
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation
from .vocabulary import Vocabulary, stem

_HALF = 0.05
"""By how much it is less likely that a mass is half of what it is than that it is there twice."""
_MOST_CALLS = 6
"""Sines and cosines of an angle, of which two are exchanged."""
_UNSIGNED = (LENGTH, MASS, Dimension(2, 1))
"""Dimensions of lengths, masses and moments of inertia, which have no sense."""
_OF_BODIES = ((1.0, 12.0), (1.0, 4.0), (1.0, 3.0), (2.0, 5.0), (1.0, 2.0), (2.0, 3.0), (3.0, 2.0), (1.0, 1.0))
"""Numbers of moments of inertia and of kinetic energies."""


def conventions(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Symbols of the other sense, and two symbols exchanged.

    A symbol that stands once is left to the edits of its place.
    """
    yield from _products(equation)
    yield from _functions(equation)
    yield from _powers(equation, vocabulary)
    yield from _energies(equation, vocabulary)
    yield from _inertias(equation)
    yield from _sizes(equation, vocabulary)
    found = [n for n in walk(equation) if isinstance(n, Sym)]
    often = [name for name in dict.fromkeys(n.name for n in found) if sum(n.name == name for n in found) > 1]
    for name in often:
        plain = Sym(name)
        if plain not in vocabulary.vectors and vocabulary.parameters.get(plain) not in _UNSIGNED:
            yield _convention(equation, {n: Negative(n) for n in _with_rates(name)}, f"`{name}` taken in the other sense")
    is_load = lambda n: vocabulary.dimension(n) == FORCE if n in vocabulary.parameters else vocabulary.is_load(n)
    loads = [n for n in dict.fromkeys(found) if is_load(n)]
    for _, alike in groupby(sorted(loads, key=stem), stem):
        if len(together := [*alike]) > 1:
            names = " and ".join(f"`{n.name}`" for n in together)
            yield _convention(equation, {n: Negative(n) for n in together}, f"{names} taken in the other sense")
    moving = [n for n in dict.fromkeys(found) if n.dots and Sym(n.name) in vocabulary.coordinates]
    for a, b in (
        (a, b) for a, b in combinations(moving, 2) if a.dots == b.dots and vocabulary.dimension(a) == vocabulary.dimension(b)
    ):
        yield _convention(equation, {a: Sym(b.name, b.dots), b: Sym(a.name, a.dots)}, f"`{a.key}` and `{b.key}` exchanged")
    pairs = [(n, o.name) for n in often for o in vocabulary.alike(Sym(n)) if n < o.name and o.name in often]
    given = [n for n in dict.fromkeys(found) if n in vocabulary.parameters]
    pairs += [(a.name, b.name) for a, b in combinations(given, 2)]
    for one, two in pairs:
        swapped = dict(zip(_with_rates(one) + _with_rates(two), _with_rates(two) + _with_rates(one), strict=True))
        yield _convention(equation, swapped, f"`{one}` and `{two}` exchanged")


def _convention(equation: Equation, changes: Mapping[Sym, Node], words: str) -> Edit:
    return Edit("convention", None, None, substitute(equation, changes), words=words)


def _everywhere(equation: Equation, changes: Mapping[Node, Node], words: str) -> Edit:
    """The edit of all parts that are one of some."""
    return Edit("convention", None, None, exchanged(equation, changes), words=words)


def _with_rates(name: str) -> list[Sym]:
    return [Sym(name, dots) for dots in range(3)]


def _products(equation: Equation) -> Iterator[Edit]:
    """Every cross product a scalar product, and the other way round."""
    for kind, other, words in ((Cross, Dot, "`·` for every `×`"), (Dot, Cross, "`×` for every `·`")):
        after = equation
        while (old := next((n for n in walk(after) if isinstance(n, kind)), None)) is not None:
            after = exchange(after, old, other(old.left, old.right, span=old.span))
        if after is not equation:
            yield Edit("convention", None, None, after, words=words)


def _functions(equation: Equation) -> Iterator[Edit]:
    """Sine and cosine of an angle exchanged wherever they stand, where they do more than once, or those of two terms; those of all angles."""
    calls = [n for n in walk(equation) if isinstance(n, Fn) and n.name in OTHER]
    if len({n.args for n in calls}) > 1 == len({n.name for n in calls}):  # as where a law is differentiated
        name = calls[0].name
        words = f"`{name}` should be `{OTHER[name]}` each time"
        yield _everywhere(equation, {n: Fn(OTHER[name], n.args) for n in calls}, words)
    for angle in dict.fromkeys(n.args for n in calls):
        found = [n for n in calls if n.args == angle]
        if len(found) > 1:
            changes = {n: Fn(OTHER[n.name], angle) for n in found}
            yield _everywhere(equation, changes, f"`sin` and `cos` of `{spell(angle[0])}` exchanged")
        for one, two in combinations(found, 2) if 2 < len(found) <= _MOST_CALLS else ():
            if one.name != two.name:
                after = exchange(exchange(equation, one, changes[one]), two, changes[two])
                yield Edit("convention", None, None, after, words=f"`{spell(one)}` and `{spell(two)}` exchanged")


def _powers(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Every square of a length the length itself, as where a momentum is written like an energy, and the other way round in a sum."""
    lengths = {n for n, its in vocabulary.parameters.items() if its == LENGTH}
    squares = {n: n.base for n in walk(equation) if isinstance(n, Pow) and n.base in lengths and n.exponent == Num(2.0)}
    if len(squares) > 1:
        yield _everywhere(equation, squares, "lengths that are squared, each by itself")
    for whole in (n for n in walk(equation) if isinstance(n, Add)):
        said = {n: Pow(n, Num(2.0, "2")) for n in walk(whole) if n in lengths}
        if len(said) > 1 and not any(isinstance(n, Pow) and n.base in said for n in walk(whole)):
            yield Edit.at(equation, "power", whole, exchanged(whole, said))


def _energies(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """½ of each kinetic energy, or twice."""
    squared = lambda n: any(isinstance(p, Pow) and p.exponent == Num(2.0) and _is_speed(p.base, vocabulary) for p in walk(n))
    sides = ((side.terms if isinstance(side, Add) else (side,)) for side in (equation.left, equation.right))
    found = [term for side in sides for term in side if squared(term)]
    if len(found) > 1:
        for words, change in (("½ of", lambda n: Quotient(n, Num(2.0, "2"))), ("twice", lambda n: Mul((Num(2.0, "2"), n)))):
            yield _everywhere(equation, {term: change(term) for term in found}, f"{words} each kinetic energy")


def _is_speed(node: Node, vocabulary: Vocabulary) -> bool:
    its = dimension(node, vocabulary.dimensions)
    return its is not None and its.mass == 0 and its.time == -1


def _inertias(equation: Equation) -> Iterator[Edit]:
    """A number that stands more than once, each time another: that of an inertia, or ½."""
    found = [n for n in walk(equation) if _is_number(n)]
    for one in dict.fromkeys(n for n in found if found.count(n) > 1):
        for above, below in _OF_BODIES:
            other: Node = Quotient(Num(above, f"{above:g}"), Num(below, f"{below:g}")) if below != 1 else Num(above, f"{above:g}")
            if other != one:
                yield _everywhere(equation, {one: other}, f"`{spell(one)}` should be `{spell(other)}` each time")


def _is_number(node: Node) -> bool:
    """Whether it is a fraction of two figures."""
    return isinstance(node, Quotient) and isinstance(node.top, Num) and isinstance(node.bottom, Num)


def _sizes(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """A quantity of the model that stands more than once, each time half or twice, as radius and diameter, or one of two alike, or another
    length."""
    known = vocabulary.parameters
    found = [n for n in walk(equation) if isinstance(n, Sym) and known.get(n) not in (None, NUMBER_ONLY) and n.name != "g"]
    for one in dict.fromkeys(n for n in found if found.count(n) > 1):
        others = vocabulary.alike(one) if known[one] == LENGTH else []
        for other in (Mul((Num(2.0, "2"), one)), Quotient(one, Num(2.0, "2")), *others):
            edit = _everywhere(equation, {one: other}, f"`{spell(one)}` should be `{spell(other)}` each time")
            yield replace(edit, extra=_HALF * (isinstance(other, Quotient) and known[one] != LENGTH))

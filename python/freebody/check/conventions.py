"""Edits of the whole equation at once: what a letter measures, and in which sense."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import combinations

from freebody.symbolic.dimensions import LENGTH, MASS, Dimension
from freebody.symbolic.tree import Add, Cross, Dot, Fn, Negative, Node, Num, Quotient, Sym, exchange, substitute, walk

from .edits import Edit
from .language.spelling import spell
from .language.statements import Equation
from .vocabulary import Vocabulary

_OTHER = {"sin": "cos", "cos": "sin"}
_SIZES = (LENGTH, MASS, Dimension(2, 1))
"""Dimensions of lengths, masses and moments of inertia, which have no sense."""
_QUARTER = Quotient(Num(math.pi, "pi"), Num(2.0, "2"))


def conventions(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Letters of the other sense, from another axis, relative for absolute, and two letters exchanged.

    A letter that stands once is left to the edits of its place.
    """
    yield from _products(equation)
    yield from _functions(equation)
    found = [n for n in walk(equation) if isinstance(n, Sym)]
    often = [name for name in dict.fromkeys(n.name for n in found) if sum(n.name == name for n in found) > 1]
    for name in often:
        plain = Sym(name)
        if plain in vocabulary.angular and plain in vocabulary.coordinates:
            yield from _angles(equation, plain, vocabulary)
        if plain not in vocabulary.vectors and vocabulary.parameters.get(plain) not in _SIZES:
            yield _convention(equation, {n: Negative(n) for n in _rates(name)}, f"`{name}` taken in the other sense")
    pairs = [(n, o.name) for n in often for o in vocabulary.alike(Sym(n)) if n < o.name and o.name in often]
    given = [n for n in dict.fromkeys(found) if n in vocabulary.parameters]
    pairs += [(a.name, b.name) for a, b in combinations(given, 2) if b not in vocabulary.alike(a)]
    for one, two in pairs:
        swapped = dict(zip(_rates(one) + _rates(two), _rates(two) + _rates(one), strict=True))
        yield _convention(equation, swapped, f"`{one}` and `{two}` exchanged")


def _convention(equation: Equation, changes: Mapping[Sym, Node], words: str) -> Edit:
    return Edit("convention", None, None, substitute(equation, changes), words=words)


def _rates(name: str) -> list[Sym]:
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
    """Sine and cosine of an angle exchanged wherever they stand, where both do."""
    calls = [n for n in walk(equation) if isinstance(n, Fn) and n.name in _OTHER]
    for angle in dict.fromkeys(n.args for n in calls):
        found = [n for n in calls if n.args == angle]
        if {n.name for n in found} == set(_OTHER):
            after = equation
            for call in found:
                after = exchange(after, call, Fn(_OTHER[call.name], angle))
            yield Edit("convention", None, None, after, words=f"`sin` and `cos` of `{spell(angle[0])}` exchanged")


def _angles(equation: Equation, plain: Sym, vocabulary: Vocabulary) -> Iterator[Edit]:
    """An angle from another axis, and relative for absolute."""
    name = plain.name
    for words, signed, say in (
        ("plus", lambda n: n, "absolute where it is relative"),
        ("minus", Negative, "relative where it is absolute"),
    ):
        yield _convention(equation, {plain: Add((plain, signed(_QUARTER)))}, f"`{name}` {words} a quarter turn")
        for other in vocabulary.alike(plain):
            shifted = {n: Add((n, signed(o))) for n, o in zip(_rates(name), _rates(other.name), strict=True)}
            yield _convention(equation, shifted, f"`{name}` {words} `{other.name}`: {say}, or the other way round")

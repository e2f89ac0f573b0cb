"""Edits of the whole equation at once: what a letter measures, and in which sense."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations

from freebody.symbolic.dimensions import LENGTH, MASS, Dimension
from freebody.symbolic.tree import Add, Cross, Dot, Fn, Negative, Node, Num, Quotient, Sym, exchange, substitute, walk

from .edits import Edit
from .language.spelling import spell
from .language.statements import Equation, letters
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
            yield _edit(equation, {name: _opposite}, f"`{name}` taken in the other sense")
    for name in often:
        for other in vocabulary.alike(Sym(name)):
            if name < other.name and other.name in often:
                yield _swapped(equation, name, other.name)
    given = [n for n in dict.fromkeys(found) if n in vocabulary.parameters]
    unlike = [(a, b) for a, b in combinations(given, 2) if b not in vocabulary.alike(a)]
    yield from (_swapped(equation, a.name, b.name) for a, b in unlike)


def _swapped(equation: Equation, one: str, two: str) -> Edit:
    """Two letters exchanged wherever they stand."""
    swapped = {Sym(a, d): Sym(b, d) for a, b in ((one, two), (two, one)) for d in range(3)}
    return Edit("convention", None, None, _exchanged(equation, swapped), words=f"`{one}` and `{two}` exchanged")


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
    name = plain.name
    for sign, words in ((1, "plus"), (-1, "minus")):
        quarter: Node = _QUARTER if sign > 0 else Negative(_QUARTER)
        after = substitute(equation, {plain: Add((plain, quarter))})
        yield Edit("convention", None, None, after, words=f"`{name}` {words} a quarter turn")
        for other in vocabulary.alike(plain):
            say = "absolute where it is relative" if sign > 0 else "relative where it is absolute"
            words_of = f"`{name}` {words} `{other.name}`: {say}, or the other way round"
            yield _edit(equation, {name: lambda n, o=other, s=sign: _shifted(n, o, s)}, words_of)


def _shifted(letter: Node, other: Sym, sign: int) -> Node:
    assert isinstance(letter, Sym)
    same = Sym(other.name, letter.dots)
    return Add((Sym(letter.name, letter.dots), same if sign > 0 else Negative(same)))


def _opposite(letter: Sym) -> Node:
    return Negative(Sym(letter.name, letter.dots))


def _edit(equation: Equation, changes: dict, words: str) -> Edit:
    inside = {n: changes[n.name](n) for n in letters(equation) if n.name in changes}
    return Edit("convention", None, None, substitute(equation, inside), words=words)


def _exchanged(equation: Equation, swapped: dict[Sym, Sym]) -> Equation:
    """Letters exchanged at once, by way of names that nothing else has."""
    between = {old: Sym(f"\0{old.name}", old.dots) for old in swapped}
    there = substitute(equation, dict(between))
    return substitute(there, {between[old]: new for old, new in swapped.items()})

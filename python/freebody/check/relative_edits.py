"""Motions seen from elsewhere, wherever they stand in an equation: relative where they are absolute, or the other way round, and angles from another axis."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import reduce

from freebody.symbolic.dimensions import LENGTH, PER_SECOND, SPEED, STIFFNESS
from freebody.symbolic.tree import Add, Negative, Node, Num, Pow, Quotient, Sym, addends, exchange, substitute, walk

from .edits import Edit
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation, symbols_in
from .vocabulary import Vocabulary

_ELSEWHERE = 0.4
"""By how much a motion is less likely to be measured from a body of which nothing was said."""
_QUARTER = Quotient(Num(math.pi, "pi"), Num(2.0, "2"))
_WAYS = (
    ("plus", lambda n: n, "absolute where it is relative"),
    ("minus", Negative, "relative where it is absolute"),
)
_MOMENTS = ("_1", "_2")


def seen_from_elsewhere(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Of coordinates with their rates, and of speeds of just before and just after something, that stand more than once."""
    found = [n for n in walk(equation) if isinstance(n, Sym)]
    for name in (name for name in dict.fromkeys(n.name for n in found) if sum(n.name == name for n in found) > 1):
        plain, turns = Sym(name), Sym(name) in vocabulary.angular
        if plain not in vocabulary.coordinates or not (turns or vocabulary.coordinates[plain] == LENGTH):
            continue
        for words, signed, _ in _WAYS if turns else ():
            yield _shifted(equation, {plain: Add((plain, signed(_QUARTER)))}, f"`{name}` {words} a quarter turn")
        for other in vocabulary.alike(plain):
            if turns or any(n.name == other.name for n in found):
                pairs = dict(zip(_with_rates(name), _with_rates(other.name), strict=True))
                yield from _other_frames(equation, name, other.name, pairs)
                if turns and plain in found:  # its angle may be the relative one, though its rates are not
                    yield from _other_frames(equation, name, other.name, {n: by for n, by in pairs.items() if n.dots})
    yield from _of_one_alone(equation)
    yield from _of_turning_frames(equation, found, vocabulary)
    yield from _from_natural_length(equation, vocabulary)
    stems = dict.fromkeys(n.name[:-2] for n in found if n.name.endswith(_MOMENTS) and vocabulary.dimension(n) == SPEED)
    speeds = {stem: [Sym(stem + index) for index in _MOMENTS] for stem in stems}
    for one, own in speeds.items():
        for two, others in speeds.items():
            if one != two and {*own, *others} <= {*vocabulary.others}:
                yield from _other_frames(equation, one, two, dict(zip(own, others, strict=True)))


def _of_one_alone(equation: Equation) -> Iterator[Edit]:
    """One rate alone for the sum or difference of two that stands more than once."""
    sums = [n for n in walk(equation) if isinstance(n, Add) and len(n.terms) == 2]
    for of in dict.fromkeys(sums):
        rates = [n for n in symbols_in(of) if n.dots == 1]
        if sums.count(of) < 2 or len(rates) != 2 or any(not isinstance(term, Sym | Negative) for term in of.terms):
            continue
        for rate in rates:
            mended = reduce(lambda whole, place: exchange(whole, place, rate), (n for n in sums if n == of), equation)
            yield Edit(
                "convention", None, None, mended, words=f"`{spell(rate)}` for `{spell(of)}`: absolute where it is relative"
            )


def _of_turning_frames(equation: Equation, found: Sequence[Sym], vocabulary: Vocabulary) -> Iterator[Edit]:
    """An angular velocity that has a letter, of a motor say, which stands more than once and is measured from what turns itself."""
    rates = [n for n in dict.fromkeys(found) if n.dots == 1 and Sym(n.name) in vocabulary.angular]
    letters = [n for n in dict.fromkeys(found) if Sym(n.name) not in vocabulary.coordinates]
    for one in (n for n in letters if vocabulary.dimension(n) == PER_SECOND and found.count(n) > 1):
        for rate in rates:
            yield from _other_frames(equation, one.name, f"{rate.name}'", {one: rate})


def _from_natural_length(equation: Equation, vocabulary: Vocabulary) -> Iterator[Edit]:
    """Whole lengths for the extensions in elastic energies, on both sides: k r² for k (r − l)²."""
    lengths = [n for n, its in vocabulary.parameters.items() if its == LENGTH]
    for stiffness in (n for n, its in vocabulary.parameters.items() if its == STIFFNESS):
        elastic = [term for side in (equation.left, equation.right) for _, term in addends(side) if stiffness in term.symbols]
        squared = (n for term in elastic for n in walk(term) if isinstance(n, Pow))
        squares = [n for n in squared if dimension(n.base, vocabulary.dimensions) == LENGTH and not isinstance(n.base, Add)]
        for natural in lengths if len(squares) > 1 else ():
            mended = equation
            for square in (n for n in squares if n.base != natural):
                mended = exchange(mended, square, Pow(Add((square.base, Negative(natural))), square.exponent))
            words = f"the extension is a length less `{spell(natural)}`, at both ends"
            yield Edit("extension", None, None, mended, words=words)


def _other_frames(equation: Equation, one: str, two: str, pairs: Mapping[Sym, Sym]) -> Iterator[Edit]:
    """What is measured from one body, measured from another."""
    said = any(n.name == other.name for n in symbols_in(equation) for other in pairs.values())
    for words, signed, say in _WAYS:
        shifted = {n: Add((n, signed(other))) for n, other in pairs.items()}
        edit = _shifted(equation, shifted, f"`{one}` {words} `{two}`: {say}, or the other way round")
        yield replace(edit, extra=0.0 if said else _ELSEWHERE)


def _shifted(equation: Equation, changes: Mapping[Sym, Node], words: str) -> Edit:
    return Edit("convention", None, None, substitute(equation, changes), words=words)


def _with_rates(name: str) -> list[Sym]:
    return [Sym(name, dots) for dots in range(3)]

"""What is said to be constant, or an energy, beside that of the model, term by term."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

import numpy as np

from freebody.equations import read
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import ZERO, Add, Negative, Node, Sym, addends, exchange

from .beside import Letters, Term, difference, ratio, signed
from .coefficients import more, multiplied
from .edits import Edit
from .families import Samples
from .language.statements import Equation, rows, symbols_in

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

_MOST = 5  # terms that are told to be lacking


_KINDS = {"kinetic()": ("kinetic",), "potential()": ("potential",), "energy()": ("kinetic", "potential")}
"""Of which kinds an energy of the model is."""
_EACH = 0.3  # by which a correction is larger for each term of the energy that it brings
_SAME = 1e-7  # below it a share is 0


def energy_edits(case: Case, equation: Equation, family: Family) -> Iterator[Edit]:
    """All terms that an equation lacks of the energy that a letter stands for, or of the change of the energy since the start of the motions of
    a family."""
    sides = (equation.left, equation.right)
    if len(rows(equation)) > 1:
        return
    for one, other in (sides, sides[::-1]):
        if isinstance(one, Sym):
            yield from _with(equation, other, lacking_of(case, one, other))
    if (samples := case.samples(family)).starts and any(n.dots == 1 for n in symbols_in(equation)):
        began = case.meaning.values(Samples(samples.core, samples.starts, samples.starts))
        changes = lambda term: sampled(term, case.values(family)) - sampled(term, began)
        with suppress(KeyError, StatementError):
            yield from _with(equation, sides[0], lacking_energies(case, Add((sides[0], Negative(sides[1]))), changes))


def _with(equation: Equation, side: Node, lost: tuple[Node, ...]) -> Iterator[Edit]:
    if lost:
        yield Edit("missing term", None, Add(lost), exchange(equation, side, more(side, *lost)), _EACH * len(lost))


def lacking_energies(case: Case, node: Node, value: Callable[[Node], Array]) -> tuple[Node, ...]:
    """The terms of the energy that an expression lacks; none where it has others, or nothing in common with it. ``value`` is how a term
    changes along the motions."""
    true, said = _beside(case, node, "energy()", value)
    found = difference(said, true)
    return found.missing if found.common and not found.strange and len(found.missing) <= _MOST else ()


def lacking_of(case: Case, letter: Sym, node: Node) -> tuple[Node, ...]:
    """What an expression lacks of the energy that a letter stands for, in its own letters where it has a part of a term; none where it has
    others, or too much of one."""
    kind = "".join(case.meaning.texts(letter))
    true, said = (
        _beside(case, node, kind, lambda term: np.asarray(sampled(term, case.admissible))) if kind in _KINDS else ([], [])
    )
    shares: dict[int, tuple[float, Node]] = {}
    for own, value in said:
        found = ((i, ratio(value, its)) for i, (_, its) in enumerate(true))
        place, share = next(((i, share) for i, share in found if share), (-1, None))
        if share is None:
            return ()
        shares[place] = (share + shares.get(place, (0.0, own))[0], own if place not in shares else true[place][0])
    lost = []
    for i, (term, _) in enumerate(true):
        share, own = shares.get(i, (0.0, term))
        if share > 1 + _SAME:
            return ()
        if share < 1 - _SAME:
            lost.append(multiplied(own, (1 - share) / (share if own is not term else 1.0)))
    return tuple(lost) if shares and None not in lost and len(lost) <= _MOST else ()  # type: ignore[arg-type]


def _beside(case: Case, node: Node, kind: str, value: Callable[[Node], Array]) -> tuple[list[Term], list[Term]]:
    """The terms of an energy of the model that change, and those of an expression; none where an energy has other symbols."""
    if not case.admissible:
        return [], []
    answer = case.sampler.core.symbolic_answers(case.samples().states[0], [{"ask": "energy"}])
    letters = Letters(case, Equation(node, ZERO), answer.symbols)
    energy = Add(tuple(read(answer.answers[0][part]) for part in _KINDS[kind]))
    terms = [term for term, _ in letters.terms(energy, ZERO)]
    if not {n.key for term in terms for n in symbols_in(term)} <= case.values().keys():
        return [], []
    true = [(term, change) for term in terms if np.any(change := value(term))]
    said = [(signed(sign, term), value(signed(sign, term))) for sign, term in addends(node, expand=True)]
    return true, [each for each in said if np.any(each[1])]

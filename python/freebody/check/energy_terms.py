"""What is said to be constant, an energy or a momentum, beside that of the model, term by term."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.equations import read
from freebody.symbolic.algebra import spread
from freebody.symbolic.dimensions import Dimension
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import ZERO, Add, Mul, Negative, Node, Pow, Sym, addends, canonical, exchange, rebuilt, walk

from .beside import Letters, Term, difference, ratio, signed
from .coefficients import more, multiplied
from .edits import Edit
from .families import Samples
from .language.dimensions import dimension
from .language.statements import Equation, rows, symbols_in

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

_MOST = 5  # terms that are told to be lacking


_KINDS = {"kinetic()": ("kinetic",), "potential()": ("potential",), "energy()": ("kinetic", "potential")}
"""Of which kinds an energy of the model is."""
_MOMENTUM = re.compile(r"momentum_([xy])\(\)|angular_momentum\((.+)\)")
_ABOUT_ORIGIN = "angular_momentum(ground.O)"
_ANGULAR_MOMENTUM = Dimension(2, 1, -1)
_EACH = 0.3  # by which a correction is larger for each term of the energy that it brings
_SAME = 1e-7  # below it a share is 0


def energy_edits(case: Case, equation: Equation, family: Family) -> Iterator[Edit]:
    """All terms that an equation lacks of the energy or momentum that a letter stands for, of the angular momentum about the origin, or of
    the change of the energy since the start of the motions of a family."""
    sides = (equation.left, equation.right)
    if len(rows(equation)) > 1:
        return
    for one, other in (sides, sides[::-1]):
        if isinstance(one, Sym):
            yield from _with(equation, other, lacking_of(case, one, other))
    if case.admissible and dimension(sides[0], case.meaning.vocabulary.dimensions) == _ANGULAR_MOMENTUM:
        whole = Add((sides[0], Negative(sides[1])))
        with suppress(KeyError, StatementError):
            yield from _with(equation, sides[0], _lacking(case, whole, _ABOUT_ORIGIN, _admissible(case)))
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
    return _lacking(case, node, "energy()", value)


def _lacking(case: Case, node: Node, kind: str, value: Callable[[Node], Array]) -> tuple[Node, ...]:
    """The same of an energy or a momentum of a ``kind``, as the model language reads it; where squares of sums are multiplied out, in the
    letters of the expression alone."""
    own = {n.key for n in symbols_in(node)}
    for opened in (False, True):
        true, said = _beside(case, node, kind, value, opened)
        found = difference(said, true)
        missing = _unbalanced(case, found.missing, value)
        is_own = all(n.key in own for term in missing for n in symbols_in(term))
        if found.common and not found.strange and len(missing) <= _MOST and (is_own or not opened):
            return missing
    return ()


def _unbalanced(case: Case, terms: tuple[Node, ...], value: Callable[[Node], Array]) -> tuple[Node, ...]:
    """Terms without those that cancel, as a weight and the springs that carry it at rest: of those of the same coordinates all together."""
    groups: dict[frozenset[str], list[Node]] = {}
    for term in terms:
        groups.setdefault(frozenset(n.name for n in symbols_in(term)) & {*case.sampler.names}, []).append(term)
    values = {of: [value(term) for term in some] for of, some in groups.items()}
    left = {of for of, each in values.items() if np.abs(sum(each)).max() > _SAME * np.abs(each).max()}
    return tuple(term for of, some in groups.items() if of in left for term in some)


def lacking_of(case: Case, letter: Sym, node: Node) -> tuple[Node, ...]:
    """What an expression lacks of the energy or momentum that a letter stands for, in its own letters where it has a part of a term; none where it has
    others, or too much of one."""
    kind = "".join(case.meaning.texts(letter))
    known = kind in _KINDS or _MOMENTUM.fullmatch(kind)
    true, said = _beside(case, node, kind, _admissible(case)) if known else ([], [])
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


def _admissible(case: Case) -> Callable[[Node], Array]:
    """What a term is at states that joints allow, where no balance holds."""
    return lambda term: np.asarray(sampled(term, case.admissible))


def _question(case: Case, kind: str) -> dict[str, Any]:
    """What to ask the core for an energy, or a momentum of all bodies."""
    if not (found := _MOMENTUM.fullmatch(kind)):
        return {"ask": "energy"}
    axis, point = found.groups()
    bodies = [body["name"] for body in case.sampler.metadata["bodies"]]
    return {"ask": "equation", "bodies": bodies, **({"along": axis} if axis else {"about": {"point": point}})}


def _without_squares(term: Node) -> Node:
    """A term with squares of sums in it multiplied out."""
    if not any(isinstance(node, Pow) and isinstance(node.base, Add) for node in walk(term)):
        return term
    return spread(rebuilt(canonical(term), lambda node: Mul((node.base,) * 2) if _is_square_of_sum(node) else None))


def _is_square_of_sum(node: Node) -> bool:
    return isinstance(node, Pow) and isinstance(node.base, Add) and node.exponent == 2


def _beside(
    case: Case, node: Node, kind: str, value: Callable[[Node], Array], opened: bool = False
) -> tuple[list[Term], list[Term]]:
    """The terms of an energy or a momentum of the model that change, with squares of sums ``opened``, and those of an expression; none
    where it has other symbols."""
    if not case.admissible:
        return [], []
    answer = case.sampler.core.symbolic_answers(case.samples().states[0], [_question(case, kind)])
    letters = Letters(case, Equation(node, ZERO), answer.symbols)
    whole = Add(tuple(read(answer.answers[0][part]) for part in _KINDS.get(kind, ("momentum",))))
    terms = [term for term, _ in letters.terms(whole, ZERO)]
    if opened:
        terms = [signed(sign, part) for term in terms for sign, part in addends(_without_squares(term))]
    if not {n.key for term in terms for n in symbols_in(term)} <= case.values().keys():
        return [], []
    true = [(term, change) for term in terms if np.any(change := value(term))]
    said = [(signed(sign, term), value(signed(sign, term))) for sign, term in addends(node, expand=True)]
    return true, [each for each in said if np.any(each[1])]

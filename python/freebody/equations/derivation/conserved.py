"""What stays constant, and why: energy, momentum along a direction, angular momentum about a point."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.equations.balances.conserved_momenta import ConservedMomentum, conserved_momenta, independent
from freebody.equations.balances.reasons import Place, agree, why_absent
from freebody.equations.derivation.first_integrals import first_integrals
from freebody.equations.derivation.sentences import clause, joined
from freebody.solve.perturbed_states import moving_states
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.solve.symbols import load_words
from freebody.symbolic.algebra import quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import Script, typed, word
from freebody.symbolic.presentation import presented
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Add, Sym, Tree, add, is_negative, is_zero, negative, power, read, symbols

_ABSENT = 1e-9
"""Part of a load below which it has none in a balance."""
_NONE = "No momentum of bodies that are joined is conserved: along no direction, about no fixed point and about no mass centre."


def section(subject: SymbolicState, symbolically: bool = True) -> list[Block]:
    """Every quantity that stays constant, with its reason, or why none does; ``symbolically``: and what it is in the coordinates."""
    kinetic, potential, why = energy(subject)
    kept = "conserved: all forces have potentials, and the reactions of joints and contacts do no work."
    made: list[Block] = [Heading("Conserved quantities")]
    if symbolically:
        left, right = energies(subject)
        made += [Equation(left, kinetic, "The kinetic and the potential energy"), Equation(right, potential)]
    lead = "Their sum" if symbolically else "The sum of kinetic and potential energy"
    made.append(Paragraph(f"{lead} is {f'not conserved: {why}.' if why else kept}"))
    while_idle = f"As long as {clause(subject.idle, 'carries', 'carry')} no load, the" if subject.idle else "The"
    found = momenta(subject)
    for each in found:
        reason = _reason(subject, each.found, each.where(subject))
        made.append(Paragraph(f"{while_idle} {each.words(subject)} is conserved: {reason}."))
        if symbolically:
            made.append(Equation(each.letter(subject), each.momentum))
    made += [] if found else [Paragraph(_NONE)]
    for integral in first_integrals(subject) if symbolically else ():
        made += [
            Paragraph(f"{while_idle} {integral.words} is conserved: {integral.reason}."),
            Equation(integral.quantity, Written("const", word("const"))),
        ]
    return made


def energy(subject: SymbolicState) -> tuple[Tree, Tree, str]:
    """Kinetic and potential energy, and why their sum is not constant (empty if it is)."""
    [stated] = subject.ask([{"ask": "energy"}])
    kinetic, potential = read(stated["kinetic"]), read(stated["potential"])
    loads, laws, why = subject.free.loads, {symbol.name for symbol, _ in subject.laws}, []
    if names := stated["without_potential"]:
        why.append(f"{clause(names, 'does', 'do')} work that has no potential")
    if motions := list(dict.fromkeys(load.name for load in loads if load.kind == "motion")):
        why.append(f"the motion of {joined(motions)} is prescribed, which takes work")
    if rough := list(dict.fromkeys(load.name for load in loads if load.follows or load.symbol in laws)):
        why.append(f"{clause(rough, 'has', 'have')} friction")
    if Sym("t") in symbols(kinetic, potential):
        why.append("the potential depends on time")
    return kinetic, potential, "; ".join(why)


def energies(subject: SymbolicState) -> tuple[Written, Written]:
    """How the kinetic and the potential energy are written."""
    names = (subject.symbols.quantity(f"E_{kind[0]}", f"{kind} energy") for kind in ("kinetic", "potential"))
    kinetic, potential = (
        Written(x.unicode(), (Script(typed("E"), word(x.below[0])),) if x.stem == "E" and len(x.below) == 1 else x.formula())
        for x in names  # what is below E is the beginning of a word, which is upright
    )
    return kinetic, potential


def total(subject: SymbolicState) -> Tree | None:
    """The energy, where it is conserved."""
    kinetic, potential, why = energy(subject)
    return None if why else add(kinetic, potential)


@dataclass(frozen=True)
class Momentum:
    """A constant ``momentum`` of some bodies, ``found`` in numbers, with the ``place`` about which it is or the unit vector along which;
    the balance says that its rate is 0."""

    found: ConservedMomentum
    momentum: Tree
    place: tuple[Tree, Tree]

    def words(self, subject: SymbolicState) -> str:
        """What it is: ``angular momentum of rod about ground.O``."""
        found, of = self.found, ""
        if not 1 < len(found.bodies) == len(subject.free.bodies):
            of = f" of {' + '.join(found.bodies)}"
        return f"{'angular ' * found.turns}momentum{of} {'about' if found.turns else 'along'} {self.where(subject)}"

    def where(self, subject: SymbolicState) -> str:
        """About what point, or along what."""
        if len(self.found.bodies) == 1 and self.found.twist.question == {"about": "centre"}:
            return "its mass centre"
        return self.found.twist.name if self.found.turns else subject.line(self.found.twist.name)

    def letter(self, subject: SymbolicState) -> Written:
        """``L_x``, ``H/ground.O``, about the mass centre of the whole ``H/G``; plain for a part of the whole, or another direction."""
        question = self.found.twist.question or {}
        about, along = question.get("about"), question.get("along")
        whole = len(self.found.bodies) == len(subject.free.bodies)
        point = "G" if about == "centre" else about.get("point") if isinstance(about, Mapping) else None
        if whole and point and not isinstance(along, str):
            return Written(f"H/{point}", (Script(typed("H"), typed("/", word(point))),))
        if whole and isinstance(along, str):
            return Written.of(subject.symbols.quantity(f"L_{along}", f"momentum along {along}"))
        return Written.of(subject.symbols.taken.give(f"the {self.words(subject)}", Name("H" if self.found.turns else "L")))


def momenta(subject: SymbolicState) -> list[Momentum]:
    """All that do not follow from each other. Numbers say which may be constant, symbols whether they are."""
    may_be = conserved_momenta(moving_states(subject.source, subject.state), subject.points)
    stated: dict[int, Balance] = {}
    while asked := [each for each in independent(may_be) if id(each) not in stated]:
        questions = [{"ask": "equation", "bodies": list(each.bodies), **(each.twist.question or {})} for each in asked]
        stated |= {id(each): balance for each, balance in zip(asked, subject.balances(questions), strict=True)}
        may_be = [each for each in may_be if id(each) not in stated or _holds(subject, each, stated[id(each)])]
    return [_written(subject, each, stated[id(each)]) for each in independent(may_be)]


def _holds(subject: SymbolicState, found: ConservedMomentum, balance: Balance) -> bool:
    """Whether a balance has no loads symbolically; or has none in numbers, and loops and contacts are closed, which symbols do not see.
    The numbers are enough only if they were taken at several places."""
    stands = found.twist.question == {"about": "centre"} or not any(x.name in subject.names for x in symbols(*balance.place.xy))
    return (is_zero(balance.left) and stands) or (found.elsewhere and bool(subject.rows))


def _written(subject: SymbolicState, found: ConservedMomentum, balance: Balance) -> Momentum:
    """The momentum; of a direction that is given by a load of another size than 1, over that size."""
    if balance.turns:
        return Momentum(found, balance.momentum, balance.place.xy)
    x, y = balance.place.xy
    size = float(np.hypot(*(evaluate(tree, subject.values, subject.tables) for tree in (x, y))))
    made, unit = presented(balance.momentum), abs(size - 1) < _ABSENT
    length = power(add(power(x, 2), power(y, 2)), "1/2")
    made, x, y = (each if unit else quotient(each, length) for each in (made, x, y))
    if not isinstance(made, Add) and is_negative(made):
        made, x, y = negative(made), negative(x), negative(y)
    return Momentum(found, made, (x, y))


def _reason(subject: SymbolicState, found: ConservedMomentum, where: str) -> str:
    """Why no load from outside changes it; known loads that each would are said to cancel."""
    place, length = Place("AMB" if found.turns else "LMB", where, found.at, False), subject.free.extent
    said: dict[str, list[str]] = {}
    for i, load in enumerate(subject.free.loads):
        if load.follows or load.inside(found.bodies) or not np.any(load.unit(found.bodies)):
            continue
        x, y, moment = load.unit(found.bodies, found.at if found.turns else (0.0, 0.0))
        part = moment if found.turns else x * found.at[0] + y * found.at[1]
        if not load.unknown and abs(part) > _ABSENT * max(1.0, abs(x), abs(y), abs(moment)):
            why = "in this they cancel each other"
        else:
            has_friction = any(other.follows and other.follows[0] == i for other in subject.free.loads)
            why = why_absent(load, found.bodies, place, length, has_friction)
        said.setdefault(why, []).append(load.symbol if load.unknown else load_words(load, found.bodies))
    if not said:
        return "nothing acts from outside"
    verb = "acts" if sum(map(len, said.values())) == 1 else "act"
    return f"from outside {verb} {'; '.join(f'{joined(names)} ({agree(why, len(names))})' for why, names in said.items())}"

"""One balance equation as a person states it: its title, what drops out and why, what acts, the scalar equation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from freebody.core import FreeBodies, Load, Pair
from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Words
from freebody.equations.balances.reasons import Place, agree, why_absent
from freebody.equations.balances.virtual_motions import placed
from freebody.equations.derivation.sentences import joined
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.solve.symbols import load_words
from freebody.symbolic.algebra import opposite, signed
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import Linear
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import ONE, Add, Sym, Tree, is_negative, is_zero, minus, negative, symbols

_GIVEN = ("origin", "centre", "start", "end", "G")
"""Points that every body has; the names of others are better known to a person."""
_SAME = 1e-9
"""Distance over the size of the mechanism below which two points are one."""


@dataclass(frozen=True)
class Stated:
    """A balance with its name: ``AMB about the pin elbow for forearm``. ``where`` is the point or direction in words, ``word``
    about, along or across; a ``constructed`` one is only described. ``own``: the sign of the acceleration that it is for, 0 where
    it is for none. Sums of ``constants`` are written as they are positive; all is multiplied by a ``factor``."""

    balance: Balance
    where: str
    word: str
    label: str = ""
    constructed: bool = False
    own: int = 0
    constants: Mapping[Sym, float] = field(default_factory=dict, repr=False)
    factor: Tree = ONE

    @property
    def kind(self) -> str:
        """AMB or LMB."""
        return "AMB" if self.balance.turns else "LMB"

    @property
    def title(self) -> str:
        """What it is."""
        return f"{self.kind} {self.word} {self.where} for {' + '.join(self.balance.bodies)}"

    @cached_property
    def _collected(self) -> tuple[Tree, Tree]:
        """What is moved and what acts, each unknown with one factor."""
        unknowns = list(self.balance.linear.coefficients)
        left, right = (presented(tree, unknowns=unknowns) for tree in (self.balance.right, self.balance.left))
        return signed(left, self.constants), signed(right, self.constants)

    @cached_property
    def turned(self) -> bool:
        """Whether the sides have all signs changed, so that the acceleration that it is for is positive, or, where it is for none, some
        term that has one, or some term."""
        if self.own:
            return self.own < 0
        left, right = self._collected
        every = left.terms if isinstance(left, Add) else (left,)
        terms = [term for term in every if any(x.dots == 2 for x in symbols(term))] or every
        return all(map(is_negative, terms)) and not isinstance(right, Sym)

    @cached_property
    def sides(self) -> tuple[Tree, Tree]:
        """What is moved = what acts, with the signs that read better; found when it is asked for."""
        left, right = self._collected
        return (opposite(left), opposite(right)) if self.turned else (left, right)

    @property
    def left(self) -> Tree:
        """What is moved."""
        return self.sides[0]

    @property
    def right(self) -> Tree:
        """What acts."""
        return self.sides[1]

    @property
    def residual(self) -> Tree:
        """left − right."""
        return minus(*self.sides)

    @cached_property
    def linear(self) -> Linear:
        """The residual by what is unknown."""
        return self.balance.linear.with_trees(negative) if self.turned else self.balance.linear

    def blocks(self, subject: SymbolicState) -> list[Block]:
        """The equation with all that a reader needs to believe it."""
        balance = self.balance
        made: list[Block] = [Heading(self.title, 3)]
        if absent := dropped(subject, self):
            names = ([f"the friction of {x.name}" if x.follows else x.symbol for x in loads] for loads in absent.values())
            said = (f"{joined(of)} ({agree(why, len(of))})" for why, of in zip(absent, names, strict=True))
            made.append(Paragraph(f"Not in this equation: {'; '.join(said)}."))
        what, sign, rate = ("moments", "Σ M = Ḣ", "angular momentum") if balance.turns else ("components", "Σ F = L̇", "momentum")
        unknowns, cancelled = list(balance.linear.coefficients), cancelling(subject, balance)
        acting: list[Words] = [
            [f"{load_words(subject.free.loads[c.load], balance.bodies)}: ", presented(c.tree)]
            for c in balance.contributions
            if not c.absent and c.load not in cancelled
        ]
        moved = [(body, tree) for body, tree in balance.inertia if not is_zero(tree)]
        inertia: list[Words] = [[f"inertia of {body}: ", presented(tree, unknowns=unknowns)] for body, tree in moved]
        made += [Paragraph(f"Applied {what}:"), Bullets(acting)] if acting else [Paragraph("No other load enters this equation.")]
        made += [Paragraph(f"Rate of change of {rate}:"), Bullets(inertia)] if inertia else []
        turned = ", with all signs changed," * self.turned
        return [*made, Equation(*self.sides, f"So {sign}{turned} is", self.label)]


def of_bodies(subject: SymbolicState, centre: str = "") -> list[Stated]:
    """The three balances of every body, two of a particle; ``centre`` is what its mass centre is called."""

    def where(balance: Balance) -> str:
        if balance.turns:
            return centre or f"the mass centre of {balance.bodies[0]}"
        return "y" if is_zero(balance.place.xy[0]) else "x"

    return [Stated(each, where(each), "about" if each.turns else "along") for each in subject.of_bodies()]


def dropped(subject: SymbolicState, stated: Stated) -> dict[str, list[Load]]:
    """Unknown loads that touch the bodies but are not in the equation, by reason, of one: ``it acts at elbow``."""
    found: dict[str, list[Load]] = {}
    balance, cancelled = stated.balance, cancelling(subject, stated.balance)
    at = numbers(subject, balance) if balance.turns else (0.0, 0.0)
    place = Place(stated.kind, stated.where, at, stated.constructed or stated.word == "across")
    for contribution in balance.contributions:
        load, summed = subject.free.loads[contribution.load], contribution.load in cancelled
        if load.unknown and (contribution.absent or summed) and not (summed and load.follows):
            found.setdefault(why_absent(load, balance.bodies, place, subject.free.extent, summed), []).append(load)
    return found


def cancelling(subject: SymbolicState, balance: Balance) -> set[int]:
    """Loads, by their places, that the friction which follows from them cancels in a balance, and that friction."""
    loads = subject.free.loads
    parts = {c.load for c in balance.contributions if not c.absent}
    leading = {load.follows[0] for load in loads if load.follows} & parts
    gone = {i for i in leading if Sym(loads[i].symbol) not in balance.linear.coefficients}
    return gone | {i for i in parts if (follows := loads[i].follows) and follows[0] in gone}


def numbers(subject: SymbolicState, balance: Balance) -> Pair:
    """The point (m), or the unit direction, of a balance at the state, in fixed axes."""
    with np.errstate(all="ignore"):  # a string without free length has no direction yet
        x, y = (float(evaluate(tree, subject.values, subject.tables)) for tree in balance.place.xy)
    length = 1.0 if balance.turns else float(np.hypot(x, y)) or 1.0
    return x / length, y / length


def named_place(subject: SymbolicState, at: Pair, bodies: Sequence[str]) -> str:
    """The name of a point: a pin there, else a mass centre, else another named point of the bodies, by its own name if no other
    body has one of that name."""
    free, near = subject.free, _SAME * subject.free.extent
    for load in free.loads:
        if load.kind == "joint" and load.axis and any(np.hypot(*np.subtract(part.point, at)) < near for part in load.on):
            return load.name
    for name in bodies:
        if np.hypot(*np.subtract(free.bodies[name].G, at)) < near:
            return f"the mass centre of {name}"
    last = {name: name.rpartition(".")[2] for name in subject.points}
    there = [name for name, point in subject.points.items() if point[0] in bodies and is_at(free, point, at)]
    own = sorted(there, key=lambda name: last[name] in _GIVEN)
    return next((last[name] if [*last.values()].count(last[name]) == 1 else name for name in own), "")


def is_at(free: FreeBodies, point: tuple[str, float, float], at: Pair) -> bool:
    """Whether a point (body, x, y in its frame) is at a place."""
    return point[0] in free.bodies and float(np.hypot(*np.subtract(placed(free, *point), at))) < _SAME * free.extent

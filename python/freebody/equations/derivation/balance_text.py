"""One balance equation as a person states it: its title, what drops out and why, what acts, the scalar equation."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from freebody.core import Body, FreeBodies, Load
from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Words
from freebody.equations.balances.reasons import Place, agree, why_absent
from freebody.equations.derivation.data import Balance, SymbolicState
from freebody.equations.derivation.meaning import joined
from freebody.equations.linear import Linear
from freebody.solve.symbols import load_words
from freebody.symbolic.collect import collected, factored
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, Sym, Tree, is_negative, is_zero, negative, symbols

_GIVEN = ("origin", "centre", "start", "end", "G")
"""Points that bodies have without being told; the names of others are better known to a person."""
_SAME = 1e-9
"""Distance over the size of the mechanism below which two points are one."""


@dataclass(frozen=True)
class Stated:
    """A balance with its name: ``AMB about the pin elbow for forearm``. ``where`` is the point or direction in words, ``word``
    about, along or across; a ``constructed`` one is only described. ``own``: the sign of the acceleration that it is for, 0 where
    it is for none."""

    balance: Balance
    where: str
    word: str
    label: str = ""
    constructed: bool = False
    own: int = 0

    @property
    def kind(self) -> str:
        """AMB or LMB."""
        return "AMB" if self.balance.turns else "LMB"

    @property
    def title(self) -> str:
        """What it is."""
        return f"{self.kind} {self.word} {self.where} for {' + '.join(self.balance.bodies)}"

    @property
    def sides(self) -> tuple[Tree, Tree]:
        """What is moved = what acts, each unknown with one factor; ``is_turned`` where that reads better."""
        left, right = self._collected
        return (negative(left), negative(right)) if self.is_turned else (left, right)

    @property
    def linear(self) -> Linear:
        """The equation as linear in what is unknown, with the sign of its sides."""
        return self.balance.linear.negative() if self.is_turned else self.balance.linear

    @cached_property
    def _collected(self) -> tuple[Tree, Tree]:
        unknowns = list(self.balance.linear.coefficients)
        return collected(self.balance.right, unknowns), collected(self.balance.left, unknowns)

    @property
    def is_turned(self) -> bool:
        """Whether all signs are changed: so that its own acceleration is positive, or some acceleration."""
        return self.own < 0 or (self.own == 0 and _all_negative(self._collected[0]))


def _all_negative(side: Tree) -> bool:
    """Whether all terms with accelerations are; where there are none, whether all terms are."""
    every = side.terms if isinstance(side, Add) else (side,)
    terms = [term for term in every if any(x.dots == 2 for x in symbols(term))] or every
    return all(map(is_negative, terms))


def blocks(subject: SymbolicState, stated: Stated) -> list[Block]:
    """The equation with all that a reader needs to believe it."""
    balance = stated.balance
    made: list[Block] = [Heading(stated.title, 3)]
    if reasons := absent(subject, stated):
        made.append(Paragraph(f"Not in this equation: {'; '.join(reasons)}."))
    what, sign = ("moments", "Σ M = Ḣ") if balance.turns else ("components", "Σ F = L̇")
    unknowns, cancelled = list(balance.linear.coefficients), cancelling(subject, balance)
    acting: list[Words] = [
        [f"{load_words(subject.free.loads[c.load], balance.bodies)}: ", factored(c.tree)]
        for c in balance.contributions
        if not c.absent and c.load not in cancelled
    ]
    inertia: list[Words] = [
        [f"inertia of {body}: ", collected(tree, unknowns)] for body, tree in balance.inertia if not is_zero(tree)
    ]
    if acting:
        made += [Paragraph(f"Applied {what}:"), Bullets(acting)]
    else:
        made.append(Paragraph("No other load enters this equation."))
    if inertia:
        rate = "angular momentum" if balance.turns else "momentum"
        made += [Paragraph(f"Rate of change of {rate}:"), Bullets(inertia)]
    turned = ", with all signs changed," if stated.is_turned else ""
    made.append(Equation(*stated.sides, f"So {sign}{turned} is", stated.label))
    return made


def absent(subject: SymbolicState, stated: Stated) -> list[str]:
    """Unknown loads that touch the bodies but are not in the equation, by reason: ``elbow.Fx and elbow.Fy (they act at elbow)``."""
    found = dropped(subject, stated).items()
    return [f"{joined([_symbol(load) for load in loads])} ({agree(why, len(loads))})" for why, loads in found]


def _symbol(load: Load) -> str:
    """The letter of a load; that which follows from another one has none."""
    return f"the friction of {load.name}" if load.follows else load.symbol


def dropped(subject: SymbolicState, stated: Stated) -> dict[str, list[Load]]:
    """Unknown loads that touch the bodies but are not in the equation, by reason, of one: ``it acts at elbow``."""
    found: dict[str, list[Load]] = {}
    at = numbers(subject, stated.balance)
    place = Place(stated.kind, stated.where, at, stated.constructed or stated.word == "across")
    cancelled = cancelling(subject, stated.balance)
    for contribution in stated.balance.contributions:
        load, summed = subject.free.loads[contribution.load], contribution.load in cancelled
        if load.unknown and (contribution.absent or summed) and not (summed and load.follows):
            why = why_absent(load, stated.balance.bodies, place, size(subject), summed)
            found.setdefault(why, []).append(load)
    return found


def cancelling(subject: SymbolicState, balance: Balance) -> set[int]:
    """Loads, by their places, that the friction which follows from them cancels in a balance, and that friction."""
    loads = subject.free.loads
    parts = {c.load for c in balance.contributions if not c.absent}
    leading = {load.follows[0] for load in loads if load.follows} & parts
    gone = {i for i in leading if Sym(loads[i].symbol) not in balance.linear.coefficients}
    return gone | {i for i in parts if (follows := loads[i].follows) and follows[0] in gone}


def numbers(subject: SymbolicState, balance: Balance) -> tuple[float, float]:
    """The point (m), or the unit direction, of a balance at the state, in fixed axes."""
    values = subject.values
    x, y = (float(evaluate(tree, values, subject.tables)) for tree in balance.place.xy)
    length = 1.0 if balance.turns else float(np.hypot(x, y)) or 1.0
    return x / length, y / length


def size(subject: SymbolicState) -> float:
    """The size of the mechanism, m."""
    return extent(subject.free)


def extent(free: FreeBodies) -> float:
    """How far apart loads act, m."""
    points = np.array([part.point for load in free.loads for part in load.on] or [(0.0, 0.0)])
    return float(np.hypot(*np.ptp(points, axis=0))) or 1.0


def named_place(subject: SymbolicState, at: tuple[float, float], bodies: Sequence[str]) -> str:
    """The name of a point: a pin there, else a mass centre, else another named point of the bodies, by its own name if no other
    body has one of that name."""
    free, near = subject.free, _SAME * size(subject)
    for load in free.loads:
        if load.axis and any(np.hypot(*np.subtract(part.point, at)) < near for part in load.on):
            return pin(load.name)
    for name in bodies:
        if np.hypot(*np.subtract(free.bodies[name].G, at)) < near:
            return f"the mass centre of {name}"
    there = [
        name for name, (body, x, y) in subject.points.items() if body in bodies and _near(free.bodies[body], (x, y), at) < near
    ]
    own = sorted(there, key=lambda name: name.rpartition(".")[2] in _GIVEN)
    return _short(subject, own[0]) if own else ""


def is_at(free: FreeBodies, point: tuple[str, float, float], at: tuple[float, float]) -> bool:
    """Whether a point (body, x, y in its frame) is at a place."""
    body, *where = point
    return body in free.bodies and _near(free.bodies[body], (where[0], where[1]), at) < _SAME * extent(free)


def pin(name: str) -> str:
    """A hinge as a point; not ``the pin pin``."""
    return name if "pin" in name.lower() else f"the pin {name}"


def _near(body: Body, point: tuple[float, float], at: tuple[float, float]) -> float:
    """How far a point of a body, in its frame, is from a place."""
    c, s = np.cos(body.angle), np.sin(body.angle)
    x, y = point
    return float(np.hypot(*np.subtract((body.at[0] + c * x - s * y, body.at[1] + s * x + c * y), at)))


def _short(subject: SymbolicState, point: str) -> str:
    last = point.rpartition(".")[2]
    return last if [name.rpartition(".")[2] for name in subject.points].count(last) == 1 else point

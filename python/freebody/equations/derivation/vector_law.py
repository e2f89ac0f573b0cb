"""A law written out in vectors, ½ L λ × (−m g j) = ½ L λ × m a + I α k, as it stands before its scalar equation."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from freebody.document.blocks import Vector
from freebody.equations.derivation import preamble
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.directions import Directions
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.symbolic.algebra import difference, quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import presented
from freebody.symbolic.printers.printer import Cross
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import ONE, ZERO, Tree, add, is_zero, mul, number

_MOST_LOADS, _MOST_BODIES = 8, 4
"""Loads on some bodies, and bodies, beyond which nobody writes all of them in one line."""
_SEED, _TRIES = 3, 5
_UNIT = 1e-9
"""By which the square of a unit vector may be off 1, by round-off."""

Terms = Mapping["str | Name", Tree]
"""Components by their directions."""


@dataclass(frozen=True)
class VectorLaw:
    """The law behind a balance in vectors: what acts, and what is moved."""

    subject: SymbolicState
    stated: Stated

    @cached_property
    def sides(self) -> tuple[Vector, Vector] | None:
        """Both sides; None where more acts than a line has room for, or friction that follows from other loads, or a force along what
        is neither a unit vector nor in one pair of directions."""
        given, subject = self.stated.balance, self.subject
        loads = {c.load: c.tree for c in given.contributions if not c.internal and self._counts(c.load, c.tree)}
        if len(loads) > _MOST_LOADS or len(given.bodies) > _MOST_BODIES or any(subject.free.loads[i].follows for i in loads):
            return None
        places = [("along", i) for i in loads] + [("about", i) for i in loads] * given.turns
        found = subject.balances(
            [{"ask": "equation", "bodies": [self._body(i)], "momentum": False, way: {"load": i}} for way, i in places]
        )
        lines = dict(zip(loads, found, strict=False))
        points = dict(zip(loads, found[len(loads) :], strict=False))
        inside = [m for m in subject.motions if m.body in given.bodies]
        moved = [m for m in inside if not (is_zero(m.mass) or all(map(is_zero, m.a.xy)))]
        named = preamble.directions(
            subject, [*(each.place for each in found), given.place, *(v for m in moved for v in (m.r, m.a))]
        )
        pulling = [i for i, line in lines.items() if not all(map(is_zero, line.place.xy))]
        pulls = [pull for i in pulling if (pull := self._force(i, lines[i], named))]
        if len(pulls) < len(pulling):
            return None
        carried = [_mass_times(m.mass, named.vector(m.a), subject.symbols.of_body("a", m.body)) for m in moved]
        if not given.turns:
            return Vector(_components(_sum(pulls), named)), Vector(_components(_sum(carried), named))
        about = _terms(named.vector(given.place))
        arms = [_less(_terms(named.vector(points[i].place)), about) for i in pulling]
        centres = [_less(_terms(named.vector(m.r)), about) for m in moved]
        turns = add(*(tree for i, tree in loads.items() if i not in pulling))
        spins = add(*(quotient(mul(m.inertia, m.alpha), ONE) for m in inside))
        return _moments(arms, pulls, turns, named), _moments(centres, carried, spins, named)

    def _body(self, load: int) -> str:
        """That of the bodies on which a load acts."""
        return next(part.body for part in self.subject.free.loads[load].on if part.body in self.stated.balance.bodies)

    def _counts(self, load: int, tree: Tree) -> bool:
        """Whether a load is in the law: of moments one that has one, of forces every force."""
        return not is_zero(tree) if self.stated.balance.turns else not self.subject.free.loads[load].card.couple

    def _force(self, load: int, line: Balance, named: Directions) -> Terms | None:
        """A load on the bodies: a known one by its components, an unknown one F e by its symbol. The balance along v has F e · v, where v is
        along e but need not be a unit vector, so that the load is (F e · v / v · v) v; None where v · v is not written out simply."""
        tree = next(each.tree for each in line.contributions if each.load == load)
        along = _terms(named.vector(line.place))
        if not self.subject.free.loads[load].unknown:
            size: Tree = number(-1 if next((x for x in self._near(tree) if x), 0) < 0 else 1)
        elif all(abs(x - 1) < _UNIT for x in self._near(add(*(mul(x, x) for x in line.place.xy)))):
            size = tree
        elif any({*along} <= {*pair} for pair in [named.axes[:2], *((pair.along, pair.across) for pair in named.pairs)]):
            size = quotient(tree, add(*(mul(x, x) for x in along.values())))
        else:
            return None
        return {name: mul(size, part) for name, part in along.items()}

    def _near(self, tree: Tree) -> list[float]:
        """Finite values of an expression at some states near this one."""
        rng = np.random.default_rng(_SEED)
        with np.errstate(all="ignore"):
            near = ({x: v + rng.uniform(0.1, 1) for x, v in self.subject.values.items()} for _ in range(_TRIES))
            sizes = [float(evaluate(tree, at, self.subject.tables)) for at in near]
        return [size for size in sizes if np.isfinite(size)]


def _mass_times(mass: Tree, a: Vector, name: Name) -> Terms:
    """m a, by the name of a where that has several components."""
    parts = _terms(a) if len(a.components) < 2 else {name: ONE}
    return {direction: mul(mass, tree) for direction, tree in parts.items()}


def _terms(vector: Vector) -> Terms:
    return {name: tree for tree, name in vector.components}


def _sum(parts: Iterable[Terms]) -> Terms:
    made: dict[str | Name, Tree] = {}
    for part in parts:
        made |= {name: add(made.get(name, ZERO), tree) for name, tree in part.items()}
    return made


def _less(first: Terms, second: Terms) -> Terms:
    return {name: difference(first.get(name, ZERO), second.get(name, ZERO)) for name in {**first, **second}}


def _components(terms: Terms, named: Directions) -> tuple[tuple[Tree, str | Name], ...]:
    """Those along the fixed axes first."""
    order = sorted(terms, key=lambda name: named.axes.index(name) if name in named.axes else len(named.axes))
    return tuple((presented(terms[name]), name) for name in order if not is_zero(terms[name]))


def _moments(arms: Sequence[Terms], vectors: Sequence[Terms], turns: Tree, named: Directions) -> Vector:
    """r × F for each arm, with all that has it, and the couples."""
    found: dict[tuple, list[Terms]] = {}
    for arm, vector in zip(arms, vectors, strict=True):
        found.setdefault(_components(arm, named), []).append(vector)
    made = [(ONE, Cross(arm, _components(_sum(each), named))) for arm, each in found.items() if arm]
    return Vector((*made, *_components({named.axes[2]: turns}, named)))

"""The motion of a point through a body's frame, or by a chain of bodies: every term by its name, symbolically and in numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from freebody.core import Array
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Table, Vector, Words, equations, listed
from freebody.document.document import Document
from freebody.equations.derivation.page import closure
from freebody.equations.derivation.put_in import Closed
from freebody.equations.derivation.sentences import joined
from freebody.equations.solve import Unconfirmed
from freebody.equations.topics.common import Asked, NotHere, document, known, point_of, rates
from freebody.equations.topics.point_motion import LEVELS, PointKinematics, Term, below
from freebody.solve.figures import figure
from freebody.solve.symbolic_state import Arrow, Direction, SymbolicState
from freebody.symbolic.algebra import equal, quotient
from freebody.symbolic.linear import linear_in
from freebody.symbolic.presentation import presented
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree, is_zero, negative, read, replace, symbols

_HEADINGS = dict(zip(LEVELS, (("Position", "m"), ("Velocity", "m/s"), ("Acceleration", "m/s²")), strict=True))


@dataclass(frozen=True)
class PointMotion(Document):
    """Position, velocity and acceleration of a point. ``terms`` add up to them; ``values`` are the sums, along x and y, SI, by
    ``r``, ``v`` and ``a``."""

    terms: tuple[Term, ...] = field(kw_only=True)
    values: Mapping[str, Array] = field(kw_only=True)


def frame(asked: Asked, *, point: str | None = None, body: Sequence[str] | str | None = None) -> PointMotion:
    """A point through a body's frame, or by a chain of bodies: relative, transport, centripetal, Coriolis and other terms.

    ``point``, or a hinge, and ``body``, by default the first mass centre that has a Coriolis acceleration through a body; of a ``point`` alone
    the chain of bodies that leads to it. Several bodies, ``rod,wheel``, are a chain: each is seen from the one before."""
    subject = asked.subject
    chain = [name.strip() for name in body.split(",")] if isinstance(body, str) else list(body or ())
    for name in chain:
        known(name, [motion.body for motion in subject.motions], "body")
    if point is None:
        point, chain = _telling(subject, chain)
    point = point_of(subject, point)
    if subject.points[point][0] not in subject.free.bodies:
        raise NotHere(f"{point} is a point of the ground and stays where it is; take a point of a body")
    seen = PointKinematics(subject, point, tuple(chain))
    closed = Closed(subject)
    made = document(subject, f"{point} {seen.way}", _blocks(seen, closed), [*seen.turns, *closed.symbols])
    values = {level: np.array(seen.value(arrow)) for level, arrow in seen.whole.items()}
    return PointMotion(made.blocks, made.letters, terms=seen.terms, values=values)


def _telling(subject: SymbolicState, chain: list[str]) -> tuple[str, list[str]]:
    """A mass centre, and a body of which it is none, through whose frame it has a Coriolis acceleration; else one that turns."""
    bodies = [motion.body for motion in subject.motions]
    pairs = [
        (f"{other}.G", by) for by in ([chain] if chain else [[body] for body in bodies]) for other in bodies if other not in by
    ]
    if not pairs:
        raise NotHere(f"{bodies[0]} is the only body; give a point, as {bodies[0]}.G")
    found = subject.ask([{"ask": "through", "point": point, "frames": by} for point, by in pairs])

    def dull(stretch: Mapping[str, Any]) -> tuple[bool, bool]:
        return all(is_zero(read(x)) for x in stretch["coriolis"]["xy"]), is_zero(read(stretch["omega"]))

    every = [min(map(dull, each["stretches"])) for each in found]
    return pairs[every.index(min(every))]


def _blocks(seen: PointKinematics, closed: Closed) -> list[Block]:
    made: list[Block] = [Heading("The frame" if seen.single else "The frames"), Paragraph(_introduction(seen))]
    turning = zip(seen.stretches, seen.turns[::2], seen.turns[1::2], strict=True)
    for each, omega, alpha in turning:
        made += [Equation(Sym(omega.name), read(each["omega"])), Equation(Sym(alpha.name), read(each["alpha"]))]
    made += [Paragraph(pair.sentence(seen.directions.axes)) for pair in seen.directions.pairs]
    for level, (heading, _) in _HEADINGS.items():
        made += [Heading(heading), *_sum(seen, level)]
    tied = [] if all(row.kind == "motion" for row in closed.rows) else closure(seen.subject, closed)
    return [*made, *_prescribed(seen), *_along_frame(seen), *_fixed(seen), *tied, *_numbers(seen)]


def _introduction(seen: PointKinematics) -> str:
    if seen.single:
        return f"The frame moves with {seen.bodies[0]}; its origin O′ is at {seen.places[0]}, r′ from there to {seen.places[-1]}."
    return f"Each of {joined(seen.bodies)} is seen from the one before; the origins of their frames are at {joined(seen.places[:-1])}."


def _sum(seen: PointKinematics, level: str) -> list[Block]:
    """The terms by their names, which vanish, and the whole."""
    every = [term for term in seen.terms if term.level == level]
    there, gone = ([term for term in every if term.vanishes is vanishes] for vanishes in (False, True))
    made: list[Block] = []
    for term in there:
        owner = f", {term.body}" if term.body and not seen.single else ""
        made.append(Equation(term.written, seen.directions.vector(term.arrow), term.name[0].upper() + term.name[1:] + owner))
    if gone and seen.single:
        made.append(Paragraph([*listed((term.written for term in gone), " and "), " vanish." if gone[1:] else " vanishes."]))
    whole = below(level, seen.places[-1])
    together: Words = ["Together, ", whole, " = ", *listed((term.written for term in there), " + ", " + ")] if there else ""
    return [*made, Equation(whole, seen.directions.vector(seen.whole[level]), together)]


def _prescribed(seen: PointKinematics) -> list[Block]:
    """Velocity and acceleration with the rates that motions prescribe, where they prescribe those of single coordinates."""
    rows = [row for row in seen.subject.rows if row.kind == "motion"]
    known: dict[Sym, Tree] = {}
    for tree, dots in ((tree, dots) for row in rows for tree, dots in ((row.rate, 1), (row.acceleration, 2)) if tree is not None):
        unknown = [x for x in (Sym(name, dots) for name in seen.subject.names) if x in symbols(tree)]
        if len(unknown) == 1:  # a rate or acceleration that is all that stands in what vanishes
            parts = linear_in(tree, unknown)
            known[unknown[0]] = quotient(negative(parts.rest), parts.coefficients[unknown[0]])
    if not known:
        return []

    def put(tree: Tree) -> Tree:
        return presented(from_sympy(to_sympy(replace(tree, known))))

    made: list[Block] = [Heading("With what is prescribed"), *equations(known.items(), "Motions give")]
    for level, name in (("v", "So"), ("a", "")):
        arrow = seen.whole[level]
        parts = tuple(Direction(d.angle, put(d.along), put(d.across)) for d in arrow.parts)
        vector = seen.directions.vector(Arrow(parts, put(arrow.i), put(arrow.j), arrow.xy))
        made.append(Equation(below(level, seen.places[-1]), vector, name))
    return made


def _along_frame(seen: PointKinematics) -> list[Block]:
    """The terms along the axes of the one frame, where they were written along others."""
    pair = next((pair for pair in seen.directions.pairs if pair.angle == read(seen.stretches[0]["angle"])), None)
    if pair is None or not seen.single:
        return []
    told = ((term, _vector(term.own, pair.along, pair.across)) for term in seen.terms if term.body and not term.vanishes)
    made = [Equation(term.written, vector) for term, vector in told if vector != seen.directions.vector(term.arrow)]
    return [Heading(f"Along the axes of {seen.bodies[0]}"), *made] if made else []


def _fixed(seen: PointKinematics) -> list[Block]:
    """Everything along the fixed axes, the sums held against the derivatives of the position."""
    v = rates(seen.whole["r"].xy, seen.subject.names)
    for level, pair in (("v", v), ("a", rates(v, seen.subject.names))):
        if not all(equal(*each) for each in zip(pair, seen.whole[level].xy, strict=True)):
            raise Unconfirmed(f"direct differentiation of the position of {seen.point} does not give what the frame gives")
    x, y, _ = seen.directions.axes
    made: list[Block] = [Heading(f"In {x} and {y}")]
    for level in LEVELS:
        told = [(term.written, term.arrow) for term in seen.terms if term.level == level and not term.vanishes]
        told += [(below(level, seen.places[-1]), seen.whole[level])] if len(told) != 1 else []
        made += equations((left, _vector(arrow.xy, x, y)) for left, arrow in told)
    return [*made, Paragraph("The position differentiated by time, once and twice, gives the same.")]


def _numbers(seen: PointKinematics) -> list[Block]:
    """Every term in numbers at the state."""
    rows: list[list[Words]] = []
    for level, (_, unit) in _HEADINGS.items():
        told = [(term.written, term.value) for term in seen.terms if term.level == level and not term.vanishes]
        told.append((below(level, seen.places[-1]), seen.value(seen.whole[level])))
        rows += [[[left], figure(x), figure(y), figure(float(np.hypot(x, y))), unit] for left, (x, y) in told]
    return [Heading("In numbers"), Table(("", "x", "y", "size", ""), rows, f"At {seen.subject.state.moment or 'this state'}:")]


def _vector(pair: tuple[Tree, Tree], along: str, across: str) -> Vector:
    return Vector(tuple((presented(tree), unit) for tree, unit in zip(pair, (along, across), strict=True) if not is_zero(tree)))

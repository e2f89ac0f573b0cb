"""A point seen from a moving body: transport, relative and Coriolis parts, and the same by direct differentiation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written, equations
from freebody.document.document import Document
from freebody.equations.derivation import preamble
from freebody.equations.derivation.directions import Directions
from freebody.equations.solve import Unconfirmed
from freebody.equations.topics.common import Asked, NotHere, document, known, own, place_of, rates, spread
from freebody.solve.symbolic_state import Arrow, Direction, SymbolicState
from freebody.symbolic.algebra import equal, quotient
from freebody.symbolic.formula import Atom, Script, bold
from freebody.symbolic.linear import linear_in
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.presentation import presented
from freebody.symbolic.symbols import Name
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree, is_zero, negative, read, replace, symbols

_WORDS = ("v", "v_transport", "v_relative", "a", "a_transport", "a_relative", "a_coriolis")


def frame(asked: Asked, *, point: str | None = None, body: str | None = None) -> Document:
    """A point seen from a moving body: transport, relative and Coriolis parts, and the same by direct differentiation.

    ``point`` and ``body``, by default the first mass centre that has a Coriolis acceleration through a body."""
    subject = asked.subject
    bodies = [motion.body for motion in subject.motions]
    if body is not None:
        known(body, bodies, "body")
    if point is not None:
        known(point, subject.points, "point")
    point, body, stated = _chosen(subject, [point] if point else [f"{b}.G" for b in bodies], [body] if body else bodies)
    turns = [
        own(subject, "coordinate", unit, f"{what} of {body}", letter, f"{letter}_{body}")
        for what, letter, unit in (("angular velocity", "omega", "rad/s"), ("angular acceleration", "alpha", "rad/s^2"))
    ]
    return document(subject, f"{point} seen from {body}", _blocks(subject, point, body, stated, turns), turns)


def _chosen(subject: SymbolicState, points: list[str], bodies: list[str]) -> tuple[str, str, Mapping[str, Any]]:
    pairs = [(p, b) for b in bodies for p in points if p in subject.points and subject.points[p][0] != b]
    if not pairs:
        raise NotHere(f"{points[0]} is a point of {bodies[0]} itself; take a point of another body, or another frame")
    stated = subject.ask([{"ask": "frame", "point": p, "body": b} for p, b in pairs])
    # best with a Coriolis acceleration, else at least in a frame that turns
    dull = [(all(is_zero(read(x)) for x in each["a_coriolis"]["xy"]), is_zero(read(each["omega"]))) for each in stated]
    best = dull.index(min(dull))
    return *pairs[best], stated[best]


def _blocks(
    subject: SymbolicState, point: str, body: str, stated: Mapping[str, Any], turns: Sequence[SymbolEntry]
) -> list[Block]:
    arrows = {word: Arrow.read(stated[word]) for word in _WORDS}
    place = place_of(subject, point)
    directions = preamble.directions(subject, [place, *arrows.values()])
    watched = f"The frame moves with {body}; {point} is watched from it. Its angular velocity and acceleration are"
    made: list[Block] = [Heading("The frame"), Paragraph(watched)]
    made += [Equation(Sym(turn.name), read(stated[word])) for turn, word in zip(turns, ("omega", "alpha"), strict=True)]
    made += [Paragraph(pair.sentence(directions.axes)) for pair in directions.pairs]
    parts = {
        "v_transport": f"Transport: of the place on {body} where {point} is, v of its origin + ω × r",
        "v_relative": f"Relative: as {body} sees {point} move",
        "v": "Together, v = v_transport + v_relative",
        "a_transport": f"Transport: of that place on {body}, a of its origin + α × r − ω² r",
        "a_relative": f"Relative: as {body} sees it",
        "a_coriolis": "Coriolis: 2 ω × v_relative",
        "a": "Together, a = a_transport + a_relative + a_coriolis",
    }
    for heading, symbol in (("Velocity", "v"), ("Acceleration", "a")):
        made.append(Heading(heading))
        made += [Equation(_vector(x), directions.vector(arrows[x]), what) for x, what in parts.items() if x[0] == symbol]
    made += _prescribed(subject, directions, arrows)
    return made + _directly(subject, place, arrows, point)


def _prescribed(subject: SymbolicState, directions: Directions, arrows: Mapping[str, Arrow]) -> list[Block]:
    """Velocity and acceleration with the rates that motions prescribe, where they prescribe those of single coordinates."""
    rows = [row for row in subject.rows if row.kind == "motion"]
    known: dict[Sym, Tree] = {}
    for tree, dots in ((tree, dots) for row in rows for tree, dots in ((row.rate, 1), (row.acceleration, 2)) if tree is not None):
        unknown = [x for x in (Sym(name, dots) for name in subject.names) if x in symbols(tree)]
        if len(unknown) == 1:  # a rate or acceleration that is all that stands in what vanishes
            parts = linear_in(tree, unknown)
            known[unknown[0]] = quotient(negative(parts.rest), parts.coefficients[unknown[0]])
    if not known:
        return []

    def put(tree: Tree) -> Tree:
        return presented(from_sympy(to_sympy(replace(tree, known))))

    made: list[Block] = [Heading("With what is prescribed")]
    made += equations(known.items(), "Motions give")
    for word, name in (("v", "So"), ("a", "")):
        arrow = arrows[word]
        parts = tuple(Direction(d.angle, put(d.along), put(d.across)) for d in arrow.parts)
        made.append(Equation(_vector(word), directions.vector(Arrow(parts, put(arrow.i), put(arrow.j), arrow.xy)), name))
    return made


def _directly(subject: SymbolicState, place: Arrow, arrows: Mapping[str, Arrow], point: str) -> list[Block]:
    names = subject.names
    v = rates(place.xy, names)
    a = rates(v, names)
    gap = [axis for axis in (0, 1) for found, word in ((v, "v"), (a, "a")) if not equal(found[axis], arrows[word].xy[axis])]
    if gap:
        raise Unconfirmed(f"direct differentiation of the position of {point} does not give what the frame gives")
    made: list[Block] = [Heading("By direct differentiation")]
    for what, pair in (("r", place.xy), ("v", v), ("a", a)):
        made += [Equation(Written.of(Name(what, (axis,))), spread(tree)) for axis, tree in zip("xy", pair, strict=True)]
    made.append(Paragraph("Both ways give the same, for all values of the symbols; it was checked at random ones."))
    return made


def _vector(name: str) -> Written:
    stem, _, below = name.partition("_")
    return Written(name, (Script(bold(stem), (Atom(below, "label"),)),) if below else bold(stem))

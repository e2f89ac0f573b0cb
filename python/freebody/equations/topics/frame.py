"""A point seen from a moving body: transport, relative and Coriolis parts, and the same by direct differentiation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.document.document import Document
from freebody.equations.derivation import preamble
from freebody.equations.derivation.data import Arrow, Direction, SymbolicState
from freebody.equations.derivation.directions import Directions
from freebody.equations.linear import linear_in
from freebody.equations.topics.common import NotHere, document, known, place_of, rates, spread, subject_of
from freebody.symbolic.algebra import equal, quotient
from freebody.symbolic.formula import Atom, Script, bold
from freebody.symbolic.presentation import presented
from freebody.symbolic.symbols import Name
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import Sym, Tree, is_zero, negative, read, replace, symbols

if TYPE_CHECKING:
    from freebody.core import State
    from freebody.model.builder import Builder

_WORDS = ("v", "v_transport", "v_relative", "a", "a_transport", "a_relative", "a_coriolis")


def frame(mechanism: Builder, state: State, *, point: str | None = None, body: str | None = None) -> Document:
    """A point seen from a moving body: transport, relative and Coriolis parts, and the same by direct differentiation.

    ``point`` and ``body``, by default the first mass centre that has a Coriolis acceleration through a body."""
    subject = subject_of(mechanism, state)
    bodies = [motion.body for motion in subject.motions]
    if body is not None:
        known(body, bodies, "body")
    if point is not None:
        known(point, subject.points, "point")
    point, body, stated = _chosen(subject, [point] if point else [f"{b}.G" for b in bodies], [body] if body else bodies)
    return document(subject, f"{point} seen from {body}", _blocks(subject, point, body, stated))


def _chosen(subject: SymbolicState, points: list[str], bodies: list[str]) -> tuple[str, str, Mapping[str, Any]]:
    pairs = [(p, b) for b in bodies for p in points if p in subject.points and subject.points[p][0] != b]
    if not pairs:
        raise NotHere(f"{points[0]} is a point of {bodies[0]} itself; take a point of another body, or another frame")
    stated = subject.ask([{"ask": "frame", "point": p, "body": b} for p, b in pairs])
    ranked = sorted(zip(pairs, stated, strict=True), key=lambda found: _dull(found[1]))
    (point, body), answer = ranked[0]
    return point, body, answer


def _dull(answer: Mapping[str, Any]) -> tuple[bool, bool]:
    coriolis, omega = answer["a_coriolis"]["xy"], answer["omega"]
    return all(is_zero(read(part)) for part in coriolis), is_zero(read(omega))


def _blocks(subject: SymbolicState, point: str, body: str, stated: Mapping[str, Any]) -> list[Block]:
    arrows = {word: Arrow.read(stated[word]) for word in _WORDS}
    place = place_of(subject, point)
    directions = preamble.directions(subject, [place, *arrows.values()])
    made: list[Block] = [Heading("The frame")]
    made.append(
        Paragraph(["The frame moves with ", body, f"; {point} is watched from it. Its angular velocity and acceleration are"])
    )
    made += [Equation(Sym("omega"), read(stated["omega"])), Equation(Sym("alpha"), read(stated["alpha"]))]
    made += [Paragraph(pair.sentence(directions.axes)) for pair in directions.pairs]

    def component_equation(name: str, word: str, what: str) -> Equation:
        return Equation(_vector(name), directions.vector(arrows[word]), what)

    made += [
        Heading("Velocity"),
        component_equation(
            "v_transport", "v_transport", f"Transport: of the place on {body} where {point} is, v of its origin + ω × r"
        ),
        component_equation("v_relative", "v_relative", f"Relative: as {body} sees {point} move"),
        component_equation("v", "v", "Together, v = v_transport + v_relative"),
        Heading("Acceleration"),
        component_equation("a_transport", "a_transport", f"Transport: of that place on {body}, a of its origin + α × r − ω² r"),
        component_equation("a_relative", "a_relative", f"Relative: as {body} sees it"),
        component_equation("a_coriolis", "a_coriolis", "Coriolis: 2 ω × v_relative"),
        component_equation("a", "a", "Together, a = a_transport + a_relative + a_coriolis"),
    ]
    made += _prescribed(subject, directions, arrows)
    return made + _directly(subject, place, arrows, point)


def _prescribed(subject: SymbolicState, directions: Directions, arrows: Mapping[str, Arrow]) -> list[Block]:
    """Velocity and acceleration with the rates that motions prescribe, where they prescribe those of single coordinates."""
    rows = [row for row in subject.rows if row.kind == "motion"]
    known = dict(
        filter(None, (_given(tree, subject, dots) for row in rows for tree, dots in ((row.rate, 1), (row.acceleration, 2))))
    )
    if not known:
        return []
    made: list[Block] = [Heading("With what is prescribed")]
    made += [Equation(x, tree, "Motions give" if i == 0 else "") for i, (x, tree) in enumerate(known.items())]
    stated = (("v", "So"), ("a", ""))
    return made + [Equation(_vector(word), directions.vector(_with(arrows[word], known)), name) for word, name in stated]


def _given(tree: Tree | None, subject: SymbolicState, dots: int) -> tuple[Sym, Tree] | None:
    """A rate or acceleration that is all that stands in what vanishes, and what it is."""
    unknown = [x for x in (Sym(name, dots) for name in subject.names) if tree is not None and x in symbols(tree)]
    if tree is None or len(unknown) != 1:
        return None
    parts = linear_in(tree, unknown)
    return unknown[0], quotient(negative(parts.rest), parts.coefficients[unknown[0]])


def _with(arrow: Arrow, known: Mapping[Sym, Tree]) -> Arrow:
    """A vector with some letters replaced."""
    parts = (Direction(d.angle, _put(d.along, known), _put(d.across, known)) for d in arrow.parts)
    return Arrow(tuple(parts), *(_put(tree, known) for tree in (arrow.i, arrow.j)), arrow.xy)


def _directly(subject: SymbolicState, place: Arrow, arrows: Mapping[str, Arrow], point: str) -> list[Block]:
    names = subject.names
    v = rates(place.xy, names)
    a = rates(v, names)
    gap = [axis for axis in (0, 1) for found, word in ((v, "v"), (a, "a")) if not equal(found[axis], arrows[word].xy[axis])]
    if gap:
        raise ArithmeticError(f"direct differentiation of the position of {point} does not give what the frame gives")
    made: list[Block] = [Heading("By direct differentiation")]
    for what, pair in (("r", place.xy), ("v", v), ("a", a)):
        made += [
            Equation(Written.of(Name(what, (axis,))), spread(tree)) for axis, tree in zip("xy", pair, strict=True)
        ]
    made.append(Paragraph("Both ways give the same, for all values of the symbols; it was checked at random ones."))
    return made


def _put(tree: Tree, known: Mapping[Sym, Tree]) -> Tree:
    return presented(from_sympy(to_sympy(replace(tree, known))))


def _vector(name: str) -> Written:
    stem, _, below = name.partition("_")
    return Written(name, (Script(bold(stem), (Atom(below, "label"),)),) if below else bold(stem))

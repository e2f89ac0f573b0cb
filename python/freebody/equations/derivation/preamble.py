"""The first sections of a derivation: configuration, letters, kinematics."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

import numpy as np

from freebody.document.blocks import Block, Bullets, Equation, Figure, Heading, Paragraph, Table, Written
from freebody.equations.derivation.data import Arrow, Motion, SymbolicState
from freebody.equations.derivation.directions import Directions, Link
from freebody.equations.derivation.loop_closure import holding
from freebody.equations.derivation.meaning import joined, plain
from freebody.solve.perturbed_states import DEPENDENT
from freebody.solve.symbols import Symbols
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.symbols import superscript
from freebody.symbolic.tree import Sym, is_zero

_CAPTION = "Every coordinate, from where it is 0. One that is 0 now is drawn a little further on."


def configuration(subject: SymbolicState) -> list[Block]:
    """The coordinates, and what each measures."""
    coordinates = subject.coordinates
    if not coordinates:
        return [Heading("Configuration"), Paragraph("The mechanism cannot move: there are no coordinates.")]
    rows = [([Sym(c["name"])], _doc(c), c["dimension"] or "1") for c in coordinates]
    return [
        Heading("Configuration"),
        Paragraph(f"{_freedom(subject)} {_count(len(coordinates))}:"),
        Table(("coordinate", "meaning", "unit"), rows),
        sketch(subject),
        *map(Paragraph, _reservations(subject)),
    ]


def _reservations(subject: SymbolicState) -> list[str]:
    """What holds for a while only, and does not show in the equations."""
    acting = {load.name for load in subject.free.loads if load.kind == "force"}
    cases = [force["name"] for force in subject.source.about["forces"] if force["cases"] and force["name"] in acting]
    said = [f"The law of {joined(cases)} has cases: the equations hold for the case at this state."] if cases else []
    if opening := [event["name"] for event in subject.source.spec.get("events", []) if event.get("opening")]:
        said.append(f"At the start of a motion {joined(opening)} happens; the equations are those before.")
    return said


def _freedom(subject: SymbolicState) -> str:
    """How many degrees of freedom there are; fewer while something holds."""
    freedom, held = subject.source.about["freedom"], holding(subject.rows)
    count = degrees(subject) if held else freedom["count"]
    said = "one degree" if count == 1 else f"{count or 'no'} degrees"
    prescribed = f", of which motions prescribe {freedom['driven']}" if freedom["driven"] else ""
    lead = f"While {held}, the" if held else "The"
    return f"{lead} mechanism has {said} of freedom{prescribed}."


def degrees(subject: SymbolicState) -> int:
    """Degrees of freedom, prescribed ones among them, with what holds now."""
    names = [c["name"] for c in subject.coordinates]
    free = [row for row, stated in zip(subject.free.rows, subject.rows, strict=True) if stated.kind != "motion"]
    table = np.array([[row.coefficients[name] for name in names] for row in free]).reshape(-1, len(names))
    return len(names) - int(np.linalg.matrix_rank(table, tol=DEPENDENT * np.abs(table).max(initial=1.0)))


def sketch(subject: SymbolicState) -> Figure:
    """The mechanism with what each coordinate measures."""
    from freebody.views.diagram.configuration import Configuration

    return Figure(Configuration(subject.source, subject.state), _CAPTION, "sketch")


def kinematics(subject: SymbolicState) -> list[Block]:
    """Position, velocity and acceleration of every mass centre in named unit directions."""
    named = directions(subject)
    made: list[Block] = [Heading("Kinematics"), Paragraph(_axes(subject.motions, *named.axes))]
    if named.pairs:
        made += [Paragraph("Rotating unit vectors:"), Bullets([pair.sentence(named.axes) for pair in named.pairs])]
        made += [Equation(left, right) for left, right in named.rates() if not subject.at_rest]
    for body in subject.motions:
        made += _body(body, named, subject.symbols)
    return made


def directions(subject: SymbolicState, arrows: Sequence[Arrow] = ()) -> Directions:
    """The unit directions in which some vectors are told, or the motions of all bodies."""
    motions = subject.motions
    names = [c["name"] for c in subject.coordinates]
    arrows = arrows or [a for b in motions for a in (b.r, b.v, b.a)]
    return Directions.of(motions, arrows, [*names, "t"], _links(subject), subject.values, subject.symbols.taken)


def _links(subject: SymbolicState) -> list[Link]:
    """Every link of the tree, from its first end to its second."""
    found = []
    for joint in subject.source.about["joints"]:
        load = next((load for load in subject.free.loads if load.kind == "joint" and load.name == joint["name"]), None)
        if load and load.card.pulls and joint["coordinates"]:
            x, y = next(part.force for part in load.on if part.body == joint["second"])  # a tension pulls it to the first
            found.append(Link(joint["name"], joint["first"], joint["second"], joint["coordinates"][0], float(np.arctan2(-y, -x))))
    return found


def letters(known: Letters, used: Collection[str]) -> list[Block]:
    """What the other letters mean, as far as they occur."""
    shown = [letter for letter in known.values() if letter.name in used]
    given = [letter for letter in shown if letter.kind in ("parameter", "constant")]
    unknown = [letter for letter in shown if letter.kind == "unknown"]
    made: list[Block] = []
    if given:
        made.append(Paragraph(["Given: ", *(piece for i, letter in enumerate(given) for piece in _given(letter, i)), "."]))
    if unknown:
        rows = [([Sym(letter.name)], letter.doc) for letter in unknown]
        made.append(Table(("symbol", "what it is"), rows, "Unknown:"))
    if renamed := list(map(str, known.renamed.values())):
        made.append(Paragraph(" ".join(renamed)))
    return [Heading("Symbols"), *made] if made else []


def _given(letter: Letter, place: int) -> list[str | Sym]:
    said = ", ".join(filter(None, (letter.doc, unit_text(letter.unit))))
    return [", " * bool(place), Sym(letter.name), f" ({said})" * bool(said)]


def unit_text(unit: str) -> str:
    """A unit as it is printed: kg·m²."""
    return re.sub(r"\^(-?\d+)", lambda found: superscript(found[1]), unit).replace("*", "·")


def _doc(coordinate: dict) -> str:
    """What it measures; a way along a guide in more words than the core's."""
    doc = plain(coordinate["doc"])
    way = re.fullmatch(r"(s|x|y) of (.+) from (.+) at (.+)", doc)
    if not way:
        return doc
    letter, second, first, joint = way.groups()
    return f"displacement of {second} along {joint}, on {first}" if letter == "s" else f"{letter} of {second}, seen from {first}"


def _count(number: int) -> str:
    return "Its configuration is described by one coordinate" if number == 1 else f"Its configuration is described by {number} coordinates"


def _axes(motions: Sequence[Motion], x: str, y: str, z: str) -> str:
    massless = [body.body for body in motions if is_zero(body.mass)]
    said = f"{x} and {y} are unit vectors along the fixed axes x and y, {z} = {x} × {y}. r, v and a are those of mass centres."
    return said + (f" {joined(massless)} {'has' if len(massless) == 1 else 'have'} no mass." if massless else "")


def _body(body: Motion, directions: Directions, symbols: Symbols) -> list[Block]:
    made: list[Block] = []
    for stem in "rva":
        name = symbols.of_body(stem, body.body)
        lead = f"For {body.body}" if stem == "r" else ""
        made.append(Equation(Written.of(name, bold=True), directions.vector(getattr(body, stem)), lead))
    if not body.particle:
        alpha = symbols.of_body("alpha", body.body)
        made.append(Equation(Written.of(alpha), body.alpha))
    return made

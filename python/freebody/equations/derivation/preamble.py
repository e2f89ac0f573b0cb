"""The first sections of a derivation: configuration, symbols, kinematics."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from freebody.core import GROUND
from freebody.document.blocks import Block, Bullets, Equation, Figure, Heading, Paragraph, Table, Written
from freebody.document.drawings import ConfigurationDrawing
from freebody.equations.derivation.directions import Directions, Link
from freebody.equations.derivation.loop_closure import holding
from freebody.equations.derivation.sentences import clause, joined
from freebody.solve.perturbed_states import DEPENDENT
from freebody.solve.symbolic_state import Arrow, SymbolicState
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.symbols import SUPERSCRIPTS
from freebody.symbolic.tree import Sym, Tree, is_zero, negative, read

_GUIDED = re.compile(r"^(s|x|y|r|length) of (.+) from (.+) at (.+?)(, backward)?$")
_VERTICAL = re.compile(r"the direction at (-?)90° to (.+) at ")
_CAPTION = "Every coordinate, from where it is 0. One that is 0 now is drawn a little further on."


def configuration(subject: SymbolicState) -> list[Block]:
    """The coordinates, what each measures, and what holds for a while only and does not show in the equations."""
    made: list[Block] = [Heading("Configuration")]
    if not subject.coordinates:
        return [*made, Paragraph("The mechanism cannot move: there are no coordinates.")]
    freedom, held = subject.source.metadata["freedom"], holding(subject.rows)
    changed = held or subject.state.history is not None  # what holds may be other than at the start
    count, number = degrees(subject) if changed else freedom["count"], len(subject.names)
    said = f"While {held}, the" if held else "The"
    said += f" mechanism has {'one degree' if count == 1 else f'{count} degrees' if count else 'no degrees'} of freedom"
    said += f", of which motions prescribe {freedom['driven']}" if freedom["driven"] else ""
    said += f". Its configuration is described by {'one coordinate' if number == 1 else f'{number} coordinates'}:"
    rows = [([Sym(c["name"])], meaning(subject, c), c["dimension"] or "1") for c in subject.coordinates]
    made += [Paragraph(said), Table(("coordinate", "meaning", "unit"), rows)]
    return [*made, Figure(ConfigurationDrawing(subject.source, subject.state), _CAPTION, "sketch"), *notes(subject)]


def meaning(subject: SymbolicState, coordinate: Mapping[str, Any]) -> str:
    """What a coordinate measures, in a person's words."""

    def vertical(found: re.Match[str]) -> str:
        body = next((motion for motion in subject.motions if motion.body == found[2]), None)
        word = f"straight {'down' if found[1] else 'up'} at " if body and is_zero(body.angle) else found[0]
        return word.replace("-90", "−90")

    said = _GUIDED.sub(_displacement, coordinate["doc"].replace("`", ""))
    said = re.sub(rf"from ({GROUND}|the fixed x axis) at ", "from the x axis at ", said)
    return _VERTICAL.sub(vertical, said)


def notes(subject: SymbolicState) -> list[Block]:
    """What holds for a while only and does not show in the equations, and states with rates of their own."""
    made: list[Block] = []
    acting = {load.name for load in subject.free.loads if load.kind == "force"}
    if cases := [force["name"] for force in subject.source.metadata["forces"] if force["cases"] and force["name"] in acting]:
        made.append(Paragraph(f"The law of {joined(cases)} has cases: the equations hold for the case at this state."))
    if names := subject.source.metadata["states"]:
        made.append(Paragraph("Beside the coordinates there are states with rates of their own:"))
        rates = [read(rate) for rate in subject.ask([{"ask": "state_rates"}])[0]]
        made += [Equation(Sym(name, 1), rate) for name, rate in zip(names, rates, strict=True)]
    return made + unloaded(subject)


def unloaded(subject: SymbolicState) -> list[Block]:
    """What is closed and carries nothing at the state, so that it is missed in the equations."""
    if not subject.idle:
        return []
    said = clause(subject.idle, "is closed but carries", "are closed but carry")
    here, they = ("it is", "it carries") if len(subject.idle) == 1 else ("they are", "they carry")
    return [Paragraph(f"At this state {said} no load, so that {here} in no equation here; give a state at which {they} one.")]


def _displacement(found: re.Match[str]) -> str:
    """What a coordinate of a guide measures, in more words than the core's."""
    word, second, first, joint, backward = found.groups()
    if word in ("r", "length"):
        return f"distance of {second} from {joint}" if word == "r" else f"free length of {joint}"
    if word == "s":
        return f"displacement of {second} along {joint}{f', on {first}' * (first != GROUND)}{backward or ''}"
    return f"{word} of {second}{f', seen from {first}' * (first != GROUND)}"


def degrees(subject: SymbolicState) -> int:
    """Degrees of freedom, prescribed ones among them, with what holds now."""
    names = subject.names
    closing = {row.name for row in subject.rows if row.kind != "motion"}
    free = [row for row in subject.free.rows if row.name in closing]
    table = np.array([[row.coefficients[name] for name in names] for row in free]).reshape(len(free), len(names))
    return len(names) - int(np.linalg.matrix_rank(table, tol=DEPENDENT * np.abs(table).max(initial=1.0)))


def kinematics(subject: SymbolicState) -> list[Block]:
    """Position, velocity and acceleration of every mass centre in named unit directions."""
    named = directions(subject)
    x, y, z = named.axes
    said = f"{x} and {y} are unit vectors along the fixed axes x and y, {z} = {x} × {y}. r, v and a are those of mass centres."
    if massless := [motion.body for motion in subject.motions if is_zero(motion.mass)]:
        said += f" {clause(massless, 'has', 'have')} no mass."
    made: list[Block] = [Heading("Kinematics"), Paragraph(said)]
    if named.pairs:
        made += [Paragraph("Rotating unit vectors:"), Bullets([pair.sentence(named.axes) for pair in named.pairs])]
        made += [Equation(left, right) for left, right in named.rates() if not subject.at_rest]
    for motion in subject.motions:
        for stem in "rva":
            name = subject.symbols.of_body(stem, motion.body)
            vector = named.vector(getattr(motion, stem))
            made.append(Equation(Written.of(name, bold=True), vector, f"For {motion.body}" if stem == "r" else ""))
        if not motion.particle:
            alpha = subject.symbols.of_body("alpha", motion.body)
            made.append(Equation(Written.of(alpha), motion.alpha))
    return made


def directions(subject: SymbolicState, arrows: Sequence[Arrow] = ()) -> Directions:
    """The unit directions in which some vectors are written, or the motions of all bodies."""
    links = []  # every link of the tree, from its first end to its second, and every line on the ground
    for joint in subject.source.metadata["joints"]:
        load = next((load for load in subject.free.loads if load.kind == "joint" and load.name == joint["name"]), None)
        if not load or not joint["coordinates"]:
            continue
        x, y = next(part.force for part in load.on if part.body == joint["second"])  # a tension pulls it to the first
        if load.card.pulls:
            links.append(Link(joint["name"], joint["first"], joint["second"], joint["coordinates"][0], float(np.arctan2(-y, -x))))
        elif joint["first"] == GROUND and not load.axis and np.hypot(x, y) > 0:  # a normal force, across the line
            links.append(Link(joint["name"], "", "", "", float(np.arctan2(-x, y))))
    motions = subject.motions
    every = [*(a for b in motions for a in (b.r, b.v, b.a)), *arrows]  # so that each has one name, whatever is written in it
    found = Directions.of(motions, every, [*subject.names, "t"], links, subject.values, subject.symbols.taken, _polar(subject))
    wanted = {part.angle for arrow in arrows or every for part in arrow.parts}
    return replace(found, pairs=tuple(pair for pair in found.pairs if pair.angle in wanted))


def _polar(subject: SymbolicState) -> dict[Tree, tuple[str, int]]:
    """The angle of every pair of polar coordinates, with the radius and by how many quarters of a turn it is ahead."""
    found = {}
    for joint in (each for each in subject.source.metadata["joints"] if each["type"] == "polar"):
        radius, place = joint["coordinates"][0], next(m.r for m in subject.motions if m.body == joint["second"])
        for part in place.parts:
            sides = (part.along, part.across, negative(part.along), negative(part.across))
            if Sym(radius) in sides:
                found[part.angle] = radius, sides.index(Sym(radius))
    return found


def nomenclature(known: Nomenclature, used: Collection[str]) -> list[Block]:
    """What the other symbols mean, as far as they occur."""
    shown = [symbol for symbol in known.values() if symbol.name in used]
    given: list[str | Sym] = []
    for symbol in (symbol for symbol in shown if symbol.kind in ("parameter", "constant")):
        unit = re.sub(r"\^(-?\d+)", lambda found: found[1].translate(SUPERSCRIPTS), symbol.unit).replace("*", "·")
        said = ", ".join(filter(None, (symbol.doc, unit)))
        given += [", " if given else "Given: ", Sym(symbol.name), f" ({said})" * bool(said)]
    made: list[Block] = [Paragraph([*given, "."])] if given else []
    if unknown := [([Sym(symbol.name)], symbol.doc) for symbol in shown if symbol.kind == "unknown"]:
        made.append(Table(("symbol", "what it is"), unknown, "Unknown:"))
    if renamed := list(map(str, known.renamed.values())):
        made.append(Paragraph(" ".join(renamed)))
    return [Heading("Symbols"), *made] if made else []

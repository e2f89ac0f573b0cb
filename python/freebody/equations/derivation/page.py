"""The page of a book: coordinates, accelerations, then for each balance its free body, what acts = what is moved, the scalar equation."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from freebody.document.blocks import Block, Equation, Figure, Heading, Paragraph, Vector, Words, Written, is_tree, listed, pieces
from freebody.document.drawings import ConfigurationDrawing
from freebody.equations.derivation import loop_closure, preamble
from freebody.equations.derivation.balance_page import ROOM, Shown, directions_in, fit, lines, shown
from freebody.equations.derivation.balance_page import fitted as balances
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.directions import Directions
from freebody.equations.derivation.distances import distances
from freebody.equations.derivation.pins import from_pins
from freebody.equations.derivation.plain_rows import on_two_sides
from freebody.equations.derivation.put_in import Closed
from freebody.solve.symbolic_state import Motion, SymbolicState
from freebody.symbolic.algebra import signed
from freebody.symbolic.formula import typed
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.symbols import direction
from freebody.symbolic.tree import Sym, is_zero, power, symbols

_TURNS = ", counter-clockwise"
_AXIS = re.compile(r" along [xy](?= of )")
_DERIVATIVES = (
    "",
    "Differentiated once more, these bind the accelerations (`--long`).",
    "Differentiated once and twice, these bind the velocities and the accelerations (`--long`).",
)
"""What is said of derivatives that are not shown."""


def beginning(subject: SymbolicState, known: Nomenclature, used: Collection[str], own: bool) -> list[Block]:
    """What the coordinates measure, where they are those of the model, what is given and what else is unknown; the sketch; what is not
    called by its usual name."""
    shown = [symbol for symbol in known.values() if symbol.name in used]
    given = [[Sym(x.name), f" ({x.doc})" * bool(x.doc)] for x in shown if x.kind in ("parameter", "constant")]
    loads: dict[str, list[Sym]] = {}
    for x in (x for x in shown if x.kind == "unknown"):
        loads.setdefault(_AXIS.sub("", x.doc.removesuffix(f" ({x.name})")), []).append(Sym(x.name))
    forces = [[*listed(names, " and "), f", {doc}"] for doc, names in loads.items()]
    said = [_coordinates(subject)] if own else []
    said += [["Given: ", *_listed(given, ", "), "."]] * bool(given)
    said += [["Unknown besides: ", *_listed(forces, "; "), "."]] * bool(forces)
    made: list[Block] = [Paragraph(_listed(said, " "))] if said else []
    if own:
        made += [Figure(ConfigurationDrawing(subject.source, subject.state), name="sketch"), *preamble.notes(subject)]
    return made + [Paragraph(" ".join(map(str, known.renamed.values())))] * bool(known.renamed)


def _coordinates(subject: SymbolicState) -> Words:
    if not subject.coordinates:
        return "The mechanism cannot move: there are no coordinates."
    meanings = [preamble.meaning(subject, c) for c in subject.coordinates]
    said: list[Words] = []
    for name, what in zip(subject.names, meanings, strict=True):
        if what.startswith("y of ") and said and said[-1][1:] == [f": x{what[1:]}"]:
            said[-1] = [*said[-1][:1], " and ", Sym(name), f": place{what[1:]}"]
        else:
            said.append([Sym(name), f": {what.removesuffix(_TURNS)}"])
    return [*_listed(said, "; "), f".{' Angles are counter-clockwise.' * any(what.endswith(_TURNS) for what in meanings)}"]


def fitted(subject: SymbolicState, stated: Sequence[Stated], closed: Closed, besides: Sequence[Block]) -> list[Block]:
    """The page below its beginning, with what stands ``besides`` before the balances: in full where there is room for it; else closures
    without their derivatives, and accelerations from body to body."""
    named = preamble.directions(subject)
    every = shown(subject, stated, closed, named)
    above = lines(subject, [*_head(subject, closed, every), *besides])
    for brief in range(3) if fit(every, "whole", ROOM) else (2,):
        opening = [*closure(subject, closed, brief), *kinematics(subject, closed, named, subject.motions, chained=brief > 0)]
        room = ROOM - above - lines(subject, opening)
        if fit(every, "whole", room):
            break
    made = balances(every, room)
    if found := units(made):
        opening = [*closure(subject, closed, brief), *kinematics(subject, closed, named, subject.motions, found, brief > 0)]
    return [*opening, *besides, *made]


def kinematics(
    subject: SymbolicState,
    closed: Closed,
    every: Directions,
    motions: Sequence[Motion],
    others: Collection[str] = (),
    chained: bool = False,
) -> list[Block]:
    """The unit directions in a sentence, those that ``others`` are among them, the acceleration of every mass centre that has one, and of
    what rolls or is geared how it turns; ``chained``: from the pin of each body on."""
    moving = [motion for motion in motions if not (is_zero(motion.mass) or all(map(is_zero, motion.a.xy)))]
    written = [(subject.symbols.of_body("a", motion.body), every.vector(motion.a).components) for motion in moving]
    written = from_pins(subject, every, [motion.body for motion in moving], written) if chained else written
    wanted = {*others, *(unit for _, parts in written for _, unit in parts)}
    pairs = [pair for pair in every.pairs if {pair.along, pair.across} & wanted]
    said = [[Written(pair.along, direction(pair.along)), " at ", pair.angle_along] for pair in pairs]
    name: Words = "Accelerations of the mass centres"
    if said:
        names = [("λ", "n")] * any(not pair.radius for pair in pairs)
        names += [(pair.along, pair.across) for pair in pairs if pair.radius]
        turned = [_turned(every.axes[2], *pair) for pair in names]
        start = Written(every.axes[0], direction(every.axes[0]))
        name = ["Accelerations, in unit directions ", *_listed(said, ", "), " from ", start, " and ", *listed(turned, " and ")]
    made: list[Block] = []
    for left, parts in written:
        shortened = tuple((signed(closed.put(tree), subject.constants), unit) for tree, unit in parts)
        made.append(Equation(Written.of(left, bold=True), Vector(shortened), "" if made else name))
    for motion in motions:
        if not is_zero(motion.inertia) and any(symbols(motion.alpha) & subject.constants.keys()):
            made.append(
                Equation(Written.of(subject.symbols.of_body("alpha", motion.body)), motion.alpha, "" if made else "Turning")
            )
    return made


def _turned(axis: str, along: str, across: str) -> Written:
    """One direction as another that is turned by a right angle: n = k × λ."""
    return Written(
        f"{across} = {axis} × {along}", (*direction(across), *typed("="), *direction(axis), *typed("×"), *direction(along))
    )


def closure(subject: SymbolicState, closed: Closed, brief: int = 0) -> list[Block]:
    """What is closed or prescribed: the places, the velocities, the accelerations; first what roots are called. ``brief``: without so
    many of the derivatives."""
    if not closed.rows:
        return []
    made = roots(closed)
    places, rates, accelerations = on_two_sides(closed.rows, subject.names, distances(subject, closed.rows))
    levels = [places, rates if brief < 2 or not places else [], accelerations if brief < 1 else []]
    for left, right in (pair for level in levels for pair in level):
        made.append(Equation(signed(left, subject.constants), signed(right, subject.constants) if is_tree(right) else right))
    said = _DERIVATIVES[brief if places else min(brief, 1)]
    return [Heading(loop_closure.title(subject.rows), 3), *made, *([Paragraph(said)] if said else [])]


def roots(closed: Closed) -> list[Block]:
    """What the roots are that have symbols."""
    return [Equation(Sym(entry.name), power(base, "1/2")) for entry, base in closed.named]


def units(made: Sequence[Block]) -> set[str]:
    """The names of the unit directions in laws in vectors."""
    sides = (side for block in made if isinstance(block, Equation) for side in (block.left, block.right))
    return directions_in(side for side in sides if isinstance(side, Vector))


def _head(subject: SymbolicState, closed: Closed, every: Sequence[Shown]) -> list[Block]:
    """The title and the beginning of a page, as far as can be told before it is made."""
    short = [each.whole for each in every if not each.is_long]
    used = {x.name for each in short for x in symbols(each.left, each.right)} | {
        x.name for row in closed.rows for x in symbols(row.acceleration)
    }
    return [Heading(subject.titled("equations"), 1), *beginning(subject, subject.nomenclature, used, True)]


def _listed(parts: Sequence[Words], between: str) -> list:
    return [piece for i, part in enumerate(parts) for piece in ([between] if i else []) + pieces(part)]

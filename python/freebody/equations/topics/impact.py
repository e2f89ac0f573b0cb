"""An impact: impulses on each body, which are absent and why, impulse–momentum equations, restitution, rates after."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from freebody.document.blocks import (
    Block,
    Bullets,
    Equation,
    Figure,
    Heading,
    MatrixEquation,
    Paragraph,
    Side,
    Words,
    equations,
    listed,
)
from freebody.document.document import Document
from freebody.document.drawings import ImpulseDrawing
from freebody.equations.balances.reasons import agree
from freebody.equations.derivation.balance_text import Stated, dropped
from freebody.equations.derivation.sentences import joined
from freebody.equations.solve import Singular, TooLarge, Unconfirmed
from freebody.equations.topics.common import Asked, NotHere, document
from freebody.equations.topics.impact_equations import Impact, Rows, after
from freebody.equations.topics.impulse_momentum import jumps
from freebody.impact.applied_impulse import strike
from freebody.impact.impacts import NoImpact
from freebody.solve.symbols import load_words
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import ZERO, Num, Sym, is_zero, symbols

_ROUND_OFF = 1e-14
"""Of the largest rate, below which one is what is left of 0."""
_NOTHING = 1e-12
"""Of the largest number in the row and in the column of a matrix, below which one is what is left of 0."""


def impact(
    asked: Asked,
    *,
    number: int | str = 1,
    of: str | None = None,
    at: str | float | None = None,
    point: str | None = None,
    direction: Any = None,
    impulse: Any = None,
    frame: str | None = None,
) -> Document:
    """An impact of the run, or an impulse applied to the model at rest: impulses on each body, which forces give none, impulse and
    momentum, restitution, friction that slides or sticks, rates after it and impulses of joints.

    ``number``, from 1, ``of`` a contact, string or stop, ``at`` a time to count from; or the ``point`` at which an impulse is
    applied, its ``direction``, an angle from the x axis of the ``frame``, ``fixed`` or ``body``, and the ``impulse`` in N·s, for
    the numbers. Raises ``NotHere`` where there is no impact."""
    how = {"direction": direction, "impulse": impulse, "frame": frame}
    chosen = {name: value for name, value in how.items() if value is not None}
    if chosen and point is None:
        raise ValueError(f"{', '.join(chosen)}: of an applied impulse, so say its point, point=rod.end")
    mechanism, state = asked.mechanism, asked.state
    try:
        acted = mechanism.blow(int(number), of=of, at=at) if point is None else strike(mechanism, state, point, **chosen)
    except NoImpact as error:
        raise NotHere(str(error)) from None
    found, title = Impact.of(acted), f"impulse at {point}"
    if point is None:
        title = f"impact at {joined(list(acted.change.of))}" if acted.change.of else "impact of the parts that engage"
    made = [*_what(found), *_equations(found), *_restitution(found), *_answers(found), *_numbers(found)]
    return document(found.subject, title, made, list(found.nomenclature.values()))


def _what(found: Impact) -> list[Block]:
    said = "During the short impact the configuration does not change, and the velocities jump. Impulses are the integrals of forces over it."
    if found.subject.impact.given:
        said += " Before it everything is at rest."
        said += "" if found.subject.source.metadata["limits"] else " If the mechanism moved, the jumps would add to its rates."
    made: list[Block] = [Heading("Impulses on each body"), Paragraph(said)]
    for body in found.subject.free.bodies:
        loads = [load for load in found.subject.impact.acting if any(part.body == body for part in load.on)]
        # A pair of equal pushes or pulls is described as that on the body, what has a sign as it is counted.
        words = {x: load_words(x, [body] if x.kind in ("contact", "string") else ()).removeprefix("the ") for x in loads}
        words |= {x: "applied impulse" for x in loads if x.name in found.subject.impact.given}
        items: list[Words] = [
            [found.symbol(x), f", {'' if x.name in found.subject.impact.given else 'of '}the {of}"] for x, of in words.items()
        ]
        made += [Paragraph(f"On {body}:"), Bullets(items or ["no impulse"])]
    made.append(Figure(ImpulseDrawing(found.subject.impact), "Impulses, and the jumps of momentum.", "impulses"))
    missing = found.subject.impact.absent()
    return [*made, Paragraph("No impulse comes from:"), Bullets(missing)] if missing else made


def _equations(found: Impact) -> list[Block]:
    free = found.conserved()
    made: list[Block] = [Heading("Impulse and momentum")]
    if free:
        constant = (
            "In the configuration of the impact no impulse enters these balances, so the momenta are the same before and after:"
        )
        made.append(Paragraph(constant))
        made += [Equation(found.after(b.momentum), b.momentum, _title(title)) for title, b in free]
    before = ", everything was at rest before" if found.subject.impact.given else " − momentum before"
    made.append(Paragraph(f"With impulses, one equation for each coordinate, impulse = momentum after{before}:"))
    stated = found.of_coordinates()
    made += [_with_impulses(found, each) for each in stated]
    # the balances of the bodies on which impulses act that those of the coordinates do not have
    loads, said = found.subject.free, {each.title for each in stated}
    there = {c.load for each in stated for c in each.balance.contributions if not c.absent}
    kept_out = {load.symbol for i, load in enumerate(loads.loads) if load in found.forces and i not in there}
    if bodies := [body for body in loads.bodies if any(load.symbol in kept_out for load in loads.on(body))]:
        made.append(Paragraph(f"For {joined(bodies)} alone, on which impulses of joints act that do not enter those:"))
        more = [each for each in found.of_bodies() if each.balance.bodies[0] in bodies and each.title not in said]
        made += [_with_impulses(found, each) for each in more]
    return made


def _with_impulses(found: Impact, each: Stated) -> Equation:
    """A balance with its impulses, and which impulses on the bodies are not in it, and why."""
    unknown = [Sym(after(name), 1) for name in found.subject.names]
    left = presented(found.acting(each.balance), unknowns=list(found.impulses.values()))
    right = presented(found.jump(each.balance), unknowns=unknown)
    said: list[str | Side] = []
    for why, loads in dropped(found.subject, each).items():
        said += ["; " if said else "Not in this equation: ", *listed(map(found.symbol, loads)), f" ({agree(why, len(loads))})"]
    return Equation(left, right, _title(each.title), note=[*said, "."] if said else "")


def _title(title: str) -> str:
    """Of a balance of impulses: ``angular impulse about …``."""
    return title.replace("AMB", "Angular impulse and momentum").replace("LMB", "Impulse and momentum")


def _restitution(found: Impact) -> list[Block]:
    made: list[Block] = []
    for each in found.conditions():
        left, right = found.sides(each)
        if not symbols(left, right):
            continue  # the mechanism holds it by itself
        if not found.holds(each):
            made.append(Paragraph(f"At {each.name}: {found.otherwise()}."))
            continue
        back = f"{each.name} does not rebound" if each.name in found.restitution else f"Constraint {each.name}"
        made.append(Equation(left, right, back if is_zero(right) else f"{each.name} rebounds"))
    made += _friction(found)
    return [Heading("Constraints" if found.subject.impact.given else "Restitution and constraints"), *made] if made else []


def _friction(found: Impact) -> list[Block]:
    """What friction does: of what slides its law, of what sticks that it could."""
    sizes = found.sizes()
    note = "Coulomb's law, integrated over the impact: the impulse of friction has its largest size, against the sliding."
    words = "{} slides throughout the impact"
    made: list[Block] = [Equation(found.symbol(x), found.law(x), words.format(x.name), note=note) for x in found.slides]
    stuck = all(found.holds(each) for each in found.conditions())
    for normal, load in pairwise(found.forces):  # friction stands behind its normal force
        if load.kind == "friction" and stuck:
            n, f = found.symbol(normal), found.symbol(load)
            words = f"{load.name} sticks after the impact: the impulse of friction that this takes is within Coulomb's limit"
            share = [": ", f, f" is {abs(sizes[f] / sizes[n]):.3g} of ", n, "."]
            made.append(Paragraph([words, *(["."] if np.isnan(sizes[f] + sizes[n]) else share)]))
    return made


def _answers(found: Impact) -> list[Block]:
    made: list[Block] = [Heading("After the impact")]
    try:
        solved = jumps(found)
    except (TooLarge, Singular) as error:
        return [*made, Paragraph(f"No more is given symbolically: {error}."), *_matrix(found)]
    except Unconfirmed as error:
        return [*made, Paragraph(f"No more is given symbolically: {error}.")]
    rest = bool(found.subject.impact.given)  # then no rate before it stands anywhere
    there = [x for x, tree in found.zeros.items() if is_zero(tree) and not (rest and x.dots)]
    said: list[str | Side] = [piece for x in there for piece in (x, " = ")] + ["0"] * bool(there)
    for x, tree in found.zeros.items():
        said += [", " if said else "", x, " = ", tree] if not is_zero(tree) else []
    made += [Paragraph(["At this impact ", *said, "."])] if said else []
    made += equations(solved.known.items(), "From the constraints before the impact, the rates then")
    made += equations(solved.names.items(), "With")
    own = {x: tree for x, tree in solved.solution.items() if x not in solved.joints}
    made += equations(own.items(), "So" if made[1:] else "") + equations(solved.joints.items(), "and for the joints")
    return made + [Paragraph(f"The impulses of joints are not given: {solved.joints_missing}.")] * bool(solved.joints_missing)


def _matrix(found: Impact) -> list[Block]:
    """All equations together in numbers."""
    rows = Rows.of(found)
    unknowns = [Sym(after(name), 1) for name in found.subject.names] + rows.impulses
    matrix, right = rows.matrix(found)
    whole = np.column_stack([matrix, right])
    least = _NOTHING * np.minimum(np.abs(whole).max(axis=1)[:, None], np.abs(whole).max(axis=0))
    shown = [[Num(float(f"{x:.5g}")) if x else ZERO for x in row] for row in np.where(np.abs(whole) < least, 0.0, whole).tolist()]
    name = "The balances of the coordinates, then the constraints, in numbers (SI) at this impact"
    return [MatrixEquation([row[:-1] for row in shown], unknowns, [row[-1] for row in shown], name)]


def _numbers(found: Impact) -> list[Block]:
    change = found.change
    given = [Sym(symbol) for symbol in found.subject.impact.given.values()]
    small = _ROUND_OFF * max(map(abs, (*change.before.u.values(), *change.after.u.values())), default=0.0)
    before, now = ({name: u if abs(u) > small else 0.0 for name, u in each.u.items()} for each in (change.before, change.after))
    rows: list[Words] = [[Sym(name, 1), f": {before[name]:.6g} before, {u:.6g} after"] for name, u in now.items()]
    unknown = " is not determined: constraints are redundant"
    impulses: list[Words] = [[x, unknown if np.isnan(size) else f" = {size:.6g}"] for x, size in found.sizes().items()]
    where: Words = f"At t = {change.t:.6g} s, rates in m/s or rad/s:"
    if given:
        where = ["With ", given[0], f" = {found.values[given[0]]:.6g} N·s, rates in m/s or rad/s:"]
    took = f"The impulse does {-change.lost:.6g} J of work." if given else f"The impact takes {change.lost:.6g} J."
    made: list[Block] = [Heading("In numbers" if given else "In the run"), Paragraph(where), Bullets(rows)]
    if impulses:
        made += [Paragraph("Impulses in N·s, of couples in N·m·s:"), Bullets(impulses)]
    return [*made, Paragraph(took + f" {change.note}" * bool(change.note))]

"""The fewest balance equations that give one wanted quantity, symbolically, with the numbers of the state."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.document.blocks import Block, Bullets, Heading, Paragraph, Table, Words
from freebody.equations.balances.smallest import COUNT, SmallestSet, smallest_set
from freebody.equations.derivation import loop_closure
from freebody.equations.derivation.balance_text import blocks
from freebody.equations.derivation.data import Row, SymbolicState
from freebody.equations.derivation.minimal import from_search
from freebody.equations.derivation.result import Form, Printed
from freebody.solve.rich_tables import figure
from freebody.symbolic.tree import Sym


def wanted(subject: SymbolicState, name: str) -> Form:
    """The smallest set for a coordinate's acceleration, a component of a reaction, or a motion's force or torque.

    Raises ``KeyError`` for what is not unknown, ``Indeterminate``."""
    found = smallest_set(name, subject.neighbours, subject.points)
    stated = from_search(subject, list(found.equations)) if found.equations else None
    if stated is None:
        return Form.of(subject.letters, [], [*_numeric(found), *_numbers(found)])
    equations = [Printed(s.title, *s.sides, s.linear) for s in stated]
    free = [name[6:-1] for name in found.values if name.startswith("accel(")]
    moving = {x.name for equation in equations for x in equation.linear.coefficients if x.dots}
    rows = loop_closure.followers(subject.rows, free, moving)
    form = Form.of(subject.letters, equations + loop_closure.printed(rows), [])
    made: list[Block] = [Heading("Balance equations"), Paragraph(_introduction(found))]
    for s in stated:
        made += blocks(subject, s)
    made += _following(subject, form, free, rows)
    return Form(form.equations, (*made, *_numbers(found)), form.system, form.reactions)


def _following(subject: SymbolicState, form: Form, free: Sequence[str], rows: Sequence[Row]) -> list[Block]:
    """The accelerations in the equations that are not unknown: what is closed or prescribed gives them."""
    if not rows:
        return []
    several = [x for x in form.system.unknowns if x.dots and x.name not in free]
    ones = [x for x in form.system.unknowns if x.dots and x.name in free]
    verb, none = ("follows", "is no unknown of its own") if len(several) == 1 else ("follow", "are no unknowns of their own")
    source = [" from ", *_listed(ones)] if ones else []
    said = [*_listed(several), f" {none}: {'it' if len(several) == 1 else 'they'} {verb}", *source]
    said.append(f", since {loop_closure.what(rows)}:")
    names = [c["name"] for c in subject.coordinates]
    return [Heading("Accelerations that follow"), Paragraph(said), *loop_closure.accelerations(rows, names)]


def _listed(letters: Sequence[Sym]) -> list:
    """``a, b and c``."""
    last = len(letters) - 1
    return [piece for i, x in enumerate(letters) for piece in (*([" and " if i == last else ", "] if i else []), x)]


def _introduction(found: SmallestSet) -> Words:
    number = len(found.equations)
    names = _listed([_letter(name) for name in found.values])
    if number == 1:
        return ["One balance equation gives ", *names, " by itself; no other unknown is in it."]
    count = COUNT[number].capitalize()
    return [
        f"{count} balance equations contain ", *names, " and no other unknown; no smaller set determines ", _letter(found.wanted), "."
    ]  # fmt: skip


def _letter(name: str) -> Sym:
    return Sym(name[6:-1], 2) if name.startswith("accel(") else Sym(name)


def _shown(name: str) -> str:
    return f"the acceleration of {name[6:-1]}" if name.startswith("accel(") else name


def _numeric(found: SmallestSet) -> list[Block]:
    """A set that has no letters, as numbers."""
    if found.virtual:
        moves = [
            f"{body}: its mass centre moves with ({figure(x)}, {figure(y)}), it turns with {figure(turn)}"
            for body, (x, y, turn) in found.virtual.motion.items()
        ]
        said = f"{_shown(found.wanted)} takes more than four balance equations. One of virtual power gives it: move the bodies so that "
        return [
            Heading("Virtual power"),
            Paragraph(f"{said}of all unknowns only {found.virtual.unknown} does work."),
            Bullets(moves),
        ]
    lines = [line.strip() for line in str(found).splitlines() if line.strip()]
    return [Heading("Balance equations"), Paragraph("The points of this set have no symbols; in numbers it is:"), Bullets(lines)]


def _numbers(found: SmallestSet) -> list[Block]:
    rows = [([_letter(name)], figure(value)) for name, value in found.values.items()]
    said = f"They agree with the solution of the complete system to a relative {found.check:.0e}."
    exact = "" if found.exact else " Not every set of bodies was tried: there are too many."
    return [Heading("Numbers"), Table(("unknown", "SI"), rows, "At this state:"), Paragraph(said + exact)]

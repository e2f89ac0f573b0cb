"""The fewest balance equations that give one wanted quantity, symbolically, with the numbers of the state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from freebody.document.blocks import Block, Bullets, Heading, Paragraph, Table, listed
from freebody.equations.balances.smallest import COUNT, VirtualPower, smallest_set
from freebody.equations.derivation import loop_closure, page, preamble
from freebody.equations.derivation.balance_page import FOR_A_PAGE, ROOM, fitted, lines, shown
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.form import Form
from freebody.equations.derivation.minimal import from_search
from freebody.equations.derivation.put_in import Closed
from freebody.solve.figures import figure
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.tree import Sym


def wanted(subject: SymbolicState, name: str, about: Sequence[str] = (), long: bool = False) -> Form:
    """The smallest set for a coordinate's acceleration, a component of a reaction, or a motion's force or torque; or that ``about``
    some points and directions.

    Raises ``KeyError`` for what is not unknown, ``Indeterminate``."""
    found = smallest_set(name, subject.neighbours, subject.points, about=about)
    rows = [([_symbol(each)], figure(value)) for each, value in found.values.items()]
    agrees = f"They agree with the solution of the complete system to a relative {found.check:.0e}."
    exact = "" if found.exact else " Not every set of bodies was tried: there are too many."
    numbers = [Heading("Numbers"), Table(("unknown", "SI"), rows, "At this state:"), Paragraph(agrees + exact)]
    if found.virtual:
        return replace(Form.of(subject.nomenclature, []), blocks=(*_virtual(found.virtual), *numbers))
    parts = {"momentum": False} if long else FOR_A_PAGE
    stated = [replace(s, constants=subject.constants) for s in from_search(subject, found.equations, **parts)]
    free = [x.name for x in map(_symbol, found.values) if x.dots]
    moving = {x.name for equation in stated for x in equation.linear.coefficients if x.dots}
    following = loop_closure.followers(subject.rows, free, moving)
    form = Form.of(subject.nomenclature, [*stated, *loop_closure.printed(following)])
    number, names = len(found.equations), listed(map(_symbol, found.values), " and ")
    said = ["One balance equation gives ", *names, " by itself; no other unknown is in it."]
    if number > 1:
        smaller = [] if about else ["; no smaller set determines ", _symbol(found.wanted)]
        said = [f"{COUNT[number].capitalize()} balance equations contain ", *names, " and no other unknown", *smaller, "."]
    made: list[Block] = [*[Heading("Balance equations")] * long, Paragraph(said)]
    closed = Closed(subject)
    made += [b for s in stated for b in s.blocks(subject)] if long else _page(subject, stated, closed, lines(subject, made))
    made += _following(subject, form, free, following) if following else []
    return replace(form, blocks=(*made, *numbers), symbols=[] if long else closed.symbols)


def _page(subject: SymbolicState, stated: Sequence[Stated], closed: Closed, above: int) -> list[Block]:
    """The balances below so many lines, and before them the accelerations of their bodies."""
    bodies = {body for each in stated for body in each.balance.bodies}
    named, moving = preamble.directions(subject), [m for m in subject.motions if m.body in bodies]
    opening = [*page.roots(closed), *page.kinematics(subject, closed, named, moving)]
    made = fitted(shown(subject, stated, closed, named), ROOM - above - lines(subject, opening))
    return [*page.roots(closed), *page.kinematics(subject, closed, named, moving, page.units(made)), *made]


def _following(subject: SymbolicState, form: Form, free: Sequence[str], rows: Sequence[Row]) -> list[Block]:
    """The accelerations in the equations that are not unknown: what is closed or prescribed gives them."""
    several = [x for x in form.system.unknowns if x.dots and x.name not in free]
    ones = [x for x in form.system.unknowns if x.dots and x.name in free]
    none = "is no unknown of its own: it follows" if len(several) == 1 else "are no unknowns of their own: they follow"
    source = [" from ", *listed(ones, " and ")] if ones else []
    said = [*listed(several, " and "), f" {none}", *source, f", since {loop_closure.what(rows)}:"]
    accelerations = loop_closure.accelerations(loop_closure.written(rows), subject.names)
    return [Heading("Accelerations that follow"), Paragraph(said), *accelerations]


def _symbol(name: str) -> Sym:
    return Sym(name[6:-1], 2) if name.startswith("accel(") else Sym(name)


def _virtual(found: VirtualPower) -> list[Block]:
    """The one equation of virtual power, in numbers."""
    symbol = _symbol(found.unknown)
    name = f"the acceleration of {symbol.name}" if symbol.dots else symbol.name
    said = f"{name} takes more than four balance equations. One of virtual power gives it: move the bodies so that "
    moves = [
        f"{body}: its mass centre moves with ({figure(x)}, {figure(y)}), it turns with {figure(turn)}"
        for body, (x, y, turn) in found.motion.items()
    ]
    return [Heading("Virtual power"), Paragraph(f"{said}of all unknowns only {found.unknown} does work."), Bullets(moves)]

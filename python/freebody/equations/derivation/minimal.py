"""The minimal form: as many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from freebody.core import Load
from freebody.document.blocks import Block, Bullets, Heading, Paragraph, Words
from freebody.equations.balances.equation import BalanceEquation
from freebody.equations.balances.minimal import MinimalForm, minimal_form
from freebody.equations.derivation import loop_closure, page, virtual
from freebody.equations.derivation.balance_page import FOR_A_PAGE
from freebody.equations.derivation.balance_text import Stated, is_at
from freebody.equations.derivation.coordinates import stated as of_coordinates
from freebody.equations.derivation.form import Form
from freebody.equations.derivation.put_in import Closed
from freebody.equations.derivation.sentences import clause, joined
from freebody.solve.figures import figure
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.solve.symbols import coefficient
from freebody.symbolic.tree import Sym, operations, symbols

_NOTHING = "Nothing is free to move: no equation of motion is left. The reactions are found by the form brute."
_POINTS = 2
"""Points of bodies tried for one place."""


def minimal(subject: SymbolicState, long: bool = False) -> Form:
    """The minimal form of a subject; ``long``: with all that a reader may ask for.

    In a tree these are the balances of the coordinates. With loops they are looked for among all connected sets of bodies; where
    all sets hold reactions, those with the fewest stand, and the equations of virtual power beside them."""
    rows, search = subject.rows, None
    parts = {"momentum": False} if long else FOR_A_PAGE
    if all(row.kind == "motion" for row in rows) and not any(load.follows for load in subject.free.loads):
        chosen = of_coordinates(subject, **parts)
    else:
        search = minimal_form(subject.neighbours, subject.points, forces=True)
        found = from_search(subject, search.equations, **parts)
        chosen = found if found or not search.wanted else of_coordinates(subject, **parts)
    added = _of_bearing_friction(subject, chosen, **parts)
    stated = [replace(s, label=str(i), constants=subject.constants) for i, s in enumerate([*chosen, *added], 1)]
    form = Form.of(subject.nomenclature, [*stated, *loop_closure.printed(rows)])
    if not long:
        closed = Closed(subject)
        brief = page.fitted(subject, stated, closed, _friction(subject))
        return replace(form, blocks=(*brief, *([] if stated else [Paragraph(_NOTHING)])), symbols=closed.symbols)
    made: list[Block] = loop_closure.section(rows, subject.names) if rows else []
    made += [Heading("Balance equations"), Paragraph(_introduction(subject, form, len(chosen), search)), *_friction(subject)]
    if added:
        laws = joined([symbol.name for symbol, _ in subject.laws])
        forces = joined([x.name for s in added for x in s.balance.linear.coefficients if not x.dots])
        said = f"The friction {laws} stays, which follows from {forces} by a law that is not linear: {len(added)} more are for these."
        made.append(Paragraph(said))
    for s in stated:
        made += s.blocks(subject)
    if search and (search.stays or not search.equations) and stated:
        made += virtual.section(subject, search.wanted)
    return replace(form, blocks=tuple(made))


def from_search(subject: SymbolicState, equations: Sequence[BalanceEquation], **parts: Any) -> list[Stated]:
    """Equations that a search found, symbolically, with the ``parts`` of a question."""
    asked = [_questions(subject, equation) for equation in equations]
    found = iter(subject.balances([{**question, **parts} for questions in asked for question in questions]))
    stated = [[_stated(subject, next(found), e) for _ in questions] for questions, e in zip(asked, equations, strict=True)]
    return [min(each, key=lambda s: operations(s.balance.left) + operations(s.balance.right)) for each in stated]


def _questions(subject: SymbolicState, equation: BalanceEquation) -> list[Mapping[str, Any]]:
    """The question for an equation, and others for the same: where a loop is closed a point of either body is the place of its load."""
    question, loads = equation.question, subject.free.loads
    place = question.get("about")
    if (
        not isinstance(place, Mapping)
        or "load" not in place
        or all(row.name != loads[place["load"]].name for row in subject.rows)
    ):
        return [question]
    within = [(name, point) for name, point in subject.points.items() if point[0] in equation.bodies]
    states = [(free, free.loads[place["load"]].on[-1].point) for free in subject.neighbours]
    there = [name for name, point in within if all(is_at(free, point, at) for free, at in states)]
    return [question, *({**question, "about": {"point": name}} for name in there[:_POINTS])]


def _stated(subject: SymbolicState, balance: Balance, equation: BalanceEquation) -> Stated:
    """An equation without what the search knows to drop out, as symbols see only where loops are closed; a line by its own name."""
    gone = {name for item in equation.dropped for name in item.unknowns} & {x.name for x in balance.linear.coefficients}
    loads = subject.free.loads
    leading = {i for i, load in enumerate(loads) if load.symbol in gone}
    places = [i for i, load in enumerate(loads) if i in leading or (load.follows and load.follows[0] in leading)]
    where = equation.about if balance.turns or equation.constructed else subject.line(equation.about)
    return Stated(balance.without(places, gone), where, "about" if balance.turns else "along", "", equation.constructed)


def _of_bearing_friction(subject: SymbolicState, stated: Sequence[Stated], **parts: Any) -> list[Stated]:
    """A force balance for every force that a law of friction holds and none of the equations does: along it, of all that its joint
    carries."""
    held = {x.name for s in stated for x in s.balance.linear.coefficients}
    needed = {x.name for _, law in subject.laws for x in symbols(law)} - held

    def carried(load: Load) -> Sequence[str]:
        """The bodies that move with the coordinate of a joint; of one that closes a loop its second body."""
        own = [{"ask": "coordinate", "name": c["name"]} for c in subject.coordinates if c["joint"] == load.name]
        return subject.balances(own[:1])[0].bodies if own else [load.of[-1]]

    wanted = [(i, load) for i, load in enumerate(subject.free.loads) if load.unknown and load.symbol in needed]
    asked = [{"ask": "equation", "bodies": [*carried(load)], "along": load.axis or {"load": i}, **parts} for i, load in wanted]
    found = zip(wanted, subject.balances(asked), strict=True) if asked else []
    return [Stated(balance, load.axis or f"the line of {load.symbol}", "along") for (_, load), balance in found]


def _introduction(subject: SymbolicState, form: Form, number: int, search: MinimalForm | None) -> str:
    if not number:
        return _NOTHING
    prescribed = [load.symbol for load in subject.free.loads if load.kind == "motion" and load.symbol in form.reactions]
    leading = [name for name in form.reactions if search and name in search.frictional]
    by_law = {symbol.name for symbol, law in subject.laws for symbol in (symbol, *symbols(law))}
    others = [name for name in form.reactions if name not in (*prescribed, *leading, *by_law)]
    also = f" and one for {joined(leading)}" if leading else ""
    count = "One balance equation" if number == 1 else f"{number} balance equations, one for each degree of freedom{also},"
    kind = "other " if leading else "joint " if prescribed or by_law else ""
    said = [f"{count} free of {kind}reactions."]
    if others and search:
        found = "is" if search.least else "was found that is"
        said = [f"No set of balance equations {found} free of reactions: {search.fewest_words}."]
        if search.equations:
            said.append(f"Here {clause(others, 'stays', 'stay')}, so there {'is' if number == 1 else 'are'} {number}.")
        else:
            many = "Just as many" if search.exact and len(others) == search.least else "Some"
            said.append(f"{many} are in the balances of the coordinates: {joined(others)}.")
    if prescribed:
        known = "The accelerations of prescribed motions are known"
        said.append(f"{known}; {clause(prescribed, 'is', 'are')} unknown in their place.")
    return " ".join(said)


def _friction(subject: SymbolicState) -> list[Block]:
    """The law of the friction that follows from forces in the equations."""
    made: list[Words] = []
    for load in subject.free.loads:
        if load.follows:
            place, ratio = load.follows
            factor = coefficient(subject.source, load.name)
            size = [Sym(factor), " "] if factor else f"{figure(abs(ratio))} "
            made.append(
                [f"the friction of {load.name} is ", *size, Sym(subject.free.loads[place].symbol), ", against the sliding"]
            )
        elif load.kind == "friction" and load.path.startswith("forces.") and load.card.couple:
            mean = f"the friction of {load.name} is the coefficient times the load, against the mean of V/|V| over its area, and "
            where = "; V is the velocity of a point, r its place from the mass centre"
            made.append([mean, Sym(load.symbol), " as much, against that of r × V/|V|", where])
    return [Paragraph("As it slides now:"), Bullets(made)] if made else []

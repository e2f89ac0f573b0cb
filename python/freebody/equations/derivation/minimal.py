"""The minimal form: as many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from freebody.document.blocks import Block, Bullets, Heading, Paragraph, Words
from freebody.equations.balances.equation import BalanceEquation
from freebody.equations.balances.minimal import MinimalForm, minimal_form
from freebody.equations.derivation import bearing_friction, loop_closure, virtual
from freebody.equations.derivation.balance_text import Stated, blocks, is_at
from freebody.equations.derivation.coordinates import stated as of_coordinates
from freebody.equations.derivation.data import Balance, SymbolicState
from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.result import Form, Printed
from freebody.solve.rich_tables import figure
from freebody.solve.symbols import coefficient
from freebody.symbolic.tree import Sym, operations, symbols

_POINTS = 2
"""Points of bodies tried for one place."""


@dataclass(frozen=True)
class _Chosen:
    """The equations, and the search that they come from: None for those of the coordinates of a tree, which need none."""

    stated: list[Stated]
    search: MinimalForm | None


def minimal(subject: SymbolicState) -> Form:
    """The minimal form of a subject.

    In a tree these are the balances of the coordinates. With loops they are looked for among all connected sets of bodies; where
    all sets hold reactions, those with the fewest stand, and the equations of virtual power beside them."""
    rows = subject.rows
    chosen = _chosen(subject)
    added = bearing_friction.beside(subject, chosen.stated)
    stated = [replace(s, label=str(i)) for i, s in enumerate([*chosen.stated, *added], 1)]
    equations = [_printed(s) for s in stated]
    form = Form.of(subject.letters, equations + loop_closure.printed(rows), [])
    made: list[Block] = loop_closure.section(rows, [c["name"] for c in subject.coordinates]) if rows else []
    made += [Heading("Balance equations"), Paragraph(_introduction(subject, form, chosen)), *_friction(subject)]
    if added:
        made.append(Paragraph(bearing_friction.sentence(subject, added)))
    for s in stated:
        made += blocks(subject, s)
    if chosen.search and (chosen.search.stays or not chosen.search.equations) and stated:
        made += virtual.section(subject, chosen.search.wanted)
    return Form(form.equations, tuple(made), form.system, form.reactions)


def from_search(subject: SymbolicState, equations: list[BalanceEquation]) -> list[Stated] | None:
    """Equations that a search found, symbolically; None if one of them has no question."""
    asked = [_alike(subject, equation) for equation in equations]
    if [] in asked:
        return None
    found = iter(subject.balances([question for questions in asked for question in questions]))
    stated = [
        [_of_search(subject, next(found), equation) for _ in questions]
        for questions, equation in zip(asked, equations, strict=True)
    ]
    return [min(each, key=_length) for each in stated]


def _alike(subject: SymbolicState, equation: BalanceEquation) -> list[Mapping[str, Any]]:
    """The question for an equation, and others for the same: where a loop is closed a point of either body is the place of its load."""
    question = equation.question
    place = question and question.get("about")
    if not question or not isinstance(place, Mapping) or "load" not in place:
        return [question] if question else []
    i = place["load"]
    if all(row.name != subject.free.loads[i].name for row in subject.rows):
        return [question]
    within = [(name, point) for name, point in subject.points.items() if point[0] in equation.bodies]
    there = [name for name, point in within if all(is_at(free, point, free.loads[i].on[-1].point) for free in subject.neighbours)]
    return [question, *({**question, "about": {"point": name}} for name in there[:_POINTS])]


def _length(stated: Stated) -> int:
    return operations(stated.balance.left) + operations(stated.balance.right)


def _of_search(subject: SymbolicState, balance: Balance, equation: BalanceEquation) -> Stated:
    """What the search knows to drop out may be seen in the letters only where loops are closed."""
    gone = {name for item in equation.dropped for name in item.unknowns} & {x.name for x in balance.linear.coefficients}
    loads = subject.free.loads
    leading = {i for i, load in enumerate(loads) if load.symbol in gone}
    places = [i for i, load in enumerate(loads) if i in leading or (load.follows and load.follows[0] in leading)]
    where = "about" if balance.turns else "along"
    return Stated(balance.without(places, gone), _place(subject, equation), where, "", equation.constructed)


def _place(subject: SymbolicState, equation: BalanceEquation) -> str:
    """The point or direction of an equation, a line by its own name: ``the normal of the slope``."""
    return equation.about if equation.kind == "AMB" or equation.constructed else subject.line(equation.about)


def _chosen(subject: SymbolicState) -> _Chosen:
    has_friction = any(load.follows for load in subject.free.loads)
    if all(row.kind == "motion" for row in subject.rows) and not has_friction:
        return _Chosen(of_coordinates(subject), None)
    search = minimal_form(subject.neighbours, subject.points, forces=True)
    found = from_search(subject, list(search.equations))
    return _Chosen(found if found or not search.wanted else of_coordinates(subject), search)


def _printed(stated: Stated) -> Printed:
    return Printed(stated.title, *stated.sides, stated.linear)


def _introduction(subject: SymbolicState, form: Form, chosen: _Chosen) -> str:
    number, search = len(chosen.stated), chosen.search
    prescribed = [load.symbol for load in subject.free.loads if load.kind == "motion" and load.symbol in form.reactions]
    leading = [name for name in form.reactions if search and name in search.rubbing]
    by_law = {letter.name for letter, law in subject.laws for letter in (letter, *symbols(law))}
    others = [name for name in form.reactions if name not in (*prescribed, *leading, *by_law)]
    count = "One balance equation" if number == 1 else f"{number} balance equations"
    if not number:
        return "Nothing is free to move: no equation of motion is left. The reactions are found by the form brute."
    each = "" if number == 1 else ", one for each degree of freedom,"
    said = [f"{count}{each} free of reactions."]
    if others and search:
        said = [f"No set of balance equations is free of reactions: {search.fewest_words}."]
        said.append(
            f"Here {joined(others)} {'stays' if len(others) == 1 else 'stay'}, so there {'is' if number == 1 else 'are'} {number}."
            if search.equations
            else f"{'Just as many' if search.exact and len(others) == search.least else 'Some'} are in the balances of the coordinates: {joined(others)}."
        )
    elif leading:
        each = "" if number == 1 else f", one for each degree of freedom and one for {joined(leading)},"
        said = [f"{count}{each} free of other reactions."]
    elif prescribed or by_law:
        said = [f"{count}{each} free of joint reactions."]
    if prescribed:
        verb = "is" if len(prescribed) == 1 else "are"
        said.append(f"The accelerations of prescribed motions are known; {joined(prescribed)} {verb} unknown in their place.")
    return " ".join(said)


def _friction(subject: SymbolicState) -> list[Block]:
    """The law of the friction that follows from forces in the equations."""
    loads = subject.free.loads
    made: list[Words] = []
    for load in loads:
        if load.follows:
            place, ratio = load.follows
            factor = coefficient(subject.source, load.name)
            size = [Sym(factor), " "] if factor else f"{figure(abs(ratio))} "
            made.append([f"the friction of {load.name} is ", *size, Sym(loads[place].symbol), ", against the sliding"])
    return [Paragraph("As it slides now:"), Bullets(made)] if made else []

"""The minimal form: as many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from freebody.balances.equation import BalanceEquation
from freebody.balances.minimal import minimal_form
from freebody.balances.states import nearby
from freebody.equations.derivation import closing
from freebody.equations.derivation.balancing import Stated, blocks
from freebody.equations.derivation.coordinates import stated as of_coordinates
from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.result import Form, Printed
from freebody.equations.derivation.told import Balance, Subject
from freebody.equations.document import Block, Heading, Paragraph


def minimal(subject: Subject) -> Form:
    """The minimal form of a subject.

    In a tree these are the balances of the coordinates. With loops they are looked for among all connected sets of bodies; where
    none exist, or only about points of inertia, the balances of the coordinates stand with the reactions of what closes loops."""
    rows = subject.rows
    chosen = None if all(row.kind == "motion" for row in rows) else _searched(subject)
    stated = chosen or of_coordinates(subject)
    stated = [Stated(s.balance, s.where, s.word, str(i), s.constructed) for i, s in enumerate(stated, 1)]
    equations = [_printed(s) for s in stated]
    form = Form.of(subject.letters, equations + closing.printed(rows), [])
    made: list[Block] = closing.section(rows, [c["name"] for c in subject.coordinates]) if rows else []
    made += [Heading("Balance equations"), Paragraph(_introduction(subject, form, bool(chosen), len(stated)))]
    for s in stated:
        made += blocks(subject, s)
    return Form(form.equations, tuple(made), form.system, form.reactions)


def from_search(subject: Subject, equations: list[BalanceEquation]) -> list[Stated] | None:
    """Equations that a search found, in letters; None if one of them has no question."""
    asked = [equation.question for equation in equations]
    if any(question is None or _several(subject, question) for question in asked):
        return None
    found = subject.balances([question for question in asked if question])
    return [_of_search(subject, balance, equation) for balance, equation in zip(found, equations, strict=True)]


def _several(subject: Subject, question: Mapping[str, Any]) -> bool:
    """Whether a load that makes the point or direction acts on the group in several places, as a cable over pulleys does."""
    about, along = question.get("about"), question.get("along")
    named = about.get("meeting", ()) if isinstance(about, Mapping) else along.values() if isinstance(along, Mapping) else ()
    loads = [subject.free.loads[i] for i in named if isinstance(i, int)]
    return any(sum(part.body in question["bodies"] for part in load.on) > 1 for load in loads)


def _of_search(subject: Subject, balance: Balance, equation: BalanceEquation) -> Stated:
    gone = {name for item in equation.dropped for name in item.unknowns}
    places = [i for i, load in enumerate(subject.free.loads) if load.symbol in gone]
    return Stated(balance.without(places, gone), equation.about, "about" if balance.turns else "along", "", equation.constructed)


def _searched(subject: Subject) -> list[Stated] | None:
    found = minimal_form(nearby(subject.source, subject.state), subject.points)
    return from_search(subject, list(found.equations)) if found.equations else None


def _printed(stated: Stated) -> Printed:
    return Printed(stated.title, *stated.sides, stated.linear)


def _introduction(subject: Subject, form: Form, searched: bool, number: int) -> str:
    prescribed = [load.symbol for load in subject.free.loads if load.kind == "motion" and load.symbol in form.reactions]
    others = [name for name in form.reactions if name not in prescribed]
    count = "One balance equation" if number == 1 else f"{number} balance equations"
    if not number:
        return "There is nothing to balance."
    each = "" if number == 1 else ", one for each degree of freedom,"
    said = [f"{count}{each} in which no reaction stands."]
    if others and searched:
        more = "so there is one" if number == 1 else f"so there are {number}"
        said = [f"No set of balance equations is free of reactions: {joined(others)} cannot be kept out, {more}."]
    elif others:
        said = [f"{count}, one for each coordinate. {joined(others)} cannot be kept out: they hold what is closed above."]
    elif prescribed:
        said = [f"{count}, one for each coordinate, in which no reaction of a joint stands."]
    if prescribed:
        said.append(f"The accelerations of prescribed motions are known; {joined(prescribed)} is unknown in their place.")
    return " ".join(said)

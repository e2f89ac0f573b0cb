"""Brute force: three balance equations a body, and all accelerations and reactions as unknowns."""

from __future__ import annotations

from freebody.document.blocks import Block, Equation, Heading, Paragraph
from freebody.equations.derivation import loop_closure
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.result import Form, Printed


def brute(subject: SymbolicState) -> Form:
    """The form of a subject."""
    stated = _stated(subject)
    rows = subject.rows
    equations = [Printed(s.title, *s.sides, s.linear) for s in stated]
    made: list[Block] = loop_closure.section(rows, [c["name"] for c in subject.coordinates]) if rows else []
    form = Form.of(subject.letters, equations + loop_closure.printed(rows), [])
    made += [Heading("Balance equations"), Paragraph(_introduction(subject, form, len(stated)))]
    body = ""
    for s in stated:
        if s.balance.bodies[0] != body:
            body = s.balance.bodies[0]
            made.append(Heading(f"Body {body}", 3))
        made.append(Equation(*s.sides, f"{s.kind} {s.word} {s.where}", s.label))
    return Form(form.equations, tuple(made), form.system, form.reactions)


def _stated(subject: SymbolicState) -> list[Stated]:
    asked, places = [], []
    for body in subject.motions:
        asked += [{"ask": "equation", "bodies": [body.body], "along": axis} for axis in "xy"]
        places += [("x", "along"), ("y", "along")]
        if not body.particle:
            asked.append({"ask": "equation", "bodies": [body.body], "about": {"point": f"{body.body}.G"}})
            places.append(("its mass centre", "about"))
    found = subject.balances(asked)
    return [Stated(b, *place, str(i)) for i, (b, place) in enumerate(zip(found, places, strict=True), 1)]


def _introduction(subject: SymbolicState, form: Form, number: int) -> str:
    unknowns = form.system.unknowns
    moving, reactions = sum(1 for x in unknowns if x.dots), sum(1 for x in unknowns if not x.dots)
    parts = [f"{moving} acceleration{'s' * (moving != 1)}"] if moving else []
    parts += [f"{reactions} unknown force{'s' * (reactions != 1)} and couples"] if reactions else []
    said = f"Each body is cut free: {number} balance equations, three a body and two a particle"
    rows = len(form.equations) - number
    said += f", and {rows} of closure for the accelerations" * bool(rows)
    return f"{said}. Unknown are {' and '.join(parts) or 'no quantities'}."

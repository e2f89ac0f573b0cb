"""Brute force: three balance equations a body, and all accelerations and reactions as unknowns."""

from __future__ import annotations

from dataclasses import replace

from freebody.document.blocks import Equation, Heading, Paragraph
from freebody.equations.derivation import loop_closure, page, preamble
from freebody.equations.derivation.balance_page import free_body
from freebody.equations.derivation.balance_text import of_bodies
from freebody.equations.derivation.form import Form
from freebody.equations.derivation.put_in import Closed
from freebody.solve.symbolic_state import SymbolicState


def brute(subject: SymbolicState, long: bool = False) -> Form:
    """The form of a subject; ``long``: with all that a reader may ask for."""
    stated = [replace(s, label=str(i)) for i, s in enumerate(of_bodies(subject, "its mass centre"), 1)]
    form = Form.of(subject.nomenclature, [*stated, *loop_closure.printed(subject.rows)])
    closed = Closed(subject)
    made = loop_closure.section(subject.rows, subject.names) if long and subject.rows else page.closure(subject, closed)
    reactions, rows = len(form.reactions), len(form.equations) - len(stated)
    moving = len(form.system.unknowns) - reactions
    parts = [f"{moving} acceleration{'s' * (moving != 1)}"] if moving else []
    parts += [f"{reactions} unknown force{'s' * (reactions != 1)} and couples"] if reactions else []
    said = f"Each body is cut free: {len(stated)} balance equations, three a body and two a particle"
    said += f", and {rows} of closure for the accelerations" * bool(rows)
    made = [
        *([] if long else page.kinematics(subject, closed, preamble.directions(subject), subject.motions)),
        *made,
        *[Heading("Balance equations")] * long,
    ]
    made.append(Paragraph(f"{said}. Unknown are {' and '.join(parts) or 'no quantities'}."))
    body = ""
    for s in stated:
        if s.balance.bodies[0] != body:
            body = s.balance.bodies[0]
            made += [Heading(f"Body {body}", 3), free_body(subject, (body,), list(subject.free.bodies).index(body) + 1)]
        made.append(Equation(*(s.sides if long else map(closed.settled, s.sides)), f"{s.kind} {s.word} {s.where}", s.label))
    return replace(form, blocks=tuple(made), symbols=[] if long else closed.symbols)

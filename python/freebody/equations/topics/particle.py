"""The equations of a particle, or of a mass centre, along i and j, and in polar coordinates about a fixed point."""

from __future__ import annotations

from freebody.core import GROUND
from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Vector, Words
from freebody.document.document import Document
from freebody.equations.topics.common import Asked, NotHere, brief, document, known, own, place_of
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.solve.symbols import load_words
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.presentation import presented
from freebody.symbolic.tree import PI, Fn, Sym, add, is_zero, minus, mul, negative, number, over, power, replace


def particle(asked: Asked, *, body: str | None = None, about: str = f"{GROUND}.O") -> Document:
    """Newton's law of a particle or a mass centre along i, j, and along e_r, e_φ about a fixed point.

    ``body``, by default the first particle, and ``about``, a point of the ground."""
    subject = asked.subject
    motions = subject.motions
    if body is None:
        body = next((motion.body for motion in motions if motion.particle), motions[0].body)
    known(body, [motion.body for motion in motions], "body")
    known(about, subject.points, "point")
    if subject.points[about][0] != GROUND:
        raise NotHere(f"{about} moves; polar coordinates are about a point of the ground")
    balances = subject.balances([{"ask": "equation", "bodies": [body], "along": axis} for axis in "xy"])
    made, more = _polar(subject, body, about, balances)
    return document(subject, f"the equations of {body}", _cartesian(subject, body, balances) + made, more)


def _cartesian(subject: SymbolicState, body: str, balances: list[Balance]) -> list[Block]:
    made: list[Block] = [Heading("Along i and j"), Paragraph(f"What acts on {body}, components along i and j:")]
    acting: list[Words] = []
    for along_x, along_y in zip(*(balance.contributions for balance in balances), strict=True):
        if not (is_zero(along_x.tree) and is_zero(along_y.tree)):
            arrow = Vector(((along_x.tree, "i"), (along_y.tree, "j")))
            acting.append([f"{load_words(subject.free.loads[along_x.load])}: ", arrow])
    made.append(Bullets(acting or ["nothing"]))
    names = ("Σ F·i = m a_x", "Σ F·j = m a_y")
    return made + [Equation(presented(b.right), b.left, name) for b, name in zip(balances, names, strict=True)]


def _polar(subject: SymbolicState, body: str, about: str, balances: list[Balance]) -> tuple[list[Block], list[SymbolEntry]]:
    place, motion = place_of(subject, about).xy, next(m for m in subject.motions if m.body == body)
    polar = [
        own(subject, "coordinate", unit, what, name, f"{name}_polar")
        for name, unit, what in (("r", "m", f"distance from {about}"), ("phi", "rad", "angle of that line from i"))
    ]
    r, phi = (symbol.name for symbol in polar)
    (x, y), forces = motion.r.xy, [b.left for b in balances]
    arm = (minus(x, place[0]), minus(y, place[1]))
    made: list[Block] = [Heading(f"Along e_r and e_φ about {about}")]
    made.append(Paragraph([Sym(r), f" is the distance of {body} from {about}, ", Sym(phi), " the angle of that line from i; "
                           "e_r points outward along it, e_φ a right angle further."]))  # fmt: skip
    along = motion.r.parts[0] if len(motion.r.parts) == 1 else None
    if along and is_zero(along.across) and (motion.r.i, motion.r.j) == place:  # along one direction that turns
        length, angle = along.along, along.angle
        unit = (Fn("cos", (angle,)), Fn("sin", (angle,)))
        if evaluate(length, subject.values, subject.tables) < 0:  # it is on the other side
            length, angle, unit = negative(length), add(angle, Sym(PI)), (negative(unit[0]), negative(unit[1]))
        made += [Equation(Sym(r), length, "Here"), Equation(Sym(phi), angle)]
    elif isinstance(x, Sym) and isinstance(y, Sym):
        length, (cos, sin), (w, out) = Sym(r), (Fn(f, (Sym(phi),)) for f in ("cos", "sin")), (Sym(phi, 1), Sym(r, 1))
        new = {
            x: add(place[0], mul(length, cos)), y: add(place[1], mul(length, sin)),
            Sym(x.name, 1): minus(mul(out, cos), mul(length, w, sin)), Sym(y.name, 1): add(mul(out, sin), mul(length, w, cos)),
        }  # fmt: skip
        made += [Equation(s, new[s], "Here" if s == x else "") for s in (x, y)]
        forces, unit = [replace(f, new) for f in forces], (cos, sin)
    else:
        made.append(Equation(power(Sym(r), 2), brief(add(power(arm[0], 2), power(arm[1], 2)), subject.nomenclature), "Here"))
        unit = (over(arm[0], Sym(r)), over(arm[1], Sym(r)))
    radial = add(mul(forces[0], unit[0]), mul(forces[1], unit[1]))
    across = add(mul(forces[1], unit[0]), negative(mul(forces[0], unit[1])))
    m, (dr, ddr), (w, alpha) = motion.mass, (Sym(r, 1), Sym(r, 2)), (Sym(phi, 1), Sym(phi, 2))
    outward = minus(ddr, mul(Sym(r), power(w, 2)))
    around = add(mul(Sym(r), alpha), mul(number(2), dr, w))
    made.append(Equation(mul(m, outward), brief(radial, subject.nomenclature), "Σ F·e_r = m (r̈ − r φ̇²)"))
    made.append(Equation(mul(m, around), brief(across, subject.nomenclature), "Σ F·e_φ = m (r φ̈ + 2 ṙ φ̇)"))
    return made, polar

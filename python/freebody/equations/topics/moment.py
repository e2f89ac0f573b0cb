"""Moment balance about a fixed point, about a moving one, and about the fixed point where the moving one is at the instant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from freebody.core import GROUND
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.document.document import Document
from freebody.equations.derivation.data import Balance, SymbolicState
from freebody.equations.topics.common import NotHere, cross, document, group_of, known, place_of, rate, rates, spread, subject_of
from freebody.symbolic.algebra import equal
from freebody.symbolic.formula import PLUS, Formula, Script, bold, dotted, typed, word
from freebody.symbolic.symbols import name_formula
from freebody.symbolic.tree import Tree, add, is_zero

if TYPE_CHECKING:
    from freebody.core import State
    from freebody.model.builder import Builder

Pair = tuple[Tree, Tree]


def moment(mechanism: Builder, state: State, *, about: str | None = None, bodies: Sequence[str] | str = ()) -> Document:
    """Moments about a fixed or a moving point: by accelerations, by dH/dt, and what a moving point adds, v × L.

    ``about`` a point, by default the first that moves, and ``bodies``, all by default."""
    subject = subject_of(mechanism, state)
    if about is not None:
        known(about, subject.points, "point")
    point = about or _first_moving(subject)
    return document(subject, f"moments about {point}", _blocks(subject, group_of(subject, bodies), point))


def _first_moving(subject: SymbolicState) -> str:
    names = subject.names
    for name, (body, _, _) in subject.points.items():
        if body != GROUND and not all(is_zero(part) for part in rates(place_of(subject, name).xy, names)):
            return name
    raise NotHere("no named point moves; give one")


def _blocks(subject: SymbolicState, group: list[str], point: str) -> list[Block]:
    names = subject.names
    questions = [{"about": {"point": point}}, {"along": "x"}, {"along": "y"}]
    of, along_x, along_y = subject.balances([{"ask": "equation", "bodies": group, **q} for q in questions])
    v = rates(of.place.xy, names)
    momentum = (along_x.momentum, along_y.momentum)
    changing = rate(of.momentum, names)
    whole = " + ".join(group or subject.free.bodies)
    made: list[Block] = [
        Heading("What acts"),
        Equation(_written("Σ M", point, typed("∑M")), of.left, f"Moments about {point} on {whole}"),
    ]
    if all(is_zero(part) for part in v):
        return [*made, *_fixed(of, point, changing)]
    return [*made, *_moving(of, point, changing, (v, momentum))]


def _fixed(of: Balance, point: str, changing: Tree) -> list[Block]:
    _agree(of.right, changing)
    return [
        Heading(f"{point} is fixed"),
        Equation(_written("H", point, typed("H")), of.momentum, "The angular momentum, Σ r × m v + I ω"),
        Equation(_written("Ḣ", point, dotted(typed("H"), 1)), of.right, "Its rate, which is Σ r × m a + I α"),
        Equation(of.left, of.right, "So Σ M = Ḣ is"),
    ]


def _moving(of: Balance, point: str, changing: Tree, moves: tuple[Pair, Pair]) -> list[Block]:
    v, momentum = moves
    extra = cross(v, momentum)
    _agree(of.right, add(changing, extra))
    relative = spread(extra)
    made: list[Block] = [
        Heading(f"By accelerations, about {point} or the fixed point where it is at the instant"),
        Paragraph("Forces and accelerations are those of the instant, so it does not matter whether the point moves: "
                  f"r is from where {point} is now to the mass centres, a are their accelerations in the fixed frame."),
        Equation(Written("Σ r × m a + I α", typed("∑", bold("r"), "×m", bold("a"), (PLUS,), "Iα")), of.right),
        Equation(of.left, of.right, "So the balance is"),
        Heading(f"By the angular momentum about {point}, which moves"),
        Equation(_written("H", point, typed("H")), spread(of.momentum), f"Σ r × m v + I ω with r from {point}, v in the fixed frame"),
        Equation(Written("dH/dt", typed(word("d"), "H/", word("d"), "t")), spread(changing), "Its derivative, r changing also because the point moves"),
        Equation(Written("v × L", typed(bold("v"), "×", bold("L"))), relative, f"v of {point} × L, the momentum of the bodies"),
    ]  # fmt: skip
    return made + [Paragraph(_verdict(point, relative))]


def _verdict(point: str, extra: Tree) -> str:
    if is_zero(extra):
        return f"Σ M = dH/dt + v × L. Here {point} moves along with the momentum, so that v × L = 0 and Σ M = dH/dt holds."
    return (
        "Σ M = dH/dt + v × L, for all values of the symbols (checked at random ones). To write Σ M = dH/dt about the moving point "
        f"would be wrong by v × L; about the fixed point where {point} is at the instant H has the same value, but its rate is "
        "dH/dt + v × L."
    )


def _agree(one: Tree, other: Tree) -> None:
    if not equal(one, other):
        raise ArithmeticError("the rate of angular momentum is not what the accelerations give")


def _written(stem: str, point: str, shown: Formula) -> Written:
    """What is about a point."""
    return Written(f"{stem}/{point}", (*shown[:-1], Script(shown[-1:], typed("/", name_formula(point)))))

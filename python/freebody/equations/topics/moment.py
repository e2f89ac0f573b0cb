"""Moment balance about a fixed point, about a moving one, and about the fixed point where the moving one is at the instant."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.core import GROUND
from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.document.document import Document
from freebody.equations.solve import Unconfirmed
from freebody.equations.topics.common import Asked, NotHere, cross, document, group_of, place_of, point_of, rates, spread
from freebody.solve.symbolic_state import Balance
from freebody.symbolic.algebra import equal
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.formula import PLUS, Formula, Script, bold, dotted, typed, word
from freebody.symbolic.symbols import name_formula
from freebody.symbolic.tree import Tree, add, is_zero


def moment(asked: Asked, *, about: str | None = None, bodies: Sequence[str] | str = ()) -> Document:
    """Moments about a fixed or a moving point: by accelerations, by dH/dt, and what a moving point adds, v × L.

    ``about`` a point, by default the first that moves, and ``bodies``, all by default."""
    subject = asked.subject
    about = about and point_of(subject, about)
    group, names = group_of(subject, bodies), subject.names
    carried = (name for name, (body, _, _) in subject.points.items() if body != GROUND)
    moving = (name for name in carried if not all(map(is_zero, rates(place_of(subject, name).xy, names))))
    if (point := about or next(moving, None)) is None:
        raise NotHere("no named point moves; give one")
    questions = [{"about": {"point": point}}, {"along": "x"}, {"along": "y"}]
    of, along_x, along_y = subject.balances([{"ask": "equation", "bodies": group, **q} for q in questions])
    v, changing = rates(of.place.xy, names), along_motion(of.momentum, names)
    extra = cross(v, (along_x.momentum, along_y.momentum))
    if not equal(of.right, add(changing, extra)):
        raise Unconfirmed("the rate of angular momentum is not what the accelerations give")
    acting = Equation(
        _written("Σ M", point, typed("∑M")), of.left, f"Moments about {point} on {' + '.join(group or subject.free.bodies)}"
    )
    made = _fixed(of, point) if all(map(is_zero, v)) else _moving(of, point, changing, spread(extra))
    return document(subject, f"moments about {point}", [Heading("What acts"), acting, *made])


def _fixed(of: Balance, point: str) -> list[Block]:
    return [
        Heading(f"{point} is fixed"),
        Equation(_written("H", point, typed("H")), of.momentum, "The angular momentum, Σ r × m v + I ω"),
        Equation(_written("Ḣ", point, dotted(typed("H"), 1)), of.right, "Its rate, which is Σ r × m a + I α"),
        Equation(of.left, of.right, "So Σ M = Ḣ is"),
    ]


def _moving(of: Balance, point: str, changing: Tree, extra: Tree) -> list[Block]:
    verdict = (
        "Σ M = dH/dt + v × L, for all values of the symbols (checked at random ones). To write Σ M = dH/dt about the moving point "
        f"would be wrong by v × L; about the fixed point where {point} is at the instant H has the same value, but its rate is "
        "dH/dt + v × L."
    )
    if is_zero(extra):
        verdict = f"Σ M = dH/dt + v × L. Here {point} moves along with the momentum, so that v × L = 0 and Σ M = dH/dt holds."
    return [
        Heading(f"By accelerations, about {point} or the fixed point where it is at the instant"),
        Paragraph("Forces and accelerations are those of the instant, so it does not matter whether the point moves: "
                  f"r is from where {point} is now to the mass centres, a are their accelerations in the fixed frame."),
        Equation(Written("Σ r × m a + I α", typed("∑", bold("r"), "×m", bold("a"), (PLUS,), "Iα")), of.right),
        Equation(of.left, of.right, "So the balance is"),
        Heading(f"By the angular momentum about {point}, which moves"),
        Equation(_written("H", point, typed("H")), spread(of.momentum), f"Σ r × m v + I ω with r from {point}, v in the fixed frame"),
        Equation(Written("dH/dt", typed(word("d"), "H/", word("d"), "t")), spread(changing), "Its derivative, r changing also because the point moves"),
        Equation(Written("v × L", typed(bold("v"), "×", bold("L"))), extra, f"v of {point} × L, the momentum of the bodies"),
        Paragraph(verdict),
    ]  # fmt: skip


def _written(stem: str, point: str, shown: Formula) -> Written:
    """What is about a point."""
    return Written(f"{stem}/{point}", (*shown[:-1], Script(shown[-1:], typed("/", name_formula(point)))))

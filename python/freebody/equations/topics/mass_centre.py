"""The mass centre of bodies: what acts on them from outside moves it, and turns them about it."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.document.blocks import Block, Equation, Heading, Written
from freebody.document.document import Document
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.topics.common import Asked, document, group_of
from freebody.symbolic.symbols import Name


def mass_centre(asked: Asked, *, bodies: Sequence[str] | str = ()) -> Document:
    """The common mass centre: where it is, how forces from outside move it, Σ F = m a_G, and turn the bodies about it, Σ M = Ḣ.

    ``bodies``, all by default."""
    subject = asked.subject
    group = group_of(subject, bodies)
    places = {"x": {"along": "x"}, "y": {"along": "y"}, "the mass centre": {"about": "centre"}}
    found = subject.balances([{"ask": "equation", "bodies": group, **place} for place in places.values()])
    made: list[Block] = [Heading("Where it is")]
    made += [Equation(Written.of(Name(axis, ("G",))), tree) for axis, tree in zip("xy", found[-1].place.xy, strict=True)]
    made.append(Heading("What moves it"))
    for number, (where, balance) in enumerate(zip(places, found, strict=True), 1):
        made += Stated(balance, where, "about" if balance.turns else "along", str(number)).blocks(subject)
    return document(subject, f"the mass centre of {' + '.join(group or subject.free.bodies)}", made)

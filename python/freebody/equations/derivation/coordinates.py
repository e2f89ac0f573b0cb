"""The balance equation of a coordinate: of the bodies that it carries, in the sense in which it moves them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from freebody.core.cards import Card, Coordinate
from freebody.core.cards import joints as cards_of
from freebody.equations.derivation.balance_text import Stated, named_place, numbers
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.symbols import unicode_name
from freebody.symbolic.tree import ZERO, Sym, is_zero


def stated(subject: SymbolicState, **parts: Any) -> list[Stated]:
    """One equation for every coordinate of the tree, with the ``parts`` of a question; no reaction of a joint of the tree is in any of
    them."""
    joints = {joint["name"]: joint for joint in subject.source.metadata["joints"]}
    own = [joints.get(c["joint"], {"type": "free", "name": c["joint"]}) for c in subject.coordinates]
    cards = [cards_of()[joint["type"]] for joint in own]
    moves = [next(m for m in card.coordinates if m.name == c["word"]) for card, c in zip(cards, subject.coordinates, strict=True)]
    asked = [_question(subject, *each) for each in zip(subject.names, own, moves, strict=True)]
    found = subject.balances([{**question, **parts} for question in asked])
    made = []
    for name, joint, card, motion, balance in zip(subject.names, own, cards, moves, found, strict=True):
        inertia = balance.linear.coefficients.get(Sym(name, 2), ZERO)
        sense = int(np.sign(evaluate(inertia, subject.values, subject.tables)))  # 0 where nothing is moved
        made.append(Stated(balance, *_place(subject, balance, joint["name"], card, motion), own=sense))
    return made


def _question(subject: SymbolicState, coordinate: str, joint: Mapping[str, Any], moves: Coordinate) -> dict[str, Any]:
    """For the balance; of a particle that carries nothing, and is moved across a line, that across the force of the joint."""
    metadata = subject.source.metadata
    if moves.across and joint.get("reaction"):
        name = joint["second"]
        particle = any(body["name"] == name and body["particle"] for body in metadata["bodies"])
        ends = [(other["first"], other is not joint and other["second"]) for other in metadata["joints"]]
        if particle and not any(name in each for each in ends):
            loads = enumerate(subject.free.loads)
            place = next(i for i, load in loads if load.kind == "joint" and load.name == joint["name"])
            return {"ask": "equation", "bodies": [name], "along": {"across": place}}
    return {"ask": "coordinate", "name": coordinate}


def _place(subject: SymbolicState, balance: Balance, joint: str, card: Card, moves: Coordinate) -> tuple[str, str]:
    """The point or direction in words, and the word before it."""
    if balance.turns:
        named = joint if card.hinged else named_place(subject, numbers(subject, balance), balance.bodies)
        touches = any(row.tangent for row in card.rows)
        return named or ("the point of contact" if touches else f"the point of {joint}"), "about"
    if card.type == "polar":
        radius, angle = [unicode_name(c["name"]) for c in subject.coordinates if c["joint"] == joint][:2]
        return (f"e_{angle}, times {radius}," if moves.across else f"e_{radius}"), "along"
    if moves.across:
        return moves.line.format(joint), "across"
    if any(map(is_zero, balance.place.xy)):  # a fixed axis, or the direction against it
        x, y = numbers(subject, balance)
        return ("−" if x + y < 0 else "") + ("x" if abs(x) > abs(y) else "y"), "along"
    return subject.lines.get(joint) or (moves.line or "the direction of {}").format(joint), "along"

"""The balance equation of a coordinate: of the bodies that it carries, in the sense in which it moves them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from freebody.core.cards import Card, Coordinate, joints
from freebody.equations.derivation.balance_text import Stated, named_place, numbers, pin
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import ZERO, Sym, is_zero


def stated(subject: SymbolicState) -> list[Stated]:
    """One equation for every coordinate of the tree; no reaction of a joint of the tree is in any of them."""
    own = [_Coordinate.of(subject, coordinate) for coordinate in subject.coordinates]
    found = subject.balances([each.question(subject) for each in own])
    made = []
    for each, balance in zip(own, found, strict=True):
        inertia = balance.linear.coefficients.get(Sym(each.name, 2), ZERO)
        sense = int(np.sign(evaluate(inertia, subject.values, subject.tables)))  # 0 where nothing is moved
        made.append(Stated(balance, *each.place(subject, balance), own=sense))
    return made


@dataclass(frozen=True)
class _Coordinate:
    """A coordinate by ``name``, the joint that has it, and the cards of both."""

    name: str
    joint: Mapping[str, Any]
    card: Card
    moves: Coordinate

    @classmethod
    def of(cls, subject: SymbolicState, coordinate: Mapping[str, Any]) -> _Coordinate:
        free = {"type": "free", "name": coordinate["joint"]}
        joint = next((j for j in subject.source.metadata["joints"] if j["name"] == coordinate["joint"]), free)
        card = joints()[joint["type"]]
        return cls(coordinate["name"], joint, card, next(c for c in card.coordinates if c.name == coordinate["word"]))

    def question(self, subject: SymbolicState) -> dict[str, Any]:
        """For the balance; of a particle that carries nothing, and is moved across a line, that across the force of the joint."""
        joint, metadata = self.joint, subject.source.metadata
        if self.moves.across and joint.get("reaction"):
            name = joint["second"]
            particle = any(body["name"] == name and body["particle"] for body in metadata["bodies"])
            carries = any(
                other["first"] == name or (other["second"] == name and other is not joint) for other in metadata["joints"]
            )
            if particle and not carries:
                loads = enumerate(subject.free.loads)
                place = next(i for i, load in loads if load.kind == "joint" and load.name == joint["name"])
                return {"ask": "equation", "bodies": [name], "along": {"across": place}}
        return {"ask": "coordinate", "name": self.name}

    def place(self, subject: SymbolicState, balance: Balance) -> tuple[str, str]:
        """The point or direction in words, and the word before it."""
        name, line = self.joint["name"], self.moves.line
        if balance.turns:
            named = pin(name) if self.card.hinged else named_place(subject, numbers(subject, balance), balance.bodies)
            touches = any(row.tangent for row in self.card.rows)
            return named or ("the point of contact" if touches else f"the point of {name}"), "about"
        if self.moves.across:
            return line.format(name), "across"
        if any(map(is_zero, balance.place.xy)):  # a fixed axis, or the direction against it
            x, y = numbers(subject, balance)
            return ("−" if x + y < 0 else "") + ("x" if abs(x) > abs(y) else "y"), "along"
        return subject.lines.get(name) or (line or "the direction of {}").format(name), "along"

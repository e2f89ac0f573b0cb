"""The balance equation of a coordinate: of the bodies that it carries, in the sense in which it moves them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from freebody.core.cards import Coordinate, joints
from freebody.equations.derivation.balance_text import Stated, named_place, numbers, pin
from freebody.equations.derivation.data import Balance, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import ZERO, Sym, is_zero


def stated(subject: SymbolicState) -> list[Stated]:
    """One equation for every coordinate of the tree; no reaction of a joint of the tree is in any of them."""
    asked = [_question(subject, coordinate) for coordinate in subject.coordinates]
    found = subject.balances(asked)
    return [
        Stated(balance, *_place(subject, coordinate, balance), own=_sense(subject, coordinate["name"], balance))
        for coordinate, balance in zip(subject.coordinates, found, strict=True)
    ]


def _sense(subject: SymbolicState, name: str, balance: Balance) -> int:
    """The sign with which the acceleration of a coordinate stands in its balance: 0 where nothing is moved."""
    inertia = balance.linear.coefficients.get(Sym(name, 2), ZERO)
    return int(np.sign(evaluate(inertia, subject.values, subject.tables)))


def _question(subject: SymbolicState, coordinate: Mapping[str, Any]) -> dict[str, Any]:
    joint = _joint(subject, coordinate)
    if _card(joint, coordinate).across and joint.get("reaction") and (carried := _particle(subject, joint)):
        return {"ask": "equation", "bodies": [carried], "along": {"across": _load(subject, joint["name"])}}
    return {"ask": "coordinate", "name": coordinate["name"]}


def _particle(subject: SymbolicState, joint: Mapping[str, Any]) -> str | None:
    """The second body of a joint, if it is a particle that carries nothing."""
    name, about = joint["second"], subject.source.about
    particle = any(body["name"] == name and body["particle"] for body in about["bodies"])
    carries = any(other["first"] == name or (other["second"] == name and other is not joint) for other in about["joints"])
    return name if particle and not carries else None


def _load(subject: SymbolicState, joint: str) -> int:
    return next(i for i, load in enumerate(subject.free.loads) if load.kind == "joint" and load.name == joint)


def _joint(subject: SymbolicState, coordinate: Mapping[str, Any]) -> Mapping[str, Any]:
    joints = subject.source.about["joints"]
    free = {"type": "free", "name": coordinate["joint"]}
    return next((joint for joint in joints if joint["name"] == coordinate["joint"]), free)


def _place(subject: SymbolicState, coordinate: Mapping[str, Any], balance: Balance) -> tuple[str, str]:
    """The point or direction in words, and the word before it."""
    joint = _joint(subject, coordinate)
    card, name = joints()[joint["type"]], joint["name"]
    if balance.turns:
        named = pin(name) if card.hinged else named_place(subject, numbers(subject, balance), balance.bodies)
        touches = any(row.tangent for row in card.rows)
        return named or ("the point of contact" if touches else f"the point of {name}"), "about"
    moves = _card(joint, coordinate)
    if moves.across:
        return moves.line.format(name), "across"
    x, y = balance.place.xy
    if is_zero(x) or is_zero(y):
        return _axis(*numbers(subject, balance)), "along"
    return subject.lines.get(name) or (moves.line or "the direction of {}").format(name), "along"


def _card(joint: Mapping[str, Any], coordinate: Mapping[str, Any]) -> Coordinate:
    return next(c for c in joints()[joint["type"]].coordinates if c.name == coordinate["word"])


def _axis(x: float, y: float) -> str:
    """A fixed axis, or the direction against it."""
    return ("−" if x + y < 0 else "") + ("x" if abs(x) > abs(y) else "y")

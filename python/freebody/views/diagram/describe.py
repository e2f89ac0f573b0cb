"""A free-body diagram in words."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from freebody.views.diagram.actions import Action

_WAYS = ("to the right", "up and to the right", "up", "up and to the left", "to the left", "down and to the left", "down",
         "down and to the right")  # fmt: skip


def described(group: Sequence[str], actions: Iterable[Action]) -> str:
    """What acts on a group, each with its letter and its direction."""
    stated = [f"{action.sign.plain} {_way(action)} on {action.body}" for action in actions]
    return f"On {' and '.join(group)} {'act' if stated else 'nothing acts'}{': ' if stated else ''}{'; '.join(stated)}."


def _way(action: Action) -> str:
    if action.turns:
        return "counter-clockwise" if action.couple > 0 else "clockwise"
    eighth = round(float(np.arctan2(action.force[1], action.force[0])) / (np.pi / 4)) % 8
    return _WAYS[eighth]

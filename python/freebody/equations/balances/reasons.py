"""Why an unknown is not in a balance equation, and what its point or direction is called, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import Load, Pair
from freebody.equations.balances.candidates import ABSENT, Candidate
from freebody.equations.balances.system import Problem

AT = 1e-9
"""Distance over length of the mechanism below which a load acts at a point."""
_SEVERAL = {
    "it is a couple, which has": "they are couples, which have",
    "its sum with its friction passes": "their sums with their friction pass",
    "its sum with its friction is": "their sums with their friction are",
    "it is": "they are",
    "it acts": "they act",
    "its line of action passes": "their lines of action pass",
    "it makes": "they make",
    "it accelerates": "they accelerate",
}


@dataclass(frozen=True)
class Dropped:
    """Unknowns that are not in an equation, and why."""

    unknowns: tuple[str, ...]
    why: str


@dataclass(frozen=True)
class Place:
    """The point (m) of a moment balance, or the unit direction of a force balance, with its name."""

    kind: str
    words: str
    at: Pair
    constructed: bool

    @property
    def short(self) -> str:
        """How a sentence after the first refers to it."""
        if not self.constructed:
            return self.words
        return "that point" if self.kind == "AMB" else "that direction"


def place_words(problem: Problem, candidate: Candidate, turns: bool) -> tuple[str, bool]:
    """The name of the point or direction of a candidate, and whether it had to be constructed."""
    if candidate.twist.pair is None:
        return candidate.twist.name, False
    first, second = (problem.unknowns[i].name for i in candidate.twist.pair)
    if not turns:
        return f"the direction in which neither {first} nor {second} has a part", True
    return f"the point where the lines of {first} and {second} meet", True


def dropped(problem: Problem, candidate: Candidate, place: Place) -> tuple[Dropped, ...]:
    """Every unknown that touches the bodies of a candidate but is not in it, those of one reason together."""
    found: dict[str, list[str]] = {}
    names = [problem.bodies[i] for i in candidate.group]
    leading = {load.follows[0] for load in problem.free.loads if load.follows}
    for i, unknown in enumerate(problem.unknowns):
        touches = np.abs(problem.systems[0].columns[i, list(candidate.group)]).max() > 0
        if touches and not candidate.support >> i & 1:
            if load := problem.load(unknown):
                why = why_absent(load, names, place, problem.length, unknown.load in leading)
            else:
                why = "makes no moment of inertia about" if place.kind == "AMB" else "accelerates no mass centre along"
                why = f"it {why} {place.short}"
            found.setdefault(why, []).append(unknown.name)
    return tuple(Dropped(tuple(of), agree(why, len(of))) for why, of in found.items())


def why_absent(load: Load, names: Sequence[str], place: Place, length: float, has_friction: bool = False) -> str:
    """Why a load is not in the balance of a group (``names``); ``length`` is the size of the mechanism, m; ``has_friction``: friction
    follows from it, and is meant with it."""
    if load.inside(names):
        return f"it is internal to {' + '.join(names)}"
    there = (np.hypot(*np.subtract(part.point, place.at)) < AT * length for part in load.on if part.body in names)
    acts_at = place.kind == "AMB" and all(there)
    if has_friction and not acts_at:
        sum_is = "passes through" if place.kind == "AMB" else "is perpendicular to"
        return f"its sum with its friction {sum_is} {place.short}"
    unit = load.unit(names, place.at if place.kind == "AMB" else (0.0, 0.0))
    if np.hypot(unit[0], unit[1]) <= ABSENT * max(1.0, abs(unit[2])):
        return "it is a couple, which has no part in a force balance"
    if place.kind == "LMB":
        return f"it is perpendicular to {place.short}"
    return f"it acts at {place.short}" if acts_at else f"its line of action passes through {place.short}"


def agree(why: str, number: int) -> str:
    """The reason in the plural where it holds of several."""
    for one, several in _SEVERAL.items() if number > 1 else ():
        if why.startswith(one + " "):
            return several + why.removeprefix(one)
    return why

"""Rigid virtual motions of a group: a turn about a point is a moment balance about it, a shift a force balance along it.

An unknown drops out of the balance if its load does no work in the motion. The motions worth trying are finite in number:
turns about points that have a name, shifts along directions that have one, and for every two unknowns the motion in which
neither does work, the turn about the point where their lines of action meet.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from freebody.balances.system import Problem
from freebody.free_body import FreeBodies, Load
from freebody.results import Array

SAME_PLACE = 1e-9
"""Distance over length of the mechanism below which two points are one."""
ONE_LINE = 1e-7
"""Size of the product of two unit wrenches below which they act along one line."""

NamedPoints = Mapping[str, tuple[str, float, float]]
"""Points of bodies: name → body, x, y in its frame (``_core.Mechanism.points``)."""


@dataclass(frozen=True)
class Twist:
    """A rigid motion by what makes it: a named point or direction, or two unknowns, by their places, that do no work in it.
    ``rank`` is 0 for the plainest; ``ask`` tells the point or direction in the words of ``_core.Mechanism.letters``."""

    name: str = ""
    pair: tuple[int, int] | None = None
    rank: int = 0
    ask: Mapping[str, Any] | None = None


Twists = list[tuple[Twist, Array]]
"""Each with its motion at every state (ns, 3): velocity x, y of the origin of the problem and turn × length."""


def named_twists(problem: Problem, points: NamedPoints) -> Twists:
    """Turns about joints, mass centres and named points; shifts along x, y and along or across what a joint holds."""
    found: Twists = []
    for name, rank, ask, places in _named_places(problem, points):
        about = (np.array(places) - problem.origin) / problem.length
        motion = np.column_stack([about[:, 1], -about[:, 0], np.ones(len(about))])
        if not any(np.abs(other - motion).max() < SAME_PLACE for _, other in found):
            found.append((Twist(name, rank=rank, ask={"about": ask}), motion))
    for name, e in (("x", (1.0, 0.0, 0.0)), ("y", (0.0, 1.0, 0.0))):
        found.append((Twist(name, rank=1, ask={"along": name}), np.tile(e, (len(problem.systems), 1))))
    return found + _joint_directions(problem)


def mass_centre(problem: Problem, group: Sequence[int]) -> tuple[Twist, Array]:
    """The turn about the mass centre of several bodies."""
    names = [problem.bodies[i] for i in group]
    about = (np.array([system.free.centre(*names) for system in problem.systems]) - problem.origin) / problem.length
    return Twist(f"the mass centre of {' + '.join(names)}", rank=3, ask={"about": "centre"}), np.column_stack(
        [about[:, 1], -about[:, 0], np.ones(len(about))]
    )


def pair_twists(columns: Array, boundary: Sequence[int]) -> Twists:
    """For every two unknowns of a boundary the motion in which neither does work. ``columns`` (ns, nu, 3)."""
    sizes = np.linalg.norm(columns, axis=2, keepdims=True)
    units = columns / np.where(sizes > 0, sizes, 1.0)
    found: Twists = []
    for j, k in combinations(boundary, 2):
        motion = np.cross(units[:, j], units[:, k])
        size = np.linalg.norm(motion, axis=1, keepdims=True)
        if size.min() > ONE_LINE:
            found.append((Twist(pair=(int(j), int(k)), rank=5), motion / size))
    return found


def _named_places(problem: Problem, points: NamedPoints) -> list[tuple[str, int, dict[str, Any], list[tuple[float, float]]]]:
    """Name, rank, how to ask for it, and place at every state, of joints, named points and mass centres."""
    joints: dict[str, int] = {}
    for i, load in enumerate(problem.free.loads):
        if load.kind in ("joint", "contact"):
            joints.setdefault(load.name, i)
    places = [(name, 0, {"load": i}, [_last_point(system.free, i) for system in problem.systems]) for name, i in joints.items()]
    for name in problem.bodies:
        places.append((f"{name}.G", 2, {"point": f"{name}.G"}, [system.free.bodies[name].G for system in problem.systems]))
    for name, (body, x, y) in points.items():
        if not name.endswith(".origin"):
            places.append((name, 2, {"point": name}, [_placed(system.free, body, x, y) for system in problem.systems]))
    return places


def _last_point(free: FreeBodies, load: int) -> tuple[float, float]:
    return free.loads[load].on[-1].point


def _placed(free: FreeBodies, body: str, x: float, y: float) -> tuple[float, float]:
    if body not in free.bodies:
        return x, y
    b = free.bodies[body]
    c, s = np.cos(b.angle), np.sin(b.angle)
    return b.at[0] + c * x - s * y, b.at[1] + s * x + c * y


def _joint_directions(problem: Problem) -> Twists:
    """Along and across the force of every unknown that has one direction of its own."""
    found: Twists = []
    for unknown in problem.unknowns:
        load = problem.load(unknown)
        if load is None or load.component in ("x", "y"):
            continue
        forces = np.array([system.free.loads[unknown.load].on[-1].force for system in problem.systems])
        size = np.linalg.norm(forces, axis=1, keepdims=True)
        if size.min() == 0:
            continue
        f = forces / size
        still = np.zeros(len(f))
        own, right_angle = _direction_words(load)
        found.append((Twist(right_angle, rank=1, ask={"along": {"across": unknown.load}}), np.column_stack([f[:, 1], -f[:, 0], still])))
        found.append((Twist(own, rank=1, ask={"along": {"load": unknown.load}}), np.column_stack([f, still])))
    return found


def _direction_words(load: Load) -> tuple[str, str]:
    """Words for the direction of a force and for the one at right angles to it."""
    if load.component == "normal force" or (load.kind == "contact" and load.symbol.endswith(".N")):
        return f"the normal of {load.name}", load.name
    return f"the line of {load.symbol}", f"the normal to {load.symbol}"

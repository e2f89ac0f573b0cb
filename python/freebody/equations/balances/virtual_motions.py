"""Rigid virtual motions of a group: a turn about a point is a moment balance about it, a shift a force balance along it.

An unknown drops out of the balance if its load does no work in the motion. The motions worth trying are finite in number:
turns about points that have a name, shifts along directions that have one, and for every two loads the motion in which
neither does work, the turn about the point where their lines of action meet. A point about which an acceleration makes no
moment, as the centre of percussion, is none that a person takes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from freebody.core import Array, FreeBodies, Load, Pair
from freebody.equations.balances.system import Problem

SAME_PLACE = 1e-9
"""Distance over length of the mechanism below which two points are one."""
ONE_LINE = 1e-7
"""Size of the product of two unit wrenches below which they act along one line."""

NamedPoints = Mapping[str, tuple[str, float, float]]
"""Points of bodies: name → body, x, y in its frame (``CompiledModel.points``)."""


@dataclass(frozen=True)
class VirtualMotion:
    """A rigid motion by what makes it: a named point or direction, or two unknown loads, by their places, that do no work in it.

    ``motion`` (ns, 3) is it at every state: velocity x, y of the origin of the problem, and turn × length. ``rank`` is 0 for the
    plainest; ``question`` is how the core is asked for the balance symbolically (``about`` or ``along``)."""

    motion: Array = field(repr=False, compare=False)
    name: str = ""
    pair: tuple[int, int] | None = None
    rank: int = 0
    question: Mapping[str, Any] | None = None


def named_motions(problem: Problem, points: NamedPoints) -> list[VirtualMotion]:
    """Turns about joints, mass centres and named points; shifts along x, y and along or across what a joint holds."""
    found: list[VirtualMotion] = []
    for turn in named_turns(problem, points):
        if not any(np.abs(other.motion - turn.motion).max() < SAME_PLACE for other in found):
            found.append(turn)
    for name, e in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
        found.append(VirtualMotion(_shift(np.tile(e, (len(problem.systems), 1))), name, rank=1, question={"along": name}))
    return found + _joint_directions(problem)


def mass_centre(problem: Problem, group: Sequence[int]) -> VirtualMotion:
    """The turn about the mass centre of several bodies; of one it has a name anyway."""
    names = [problem.bodies[i] for i in group]
    turn = _turn(problem, [system.free.centre(*names) for system in problem.systems])
    return VirtualMotion(turn, f"the mass centre of {' + '.join(names)}", rank=3, question={"about": "centre"})


def clear_shifts(problem: Problem, columns: Array, boundary: Sequence[int]) -> list[VirtualMotion]:
    """The shifts across all that one load of a boundary does to the group, be it in several places. ``columns`` (ns, nu, 3)."""
    found: list[VirtualMotion] = []
    for i in boundary:
        load, force = problem.load(problem.unknowns[i]), columns[:, i, :2]
        size = np.linalg.norm(force, axis=1, keepdims=True)
        if load is not None and size.min() > 0:
            question = {"along": {"clear": problem.unknowns[i].load}}
            found.append(
                VirtualMotion(_shift(_across(force) / size), f"the direction across {load.symbol}", rank=4, question=question)
            )
    return found


def known_shifts(problem: Problem) -> list[VirtualMotion]:
    """The shifts across every known force."""
    found: list[VirtualMotion] = []
    for i, load in enumerate(problem.free.loads):
        f = None if load.unknown else _directions(problem, i)
        if f is not None:
            words = f"the direction across {'gravity' if load.kind == 'weight' else load.name}"
            found.append(VirtualMotion(_shift(_across(f)), words, rank=4, question={"along": {"across": i}}))
    return found


def pair_motions(columns: Array, boundary: Sequence[int]) -> list[VirtualMotion]:
    """For every two loads of a boundary, by their places among the unknowns, the motion in which neither does work. ``columns`` (ns, nu, 3)."""
    sizes = np.linalg.norm(columns, axis=2, keepdims=True)
    units = columns / np.where(sizes > 0, sizes, 1.0)
    first, second = (np.array(boundary, int)[part] for part in np.triu_indices(len(boundary), 1))
    motions = np.cross(units[:, first], units[:, second]).swapaxes(0, 1)
    size = np.linalg.norm(motions, axis=2, keepdims=True)
    meet = size.min(axis=(1, 2)) > ONE_LINE
    pairs = zip(first[meet].tolist(), second[meet].tolist(), strict=True)
    return [VirtualMotion(motion, pair=pair, rank=5) for motion, pair in zip(motions[meet] / size[meet], pairs, strict=True)]


def _turn(problem: Problem, places: Sequence[Pair]) -> Array:
    """The turn about a place, which is one of these at every state."""
    about = (np.array(places) - problem.origin) / problem.length
    return np.column_stack([about[:, 1], -about[:, 0], np.ones(len(about))])


def _shift(directions: Array) -> Array:
    """The shift along a direction (ns, 2)."""
    return np.column_stack([directions, np.zeros(len(directions))])


def _across(directions: Array) -> Array:
    """The directions a right angle on."""
    return np.column_stack([-directions[:, 1], directions[:, 0]])


def named_turns(problem: Problem, points: NamedPoints) -> list[VirtualMotion]:
    """The turns about joints, mass centres and named points."""
    joints: dict[str, int] = {}
    for i, load in sorted(enumerate(problem.free.loads), key=lambda each: not each[1].axis):  # pins first
        if load.kind in ("joint", "contact"):
            joints.setdefault(load.name, i)
    rolling, states = touching(problem.free), [system.free for system in problem.systems]
    found = []
    for name, i in joints.items():
        words, turn = (
            "the point of contact" if rolling == [name] else name,
            _turn(problem, [free.loads[i].on[-1].point for free in states]),
        )
        found.append(VirtualMotion(turn, words, question={"about": {"load": i}}))
    named = {f"{body}.G": [free.bodies[body].G for free in states] for body in problem.bodies}
    for name, point in points.items():
        if not name.endswith(".origin"):
            named.setdefault(name, [placed(free, *point) for free in states])
    turns = ((name, _turn(problem, at)) for name, at in named.items())
    return found + [VirtualMotion(turn, name, rank=2, question={"about": {"point": name}}) for name, turn in turns]


def placed(free: FreeBodies, body: str, x: float, y: float) -> Pair:
    """Where a point of a body, in its frame, is."""
    if body not in free.bodies:
        return x, y
    b = free.bodies[body]
    c, s = np.cos(b.angle), np.sin(b.angle)
    return b.at[0] + c * x - s * y, b.at[1] + s * x + c * y


def _joint_directions(problem: Problem) -> list[VirtualMotion]:
    """Along and across the force of every unknown that has one direction of its own; plainer than the axes where it has friction."""
    found: list[VirtualMotion] = []
    for unknown in problem.unknowns:
        load = problem.load(unknown)
        f = None if load is None or load.axis else _directions(problem, unknown.load)
        if f is None:
            continue
        follows = (i for i, other in enumerate(problem.free.loads) if other.follows and other.follows[0] == unknown.load)
        friction = next((i for i in follows if _directions(problem, i) is not None), None)  # the friction that follows from it
        own, right_angle = _direction_words(problem, load, f)
        rank = 0 if friction is not None and np.abs(f).min() > ONE_LINE else 1
        across = {"across": unknown.load} if friction is None else {"load": friction}
        slides = -_across(f) if friction is None else _directions(problem, friction)
        found.append(VirtualMotion(_shift(slides), right_angle, rank=rank, question={"along": across}))
        found.append(VirtualMotion(_shift(f), own, rank=rank, question={"along": {"load": unknown.load}}))
    return found


def touching(free: FreeBodies) -> list[str]:
    """The names of what touches: contacts that hold, and joints that roll."""
    return list(dict.fromkeys(load.name for load in free.loads if load.kind == "contact" or load.card.tangent))


def _directions(problem: Problem, load: int) -> Array | None:
    """Unit direction of the force of a load at every state (ns, 2); None if it has no force, or several, as a cable over pulleys."""
    forces = [[part.force for part in system.free.loads[load].on] for system in problem.systems]
    if not all(on and all(map(any, on)) for on in forces):
        return None
    parts = np.array(forces)
    units = parts / np.linalg.norm(parts, axis=2, keepdims=True)
    last = units[:, -1]
    across = units[:, :, 0] * last[:, None, 1] - units[:, :, 1] * last[:, None, 0]
    return last if np.abs(across).max() < ONE_LINE else None


def _direction_words(problem: Problem, load: Load, f: Array) -> tuple[str, str]:
    """Words for the direction of a force and for the one at right angles to it."""
    if load.card.pulls:
        return load.name, f"the normal of {load.name}"
    normal, tangent = f"the normal of {load.name}", f"the tangent of {load.name}"
    if load.name in touching(problem.free):
        return (tangent, normal) if load.card.tangent else (normal, tangent)
    loads = enumerate(problem.free.loads)
    alike = [_directions(problem, i) for i, other in loads if other.path == load.path and other.unknown and not other.follows]
    if all(g is None or np.abs(f[:, 0] * g[:, 1] - f[:, 1] * g[:, 0]).max() < ONE_LINE for g in alike):
        return f"the normal of {load.name}", load.name
    return f"the line of {load.symbol}", f"the normal to {load.symbol}"

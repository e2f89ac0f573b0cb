"""The smallest set of balance equations that gives one unknown; virtual power where no small set does."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from freebody.core import FreeBodies, Indeterminate
from freebody.equations.balances.asked_for import asked_for
from freebody.equations.balances.candidates import bits, candidates, smallest
from freebody.equations.balances.equation import BalanceEquation, disagreement, equation, solved
from freebody.equations.balances.system import Problem, problem, released
from freebody.equations.balances.virtual_motions import NamedPoints
from freebody.solve.figures import figure
from freebody.solve.rich_tables import PlainText

DETERMINED = 1e-8
"""What virtual power leaves of other unknowns, relative to the one that it gives, below which it leaves nothing."""
COUNT = ("no", "one", "two", "three", "four", "five")


@dataclass(frozen=True)
class VirtualPower:
    """The virtual motion in which, of all unknowns, only one does work: one equation, ``unknown`` = ``right`` (N, N·m, m/s² or
    rad/s²). ``motion``: velocity x, y of the mass centre and turning rate of every body that moves."""

    unknown: str
    motion: Mapping[str, tuple[float, float, float]]
    right: float

    def lines(self) -> list[str]:
        """As text: how the bodies move in it, and what it gives."""
        moves = [
            f"   {body}: G moves with ({figure(vx)}, {figure(vy)}), turns with {figure(turn)}"
            for body, (vx, vy, turn) in self.motion.items()
        ]
        title = f"virtual power, in the motion in which only {self.unknown} has any"
        return [title, *moves, f"   {self.unknown} = {figure(self.right)}"]


@dataclass(frozen=True)
class SmallestSet(PlainText):
    """The fewest equations that give ``wanted``, and no more unknowns than they are.

    ``equations`` is empty where that takes more than four; ``virtual`` then is the one equation of virtual power.
    ``values``: all unknowns of the set, N, N·m, m/s², rad/s²; ``check``: their largest relative difference from the full
    solve. ``exact``: every connected set of bodies was tried; ``structural``: what drops out does so at other states, too;
    ``known_motion``: the accelerations are taken as they are.
    """

    wanted: str
    equations: tuple[BalanceEquation, ...]
    virtual: VirtualPower | None
    values: Mapping[str, float]
    check: float
    exact: bool
    structural: bool
    known_motion: bool = False

    def __str__(self) -> str:
        number, names = len(self.equations), ", ".join(self.values)
        if self.virtual:
            stated = [f"{self.wanted} takes more than four balance equations; one of virtual power gives it:"]
            stated += ["", *self.virtual.lines()]
        else:
            plural = "balance equation gives" if number == 1 else f"balance equations in {names} give"
            stated = [f"{COUNT[number].capitalize()} {plural} {self.wanted}:"]
            for i, each in enumerate(self.equations, 1):
                stated += ["", *each.lines(i)]
        stated += ["", *(f"{name} = {figure(value)}" for name, value in self.values.items())]
        stated.append(f"differs from the full solve by {self.check:.1e}")
        if self.known_motion:
            stated.append("the accelerations are taken as known")
        if not self.exact:
            stated.append("not every set of bodies was tried: there are too many")
        if not self.structural:
            stated.append("seen at this state only: something may drop out here that does not in general")
        return "\n".join(stated)

    @property
    def value(self) -> float:
        """What was wanted, N, N·m, m/s² or rad/s²."""
        return self.values[self.wanted]


def smallest_set(
    wanted: str,
    states: Sequence[FreeBodies],
    points: NamedPoints | None = None,
    known_motion: bool = False,
    about: Sequence[str] = (),
) -> SmallestSet:
    """The smallest set for ``wanted``: a coordinate (its acceleration), a component of a reaction (``A.Fx``), a motion (its
    force or torque); or a force of the model by its name, the one that makes the accelerations what they are
    (``known_motion`` then).

    ``states``: the instant, and others of the same mechanism near by, to tell what vanishes always from what vanishes there;
    ``points``: further named points; ``about``: the points and directions that are to be taken, ``("B", "B", "A")``, one for each
    equation. Raises ``KeyError`` for what is not unknown, ``Indeterminate``, ``ValueError`` where those do not give it.
    """
    if any(load.name == wanted and load.kind == "force" and not load.unknown for load in states[0].loads):
        states, known_motion = [released(state, wanted) for state in states], True
    given = problem(states, wanted.removeprefix("accel(").removesuffix(")"), known_motion)
    place = given.place(wanted)
    name = given.unknowns[place].name
    if about:
        found, exact = asked_for(given, points or {}, place, about), True
    else:
        by_support, exact = candidates(given, points or {}, counted=bits(range(len(given.unknowns))))
        accelerations = bits(i for i, unknown in enumerate(given.unknowns) if unknown.coordinate)
        found = smallest(by_support, 1 << place, accelerations)
    equations = tuple(equation(given, candidate) for candidate in found)
    virtual = None if found else virtual_power(given, place)
    values = {virtual.unknown: virtual.right} if virtual else solved(equations)
    several = len(given.systems) > 1
    return SmallestSet(name, equations, virtual, values, disagreement(given, values), exact, several, known_motion)


def virtual_power(given: Problem, place: int) -> VirtualPower:
    """The one equation that gives an unknown alone: it is released, and nothing else unknown does work.
    Raises ``Indeterminate`` where there is no such motion."""
    system, unknown = given.systems[0], given.unknowns[place]
    table = system.columns.reshape(len(given.unknowns), -1)
    sizes = np.linalg.norm(table, axis=1)
    wanted = np.zeros(len(sizes))
    wanted[place] = 1.0
    motion = np.linalg.pinv(table / sizes[:, None], rcond=DETERMINED) @ wanted / sizes[place]
    left = (table @ motion) / sizes * sizes[place] - wanted
    if np.abs(left).max() > DETERMINED:
        raise Indeterminate(f"{unknown.name} is not determined by the balances")
    moves = {}  # velocity of the mass centre and turning rate, from a motion of the origin and turn × length
    for name, (vx, vy, turn) in zip(given.bodies, motion.reshape(-1, 3), strict=True):
        rate = turn / given.length
        x, y = np.subtract(given.free.bodies[name].G, given.origin)
        move = float(vx - rate * y), float(vy + rate * x), float(rate)
        if np.abs(move).max() > DETERMINED * np.abs(motion).max():
            moves[name] = move
    return VirtualPower(unknown.name, moves, float(motion @ system.right.ravel()))

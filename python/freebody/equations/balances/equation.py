"""A balance equation as a person states it: which bodies, about which point or along which direction, what is in it."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from freebody.core import Pair
from freebody.equations.balances.candidates import Candidate
from freebody.equations.balances.reasons import Dropped, Place, dropped, place_words
from freebody.equations.balances.system import Problem
from freebody.solve.figures import figure

SMALL = 1e-3
"""Part of the largest load below which a value is held against that load, rather than against itself."""
NO_TURN = 1e-9
"""Turn of a unit motion below which it is a shift."""
ROUND_OFF = 1e-14
"""Part of the largest coefficient of an equation below which one is 0 at this state."""


@dataclass(frozen=True)
class BalanceEquation:
    """The angular (``AMB``) or linear (``LMB``) momentum balance of bodies cut free together.

    ``about`` names the point or direction, ``at`` is the place in m, or the unit direction, in the fixed axes; ``constructed``
    if it has no name in the model. Σ ``coefficients[x]`` x = ``right``, in N·m or N, where the loads stand as they act and
    the inertia that unknown accelerations call for is on their side, with a minus sign. ``dropped``: what is unknown and
    touches the bodies, but is not in the equation, each with the reason. ``question`` asks the core for the equation in
    symbols (``CompiledModel.symbolic_answers``).
    """

    kind: str
    bodies: tuple[str, ...]
    about: str
    at: Pair
    constructed: bool
    coefficients: Mapping[str, float]
    right: float
    dropped: tuple[Dropped, ...]
    question: Mapping[str, Any]

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The unknowns that stay."""
        return tuple(self.coefficients)

    @property
    def title(self) -> str:
        """Which equation it is: ``AMB about E for forearm``."""
        where = "about" if self.kind == "AMB" else "along"
        return f"{self.kind} {where} {self.about} for {' + '.join(self.bodies)}"

    def lines(self, number: int) -> list[str]:
        """As text: its bodies, its point or direction, its coefficients, what drops out and why."""
        where, unit = ("at", "N·m") if self.kind == "AMB" else ("direction", "N")
        place = f" ({where} {figure(self.at[0])}, {figure(self.at[1])})" if self.constructed else ""
        sign = -1 if all(value < 0 for value in self.coefficients.values()) else 1
        least = ROUND_OFF * max(map(abs, self.coefficients.values()), default=0.0)
        terms = []
        for name, value in self.coefficients.items():
            value = sign * value if abs(value) > least else 0.0
            size = "" if math.isclose(abs(value), 1.0, rel_tol=1e-12) else f"{figure(abs(value))} "
            terms.append(f"{'-' if value < 0 else '+'} {size}{name}")
        sides = f"{' '.join(terms).removeprefix('+ ')} = {figure(sign * self.right + 0.0)} {unit}"
        absent = [f"   {', '.join(item.unknowns)}: {item.why}" for item in self.dropped]
        return [f"{number}. {self.title}{place}", f"   {sides}", *absent]


def equation(problem: Problem, candidate: Candidate) -> BalanceEquation:
    """A candidate in SI, with its names and reasons."""
    motion = candidate.twist.motion[0]
    turn, shift = motion[2], motion[:2]
    turns = abs(turn) > NO_TURN * np.linalg.norm(motion)
    if turns:
        x, y = np.array([-shift[1], shift[0]]) / turn * problem.length + problem.origin
        factor = problem.length / turn
    else:
        factor = np.sign(shift[np.argmax(np.abs(shift))]) / np.hypot(*shift) if candidate.twist.pair else 1 / np.hypot(*shift)
        x, y = shift * factor
    names, constructed = place_words(problem, candidate, turns)
    place = Place("AMB" if turns else "LMB", names, (float(x), float(y)), constructed)
    bodies = tuple(problem.bodies[i] for i in candidate.group)
    stays = (i for i in range(len(problem.unknowns)) if candidate.support >> i & 1)
    coefficients = {problem.unknowns[i].name: float(candidate.coefficients[i] * factor) for i in stays}
    question, loads = candidate.twist.question or {}, [problem.unknowns[i].load for i in candidate.twist.pair or ()]
    if loads:
        forces = [i for i in loads if np.hypot(*problem.free.loads[i].on[-1].force) > 0]
        question = {"about": {"meeting": loads}} if turns else {"along": {"clear": forces[0]}}
    question = {"ask": "equation", "bodies": list(bodies), **question}
    gone, right = dropped(problem, candidate, place), float(candidate.right * factor)
    return BalanceEquation(place.kind, bodies, names, place.at, constructed, coefficients, right, gone, question)


def solved(equations: Sequence[BalanceEquation]) -> dict[str, float]:
    """The unknowns of a set of as many independent equations, N, N·m, m/s² or rad/s²."""
    names = list(dict.fromkeys(name for e in equations for name in e.unknowns))
    rows = np.array([[e.coefficients.get(name, 0.0) for name in names] for e in equations])
    sizes = np.abs(rows).max(axis=1)
    values = np.linalg.solve(rows / sizes[:, None], np.array([e.right for e in equations]) / sizes)
    return dict(zip(names, values.tolist(), strict=True))


def disagreement(problem: Problem, values: Mapping[str, float]) -> float:
    """Largest difference between these values and the full solve, relative to the value, or, of what is close to 0, to the
    largest load or inertia there is."""
    full = problem.systems[0].values(problem.unknowns)
    reach = np.linalg.norm(problem.systems[0].columns, axis=2).max(axis=1)
    largest = np.nanmax(np.abs(full) * reach)
    known = [(values[u.name], f, largest / r) for u, f, r in zip(problem.unknowns, full, reach, strict=True) if u.name in values]
    return max((abs(value - f) / (max(abs(f), SMALL * most) or 1.0) for value, f, most in known), default=0.0)

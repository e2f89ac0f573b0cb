"""The balances of all bodies as one linear system in what is unknown: loads, and accelerations that nothing prescribes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import GROUND, Array, FreeBodies, Indeterminate, Load, Part
from freebody.solve.perturbed_states import DEPENDENT, alike

Group = tuple[int, ...]
MOST_GROUPS = 255
"""Sets beyond which only small ones, and those that one cut leaves, are looked at: all that eight bodies can have."""


class NotUnknown(KeyError):
    """A name of nothing that is unknown; the sentence says what is."""

    def __str__(self) -> str:
        return str(self.args[0])


@dataclass(frozen=True)
class Unknown:
    """A load of unknown value, or the acceleration of a ``coordinate`` that is free to take any."""

    name: str
    load: int | None = None
    coordinate: str | None = None


@dataclass(frozen=True)
class System:
    """The balances at one state: Σ ``columns`` x = ``right``, for each body (nb, 3) force x, y and moment/length about ``origin``.

    ``columns`` (nu, nb, 3): what a unit of each unknown does; of an acceleration, the opposite of the inertia that it calls for.
    """

    free: FreeBodies
    columns: Array
    right: Array

    def values(self, unknowns: Sequence[Unknown]) -> Array:
        """The full solution, as the core has it (nu,); NaN where it is not determined."""
        return np.array(
            [self.free.accelerations[u.coordinate] if u.load is None else self.free.loads[u.load].value for u in unknowns]
        )


@dataclass(frozen=True)
class Problem:
    """A mechanism at the state asked for (first) and at others that share nothing with it but the structure."""

    bodies: tuple[str, ...]
    unknowns: tuple[Unknown, ...]
    systems: tuple[System, ...]
    origin: Array
    length: float

    @property
    def free(self) -> FreeBodies:
        """Bodies and loads at the state asked for."""
        return self.systems[0].free

    def load(self, unknown: Unknown) -> Load | None:
        """The load that an unknown is the size of."""
        return None if unknown.load is None else self.free.loads[unknown.load]

    def place(self, wanted: str) -> int:
        """Where an unknown stands, by the name of a coordinate, a motion, or a component of a reaction (``A.Fx``).
        Raises ``NotUnknown``, ``Indeterminate``."""
        found = [i for i, unknown in enumerate(self.unknowns) if wanted in (unknown.name, unknown.coordinate)]
        named = [i for i, u in enumerate(self.unknowns) if u.load is not None and self.free.loads[u.load].name == wanted]
        if found or len(named) == 1:
            [i, *_] = found or named
            load = self.load(self.unknowns[i])
            if load is not None and not load.determinate:
                raise Indeterminate(f"{load.symbol} is not determined: the joints hold the mechanism in more ways than it needs")
            return i
        if wanted in self.free.accelerations or wanted.removeprefix("accel(").removesuffix(")") in self.free.accelerations:
            raise NotUnknown(f"the acceleration of {wanted} follows from motions and loops without any balance")
        for load in self.free.loads:
            if load.follows and load.symbol == wanted:
                leader = self.free.loads[load.follows[0]].symbol
                raise NotUnknown(f"{wanted} is {load.follows[1]:g} times {leader}, by the law of friction; ask for that")
        raise NotUnknown(f"nothing unknown is called {wanted!r}; there are {', '.join(u.name for u in self.unknowns)}")


def problem(states: Sequence[FreeBodies], prefer: str | None = None, known_motion: bool = False) -> Problem:
    """The problem at ``states[0]``; the others tell structure from chance, where they have the same loads.
    ``prefer``: a coordinate whose acceleration is kept as an unknown if loops leave a choice; ``known_motion``: the
    accelerations are given, as they are."""
    first = states[0]
    same = [state for state in states if alike(state, first)]
    points = [part.point for load in first.loads for part in load.on if part.body in {*first.bodies, GROUND}]
    points += [body.G for body in first.bodies.values()]
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    origin, length = (low + high) / 2, float(np.hypot(*(high - low))) or 1.0  # moments are scaled with these
    unprescribed = [] if known_motion else _free_coordinates(same, prefer)
    accelerations = [Unknown(f"accel({name})", coordinate=name) for name in unprescribed]
    loads = [Unknown(load.symbol, load=i) for i, load in enumerate(first.loads) if load.unknown and not load.follows]
    unknowns = (*loads, *accelerations)
    systems = tuple(_system(state, unknowns, origin, length, known_motion) for state in same)
    return Problem(tuple(first.bodies), unknowns, systems, origin, length)


def released(free: FreeBodies, name: str) -> FreeBodies:
    """The same, but for a force of the model by that name, whose size is taken as unknown: that along its force, or its couple
    on its second body. Raises ``ValueError`` where it is 0, and so has no direction."""
    (i, load), *_ = ((i, load) for i, load in enumerate(free.loads) if load.name == name and load.kind == "force")
    forces = [np.hypot(*part.force) for part in load.on]
    size = max(forces) or next((part.couple for part in load.on if part.body == load.of[-1]), 0.0)
    if size == 0:
        raise ValueError(f"{name} is 0 at this instant, so the direction in which it could act is not known; give it a value")
    parts = tuple(Part(p.body, p.point, (p.force[0] / size, p.force[1] / size), p.couple / size) for p in load.on)
    freed = replace(load, unknown=True, value=float(size), on=parts)
    return replace(free, loads=(*free.loads[:i], freed, *free.loads[i + 1 :]))


def _free_coordinates(states: Sequence[FreeBodies], prefer: str | None) -> list[str]:
    """Coordinates whose accelerations motions and loops leave open, the first ones where there is a choice."""
    names = sorted(states[0].accelerations, key=lambda name: name != prefer)
    tables = [np.array([[row.coefficients[name] for name in names] for row in state.rows]) for state in states if state.rows]
    found: list[int] = []

    def adds(table: Array, column: int) -> bool:
        new = table[:, column]
        if found:
            basis, sizes, _ = np.linalg.svd(table[:, found], full_matrices=False)
            basis = basis[:, sizes > DEPENDENT * sizes[0]]
            new = new - basis @ (basis.T @ new)
        return bool(np.linalg.norm(new) > DEPENDENT * np.abs(table).max())

    for column in reversed(range(len(names)) if tables else ()):
        if all(adds(table, column) for table in tables):
            found.append(column)
    return [name for i, name in enumerate(names) if i not in found]


def _system(free: FreeBodies, unknowns: Sequence[Unknown], origin: Array, length: float, known_motion: bool) -> System:
    about, names = (origin[0], origin[1]), list(free.bodies)
    scale = np.array([1.0, 1.0, 1.0 / length])
    loads = np.array([[load.unit([name], about) for name in names] for load in free.loads]).reshape(-1, len(names), 3)
    for i, load in enumerate(free.loads):
        if load.follows:
            loads[load.follows[0]] += load.follows[1] * loads[i]
    open_to = [u.coordinate for u in unknowns if u.coordinate]
    found = [(*body.a, body.alpha) for body in free.bodies.values()]
    by_free, bias = ([], found) if known_motion else _motions(free, open_to)
    right = np.array([free.bodies[name].effective(about, bias[i]) for i, name in enumerate(names)])
    right -= sum((loads[i] for i, load in enumerate(free.loads) if not load.unknown), np.zeros_like(right))
    columns = [loads[u.load] for u in unknowns if u.load is not None]
    columns += [-np.array([free.bodies[name].effective(about, row[i]) for i, name in enumerate(names)]) for row in by_free]
    return System(free, np.array(columns) * scale, right * scale)


def _motions(free: FreeBodies, open_to: Sequence[str]) -> tuple[Array, Array]:
    """(ax, ay, α) of every body by a unit of each free acceleration (nz, nb, 3), and with all of them 0 (nb, 3)."""
    names = list(free.accelerations)
    rest = [name for name in names if name not in open_to]
    by = np.array([[body.by_accelerations[name] for body in free.bodies.values()] for name in names])
    by = by.reshape(len(names), len(free.bodies), 3)
    index = {name: i for i, name in enumerate(names)}
    bias = np.array([body.bias_acceleration for body in free.bodies.values()])
    own = by[[index[name] for name in open_to]]
    if not rest:
        return own, bias
    table = np.array([[row.coefficients[name] for name in (*rest, *open_to)] for row in free.rows])
    solve = np.linalg.pinv(table[:, : len(rest)], rcond=DEPENDENT)
    carried = by[[index[name] for name in rest]]
    bias = bias + np.einsum("r,rbk->bk", solve @ np.array([row.right for row in free.rows]), carried)
    return own - np.einsum("rz,rbk->zbk", solve @ table[:, len(rest) :], carried), bias


def groups(problem: Problem, known: bool = False) -> tuple[list[Group], bool]:
    """Connected sets of bodies, by their places, small ones first; and whether these are all. ``known``: known loads, as those
    of springs, connect as well."""
    near: dict[int, set[int]] = {i: set() for i in range(len(problem.bodies))}
    for load in problem.free.loads:
        touched = {problem.bodies.index(part.body) for part in load.on if part.body in problem.bodies}
        for body in touched if load.unknown or known else ():
            near[body] |= touched - {body}
    found = {frozenset([i]) for i in near}
    layer, every = set(found), True
    while layer and every:
        layer = {group | {other} for group in layer for body in group for other in near[body] - group} - found
        every = len(found) + len(layer) <= MOST_GROUPS
        found |= layer if every else _sides(near)
    return sorted((tuple(sorted(group)) for group in found), key=lambda group: (len(group), group)), every


def _sides(near: dict[int, set[int]]) -> set[frozenset[int]]:
    """What is left together when one joint between two bodies is cut, or nothing is."""
    sides = set()
    for cut in [set(), *({a, b} for a in near for b in near[a] if a < b)]:
        for start in near:
            found, edge = {start}, [start]
            while edge:
                body = edge.pop()
                new = {other for other in near[body] - found if {body, other} != cut}
                found |= new
                edge += new
            sides.add(frozenset(found))
    return sides

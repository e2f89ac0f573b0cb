"""Free-body diagrams as data: every load on every body at one instant, and what it gives the mass centres."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from .cards import LoadCard
from .errors import Indeterminate
from .state import Array

GROUND = "ground"
_DRIVEN = ("motion", "coupling", "lock", "force")
_POINT = 1e-12
"""Size in m below which all of a mechanism is at one point, but for round-off."""
_VANISHES = 1e-9
"""Part of the size of the mechanism below which what changes a row of lengths is round-off."""
Pair = tuple[float, float]


@dataclass(frozen=True)
class Part:
    """What one load does to one body: ``force`` (fixed axes) at ``point`` (m, fixed axes) and ``couple``, counter-clockwise;
    in N and N·m, or, of an unknown load, for each unit of its value."""

    body: str
    point: Pair
    force: Pair
    couple: float

    @property
    def idle(self) -> bool:
        """Whether it is nothing at all."""
        return not any(self.force) and not self.couple

    def wrench(self, about: Pair = (0.0, 0.0)) -> Array:
        """Force x, y and moment about a place, (3,)."""
        (x, y), (fx, fy) = np.subtract(self.point, about), self.force
        return np.array([fx, fy, self.couple + x * fy - y * fx])


@dataclass(frozen=True)
class Load:
    """One load, or one component of a reaction, and what it does to each body that it touches, ground included.

    ``symbol`` is what an expression of the model calls it (``pivot.Fx``); ``kind`` is joint, motion, coupling, lock, weight, force,
    contact, string, stop or friction; ``axis`` the fixed axis, x or y, along which it is a component of a pin's force;
    ``number`` which one it is of several of its kind that its owner has; ``of`` are its first and second body. An ``unknown`` load has a ``value`` (N or N·m; NaN
    where it is not ``determinate``) that multiplies its parts; the parts of a known one are what acts. One that ``follows``
    has a value so many times that of another load, given by its place in the list.
    """

    name: str
    path: str
    symbol: str
    kind: str
    axis: str | None
    card: LoadCard
    number: int | None
    unknown: bool
    value: float
    determinate: bool
    of: tuple[str, ...]
    on: tuple[Part, ...]
    follows: tuple[int, float] | None = None

    @property
    def component(self) -> str | None:
        """Which component of a joint's reaction it is: x, y, or its name."""
        return self.axis or (self.card.name if self.kind == "joint" else None)

    @property
    def touched(self) -> frozenset[str]:
        """The bodies it acts on or is exerted by, ground included; not one on which its parts cancel."""
        return frozenset(self.of) | {part.body for part in self.on if any(part.force) or part.couple}

    def inside(self, group: Collection[str]) -> bool:
        """Whether it acts within a group of bodies only, so that its parts add up to nothing there."""
        return len(self.touched) > 1 and self.touched <= set(group)

    def unit(self, group: Collection[str], about: Pair = (0.0, 0.0)) -> Array:
        """Resultant of its parts on a group, for each unit of its value if it is unknown: force x, y and moment (3,)."""
        return sum((part.wrench(about) for part in self.on if part.body in group), np.zeros(3))

    def acting(self, group: Collection[str], about: Pair = (0.0, 0.0)) -> Array:
        """Resultant of what acts on a group: force x, y in N and moment in N·m (3,). Raises ``Indeterminate``."""
        if not self.determinate:
            raise Indeterminate(f"{self.symbol} is not determined by the balances")
        return self.value * self.unit(group, about)


@dataclass(frozen=True)
class Body:
    """A body and its motion: mass in kg, inertia about the mass centre in kg·m²; frame origin ``at`` and ``angle``; mass
    centre ``G``, its velocity ``v`` and acceleration ``a`` in fixed axes, ``omega`` and ``alpha``; all SI.

    (a, α) = Σ ``by_accelerations[c]`` c̈ + ``bias_acceleration`` over the coordinates c of the state.
    """

    name: str
    particle: bool
    mass: float
    inertia: float
    at: Pair
    angle: float
    G: Pair
    v: Pair
    omega: float
    a: Pair
    alpha: float
    by_accelerations: Mapping[str, tuple[float, float, float]]
    bias_acceleration: tuple[float, float, float]

    def effective(self, about: Pair = (0.0, 0.0), motion: Collection[float] | None = None) -> Array:
        """The effective side of its balance, m a and its moment about a fixed place plus I α, (3,); for its own motion, or
        another ``motion`` (ax, ay, α)."""
        ax, ay, alpha = (*self.a, self.alpha) if motion is None else motion
        x, y = np.subtract(self.G, about)
        return np.array([self.mass * ax, self.mass * ay, self.inertia * alpha + self.mass * (x * ay - y * ax)])


@dataclass(frozen=True)
class Row:
    """One equation among the accelerations of the coordinates, of a loop or a prescribed motion: Σ ``coefficients[c]`` c̈ =
    ``right``."""

    name: str
    coefficients: Mapping[str, float]
    right: float


@dataclass(frozen=True)
class FreeBodies:
    """All bodies, ground left out, and all loads at an instant. For each body, and so for each group of them, the loads on it
    add up to the effective side: force to m a, moment about any fixed place to that of m a at G plus I α."""

    bodies: Mapping[str, Body]
    loads: tuple[Load, ...]
    rows: tuple[Row, ...] = ()
    accelerations: Mapping[str, float] = field(default_factory=dict)
    """Of the coordinates of the state, m/s² or rad/s²."""

    @classmethod
    def read(cls, data: Mapping[str, Any]) -> FreeBodies:
        """As the core gives them."""
        bodies = map(_body, data["bodies"])
        rows = (Row(item.get("name", ""), item["coefficients"], item["right"]) for item in data.get("rows", ()))
        loads, accelerations = tuple(map(_load, data["loads"])), data.get("accelerations", {})
        return cls({body.name: body for body in bodies}, loads, tuple(rows), accelerations)

    @cached_property
    def extent(self) -> float:
        """The size of the mechanism: how far its mass centres and the points of its loads lie apart, m; 1 m where all are in one."""
        places = [part.point for load in self.loads for part in load.on] + [body.G for body in self.bodies.values()]
        extent = float(np.hypot(*np.ptp(places, axis=0)))
        return extent if extent > _POINT else 1.0

    def units(self, coordinates: Sequence[Mapping[str, Any]]) -> Array:
        """What each coordinate is measured by, (n,): an angle by 1 rad, a length by the size of the mechanism."""
        return np.array([1.0 if c["dimension"] == "rad" else self.extent for c in coordinates])

    def usual_rate(self, coordinates: Sequence[Mapping[str, Any]], u: Array) -> float:
        """What rates are measured by at a state with the rates ``u``, 1/s: the fastest of these, or of what the accelerations and
        loads bring about within a radian or the size of the mechanism; 1/s where there is none, for any unit will do."""
        units, mass = self.units(coordinates), sum(body.mass for body in self.bodies.values())
        falls = np.abs([self.accelerations[c["name"]] for c in coordinates]) / units
        forces = [abs(load.value) * np.hypot(*part.force) for load in self.loads for part in load.on]
        own = np.nan_to_num(forces).max(initial=0.0) / (mass * self.extent) if mass else 0.0
        return float(max(np.abs(u / units).max(initial=0.0), np.sqrt(max(falls.max(initial=0.0), own))) or 1.0)

    def row_sizes(self, coordinates: Sequence[Mapping[str, Any]]) -> Array:
        """What each row is measured by, (k,): what it changes by while the coordinates do by what they are measured by; the size of
        the mechanism at a dead position, where nothing changes it."""
        table = [[row.coefficients[c["name"]] for c in coordinates] for row in self.rows]
        sizes = np.abs(np.reshape(table, (len(table), len(coordinates)))) @ self.units(coordinates)
        return np.where(sizes > _VANISHES * self.extent, sizes, self.extent)

    def on(self, *group: str) -> tuple[Load, ...]:
        """The loads on the diagram of a body, or of a group of bodies cut free together: those inside the group are left out."""
        self._known(group)
        touching = (load for load in self.loads if any(part.body in group for part in load.on))
        return tuple(load for load in touching if not load.inside(group))

    def inside(self, *group: str) -> tuple[Load, ...]:
        """The loads that the bodies of a group exert on each other."""
        self._known(group)
        return tuple(load for load in self.loads if load.inside(group))

    def effective(self, *group: str, about: Pair = (0.0, 0.0)) -> Array:
        """The effective side of a group: Σ m a, and its moment about a fixed place plus Σ I α, (3,)."""
        self._known(group)
        return sum((self.bodies[name].effective(about) for name in group), np.zeros(3))

    def acting(self, *group: str, about: Pair = (0.0, 0.0)) -> Array:
        """All that acts on a group from outside: force x, y in N and moment about a place in N·m, (3,).
        Raises ``Indeterminate`` where a load is not determined."""
        return sum((load.acting(group, about) for load in self.on(*group)), np.zeros(3))

    def data(self, *group: str) -> dict[str, Any]:
        """The diagram of a group as plain data, SI: every load with what it does to each body of the group, and the effective side
        with its moment about the mass centre. A value that is not determined is None."""
        about = self.centre(*group)
        x, y, moment = self.effective(*group, about=about)
        stated = {"force": [float(x), float(y)], "moment": float(moment), "about": list(about)}
        return {"bodies": list(group), "loads": [_load_data(load, group) for load in self.on(*group)], "effective": stated}

    def balance_gap(self, *group: str) -> float:
        """How far the loads on a group are from its effective side, relative to the largest force, and the largest moment that
        such a force could have about its mass centre."""
        about, outside = self.centre(*group), self.on(*group)
        parts = [load.acting(group, about) for load in outside] + [-self.bodies[name].effective(about) for name in group]
        reach = max((np.hypot(*np.subtract(part.point, about)) for load in outside for part in load.on), default=0.0)
        sizes, gap = np.max(np.abs(parts), axis=0), np.abs(np.sum(parts, axis=0))
        force = sizes[:2].max() or 1.0
        return float(max(gap[:2].max() / force, gap[2] / (max(sizes[2], force * reach) or 1.0)))

    def centre(self, *group: str) -> Pair:
        """Mass centre of a group; the middle of the bodies' own where they have no mass."""
        self._known(group)
        bodies = [self.bodies[name] for name in group]
        masses = [body.mass for body in bodies]
        x, y = np.average([body.G for body in bodies], axis=0, weights=masses if sum(masses) > 0 else None)
        return float(x), float(y)

    def _known(self, group: Collection[str]) -> None:
        for name in group:
            if name not in self.bodies:
                raise KeyError(f"no body is called {name!r}; there are {', '.join(self.bodies)}")


def _load_data(load: Load, group: Collection[str]) -> dict[str, Any]:
    plain = {word: getattr(load, word) for word in ("name", "symbol", "kind", "component", "unknown", "determinate")}
    on = [asdict(part) for part in load.on if part.body in group]
    return plain | {"value": load.value if load.determinate else None, "of": list(load.of), "on": on}


def _pair(values: Any) -> Pair:
    x, y = values
    return x, y


def _body(item: Mapping[str, Any]) -> Body:
    pairs = {name: _pair(item[name]) for name in ("at", "G", "v", "a")}
    plain = {name: float(item[name]) for name in ("mass", "inertia", "angle", "omega", "alpha")}
    by = {name: tuple(row) for name, row in item["by_accelerations"].items()}
    bias = tuple(item["bias"])
    return Body(name=item["name"], particle=item["particle"], by_accelerations=by, bias_acceleration=bias, **pairs, **plain)


def _load(item: Mapping[str, Any]) -> Load:
    value = 1.0 if not item["unknown"] else float("nan") if item["value"] is None else float(item["value"])
    parts = [Part(on["body"], _pair(on["point"]), _pair(on["force"]), float(on["couple"])) for on in item["on"]]
    of = tuple(item["of"])
    if item["kind"] in _DRIVEN and not all(part.idle for part in parts):
        # What drives a difference of coordinates cancels on ground, or on what carries both bodies.
        parts = [part for part in parts if not part.idle]
        of = (parts[1].body if len(parts) > 1 else GROUND, parts[0].body)
    known = not item["unknown"] or (item["determinate"] and not np.isnan(value))
    named = {name: item[name] for name in ("name", "path", "symbol", "kind", "axis", "number", "unknown")}
    named["card"] = LoadCard(**item["card"])
    follows = (item["follows"]["load"], float(item["follows"]["ratio"])) if item["follows"] else None
    return Load(value=value, determinate=known, of=of, on=tuple(parts), follows=follows, **named)

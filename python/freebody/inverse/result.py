"""What a motion takes: the forces of motors and all reactions over time, with their extremes, zeros, powers and works."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import brentq

from freebody.core import GROUND, Array, Indeterminate, State, quote
from freebody.formats import Formats, write
from freebody.inverse.actuators import Actuators, Found
from freebody.model.names import suggestion
from freebody.run.records import Window, reduce

if TYPE_CHECKING:
    from freebody.run.simulation import Run

_NONE = 1e-10
"""Part of the largest value of a curve below which a change of its sign, its mean or its integral is round-off."""


@dataclass(frozen=True)
class Motor:
    """What gives the motion: a prescribed motion, or an actuator. ``force`` and ``power`` are the expressions of its force, in
    ``unit`` (N or N*m), and of its power (W)."""

    name: str
    force: str
    power: str
    unit: str


@dataclass(frozen=True)
class Place:
    """A value of a curve, with its time in s and the value of the ``angle`` then (of the gauge over which curves are drawn)."""

    t: float
    angle: float
    value: float


@dataclass(frozen=True)
class Summary:
    """A curve in figures: all local extremes within the span and its greatest and least value, zero crossings, mean, rms."""

    greatest: Place
    least: Place
    extremes: tuple[Place, ...]
    zeros: tuple[Place, ...]
    mean: float
    rms: float


@dataclass(eq=False, repr=False)
class InverseDynamics:
    """The forces that a motion takes, at any time of its ``run``.

    ``gauge`` is the expression over which curves are drawn, that of the first motion. Where ``actuators`` give the motion, their forces
    are found at each time, and all reactions are those with them; else the prescribed motions act along their own gauges.
    """

    run: Run
    gauge: str
    actuators: Actuators | None = None
    t: Array = field(default_factory=lambda: np.empty(0))

    def __post_init__(self) -> None:
        self.t = self.t if len(self.t) else self.run.t
        self._found: dict[float, Found] = {}
        self.source = self.actuators.source if self.actuators else self.run.source
        self.name = self.source.name

    @cached_property
    def motors(self) -> dict[str, Motor]:
        """What gives the motion, by name: the actuators, or the prescribed motions."""
        if self.actuators:
            units = zip(self.actuators.names, self.actuators.units, strict=True)
            return {name: Motor(name, f"{quote(name)}.value", f"{quote(name)}.power", unit) for name, unit in units}
        return {
            m["name"]: Motor(m["name"], f"{quote(m['name'])}.force", f"{quote(m['name'])}.power", m["readings"]["force"])
            for m in self.run.metadata["motions"]
        }

    @property
    def pins(self) -> list[str]:
        """Joints that carry a load."""
        return [joint["name"] for joint in self.source.metadata["joints"] if joint["reaction"]]

    def pin_load(self, joint: str, axes: str = GROUND) -> tuple[str, str]:
        """Expressions of the force (N) of a joint on its second body, along the axes of the ground or of a body, which turn with it."""
        x, y = f"{quote(joint)}.Fx", f"{quote(joint)}.Fy"
        if axes == GROUND:
            return x, y
        if axes not in (bodies := [body["name"] for body in self.source.metadata["bodies"]]):
            raise ValueError(f"there is no body `{axes}`: {suggestion(axes, bodies, 'bodies')}")
        turn = f"angle({quote(axes)})"
        return f"{x}*cos({turn}) + {y}*sin({turn})", f"{y}*cos({turn}) - {x}*sin({turn})"

    # Anything at any time

    def found(self, t: float) -> Found:
        """What the actuators have to do at a time. Raises ``NotRealizable`` and ``Indeterminate``; ``LookupError`` without actuators."""
        if self.actuators is None:
            raise LookupError("the prescribed motions act by themselves: their forces are readings, `drive.force`")
        if t not in self._found:
            state = self.run.motion.state(t)
            names = [quote(c["name"]) for c in self.run.metadata["coordinates"]]
            wanted = self.run.motion.evaluate([f"accel({name})" for name in names], np.array([t]))[0]
            self._found[t] = self.actuators.at(State(state.p, t, state.q, state.u), wanted)
        return self._found[t]

    def values(self, texts: Sequence[str], t: Array) -> Array:
        """Expressions (nt, k) at times (nt,), NaN for what the balances do not determine."""
        if self.actuators is None:
            return self.run.motion.evaluate(texts, t)
        return np.array([self.source.evaluate(texts, self.found(float(each)).state) for each in t]).reshape(len(t), len(texts))

    def evaluate(self, text: str, t: float | Sequence[float] | Array | None = None) -> Any:
        """An expression at times within the motion (default ``t``); a single time gives a single number. Raises ``Indeterminate``."""
        times = np.ascontiguousarray(self.t if t is None else t, float).reshape(-1)
        found = self.values([text], times)[:, 0]
        if not np.isfinite(found).all():
            raise Indeterminate(f"{text!r} is not determined by the balances, or has no finite value")
        return float(found[0]) if np.isscalar(t) else found

    def __getitem__(self, text: str) -> Array:
        """An expression over ``t``."""
        return np.asarray(self.evaluate(text))

    # Figures

    @cached_property
    def window(self) -> Window:
        """The span of the motion; between its edges all is smooth."""
        return Window(self.run.edges)

    def summary(self, text: str) -> Summary:
        """An expression over the whole motion, in figures; extremes are zeros of its derivative, located to round-off."""
        signal = partial(self._signal, text)
        asked = {how: reduce(how, signal, self.window) for how in ("max", "min", "maxima", "minima", "mean", "rms")}
        local = sorted(asked["maxima"] + asked["minima"], key=lambda pair: pair[0] or 0.0)
        (greatest, least), zeros = (asked["max"][0], asked["min"][0]), [(t, 0.0) for t in self.zeros(text)]
        if greatest[1] - least[1] <= _NONE * max(abs(greatest[1]), abs(least[1])):  # constant: from the start on
            greatest, least = ((float(self.run.edges[0]), value) for _, value in (greatest, least))
        places = self._places([greatest, least, *local, *zeros])
        parted, mean, rms = 2 + len(local), asked["mean"][0][1], asked["rms"][0][1]
        return Summary(
            *places[:2], tuple(places[2:parted]), tuple(places[parted:]), mean if abs(mean) > _NONE * rms else 0.0, rms
        )

    def greatest(self, text: str) -> Place | None:
        """The greatest value of an expression; None where the balances do not determine it."""
        try:
            return self._places(reduce("max", partial(self._signal, text), self.window))[0]
        except Indeterminate:
            return None

    def zeros(self, text: str) -> list[float]:
        """Times (s) at which an expression changes its sign."""
        t = self.window.samples()
        y = self._signal(text, t)
        y = np.where(np.abs(y) > _NONE * np.abs(y).max(), y, 0.0)
        kept = np.flatnonzero(y)
        pairs = [(i, j) for i, j in pairwise(kept) if y[i] * y[j] < 0]
        return [float(brentq(lambda at: self._signal(text, np.array([at]))[0], t[i], t[j], xtol=1e-15)) for i, j in pairs]

    def integral(self, text: str) -> float:
        """The integral of an expression over the time of the motion: of a power, the work."""
        return reduce("integral", partial(self._signal, text), self.window)[0][1]

    def work(self, motor: str) -> float:
        """What a motor puts in over the motion, J."""
        power = self.motors[motor].power
        done = self.integral(power)
        return done if abs(done) > _NONE * self.integral(f"abs({power})") else 0.0

    def _signal(self, text: str, t: Array) -> Array:
        return np.asarray(self.evaluate(text, t))

    def _places(self, pairs: Sequence[tuple[float | None, float]]) -> list[Place]:
        times = np.array([t for t, _ in pairs], float)
        angles = self.run.evaluate(self.gauge, times)
        return [Place(t, angle, value) for t, angle, (_, value) in zip(times.tolist(), angles.tolist(), pairs, strict=True)]

    # What the ground feels

    @cached_property
    def weight(self) -> tuple[float, float]:
        """The weight of all bodies, N."""
        free = self.source.free_bodies(self.run.start if self.actuators is None else self.found(float(self.run.edges[0])).state)
        parts = [part.force for load in free.loads if load.kind == "weight" for part in load.on]
        x, y = np.sum(parts, axis=0) if parts else (0.0, 0.0)
        return float(x), float(y)

    @property
    def shaking(self) -> tuple[str, str, str]:
        """Expressions of the shaking force Fx, Fy (N) and moment about ``ground.O`` (N·m): all that the mechanism exerts on the
        ground, its weight and the torques of motors on the ground among it; the weight less the rates of the momenta."""
        x, y = self.weight
        return (
            f"{x!r} - rate(momentum_x())",
            f"{y!r} - rate(momentum_y())",
            f"centre_x()*({y!r}) - centre_y()*({x!r}) - rate(angular_momentum(ground.O))",
        )

    @cached_property
    def greatest_shaking(self) -> tuple[Place, Place]:
        """The largest shaking force (N), and the largest size of the shaking moment about ``ground.O`` (N·m)."""
        x, y, moment = self.shaking
        texts = (f"hypot({x}, {y})", f"abs({moment})")
        force, couple = (self._places(reduce("max", partial(self._signal, text), self.window))[0] for text in texts)
        return force, couple

    # How it was verified

    @cached_property
    def error(self) -> float:
        """The largest residual over ``t``: without actuators of the momentum balances, relative to their largest term; with them the
        difference of the accelerations that they give in forward dynamics from those wanted, relative to the largest among the terms
        that balance."""
        times = self.t[:: max(1, len(self.t) // 50)].tolist()
        if self.actuators:
            return max(self.found(t).error for t in times)
        return max(self.run.instant(t).residual for t in times)

    @property
    def verified(self) -> str:
        """How, and to what part, in words."""
        if self.actuators:
            return f"put into forward dynamics, the forces give the accelerations to {self.error:.1e} of the largest"
        return f"the balances of momentum of all bodies hold to {self.error:.1e} of their largest term"

    @property
    def free_combinations(self) -> list[str]:
        """What can be added to the forces of the actuators without a change of the motion, in words, as at the start."""
        free = self.found(float(self.run.edges[0])).free if self.actuators else np.empty((0, 0))
        return [" and ".join(parts) for parts in self.actuators.combinations(free)] if self.actuators and free.size else []

    @cached_property
    def beyond(self) -> dict[str, list[tuple[float, float]]]:
        """Where actuators would have to pass their limits, by name: the spans of time, s."""
        found: dict[str, list[tuple[float, float]]] = {}
        for name, most in (self.actuators.limits if self.actuators else {}).items():
            excess = f"abs({self.motors[name].force}) - ({most!r})*(1 + 1e-9)"
            edges = [float(self.run.edges[0]), *self.zeros(excess), float(self.run.edges[-1])]
            spans = [(a, b) for a, b in pairwise(edges) if self._signal(excess, np.array([(a + b) / 2]))[0] > 0]
            if spans:
                found[name] = spans
        return found

    # As a table

    @cached_property
    def columns(self) -> dict[str, str]:
        """The units of what is kept over ``t``, by expression: the gauge, forces and powers of the motors, reactions."""
        found = {self.gauge: self.run.unit_of(self.gauge)}
        for motor in self.motors.values():
            found |= {motor.force: motor.unit, motor.power: "W"}
        for joint in self.source.metadata["joints"]:
            parts = [("Fx", "N"), ("Fy", "N")] + [("M", "N*m")] * joint["couple"]
            found |= {f"{quote(joint['name'])}.{part}": unit for part, unit in parts if joint["reaction"]}
        return found | dict(zip(self.shaking, ("N", "N", "N*m"), strict=True))

    @cached_property
    def table(self) -> Array:
        """Values (nt, k) of the ``columns`` over ``t``; NaN where the balances do not determine them."""
        return self.values(list(self.columns), self.t)

    def to_csv(self) -> str:
        """The table as CSV, with the time first and units in the heads; empty where something is not determined."""
        shaking = dict(zip(self.shaking, ("shaking Fx", "shaking Fy", "shaking M about ground.O"), strict=True))
        heads = ["t [s]", *(f"{shaking.get(text, text)} [{unit}]" for text, unit in self.columns.items())]
        rows = [["" if np.isnan(x) else repr(x) for x in row] for row in np.column_stack([self.t, self.table]).tolist()]
        return "\n".join(",".join(row) for row in [heads, *rows]) + "\n"

    def save(self, path: str | Path) -> Path:
        """Write the table as ``.csv``."""
        return write(path, FORMATS.of(Path(path))(self))


FORMATS: Formats[Callable[[InverseDynamics], str]] = Formats("curves are written as", {".csv": InverseDynamics.to_csv})

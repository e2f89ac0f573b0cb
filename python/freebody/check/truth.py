"""True motions of a model: random states with random parameters, solved by the core, on which a statement is tried."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody import _core
from freebody.instant import State
from freebody.model.errors import Complaint
from freebody.model.start import Start, evaluate, initial_state
from freebody.model.units import Dimension
from freebody.results import Array, quote
from freebody.switched import with_dimensions

if TYPE_CHECKING:
    from freebody.model.builder import Builder

SAMPLES = 64
_TRIES = 40  # for one sample; a four-bar with random bars closes in about one of three
_PATIENCE = 3  # samples, of which one at least must be found
_ENOUGH = 8  # samples to judge by
_BALANCED = 1e-11  # largest relative residual of a state that may judge: below it is round-off, above it a bad condition
_FEW_TRIES = 8  # where a parameter is far from the model's, and states are rarer or none
_FAST = 20  # times the usual rate: beyond it a closed loop is near a dead point
_FACTOR = (0.3, 3.0)
_LOOP_FACTOR = (0.7, 1.4)  # of lengths of closed loops, which have to close
_ANGLE_FACTOR = (0.4, 1.6)  # of angles, which are not free to grow
_RTOL = 1e-7  # of runs: every state on them is solved anew, so that they need not be accurate
_NEAR = 0.15  # of the time typical of the model: a run that lasts so long stays near its start
_STEPS = 2000  # of a run, which is short
_STEP = 1e-6  # of central differences of gaps, relative to the size of the model


class NoMotion(ValueError):
    """A model, or a family of its motions, of which no true state was found."""


@dataclass(frozen=True)
class Family:
    """Which motions: ``held`` are parameters with a number of their own (SI, or an expression of others), ``numbers`` holds all
    at the model's, ``at_rest`` has all rates 0, ``at_start`` stays where the model starts, ``zeros`` lets parameters that are 0
    in the model be something else, ``gravity`` False takes it away, ``scaled`` multiplies parameters; ``vanishing`` are
    expressions of configuration and, linearly, rates that are 0."""

    held: tuple[tuple[str, float | str], ...] = ()
    numbers: bool = False
    at_rest: bool = False
    at_start: bool = False
    zeros: bool = True
    gravity: bool = True
    scaled: tuple[tuple[str, float], ...] = ()
    vanishing: tuple[str, ...] = ()


ALL = Family()
"""Every motion of the model, with every parameter free."""


@dataclass(frozen=True)
class Sample:
    """A true state; ``motion``: the run that it lies on, where what switches decides."""

    state: State
    motion: Any = None


@dataclass
class Samples:
    """True states of one family. ``values`` reads any expression of the model language on all of them."""

    core: _core.Mechanism
    samples: list[Sample]
    names: list[str]
    known: dict[str, Array] = field(default_factory=dict)
    weighed: dict[str, tuple[Array, Array]] = field(default_factory=dict)

    def __len__(self) -> int:
        return len(self.samples)

    def values(self, texts: Sequence[str]) -> dict[str, Array]:
        """Each expression on all samples, (K,); NaN where it reads a reaction that is not determined."""
        new = [text for text in dict.fromkeys(texts) if text not in self.known]
        if new:
            rows = np.array([self._row(sample, new) for sample in self.samples])
            self.known |= {text: rows[:, i] for i, text in enumerate(new)}
        return {text: self.known[text] for text in texts}

    def _row(self, sample: Sample, texts: Sequence[str]) -> Array:
        state = sample.state
        if sample.motion is not None:
            return sample.motion.evaluate(texts, np.array([state.t]))[0]
        return self.core.evaluate(texts, state.p, state.t, state.q, state.u)

    def masses(self) -> dict[str, tuple[Array, Array]]:
        """Mass (K,) in kg and moment of inertia (K,) about the mass centre in kg·m² of each body."""
        if not self.weighed:
            told = [json.loads(self.core.free_bodies(s.state.p, s.state.t, s.state.q, s.state.u))["bodies"] for s in self.samples]
            for i, body in enumerate(told[0]):
                mass, inertia = (np.array([row[i][word] or 0.0 for row in told]) for word in ("mass", "inertia"))
                self.weighed[body["name"]] = mass, inertia
        return self.weighed

    def parameters(self, k: int) -> dict[str, float]:
        """The parameters of sample ``k`` by name, SI."""
        return dict(zip(self.names, self.samples[k].state.p.tolist(), strict=True))


class Truth:
    """The true motions of a model. Families of samples are made once and kept."""

    def __init__(self, mechanism: Builder, seed: int = 0) -> None:
        lowered = mechanism.lowered()
        self.start: Start = lowered.start
        self.spec: dict[str, Any] = json.loads(json.dumps(lowered.spec))
        self.seed = seed
        self.gravity = self._parametrised_gravity()
        self.core = _core.Mechanism(json.dumps(self.spec))
        self.about = with_dimensions(json.loads(self.core.describe()), self.spec)
        self.fixed_counts = _counts(mechanism)
        self._families: dict[tuple[Family, int], Samples] = {}

    def _parametrised_gravity(self) -> str | None:
        """A gravity that is a plain number becomes a parameter, so that nothing is true by the number 9.81."""
        given = self.spec.get("gravity")
        if given is None or not all(isinstance(part, int | float) for part in given) or given[0] != 0 or given[1] == 0:
            return None
        taken = {p["name"] for p in self.spec["parameters"]} | set(self.start.coordinates)
        name = next(name for name in ("g", "gravity", "gravity_") if name not in taken)
        self.spec["parameters"] += [{"name": name, "value": -given[1], "unit": "m/s^2"}]
        self.spec["gravity"] = [0.0, f"-{name}"]
        self.start = replace(self.start, parameters=self.start.parameters | {name: Dimension(length=1, time=-2)})
        return name

    @cached_property
    def free_parameters(self) -> dict[str, float]:
        """Parameters that are plain numbers in the model, with those; the others follow from them."""
        numbers = {p["name"]: p["value"] for p in self.spec["parameters"] if isinstance(p["value"], int | float)}
        return {name: float(value) for name, value in numbers.items() if name not in self.fixed_counts}

    @cached_property
    def parameter_names(self) -> list[str]:
        """All parameters in the order of ``p``."""
        return [p["name"] for p in self.about["parameters"]]

    @cached_property
    def coordinates(self) -> list[Mapping[str, Any]]:
        """The coordinates of the state, as the core describes them."""
        return list(self.about["coordinates"])

    @cached_property
    def frictions(self) -> list[str]:
        """Free parameters that are a coefficient of friction."""
        written = [c.get(word) for c in self.spec.get("contacts", []) for word in ("friction", "static_friction")]
        written += [j.get(word) for j in self.spec["joints"] for word in ("friction", "static_friction")]
        return [name for name in self.free_parameters if name in written]

    @cached_property
    def gravities(self) -> list[str]:
        """Free parameters that stand alone in the gravity of the model."""
        parts = [str(part).strip("-() ") for part in self.spec.get("gravity") or ()]
        return [name for name in self.free_parameters if name in parts]

    # -- the model's own state

    @cached_property
    def own(self) -> Sample:
        """The state of the model at its start, after the events there."""
        words = initial_state(self.start, self.core)
        q, u, _ = self.core.assemble(words.pop("p"), 0.0, **words)
        return self._begun(State(self.core.bind({}), 0.0, q, u))

    @cached_property
    def restricted(self) -> bool:
        """Whether limits, joint friction or events at the start decide what moves, so that states must lie on runs."""
        if any(event.get("opening") for event in self.spec.get("events", [])) or self._sticky:
            return True
        state = self._first
        limits = json.loads(self.core.instant(state.p, state.t, state.q, state.u).limits)
        return any(limit["state"] != "open" for limit in limits)

    @cached_property
    def _first(self) -> State:
        return self._started({})

    @cached_property
    def _sticky(self) -> list[str]:
        return [j["name"] for j in self.spec["joints"] if j.get("friction")]

    @cached_property
    def _rubbing(self) -> list[str]:
        """The rates at which joints with friction slide."""
        first = {j["name"]: j["coordinates"][0] for j in self.about["joints"] if j["coordinates"]}
        return [f"rate({quote(first[name])})" for name in self._sticky if name in first]

    def _started(self, parameters: Mapping[str, float]) -> State:
        words = initial_state(self.start, self.core, parameters)
        p = words.pop("p")
        q, u, _ = self.core.assemble(p, 0.0, **words)
        return State(p, 0.0, q, u)

    def _begun(self, state: State) -> Sample:
        if not self.restricted:
            return Sample(state)
        return Sample(state, self._run(state, 1e-6 / self.rate))

    def _run(self, state: State, until: float) -> Any:
        return self.core.simulate(state.p, state.t, state.q, state.u, state.t + until, rtol=_RTOL, max_steps=_STEPS)

    @cached_property
    def length(self) -> float:
        """A length typical of the model, m."""
        places = json.loads(self.core.points(self.core.bind({})))
        found = [math.hypot(*_place(at)) for at in places.values()] if isinstance(places, dict) else []
        state = self._first
        found += [abs(q) for q, c in zip(state.q, self.coordinates, strict=True) if c["dimension"] == "m"]
        return max([x for x in found if x > 0], default=1.0)

    @cached_property
    def mass(self) -> float:
        """A mass typical of the model, kg."""
        return max([b["mass"] for b in self.about["bodies"] if b.get("mass")], default=1.0)

    @cached_property
    def rate(self) -> float:
        """A rate typical of the model, 1/s: what its accelerations at rest and its own rates suggest."""
        state = self._first
        sizes = np.array([1.0 if c["dimension"] == "rad" else 1 / self.length for c in self.coordinates])
        try:
            solved = self.core.instant(state.p, state.t, state.q, state.u)
            found = math.sqrt(np.max(np.abs(solved.accelerations * sizes), initial=0.0))
        except _core.MotionError:
            found = 0.0
        own = float(np.max(np.abs(state.u * sizes), initial=0.0))
        return float(np.clip(max(found, own), 1e-3, 1e3)) if max(found, own) > 0 else 1.0

    # -- families

    def samples(self, family: Family = ALL, count: int = SAMPLES, fresh: int = 0) -> Samples:
        """True states of a family; ``fresh`` other than 0 gives others than before. Raises ``NoMotion``."""
        key = (family, 1000 * fresh + count)
        if key not in self._families:
            self._families[key] = Samples(self.core, self._drawn_samples(family, count, fresh), self.parameter_names)
        if not self._families[key].samples:
            raise NoMotion("no motion of this model was found that is not singular, on a limit or of another mode than its start")
        return self._families[key]

    def has(self, family: Family) -> bool:
        """Whether there are motions of a family."""
        try:
            return len(self.samples(family, _PATIENCE)) > 0
        except NoMotion:
            return False

    def _drawn_samples(self, family: Family, count: int, fresh: int) -> list[Sample]:
        """``count`` samples; none where the first ones already fail."""
        rng = np.random.default_rng([self.seed, fresh])
        found: list[Sample] = []
        for i in range(count):
            if i == _PATIENCE and not found:
                return []
            if (sample := self._sample(rng, family)) is not None:
                found.append(sample)
        return found if len(found) >= min(_ENOUGH, count) else []

    def _sample(self, rng: np.random.Generator, family: Family) -> Sample | None:
        for _ in range(_FEW_TRIES if family.scaled or family.held else _TRIES):
            try:
                values = self._parameters(rng, family)
                made = self._made(rng, values, family)
            except (_core.MotionError, _core.ModelError, Complaint, ZeroDivisionError):
                continue
            if made is not None:
                return made
        return None

    def _made(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        if self.restricted:
            return self._on_a_run(rng, values, family)
        return Sample(self._started(values)) if family.at_start else self._anywhere(rng, values, family)

    def _parameters(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        held, scaled = dict(family.held), dict(family.scaled)
        if not family.gravity:
            held |= dict.fromkeys(self.gravities, 0.0)
        drawn = {name: self._drawn(rng, name, value, family) for name, value in self.free_parameters.items()}
        numbers = {name: x for name, x in held.items() if not isinstance(x, str)}
        plain = {name: numbers.get(name, value) * scaled.get(name, 1.0) for name, value in drawn.items()}
        return plain | {name: evaluate(x, plain) for name, x in held.items() if isinstance(x, str)}

    def _drawn(self, rng: np.random.Generator, name: str, value: float, family: Family) -> float:
        dimension = self.start.parameters.get(name)
        size, sign = rng.random(), rng.choice([-1.0, 1.0])
        if family.numbers or (value == 0 and not family.zeros):
            return value
        low, high = self._factor(dimension)
        factor = low * (high / low) ** size
        return value * factor if value else sign * factor * self._unit(dimension)

    def _factor(self, dimension: Dimension | None) -> tuple[float, float]:
        """By what a parameter may differ from the model's."""
        if dimension is not None and _is_angle(dimension):
            return _ANGLE_FACTOR
        return _LOOP_FACTOR if self._shapes(dimension) else _FACTOR

    def _shapes(self, dimension: Dimension | None) -> bool:
        return self._loops > 0 and (dimension is None or (dimension.mass == 0 and dimension.time == 0))

    def shapes_loops(self, name: str) -> bool:
        """Whether a parameter may be a length of a closed loop."""
        return self._shapes(self.start.parameters.get(name))

    def _unit(self, dimension: Dimension | None) -> float:
        if dimension is None:
            return 1.0
        return self.mass**dimension.mass * self.length**dimension.length * self.rate ** (-dimension.time)

    def _anywhere(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        """A random state on the model's branch, none of whose limits is closed."""
        words = initial_state(self.start, self.core, values)
        p, t = words["p"], self._time(rng)
        own = self._first.q
        wide = self._loops == 0 or bool(words["branch"])
        spread = np.array([(math.pi if wide else 0.6) if c["dimension"] == "rad" else self.length for c in self.coordinates])
        guess = own + spread * rng.uniform(-1, 1, len(own))
        near = {c["name"]: float(x) for c, x in zip(self.coordinates, guess, strict=True)}
        rates = self._rates(rng, family)
        q, u, _ = self.core.assemble(p, t, guess=near, rates=rates, branch=words["branch"])
        for text in family.vanishing:
            q, u = self._vanished(text, State(p, t, q, u))
        solved = self.core.instant(p, t, q, u)
        if any(limit["state"] != "open" or limit["gap"] < 0 for limit in json.loads(solved.limits)):
            return None
        sizes = self.rate * np.array([1.0 if c["dimension"] == "rad" else self.length for c in self.coordinates])
        good = solved.residual < _BALANCED and np.isfinite(solved.accelerations).all() and np.all(np.abs(u) < _FAST * sizes)
        return Sample(State(p, t, q, u)) if good else None

    def _vanished(self, text: str, state: State) -> tuple[Array, Array]:
        """The nearest place, or else the nearest rates there, where an expression is 0; for mechanisms without loops."""
        if self._loops:
            raise NoMotion(f"`{text} = 0` cannot be arranged in a mechanism with closed loops")
        q, u = state.q, state.u
        for _ in range(30):
            value, slope = self._slope(text, state, q, u, 0)
            if not slope.any() or abs(value) < 1e-14:
                break
            q = q - slope * value / (slope @ slope)
        value, slope = self._slope(text, state, q, u, 1)
        return q, u - slope * value / (slope @ slope) if slope.any() else u

    def _slope(self, text: str, state: State, q: Array, u: Array, order: int) -> tuple[float, Array]:
        """The value of an expression and its gradient by coordinates (0) or rates (1)."""

        def at(dq: Array, du: Array) -> float:
            return float(self.core.evaluate([text], state.p, state.t, q + dq, u + du)[0])

        still, steps = np.zeros_like(q), _STEP * np.eye(len(q))
        if order:
            steps = steps / _STEP * self.rate
            return at(still, still), np.array([at(still, s) - at(still, still) for s in steps]) / self.rate
        return at(still, still), np.array([at(s, still) - at(-s, still) for s in steps]) / (2 * _STEP)

    @cached_property
    def _loops(self) -> int:
        return len(self.about.get("closure_coordinates", [])) + sum(1 for j in self.about["joints"] if j.get("cut"))

    def _time(self, rng: np.random.Generator) -> float:
        return 3 * rng.random() / self.rate

    @cached_property
    def freedom(self) -> int:
        """Rates that can be given at will."""
        state = self._first
        solved = self.core.instant(state.p, state.t, state.q, state.u)
        return max(int(json.loads(solved.rank)["freedom"]) - int(self.about["freedom"].get("driven", 0)), 0)

    def _rates(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        n = len(self.coordinates)
        sizes = self.rate * np.array([1.0 if c["dimension"] == "rad" else self.length for c in self.coordinates])
        drawn = sizes * rng.uniform(0.3, 1.5, n) * rng.choice([-1.0, 1.0], n)
        chosen = sorted(rng.permutation(n)[: self.freedom].tolist())
        return {self.coordinates[i]["name"]: 0.0 if family.at_rest else float(drawn[i]) for i in chosen}

    # -- states on runs

    def _on_a_run(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> Sample | None:
        """A state on a run from the model's start with random numbers and admissible rates, as long as nothing switches."""
        state = self._started(values)
        late = 0.0 if family.at_rest or family.at_start else _NEAR * rng.random() / self.rate
        if family.at_rest:
            state = State(state.p, state.t, state.q, np.zeros_like(state.u))
        elif rng.random() < 0.7 and not family.at_start:
            state = self._moving(rng, state)
        motion = self._run(state, max(late, 1e-6 / self.rate))
        ends = motion.final()[0]
        t = min(late, 0.9 * ends)
        q, u = (a[0] for a in motion.sample(np.array([t])))
        same = _same(self._mode(motion.instant(t), motion, t), self._own_mode)
        return Sample(State(state.p, t, q, u), motion) if same and motion.instant(t).residual < _BALANCED else None

    def _moving(self, rng: np.random.Generator, state: State) -> State:
        """Random rates that keep closed what is closed."""
        names, sizes = [c["name"] for c in self.coordinates], self._rates(rng, ALL)
        wanted = np.array([sizes.get(name, 0.0) for name in names])
        q, u, _ = self.core.assemble(
            state.p,
            state.t,
            guess=dict(zip(names, state.q.tolist(), strict=True)),
            rates={n: x for n, x in zip(names, wanted.tolist(), strict=True) if n in sizes},
        )
        if not np.allclose(q, state.q, atol=1e-9 * self.length):
            return state
        return State(state.p, state.t, state.q, _without(u - state.u, self._slopes(state)) + state.u)

    def _slopes(self, state: State) -> Array:
        """Gradients of the gaps that are closed, and of what sticks, a row each."""
        steps = _STEP * np.array([1.0 if c["dimension"] == "rad" else self.length for c in self.coordinates])
        closed = [i for i, limit in enumerate(self._limits(state, state.q)) if limit["state"] != "open"]
        columns = []
        for i, step in enumerate(steps):
            moved = np.zeros_like(state.q)
            moved[i] = step
            after, before = (self._limits(state, state.q + sign * moved) for sign in (1, -1))
            columns.append([(after[j]["gap"] - before[j]["gap"]) / (2 * step) for j in closed])
        return np.array(columns).T.reshape(len(closed), len(steps))

    def _limits(self, state: State, q: Array) -> list[dict[str, Any]]:
        return json.loads(self.core.instant(state.p, state.t, q, np.zeros_like(q)).limits)

    @cached_property
    def _own_mode(self) -> tuple[Any, ...]:
        state = self._first
        motion = self._run(state, 1e-3 / self.rate)
        t = motion.final()[0]
        return self._mode(motion.instant(t), motion, t)

    def _mode(self, solved: Any, motion: Any, t: float) -> tuple[Any, ...]:
        """How every limit is held, to which side it slides, and to which side every joint rubs."""
        limits = tuple(
            (x["state"], np.sign(round(x["friction"] or 0.0, 12)) if x["state"] == "sliding" else 0)
            for x in json.loads(solved.limits)
        )
        rubs = motion.evaluate(self._rubbing, np.array([t]))[0] if self._rubbing else np.empty(0)
        slow = 1e-9 * self.rate * min(self.length, 1.0)
        return (*limits, *(float(np.sign(x)) if abs(x) > slow else 0.0 for x in rubs))


def _same(a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
    """Whether two modes are one; what slides without friction does so in either sense."""

    def alike(x: Any, y: Any) -> bool:
        return x == y or (isinstance(x, tuple) and x[0] == y[0] and 0 in (x[1], y[1]))

    return len(a) == len(b) and all(alike(x, y) for x, y in zip(a, b, strict=True))


def _without(u: Array, rows: Array) -> Array:
    """The part of a vector that no row sees."""
    return u - np.linalg.pinv(rows) @ (rows @ u) if rows.size else u


def _place(at: Any) -> Iterator[float]:
    """Coordinates of a point in its body's frame."""
    return (float(x) for x in at[1:3]) if len(at) >= 3 and not isinstance(at[1], list) else iter((0.0,))


def _is_angle(dimension: Dimension) -> bool:
    return dimension.angle == 1 and dimension.length == dimension.mass == dimension.time == 0


def _counts(mechanism: Builder) -> set[str]:
    """Parameters that say how many items there are; those cannot vary."""
    text = mechanism.model.model_dump_json(by_alias=True, exclude_unset=True)
    return {name for name in mechanism.model.parameters if f".. {name}]" in text or f"..{name}]" in text}

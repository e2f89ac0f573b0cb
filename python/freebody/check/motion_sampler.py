"""True motions of a model: random states with random parameters, solved by the core, on which a statement is tried."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, CompiledModel, ModelError, MotionError, State, Trajectory, quote
from freebody.model.errors import ModelProblem
from freebody.model.start import Start, evaluate, initial_state
from freebody.symbolic.dimensions import ANGLE, Dimension

from .families import ALL, Family, NoMotion, Samples

if TYPE_CHECKING:
    from freebody.model.builder import Builder

SAMPLES = 64
_TRIES = 40  # for one sample; a four-bar with random bars closes in about one of three
_FEW_TRIES = 8  # where a parameter is far from the model's, and states are rarer or none
_PATIENCE = 3  # samples, of which one at least must be found
_ENOUGH = 8  # samples to judge by
_STAGES = 12  # in which a closed loop goes from the start to another place
_TOUCHING = 1e-9  # least square of a distance on the way, relative to that at its ends: below it the distance has been 0
_FAST = 20  # times the usual rate: beyond it a closed loop is near a dead point
_FACTOR = (0.3, 3.0)
_LOOP_FACTOR = (0.7, 1.4)  # of lengths of closed loops, which have to close
_ANGLE_FACTOR = (0.4, 1.6)  # of angles, which are not free to grow
_NOTHING = 1e-11  # SI: what vanishes by a hypothesis is below it
_DONE = 1e-14  # SI: where Newton's method has nothing left to do
_NEWTON = 30  # steps of it
_STEP = 1e-6  # of central differences, relative to the size of a coordinate
_EXACT = 1e-13  # tolerance of runs whose course matters
_RTOL = 1e-7  # of runs: every state on them is solved anew, so that they need not be accurate
_NEAR = 0.15  # of the time typical of the model: a run that lasts so long stays near its start
_APART = 0.2  # rad, or so much of the size of the model, by which places at rest differ
_PLACES = 12  # steps of Newton's method to one
_TOUCHES = 1e-12  # gap that is closed, relative to the size of the model
_STEPS = 2000  # of a run, which is short
_BALANCED = 1e-11  # largest relative residual of a state that may judge: below it is round-off, above it a bad condition
_SLOW = 1e-9  # of the usual rate: a joint with friction that slides no faster stands
_RATES = (1e-3, 1e3)  # 1/s, within which the usual rate of a model is looked for
_ONE_OF_SEVERAL = re.compile(r"\.N\d+$")  # the force at one place of a contact that holds at several


class MotionSampler:
    """The true motions of a model. Families of samples are made once and kept. Where contacts, strings, stops or friction decide
    what moves, samples lie on short runs from the model's start."""

    def __init__(self, mechanism: Builder, seed: int = 0) -> None:
        lowered = mechanism.lowered()
        self.start: Start = lowered.start
        self.spec: dict[str, Any] = {**lowered.spec, "parameters": list(lowered.spec["parameters"])}
        self.gravity = self._parametrised_gravity()
        self.core = CompiledModel.of(self.spec)
        self.metadata = self.core.metadata
        self.coordinates: list[Mapping[str, Any]] = list(self.metadata["coordinates"])
        self.names: list[str] = [c["name"] for c in self.coordinates]
        text = mechanism.model.model_dump_json(by_alias=True, exclude_unset=True)
        numbers = {p["name"]: p["value"] for p in self.spec["parameters"] if isinstance(p["value"], int | float)}
        counts = {name for name in mechanism.model.parameters if f".. {name}]" in text or f"..{name}]" in text}
        self.free_parameters = {name: float(value) for name, value in numbers.items() if name not in counts}
        """Parameters that are plain numbers in the model, with those; the others follow from them, or count items."""
        self.seed = seed
        self._families: dict[tuple[Family, int], Samples] = {}

    def _parametrised_gravity(self) -> str | None:
        """A gravity that is a plain number becomes a parameter, so that nothing is true by the number 9.81."""
        given = self.spec.get("gravity")
        if given is None or not all(isinstance(part, int | float) for part in given) or given[0] != 0 or given[1] == 0:
            return None
        taken = {p["name"] for p in self.spec["parameters"]} | set(self.start.coordinates)
        name = next(name for name in ("g", "gravity", "gravity2") if name not in taken)
        self.spec["parameters"] += [{"name": name, "value": -given[1], "unit": "m/s^2"}]
        self.spec["gravity"] = [0.0, f"-{name}"]
        self.start = replace(self.start, parameters=self.start.parameters | {name: Dimension(length=1, time=-2)})
        return name

    # -- samples of a family

    def samples(self, family: Family = ALL, count: int = SAMPLES, fresh: int = 0) -> Samples:
        """True states of a family; ``fresh`` other than 0 gives others than before. Raises ``NoMotion``."""
        key = (family, 1000 * fresh + count)
        if key not in self._families:
            self._families[key] = Samples(self.core, self._drawn_samples(family, count, fresh))
        if not self._families[key].states:
            try:
                _ = self.first
            except MotionError as error:
                raise NoMotion(f"the model does not start: {error.what}") from None
            there = "".join(f"has `{_stated(text)}` and " for text in family.vanishing)
            why = "is not singular, on a limit or of another mode than its start"
            raise NoMotion(f"no motion of this model was found that {there}{why}")
        return self._families[key]

    def has(self, family: Family) -> bool:
        """Whether there are motions of a family."""
        with suppress(NoMotion):
            return bool(self.samples(family, _PATIENCE).states)
        return False

    def _drawn_samples(self, family: Family, count: int, fresh: int) -> list[State]:
        """``count`` samples; none where the first ones already fail."""
        rng = np.random.default_rng([self.seed, fresh])
        found: list[State] = []
        for i in range(count):
            if i == _PATIENCE and not found:
                return []
            for _ in range(_FEW_TRIES if family.scaled or family.held else _TRIES):
                with suppress(MotionError, ModelError, ModelProblem, ZeroDivisionError):
                    if (made := self._made(rng, self._parameters(rng, family), family)) is not None:
                        found.append(made)
                        break
        return found if len(found) >= min(_ENOUGH, count) else []

    def _made(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> State | None:
        if family.since and not family.at_start:
            found = self._since_start(rng, values, family)
        elif self.restricted:
            found = self._on_a_run(rng, values, family)
        else:
            found = self._started(values) if family.at_start else self._anywhere(rng, values, family)
        return found if found and all(self._vanishes(text, found, family) for text in family.vanishing) else None

    def _vanishes(self, text: str, state: State, family: Family) -> bool:
        """Whether an expression is 0 there. Raises ``NoMotion`` where nothing can be done for it."""
        if abs(float(Samples(self.core, [state]).values([text])[text][0])) < _NOTHING:
            return True
        if self.restricted:
            why = "contacts, strings, stops or friction decide how this model moves, so that it is tried on runs from its start"
            raise NoMotion(f"`{_stated(text)}` cannot be arranged: {why}")
        if family.at_start:
            raise NoMotion(f"`{_stated(text)}` does not hold at the start of this model")
        return False

    def _parameters(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        held, scaled = dict(family.held), dict(family.scaled)
        held |= {} if family.gravity else dict.fromkeys(self.gravities, 0.0)
        drawn = {name: self._drawn(rng, name, value, family) for name, value in self.free_parameters.items()}
        numbers = {name: x for name, x in held.items() if not isinstance(x, str)}
        plain = {name: numbers.get(name, value) * scaled.get(name, 1.0) for name, value in drawn.items()}
        return plain | {name: evaluate(x, plain) for name, x in held.items() if isinstance(x, str)}

    def _drawn(self, rng: np.random.Generator, name: str, value: float, family: Family) -> float:
        dimension = self.start.parameters.get(name)
        size, sign = rng.random(), rng.choice([-1.0, 1.0])
        if family.numbers or (value == 0 and not family.zeros):
            return value
        low, high = _ANGLE_FACTOR if dimension == ANGLE else _LOOP_FACTOR if self.shapes_loop(name) else _FACTOR
        factor = low * (high / low) ** size
        return value * factor if value else sign * factor * self.unit(dimension)

    # -- anywhere

    def _anywhere(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> State | None:
        """A random state of the start's assembly and side, none of whose limits is closed."""
        words = initial_state(self.start, self.core, values)
        t, own = 3 * rng.random() / self.rate, self.first.q
        angle = math.pi if self.loops == 0 or words["branch"] else 0.6
        spread = self.sizes * np.array([angle if c["dimension"] == "rad" else 1.0 for c in self.coordinates])
        move, rates = spread * rng.uniform(-1, 1, len(own)), self._rates(rng, family)
        state, stages = self.first, _STAGES if self.loops else 1  # a loop that is moved far at once may close elsewhere
        for done in np.arange(1, stages + 1) / stages:
            p, guess = self.first.p + done * (words["p"] - self.first.p), self._named(state.q + move / stages)
            state, _ = self.core.assemble(p, done * t, guess=guess, rates=rates, branch=words["branch"])
        small = [f"({text}) - ({size * _about(rng)!r})" for text, size in family.small]
        slow = [f"rate({text}) - ({size * self.rate * _about(rng)!r})" for text, size in family.small if not family.at_rest]
        for text in (*family.vanishing, *small, *slow):
            state = self._vanished(text, state, list(rates), words["branch"])
        solved = self.core.instant(state)
        if self._changes_side(state, own) or not all(limit.is_open and limit.gap >= 0 for limit in solved.limits.values()):
            return None
        judges = solved.residual < _BALANCED and np.isfinite(solved.accelerations).all()
        return state if judges and np.all(np.abs(state.u) < _FAST * self.rate * self.sizes) else None

    def _changes_side(self, state: State, own: Array) -> bool:
        """Whether a distance that the model reads, as of the ends of a spring, would be 0 on the straight way from the start: then
        its two points would have changed sides, and what is x on the one is −x on the other."""
        at = [self.core.evaluate(self._distances, state.at(q)) for q in (own, (own + state.q) / 2, state.q)]
        first, half, last = np.array(at) ** 2  # along a line d² is a parabola, c + b s + a s²
        a, b = 2 * (first - 2 * half + last), 4 * half - 3 * first - last
        with np.errstate(all="ignore"):
            between = (-b > 0) & (-b < 2 * a)
            return bool(np.any(between & (first - b**2 / (4 * a) < _TOUCHING * np.maximum(first, last))))

    @cached_property
    def _distances(self) -> list[str]:
        """The distances that springs, dampers, polar coordinates and expressions of the model read."""
        pairs = [force["with"]["between"] for force in self.spec["forces"] if "between" in force["with"]]
        pairs += [joint["with"]["of"] for joint in self.spec["joints"] if joint["type"] == "polar"]
        read = re.findall(r"distance\([^()]*\)", json.dumps(self.spec, ensure_ascii=False))
        return [*(f"distance({a}, {b})" for a, b in pairs), *read]

    def _rates(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        """Random rates, or none, of as many coordinates as may be given at will."""
        n = len(self.names)
        drawn = self.rate * self.sizes * rng.uniform(0.3, 1.5, n) * rng.choice([-1.0, 1.0], n)
        chosen = sorted(rng.permutation(n)[: self.freedom].tolist())
        return {self.names[i]: 0.0 if family.at_rest else float(drawn[i]) for i in chosen}

    def _vanished(self, text: str, state: State, free: Sequence[str], branch: Mapping[str, int]) -> State:
        """The nearest rates, or where they are not in it the nearest place, at which an expression is 0: of the coordinates that
        are ``free``; the others follow where loops close. Raises ``NoMotion`` and ``MotionError``."""
        chosen = [self.names.index(name) for name in free]

        def moved(places: Array, rates: Array) -> State:
            fixed, given = (dict(zip(free, x.tolist(), strict=True)) for x in (places, rates))
            near = self._named(state.q)
            return self.core.assemble(state.p, state.t, fixed=fixed, guess=near, rates=given, branch=branch)[0]

        def value(places: Array, rates: Array) -> Array:
            return self.core.evaluate([text], moved(places, rates))

        q, u, sizes = state.q[chosen], state.u[chosen], self.sizes[chosen]
        slope = _slopes(lambda rates: value(q, rates), u, self.rate * sizes)[0]
        if np.abs(slope * sizes).max(initial=0.0) > _NOTHING:
            return moved(q, u - slope * value(q, u) / (slope @ slope))
        for _ in range(_NEWTON):
            if abs(left := value(q, u)[0]) < _DONE:
                break
            slope = _slopes(lambda places: value(places, u), q, _STEP * sizes)[0]
            if not np.abs(slope * sizes).max(initial=0.0) > _NOTHING:
                why = "it depends on nothing that is free in" if free else "no freedom is left in"
                raise NoMotion(f"`{_stated(text)}` cannot be arranged: {why} this mechanism")
            q = q - slope * left / (slope @ slope)
        return moved(q, u)

    # -- on runs, where contacts, strings, stops or friction decide what moves

    @cached_property
    def own(self) -> State:
        """The state of the model at its start, after the events there."""
        return self._run(self.first, 1e-6 / self.rate).state(self.first.t) if self.restricted else self.first

    @cached_property
    def restricted(self) -> bool:
        """Whether limits, joint friction or events at the start decide what moves, so that states must lie on runs."""
        if any(event.get("opening") for event in self.spec.get("events", [])) or self._sticky:
            return True
        return not all(limit.is_open for limit in self.core.instant(self.first).limits.values())

    @cached_property
    def _sticky(self) -> list[str]:
        """The rates at which joints with friction slide."""
        first = {j["name"]: j["coordinates"] for j in self.metadata["joints"]}
        rough = [first.get(j["name"]) for j in self.spec["joints"] if j.get("friction")]
        return [f"rate({quote(own[0])})" for own in rough if own]

    def _run(self, state: State, until: float, rtol: float = _RTOL) -> Trajectory:
        return self.core.simulate(state, state.t + until, rtol=rtol, max_steps=_STEPS)

    def _on_a_run(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> State | None:
        """A state on a run from the model's start with random numbers and admissible rates, as long as nothing switches."""
        state = self._started(values)
        late = 0.0 if family.at_rest or family.at_start else _NEAR * rng.random() / self.rate
        if family.at_rest:
            state = replace(state, u=np.zeros_like(state.u))
        # A straight string without a length is as long as the start's place makes it, which its equations say in figures.
        as_long = any(string["length"] is None and not string["over"] for string in self.spec["strings"])
        if not (family.at_start or family.vanishing or state.u.any() or self._lies or as_long):
            state = self._placed(rng, state)
        if rng.random() < 0.7 and not (family.at_rest or family.at_start or self._lies):
            state = self._moving(rng, state)
        motion = self._run(state, max(late, 1e-6 / self.rate))
        return self._sampled(motion, min(late, 0.9 * motion.end.t))

    def _since_start(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> State | None:
        """A state on a run from the model's own start with random numbers, with the rates there or at rest, before
        anything switches."""
        state = self._started(values)
        if family.since == "rest":
            rates = self._rates(rng, replace(family, at_rest=True))
            state, _ = self.core.assemble(state.p, state.t, guess=self._named(state.q), rates=rates)
        motion = self._run(state, rng.uniform(0.05, 0.3) / self.rate, _EXACT)
        ends = [motion.end.t, *(change.t for change in motion.changes if change.t > state.t)]
        return self._sampled(motion, state.t + 0.99 * (min(ends) - state.t))

    def _sampled(self, motion: Trajectory, t: float) -> State | None:
        """The state of a run at a time, if all holds there as at the model's start, and it may judge."""
        found = motion.state(t)
        same = not self.restricted or _same(self._mode(found), self._own_mode)
        return found if same and self.core.instant(found).residual < _BALANCED else None

    def _placed(self, rng: np.random.Generator, state: State) -> State:
        """A random place near the start, at rest, where what is closed there is closed: bodies of other sizes touch elsewhere."""
        q = state.q + _APART * self.sizes * rng.uniform(-1, 1, len(self.names))
        closed = [i for i, held in enumerate(self._own_mode[: len(self.metadata["limits"])]) if held[0] not in ("open", "slack")]
        for _ in range(_PLACES):
            found, _ = self.core.assemble(state.p, state.t, guess=self._named(q))
            gaps = self._gaps(found, found.q)[closed]
            if not np.isfinite(gaps).all():
                break
            if np.max(np.abs(gaps), initial=0.0) < _TOUCHES * self.length:
                return found if not found.u.any() else state
            q = found.q - np.linalg.pinv(self._gap_slopes(found)[closed] * self.sizes) @ gaps * self.sizes
        return state

    def _moving(self, rng: np.random.Generator, state: State) -> State:
        """Random rates that keep closed what is closed."""
        found, _ = self.core.assemble(state.p, state.t, guess=self._named(state.q), rates=self._rates(rng, ALL))
        if not np.allclose(found.q, state.q, atol=1e-9 * self.length):
            return state
        closed = [i for i, limit in enumerate(self.core.instant(state.at(state.q)).limits.values()) if not limit.is_open]
        u, rows = found.u - state.u, self._gap_slopes(state)[closed]
        seen = np.linalg.pinv(rows) @ (rows @ u) if rows.size else 0.0
        return replace(state, u=found.u - seen)

    def _gaps(self, state: State, q: Array) -> Array:
        """How far every limit is from closing, less than 0 where it is violated, NaN where it has no gap."""
        return np.array([limit.gap for limit in self._untouched.instant(replace(state.at(q), history=None)).limits.values()])

    def _gap_slopes(self, state: State) -> Array:
        """Gradients of the gaps of all limits, a row each."""
        return _slopes(lambda q: self._gaps(state, q), state.q, _STEP * self.sizes)

    @cached_property
    def _untouched(self) -> CompiledModel:
        """The model with nothing that its limits do."""
        off = {kind: [{**limit, "engaged": False} for limit in self.spec[kind]] for kind in ("contacts", "strings", "stops")}
        return CompiledModel.of({**self.spec, **off})

    @cached_property
    def _own_mode(self) -> tuple[Any, ...]:
        return self._mode(self._run(self.first, 1e-3 / self.rate).end)

    def _mode(self, state: State) -> tuple[Any, ...]:
        """How every limit is held and to which side it slides, the sense of friction in every joint, at how many places contacts hold."""
        limits = tuple(
            (x.state, np.sign(round(np.nan_to_num(x.T), 12)) if x.state == "sliding" else 0)
            for x in self.core.instant(state).limits.values()
        )
        sliding = self.core.evaluate(self._sticky, state)
        slow = _SLOW * self.rate * min(self.length, 1.0)
        return (*limits, *np.sign(np.where(np.abs(sliding) > slow, sliding, 0.0)), self._places(state) if self._lies else 0)

    @cached_property
    def _lies(self) -> bool:
        """Whether a contact holds at several places, so that a turn would lift one: then random places and rates would end it."""
        return self._places(self.first) > 0

    def _places(self, state: State) -> int:
        """At how many places contacts hold that hold at several."""
        return sum(bool(_ONE_OF_SEVERAL.search(load.symbol)) for load in self.core.free_bodies(state).loads)

    # -- what the model says of itself before anything of it moves

    def _named(self, q: Array) -> dict[str, float]:
        """Coordinates, or rates, by their names."""
        return dict(zip(self.names, q.tolist(), strict=True))

    @cached_property
    def first(self) -> State:
        """The state in which the model starts."""
        return self._started({})

    def _started(self, parameters: Mapping[str, float]) -> State:
        """The start with other parameters. Raises ``MotionError`` and ``ModelProblem``."""
        words = initial_state(self.start, self.core, parameters)
        return self.core.assemble(words.pop("p"), 0.0, **words)[0]

    @cached_property
    def frictions(self) -> list[str]:
        """Free parameters that are a coefficient of friction."""
        rough = [*self.spec.get("contacts", []), *self.spec["joints"]]
        written = [item.get(word) for item in rough for word in ("friction", "static_friction")]
        return [name for name in self.free_parameters if name in written]

    @cached_property
    def gravities(self) -> list[str]:
        """Free parameters that stand alone in the gravity of the model."""
        parts = [str(part).strip("-() ") for part in self.spec.get("gravity") or ()]
        return [name for name in self.free_parameters if name in parts]

    @cached_property
    def length(self) -> float:
        """A length typical of the model, m."""
        places = self.core.points(self.core.bind({}))
        found = [math.hypot(x, y) for _, x, y in places.values()]
        found += [abs(q) for q, c in zip(self.first.q, self.coordinates, strict=True) if c["dimension"] == "m"]
        return max([x for x in found if x > 0], default=1.0)

    @cached_property
    def sizes(self) -> Array:
        """By what each coordinate changes noticeably: 1 rad, or a length typical of the model."""
        return np.array([1.0 if c["dimension"] == "rad" else self.length for c in self.coordinates])

    @cached_property
    def rate(self) -> float:
        """A rate typical of the model, 1/s: what its accelerations at rest and its own rates suggest."""
        found = float(np.max(np.abs(self.first.u / self.sizes), initial=0.0))
        with suppress(MotionError):
            accelerations = self.core.instant(self.first).accelerations
            found = max(found, math.sqrt(np.max(np.abs(accelerations / self.sizes), initial=0.0)))
        return float(np.clip(found, *_RATES)) if found > 0 else 1.0

    def unit(self, dimension: Dimension | None) -> float:
        """What is typical of a dimension, SI."""
        if dimension is None:
            return 1.0
        mass = max([b["mass"] for b in self.metadata["bodies"] if b.get("mass")], default=1.0)
        return mass**dimension.mass * self.length**dimension.length * self.rate ** (-dimension.time)

    @cached_property
    def freedom(self) -> int:
        """Rates that can be given at will."""
        given = sum(motion["engaged"] and motion["level"] != "acceleration" for motion in self.spec["motions"])
        return max(self.core.instant(self.first).rank.freedom - given, 0)

    @cached_property
    def loops(self) -> int:
        """How many joints close a loop."""
        return len(self.metadata.get("closure_coordinates", [])) + sum(1 for j in self.metadata["joints"] if j.get("cut"))

    def shapes_loop(self, name: str) -> bool:
        """Whether a parameter may be a length of a closed loop."""
        dimension = self.start.parameters.get(name)
        return self.loops > 0 and (dimension is None or (dimension.mass == 0 and dimension.time == 0))


def _slopes(of: Callable[[Array], Array], at: Array, steps: Array) -> Array:
    """Derivatives of several numbers, a row each, by central differences."""
    columns = [(of(at + step) - of(at - step)) / (2 * step.sum()) for step in np.diag(steps)]
    return np.array(columns).T if columns else np.zeros((1, 0))


def _same(a: tuple[Any, ...], b: tuple[Any, ...]) -> bool:
    """Whether two modes are one; what slides without friction does so in either sense."""
    pairs = zip(a, b, strict=False)
    alike = (x == y or (isinstance(x, tuple) and x[0] == y[0] and 0 in (x[1], y[1])) for x, y in pairs)
    return len(a) == len(b) and all(alike)


def _about(rng: np.random.Generator) -> float:
    """A number of the size of 1, of either sign."""
    return float(rng.uniform(0.3, 1.0) * rng.choice([-1.0, 1.0]))


def _stated(text: str) -> str:
    """What vanishes, as the equation that it comes from."""
    found = re.fullmatch(r"\((.+)\) - \((.+)\)", text)
    return f"{found[1]} = {found[2]}" if found else f"{text} = 0"

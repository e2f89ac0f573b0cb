"""True motions of a model: random states with random parameters, solved by the core, on which a statement is tried."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from time import process_time
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, CompiledModel, FreeBodies, ModelError, MotionError, State, Trajectory, quote
from freebody.model.errors import ModelProblem
from freebody.model.start import Start, evaluate, initial_state
from freebody.run.moments import START, Unreached, state_of
from freebody.solve.perturbed_states import independent, same_mode
from freebody.symbolic.dimensions import ANGLE, Dimension

from .admissible import UnderOtherLoads
from .budget import Budget
from .families import ALL, Family, NoMotion, Samples, at_start
from .sides import changes_side, squares

if TYPE_CHECKING:
    from freebody.model.builder import Builder

SAMPLES = 64
_TRIES = 40  # for one sample; a four-bar with random bars closes in about one of three
_FEW_TRIES = 8  # where a parameter is far from the model's, and states are rarer or none
_PATIENCE = 3  # samples, of which one at least must be found
_ENOUGH = 8  # samples to judge by
_STAGES = 12  # in which a closed loop goes from the start to another place
_AT_REST = 1e-6  # of the rate of vibrations: below it a rate is the root of an acceleration that is round-off
_FAST = 20  # times the usual rate: beyond it a closed loop is near a dead point
_FACTOR = (0.3, 3.0)
_LOOP_FACTOR = (0.7, 1.4)  # of lengths of closed loops, which have to close
_ANGLE_FACTOR = (0.4, 1.6)  # of angles, which are not free to grow
_NOTHING = 1e-11  # of what an expression changes by within the model's sizes: what vanishes by a hypothesis is below it
_DONE = 1e-14  # of the same: where Newton's method has nothing left to do
_NEWTON = 30  # steps of it
_STEP = 1e-6  # of central differences, relative to the size of a coordinate
_EXACT = 1e-13  # tolerance of runs whose course matters
_RTOL = 1e-7  # of runs: every state on them is solved anew, so that they need not be accurate
_SHARE, _MOST, _FEWER = 0.1, 0.4, 16
"""Of the time for a statement: when fewer samples are enough, and when no more are looked for."""
_NEAR = 0.15  # of the time typical of the model: a run that lasts so long stays near its start
_ELSEWHERE = 0.8  # share of samples at random places with random rates; the others are at the moment's own
_APART = 0.2  # rad, or so much of the size of the model, by which places at rest differ
_LONG = 12.0  # of the time typical of the model: where within that something vanishes on a run it is found
_LONGER = 0.3, 2.0, _LONG  # such runs one after the other: most of what vanishes does so soon
_LOOKS, _FINER, _SHORTEST = (
    65,
    12,
    1e-15,
)  # times at which it is looked for between two, how often again, and how near they may come
_STEPS = 2000  # of a run, which is short
_BALANCED = 1e-11  # largest relative residual of a state that may judge: below it is round-off, above it a bad condition


class MotionSampler:
    """The true motions of a model, as it is at a moment: by default the start, after the events there. Families of samples are made
    once and kept. Where contacts, strings, stops, friction or events decide what moves, and at a later moment, samples lie near the
    state of the moment, and what is in place and holds is the same there.

    ``asked`` are ``at``, ``before``, ``after``, ``initial``, ``t`` and changes, as in ``Mechanism.solve``."""

    def __init__(self, mechanism: Builder | UnderOtherLoads, seed: int = 0, **asked: Any) -> None:
        lowered, self._asked = mechanism.lowered(), dict(asked)
        self.mechanism, self.start, initial = mechanism, lowered.start, asked.pop("initial", None)
        if initial is not None:
            self.start = Start(coordinates=self.start.coordinates, parameters=self.start.parameters)
        self.begins = asked.pop("t", 0.0)
        self.moment = {word: asked.pop(word) for word in ("at", "before", "after") if asked.get(word) is not None}
        self.changes = {**(initial or {}), **{name: value for name, value in asked.items() if value is not None}}
        self.spec: dict[str, Any] = {**lowered.spec, "parameters": list(lowered.spec["parameters"])}
        opening = [event["name"] for event in self.spec["events"] if event.get("opening")]
        self.stated = ""  # of which moment the model is spoken, where it is none that a motion comes to
        if opening and self.moment.get("before") in (START, *opening):
            self.stated, self.moment = f"before {' and '.join(opening)}", {}
            self.spec["events"] = []
        self.gravity = self._parametrised_gravity()
        self.core = CompiledModel.of(self.spec)
        self.metadata = self.core.metadata
        self.coordinates: list[Mapping[str, Any]] = list(self.metadata["coordinates"])
        self.names: list[str] = [c["name"] for c in self.coordinates]
        text = mechanism.model.model_dump_json(by_alias=True, exclude_unset=True)
        own = [*self.spec["parameters"], *({"name": z["name"], "value": z["start"]} for z in self.spec["states"])]
        numbers = {p["name"]: p["value"] for p in own if isinstance(p["value"], int | float)}
        counts = {name for name in mechanism.model.parameters if f".. {name}]" in text or f"..{name}]" in text}
        changed = {name: evaluate(value, {}) for name, value in self.changes.items() if name in self.start.parameters}
        self.free_parameters = {name: float(value) for name, value in (numbers | changed).items() if name not in counts}
        """Parameters and states that are plain numbers in the model, with those; the others follow from them, or count items."""
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

    @cached_property
    def admissible(self) -> MotionSampler:
        """The motions of the same model under other loads: what is true of them, too, is no balance."""
        return MotionSampler(UnderOtherLoads(self), self.seed, **self._asked)

    def samples(self, family: Family = ALL, count: int = SAMPLES, fresh: int = 0) -> Samples:
        """True states of a family; ``fresh`` other than 0 gives others than before. Raises ``NoMotion``."""
        key = (family, 1000 * fresh + count)
        if key not in self._families:
            made = self._drawn_samples(family, count, fresh)
            self._families[key] = Samples(self.core, [state for state, _ in made], [start for _, start in made if start])
        if not self._families[key].states:
            try:
                _ = self.own
            except MotionError as error:
                raise NoMotion(f"the model does not start: {error.what}") from None
            there = "".join(f"has `{_stated(text)}` and " for text in family.vanishing)
            there += "no freedom is left in it to arrange that, and it " if family.vanishing and not self._free_rates.size else ""
            why = "is not singular, on a limit or of another mode than its start"
            raise NoMotion(f"no motion of this model was found that {there}{why}")
        return self._families[key]

    def has(self, family: Family) -> bool:
        """Whether there are motions of a family."""
        with suppress(NoMotion):
            return bool(self.samples(family, _PATIENCE).states)
        return False

    def _drawn_samples(self, family: Family, count: int, fresh: int) -> list[tuple[State, State | None]]:
        """``count`` samples, each with where its motion began if that is known; none where the first ones already fail."""
        rng = np.random.default_rng([self.seed, fresh])
        found: list[tuple[State, State | None]] = []
        began, seconds = process_time(), Budget.seconds_for(len(self.metadata["bodies"]))
        for i in range(count):
            spent = (process_time() - began) / seconds
            if (i >= _PATIENCE and not found) or spent > _MOST:
                break
            if len(found) >= _FEWER and spent > _SHARE:
                return found
            for _ in range(_FEW_TRIES if family.scaled or family.held else _TRIES):
                with suppress(MotionError, ModelError, ModelProblem, ZeroDivisionError, Unreached):
                    if (made := self._made(rng, self._parameters(rng, family), family)) is not None:
                        found.append(made)
                        break
        return found if len(found) >= min(_ENOUGH, count) else []

    def _made(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> tuple[State, State | None] | None:
        start = None
        driven = bool(family.vanishing and self.spec["motions"]) and not self._free_rates.size
        if (family.since or driven) and not family.at_start:
            found, start = self._since_start(rng, values, family)
        elif self.restricted:
            found = self._near_moment(rng, values, family)
        elif self.rolls_in_loop and not family.at_start:
            found, start = self._rolled_on(rng, values, family)
        else:
            found = self._started(values) if family.at_start else self._anywhere(rng, values, family)
        start = found if family.at_start else start
        lost = [
            text
            for text in family.vanishing
            if found and not self._vanishes(at_start(text, self.core, start) if start else text, found)
        ]
        if lost and (family.at_start or family.since):
            raise NoMotion(f"`{_stated(lost[0])}` does not hold {'at' if family.at_start else 'from'} the start of this model")
        return None if lost or not found else (found, start)

    def _vanishes(self, text: str, state: State) -> bool:
        """Whether an expression is 0 there."""
        return abs(float(Samples(self.core, [state]).values([text])[text][0])) <= _NOTHING * self._size(text, state)

    def _size(self, text: str, state: State) -> float:
        """What an expression changes by while coordinates, rates and parameters do by what is typical of the model."""
        by = np.abs(self.core.derivatives([text], state)[0, 1:])
        return float(by @ np.concatenate([self.sizes, self.rate * self.sizes, np.abs(state.p)]))

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
        if name in self.metadata["states"]:
            fixed = family.at_start or family.since
        else:
            fixed = family.numbers or (value == 0 and not family.zeros)
        if fixed:
            return value
        low, high = _ANGLE_FACTOR if dimension == ANGLE else _LOOP_FACTOR if self.shapes_loop(name) else _FACTOR
        factor = low * (high / low) ** size
        return value * factor if value else sign * factor * self.unit(dimension)

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
        return self._judging(self._arranged(self._conditions(rng, family), state, list(rates), words["branch"]))

    def _rolled_on(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> tuple[State | None, State]:
        """A random state to which the model comes from its own place, where what rolls is at angle 0; and that start."""
        start = self._at_moment(values, self._rates(rng, replace(family, at_rest=False)))
        conditions, n = self._conditions(rng, family), len(self.names)
        places = [text for text in conditions if not self.core.derivatives([text], start)[0, n + 1 : 2 * n + 1].any()]
        for long in _LONGER if places else (rng.uniform(*_LONGER[:2]),):
            motion = self._run(start, long / self.rate, _EXACT)
            t = self._first_zero(places[0], motion, start) if places else motion.end.t
            if t is not None:
                break
        else:
            return None, start
        rates = self._rates(rng, family)
        state, _ = self.core.assemble(start.p, t, guess=self._named(motion.state(t).q), rates=rates)
        return self._judging(self._arranged(conditions, state, list(rates))), start

    def _judging(self, state: State) -> State | None:
        """A state of the start's side and freedom, none of whose limits is closed, if it may judge."""
        solved = self.core.instant(state)
        singular = (
            solved.rank.freedom > self._freedom or solved.residual >= _BALANCED or not np.isfinite(solved.accelerations).all()
        )
        if singular or changes_side(self.core, self._squares, self.first.q, state):
            return None
        apart = all(limit.is_open and limit.gap >= 0 for limit in solved.limits.values())
        return state if apart and np.all(np.abs(state.u) < _FAST * self.rate * self.sizes) else None

    @cached_property
    def _freedom(self) -> int:
        """Degrees of freedom where the model starts."""
        return self.core.instant(self.first).rank.freedom

    def _conditions(self, rng: np.random.Generator, family: Family) -> list[str]:
        """What is 0 in a family, and where what is small there is so."""
        sizes = [(text, size * self._size(text, self.first)) for text, size in family.small]
        small = [f"({text}) - ({size * _about(rng)!r})" for text, size in sizes]
        slow = [f"rate({text}) - ({size * self.rate * _about(rng)!r})" for text, size in sizes if not family.at_rest]
        return [*family.vanishing, *small, *slow]

    def _arranged(
        self, conditions: Sequence[str], state: State, free: Sequence[str], branch: Mapping[str, int] | None = None
    ) -> State:
        """The nearest state at which ``conditions`` are 0. Raises ``NoMotion``."""
        for text in conditions:
            if not self._vanishes(text, state):
                state = self._vanished(text, state, free, branch or {})
        return state

    @cached_property
    def _squares(self) -> list[str]:
        return list(squares(self.spec))

    def _rates(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        """Random rates, or none, of as many coordinates as may be given at will."""
        n = len(self.names)
        drawn = self.rate * self.sizes * rng.uniform(0.3, 1.5, n) * rng.choice([-1.0, 1.0], n)
        order = rng.permutation(n)
        chosen = sorted(order[independent(self._free_rates[order])].tolist())
        return {self.names[i]: 0.0 if family.at_rest else float(drawn[i]) for i in chosen}

    def _vanished(self, text: str, state: State, free: Sequence[str], branch: Mapping[str, int]) -> State:
        """The nearest rates, or where they are not in it the nearest place, at which an expression is 0: of the coordinates that
        are ``free``; the others follow where loops close. What rolls leaves more places free than rates. Raises ``NoMotion`` and
        ``MotionError``."""
        movable = free if state.history is None and not self.rolls_in_loop else self.names
        places_of, rates_of = ([self.names.index(name) for name in names] for names in (movable, free))

        def moved(places: Array, rates: Array) -> State:
            there, given = dict(zip(movable, places.tolist(), strict=True)), dict(zip(free, rates.tolist(), strict=True))
            held: dict[str, Any] = {"guess": there}
            if movable is free:
                held = {"fixed": there, "guess": self._named(state.q), "branch": branch}
            return self.core.assemble(state.p, state.t, rates=given, history=state.history, **held)[0]

        def value(places: Array, rates: Array) -> Array:
            return self.core.evaluate([text], moved(places, rates))

        q, u, sizes, size = state.q[places_of], state.u[rates_of], self.sizes[places_of], self._size(text, state)
        slope = _slopes(lambda rates: value(q, rates), u, self.rate * self.sizes[rates_of])[0]
        if np.abs(slope * self.sizes[rates_of]).max(initial=0.0) * self.rate > _NOTHING * size:
            return moved(q, u - slope * value(q, u) / (slope @ slope))
        for _ in range(_NEWTON):
            if abs(left := value(q, u)[0]) <= _DONE * size:
                break
            slope = _slopes(lambda places: value(places, u), q, _STEP * sizes)[0]
            if not np.abs(slope * sizes).max(initial=0.0) > _NOTHING * size:
                why = "it depends on nothing that is free in" if movable else "no freedom is left in"
                raise NoMotion(f"`{_stated(text)}` cannot be arranged: {why} this mechanism")
            q = q - slope * left / (slope @ slope)
        return moved(q, u)

    @cached_property
    def own(self) -> State:
        """The state of the model at its moment. Raises ``ValueError`` where there is none."""
        found = self._at_moment({})
        return replace(found, moment=self.stated or found.moment)

    def _at_moment(self, values: Mapping[str, float], rates: Mapping[str, float] | None = None) -> State:
        """The state at the moment of the motion with other parameters, from the start with ``rates`` or those there."""
        state = self._started(values)
        if rates is not None:
            state, _ = self.core.assemble(state.p, state.t, guess=self._named(state.q), rates=rates)
        found = state_of(self.mechanism, state, self.core, **self.moment) if not self.stated else state
        is_new = found.history is None and self.restricted  # what holds there shows as it begins to move
        return replace(self._run(found, 1e-6 / self.rate).state(found.t), moment=found.moment) if is_new else found

    @cached_property
    def restricted(self) -> bool:
        """Whether limits, joint friction, events at the start or the moment decide what moves, so that states lie near that."""
        named = [event.get("opening") for event in self.spec["events"]] + [joint.get("friction") for joint in self.spec["joints"]]
        return bool(self.moment) or any(named) or not all(x.is_open for x in self.core.instant(self.first).limits.values())

    @cached_property
    def _puts_in_place(self) -> bool:
        """Whether events fasten parts where they are: with other parameters these are elsewhere."""
        return any("engage" in action for event in self.spec["events"] for action in event["then"] if isinstance(action, Mapping))

    def _run(self, state: State, until: float, rtol: float = _RTOL) -> Trajectory:
        return self.core.simulate(state, state.t + until, rtol=rtol, max_steps=_STEPS)

    def _near_moment(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> State | None:
        """A state of the same mode with random numbers, mostly at a random place with random rates, at which what is closed stays so;
        else a little after the moment, as long as nothing switches."""
        late = 0.0
        if family.at_start:
            state = self._at_moment(values)
        else:
            own = self._at_moment(values) if self._puts_in_place else self.own
            p, random = self.core.bind(values), rng.random() < _ELSEWHERE
            q = own.q + _APART * self.sizes * rng.uniform(-1, 1, len(own.q)) * random
            rates, there = self._rates(rng, family), self._named(own.u)
            if not (random or family.at_rest):
                rates = {name: there[name] for name in rates}
                late = 0.0 if family.vanishing or family.small else _NEAR * rng.random() / self.rate
            state, _ = self.core.assemble(p, own.t, guess=self._named(q), rates=rates, history=own.history)
            state = self._arranged(self._conditions(rng, family), state, list(rates))
        if "before" in self.moment:
            return self._sampled(state)
        motion = self._run(state, max(late, 1e-6 / self.rate))
        return self._sampled(motion.state(state.t + min(late, 0.9 * (motion.end.t - state.t))))

    def _since_start(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> tuple[State | None, State]:
        """A state on a run from the model's own start with random numbers, with the rates there or at rest, from the moment on and
        before anything switches, where what vanishes first does so; and that start."""
        start = self._at_moment(values, self._rates(rng, replace(family, at_rest=True)) if family.since == "rest" else None)
        long = _LONG if family.vanishing else rng.uniform(0.05, 0.3)
        motion = self._run(start, long / self.rate, _EXACT)
        ends = [motion.end.t, *(change.t for change in motion.changes if change.t > start.t)]
        if not family.vanishing:
            return self._sampled(motion.state(start.t + 0.99 * (min(ends) - start.t))), start
        first = at_start(family.vanishing[0], self.core, start)
        t = self._first_zero(first, motion, start, min(ends))
        return (None if t is None else self._sampled(start if t == start.t else motion.state(t))), start

    def _first_zero(self, text: str, motion: Trajectory, start: State, ends: float | None = None) -> float | None:
        """When an expression is first 0 behind the start of a motion; at the start, where it is only so there."""
        t = first_zero(lambda times: motion.evaluate([text], times)[:, 0], start.t, motion.end.t if ends is None else ends)
        return start.t if t is None and self._vanishes(text, start) else t

    def _sampled(self, found: State) -> State | None:
        """A state, if all holds there as at the model's moment, on the same features and sides, and it may judge."""
        if self.restricted:
            if not _touching(found) <= _touching(self.own) or changes_side(self.core, self._squares, self.own.q, found):
                return None
            if not same_mode(self.core.free_bodies(found), self._loads):
                return None
        return found if self.core.instant(found).residual < _BALANCED else None

    @cached_property
    def _loads(self) -> FreeBodies:
        """All loads at the moment."""
        return self.core.free_bodies(self.own)

    def _named(self, q: Array) -> dict[str, float]:
        """Coordinates, or rates, by their names."""
        return dict(zip(self.names, q.tolist(), strict=True))

    @cached_property
    def first(self) -> State:
        """The state in which the model starts."""
        return self._started({})

    def _started(self, parameters: Mapping[str, float]) -> State:
        """The start with other parameters. Raises ``MotionError`` and ``ModelProblem``."""
        words = initial_state(self.start, self.core, self.changes | parameters)
        return self.core.assemble(words.pop("p"), self.begins, **words)[0]

    @cached_property
    def frictions(self) -> list[str]:
        """Free parameters that are a coefficient of friction."""
        rough = [*self.spec["contacts"], *(joint.get("friction") or {} for joint in self.spec["joints"])]
        written = [item.get(word) for item in rough for word in ("friction", "static_friction", "kinetic", "fixed")]
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
        """A rate typical of the model, 1/s: what its accelerations at rest and its own rates suggest; where these are round-off, in an
        equilibrium, that of vibrations about it."""
        found = float(np.max(np.abs(self.first.u / self.sizes), initial=0.0))
        with suppress(MotionError):
            n, falls = len(self.names), [f"rate(rate({quote(name)}))" for name in self.names]
            accelerations, by = self.core.evaluate(falls, self.first), self.core.derivatives(falls, self.first)[:, 1 : n + 1]
            found = max(found, math.sqrt(np.max(np.abs(accelerations / self.sizes), initial=0.0)))
            stiff = np.abs(by * self.sizes / self.sizes[:, None]).max(axis=1, initial=0.0)
            vibrations = math.sqrt(min((x for x in stiff if x > _AT_REST**2 * stiff.max()), default=0.0))  # the slowest
            found = vibrations if found < _AT_REST * vibrations else found
        return found or 1.0

    def unit(self, dimension: Dimension | None) -> float:
        """What is typical of a dimension, SI."""
        if dimension is None:
            return 1.0
        mass = max([b["mass"] for b in self.metadata["bodies"] if b.get("mass")], default=1.0)
        return mass**dimension.mass * self.length**dimension.length * self.rate ** (-dimension.time)

    @cached_property
    def _free_rates(self) -> Array:
        """Rates that can be given at will, (n, f), one a column: those by which loops stay closed, what touches goes on touching, and
        what is locked or driven stays so."""
        free = [motion["name"] for motion in self.spec["motions"] if motion["level"] == "acceleration"]
        rows = [[row.coefficients[name] for name in self.names] for row in self._loads.rows if row.name not in free]
        held = np.array(rows).reshape(len(rows), len(self.names))
        return np.linalg.svd(held)[2][len(independent(held)) :].T

    @cached_property
    def loops(self) -> int:
        """How many joints close a loop."""
        return len(self.metadata.get("closure_coordinates", [])) + sum(1 for j in self.metadata["joints"] if j.get("cut"))

    @cached_property
    def rolls_in_loop(self) -> bool:
        """Whether something that rolls closes a loop: that binds rates, and of the places only what follows from the start."""
        cut = {joint["name"] for joint in self.metadata["joints"] if joint.get("cut")}
        return any(joint["name"] in cut and joint["type"].startswith("rolling") for joint in self.spec["joints"])

    def shapes_loop(self, name: str) -> bool:
        """Whether a parameter may be a length of a closed loop."""
        dimension = self.start.parameters.get(name)
        return self.loops > 0 and (dimension is None or (dimension.mass == 0 and dimension.time == 0))


def _touching(state: State) -> set[tuple[int, int]]:
    """What touches or is taut in a state, and on which of its features."""
    return set(state.history.touching() if state.history else ())


def _slopes(of: Callable[[Array], Array], at: Array, steps: Array) -> Array:
    """Derivatives of several numbers, a row each, by central differences."""
    columns = [(of(at + step) - of(at - step)) / (2 * step.sum()) for step in np.diag(steps)]
    return np.array(columns).T if columns else np.zeros((1, 0))


def first_zero(of: Callable[[Array], Array], begins: float, ends: float) -> float | None:
    """Where a function of time, read at many times at once, first goes through 0 behind its beginning; None where it does not."""
    times = np.linspace(begins, ends, _LOOKS)
    for _ in range(_FINER):
        values = of(times)
        crossings = np.flatnonzero((values[1:-1] * values[2:] <= 0) & (values[1:-1] != 0)) + 1
        if not len(crossings) and values[0] * values[1] < 0:
            crossings = np.zeros(1, int)
        if not len(crossings):
            return None
        a, b = times[crossings[0]], times[crossings[0] + 1]
        if b - a <= _SHORTEST * (abs(b) + ends - begins):
            return float(b - (b - a) * values[crossings[0] + 1] / (values[crossings[0] + 1] - values[crossings[0]]))
        times = np.linspace(a, b, _LOOKS)
    return float(times[-1])


def _about(rng: np.random.Generator) -> float:
    """A number of the size of 1, of either sign."""
    return float(rng.uniform(0.3, 1.0) * rng.choice([-1.0, 1.0]))


def _stated(text: str) -> str:
    """What vanishes, as the equation that it comes from."""
    found = re.fullmatch(r"\((.+)\) - \((.+)\)", text)
    return f"{found[1]} = {found[2]}" if found else f"{text} = 0"

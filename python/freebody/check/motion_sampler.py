"""True motions of a model: random states with random parameters, solved by the core, on which a statement is tried."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from time import thread_time
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import ModelError, MotionError, State
from freebody.model.errors import ModelProblem
from freebody.model.start import evaluate
from freebody.run.moments import Unreached
from freebody.solve.perturbed_states import independent, same_mode
from freebody.symbolic.dimensions import ANGLE, LENGTH

from .admissible import UnderOtherLoads
from .arrangement import NOTHING, arranged, stated, with_parameters
from .budget import Budget
from .families import ALL, BEFORE, Family, NoMotion, Samples
from .followed_model import JUST_AFTER, JUST_BEFORE, Course, FollowedModel
from .integrals import EXACT
from .sides import changes_side
from .steady import period_of, steady_state
from .stretches import first_zero, stretches

if TYPE_CHECKING:
    from freebody.model.builder import Builder

SAMPLES = 64
_TRIES = 40  # for one sample; a four-bar with random bars closes in about one of three
_FEW_TRIES = 16  # where a parameter is far from the model's, and states are rarer or none
_NEARER = 0.9  # to the start after a try that failed: loops may have few places far from it
_SOONER = 4  # tries that a sample begins before that with which the last one was found
_PATIENCE = 3  # samples, of which one at least must be found
_ENOUGH = 8  # samples to judge by
_LATE_ENOUGH = 3  # the same of motions that last long, each of which takes time
_STILL_SMALL = 10.0  # times as large as it was to be: round-off of what else was arranged
_FAST = 20  # times the usual rate: beyond it a closed loop is near a dead point
_FULL_SPEED = 1000  # the same where a speed is asked for at which something vanishes
_FACTOR = (0.3, 3.0)
_LOOP_FACTOR = (0.7, 1.4)  # of lengths of closed loops, which have to close
_ANGLE_FACTOR = (0.4, 1.6)  # of angles, which are not free to grow
_SHARE, _MOST, _FEWER = 0.1, 0.4, 16
"""Of the time for a statement: when fewer samples are enough, and when no more are looked for."""
_SHORT_LOOP = 4  # coordinates, up to which a loop is taken far
_OTHER = 1.01  # times a parameter: another value, by which it shows whether loops close with it
_NEAR = 0.15  # of the time typical of the model: a run that lasts so long stays near its start
_ELSEWHERE = 0.8  # share of samples at random places with random rates; the others are at the moment's own
_NEXT = 0.1  # of the farthest: a place next to the start
_APART = 0.2  # rad, or so much of the size of the model, by which places at rest differ
_LONG = 12.0  # of the time typical of the model: how long a run is followed at least
_STAGES = tuple(0.3 * 2.0**k for k in range(10))  # of the same time, one after the other: most of what vanishes does so soon
_FURTHER = 2.0  # of the same time: how far what rolls in a loop is taken
_LATER = 0.05, 0.8  # of the time typical of the model: how long runs from the start last
_PARTS = 4  # stretches of a motion that goes on through what switches
_BALANCED = 1e-11  # largest relative residual of a state that may judge: below it is round-off, above it a bad condition


class MotionSampler(FollowedModel):
    """The true motions of a model. Families of samples are made once and kept. Loops are of the assembly of the start. Where contacts,
    strings, stops, friction or events decide what moves, and at a later moment, samples lie near the state of the moment, and what is
    in place and holds is the same there."""

    def __init__(self, mechanism: Builder | UnderOtherLoads, seed: int = 0, **asked: Any) -> None:
        super().__init__(mechanism, **asked)
        self.seed = seed
        self._families: dict[tuple[Family, int], Samples] = {}
        self._usual: dict[Family, Course | None] = {}
        self._of_any_course: set[Family] = set()
        self._without: set[tuple[Family, int]] = set()  # families of which no state was found

    @cached_property
    def admissible(self) -> MotionSampler:
        """The motions of the same model under other loads: what is true of them, too, is no balance."""
        return MotionSampler(UnderOtherLoads(self), self.seed, **self._asked)

    def samples(self, family: Family = ALL, count: int = SAMPLES, fresh: int = 0) -> Samples:
        """True states of a family; ``fresh`` other than 0 gives others than before. Raises ``NoMotion``."""
        key = (family, 1000 * fresh + count)
        if key not in self._families:
            made = self._drawn_samples(family, count, fresh)
            self._families[key] = Samples(
                self.core,
                [state for state, _ in made],
                [start for _, start in made if start],
                self._begins(family),
                whole=family.since == BEFORE,
                repeats=family.steady and not family.small,
            )
        if not self._families[key].states:
            try:
                _ = self.own
            except MotionError as error:
                raise NoMotion(f"the model does not start: {error.what}") from None
            there = "".join(f"has `{stated(text)}` and " for text in family.vanishing)
            there += "no freedom is left in it to arrange that, and it " if family.vanishing and not self.free_rates.size else ""
            why = "is not singular, on a limit or of another mode than its start"
            raise NoMotion(f"no motion of this model was found that {there}{why}")
        return self._families[key]

    def _begins(self, family: Family) -> State | None:
        """Where the model's own motion begins, as those of a family do; None where nothing switches."""
        switches = self.spec["contacts"] or self.spec["stops"] or self.spec["strings"]
        return (self.first if family.since == BEFORE else self.own) if switches and (family.since or family.at_start) else None

    def has(self, family: Family) -> bool:
        """Whether there are motions of a family."""
        with suppress(NoMotion):
            return bool(self.samples(family, _PATIENCE).states)
        return False

    def _drawn_samples(self, family: Family, count: int, fresh: int) -> list[tuple[State, State | None]]:
        """``count`` samples, each with where its motion began if that is known; none where the first ones already fail."""
        rng = np.random.default_rng([self.seed, fresh])
        found: list[tuple[State, State | None]] = []
        if (family, fresh) in self._without:
            return found
        began, seconds = thread_time(), Budget.seconds_for(len(self.metadata["bodies"]))
        first = 0  # tries that fail are followed by one nearer the start, and so are those of the next sample
        for i in range(count):
            spent = (thread_time() - began) / seconds
            patience = _PATIENCE * (2 if family.through or "after" in self.moment else 1)
            if (not found and i >= patience) or spent > _MOST:
                break
            if not found and i == _PATIENCE:  # of the model's own course are none
                self._of_any_course.add(family)
            if len(found) >= _FEWER and spent > _SHARE:
                return found
            for failed in range(first, first + (_FEW_TRIES if family.scaled or family.held else _TRIES)):
                if thread_time() - began > _MOST * seconds:
                    break
                try:
                    if (
                        made := self._made(rng, self._parameters(rng, family, _NEARER**failed), family, _NEARER**failed)
                    ) is not None:
                        found.append(made)
                        first = max(0, failed - _SOONER)
                        break
                except NoMotion:
                    if not found and failed >= _ENOUGH:  # else it may be so with these numbers alone
                        raise
                except (MotionError, ModelError, ModelProblem, ZeroDivisionError, Unreached):
                    pass
        if not found and count >= _PATIENCE:
            self._without.add((family, fresh))
        far = family.late or (family.since and family.vanishing)
        return found if len(found) >= min(_LATE_ENOUGH if far else _ENOUGH, count) else []

    def _made(
        self, rng: np.random.Generator, values: Mapping[str, float], family: Family, reach: float
    ) -> tuple[State, State | None] | None:
        start, reach = None, reach * (_NEXT if family.near else 1.0)
        if family.steady:
            values = self._tied(values, family)
            found = steady_state(self, rng, values, EXACT)
            return (found, None) if found and self.are_above(family.above, found) else None
        if self.rolls_in_loop and (fixed := tuple(text for text in family.vanishing if self._is_of_numbers(text))):
            values = self._tied(values, replace(family, vanishing=fixed))
        driven = bool(family.vanishing and self.spec["motions"]) and (
            not self.free_rates.size or self._are_driven(family.vanishing)
        )
        if (family.since or driven) and not family.at_start:
            found, start = self._since_start(rng, values, family)
            found = found if found and self._comes_as_usual(family, start, found) else None
        elif self.restricted:
            found = self._near_moment(rng, values, family, reach)
        elif self.rolls_in_loop and not family.at_start:
            found, start = self._rolled_on(rng, values, family)
        else:
            found = self.released(values, family) if family.at_start else self._anywhere(rng, values, family, reach)
        start = found if family.at_start else start
        at_once = family.at_start and not family.held  # with parameters that are said it may come otherwise
        comes = "after" in self.moment or ("before" in self.moment and (at_once or family.since == BEFORE))
        if found and start and comes and not self._came_as_usual(family, values, start):
            return None
        start = self.started(values) if family.since == BEFORE else start
        asked = self._asked_of_motion(start, family) if found and start else family.vanishing
        lost = [text for text in asked if found and not self.vanishes(self.of_now(text, start), found)]
        if lost and (family.at_start or family.since):
            raise NoMotion(f"`{stated(lost[0])}` does not hold {'at' if family.at_start else 'from'} the start of this model")
        if lost or not found or not self.are_above([self.of_now(text, start) for text in family.above], found):
            return None
        return found, start

    def _are_driven(self, texts: Sequence[str]) -> bool:
        """Whether of the coordinates those alone stand in expressions that motions prescribe."""
        said = {name for text in texts for name in self._moving_in(text)}
        return bool(said) and said <= {motion["of"] for motion in self.spec["motions"]}

    def _is_of_numbers(self, text: str) -> bool:
        """Whether parameters alone stand in an expression."""
        return {*re.findall(r"[^\W\d]\w*", text)} <= {*self.free_parameters}

    def _moving_in(self, text: str) -> set[str]:
        """The coordinates that stand in an expression."""
        return {name for name in self.names if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text)}

    def _tied(self, values: dict[str, float], family: Family) -> dict[str, float]:
        """Parameters with other values of those that are not held, so that what vanishes does so. Raises ``NoMotion``."""
        if not family.vanishing:
            return values
        free = [name for name in self.free_parameters if name not in dict(family.held) and name not in self._closing]
        if (found := with_parameters(self, family.vanishing, self.started(values), values, free)) is None:
            raise NoMotion(f"`{stated(family.vanishing[0])}` cannot be arranged by parameters")
        numbers = dict(zip((p["name"] for p in self.metadata["parameters"]), found.p.tolist(), strict=True))
        return {name: numbers.get(name, value) for name, value in values.items()}

    def _parameters(self, rng: np.random.Generator, family: Family, reach: float = 1.0) -> dict[str, float]:
        """Random numbers, within ``reach`` of the farthest from the model's."""
        held, scaled = dict(family.held), dict(family.scaled)
        held |= {} if family.gravity else dict.fromkeys(self.gravities, 0.0)
        drawn = {name: self._drawn(rng, name, value, family, reach) for name, value in self.free_parameters.items()}
        numbers = {name: x for name, x in held.items() if not isinstance(x, str)}
        plain = {name: numbers.get(name, value) * scaled.get(name, 1.0) for name, value in drawn.items()}
        for name, x in held.items():  # one after the other: the later ones may read the earlier
            plain |= {name: evaluate(x, plain)} if isinstance(x, str) else {}
        return plain

    def _drawn(self, rng: np.random.Generator, name: str, value: float, family: Family, reach: float) -> float:
        dimension = self.start.parameters.get(name)
        size, sign = rng.random(), rng.choice([-1.0, 1.0])
        if name in self.metadata["states"]:
            fixed = family.at_start or family.since
        else:
            fixed = family.numbers or (value == 0 and not family.zeros)
        if fixed:
            return value
        low, high = _ANGLE_FACTOR if dimension == ANGLE else _LOOP_FACTOR if self.shapes_loop(name) else _FACTOR
        # What leans to one side does so with other numbers, too.
        if dimension == ANGLE and self.restricted and value % (math.pi / 2):
            high = min(high, math.ceil(abs(value) / (math.pi / 2)) * (math.pi / 2) / abs(value))
        factor = (low * (high / low) ** size) ** (reach if value else 1.0)
        return value * factor if value else sign * factor * self.unit(dimension)

    def _anywhere(self, rng: np.random.Generator, values: Mapping[str, float], family: Family, reach: float) -> State | None:
        """A random state of the start's assembly and side, within ``reach`` of the farthest, none of whose limits is closed."""
        turn = math.pi  # farther than a part of a right angle many ways of a loop end in a singular position
        turn *= min(1.0, _SHORT_LOOP / len(self.names)) / 2 if self.loops else 1
        move = np.array([turn if c["dimension"] == "rad" else self.length for c in self.coordinates])
        near = self.started(values) if self.loops and family.scaled else self.first
        place = near.q + reach * move * rng.uniform(-1, 1, len(move))
        rates, t = self._rates(rng, family), 3 * rng.random() / self.rate
        state = self.moved(near, place, rates, t=t, p=self.bound(values, near))
        made = arranged(self, self._conditions(rng, family), state, rates, family, values, self._adjustable(family))
        return self._judging(made, family) if self._is_small(family, made) else None

    def _is_small(self, family: Family, state: State) -> bool:
        """Whether what is small is so with its rate: what was arranged later may have moved it. What vanishes besides goes before."""
        texts, sizes = (
            [text for text, _ in family.small],
            np.array([size * self.size_of(text, self.first) for text, size in family.small]),
        )
        if not texts or family.vanishing:
            return True
        found = np.abs(self.core.evaluate([*texts, *(f"rate({text})" for text in texts)], state)).reshape(2, -1)
        return bool((found <= _STILL_SMALL * sizes * np.array([[1.0], [self.rate]])).all())

    def _adjustable(self, family: Family) -> list[str]:
        """The parameters of which one may have another value so that something vanishes: none that says where parts are."""
        held = dict(family.held)
        if any(isinstance(value, str) for value in held.values()) or family.numbers or not family.vanishing:
            return []
        return [name for name in self.free_parameters if name not in held and name not in self._closing]

    @cached_property
    def _closing(self) -> set[str]:
        """The parameters with which loops close, couplings hold and parts touch: with another value of one the model cannot stay at its place."""
        own, values = self.own, self.free_parameters

        def moves(name: str) -> bool:
            try:
                p, guess = self.core.bind({name: _OTHER * values[name]}), self._named(own.q)
                there, _ = self.core.assemble(p, own.t, guess=guess, history=own.history)
            except (MotionError, ModelError):
                return True
            return bool(np.abs((there.q - own.q) / self.sizes).max() > NOTHING)

        return {*filter(moves, values)}

    def _rolled_on(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> tuple[State | None, State]:
        """A random state to which the model comes from its own place, where what rolls is at angle 0; and that start."""
        start = self._at_moment(self.started(values), self._rates(rng, replace(family, at_rest=False)))
        conditions, n = self._conditions(rng, family), len(self.names)
        moving = self.core.derivatives(conditions, start)[:, n + 1 : 2 * n + 1].any(axis=1) if conditions else []
        places = [text for text, moves in zip(conditions, moving, strict=True) if family.at_rest or not moves]
        rates = self._rates(rng, family)

        def given_rates(state: State) -> State:
            return self.core.assemble(start.p, state.t, guess=self._named(state.q), rates=rates)[0]

        if family.near and (found := with_parameters(self, conditions, given_rates(start), values, self._sizeless)):
            return self._judging(found, family), start
        there = start if places and self.vanishes(places[0], given_rates(start)) else None
        for motion, _ in self.followed(start, _STAGES if places else (rng.uniform(_STAGES[0], _FURTHER),)):
            if places and family.at_rest:
                left = lambda times, motion=motion: np.array(
                    [self.core.evaluate(places[:1], given_rates(motion.state(t)))[0] for t in times]
                )
                t = first_zero(left, float(motion.steps[0]), motion.end.t)
                found = None if t is None else motion.state(t)
            else:
                found = self.first_at(places[0], motion, stretches(motion)) if places else motion.end
            there = found or there
            if found is not None:
                break
        if there is None and any("accel(" in text for text in places):  # nowhere on it with these numbers
            fitted = with_parameters(self, conditions, given_rates(motion.end), values, self._sizeless)
            return self._judging(fitted, family) if fitted else None, start
        if there is None:
            return None, start
        state = given_rates(there)
        made = arranged(self, conditions, state, rates, family, values, self._sizeless)
        rolled_away = np.abs(made.q - state.q).max() > NOTHING * self.length  # to where what rolls is at another angle
        return None if rolled_away else self._judging(made, family), start

    @cached_property
    def is_driven(self) -> bool:
        """Whether forces or motions that repeat act on it."""
        return period_of(self, self.first) is not None

    @cached_property
    def _sizeless(self) -> list[str]:
        """The free parameters that are no lengths, with which nothing has to be put together anew."""
        return [name for name in self.free_parameters if self.start.parameters.get(name) != LENGTH]

    def _judging(self, state: State, family: Family) -> State | None:
        """A state of the start's side and freedom, none of whose limits is closed, if it may judge."""
        solved = self.core.instant(state)
        singular = solved.rank.freedom > self._freedom or solved.residual >= _BALANCED
        if singular or not np.isfinite(solved.accelerations).all() or changes_side(self.core, self._squares, self.first.q, state):
            return None
        apart = all(limit.is_open and limit.gap >= 0 for limit in solved.limits.values())
        fastest = (_FULL_SPEED if family.vanishing else _FAST) * self.rate * self.sizes
        return state if apart and np.all(np.abs(state.u) < fastest) else None

    @cached_property
    def _freedom(self) -> int:
        """Degrees of freedom where the model starts."""
        return self.core.instant(self.first).rank.freedom

    def _conditions(self, rng: np.random.Generator, family: Family) -> list[str]:
        """What is 0 in a family, and where what is small there is so."""
        sizes = [(text, size * self.size_of(text, self.first)) for text, size in family.small]
        small = [f"({text}) - ({size * _about(rng)!r})" for text, size in sizes]
        slow = [f"rate({text}) - ({size * self.rate * _about(rng)!r})" for text, size in sizes if not family.at_rest]
        return [*small, *slow, *family.vanishing]  # what is exact comes last: what is small need only stay so

    def _rates(self, rng: np.random.Generator, family: Family) -> dict[str, float]:
        """Random rates, or none, of as many coordinates as may be given at will."""
        n = len(self.names)
        drawn = self.rate * self.sizes * rng.uniform(0.3, 1.5, n) * rng.choice([-1.0, 1.0], n)
        small = {word for text, _ in family.small for word in re.findall(r"\w+", text)}
        order = np.array(sorted(rng.permutation(n), key=lambda i: self.names[i] not in small))  # so that each is small by itself
        chosen = sorted(order[independent(self.free_rates[order])].tolist())
        return {self.names[i]: 0.0 if family.at_rest else float(drawn[i]) for i in chosen}

    def _near_moment(self, rng: np.random.Generator, values: Mapping[str, float], family: Family, reach: float) -> State | None:
        """A state of the same mode with random numbers, mostly at a random place with random rates, at which what is closed stays so;
        else a little after the moment, as long as nothing switches."""
        late = 0.0
        if family.at_start:
            state = self._at_moment(self.started(values))
        else:
            random = rng.random() < _ELSEWHERE
            # Strings may be as long as they are at the start.
            with_them = self._puts_in_place or (reach < 1 and rng.random() < 0.5)
            own = self._at_moment(self.started(values)) if with_them else self.own
            q = own.q + reach * _APART * self.sizes * rng.uniform(-1, 1, len(own.q)) * random
            rates, there = self._rates(rng, family), self._named(own.u)
            if not (random or family.at_rest):
                rates = {name: there[name] for name in rates}
                late = 0.0 if family.vanishing or family.small else _NEAR * rng.random() / self.rate
            state = self.moved(own, q, rates, p=self.bound(values, own))
            free = self._adjustable(family)
            state = arranged(self, self._conditions(rng, family), state, rates, family, values, free)
        if "before" in self.moment:
            return self._sampled(state)
        motion = self.run(state, max(late, 1e-6 / self.rate))
        return self._sampled(motion.state(state.t + min(late, 0.9 * (motion.end.t - state.t))))

    def _since_start(self, rng: np.random.Generator, values: Mapping[str, float], family: Family) -> tuple[State | None, State]:
        """A state on a run from the model's own start with random numbers, with the rates there or at rest, from the moment on, where
        what vanishes first does so; before anything switches, or ``through`` that. And that start."""
        start = self._at_moment(
            self.put_together(values, family), self._rates(rng, replace(family, at_rest=True)) if family.since == "rest" else None
        )
        start = self.put(start, family, values)
        began = self.started(values) if family.since == BEFORE else start
        conditions = [self.of_now(text, began) for text in self._asked_of_motion(start, family)]
        usual = family.late or _LATER[0] * (_LATER[1] / _LATER[0]) ** rng.random()
        first = conditions
        for motion, goes_on in self.followed(start, _STAGES if conditions else (_LONG if family.through else usual,)):
            parts = stretches(motion, family.until)[: _PARTS if family.through else 1]
            begins, ends = parts[0][0], self.staying(motion, parts[0][0], parts[-1][1])
            parts = [(one, min(other, ends)) for one, other in parts if one < ends] or parts[:1]
            if begins == start.t:  # what is 0 all along is asked of no moment
                first = [text for text in conditions if family.through or not self._stays(text, motion, *parts[0])][:1]
            if not first:
                one, other = parts[rng.integers(len(parts))]
                if family.late and not goes_on:
                    break
                return self._sampled(motion.state(one + 0.99 * min(usual / self.rate, other - one)), family.through), start
            above = [self.of_now(text, began) for text in family.above]
            if (found := self.first_at(first[0], motion, parts, above)) is not None:
                return self._sampled(found, family.through), start
            if not goes_on and self.vanishes(first[0], motion.end):  # an event ends it there
                return self._sampled(motion.end, family.through), start
            if ends < motion.end.t and not family.through:
                break
        at_start = first and not family.through and self.vanishes(first[0], start)
        return (self._sampled(start) if at_start else None), start

    def _comes_as_usual(self, family: Family, start: State, found: State) -> bool:
        """Whether what is asked comes as on the model's own motion: with other numbers a second impact may come before, or a stop open."""
        if not (family.through and family.vanishing):
            return True
        if family not in self._usual:
            try:
                own, began = self._since_start(
                    np.random.default_rng(self.seed), self.free_parameters, replace(family, numbers=True)
                )
            except (MotionError, ModelError, ModelProblem, ZeroDivisionError, Unreached):
                own = None
            self._usual[family] = self.course(began, own.t) if own else None
        return self._usual[family] is None or self._is_alike(family, self._usual[family], self.course(start, found.t))

    def _came_as_usual(self, family: Family, values: Mapping[str, float], there: State) -> bool:
        """Whether the moment comes as on the model's own motion, and what holds behind it is the same."""
        return self._is_alike(family, self._course_through, self._course_to(self.started(values), there.t))

    def _is_alike(self, family: Family, usual: Course, course: Course) -> bool:
        """Whether two motions have one course; of impacts alone where none with the same course in all was found."""
        return course.is_like(usual) or (family in self._of_any_course and usual.impacts == course.impacts)

    @cached_property
    def _course_through(self) -> Course:
        return self._course_to(self.first, self.own.t)

    def _course_to(self, start: State, t: float) -> Course:
        """What switches on the motion from a start up to the moment; through what happens there where it is spoken of what is after."""
        return self.course(start, t, JUST_BEFORE if "before" in self.moment else JUST_AFTER)

    def _asked_of_motion(self, start: State, family: Family) -> list[str]:
        """What has to vanish on a motion itself: its start was put where it has to be."""
        placed = [] if family.since == BEFORE else self.of_start(family, start)
        return [text for text in family.vanishing if text not in placed]

    def _sampled(self, found: State, through: bool = False) -> State | None:
        """A state, if all holds there as at the model's moment, on the same features and sides, and it may judge; ``through`` what
        switches something else may hold."""
        if self.restricted and not through:
            if not touching(found) <= touching(self.own) or changes_side(self.core, self._squares, self.own.q, found):
                return None
            if not same_mode(self.core.free_bodies(found), self._loads):
                return None
        return found if self.core.instant(found).residual < _BALANCED else None


def touching(state: State) -> set[tuple[int, int]]:
    """What touches or is taut in a state, and on which of its features."""
    return set(state.history.touching() if state.history else ())


def _about(rng: np.random.Generator) -> float:
    """A number of the size of 1, of either sign."""
    return float(rng.uniform(0.3, 1.0) * rng.choice([-1.0, 1.0]))

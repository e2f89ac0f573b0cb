"""The small vibrations of a model about a place of rest: natural frequency, damping ratio, period; of several freedoms its natural
frequencies."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import Array, ModelError, MotionError, State, quote
from freebody.model.errors import ModelProblem
from freebody.solve.perturbed_states import independent
from freebody.stability.equilibria import Equilibrium, equilibria, newton_step, rest_near
from freebody.stability.state_space import SingularConfiguration
from freebody.symbolic.dimensions import LENGTH, NUMBER_ONLY, PER_SECOND, TIME, Dimension
from freebody.symbolic.symbols import folded

from .arrangement import arranged
from .families import Family, NoMotion
from .forced import forced_vibrations
from .linear_equations import NOTHING, linear_equations, of_several, squares_of, swings
from .user_symbols import AMPLITUDE, LAG, Masses, Meaning, Values

if TYPE_CHECKING:
    from .motion_sampler import MotionSampler

_AT_REST = Family(at_rest=True)
_MOST = 6  # natural frequencies that have an index
_QUANTITIES = {
    **{f"{name}_{i}": f"natural frequency {i}" for i in range(1, _MOST + 1) for name in ("ω", "natural_frequency")},
    **dict.fromkeys(("ω_n", "ω_0", "natural_frequency"), "natural frequency"),
    **dict.fromkeys(("f", "f_n", "frequency"), "frequency"),
    **dict.fromkeys(("τ", "τ_n", "T_n", "period"), "period"),
    **dict.fromkeys(("c_c", "c_cr", "c_crit"), "critical damping"),
    **{
        "ζ": "damping ratio",
        "δ": "logarithmic decrement",
        "ω_d": "damped frequency",
        "f_d": "frequency, damped",
        "T_d": "damped period",
        "τ_d": "damped period",
    },
}
_WITH_INDEX = {
    f"{letter}_{i}": what
    for i in range(1, _MOST + 1)
    for letter, what in (("ω", "natural frequency"), ("T", "period"), ("τ", "period"), ("f", "frequency"))
}
"""What has an index where of several coordinates one swings alone."""
_DAMPING = "c"
"""The parameter of which the critical value is asked."""
_STAGES = 6  # in which a place of rest goes along as parameters change, where it does not at once
_ALIKE = 1e-6  # of what moves in a vibration, below which it does not change what coordinates have to do with each other
_APART = 0.1  # of what is typical of each coordinate, to a place where linear equations may be others
_LATE = 0.37, 0.91  # of the typical time: later, when what goes on at one speed does so
_NEWTON, _FOUND = 20, 1e-10  # steps to a place of rest, and the last of them, of what is typical of each coordinate
_THERE = 1e-6  # of what an expression changes by within the model's sizes: a place that is said, as exactly as places of rest are found
_LENGTHS = 3.0  # of the model, within which a place of rest is looked for


@dataclass(frozen=True)
class OfVibration(Meaning):
    """What a vibration has, a function of the ``parameters`` alone."""

    of: Vibration | None = field(default=None, compare=False)

    @property
    def is_vector(self) -> bool:
        return False

    def needed(self, dots: int) -> list[str]:
        return ["0"] if dots or self.of is None else list(self.of.parameters)

    def value(self, dots: int, values: Values, masses: Masses) -> Array:
        if dots or self.of is None:
            return values["0"]
        rows = np.array([values[name] for name in self.of.parameters]).T
        return np.array([self.of.quantities(row).get(self.texts[0], np.nan) for row in rows])


class Vibration:
    """That of a sampler's model, about the place of rest next to the start that it swings about, or where ``places`` are 0; or of that
    coordinate ``alone`` which swings for itself, whatever the others do. ``forced``: what names of amplitudes are of, in a steady state."""

    def __init__(
        self, sampler: MotionSampler, alone: str = "", places: tuple[str, ...] = (), forced: Mapping[str, str] | None = None
    ) -> None:
        self.sampler, self.parameters, self.alone, self.places = sampler, tuple(sampler.free_parameters), alone, places
        self.forced = forced or {}
        self._known: dict[bytes, dict[str, float]] = {}

    def about(self, places: tuple[str, ...]) -> Vibration:
        """That where such expressions are 0."""
        return Vibration(self.sampler, self.alone, places)

    def driven(self, amplitudes: Mapping[str, str]) -> Vibration:
        """The same, forced, in a steady state; ``amplitudes``: names of such, with the coordinates of which they are."""
        return Vibration(self.sampler, self.alone, self.places, amplitudes)

    def meanings(self, asked: Iterable[str]) -> dict[str, OfVibration]:
        """What those of the ``asked`` names mean that are used for it; nothing where the model has no such vibration."""
        named = {folded(name): name for name in asked}
        known = _QUANTITIES | (_WITH_INDEX if self.alone else {}) | self.forced
        found = {named[folded(name)]: what for name, what in known.items() if folded(name) in named}
        per_second, second = PER_SECOND, NUMBER_ONLY.times(TIME, 1)
        dimensions: dict[str, Dimension] = {"period": second, "damped period": second, "damping ratio": NUMBER_ONLY}
        if its := self.sampler.start.parameters.get(_DAMPING):
            dimensions["critical damping"] = its
        dimensions |= {
            AMPLITUDE + c["name"]: NUMBER_ONLY if c["dimension"] == "rad" else LENGTH for c in self.sampler.coordinates
        }
        dimensions |= {LAG + name: NUMBER_ONLY for name in self.sampler.names}
        return {
            name: OfVibration("vibration", (what,), dimensions.get(what, per_second), of=self)
            for name, what in (found.items() if found and self.rest else ())
            if what in self._own
        }

    @property
    def drive(self) -> str:
        """The parameter that drives it to and fro; empty where none does."""
        return next(iter(self._amplitude), "")

    @property
    def count(self) -> int:
        """How many natural frequencies it has."""
        return sum(name.startswith("natural frequency") for name in self._own) if self.rest else 0

    @property
    def is_of_several(self) -> bool:
        """Whether several coordinates move freely about the place of rest."""
        return self.rest is not None and len(linear_equations(self.sampler.core, self.rest).free) > 1

    def modes(self, relations: Sequence[str]) -> list[int]:
        """The numbers of those natural vibrations in which expressions of several coordinates stay 0, as they are at rest. Raises
        ``NoMotion`` where there is none."""
        core, rest, every = self.sampler.core, self.rest, list(range(1, self.count + 1))
        space, size = linear_equations(core, rest), self.sampler.sizes
        slopes = core.derivatives(list(relations), rest)[:, 1 : 1 + len(size)] * size if relations else np.zeros((0, 0))
        slopes = slopes[np.sum(np.abs(slopes) > NOTHING, axis=1) > 1]
        if not len(slopes) or len(space.free) != len(size):
            return every
        squares, shapes = np.linalg.eig(-space.a[len(size) :, : len(size)])
        swinging = [k for k in np.argsort(squares.real) if squares[k].real > NOTHING * np.abs(squares).max()]
        order = [self.sampler.names.index(name) for name in space.free]
        moved = np.abs(slopes[:, order] @ (shapes[:, swinging].real / size[order, None]))
        most = np.abs(slopes[:, order]) @ np.abs(shapes[:, swinging].real / size[order, None])
        if not (found := [i for i, so in zip(every, np.all(moved <= _ALIKE * most, axis=0), strict=False) if so]):
            raise NoMotion("no natural vibration of this model is of that kind")
        return found

    @property
    def place(self) -> str:
        """Where that is, in words."""
        core, rest = self.sampler.core, self.rest
        free = linear_equations(core, rest).free
        if len(free) > 1 and not self.alone:
            return f"the place of rest at {', '.join(free)} = {', '.join(f'{q + 0.0:g}' for q in self._places(free))} (SI)"
        name = self.alone or free[0]
        k, is_angle = (
            self.sampler.names.index(name),
            name in {c["name"] for c in self.sampler.coordinates if c["dimension"] == "rad"},
        )
        return f"{name} = {round(np.degrees(rest.q[k]), 6) + 0.0:g}°" if is_angle else f"{name} = {round(rest.q[k], 6) + 0.0:g} m"

    @cached_property
    def _later(self) -> bool:
        """Whether events have changed what moves, or where it is follows from its start."""
        return self.sampler.restricted or self.sampler.rolls_in_loop

    @cached_property
    def _is_turned(self) -> bool:
        """Whether what is prescribed goes on at one speed, so that it swings on that: a bead on a rail that turns."""
        rates = [self._steady(self.sampler.first, late).u for late in (0.0, *_LATE)] if self.sampler.spec["motions"] else []
        return any(u.any() for u in rates) and all(np.abs(u - rates[0]).max() <= NOTHING * np.abs(u).max() for u in rates)

    def _steady(self, state: State, late: float = 0.0) -> State:
        """Where a state is, so many of its typical times later, with no rates but those that are prescribed."""
        sampler = self.sampler
        still = {sampler.names[i]: 0.0 for i in independent(sampler.free_rates)}
        return sampler.moved(state, state.q, still, t=state.t + late / sampler.rate)

    def _at_rest(self, state: State) -> State | None:
        """The place of rest next to a state, beside what goes on at one speed; where nothing holds it, but its linear equations are
        everywhere the same, that place."""
        core, sampler = self.sampler.core, self.sampler
        if self._is_turned:
            return self._at_rest_on_drive(state)
        if (rest := rest_near(core, state)) is not None:
            return rest
        a, other = (
            linear_equations(core, each).a for each in (state, sampler.moved(state, state.q + _APART * sampler.sizes, {}))
        )
        return state if a.shape == other.shape and np.abs(a - other).max() <= NOTHING * np.abs(a).max() else None

    def _at_rest_on_drive(self, state: State) -> State | None:
        """The same, by Newton's method, on what is driven at one speed, if it stays one as that goes on."""
        core, sampler = self.sampler.core, self.sampler
        for _ in range(_NEWTON):
            change, *_ = newton_step(core, state)
            state = self._steady(state.at(state.q + change))
            if np.abs(change / sampler.sizes).max() < _FOUND:
                first, *others = (linear_equations(core, self._steady(state, late)).a for late in (0.0, *_LATE))
                same = all(np.abs(a - first).max() <= NOTHING * np.abs(first).max() for a in others)
                return state if same else None
        return None

    def _placed(self, state: State) -> State:
        """Where a state is, at rest."""
        return self._steady(state) if self._is_turned else state.at(state.q)

    def _places(self, names: Iterable[str]) -> list[float]:
        """The coordinates of rest by their names."""
        return [round(float(self.rest.q[self.sampler.names.index(name)]), 6) for name in names]  # type: ignore[union-attr]

    @cached_property
    def _own(self) -> Mapping[str, float]:
        """What it has with the model's own numbers."""
        return self.quantities(np.array(list(self.sampler.free_parameters.values())))

    @cached_property
    def rest(self) -> State | None:
        """The place of rest that it swings about with the model's own numbers."""
        sampler, core = self.sampler, self.sampler.core
        try:
            if core.metadata["states"] or sampler.is_held:
                return None
            first = self._placed(self._undriven(sampler.own if self._later else sampler.first))
            if self.places:
                first = arranged(sampler, self.places, first, {}, _AT_REST, sampler.free_parameters, ())
            free = linear_equations(core, first).free
            if not free:
                return None
            if len(free) > 1 or self._later or self._is_turned:
                rest = self._at_rest(first)
                return rest if rest and self._is_there(rest) and swings(linear_equations(core, rest).a) else None
            (k,) = (sampler.names.index(name) for name in free)
            reach = np.pi if sampler.coordinates[k]["dimension"] == "rad" else _LENGTHS * sampler.length
            found = self._within(first, free[0], reach)
        except (MotionError, ModelError, NoMotion, SingularConfiguration, ValueError, np.linalg.LinAlgError):
            return None
        swinging = [each.state for each in found if len(each.space.a) == 2 and np.linalg.det(each.space.a) > 0]
        if self.places:
            return next(filter(self._is_there, swinging), None)
        if not swinging and (far := self._at_rest(first)) and swings(linear_equations(core, far).a):
            return far
        return min(swinging, key=lambda rest: np.linalg.norm((rest.q - first.q) / sampler.sizes), default=None)

    def _is_there(self, state: State) -> bool:
        """Whether a place of rest is that which was said."""
        left = self.sampler.core.evaluate(list(self.places), state).tolist() if self.places else []
        return all(abs(x) <= _THERE * self.sampler.size_of(text, state) for text, x in zip(self.places, left, strict=True))

    def _within(self, first: State, name: str, reach: float) -> Sequence[Equilibrium]:
        """The places of rest that one coordinate comes to; none where something is in its way."""
        q = first.q[self.sampler.names.index(name)]
        with suppress(MotionError):
            return equilibria(self.sampler.core, first, {name: (q - reach, q + reach)})[0]
        return []

    def _undriven(self, state: State) -> State:
        """A state without what drives the model."""
        return self.sampler.moved(state, state.q, {}, p=self._bound(self._amplitude)) if self._amplitude else state

    def _bound(self, values: Mapping[str, float]) -> Array:
        """The parameters of the model, some of them changed."""
        return self.sampler.core.bind({**self.sampler.free_parameters, **values})

    @cached_property
    def _amplitude(self) -> dict[str, float]:
        """The parameter that is 0 where nothing drives the model to and fro, if there is one: it swings about where it rests then. Of several
        that which has the least to do with how it swings: no force comes through a spring without stiffness, either."""
        if self._is_turned or self._later or self._is_steady({}):
            return {}
        own = self._linear_at_start({})

        def apart(zero: Mapping[str, float]) -> float:
            found = self._linear_at_start(zero)
            return float(np.abs(found - own).max(initial=0.0)) if found.shape == own.shape else np.inf

        known = self.sampler.start.parameters
        zeros = ({name: 0.0} for name in self.parameters if (its := known.get(name)) is None or its.time != -1)
        return min(filter(self._is_steady, zeros), key=apart, default={})

    def _is_steady(self, values: Mapping[str, float]) -> bool:
        """Whether accelerations at the start's place, at rest, are at all times the same with some values of parameters."""
        sampler, first = self.sampler, self.sampler.first
        falls = [f"accel({quote(name)})" for name in sampler.names]
        try:
            p = self._bound(values)
            states = (sampler.moved(first, first.q, {}, t=first.t + late / sampler.rate, p=p) for late in _LATE)
            found = np.array([sampler.core.evaluate(falls, state) for state in states])
        except (MotionError, ModelError):  # nothing has such a mass, or stiffness
            return False
        return bool(np.ptp(found, axis=0).max(initial=0.0) <= NOTHING * np.abs(found).max(initial=0.0))

    def _linear_at_start(self, values: Mapping[str, float]) -> Array:
        """The matrix of the linear equations at the start's place, at rest, with some values of parameters."""
        first = self.sampler.first
        return linear_equations(self.sampler.core, self.sampler.moved(first, first.q, {}, p=self._bound(values))).a

    def quantities(self, row: Array) -> Mapping[str, float]:
        """What it has with other parameters; NaN where it is none."""
        if (key := row.tobytes()) not in self._known:
            self._known[key] = self._found(row)
        return self._known[key]

    def _found(self, row: Array) -> dict[str, float]:
        a, rest = self._linear(row) or (None, None)
        if self.forced:
            return self._forced(a, rest, row)
        if a is not None and self.alone:
            a = self._part(a)
        if a is not None and len(a) > 2:
            return of_several(squares_of(a))
        with np.errstate(all="ignore"):
            natural = np.sqrt(np.linalg.det(a)) if a is not None else np.nan
            damping = -np.trace(a) / (2 * natural) if a is not None else np.nan
            damped = natural * np.sqrt(1 - damping**2)
            out = {"natural frequency": natural, "damping ratio": damping, "damped frequency": damped}
            if _DAMPING in self.parameters:
                out["critical damping"] = row[self.parameters.index(_DAMPING)] / damping
            out |= {"logarithmic decrement": 2 * np.pi * damping / np.sqrt(1 - damping**2)}
            out |= {"frequency": natural / (2 * np.pi), "frequency, damped": damped / (2 * np.pi)}
            return {**out, "period": 2 * np.pi / natural, "damped period": 2 * np.pi / damped}

    def _forced(self, a: Array | None, rest: State | None, row: Array) -> dict[str, float]:
        """The amplitudes of what moves freely, m or rad, and how far they lag behind, rad in [−π, π]."""
        values = dict(zip(self.parameters, row.tolist(), strict=True))
        free = linear_equations(self.sampler.core, self.rest).free
        if a is None or rest is None or not self.drive or len(a) != 2 * len(free):
            return {}
        found = forced_vibrations(self.sampler, rest, a, free, values, self.drive)
        amplitudes = {f"{AMPLITUDE}{name}": abs(x) for name, x in found.items()}
        return amplitudes | {f"{LAG}{name}": float(-np.angle(x)) for name, x in found.items()}

    def _part(self, a: Array) -> Array | None:
        """The rows of linear equations that are of one coordinate alone; None where others have to do with it, or it does not swing."""
        free = linear_equations(self.sampler.core, self.rest).free
        if self.alone not in free or len(a) != 2 * len(free):
            return None
        own = [free.index(self.alone), free.index(self.alone) + len(free)]
        part, others = a[np.ix_(own, own)], np.delete(a[own[1]], own)
        sizes = np.delete(np.tile(self.sampler.sizes[[self.sampler.names.index(name) for name in free]], 2), own)
        scale = np.abs(part[1]).max() * self.sampler.sizes[self.sampler.names.index(self.alone)]
        return part if np.all(np.abs(others) * sizes <= NOTHING * scale) and swings(part) else None

    def _linear(self, row: Array) -> tuple[Array, State] | None:
        """The matrix of the linear equations at rest with other parameters, and where that is."""
        core, rest, values = self.sampler.core, self.rest, dict(zip(self.parameters, row.tolist(), strict=True))
        if self._later:
            try:
                there = self._at_rest(self._placed(self.sampler.at_moment_with(values)))
            except (MotionError, ModelError, ModelProblem, SingularConfiguration, ValueError):
                return None
            return (a, there) if there and self._is_there(there) and swings(a := linear_equations(core, there).a) else None
        p = core.bind(values | self._amplitude)
        for stages in (1, _STAGES):
            state = rest
            for done in np.arange(1, stages + 1) / stages:
                try:
                    there = rest.p + done * (p - rest.p)
                    near, _ = core.assemble(there, rest.t, guess=dict(zip(self.sampler.names, state.q.tolist(), strict=True)))
                    state = self._at_rest(self._placed(near))
                except (MotionError, ModelError, SingularConfiguration, ValueError):
                    state = None
                if state is None:
                    break
            if state is None or not self._is_there(state):
                continue
            if swings(a := linear_equations(core, state).a) and self._is_reached(values, state):
                return a, state
        return None

    def _is_reached(self, values: Mapping[str, float], rest: State) -> bool:
        """Whether the start with such parameters is of the same assembly: a loop may close there another way."""
        try:
            return not self.sampler.loops or self.sampler.joined(self.sampler.started(values), rest)
        except (MotionError, ModelProblem):
            return False

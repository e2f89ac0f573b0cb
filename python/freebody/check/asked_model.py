"""A model as it is asked about: its state at a moment, the parameters that are free, and what is typical of its size and speed."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, CompiledModel, FreeBodies, MotionError, State, Trajectory, quote
from freebody.model.errors import ModelProblem
from freebody.model.start import Start, evaluate, initial_state
from freebody.run.moments import START, state_of
from freebody.solve.perturbed_states import independent
from freebody.symbolic.dimensions import LENGTH, NUMBER_ONLY, Dimension

from .families import NoMotion
from .integrals import EXACT
from .sides import changes_side, squares, strings_turn_over

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .admissible import UnderOtherLoads

WORD = re.compile(r"[^\W\d][\w.\[\]]*")
"""A name in an expression of the model language, also of a part of the model."""
_AT_REST = 1e-6  # of the rate of vibrations: below it a rate is the root of an acceleration that is round-off
_RTOL = 1e-7  # of runs: every state on them is solved anew, so that they need not be accurate
_STEPS = 2000  # of a run, which is short
_TO_MOMENT = 20_000  # of one up to a moment
_MOMENTS, _HALVES = 12, 8  # of a motion, at which its assembly is looked at, and how often it is halved where that changes
_SAME_PLACE = 1e-3  # of the sizes of coordinates: where two states differ by more, they are of two assemblies
_SOON = 1e-4  # of the time typical of the model: what starts with a speed has moved a hundred times as far as what starts without
_SWITCH = re.compile(r"0(?:\.0*)?|-?1(?:\.0*)?")
_NO_GAP = 1e-9  # of the size of the model, at which parts touch
_STRIDE = 4.0  # by which a length grows from place to place on the way to where it is far larger
_DEPENDENT = (
    0.05  # part of the motions by which loops stay closed that moves a coordinate: below it loops are near a dead position for it
)


def does(event: Mapping[str, Any], what: str) -> bool:
    """Whether an event has an action, ``engage`` or ``release``: welds are engaged, and what is cut is released."""
    return any(what in action for action in event["then"] if isinstance(action, Mapping))


def _with_words(item: Any, change: Callable[[str], str]) -> Any:
    """Data with each text in it changed, but for units."""
    if isinstance(item, Mapping):
        return {key: each if key in ("name", "unit") else _with_words(each, change) for key, each in item.items()}
    if isinstance(item, str):
        return change(item)
    return [_with_words(each, change) for each in item] if isinstance(item, list | tuple) else item


def with_gravity(text: str, pull: float, name: str) -> str:
    """An expression with the name of gravity for its number, which is no other one unless it has the unit of something else."""
    number = rf"(?<![\w.]){re.escape(f'{pull:g}')}(?:\s*m/s(?:\^2|\*\*2|²))?"
    return re.sub(rf"{number}(?![\w.])(?!\s+[A-Za-zµ°])", name, text)


class AskedModel:
    """A model at a moment: by default the start, after the events there.

    ``asked`` are ``at``, ``before``, ``after``, ``initial``, ``t`` and changes, as in ``Mechanism.solve``."""

    def __init__(self, mechanism: Builder | UnderOtherLoads, **asked: Any) -> None:
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
        counts |= {name for name in self.switched if self._is_on_or_off(name, numbers)}
        changed = {name: evaluate(value, {}) for name, value in self.changes.items() if name in self.start.parameters}
        self.free_parameters = {name: float(value) for name, value in (numbers | changed).items() if name not in counts}
        """Parameters and states that are plain numbers in the model, with those; the others follow from them, count items, or are on or off."""

    @cached_property
    def switched(self) -> Mapping[str, set[str]]:
        """The parameters that events set, with the values that they give them."""
        found: dict[str, set[str]] = {}
        for action in (action for event in self.spec["events"] for action in event["then"] if isinstance(action, Mapping)):
            for name, value in action.get("set", {}).items():
                found.setdefault(name, set()).add(str(value))
        return found

    def _is_on_or_off(self, name: str, numbers: Mapping[str, Any]) -> bool:
        """Whether a parameter without a unit is a switch: it starts with, and events set it to, 0, 1 or −1 alone."""
        values = {str(numbers.get(name)), *self.switched[name]}
        return self.start.parameters.get(name) in (None, NUMBER_ONLY) and all(map(_SWITCH.fullmatch, values))

    def bound(self, values: Mapping[str, float], state: State) -> Array:
        """The parameters with other values; those that events have set by the moment as they are in a state."""
        p = self.core.bind(values)
        for k, given in enumerate(self.metadata["parameters"]):
            if given["name"] in self.switched and self.own.p[k] != self.first.p[k]:
                p[k] = state.p[k]
        return p

    def _parametrised_gravity(self) -> str | None:
        """A gravity that is a plain number becomes a parameter, so that nothing is true by the number 9.81."""
        given = self.spec.get("gravity")
        if given is None or not all(isinstance(part, int | float) for part in given) or given[0] != 0 or given[1] == 0:
            return None
        taken = {p["name"] for p in self.spec["parameters"]} | set(self.start.coordinates)
        name = next(name for name in ("g", "gravity", "gravity2") if name not in taken)
        self.spec["parameters"] += [{"name": name, "value": -given[1], "unit": "m/s^2"}]
        self.spec["gravity"] = [0.0, f"-{name}"]
        for kind in ("forces", "motions", "states", "parameters"):
            self.spec[kind] = [_with_words(item, lambda text: with_gravity(text, -given[1], name)) for item in self.spec[kind]]
        self.start = replace(self.start, parameters=self.start.parameters | {name: Dimension(length=1, time=-2)})
        return name

    @cached_property
    def own(self) -> State:
        """The state of the model at its moment. Raises ``ValueError`` where there is none."""
        found = self._at_moment(self.first)
        return replace(found, moment=self.stated or found.moment)

    def _at_moment(self, state: State, rates: Mapping[str, float] | None = None) -> State:
        """The state at the moment of the motion from a start, with ``rates`` or those there."""
        if rates is not None:
            state, _ = self.core.assemble(state.p, state.t, guess=self._named(state.q), rates=rates)
        there = {**self.moment, "max_steps": _TO_MOMENT, "rtol": EXACT}
        found = state if self.stated else state_of(self.mechanism, state, self.core, **there)
        is_new = found.history is None and self.restricted  # what holds there shows as it begins to move
        return replace(self.run(found, 1e-6 / self.rate).state(found.t), moment=found.moment) if is_new else found

    @cached_property
    def starts_to_move(self) -> bool:
        """Whether it is at rest at its moment, and every coordinate of it that loops leave free moves soon after."""
        soon = self.run(self.own, 0.1 / self.rate).end
        before, after = (np.abs(state.u) / (self.rate * self.sizes) for state in (self.own, soon))
        held = np.linalg.norm(self.free_rates, axis=1) <= _DEPENDENT  # by loops; what else holds may do so anywhere
        moving = (after > _AT_REST) | (held & bool(self.loops and not self.restricted))
        return bool(np.all(before <= _AT_REST) and np.all(moving) and np.any(after > _AT_REST))

    @cached_property
    def restricted(self) -> bool:
        """Whether limits, joint friction, events at the start or the moment decide what moves, so that states lie near that."""
        named = [event.get("opening") for event in self.spec["events"]] + [joint.get("friction") for joint in self.spec["joints"]]
        return bool(self.moment) or any(named) or not all(x.is_open for x in self.core.instant(self.first).limits.values())

    def require_touch(self, names: Collection[str]) -> None:
        """Raises ``NoMotion`` where those of some contacts and stops whose parts touch at the moment, without a speed between them, all
        open at once."""
        soon = self.run(self.own, _SOON / self.rate).end
        now, then = (self.core.instant(state).limits for state in (self.own, soon))
        there = [(now[name], then[name]) for name in names if name in now and name in then]
        near = (_NO_GAP * self.length, 0.01 * _SOON * self.length)
        if there and all(one.is_open and abs(one.gap) <= near[0] and abs(two.gap) <= near[1] for one, two in there):
            what = f"with its own numbers the model leaves `{' '.join(names)}` at once"
            raise NoMotion(f"{what}: give it others, with which it stays there")

    @cached_property
    def is_held(self) -> bool:
        """Whether friction of joints or a limit that is closed, other than a taut string, decides what moves."""
        rough = any(joint.get("friction") for joint in self.spec["joints"])
        strings = {string["name"] for string in self.spec["strings"]}
        limits = self.core.instant(self.own if self.moment else self.first).limits
        return rough or not all(limit.is_open for name, limit in limits.items() if name not in strings)

    def at_moment_with(self, values: Mapping[str, float]) -> State:
        """The state at the moment with other parameters. Raises ``MotionError`` and ``ModelProblem``."""
        return self._at_moment(self.started(values))

    @cached_property
    def _puts_in_place(self) -> bool:
        """Whether events fasten parts where they are: with other parameters these are elsewhere."""
        return any(does(event, "engage") for event in self.spec["events"])

    def run(self, state: State, until: float, rtol: float = _RTOL) -> Trajectory:
        return self.core.simulate(state, state.t + until, rtol=rtol, max_steps=_STEPS)

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
        words = initial_state(self.start, self.core, self.changes)
        return self.core.assemble(words.pop("p"), self.begins, **words)[0]

    def started(self, values: Mapping[str, float]) -> State:
        """The start with other parameters, its loops in the same assembly. Raises ``MotionError`` and ``ModelProblem``."""
        words = initial_state(self.start, self.core, self.changes | values)
        if self.loops:
            own = initial_state(self.start, self.core, self.changes)["guess"] if self.rolls_in_loop else words["guess"]
            follow = {
                name: q for name, q in words["guess"].items() if q != own[name]
            }  # where what rolls begins is not closed by loops
            words["guess"] |= self._named(self._closed(values, words["fixed"])) | follow
        found = self.core.assemble(words.pop("p"), self.begins, **words)[0]
        if self.spec["strings"] and strings_turn_over(self.core, self.spec, self.first, found):
            raise ModelProblem("a string is turned over at the start", "take other numbers")
        return found

    def _closed(self, values: Mapping[str, float], fixed: Mapping[str, float]) -> Array:
        """Where loops close with other parameters, in the assembly of the start; those that are far larger by strides, on which lengths grow with
        them. Raises ``MotionError``."""
        own, q = self.free_parameters, np.array([fixed.get(name, q) for name, q in self._named(self.first.q).items()])
        ratios = {name: x / own[name] for name, x in values.items() if own.get(name) and x / own[name] > 0}
        lengths = {name for name, its in self.start.parameters.items() if its == LENGTH}
        far = max((ratio for name, ratio in ratios.items() if name in lengths), default=1.0)
        strides = math.ceil(math.log(far, _STRIDE)) if far > 1 else 1
        for k in range(1, strides + 1):
            on_the_way = {name: own[name] * ratio ** (k / strides) for name, ratio in ratios.items()}
            p = self.core.bind({**values, **on_the_way} if k < strides else values)
            q = (self.core.assemble(p, self.begins, fixed, self._named(q))[0] if k > 1 else self.moved(self.first, q, {}, p=p)).q
            q = np.where([c["dimension"] == "m" and k < strides for c in self.coordinates], q * far ** (1 / strides), q)
        return q

    def moved(self, state: State, q: Array, rates: Mapping[str, float], t: float | None = None, p: Array | None = None) -> State:
        """A state of the same assembly and mode with coordinates ``q``, where loops leave them free. Raises ``MotionError``."""
        p, t, named = state.p if p is None else p, state.t if t is None else t, self._named(q)
        fixed = {self.names[i]: named.pop(self.names[i]) for i in self._places}
        return self.core.assemble(p, t, fixed, named, rates, history=state.history, beginning=state)[0]

    def staying(self, motion: Trajectory, begins: float, ends: float) -> float:
        """An end of a motion before which its loops are of the assembly in which it begins, and its distances on one side: it may go on
        through a singular position, or a point through its anchor."""
        for _ in range(_HALVES):
            states = [motion.state(t) for t in np.linspace(begins, ends, _MOMENTS).tolist()]
            if all(self.joined(one, other) for one, other in pairwise(states)):
                break
            ends = (begins + ends) / 2
        return ends

    def joined(self, one: State, other: State) -> bool:
        """Whether two places are of one assembly, and distances on one side."""
        if changes_side(self.core, self._squares, one.q, other):
            return False
        if not self.loops or self.rolls_in_loop:
            return True
        try:
            reached = self.moved(one, other.q, {}, t=other.t)
        except MotionError:
            return False
        return bool(np.all(np.abs(reached.q - other.q) < _SAME_PLACE * self.sizes))

    @cached_property
    def _squares(self) -> list[str]:
        return list(squares(self.spec))

    @cached_property
    def _places(self) -> list[int]:
        """Coordinates that say where closed loops are: those that the start gives as far as they are free, then those that move most."""
        given = [i for i, name in enumerate(self.names) if name in self.start.fixed or name in self.changes]
        rows, found = self.free_rates.copy(), list[int]()
        for _ in range(rows.shape[1]):
            sizes = np.linalg.norm(rows, axis=1)
            found.append(next((i for i in given if sizes[i] > _DEPENDENT), int(np.argmax(sizes))))
            along = rows[found[-1]] / sizes[found[-1]]
            rows -= np.outer(rows @ along, along)
        return found

    @cached_property
    def derived_start(self) -> set[str]:
        """Parameters with a formula that say where or how fast the model starts."""
        return {each["name"] for each in self.spec["parameters"] if isinstance(each["value"], str)} & {
            *WORD.findall(self._initial)
        }

    @cached_property
    def in_initial_or_events(self) -> set[str]:
        """The words in which it is said where and how fast the model starts, and what happens on its motion."""
        said = self._initial + json.dumps(self.spec["events"], ensure_ascii=False)
        return {*WORD.findall(self.with_formulas(said))}

    @property
    def _initial(self) -> str:
        initial = self.mechanism.model.initial
        return initial.model_dump_json() if initial else ""

    def with_formulas(self, text: str) -> str:
        """A part of the model as text, with the formulas of the parameters that stand in it."""
        for parameter in reversed(self.spec["parameters"]):
            if isinstance(parameter["value"], str) and parameter["name"] in WORD.findall(text):
                text += f" {parameter['value']}"
        return text

    @cached_property
    def frictions(self) -> list[str]:
        """Free parameters that are a coefficient of friction."""
        rough = [*self.spec["contacts"], *(joint.get("friction") or {} for joint in self.spec["joints"])]
        written = [item.get(word) for item in rough for word in ("friction", "static_friction", "kinetic", "fixed")]
        return [name for name in self.free_parameters if name in written]

    @cached_property
    def dampings(self) -> list[str]:
        """Free parameters that are a coefficient of damping."""
        written = [force["with"].get(word) for force in self.spec["forces"] for word in ("damping", "coefficient")]
        return [name for name in self.free_parameters if name in written]

    @cached_property
    def torsional(self) -> set[str]:
        """Free parameters that are the stiffness of a torsion spring."""
        written = {force["with"].get("stiffness") for force in self.spec["forces"] if force["type"] == "torsion_spring"}
        return written & self.free_parameters.keys()

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
        equilibrium, that of vibrations about it, or of what falls."""
        found = float(np.max(np.abs(self.first.u / self.sizes), initial=0.0))
        with suppress(MotionError):
            n, falls = len(self.names), [f"rate(rate({quote(name)}))" for name in self.names]
            accelerations, by = self.core.evaluate(falls, self.first), self.core.derivatives(falls, self.first)[:, 1 : n + 1]
            found = max(found, math.sqrt(np.max(np.abs(accelerations / self.sizes), initial=0.0)))
            stiff = np.abs(by * self.sizes / self.sizes[:, None]).max(axis=1, initial=0.0)
            vibrations = math.sqrt(min((x for x in stiff if x > _AT_REST**2 * stiff.max()), default=0.0))  # the slowest
            gravity = np.hypot(*self.core.evaluate([str(part) for part in self.spec.get("gravity") or (0, 0)], self.first))
            falling = math.sqrt(gravity / self.length)
            natural = vibrations if vibrations > _AT_REST * falling else falling
            found = natural if found < _AT_REST * natural else found
        return found or 1.0

    def unit(self, dimension: Dimension | None) -> float:
        """What is typical of a dimension, SI."""
        if dimension is None:
            return 1.0
        mass = max([b["mass"] for b in self.metadata["bodies"] if b.get("mass")], default=1.0)
        return mass**dimension.mass * self.length**dimension.length * self.rate ** (-dimension.time)

    @cached_property
    def free_rates(self) -> Array:
        """Rates over ``sizes`` that can be given at will, (n, f), one a column: those by which loops stay closed, what touches goes on
        touching, and what is locked or driven stays so."""
        return self.rates_free_in(self._loads)

    def rates_free_in(self, loads: FreeBodies) -> Array:
        """The same in a state with such loads."""
        free = [motion["name"] for motion in self.spec["motions"] if motion["level"] == "acceleration"]
        rows = [[row.coefficients[name] for name in self.names] for row in loads.rows if row.name not in free]
        held = np.array(rows).reshape(len(rows), len(self.names)) * self.sizes
        return np.linalg.svd(held)[2][len(independent(held)) :].T

    @property
    def moves_one_way(self) -> bool:
        """Whether one rate says all others."""
        return self.free_rates.shape[1] == 1

    @cached_property
    def loops(self) -> int:
        """How many joints close a loop."""
        return len(self.metadata.get("closure_coordinates", [])) + sum(1 for j in self.metadata["joints"] if j.get("cut"))

    @cached_property
    def rolls_in_loop(self) -> bool:
        """Whether something that rolls or meshes closes a loop: that binds rates, and of the places only what follows from the start."""
        cut = {joint["name"] for joint in self.metadata["joints"] if joint.get("cut")}
        return any(
            joint["name"] in cut and joint["type"].startswith(("rolling", "gear", "belt")) for joint in self.spec["joints"]
        )

    def shapes_loop(self, name: str) -> bool:
        """Whether a parameter may be a length of a closed loop."""
        dimension = self.start.parameters.get(name)
        return self.loops > 0 and (dimension is None or (dimension.mass == 0 and dimension.time == 0))

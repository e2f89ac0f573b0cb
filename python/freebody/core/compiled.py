"""A compiled model: what is asked of the core, and what it answers."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from freebody import _core

from .cards import methods
from .free_bodies import FreeBodies
from .motion import Trajectory
from .solution import RowDerivatives, Solution, SymbolicAnswers
from .state import Array, State

Spec = dict[str, Any]
"""A model as the core reads it; crates/freebody/src/spec/ says what stands in it."""
BEFORE = "before "
"""In front of an event's name: the moment just before it."""
EXTREMES = ("max", "min", "maxima", "minima", "mean", "rms", "integral")
"""What a report can ask for of a whole run, or a part of it."""
_PLAIN_WORD = re.compile(r"[^\W\d]\w*(\[[^\]]*\])*")


def quote(name: str) -> str:
    """The name as expressions read it: words that are not plain stand in quotes, ``'crank drive'.pin``."""
    return ".".join(part if _PLAIN_WORD.fullmatch(part) else re.sub(r"^[^\[]+", r"'\g<0>'", part) for part in name.split("."))


@dataclass(frozen=True)
class Settings:
    """How a run is made; times in s. ``every`` is the spacing of the output grid, ``impacts`` and ``painleve`` are the laws
    of impacts and of friction that jams. ``until`` may be left to whoever starts the run."""

    until: float | None = None
    method: str = next(iter(methods()))
    rtol: float = 1e-9
    step: float | None = None
    max_step: float | None = None
    route: str = "auto"
    every: float | None = None
    impacts: str = "stop"
    painleve: str = "stop"


@dataclass(frozen=True)
class ReportItem:
    """A quantity that the model asks for.

    ``how`` is ``at`` or one of ``EXTREMES``; ``at`` is ``start``, ``end``, an event's name, ``before``
    and an event's name, or a time in s; ``over`` is a window in s; ``unit`` converts the printed figure, empty: SI. In a model without
    numbers a time may be an expression of parameters, marked by ``=``.
    """

    label: str
    value: str
    how: str = "at"
    at: str | float = "end"
    over: tuple[Any, Any] | None = None
    unit: str = ""


@dataclass(frozen=True)
class PlotItem:
    """A plot that the model asks for: curves of expressions over ``t``, or one expression over another, or ``around`` an angle."""

    title: str
    up: tuple[str, ...]
    across: str = "t"
    around: bool = False


@dataclass(frozen=True, eq=False)
class CompiledModel:
    """A mechanism without numbers, with the ``spec`` that it was compiled from; beside it the ``model`` as its file says it, what to
    ``report``, which ``plots`` it wants, how its bodies look (``looks``), and what is worth saying about its assembly (``notes``).

    Where a state has no answer ``MotionError`` is raised, and ``ModelError`` for an expression or word that means nothing."""

    mechanism: _core.Mechanism
    spec: Spec
    model: Mapping[str, Any] = field(default_factory=dict)
    report: tuple[ReportItem, ...] = ()
    plots: tuple[PlotItem, ...] = ()
    looks: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @classmethod
    def of(cls, spec: Spec) -> CompiledModel:
        """From the core's terms. Raises ``ModelError``."""
        return cls(_core.Mechanism(spec), spec)

    def with_notes(self, notes: Sequence[str]) -> CompiledModel:
        """The same mechanism with these notes."""
        return replace(self, notes=tuple(notes)) if notes or self.notes else self

    @property
    def metadata(self) -> dict[str, Any]:
        """What the core says of the mechanism: bodies, coordinates, joints and so on; always the same object."""
        return self.mechanism.describe()

    @cached_property
    def coordinate_names(self) -> list[str]:
        """The names of the coordinates of the tree, in the order of ``State.q``."""
        return [c["name"] for c in self.metadata["coordinates"]]

    @cached_property
    def dependent_coordinates(self) -> list[dict[str, Any]]:
        """The coordinates that the model names at joints that close loops or can be released: they follow from the others."""
        return [c for c in self.metadata["closure_coordinates"] if c["name"] != f"{c['joint']}.{c['word']}"]

    @property
    def name(self) -> str:
        """Title for reports."""
        return self.spec.get("name") or "mechanism"

    def bind(self, values: Mapping[str, float] | None = None) -> Array:
        """All parameters (np,), those named in ``values`` overruled. Raises ``ModelError`` for numbers that cannot be."""
        return self.mechanism.bind(dict(values or {}))

    def bind_rows(self, columns: Mapping[str, Array]) -> Array:
        """The parameters (members, np) of many, those named in ``columns`` (members,) overruled. Raises ``ModelError``, which names the
        member."""
        return self.mechanism.bind_rows(list(columns), np.column_stack(list(columns.values())))

    def starts(
        self,
        asked: Sequence[Mapping[str, Any]],
        p: Array,
        t: float,
        threads: int,
        fixed: Mapping[str, Array] | None = None,
        rates: Mapping[str, Array] | None = None,
    ) -> tuple[Array, Array]:
        """Coordinates and rates (members, n) of many starts at the rows of ``p``, each to the last bit as ``assemble`` finds it by the
        arguments ``asked`` of it. Those of one are asked of all, with other values of what is ``fixed`` and of ``rates`` by columns
        (members,). Raises ``MotionError``, which names the first member that has none."""
        columns = [{name: np.ascontiguousarray(column) for name, column in (each or {}).items()} for each in (fixed, rates)]
        q, u = self.mechanism.starts(t, list(asked), np.ascontiguousarray(p), columns, threads)
        return q, u

    @property
    def runs_in_lanes(self) -> bool:
        """Whether ``batch`` makes its motions by ``rk4`` side by side: it is a tree, and nothing switches, happens or is looked up."""
        return self.mechanism.runs_in_lanes()

    @cached_property
    def reaction_names(self) -> list[str]:
        """The names of the reactions of ``batch``, as an ``Evaluator`` has them."""
        return self.mechanism.reaction_names()

    def batch(
        self, p: Array, q: Array, u: Array, t: float, until: float, times: Array, threads: int, reactions: bool, **settings: Any
    ) -> tuple[Array, dict[str, list[Any]]]:
        """The motions from many states, in rows of ``q``, ``u`` and ``p`` (or one row of ``p`` for all): coordinates and rates (members,
        nt, 2 n) at ``times``, with ``reactions=True`` followed by accelerations and reactions (members, nt, 3 n + k), NaN after the end of
        a motion, and how each ended, in columns like the fields of ``Outcome``. The other ``settings`` as in ``simulate``. Each has the same
        bits on any number of ``threads``, and whatever stands beside it."""
        rows = [np.ascontiguousarray(each) for each in (p, q, u)]
        n = q.shape[1]
        made = np.empty((len(q), len(times), 3 * n + len(self.reaction_names) if reactions else 2 * n))
        endings = self.mechanism.batch(rows, [t, until], times, made, threads, reactions=reactions, **settings)
        return made, dict(zip(("name", "ok", "t", "sentence", "path"), map(list, zip(*endings, strict=True)), strict=True))

    def assemble(
        self,
        p: Array,
        t: float = 0.0,
        fixed: Mapping[str, float] | None = None,
        guess: Mapping[str, float] | None = None,
        rates: Mapping[str, float] | None = None,
        points: Mapping[str, Sequence[float]] | None = None,
        branch: Mapping[str, int] | None = None,
        history: _core.History | None = None,
        beginning: State | None = None,
    ) -> tuple[State, list[str]]:
        """A state with all loops closed, that keeps what is ``fixed``, ``rates`` and places of ``points`` (m), near ``guess``, with
        expressions positive or negative as ``branch`` says; and what is worth saying about it. With the ``history`` of a motion what
        it has brought in place, and what touches, stays so. From a ``beginning`` it is reached along the mechanism, past no singular
        position of the loops with what is fixed, so that it is of the same assembly."""
        asked = (fixed or {}, guess or {}, rates or {}, points or {}, branch or {})
        q, u, notes = self.mechanism.assemble(p, t, *map(dict, asked), history, beginning and beginning.arrays)
        return State(p, t, q, u, history), [*notes["adjusted"], *notes["branch"], *notes["behind"]]

    def as_it_holds(self, state: State) -> tuple[CompiledModel, State]:
        """The mechanism without its events, and a state before which nothing moved in its coordinates: joints that events release or
        engage are out of the tree, and without those events the coordinates that are declared at them describe what they join."""
        if state.history is not None or not self._switched:
            return self, state
        made = self._without_events
        if any(name.startswith(f"{joint}.") for name in made.coordinate_names for joint in self._switched):
            return self, state
        names = [quote(name) for name in made.coordinate_names]
        q, u = np.split(self.evaluate([*names, *(f"rate({name})" for name in names)], state), 2)
        return made, replace(state, q=q, u=u)

    @cached_property
    def _switched(self) -> set[str]:
        """The joints that events release or engage."""
        actions = [action for event in self.spec["events"] for action in event["then"] if isinstance(action, Mapping)]
        named = {name for action in actions for word in ("release", "engage") for name in action.get(word, ())}
        return named & {joint["name"] for joint in self.spec["joints"]}

    @cached_property
    def _without_events(self) -> CompiledModel:
        spec = {**self.spec, "events": []}
        return replace(self, mechanism=_core.Mechanism(spec), spec=spec)

    def instant(self, state: State, route: str = "minimal") -> Solution:
        """Accelerations and all reactions by ``minimal``, ``newton_euler`` or ``constraints``."""
        p, t, q, u, history = state.arrays
        asked = (p.copy(), t, q.copy(), u.copy(), history)  # that of which it is judged later, whatever becomes of the arrays
        return Solution.read(self.mechanism.instant(asked, route), self.metadata, lambda: self.mechanism.balances(asked, route))

    def free_bodies(self, state: State) -> FreeBodies:
        """All that acts on each body."""
        return FreeBodies.read(self.mechanism.free_bodies(state.arrays))

    def symbolic_answers(
        self,
        state: State,
        questions: Sequence[Mapping[str, Any]],
        at_rest: bool = False,
        numbers: Mapping[str, float] | None = None,
    ) -> SymbolicAnswers:
        """What is asked of a state symbolically; crates/freebody/src/symbolic/query.rs lists the questions. Symbols among
        ``numbers`` are these numbers."""
        setting = {"at_rest": at_rest, "numbers": dict(numbers or {})}
        return SymbolicAnswers.read(self.mechanism.symbolic_answers(state.arrays, setting, list(questions)))

    def evaluate(self, texts: Sequence[str], state: State) -> Array:
        """Values (k,) of expressions; works are those of the motion that brought the state, 0 without one."""
        return self.mechanism.evaluate(list(texts), state.arrays)

    def derivatives(self, texts: Sequence[str], state: State) -> Array:
        """Derivatives (k, 1 + 2 n + np) of expressions by time, coordinates, rates and parameters, in the mode of the state."""
        return self.mechanism.derivatives(list(texts), state.arrays).T

    def row_derivatives(self, state: State) -> list[RowDerivatives]:
        """Of each row that closes a loop, prescribes a motion, or holds what touches, in the mode of the state."""
        found = self.mechanism.row_derivatives(state.arrays)
        made = [(name, sticks, *(None if x is None else np.array(x) for x in rows)) for name, sticks, *rows in found]
        return [RowDerivatives(*row) for row in made]

    def mass_matrix(self, state: State) -> Array:
        """The mass matrix (n, n) of the tree, by its coordinates: twice the kinetic energy is u M u."""
        return self.mechanism.mass_matrix(state.p, state.q)

    def points(self, p: Array) -> dict[str, tuple[str, float, float]]:
        """Named points: body, x and y in its frame (m)."""
        return {name: (body, x, y) for name, (body, x, y) in self.mechanism.points(p).items()}

    def simulate(self, state: State, until: float, **settings: Any) -> Trajectory:
        """The motion from a state to a time. ``settings`` are those of ``Settings``, ``max_steps``, and ``progress``: a function
        of t, called now and then, that interrupts by returning False. ``after``: a motion at whose end this one starts; what it
        has released, engaged and wound up stays so."""
        run = self.mechanism.simulate(state.arrays, until, **settings)
        tables = [f"{table['name']}(" for table in self.spec.get("tables", ())]
        reported = [item.value for item in self.report if any(called in item.value for called in tables)]
        return Trajectory(run, self.metadata, reported)

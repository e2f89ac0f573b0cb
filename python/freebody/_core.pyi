"""The compiled core: numbers in, numbers out; plain data (dicts, lists, text) beside arrays. Only ``freebody.core`` reads it,
which says what everything means."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
State = tuple[Array, float, Array, Array]
"""p (np,), t, q (n,), u (n,)."""

def parse(text: str) -> dict[str, Any]:
    """The syntax tree of an expression (see crates/freebody/src/expr/ast.rs). Raises ExpressionError."""

def cards() -> dict[str, Any]:
    """``{"joints": [card], "forces": [card], "shapes": [card], "functions", "readings", "phrases", "methods"}``.

    card = ``{"type", "doc", "fields": [{"name", "kind", "dimension", "default", "doc"}], "coordinates": [{"name", "dimension"}]}``.
    ``kind`` is one of point, points, line, circle, curve, body, number, numbers, law (an expression of time and
    state), gauge (an expression of the configuration), flag, choice:a|b. ``default`` null = required.
    ``dimension`` is a unit text in SI, e.g. ``m``, ``rad``, ``N/m``, ``""`` for none and null for "any".
    """

def time_chain(n: int, repeats: int) -> float:
    """Seconds for one acceleration solve of a chain of ``n`` bars; for benchmarks."""

class Evaluator:
    """Accelerations and all reactions of a mechanism at one state after another, as arrays; made by ``Mechanism.evaluator``."""

    coordinates: list[str]
    """The names of the coordinates, in the order of q and of the accelerations."""
    reactions: list[str]
    """The names of the reactions: of each joint the force on its second body along the fixed axes and the couple about its point, the force
    or torque of each motion and coupling, and of each contact, stop and string the force on its first body."""
    parameters: list[str]
    """The names of the parameters, in the order of p."""

    def __init__(self, spec: Mapping[str, Any], p: Array) -> None:
        """``spec``: crates/freebody/src/spec/; all parameters (np,) that are meant where none are given."""

    def __call__(self, q: ArrayLike, u: ArrayLike, p: ArrayLike | None = None, t: float = 0.0) -> tuple[Array, Array]:
        """Accelerations (n,), m/s² or rad/s², and reactions (k,), N and N·m, at coordinates (n,), rates (n,), all parameters (np,) and a
        time, s. A reaction that the balances leave open is NaN. The state decides by itself what touches, is taut or slides. Loops are
        not closed: ``q`` and ``u`` must keep them. Raises MotionError."""

class Mechanism:
    """A compiled model: topology without numbers. Raises ModelError and MotionError."""

    def __init__(self, spec: Mapping[str, Any]) -> None:
        """``spec``: crates/freebody/src/spec/."""

    def describe(self) -> dict[str, Any]:
        """``bodies`` [{name, mass, inertia, centre:[x,y], particle}], ``parameters`` [{name, unit, value}],
        ``coordinates`` (the state, in order) [{name, joint, dimension ("m" or "rad"), absolute, doc}],
        ``closure_coordinates`` (of cut joints; measured, not integrated), ``joints`` [{name, type, first, second, point, cut,
        coordinates, reaction: [labels]}], ``forces`` [{name, type, conservative}], ``motions`` [{name, level, ideal, engaged}],
        ``locks`` [{name, first, second, turns: whether it passes a couple}],
        ``limits`` (contacts, strings and stops) [{name, type, first, second, engaged}],
        ``events`` [names], ``freedom`` {count, joints_count}, ``notes`` [str: what is modelled, ignored, assumed]."""

    def bind(self, values: dict[str, float]) -> Array: ...
    def bind_rows(self, names: list[str], columns: Array) -> Array:
        """Parameters (members, np), those of the names given in columns (members, k)."""

    def starts(
        self, t: float, asked: list[Mapping[str, Any]], p: Array, columns: Sequence[Mapping[str, Array]], threads: int
    ) -> list[Array]:
        """q and u (members, n) at p (members, np); of each, or of all, is asked ``{"fixed", "guess", "rates", "points", "branch"}`` as in
        ``assemble``, with other values of what is fixed and of rates by columns (members,)."""

    def reaction_names(self) -> list[str]: ...
    def runs_in_lanes(self) -> bool: ...
    def batch(
        self,
        states: Sequence[Array],
        span: Sequence[float],
        times: Array,
        made: Array,
        threads: int,
        method: str,
        rtol: float,
        step: float | None,
        max_step: float | None,
        route: str,
        impacts: str,
        painleve: str,
        reactions: bool,
        max_steps: int = 1_000_000,
    ) -> list[tuple[Any, bool, float, str, str]]:
        """Of p (members or 1, np), q and u (members, n): writes the states (members, nt, 2 n), with ``reactions`` followed by accelerations
        and all reactions, to ``made``; how each motion ended: name, whether that is as asked, when, a sentence, the item that it is about."""

    def assemble(
        self,
        p: Array,
        t: float,
        fixed: dict[str, float],
        guess: dict[str, float],
        rates: dict[str, float],
        points: dict[str, Sequence[float]],
        branch: dict[str, int],
        history: Any,
        beginning: State | None,
    ) -> tuple[Array, Array, dict[str, Any]]:
        """q, u, and ``{"branch": [str], "adjusted": [str], "behind": [str], "gap": float}``."""

    def instant(self, state: State, route: str) -> dict[str, Any]: ...
    def free_bodies(self, state: State) -> dict[str, Any]: ...
    def symbolic_answers(
        self, state: State, setting: Mapping[str, Any], questions: Sequence[Mapping[str, Any]]
    ) -> dict[str, Any]: ...
    def evaluate(self, texts: list[str], state: State) -> Array: ...
    def points(self, p: Array) -> dict[str, list[Any]]: ...
    def mass_matrix(self, p: Array, q: Array) -> Array:
        """Of the tree in the coordinates of ``q``, (n, n)."""

    def simulate(
        self,
        state: State,
        until: float,
        method: str = ...,
        rtol: float = 1e-9,
        step: float | None = None,
        max_step: float | None = None,
        route: str = "auto",
        max_steps: int = 1_000_000,
        progress: Callable[[float], bool] | None = None,
        impacts: str = "stop",
        painleve: str = "stop",
        after: Trajectory | None = None,
    ) -> Trajectory: ...

class Trajectory:
    """A finished run with dense output."""

    steps: Array
    def record(self, reported: list[str]) -> dict[str, Any]:
        """``events``, ``changes``, ``outcome`` and ``stats``."""

    def sample(self, times: Array) -> tuple[Array, Array]: ...
    def evaluate(self, texts: list[str], times: Array) -> Array: ...
    def poses(self, times: Array) -> Array: ...
    def reactions(self, times: Array) -> Array: ...
    def ledger(self, times: Array) -> tuple[list[str], Array]: ...
    def state(self, t: float) -> State: ...
    def state_of_impact(self, change: int) -> State: ...
    def impact_derivatives(self, change: int) -> Array: ...
    def end(self) -> State: ...

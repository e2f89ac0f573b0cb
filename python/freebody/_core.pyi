"""The compiled core: numbers in, numbers out. Text crosses as JSON, arrays as NumPy."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

class ModelError(ValueError):
    """A model that cannot be compiled. ``args = (path, what, hint)``; ``path`` like ``joints.pivot.of[1]``."""

class ExpressionError(ValueError):
    """Text that is no expression. ``args = (start, end, what, hint)``, offsets in characters."""

class MotionError(RuntimeError):
    """A state that has no answer. ``args = (kind, path, what, hint)``; kind e.g. ``singular_mass``, ``cannot_assemble``;
    ``path`` like ``joints.pivot``, or empty."""

def parse(text: str) -> str:
    """The syntax tree of an expression, as JSON (see crates/freebody/src/expr/ast.rs)."""

def cards() -> str:
    """JSON ``{"joints": [card], "forces": [card], "shapes": [card]}``.

    card = ``{"type", "doc", "fields": [{"name", "kind", "dimension", "default", "doc"}], "coordinates": [{"name", "dimension"}]}``.
    ``kind`` is one of point, points, line, circle, curve, body, number, numbers, law (an expression of time and
    state), gauge (an expression of the configuration), flag, choice:a|b. ``default`` null = required.
    ``dimension`` is a unit text in SI, e.g. ``m``, ``rad``, ``N/m``, ``""`` for none and null for "any".
    """

class Mechanism:
    """A compiled model: topology without numbers."""

    def __init__(self, spec: str) -> None:
        """``spec``: JSON of crates/freebody/src/spec.rs. Raises ModelError."""

    def describe(self) -> str:
        """JSON: ``bodies`` [{name, mass, inertia, centre:[x,y], particle}], ``parameters`` [{name, unit, value}],
        ``coordinates`` (the state, in order) [{name, joint, dimension ("m" or "rad"), absolute, doc}],
        ``closure_coordinates`` (of cut joints; measured, not integrated), ``joints`` [{name, type, first, second, point, cut,
        coordinates, reaction: [labels]}], ``forces`` [{name, type, conservative}], ``motions`` [{name, of, level, ideal}],
        ``limits`` (contacts, strings and stops) [{name, type, first, second, engaged}],
        ``events`` [names], ``freedom`` {count, joints_count}, ``notes`` [str: what is modelled, ignored, assumed]."""

    def bind(self, values: Mapping[str, float]) -> Array:
        """All parameters (np,), those named in ``values`` overruled."""

    def assemble(
        self,
        p: Array,
        t: float = 0.0,
        fixed: Mapping[str, float] = ...,
        guess: Mapping[str, float] = ...,
        rates: Mapping[str, float] = ...,
        points: Mapping[str, Sequence[float]] = ...,
        branch: Mapping[str, int] = ...,
    ) -> tuple[Array, Array, str]:
        """Coordinates q (n,), rates u (n,) with all loops closed, and JSON notes {"branch": [str], "adjusted": [str], "gap": float}."""

    def instant(self, p: Array, t: float, q: Array, u: Array, route: str = "minimal") -> Instant:
        """Accelerations and all reactions at a state by ``minimal``, ``newton_euler`` or ``constraints``."""

    def free_bodies(self, p: Array, t: float, q: Array, u: Array) -> str:
        """JSON {"bodies", "loads", "rows", "accelerations"}: all that acts on each body at a state; see ``freebody.free_body``."""

    def letters(self, p: Array, t: float, q: Array, u: Array, setting: str, questions: str) -> str:
        """JSON {"answers", "loads", "letters"}: what is asked of a state, in letters; ``letters/question.rs`` lists the questions."""

    def evaluate(self, texts: Sequence[str], p: Array, t: float, q: Array, u: Array) -> Array:
        """Values (k,) of observable expressions at a state; works count as 0."""

    def points(self, p: Array) -> str:
        """JSON {point name: [body, x, y]} in body frames, lines and curves too, for drawings."""

    def simulate(
        self,
        p: Array,
        t: float,
        q: Array,
        u: Array,
        until: float,
        method: str = "dop853",
        rtol: float = 1e-9,
        step: float | None = None,
        max_step: float | None = None,
        route: str = "auto",
        max_steps: int = 1_000_000,
        progress: Callable[[float], bool] | None = None,
        impacts: str = "stop",
        painleve: str = "stop",
        after: Trajectory | None = None,
    ) -> Trajectory:
        """The motion from a state. ``progress(t)`` is called now and then; returning False interrupts.

        ``impacts`` is newton, poisson, sequential or stop; ``painleve`` is stop or impact. ``after``: a motion at whose end this
        one starts; what it has released, engaged and wound up stays so."""

class Instant:
    """One instant, solved."""

    accelerations: Array  # (n,) q̈ of the state coordinates
    body_accelerations: Array  # (nb, 3) ax, ay of the mass centre, α
    reactions: Array  # (nj, 3) Fx, Fy on the second body at the joint's point, couple M; NaN where indeterminate
    least_reactions: Array  # (nj, 3) the minimum-norm member, where reactions are indeterminate
    determinate: NDArray[np.bool_]  # (nj, 3)
    motions: Array  # (nmotions,) force or torque of each prescribed motion
    residual: float  # largest momentum-balance residual of a body, relative to the largest term
    sizes: tuple[float, float]  # largest force (N) and acceleration (m/s²) among the terms that balance
    body_residuals: Array  # (nb, 3) N, N, N·m
    limits: str  # JSON [{"state", "gap", "normal", "friction", "force": on the first body, "at"}], as in ``describe()["limits"]``
    rank: str  # JSON {"freedom", "count", "rank", "rows", "redundant", "explanation", "self_stress": [str]}

class Trajectory:
    """A finished run with dense output."""

    steps: Array  # (ns,) times of the accepted steps, first and last included
    events: str  # JSON [{"name", "t", "kind": "crossing"|"touch", "direction", "q", "u"}]
    changes: str  # JSON [{"t", "kind", "of": [names], "lost", "note", "impulses": {"limits": [[name, [x, y]]], "joints"}, "before", "after": {"q", "u"}}]
    outcome: str  # JSON {"name", "ok", "t", "sentence", "path": "joints.pivot", or empty}
    stats: str  # JSON {"accepted", "rejected", "evaluations", "method", "rtol", "closure": worst gap, …}
    def sample(self, times: Array) -> tuple[Array, Array]:
        """q, u (nt, n) at times within the run, on the closed loops."""
    def evaluate(self, texts: Sequence[str], times: Array) -> Array:
        """Observable expressions (nt, k); reactions and accelerations are solved again at each time."""
    def poses(self, times: Array) -> Array:
        """Frame origin x, y and angle of every body (nt, nb, 3)."""
    def instants(self, times: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Reactions (nt, nj, 3) and whether they are determinate."""
    def instant(self, t: float, route: str = "minimal") -> Instant:
        """Everything about one time, with what is in place and holds then."""
    def free_bodies(self, t: float) -> str:
        """As that of ``Mechanism``, with what is in place and holds then."""
    def letters(self, t: float, setting: str, questions: str) -> str:
        """As that of ``Mechanism``, with what is in place and holds then."""
    def ledger(self, times: Array) -> tuple[list[str], Array]:
        """Column names and values (nt, k): kinetic, potential, work of each non-conservative force and motion, balance."""
    def final(self) -> tuple[float, Array, Array, Array, str]:
        """t, q, u, parameters p at the end of the run, and the mode as JSON: enough to continue from."""

"""Return maps: from what a motion starts with to what it has when it comes back, with the exact derivative."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array
from freebody.periodic import start
from freebody.periodic.saltation import Moment, Perturbation
from freebody.periodic.variation import VectorField, transition
from freebody.run.simulation import Run

if TYPE_CHECKING:
    from freebody.model.builder import Builder

RTOL = 1e-13
"""Relative tolerance of the runs, unless another is asked for."""


class NoReturn(ValueError):
    """A motion does not come back: why."""


@dataclass(frozen=True)
class Return:
    """Where a motion comes back: the ``values`` (k,) of the unknowns there, ``slopes`` (k, k) their derivatives by those of the
    start, and the time that it takes, s. ``scales`` (k,) are the largest sizes that they had on the way, a coordinate
    at least a radian or the size of the mechanism, a rate that over the time of the return.

    ``checks`` say to how much the derivative was found right: the error of the variational equation, by halved steps; Liouville's
    formula for its determinant; and that a shift along the motion is carried into a shift along the motion."""

    values: Array
    slopes: Array
    time: float
    scales: Array
    checks: Mapping[str, float]
    run: Run


@dataclass(frozen=True)
class ReturnMap:
    """The map from values of ``unknowns`` (parameters of the start, coordinates, ``rate(coordinate)``) to those of the expressions
    ``returns`` when the motion comes back: after a ``period`` (an expression of parameters), or when the event, contact, string
    or stop ``section`` next switches, just after that. ``others`` are changes of the start; ``horizon`` is the longest time
    that a motion is followed for, s."""

    mechanism: Builder
    unknowns: tuple[str, ...]
    returns: tuple[str, ...]
    section: str | None
    period: str | None
    others: Mapping[str, Any]
    rtol: float
    horizon: float

    def __call__(self, values: Sequence[float] | Array, **others: Any) -> Return:
        """One return. Raises ``NoReturn`` and ``NotDifferentiable``; ``MotionError`` and ``ModelProblem`` for an impossible start."""
        run, end = self.run(np.asarray(values, float), others)
        field = VectorField(run)
        perturbation, checks = self._carried(field, run, end, others)
        source = run.source
        there, shift = perturbation, np.zeros(perturbation.state.shape[1])
        state = run.motion.state(end)
        if self.section:
            there, shift = Moment(run, field, end).through(perturbation)
        else:
            shift = field.split(source.derivatives([str(self.period)], run.start))[1][0] @ perturbation.others
            there = Perturbation(perturbation.state + np.outer(field(state), shift), perturbation.others)
        by_state, by_others = field.split(source.derivatives(self.returns, state))
        slopes = by_state @ there.state + by_others @ there.others
        k = len(self.unknowns)
        steps = run.motion.steps
        largest = np.abs(run.motion.evaluate(self.returns, steps[steps < end])).max(axis=0)
        own = dict(zip(field.names, field.sizes, strict=True))
        own |= {f"rate({name})": size / (end - run.start.t) for name, size in own.items()}
        scales = np.maximum(largest, [own.get(name, 0.0) for name in self.unknowns])
        values = source.evaluate(self.returns, state)
        return Return(values, slopes[:, :k], end - run.start.t, scales, checks, run)

    def value(self, values: Sequence[float] | Array, **others: Any) -> tuple[Array, float]:
        """The values at the return (k,) and its time, without their derivatives."""
        run, end = self.run(np.asarray(values, float), others)
        return run.source.evaluate(self.returns, run.motion.state(end)), end - run.start.t

    def run(self, values: Array, others: Mapping[str, Any]) -> tuple[Run, float]:
        """The motion from a start, and when it comes back, s. Raises as a return."""
        mechanism, changes = self.mechanism, start.changes(self.unknowns, values, {**self.others, **others})
        until = self.horizon
        if self.period:
            state, _ = mechanism.start(**changes)
            until = float(mechanism.compile().evaluate([self.period], state)[0])
        run = mechanism.simulate(until=until, rtol=self.rtol, **changes)
        end = until if self.period else self._section(run)
        if not run.outcome.ok and run.end.t < end:
            raise NoReturn(f"the motion ends at t = {run.end.t:g} s: {run.outcome.sentence}")
        return run, end

    def _section(self, run: Run) -> float:
        """When the section is first come to after the start."""
        names = {event.name for event in run.events} | {name for change in run.changes for name in change.of}
        wanted = {name for name in names if name == self.section or name.partition("[")[0] == self.section}
        times = [event.t for event in run.events if event.name in wanted]
        times += [change.t for change in run.changes if wanted & set(change.of)]
        if later := [t for t in times if t > run.start.t]:
            return min(later)
        why = "" if run.outcome.ok else f"; {run.outcome.sentence}"
        raise NoReturn(f"the motion does not come to `{self.section}` within {run.end.t - run.start.t:g} s{why}")

    def _carried(
        self, field: VectorField, run: Run, end: float, others: Mapping[str, Any]
    ) -> tuple[Perturbation, dict[str, float]]:
        """The perturbations by the unknowns just before the end, and, as the last column, that along the motion."""
        lowered = self.mechanism.lowered().start
        state, by = start.slopes(field, lowered, run.start, self.unknowns, {**self.others, **others})
        first = run.motion.state(run.motion.steps[0])
        along = np.eye(len(by), 1)
        perturbation = Perturbation(np.hstack([state, field(first)[:, None]]), np.hstack([by, along]))
        steps = run.motion.steps
        switched = {change.t for change in run.changes} | {event.t for event in run.events}
        bounds = [t for t in steps if t in switched or run.stats["kinks"]]
        bounds = sorted({steps[0], *(t for t in bounds if steps[0] < t < end), end})
        checks = {"variational equation": 0.0, "Liouville": 0.0}
        for begin, stop in pairwise(bounds):
            inside = np.array([begin, *steps[(steps > begin) & (steps < stop)], stop])
            phase = transition(field, run.motion, inside, perturbation.others)
            carried = phase.by_state @ perturbation.state + phase.by_others
            perturbation = Perturbation(carried, perturbation.others)
            checks["variational equation"] += phase.error
            checks["Liouville"] = max(checks["Liouville"], phase.liouville)
            if stop < end:
                perturbation = Moment(run, field, stop).passed(perturbation)
        ahead = field(Moment(run, field, end).before)
        checks["along the motion"] = float(np.abs(perturbation.state[:, -1] - ahead).max() / (np.abs(ahead).max() or 1.0))
        return perturbation, checks

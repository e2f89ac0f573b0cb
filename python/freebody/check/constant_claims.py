"""Claims that something stays the same along motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import takewhile
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import MotionError, State, Trajectory
from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import Node

from .assumptions import FROM_START
from .case import Case
from .constants import constant_corrections
from .families import ALL, SINCE_START, Samples
from .language.statements import symbols_in
from .motion_sampler import touching
from .residual import magnitude
from .verdict import Evidence, Kind, Verdict

if TYPE_CHECKING:
    from .api import Checker, Declared

_STEADY = 1e-7  # spread of a constant along a run, relative to its terms: what the integrator leaves
_MOMENTS = 6
_RUNS = 12
_ENOUGH, _CLEARLY = 5, 1e-3  # runs after which what changes by so much is no constant


def constant(checker: Checker, declared: Declared, expression: str) -> Verdict:
    """The same at all times of each motion, until it goes on in another mode; of motions from the start, or after something that happens, until
    something switches."""
    case = reading(checker, declared, expression)
    node = case.equations[0].left
    worst, seen, lost, runs, broken = 0.0, None, "", [], None
    # What a hypothesis makes 0 has no size of its own there, only round-off.
    usual = float(np.median(magnitude(node, case.values(ALL)))) if case.hypothesis.vanishing else 0.0
    for sample in case.samples(count=_RUNS).states:
        if len(runs) >= _ENOUGH and worst > _CLEARLY and not case.correcting:
            break
        try:
            along, change = _along(
                checker, sample, until_change=bool(case.hypothesis.since or checker.sampler.moment or checker.is_at_first)
            )
        except MotionError as error:  # with these numbers what switches on it cannot be carried through
            broken = error
            continue
        if not along.states:
            continue
        values = case.meaning.values(along)
        runs.append(values)
        value, size = sampled(node, values), magnitude(node, values)
        spread = float(np.max(np.ptp(value, axis=0)) / max(float(np.max(size)), usual, 1e-300))
        if np.isnan(spread):
            return Verdict(Kind.UNDECIDABLE, expression, "it has no value along the motion")
        if spread >= worst:
            worst, lost = spread, change
            seen = Evidence({"t": along.states[-1].t}, value[0].tolist(), value[-1].tolist(), spread, _RUNS)
    if broken and not runs:
        raise broken
    if worst < _STEADY:
        reason = f"constant along {_RUNS} random motions, to {worst:.0e}"
        notes = (
            ()
            if _may_change(case, node, runs)
            else ("It is of parameters alone, or of what is 0: that says nothing of the motion.",)
        )
        return Verdict(Kind.TRUE, expression, reason, evidence=seen, notes=notes)
    if case.hypothesis == ALL and case.sampler.starts_to_move:  # a momentum that is 0 keeps mass centres where they are
        from_start = checker.check(f"constant: {expression}", declared, SINCE_START, correcting=False)
        if from_start.ok:
            return replace(from_start, assumption=FROM_START)
    mends = constant_corrections(case, node, runs) if case.correcting else ()
    return Verdict(Kind.WRONG, expression, f"not constant: it changes along a motion{lost}", mends=mends, evidence=seen)


def _may_change(case: Case, node: Node, runs: Sequence[Mapping[str, Array]]) -> bool:
    """Whether something stands in an expression that is no parameter, and not 0 all along."""
    moving = [n.key for n in symbols_in(node) if n.name not in case.meaning.symbols.constants]
    return any(np.any(values[key]) for values in runs for key in moving)


def reading(checker: Checker, declared: Declared, expression: str) -> Case:
    """An expression symbolically, or else one of the model language (``energy()``)."""
    try:
        return checker.case(f"{expression} = 0", declared)
    except StatementError:
        with suppress(ModelProblem):
            return checker.case("quantity = 0", {**declared, "quantity": expression})
        raise


def _along(checker: Checker, state: State, until_change: bool) -> tuple[Samples, str]:
    """States along the motion that goes on from a true state, to its first change if that is asked for, or no impact comes on it that belongs
    to the model's own motion; and what changes on it."""
    sampler = checker.sampler
    motion = sampler.core.simulate(state, state.t + 1 / sampler.rate, rtol=1e-11, max_steps=5000)
    change = next((each for each in motion.changes if each.t > state.t), None)
    until_change |= change is not None and not _happens(checker, change.of, motion, state.t)
    ends = sampler.staying(motion, state.t, change.t if change and until_change else motion.end.t)
    times = np.linspace(state.t, ends - 1e-9 * (ends - state.t), _MOMENTS)
    stated = f", with {' '.join([change.kind, *change.of])} on it" if change and not until_change else ""
    states = [motion.state(t) for t in times.tolist()]
    first = touching(state if state.history else states[0])
    # Until a cord is unwound; none where at once it touches.
    same = takewhile(lambda each: stated or touching(each) == first, states)
    return Samples(sampler.core, [*same]), stated


def _happens(checker: Checker, parts: Sequence[str], motion: Trajectory, begins: float) -> bool:
    """Whether rates jump on a motion, by something of parts that changes on the model's own run, too."""
    jumps = any(each.before is not None for each in motion.changes if each.t > begins)
    return jumps and any({*each.of} & {*parts} for each in checker.happens.run.changes if each.t > 0)

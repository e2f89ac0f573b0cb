"""Random models: every form of the equations holds with the accelerations and loads of the core, at random states of the same mode."""

from functools import cache

import numpy as np
import pytest
from evaluated import balanced, numbers, off, terms
from random_models import drawn
from store import every

import freebody as fb
from freebody.codegen.refusals import CannotGenerate
from freebody.equations.derivation import conserved
from freebody.equations.derivation.derive import FORMS, derive
from freebody.equations.topics.lagrange import equations
from freebody.solve.perturbed_states import RATES, others
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate

AGREE = 1e-10
"""Of the largest term: as closely as the core's own routes agree."""
every_model = every(map(str, range(300)), "seed")
REFUSED = {"inconsistent_velocities", "inconsistent_constraints", "painleve_indeterminate", "painleve_inconsistent"}
"""What a start may be refused for, and be right: a motion that loops exclude, a lock of what is driven, contacts that jam."""


@cache
def visited(seed: str) -> list[SymbolicState] | str:
    """The states of a random model; or why there is none."""
    mechanism = drawn(int(seed))
    try:
        state = mechanism.solve().state
    except fb.MotionError as error:
        assert error.kind in REFUSED, error
        return error.kind.value
    first = SymbolicState(mechanism.source(), state)
    return [first, *(SymbolicState(first.source, state) for state in others(first.source, first.state)[::RATES])]


@pytest.fixture
def states(seed, record_property):
    found = visited(seed)
    if isinstance(found, str):
        record_property("not derived", found)
        pytest.skip(found)
    return found


@every_model
@pytest.mark.parametrize("form", FORMS)
def test_every_equation_of_every_form_holds(seed, form, states, record_property):
    try:
        found = derive(states[0], form)
    except fb.MotionError as error:
        assert error.kind == "too_large", error
        record_property("not derived", f"{form}: too_large")
        pytest.skip("too_large")
    assert found.text()
    now = states[0].source.instant(states[0].state)
    if form == "constraints" and not now.rank.self_stress and not any(load.kind == "friction" for load in states[0].free.loads):
        assert len(found.mass_matrix) == len(found.unknowns), (len(found.mass_matrix), len(found.unknowns))
    for at in states:
        values = numbers(at)
        for part in found.parts:
            assert off(part, values, at.tables) < AGREE, part.title


@every_model
def test_lagrange_holds_and_energy_changes_by_the_power_of_what_acts(seed, states, record_property):
    try:
        found, (kinetic, potential, _) = equations(states[0])[2], conserved.energy(states[0])
    except fb.MotionError as error:
        assert error.kind == "too_large", error
        record_property("not derived", "lagrange: too_large")
        pytest.skip("too_large")
    for at in states:
        values = numbers(at)
        for each in found:
            sides = [x for side in (each.left, each.force) for x in terms(side, values, at.tables)]
            assert abs(evaluate(each.residual, values, at.tables)) < AGREE * max([1.0, *map(abs, sides)]), each.coordinate
        balanced(kinetic, potential, at)


@every_model
def test_generated_code_gives_the_accelerations_and_loads(seed, states, record_property):
    mechanism = drawn(int(seed))
    try:
        program: dict = {}
        exec(compile(mechanism.code(), "generated.py", "exec"), program)
    except CannotGenerate as refused:
        record_property("not derived", f"code: {str(refused).split()[-1]}")
        pytest.skip(str(refused))
    for at in states:
        state, free = at.state, at.free
        given = state.q, state.u, np.array([*state.p, *program["DEFAULTS"][len(state.p) :]]), state.t
        loads = {load.symbol: load.value for load in free.loads if load.unknown}
        size = max([1.0, *map(abs, free.accelerations.values())])
        expected = [free.accelerations[name] for name in program["COORDINATES"]]
        assert program["accelerations"](*given) == pytest.approx(expected, abs=AGREE * size)
        if program["LOADS"]:
            found, expected = program["reactions"](*given), [loads[name] for name in program["LOADS"]]
            assert found == pytest.approx(expected, abs=AGREE * max([1.0, *map(abs, expected)]))

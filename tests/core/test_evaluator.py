"""The evaluator of inner loops gives the numbers of a solved instant, at one state after another."""

import numpy as np
import pytest
from store import ANSWERED, every, mechanism

import freebody as fb


def told(core, state):
    """Accelerations and reactions of a state by the names of the evaluator, as a solved instant tells them."""
    found = core.instant(state)
    joints = zip((joint["name"] for joint in core.metadata["joints"]), found.reactions, strict=True)
    named = {f"{name}.{part}": x for name, row in joints for part, x in zip(("Fx", "Fy", "M"), row, strict=True)}
    for name, limit in found.limits.items():
        named |= {f"{name}.Fx": limit.Fx, f"{name}.Fy": limit.Fy}
    return found, named | found.motions | found.couplings


@every(ANSWERED)
def test_it_gives_the_numbers_of_a_solved_instant(model):
    core = mechanism(model).compile()
    state, _ = mechanism(model).start()
    at = mechanism(model).evaluator()
    assert at.coordinates == core.coordinate_names
    for u in (state.u, 1.5 * state.u, state.u):  # back again: nothing is left of the state before
        accelerations, reactions = at(state.q, u, state.p, state.t)
        found, named = told(core, type(state)(state.p, state.t, state.q, u))
        size = np.abs(found.accelerations).max(initial=found.sizes[1])
        np.testing.assert_allclose(accelerations, found.accelerations, rtol=1e-9, atol=1e-9 * size)
        wanted = [named[name] for name in at.reactions]
        np.testing.assert_allclose(reactions, wanted, rtol=1e-8, atol=1e-9 * found.sizes[0])


def test_it_takes_lists_and_parameters_and_refuses_wrong_sizes():
    bar = """
freebody: 1
parameters: {m: 2 kg, l: 3 m}
gravity: 10 m/s^2
bodies: {rod: {shape: rod, mass: m, length: l}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
"""
    made = fb.Mechanism.loads(bar)
    at = made.evaluator(m="4 kg")
    accelerations, reactions = at([0], [0])
    assert accelerations == pytest.approx([-3 / 2 * 10 / 3])
    assert dict(zip(at.reactions, reactions, strict=True)) == pytest.approx({"pin.Fx": 0, "pin.Fy": 4 * 10 / 4, "pin.M": 0})
    assert at([0], [0], p=[2, 3])[1][1] == pytest.approx(2 * 10 / 4)
    assert at.parameters == ["m", "l"]
    with pytest.raises(fb.MotionError, match="1 coordinates are needed, and 2 were given"):
        at([0, 0], [0])

"""What is made of a model is kept exactly as long as the model is the same: by whom, where and when ever it is changed."""

import threading

import numpy as np
import pytest

from freebody import Mechanism
from freebody.model import builder, schema

TEXT = """
freebody: 1
parameters: {l: 1 m, k: 20 N/m}
ground: {points: {A: [0, 0], B: [2, 0]}}
bodies:
  crank: {shape: rod, length: l, mass: 1 kg, points: {P: [0.2, 0]}}
  plate: {shape: polygon, corners: [[0, 0], [1, 0], [0, 1]], mass: 2 kg}
joints:
  pivot: {type: hinge, of: [ground.A, crank.start], coordinate: theta}
  pin: {type: hinge, of: [ground.B, plate.origin], coordinate: phi}
forces:
  spring: {type: spring, between: [crank.P, plate.origin], stiffness: k}
initial: {theta: 30 deg, rates: {theta: 1}}
"""

CHANGES = {
    "a word": lambda m: setattr(m.bodies["crank"], "mass", 3),
    "an item": lambda m: m.gauges.update(way="2*theta"),
    "an item in what was left out": lambda m: m.bodies["plate"].points.update(R=[1, 1]),
    "an item less": lambda m: m.forces.pop("spring"),
    "the last item": lambda m: m.forces.popitem(),
    "a deleted item": lambda m: m.forces.__delitem__("spring"),
    "all items": lambda m: m.forces.clear(),
    "a parameter": lambda m: m.parameters.__setitem__("l", "2 m"),
    "parameters together": lambda m: m.parameters.__ior__({"k": 5}),
    "a place": lambda m: m.bodies["crank"].points["P"].__setitem__(0, 0.3),
    "another point": lambda m: m.bodies["crank"].points.setdefault("Q", [0, 1]),
    "a corner": lambda m: m.bodies["plate"].corners.append([-1, 0]),
    "a corner of a corner": lambda m: m.bodies["plate"].corners[1].__setitem__(0, 3),
    "corners turned round": lambda m: m.bodies["plate"].corners.reverse(),
    "a start": lambda m: m.initial.model_extra.update(theta=0.1),
    "a start as a word": lambda m: setattr(m.initial, "theta", 0.1),
    "a rate": lambda m: m.initial.rates.__setitem__("theta", 2),
    "a whole section": lambda m: setattr(m, "parameters", {"l": 1, "k": 3}),
    "what was assigned": lambda m: (setattr(m, "parameters", {"l": 1, "k": 3}), m.parameters.update(k=4)),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES.keys())
def test_whatever_changes_a_model_is_seen(change):
    m = Mechanism.loads(TEXT)
    before = m.lowered()
    change(m.model)
    after, anew = m.lowered(), Mechanism.of(m.model.model_copy(deep=True)).lowered()
    assert (after.spec, after.start) != (before.spec, before.start)
    assert (after.spec, after.start) == (anew.spec, anew.start)
    assert m.lowered() is after


def test_a_change_of_another_model_makes_nothing_anew():
    m, other = Mechanism.loads(TEXT), Mechanism.loads(TEXT)
    before = m.lowered()
    other.parameters["l"] = "3 m"
    assert m.lowered() is before


def test_a_change_while_the_model_is_lowered_is_seen_by_the_next_call(monkeypatch):
    """As another thread makes it, at the worst moment: what is then returned may be the old, what is kept not."""
    m, lower = Mechanism.loads(TEXT), builder.lower

    def slow(*asked):
        made = lower(*asked)
        changing = threading.Thread(target=m.parameters.__setitem__, args=("l", "2 m"))
        changing.start()
        changing.join()
        return made

    monkeypatch.setattr(builder, "lower", slow)
    m.lowered()
    monkeypatch.setattr(builder, "lower", lower)
    assert m.lowered().spec["parameters"][0]["value"] == 2.0


def test_an_unchanged_model_is_not_written_out_again(monkeypatch):
    m = Mechanism.loads(TEXT)
    first = m.solve()
    monkeypatch.setattr(schema.Model, "model_dump_json", None)
    monkeypatch.setattr(schema.Model, "model_dump", None)
    second, turned = m.solve(), m.solve(theta=0.1)
    assert (second.accelerations, second.residual) == (first.accelerations, first.residual)
    assert turned.accelerations != first.accelerations
    assert m.simulate(0.01).q[0, 0] == pytest.approx(first.state.q[0])


def test_what_is_said_later_of_an_instant_is_said_of_its_state():
    m = Mechanism.loads(TEXT)
    core, (state, _) = m.compile(), m.start()
    at_once, later = core.instant(state), core.instant(state)
    told = at_once.sizes
    state.u[:] = 100.0
    assert later.sizes == told != core.instant(state).sizes


def test_a_run_takes_changes_by_keyword_as_an_instant_does():
    m, changed = Mechanism.loads(TEXT), Mechanism.loads(TEXT)
    changed.parameters["l"] = "2 m"
    run, anew = m.simulate(0.05, l="2 m", theta=0.3, rtol=1e-8), changed.simulate(0.05, theta=0.3, rtol=1e-8)
    assert run.settings.rtol == 1e-8
    assert np.array_equal(run.q, anew.q)
    assert m.solve(l="2 m", theta=0.3).accelerations == changed.solve(theta=0.3).accelerations
    assert m.solve().accelerations == Mechanism.loads(TEXT).solve().accelerations != changed.solve().accelerations


def test_output_times_are_those_that_were_asked_for():
    asked = [0.0, 0.01]
    run = Mechanism.loads(TEXT).simulate(0.02, t_eval=asked)
    asked.append(0.02)
    assert run.t.tolist() == [0.0, 0.01]

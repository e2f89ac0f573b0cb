"""Motions whose answers are known: kinks, tables, events that change parameters, assemblies."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import freebody as fb

M, K, G = 2.0, 5000.0, 9.81


def one_sided_spring() -> fb.Mechanism:
    """A particle that falls 1 m on a spring which can only push."""
    m = fb.Mechanism("one-sided spring", gravity=G)
    ball = m.particle("ball", mass=M)
    m.free("ground.O", ball.centre, coordinates=["x", "y"])
    m.law(name="pad", along="y", value=f"max(0, -{K}*y)", potential=f"{K}/2*min(y, 0)^2")
    m.initial(y=1)
    return m


def test_a_kink_is_not_stepped_over():
    """Free fall, then m ÿ = −mg − ky from y = 0: the deepest point follows from energy, its time from the oscillation about
    −mg/k. The energy is kept to the tolerance although the law has a corner."""
    run = one_sided_spring().simulate(until=2, rtol=1e-11)
    assert run.stats["kinks"] > 0
    energy = run.energy["kinetic"] + run.energy["potential"]
    assert np.ptp(energy) < 1e-9 * energy[0]
    speed, omega, rest = math.sqrt(2 * G), math.sqrt(K / M), -M * G / K
    contact = 2 * (math.pi - math.atan2(speed / omega, -rest)) / omega
    deepest = rest - math.hypot(speed / omega, rest)
    t = speed / G + contact / 2
    assert run.evaluate("y", t) == pytest.approx(deepest, rel=1e-9)
    assert run.evaluate("rate(y)", t) == pytest.approx(0, abs=1e-7)


def test_a_table_of_straight_pieces_is_integrated_exactly():
    """Torque 0, 2, 0 N·m at 0, 1, 2 s on a wheel of inertia 1 kg·m²: impulse 2 N·m·s, so 2 rad/s at the end."""
    m = fb.Mechanism("table", gravity="none")
    wheel = m.disk("wheel", radius=math.sqrt(2), mass=1)
    m.hinge("ground.O", wheel.centre, coordinate="theta")
    m.table("duty", [0, 1, 2], [0, 2, 0])
    m.torque(on="wheel", value="duty(t)")
    run = m.simulate(until=2, rtol=1e-10)
    assert run.u[-1, 0] == pytest.approx(2, abs=1e-12)
    assert run.q[-1, 0] == pytest.approx(2, abs=1e-12)


def test_every_other_time_may_be_asked_for():
    run = one_sided_spring().simulate(until=0.4)
    assert run.evaluate("y", run.t[::2]) == pytest.approx(1 - G * run.t[::2] ** 2 / 2, abs=1e-9)
    assert run.at(run.t[::2])["y"] == pytest.approx(run["y"][::2])


def softening(name: str, when: str) -> fb.Run:
    """A mass of 1 kg on a spring of 4 N/m, drawn out by 1 m, whose stiffness is quartered ``when`` a level is reached on the way back."""
    m = fb.Mechanism("softer", gravity="none")
    block = m.particle("block", mass=1)
    k = m.parameter("k", 4)
    m.free("ground.O", block.centre, coordinates=["x", "y"])
    m.spring(along="x", stiffness=k)
    m.event(name, when, direction="falling", if_="k > 2", then={"set": {"k": 1}})
    m.initial(x=1)
    run = m.simulate(until=6, rtol=1e-11)
    assert np.abs(run.energy.balance).max() < 1e-9
    return run


def test_an_event_changes_a_parameter_and_the_ledger_knows():
    """Where the spring is relaxed the amplitude doubles, and no energy enters."""
    run = softening("relaxed", "x")
    assert [event.t for event in run.events] == pytest.approx([math.pi / 4], abs=1e-10)
    assert run.q[:, 0].min() == pytest.approx(-2, abs=1e-4)


def test_a_spring_that_softens_under_load_takes_energy():
    """k from 4 to 1 N/m at x = ½ m takes ½ · 3 · ¼ = 0.375 J of the 2 J; what is left swings to √(2 · 1.625) m."""
    run = softening("half", "x - 0.5")
    assert run.energy["parameter changes"][[0, -1]] == pytest.approx([0, -0.375], abs=1e-9)
    assert run.energy["potential"].max() == pytest.approx(2, rel=1e-12)
    assert run["x"].min() == pytest.approx(-math.sqrt(3.25), abs=1e-4)


def four_bar() -> fb.Mechanism:
    m = fb.Mechanism("four-bar")
    m.mark("ground", "points", "D", (1.2, 0))
    a, b, c = m.rod("a", length=0.4, mass=1), m.rod("b", length=0.5657, mass=1), m.rod("c", length=1.1314, mass=1)
    m.hinge("ground.O", a.start, coordinate="theta")
    m.hinge(a.end, b.start, coordinate={"name": "beta", "absolute": True})
    m.hinge("ground.D", c.start, coordinate="phi")
    m.hinge(b.end, c.end)
    return m


def test_the_assembly_can_be_chosen_and_the_other_one_is_reported():
    """The two assemblies are mirror images in the line from B to D."""
    side = "(x(b.end) - x(a.end))*(y(ground.D) - y(a.end)) - (y(b.end) - y(a.end))*(x(ground.D) - x(a.end))"
    found = {}
    for sign in ("positive", "negative"):
        state, notes = four_bar().start(initial={"theta": "90 deg", "guess": {"beta": 0.5, "phi": 2}, "branch": {side: sign}})
        found[sign] = state.q
        assert any("other assembly" in note for note in notes)
    mirror = 2 * math.atan2(-0.4, 1.2)
    turned = lambda angle: (angle + math.pi) % (2 * math.pi) - math.pi
    assert turned(found["positive"][1] + found["negative"][1] - mirror) == pytest.approx(0, abs=1e-9)


def test_another_start_stays_on_the_branch_of_the_model():
    for sign in ("positive", "negative"):
        mechanism = four_bar()
        mechanism.initial(theta="80 deg", guess={"phi": 2}, branch={"sin(beta)": sign})
        states = [mechanism.start(**start)[0].q for start in ({"theta": "90 deg"}, {"initial": {"theta": "90 deg"}})]
        np.testing.assert_array_equal(*states)


def test_loops_that_cannot_close_name_the_gap():
    """Two bars of 1 m between pins 5 m apart come no nearer than 3 m."""
    far = fb.Mechanism("too far")
    far.mark("ground", "points", "D", (5, 0))
    a, b = far.rod("a", length=1, mass=1), far.rod("b", length=1, mass=1)
    far.hinge("ground.O", a.start, coordinate="p")
    far.hinge(a.end, b.start, coordinate="q")
    far.hinge("ground.D", b.end)
    with pytest.raises(fb.MotionError, match=r"3\.0000"):
        far.solve(guess={"p": 0.3, "q": 0.1})


def test_prescribed_motions_that_exclude_each_other_are_refused():
    m = fb.Mechanism("two wills")
    bar = m.rod("bar", length=1, mass=1)
    m.hinge("ground.O", bar.start, coordinate="theta")
    m.motion("first", of="theta", is_="t")
    m.motion("second", of="theta", is_="2*t")
    with pytest.raises(fb.MotionError):
        m.simulate(until=1)


def bending_pendulum() -> fb.Mechanism:
    """A rod that bends at its middle."""
    m = fb.Mechanism("bending pendulum", gravity=G)
    stiffness, damping = m.parameter("k_rod", 1), m.parameter("c_rod", 1)
    near, far = (m.body(name, shape="rod", length=0.15, mass=1) for name in ("near", "far"))
    m.hinge("ground.O", near.start, coordinate="theta")
    m.hinge(near.end, far.start, coordinate="bend")
    m.spring(along="bend", stiffness=stiffness, damping=damping)
    m.initial(theta=1, bend=0, rates={"theta": 20, "bend": 0})
    return m


def bending_slider_crank() -> fb.Mechanism:
    mechanism = fb.Mechanism.load(Path(fb.__file__).parent / "systems/GEN-MODES-vibrating-slider-crank/model.yaml")
    mechanism.parameters.update(w=20, c=1)
    return mechanism


@pytest.mark.parametrize("machine", [bending_pendulum, bending_slider_crank])
def test_stiffness_costs_radau_nothing(machine):
    """Steps follow the slow motion (Hairer & Wanner, Solving ODEs II, IV.8), also where loops are closed after each of them: what
    bends ever less, damped by a tenth of critical, costs no more evaluations."""
    mechanism, counts = machine(), []
    for stiffness in (2e4, 2e6, 2e8):
        mechanism.parameters.update(k_rod=stiffness, c_rod=0.2 * math.sqrt(1e-3 * stiffness))
        counts.append(mechanism.simulate(until=0.1, method="radau", rtol=1e-8).stats["evaluations"])
    assert max(counts) < 1.5 * counts[0], counts


PRESSED = """
freebody: 1
gravity: none
parameters: {k: 0 N/m}
bodies: {a: {shape: rod, length: 1 m, mass: 1.7}, b: {shape: rod, length: 0.7 m, mass: 2.7}}
joints:
  A: {type: slider, along: {through: ground.O, angle: 0.549}, line: [a.start, a.end], coordinate: s}
  B: {type: polar, of: [a.end, b.start], coordinates: [r, phi, turn]}
forces: {pressed: {type: spring, along: r, stiffness: k}}
motions: {drive: {of: r, is: 1.5*sin(t), level: acceleration}}
events: {hold: {at: start, then: {lock: phi}}}
initial: {s: -0.249, r: 1.467, phi: 0.3, turn: 0.673, at_rest: true}
run: {until: 1.5 s, rtol: 1e-9}
"""
"""Nothing moves at the start, where the drive bears the spring to round-off."""


@pytest.mark.parametrize("k", [1.0, 10.0, 100.0])
def test_what_balances_to_round_off_at_the_start_is_no_measure_of_the_motion(k):
    mechanism = fb.Mechanism.loads(PRESSED)
    free, pressed = mechanism.simulate().stats, mechanism.simulate(k=k).stats
    assert pressed["evaluations"] < 2 * free["evaluations"]

"""Friction of joints along curves: beads on rough hoops, pins in rough curved slots, sliders that their cranks turn back."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from seen import changes, kinds, model, motion

G = 9.81

HOOP = """
parameters: {mu: 0.2, v: 4 m/s, R: 0.5 m}
gravity: GRAVITY
bodies: {bead: {shape: particle, mass: 0.5 kg}}
ground: {curves: {hoop: {arc: {centre: O, radius: R}}}}
joints: {wire: {type: curved_slot, along: ground.hoop, point: bead.centre, coordinate: {name: phi, zero: -pi/2, sense: SENSE}, friction: mu}}
initial: {phi: 0, rates: {phi: v/R}}
"""


@pytest.mark.parametrize("sense", ["forward", "backward"])
def test_a_bead_on_a_rough_hoop_slows_down_by_its_own_pressure(sense):
    """Without gravity N = m v²/R and v̇ = −μ v²/R: v = v₀/(1 + μ v₀ t/R), whichever way round."""
    run = motion(HOOP.replace("GRAVITY", "none").replace("SENSE", sense), 3, {"rtol": 1e-11})
    v = 4 / (1 + 0.2 * 4 * 3 / 0.5)
    assert run.evaluate("rate(phi)", 3) == pytest.approx(v / 0.5, rel=1e-9)
    assert run.evaluate("wire.F", 3) == pytest.approx(0.5 * v**2 / 0.5, rel=1e-9)
    assert run.evaluate("wire.friction", 3) == pytest.approx(-0.2 * 0.5 * v**2 / 0.5, rel=1e-9)
    names, ledger = run.motion.ledger(np.array([3.0]))
    assert ledger[0][names.index("friction")] == pytest.approx(0.25 * (v**2 - 16), rel=1e-9)


def squared_speed(phi: float, start: float, v2: float, mu: float, radius: float) -> float:
    """v² of a bead that slides up a rough hoop from an angle ``start`` from the bottom, pressed outwards.

    d(v²)/dφ = −2gR (sin φ + μ cos φ) − 2μ v², a linear equation.
    """
    a = 2 * mu
    primitive = lambda x: math.exp(a * x) * (1.5 * a * math.sin(x) + (a * a / 2 - 1) * math.cos(x)) / (a * a + 1)
    return math.exp(-a * phi) * (math.exp(a * start) * v2 - 2 * G * radius * (primitive(phi) - primitive(start)))


@pytest.mark.parametrize("v", [1.2, 2.0, 2.9])
def test_a_bead_swings_in_a_rough_hoop_until_it_sticks(v):
    """Each swing goes from rest to rest by the closed form, to one side and to the other; it stays where tan φ ≤ μ."""
    text = HOOP.replace("GRAVITY", "9.81").replace("SENSE", "forward")
    run = motion(text, 6, {"rtol": 1e-11}, v=v)
    stops = [brentq(lambda phi: squared_speed(phi, 0.0, v * v, 0.2, 0.5), 1e-6, math.pi / 2)]
    while math.tan(abs(stops[-1])) > 0.2:
        # As a swing to the right: from where the last one ended, on the left.
        start, side = -abs(stops[-1]), -math.copysign(1, stops[-1])
        stops.append(side * brentq(lambda phi, at=start: squared_speed(phi, at, 0.0, 0.2, 0.5), start + 1e-3, math.pi / 2))
    stated = changes(run)
    assert [c.kind for c in stated] == ["reversal"] * (len(stops) - 1) + ["stick"]
    assert [run.evaluate("phi", c.t) for c in stated] == pytest.approx(stops, abs=1e-8)
    assert run.evaluate("rate(phi)", 6) == 0


def test_a_bead_goes_slowly_over_the_top_of_a_rough_hoop():
    """On the way it leans first on the outer, then on the inner, again on the outer side of the wire: N passes 0 twice.

    d(v²)/dφ = −2 g R sin φ − 2 μ |v² + g R cos φ|, integrated piece by piece between the zeros of the pressure.
    """
    mu, radius, v = 0.1, 0.5, 5.6
    rate = lambda side: lambda phi, y: [-2 * G * radius * math.sin(phi) - 2 * mu * side * (y[0] + G * radius * math.cos(phi))]
    lifted = lambda phi, y: y[0] + G * radius * math.cos(phi)
    lifted.terminal = True
    phi, y, side, zeros = 0.0, [v * v], 1.0, []
    while phi < 2 * math.pi:
        lifted.direction = -side
        leg = solve_ivp(rate(side), (phi, 2 * math.pi), y, method="DOP853", rtol=1e-12, atol=1e-12, events=lifted)
        phi, y, side = leg.t[-1], leg.y[:, -1], -side
        zeros += list(leg.t_events[0])
    assert len(zeros) == 2
    text = HOOP.replace("GRAVITY", "9.81").replace("SENSE", "forward") + "events: {round: {when: phi - 2*pi, then: stop}}\n"
    run = motion(text, 5, {"rtol": 1e-11}, v=v, mu=mu)
    end = run.outcome.t
    assert (radius * run.evaluate("rate(phi)", end)) ** 2 == pytest.approx(y[0], rel=1e-8)


@pytest.mark.parametrize("past", [-1e-12, 1e-12])
def test_the_verdict_on_the_edge_of_the_cone(past):
    """A bead that is let go where tan φ = μ stays there; by a little more, it slides."""
    text = HOOP.replace("GRAVITY", "9.81").replace("SENSE", "forward")
    text = text.replace("{phi: 0, rates: {phi: v/R}}", f"{{phi: {math.atan(0.2 * (1 + past))!r}, at_rest: true}}")
    run = model(text).simulate(until=100)
    assert run.outcome.ok and (run.evaluate("phi", 100) == run.evaluate("phi", 0)) == (past < 0)


ARM = """
gravity: none
bodies:
  arm: {shape: rod, length: 1 m, mass: 2 kg, GUIDE}
  bead: {shape: particle, mass: 0.3 kg}
joints:
  pivot: {type: hinge, of: [ground.O, arm.start], coordinate: theta}
  track: {type: TRACK, point: bead.centre, coordinate: R, friction: 0.3}
initial: {theta: 0, R: 0.2 m, rates: {theta: 5, R: 0.4}}
"""
STRAIGHT = ARM.replace("GUIDE", "lines: {way: [start, end]}").replace("TRACK", "slot, along: arm.way")
AS_CURVE = ARM.replace("GUIDE", "curves: {way: [{line: [start, end]}]}").replace("TRACK", "curved_slot, along: arm.way")


def test_a_straight_curve_of_a_turning_body_rubs_as_a_slot_does():
    slot, curve = (motion(text, 0.5, {"rtol": 1e-12}) for text in (STRAIGHT, AS_CURVE))
    times = np.linspace(0, 0.5, 6)
    for what in ("theta", "R", "track.friction", "pivot.Fx"):
        assert curve.evaluate(what, times) == pytest.approx(slot.evaluate(what, times), rel=1e-9, abs=1e-11)


CRANK = """
bodies:
  crank: {shape: rod, length: 0.1 m, mass: 1 kg}
  rod: {shape: rod, length: 0.4 m, mass: 2 kg, points: {P: end}, point_masses: [{at: end, mass: 2 kg}]}
ground: {points: {A: [0.1, 0], B: [0.9, 0]}, lines: {way: [A, B]}, curves: {curve: [{line: [A, B]}]}}
joints:
  axle: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  pin: {type: hinge, of: [crank.end, rod.start]}
  guide: {type: GUIDE, point: rod.P, friction: 0.3}
initial: {theta: 1, RATES, branch: {x(rod.P): positive}, guess: {guide.s: 0.3}}
"""


@pytest.mark.parametrize("guide", ["slot, along: ground.way", "curved_slot, along: ground.curve"])
def test_a_crank_turns_its_rubbing_slider_back_at_the_dead_points(guide):
    """There the slide stops and nothing can hold it: the crank goes through, at θ = π, 2π …"""
    text = CRANK.replace("GUIDE", guide).replace("RATES", "rates: {theta: 30}")
    run = motion(text, 0.9, {"rtol": 1e-11})
    stated = changes(run)
    assert len(stated) >= 2 and {c.kind for c in stated} == {"reversal"}
    assert [run.evaluate("theta", c.t) for c in stated] == pytest.approx(
        [math.pi * (k + 1) for k in range(len(stated))], abs=1e-9
    )


@pytest.mark.parametrize("guide", ["slot, along: ground.way", "curved_slot, along: ground.curve"])
def test_a_driven_crank_pays_for_the_friction(guide):
    text = CRANK.replace("GUIDE", guide).replace("RATES", "rates: {theta: 0}").replace("theta: 1, rates: {theta: 0}, ", "")
    run = motion(text + 'motions: {drive: {of: theta, is: "1 + 3*t"}}\n', 2 * math.pi / 3, {"rtol": 1e-10})
    assert kinds(run) == [("reversal", ("guide",))] * 2
    names, ledger = run.motion.ledger(np.array([2 * math.pi / 3]))
    paid = dict(zip(names, ledger[0], strict=True))
    # After a turn all energy is as before.
    assert paid["drive"] == pytest.approx(-paid["friction"], rel=1e-7) and paid["friction"] < -0.1
    along = np.linspace(0.01, 2, 400)
    known = -0.3 * np.abs(run.evaluate("guide.F", along)) * np.abs(run.evaluate("rate(guide.s)", along))
    assert run.evaluate("guide.friction", along) * run.evaluate("rate(guide.s)", along) == pytest.approx(known, rel=1e-9)


def test_what_stuck_in_a_slot_that_is_released_falls():
    run = motion("""
bodies: {bead: {shape: particle, mass: 1 kg}}
ground: {points: {A: [0, 0], B: [1, 0.1]}, curves: {way: [{line: [A, B]}]}}
joints: {track: {type: curved_slot, along: ground.way, point: bead.centre, coordinate: s, friction: 0.3}}
initial: {s: 0.5, at_rest: true}
events: {off: {at: 1 s, then: {release: track}}}
""", 2)  # fmt: skip
    assert run.evaluate("ay(bead.centre)", [0.5, 1.5]) == pytest.approx([0, -G], abs=1e-12)
    assert run.evaluate("track.friction", [0.5, 1.5]) == pytest.approx([G * 0.1 / math.hypot(1, 0.1), 0], abs=1e-12)


@pytest.mark.parametrize("absolute", ["false", "true"])
def test_a_bearing_between_two_bodies_rubs_by_what_they_turn_against_each_other(absolute):
    """Two disks on one axle: the couple μ ρ |F| of the weight that hangs on it slows one and speeds up the other, however the angle
    is counted, until both turn as one."""
    run = motion(f"""
bodies: {{a: {{shape: disk, radius: 0.2 m, mass: 3 kg}}, b: {{shape: disk, radius: 0.3 m, mass: 1 kg}}}}
joints:
  axle: {{type: hinge, of: [ground.O, a.centre], coordinate: p}}
  bush: {{type: hinge, of: [a.centre, b.centre], coordinate: {{name: q, absolute: {absolute}}}, friction: 0.3, bearing_radius: 0.1 m}}
initial: {{p: 0, q: 0, rates: {{p: 9, q: {0 if absolute == "true" else -9}}}}}
""", 3)  # fmt: skip
    ia, ib, couple = 0.5 * 3 * 0.04, 0.5 * 0.09, 0.3 * 0.1 * G
    (stick,) = changes(run, "stick")
    assert stick.t == pytest.approx(9 / (couple / ia + couple / ib), rel=1e-10)
    assert run.evaluate("omega(b)", stick.t / 2) == pytest.approx(couple / ib * stick.t / 2, rel=1e-10)
    assert [run.evaluate(f"omega({x})", 3) for x in "ab"] == pytest.approx([9 * ia / (ia + ib)] * 2, rel=1e-10)


def test_a_hoop_has_no_bearing():
    with pytest.raises(Exception, match="takes no `bearing_radius`"):
        model(HOOP.replace("friction: mu", "friction: mu, bearing_radius: 0.1 m"))


def test_the_symbol_of_a_curve_hides_a_parameter_of_that_name():
    """A bead on a parabola: at s, m (1 + y'²) s̈ = −m g y' with y' = 0.8 s."""
    text = """
parameters: {m: 1 kg, s: 0.3 kg}
ground: {curves: {wave: {x: s, y: 0.4*s^2}}}
bodies: {bead: {shape: particle, mass: m}}
joints: {wire: {type: curved_slot, along: ground.wave, point: bead.centre, coordinate: q}}
initial: {q: 0.5, at_rest: true}
"""
    assert model(text).solve().accelerations["q"] == pytest.approx(-9.81 * 0.4 / (1 + 0.4**2), rel=1e-12)

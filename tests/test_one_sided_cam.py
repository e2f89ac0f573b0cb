"""A follower that a cam can only push: above a critical speed it floats, and lands again."""

import numpy as np
import pytest
from scipy.optimize import brentq

import freebody as fb
from freebody.core import ModelError
from freebody.model.errors import ModelFileError

M, K, E, R, PRE, G = 0.5, 400.0, 0.01, 0.03, 0.02, 9.81
FOLLOWER = """
freebody: 1
parameters: {m: 0.5 kg, k: 400 N/m, e: 10 mm, r: 30 mm, pre: 20 mm, w: 75 rad/s, bounce: 0}
bodies:
  cam:
    mass: 0
    inertia: 1e-3 kg*m^2
    curves: {profile: {x: "(r + e*(1 - cos(s + pi/2)))*cos(s)", y: "-(r + e*(1 - cos(s + pi/2)))*sin(s)"}}
  tappet: {mass: m, inertia: 1, points: {tip: [0, 0]}, lines: {axis: {through: tip, angle: 90 deg}}}
ground: {lines: {up: {through: O, angle: 90 deg}}}
joints:
  shaft: {type: hinge, of: [ground.O, cam.origin], coordinate: theta}
  guide: {type: slider, along: ground.up, line: tappet.axis, coordinate: y}
  lift:
    {type: one_sided_cam, along: cam.profile, follower: {centre: tappet.tip, radius: 0}, coordinates: [s, h, phi], restitution: bounce}
forces: {spring: {type: law, along: y, value: -k*(y - r + pre)}}
motions: {drive: {of: theta, is: w*t}}
initial: {theta: 0, h: 0, guess: {s: -90 deg, y: 30 mm}}
run: {until: 0.09 s, rtol: 1e-12}
"""


def held(t, w):
    """The force along the way with which the follower is pushed on the cam, while it stays on: y = r + e (1 − cos ωt)."""
    return M * E * w**2 * np.cos(w * t) + M * G + K * (E * (1 - np.cos(w * t)) + PRE)


def test_below_the_critical_speed_it_stays_on_and_its_push_is_the_closed_form():
    critical = np.sqrt((M * G + K * (2 * E + PRE)) / (M * E))
    w = 0.99 * critical
    run = fb.Mechanism.loads(FOLLOWER).simulate(w=w)
    assert [change.kind for change in run.changes] == ["contact"] and run.outcome.name == "Completed"
    t = np.linspace(0, 0.09, 40)
    slope = E * np.sin(w * t) / (R + E * (1 - np.cos(w * t)))  # of the profile, against the circle
    np.testing.assert_allclose(run.evaluate("'lift.contact'.N", t), held(t, w) * np.sqrt(1 + slope**2), rtol=1e-9)
    np.testing.assert_allclose(run.evaluate("y", t), R + E * (1 - np.cos(w * t)), atol=1e-13)
    above = fb.Mechanism.loads(FOLLOWER).simulate(w=1.01 * critical)
    assert [change.kind for change in above.changes][:2] == ["contact", "lift-off"]


@pytest.mark.parametrize("bounce", [0.0, 0.4])
def test_above_it_floats_and_lands_as_its_harmonic_flight_says(bounce):
    w, own = 75.0, np.sqrt(K / M)
    run = fb.Mechanism.loads(FOLLOWER).simulate(w=w, bounce=bounce)
    leaves = brentq(lambda t: held(t, w), 0.5 * np.pi / w, np.pi / w, xtol=1e-16)
    middle = R - PRE - M * G / K
    y, v = R + E * (1 - np.cos(w * leaves)), E * w * np.sin(w * leaves)

    def flight(t):
        c, s = np.cos(own * (t - leaves)), np.sin(own * (t - leaves))
        return middle + (y - middle) * c + v / own * s, -(y - middle) * own * s + v * c

    lands = brentq(lambda t: flight(t)[0] - R - E * (1 - np.cos(w * t)), leaves + 0.01, 0.09, xtol=1e-16)
    lifts, hits = run.changes[1:3]
    assert (lifts.kind, hits.kind) == ("lift-off", "impact")
    assert lifts.t == pytest.approx(leaves, abs=1e-11) and hits.t == pytest.approx(lands, abs=1e-10)
    for t in np.linspace(leaves, lands, 7)[1:-1]:
        assert float(run.evaluate("y", [t])[0]) == pytest.approx(flight(t)[0], abs=1e-12)
        assert float(run.evaluate("h", [t])[0]) > 0
        assert float(run.evaluate("'lift.contact'.N", [t])[0]) == 0
    approach = E * w * np.sin(w * lands) - flight(lands)[1]
    after = E * w * np.sin(w * lands) + bounce * approach
    assert float(run.evaluate("rate(y)", [lands + 1e-9])[0]) == pytest.approx(after, abs=1e-6)
    assert hits.lost == pytest.approx(M * approach**2 * (1 - bounce**2) / 2, rel=1e-8)
    assert abs(run.energy.balance).max() < 1e-10


ROUND = """
freebody: 1
parameters: {m: 0.5 kg, k: 400 N/m, e: 10 mm, r: 30 mm, roll: 12 mm}
bodies:
  cam: {mass: 0, inertia: 1e-3 kg*m^2, points: {C: [0, e]}, curves: {profile: {x: "r*cos(s)", y: "e - r*sin(s)"}}}
  tappet: {mass: m, inertia: 1, points: {tip: [0, 0]}, lines: {axis: {through: tip, angle: 90 deg}}}
ground: {lines: {up: {through: O, angle: 90 deg}}}
joints:
  shaft: {type: hinge, of: [ground.O, cam.origin], coordinate: theta}
  guide: {type: slider, along: ground.up, line: tappet.axis, coordinate: y}
%s
forces: {spring: {type: law, along: y, value: -k*(y - 20 mm)}, motor: {type: torque, on: cam, value: 3}}
initial: {theta: 0, %s rates: {theta: 70}}
run: {until: 0.15 s, rtol: 1e-12}
"""
TIP = "{centre: tappet.tip, radius: roll}"
ONE_SIDED = ROUND % (
    f"  lift: {{type: one_sided_cam, along: cam.profile, follower: {TIP}, coordinates: [s, h, phi]}}",
    "h: 0, guess: {s: -90 deg, y: 52 mm},",
)
ON_THE_RIGHT = (
    ONE_SIDED.replace("e - r*sin(s)", "e + r*sin(s)")
    .replace("-90 deg", "90 deg")
    .replace("radius: roll}", "radius: roll}, right: true")
)
TOUCHING = ROUND % (f"contacts: {{lift: {{of: [{TIP}, {{centre: cam.C, radius: r}}]}}}}", "y: 52 mm,")


@pytest.mark.parametrize("text", [ONE_SIDED, ON_THE_RIGHT], ids=["left", "right"])
def test_a_roller_on_a_round_cam_is_a_contact_of_two_circles(text):
    """By other coordinates and another gap: the torque is given, the cam slows down as it pushes."""
    one, other = (fb.Mechanism.loads(each).simulate() for each in (text, TOUCHING))
    assert [c.kind for c in one.changes] == [c.kind for c in other.changes]
    assert {"lift-off", "impact"} <= {c.kind for c in one.changes}
    np.testing.assert_allclose([c.t for c in one.changes], [c.t for c in other.changes], atol=1e-9)
    np.testing.assert_allclose([c.lost for c in one.changes], [c.lost for c in other.changes], rtol=1e-6, atol=1e-10)
    t = np.linspace(0, 0.15, 23)
    for each in ("y", "theta"):
        np.testing.assert_allclose(one.evaluate(each, t), other.evaluate(each, t), atol=1e-9)
    np.testing.assert_allclose(one.evaluate("'lift.contact'.N", t), other.evaluate("lift.N", t), rtol=1e-6, atol=1e-6)


def test_routes_derivatives_and_equations_agree():
    model = fb.Mechanism.loads(ONE_SIDED.replace("theta: 0, h", "theta: 0.1, h").replace("theta: 70", "theta: 20, h: 0"))
    now, other = model.solve(), model.solve(route="constraints")
    for text in ("accel(theta)", "accel(y)", "'lift.contact'.N"):
        assert now[text] == pytest.approx(other[text], rel=1e-12)
    assert now["'lift.contact'.N"] > 0
    assert model.check("m*accel(y) = -m*g - k*(y - 0.02) + lift.contact.N*sin(theta - s)").ok
    text = model.equations().text()
    assert "lift" in text
    assert model.diagram("tappet") is not None


def test_what_it_pushes_with_is_read_from_its_stop():
    with pytest.raises(ModelError, match="what it pushes with is"):
        fb.Mechanism.loads(ONE_SIDED).simulate(until=0.01).evaluate("lift.Fn", [0])
    let_go = ONE_SIDED + "events: {loose: {at: 0.01 s, then: {release: lift}}}\n"
    run = fb.Mechanism.loads(let_go).simulate(until=0.02)
    assert float(run.evaluate("'lift.contact'.N", [0.015])[0]) == 0


def test_without_a_spring_it_floats_where_the_profile_falls_faster_than_g():
    """y = r + e (1 − cos ωt) needs m (g + e ω² cos ωt) ≥ 0; then it flies on a parabola."""
    w = 40.0
    run = fb.Mechanism.loads(FOLLOWER).simulate(w=w, k=0, until=0.17)
    leaves = np.arccos(-G / (E * w**2)) / w
    y, v = R + E * (1 - np.cos(w * leaves)), E * w * np.sin(w * leaves)
    lands = brentq(
        lambda t: y + v * (t - leaves) - G * (t - leaves) ** 2 / 2 - R - E * (1 - np.cos(w * t)), leaves + 0.02, 0.17, xtol=1e-16
    )
    assert [change.kind for change in run.changes][1:3] == ["lift-off", "impact"]
    assert run.changes[1].t == pytest.approx(leaves, abs=1e-11) and run.changes[2].t == pytest.approx(lands, abs=1e-11)
    slow = fb.Mechanism.loads(FOLLOWER).simulate(w=0.999 * np.sqrt(G / E), k=0, until=0.25)
    assert [change.kind for change in slow.changes] == ["contact"]


BEAD = """
freebody: 1
parameters: {R: 0.5 m, m: 0.2 kg}
bodies: {bead: {shape: particle, mass: m}}
ground: {curves: {dome: {x: CURVE, y: R*cos(s)}}}
joints: {dome: {type: one_sided_cam, along: ground.dome, follower: {centre: bead.centre, radius: 0}, SIDE coordinates: [theta, h]}}
initial: {theta: START, h: 0, at_rest: true}
run: {until: 1.5 s, rtol: 1e-12}
"""


@pytest.mark.parametrize(
    ("curve", "side", "start"), [("R*sin(s)", "", 0.01), ("-R*sin(s)", "right: true,", -0.01)], ids=["left", "right"]
)
def test_a_bead_leaves_a_slot_open_outwards_at_two_thirds(curve, side, start):
    """From rest at θ₀ the push is m g (3 cos θ − 2 cos θ₀); where it is gone the bead flies on a parabola."""
    run = fb.Mechanism.loads(BEAD.replace("CURVE", curve).replace("SIDE", side).replace("START", str(start))).simulate()
    assert [change.kind for change in run.changes] == ["contact", "lift-off"]
    leaves, angle = run.changes[1].t, np.arccos(2 * np.cos(0.01) / 3)
    assert abs(float(run.evaluate("theta", [leaves])[0])) == pytest.approx(angle, abs=1e-10)
    t = np.linspace(0, leaves, 9)[:-1]
    theta = run.evaluate("theta", t)
    np.testing.assert_allclose(run.evaluate("'dome.contact'.N", t), 0.2 * G * (3 * np.cos(theta) - 2 * np.cos(0.01)), atol=1e-9)
    speed, later = np.sqrt(2 * G * 0.5 * (np.cos(0.01) - np.cos(angle))), np.linspace(0, 0.2, 5)
    x = 0.5 * np.sin(angle) + speed * np.cos(angle) * later
    y = 0.5 * np.cos(angle) - speed * np.sin(angle) * later - G * later**2 / 2
    np.testing.assert_allclose(run.evaluate("x(bead.centre)", leaves + later), x, atol=1e-9)
    np.testing.assert_allclose(run.evaluate("y(bead.centre)", leaves + later), y, atol=1e-9)
    np.testing.assert_allclose(run.evaluate("h", leaves + later), np.hypot(x, y) - 0.5, atol=1e-9)


def test_what_would_be_a_slot_open_on_one_side_is_told_its_word():
    slot = BEAD.replace("one_sided_cam", "curved_slot").replace(
        "follower: {centre: bead.centre, radius: 0}, SIDE", "point: bead.centre, one_sided: true,"
    )
    with pytest.raises(ModelFileError, match="one_sided_cam"):
        fb.Mechanism.loads(slot)

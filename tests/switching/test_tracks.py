"""Roads of lines and arcs that go on in each other's direction: what rolls, slides and flies over them passes the joints smoothly."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from seen import changes, kinds, model, motion

G = 9.81

BODIES = {"particle": (0.0, 0.0), "disk": (0.1, 0.5)}
SHAPES = {"particle": "shape: particle", "disk": "shape: disk, radius: 0.1 m"}


VALLEY = """
parameters: {a: 40 deg, R: 1 m, l: 2 m, r: RADIUS}
bodies: {ball: {SHAPE, mass: 2 kg}}
ground:
  points:
    C: [0, R]
    B: ["-R*sin(a)", "R*(1 - cos(a))"]
    A: ["-R*sin(a) - l*cos(a)", "R*(1 - cos(a)) + l*sin(a)"]
    D: ["R*sin(a)", "R*(1 - cos(a))"]
    E: ["R*sin(a) + l*cos(a)", "R*(1 - cos(a)) + l*sin(a)"]
  curves: {road: [{line: [A, B]}, {arc: {centre: C, to: D}}, {line: [D, E]}]}
contacts: {road: {of: [ball, ground.road], WORDS}}
initial: {ball.x: "-R*sin(a) - 1*cos(a) + r*sin(a)", ball.y: "R*(1 - cos(a)) + 1*sin(a) + r*cos(a)", at_rest: true}
events: {bottom: {when: ball.x, direction: any}, turns: {when: rate(ball.x), direction: any, if: t > 0.1}}
"""


def valley(shape, words):
    return VALLEY.replace("SHAPE", SHAPES[shape]).replace("RADIUS", f"{BODIES[shape][0]} m").replace("WORDS", words)


@pytest.mark.parametrize("shape, words", [("particle", "friction: 0"), ("disk", "friction: 0"), ("disk", "rough: true")])
def test_a_valley_of_line_arc_and_line(shape, words):
    """Down 1 m of slope, through the arc and up as far; the speed by the fall, the push by the curvature, the time by quadrature.

    What rolls carries the share J/(m r²) of its energy in its turn; its centre goes on a circle of R − r.
    """
    r, share = BODIES[shape]
    share = share if "rough" in words else 0.0
    run = motion(valley(shape, words), 4, {"rtol": 1e-11})
    stated = kinds(run)
    assert stated == [("contact", ("road",))]
    a, rho = math.radians(40), 1 - r
    top = (1 - math.cos(a)) * rho + math.sin(a)
    speed = lambda fall: math.sqrt(2 * G * fall / (1 + share))
    bottom = next(e.t for e in run.events if e.name == "bottom")
    slope = math.sqrt(2 * 1 / (G * math.sin(a) / (1 + share)))
    round_ = quad(lambda x: rho / speed(top - rho * (1 - math.cos(x))), 0, a, epsabs=1e-13)[0]
    assert bottom == pytest.approx(slope + round_, abs=1e-9)
    assert run.evaluate("speed(ball.centre)", bottom) == pytest.approx(speed(top), rel=1e-9)
    assert run.evaluate("road.N", bottom) == pytest.approx(2 * (G + speed(top) ** 2 / rho), rel=1e-8)
    assert run.evaluate("road.N", slope - 1e-6) == pytest.approx(2 * G * math.cos(a), rel=1e-8)
    turns = next(e.t for e in run.events if e.name == "turns")
    assert turns == pytest.approx(2 * (slope + round_), abs=1e-8)
    assert run.evaluate("ball.x", turns) == pytest.approx(-run.evaluate("ball.x", 0.0), abs=1e-9)


LOOP = """
parameters: {R: 1 m, v: 7 m/s}
bodies: {ball: {shape: disk, radius: 0.1 m, mass: 1 kg}}
ground:
  points:
    A: [-4, 0]
    B: [0, 0]
    C: [0, R]
    P: ["R*cos(30 deg)", "R*(1 + sin(30 deg))"]
    Q: ["-R*cos(30 deg)", "R*(1 + sin(30 deg))"]
    D: [4, 0]
  curves:
    road: [{line: [A, B]}, {arc: {centre: C, to: P}}, {arc: {centre: C, to: Q}}, {arc: {centre: C, to: B}}, {line: [B, D]}]
contacts: {road: {of: [ball, ground.road]}}
initial: {ball.x: -3, ball.y: 0.1, rates: {ball.x: v}}
events: {top: {when: ball.y - (2*R - 0.1 m), direction: rising}, leaves: {when: road.N, direction: falling}}
"""


def test_a_loop_is_run_through():
    """A track that crosses itself: v² = v₀² − 4 g (R − r) at the top, out on the other side with the speed of the start."""
    run = motion(LOOP, 1.6, {"rtol": 1e-11}, v=math.sqrt(2 * G * 2.6))
    assert kinds(run) == [("contact", ("road",))]
    assert run.evaluate("ball.x", 1.6) > 0.5
    assert run.evaluate("rate(ball.x)", 1.6) == pytest.approx(math.sqrt(2 * G * 2.6), rel=1e-9)
    assert run.evaluate("ball.y", 1.6) == pytest.approx(0.1, abs=1e-12)


def test_too_slow_a_ball_falls_off_the_loop():
    """At the height of the centre where N = 0: v² = g (R − r) sin θ over the level of C, v₀² = g (R − r)(2 + 3 sin θ)."""
    run = model(LOOP, v=math.sqrt(2 * G * 1.9)).simulate(until=1.2, rtol=1e-11)
    off = changes(run, "lift-off")[0]
    theta = math.asin((2 * 1.9 / 0.9 - 2) / 3)
    place = [run.evaluate(f"ball.{c}", off.t) for c in "xy"]
    assert place == pytest.approx([0.9 * math.cos(theta), 1 + 0.9 * math.sin(theta)], abs=1e-8)


HILL = """
parameters: {v: 1 m/s, R: 1 m, r: RADIUS}
bodies: {ball: {SHAPE, mass: 1 kg}}
ground:
  points: {A: [-2, 0], B: [0, 0], C: [0, -R], D: ["R*sin(60 deg)", "-R*(1 - cos(60 deg))"]}
  curves: {road: [{line: [A, B]}, {arc: {centre: C, to: D}}]}
contacts: {road: {of: [ball, ground.road]}}
initial: {ball.x: -1, ball.y: r, rates: {ball.x: v}}
"""


@pytest.mark.parametrize("shape", ["particle", "disk"])
@pytest.mark.parametrize("v", [1.0, 4.0])
def test_off_a_hill(shape, v):
    """From a level road over its brow: slow, off where g cos φ = v²/(R + r); too fast, v² > g (R + r), right where the arc begins."""
    r = BODIES[shape][0]
    text = HILL.replace("SHAPE", SHAPES[shape]).replace("RADIUS", f"{r} m")
    run = motion(text, 1 / v + 0.9, {"rtol": 1e-11}, v=v)
    (off,) = changes(run, "lift-off")
    rho = 1 + r
    cos = min(1.0, 2 / 3 + v * v / (3 * G * rho))
    sin = math.sqrt(1 - cos * cos)
    place = [run.evaluate(f"ball.{c}", off.t) for c in "xy"]
    assert place == pytest.approx([rho * sin, rho * cos - 1], abs=1e-8)
    after = 1 / v + 0.9 - off.t
    w = math.sqrt(v * v + 2 * G * rho * (1 - cos))
    flown = [rho * sin + w * cos * after, rho * cos - 1 - w * sin * after - G / 2 * after**2]
    assert [run.evaluate(f"ball.{c}", run.outcome.t) for c in "xy"] == pytest.approx(flown, abs=1e-7)


def test_a_road_on_a_cart_keeps_the_momentum():
    """A bead slides down a smooth quarter arc of a free cart and along its bed: level momentum stays, energy stays."""
    text = """
bodies:
  cart: {mass: 3 kg, points: {A: [-1, 1], C: [0, 1], B: [0, 0], D: [5, 0]}, curves: {road: [{line: [T, A]}, {arc: {centre: C, to: B}}, {line: [B, D]}]}}
  bead: {shape: particle, mass: 1 kg}
joints: {wheels: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}}
contacts: {road: {of: [bead, cart.road]}}
initial: {x: 0, bead.x: -1, bead.y: 1.2, at_rest: true}
""".replace("points: {A", "points: {T: [-1, 2], A")
    run = motion(text, 1.4, {"rtol": 1e-11})
    assert run.evaluate("momentum_x()", np.linspace(0, 1.4, 8)) == pytest.approx(0, abs=1e-9)
    v = math.sqrt(2 * G * 1.2 * 3 / 4)
    assert run.evaluate("vx(bead.centre)", 1.4) == pytest.approx(v, rel=1e-9)
    assert run.evaluate("rate(x)", 1.4) == pytest.approx(-v / 3, rel=1e-9)


def test_what_slides_off_the_end_of_a_road_lifts_off_there():
    """The end of a level stretch: a bead flies on at its height and speed, and is said to have lifted off."""
    for shape in ("particle", "disk"):
        r = BODIES[shape][0]
        text = (
            HILL.replace("SHAPE", SHAPES[shape])
            .replace("RADIUS", f"{r} m")
            .replace("{line: [A, B]}, {arc: {centre: C, to: D}}", "{line: [A, B]}")
        )
        run = motion(text, 0.6, {"rtol": 1e-11}, v=4.0)
        (off,) = changes(run, "lift-off")
        assert off.t == pytest.approx(0.25, abs=1e-9)
        assert run.evaluate("ball.y", 0.6) == pytest.approx(r - G / 2 * 0.35**2, abs=1e-8)


def test_a_ball_bounces_over_a_valley():
    """Dropped on the slope, with restitution 1 and no friction: energy stays, over many bounces on all stretches."""
    text = valley("disk", "restitution: 1").replace(
        'ball.y: "R*(1 - cos(a)) + 1*sin(a) + r*cos(a)"', 'ball.y: "R*(1 - cos(a)) + 1*sin(a) + r*cos(a) + 0.2 m"'
    )
    run = motion(text, 4, {"rtol": 1e-11})
    assert len(changes(run, "impact")) > 4
    energy = run.evaluate("energy()", np.linspace(0, 4, 50))
    assert np.ptp(energy) < 1e-8


WRONG = [
    ("{line: [A, B]}, {line: [B, D]}", "kink"),
    ("{line: [A, B]}, {arc: {centre: A, to: D}}", "kink|from its centre"),
    ("{line: [A, B]}, {arc: {centre: C, to: H}}", "from its centre"),
]


@pytest.mark.parametrize("road, why", WRONG)
def test_a_track_with_a_fault_is_refused(road, why):
    text = HILL.replace("SHAPE", SHAPES["disk"]).replace("RADIUS", "0.1 m").replace("A: [-2, 0]", "A: [-2, 0], H: [0.5, -0.3]")
    with pytest.raises(Exception, match=why):
        model(text.replace("{line: [A, B]}, {arc: {centre: C, to: D}}", road)).simulate(until=0.1)


def test_a_circle_that_does_not_fit_is_refused():
    with pytest.raises(Exception, match="does not fit"):
        model(valley("disk", "friction: 0").replace("radius: 0.1 m", "radius: 1 m")).simulate(until=0.1)


BOWL = """
parameters: {R: 1 m, w: 0.6 m, h: 0.2 m, c: "sqrt(R^2 - w^2/4) - h/2", a: 30 deg}
bodies: {box: {shape: rectangle, width: w, height: h, mass: 2 kg}}
ground:
  points: {A: [-2, 0], L: ["-R*sin(60 deg)", "-R*cos(60 deg)"], O2: [0, 0], B: ["R*sin(60 deg)", "-R*cos(60 deg)"], T: ["-R*(sin(60 deg) + cos(60 deg))", "R*(sin(60 deg) - cos(60 deg))"]}
  curves: {bowl: [{line: [T, L]}, {arc: {centre: O2, to: B}}]}
contacts: {bowl: {of: [box, ground.bowl]}}
initial: {box.x: "c*sin(a)", box.y: "-c*cos(a)", box.angle: a, at_rest: true}
events: {bottom: {when: box.x, direction: any}}
"""


def test_a_box_in_a_smooth_bowl_swings_as_a_pendulum():
    """Both lower corners on the arc: it turns about the centre, I_C ω²/2 = m g c (cos φ − cos a)."""
    run = motion(BOWL, 1.5, {"rtol": 1e-11})
    assert kinds(run) == [("contact", ("bowl",))]
    c = math.sqrt(1 - 0.09) - 0.1
    inertia = 2 * (0.36 + 0.04) / 12 + 2 * c * c
    bottom = run.events[0].t
    # The quarter swing by quadrature, with sin φ/2 = sin a/2 · sin ψ.
    k = math.sin(math.radians(15))
    quarter = quad(lambda psi: 1 / math.sqrt(1 - (k * math.sin(psi)) ** 2), 0, math.pi / 2, epsabs=1e-13)[0]
    assert bottom == pytest.approx(quarter * math.sqrt(inertia / (2 * G * c)), abs=1e-9)
    omega2 = 2 * 2 * G * c * (1 - math.cos(math.radians(30))) / inertia
    assert run.evaluate("omega(box)", bottom) ** 2 == pytest.approx(omega2, rel=1e-9)
    assert run.evaluate("bowl.N", bottom) > 2 * (G + c * omega2)


def test_a_box_does_not_fall_through_the_end_of_a_track():
    """Put half over the end of a level road, it tips about the end, which then slides along its side."""
    text = """
bodies: {box: {shape: rectangle, width: 1 m, height: 0.2 m, mass: 1 kg}}
ground: {points: {A: [-2, 0], B: [0, 0]}, curves: {road: [{line: [A, B]}]}}
contacts: {road: {of: [box, ground.road]}}
initial: {box.x: 0.1, box.y: 0.1, at_rest: true}
"""
    run = motion(text, 0.3, {"rtol": 1e-11})
    times = np.linspace(0.05, 0.3, 6)
    along = run.evaluate("box.angle", times)
    height = -(run.evaluate("box.x", times) * -np.sin(along) + run.evaluate("box.y", times) * np.cos(along))
    # The end lies on the lower side of the box.
    assert height == pytest.approx(-0.1, abs=1e-9) and along[-1] < -0.1

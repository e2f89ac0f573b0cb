"""Linear equations where loops, motions and contacts hold: against slopes of the core's accelerations along the loops, against
simulated swings, and against closed forms."""

from __future__ import annotations

import sys
from dataclasses import replace

import numpy as np
import pytest
from models import system
from numpy.testing import assert_allclose
from store import but_long

import freebody as fb
from freebody.core import State
from freebody.equations.linearization import Held, held, linearised, numbers, place_of
from freebody.equations.topics import NotHere, topic
from freebody.solve.symbolic_state import SymbolicState
from freebody.stability.equilibria import rest_near
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import mul, number

DAMPED = """
forces:
  bearing: {type: torsion_spring, on: left, stiffness: 0, damping: 0.3 N*m*s/rad}
  wind: {type: damper, between: [ground.D, platform.start], damping: 2 N*s/m}
"""
SWING = """
freebody: 1
name: platform on parallel links
parameters: {l: 0.5 m, m: 2 kg, M: 3 kg, w: 0.8 m, g: 9.81 m/s^2}
gravity: g
ground: {points: {A: [0, 0], D: [w, 0]}}
bodies:
  left: {shape: rod, length: l, mass: m}
  platform: {shape: rod, length: w, mass: M}
  right: {shape: rod, length: l, mass: m}
joints:
  A: {type: hinge, of: [ground.A, left.start], coordinate: theta}
  B: {type: hinge, of: [left.end, platform.start], coordinate: {name: beta, absolute: true}}
  D: {type: hinge, of: [ground.D, right.start], coordinate: phi}
  C: {type: hinge, of: [right.end, platform.end]}
initial: {theta: -90 deg, at_rest: true, guess: {beta: 0, phi: -90 deg}}
"""
BOWL = """
freebody: 1
name: disk in a bowl
parameters: {R: 1 m, r: 0.2 m, m: 2 kg, g: 9.81 m/s^2}
gravity: g
bodies:
  disk: {shape: disk, radius: r, mass: m}
"""
ON_AN_ARM = """
  arm: {shape: rod, length: "R - r", mass: 0 kg, inertia: 0}
joints:
  pivot: {type: hinge, of: [ground.O, arm.start], coordinate: {name: phi, zero: down}}
  axle: {type: hinge, of: [arm.end, disk.origin], coordinate: {name: theta, absolute: true}}
  roll: {type: rolling_circles, circle: {centre: disk.origin, radius: r}, on: {centre: ground.O, radius: R}, inside: true}
initial: {phi: 0, theta: 0, at_rest: true}
"""
IN_CONTACT = """
contacts:
  bowl: {of: [disk, {centre: ground.O, radius: R, hollow: true}], friction: 0.5}
initial: {disk.x: 0, disk.y: r - R, at_rest: true}
"""
HELD = """
freebody: 1
name: a cart that is held, with a pendulum
parameters: {l: 0.5 m, m: 2 kg, M: 3 kg, v: 0.3 m/s}
bodies:
  cart: {mass: M}
  bob: {mass: m, inertia: 0, points: {A: [0, l]}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}
  pin: {type: hinge, of: [cart.origin, bob.A], coordinate: theta}
motions:
  hand: {of: x, is: HAND, level: position}
initial: {theta: 0.2, at_rest: true}
"""


def slider_crank(**initial: object) -> tuple[fb.Mechanism, State]:
    mechanism = system("GEN-SLIDER")
    return mechanism, mechanism.start(at_rest=True, **initial)[0]


def four_bar() -> tuple[fb.Mechanism, State]:
    mechanism = system("S19.22")
    return mechanism, mechanism.start(at_rest=True, theta="-60 deg")[0]


def swing() -> tuple[fb.Mechanism, State]:
    mechanism = fb.Mechanism.loads(SWING)
    return mechanism, mechanism.start()[0]


def leaning(more: str) -> tuple[fb.Mechanism, State]:
    """The platform, its links of different length, so that it hangs askew."""
    uneven = SWING.replace("right: {shape: rod, length: l,", "right: {shape: rod, length: 1.5*l,")
    mechanism = fb.Mechanism.loads(uneven.rstrip() + more)
    return mechanism, mechanism.start()[0]


CLOSED = {"slider-crank": lambda: slider_crank(theta="-80 deg"), "four-bar": four_bar, "platform on links": swing}


def at_rest(make) -> tuple[fb.Mechanism, SymbolicState, Held]:
    mechanism, state = make()
    rest = rest_near(mechanism.source(), state)
    assert rest is not None
    subject = SymbolicState(mechanism.source(), rest, at_rest=True).with_numbers(
        [p["name"] for p in mechanism.source().metadata["parameters"]]
    )
    put = place_of(subject)
    return mechanism, subject, held(subject, linearised(subject, put), put)


def frequency(subject: SymbolicState, found: Held) -> float:
    m, k = numbers(subject, found.equations.mass), numbers(subject, found.equations.stiffness)
    return float(np.sqrt(np.linalg.eigvals(np.linalg.solve(m, k)).real.min()))


@pytest.mark.parametrize("name", [*CLOSED, "upper dead point"])
def test_stiffness_is_the_slope_of_accelerations_along_the_loop(name: str) -> None:
    """M⁻¹ K of the free coordinate is the slope of its acceleration, in the core, where its neighbours close the loop."""
    mechanism, subject, found = at_rest(CLOSED.get(name, lambda: slider_crank(theta="80 deg")))
    m, k = numbers(subject, found.equations.mass), numbers(subject, found.equations.stiffness)
    (free,) = found.equations.coordinates
    names, s, h = subject.names, subject.state, 1e-5
    places = dict(zip(names, s.q.tolist(), strict=True))
    core = mechanism.compile()

    def beside(step: float) -> float:
        near = {n: x for n, x in places.items() if n != free}
        place, _ = core.assemble(s.p, s.t, fixed={free: places[free] + step}, guess=near)
        return core.instant(place).accelerations[names.index(free)]

    slope = (beside(h) - beside(-h)) / (2 * h)
    assert_allclose(-np.linalg.solve(m, k), [[slope]], rtol=1e-7)


def test_damping_is_the_slope_by_rates_along_the_loop() -> None:
    """M⁻¹ C of the free coordinate is the slope of its acceleration by its rate, the others following."""
    mechanism, subject, found = at_rest(lambda: leaning(DAMPED))
    (free,) = found.equations.coordinates
    names, s, h = subject.names, subject.state, 1e-5
    ways = {free: 1.0} | {name: float(evaluate(way[0], {})) for name, way in found.follow.items()}
    rates = np.array([ways[name] for name in names])
    core = mechanism.compile()
    ahead, behind = (core.instant(replace(s, u=sign * h * rates)).accelerations[names.index(free)] for sign in (1, -1))
    m, c = numbers(subject, found.equations.mass), numbers(subject, found.equations.damping)
    assert c[0, 0] > 0.3
    assert_allclose(-np.linalg.solve(m, c), [[(ahead - behind) / (2 * h)]], rtol=1e-7)


@pytest.mark.parametrize("name", CLOSED)
def test_a_small_swing_has_the_period_of_the_eigenvalue(name: str) -> None:
    """Released beside the lowest place, it is there again after half a period, to the square of the amplitude."""
    mechanism, subject, found = at_rest(CLOSED[name])
    (free,) = found.equations.coordinates
    lowest = float(subject.state.q[subject.names.index(free)])
    half, beside = np.pi / frequency(subject, found), 1e-3
    run = mechanism.simulate(
        2 * half, initial={free: lowest + beside, "at_rest": True, "guess": guess(subject, free)}, t_eval=[half, 2 * half]
    )
    assert_allclose(run[free][-2:] - lowest, [-beside, beside], atol=2 * beside**2)


def guess(subject: SymbolicState, free: str) -> dict[str, float]:
    return {c["name"]: float(x) for c, x in zip(subject.coordinates, subject.state.q, strict=True) if c["name"] != free}


def test_platform_on_parallel_links() -> None:
    """It swings as (M + 2 m/3) l² θ̈ + (M + m) g l θ = 0, by energy."""
    mechanism, _ = swing()
    document = topic(mechanism, "linear")
    expected = np.sqrt((3 + 2) * 9.81 / ((3 + 4 / 3) * 0.5))
    assert f"± {expected:.5g} i" in document.text()
    assert "ξ₃ = ξ₁" in document.text() and "ξ₂ = 0" in document.text()


def test_a_third_link_holds_no_more() -> None:
    """With a redundant link, whose load is not determined, it swings by (M + m) l² θ̈ + (M + 3 m/2) g l θ = 0."""
    more = {
        "bodies:\n": "bodies:\n  middle: {shape: rod, length: l, mass: m}\n",
        "joints:\n": "joints:\n  E: {type: hinge, of: [ground.E, middle.start], coordinate: psi}\n"
        "  F: {type: hinge, of: [middle.end, platform.centre]}\n",
        "D: [w, 0]": "D: [w, 0], E: [w/2, 0]",
        "guess: {": "guess: {psi: -90 deg, ",
    }
    text = SWING
    for old, new in more.items():
        text = text.replace(old, new)
    said = topic(fb.Mechanism.loads(text), "linear").text()
    assert f"± {np.sqrt((3 + 3) * 9.81 / ((3 + 2) * 0.5)):.5g} i" in said
    assert "not determined" in said


def test_where_loops_lose_their_independence_it_is_said() -> None:
    """Flat, the links of the platform may turn the same way or against each other."""
    flat = SWING.replace("theta: -90 deg", "theta: 0").replace("phi: -90 deg", "phi: 0").replace("gravity: g", "gravity: none")
    with pytest.raises(NotHere, match="lose their independence"):
        topic(fb.Mechanism.loads(flat), "linear")


@pytest.mark.parametrize("held_by", [ON_AN_ARM, IN_CONTACT])
def test_a_disk_rolls_in_a_bowl(held_by: str) -> None:
    """ω² = 2 g/(3 (R − r)), whether a joint or friction keeps it from sliding. Den Hartog, Mechanical Vibrations, ch. 2."""
    said = topic(fb.Mechanism.loads(BOWL.rstrip() + held_by), "linear").text()
    assert f"± {np.sqrt(2 * 9.81 / (3 * 0.8)):.5g} i" in said


def test_a_motion_that_stands_still_holds_its_coordinate() -> None:
    """A pendulum on a cart that is held swings as one on a fixed pin, √(g/l); where the cart is driven nothing rests."""
    said = topic(fb.Mechanism.loads(HELD.replace("HAND", "0.3 m")), "linear").text()
    assert "√(g/l)" in said and "ξ₁ = 0" in said
    with pytest.raises(NotHere, match="hand prescribes a rate"):
        topic(fb.Mechanism.loads(HELD.replace("HAND", "v*t")), "linear")


@pytest.mark.long
def test_symbolically_or_with_lengths_in_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    """A slider-crank at its dead point is short enough for symbols; a four-bar keeps its mass and g."""
    monkeypatch.setattr(sys.modules["freebody.equations.stability"], "PATIENCE", 0.1)  # which is not looked at here
    mechanism, state = slider_crank(theta="-90 deg")
    assert "ξ₃ = r ξ₁" in topic(mechanism, "linear", state).text()
    mechanism, state = four_bar()
    said = topic(mechanism, "linear", state).text()
    assert "are numbers, in SI" in said and " m g" in said


GOVERNOR = """
freebody: 1
name: half of a governor, its plane turning at W
parameters: {l: 0.3 m, m: 2 kg, Ms: 1.5 kg, W: 12 rad/s, g: 9.81 m/s^2}
gravity: g
ground: {lines: {axis: {through: O, angle: -90 deg}}}
bodies:
  arm: {shape: rod, length: l, mass: 0 kg, inertia: 0}
  ball: {mass: m, inertia: 0}
  link: {shape: rod, length: l, mass: 0 kg, inertia: 0}
  sleeve: {mass: Ms, inertia: 0, lines: {base: {through: origin, angle: 0}}}
joints:
  top: {type: hinge, of: [ground.O, arm.start], coordinate: {name: theta, zero: down}}
  weld: {type: weld, of: [arm.end, ball.origin]}
  elbow: {type: hinge, of: [arm.end, link.start], coordinate: {name: beta, absolute: true}}
  guide: {type: slider, along: ground.axis, line: sleeve.base, coordinate: s}
  pin: {type: hinge, of: [link.end, sleeve.origin]}
forces:
  away: {type: force, at: ball.origin, x: "m*W^2*l*sin(theta)"}
initial: {theta: 50 deg, at_rest: true, guess: {beta: -130 deg, s: l}}
"""


@pytest.mark.long
def test_a_governor() -> None:
    """cos θ = (m + 2 Mₛ) g/(m W² l), about which ω² = (m + 2 Mₛ) g sin²θ/(l cos θ (m + 4 Mₛ sin²θ)), Mₛ being half of the sleeve.

    From the potential −m g l cos θ − 2 Mₛ g l cos θ − ½ m W² l² sin²θ and the inertia m l² + 4 Mₛ l² sin²θ; the equilibrium is that of
    Pontryagin, Ordinary Differential Equations, §27."""
    mechanism = fb.Mechanism.loads(GOVERNOR)
    for l, m, sleeve, spin in ((0.3, 2.0, 1.5, 12.0), (0.4, 1.0, 0.6, 12.0)):
        said = topic(mechanism, "linear", l=l, m=m, Ms=sleeve, W=spin).text()
        cosine = (m + 2 * sleeve) * 9.81 / (m * spin**2 * l)
        sine = np.sqrt(1 - cosine**2)
        own = np.sqrt((m + 2 * sleeve) * 9.81 * sine**2 / (l * cosine * (m + 4 * sleeve * sine**2)))
        assert f"± {own:.5g} i" in said and f"θ = {np.arccos(cosine):.5g}" in said


def test_a_governor_hangs_down_while_it_turns_slowly() -> None:
    """A pendulum in a plane that turns: it hangs straight down while W² < g/l. Pontryagin, as above, without a sleeve."""
    text = """
freebody: 1
name: pendulum, its plane turning at W
parameters: {l: 0.3 m, m: 2 kg, W: 2 rad/s, g: 9.81 m/s^2}
gravity: g
bodies: {bob: {mass: m, inertia: 0, points: {A: [0, l]}}}
joints: {pin: {type: hinge, of: [ground.O, bob.A], coordinate: theta}}
forces: {away: {type: force, at: bob.origin, x: "m*W^2*l*sin(theta)"}}
initial: {theta: 0, at_rest: true}
"""
    said = topic(fb.Mechanism.loads(text), "linear").text()
    assert "g − l W² > 0" in said or "g − W² l > 0" in said, said


def test_a_damped_inverted_pendulum_needs_a_stiff_spring() -> None:
    """m l² θ̈ + c θ̇ + (k − m g l) θ = 0 comes to rest upright if k > m g l, by Routh and Hurwitz."""
    text = """
freebody: 1
name: inverted pendulum
parameters: {l: 0.5 m, m: 2 kg, k: 30 N*m/rad, c: 0.4 N*m*s/rad, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {mass: m, inertia: 0, points: {A: [0, "-l"]}}}
joints: {pin: {type: hinge, of: [ground.O, rod.A], coordinate: {name: theta, sense: clockwise}}}
forces: {spring: {type: torsion_spring, on: rod, stiffness: k, damping: c}}
initial: {theta: 0, at_rest: true}
"""
    said = topic(fb.Mechanism.loads(text), "linear").text()
    assert "Small perturbations decay if" in said and "k − m g l > 0" in said and "m l² θ̈ + c θ̇" in said


@pytest.mark.parametrize("which", but_long(["mass", "stiffness", "damping"], "stiffness", "damping"))
def test_wrong_linear_equations_are_refused(which, monkeypatch):
    """What is printed is held against derivatives of the core: a derivation that errs by a part of a thousand in one matrix is found."""
    module = sys.modules["freebody.equations.topics.linear"]
    right = module.held

    def wrong(*asked):
        found = right(*asked)
        matrix = getattr(found.equations, which)
        off = [[mul(number(1.001), entry) for entry in row] for row in matrix]
        return replace(found, equations=replace(found.equations, **{which: off}))

    mechanism = fb.Mechanism.loads(SWING + DAMPED)
    assert topic(mechanism, "linear").equations.coordinates
    monkeypatch.setattr(module, "held", wrong)
    with pytest.raises(NotHere, match="do not agree"):
        topic(mechanism, "linear")

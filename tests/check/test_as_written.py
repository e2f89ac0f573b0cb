"""Statements as students, instructors and researchers write them; each is derived by hand beside it."""

from __future__ import annotations

import numpy as np
import pytest
from textbook import BOOKS

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism
from freebody.symbolic.errors import StatementError

T, W, IF, D, U = Kind.TRUE, Kind.WRONG, Kind.TRUE_IF, Kind.DIMENSIONS, Kind.UNDECIDABLE


def book(name: str, **letters: str | list[str]) -> Checker:
    found = next(each for each in BOOKS if each.name == name)
    return Checker(Mechanism.loads(f"freebody: 1\n{found.model}"), {**dict(found.letters), **letters}, seconds=60.0)


TABLE = """
freebody: 1
parameters: {Omega: 2 rad/s, m: 1 kg, k: 30 N/m, r0: 0.2 m}
gravity: none
bodies: {table: {mass: 0}, bead: {shape: particle, mass: m}}
joints:
  turn: {type: hinge, of: [ground.O, table.origin], coordinate: theta}
  groove: {type: slot, along: {through: table.origin, angle: 0}, point: bead.centre, coordinate: r}
motions: {drive: {of: theta, is: Omega*t, level: position}}
forces: {spring: {type: spring, along: r, stiffness: k, rest_length: r0}}
initial: {r: 0.3}
"""
PUSHED = """
freebody: 1
parameters: {m: 5 kg, mu: 0.3, F: 30 N, b: 0.4 m, h: 0.3 m}
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {box: {shape: rectangle, width: b, height: h, mass: m}}
contacts: {floor: {of: [box, ground.floor], friction: mu}}
forces: {push: {type: force, at: box.centre, x: F, y: 0}}
initial: {box.x: 0, box.y: h/2, at_rest: true}
run: {until: 1 s}
"""
DROPPED = """
freebody: 1
parameters: {m: 0.3 kg, h: 2 m, e: 0.5, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {ball: {shape: particle, mass: m}}
contacts: {floor: {of: [ball, ground.floor], restitution: e}}
initial: {ball.x: 0, ball.y: h, at_rest: true}
run: {until: 1 s}
"""
DRAG = """
freebody: 1
parameters: {m: 0.2 kg, c: 0.01 kg/m, g: 9.81 m/s^2}
gravity: g
bodies: {ball: {shape: particle, mass: m}}
joints: {air: {type: free, of: [ground.O, ball.centre], coordinates: [x, y]}}
forces:
  drag: {type: force, at: ball.centre, x: "-c*speed(ball.centre)*vx(ball.centre)", y: "-c*speed(ball.centre)*vy(ball.centre)"}
initial: {x: 0, y: 1, rates: {x: 3, y: 4}}
"""

KINETIC = "L = 1/2 M x'^2 + 1/2 m (x'^2 + 2 l x' θ' cos θ + l^2 θ'^2)"
WRITTEN = [
    # d/dt of an angular momentum is the couple
    ("bead on a turning rod", "d/dt((m1 l^2/3 + m2 R^2) θ') = T", T),
    ("bead on a turning rod", r"\frac{d}{dt}\left[\left(\frac{m_1 l^2}{3} + m_2 R^2\right)\dot\theta\right] = 2T", W),
    ("bead on a turning rod", "I := m1 l^2/3 + m2 R^2; H = I θ'; H' = T", T),
    # Lagrange's equations, of a Lagrangian symbolically
    ("pendulum on a cart", f"{KINETIC} + m g l cos θ; d/dt(∂L/∂θ') - ∂L/∂θ = 0; d/dt(∂L/∂x') - ∂L/∂x = F", T),
    ("pendulum on a cart", f"{KINETIC} + m g l cos θ; p = ∂L/∂x'; p' = F", T),
    ("pendulum on a cart", f"{KINETIC} - m g l cos θ; d/dt(∂L/∂θ') - ∂L/∂θ = 0", W),
    ("pendulum on a cart", rf"{KINETIC} + m g l cos θ \\ \frac{{d}}{{dt}}\frac{{\partial L}}{{\partial \dot x}} = F", T),
    # programs
    ("bead on a turning rod", "theta_dd = (T - 2*m2*R*R_d*theta_d)/(m1*l**2/3 + m2*R**2)", T),
    ("bead on a turning rod", "θ' = ω; R' = v; v' = R ω^2; ω' = (T - 2 m2 R v ω)/(m1 l^2/3 + m2 R^2)", T),
    ("bead on a turning rod", "θ' = ω; R' = v; v' = R ω^2; ω' = (T - m2 R v ω)/(m1 l^2/3 + m2 R^2)", W),
    ("mass on a spring", "dx/dt == v; dv/dt == (F - c*v - k*x)/m", T),
    ("mass on a spring", "v = x'\nv' = (F - c v + k x)/m", W),
    # a unit is a unit where m and s are symbols: s̈ = g (sin 35° − 0.2 cos 35°) = 4.0196 m/s²
    ("block that slides down a slope", "at start: s'' = 4.02 m/s^2", T),
    ("block that slides down a slope", "at start: s'' = 4.12 m/s^2", W),
    ("block that slides down a slope", "at start: s'' = 1/s", U),  # s is 0 there
    # names that lines before a claim, or words behind it, give
    ("bob on a spring", "E = 1/2 m (r'^2 + r^2 θ'^2) + 1/2 k (r - r0)^2 - m g r cos θ; constant: E", T),
    ("bob on a spring", "constant: K + V where K = 1/2 m (r'^2 + r^2 θ'^2), V = 1/2 k (r - r0)^2 - m g r cos θ", T),
    ("bob on a spring", "constant: K - V where K = 1/2 m (r'^2 + r^2 θ'^2), V = 1/2 k (r - r0)^2 - m g r cos θ", W),
    ("bob on a spring", "if at rest, theta = 0, r = r0 + m g/k: r'' = 0", T),  # it hangs in equilibrium
    # to first order
    ("rod as a pendulum", "θ'' = -3/2 g/l θ", IF),
    ("rod as a pendulum", "limit: θ'' = -3/2 g/l θ as theta -> 0", T),
    ("rod as a pendulum", "limit: θ'' = -g/l θ as theta -> 0", W),
    ("rod as a pendulum", "limit: θ'' = 3/2 g/l (θ − pi) as theta -> pi", T),  # sin θ ≈ π − θ
    ("pendulum on a cart", "x'' + l θ'' + g θ = 0", IF),
    ("pendulum on a cart", "limit: M x'' = F + m g θ as theta -> 0", T),  # of ẍ (M + m sin²θ) = F + m sin θ (l θ̇² + g cos θ)
    ("pendulum on a cart", "limit: M x'' = F + 2 m g θ as theta -> 0", W),
    ("double pendulum", "(m1+m2) l1 θ1'' + m2 l2 θ2'' + (m1+m2) g θ1 = 0", IF),
    # from the start
    ("rod as a pendulum", "if the start is at rest: θ'^2 = 3 g/l (cos θ - cos 0.4)", T),
    ("rod as a pendulum", "if released from rest: θ'^2 = 3 g/l (cos θ - cos 0.5)", W),
    ("pendulum on a cart", "only if F = 0, the start is at rest: (M+m) x' + m l θ' cos θ = 0", T),
    ("block on a sliding wedge", "if the start is at rest: constant: m1 x + m2 (x + s cos α)", T),
    ("block on a sliding wedge", "constant: m1 x + m2 (x + s cos α)", T),  # as the model starts
]


@pytest.mark.parametrize(("name", "text", "kind"), WRITTEN)
def test_it_is_judged_as_it_is_written(name: str, text: str, kind: Kind) -> None:
    verdict = book(name).check(text)
    assert verdict.kind is kind, str(verdict)


MODELS = [
    (TABLE, "m (r'' - r Ω^2) = -k (r - r0)", T),
    (TABLE, "m (r'' + r Ω^2) = -k (r - r0)", W),
    (TABLE, "groove.Fn = 2 m Ω r'", T),  # the Coriolis force
    (PUSHED, "N = m g", T),
    (PUSHED, "m box.x'' = F - mu m g", T),
    (PUSHED, "m box.x'' = F + mu m g", W),
    (PUSHED, "N_floor₁ + N_floor₂ = m g", T),
    (PUSHED, "(N_floor₁ - N_floor₂) b = mu N h", T),  # moments about the centre: the right corner, ahead, carries more
    (PUSHED, "(N_floor₁ - N_floor₂) b = 2 mu N h", W),
    (PUSHED, "F >= mu N", W),  # it may also slide on, ever slower
    (PUSHED, "if the start is at rest: F >= mu N", T),  # else it would not slide
    (DROPPED, "if the start is at rest: ball.y'^2 = 2 g (h - ball.y)", T),  # up to the impact
    (DRAG, "m x'' = -c v x'; m y'' = -m g - c v y'", T),
    (DRAG, "d/dt(1/2 m (x'^2 + y'^2) + m g y) = -c v^3", T),
]


@pytest.mark.parametrize(("model", "text", "kind"), MODELS)
def test_of_other_models(model: str, text: str, kind: Kind) -> None:
    letters = {
        TABLE: {"i'": "direction from table.origin to bead.centre"},
        PUSHED: {"N": "floor.N"},
        DRAG: {"v": "speed(ball.centre)"},
    }
    verdict = Checker(Mechanism.loads(model), letters.get(model)).check(text)
    assert verdict.kind is kind, str(verdict)


SLIPS = [
    # an acceleration alone on the left is what the equation is solved for: the other side is mended
    ("block on a sliding wedge", "x'' = m2 g sin α cos α/(m1 + m2 sin^2 α)", {"sign"}, "xddot = -m2"),
    ("bead on a turning rod", "R'' = 2 R θ'^2", {"factor"}, "Rddot = R*thetadot^2"),
    ("bead on a turning rod", "(m1 l^2/3 + m2 l^2) θ'' + 2 m2 R R' θ' = T", {"symbol"}, "m2*R^2"),
    ("mass on a spring", "m x'' + k x' + c x = F", {"convention"}, "c*xdot + k*x"),
    ("disk that rolls down a slope", "s'' = 2/3 m g sin(a)", {"extra factor"}, "sddot = 2/3*g*sin(a)"),
    ("rod as a pendulum", "θ'' = -3 g/2 l sin θ", {"brackets"}, "3*g/(2*l)"),
    # two slips
    ("bead on a turning rod", "(m1 l^2/12 + m2 R^2) θ'' + m2 R R' θ' = T", {"factor"}, "m1*l^2/3"),
    ("pendulum on a cart", "x'' = (F + m sin θ (l θ'^2 - g cos θ))/(M + m cos^2 θ)", {"sign", "function"}, "sin(theta)^2"),
    # of a linearised equation
    ("rod as a pendulum", "θ'' = -g/l θ", {"factor"}, "(with small theta)"),
    ("pendulum on a cart", "x'' + l θ'' - g θ = 0", {"sign"}, "(with small theta)"),
]


@pytest.mark.parametrize(("name", "text", "kinds", "after"), SLIPS)
def test_the_first_mend_is_the_one_that_a_person_would_make(name: str, text: str, kinds: set[str], after: str) -> None:
    verdict = book(name).check(text)
    assert verdict.kind in (Kind.WRONG, Kind.DIMENSIONS)
    assert {edit[0] for edit in verdict.mends[0].edits} <= kinds, str(verdict)
    assert after in str(verdict.mends[0])


def test_two_signs_go_before_a_term_that_stands_for_them() -> None:
    """−k (x2 − x1) − c (ẋ2 − ẋ1) for its opposite lacks 2 m2 ẍ2, of which the equation says nothing."""
    two = """
freebody: 1
parameters: {m1: 1 kg, m2: 2 kg, k1: 100 N/m, k2: 50 N/m, c: 2 N*s/m}
gravity: none
bodies: {a: {mass: m1}, b: {mass: m2}}
joints:
  ra: {type: slider, along: {through: ground.O, angle: 0}, line: {through: a.origin, angle: 0}, coordinate: x1}
  rb: {type: slider, along: {through: ground.O, angle: 0}, line: {through: b.origin, angle: 0}, coordinate: x2}
forces:
  s1: {type: spring, along: x1, stiffness: k1}
  s2: {type: spring, along: x2 - x1, stiffness: k2, damping: c}
initial: {x1: 0.1, x2: -0.1}
"""
    first, *_ = Checker(Mechanism.loads(two)).check("m1 x1'' = -k1 x1 - k2 (x2 - x1) - c (x2' - x1')").mends
    assert [edit[0] for edit in first.edits] == ["sign", "sign"]


def test_a_spoilt_inequality_is_shown_where_it_is_broken() -> None:
    verdict = book("block that slides down a slope").check("tan(a) > mu")  # it may also slide on, ever slower
    at = verdict.evidence
    assert verdict.kind is Kind.WRONG
    assert at is not None
    assert np.tan(at.letters["a"]) <= at.letters["mu"]


def test_assumptions_that_are_equally_mild_are_all_named() -> None:
    verdict = book("mass on a spring").check("m x'' + k x = F")
    assert verdict.assumption == "at rest"
    assert "c = 0" in verdict.reason


INDEPENDENT = [
    ("bead on a turning rod", "T - R N = m1 l^2 θ''/3 and N = m2 (R θ'' + 2 R' θ')", "independent in"),
    ("two weights over a pulley", "a = (m2 - m1) g/(m1 + m2); y1'' = a; y2'' = -a; S = m1 (g + a)", "independent in"),
    ("two weights over a pulley", "m1 y1'' = S - m1 g; 2 m1 y1'' = 2 S - 2 m1 g", "only 1 of them"),
]


@pytest.mark.parametrize(("name", "text", "said"), INDEPENDENT)
def test_forces_are_unknowns_too(name: str, text: str, said: str) -> None:
    verdict = book(name, N="track.Fn" if "bead" in name else "0").check(text)
    assert verdict.ok
    assert said in verdict.reason


@pytest.mark.parametrize("text", ["limit: s'' = g", "follows: s'' = g", "shorter: s'' = g", "report: s"])
def test_a_claim_that_lacks_a_part_is_no_label(text: str) -> None:
    with pytest.raises(StatementError, match="a part of this claim is missing"):
        book("block that slides down a slope").check(text)


def test_a_number_that_is_a_vector_is_said_so() -> None:
    verdict = book("bob on a spring", e=["sin(theta)", "-cos(theta)"]).check("r = r e")
    assert verdict.kind is Kind.DIMENSIONS
    assert "the right side a vector" in verdict.reason

"""What is right is called right, what is wrong is corrected, and what is true only sometimes has its condition."""

from __future__ import annotations

import numpy as np
import pytest
from textbook import BOOKS, Book

from freebody.catalogue import model_file
from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism


def checker(name: str) -> Checker:
    book = next(book for book in BOOKS if book.name == name)
    return Checker(Mechanism.loads(f"freebody: 1\n{book.model}"), dict(book.letters))


@pytest.fixture(scope="module")
def cart() -> Checker:
    return checker("pendulum on a cart")


@pytest.mark.parametrize("book", BOOKS, ids=lambda book: book.name)
def test_textbook_equations_are_true(book: Book) -> None:
    one = Checker(Mechanism.loads(f"freebody: 1\n{book.model}"), dict(book.letters))
    for equation in book.equations:
        verdict = one.check(equation)
        assert verdict.kind is Kind.TRUE, (equation, verdict)
        assert not verdict.untested


SLIPS = [
    ("l*theta'' + x''*cos(theta) - g*sin(theta) = 0", "sign", "-g*sin(theta)"),
    ("l*theta'' + x''*sin(theta) + g*sin(theta) = 0", "function", "sin(theta)"),
    ("l*theta'' + 2*x''*cos(theta) + g*sin(theta) = 0", "factor", "2"),
    ("theta'' + x''*cos(theta) + g*sin(theta) = 0", "missing factor", "thetaddot"),
    ("l*theta'' + x'*cos(theta) + g*sin(theta) = 0", "derivative", "xdot"),
    ("(M+M)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = F", "symbol", "M"),
    ("(M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'*sin(theta) = F", "power", "thetadot"),
    ("(M+m)*x'' + m*l*theta''*cos(theta) - m*l*x'*theta'*sin(theta) = F", "symbol", "xdot"),
    ("l*theta'' + x''*cos(theta) + g*sin(theta)*cos(theta) = 0", "extra factor", "g*sin(theta)*cos(theta)"),
    ("l*theta'' + x''*cos(theta) + g*sin(theta) + g*cos(theta) = 0", "extra term", "g*cos(theta)"),
]


@pytest.mark.parametrize(("text", "kind", "place"), SLIPS)
def test_a_slip_is_named_with_its_place(cart: Checker, text: str, kind: str, place: str) -> None:
    verdict = cart.check(text)
    assert verdict.kind in (Kind.WRONG, Kind.DIMENSIONS)
    assert (kind, place) in [edit[:2] for mend in verdict.mends for edit in mend.edits], [str(m) for m in verdict.mends]


def test_a_mend_is_a_true_equation(cart: Checker) -> None:
    for text, _, _ in SLIPS:
        for mend in cart.check(text).mends:
            assert cart.check(mend.equation).ok, (text, mend.equation)


def test_two_slips_are_found_together(cart: Checker) -> None:
    verdict = cart.check("(M+m)*x'' - m*l*theta''*cos(theta) - m*l*theta'^2*cos(theta) = F")
    kinds = [sorted(edit[0] for edit in mend.edits) for mend in verdict.mends]
    assert verdict.kind is Kind.WRONG
    assert ["function", "sign"] in kinds


def test_what_nothing_small_mends_is_said_to_be_so(cart: Checker) -> None:
    verdict = cart.check("M*x''*cos(x/l)^2 = F*sin(theta) - m*g*theta'*x'/(l*l*m) * M")
    assert verdict.kind in (Kind.WRONG, Kind.DIMENSIONS)
    assert not verdict.mends
    assert verdict.evidence is not None or verdict.kind is Kind.DIMENSIONS


CONDITIONS = [
    ("(M+m)*x'' + m*l*theta''*cos(theta) = F", "at rest"),
    ("l*theta'' + x''*cos(theta) = 0", "without gravity"),
    ("(M+m)*x'' + m*l*theta''*cos(theta) - m*l*theta'^2*sin(theta) = 0", "F = 0"),
    ("l*theta'' + g*sin(theta) = 0", "M → ∞"),
    ("theta'' + 2*x''*cos(theta) + 2*g*sin(theta) = 0", "these numbers of the model"),
]


@pytest.mark.parametrize(("text", "condition"), CONDITIONS)
def test_what_was_left_out_is_wrong_and_when_it_would_not_matter_is_said(cart: Checker, text: str, condition: str) -> None:
    verdict = cart.check(text)
    if condition == "these numbers of the model":
        assert verdict.kind in (Kind.TRUE_IF, Kind.DIMENSIONS)  # 1/l is 2 only with the unit of l forgotten
        return
    assert verdict.kind is Kind.WRONG
    assert verdict.assumption == condition
    assert {edit[0] for edit in verdict.mends[0].edits} == {"missing term"}


def test_an_assumption_does_not_excuse_a_wrong_sign(cart: Checker) -> None:
    verdict = cart.check("(M+m)*x'' + m*l*theta''*cos(theta) + m*l*theta'^2*sin(theta) = F")
    assert verdict.kind is Kind.WRONG  # though it holds at rest


def test_a_number_beside_a_vector_is_no_equation() -> None:
    letters = {"e": ["cos(alpha)", "-sin(alpha)"]}
    verdict = checker("block on a sliding wedge").check("0 = (m1 x'' + m2 (x'' + s'' e))·i", letters)
    assert verdict.kind is Kind.DIMENSIONS


def test_evidence_breaks_the_equation(cart: Checker) -> None:
    verdict = cart.check("l*theta'' = g*sin(theta) - x''*cos(theta)")
    seen = verdict.evidence
    assert seen is not None
    at = seen.letters
    left, right = at["l"] * at["thetaddot"], at["g"] * np.sin(at["theta"]) - at["xddot"] * np.cos(at["theta"])
    assert seen.left == pytest.approx(left)
    assert seen.right == pytest.approx(right)
    # The state is a true one: the equation that holds, holds there.
    assert left == pytest.approx(-at["g"] * np.sin(at["theta"]) - at["xddot"] * np.cos(at["theta"]))


def test_equations_that_say_the_same_twice_are_reported(cart: Checker) -> None:
    verdict = cart.check("l*theta'' + x''*cos(theta) + g*sin(theta) = 0\n2*l*theta'' + 2*x''*cos(theta) = -2*g*sin(theta)")
    assert verdict.ok
    assert "only 1 of them independent" in verdict.reason


def test_what_is_the_same_by_itself_is_reported(cart: Checker) -> None:
    assert "says nothing" in cart.check("2*l*theta''/l - theta'' = theta''").reason
    assert "says nothing" not in cart.check("l*theta'' + x''*cos(theta) + g*sin(theta) = 0").reason


def test_the_same_seed_gives_the_same_evidence() -> None:
    text = "l*theta'' = g*sin(theta)"
    first, second = (checker("pendulum on a cart").check(text).evidence for _ in range(2))
    assert first == second


REDUNDANT = """
freebody: 1
parameters: {m: 2 kg, l: 1 m}
bodies: {beam: {shape: rod, length: l, mass: m}}
ground: {points: {B: [l, 0]}}
joints:
  a: {type: hinge, of: [ground.O, beam.start]}
  b: {type: hinge, of: [ground.B, beam.end]}
"""


REDUNDANT_STATEMENTS = [
    ("a_x = 0", Kind.UNDECIDABLE),  # the beam may be stretched between its hinges
    ("a_x + b_x = 0", Kind.TRUE),  # by however much, the two are opposite
    ("a_x - b_x = 0", Kind.UNDECIDABLE),
    ("2*a_y = m*g", Kind.TRUE),
    ("a_y = m*g", Kind.WRONG),
    ("a_x + b_x = m*g", Kind.WRONG),
]


@pytest.mark.parametrize(("text", "kind"), REDUNDANT_STATEMENTS)
def test_reactions_that_are_not_determined_must_fit_whatever_they_are(text: str, kind: Kind) -> None:
    assert Checker(Mechanism.loads(REDUNDANT)).check(text).kind is kind


def system(name: str) -> Checker:
    return Checker(Mechanism.load(model_file(name)))


def test_a_number_of_the_start_is_true_only_there() -> None:
    pendulum = system("S19.18/model")  # θ̈ at the start by hand: (g sin(slope − θ) − s̈ cos θ)/l, ẍ by elimination
    slope, theta, g, l, M, m = np.radians(20), 0.6, 9.81, 0.5, 2.0, 1.0
    pull = (M + m) * np.sin(slope) - m * np.cos(theta) * np.sin(slope - theta)
    thetaddot = (g * np.sin(slope - theta) - np.cos(theta) * g * pull / (M + m * np.sin(theta) ** 2)) / l
    verdict = pendulum.check(f"theta'' = {thetaddot:.2f}")
    assert (verdict.kind, verdict.assumption) == (Kind.TRUE_IF, "at the start, with these numbers of the model")
    assert pendulum.check(f"theta'' = {thetaddot + 0.02:.2f}").kind is Kind.WRONG


def test_angles_that_are_equal_but_for_round_off_are_equal() -> None:
    held = system("EX-ARM/held")
    assert held.check("sin(theta1 - theta2) = 0").ok
    assert system("EX-ARM/model").check("sin(theta1 - theta2) = 0").kind is Kind.WRONG


def test_rates_of_a_prescribed_acceleration_are_free() -> None:
    """Else nothing would be learnt about products of them."""
    pendulum = system("19.3.18/model")
    assert pendulum.check("l*theta'' = aA*sin(theta)").ok
    assert pendulum.check("l*theta'' = aA*sin(theta) + xA'*theta'").kind is Kind.WRONG


LIKELY = [
    ("S19.19/model", "(M+m) x'' + k x = m eps (θ'' cosθ + θ'^2 sinθ)", "`sin` and `cos` of `theta` exchanged"),
    ("EX-ARM/model", "I1 θ1'' = Ms − Me + l1 (shoulder_x sinθ1 − shoulder_y cosθ1) − l3 (elbow_y cosθ1 − elbow_x sinθ1)", "l3 - l1"),
    ("19.3.25/model", "m ½ l² θ'' = −m g l sinθ + m l r'' cosθ", "1"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "text", "after"), LIKELY)
def test_the_likely_slip_is_the_one_mend(name: str, text: str, after: str) -> None:
    (mend,) = system(name).check(text).mends
    assert [edit[2] for edit in mend.edits] == [after]


def test_mends_in_parameters_that_follow_from_others_come_last() -> None:
    gun = system("S19.16/model")  # m1 is m2/3 there
    first, *_ = gun.check("(m1 l²/3 + m2 R²) θ'' = T").mends
    assert first.edits[0][2] == "2*m2*R*Rdot*thetadot"


VAIN = [
    ("T = 0", 1),  # m2 T = 3 m1 T, and T R̈ = T R θ̇², say nothing of T; in m1 and in m2 it is one mend
    ("pivot.Fx = 0", 0),
    ("m1 = m2/2", 1),  # what the model defines can itself be stated, and mended
]


@pytest.mark.parametrize(("text", "count"), VAIN)
def test_a_mend_says_something_of_what_was_stated(text: str, count: int) -> None:
    gun = system("S19.16/model")  # m1 is m2/3 there
    verdict = gun.check(text)
    assert verdict.kind is Kind.WRONG
    assert len(verdict.mends) == count, [str(mend) for mend in verdict.mends]


def test_what_parameters_are_defined_to_be_says_nothing_of_the_motion() -> None:
    assert "says nothing" in system("S19.16/model").check("m1 = m2/3").reason


LADDER = """
freebody: 1
parameters: {m: 10 kg, l: 4 m, mu: 0.3}
ground: {lines: {floor: {through: O, angle: 0}, wall: {through: O, angle: -90 deg}}}
bodies: {ladder: {shape: rod, length: l, mass: m}}
joints: {pos: {type: free, of: [ground.O, ladder.start], coordinates: [x, y, phi]}}
contacts:
  foot: {of: [ladder.start, ground.floor], friction: mu}
  top: {of: [ladder.end, ground.wall]}
initial: {x: 2 m, y: 0, phi: 120 deg}
"""
STATICS = [  # phi lies in the second quadrant, where its cosine is negative
    ("top.N = -m g cos(phi)/(2 sin(phi))", Kind.TRUE),  # moments about the foot
    ("top.N = -m g cos(phi)/sin(phi)", Kind.WRONG),
    ("foot.N = m g", Kind.TRUE),
    ("foot.T = -top.N", Kind.TRUE),
    ("abs(foot.T) <= mu foot.N", Kind.TRUE),
    ("abs(foot.T) <= mu foot.N/2", Kind.WRONG),
    ("x = -l cos(phi)", Kind.TRUE),  # it stands elsewhere, too, but always between floor and wall
]


@pytest.fixture(scope="module")
def ladder() -> Checker:
    return Checker(Mechanism.loads(LADDER))


@pytest.mark.parametrize(("text", "kind"), STATICS)
def test_a_body_that_cannot_move_is_decided_where_it_can_stand(ladder: Checker, text: str, kind: Kind) -> None:
    assert ladder.check(text).kind is kind


HOIST = """
freebody: 1
parameters: {m1: 2 kg, m2: 1 kg, R: 0.1 m}
ground: {points: {P: [0, 2], L: [-0.1, 0], K: [0.1, 0]}}
bodies: {left: {shape: particle, mass: m1}, right: {shape: particle, mass: m2}}
joints:
  rl: {type: slot, along: {through: ground.L, angle: 90 deg}, point: left.centre, coordinate: yl}
  rr: {type: slot, along: {through: ground.K, angle: 90 deg}, point: right.centre, coordinate: yr}
strings: {rope: {ends: [left.centre, right.centre], over: [{pulley: ground.P, radius: R, sense: clockwise}]}}
initial: {yl: 0.5 m, yr: 0.5 m}
"""


def test_at_rest_is_at_rest_anywhere() -> None:
    """Only with R = 0.1 m does the rope hang along the guides; at rest on other pulleys it leans."""
    verdict = Checker(Mechanism.loads(HOIST)).check("(m1 + m2) yl'' = (m2 - m1) g")
    assert (verdict.kind, verdict.assumption) == (Kind.TRUE_IF, "these numbers of the model")


MEASURED = [
    ("x(rod.end) = l cos(theta)", Kind.TRUE),
    ("y(rod.end) = l cos(theta)", Kind.WRONG),
    ("accel(R) = R rate(theta)^2", Kind.TRUE),
    ("m1 ax(rod.G) = pivot.Fx - track.Fn sin(theta)", Kind.WRONG),
    ("m1 ax(rod.G) = pivot.Fx + track.Fn sin(theta)", Kind.TRUE),
    ("kinetic(rod) = m1 l^2 omega(rod)^2/6", Kind.TRUE),
    ("constant: energy() - T theta", Kind.TRUE),
]


@pytest.mark.parametrize(("text", "kind"), MEASURED)
def test_what_the_model_language_measures_stands_in_statements(text: str, kind: Kind) -> None:
    assert system("S19.16/model").check(text).kind is kind


PENDULUM = """
freebody: 1
parameters: {m: 2 kg, l: 0.7 m}
bodies: {bob: {shape: particle, mass: m}}
joints: {O: {type: link, of: [ground.O, bob.centre], length: l, coordinate: {name: θ, zero: down}}}
initial: {θ: -0.5, at_rest: true}
"""


@pytest.mark.parametrize(("text", "kind"), [("v = l θ'", Kind.TRUE), ("v = −l θ'", Kind.WRONG), ("v = 2 l θ'", Kind.WRONG)])
def test_a_size_beside_a_rate_has_the_sense_in_which_it_sets_off(text: str, kind: Kind) -> None:
    assert Checker(Mechanism.loads(PENDULUM), {"v": "speed(bob.centre)"}).check(text).kind is kind


SHAFT = """
freebody: 1
parameters: {I: 2 kg*m^2, J: 3 kg*m^2, k: 5 N*m, c: 1 N*m*s, Q: 4 N*m}
gravity: none
bodies: {hub: {mass: 1 kg, inertia: I}, ring: {mass: 1 kg, inertia: J}}
joints: {a: {type: hinge, of: [ground.O, hub.G], coordinate: θ}, b: {type: hinge, of: [ground.O, ring.G], coordinate: φ}}
forces:
  oil: {type: law, along: φ - θ, value: -c*(rate(φ) - rate(θ))}
  motor: {type: law, along: θ, value: Q - k*θ}
initial: {rates: {θ: 1}}
"""


def test_corrections_without_lengths() -> None:
    """Where a model has none there are no components by ratios of them."""
    assert Checker(Mechanism.loads(SHAFT)).check("(I + J) θ'' = Q − k θ").kind is Kind.WRONG


SPRING = """
freebody: 1
gravity: none
bodies: {p: {shape: particle, mass: 2 kg}}
joints: {guide: {type: slot, along: {through: ground.O, angle: 0}, point: p.centre, coordinate: x}}
forces: {coil: {type: spring, along: x, stiffness: 30 N/m}}
initial: {x: 1 m}
"""


def test_figures_of_a_true_equation_are_in_si_units() -> None:
    spring = Checker(Mechanism.loads(SPRING))
    assert spring.check("2 x'' = -30 x").ok
    verdict = spring.check("2 x'' = -31 x")
    assert (verdict.kind, verdict.reason) == (Kind.WRONG, "figures are in SI units")
    assert "30" in {edit[2] for mend in verdict.mends for edit in mend.edits}


# slips with a sentence of why: what is left out, a moment of inertia about another point, sine for cosine
REASONS = [
    ("1/12 m L^2 θ'' = 1/2 m g L sin θ", "about another point"),
    ("1/3 m L^2 θ'' = 1/2 m g L cos θ", "sine and cosine"),
    ("1/3 m L^2 θ'' = -1/2 m g L sin θ", "other sense"),
    ("N_B = m g - m L/2 θ'' sin θ", "centripetal"),
]
SLIPPING = """
freebody: 1
parameters: {m: 8 kg, L: 3 m, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}, wall: {through: O, angle: -90 deg}}}
bodies: {ladder: {shape: rod, length: L, mass: m}}
joints:
  B: {type: slot, point: ladder.start, along: ground.floor, coordinates: [x, {name: phi, zero: up, absolute: true}]}
  A: {type: slot, point: ladder.end, along: ground.wall}
initial: {phi: 20 deg, at_rest: true}
"""


@pytest.fixture(scope="module")
def slipping() -> Checker:
    return Checker(Mechanism.loads(SLIPPING), {"θ": "phi", "N_A": "A.Fn", "N_B": "B.Fn"})


@pytest.mark.parametrize(("text", "why"), REASONS)
def test_at_most_three_corrections_each_with_its_reason(slipping: Checker, text: str, why: str) -> None:
    verdict = slipping.check(text)
    assert verdict.kind in (Kind.WRONG, Kind.TRUE_IF)
    assert len(verdict.mends) <= 3
    assert not why or why in verdict.mends[0].why, str(verdict)


def test_past_its_budget_it_says_what_it_has() -> None:
    checker = Checker(Mechanism.loads(SLIPPING), {"θ": "phi", "N_B": "B.Fn"}, seconds=1e-6)
    verdict = checker.check("N_B = m g")
    assert verdict.kind is Kind.WRONG
    assert "no more was looked for" in str(verdict)
    assert checker.check("1/3 m L^2 θ'' = 1/2 m g L sin θ").ok


def test_a_function_of_nothing_is_a_factor_like_any_other():
    verdict = system("S19.16/model").check("(m1 l^2/3) thetaddot cos(0) = T")
    assert verdict.kind is Kind.WRONG and verdict.mends

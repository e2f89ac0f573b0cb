"""Claims: constants, limits, figures to their printed digits, consequences, and conditions tried both ways."""

from __future__ import annotations

import pytest
from textbook import BOOKS

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism
from freebody.symbolic.errors import StatementError


def checker(name: str) -> Checker:
    book = next(book for book in BOOKS if book.name == name)
    return Checker(Mechanism.loads(f"freebody: 1\n{book.model}"), dict(book.letters))


CLAIMS = [
    ("pendulum on a cart", "if F = 0: constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.TRUE),
    ("pendulum on a cart", "constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.WRONG),
    ("pendulum on a cart", "only if F = 0: constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.TRUE),
    ("pendulum on a cart", "only if g = 0: (M+m)*xddot + m*l*thetaddot*cos(theta) - m*l*thetadot^2*sin(theta) = F", Kind.WRONG),
    ("pendulum on a cart", "limit: l*thetaddot = -g*sin(theta) as M -> inf", Kind.TRUE),
    ("pendulum on a cart", "limit: l*thetaddot = g*sin(theta) as M -> inf", Kind.WRONG),
    ("pendulum on a cart", "limit: l*thetaddot = -g*sin(theta) as m -> 0", Kind.WRONG),
    ("pendulum on a cart", "if m = M, theta = pi/4, at rest, F = 0: xddot = g/3", Kind.TRUE),
    ("pendulum on a cart", "no x, xdot in: thetaddot", Kind.TRUE),
    ("pendulum on a cart", "no thetadot in: thetaddot", Kind.WRONG),
    ("pendulum on a cart", "if thetadot = 0: (M+m)*xddot + m*l*thetaddot*cos(theta) = F", Kind.TRUE),
    ("bead on a turning rod", "only if T = 0: constant: (m1*l^2/3 + m2*R^2)*thetadot", Kind.TRUE),
    ("bead on a turning rod", "only if thetadot = 0, T = 0: constant: thetadot", Kind.TRUE),
    ("bead on a turning rod", "if thetadot = 0: constant: thetadot", Kind.WRONG),
    ("bead on a turning rod", "follows: m2*Rddot = m2*R*thetadot^2 from Rddot = R*thetadot^2", Kind.TRUE),
    ("bead on a turning rod", "follows: Rddot = 0 from Rddot = R*thetadot^2", Kind.WRONG),
    # premises that are quadratic in rates: of one rate, of two, and of which one has no root everywhere
    ("pendulum on a cart", "follows: x'^2 = 3 g l from x'^2 + l^2 theta'^2 = 4 g l and l theta'^2 = g", Kind.TRUE),
    ("pendulum on a cart", "follows: x'^2 = 4 g l from x'^2 + l^2 theta'^2 = 4 g l and l theta'^2 = g", Kind.WRONG),
    ("double pendulum", "constant: energy()", Kind.TRUE),
    ("double pendulum", "constant: kinetic()", Kind.WRONG),
    ("double pendulum", "energy() = const", Kind.TRUE),
    ("double pendulum", "T = kinetic(); E = T + potential() = constant", Kind.TRUE),
    ("double pendulum", "kinetic() = const.", Kind.WRONG),
    ("block on a sliding wedge", "constant: xddot", Kind.TRUE),
    ("block on a sliding wedge", "constant: xdot", Kind.WRONG),
    ("block on a sliding wedge", "constant: xdot î", Kind.WRONG),
    ("block on a sliding wedge", "constant: xddot î", Kind.TRUE),
    ("pendulum on a cart", "no x, thetadot in the factors of xddot: (M+m)*xddot + m*l*thetaddot*cos(theta) = 0", Kind.TRUE),
    ("pendulum on a cart", "no theta in the factors of thetaddot: (M+m)*xddot + m*l*thetaddot*cos(theta) = 0", Kind.WRONG),
    (
        "pendulum on a cart",
        "shorter: l*thetaddot = -g*sin(theta) - xddot*cos(theta) than m*l*thetaddot + m*xddot*cos(theta) = -m*g*sin(theta) + 0*F + m*g - m*g",
        Kind.TRUE,
    ),
    (
        "pendulum on a cart",
        "shorter: l*thetaddot = -g*sin(theta) than l*thetaddot + xddot*cos(theta) = -g*sin(theta)",
        Kind.WRONG,
    ),
]


@pytest.mark.parametrize(("book", "text", "kind"), CLAIMS)
def test_claims(book: str, text: str, kind: Kind) -> None:
    verdict = checker(book).check(text)
    assert verdict.kind is kind, verdict
    assert verdict.reason


FALL = """
freebody: 1
parameters: {m: 1 kg, h: 2 m}
gravity: 9.81 m/s^2
bodies: {stone: {shape: particle, mass: m}}
joints: {path: {type: slider, along: {through: ground.O, angle: 90 deg}, line: {through: stone.centre, angle: 90 deg}, coordinate: y}}
initial: {y: h, at_rest: true}
events: {lands: {when: y, direction: falling, then: stop}}
run: {until: 5 s}
"""
FALL = FALL.replace("shape: particle, ", "")  # a slider holds the direction of what it carries
FALL = FALL.replace("stone.centre", "stone.origin")

# Falling 2 m from rest takes √(2·2/9.81) = 0.638551 s and ends with √(2·9.81·2) = 6.264184 m/s.
FIGURES = [
    ("at lands: t = 0.64 s", True),
    ("at lands: t = 0.639 s", True),
    ("at lands: t = 0.638 s", False),
    ("at lands: t = 0.63855 s", True),
    ("at lands: ydot = -6.26 m/s", True),
    ("at lands: ydot = -6.27 m/s", False),
    ("at start: yddot = -9.81 m/s^2", True),
    ("at 0.1 s: ydot = -0.981 m/s", True),
]


@pytest.mark.parametrize(("text", "ok"), FIGURES)
def test_figures_hold_to_their_printed_digits(text: str, ok: bool) -> None:
    assert Checker(Mechanism.loads(FALL)).check(text).ok is ok


def test_a_figure_that_is_off_is_printed_anew() -> None:
    verdict = Checker(Mechanism.loads(FALL)).check("at lands: t = 0.628 s")
    assert [mend.edits for mend in verdict.mends] == [(("figure", "0.628", "0.639"),)]
    assert "last digit" not in verdict.reason
    assert "last digit" in Checker(Mechanism.loads(FALL)).check("at lands: t = 0.638 s").reason


ALIKE = [
    ("same at lands for m = 1, 2, 5: t", Kind.TRUE),
    ("same at lands for h = 1, 2: t", Kind.WRONG),
    ("same at lands for h = 1, 2, 7: ydot^2/h", Kind.TRUE),  # 2 g
]


@pytest.mark.parametrize(("text", "kind"), ALIKE)
def test_runs_are_compared(text: str, kind: Kind) -> None:
    assert Checker(Mechanism.loads(FALL)).check(text).kind is kind


def test_another_run_leaves_the_model_as_it_was() -> None:
    checker = Checker(Mechanism.loads(FALL))
    checker.check("same at lands for h = 1, 2: t")
    assert checker.check("at lands: t = 0.639 s").ok


GROUND = """
freebody: 1
parameters: {m: 1 kg, mu: 0.3, g: 9.81 m/s^2}
gravity: g
bodies: {box: {shape: particle, mass: m}}
ground: {lines: {floor: {through: origin, angle: 0}}}
contacts: {floor: {of: [box, ground.floor], friction: mu}}
initial: {box.x: 0, box.y: 0, rates: {box.x: 2, box.y: 0}}
"""
LOOP = """
freebody: 1
parameters: {a: 0.3 m, b: 0.8 m, m: 1 kg}
gravity: none
bodies: {crank: {shape: rod, length: a, mass: m}, rod: {shape: rod, length: b, mass: m}, block: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  P: {type: hinge, of: [crank.end, rod.start], coordinate: beta}
  Q: {type: hinge, of: [rod.end, block.centre]}
  guide: {type: slot, along: {through: ground.O, angle: 0}, point: block.centre, coordinate: x}
initial: {theta: 1, guess: {x: 0.9}}
"""
ARRANGED = [
    ("if theta = pi/4: x - sqrt(b^2 - a^2/2) = a/sqrt(2)", Kind.TRUE),  # the law of cosines
    ("if theta = pi/4: x - sqrt(b^2 - a^2/2) = a/sqrt(3)", Kind.WRONG),
    ("if thetadot = 0: xdot = 0", Kind.TRUE),
    ("if y(rod.G) = 0: cos(theta)^2 = 1", Kind.TRUE),
]


@pytest.mark.parametrize(("text", "kind"), ARRANGED)
def test_conditions_are_arranged_in_closed_loops(text: str, kind: Kind) -> None:
    verdict = Checker(Mechanism.loads(LOOP)).check(text)
    assert verdict.kind is kind, verdict


@pytest.mark.parametrize(("text", "kind"), [("xddot = -4*a*(1 + a/b)", Kind.TRUE), ("xddot = -4*a*(1 - a/b)", Kind.WRONG)])
def test_a_driven_crank_comes_to_a_place_a_turn_later(text: str, kind: Kind) -> None:
    """At the outer dead centre, θ = 0, which a crank that starts at 1 rad passes by at 2π: ẍ = −a ω² (1 + a/b) of any slider-crank."""
    verdict = Checker(Mechanism.loads(LOOP + "motions: {drive: {of: theta, is: 1 + 2*t}}")).check(f"if theta = 0: {text}")
    assert verdict.kind is kind, verdict


IMPOSSIBLE = [
    (LOOP + "motions: {drive: {of: theta, is: 1 + sin(2*t)/10}}", "if theta = pi/4: x'' = 0", "no freedom"),
    (GROUND, "if box.y = 1: floor.N = m*g", "nothing that is free"),
    (FALL, "if y = 7, at the start: m*yddot = -3*path.M/y", "at the start"),
]


@pytest.mark.parametrize(("model", "text", "why"), IMPOSSIBLE)
def test_a_condition_that_cannot_be_arranged_is_not_decidable(model: str, text: str, why: str) -> None:
    verdict = Checker(Mechanism.loads(model), seconds=1).check(text)
    assert verdict.kind is Kind.UNDECIDABLE
    assert why in verdict.reason


def test_a_model_that_does_not_start_is_not_decidable() -> None:
    verdict = Checker(Mechanism.loads(LOOP.replace("guess: {x: 0.9}", "x: 0.9"))).check("x'' = 0")
    assert verdict.kind is Kind.UNDECIDABLE
    assert "do not fit together" in verdict.reason


@pytest.mark.parametrize("condition", ["box.y = 0", "box.x = 1"])
def test_a_condition_that_holds_anyway_or_is_arranged_may_be_said(condition: str) -> None:
    assert Checker(Mechanism.loads(GROUND)).check(f"if {condition}: floor.N = m*g").ok


@pytest.mark.parametrize("text", ["if : theta = 0", "only if : theta = 0", "limit: theta = 0 as "])
def test_an_empty_hypothesis_is_none(text: str) -> None:
    with pytest.raises(StatementError, match="hypothesis is empty"):
        checker("pendulum on a cart").check(text)


OWN = [
    ("m1 g - T1 = -m1 y1''; T1 = m2 y2'' + m2 g", "T1 is what the first line makes it", Kind.TRUE),
    ("m1 g + T1 = -m1 y1''; T1 - m2 g = m2 y2''", "a tension that pushes on one side", Kind.WRONG),
    ("m1 g - 2 T1 = -m1 y1''; T1 - m2 g = m2 y2''", "twice the tension", Kind.WRONG),
]
_WEIGHTS = """
freebody: 1
parameters: {m1: 2 kg, m2: 3 kg, g: 9.81 m/s^2}
gravity: g
ground: {lines: {up: {through: O, angle: 90 deg}}}
bodies: {left: {shape: particle, mass: m1}, right: {shape: particle, mass: m2}}
joints:
  a: {type: slot, along: ground.up, point: left.centre, coordinate: y1}
  b: {type: slot, along: ground.up, point: right.centre, coordinate: y2}
  cord: {type: coupling, zero: y1 + y2}
initial: {y1: 0, at_rest: true}
"""


@pytest.mark.parametrize(("text", "what", "kind"), OWN)
def test_an_unknown_of_the_writers_own_is_eliminated(text: str, what: str, kind: Kind) -> None:
    assert Mechanism.loads(_WEIGHTS).check(text).kind is kind, what


def test_a_slip_of_the_pen_is_no_unknown() -> None:
    model = _WEIGHTS.replace("m1: 2 kg", "mass: 2 kg").replace("mass: m1", "mass: mass")
    with pytest.raises(StatementError, match="maas"):
        Mechanism.loads(model).check("maas g = 2 y1''; maas y1'' = y2''")


def test_what_is_said_to_be_constant_is_corrected():
    """An energy with a kinetic part forgotten, the wrong sign of a potential, and twice the energy of a spring."""
    checker = Checker(
        Mechanism.loads("""
freebody: 1
parameters: {m: 3 kg, I: 0.05 kg*m^2, r: 0.15 m, k: 200 N/m, g: 9.81 m/s^2}
gravity: g
ground: {lines: {down: {through: O, angle: -90 deg}}}
bodies: {weight: {shape: particle, mass: m}, pulley: {mass: 0, inertia: I}}
joints:
  way: {type: slot, point: weight.centre, along: ground.down, coordinate: x}
  axle: {type: hinge, of: [ground.O, pulley.origin], coordinate: {name: phi, sense: clockwise}}
  rope: {type: coupling, zero: x - r*phi}
forces: {spring: {type: spring, along: x, stiffness: k}}
initial: {phi: 0, at_rest: true}
""")
    )
    kinetic, lost = "1/2 m x'^2 + 1/2 I phi'^2", []
    for said in ("1/2 m x'^2 + 1/2 k x^2 - m g x", f"{kinetic} + 1/2 k x^2 + m g x", f"{kinetic} + k x^2 - m g x"):
        (mend,) = checker.check(f"constant: {said}").mends
        assert checker.check(mend.equation).ok, mend.equation
        lost.append(mend.edits[0][2])
    assert lost == ["I*phidot^2/2", "-m*g*x", "k*x^2/2"]


def test_what_is_constant_by_parameters_alone_says_so():
    """T is a couple here, and no kinetic energy."""
    verdict = checker("bead on a turning rod").check("constant: 2 T")
    assert verdict.ok and any("parameters alone" in note for note in verdict.notes)
    assert not checker("double pendulum").check("constant: energy()").notes

"""Symbolic answers against closed forms of textbooks, and against numbers at other states."""

import numpy as np
import pytest
from models import atwood, sliding_rod, spring_pendulum, system, tree
from typer.testing import CliRunner

import freebody as fb
from freebody.catalogue import model_file
from freebody.cli import app
from freebody.equations import Num, Sym, evaluate, symbols, to_sympy
from freebody.equations.answers import Answers, solve_in_letters
from freebody.equations.solve import TooLarge
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal

# Each with where the closed form stands: Meriam & Kraige, Dynamics (Atwood, sliding rod); the wedge and the cart from elimination by hand.
CLOSED = {
    "Atwood": (atwood, {"x1": "g*(m1 - m2)/(m1 + m2)", "cord": "-2*m1*m2*g/(m1 + m2)"}, "g m1 m2", {}),
    "rod on wall and floor": (
        sliding_rod,
        {"theta": "3*g*cos(theta)/(2*l)", "floor.Fn": "m*g*(1 + 3*sin(theta)**2)/4", "wall.Fn": "3*m*g*sin(theta)*cos(theta)/4"},
        "g m l theta",
        {"at_rest": True},
    ),
    "block on movable wedge": (
        lambda: system("EX-BLOCK"),
        {"x": "m2*g*sin(tip)*cos(tip)/(m1 + m2*sin(tip)**2)", "y": "(m1 + m2)*g*sin(tip)/(m1 + m2*sin(tip)**2)"},
        "g m1 m2 tip",
        {"at_rest": True},
    ),
    "cart and pendulum": (
        lambda: system("19.3.17"),
        {
            "theta": "-(mc + mp)*g*sin(theta)/(l*(mc + mp*sin(theta)**2))",
            "rod.tension": "mc*mp*g*cos(theta)/(mc + mp*sin(theta)**2)",
        },
        "g mc mp l theta",
        {"at_rest": True},
    ),
    "cart and pendulum at 45°, equal masses": (
        lambda: system("19.3.17"),
        {"x": "g/3"},
        "g",
        {"at_rest": True, "set": {"theta": "45 deg", "mp": "mc"}},
    ),
    "double pendulum, level": (
        lambda: system("19.3.28"),
        {"phi1": "-9*g/(7*l)", "phi2": "3*g/(7*l)"},
        "g l",
        {"at_rest": True, "set": {"phi1": "90 deg", "phi2": "90 deg"}},
    ),
    "two blocks and a cable": (
        lambda: system("19.3.21"),
        {"x1": "g*(m1*sin(alpha1) - m2*sin(alpha2))/(m1 + m2)", "cable.tension": "m1*m2*g*(sin(alpha1) + sin(alpha2))/(m1 + m2)"},
        "g m1 m2 alpha1 alpha2",
        {"at_rest": True},
    ),
    "new gun": (lambda: system("S19.17"), {"theta": "3*T/(m1*l**2 + 3*m2*R**2)"}, "T m1 m2 l R", {"at_rest": True}),
}


@pytest.mark.parametrize("name", CLOSED)
def test_closed_forms(name: str) -> None:
    make, wanted, letters, options = CLOSED[name]
    answers = solve_in_letters(make(), list(wanted), **options)
    assert answers.checked >= 2
    for what, text in wanted.items():
        assert equal(answers[what], tree(text, letters)), f"{what}: {to_sympy(answers[what])}"


def test_limits() -> None:
    answers = atwood().solve_in_letters(["x1", "cord"], limits={"m1": "inf", "m2": 0})
    assert answers.limits["x1", "m1"] == Sym("g")
    assert equal(answers.limits["cord", "m1"], tree("-2*m2*g", "m2 g"))
    assert evaluate(answers.limits["cord", "m2"], {}) == 0
    assert "∞" in str(answers)


def test_what_is_too_long_is_refused() -> None:
    """Where lengths are asked to stay symbols, there is no shorter way."""
    letters = ("l1", "l2", "l3", "d", "side", "beta", "phi")
    with pytest.raises(TooLarge, match="ask for numbers"):
        system("S19.21").solve_in_letters(["theta"], at_rest=True, set={"theta": 1.1}, limits=dict.fromkeys(letters, 0))


def test_what_is_driven_follows_from_its_motion() -> None:
    """The support has the acceleration that is prescribed, and the pendulum on it feels it."""
    answers = system("19.3.18").solve_in_letters(["xA", "theta"])
    assert answers["xA"] == Sym("aA")
    assert Sym("aA") in symbols(answers["theta"]) or Sym("xA", 2) in symbols(answers["theta"])
    with pytest.raises(ValueError, match="not at rest"):
        system("GEN-FOURBAR").solve_in_letters(["beta"], at_rest=True)


def test_what_is_not_unknown_is_named() -> None:
    with pytest.raises(KeyError, match=r"floor\.Fn"):
        sliding_rod().solve_in_letters(["floor.Fq"])
    with pytest.raises(ValueError, match="cannot be set"):
        sliding_rod().solve_in_letters(["theta"], set={"nothing": 1})


def test_a_spring_and_gravity() -> None:
    answers = solve_in_letters(spring_pendulum(), ["theta"])
    assert equal(answers["theta"], tree("(m*g*l*sin(theta) - k*theta)/(m*l**2)", "m g l k theta"))


def bars(lengths: tuple[float, float, float, float], theta: float, beta: float, phi: float) -> tuple[np.ndarray, np.ndarray]:
    """Of a four-bar of rods, by θ̇: the rates of its three angles, and the squared speeds of mass centres and spins together, a mass."""
    l1, l2, l3, _ = lengths
    across = [np.array([-np.sin(a), np.cos(a)]) for a in (theta, beta, phi)]
    b, f = np.linalg.solve(np.array([l2 * across[1], -l3 * across[2]]).T, -l1 * across[0])
    speed = (l1 * across[0] / 2, l1 * across[0] + b * l2 * across[1] / 2, f * l3 * across[2] / 2)
    inertia = [v @ v + (length * w) ** 2 / 12 for v, length, w in zip(speed, (l1, l2, l3), (1, b, f), strict=True)]
    return np.array([1, b, f]), np.array(inertia)


def value(answers: Answers, name: str, at: dict[Sym, float]) -> float:
    """An answer where symbols have values, its named ones by those before."""
    known = dict(at)
    for symbol, meant in answers.named.items():
        known[symbol] = float(evaluate(meant, known))
    return float(evaluate(answers[name], known))


def letters(**values: float) -> dict[Sym, float]:
    return {Sym(name): value for name, value in values.items()}


def test_a_four_bar_in_all_its_symbols() -> None:
    """From rest T = Σ mᵢ (v² + ρ² ω²) θ̈ by power, v and ω for a unit θ̇, whatever the lengths and angles."""
    answers = system("S19.21").solve_in_letters(["theta", "phi"], at_rest=True)
    lengths, angles = (0.5, 0.61, 0.93, 0.0), (0.7, 1.9, 2.4)
    rates, inertia = bars(lengths, *angles)
    at = letters(m1=2.3, m2=0.4, m3=5.1, T=7.0, l1=0.5, l2=0.61, l3=0.93, theta=0.7, beta=1.9, phi=2.4)
    expected = 7.0 / (inertia @ [2.3, 0.4, 5.1])
    assert value(answers, "theta", at) == pytest.approx(expected, rel=1e-9)
    assert value(answers, "phi", at) == pytest.approx(expected * rates[2], rel=1e-9)
    assert "J θ̈ = T" in str(answers) and answers.checked > 1


def test_a_slider_crank_in_all_its_symbols() -> None:
    """Released from rest: its weights do work at r/2 cos θ, r/2 cos θ and none; the rod's centre is the mean of its ends."""
    answers = system("GEN-SLIDER").solve_in_letters(["theta"], at_rest=True)
    r, l, theta, beta = 0.13, 0.31, 0.9, -0.4
    b = -r * np.cos(theta) / (l * np.cos(beta))
    x = -r * np.sin(theta) - l * np.sin(beta) * b
    crank = r**2 / 3
    rod = ((x - r * np.sin(theta)) ** 2 + (r * np.cos(theta)) ** 2) / 4 + (l * b) ** 2 / 12
    at = letters(m1=0.7, m2=3.0, m3=1.1, g=9.0, r=r, l=l, theta=theta, beta=beta)
    expected = -9.0 * r / 2 * np.cos(theta) * (0.7 + 3.0) / (0.7 * crank + 3.0 * rod + 1.1 * x**2)
    assert value(answers, "theta", at) == pytest.approx(expected, rel=1e-9)


@pytest.mark.long
def test_reactions_of_a_loop_by_its_accelerations() -> None:
    """The pin of a moving four-bar: its force is written by θ̈, β̈, φ̈, and these by ratios, at a state of the program's own."""
    mechanism = system("S19.21")
    answers = mechanism.solve_in_letters(["theta", "D.Fx"])
    subject = SymbolicState(mechanism.source(), mechanism.start()[0])
    assert symbols(answers["D.Fx"]) & {Sym("theta", 2), Sym("phi", 2)}
    known = {x: v for x, v in subject.values.items() if x.dots < 2 and x.name != "D.Fx"}
    assert value(answers, "D.Fx", known) == pytest.approx(subject.values[Sym("D.Fx")], rel=1e-9)


@pytest.mark.long
def test_where_nothing_else_is_short_masses_are_numbers_too() -> None:
    """Seven links: what is left symbolically is g, once the motors hold the posture of the start."""
    answers = system("GEN-STEP").solve_in_letters(["ankle"], at_rest=True)
    assert symbols(answers["ankle"]) == {Sym("g")} and "would fill pages" in str(answers) and answers.checked > 1


@pytest.mark.long
def test_what_defines_a_length_stands_for_it() -> None:
    """The height of a wedge's polygon is w tan α/3: answers hold α. One that is set stays a symbol, and so does a mass."""
    answers = system("S19.15").solve_in_letters(["x"])
    assert Sym("alpha") in symbols(answers["x"]) and not symbols(answers["x"]) & {Sym("h"), Sym("w")}
    assert Sym("h") in symbols(system("S19.15").solve_in_letters(["x"], limits={"h": 1})["x"])


def test_a_dead_point_is_answered_where_it_stands() -> None:
    """With its masses in line and its lengths whatever they are nothing moves it."""
    answers = fb.load(model_file("GEN-SLIDER/dead_point")).solve_in_letters()
    assert all(tree == Num(0) for tree in answers.values.values())


def test_what_is_asked_for_in_a_limit_stays_a_symbol() -> None:
    """A four-bar of which two bars have no mass is a rod on a pin: θ̈ = 3 T/(m₁ l₁²)."""
    mechanism = system("S19.21")
    answers = mechanism.solve_in_letters(["theta"], at_rest=True, set={"m2": 0}, limits={"m3": 0})
    assert evaluate(answers.limits["theta", "m3"], {Sym("T"): 1.0, Sym("m1"): 1.0}) == pytest.approx(3 / 0.3**2, rel=1e-9)


# A parameter to 0 or ∞, and what is then left, each a case that a book treats by itself.
LIMITS = {
    "a wedge that cannot move": ("m1", "inf", {"x": "0", "y": "g*sin(tip)"}),
    "a wedge without mass: the block falls": ("m1", 0, {"x": "g*cos(tip)/sin(tip)", "y": "g/sin(tip)"}),
    "a heavy block": ("m2", "inf", {"x": "g*cos(tip)/sin(tip)"}),
}


@pytest.mark.parametrize("name", LIMITS)
def test_limits_of_a_block_on_a_wedge(name: str) -> None:
    symbol, to, expected = LIMITS[name]
    answers = system("EX-BLOCK").solve_in_letters(list(expected), at_rest=True, limits={symbol: to})
    for what, text in expected.items():
        assert equal(answers.limits[what, symbol], tree(text, "g tip")), what


def test_limits_of_atwood() -> None:
    """Free fall without a second mass, upward with g beside one beyond measure; no tension, and twice a weight."""
    found = atwood().solve_in_letters(["x1", "cord"], limits={"m2": "inf", "m1": 0})
    assert equal(found.limits["x1", "m2"], tree("-g", "g")) and equal(found.limits["x1", "m1"], tree("-g", "g"))
    assert equal(found.limits["cord", "m2"], tree("-2*m1*g", "m1 g")) and evaluate(found.limits["cord", "m1"], {}) == 0
    assert evaluate(atwood().solve_in_letters(["x1"], set={"m2": "m1"})["x1"], {}) == 0


def test_the_command_solves_in_letters() -> None:
    model = str(model_file("19.3.17/model"))
    asked = ["--form", "solved", "--for", "x,rod.tension", "--at-rest", "--set", "theta=45 deg", "--limit", "mc=inf"]
    done = CliRunner().invoke(app, ["equations", model, *asked])
    assert done.exit_code == 0 and "mp g/(2 mc + mp)" in done.output and "mc → ∞" in done.output

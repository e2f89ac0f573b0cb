"""Answers in letters against closed forms of textbooks, and against numbers at other states."""

import pytest
from models import atwood, sliding_rod, spring_pendulum, system

from freebody.equations import Sym, evaluate, from_sympy, symbols, to_sympy
from freebody.equations.answers import solve_in_letters
from freebody.equations.simplify import equal
from freebody.equations.solve import TooLarge


def tree(text: str, names: str) -> object:
    """An expression written with SymPy's words."""
    import sympy

    return from_sympy(sympy.sympify(text, locals={name: sympy.Symbol(name) for name in names.split()}))


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
    with pytest.raises(TooLarge, match="ask for numbers"):
        system("S19.21").solve_in_letters(["theta"], at_rest=True)


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

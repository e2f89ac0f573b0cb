"""Quantities, units inside expressions, and the algebra of dimensions."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from freebody import Mechanism
from freebody.model import syntax, units
from freebody.model.errors import ModelProblem
from freebody.symbolic.dimensions import Dimension

TABLE = {
    "400 mm": (0.4, "m"),
    "2 ft": (0.6096, "m"),
    "1 in": (0.0254, "m"),
    "10 lbm": (4.5359237, "kg"),
    "1 N*m": (1.0, "N*m"),
    "5 N m": (5.0, "N*m"),
    "9.81 m/s^2": (9.81, "m/s^2"),
    "-3 kg*m^2/s": (-3.0, "N*m*s"),
    "1e-3 N/(m/s)": (1e-3, "N*s/m"),
    "2 kN/mm": (2e6, "N/m"),
    "30 deg": (math.radians(30), "rad"),
    "30°": (math.radians(30), "rad"),
    "0.5 rev": (math.pi, "rad"),
    "60 rpm": (2 * math.pi, "rad/s"),
    "3 rad/s^2": (3.0, "rad/s^2"),
    "5 cm²": (5e-4, "m^2"),
    "1 lbf": (4.4482216152605, "N"),
    "250 ms": (0.25, "s"),
    "36 kph": (10.0, "m/s"),
    "1 hp": (745.6998715822702, "W"),
}


@pytest.mark.parametrize("text", TABLE)
def test_quantities(text):
    value, unit = TABLE[text]
    found = units.quantity(text)
    assert found.value == pytest.approx(value, rel=1e-15)
    assert found.dimension.unit() == unit


@pytest.mark.parametrize("degrees", [1, 20, 30, 45, 60, 90, -120, 180, 360])
def test_degrees_are_those_of_python_to_the_bit(degrees):
    assert units.quantity(f"{degrees} deg").value == math.radians(degrees)


@pytest.mark.parametrize("text", ["2*l", "3 m/k", "0.1 m - x", "m2/3", "l", "1e6", "2 and x", "-5", "3 m + 2 m"])
def test_no_quantities(text):
    assert units.quantity(text) is None


@pytest.mark.parametrize("text", ["3 fot", "2 kelvin", "1 V", "5 degC", "2 c"])
def test_what_is_no_unit_of_mechanics(text):
    with pytest.raises(ModelProblem, match="no unit"):
        units.quantity(text)


REWRITTEN = {
    "2*l*sin(90 deg)": "2*l*sin(1.5707963267948966)",
    "0.1 m - (M + m)*g/k": "0.1 - (M + m)*g/k",
    "if(t < 250 ms and x > 2 cm, 1, 0)": "if(t < 0.25 and x > 0.02, 1, 0)",
    "x/(2 mm)": "x/(0.002)",
    "'crank drive'.force - 3 kN": "'crank drive'.force - 3000.0",
    "link[3].x + 2ft": "link[3].x + 0.6096",
}


@pytest.mark.parametrize("text", REWRITTEN)
def test_units_inside_expressions(text):
    assert units.rewrite(text).text == REWRITTEN[text]


@pytest.mark.parametrize("text", ["x/2 m", "1/3 ft", "x^2 m"])
def test_units_that_could_belong_to_two_things(text):
    with pytest.raises(ModelProblem, match="two ways"):
        units.rewrite(text)


KNOWN = {"l": "m", "m": "kg", "k": "N/m", "T": "N*m", "theta": "rad", "w": "rad/s", "v": "m/s", "a": "m^2"}


def measured(text: str) -> Dimension | None:
    expression = syntax.parse(text)
    return syntax.Measure(expression, lambda name: units.unit(KNOWN[name]).dimension if name in KNOWN else None).of(
        expression.tree
    )


MEASURED = {
    "m/3": "kg",
    "k*l": "N",
    "sqrt(k/m)": "1/s",
    "sqrt(a)": "m",
    "l^2": "m^2",
    "a^0.5": "m",
    "m*l^2/12": "kg*m^2",
    "T*sin(theta)/l": "N",
    "theta + 1": "rad",
    "theta - w*(2 s)": "rad",
    "max(l, 2 ft)": "m",
    "hypot(l, 3)": "m",
    "if(l < 3 m, k, 2)": "N/m",
    "abs(-l)": "m",
    "atan2(l, 3)": "rad",
    "speed(P)": "m/s",
    "rate(l)": "m/s",
    "-v": "m/s",
    "clamp(T, -2, 2)": "N*m",
    "(l/(1 m))^2 * (3 N)": "N",
}


@pytest.mark.parametrize("text", MEASURED)
def test_dimensions(text):
    found = measured(text)
    assert found is not None
    assert found.fits(units.unit(MEASURED[text].replace("1/s", "Hz")).dimension)


@pytest.mark.parametrize("text", ["2*l", "9.81*m", "u", "u*l", "3", "pi", "0", "2^3", "l*1.5"])
def test_bare_numbers_and_parameters_fit_anywhere(text):
    assert measured(text) is None


@pytest.mark.parametrize(
    "text", ["l + m", "l < m", "sin(l)", "exp(T)", "l^m", "l^u", "min(l, T)", "if(1 < 2, l, m)", "l - 3 kg", "2 m + 1 kg"]
)
def test_what_does_not_fit(text):
    with pytest.raises(ModelProblem):
        measured(text)


@given(st.tuples(*[st.integers(-3, 3)] * 3))
def test_the_unit_of_a_dimension_reads_back(powers):
    dimension = Dimension(*powers)
    assert units.unit(_readable(dimension)).dimension.fits(dimension)


def _readable(dimension: Dimension) -> str:
    """Units of pure reciprocals are shown as ``1/s``, which is for reading only."""
    text = dimension.unit()
    if not text.startswith("1/"):
        return text
    return "rad/" + text[2:]


@given(st.floats(-1e12, 1e12, allow_nan=False))
def test_a_coherent_unit_changes_no_bit(value):
    assert units.quantity(f"{value!r} N*m").value == value


def test_evaluation():
    values = {"a": 2.0, "b": 3.0}
    for text, wanted in {
        "a^b - -1": 9,
        "min(a, b)*10": 20,
        "if(a > b or not a == 3, 1, 2)": 1,
        "2^-1": 0.5,
        "-a^2": -4,
        "sign(-3)": -1,
    }.items():
        assert syntax.evaluate(syntax.parse(text).tree, values.__getitem__) == wanted


def test_the_units_of_every_day_are_those_of_the_registry():
    for word in units._EVERYDAY:
        assert units.word(word) == units.registered(word), word


TURNED = """
freebody: 1
parameters: {l: 1 m, a: ANGLE, b: a, n: 8}
ground: {points: {Q: [n*l, 1]}, lines: {slope: {through: O, angle: LINE}}}
bodies: {rod: {shape: rod, length: l, mass: 2 kg, points: {P: [l*cos(COSINE), 0]}}}
joints: {pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
initial: {theta: THETA}
"""


@pytest.mark.parametrize("place", ["LINE", "COSINE", "THETA"])
@pytest.mark.parametrize(("stated", "is_asked"), [("30", True), ("30 deg", False), ("pi/6", False), ("5", False)])
@pytest.mark.parametrize("by", ["itself", "a", "b", "-a"])
def test_a_bare_number_of_more_than_a_turn_that_stands_for_an_angle_is_asked_about(place, stated, is_asked, by):
    """Wherever an angle may stand, also by way of a parameter; a number of another use is not."""
    text = TURNED.replace(place, stated if by == "itself" else by).replace("ANGLE", stated)
    for other in ("LINE", "COSINE", "THETA"):
        text = text.replace(other, "0.1")
    _, notes = Mechanism.loads(text).start()
    assert len(notes) == is_asked and all("30 rad is 4.77 turns; for degrees write `30 deg`" in note for note in notes)


def test_a_change_of_a_parameter_that_stands_for_an_angle_is_asked_about():
    model = Mechanism.loads(TURNED.replace("THETA", "a").replace("ANGLE", "80").replace("LINE", "0").replace("COSINE", "0"))
    assert "a = 80 rad" in model.start()[1][0] and "a = 45 rad" in model.start(a=45)[1][0] and model.start(a="45 deg")[1] == []

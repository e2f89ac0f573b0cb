"""What symbols mean: rates, vectors, phrases; seen by mechanics that holds for them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import freebody as fb
from freebody.check.language.dimensions import check_dimensions
from freebody.check.language.parser import parse
from freebody.check.language.statements import inlined
from freebody.check.residual import equation_sides
from freebody.check.symbols import Symbols, declarations
from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError


class States:
    """The model at its start and with other rates."""

    def __init__(self, model: fb.Mechanism) -> None:
        self.core = model.compile()
        start, _ = model.start()
        self.states = [replace(start, u=factor * start.u) for factor in (1.0, -0.7)]

    def values(self, texts):
        rows = np.array([self.core.evaluate(texts, state) for state in self.states])
        return {text: rows[:, i] for i, text in enumerate(texts)}

    def masses(self):
        found = [self.core.free_bodies(state).bodies for state in self.states]
        return {n: tuple(np.array([[getattr(b[n], w) for b in found] for w in ("mass", "inertia")])) for n in found[0]}


@pytest.fixture(scope="module")
def model():
    m = fb.Mechanism("pendulum on a cart", gravity="9.81 m/s^2")
    length, mass, _ = m.parameter("l", "0.5 m"), m.parameter("m", "1 kg"), m.parameter("M", "2 kg")
    m.parameter("alpha", "20 deg")
    cart = m.rectangle("cart", width="0.4 m", height="0.2 m", mass="M")
    rod = m.rod("rod", length=length, mass=mass)
    m.slider(name="track", along={"through": m.ground.O, "angle": 0}, line={"through": cart.G, "angle": 0}, coordinate="s")
    m.hinge(cart.G, rod.start, name="pivot", coordinate="theta")
    m.initial(theta="30 deg", rates={"theta": 2, "s": 1})
    return m


DECLARED = {
    "ψ": "θ - alpha",
    "i'": "[cos(ψ), sin(ψ)]",
    "r_G/P": "position of rod.G from cart.G",
    "v_G": "velocity of rod.G",
    "a_G": "acceleration of rod.G",
    "a_G/P": "acceleration of rod.G relative to cart.G",
    "ω": "rate(theta)",
    "p": "M*rate(s)/m - vx(rod.G)",
    "z": "l*theta/rate(s)",
    "R_P": "force of pivot on rod",
    "R_C": "force of pivot on cart",
    "H/P": "angular momentum of rod about cart.G",
    "ΣM/P": "moment on rod about cart.G",
    "H": "angular momentum of all about ground.O",
    "ΣF": "force on all",
    "λ": "direction from rod.start to rod.end",
    "n": "normal from rod.start to rod.end",
    "h": "0.3 m",
}

TRUE = [
    "ψ̇ = θ̇",
    "d²ψ/dt² = θ̈",
    "i'·i = cos(θ − α)",
    "λ = cosθ i + sinθ j",
    "n = k × λ",
    "dλ/dt = θ̇ n",
    "d²λ/dt² = θ̈ n − θ̇² λ",
    "ṙ_G/P = θ̇ k × r_G/P",
    "r̈_G/P = a_G/P",
    "v̇_G = a_G",
    "ω̇ = θ̈",
    "ṗ = M s̈/m − a_G·i",
    "ż = l θ̇/ṡ − l θ s̈/ṡ²",
    "l̇ = 0",
    "h = 300 mm",
    "R_P = −R_C",
    "R_P·i = pivot_x",
    "R_P·j = pivot.Fy",
    "m a_G = R_P − m g j",
    "ΣM/P = r_G/P × (−m g j)",
    "Ḣ/P = ΣM/P",
    "Ḣ/P = r_G/P × m a_G + (m l²/12) θ̈ k",
    "H/P = r_G/P × m v_G + (m l²/12) θ̇ k",
    "H = (l/2 λ + s i) × m v_G + (m l²/12) θ̇ k",
    "ΣF · i = 0",
    "ΣF · j = track_y − (m + M) g",
    "m ax(rod.G) = pivot.Fx",
    "m ay( rod.G ) = pivot.Fy − m g",
    "accel(s) = s̈",
    "kinetic(rod) = ½ m v_G·v_G + (m l²/24) θ̇²",
    "angular_momentum(ground.O) = H·k",
    "x (l + rate(s) h/ṡ) = x (l + h), x = 3",
    "(l/3) θ̈ − s̈ sin θ/2 + (g/2) cos θ = 0",
    r"(M+m)\ddot{s} = \frac{m l}{2}\left(\ddot\theta\sin\theta + \dot\theta^2\cos\theta\right)",
]


@pytest.mark.parametrize("text", TRUE)
def test_what_holds_by_mechanics(model, text):
    letters = Symbols(model, DECLARED)
    program = letters.read(text)
    check_dimensions(program, letters.dimensions)
    (line,) = inlined(program)
    both = equation_sides(line, letters.values(letters.require(program), States(model)))
    assert both.residual == pytest.approx(np.zeros_like(both.residual), abs=1e-11)
    assert np.abs(both.left).max() > 1e-3 or text in ("l̇ = 0", "ΣF · i = 0", "(l/3) θ̈ − s̈ sin θ/2 + (g/2) cos θ = 0")


def test_symbols_of_the_model_by_kind(model):
    letters = Symbols(model, DECLARED)
    assert letters.of_kind("parameter") == ["l", "m", "M", "alpha"]
    assert letters.of_kind("coordinate") == ["s", "theta"]
    assert {"i", "j", "k", "λ", "r_G/P", "H/P", "ΣF"} <= {name for name, meaning in letters.meanings.items() if meaning.is_vector}
    assert letters.dimensions["R_P"].unit() == "N"
    assert letters.dimensions["ω"].unit() == "rad/s"


def test_a_symbol_of_the_model_goes_before_gravity_and_directions():
    m = fb.Mechanism("a particle", gravity="9.81 m/s^2")
    m.parameter("g", "3 N")
    m.parameter("k", "2 N/m")
    m.slot(point=m.particle("P", mass="1 kg").centre, along={"through": m.ground.O, "angle": 0}, coordinate="x", name="guide")
    letters = Symbols(m)
    assert [letters.dimensions[n].unit() for n in "gk"] == ["N", "N/m"]
    assert letters.meanings["i"].texts == ("1", "0", "0")


def test_without_gravity_there_is_no_g():
    m = fb.Mechanism("a particle", gravity="none")
    m.slot(point=m.particle("P", mass="1 kg").centre, along={"through": m.ground.O, "angle": 0}, coordinate="x", name="guide")
    assert "g" not in Symbols(m).names


def test_an_unknown_symbol_is_said_with_its_place_and_a_near_one(model):
    letters = Symbols(model)
    with pytest.raises(StatementError) as error:
        letters.require(parse("m s̈ = m thetta", letters.names))
    assert str(error.value) == (
        "the symbol `thetta` has no meaning in this model\n    m s̈ = m thetta\n            ^^^^^^\n"
        "  did you mean `theta`? Otherwise declare it, like `thetta: …`, on the command line by `--where 'thetta=…'`"
    )


def test_a_fourth_derivative_is_not_known(model):
    letters = Symbols(model)
    assert letters.require(parse("diff(theta, t, 3) = 0", letters.names))
    with pytest.raises(StatementError, match="order 4"):
        letters.require(parse("diff(theta, t, 4) = 0", letters.names))


WRONG = [
    ("phi", "thetaa - alpha", "symbol `phi`: nothing is called `thetaa`"),
    ("r", "position of rod.X", "`rod` has no point `X`"),
    ("R", "force of pivott on rod", "there is no joint `pivott`"),
    ("R", "force of pivot on ground", "`pivot` does not touch `ground`"),
    ("H", "angular momentum of rodd about ground.O", "there is no body `rodd`"),
    ("r", "[l, theta, 1, 2]", "two components"),
    ("r", "[l, m]", "a mass"),
    ("x", "l + m", "cannot be added"),
]


@pytest.mark.parametrize(("name", "said", "what"), WRONG)
def test_declarations_that_mean_nothing(model, name, said, what):
    with pytest.raises(ModelProblem) as error:
        Symbols(model, {name: said})
    assert what in f"{error.value.what} {error.value.hint}"


def test_declarations_in_lines():
    assert declarations(["phi = theta - alpha", "r_G/O: position of rod.G"]) == {
        "phi": "theta - alpha",
        "r_G/O": "position of rod.G",
    }
    with pytest.raises(ModelProblem, match="declares no symbol"):
        declarations(["phi"])


_CART = """
freebody: 1
parameters: {{m: 2 kg, k: 8 N/m, {name}: 3 rad/s}}
bodies: {{cart: {{shape: particle, mass: m}}}}
joints: {{rail: {{type: slot, along: {{through: ground.O, angle: 0}}, point: cart.centre, coordinate: x}}}}
forces: {{spring: {{type: spring, along: x, stiffness: k}}}}
initial: {{x: 0.3 m, rates: {{x: "{name}*0.1 m"}}}}
"""


@pytest.mark.parametrize(("name", "own"), [("omega", "ω"), ("Omega", "Ω"), ("m_1", "m₁"), ("w1", "w_1"), ("epsilon", "eps")])
def test_own_letters_go_before_names_of_the_model_that_read_alike(name, own):
    checker = fb.check.Checker(fb.Mechanism.loads(_CART.format(name=name)), {own: "sqrt(k/m)", "T": f"2 pi/{own}"})
    verdict = checker.check(f"x'' = −{own}² x", correcting=False)
    assert verdict.kind is fb.check.Kind.TRUE
    assert verdict.notes == (f"Here {own} is what is declared, not the parameter {name} of the model.",)
    assert checker.check(f"T {name} = 2 pi", correcting=False).ok
    assert not checker.check(f"{own} = 3", correcting=False).ok


@pytest.mark.parametrize(("name", "quoted"), [("knee[2]", "knee[2]"), ("left knee", "'left knee'")])
def test_a_letter_for_a_force_is_that_force_however_its_joint_is_called(name, quoted):
    """No correction says of a letter only that it is what it stands for."""
    m = fb.Mechanism("two rods")
    a, b = (m.rod(each, length=1.0, mass=1.0) for each in "ab")
    m.hinge(m.ground.O, a.start, name="hip", coordinate="p")
    m.hinge(a.end, b.start, name=name, coordinate="q")
    m.initial(p=0.3, q=0.5, rates={"p": 1.0, "q": 0.0})
    assert not any(quoted in str(mend) for mend in m.check("F = 0", {"F": f"{quoted}.Fx"}).mends)


def test_a_letter_for_a_gauge_has_its_dimension() -> None:
    model = fb.Mechanism.loads("""
freebody: 1
bodies: {puck: {shape: particle, mass: 1 kg}}
joints: {table: {type: free, of: [ground.O, puck.centre], coordinates: [x, y]}}
gauges: {r: "distance(ground.O, puck.centre)"}
initial: {x: 1 m, y: 1 m}
""")
    known = Symbols(model, {"ρ": "r", "A": "r^2"}).dimensions
    assert known["ρ"] == known["x"]
    assert known["A"] == known["x"].times(known["x"], 1)

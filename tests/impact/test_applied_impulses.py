"""A model at rest that is struck: closed forms of textbooks, and theorems on impulses."""

from dataclasses import replace

import numpy as np
import pytest
import sympy
from store import but_long

import freebody as fb
from freebody.catalogue import model_file
from freebody.core import State
from freebody.equations import Sym, evaluate, from_sympy
from freebody.equations.solve import TooLarge
from freebody.equations.topics import NotHere, topic
from freebody.equations.topics.impact_equations import Impact, Rows, after
from freebody.equations.topics.impulse_momentum import jumps
from freebody.impact.applied_impulse import strike
from freebody.symbolic.algebra import equal

BAT = """
parameters: {m: 2 kg, l: 1.2 m, b: 0.8 m}
bodies: {bat: {shape: rod, length: l, mass: m, points: {P: ["b - l/2", 0]}}}
joints: {pin: {type: hinge, of: [ground.O, bat.start], coordinate: {name: theta, zero: down}}}
initial: {theta: 0, at_rest: true}
"""
"""A rod that hangs on a pin, with a point b below it."""
RODS = """
gravity: none
parameters: {m: 3 kg, l: 0.7 m}
bodies: {one: {shape: rod, length: l, mass: m}, two: {shape: rod, length: l, mass: m}}
joints:
  place: {type: free, of: [ground.O, one.start], coordinates: [x, y, theta]}
  knee: {type: hinge, of: [one.end, two.start], coordinate: phi}
initial: {x: 0, y: 0, theta: 0, phi: 0, at_rest: true}
"""
"""Two equal rods in a line, hinged to each other."""
BOX = """
parameters: {m: 2 kg, mu: 0.4, w: 0.5 m, h: 0.3 m}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
bodies: {box: {shape: rectangle, width: w, height: h, mass: m, points: {S: [-w/2, 0]}}}
contacts: {floor: {of: [box, ground.floor], friction: mu}}
initial: {box.x: 0, box.y: 0.15 m, box.angle: 0, at_rest: true}
"""
"""A box on a rough floor."""
BOB = """
parameters: {M: 2 kg, m: 1 kg, l: 0.5 m}
bodies: {cart: {mass: M}, bob: {shape: particle, mass: m}}
joints: {rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}}
strings: {cord: {ends: [cart.origin, bob.G], length: l}}
initial: {x: 0, bob.x: 0, bob.y: -l, at_rest: true}
"""
"""A bob that hangs on a string from a cart."""

CLOSED = {
    # About the pin ⅓ m l² ω = J b; the pin gives nothing at the centre of percussion, b = 2 l/3 (Meriam & Kraige, Dynamics, 7th
    # ed., art. 6/4 and 6/8).
    "bat": (BAT, "bat.P", 0, {Sym("theta_after", 1): "3*J*b/(m*l**2)", Sym("pin.J_x"): "J*(3*b/(2*l) - 1)", Sym("pin.J_y"): "0"}),
    # The struck end has 7 J/(2 m), and J/4 against J is on the other rod (Routh, Elementary Rigid Dynamics, on impulses on a chain of rods).
    "rods": (RODS, "one.start", "90 deg", {Sym("y_after", 1): "7*J/(2*m)", Sym("knee.J_x"): "0", Sym("knee.J_y"): "-J/4"}),
    # From below at one side: it turns about the other lower edge, which slides; m Δv = J + N, I ω = w (N − J)/2 + μ N h/2.
    "box from below": (BOX, "box.S", "90 deg", {Sym("floor.J_N"): "J*(2*w**2 - h**2)/(3*mu*w*h + 4*w**2 + h**2)"}),
    # The string takes what is along it.
    "bob downwards": (BOB, "bob.G", "-60 deg", {Sym("bob.x_after", 1): "J/(2*m)", Sym("bob.y_after", 1): "0",
                                                Sym("cord.J_tension"): "sqrt(3)*J/2"}),
    # It can only pull.
    "bob upwards": (BOB, "bob.G", "60 deg", {Sym("bob.x_after", 1): "J/(2*m)", Sym("bob.y_after", 1): "sqrt(3)*J/(2*m)"}),
}  # fmt: skip


def of(text):
    return fb.Mechanism.loads("freebody: 1\n" + text, "struck")


def letters(text):
    return from_sympy(sympy.sympify(text, {name: sympy.Symbol(name) for name in ("J", "m", "l", "b", "w", "h", "mu")}))


@pytest.mark.parametrize("name", CLOSED)
def test_closed_forms(name):
    text, point, direction, known = CLOSED[name]
    made = jumps(Impact.of(strike(of(text), of(text).start()[0], point, direction=direction))).spelt()
    for symbol, expected in known.items():
        assert symbol in made, sorted(x.name for x in made)
        assert equal(made[symbol], letters(expected)), (symbol, made[symbol])


MODELS = ["19.3.17", "19.3.28", "S19.18", "S19.22", "EX-ARM", "EX-BLOCK", "GEN-SLIDER", "GEN-STEP", "19.3.20"]


def at_rest(name):
    """A model at rest, its points that may move, and the velocity of one of them after a strike of 1 N·s."""
    model = fb.load(model_file(f"{name}/model"))
    start = model.start()[0]
    state = State(start.p, start.t, start.q, np.zeros_like(start.u))
    core = model.compile()
    points = [point for point, (body, _, _) in sorted(core.points(state.p).items()) if body != "ground"]

    def velocity(struck, angle, seen):
        u = np.array(list(strike(model, state, struck, float(angle)).change.after.u.values()))
        return core.evaluate([f"rate(x({seen}))", f"rate(y({seen}))"], replace(state, u=u))

    return model, state, points, velocity


@pytest.mark.parametrize("name", MODELS)
def test_theorems(name):
    """The energy given is half the impulse by the velocity of its point (Kelvin). What an impulse at P along d gives Q along e, the
    same at Q along e gives P along d (Maxwell's reciprocity)."""
    model, state, points, velocity = at_rest(name)
    rng = np.random.default_rng(5)
    for _ in range(3):
        one, other = rng.choice(points, 2)
        angles = rng.uniform(0, 2 * np.pi, 2)
        d, e = (np.array([np.cos(angle), np.sin(angle)]) for angle in angles)
        given = -strike(model, state, one, float(angles[0])).change.lost
        assert given == pytest.approx(velocity(one, angles[0], one) @ d / 2, rel=1e-9, abs=1e-12)
        there, back = velocity(one, angles[0], other) @ e, velocity(other, angles[1], one) @ d
        assert there == pytest.approx(back, rel=1e-9, abs=1e-10)


@pytest.mark.parametrize("name", but_long(["19.3.17", "19.3.20", "S19.18", "EX-BLOCK"], "19.3.17", "S19.18", "EX-BLOCK"))
def test_symbols_are_the_numbers(name):
    model, state, points, _ = at_rest(name)
    found = Impact.of(strike(model, state, points[-1], direction="40 deg", impulse="3 N*s"))
    made, most = jumps(found).spelt(), max(map(abs, found.sizes().values()))
    for coordinate, u in found.change.after.u.items():
        assert float(evaluate(made[Sym(after(coordinate), 1)], found.values)) == pytest.approx(u, abs=1e-9)
    for symbol in made.keys() & found.sizes().keys():
        assert float(evaluate(made[symbol], found.values)) == pytest.approx(found.sizes()[symbol], abs=1e-9 * most)


def test_where_symbols_fill_pages_the_equations_stand_in_numbers():
    model, state, _, _ = at_rest("GEN-STEP")
    found = Impact.of(strike(model, state, "trunk.S"))
    with pytest.raises(TooLarge):
        jumps(found)
    matrix, right = Rows.of(found).matrix(found)
    unknowns = [*found.rates_after.values(), *(found.sizes()[x] for x in Rows.of(found).impulses)]
    assert np.array(matrix) @ unknowns == pytest.approx(np.array(right), abs=1e-9)
    assert "in numbers (SI) at this impact" in topic(model, "impact", state, point="trunk.S").text()


def test_what_stays_finite_is_said_and_has_no_part():
    said = topic(fb.load(model_file("19.3.20/equilibrium")), "impact", point="bob.G").text()
    assert "finite" in said and "spring" in said


def test_what_moves_and_may_touch_is_refused():
    with pytest.raises(NotHere, match="moves at its start"):
        topic(of(BOX.replace("at_rest: true", "rates: {box.x: 1}")), "impact", point="box.S")
    said = topic(of(BAT.replace("at_rest: true", "rates: {theta: 1}")), "impact", point="bat.P").text()
    assert "If the mechanism moved, the jumps would add to its rates." in " ".join(said.split())


def test_what_strikes_needs_a_point():
    with pytest.raises(ValueError, match="direction"):
        topic(of(BAT), "impact", direction="90 deg")

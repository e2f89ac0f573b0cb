"""What becomes of small perturbations, where eigenvalues are 0 or equal: against closed forms and against simulated motions."""

from __future__ import annotations

import json

import numpy as np
import pytest

import freebody as fb
from freebody.catalogue import model_file
from freebody.equations.stability import stability
from freebody.equations.topics import topic
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import ZERO, Sym

CART = """
freebody: 1
name: a pendulum on a free cart
parameters: {M: 2 kg, m: 1 kg, l: 1 m, c: 0.5 N*s/m, g: 9.81 m/s^2}
gravity: g
bodies: {cart: {mass: M}, bob: {shape: particle, mass: m}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}
  cord: {type: link, of: [cart.origin, bob.centre], length: l, coordinate: {name: theta, zero: down, absolute: true}}
initial: {x: 0, theta: 0, at_rest: true}
"""
DRAG = 'forces: {drag: {type: force, at: cart.origin, x: "-c*vx(cart.origin)"}}\n'
PENDULUMS = """
freebody: 1
name: two pendulums that share nothing
parameters: {l: 0.5 m, m: 2 kg, k: 3 N*m/rad, c: 0.4 N*m*s/rad, g: 9.81 m/s^2}
gravity: g
bodies: {a: {mass: m, inertia: 0, points: {A: [0, l]}}, b: {mass: m, inertia: 0, points: {A: [0, l]}}}
joints:
  one: {type: hinge, of: [ground.O, a.A], coordinate: theta}
  two: {type: hinge, of: [ground.O, b.A], coordinate: phi}
forces: {FORCES}
initial: {theta: 0, phi: 0, at_rest: true}
"""
PULL = 'pull: {type: torque, on: a, value: "k*phi"}'
BEARING = "bearing: {type: torsion_spring, on: a, stiffness: 0, damping: c}"


def said(text: str) -> str:
    return " ".join(topic(fb.Mechanism.loads(text), "linear").text().split())


def test_a_free_cart_drifts_while_its_pendulum_swings() -> None:
    """s² (s² + (M + m) g/(M l)) = 0: the mass centre keeps its speed. Meirovitch, Elements of Vibration Analysis, ch. 4, of semidefinite systems."""
    stated = said(CART)
    assert "s² (s² + (M + m) g/(M l)) = 0" in stated and "± √((M + m) g/(M l)) i" in stated
    assert "No load restores x: at any small constant speed it drifts away." in stated
    assert "Apart from that, small perturbations of x, θ stay small and oscillate" in stated
    run = fb.Mechanism.loads(CART).simulate(50.0, initial={"rates": {"x": 1e-3, "theta": 0}}, t_eval=[50.0])
    assert run["x"][-1] > 0.02 and abs(run["theta"][-1]) < 1e-3


def test_a_cart_that_rubs_stays_where_it_comes_to_rest() -> None:
    """With −c ẋ the root 0 is single: nothing drifts, and the rest dies out, as the cart takes part in all of it."""
    stated = said(CART + DRAG)
    assert "No load restores x: a small perturbation stays as it is." in stated and "drift" not in stated
    assert "Apart from that, small perturbations of x, θ decay if - c > 0 Masses" in stated


def test_matrices_do_not_take_symbols_of_the_model() -> None:
    """The mass M of the cart stands in the matrix 𝐌, the coordinate x in the vector 𝐱."""
    mechanism = fb.Mechanism.loads(CART)
    stated = topic(mechanism, "linear").text()
    assert "𝐌 = ⎡ M + m  m l  ⎤" in stated and "𝐱 = (x, θ)" in stated and "𝐂 = 0" in stated
    assert r"\mathbf{M} = \begin{bmatrix}" in topic(mechanism, "linear").latex()


# Two equal pendulums: what else acts, and what then becomes of small perturbations.
EQUAL = {
    "equal frequencies, each with a direction of its own": ("", "Small perturbations stay small and oscillate for all values"),
    "one is pulled by the other's angle and so at its own frequency": (PULL, "A repeated eigenvalue has one eigenvector only"),
    "one of them is damped": (BEARING, "Small perturbations stay small: some decay, others oscillate if - c > 0 Masses"),
}


@pytest.mark.parametrize("name", EQUAL)
def test_equal_pendulums(name: str) -> None:
    """Equal eigenvalues are harmless unless they lack directions; then a swing grows as t, as at resonance. Each is simulated, too."""
    forces, verdict = EQUAL[name]
    text = PENDULUMS.replace("FORCES", forces)
    assert verdict in said(text)
    run = fb.Mechanism.loads(text).simulate(60.0, initial={"theta": 1e-4, "phi": 1e-4, "at_rest": True})
    late = run.t > 45
    growth = np.abs(run["theta"][late]).max() / 1e-4
    assert growth > 5 if forces == PULL else growth < 1.1


@pytest.mark.parametrize(("forces", "count"), [("", 2), (PULL, 2), (BEARING, 1)])
def test_eigenvalues_are_numbers_with_their_multiplicity(forces: str, count: int) -> None:
    """± i √(g/l) of two equal pendulums, twice also where they share a direction; of a damped one −c/(2 m l²) ± …"""
    found = topic(fb.Mechanism.loads(PENDULUMS.replace("FORCES", forces)), "linear")
    upward = [(root.value, root.count) for root in found.eigenvalues if root.value.imag > 0]
    free = 1j * np.sqrt(9.81 / 0.5)
    bearing = [] if count == 2 else [(-0.4 / (2 * 2 * 0.5**2) + 1j * np.sqrt(9.81 / 0.5 - 0.4**2), 1)]
    for (value, times), (true, expected) in zip(upward, [*bearing, (free, count)], strict=True):
        assert abs(value - true) < 1e-9 and times == expected
    printed = json.loads(found.json())["blocks"][-1]["data"]
    assert [(each["real"] + 1j * each["imaginary"], each["count"]) for each in printed if each["imaginary"] > 0] == upward


def test_upside_down_it_falls() -> None:
    """Upright the polynomial is s² (s² − (M + m) g/(M l))."""
    stated = " ".join(topic(fb.Mechanism.loads(CART), "linear", theta="180 deg").text().split())
    assert "grow, whatever the values of the symbols: it is unstable" in stated


def test_two_equal_rods_hang_from_each_other() -> None:
    """ω² = (3 ± 6/√7) g/l. Timoshenko & Young, Advanced Dynamics, of two bars."""
    path = model_file("19.3.28/model")
    stated = topic(fb.load(path), "linear", phi1=0, phi2=0).text()
    l = fb.load(path).start()[0].p[[p["name"] for p in fb.load(path).source().metadata["parameters"]].index("l")]
    for sign in (1, -1):
        assert f"± {np.sqrt((3 + sign * 6 / np.sqrt(7)) * 9.81 / l):.5g} i" in stated
    assert stated.count("± √(") == 2 and "stay small and oscillate for all values" in " ".join(stated.split())


HAND = """
freebody: 1
name: a broom on a hand that is driven
parameters: {l: 1.5 m, p: 30 m/s^2, d: 7 m/s, x: 1, v: 1.5, g: 9.81 m/s^2}
gravity: g
bodies: {hand: {mass: 0}, broom: {shape: rod, length: l, mass: 1 kg, points: {A: start}}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: hand.origin, angle: 0}, coordinate: s}
  grip: {type: hinge, of: [hand.origin, broom.A], coordinate: {name: theta, zero: up, sense: clockwise}}
motions: {hold: {of: s, is: p*theta + d*rate(theta) + x*s + v*rate(s), level: acceleration}}
initial: {s: 0, theta: 0, at_rest: true}
"""


@pytest.mark.parametrize(("p", "d"), [(30, 7), (30, -7), (5, 7), (-5, -7)])
def test_gains_are_conditions_whatever_they_are_in_the_model(p: float, d: float) -> None:
    """s̈ = p θ + d θ̇ holds the broom up, λ² + κ d λ + κ (p − g) = 0 with κ = 3/2l, where p > g and d > 0."""
    hand = (
        HAND.replace("p: 30", f"p: {p}")
        .replace("d: 7", f"d: {d}")
        .replace(" + x*s + v*rate(s)", "")
        .replace(" x: 1, v: 1.5,", "")
    )
    stated = said(hand)
    assert "decay if - d > 0 - p − g > 0 Masses, inertias, lengths, stiffnesses and gravity are taken as positive." in stated


def test_a_hand_that_follows_a_law_is_part_of_what_is_left() -> None:
    """λ⁴ + (κd − v) λ³ + (κp − κg − x) λ² + κg v λ + κg x with κ = 3/2l: s̈ is prescribed by places and rates, so s is not held."""
    l, p, d, x, v, g = 1.5, 30.0, 7.0, 1.0, 1.5, 9.81
    kappa = 3 / (2 * l)
    roots = np.roots([1, kappa * d - v, kappa * (p - g) - x, kappa * g * v, kappa * g * x])
    stated = said(HAND)
    for root in roots:
        assert f"{abs(root.imag):.5g} i 1/s" in stated, (root, stated[-300:])
    assert "the law of hold last" in stated


@pytest.mark.parametrize(
    ("order", "even"), [(1, False), (2, False), (3, False), (2, True), (4, True), pytest.param(4, False, marks=pytest.mark.long)]
)
def test_conditions_hold_just_where_all_roots_do(order: int, even: bool) -> None:
    """Of polynomials with drawn roots: all to the left; of those with even powers alone all imaginary and apart."""
    names, rng, seen = [Sym(f"a{i}") for i in range(order, -1, -1)], np.random.default_rng(order), set()
    told = stability([ZERO if even and i % 2 else name for i, name in enumerate(names)], positive=[names[0].name])
    for _ in range(200):
        squares = rng.uniform(-3, 1, order // 2) if even else []
        pairs = [complex(*rng.uniform(-2, 0.5, 2)) for _ in range(order // 2)]
        real = rng.uniform(-2, 0.5, order % 2 if rng.random() < 0.7 else order)
        roots = [*np.concatenate([x for p in pairs for x in ([p], [p.conjugate()])] or [[]]), *real][-order:]
        roots = [root for x in squares for root in (np.sqrt(x + 0j), -np.sqrt(x + 0j))] if even else roots
        polynomial = rng.uniform(0.5, 2) * np.poly(roots).real
        values = dict(zip(names, polynomial.tolist(), strict=True))
        holds = bool((np.roots(polynomial).real < 0).all()) if not even else bool((np.array(squares) < 0).all())
        seen.add(holds)
        assert all(evaluate(each, values) > 0 for each in told.conditions) == holds, (polynomial, told)
    assert seen == {True, False}

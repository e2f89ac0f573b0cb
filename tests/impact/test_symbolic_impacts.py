"""Impacts symbolically: closed forms of textbooks, and the numbers of the run."""

import numpy as np
import pytest
import sympy
from colliding import ALL, first_impacts, mechanism
from store import every

from freebody.equations import Sym, evaluate, from_sympy
from freebody.equations.solve import TooLarge
from freebody.equations.topics import topic
from freebody.equations.topics.impact_equations import Impact, after
from freebody.equations.topics.impulse_momentum import jumps
from freebody.symbolic.algebra import equal
from freebody.symbolic.tree import replace

LONG = {"GEN-WALK/model", "four_bar", "GEN-STEP/floor", "GEN-STEP/model"}
"""Too long to be solved symbolically."""
REDUNDANT = {"plate"}
"""Friction on two feet at once is more than it takes."""


def solved(name):
    return jumps(Impact.of(mechanism(name).blow())).spelt()


def letters(text):
    """SymPy of a text in which ``u'`` is a rate before and e the restitution of the one contact."""
    names = ("m", "M", "l", "b", "d", "n", "e", "mu", "R", "y'", "x'", "s'", "w'")
    spelt = {name.replace("'", "_before"): sympy.Symbol(name) for name in names}
    return from_sympy(sympy.sympify(text, spelt))


CLOSED = {
    # A ball on a bar: moments of momentum about the pin, I = M l²/3, and e v = b ω⁺ + …; the reaction of the pin changes its sense
    # where the ball strikes at the centre of percussion, b = 2 l/3 (Meriam & Kraige, Dynamics, 7th ed., art. 6/8).
    "ball_on_bar": {
        Sym("phi_after", 1): "(1 + e)*m*b*y_before/(M*l**2/3 + m*b**2)",
        Sym("y_after", 1): "(m*b**2 - e*M*l**2/3)*y_before/(M*l**2/3 + m*b**2)",
        Sym("knock.J_N"): "-(1 + e)*m*M*l**2/3*y_before/(M*l**2/3 + m*b**2)",
        Sym("pin.J_y"): "(1 + e)*m*M*(l*b/2 - l**2/3)*y_before/(M*l**2/3 + m*b**2)",
    },
    # A bullet in a hanging rod: ω = m d v/(M l²/3 + m d²) (Ruina & Pratap, Introduction to Mechanics, the ballistic pendulum).
    "bullet": {
        Sym("theta_after", 1): "m*d*x_before/(M*l**2/3 + m*d**2)",
        Sym("x_after", 1): "m*d**2*x_before/(M*l**2/3 + m*d**2)",
        Sym("pivot.J_x"): "m*M*(l*d/2 - l**2/3)*x_before/(M*l**2/3 + m*d**2)",
    },
    # Two rods struck at the end: velocity 7 J/(2 m) of that end, J/4 at the hinge (Routh, Elementary Rigid Dynamics, on impulses
    # on a chain of rods), where J = (1 + e) v/(1/n + 7/(2 m)).
    "links": {
        Sym("knock.J_N"): "-(1 + e)*s_before/(1/n + 7/(2*m))",
        Sym("y_after", 1): "5/(4*m)*(1 + e)*s_before/(1/n + 7/(2*m))",
        Sym("phi_after", 1): "6/(m*l)*(1 + e)*s_before/(1/n + 7/(2*m))",
    },
    # A disk that slides throughout: friction μ (1 + e) m v (Brach, Mechanical Impact Dynamics, ch. 2).
    "slides": {
        Sym("disk.x_after", 1): "x_before + mu*(1 + e)*y_before",
        Sym("floor.J_N"): "-(1 + e)*m*y_before",
    },
}


PLACES = {
    "links": {Sym("x"): from_sympy(sympy.Symbol("l") / 2)},
    "slides": {Sym("disk.x", 1): Sym("x", 1), Sym("disk.y", 1): Sym("y", 1)},
}
"""Where the models are at the impact, and shorter names."""


@pytest.mark.parametrize("name", CLOSED)
def test_closed_forms(name):
    made = solved(name)
    for symbol, text in CLOSED[name].items():
        found = replace(made[symbol], PLACES.get(name, {}))
        assert equal(found, letters(text)), (symbol, found)


def test_a_rod_caught_at_its_end():
    """It turns about that end with 3 v/(2 l), its centre keeps ¾ v, and the string takes ¼ m v (Ruina & Pratap, on collisions of
    rods with what they hang on)."""
    found, v = Impact.of(mechanism("caught").blow()), Sym("rod.y", 1)
    # The string is upright, the rod at its lower end.
    below = {Sym("rod.x"): from_sympy(sympy.Symbol("l") / 2), Sym("rod.y"): from_sympy(-sympy.Symbol("s"))}
    made = {symbol: replace(tree, below) for symbol, tree in solved("caught").items()}
    m, l, u = (sympy.Symbol(x) for x in ("m", "l", "rod.y'"))
    known = {"rod.y_after": 3 * u / 4, "rod.angle_after": 3 * u / (2 * l)}
    for name, expression in known.items():
        assert equal(made[Sym(name, 1)], from_sympy(expression)), made[Sym(name, 1)]
    [(cord, size)] = [(x, n) for x, n in found.sizes().items() if x.name.startswith("cord")]
    assert equal(made[cord], from_sympy(-m * u / 4)) and size == pytest.approx(-2 * found.values[v] / 4, rel=1e-9)


@every(sorted(set(ALL) - LONG - REDUNDANT), "name", share=2)
def test_symbolic_answers_are_the_numbers_of_the_run(name):
    found = Impact.of(mechanism(name).blow())
    made, values, sizes = jumps(found).spelt(), found.values, found.sizes()
    for coordinate, u in found.change.after.u.items():
        assert float(evaluate(made[Sym(after(coordinate), 1)], values)) == pytest.approx(u, abs=1e-7)
    assert made.keys() >= set(found.impulses.values()) or any(map(np.isnan, sizes.values()))
    most = np.nanmax(np.abs(list(sizes.values())))
    for symbol in made.keys() & sizes.keys():
        assert float(evaluate(made[symbol], values)) == pytest.approx(sizes[symbol], abs=1e-7 * most), symbol


@every(ALL, "name", share=2)
def test_every_equation_holds_in_the_run(name):
    """Balances of coordinates and of bodies, what comes back or holds, and the law of friction."""
    for number in range(1, len(first_impacts(name, 2)) + 1):
        found = Impact.of(mechanism(name).blow(number))
        values = found.values | {Sym(after(c), 1): u for c, u in found.change.after.u.items()} | found.sizes()
        if any(np.isnan(x) for x in found.sizes().values()):
            continue
        rounding = 1e-8 * max(1.0, *map(abs, found.sizes().values()))
        for each in [*found.of_coordinates(), *found.of_bodies()]:
            gap = evaluate(found.acting(each.balance), values) - evaluate(found.jump(each.balance), values)
            assert abs(float(gap)) < rounding, each.title
        for each in found.conditions():
            left, right = (float(evaluate(side, values)) for side in found.sides(each))
            assert left == pytest.approx(right, abs=1e-8), each.name


@pytest.mark.parametrize("name", sorted(LONG))
def test_what_is_too_long_is_refused(name):
    found = Impact.of(mechanism(name).blow())
    with pytest.raises(TooLarge):
        jumps(found)


def test_friction_says_its_law():
    slides, rolls = (topic(mechanism(name), "impact").text() for name in ("slides", "rolls"))
    assert "slides throughout the impact" in slides and "Coulomb's law" in slides
    assert "sticks after the impact" in rolls


def test_slip_that_turns_is_refused_with_its_reason():
    """A leaning rod whose tip stops sliding within the impact, where Newton's law would make energy (Kane 1984)."""
    from freebody import Mechanism

    text = """freebody: 1
gravity: none
bodies: {stick: {shape: rod, length: 1 m, mass: 1.5 kg}}
ground: {lines: {floor: {through: ground.O, angle: 0}}}
contacts: {tip: {of: [stick.start, ground.floor], friction: 1.5, restitution: 0.9}}
initial: {points: {stick.start: [0, 1e-3]}, stick.angle: 50 deg, rates: {stick.x: 0.4, stick.y: -1, stick.angle: 0}}
run: {until: 2 ms, impacts: poisson}
"""
    said = topic(Mechanism.loads(text, "stick"), "impact").text()
    assert "neither the largest in one direction nor what sticking takes" in " ".join(said.split())


@pytest.mark.long
def test_a_document_has_its_drawings_even_where_the_state_alone_jams():
    """A foot that strikes may jam by Coulomb's law if it stayed; the configuration and the impulses of every body are drawn."""
    assert topic(mechanism("GEN-STEP/model"), "impact", of="other").html().count("<svg") == 2

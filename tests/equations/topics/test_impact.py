"""Impacts symbolically against those of the run, and against closed forms."""

import pytest
from models import system
from numpy.testing import assert_allclose
from store import but_long

import freebody as fb
from freebody.equations import Sym, evaluate, from_sympy
from freebody.equations.topics import NotHere, topic
from freebody.equations.topics.impact_equations import Impact, after
from freebody.equations.topics.impulse_momentum import jumps
from freebody.symbolic.algebra import equal


def carts(restitution: float) -> fb.Mechanism:
    """A cart runs into another on a rail."""
    m = fb.Mechanism("two carts", gravity=0)
    rail = {"through": m.ground.O, "angle": 0}
    for name, x in (("A", "m1"), ("B", "m2")):
        cart = m.body(name, mass=m.parameter(x, "2 kg" if name == "A" else "3 kg"))
        m.slider(name=f"rail{name}", along=rail, line={"through": cart.origin, "angle": 0}, coordinate=f"x{name}")
        face = cart.line("face", cart.origin, angle="90 deg")
    m.contact("bump", "A.origin", face, restitution=restitution)
    m.initial(xA=0, xB=1, rates={"xA": 2, "xB": "0.5 m/s"})
    m.run_settings(until=2)
    return m


def rod_on_a_floor(restitution: float = 0.0) -> fb.Mechanism:
    """A rod falls, without turning, on a smooth floor with its end."""
    m = fb.Mechanism("falling rod", gravity=9.81)
    rod = m.rod("rod", length=m.parameter("l", "1 m"), mass=m.parameter("m", "2 kg"))
    m.free(m.ground.O, rod.centre, coordinates=["x", "y", "theta"])
    m.contact("floor", rod.start, m.ground.line("ground line", m.ground.O, angle=0), restitution=restitution)
    m.initial(x=0, y=1, theta="30 deg", at_rest=True)
    m.run_settings(until=0.5)
    return m


MODELS = {
    "carts that bounce": lambda: carts(0.6),
    "carts that stick": lambda: carts(0.0),
    "19.3.22": lambda: system("19.3.22"),
    "19.3.30": lambda: system("19.3.30"),
    "rod on a floor": rod_on_a_floor,
    "rod on a floor that bounces": lambda: rod_on_a_floor(0.5),
}


@pytest.mark.parametrize("name", but_long(MODELS, "19.3.30"))
def test_rates_after_an_impact_are_those_of_the_run(name: str) -> None:
    found = Impact.of(MODELS[name]().blow())
    solved, values = jumps(found).spelt(), found.values
    for coordinate, true in found.change.after.u.items():
        assert float(evaluate(solved[Sym(after(coordinate), 1)], values)) == pytest.approx(true, abs=1e-7)


@pytest.mark.parametrize("name", but_long(MODELS, "19.3.30"))
def test_impulses_are_those_of_the_run(name: str) -> None:
    found = Impact.of(MODELS[name]().blow())
    solved, values = jumps(found).spelt(), found.values
    for limit, true in found.change.impulses.contacts.items():
        loads = [load for load in found.subject.free.loads if load.name == limit and load.unknown]
        first = found.subject.source.metadata["limits"]
        of = next(each["first"] for each in first if each["name"] == limit)
        made = [0.0, 0.0]
        for load in loads:
            size = float(evaluate(solved[found.impulses[Sym(load.symbol)]], values))
            part = next((p for p in load.on if p.body == of), None) or load.on[0]
            sign = 1.0 if part.body == of else -1.0
            made = [m + sign * size * f for m, f in zip(made, part.force, strict=True)]
        assert_allclose(made, true, atol=1e-6)


@pytest.mark.parametrize("name", but_long(MODELS, "19.3.30"))
def test_conserved_momenta_are_the_same_on_both_sides(name: str) -> None:
    found = Impact.of(MODELS[name]().blow())
    values = found.values | {Sym(after(c), 1): u for c, u in found.change.after.u.items()}
    assert found.conserved()
    for title, balance in found.conserved():
        assert float(evaluate(found.jump(balance), values)) == pytest.approx(0.0, abs=1e-7), title


def test_carts_bounce() -> None:
    """v₁' = ((m₁ − e m₂) v₁ + (1 + e) m₂ v₂)/(m₁ + m₂). Goldstein, Classical Mechanics, or any text."""
    import sympy

    m1, m2, e, a, b = sympy.symbols("m1 m2 e_bump xA' xB'")
    known = ((m1 - e * m2) * a + (1 + e) * m2 * b) / (m1 + m2)
    assert equal(jumps(Impact.of(carts(0.6).blow())).spelt()[Sym(after("xA"), 1)], from_sympy(known))


def test_a_run_without_impact_is_named() -> None:
    with pytest.raises(NotHere, match="0 impacts"):
        topic(system("19.3.1"), "impact")


def test_what_is_absent_is_reported() -> None:
    said = topic(rod_on_a_floor(), "impact").text()
    assert "weight of rod: finite" in said
    assert "J_N_floor" in said

"""The energy of contacts, strings and stops for which springs stand: in the potential where nothing else acts in them, else a work."""

from __future__ import annotations

import numpy as np
import pytest
from seen import imbalance, model

from freebody.equations.topics import topic

PARTS = {
    "contact": "contacts: {floor: {of: [ball, {through: ground.O, angle: 0}], stiffness: k}}",
    "stop": "stops: {floor: {of: ball.y, least: 0, stiffness: k}}",
    "string": "strings: {floor: {ends: [ground.top, ball.centre], length: 2 m, stiffness: k}}",
}
BALL = """
parameters: {k: 2000 N/m, c: 5 N*s/m}
bodies: {ball: {shape: particle, mass: 2 kg}}
ground: {points: {top: [0, 2]}}
PART
initial: {ball.x: 0, ball.y: HEIGHT, rates: {ball.x: 0.5 m/s}}
run: {until: 1 s, rtol: 1e-11}
"""


def ball(part: str, height: str = "0.3", damped: bool = False):
    text = BALL.replace("PART", PARTS[part]).replace("HEIGHT", height)
    return model(text.replace("stiffness: k", "stiffness: k, damping: c") if damped else text)


@pytest.mark.parametrize("part", PARTS)
def test_a_spring_keeps_the_energy_and_a_damper_beside_it_takes_some(part: str):
    run = ball(part).simulate()
    assert sum(change.kind in ("contact", "taut") for change in run.changes) >= 1
    energy = run.evaluate("energy()")
    assert energy == pytest.approx(energy[0], rel=1e-9) and "compliant contacts" not in run.energy.names
    damped = ball(part, damped=True).simulate()
    assert damped["compliant contacts"][-1] < -1e-2 and imbalance(damped) < 1e-9


@pytest.mark.parametrize("part", PARTS)
def test_equations_and_conservation_know_the_energy_of_what_is_pressed(part: str):
    """The equations of Lagrange are held against the balances by the derivation itself."""
    pressed = ball(part, "-0.05")
    said = str(pressed.equations(long=True))
    assert "conserved: all forces have potentials" in said and "½" in said and "k" in said.split("E_p")[1].split("\n")[0]
    assert pressed.check("constant: energy()").kind == "true"
    assert "The same as the balance equations" in topic(pressed, "lagrange").text()
    damped = ball(part, "-0.05", damped=True)
    assert "not conserved: floor does work that has no potential" in str(damped.equations(long=True))
    assert "The same as the balance equations" in topic(damped, "lagrange").text()


@pytest.mark.parametrize("part", PARTS)
def test_a_spring_that_goes_and_comes_while_it_is_pressed_is_in_the_ledger(part: str):
    """It is taken away with k δ²/2, and found again deeper."""
    absent = "events: {away: {at: 0.01 s, then: {release: floor}}, again: {at: 0.1 s, then: {engage: floor}}}\ninitial:"
    run = model(BALL.replace("PART", PARTS[part]).replace("HEIGHT", "-0.05").replace("initial:", absent)).simulate(until=0.3)
    gap = run.evaluate("floor.gap", [np.nextafter(0.01, 0), 0.1])
    put_in = np.array([-1, 1]) @ gap**2 * 1000
    assert run["parameter changes"][-1] == pytest.approx(put_in, rel=1e-9) and imbalance(run) < 1e-9

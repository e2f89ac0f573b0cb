"""Equations, diagrams and instants of one moment of a motion: after the events at its start, at a time, before and after an event."""

from __future__ import annotations

import numpy as np
import pytest

import freebody as fb
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate

HUNG = """
freebody: 1
parameters: {L: 1.2 m, m: 5 kg, h: 0.8 m}
ground: {points: {C: [0, 0], D: [L, 0]}}
bodies: {bar: {shape: rod, length: L, mass: m}}
strings:
  AC: {ends: [ground.C, bar.start]}
  BD: {ends: [ground.D, bar.end]}
initial: {points: {bar.start: [0, -h], bar.end: [L, -h]}, at_rest: true}
events: {cutting: {at: start, then: {cut: BD}}}
run: {until: 0.3 s}
"""
MOMENTS = {
    "examples/tossed_box.yaml": ["leash", 0.2, 0.42, 0.9],
    "systems/19.3.9-collar-flung-off/model.yaml": ["cut", 1.0, "track leaves end"],
    "systems/19.3.4-cart-and-cut-string/model.yaml": ["start", 0.5],
    "systems/19.3.11-gun-on-a-cart/two.yaml": ["start", 0.1],
    "examples/new_gun.yaml": [0.5],
}


@pytest.fixture
def hung(tmp_path) -> fb.Mechanism:
    file = tmp_path / "hung.yaml"
    file.write_text(HUNG)
    return fb.load(file)


def test_a_bar_of_which_one_string_is_cut_pulls_with_a_quarter_of_its_weight(hung: fb.Mechanism) -> None:
    """Just after the cut its mass centre falls with 3g/4 and the other string carries m g/4, before it half of the weight each."""
    weight = 5 * 9.81
    assert hung.solve(before="start")["AC.tension"] == pytest.approx(weight / 2)
    assert hung.solve(before="cutting")["BD.tension"] == pytest.approx(weight / 2)
    for now in (hung.solve(), hung.solve(after="cutting"), hung.solve(at=0)):
        assert now["AC.tension"] == pytest.approx(weight / 4)
        assert now.accelerations["bar.y"] == pytest.approx(-0.75 * 9.81)
    assert "equations, minimal form, after cutting" in str(hung.equations())
    assert "equations, minimal form, before cutting" in str(hung.equations(before="start"))
    assert hung.check("at start: AC.tension = m g/4").ok


def moments() -> list[tuple[str, float | str]]:
    return [(model, moment) for model, asked in MOMENTS.items() for moment in asked]


@pytest.mark.parametrize(("model", "moment"), moments())
def test_printed_equations_hold_for_what_is_in_place_then(model: str, moment: float | str) -> None:
    """A x = b with the accelerations and loads of the instant of the run at that moment."""
    m = fb.load(model)
    words = {"at": moment} if isinstance(moment, float) else {"after": moment}
    state, _ = m.moment(**words)
    made, subject = m.equations("brute", **words), SymbolicState(m.source(), state)
    values = subject.values
    a = np.array([[evaluate(entry, values, subject.tables) for entry in row] for row in made.mass_matrix])
    b = np.array([evaluate(entry, values, subject.tables) for entry in made.right_hand_side])
    x = np.array([values[unknown] for unknown in made.unknowns])
    assert np.abs(a @ x - b).max() < 1e-10 * np.abs(a * x).max(initial=1.0)
    now = m.simulate().instant(state.t)
    assert m.solve(**words).accelerations == pytest.approx(now.accelerations, rel=1e-9, abs=1e-9)
    assert {load.symbol for load in subject.free.loads} == {load.symbol for load in now.free_bodies().loads}


def test_what_does_not_come_is_named(hung: fb.Mechanism) -> None:
    with pytest.raises(ValueError, match=r"'rope' does not happen until 0.3 s; what happens: .*cutting"):
        hung.solve(after="rope")
    with pytest.raises(ValueError, match="one moment"):
        hung.solve(at=0.1, before="cutting")
    with pytest.raises(ValueError, match="begins at 0 s"):
        hung.equations(at=-1)

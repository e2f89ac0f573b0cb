"""What one set of formulas cannot hold is refused by name."""

from __future__ import annotations

import pytest
from programs import ROOT

import freebody as fb
from freebody.codegen.refusals import CannotGenerate

CART = """
freebody: 1
name: cart
parameters: {m: 1 kg, k: 4 N/m, F: 2 N}
gravity: 9.81
bodies:
  cart: {shape: rectangle, width: 0.4, height: 0.2, mass: m}
joints:
  track: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.centre, angle: 0}, coordinate: s}
forces:
  push: {type: force, at: cart.centre, x: F, y: 0}
initial: {s: 0.1}
"""


@pytest.mark.parametrize(
    ("path", "reason"),
    [
        ("examples/tossed_box.yaml", r"contacts\.floor opens and closes"),
        ("systems/19.3.21-two-blocks-and-a-cable/model.yaml", r"strings\.cable goes slack"),
        ("systems/GEN-CAR-drivetrain/model.yaml", r"joints\.first gear pair pushes with one flank or the other"),
        ("examples/beam_held_twice.yaml", r"do not determine left\.Fx, right\.Fx"),
    ],
)
def test_what_switches_or_is_not_determined(path, reason):
    with pytest.raises(CannotGenerate, match=reason):
        fb.load(ROOT / path).code()


@pytest.mark.parametrize(
    ("before", "after", "reason"),
    [
        ("coordinate: s}", "coordinate: s, friction: 0.2}", r"joints\.track has friction, which sticks or slides"),
        ("x: F,", 'x: "max(0, F - k*s)",', r"forces\.push: '.*' switches between formulas \(max\); a smooth law"),
        ("x: F,", 'x: "if(s > 0.2 m, F, 0 N)",', r"forces\.push: '.*' switches between formulas"),
        (
            "x: F,",
            'x: "bump(s)",',
            r"forces\.push: 'bump\(s\)' is given by the table 'bump'",
        ),
    ],
)
def test_friction_cases_and_tables(before, after, reason):
    text = CART.replace(before, after)
    if "bump" in after:
        text += "tables:\n  bump: {x: [0 m, 1 m, 2 m], y: [0 N, 1 N, 0 N]}\n"
    with pytest.raises(CannotGenerate, match=reason):
        fb.Mechanism.loads(text).code()


def test_a_smooth_law_is_taken():
    assert "np.exp" in fb.Mechanism.loads(CART.replace("x: F,", 'x: "F*exp(-s/(1 m))",')).code()


def test_a_language_that_is_not_there():
    with pytest.raises(ValueError, match="'fortran' is unknown; there are python, c"):
        fb.Mechanism.loads(CART).code("fortran")

"""Amplitudes of what is driven and of what swings freely: closed forms of Thomson, Theory of Vibration, chapters 2 and 3."""

from __future__ import annotations

import pytest

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism

MASS = """
freebody: 1
parameters: {m: 2.3 kg, k: 410 N/m, c: 11 N*s/m, F0: 7.4 N, Ω: 17 1/s, x0: 0.031 m, v0: 0.42 m/s}
gravity: none
ground: {lines: {level: {through: O, angle: 0}}}
bodies: {block: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: ground.level, point: block.centre, coordinate: x}}
"""
FORCES = {
    "driven": "spring: {type: spring, along: x, stiffness: k, damping: c}, push: {type: force, at: block.centre, x: F0*sin(Ω*t)}",
    "undamped": "spring: {type: spring, along: x, stiffness: k}, push: {type: force, at: block.centre, x: F0*sin(Ω*t)}",
    "free": "spring: {type: spring, along: x, stiffness: k}",
}
SAID = [
    ("driven", "in the steady state: X = F0/√((k − m Ω²)² + (c Ω)²)", Kind.TRUE),
    ("driven", "the steady-state amplitude of x is F0/√((k − m Ω²)² + c² Ω²)", Kind.TRUE),
    ("driven", "amplitude of the block: A = F0/√((k − m Ω²)² + (c Ω)²)", Kind.TRUE),
    ("driven", "in the steady state: X = F0/√((k − m Ω²)² + c² Ω)", Kind.DIMENSIONS),
    ("driven", "in the steady state: X = F0/√((k − m Ω²)² + 4 c² Ω²)", Kind.WRONG),
    ("driven", "in the steady state: X = F0/√((k + m Ω²)² + (c Ω)²)", Kind.WRONG),
    ("driven", "in the steady state, amplitude of x = F0/√((k − m Ω²)² + (c Ω)²)", Kind.TRUE),
    ("driven", "in the steady state, amplitude of x = F0/√((k − m Ω²)² + c² Ω)", Kind.DIMENSIONS),
    ("driven", "in the steady state, small x: X = F0/√((k − m Ω²)² + (c Ω)²)", Kind.TRUE),
    ("driven", "in the steady state, small x: X = F0/√((k − m Ω²)² + 4 c² Ω²)", Kind.WRONG),
    ("driven", "in the steady state, for small c: the amplitude of x = F0/|k − m Ω²|", Kind.TRUE),
    ("driven", "in the steady state, for small c: the amplitude of x = F0/|k − 2 m Ω²|", Kind.WRONG),
    ("driven", "in the steady state: tan φ = c Ω/(k − m Ω²)", Kind.TRUE),
    ("driven", "in the steady state: tan φ = c Ω/(m Ω² − k)", Kind.WRONG),
    ("undamped", "steady-state amplitude: X = F0/(k − m Ω²)", Kind.TRUE),
    ("undamped", "steady-state amplitude: X = F0/(k − 2 m Ω²)", Kind.WRONG),
    ("free", "amplitude: X = √(x0² + m v0²/k)", Kind.TRUE),
    ("free", "the amplitude of x is √(x0² + (v0/ω)²), where ω = √(k/m)", Kind.TRUE),
    ("free", "amplitude: X = x0 + v0 √(m/k)", Kind.WRONG),
]


@pytest.mark.parametrize(("model", "says", "kind"), SAID)
def test_amplitudes_are_judged(model, says, kind):
    text = f"{MASS}forces: {{{FORCES[model]}}}\ninitial: {{x: x0, rates: {{x: v0}}}}\n"
    checker = Checker(Mechanism.loads(text))
    checker.correcting = False
    assert checker.check(says).kind is kind


SHAKEN = (
    MASS.replace("F0: 7.4 N", "h: 0.02 m")
    + """
forces: {spring: {type: law, along: x, value: "-k*(x - h*cos(Ω*t))"}}
initial: {x: 0.01 m}
"""
)
BASE = """
freebody: 1
parameters: {m: 2.3 kg, k: 410 N/m, c: 11 N*s/m, h: 0.02 m, Ω: 17 1/s}
gravity: none
ground: {lines: {level: {through: O, angle: 0}}}
bodies: {block: {shape: particle, mass: m}, base: {shape: particle, mass: m}}
joints:
  rail: {type: slot, along: ground.level, point: block.centre, coordinate: x}
  track: {type: slot, along: ground.level, point: base.centre, coordinate: y}
forces: {spring: {type: spring, along: x - y, stiffness: k, damping: c}}
motions: {shake: {of: y, is: h*sin(Ω*t)}}
initial: {x: 0.01 m}
"""
ROD = """
freebody: 1
parameters: {m: 1.3 kg, l: 0.62 m, g: 9.81 m/s^2, F0: 21 N, Ω: 5.3 1/s}
gravity: g
bodies: {rod: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: {name: θ, zero: -90 deg}}}
forces: {wind: {type: force, at: rod.end, x: F0*cos(Ω*t)}}
initial: {θ: 10 deg}
"""


@pytest.mark.parametrize(
    ("model", "says", "kind"),
    [
        (ROD, "natural frequency: ω² = 3 g/(2 l)", Kind.TRUE),
        (ROD, "natural frequency: ω² = g/l", Kind.WRONG),
        (ROD, "small oscillations: ⅓ m l² θ'' + ½ m g l θ = F0 l cos Ωt", Kind.TRUE),
        (ROD, "small oscillations: ⅓ m l² θ'' + ½ m g l θ = ½ F0 l cos Ωt", Kind.WRONG),
        (SHAKEN, "natural frequency: ω² = k/m", Kind.TRUE),
        (SHAKEN, "small oscillations: m x'' + k x = k h cos Ωt", Kind.TRUE),
    ],
)
def test_what_drives_does_not_shift_the_place_about_which_a_model_swings(model, says, kind):
    """At first the wind would hold the rod at arctan(2 F0/(m g))."""
    checker = Checker(Mechanism.loads(model))
    checker.correcting = False
    assert checker.check(says).kind is kind


@pytest.mark.parametrize(
    ("says", "kind"),
    [
        ("in the steady state, small θ: Θ = F0 l/(½ m g l − ⅓ m l² Ω²)", Kind.TRUE),
        ("steady state, small θ: θ_max = F0/|½ m g − ⅓ m l Ω²|", Kind.TRUE),
        ("in the steady state, for small angles: the amplitude of θ is F0/|m g/2 − m l Ω²/3|", Kind.TRUE),
        ("steady state, small θ: Θ = F0 l/|½ m g l + ⅓ m l² Ω²|", Kind.WRONG),
        ("steady state, small θ: Θ = F0 l/|½ m g l − ½ m l² Ω²|", Kind.WRONG),
        ("steady state, small θ: Θ = F0/|½ m g l − ⅓ m l² Ω²|", Kind.DIMENSIONS),
    ],
)
def test_amplitudes_of_small_forced_vibrations(says, kind):
    checker = Checker(Mechanism.loads(ROD))
    checker.correcting = False
    assert checker.check(says).kind is kind


@pytest.mark.parametrize(("says", "kind"), [("c_c = 2 √(k m)", Kind.TRUE), ("critical damping: c_cr = √(k m)", Kind.WRONG)])
def test_critical_damping(says, kind):
    checker = Checker(Mechanism.loads(f"{MASS}forces: {{{FORCES['driven']}}}\n"))
    assert checker.check(says).kind is kind


@pytest.mark.parametrize(
    ("says", "kind"),
    [
        ("steady state: tan φ = m c Ω³/(k (k − m Ω²) + (c Ω)²)", Kind.TRUE),  # Thomson 3.5: behind the base, and not its force
        ("steady state: tan φ = c Ω/(k − m Ω²)", Kind.WRONG),
    ],
)
def test_a_phase_is_that_behind_what_drives(says, kind):
    checker = Checker(Mechanism.loads(BASE))
    checker.correcting = False
    assert checker.check(says).kind is kind

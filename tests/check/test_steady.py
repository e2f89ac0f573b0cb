"""Steady states: what is left where all that dies away has done so."""

from __future__ import annotations

import pytest

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism

T, W = Kind.TRUE, Kind.WRONG
SLEDGES = """
parameters: {m: 2 kg, M: 3 kg, k: 40 N/m, c: 5 N*s/m, q: 0.8 kg/m, F: 7 N, D: 0 N}
ground: {lines: {ice: {through: O, angle: 0}}}
bodies:
  front: {shape: particle, mass: m, points: {P: centre}}
  back: {shape: particle, mass: M, points: {P: centre}}
joints:
  one: {type: slot, along: ground.ice, point: front.P, coordinate: x}
  two: {type: slot, along: ground.ice, point: back.P, coordinate: y}
forces:
  pull: {type: law, along: x, value: F}
  cord: {type: spring, along: x - y, stiffness: k, damping: c}
"""
DRAG = "  drag: {type: law, along: y, value: -q*rate(y)*abs(rate(y))}\n"
"""Two sledges that are tied by a cord that gives; with the drag on the second one."""
STATED = [
    ("", "k (x - y) = M F/(m + M)", T),
    ("", "k (x - y) = F", W),
    ("", "(m + M) x'' = F", T),
    ("", "x' = y'", T),
    ("", "x'' = 0", W),
    (DRAG, "q y'^2 = F", T),
    (DRAG, "k (x - y) = F", T),
    (DRAG, "k (x - y) = M F/(m + M)", W),
    (DRAG, "x'' = 0", T),
]  # fmt: skip


@pytest.mark.parametrize(("drag", "statement", "kind"), STATED)
def test_what_dies_away_has_done_so(drag: str, statement: str, kind: Kind) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{SLEDGES}{drag}initial: {{x: 0.1 m, y: 0, at_rest: true}}\n")
    verdict = Checker(mechanism).check(f"in the steady state: {statement}", correcting=False)
    assert verdict.kind is kind, str(verdict)


SHAFT = """
freebody: 1
parameters: {J: 0.2 kg*m^2, K: 3 N*m/rad, c: 0.4 N*m*s/rad, Ω: 5 rad/s}
gravity: none
bodies: {shaft: {mass: 1 kg, inertia: J}, disk: {mass: 1 kg, inertia: J}}
joints:
  one: {type: hinge, of: [ground.O, shaft.origin], coordinate: ψ}
  two: {type: hinge, of: [ground.O, disk.origin], coordinate: φ}
forces: {wire: {type: law, along: ψ - φ, value: -K*(ψ - φ)}, oil: {type: law, along: φ, value: -c*rate(φ)}}
motions: {motor: {of: ψ, is: Ω*t}}
initial: {φ: 0, rates: {φ: 0}}
run: {until: 1 s}
"""
"""A disk in oil that a shaft turns by a wire."""


@pytest.mark.parametrize(("statement", "kind"), [("K (ψ - φ) = c Ω", T), ("φ' = Ω", T), ("ψ = φ", W), ("φ' = 0", W)])
def test_what_is_driven_at_one_speed_takes_the_rest_along(statement: str, kind: Kind) -> None:
    assert Checker(Mechanism.loads(SHAFT)).check(f"in the steady state: {statement}", correcting=False).kind is kind

"""The clauses around an equation: conditions come first, then what it is of."""

from __future__ import annotations

import pytest

from freebody.check.prose import plainly

KNOWN = {*["m", "θ", "F", "E", "k", "a", "b", "J", "M", "T", "v", "u"]}
BODIES = ("wheel",)
ARRANGED = {
    "energy just after the impact: ½ m v² = E": "just after the impact: energy: ½ m v² = E",
    "wheel, ΣM_C while it slips (clockwise +): F r = J α": "while it slips: wheel, ΣM_C: F r = J α",
    "engine off, no damping (Q = 0, c = 0), for small φ: ω = 1": "if Q = 0, c = 0, for small φ: ω = 1",
    "rotor runs free: J α = −Q, after the motor is off": "after the motor is off, rotor runs free: J α = −Q",
    "At the moment A leaves the wall v = u": "at the moment A leaves the wall: v = u",
    "the rope gets shorter at the rate L' = u": "L' = u",
    "for R → ∞ nothing is lost: E = T": "for R → ∞: E = T",
    "the belt becomes taut at the instant t = 1": "when the belt becomes taut: t = 1",
    "if k₁ a = k₂ b the car pitches: ω² = k/J": "if k₁ a = k₂ b: the car pitches: ω² = k/J",
    "momentum before = momentum just after: m v = M u": "m v = M u",
    "if the arms have no mass (m = 0): F = M a": "if m = 0: F = M a",
    "jaws together (after the blow): θ = φ": "after the blow: θ = φ",
    "after the first blow, before the second: E = 0": "after the first blow: E = 0",
    "right after the release (θ = θ_0, θ' = 0): R = 0": "right after the release: R = 0",
    "link locked (θ = 0, d = 0): F = 0": "if θ held at 0, d = 0: F = 0",
    "recovery (handle free): E = const": "during recovery: E = const",
    "small, from equilibrium: m a = F": "for small motions: m a = F",
    "in equilibrium, ΣM_A = 0: F a = W b": "in equilibrium: F a = W b",
    "v_B has no part along PB, so x = y": "x = y",
    "right after the impact \\dot x = v": "right after the impact: \\dot x = v",
    "bolt in flight, ΣF_r: F = m a": "while bolt is in flight: ΣF_r: F = m a",
    "at the top of the first rebound: x = y": "at the top, after the impact: x = y",
    "While they move together $N = k x$": "while they move together: N = k x",
    "natural frequencies for $c = 0$: m ω² = k": "for c = 0: frequencies: m ω² = k",
    "m s = F   (belt taut, sliding forward)": "belt taut, sliding forward: m s = F",
    "once the speed is steady: F v = E": "in the steady state: F v = E",
    "Solving both equations, after the blow: v = u": "after the blow: v = u",
    "skidding: the friction eats energy, T' = P": "skidding, the friction eats energy: T' = P",
    "rear wheel in the air, ΣF_x: F = m a": "while rear wheel is in the air: ΣF_x: F = m a",
    "at every instant F = k x": "F = k x",
    "wheel held: F = k x": "if wheel held: F = k x",
    "check: if m = 0, F = k x": "if m = 0: F = k x",
    "top of the slice's flight: z = h": "at the highest point of the slice, after lift-off: z = h",
    "rod passing θ = 0 for the first time, ↑: A = W": "when θ = 0, from the start: A = W",
    "cart in motion, rod ΣM_A: J α = −W": "while the cart moves: rod ΣM_A: J α = −W",
    "if θ and φ are small: J = k": "for small θ, φ: J = k",
    "small oscillations about θ = π: ω² = k/J": "as θ -> π: ω² = k/J",
    "mast standing still at θ = 0: N = W": "in equilibrium, θ = 0: N = W",
    "when the speed no longer changes: F = W": "in the steady state: F = W",
}
AS_THEY_STAND = (
    "v = r ω",
    "ΣM_O: F r = J α",
    "wheel: F = m a",
    "at θ = 0: F = m g",
    "E = T + V",
    "F = m g cos θ, N = 0",
    "x' = u with u = a t",
)


@pytest.mark.parametrize("text", ARRANGED)
def test_conditions_come_first(text):
    assert plainly(text, KNOWN, (), BODIES)[0].strip() == ARRANGED[text]


@pytest.mark.parametrize("text", AS_THEY_STAND)
def test_what_has_one_clause_stays(text):
    assert plainly(text, KNOWN, (), BODIES)[0] == text

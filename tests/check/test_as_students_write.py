"""Notation of exercise sheets: labels, conditions in words, usual letters, LaTeX; each statement's verdict was written down by hand."""

from __future__ import annotations

import pytest

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism
from freebody.symbolic.errors import StatementError

T, W, IF, D = Kind.TRUE, Kind.WRONG, Kind.TRUE_IF, Kind.DIMENSIONS

# a uniform rod that swings about its end O, let go at rest; θ from the vertical, B its free end
ROD = """
freebody: 1
parameters: {m: 2 kg, L: 1 m, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {shape: rod, length: L, mass: m, points: {B: [L/2, 0]}}}
joints: {O: {type: hinge, of: [ground.O, rod.start], coordinate: {name: θ, zero: down}}}
initial: {θ: 0.5, at_rest: true}
"""
# a block on a spring, let go at rest where the spring is drawn out
BLOCK = """
freebody: 1
parameters: {m: 2 kg, k: 50 N/m, d: 0.1 m}
gravity: none
bodies: {block: {shape: particle, mass: m}}
joints: {track: {type: slot, along: {through: ground.O, angle: 0}, point: block.centre, coordinate: x}}
forces: {spring: {type: spring, along: x, stiffness: k}}
initial: {x: d, at_rest: true}
"""
# two rods one behind the other, each with letters at its ends
TWO = """
freebody: 1
parameters: {m: 2 kg, L: 1 m, b: 0.7 m, g: 9.81 m/s^2}
gravity: g
bodies:
  first: {shape: rod, length: L, mass: m, points: {A: [-L/2, 0], B: [L/2, 0]}}
  second: {shape: rod, length: b, mass: m, points: {C: [b/2, 0]}}
joints:
  O: {type: hinge, of: [ground.O, first.A], coordinate: θ}
  elbow: {type: hinge, of: [first.B, second.start], coordinate: φ}
initial: {θ: 0.5, φ: 0.2, at_rest: true}
"""
MODELS = {"rod": ROD, "block": BLOCK, "two": TWO}

SAID = {
    "rod": [
        (r"ΣM_O = I_O α: -m g L/2 sin θ = 1/3 m L² α", T),
        (r"\sum M_O = I_O \alpha", T),
        (r"\sum F_x: O_x = m a_{Gx}", T),
        (r"ΣF_y = m a_{Gy}: O_y - m g = m a_{Gy}", T),
        (r"ΣF_y = m a_{Gy}: O_y + m g = m a_{Gy}", W),
        ("O_y = m g + m L/2 (α sin θ + ω² cos θ)", T),
        ("at rest: O_y = m g + m (L/2) α sin θ", T),
        ("O_y = m g + m (L/2) α sin θ", W),
        ("at θ = 0: O_y = m g + m (L/2) ω²", T),
        ("at θ = 0: O_y = m g", W),
        ("O_y = m g + m (L/2) ω² when θ = 0", T),
        ("when θ = 0: α = 0", T),
        ("at t = 0: ω = 0", T),
        ("at t = 0: α = 0", W),
        ("initially: ω = 0", T),
        (r"a_{Gx} = (L/2)(α cos θ - ω² sin θ)", T),
        (r"a_{Gx} = (L/2)(α cos θ + ω² sin θ)", W),
        (r"m\ddot x_G = O_x", T),
        (r"m\ddot{x}_G = O_x", T),
        (r"\vec v_B = \vec\omega", D),
        (r"\vec v_B = L ω (cos θ \hat i + sin θ \hat j)", T),
        (r"v_{Bx} = L ω cos θ", T),
        ("½ I_O ω² - m g (L/2) cos θ = constant", T),
        ("E = T + V = const", T),
        (r"T + V = \text{const}", T),
        ("T - V is constant", W),
        ("E is conserved", T),
        ("ΔT + ΔV = 0", T),
        (r"\Delta T + \Delta V = 0", T),
        ("ΔT - ΔV = 0", W),
        ("ΔT + V = 0", None),
        ("T = 1/6 m L² ω²", T),
        ("T = 1/24 m L² ω²", W),
        ("ω² = (3g/L)(cos θ - cos θ₀)", T),
        (r"\omega^2 = \frac{6g}{L}(\cos\theta - \cos\theta_0)", W),
        (r"\boxed{\ddot\theta = -\frac{3g}{2L}\sin\theta}", T),
        (r"I_O \alpha = -m g \frac{L}{2} \sin\theta \Rightarrow \alpha = -\frac{3g}{2L}\sin\theta", T),
        (r"I_O α = -m g (L/2) sin θ ⇒ α = -3g/(L) sin θ", W),
        (r"\ddot\theta \approx -\frac{3g}{2L}\theta", IF),
        ("for small θ: θ'' = -(3g/2L) θ", T),
        ("for small θ: θ'' = -(3g/L) θ", W),
        ("θ'' = -(3g/2L) sin θ", T),
        ("ω dω/dθ = -3g/(2L) sin θ", T),
        ("ω dω/dθ = -3g/L sin θ", W),
        ("I_O = I_G + m (L/2)²", T),
        ("I_O = I_G + m L²", W),
        ("I_G = 1/12 m L²", T),
        ("after the start: ω = 0", None),
    ],
    "block": [
        ("v dv/dx = -k x/m", T),
        ("v dv/dx = -2 k x/m", W),
        ("a = -(k/m) x", T),
        ("½ m v² + ½ k x² = ½ k x₀²", T),
        ("½ m v² + ½ k x² = k x₀²", W),
        ("½ m v² + ½ k x² = const.", T),
        ("x = x_0 cos ω t where ω = sqrt(k/m)", T),
        (r"x = x_0 \cos \omega t \text{ with } \omega = \sqrt{k/m}", T),
        ("x = d cos(sqrt(k/m) t)", T),
    ],
    "two": [
        ("ω_AB = θ'", T),
        (r"v_C = v_B + b (ω_AB + φ') (-sin(θ + φ) i + cos(θ + φ) j)", T),
        ("α = θ''", None),  # of which rod?
        ("I_O θ'' k = 0", W),  # k is no vector whose size is meant
        ("I_O = 1/3 m L²", T),
    ],
}  # fmt: skip


@pytest.fixture(scope="module")
def checkers() -> dict[str, Checker]:
    return {name: Checker(Mechanism.loads(text)) for name, text in MODELS.items()}


@pytest.mark.parametrize(("model", "said", "kind"), [(model, *each) for model, several in SAID.items() for each in several])
def test_statements_are_read_as_they_are_meant(checkers: dict[str, Checker], model: str, said: str, kind: Kind | None) -> None:
    """``None``: it cannot be read, and that is said."""
    if kind is None:
        with pytest.raises(StatementError):
            checkers[model].check(said, correcting=False)
    else:
        verdict = checkers[model].check(said, correcting=kind is IF)
        assert verdict.kind is kind, str(verdict)

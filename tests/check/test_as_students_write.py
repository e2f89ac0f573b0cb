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
# a uniform rod let go level, θ clockwise from there
LEVEL = """
freebody: 1
parameters: {m: 2 kg, L: 1 m, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {shape: rod, length: L, mass: m}}
joints: {O: {type: hinge, of: [ground.O, rod.start], coordinate: {name: θ, sense: clockwise}}}
initial: {θ: 0, at_rest: true}
"""
# a collar that slides on a turning bar
COLLAR = """
freebody: 1
parameters: {m: 1 kg, J: 0.2 kg*m^2, k: 60 N/m, d: 0.25 m, Q: 2 N*m}
gravity: none
bodies: {bar: {mass: 0, inertia: J, lines: {rail: {through: origin, angle: 0}}}, collar: {shape: particle, mass: m}}
joints:
  axle: {type: hinge, of: [ground.O, bar.origin], coordinate: θ}
  rail: {type: slot, point: collar.centre, along: bar.rail, coordinate: r}
forces:
  spring: {type: spring, along: r, stiffness: k, rest_length: d}
  motor: {type: torque, on: bar, from: ground, value: Q}
initial: {θ: 0, r: 0.4 m, rates: {θ: 2, r: 0.3 m/s}}
"""
# two drums that roll on each other
GEARS = """
freebody: 1
parameters: {M: 6 N*m, r1: 0.1 m, r2: 0.25 m, I1: 0.01 kg*m^2, I2: 0.2 kg*m^2}
gravity: none
ground: {points: {B: [r1 + r2, 0]}}
bodies: {small: {mass: 0, inertia: I1}, large: {mass: 0, inertia: I2}}
joints:
  A: {type: hinge, of: [ground.O, small.origin], coordinate: φ1}
  C: {type: hinge, of: [ground.B, large.origin], coordinate: {name: φ2, sense: clockwise}}
  teeth: {type: gear, of: [small.origin, large.origin], radii: [r1, r2]}
forces: {motor: {type: torque, on: small, from: ground, value: M}}
initial: {φ1: 0, φ2: 0, at_rest: true}
"""
# a bar that a lump of clay strikes and sticks to
STRUCK = """
freebody: 1
parameters: {M: 4 kg, m: 0.5 kg, L: 1 m, b: 0.7 m, v: 12 m/s, g: 9.81 m/s^2}
gravity: g
bodies: {bar: {shape: rod, length: L, mass: M}, clay: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, bar.start], coordinate: {name: θ, zero: down}}
  flight: {type: free, of: [ground.O, clay.centre], coordinates: [x, y]}
events: {hit: {at: start, then: {weld: [bar, clay]}}}
initial: {θ: 0, x: 0, y: -b, rates: {θ: 0, x: v, y: 0}}
"""
# a body on two springs that the weight presses together at rest, let go level
CAR = """
freebody: 1
parameters: {m: 1200 kg, J: 1500 kg*m^2, a: 1.1 m, b: 1.5 m, k1: 35 kN/m, k2: 30 kN/m, g: 9.81 m/s^2, d1: m*g*b/(k1*(a + b)), d2: m*g*a/(k2*(a + b)), y0: 0.07 m}
gravity: g
bodies: {car: {mass: m, inertia: J, points: {F: [a, 0], R: [-b, 0]}}}
joints: {guide: {type: slot, along: {through: ground.O, angle: 90 deg}, point: car.G, coordinates: [y, {name: θ, absolute: true}]}}
gauges: {front: y(car.F), rear: y(car.R)}
forces:
  s1: {type: spring, along: front, stiffness: k1, rest_length: d1}
  s2: {type: spring, along: rear, stiffness: k2, rest_length: d2}
initial: {y: y0, θ: 0, at_rest: true}
"""
# a crank that is turned evenly, and rocks an arm against dry friction
WIPER = """
freebody: 1
parameters: {r: 30 mm, l: 300 mm, c: 60 mm, d: 310 mm, I: 0.03 kg*m^2, R: 1.7 N*m, Ω: 5 rad/s}
gravity: none
ground: {points: {D: [d, 0]}}
bodies: {crank: {mass: 0, inertia: 0, points: {A: [r, 0]}}, arm: {mass: 0, inertia: I, points: {B: [c, 0]}}}
joints:
  shaft: {type: hinge, of: [ground.O, crank.origin], coordinate: φ}
  spindle: {type: hinge, of: [ground.D, arm.origin], coordinate: ψ}
  rod: {type: link, of: [crank.A, arm.B], length: l}
gauges: {β: "direction(crank.A, arm.B)"}
motions: {motor: {of: φ, is: Ω, level: velocity}}
forces: {glass: {type: torque, on: arm, value: -R*sign(rate(ψ))}}
initial: {φ: 50 deg, guess: {ψ: 100 deg}}
"""
# a stepladder on a smooth floor, whose cord is cut at the start
LADDER = """
freebody: 1
parameters: {l: 2.3 m, M: 5 kg, b: 0.8 m, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}}}
bodies:
  left: {shape: rod, length: l, mass: M, points: {D: [b - l/2, 0]}}
  right: {shape: rod, length: l, mass: M, points: {D: [b - l/2, 0]}}
joints:
  A: {type: slot, along: ground.floor, point: left.start, coordinates: [x, θ]}
  B: {type: slot, along: ground.floor, point: right.start, coordinates: [u, {name: ψ, zero: left, sense: clockwise}]}
  top: {type: hinge, of: [left.end, right.end]}
strings: {cord: {ends: [left.D, right.D]}}
initial: {θ: 68 deg, x: 0, at_rest: true, guess: {u: 1.7 m, ψ: 68 deg}}
events: {snip: {at: start, then: {cut: cord}}}
"""
# a spinning tyre that is set down on a slope
TYRE = """
freebody: 1
parameters: {m: 9 kg, r: 0.3 m, k: 0.27 m, β: 17 deg, μ: 0.6, w: 34 rad/s, g: 9.81 m/s^2}
gravity: [-g*sin(β), -g*cos(β)]
ground: {lines: {slope: {through: O, angle: 0}}}
bodies: {tyre: {shape: ring, radius: r, mass: m, inertia: m*k^2}}
joints: {plane: {type: free, of: [ground.O, tyre.centre], coordinates: [x, y, {name: φ, sense: clockwise}]}}
contacts: {road: {of: [tyre, ground.slope], friction: μ}}
initial: {x: 0, y: r, φ: 0, rates: {x: 0, y: 0, φ: w}}
run: {until: 2.2 s}
"""
MODELS = {
    "rod": ROD,
    "block": BLOCK,
    "two": TWO,
    "level": LEVEL,
    "collar": COLLAR,
    "gears": GEARS,
    "struck": STRUCK,
    "car": CAR,
    "wiper": WIPER,
    "ladder": LADDER,
    "tyre": TYRE,
}

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
        ("Energy: T + V = const.", T),
        ("conservation of energy: T + V = const", T),
        ("T + V, everything: T - V = const", W),
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
        ("2 m s'' = O_y − 2 m g where s = centre_y()", T),
        ("2 m s'' = O_y − m g where s = centre_y()", W),
        ("ω_AB = θ'", T),
        (r"v_C = v_B + b (ω_AB + φ') (-sin(θ + φ) i + cos(θ + φ) j)", T),
        ("α = θ''", None),  # of which rod?
        ("I_O θ'' k = 0", W),  # k is no vector whose size is meant
        ("I_O = 1/3 m L²", T),
    ],
    "level": [
        (r"\omega^2 = \frac{3 g}{L}\sin\theta", T),
        (r"\omega^2 = \frac{3 g}{2L}\sin\theta", W),
        (r"T_1 + U_{1-2} = T_2 \Rightarrow 0 + m g \frac{L}{2}\sin\theta = \frac12\left(\frac13 m L^2\right)\omega^2", T),
        ("T_1 + V_1 = T_2 + V_2: 0 + 0 = 1/6 m L² ω² − m g (L/2) sin θ", T),
        ("T_1 + V_1 = T_2 + V_2: 0 + 0 = 1/6 m L² ω² + m g (L/2) sin θ", W),
        ("I_O α = r_G × m g: I_O α = m g (L/2) cos θ", T),
        (r"\circlearrowright\!+\ \Sigma M_O = I_O\alpha:\quad mg\tfrac{L}{2}\cos\theta = \tfrac13 mL^2\ddot\theta", T),
        (r"at \theta = 0^+:\quad \alpha = \tfrac{3g}{2L}", T),
        ("at t = 0+: O_y = m g/4", T),
        ("at t = 0+: O_y = m g/2", W),
        ("at the bottom (θ = 90°): O_y = 5/2 m g", T),
        ("at the bottom (θ = 90°): O_y = 3/2 m g", W),
        (r"a_n = \frac{L}{2}\omega^2,\quad a_t = \frac{L}{2}\alpha", T),
        ("ω_max = √(3 g/L)", T),
        (r"\omega_{\max}^2 = 3g/(2L)", W),
        ("when θ = 90°: L ω = sqrt(3 g L) for the free end", T),
        ("½ I_O ω² = m g (L/2) sin θ (from rest)", T),
        ("L ω = -√(3 g L sin θ)", W),
        ("I_e = ⅓ m L²: I_e α = ½ m g L cos θ", T),
        ("I_e = ½ m L²: I_e α = ½ m g L cos θ", W),
    ],
    "collar": [
        ("a_r = r̈ − r θ̇²", T),
        ("a_r = r̈ + r θ̇²", W),
        (r"a_\theta = r\ddot\theta + 2\dot r\dot\theta", T),
        (r"a_\theta = r\ddot\theta + \dot r\dot\theta", W),
        ("½ J ω² + ½ m (r'² + r² ω²) + ½ k (r − d)² = const + Q θ", T),
        ("½ J ω² + ½ m (r'² + r² ω²) + ½ k (r − d)² = const − Q θ", W),
        ("(J + m r²) ω = ∫(Q) dt + (J + m r_0²) ω_0", T),
    ],
    "gears": [
        ("φ1'/φ2' = r2/r1 = n", T),
        ("φ1'/φ2' = r1/r2 = n", W),
        ("I_e = I1 + I2/n² with n = r2/r1: I_e φ1'' = M", T),
        ("M φ1 = ½ I1 ω_1² + ½ I2 ω_2²", T),
        ("M φ1 = ½ I1 ω_1² + I2 ω_2²", W),
        ("Δω_1 = M t/(I1 + I2 r1²/r2²)", T),
    ],
    "struck": [
        ("(H_O)_1 = (H_O)_2, just after the hit: m v b = (⅓ M L² + m b²) θ'", T),
        ("for small θ: ω_n² = (½ M L + m b) g/(⅓ M L² + m b²)", T),
        ("for small θ: ω_n² = (½ M L + m b) g/(⅓ M L²)", W),
        ("½ (⅓ M L² + m b²)(θ̇² − θ̇₀²) = −(½ M L + m b) g (1 − cos θ)", T),
        ("cos θ_max = 1 − (⅓ M L² + m b²) θ̇_0²/((M L + 2 m b) g)", T),
    ],
    "car": [
        ("if k1 a = k2 b, pitch: ω² = (k1 a² + k2 b²)/J", T),
        ("if k1 a = k2 b, pitch: ω² = (k1 a² + k2 b²)/(J + m a²)", W),
        ("if k1 a = k2 b, pure bounce has the period T = 2π √(m/(k1 + k2))", T),
        ("small vibrations, natural frequencies: (k1 + k2 − m ω²)(k1 a² + k2 b² − J ω²) = (k1 a − k2 b)²", T),
        ("in equilibrium: k1 (d1 − y − a sin θ) = m g b/(a + b)", T),
        ("in equilibrium: k1 (d1 − y − a sin θ) = m g a/(a + b)", W),
        ("let go at rest from y₀, θ = 0: m y'² + J θ'² + k1 (y + a sin θ)² + k2 (y − b sin θ)² = (k1 + k2) y₀²", T),
        ("let go at rest from y₀, θ = 0: m y'² + J θ'² + (k1 + k2) y² + (k1 a² + k2 b²) sin²θ = (k1 + k2) y₀²", W),
    ],
    "wiper": [
        ("stretched out (φ = β): (r + l)² = c² + d² + 2 c d cos ψ", T),
        ("folded back (φ = β + π): (l − r)² = c² + d² + 2 c d cos ψ", T),
        ("folded back (φ = β + π): (l − r)² = c² + d² − 2 c d cos ψ", W),
        ("on the way back, ψ' < 0, ΣM_D: I ψ'' = S c sin(ψ − β) + R where S = rod.tension", T),
        ("on the way back, ψ' < 0, ΣM_D: I ψ'' = S c sin(ψ − β) − R where S = rod.tension", W),
    ],
    "ladder": [
        ("before the cord is cut: cord.tension = M g l cot θ/(2 (l − b))", T),
        ("cord still whole: cord.tension = M g l cot θ/(2 b)", W),
    ],
    "tyre": [
        ("rolling (x' = r φ'): road.Fx = m g sin β k²/(r² + k²)", T),
        ("rolling (x' = r φ'): road.Fx = μ m g cos β", W),
        ("at the end of slipping: t = r w/(g (μ cos β (1 + r²/k²) − sin β))", T),
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

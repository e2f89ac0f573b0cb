"""Statics symbolically: what cannot move needs no acceleration, and the balances of textbooks give the reactions."""

from __future__ import annotations

import pytest
from models import tree

import freebody as fb
from freebody.document.blocks import Equation
from freebody.equations import evaluate, symbols, to_sympy
from freebody.symbolic.algebra import equal
from freebody.symbolic.tree import Sym

LADDER = """
freebody: 1
name: ladder on a rough floor at a smooth wall
parameters: {m: 10 kg, l: 4 m, mu: 0.3, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}, wall: {through: O, angle: -90 deg}}}
bodies: {ladder: {shape: rod, length: l, mass: m, points: {A: start, B: end}}}
joints: {pos: {type: free, of: [ground.O, ladder.A], coordinates: [x, y, phi]}}
contacts:
  foot: {of: [ladder.A, ground.floor], friction: mu}
  top: {of: [ladder.B, ground.wall]}
initial: {x: 2 m, y: 0, phi: 120 deg, at_rest: true}
"""
BEAM = """
freebody: 1
name: beam on two supports
parameters: {L: 4 m, a: 1 m, W: 500 N, T: 30 N*m, m: 20 kg, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {beam: {shape: rod, length: L, mass: m, points: {C: [a - L/2, 0]}}}
joints:
  A: {type: hinge, of: [ground.O, beam.start], coordinate: theta}
  B: {type: slot, along: ground.floor, point: beam.end}
forces:
  load: {type: force, at: beam.C, value: W, direction: -90 deg}
  couple: {type: torque, on: beam, value: T}
initial: {theta: 0}
"""
FRAME = """
freebody: 1
name: A-frame, loaded at its pin
parameters: {l: 2 m, h: 3 m, m: 20 kg, W: 300 N, g: 9.81 m/s^2}
gravity: g
ground: {points: {E: [l, 0]}}
bodies:
  left: {mass: m, inertia: 1 kg*m^2, points: {A: ["-l/4", "-h/2"], C: ["l/4", "h/2"]}}
  right: {mass: m, inertia: 1 kg*m^2, points: {B: ["l/4", "-h/2"], C: ["-l/4", "h/2"]}}
joints:
  A: {type: hinge, of: [ground.O, left.A], coordinate: alpha}
  C: {type: hinge, of: [left.C, right.C], coordinate: beta}
  B: {type: hinge, of: [ground.E, right.B]}
forces: {load: {type: force, at: left.C, x: 0, y: -W}}
initial: {alpha: 0, at_rest: true, guess: {beta: 0}}
"""
DOOR = """
freebody: 1
name: a door on two hinges, the upper one free to shift, seen from before it
parameters: {m: 30 kg, b: 0.9 m, h: 2 m, c: 0.2 m, g: 9.81 m/s^2}
gravity: g
ground: {lines: {post: {through: O, angle: 90 deg}}}
bodies:
  door: {shape: rectangle, width: b, height: h, mass: m, points: {L: ["-b/2", "-h/2 + c"], U: ["-b/2", "h/2 - c"]}}
joints:
  lower: {type: hinge, of: [ground.O, door.L], coordinate: theta}
  upper: {type: slot, along: ground.post, point: door.U}
initial: {theta: 0}
"""
BLOCK = """
freebody: 1
name: block that friction holds on a slope
parameters: {m: 2 kg, alpha: 20 deg, F: 3 N, g: 9.81 m/s^2}
gravity: g
ground: {lines: {slope: {through: O, angle: alpha}}}
bodies: {block: {shape: particle, mass: m}}
contacts: {slope: {of: [block, ground.slope], friction: 0.8}}
forces: {push: {type: force, at: block.centre, value: F, direction: alpha}}
initial: {at_rest: true}
"""
CANTILEVER = """
freebody: 1
name: cantilever
parameters: {L: 4 m, m: 5 kg, W: 50 N, g: 9.81 m/s^2}
gravity: g
bodies: {beam: {shape: rod, length: L, mass: m}}
joints: {A: {type: weld, of: [ground.O, beam.start]}}
forces: {load: {type: force, at: beam.end, y: -W}}
"""

# By one or two moment balances each, as in Meriam & Kraige, Statics, chs. 3, 4 and 6. A reaction acts on the second body of a
# joint or contact, so the wall gets what the ladder presses on it, to the left, with φ in the second quadrant.
CLOSED = {
    "ladder": (
        LADDER,
        {"foot.T": "m*g*cos(phi)/(2*sin(phi))", "top.N": "-m*g*cos(phi)/(2*sin(phi))", "foot.N": "m*g"},
        "m g phi",
    ),
    "beam": (BEAM, {"A.Fy": "W*(L - a)/L + m*g/2 + T/L", "B.Fn": "W*a/L + m*g/2 - T/L", "A.Fx": "0"}, "W L a m g T"),
    "A-frame": (
        FRAME,
        {"A.Fx": "(m*g + W)*l/(4*h)", "A.Fy": "m*g + W/2", "B.Fy": "m*g + W/2", "C.Fx": "(m*g + W)*l/(4*h)", "C.Fy": "-W/2"},
        "m g W l h",
    ),
    "door": (DOOR, {"lower.Fx": "m*g*b/(2*(h - 2*c))", "lower.Fy": "m*g", "upper.Fn": "m*g*b/(2*(h - 2*c))"}, "m g b h c"),
    "block": (BLOCK, {"slope.N": "m*g*cos(alpha)", "slope.T": "m*g*sin(alpha) - F"}, "m g alpha F"),
    "cantilever": (CANTILEVER, {"A.Fx": "0", "A.Fy": "m*g + W", "A.M": "m*g*L/2 + W*L"}, "m g W L"),
}


@pytest.mark.parametrize("name", CLOSED)
def test_reactions(name: str) -> None:
    text, wanted, letters = CLOSED[name]
    answers = fb.Mechanism.loads(text).solve_in_letters(list(wanted))
    for what, form in wanted.items():
        assert equal(answers[what], tree(form, letters)), f"{what}: {to_sympy(answers[what])}"
    stated = [side for block in answers.blocks if isinstance(block, Equation) for side in (block.left, block.right)]
    assert stated and not any(x.dots for x in symbols(*stated)), "no acceleration or rate stands in statics"


def test_what_stands_still_is_said_and_has_no_acceleration() -> None:
    """Of the frame both angles, and where they are; the floor holds the ladder's foot at y = 0, x and φ are as it is put."""
    frame, ladder = fb.Mechanism.loads(FRAME), fb.Mechanism.loads(LADDER)
    assert "Nothing can move: α, β stand still, with α = 0, β = 0." in str(frame.solve_in_letters(["A.Fy"]))
    answers = ladder.solve_in_letters(["foot.N", "phi"])
    assert "x, y, φ stand still, with y = 0." in str(answers) and evaluate(answers["phi"], {}) == 0


def test_what_moves_does_not_stand_still() -> None:
    """The ladder on a smooth floor slides: only its foot stays on the floor."""
    sliding = fb.Mechanism.loads(LADDER.replace("friction: mu", "friction: 0")).solve_in_letters(["foot.N"])
    assert "What cannot move: y stands still" in str(sliding) and Sym("phi") in symbols(sliding["foot.N"])


SLIDER = """
freebody: 1
name: block in a guide with friction
parameters: {m: 2 kg, alpha: 30 deg, mu: 0.2, g: 9.81 m/s^2}
gravity: g
ground: {lines: {slope: {through: O, angle: -alpha}}}
bodies:
  block: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: m, points: {B: [0, -0.1]}, lines: {base: {through: B, angle: 0}}}
joints: {guide: {type: slider, along: ground.slope, line: block.base, coordinate: s, friction: mu}}
initial: {s: 0, rates: {s: 0.1}}
"""


def test_a_guide_that_rubs() -> None:
    """s̈ = g (sin α − μ cos α) while it slides down. Meriam & Kraige, Dynamics, ch. 3."""
    answers = fb.Mechanism.loads(SLIDER).solve_in_letters(["s", "guide.Fn"])
    assert equal(answers["s"], tree("g*(sin(alpha) - mu*cos(alpha))", "g alpha mu"))
    assert equal(answers["guide.Fn"], tree("m*g*cos(alpha)", "m g alpha")) and answers.checked > 1
    assert [str(answers).count(f"({i})") for i in (1, 2, 3)] == [1, 1, 0]


def test_angles_of_lines_stay_symbols() -> None:
    """A mass on a face at γ of a cart that is driven up a ramp: N = m (g cos γ − a₀ sin(γ − ramp)), by the balance across the face."""
    from models import system

    answers = system("19.3.14").solve_in_letters(["top.N"])
    assert equal(answers["top.N"], tree("m*(g*cos(gamma) - a0*sin(gamma - ramp))", "m g gamma ramp a0"))


def test_an_answer_is_derived_once() -> None:
    """The friction of a rolling disk takes its acceleration as found: no second balance with it, no number twice."""
    rolling = """
freebody: 1
name: disk on a slope
parameters: {m: 2 kg, r: 0.3 m, alpha: 20 deg, g: 9.81 m/s^2}
gravity: g
ground: {lines: {slope: {through: O, angle: -alpha}}}
bodies: {disk: {shape: disk, radius: r, mass: m}}
joints: {roll: {type: rolling, circle: {centre: disk.centre, radius: r}, on: ground.slope, coordinate: s}}
initial: {s: 0}
"""
    answers = fb.Mechanism.loads(rolling).solve_in_letters(["s", "roll.Fs"], limits={"alpha": 0, "r": "inf"})
    stated = str(answers)
    assert equal(answers["s"], tree("2*g*sin(alpha)/3", "g alpha")) and "With s̈ as above" in stated
    assert stated.count("α → 0:") == 1 and stated.count("r → ∞:") == 1 and stated.count("(1)") == 1


def test_what_is_unknown_is_named_with_the_coordinates() -> None:
    with pytest.raises(KeyError) as refused:
        fb.Mechanism.loads(SLIDER).solve_in_letters(["q"])
    assert str(refused.value).startswith("'q' is no coordinate") and "there are s, guide.Fn" in str(refused.value)

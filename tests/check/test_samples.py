"""What true motions are sampled: works are of motions from the start, places stay on the start's side of every distance."""

from __future__ import annotations

import numpy as np
import pytest
from books import Book

from freebody.catalogue import model_file
from freebody.check import Checker, Kind
from freebody.check.hypotheses import SMALL, family
from freebody.mechanism import Mechanism

T, W, IF = Kind.TRUE, Kind.WRONG, Kind.TRUE_IF

# Each drives with a constant force or couple along its first coordinate q, which starts at 0: W = value q. `E` at rest is 0.
_DRIVEN = {
    "disk on a motor": """
bodies: {d: {shape: disk, radius: 1 m, mass: 2 kg}}
joints: {pin: {type: hinge, of: [ground.O, d.centre], coordinate: q}}
forces: {drive: {type: torque, on: d, from: ground, value: 3 N*m}}
""",
    "cart that is pulled": """
parameters: {F: 2 N, m: 0.7 kg}
bodies: {cart: {shape: particle, mass: m}}
joints: {track: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: q}}
forces: {drive: {type: force, at: cart.centre, value: F, direction: 0}}
""",
    "bead on a turning rod": """
parameters: {T: 1 N*m, m: 0.2 kg, l: 1 m}
bodies: {rod: {shape: rod, length: l, mass: m}, bead: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, rod.start], coordinate: q}
  along: {type: slot, along: [rod.start, rod.end], point: bead.centre, coordinate: r}
forces: {drive: {type: torque, on: rod, from: ground, value: T}}
""",
}


def _driven(name: str) -> Checker:
    start = "r: 0.3 m, " if "bead" in name else ""
    text = f"freebody: 1\ngravity: none\n{_DRIVEN[name]}\ninitial: {{q: 0, {start}at_rest: true}}\nrun: {{until: 1 s}}\n"
    return Checker(Mechanism.loads(text), {"W": "drive.work"})


@pytest.mark.parametrize("name", _DRIVEN)
@pytest.mark.parametrize(
    ("statement", "kind"),
    [
        ("W = drive.value*q", T),
        ("W = energy()", T),
        ("drive.work = drive.value*q", T),
        ("W = 0", W),
        ("2 W = drive.value*q", W),
        ("energy() = drive.value*q", T),
        ("only if from the start: energy() = drive.value*q", T),
        ("at start: W = 0", T),
    ],
)
def test_work_is_of_a_motion_from_the_start(name: str, statement: str, kind: Kind) -> None:
    verdict = _driven(name).check(statement)
    assert verdict.kind is kind, str(verdict)


# A spring along the line on which its ends move: the equations of it hold on one side of the place where they meet.
_COLLINEAR = {
    "collar on a driven rod": ("m r'' - m r theta'^2 = k (l0 - r)", 0.4),
    "collar on a free rod": ("m r'' - m r theta'^2 = k (l0 - r)", -0.4),
    "collar beyond its anchor": ("m r'' - m r theta'^2 = k (l0 - (r - a))", 0.6),
}


@pytest.mark.parametrize("name", _COLLINEAR)
def test_places_stay_on_the_starts_side(name: str) -> None:
    equation, start = _COLLINEAR[name]
    text = f"""
freebody: 1
gravity: none
parameters: {{w: 4 rad/s, k: 50 N/m, m: 2 kg, l0: 0.3 m, a: 0.2 m}}
bodies:
  rod: {{shape: rod, length: 1 m, mass: m, points: {{A: [a - 0.5 m, 0]}}}}
  collar: {{shape: particle, mass: m}}
joints:
  O: {{type: hinge, of: [ground.O, rod.start], coordinate: theta}}
  slide: {{type: slot, along: [rod.start, rod.end], point: collar.centre, coordinate: r}}
motions: {{{"drive: {of: theta, is: w*t}" if "driven" in name else ""}}}
forces:
  spring: {{type: spring, between: [{"rod.A" if "anchor" in name else "rod.start"}, collar.centre], stiffness: k, rest_length: l0}}
initial: {{r: {start} m}}
"""
    checker = Checker(Mechanism.loads(text))
    equation = equation if start > 0 else equation.replace("l0 - r", "-l0 - r")
    verdict = checker.check(equation)
    assert verdict.kind is T, str(verdict)
    turned = checker.check(equation.replace("l0", "(-l0)"))
    assert turned.kind is W, str(turned)


ABOVE = """
freebody: 1
parameters: {m: 1 kg, r: 0.1 m, h: 1 m}
bodies: {ball: {shape: disk, radius: r, mass: m}}
ground: {lines: {top: {through: ground.O, angle: 0}}}
joints: {place: {type: free, of: [ground.O, ball.centre], coordinates: [x, y, a]}}
contacts: {floor: {of: [ball, ground.top], friction: 0.3}}
initial: {x: 0, y: HEIGHT, a: 0}
"""


@pytest.mark.parametrize(
    ("height", "statement", "kind"),
    [
        ("h", "m y'' = -m g", T),
        ("h", "m y'' = floor.N - m g", Kind.UNDECIDABLE),  # the ball has not landed: nothing tells the factor of N
        ("h", "m y'' = 2 floor.N - m g", Kind.UNDECIDABLE),
        ("h", "floor.N = 0", Kind.UNDECIDABLE),
        ("h", "floor.gap = y - r", T),
        ("r", "m y'' = floor.N - m g", T),
        ("r", "m y'' = 2 floor.N - m g", W),
        ("r", "floor.N = 0", W),
    ],
)
def test_a_force_that_no_sample_has_decides_nothing(height: str, statement: str, kind: Kind) -> None:
    verdict = Checker(Mechanism.loads(ABOVE.replace("HEIGHT", height))).check(statement)
    assert verdict.kind is kind, str(verdict)


# What holds at the start stays so: a lock, a stop, a rough floor, a taut string, the sense of sliding. All else varies.
_HELD = {
    "a locked bead": """
parameters: {l: 0.7 m, m: 2 kg, M: 1.5 kg}
bodies: {rod: {shape: rod, length: l, mass: m}, bead: {shape: particle, mass: M}}
joints:
  O: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  along: {type: slot, along: [rod.start, rod.end], point: bead.centre, coordinate: r}
initial: {theta: -1.2, r: 0.3 m}
events: {hold: {at: start, then: {lock: r}}}
""",
    "a cart at a stop": """
parameters: {m: 2 kg, F: 4 N}
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
forces: {push: {type: force, at: cart.centre, x: -F, y: 0}}
stops: {end: {of: x, least: 0.1}}
initial: {x: 0.1 m}
""",
    "a disk on a rough slope": """
parameters: {m: 2 kg, r: 0.3 m, al: 0.2}
bodies: {w: {shape: disk, radius: r, mass: m}}
ground: {lines: {s: {through: ground.O, angle: -al}}}
joints: {f: {type: free, of: [ground.O, w.centre], coordinates: [x, y, phi]}}
contacts: {c: {of: [w, ground.s], rough: true}}
initial: {x: r*sin(al), y: r*cos(al), phi: 0, at_rest: true}
""",
    "two weights on a string": """
parameters: {m: 2 kg, M: 3 kg, h: 0.5 m}
ground: {points: {A: [0, 1], B: [1, 1]}}
bodies: {a: {shape: particle, mass: m}, b: {shape: particle, mass: M}}
joints:
  ja: {type: slot, along: {through: ground.A, angle: -90 deg}, point: a.centre, coordinate: p}
  jb: {type: slot, along: {through: ground.B, angle: -90 deg}, point: b.centre, coordinate: q}
strings: {s: {ends: [a.centre, b.centre], over: [ground.A, ground.B]}}
initial: {p: h, q: 0.7 m, at_rest: true}
""",
    "a block that is pushed over a rough bed": """
parameters: {m: 2 kg, mu: 0.2, F: 9 N}
bodies: {b: {mass: m}}
joints: {j: {type: slider, along: {through: ground.O, angle: 0}, line: {through: b.origin, angle: 0}, coordinate: s, friction: mu}}
forces: {push: {type: force, at: b.origin, x: F, y: 0}}
initial: {s: 0, at_rest: true}
""",
}  # fmt: skip
_OF_HELD = [
    ("a locked bead", {"r' = 0": T, "r = 0.3 m": W, "θ = -1.2": W, "θ' = 0": W, "(m l^2/3 + M r^2) θ'' = -(m l/2 + M r) g cos θ": T,
                       "(m l^2/3 + 0.09 M) θ'' = -(m l/2 + 0.3 M) g cos θ": W}),
    ("a cart at a stop", {"end.N = F": T, "end.N = 4 N": W, "end.N = 2 F": W, "x = 0.1 m": T, "m x'' = 0": T}),
    ("a disk on a rough slope", {"φ'' = -2/3 g sin(al)/r": T, "x' = -r φ' cos(al)": T, "x' = 0": W, "φ' = 0": W, "y = r cos(al)": W,
                                 "abs(c.T) = m g sin(al)/3": T, "abs(c.T) = m g sin(al)/2": W}),
    ("two weights on a string", {"s.tension = 2 m M g/(m+M)": T, "p' + q' = 0": T, "p' = 0": W, "p = h": W, "p + q = h + 0.7 m": W}),
    ("a block that is pushed over a rough bed", {"m s'' = F - mu m g": T, "m s'' = F": W, "s' = 0": W, "s = 0": W, "F > mu m g": W,
                                                 "abs(j.friction) = mu m g": T}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "statement", "kind"), [(name, *each) for name, of in _OF_HELD for each in of.items()])
def test_nothing_is_true_since_it_was_not_varied(name: str, statement: str, kind: Kind) -> None:
    verdict = Checker(Mechanism.loads(f"freebody: 1\n{_HELD[name]}")).check(statement, correcting=False)
    assert verdict.kind is kind, str(verdict)


_HANGING = """
freebody: 1
parameters: {m: 2 kg, k: 80 N/m, c: 3 N*s/m, g: 9.81 m/s^2}
gravity: g
ground: {lines: {plumb: {through: O, angle: 90 deg}}}
bodies: {bob: {shape: particle, mass: m}}
joints: {way: {type: slot, along: ground.plumb, point: bob.centre, coordinate: y}}
forces: {spring: {type: spring, along: y, stiffness: k, damping: c}}
initial: {y: -m*g/k, at_rest: true}
run: {until: 1 s}
"""


@pytest.mark.parametrize(("statement", "kind"), [
    ("m y'' + c y' + k y + m g = 0", T), ("m y'' + k y + m g = 0", W), ("m y'' + 2 c y' + k y + m g = 0", W),
])  # fmt: skip
def test_a_start_in_equilibrium_hides_no_damping(statement, kind):
    """There accelerations are round-off, by which no rates are measured."""
    verdict = Checker(Mechanism.loads(_HANGING), {}).check(statement)
    assert verdict.kind is kind
    assert kind is not IF or "at rest" in verdict.assumption or "c = 0" in verdict.assumption


def test_a_motion_from_the_start_ends_where_something_switches():
    box = Mechanism.loads("""
freebody: 1
parameters: {m: 1 kg, h: 1 m}
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {ball: {shape: disk, radius: 0.1 m, mass: m}}
joints: {free: {type: free, of: [ground.O, ball.centre], coordinates: [x, y, phi]}}
contacts: {floor: {of: [ball, ground.floor], restitution: 0.5}}
initial: {y: h, at_rest: true}
run: {until: 1 s}
""")
    assert box.check("if the start is at rest: constant: energy()").kind is T
    bounced = box.check("constant: energy()")
    assert bounced.kind is W
    assert "impact floor" in str(bounced)


_SIDES = {
    # two prisms on smooth ground, by the balance of momentum along it; elsewhere their upright faces touch, and neither pushes
    "prisms": ("19.3.13", {"A": "ax(lower.G)", "N": "slope.N"}, ("A = -g sin(alpha) cos(alpha)/(n + sin(alpha)^2)", "N = 0")),
    # two blocks on a cable over a pulley; beyond it each would move to the other side
    "cable": ("19.3.21", {}, ("(m1 + m2) x2'' = m2 g sin(alpha2) - m1 g sin(alpha1)", "x1'' = x2''")),
    # a rocker on its round foot, small swings about the upright
    "rocker": (
        "19.3.29",
        {},
        ("limit: (L^2/12 + (R + d)^2) phi'' = g d phi as phi -> 0", "limit: (L^2/12 + d^2) phi'' = g d phi as phi -> 0"),
    ),
    # the same as it lies
    "lying": (
        "19.3.29",
        {},
        (
            "if phi = pi/2: (L^2/12 + R^2 + d^2) phi'' - R d phi'^2 = g d",
            "if phi = pi/2: (L^2/12 + R^2 + d^2) phi'' + R d phi'^2 = g d",
        ),
    ),
}


@pytest.mark.parametrize("name", _SIDES)
def test_what_touches_or_is_taut_is_as_at_the_start(name: str) -> None:
    system, letters, (right, wrong) = _SIDES[name]
    checker = Checker(Mechanism.load(model_file(f"{system}/model")), letters)
    assert checker.check(right, correcting=False).kind is T
    assert checker.check(wrong, correcting=False).kind is W


@pytest.mark.parametrize(
    ("name", "angles"), [("rola_bola", "θ φ"), ("hinged_deck", "θ φ"), ("wheelset_hunting", "y ψ"), ("slewing_crane", "u w ψ")]
)
def test_what_is_small_is_so_with_its_rate_in_every_motion(name, angles):
    """In loops one rate may be arranged at the cost of another."""
    checker = Book(name).checker
    case = checker.case(f"{angles.split()[0]} = 0", None, family(", ".join(f"{n} -> 0" for n in angles.split()), checker, {}))
    values, sampler = case.values(), checker.sampler
    for angle in angles.split():
        size = 20 * SMALL * sampler.size_of(angle, sampler.first)
        assert np.abs(values[angle]).max() < size and np.abs(values[f"{angle}dot"]).max() < size * sampler.rate

"""Of which moment a statement is: what is cut, locked or engaged in the course of a motion stands in its equations from then on."""

from __future__ import annotations

import pytest

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism
from freebody.symbolic.errors import StatementError

T, W = Kind.TRUE, Kind.WRONG
BAR = """
parameters: {L: 1.2 m, m: 5 kg, h: 0.8 m}
ground: {points: {C: [0, 0], D: [L, 0]}}
bodies: {bar: {shape: rod, length: L, mass: m}}
strings: {AC: {ends: [ground.C, bar.start]}, BD: {ends: [ground.D, bar.end]}}
initial: {points: {bar.start: [0, -h], bar.end: [L, -h]}, at_rest: true}
events: {cutting: {at: start, then: {cut: BD}}}
"""
ROD = """
parameters: {l: 0.7 m, m: 2 kg, M: 1.5 kg}
bodies: {rod: {shape: rod, length: l, mass: m}, bead: {shape: particle, mass: M}}
joints:
  O: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  along: {type: slot, along: [rod.start, rod.end], point: bead.centre, coordinate: r}
initial: {theta: -1.2, r: 0.3 m}
events: {hold: {at: start, then: {lock: r}}, drop: {at: 0.2 s, then: {unlock: r}}}
"""
SPRING = """
parameters: {k: 40 N/m, m: 2 kg, c: 0.3 m}
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
forces: {buffer: {type: spring, along: x - c, stiffness: k, engaged: false}}
initial: {x: 0, rates: {x: 1}}
events: {reached: {when: x - c, then: {engage: buffer}}}
"""
BALL = """
parameters: {m: 0.5 kg, h: 2 m, e: 0.8, V: 1.5 m/s, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}}}
bodies: {ball: {shape: particle, mass: m}}
joints: {free: {type: free, of: [ground.O, ball.centre], coordinates: [x, y]}}
contacts: {floor: {of: [ball, ground.floor], restitution: e}}
initial: {y: h, rates: {x: V, y: 0}}
"""
LETTERS = {"v_1": "-vy(ball.G) @ before floor", "v_2": "vy(ball.G) @ floor", "d": "x @ floor", "s": "x @ 0.1 s"}
"""Of moments of the motion, each with a mechanics that holds for them in closed form."""
HELD = "(m l^2/3 + M r^2) θ'' = -(m l/2 + M r) g cos θ"
FREE = "r'' = r θ'^2 - g sin θ"
STATED = [
    (BAR, "if at the start: AC.tension = m g/2", {"before": "cutting"}, T),
    (BAR, "if at the start: AC.tension = m g/2", {"before": "start"}, T),
    (BAR, "if at the start: AC.tension = m g/2", {"after": "cutting"}, W),
    (BAR, "if at the start: AC.tension = m g/4", {"after": "cutting"}, T),
    (BAR, "if at the start: AC.tension = m g/4", {}, T),
    (BAR, "if at the start: BD.tension = AC.tension", {"before": "cutting"}, T),
    (ROD, HELD, {}, T),
    (ROD, HELD, {"before": "hold"}, W),
    (ROD, HELD, {"before": "drop"}, T),
    (ROD, HELD, {"after": "drop"}, W),
    (ROD, FREE, {}, W),
    (ROD, FREE, {"before": "hold"}, T),
    (ROD, FREE, {"at": "0.1 s"}, W),
    (ROD, FREE, {"at": 0.25}, T),
    (SPRING, "m x'' = 0", {}, T),
    (SPRING, "m x'' = 0", {"at": "0.2 s"}, T),
    (SPRING, "m x'' = -k (x - c)", {"after": "reached"}, T),
    (SPRING, "m x'' = k (x - c)", {"after": "reached"}, W),
    (SPRING, "m x'' = -k (x - c)", {"before": "reached"}, W),
    (SPRING, "m x'' = -k (x - c)", {"at": "0.5 s"}, T),
    (SPRING, "m x'' = -k (x - c)", {"at": "0.5 s", "k": "900 N/m"}, T),
]  # fmt: skip


@pytest.mark.parametrize(("model", "statement", "asked", "kind"), STATED)
def test_a_statement_is_of_the_moment_that_is_asked_for(model: str, statement: str, asked: dict, kind: Kind) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{model}run: {{until: 1 s}}\n")
    verdict = Checker(mechanism, **asked).check(statement, correcting=False)
    assert verdict.kind is kind, str(verdict)
    assert bool(verdict.moment) == (bool(asked) or model is not SPRING)
    if kind is T:
        assert mechanism.check(statement, **asked).ok


OF_LETTERS = [
    ("v_1^2 = 2 g h", T),
    ("v_1^2 = g h", W),
    ("v_2 = e v_1", T),
    ("v_2 = v_1/e", W),
    ("d = V √(2 h/g)", T),
    ("s = 0.1 V", T),
    ("s = 0.2 V", W),
    ("½ m v_1² = m g h", T),
    ("the impulse of the floor: m (v_1 + v_2) = m v_1 (1 + e)", T),
    ("after the bounce: y' ^2 = v_2^2 - 2 g y", T),
    ("after the bounce: y'^2 = v_1^2 - 2 g y", W),
    ("before the bounce: y'^2 = v_1^2 - 2 g y", T),
    ("at 0.5 s: y' = -v_1", W),
    ("at 0.1 s: x = s", T),
]  # fmt: skip


@pytest.mark.parametrize(("statement", "kind"), OF_LETTERS)
def test_a_letter_names_what_is_at_a_moment_of_the_motion(statement: str, kind: Kind) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{BALL}run: {{until: 1.2 s}}\n")
    verdict = Checker(mechanism, LETTERS).check(statement, correcting=False)
    assert verdict.kind is kind, str(verdict)


@pytest.mark.parametrize(("speed", "kind"), [("e^2 √(2 g h)", T), ("e √(2 g h)", W), ("e^3 √(2 g h)", W)])
def test_the_second_impact_is_the_second(speed: str, kind: Kind) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{BALL}run: {{until: 2 s}}\n")
    assert Checker(mechanism).check(f"just after the second impact: y' = {speed}", correcting=False).kind is kind
    assert mechanism.solve(after="second impact").state.t > mechanism.solve(after="impact").state.t
    with pytest.raises(StatementError, match="does not come to a fourth"):
        Checker(mechanism).check("just after the fourth impact: y' = 0")


LIFTED = """
parameters: {m: 3 kg, p: 90 N/s, g: 9.81 m/s^2}
gravity: g
ground: {lines: {floor: {through: O, angle: 0}, up: {through: O, angle: 90 deg}}}
bodies: {load: {shape: particle, mass: m}}
joints: {guide: {type: slot, along: ground.up, point: load.centre, coordinate: y}}
contacts: {floor: {of: [load.centre, ground.floor]}}
forces: {rope: {type: law, along: y, value: p*t}}
initial: {y: 0, at_rest: true}
run: {until: 1 s}
"""


@pytest.mark.parametrize(
    ("statement", "kind"),
    [
        ("once the load hangs free: T = m g", W),
        ("once the load leaves the floor: T = m g", Kind.TRUE_IF),
        ("once the load leaves the floor: T = m g + m y''", T),
        ("at the moment the load leaves the floor: T = m g", T),
        ("load in the air: T = m g", W),
    ],
)
def test_once_is_from_then_on(statement: str, kind: Kind) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{LIFTED}")
    assert Checker(mechanism, {"T": "p*t"}).check(statement, correcting=False).kind is kind


def test_a_letter_of_a_moment_that_there_is_not_is_refused() -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{BALL}run: {{until: 1.2 s}}\n")
    with pytest.raises(StatementError, match="nothing that happens"):
        Checker(mechanism, {"v": "vy(ball.G) @ before roof"}).check("v = 0")


@pytest.mark.parametrize("asked", [{"after": "nothing"}, {"at": -1}, {"at": 0.1, "before": "reached"}])
def test_a_moment_that_there_is_not_is_refused(asked: dict) -> None:
    mechanism = Mechanism.loads(f"freebody: 1\n{SPRING}run: {{until: 1 s}}\n")
    with pytest.raises(ValueError):  # as in `solve`
        mechanism.solve(**asked)
    with pytest.raises(ValueError):
        mechanism.check("m x'' = 0", **asked)

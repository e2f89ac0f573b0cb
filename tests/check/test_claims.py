"""Claims: constants, limits, figures to their printed digits, consequences, and conditions tried both ways."""

from __future__ import annotations

import pytest
from textbook import BOOKS

from freebody.check import Checker, Kind
from freebody.model import Mechanism


def checker(name: str) -> Checker:
    book = next(book for book in BOOKS if book.name == name)
    return Checker(Mechanism.loads(f"freebody: 1\n{book.model}"), dict(book.letters))


CLAIMS = [
    ("pendulum on a cart", "if F = 0: constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.TRUE),
    ("pendulum on a cart", "constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.WRONG),
    ("pendulum on a cart", "only if F = 0: constant: (M+m)*xdot + m*l*thetadot*cos(theta)", Kind.TRUE),
    ("pendulum on a cart", "only if g = 0: (M+m)*xddot + m*l*thetaddot*cos(theta) - m*l*thetadot^2*sin(theta) = F", Kind.WRONG),
    ("pendulum on a cart", "limit: l*thetaddot = -g*sin(theta) as M -> inf", Kind.TRUE),
    ("pendulum on a cart", "limit: l*thetaddot = g*sin(theta) as M -> inf", Kind.WRONG),
    ("pendulum on a cart", "limit: l*thetaddot = -g*sin(theta) as m -> 0", Kind.WRONG),
    ("pendulum on a cart", "if m = M, theta = pi/4, at rest, F = 0: xddot = g/3", Kind.TRUE),
    ("pendulum on a cart", "no x, xdot in: thetaddot", Kind.TRUE),
    ("pendulum on a cart", "no thetadot in: thetaddot", Kind.WRONG),
    ("pendulum on a cart", "if thetadot = 0: (M+m)*xddot + m*l*thetaddot*cos(theta) = F", Kind.TRUE),
    ("bead on a turning rod", "only if T = 0: constant: (m1*l^2/3 + m2*R^2)*thetadot", Kind.TRUE),
    ("bead on a turning rod", "follows: m2*Rddot = m2*R*thetadot^2 from Rddot = R*thetadot^2", Kind.TRUE),
    ("bead on a turning rod", "follows: Rddot = 0 from Rddot = R*thetadot^2", Kind.WRONG),
    ("double pendulum", "constant: energy()", Kind.TRUE),
    ("double pendulum", "constant: kinetic()", Kind.WRONG),
    ("block on a sliding wedge", "constant: xddot", Kind.TRUE),
    ("block on a sliding wedge", "constant: xdot", Kind.WRONG),
]


@pytest.mark.parametrize(("book", "text", "kind"), CLAIMS)
def test_claims(book: str, text: str, kind: Kind) -> None:
    verdict = checker(book).check(text)
    assert verdict.kind is kind, verdict
    assert verdict.reason


FALL = """
freebody: 1
parameters: {m: 1 kg, h: 2 m}
gravity: 9.81 m/s^2
bodies: {stone: {shape: particle, mass: m}}
joints: {path: {type: slider, along: {through: ground.O, angle: 90 deg}, line: {through: stone.centre, angle: 90 deg}, coordinate: y}}
initial: {y: h, at_rest: true}
events: {lands: {when: y, direction: falling, then: stop}}
run: {until: 5 s}
"""
FALL = FALL.replace("shape: particle, ", "")  # a slider holds the direction of what it carries
FALL = FALL.replace("stone.centre", "stone.origin")

# Falling 2 m from rest takes √(2·2/9.81) = 0.638551 s and ends with √(2·9.81·2) = 6.264184 m/s.
FIGURES = [
    ("at lands: t = 0.64 s", True),
    ("at lands: t = 0.639 s", True),
    ("at lands: t = 0.638 s", False),
    ("at lands: t = 0.63855 s", True),
    ("at lands: ydot = -6.26 m/s", True),
    ("at lands: ydot = -6.27 m/s", False),
    ("at start: yddot = -9.81 m/s^2", True),
    ("at 0.1 s: ydot = -0.981 m/s", True),
]


@pytest.mark.parametrize(("text", "ok"), FIGURES)
def test_figures_hold_to_their_printed_digits(text: str, ok: bool) -> None:
    assert Checker(Mechanism.loads(FALL)).check(text).ok is ok

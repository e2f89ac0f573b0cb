"""Where nothing corrects an equation, a true one with the same symbols is offered; it is put to the test like any other."""

from __future__ import annotations

import pytest
from store import mechanism
from textbook import BOOKS

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism

HOPELESS = [
    ("pendulum on a cart", "l^2*thetaddot*sin(theta)^2 = 7*g*x + 3*l*xddot", "moments"),
    ("pendulum on a cart", "7*(M + 2*m)*sin(theta)*xddot = 3*F", "forces"),
    ("double pendulum", "m2*theta2ddot*l2*sin(theta1) = 5*m2*theta1ddot*l1*cos(theta2)^3", "forces"),
    ("bead on a turning rod", "m2*Rddot*(2 + cos(theta)^3) = 3*m2*R*thetaddot*sin(theta) - 5*m1*l*thetadot^2", ""),
]


@pytest.mark.parametrize(("name", "text", "what"), HOPELESS)
def test_the_nearest_balance_is_true(name: str, text: str, what: str) -> None:
    book = next(book for book in BOOKS if book.name == name)
    checker = Checker(Mechanism.loads(f"freebody: 1\n{book.model}"), dict(book.letters))
    verdict = checker.check(text)
    assert verdict.kind is Kind.WRONG
    assert not verdict.mends
    words, _, equation = verdict.true.partition(" reads: ")
    assert what in words
    assert checker.check(equation).ok, equation


def test_the_nearest_balance_of_what_rolls() -> None:
    """Rolling holds rates and no place: its row of places is empty."""
    verdict = mechanism("19.3.29/model").check("foot.N = 3*m*g")
    assert verdict.kind is Kind.WRONG


CHAIN = """
freebody: 1
parameters: {m: 1 kg, L: 1 m, g: 9.81 m/s^2}
gravity: g
bodies: {a: {shape: rod, length: L, mass: m}, b: {shape: rod, length: L, mass: m}, c: {shape: rod, length: L, mass: m}}
joints:
  A: {type: hinge, of: [ground.O, a.start], coordinate: {name: p, zero: down, absolute: true}}
  B: {type: hinge, of: [a.end, b.start], coordinate: {name: q, zero: down, absolute: true}}
  C: {type: hinge, of: [b.end, c.start], coordinate: {name: r, zero: down, absolute: true}}
initial: {p: 0.1, q: 0.2, r: 0.3, at_rest: true}
"""


def test_a_moment_about_a_moving_pin_is_given_all_that_it_lacks() -> None:
    """Of the balance of the last rod about its upper pin: r × m a of the pin, which four terms are."""
    checker = Checker(Mechanism.loads(CHAIN))
    (mend,) = checker.check("1/3 m L^2 r'' + 1/2 m g L sin r = 0").mends
    assert checker.check(mend.equation).ok
    assert all(word in mend.equation for word in ("pddot", "qddot", "pdot^2", "qdot^2"))

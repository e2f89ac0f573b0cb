"""What keeps two points apart is printed by differences, and as the distance of the two points moves."""

from __future__ import annotations

import numpy as np
import pytest

import freebody as fb
from freebody.core import State
from freebody.document.blocks import Written
from freebody.equations.derivation.distances import distances
from freebody.equations.derivation.plain_rows import on_two_sides
from freebody.equations.derivation.put_in import Closed
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, Pow, Sym, symbols

# name: bodies and joints, the two points, whether velocities go by differences, too
MODELS = {
    "two particles": (
        "{A: {shape: particle, mass: 1}, C: {shape: particle, mass: 2}}",
        "fa: {type: free, of: [ground.O, A.centre], coordinates: [x_A, y_A]}, "
        "fc: {type: free, of: [ground.O, C.centre], coordinates: [x_C, y_C]}",
        ("A.centre", "C.centre"),
        True,
    ),
    "two sliders": (
        "{A: {shape: particle, mass: 1}, C: {shape: particle, mass: 2}}",
        "sa: {type: slot, along: {through: ground.O, angle: 0}, point: A.centre, coordinate: x}, "
        "sc: {type: slot, along: {through: ground.O, angle: 90 deg}, point: C.centre, coordinate: y}",
        ("A.centre", "C.centre"),
        True,
    ),
    "a hung rod": (
        "{bar: {shape: rod, length: c, mass: 1}}",
        "f: {type: free, of: [ground.O, bar.G], coordinates: [x, y, theta]}",
        ("ground.Q", "bar.end"),
        True,
    ),
    "two cranks": (
        "{one: {shape: rod, length: c, mass: 1}, two: {shape: rod, length: 2*c, mass: 1}}",
        "O: {type: hinge, of: [ground.O, one.start], coordinate: theta}, Q: {type: hinge, of: [ground.Q, two.start], coordinate: phi}",
        ("one.end", "two.end"),
        False,
    ),
    "a crank and a particle": (
        "{one: {shape: rod, length: c, mass: 1}, C: {shape: particle, mass: 2}}",
        "O: {type: hinge, of: [ground.O, one.start], coordinate: theta}, "
        "fc: {type: free, of: [ground.O, C.centre], coordinates: [X, Y]}",
        ("one.end", "C.centre"),
        False,
    ),
}
TEXT = """
freebody: 1
parameters: {{l: 1.3 m, c: 0.7 m}}
ground: {{points: {{Q: [1.1 m, 0.2 m]}}}}
bodies: {bodies}
joints: {{{joints}{link}}}
{string}
initial: {{guess: {guess}}}
"""
GUESSES = {
    "two particles": "{x_A: 0, y_A: 0, x_C: 1, y_C: 1}", "two sliders": "{x: 0.9, y: 0.9}", "a hung rod": "{x: 0.3, y: -0.9, theta: 0.4}",
    "two cranks": "{theta: 0.5, phi: 1.2}", "a crank and a particle": "{theta: 0.5, X: 1.5, Y: -0.5}",
}  # fmt: skip


def subject_of(name: str, way: str) -> SymbolicState:
    bodies, joints, ends, _ = MODELS[name]
    link = f", bar: {{type: link, of: [{', '.join(ends)}], length: l}}" if way == "link" else ""
    string = "" if link else f"strings: {{bar: {{ends: [{', '.join(ends)}]}}}}"
    made = fb.Mechanism.loads(TEXT.format(bodies=bodies, joints=joints, link=link, string=string, guess=GUESSES[name]))
    return SymbolicState(made.source(), made.start()[0])


@pytest.mark.parametrize(
    ("name", "way"), [*((name, "link") for name in MODELS), *((name, "string") for name in ("two particles", "a hung rod"))]
)
def test_what_keeps_two_points_apart_is_printed_by_differences(name, way):
    """Squares of differences on one side, what does not move on the other; all levels as the distance has them at states off the row."""
    subject, (_, _, (p, q), factored) = subject_of(name, way), MODELS[name]
    rows = Closed(subject).rows
    apart = distances(subject, rows)
    levels = on_two_sides(rows, subject.names, apart)
    (left, right), rate, acceleration = (sides for [sides] in levels)
    squares = left.terms if isinstance(left, Add) else (left,)
    assert 0 < len(squares) <= 2 and all(isinstance(square, Pow) and square.exponent == 2 for square in squares)
    assert symbols(right) == {Sym("l")} & symbols(right) and not any(isinstance(side, Written) for side in (*rate, *acceleration))
    if factored:  # else what is multiplied out is shorter
        assert rate == apart["bar"].levels(subject.names)[1]
    drawn, source, p0 = np.random.default_rng(1), subject.source, subject.state.p
    kept = evaluate(right, subject.values)
    for _ in range(5):
        q0, u, a = drawn.uniform(-1.5, 1.5, (3, len(subject.names)))
        values = subject.values | {
            Sym(n, k): x for k, xs in enumerate((q0, u, a)) for n, x in zip(subject.names, xs, strict=True)
        }
        gap = lambda s: source.evaluate([f"distance({p}, {q})^2"], State(p0, 0.0, q0 + u * s + a * s**2 / 2, u))[0] - kept  # noqa: B023
        h = 1e-3
        # Derivatives of five points of the distance along a motion, whose own error is some h⁴; half of them as a square has.
        ahead, behind, further, before = gap(h), gap(-h), gap(2 * h), gap(-2 * h)
        slope = (8 * (ahead - behind) - (further - before)) / (12 * h)
        bend = (16 * (ahead + behind) - (further + before) - 30 * gap(0.0)) / (12 * h**2)
        for (one, other), true in (((left, right), gap(0.0)), (rate, slope / 2), (acceleration, bend / 2)):
            found = evaluate(one, values) - evaluate(other, values)
            assert min(abs(found - true), abs(found + true)) == pytest.approx(0.0, abs=1e-6)

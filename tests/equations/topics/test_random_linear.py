"""Linear equations of random mechanisms at rest, with loops, rolling, strings, contacts, friction, motions: they are what differences
of the core's own accelerations and energies give, or are refused."""

import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
import sympy
from differences import first_order, tangent
from random_models import resting
from store import every

import freebody as fb
from freebody.core import CompiledModel, State
from freebody.equations import Sym, TooLarge, Tree, to_sympy
from freebody.equations.solve import Singular
from freebody.equations.topics import NotHere, topic
from freebody.equations.topics.linear import LinearEquations

AGREE = 1e-7
"""Of the largest entry, or eigenvalue: what is left of differences."""
SHARE = 50


@pytest.fixture(autouse=True)
def without_patience(monkeypatch):
    """What is printed need not be short here."""
    for name in ("linearization", "stability"):
        monkeypatch.setattr(sys.modules[f"freebody.equations.{name}"], "PATIENCE", 0.1)


def known(source: CompiledModel, state: State) -> dict[sympy.Symbol, float]:
    """The numbers of all symbols at a state, for SymPy."""
    names = [each["name"] for each in source.metadata["coordinates"]]
    values = {Sym(name): each["value"] for name, each in source.symbolic_answers(state, []).symbols.items()}
    return {to_sympy(x): value for x, value in (values | dict(zip(map(Sym, names), state.q.tolist(), strict=True))).items()}


def matrix(rows: Sequence[Sequence[Tree]], values: dict[sympy.Symbol, float]) -> np.ndarray:
    return np.array(
        [[float(to_sympy(entry).subs(values | {sympy.Symbol("pi"): sympy.pi}).evalf()) for entry in row] for row in rows]
    )


def agree(source: CompiledModel, found: LinearEquations) -> None:
    """Nothing moves off from where they hold; equations, what follows, kinetic energy and eigenvalues are those of differences."""
    still = source.instant(found.rest)
    assert not found.rest.u.any() and np.abs(still.accelerations).max() <= AGREE * max(1.0, still.sizes[1])
    free, values = found.equations.coordinates, known(source, found.rest)
    ways, names = tangent(source, found.rest, free), [each["name"] for each in source.metadata["coordinates"]]
    for name, printed in found.follow.items():
        assert matrix([printed], values)[0] == pytest.approx(
            ways[names.index(name)], abs=AGREE * np.abs(ways).max(initial=0.0)
        ), name
    if not free:
        return
    true, n = first_order(source, found.rest, free), len(free)
    m, c, k = (matrix(part, values) for part in (found.equations.mass, found.equations.damping, found.equations.stiffness))
    for printed, expected in ((-np.linalg.solve(m, k), true[n:, :n]), (-np.linalg.solve(m, c), true[n:, n:])):
        assert printed == pytest.approx(expected, abs=AGREE * max(1.0, np.abs(true).max(initial=0.0)))
    if not any(motion["level"] == "acceleration" for motion in source.spec["motions"]):

        def kinetic(way: np.ndarray) -> float:
            return float(source.evaluate(["kinetic()"], replace(found.rest, u=way.copy()))[0])

        energies = np.array([[kinetic(a + b) - kinetic(a) - kinetic(b) for b in ways.T] for a in ways.T]).reshape(n, n)
        own = np.diag(m) / np.diag(energies)  # a balance may be one of moments where the coordinate is a length
        assert m == pytest.approx(own[:, None] * energies, abs=AGREE * np.abs(m).max(initial=0.0))
    expected, left = np.linalg.eigvals(true), [root.value for root in found.eigenvalues for _ in range(root.count)]
    assert len(left) == len(expected)
    for value in expected:
        nearest = min(left, key=lambda root: abs(root - value))
        left.remove(nearest)
        assert abs(nearest - value) < np.sqrt(AGREE) * np.abs(expected).max()  # a double eigenvalue has half of the digits
    if told := found.stability:
        holds = not told.never and (matrix([told.conditions], values) > 0).all()
        assert holds == bool((expected.real < AGREE * np.abs(expected).max()).all()), told


@every(map(str, range(200)), "seed", share=SHARE)
def test_linear_equations_are_differences_of_the_core_or_are_refused(seed, record_property):
    try:
        mechanism = resting(int(seed))
        found = topic(mechanism, "linear")
    except (fb.MotionError, NotHere, TooLarge, Singular) as error:
        record_property("refused", str(error))
        return
    agree(mechanism.source(), found)

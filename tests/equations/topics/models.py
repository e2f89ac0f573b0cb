"""Small models with answers in textbooks, and random states of any model."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import freebody as fb
from freebody.catalogue import model_file
from freebody.equations import from_sympy
from freebody.equations.substitutions import substitutions_of
from freebody.solve.symbolic_state import SymbolicState


def system(name: str) -> fb.Mechanism:
    """A model of the catalogue."""
    return fb.load(model_file(f"{name}/model"))


def random_subjects(mechanism: fb.Mechanism, number: int = 3, seed: int = 3) -> Iterator[SymbolicState]:
    """A mechanism at states near its start, its parameters, coordinates and (in open trees) rates moved at random."""
    first = SymbolicState(mechanism.source(), mechanism.start()[0])
    rng = np.random.default_rng(seed)
    found = 0
    for _ in range(10 * number):
        state = substitutions_of(mechanism, {}).near(first, rng)
        if state is not None and found < number:
            found += 1
            yield SymbolicState(first.source, state)
    assert found == number


def atwood() -> fb.Mechanism:
    """Two masses hang on a cord over a pulley without mass; x1 and x2 are how far they are below it."""
    m = fb.Mechanism("Atwood's machine")
    m1, m2 = m.parameter("m1", "3 kg"), m.parameter("m2", "2 kg")
    for name, mass, x in (("first", m1, "-0.1 m"), ("second", m2, "0.1 m")):
        body = m.particle(name, mass=mass)
        m.slot(name=f"guide {name}", along={"through": m.ground.point(f"P {name}", [x, 0]), "angle": "-90 deg"}, point=body.centre,
               coordinate="x1" if name == "first" else "x2")  # fmt: skip
    m.coupling(name="cord", zero="x1 + x2 - 2")
    m.initial(x1=1, x2=1)
    return m


def sliding_rod() -> fb.Mechanism:
    """A uniform rod with its ends on a smooth wall and a smooth floor, at an angle to the floor."""
    m = fb.Mechanism("rod on wall and floor")
    length, mass = m.parameter("l", "2 m"), m.parameter("m", "3 kg")
    rod = m.rod("rod", length=length, mass=mass)
    m.slot(name="floor", along={"through": m.ground.O, "angle": 0}, point=rod.end, coordinates=["x", "theta"])
    m.slot(name="wall", along={"through": m.ground.O, "angle": "90 deg"}, point=rod.start)
    m.initial(x="1.2 m")
    return m


def spring_pendulum() -> fb.Mechanism:
    """A bob on a massless rod above its pin, held up by a torsion spring; theta from the vertical."""
    m = fb.Mechanism("inverted pendulum with a spring")
    mass, k = m.parameter("m", "2 kg"), m.parameter("k", "30 N*m/rad")
    m.parameter("l", "0.5 m")
    rod = m.body("rod", mass=mass, inertia=0, points={"A": [0, "-l"]})
    m.hinge(m.ground.O, rod.A, name="pin", coordinate={"name": "theta", "sense": "clockwise"})
    m.torsion_spring(name="spring", on=rod, stiffness=k)
    m.initial(theta=0)
    return m


def tree(text: str, names: str) -> object:
    """An expression written with SymPy's words."""
    import sympy

    return from_sympy(sympy.sympify(text, locals={name: sympy.Symbol(name) for name in names.split()}))

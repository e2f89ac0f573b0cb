"""What the topics print of random models, at random states of the same mode: both sides of every equation are what vectors of the core's
bodies and loads give, of which no symbol knows anything."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from random_models import drawn
from store import every

import freebody as fb
from freebody.core import Indeterminate
from freebody.document.blocks import Block, Equation, Paragraph, Vector, Written
from freebody.document.document import Document
from freebody.equations import Sym, TooLarge, evaluate
from freebody.equations.derivation.directions import axes
from freebody.equations.solve import Unconfirmed
from freebody.equations.topics import TOPICS, NotHere, common, topic
from freebody.solve.perturbed_states import RATES, others
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.symbols import Name, unicode_name

AGREE = 1e-8
"""Of the largest term of an equation."""
ELSEWHERE = {"lagrange": "test_random_models.py", "linear": "test_random_linear.py", "impact": "test_random_impacts.py"}
ELSEWHERE |= {"frame": "test_point_motion.py", "virtual_power": "../derivation/test_virtual.py"}
"""Topics with a law of their own."""
GRAVITY = 3.7

Known = Mapping[Any, Any]
"""What symbols of a topic, by what they mean (and dots), and what is written in words, must be: a number, or a vector (2,)."""


@pytest.fixture(autouse=True)
def without_patience(monkeypatch):
    """What is printed need not be short here."""
    monkeypatch.setattr(common, "PATIENCE", 0.1)


def cross(a: Any, b: Any) -> float:
    return float(a[0] * b[1] - a[1] * b[0])


def turned(w: float, r: Any) -> np.ndarray:
    """w k × r."""
    return w * np.array([-r[1], r[0]])


def particle(at: SymbolicState, body: str) -> Known:
    """Polar coordinates of a mass centre about the origin, with their rates."""
    it = at.free.bodies[body]
    out = np.array(it.G) / np.hypot(*it.G)
    across, r = turned(1.0, out), np.hypot(*it.G)
    w = across @ it.v / r
    radial, turning = [r, out @ it.v, out @ it.a + r * w**2], [np.arctan2(it.G[1], it.G[0]), w]
    turning.append((across @ it.a - 2 * radial[1] * w) / r)
    polar = zip(("distance from ground.O", "angle of that line from i"), (radial, turning), strict=True)
    return {(what, dots): x for what, values in polar for dots, x in enumerate(values)}


def moment(at: SymbolicState, about: str) -> Known:
    """Sums over all bodies about a mass centre, or about the origin."""
    bodies = at.free.bodies.values()
    place, v = (0.0, 0.0), np.zeros(2)
    if about != "ground.O":
        place, v = at.free.bodies[about.removesuffix(".G")].G, at.free.bodies[about.removesuffix(".G")].v
    spun = sum(cross(np.subtract(b.G, place), b.mass * np.array(b.v)) + b.inertia * b.omega for b in bodies)
    rate = sum(cross(np.subtract(b.G, place), b.mass * np.array(b.a)) + b.inertia * b.alpha for b in bodies)
    extra = cross(v, sum(b.mass * np.array(b.v) for b in bodies))
    acting = at.free.acting(*at.free.bodies, about=place)[2]
    words = {"Σ r × m a + I α": rate, "dH/dt": rate - extra, "v × L": extra}
    return words | {f"{stem}/{about}": x for stem, x in (("Σ M", acting), ("H", spun), ("Ḣ", rate))}


def mass_centre(at: SymbolicState) -> Known:
    place = at.free.centre(*at.free.bodies)
    return {Name(axis, ("G",)).unicode(): x for axis, x in zip("xy", place, strict=True)}


def elimination(at: SymbolicState) -> Known:
    """The momenta of coordinates, by the kinetic energy, which is a quadratic form; the energy."""
    velocities, energy = np.eye(len(at.names)), at.source.evaluate(["energy()"], at.state)[0]

    def kinetic(u: np.ndarray) -> float:
        return float(at.source.evaluate(["kinetic()"], replace(at.state, u=u))[0])

    u = at.state.u
    momenta = {name: kinetic(u + way) - kinetic(u) - kinetic(way) for name, way in zip(at.names, velocities, strict=True)}
    return {f"conserved momentum of {unicode_name(name)}": p for name, p in momenta.items()} | {"energy": energy}


def out_of_plane(at: SymbolicState) -> Known:
    return {"Σ N": GRAVITY * sum(body.mass for body in at.free.bodies.values()), "gravity into the plane": GRAVITY}


LAWS: dict[str, tuple[Callable[..., Known], Callable[[list[str]], dict[str, Any]]]] = {
    "particle": (particle, lambda bodies: {"body": bodies[0]}),
    "moment": (moment, lambda bodies: {"about": f"{bodies[-1]}.G" if len(bodies) != 2 else "ground.O"}),
    "mass_centre": (mass_centre, lambda *_: {}),
    "elimination": (elimination, lambda *_: {}),
    "out_of_plane": (out_of_plane, lambda *_: {}),
}
"""What a topic must be, and what it is asked of all bodies."""


def test_every_topic_has_a_law():
    assert {*LAWS, *ELSEWHERE} == {*TOPICS}


def directions(blocks: Iterator[Block], values: Mapping[Sym, float]) -> dict[str, np.ndarray]:
    """The unit vectors that a document introduces: "λ points … at the angle φ; n = k × λ"."""
    found = {}
    for words in (block.words for block in blocks if isinstance(block, Paragraph)):
        if isinstance(words, list) and len(words) > 4 and isinstance(words[0], Written) and "angle" in str(words[1]):
            angle = evaluate(words[2], values)
            found[words[0].text] = np.array([np.cos(angle), np.sin(angle)])
            found[words[4].text] = turned(1.0, found[words[0].text])
    return found


def symbols_of(made: Document, own: Known) -> dict[Sym, float]:
    """The values of a topic's own symbols."""
    meant = {entry.doc: name for name, entry in made.letters.items()}
    keys = (key if isinstance(key, tuple) else (key, 0) for key in own)
    return {Sym(meant[what], dots): own.get((what, dots), own.get(what)) for what, dots in keys if what in meant}


def look(mechanism: fb.Mechanism, name: str) -> str:
    """Holds what a topic prints of a mechanism against its law; the reason where there is nothing to hold."""
    law, ask = LAWS[name]
    try:
        first = SymbolicState(mechanism.source(), mechanism.solve().state)
        asked = ask([*first.free.bodies])
        made = topic(mechanism, name, first.state, **asked, **({"gravity": GRAVITY} if name == "out_of_plane" else {}))
    except (fb.MotionError, NotHere, TooLarge, Unconfirmed) as error:
        return str(error)
    seen = 0
    for at in (first, *(SymbolicState(first.source, state) for state in others(first.source, first.state)[::RATES])):
        if name == "particle" and np.dot(at.free.bodies[asked["body"]].G, first.free.bodies[asked["body"]].G) < 0:
            continue  # what moves along a line through the origin is on the other side of it
        try:
            own = law(at, **asked)
        except Indeterminate as error:
            return str(error)
        values = at.values | symbols_of(made, own)
        units = directions(made.blocks, values) | dict(zip(axes(first.symbols.taken), np.eye(2), strict=False))

        def side(part: Any, own=own, values=values, units=units, at=at) -> tuple[Any, float]:
            """Its value, and its largest term."""
            if isinstance(part, Written):
                return own[part.text], 1.0
            if isinstance(part, Vector):
                return sum((evaluate(tree, values, at.tables) * units[unit] for tree, unit in part.components), np.zeros(2)), 1.0
            terms = [evaluate(term, values, at.tables) for term in getattr(part, "terms", (part,))]
            return sum(terms), max(map(abs, terms))

        for block in made.blocks:
            if not isinstance(block, Equation) or isinstance(block.right, Written):
                continue
            (left, one), (right, other) = side(block.left), side(block.right)
            apart = np.subtract(left, right)
            if (
                getattr(block.left, "name", "") in made.letters
                and made.letters[block.left.name].doc == "angle of that line from i"
            ):
                apart = np.sin(apart / 2)
            assert np.abs(apart).max() < AGREE * max(1.0, one, other, np.abs(left).max()), block
            seen += 1
    assert seen
    return ""


@every([f"{seed} {name}" for seed in range(120) for name in LAWS], "case", share=60)
def test_both_sides_of_what_a_topic_prints_are_those_of_the_bodies(case, record_property):
    seed, name = case.split()
    if refused := look(drawn(int(seed)), name):
        record_property("refused", refused)


OWN = """
freebody: 1
gravity: none
parameters: {omega: 0.5 m, r: 0.3 kg, E: 2 kg, g_z: 0.4 N/m, p_alpha: 0.7 m, s: 3 N*s/m}
bodies: {rod: {shape: rod, length: omega, mass: r}, bob: {shape: particle, mass: E}}
joints:
  A: {type: hinge, of: [ground.O, rod.start], coordinate: alpha}
  B: {type: slot, along: [rod.start, rod.end], point: bob.centre, coordinate: phi}
forces: {k: {type: spring, along: phi - p_alpha, stiffness: g_z}}
initial: {alpha: 0.3, phi: -0.2, rates: {alpha: 1, phi: 0.1}}
"""


@pytest.mark.parametrize("name", LAWS)
def test_a_symbol_of_a_topic_is_none_of_the_model(name):
    assert not look(fb.Mechanism.loads(OWN), name)


def test_the_eigenvalue_is_none_of_the_model():
    held = OWN.replace("spring, along: phi - p_alpha", "spring, along: phi, damping: s").replace(
        "alpha: 1, phi: 0.1", "alpha: 0, phi: 0"
    )
    said = topic(fb.Mechanism.loads(held.replace("-0.2", "0")), "linear").text()
    assert "eigenvalue is written λ" in said and "characteristic equation of the eigenvalues λ" in said

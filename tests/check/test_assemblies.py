"""Samples of closed loops are of the start's assembly: loops with change points, where a parallelogram becomes the crossed one, and others."""

from __future__ import annotations

import numpy as np
import pytest
from store import every

from freebody.check import Checker, Kind
from freebody.core import MotionError
from freebody.mechanism import Mechanism

FOUR_BAR = """
parameters: {{a: {a} m, b: {b} m, c: {c} m, d: {d} m}}
ground: {{points: {{D: [{ground}, 0]}}}}
bodies:
  crank: {{shape: rod, length: a, mass: 1 kg}}
  coupler: {{shape: rod, length: {coupler}, mass: 2 kg}}
  rocker: {{shape: rod, length: {rocker}, mass: 3 kg}}
joints:
  A: {{type: hinge, of: [ground.O, crank.start], coordinate: theta}}
  B: {{type: hinge, of: [crank.end, coupler.start], coordinate: {{name: psi, absolute: true}}}}
  C: {{type: hinge, of: [coupler.end, rocker.end]}}
  D: {{type: hinge, of: [ground.D, rocker.start], coordinate: phi}}
"""
EQUAL = {
    "parallelogram": {"coupler": "d", "rocker": "a", "ground": "d"},
    "kite": {"coupler": "b", "rocker": "b", "ground": "a"},
    "any": {"coupler": "b", "rocker": "c", "ground": "d"},
}
SLIDER_CRANK = """
parameters: {{l: {l} m}}
ground: {{lines: {{rail: {{through: O, angle: 0}}}}}}
bodies:
  crank: {{shape: rod, length: l, mass: 1 kg}}
  rod: {{shape: rod, length: l, mass: 2 kg}}
joints:
  A: {{type: hinge, of: [ground.O, crank.start], coordinate: theta}}
  B: {{type: hinge, of: [crank.end, rod.start], coordinate: {{name: psi, absolute: true}}}}
  C: {{type: slot, along: ground.rail, point: rod.end}}
initial: {{theta: {theta}, guess: {{psi: {psi}}}}}
"""
CROSSED = "sin(angle(coupler) - angle(rocker))"
"""Twice the area of the triangle of coupler and rocker over its sides: its sign tells the two assemblies of a four-bar apart."""
FOLDED = "cos(angle(rod))"
"""A crank and a rod of one length lie on one another where it is below 0, so that the slider stays on the crank's pin."""
KINDS = ("parallelogram", "antiparallelogram", "kite", "any", "slider-crank", "folded slider-crank")


def loop(seed: int) -> tuple[str, str]:
    """A random loop, and what has the sign of its assembly."""
    rng, kind = np.random.default_rng(seed), KINDS[seed % len(KINDS)]
    theta = rng.uniform(0.3, 1.2) * rng.choice([-1, 1])
    if "slider" in kind:
        psi = -theta if kind == KINDS[4] else np.pi + theta
        return SLIDER_CRANK.format(l=rng.uniform(0.2, 2), theta=theta, psi=psi), FOLDED
    sizes = dict(zip("abcd", rng.uniform(0.4, 1.5, 4) * rng.uniform(0.2, 2), strict=True))
    lengths = EQUAL[kind.replace("anti", "")]
    a, b, c, d = sizes["a"], *(sizes[lengths[word]] for word in ("coupler", "rocker", "ground"))
    pin, across = a * np.exp(1j * theta), d - a * np.exp(1j * theta)
    r = abs(across)
    if not abs(b - c) < 0.95 * r < 0.9 * (b + c):
        return loop(seed + len(KINDS) * 1000)
    turned = np.arccos((r**2 + b**2 - c**2) / (2 * r * b))
    ways = [np.angle(across) + sign * turned for sign in (1, -1)]
    parallel = [abs(np.sin(way)) < 1e-9 for way in ways]
    psi = ways[parallel.index(kind == "parallelogram")] if "parallelogram" in kind else ways[rng.integers(2)]
    phi = np.angle(pin + b * np.exp(1j * psi) - d)
    start = f"initial: {{theta: {theta:.17g}, guess: {{psi: {psi:.17g}, phi: {phi:.17g}}}}}"
    return FOUR_BAR.format(**sizes, **lengths) + start, CROSSED


@every(map(str, range(120)), "seed", share=20)
def test_samples_are_of_the_starts_assembly(seed):
    text, sign = loop(int(seed))
    sampler = Checker(Mechanism.loads(f"freebody: 1\n{text}")).sampler
    found = sampler.samples().values([sign])[sign]
    own = sampler.core.evaluate([sign], sampler.first)[0]
    assert len(found) >= 16
    assert np.all(found * own > 0), "a sample is of another assembly"
    assert np.abs(found).min() > 1e-3 * abs(own), "a sample is next to where assemblies meet"


@pytest.mark.parametrize("kind", ["parallelogram", "antiparallelogram", "slider-crank"])
def test_solved_for_from_afar_states_hop(kind):
    """What makes the law above say something."""
    text, sign = loop(KINDS.index(kind))
    sampler, rng = Checker(Mechanism.loads(f"freebody: 1\n{text}")).sampler, np.random.default_rng(1)
    own, signs = sampler.core.evaluate([sign], sampler.first)[0], []
    for _ in range(40):
        there = dict(zip(sampler.names, (sampler.first.q + rng.uniform(-1.5, 1.5, len(sampler.names))).tolist(), strict=True))
        try:
            signs.append(sampler.core.evaluate([sign], sampler.core.assemble(sampler.first.p, guess=there)[0])[0] * own)
        except MotionError:
            continue
    assert min(signs) < 0 < max(signs)


RIGHT_OF = {
    "parallelogram": ("phi = theta", "omega(coupler) = 0", "psi = 0"),
    "antiparallelogram": (
        "a sin(theta) + d sin(psi) = a sin(phi)",
        "a^2 = x(rocker.end)^2 - 2 d x(rocker.end) + d^2 + y(rocker.end)^2",
    ),
    "slider-crank": ("psi = -theta", "x(rod.end) = 2 l cos(theta)"),
    "folded slider-crank": ("x(rod.end) = 0", "omega(rod) = omega(crank)"),
}


@pytest.mark.parametrize(("kind", "statement"), [(kind, each) for kind, of in RIGHT_OF.items() for each in of])
def test_what_is_right_of_an_assembly_is_right(kind, statement):
    text, _ = loop(KINDS.index(kind))
    verdict = Checker(Mechanism.loads(f"freebody: 1\n{text}")).check(statement)
    assert verdict.kind is Kind.TRUE, str(verdict)

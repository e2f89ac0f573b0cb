"""The work of every kind of force is the integral of its power, over impacts, switches and changes of parameters, parts and modes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from seen import model

from freebody.core import cards

BOX = """
parameters: {c: 30, k: 0.2, rest: 0.3 m, e: 0.6, K: 3e4 N/m}
ground: {points: {P: [-1, 0], Q: [1, 0], post: [0, 1.2]}, lines: {floor: [P, Q]}}
bodies: {box: {shape: rectangle, width: 0.5 m, height: 0.3 m, mass: 2 kg, points: {A: [0.25, 0.15], B: [-0.25, 0.15], C: [-0.25, 0]}}, load: {shape: particle, mass: 1.5}, crank: {shape: rod, length: 0.4, mass: 0.7}}
contacts: {floor: {of: [box, ground.floor], restitution: e, friction: 0.3}}
strings: {leash: {ends: [ground.post, box.C], length: 1.1 m, restitution: 0.2}}
joints:
  lift: {type: slot, along: [ground.P, ground.post], point: load.centre, coordinate: lift}
  knob: {type: hinge, of: [ground.Q, crank.start], coordinate: knob}
motions: {winch: {of: lift, is: 0.1*sin(3*t)}, motor: {of: knob, is: 2 + 0.3*cos(5*t), level: velocity}}
stops: {wall: {of: box.x, most: 0.3 m, stiffness: K, damping: 40}}
forces: {it: %s}
initial: {box.x: 0.1, box.y: 0.5, box.angle: 0.4, rates: {box.x: 0.8, box.y: -1, box.angle: -4}}
events:
  changed:  {at: 0.20 s, then: {set: {c: 1.5*c, k: 1, rest: rest/2}}}
  released: {at: 0.35 s, then: {release: it}}
  engaged:  {at: 0.45 s, then: {engage: it}}
run: {until: 0.7 s, rtol: 1e-11, impacts: newton}
"""
FORCES = {
    "force": ["{at: box.A, value: c/10, direction: 0.3, frame: body}", "{at: box.A, x: -c*box.x, y: 'if(box.y < 0.3, c/5, 0)'}"],
    "torque": ["{on: box, value: -c/30*omega(box)}"],
    "torsion_spring": ["{on: box, stiffness: c/10, rest_angle: 2*k}", "{on: box, stiffness: c/10, damping: c/100}"],
    "spring": [
        "{between: [ground.post, box.A], stiffness: c, rest_length: rest}",
        "{between: [ground.post, box.A], stiffness: c, rest_length: rest, damping: c/30}",
        "{along: box.x + box.y, stiffness: c}",
    ],
    "damper": ["{between: [ground.post, box.B], damping: c/20}"],
    "law": [
        "{along: box.x, value: -c*box.x^3, potential: c*box.x^4/4}",
        "{along: 'distance(ground.post, box.A)', value: 'if(rate(box.y) < 0, c/10, -c/20)'}",
        "{along: box.y, value: 'if(box.y < 0.3, 0.3 - box.y, 0)*c', potential: 'if(box.y < 0.3, (0.3 - box.y)^2/2, 0)*c'}",
    ],
    "table_friction": ["{points: [box.A, box.B, box.C], friction: 0.1, load: c}"],
    "plate_friction": ["{area: box, friction: 0.1, load: c}"],
}


def test_every_kind_of_force_is_here():
    assert set(FORCES) == set(cards.forces())


@pytest.mark.parametrize("force", [f"{{type: {word}, {each[1:]}" for word, all_of in FORCES.items() for each in all_of])
def test_its_work_is_the_integral_of_its_power(force: str):
    run = model(BOX % force).simulate()
    assert run.outcome.ok and {"impact", "released", "engaged"} <= {change.kind for change in run.changes}
    nodes, weights = np.polynomial.legendre.leggauss(8)
    for part in ("it", "winch", "motor"):
        done, largest = 0.0, 1e-3
        for start, end in pairwise(run.edges):
            powers = run.evaluate(f"{part}.power", (start + end) / 2 + (end - start) / 2 * nodes)
            done += (end - start) / 2 * float(weights @ powers)
            largest = max(largest, abs(done))
            assert run.evaluate(f"{part}.work", end) == pytest.approx(done, abs=1e-8 * largest)
        assert largest > 0.02
    for state in (run.start, run.motion.state(0.3), run.end):
        work, power, rate = run.source.evaluate(["it.work", "it.power", "rate(it.work)"], state)
        assert rate == pytest.approx(power, abs=1e-9 * largest)
        assert work == pytest.approx(run.evaluate("it.work", state.t), abs=1e-12 * largest)
    ledger = run.energy
    assert np.abs(ledger.balance).max() < 1e-9 * np.abs(ledger.values[:, :-1]).max()

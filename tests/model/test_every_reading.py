"""Everything that an expression can read: it has a value, a unit in reports, and grows with sizes, masses and times as that unit says."""

import math

import pytest

import freebody as fb
from freebody.core import cards
from freebody.model import units
from freebody.run.records import quote, unit_of

ARGUMENTS = {"point": ("rod.end", "ground.P"), "line": ("ground.rail",), "body": ("rod",), "string": ("rope",)}
SCALES = (3.0, 5.0, 2.0)
"""Of lengths, masses and times."""


def model(length=1.0, mass=1.0, time=1.0):
    """A mechanism with something of everything, all its numbers scaled."""
    g, n = length / time**2, mass * length / time**2
    nm, stiff = n * length, n / length
    return fb.Mechanism.loads(f"""
freebody: 1
gravity: {9.81 * g}
ground:
  points: {{P: [{length}, {2 * length}], R: [{5 * length}, 0], S: [{9 * length}, 0], W: [{-4 * length}, 0], F: [0, {-9 * length}]}}
  lines: {{rail: {{through: P, angle: 20 deg}}, floor: {{through: F, angle: 0}}}}
bodies:
  rod: {{shape: rod, length: {2 * length}, mass: {mass}}}
  cart: {{mass: {mass}, inertia: {0.1 * mass * length**2}, lines: {{own: {{through: origin, angle: 0}}}}}}
  ball: {{shape: particle, mass: {mass}}}
  bob: {{shape: particle, mass: {mass}}}
  box: {{shape: rectangle, width: {length}, height: {length}, mass: {mass}}}
  plate: {{mass: {mass}, inertia: {0.2 * mass * length**2}, centre: [{0.3 * length}, 0]}}
joints:
  pivot: {{type: hinge, of: [ground.O, rod.start], coordinate: a, friction: 0.2, bearing_radius: {0.1 * length}}}
  guide: {{type: slider, along: ground.rail, line: cart.own, coordinate: s}}
  tie: {{type: link, of: [ground.R, ball.centre], length: {length}, coordinate: b}}
  hold: {{type: weld, of: [ground.W, plate.origin]}}
  where: {{type: free, of: [ground.O, box.centre], coordinates: [x, y, phi]}}
  hangs: {{type: free, of: [ground.S, bob.centre], coordinates: [u, v]}}
forces:
  coil: {{type: spring, between: [ground.P, rod.end], stiffness: {30 * stiff}, damping: {2 * stiff * time}}}
  motor: {{type: torque, on: rod, value: {4 * nm}}}
  push: {{type: force, at: ball.centre, x: {3 * n}}}
  twist: {{type: torsion_spring, on: box, stiffness: {nm}, damping: {nm * time}}}
motions:
  drive: {{of: s, is: {0.3 * length / time**2} * t^2 + {0.2 * length / time} * t}}
contacts:
  rests: {{of: [box, ground.floor], friction: 0.3}}
strings:
  rope: {{ends: [ground.S, bob.centre], length: {length}}}
stops:
  end: {{of: s, least: {-length}}}
  turned: {{of: a, most: 3 rad}}
initial: {{a: 0.4, b: -1, s: 0, x: 0, y: {-8.5 * length}, phi: 0, u: {0.6 * length}, v: {-0.8 * length},
  rates: {{a: {1 / time}, b: {2 / time}, x: {length / time}, y: 0, phi: 0, u: {0.8 * length / time}, v: {0.6 * length / time}}}}}
""")


def every_reading(metadata):
    """Each function of something, and each word behind the name of a part. Where nothing touches is no place: NaN."""
    for function in cards.functions().values():
        texts = [ARGUMENTS[kind][min(i, len(ARGUMENTS[kind]) - 1)] for i, kind in enumerate(function.takes)]
        yield f"{function.word}({', '.join(texts)})"
    for section in ("joints", "forces", "motions", "limits"):
        for part in metadata[section]:
            yield from (f"{quote(part['name'])}.{word}" for word in part["readings"])


def test_readings_grow_as_their_units_say():
    plain, grown = model(), model(*SCALES)
    metadata = plain.source().metadata
    texts = list(every_reading(metadata))
    assert len(texts) > 100
    now, then = (solved.core.evaluate(texts, solved.state) for solved in (plain.solve(), grown.solve()))
    for text, before, after in zip(texts, now, then, strict=True):
        unit = unit_of(text, (), metadata)
        assert unit, f"{text} has no unit"
        dimension = units.unit(unit).dimension
        factor = math.prod(float(scale) ** float(power) for scale, power in zip(SCALES, dimension[:3], strict=True))
        assert after == pytest.approx(factor * before, rel=1e-9, abs=1e-9 * factor, nan_ok=True), f"{text} in {unit}"


@pytest.mark.parametrize("sense", [1, -1])
def test_curvature_is_that_of_the_curve_however_one_moves_on_it(sense):
    """y″/(1 + y′²)^(3/2) of y = 0.4 x² + 0.1 x, to the left as one goes to the right."""
    m = fb.Mechanism(gravity=9.81)
    m.ground.curve("bowl", x="s", y="0.4*s^2 + 0.1*s")
    m.body("ball", shape="particle", mass=1)
    m.curved_slot(along="ground.bowl", point="ball.centre", coordinate="s")
    m.initial(s=0.3, rates={"s": 2 * sense})
    run = m.simulate(0.1)
    expected = sense * 0.8 / (1 + (0.8 * run["s"] + 0.1) ** 2) ** 1.5
    assert run["curvature(ball.centre)"] == pytest.approx(expected, rel=1e-9)

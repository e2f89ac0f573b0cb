"""The return map in symbols against closed forms, at parameters that the model does not have."""

import math

import pytest

import freebody as fb
from freebody.catalogue import find
from freebody.periodic.symbolic_map import NoSymbolicMap
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import PI, Sym


@pytest.mark.parametrize(("file", "section"), [("hinged.yaml", "hit"), ("model.yaml", "foot")])
def test_a_rimless_wheel(file, section):
    """ω₊² = η² (ω² + 4 (mgR/J) sin α sin γ), J = I + mR², η = (I + mR² cos 2α)/J, whatever the numbers are."""
    wheel = fb.Mechanism.load(find("19.3.30").folder / file)
    found = wheel.periodic({"omega": "-rate(wheel.angle)"}, section=section, horizon=3).symbolic()
    m, inertia, R, slope, g, k = 2.0, 0.3, 0.7, 0.2, 3.0, 5
    J, alpha = inertia + m * R**2, math.pi / k
    eta = (inertia + m * R**2 * math.cos(2 * alpha)) / J
    feed = eta**2 * 4 * m * g * R / J * math.sin(alpha) * math.sin(slope)
    values = {Sym(name): x for name, x in dict(m=m, I=inertia, R=R, slope=slope, g=g, k=k, **{PI: math.pi}).items()}
    read = lambda tree: float(evaluate(tree, values))
    assert [read(found.factor), read(found.multiplier), read(found.feed)] == pytest.approx([eta, eta**2, feed], rel=1e-12)
    assert read(found.fixed) == pytest.approx(feed / (1 - eta**2), rel=1e-12)
    assert read(found.begins) == pytest.approx(alpha - slope) and read(found.ends) == pytest.approx(-alpha - slope)


BLOCK = """
freebody: 1
parameters: {m: 3 kg, b: 0.2 m, h: 0.5 m, omega: 0.4 rad/s}
gravity: 9.81 m/s^2
bodies: {block: {mass: m, inertia: m*(b^2 + h^2)/3, points: {left: [-b, -h], right: [b, -h]}}}
ground: {lines: {floor: {through: O, angle: 0 deg}}}
contacts:
  heel: {of: [block.left, ground.floor], rough: true}
  toe: {of: [block.right, ground.floor], rough: true}
initial: {block.x: 0, block.y: h, block.angle: 0, rates: {block.x: h*omega, block.y: b*omega, block.angle: -omega}}
run: {until: 2 s}
"""


def test_a_rocking_block_loses_what_housner_says():
    """ω₊ = (1 − 3/2 sin² α) ω with tan α = b/h (Housner, Bull. Seism. Soc. Am. 53, 1963, 403)."""
    rocking = fb.Mechanism.loads(BLOCK).periodic({"omega": "-rate(block.angle)"}, section="heel").symbolic()
    values = {Sym("m"): 1.0, Sym("b"): 0.3, Sym("h"): 0.4}
    assert float(evaluate(rocking.factor, values)) == pytest.approx(1 - 1.5 * 0.3**2 / (0.3**2 + 0.4**2), rel=1e-12)
    assert evaluate(rocking.feed, values) == 0


def test_what_has_no_map_in_symbols_says_why():
    damped = BLOCK.replace("run:", "forces: {drag: {type: law, along: block.angle, value: -rate(block.angle)*0.01}}\nrun:")
    with pytest.raises(NoSymbolicMap, match="drag"):
        fb.Mechanism.loads(damped).periodic({"omega": "-rate(block.angle)"}, section="heel").symbolic()
    with pytest.raises(NoSymbolicMap, match="goes from impact to impact"):
        fb.Mechanism.loads(BLOCK).periodic({"omega": "-rate(block.angle)"}, period=0.01).symbolic()

"""All values that meet a target, beside closed forms; planted jumps; none."""

import math
import re

import numpy as np
import pytest
from scipy.special import ellipk

import freebody as fb
from freebody.model import user_units
from freebody.model.errors import ModelProblem

G = 9.81
THROW = """
freebody: 1
gravity: 9.81
parameters: {v: 12 m/s, angle: 30 deg}
bodies: {ball: {shape: particle, mass: 1}}
joints: {J: {type: free, of: [ground.O, ball.centre], coordinates: [x, y]}}
initial: {x: 0, y: 0, rates: {x: v*cos(angle), y: v*sin(angle)}}
events: {lands: {when: y, direction: falling, then: stop}}
run: {until: 10}
report: {range: x @ lands}
"""
PENDULUM = """
freebody: 1
gravity: 9.81
bodies: {bob: {shape: particle, mass: 1}, rod: {shape: general, mass: 0, inertia: 0, points: {A: [1, 0]}}}
joints:
  pivot: {type: hinge, of: [ground.O, rod.origin], coordinate: theta}
  end: {type: weld, of: [rod.A, bob.centre]}
initial: {theta: -90 deg, rates: {theta: 1}}
events:
  over: {when: theta - 90 deg, direction: rising, then: stop}
  back: {when: rate(theta), direction: falling, then: stop}
run: {until: 20}
"""
SNAPPING = """
freebody: 1
gravity: none
bodies: {b: {shape: particle, mass: 1}}
joints: {J: {type: slot, along: {through: ground.O, angle: 0 deg}, point: b.centre, coordinate: x}}
forces: {spring: {type: law, along: x, value: -4*x}}
initial: {x: 0, rates: {x: 1}}
events: {snaps: {when: x - 1, direction: rising, then: {release: spring}}}
run: {until: 5}
"""
BUMPS = """
freebody: 1
gravity: none
parameters: {a: 1, height: 1 m}
bodies: {b: {shape: particle, mass: 1}}
joints: {J: {type: free, of: [ground.O, b.centre], coordinates: [x, y]}}
initial: {x: "LAW", y: 0, at_rest: true}
run: {until: 0.1}
"""


def placed(law: str) -> fb.Mechanism:
    """A body at rest at x = law(a)."""
    return fb.Mechanism.loads(BUMPS.replace("LAW", law))


def throw() -> fb.Mechanism:
    return fb.Mechanism.loads(THROW)


def test_both_angles_of_a_throw():
    found = throw().find("range", "10 m", vary="angle", within=("5 deg", "85 deg"))
    flat = math.asin(10 * G / 144) / 2
    assert found.values == pytest.approx([flat, math.pi / 2 - flat], rel=1e-12)
    assert all(abs(root.found - 10) < 1e-9 and root.where.error < 1e-9 for root in found.roots)
    assert "angle = 0.374734406322 rad, = 1.19606192047 rad, and for no other" in found.sentence


def test_answers_are_told_in_the_units_of_choice():
    """Angles in degrees, places in feet of 0.3048 m, in sentences and tables; data stay in SI."""
    found = throw().find("range", "10 m", vary="angle", within=("5 deg", "85 deg"), points=9)
    best = throw().extremes("range", vary="angle", within=("5 deg", "85 deg"), points=9)
    flat = math.degrees(math.asin(10 * G / 144) / 2)
    with fb.units("deg, ft"):
        assert f"range is {10 / 0.3048:.10g} ft for angle = {flat:.10g}" in str(found) and "angle [deg]" in str(found)
        assert "between 5 and 85 deg" in best.sentence and "range [ft]" in str(best) and f"{144 / G / 0.3048:.9g}" in str(best)
        assert found.values[0] == pytest.approx(math.radians(flat), rel=1e-12)


def test_a_parameter_without_a_unit_that_stands_for_an_angle_is_one():
    """sin 2θ = 1/2 for 15 and 75 degrees; the range without a throw upwards is 0, not its round-off."""
    bare = fb.Mechanism.loads(THROW.replace("angle: 30 deg", "angle: 1"))
    best = bare.extremes("range", vary="angle", within=("0 deg", "90 deg"), points=9)
    with fb.units(""):
        user_units.as_asked(None, "5 deg", "0.2 ft")
        assert f"{best.greatest.value / 0.3048:.10g} ft" in best.sentence
    with fb.units("deg"):
        user_units.as_asked("1 rad")
        assert "least, 0 m, at angle = " in best.sentence and "between 0 and 90 deg" in best.sentence
        found = bare.find("range", 72 / G, vary="angle", within=("5 deg", "85 deg"), points=9)
        assert "angle = 15" in found.sentence and ", = 75" in found.sentence


def test_the_furthest_throw_is_a_root_that_touches_and_an_extreme():
    furthest = 144 / G
    (root,) = throw().find("x @ lands", furthest, vary="angle", within=("5 deg", "85 deg")).roots
    assert root.touching and root.where == pytest.approx(math.pi / 4, abs=2 * root.where.error) and root.where.error < 1e-5
    best = throw().extremes("range", vary="angle", within=("5 deg", "85 deg"))
    assert best.greatest.value == pytest.approx(furthest, rel=1e-12)
    assert best.greatest.where == pytest.approx(math.pi / 4, abs=1e-6) and not best.greatest.at_edge
    assert best.least.at_edge and best.least.value == pytest.approx(furthest * math.sin(math.radians(10)), rel=1e-12)


def test_none_is_said_with_what_there_is():
    found = throw().find("range", 15, vary="angle", within=("5 deg", "85 deg"))
    assert found.values == [] and "for no angle" in found.sentence and "2.54896 to 14.6789 m" in found.sentence


def test_a_rate_of_the_start_and_the_critical_speed_below_which_it_is_never_so():
    """A swing of amplitude A from the bottom takes K(sin²A/2)/√(g/l) to its turn; below 2√(g/l) it never comes over."""
    pendulum, critical = fb.Mechanism.loads(PENDULUM), 2 * math.sqrt(G)
    swing = math.radians(120)
    quarter = float(ellipk(math.sin(swing / 2) ** 2)) / math.sqrt(G)
    (root,) = pendulum.find("t @ back", quarter, vary="rate(theta)", within=(3, 6), rtol=1e-12).roots
    assert root.where == pytest.approx(critical * math.sin(swing / 2), rel=1e-10)
    found = pendulum.find("t @ over", 0.4, vary="rate(theta)", within=(1, 15), rtol=1e-12)
    w = found.values[0]
    half = float(ellipk((critical / w) ** 2)) * 2 / w
    assert half == pytest.approx(0.4, rel=1e-10) and len(found.roots) == 1
    (edge,) = found.breaks
    assert edge.x == pytest.approx(critical, rel=1e-8) and edge.reason == "below there is no value: over did not happen"


def test_a_jump_over_the_target_is_named_and_is_no_root():
    """A spring that snaps at 1 m: pushed off with less than ω · 1 m the mass swings, x = (v/ω) sin ωt; with more it flies away."""
    found = fb.Mechanism.loads(SNAPPING).find("x @ 2 s", 0.2, vary="rate(x)", within=(1, 4))
    assert found.values == []
    (jump,) = found.breaks
    assert jump.x == pytest.approx(2, rel=1e-8) and jump.reason == "below, nothing more comes; above, snaps"
    assert (jump.below.y, jump.above.y) == pytest.approx((math.sin(4), 1), abs=1e-3)
    swing = fb.Mechanism.loads(SNAPPING).find("x @ 2 s", -0.5, vary="rate(x)", within=(1, 4))
    assert swing.values == pytest.approx([-1 / math.sin(4)], rel=1e-8)


def test_a_planted_jump_is_found_where_it_is():
    found = placed("height*(a + if(a > 1.7, 3, 0))").find("x @ start", 3, vary="a", within=(0, 4))
    assert found.values == []
    (jump,) = found.breaks
    assert jump.x == pytest.approx(1.7, abs=1e-12) and jump.jump == pytest.approx(3, abs=1e-9)
    assert "jumps from 1.7 to 4.7: the same happens on both sides" in str(found)


def test_roots_are_found_between_the_first_samples():
    """All zeros of sin(a²): they crowd together."""
    found = placed("height*sin(a^2)").find("x @ start", 0, vary="a", within=(1, 12), points=17)
    assert found.values == pytest.approx([math.sqrt(n * math.pi) for n in range(1, 46)], rel=1e-9)
    assert len(found.curve.samples) > 200 and found.curve.unresolved == []


def test_where_it_is_so_throughout():
    found = placed("height*max(a, 2)").find("x @ start", 2, vary="a", within=(0, 4))
    (interval,) = found.throughout
    assert interval == pytest.approx((0, 2), abs=1e-8) and "from 0 to" in found.sentence


def test_many_random_polynomials():
    rng = np.random.default_rng(5)
    for _ in range(20):
        zeros = np.sort(rng.uniform(-1, 1, 5))
        if np.diff(zeros).min() < 0.02:
            continue
        law = "*".join(f"(a - ({zero!r}))" for zero in zeros.tolist())
        found = placed(f"height*{law}").find("x @ start", 0, vary="a", within=(-1, 1))
        assert found.values == pytest.approx(zeros.tolist(), abs=1e-11), law


@pytest.mark.parametrize(
    ("asked", "vary", "says"),
    [
        ("range", "angel", "`angel` is no parameter, coordinate or `rate(coordinate)`"),
        ("speed(bal) @ lands", "angle", "bal"),
        ("maxima of x", "angle", "`maxima of x` is several figures"),
    ],
)
def test_wrong_words_are_answered(asked, vary, says):
    with pytest.raises((ModelProblem, fb.ModelFileError), match=re.escape(says)):
        throw().find(asked, 1, vary=vary, within=(0.1, 1))


def test_what_has_no_value_anywhere_is_refused():
    with pytest.raises(ValueError, match="lands did not happen"):
        throw().find("range", 1, vary="v", within=(5, 6), angle=1.0, until=0.01)


def test_where_two_runs_part_no_root_is_lost_and_none_has_digits(monkeypatch):
    from freebody.find.response import Response
    from freebody.solve.figures import Known

    known = Response.known
    monkeypatch.setattr(Response, "known", lambda self, x: Known(float(known(self, x)), math.inf, 1.0))
    found = throw().find("range", "10 m", vary="angle", within=("5 deg", "85 deg"))
    flat = math.asin(10 * G / 144) / 2
    assert found.values == pytest.approx([flat, math.pi / 2 - flat], rel=1e-9)
    assert all(root.where.error == math.inf and root.where.digits == 0 for root in found.roots)
    assert "0.3747" not in found.sentence and "1.196" not in found.sentence, found.sentence

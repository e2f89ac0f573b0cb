"""States near by: loops closed, what touches touching, drives set aside; and what they teach about what drops out."""

import numpy as np
import pytest

import freebody as fb
from freebody.catalogue import model_file
from freebody.core import FreeBodies
from freebody.equations.balances.smallest import smallest_set
from freebody.solve.perturbed_states import nearby


def leaning(friction=None):
    """A rod against a floor and a wall, which hold it by contacts."""
    m = fb.Mechanism("ladder")
    rod = m.rod("ladder", length="2 m", mass="3 kg")
    m.free(m.ground.O, rod.G, name="place", coordinates=["x", "y", "turn"])
    floor, wall = (m.ground.line(name, m.ground.O, angle=angle) for name, angle in (("floor", 0), ("wall", "-90 deg")))
    words = {"friction": friction} if friction else {}
    m.contact("foot", floor, rod.start, **words)
    m.contact("top", wall, rod.end)
    m.initial(x="1 m * cos(60 deg)", y="1 m * sin(60 deg)", turn="120 deg", at_rest=True)
    return m


def gaps_of_joints(free):
    """Distances between the points at which one joint acts on its two bodies."""
    return [np.hypot(*np.subtract(load.on[0].point, load.on[1].point)) for load in free.loads if load.component in ("x", "y")]


@pytest.mark.parametrize("file", ["GEN-FOURBAR/model", "GEN-SLIDER/model", "EX-ARM/model", "19.3.16/driven"])
def test_states_near_by_are_others_and_close_every_loop(file):
    m = fb.load(model_file(file))
    free = nearby(m.source(), m.start()[0])
    assert len(free) == 4
    for other in free[1:]:
        assert max(gaps_of_joints(other)) < 1e-12
        for name in other.bodies:
            assert other.balance_gap(name) < 1e-9
        assert any(np.hypot(*np.subtract(other.bodies[name].G, free[0].bodies[name].G)) > 1e-3 for name in other.bodies)


def test_what_touches_goes_on_touching():
    m = leaning()
    for other in nearby(m.source(), m.start()[0]):
        foot, top = (next(load for load in other.loads if load.name == name).on[-1].point for name in ("foot", "top"))
        assert foot[1] == pytest.approx(0, abs=1e-11)
        assert top[0] == pytest.approx(0, abs=1e-11)


def test_a_ladder_on_contacts_turns_about_the_point_where_their_normals_meet():
    (equation,) = leaning().smallest("turn").equations
    assert equation.about == "the point where the lines of foot.N and top.N meet"
    np.testing.assert_allclose(equation.at, (1.0, np.sqrt(3)), atol=1e-9)


def test_friction_that_slides_goes_with_its_normal_force():
    """A ladder that slides with friction at its foot: the line of the two together is what passes through the point."""
    m = leaning(friction=0.2)
    found = m.smallest("turn")
    assert found.check < 1e-9
    (equation,) = found.equations
    free = m.free_bodies()
    normal, rub = (next(load for load in free.loads if load.symbol == name) for name in ("foot.N", "foot.T"))
    both = normal.acting(["ladder"], equation.at) + rub.acting(["ladder"], equation.at)
    assert abs(both[2]) < 1e-9
    assert abs(rub.acting(["ladder"], equation.at)[2]) > 1e-3
    with pytest.raises(KeyError, match=r"times foot\.N, by the law of friction"):
        m.smallest("foot.T")


def test_a_body_on_which_nothing_acts_is_still_a_state():
    assert isinstance(fb.load(model_file("19.3.2/model")).minimal_form().equations, tuple)


def test_a_set_from_a_moment_without_its_neighbours_says_so():
    m = leaning()
    free = m.free_bodies()
    assert not smallest_set("turn", [free]).structural
    assert smallest_set("turn", nearby(m.source(), m.start()[0])).structural
    assert isinstance(free, FreeBodies)

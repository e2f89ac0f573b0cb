"""Impulses as data, from the momentum of single bodies, against what the run finds in another way, and against closed forms."""

import numpy as np
import pytest
from colliding import ALL, CATALOGUE, TEXTS, first_impacts, mechanism
from numpy.testing import assert_allclose
from store import every

from freebody import catalogue
from freebody.impact.impacts import NoImpact

every_model = every(ALL, "name", share=2)
CLOSE = 1e-9
"""Relative to the largest impulse: both routes solve linear systems of a few unknowns in double precision, at places where gaps
are closed within 1e-10 of the mechanism's length."""


def size(impact):
    stated = [load.value for load in impact.impulses.loads if load.determinate]
    return max(map(abs, stated))


@every_model
def test_impulses_on_any_group_add_up_to_its_jump_of_momentum(name):
    for impact in first_impacts(name):
        free = impact.impulses
        if not all(load.determinate for load in free.loads):
            continue
        for group in [*((body,) for body in free.bodies), tuple(free.bodies)]:
            gap = free.acting(*group) - free.effective(*group)
            assert np.abs(gap).max() < CLOSE * max(1.0, size(impact)), (group, gap)


@every_model
def test_impulses_of_contacts_strings_and_stops_are_those_of_the_run(name):
    for impact in first_impacts(name):
        stated = impact.change.impulses
        for limit, (x, y) in stated.contacts.items():
            first = next(each["first"] for each in impact.run.metadata["limits"] if each["name"] == limit)
            loads = [load for load in impact.impulses.loads if load.name == limit]
            if all(load.determinate for load in loads):
                found = sum(load.acting([first])[:2] for load in loads)
                assert_allclose(found, (x, y), atol=CLOSE * size(impact))
        for stop, impulse in stated.stops.items():
            [load] = [load for load in impact.impulses.loads if load.name == stop]
            assert load.value == pytest.approx(impulse, rel=CLOSE)


@every_model
def test_impulses_of_joints_are_those_of_the_run(name):
    """The run passes them from body to body along the tree; here every body has its balance."""
    for impact in first_impacts(name):
        joints = {joint["name"]: joint for joint in impact.run.metadata["joints"]}
        for joint, (x, y, _) in impact.change.impulses.joints.items():
            loads = [load for load in impact.impulses.loads if load.name == joint and load.kind == "joint"]
            if all(load.determinate for load in loads):
                found = sum((load.acting([joints[joint]["second"]])[:2] for load in loads), np.zeros(2))
                assert_allclose(found, (x, y), atol=CLOSE * size(impact), err_msg=joint)


@every_model
def test_what_is_finite_has_no_impulse(name):
    for impact in first_impacts(name):
        acting = {load.symbol for load in impact.impulses.loads}
        assert not acting & {load.symbol for load in impact.finite}
        weights = {load.of[-1] for load in impact.finite if load.kind == "weight"}
        said = " ".join(impact.absent())
        assert all(f"weight of {body}" in said for body in weights)


def test_all_models_of_the_catalogue_with_an_impact_are_visited():
    found = set()
    for system in catalogue.systems():
        for path in system.models:
            try:
                run = mechanism(f"{system.id}/{path.stem}").simulate()
            except ValueError:  # no end, or no start
                continue
            found |= {f"{system.id}/{path.stem}"} if run.impacts else set()
    assert found == CATALOGUE


def test_friction_on_two_feet_is_not_reported():
    """A plate that lands flat and slides on neither: their friction together is known, not that of each."""
    [impact] = first_impacts("plate")
    unknown = {load.symbol for load in impact.impulses.loads if not load.determinate}
    assert unknown in ({"left.T", "right.T"}, set())


def test_a_stop_tells_its_impulse():
    """A rod on a pin: (1 + e) I ω about the pin."""
    [impact, *_] = first_impacts("door")
    before = impact.change.before.u["th"]
    assert impact.change.impulses.stops == {"wall": pytest.approx(1.6 * 1.5**2 / 3 * abs(before), rel=1e-12)}
    assert impact.change.impulses.contacts == {}


def test_what_lets_go_and_what_rubs_is_said():
    [walking] = first_impacts("GEN-STEP/model")[:1]
    assert any("which opens" in sentence for sentence in walking.absent()) == bool(walking.change.impulses.spared)
    assert any("friction of pin" in sentence for sentence in first_impacts("door")[0].absent("bob"))
    assert any("oil" in sentence for sentence in first_impacts("door")[0].absent("bob"))


def test_impacts_are_chosen_by_number_name_and_time():
    wheel = mechanism("19.3.30/model")
    second, fourth = wheel.blow(2), wheel.blow(1, of="foot[4]")
    assert second.change.of == ("foot[3]",) and fourth.change.of == ("foot[4]",)
    assert wheel.blow(1, at=second.change.t + 1e-6).change.t == fourth.change.t
    with pytest.raises(NoImpact, match="1 impacts of foot"):
        wheel.blow(2, of="foot[4]")


def test_what_touches_and_approaches_at_the_start_strikes_then():
    """So an impact is had at any place and with any velocities."""
    from freebody import Mechanism

    text = TEXTS["ball_on_bar"].replace("y: 0.3 m", "y: 0 m")
    [later], now = first_impacts("ball_on_bar"), Mechanism.loads(f"freebody: 1\n{text}", "now").blow()
    assert now.change.t == 0.0
    assert now.change.impulses.contacts["knock"] == pytest.approx(later.change.impulses.contacts["knock"], rel=1e-9)

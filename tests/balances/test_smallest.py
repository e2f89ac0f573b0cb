"""The smallest set: never beaten by brute force, equal to the full solve, and what a textbook would choose."""

import numpy as np
import planar
import pytest
from by_brute_force import DRAWN as MODELS
from by_brute_force import MOST, TARGETS, asked, fewest, states
from store import every

import freebody as fb
from freebody.catalogue import model_file
from freebody.core import FreeBodies, Indeterminate
from freebody.equations.balances.smallest import smallest_set, virtual_power
from freebody.equations.balances.system import problem

CONSTRUCTED = {"ladder ladder.angle", "19.3.9/model pivot.Fx", "19.3.10/model pivot.Fy", "S19.16/model pivot.Fx"}
"""Targets for which a point or a direction has no name but how it is constructed."""


@pytest.mark.parametrize("name", MODELS)
def test_brute_force_over_sets_points_and_directions_never_beats_the_search(name):
    given = states(MODELS[name])
    free = problem(given)
    chosen = range(len(free.unknowns)) if len(free.bodies) < 4 else range(0, len(free.unknowns), 4)
    for i in chosen:
        unknown = free.unknowns[i]
        found = smallest_set(unknown.name, given)
        number = len(found.equations)
        assert fewest(problem(given, unknown.coordinate), i, number - 1 if number else MOST) is None, unknown.name


@every(TARGETS, "target")
def test_no_set_of_sixty_targets_is_beaten(target):
    """Nor is one larger than the fewest equations that there are."""
    given, points, wanted = asked(target)
    found = smallest_set(wanted, given, points)
    assert found.check < 1e-9
    own = problem(given, wanted)
    assert fewest(own, own.place(wanted), len(found.equations), points) == len(found.equations)


@pytest.mark.long
def test_points_and_directions_have_names_where_a_person_has_them():
    """A point is constructed, where two lines of action meet, only where that saves an equation."""
    sets = [smallest_set(wanted, given, points) for given, points, wanted in map(asked, TARGETS)]
    named = [not any(equation.constructed for equation in each.equations) for each in sets]
    assert np.mean(named) >= 0.9


@every([target for target in TARGETS if target not in CONSTRUCTED], "target")
def test_the_points_of_a_set_asked_for_by_their_names_give_it_again(target):
    given, points, wanted = asked(target)
    found = smallest_set(wanted, given, points)
    names = [equation.about if equation.kind == "AMB" else f"along {equation.about}" for equation in found.equations]
    again = smallest_set(wanted, given, points, about=names)
    assert len(again.equations) == len(found.equations) and again.check < 1e-9
    assert again.value == pytest.approx(found.value, rel=1e-9, abs=1e-9)


def test_an_instructor_may_choose_the_points():
    given, points, wanted = asked("GEN-FOURBAR/model drive")
    bodies = {equation.about: equation.bodies for equation in smallest_set(wanted, given, points, about="BDA").equations}
    assert bodies == {"B": ("bc",), "D": ("dc",), "A": ("ab", "bc")}
    with pytest.raises(ValueError, match=r"no bodies have balances about A, A, A that give drive\.force"):
        smallest_set(wanted, given, points, about="AAA")
    with pytest.raises(ValueError, match=r"'Q' is no point or direction; there are A, B,.* along x"):
        smallest_set(wanted, given, points, about=["Q"])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("name", MODELS)
def test_every_set_solved_again_gives_what_the_full_solve_gives(name, seed):
    given = states(MODELS[name], seed)
    for unknown in problem(given).unknowns:
        found = smallest_set(unknown.name, given)
        assert found.check < 1e-9, unknown.name
        names = {name for equation in found.equations for name in equation.unknowns}
        assert len(names) == len(found.equations)
        assert found.wanted in found.values


@pytest.mark.parametrize("name", MODELS)
def test_an_equation_and_its_reasons_name_every_unknown_that_touches_its_bodies_once(name):
    given = states(MODELS[name])
    free = given[0]
    for unknown in problem(given).unknowns:
        for equation in smallest_set(unknown.name, given).equations:
            touching = {
                load.symbol for load in free.loads if load.unknown and any(part.body in equation.bodies for part in load.on)
            }
            dropped = [name for item in equation.dropped for name in item.unknowns]
            stated = [name for name in (*equation.unknowns, *dropped) if not name.startswith("accel(")]
            assert len(stated) == len(set(stated))
            assert set(stated) == touching


@pytest.mark.parametrize("name", MODELS)
def test_an_equation_is_the_balance_of_its_bodies_about_its_point(name):
    given = states(MODELS[name])
    free = given[0]
    for unknown in problem(given).unknowns:
        for equation in smallest_set(unknown.name, given).equations:
            names = {load.symbol: load for load in free.loads}
            for name, coefficient in equation.coefficients.items():
                if name in names:
                    unit = names[name].unit(equation.bodies, equation.at if equation.kind == "AMB" else (0.0, 0.0))
                    stated = unit[2] if equation.kind == "AMB" else np.dot(unit[:2], equation.at)
                    assert coefficient == pytest.approx(stated, abs=1e-9)


@pytest.mark.parametrize("name", MODELS)
def test_virtual_power_gives_every_unknown_alone(name):
    given = problem(states(MODELS[name]))
    full = given.systems[0].values(given.unknowns)
    for i, value in enumerate(full):
        assert virtual_power(given, i).right == pytest.approx(value, rel=1e-9, abs=1e-9)


def titles(found):
    return {equation.title for equation in found.equations}


def test_the_torque_of_a_four_bar_takes_three_equations_in_it_and_one_pin():
    found = smallest_set("T", states(planar.four_bar))
    assert titles(found) == {"AMB about A for coupler", "AMB about C for rocker", "AMB about O for crank + coupler"}
    assert set(found.values) == {"T.force", "B.Fx", "B.Fy"}


def pushed(rng):
    """A four-bar that a given couple turns."""
    made = planar.four_bar(rng, driven=False)
    parts = [("crank", (0, 0), (0.0, 0.0), -3.0), ("ground", (0, 0), (0.0, 0.0), 3.0)]
    made.load("motor", ("ground", "crank"), parts)
    return made


def test_a_torque_that_is_given_is_found_from_the_motion_that_it_makes():
    found = smallest_set("motor", states(pushed))
    assert titles(found) == titles(smallest_set("T", states(planar.four_bar)))
    assert found.value == pytest.approx(-3.0, rel=1e-12)
    assert found.known_motion


def test_with_the_motion_known_a_reaction_takes_no_acceleration():
    pendulum = states(lambda rng: planar.chain(rng, 2))
    found = smallest_set("B.Fx", pendulum, known_motion=True)
    assert titles(found) == {"LMB along x for rod2"}
    assert found.check < 1e-9


def test_the_torque_at_the_base_of_a_chain_takes_one():
    found = smallest_set("T1", states(lambda rng: planar.driven_chain(rng, 6)))
    assert titles(found) == {"AMB about A for rod1 + rod2 + rod3 + rod4 + rod5 + rod6"}


def test_a_ladder_turns_by_one_equation_about_the_point_where_its_forces_meet():
    (equation,) = smallest_set("ladder.angle", states(planar.ladder)).equations
    free = states(planar.ladder)[0]
    points = {load.name: load.on[0].point for load in free.loads}
    np.testing.assert_allclose(equation.at, (points["floor"][0], points["wall"][1]), atol=1e-12)
    assert equation.constructed
    assert equation.dropped[0].why == "their lines of action pass through that point"


def test_along_a_slope_what_holds_the_block_drops_out():
    (equation,) = smallest_set("block.x", states(planar.block_on_slope)).equations
    assert equation.title == "LMB along slope for block"
    assert {item.unknowns: item.why for item in equation.dropped} == {
        ("slope.Fn",): "it is perpendicular to slope",
        ("slope.M",): "it is a couple, which has no part in a force balance",
    }


def test_what_is_zero_here_by_chance_is_not_taken_to_drop_out():
    """A four-bar with crank and coupler in one line, along x: here A.Fx has no moment about O, but only here."""

    def stretched(rng):
        made = planar.Fake(rng)
        made.rod("crank", (0, 0), (0.5, 0), 1.0)
        made.rod("coupler", (0.5, 0), (1.7, 0), 2.0)
        made.rod("rocker", (1.5, -1.0), (1.7, 0), 1.5)
        for name, first, second, at in (
            ("O", "ground", "crank", (0, 0)),
            ("A", "crank", "coupler", (0.5, 0)),
            ("B", "coupler", "rocker", (1.7, 0)),
            ("C", "ground", "rocker", (1.5, -1.0)),
        ):
            made.hinge(name, first, second, at)
        made.motor("T", "ground", "crank", 1.0)
        return FreeBodies.read(made.data())

    here = stretched(np.random.default_rng(0))
    alone, among = smallest_set("T", [here]), smallest_set("T", [here, *states(planar.four_bar)])
    assert (len(alone.equations), alone.structural) == (2, False)
    assert (len(among.equations), among.structural) == (3, True)
    assert among.check < 1e-9


def test_the_files_of_the_catalogue_agree_with_the_full_solve():
    for file, wanted, number in (
        ("GEN-FOURBAR/model", "drive", 3),
        ("19.3.16/driven", "push", 1),
        ("EX-ARM/model", "theta1", 2),
        ("EX-ARM/model", "shoulder.Fy", 3),
    ):
        found = fb.load(model_file(file)).smallest(wanted)
        assert len(found.equations) == number
        assert found.check < 1e-9
        assert found.structural


def test_what_is_not_unknown_or_not_determined_is_refused():
    given = states(planar.four_bar)
    with pytest.raises(KeyError, match=r"'Q'; there are O\.Fx, O\.Fy"):
        smallest_set("Q", given)
    with pytest.raises(KeyError, match="follows from motions and loops"):
        smallest_set("crank.angle", given)
    stated = planar.ladder(np.random.default_rng(2)).data()
    stated["loads"][0]["determinate"] = False
    with pytest.raises(Indeterminate, match=r"floor\.Fn"):
        smallest_set("floor.Fn", [FreeBodies.read(stated)])

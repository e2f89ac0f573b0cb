"""Free bodies as data: complete, opposite in pairs, and in balance with the motion, alone and in any group."""

from itertools import chain as flat
from itertools import combinations, pairwise

import numpy as np
import planar
import pytest
import store
from store import SYSTEMS, WITHOUT_ANSWER, every

from freebody.core import FreeBodies, Indeterminate

MODELS = {
    "double pendulum": lambda rng: planar.chain(rng, 2),
    "chain of four, driven": lambda rng: planar.driven_chain(rng, 4),
    "four-bar": planar.four_bar,
    "block on a slope": planar.block_on_slope,
    "ladder": planar.ladder,
    "slider-crank": planar.slider_crank,
}


FILES = ["GEN-FOURBAR/model", "GEN-SLIDER/model", "19.3.16/driven", "EX-ARM/model", "19.3.20/model"]


@pytest.fixture(params=[*MODELS, *FILES])
def free(request):
    if request.param in FILES:
        return store.free_bodies(request.param)
    return FreeBodies.read(MODELS[request.param](np.random.default_rng(7)).data())


def groups(free):
    return flat.from_iterable(combinations(free.bodies, k) for k in range(1, len(free.bodies) + 1))


def test_the_loads_on_every_group_add_up_to_its_effective_side(free):
    for group in groups(free):
        assert free.balance_gap(*group) < 1e-12
        for about in ((0.0, 0.0), (1.3, -0.7)):
            np.testing.assert_allclose(free.acting(*group, about=about), free.effective(*group, about=about), atol=1e-10)


INDETERMINATE = {"GEN-CAR/model", "GEN-CAR/driveshaft", "GEN-SLIDER/dead_point"}  # what guides and loops share among themselves
every_model = every(sorted(set(SYSTEMS) - WITHOUT_ANSWER))


@every_model
def test_of_every_model_the_loads_on_every_group_add_up(model):
    """To m a and its moment plus I α about any place; round-off is that of the largest force over the size of the mechanism."""
    free = store.free_bodies(model)
    places = np.array([body.G for body in free.bodies.values()] + [part.point for load in free.loads for part in load.on])
    parts = [(load.value, part) for load in free.loads if load.determinate for part in load.on]
    force = max((np.abs(value * np.array(part.force)).max() for value, part in parts), default=0.0)
    couple = max((abs(value * part.couple) for value, part in parts), default=0.0)
    size = np.hypot(*np.ptp(places, axis=0)) + couple / (force or 1.0)
    known = [group for group in groups(free) if all(load.determinate for load in free.on(*group))]
    assert (len(known) < 2 ** len(free.bodies) - 1) == (model in INDETERMINATE)
    for group in known:
        for about in (free.centre(*group), (1.3, -0.7)):
            gap = np.abs(free.acting(*group, about=about) - free.effective(*group, about=about))
            reach = size + np.hypot(*np.subtract(about, places).T).max()
            particle = len(group) == 1 and free.bodies[group[0]].particle  # which has no balance of moments
            assert (gap[:2] <= 1e-12 * force).all() and (particle or gap[2] <= 1e-12 * force * reach + 1e-15)


@every_model
def test_of_every_model_the_loads_give_the_motion(model):
    """m times the rate of the velocities that the run has, by differences over a thousandth of a while in which nothing switches.
    Those of the liveliest motions are good to 1e-3, of most to 1e-8."""
    run = store.run(model)
    changes = [run.t[0], *(change.t for change in run.changes), run.t[-1]]
    start, end = max(pairwise(changes), key=lambda pair: pair[1] - pair[0])
    t, h = 0.6 * start + 0.4 * end, 1e-3 * (end - start)
    free = run.instant(t).free_bodies()
    for name, body in free.bodies.items():
        loads = free.on(name)
        if not all(load.determinate for load in loads):
            continue
        acting = free.acting(name, about=body.G)[:2]
        ends = [[run.evaluate(f"rate({x}({name}.G))", t + k * h) for x in "xy"] for k in (-2, -1, 1, 2)]
        rate = np.array([1, -8, 8, -1]) @ np.array(ends) / (12 * h)
        force = max((np.abs(load.value * np.array(part.force)).max() for load in loads for part in load.on), default=0.0)
        np.testing.assert_allclose(acting, body.mass * rate, rtol=0, atol=3e-3 * force + 1e-9)


def test_a_load_forgotten_or_turned_round_leaves_a_gap(free):
    for load in free.loads:
        rest = FreeBodies(free.bodies, tuple(other for other in free.loads if other is not load), free.rows)
        bodies = [part.body for part in load.on if part.body in free.bodies]
        acts = np.abs(load.acting(bodies[:1])).max() > 1e-9
        assert not acts or rest.balance_gap(bodies[0]) > 1e-6


def test_what_acts_within_a_group_is_left_out_and_adds_up_to_nothing(free):
    for group in groups(free):
        for load in free.inside(*group):
            assert load not in free.on(*group)
            np.testing.assert_allclose(load.unit(group), 0, atol=1e-12)
        touching = {load.symbol for load in free.loads if any(part.body in group for part in load.on)}
        assert {load.symbol for load in (*free.on(*group), *free.inside(*group))} == touching


def test_a_weight_is_on_the_diagram_of_all_bodies_together():
    free = FreeBodies.read(planar.chain(np.random.default_rng(1), 3).data())
    assert sum(load.kind == "weight" for load in free.on(*free.bodies)) == 3
    assert {load.name for load in free.on(*free.bodies) if load.kind == "joint"} == {"A"}


def test_the_accelerations_are_affine_in_those_of_the_coordinates(free):
    for body in free.bodies.values():
        motion = (
            sum(free.accelerations[name] * np.array(by) for name, by in body.by_accelerations.items()) + body.bias_acceleration
        )
        np.testing.assert_allclose(motion, (*body.a, body.alpha), atol=1e-10)
    for row in free.rows:
        left = sum(c * free.accelerations[name] for name, c in row.coefficients.items())
        assert left == pytest.approx(row.right, abs=1e-10)


def test_what_is_not_determined_is_refused():
    fakes = planar.ladder(np.random.default_rng(2))
    stated = fakes.data()
    stated["loads"][0]["determinate"] = False
    free = FreeBodies.read(stated)
    with pytest.raises(Indeterminate, match="floor"):
        free.acting("ladder")


def test_a_body_that_is_not_there_is_named():
    free = FreeBodies.read(planar.four_bar(np.random.default_rng(2)).data())
    with pytest.raises(KeyError, match="'lever'; there are crank, coupler, rocker"):
        free.on("lever")


def test_what_is_determined_is_the_same_in_loads_and_reactions():
    """Of a car whose frame and axle may press each other up and down by any amount, the thrust of the road is determined."""
    car = store.mechanism("GEN-CAR/model")
    thrust, weight = (
        next(load for load in store.free_bodies("GEN-CAR/model").loads if load.symbol == name) for name in ("road.Fs", "road.Fn")
    )
    assert thrust.determinate and not weight.determinate
    assert thrust.value == pytest.approx(car.solve(route="newton_euler").reactions["road"].Fx, rel=1e-12)

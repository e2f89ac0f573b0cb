"""The minimal form: as many equations as degrees of freedom, without reactions where a tree or a ladder has such."""

from itertools import combinations

import numpy as np
import planar
import pytest
import store
from by_brute_force import DRAWN as MODELS
from by_brute_force import connected, states
from store import ANSWERED, every

from freebody.equations.balances.minimal import minimal_form, regular
from freebody.equations.balances.system import problem
from freebody.solve.perturbed_states import nearby

KEPT_OUT = {
    "free four-bar": 2,
    "free slider-crank": 2,
}
"""Reactions that stay in a model that moves; the others need none."""


def null_space(rows):
    _, sizes, turn = np.linalg.svd(rows)
    return turn[(sizes > 1e-9).sum() :]


def free_models():
    return [
        name for name in MODELS if not any(driven in name for driven in ("driven", "four-bar", "slider", "six")) or "free" in name
    ]


def solved(form, coordinates):
    unknowns = [*(f"accel({name})" for name in coordinates), *form.stays]
    rows = np.array([[equation.coefficients.get(name, 0.0) for name in unknowns] for equation in form.equations])
    return dict(zip(unknowns, np.linalg.solve(rows, [equation.right for equation in form.equations]), strict=True))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", [name for name in free_models() if name != "branched"])
def test_the_form_gives_the_accelerations_of_the_full_solve(name, seed):
    given = states(MODELS[name], seed)
    form = minimal_form(given)
    assert len(form.stays) == KEPT_OUT.get(name, 0)
    assert len(form.equations) == len(form.coordinates) + len(form.stays)
    values = solved(form, form.coordinates)
    for coordinate in form.coordinates:
        assert values[f"accel({coordinate})"] == pytest.approx(given[0].accelerations[coordinate], rel=1e-8)


@pytest.mark.parametrize("name", ["free four-bar", "free slider-crank"])
def test_what_is_said_not_to_be_kept_out_is_in_every_set(name):
    """Fewer loads do not do, whichever they are and whatever the motions of connected sets."""
    given = problem(states(MODELS[name]))
    loads = [i for i, unknown in enumerate(given.unknowns) if unknown.load is not None]
    rest = [i for i, unknown in enumerate(given.unknowns) if unknown.load is None]
    sums = np.array([given.systems[0].columns[:, list(group)].sum(axis=1) for group in connected(given)])
    for k in range(KEPT_OUT[name]):
        for stays in combinations(loads, k):
            kept, out = [*rest, *stays], [i for i in loads if i not in stays]
            rows = np.vstack([null_space(group[out]) @ group[kept].T for group in sums])
            assert np.linalg.matrix_rank(rows, tol=1e-9) < len(kept)


BRUTE = 5
"""Bodies of which all sets are tried."""
LARGE = {"GEN-CAR/model", "GEN-CAR/driveshaft", "GEN-STEP/model", "GEN-STEP/floor"}
IMMOBILE = {"examples/beam_held_twice"}


def every_set(given, kept):
    """The rank of all balances of all connected sets in the unknowns ``kept``, whatever the motions, at the last state."""
    out = [i for i in range(len(given.unknowns)) if i not in kept]
    columns = given.systems[-1].columns
    columns = columns / (np.linalg.norm(columns, axis=(1, 2), keepdims=True) + 1e-300)
    sums = np.array([columns[:, list(group)].sum(axis=1) for group in connected(given)])
    rows = np.vstack([null_space(group[out].reshape(-1, 3)) @ group[kept].T for group in sums])
    return np.linalg.matrix_rank(rows, tol=1e-7)


@every(sorted(set(ANSWERED) - LARGE - IMMOBILE))
def test_the_set_has_the_fewest_reactions_and_nothing_smaller_exists(model):
    at = store.subject(model)
    seen = nearby(at.source, at.state)
    given = problem(regular(seen))
    form = minimal_form(seen, forces=True)
    assert len(given.bodies) <= BRUTE and form.wanted
    names = [*(f"accel({name})" for name in form.coordinates), *form.forces, *form.frictional]
    wanted = [i for i, unknown in enumerate(given.unknowns) if unknown.name in names]
    loads = [i for i in range(len(given.unknowns)) if i not in wanted]
    assert every_set(given, wanted) == len(wanted) or form.least > 0
    for k in range(min(form.least, 3)):
        for stays in combinations(loads, k):
            assert every_set(given, [*wanted, *stays]) < len(wanted) + k
    if form.equations:
        stay = [i for i, unknown in enumerate(given.unknowns) if unknown.name in form.stays]
        assert len(stay) == form.least
        assert every_set(given, [*wanted, *stay]) == len(wanted) + len(stay)


def titles(form):
    return [equation.title for equation in form.equations]


def test_textbook_forms_have_their_textbook_names():
    assert titles(minimal_form(states(lambda rng: planar.chain(rng, 2)))) == [
        "AMB about B for rod2",
        "AMB about A for rod1 + rod2",
    ]
    assert titles(minimal_form(states(planar.car_on_slope))) == ["AMB about pin for rod", "LMB along slope for block + rod"]
    assert titles(minimal_form(states(planar.block_on_slope))) == ["LMB along slope for block"]
    (ladder,) = titles(minimal_form(states(planar.ladder)))
    assert ladder == "AMB about the point where the lines of floor.Fn and wall.Fn meet for ladder"


def test_an_arm_from_a_file_and_how_it_is_reported():
    form = store.mechanism("EX-ARM/model").minimal_form()
    assert titles(form) == ["AMB about elbow for forearm", "AMB about shoulder for upper + forearm"]
    stated = str(form)
    assert "elbow.Fx, elbow.Fy: they act at elbow" in stated
    assert "they are internal to upper + forearm" in stated


def test_the_force_of_a_motion_takes_the_place_of_the_acceleration_that_it_prescribes():
    form = minimal_form(states(planar.four_bar), forces=True)
    assert (form.coordinates, form.forces, len(form.equations), form.least) == ((), ("T.force",), 3, 2)


def test_a_mechanism_that_motions_move_has_no_equation_of_motion():
    form = minimal_form(states(planar.four_bar))
    assert (form.coordinates, form.equations, form.stays) == ((), (), ())
    assert "prescribe every acceleration" in str(form)

"""The fewest balance equations by brute force: every connected set of bodies, every point and direction that names or forces give, every
set of unknowns. Nothing of the search is in it but its linear system, whose solution is that of the core."""

from itertools import combinations

import numpy as np
import planar
import store

from freebody.core import FreeBodies

MOST = 3
"""Equations, of which all sets are tried."""
_GONE = 1e-7
"""Part of what an unknown can do in a motion, below which it is not in the equation."""

DRAWN = {
    "block on a slope": planar.block_on_slope,
    "block with a rod": planar.car_on_slope,
    "ladder": planar.ladder,
    "double pendulum": lambda rng: planar.chain(rng, 2),
    "chain of three": lambda rng: planar.chain(rng, 3),
    "chain of five": lambda rng: planar.chain(rng, 5),
    "driven chain of three": lambda rng: planar.driven_chain(rng, 3),
    "driven chain of five": lambda rng: planar.driven_chain(rng, 5),
    "four-bar": planar.four_bar,
    "free four-bar": lambda rng: planar.four_bar(rng, driven=False),
    "slider-crank": planar.slider_crank,
    "free slider-crank": lambda rng: planar.slider_crank(rng, driven=False),
    "branched": planar.branched,
    "free branched": lambda rng: planar.branched(rng, driven=False),
    "six-bar": planar.watt,
}


def states(make, seed=0, number=4):
    """A drawn model with other lengths and places at each state."""
    return [FreeBodies.read(make(np.random.default_rng([seed, k])).data()) for k in range(number)]


TARGETS = (
    "ladder floor.Fn", "ladder ladder.angle", "block on a slope block.x", "double pendulum A.Fx", "four-bar T", "four-bar B.Fx",
    "slider-crank T", "slider-crank B.Fy", "driven chain of three T1", "chain of three C.Fx",
    "19.3.1/model x", "19.3.1/string x", "19.3.2/model p.tension", "19.3.3/polar r", "19.3.5/model phi",
    "19.3.6/model foot.Fn", "19.3.6/model x", "19.3.6/model theta", "19.3.7/straight drop", "19.3.9/model pivot.Fx",
    "19.3.9/model track.Fn", "19.3.10/model theta", "19.3.10/model pivot.Fy", "19.3.12/model track.Fn", "19.3.13/model upper.x",
    "19.3.14/model mass.x", "19.3.15/model theta", "19.3.15/model x", "19.3.16/driven push", "19.3.17/model x",
    "19.3.18/model theta", "19.3.19/model theta", "19.3.20/model y", "19.3.21/model cable.tension", "19.3.24/model theta1",
    "19.3.25/model theta", "19.3.25/rod theta", "19.3.26/model theta", "19.3.28/model phi1", "19.3.28/model phi2",
    "19.3.28/model elbow.Fx", "19.3.29/model rocker.angle", "EX-ARM/model theta1", "EX-ARM/model theta2", "EX-ARM/model elbow.Fx",
    "EX-ARM/model shoulder.Fy", "EX-BLOCK/model x", "EX-BLOCK/model rollers.F1", "GEN-FOURBAR/model drive", "GEN-SLIDER/driven drive",
    "GEN-CHAIN/two_bars phi1", "GEN-CHAIN/two_bars knee.Fx", "S19.15/model x", "S19.16/model theta", "S19.16/model pivot.Fx",
    "S19.17/model theta", "S19.17/flight pivot.Fx", "S19.18/model theta", "S19.19/model x", "S19.21/model theta",
)  # fmt: skip
"""A model and what is wanted of it."""


def asked(target):
    """The states of a target, its named points, and what is wanted."""
    model, _, wanted = target.rpartition(" ")
    if model in DRAWN:
        return states(DRAWN[model]), {}, wanted
    subject = store.subject(model)
    return subject.neighbours, subject.points, wanted


def connected(problem):
    """All connected sets of bodies, by trying every set."""
    touched = [{b for b, column in enumerate(columns) if np.abs(column).max() > 0} for columns in problem.systems[0].columns]
    pairs = [bodies for unknown, bodies in zip(problem.unknowns, touched, strict=True) if unknown.load is not None]
    for k in range(1, len(problem.bodies) + 1):
        for group in combinations(range(len(problem.bodies)), k):
            reached = {group[0]}
            for _ in group:
                reached |= {b for pair in pairs if pair & reached for b in pair if b in group}
            if len(reached) == k:
                yield group


def places(free, points, group):
    """Where joints act, mass centres, that of a set of bodies, named points."""
    found = [part.point for load in free.loads for part in load.on[-1:]] + [body.G for body in free.bodies.values()]
    found.append(free.centre(*group))
    for body, x, y in points.values():
        at, angle = (free.bodies[body].at, free.bodies[body].angle) if body in free.bodies else ((0.0, 0.0), 0.0)
        c, s = np.cos(angle), np.sin(angle)
        found.append((at[0] + c * x - s * y, at[1] + s * x + c * y))
    return np.array(found)


def motions(problem, system, group, columns, points):
    """Turns of a group about every point, shifts along every direction, for every two forces the motion in which neither does
    work (n, 3), as velocity of the origin and turn × length; ``columns`` (nu, 3) are what a unit of each unknown does to the group."""
    about = (places(system.free, points, [problem.bodies[b] for b in group]) - problem.origin) / problem.length
    turns = np.column_stack([about[:, 1], -about[:, 0], np.ones(len(about))])
    unknown = [i for i, each in enumerate(problem.unknowns) if each.load is not None]
    sizes = np.linalg.norm(columns[unknown], axis=1, keepdims=True)
    loads = columns[unknown] / np.where(sizes > 0, sizes, 1.0)
    forces = np.array([[*part.force] for i in unknown for part in system.free.loads[problem.unknowns[i].load].on]).reshape(-1, 2)
    forces = np.concatenate([forces, loads[:, :2]])  # the latter with the friction that follows from them
    along = np.column_stack([forces, np.zeros(len(forces))])
    across = np.column_stack([-forces[:, 1], forces[:, 0], np.zeros(len(forces))])
    first, second = np.triu_indices(len(loads), 1)
    return np.concatenate([turns, np.eye(3)[:2], along, across, np.cross(loads[first], loads[second])])


def equations(problem, points):
    """What is in each balance of each set of bodies (n, nu), and its coefficients beside the state asked for."""
    for group in connected(problem):
        made = []
        for system in problem.systems:
            sums = system.columns[:, list(group)].sum(axis=1)
            tried = motions(problem, system, group, sums, points)
            reach = np.linalg.norm(tried, axis=1)[:, None] * np.linalg.norm(system.columns, axis=2).max(axis=1)
            made.append(tried @ sums.T / np.where(reach > 0, reach, 1.0))
        held = np.max(np.abs(made[1:] or made), axis=0) > _GONE
        yield held, made[-1]


def fewest(problem, wanted, most, points=None):
    """The least number of unknowns, ``wanted`` among them and at most ``most``, that as many independent balances hold; None if none
    are so few."""
    held, made = (np.concatenate(part) for part in zip(*equations(problem, points or {}), strict=True))
    few = held.sum(axis=1) <= most
    held, made = held[few], made[few]
    others = [i for i in range(len(problem.unknowns)) if i != wanted and held[:, i].any()]
    for k in range(1, most + 1):
        for more in combinations(others, k - 1):
            kept = [wanted, *more]
            rows = made[held.sum(axis=1) == held[:, kept].sum(axis=1)]
            if len(rows) >= k and np.linalg.matrix_rank(rows, tol=_GONE) == k and rows[:, wanted].any():
                return k
    return None

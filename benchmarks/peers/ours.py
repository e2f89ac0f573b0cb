"""freebody, by its public calls."""

from pathlib import Path

import batch
import calls
import motions
import numpy as np
import problems
from entry import TOLERANCES, Entry

import freebody as fb


def chain(n):
    made, (q, u) = calls.chain(n), problems.chain_state(n)
    at, names = made.evaluator(), [f"th{i}" for i in range(n)]

    def read(found):
        return np.append(found[0], found[1].reshape(n, 3)[:, :2])

    start, rates = (dict(zip(names, map(float, each), strict=True)) for each in (q, u))
    made.initial(**start, rates=rates)
    yield Entry("freebody, evaluator", lambda _: at(q, u), says="accelerations, all reactions", read=read)
    says = "the same from the model, as objects with names, and which are determinate"
    yield Entry(
        "freebody, m.solve",
        lambda _: made.solve(),
        says=says,
        read=lambda now: np.array([now.accelerations[name] for name in names]),
    )


def motion(made, end, read):
    """By each method that carries it."""
    says = "m.simulate, with its ledger of energy, and all reactions at any time when asked"
    for method in ("dop853", "taylor") if made.compile().runs_in_lanes else ("dop853",):

        def solve(rtol, method=method):
            return made.simulate(end, rtol=rtol, method=method)

        yield Entry(f"freebody, {method}", solve, TOLERANCES, says, lambda run: read(run.end.q))


def double_pendulum():
    yield from motion(motions.double_pendulum(), problems.END, np.cumsum)


def four_bar():
    yield from motion(motions.four_bar(), problems.END, lambda q: np.array([q[0], q[0] + q[1], q[2]]))


def andrews():
    made = fb.load(Path(__file__).parents[1] / "accuracy/andrews.yaml")
    order = [made.compile().coordinate_names.index(name) for name in problems.ANDREWS]
    yield from motion(made, 0.03, lambda q: q[order])


def slider_cranks():
    m = fb.Mechanism("slider-crank", gravity=problems.G)
    length = m.parameter("length", float(problems.RODS[0]))
    m.ground.line("axis", through="O", angle=0)
    crank, rod = m.rod("crank", length=0.1, mass=1), m.rod("rod", length=length, mass=2)
    m.body("slider", mass=1.5, inertia=0.01, lines={"base": {"through": "origin", "angle": 0}})
    m.hinge(m.ground.O, crank.start, name="O", coordinate="theta")
    m.hinge(crank.end, rod.start, name="B", coordinate={"name": "beta", "absolute": True})
    m.slider(name="guide", along="ground.axis", line="slider.base", coordinate="x")
    m.hinge(rod.end, "slider.origin", name="C")
    m.initial(theta=0, guess={"x": 0.4}, rates={"theta": problems.TURNING[1]})
    kept = ["O.Fx", "O.Fy", "B.Fx", "B.Fy", "C.Fx", "C.Fy", "guide.Fy"]

    def solve(rtol):
        return m.batch(p={"length": problems.RODS}, until=problems.SEEN[-1], t_eval=problems.SEEN, rtol=rtol, reactions=True)

    def read(found):
        return found.reactions.sel(reaction=kept)[[0, -1]].values

    says = "motions and all reactions, by name, on all cores"
    yield Entry("freebody, m.batch", solve, TOLERANCES, says, read)


def pendulums():
    made, fan = batch.mechanism(), problems.fan() - np.pi / 2

    def solve(_):
        end = batch.STEPS * batch.STEP
        return made.batch(fan, until=end, method="rk4", step=batch.STEP, t_eval=[end])

    yield Entry(
        "freebody, m.batch", solve, says="64 side by side, on all cores", read=lambda found: found.q.values[:, -1] + np.pi / 2
    )


def block():
    m = fb.Mechanism("block", gravity=list(problems.PULL))
    box = m.rectangle("box", width=0.4, height=0.2, mass=1)
    m.contact("slope", box, m.ground.line("surface", through=m.ground.O, angle=0), friction=problems.FRICTION)
    m.initial(**{"box.x": 0, "box.y": 0.1, "box.angle": 0}, rates={"box.x": problems.SPEED})

    def solve(_):
        return m.simulate(problems.PLACES[-1], t_eval=problems.PLACES)["box.x"]

    yield Entry("freebody", solve, says="sliding and sticking exactly, the change between them located")

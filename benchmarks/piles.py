"""Piles of boxes and disks that are thrown between two walls, followed until they rest: how many come there, and what that costs.

    python benchmarks/piles.py [BODIES …] [--seeds N] [--seconds S] [--patience P]

Of each number of bodies some piles are drawn. The table says how many complete their seconds, the processor time, the changes of mode, and the
largest share of the energy at the start by which the ledger is off; below it stands what ended the others.
"""

from argparse import ArgumentParser
from math import ceil, sqrt
from statistics import median
from time import process_time

import numpy as np
from rich.console import Console
from rich.table import Table

import freebody as fb

SPACING = 0.32  # m, of the bodies at the start


def pile(bodies: int, seed: int) -> fb.Mechanism:
    """Boxes and disks of 12 to 20 cm over a floor, in rows as wide as the box that they fall into."""
    random = np.random.default_rng([bodies, seed])
    columns = ceil(sqrt(bodies))
    half = SPACING * columns / 2
    made = fb.Mechanism(f"pile of {bodies}, {seed}", gravity="9.81 m/s^2")
    made.ground.line("floor", made.ground.O)
    for side, x, angle in (("left", -half, -90), ("right", half, 90)):
        made.ground.point(side.upper(), [x, 0])
        made.ground.line(side, f"ground.{side.upper()}", angle=f"{angle} deg")
    start: dict[str, float] = {}
    for i in range(bodies):
        name, size = f"b{i}", random.uniform(0.12, 0.2)
        if random.random() < 0.5:
            made.body(name, shape="disk", radius=size / 2, mass=20 * size**2)
        else:
            made.body(name, shape="rectangle", width=size, height=0.8 * size, mass=16 * size**2)
        made.free("ground.O", f"{name}.centre", coordinates=[f"x{i}", f"y{i}", f"a{i}"])
        row, column = divmod(i, columns)
        at = (SPACING * (column + 0.5) - half, SPACING * (row + 0.5), random.uniform(-1, 1))
        start |= dict(zip((f"x{i}", f"y{i}", f"a{i}"), map(float, at), strict=True))
        law = {"restitution": 0.2, "friction": 0.5}
        for side in ("floor", "left", "right"):
            made.contact(f"{name} {side}", name, f"ground.{side}", **law)
        for other in range(i):
            made.contact(f"{name} b{other}", name, f"b{other}", **law)
    made.initial(at_rest=True, **start)
    return made


def thrown(bodies: int, seed: int, seconds: float, patience: float) -> tuple[fb.core.Outcome, float, int, float]:
    """How the motion ends, its processor time, its changes and what the ledger leaves over."""
    made = pile(bodies, seed)
    began = process_time()
    run = made.simulate(seconds, progress=lambda *_: process_time() - began < patience, impacts="newton", painleve="impact")
    took = process_time() - began
    energy = run.energy
    off = float(np.abs(energy.balance).max() / (energy.kinetic[0] + energy.potential[0]))
    return run.outcome, took, len(run.changes), off


def main() -> None:
    """Print the table, and what ended the piles that did not complete."""
    parser = ArgumentParser(description=__doc__)
    parser.add_argument("bodies", nargs="*", type=int, default=[10, 20])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--seconds", type=float, default=4.0)
    parser.add_argument("--patience", type=float, default=300.0)
    asked = parser.parse_args()
    table = Table("bodies", "complete", "seconds, median", "longest", "changes, median", "ledger off by at most")
    ended: list[str] = []
    for bodies in asked.bodies:
        runs = [thrown(bodies, seed, asked.seconds, asked.patience) for seed in range(asked.seeds)]
        ended += [f"{bodies} bodies, {seed}: {run[0].sentence}" for seed, run in enumerate(runs) if not run[0].ok]
        complete = sum(run[0].ok for run in runs)
        _, took, changes, off = zip(*runs, strict=True)
        shown = (f"{median(took):.1f}", f"{max(took):.1f}", f"{median(changes):.0f}", f"{max(off):.0e}")
        table.add_row(str(bodies), f"{complete} of {asked.seeds}", *shown)
    Console().print(table)
    if ended:
        print(*ended, sep="\n")


if __name__ == "__main__":
    main()

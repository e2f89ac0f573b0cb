"""The checks that every system gets for nothing, on all that its questions computed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from freebody.catalogue.answers import Answer, Question
from freebody.catalogue.case import Case

ROUTES = ("minimal", "newton_euler", "constraints")
STATES_OF_A_RUN = 4


def _routes(case: Case) -> Iterator[Answer]:
    """Accelerations and determinate reactions by each route, and what is left of every body's balance: at every instant that was
    asked for, and a few of every run."""
    from freebody.solve.instant import Instant

    if not case.runs and not case.instants:
        case.instant()
    asked = [(name, [partial(Instant, each.core, each.state)]) for name, each in case.instants.items()]
    for name, run in case.runs.items():
        times = np.linspace(run.edges[0], run.edges[-1], STATES_OF_A_RUN).tolist()
        asked.append((name, [partial(run.instant, t) for t in times]))
    names, accelerations, reactions, residuals = [], [], [], []
    for name, solved in ((name, solved) for name, states in asked for solved in states):
        one, *others = (solved(route) for route in ROUTES)
        gaps = [one.apart(other) for other in others]
        names.append(name)
        accelerations.append(max(gap[0] for gap in gaps))
        reactions.append(max(gap[1] for gap in gaps))
        residuals.append(max(each.residual for each in (one, *others)))
    at = f"at {len(names)} state{'s' * (len(names) > 1)}"
    yield _greatest(f"They give the same accelerations {at}.", accelerations, names, "the other two routes", 1e-10)
    yield _greatest(f"They give the same reactions {at}.", reactions, names, "the other two routes", 1e-10)
    yield _greatest(f"No momentum is left over {at}.", residuals, names, "balance of every body", 1e-12)


def _greatest(says: str, left: list[float], names: list[str], against: str, tolerance: float, own: bool = False) -> Answer:
    """That nothing is left, by the greatest that is, and where it is."""
    worst = int(np.argmax(left))
    return Answer(names[worst], left[worst], "", 0.0, against, tolerance, 1.0, own=own, says=says)


def _ledgers(case: Case) -> Iterator[Answer]:
    """Kinetic + potential − works stays what it was, relative to the largest of them that comes and goes."""
    left = []
    for run in case.runs.values():
        energy = run.energy
        at_rest = 1e-6 * np.abs(energy.potential).max()  # where nothing moves, round-off is all that comes and goes
        stored = [np.abs(energy.kinetic).max(), np.ptp(energy.potential), at_rest]
        size = max(*stored, *(np.abs(work).max() for work in energy.works.values()), 0.0)
        left.append(float(np.abs(energy.balance).max() / size) if size else 0.0)
    says = f"No energy is left over in {len(left)} motion{'s' * (len(left) > 1)}."
    yield _greatest(says, left, list(case.runs), "energy stored − work done", 1e-9, own=True)


def free_questions(case: Case) -> list[Question]:
    """Three routes and momentum balance; the energy ledger of what moved."""
    ledger = Question("Does the energy ledger balance?", _ledgers)
    return [Question("Do three routes to the same instant agree?", _routes), *([ledger] if case.runs else [])]

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
    for name, states in asked:
        accelerations, reactions, residuals = [0.0], [0.0], [0.0]
        for solved in states:
            one, *others = (solved(route) for route in ROUTES)
            residuals += [one.residual, *(other.residual for other in others)]
            for other in others:
                gaps = one.apart(other)
                accelerations.append(gaps[0])
                reactions.append(gaps[1])
        against = "the other two routes"
        yield Answer(f"{name}: accelerations apart", max(accelerations), "", 0.0, against, 1e-10, 1.0)
        yield Answer(f"{name}: reactions apart", max(reactions), "", 0.0, against, 1e-10, 1.0)
        yield Answer(f"{name}: momentum left over", max(residuals), "", 0.0, "balance of every body", 1e-12, 1.0)


def _ledgers(case: Case) -> Iterator[Answer]:
    """Kinetic + potential − works stays what it was, relative to the largest of them that comes and goes."""
    for name, run in case.runs.items():
        energy = run.energy
        at_rest = 1e-6 * np.abs(energy.potential).max()  # where nothing moves, round-off is all that comes and goes
        stored = [np.abs(energy.kinetic).max(), np.ptp(energy.potential), at_rest]
        size = max(*stored, *(np.abs(work).max() for work in energy.works.values()), 0.0)
        left = float(np.abs(energy.balance).max() / size) if size else 0.0
        yield Answer(f"{name}: left over", left, "", 0.0, "energy stored − work done", 1e-9, 1.0, own=True)


FREE_QUESTIONS = (Question("three routes to the same instant", _routes), Question("energy ledger", _ledgers))
"""Three routes, momentum balance, energy ledger."""

"""The models of the catalogue and what tests ask of them, each worked out once in a session.

``every(MODELS)`` lets a test visit them. By default a sample is visited, with ``--all`` every one (see ``conftest.py``); all tests
of one model run in one process, so that what one of them derived or drew is there for the next. A stored thing is only looked at:
a test that changes a mechanism loads its own.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import pytest

import freebody as fb
from freebody import catalogue
from freebody.equations.derivation.derive import derive
from freebody.solve.perturbed_states import RATES, others
from freebody.solve.symbolic_state import SymbolicState

ROOT = Path(__file__).parents[1]
SYSTEMS = {f"{system.id}/{path.stem}": path for system in catalogue.systems() for path in system.models}
MODELS = SYSTEMS | {f"examples/{path.stem}": path for path in sorted((ROOT / "examples").glob("*.yaml"))}
WITHOUT_ANSWER = {"19.3.23/idle"}
"""A body without inertia moves freely: there is no instant, so no loads and no equations."""
ANSWERED = [name for name in MODELS if name not in WITHOUT_ANSWER]
REPRESENTATIVE = (
    "19.3.1/string", "19.3.2/with_spin", "19.3.3/polar", "19.3.7/straight", "19.3.7/taut", "19.3.11/two", "19.3.11/wall",
    "19.3.13/model", "19.3.19/push", "19.3.20/cable", "19.3.20/pulleys", "19.3.21/broken", "19.3.22/latch", "19.3.23/idle",
    "19.3.27/model", "19.3.27/plate", "19.3.27/table", "19.3.29/model", "EX-ARM/held", "EX-BLOCK/model", "GEN-CAR/driveshaft", "GEN-SUSP/one_sided", "GEN-WALK/model", "S19.15/model",
    "S19.17/free_end", "examples/tossed_box",
)  # fmt: skip
"""Together they hold every kind of part that any model has (``test_sample.py``); each file of laws visits a part of them."""

REPRESENTED, SHARE, LEAST = 3, 40, 3
"""One of so many representative members of a family is visited, beside them one of so many others, and no fewer than that; where a law
has a share of its own, of both as many fewer or more."""
LONG = {"GEN-ROBOT", "50", "58", "106", "116"}
"""Systems and seeds of random models that take long wherever they are visited: with ``--all`` only."""


def sample(names: set[str], seed: int, share: int = SHARE, where: str = "") -> set[str]:
    """The members of a family that are visited: of the representative ones others in each file of laws."""

    def drawn(some: set[str], where: str = "") -> list[str]:
        return sorted(some, key=lambda name: zlib.crc32(f"{seed} {where}{name}".encode()))

    known = drawn(names & {*REPRESENTATIVE}, where)
    return {*known[: -(-len(known) * SHARE // (REPRESENTED * share))], *drawn(names - LONG)[: max(LEAST, len(names) // share)]}


def every(names: Iterable[str], argument: str = "model", share: int = SHARE) -> pytest.MarkDecorator:
    """Parametrizes a test by names: of models, or of anything else that comes in a family, one of ``share`` by default."""
    return pytest.mark.parametrize(argument, family(names, share))


def family(names: Iterable[str], share: int = SHARE, group: str = "") -> list:
    """The same for a fixture's ``params``; all in one process if there is a ``group``."""
    marks = pytest.mark
    return [pytest.param(name, id=name, marks=(marks.family(name, share), marks.xdist_group(group or name))) for name in names]


def but_long(names: Iterable[object], *long: object) -> list:
    """A test's parameters, of which some take long: those are visited with ``--all`` only."""
    return [pytest.param(name, marks=pytest.mark.long) if name in long else name for name in names]


@cache
def mechanism(model: str) -> fb.Mechanism:
    """A model, as it is loaded."""
    return fb.load(MODELS[model])


@cache
def start(model: str):
    """The state at its start, and the notes on how it was assembled."""
    return mechanism(model).moment()


@cache
def subject(model: str) -> SymbolicState:
    """A model at its start, for derivations."""
    return SymbolicState(mechanism(model).source(), start(model)[0])


@cache
def derived(model: str, form: str, long: bool = False):
    """Its equations in a form, as a page or at length."""
    return derive(subject(model), form, long=long)


@cache
def run(model: str) -> fb.Run:
    """Its motion, as the file asks for it."""
    return mechanism(model).simulate()


@cache
def instant(model: str):
    """All that is solved at its start."""
    return mechanism(model).solve()


@cache
def free_bodies(model: str):
    """Its free bodies with all loads, at its start."""
    return mechanism(model).free_bodies()


def diagram(model: str, of: str | None = None, to_scale: bool = False, column: float = 160.0):
    """Its free-body diagrams on a sheet."""
    return _sheet(model, of, to_scale, column)


@cache
def _sheet(model, of, to_scale, column):
    return mechanism(model).diagram(of, to_scale=to_scale, column=column)


@cache
def elsewhere(model: str) -> tuple[SymbolicState, ...]:
    """A model at its start, and at a state of the same mode at about each place near by: at rates and a time of its own, with
    closed what is closed, where the same things touch, are taut and slide the same way. Where a string has no free length, by which its
    equations divide: in its own motion a little later."""
    first = subject(model)
    if first.regular is first.state:
        return first, *(SymbolicState(first.source, state) for state in others(first.source, first.state)[::RATES])
    return tuple(SymbolicState(first.source, run(model).motion.state(part * run(model).end.t)) for part in (0.05, 0.1))

"""Families of true motions, and the samples that stand for them."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from freebody.core import CompiledModel, State
from freebody.model.names import unquote
from freebody.run.records import Array, quote

from .integrals import EXACT, amplitude, summed
from .moments import Moments
from .user_symbols import AMPLITUDE, LOAD, OF_START, SUMMED, WORK

_STEPS = 5000  # of a run from the start to a state
_SINGULAR = 1e-9  # of the largest singular value: below it a combination of loads moves nothing


class NoMotion(ValueError):
    """A model, or a family of its motions, of which no true state was found."""


@dataclass(frozen=True)
class Family:
    """Which motions: ``held`` are parameters with a number of their own (SI, or an expression of others), ``numbers`` holds all
    at the model's, ``at_rest`` has all rates 0, ``at_start`` stays where the model starts, ``zeros`` lets parameters that are 0
    in the model be something else, ``gravity`` False takes it away, ``scaled`` multiplies parameters; ``vanishing`` are
    expressions of configuration and, linearly, rates that are 0, ``above`` such that are more; ``small`` are expressions of configuration with the size that
    they and their rates have at most. ``since``: motions that begin where the model does, with its rates (``start``) or without
    (``rest``), or at its moment, while what is asked of the start is of the model's own (``before``), and last so many times the time typical of the model if it is to be ``late``; they end where something switches, or go
    on ``through`` that, and at an event that is named, ``until``. ``steady``: they repeat with what drives them, or what dies away has done so. ``near``: they are no
    farther from the start than what is next to it."""

    held: tuple[tuple[str, float | str], ...] = ()
    numbers: bool = False
    at_rest: bool = False
    at_start: bool = False
    zeros: bool = True
    gravity: bool = True
    scaled: tuple[tuple[str, float], ...] = ()
    vanishing: tuple[str, ...] = ()
    above: tuple[str, ...] = ()
    small: tuple[tuple[str, float], ...] = ()
    since: str = ""
    late: float = 0.0
    through: bool = False
    until: str = ""
    steady: bool = False
    near: bool = False


BEFORE = "before"
"""Of a family ``since`` a moment, that its start is before that."""
ALL = Family()
"""Every motion of the model, with every parameter free."""
AT_START = Family(at_start=True)
"""Where the model starts, with every parameter free."""
SINCE_START = Family(since="start")
"""The motions that begin where the model does, until something switches."""


@dataclass
class Samples:
    """True states of one family, each with its history where what switches decides. ``values`` reads any expression of the model language on all of them.

    Reactions that are not determined have random admissible values; with ``stress`` 0 those of least norm."""

    core: CompiledModel
    states: list[State]
    starts: list[State] = field(default_factory=list)
    """Where the motion of each state began, if that is known."""
    own_start: State | None = None
    """Where the model's own motion begins, which shows how others come to a moment."""
    stress: float = 1.0
    whole: bool = False
    """Whether what is summed up is so from the model's start on, and not from its moment."""
    repeats: bool = False
    """Whether the states are on motions that repeat, of which something may be largest."""
    loose: set[str] = field(default_factory=set)
    known: dict[str, Array] = field(default_factory=dict)
    weighed: dict[str, tuple[Array, Array]] = field(default_factory=dict)

    def values(self, texts: Sequence[str]) -> dict[str, Array]:
        """Each expression on all samples, (K,); NaN where it reads a reaction that is not determined."""
        new = [text for text in dict.fromkeys(texts) if text not in self.known]
        if new:
            rng = np.random.default_rng(17)
            rows = np.array([self._stressed(state, new, self._row(k, new), rng) for k, state in enumerate(self.states)])
            self.known |= {text: rows[:, i] for i, text in enumerate(new)}
        return {text: self.known[text] for text in texts}

    @cached_property
    def _usual(self) -> Moments | None:
        return Moments(self.core, self.own_start) if self.own_start else None

    def _row(self, k: int, texts: Sequence[str]) -> Array:
        """Expressions, loads and what is asked of the start, in one state."""
        state, start = self.states[k], self.starts[k] if self.starts else None
        asked = Moments(self.core, start or state, state.t - start.t if start else 0.0, self._usual)
        in_numbers = asked.in_numbers if start else asked.of_repeating if self.repeats else str
        read = {text: in_numbers(text) for text in texts}
        plain = [
            t for t, of in read.items() if not (of.startswith((LOAD, SUMMED, AMPLITUDE)) or OF_START.search(of) or "(nan)" in of)
        ]
        found = self.core.evaluate([read[text] for text in plain], state)
        if start and self.whole and any(worked := [WORK.search(text) is not None for text in plain]):  # since before the moment
            run = self.core.simulate(start, state.t, rtol=EXACT, max_steps=_STEPS)
            ends = np.array([min(state.t, run.end.t)])  # an event there may come sooner by round-off
            found[worked] = run.evaluate([read[text] for text, sums in zip(plain, worked, strict=True) if sums], ends)[0]
        if len(plain) == len(texts):
            return found
        known = dict(zip(plain, found.tolist(), strict=True))
        known |= {text: amplitude(text, self.core, state) for text in texts if text.startswith(AMPLITUDE)}
        if any(text.startswith(LOAD) for text in texts):
            known |= {LOAD + load.symbol: load.value for load in self.core.free_bodies(state).loads}
        if start:
            known |= {text: summed(text, self.core, start, state) for text in texts if text.startswith(SUMMED)}
        return np.array([known.get(text, np.nan) for text in texts])

    def _stressed(self, state: State, texts: Sequence[str], row: Array, rng: np.random.Generator) -> Array:
        """A row in which what reads reactions that are not determined has a value, too."""
        if not np.isnan(row).any():
            return row
        values = admissible(self.core, state, rng, self.stress)
        lost = [i for i, text in enumerate(texts) if np.isnan(row[i]) and with_numbers(text, values) != text]
        if lost:
            row[lost] = self.core.evaluate([with_numbers(texts[i], values) for i in lost], state)
            self.loose |= {texts[i] for i in lost}
        return row

    def masses(self) -> dict[str, tuple[Array, Array]]:
        """Mass (K,) in kg and moment of inertia (K,) about the mass centre in kg·m² of each body."""
        if not self.weighed:
            rows = [self.core.free_bodies(state).bodies for state in self.states]
            for name in rows[0]:
                self.weighed[name] = np.array([row[name].mass for row in rows]), np.array([row[name].inertia for row in rows])
        return self.weighed


# -- reactions that the balances leave open


def admissible(core: CompiledModel, state: State, rng: np.random.Generator, size: float) -> dict[str, float]:
    """Values of the reactions that are not determined, by their names in the model: those of least norm and, ``size`` times
    as large as they, a random self-stress."""
    free_bodies = core.free_bodies(state)
    loads = [load for load in free_bodies.loads if load.unknown]
    if all(load.determinate for load in loads):
        return {}
    columns = np.zeros((len(loads), len(free_bodies.bodies), 3))  # force and moment about the origin of each unit load
    for row, load in zip(columns, loads, strict=True):
        for body, effect in zip(free_bodies.bodies, row, strict=True):
            effect += sum(part.wrench() for part in load.on if part.body == body)
    _, sizes, rows = np.linalg.svd(columns.reshape(len(loads), -1).T)
    free = rows[np.sum(sizes > _SINGULAR * sizes.max()) :]
    values = np.nan_to_num([load.value for load in loads])
    values = values + size * (np.abs(values).max() + 1.0) * (free.T @ rng.uniform(-1, 1, len(free)))
    pairs = zip(loads, values, strict=True)
    return {load.symbol: float(value) for load, value in pairs if not load.determinate}


def with_numbers(text: str, values: Mapping[str, float]) -> str:
    """An expression with numbers for the reactions of which values are given."""
    for symbol, value in values.items():
        owner, _, part = symbol.rpartition(".")
        for name in {symbol, f"{quote(unquote(owner))}.{part}"}:
            text = re.sub(rf"(?<![\w.]){re.escape(name)}(?![\w.])", f"({value!r})", text)
    return text

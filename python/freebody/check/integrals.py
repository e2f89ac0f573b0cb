"""What an integral in a statement means: of a function of its own variable a number, else over the motion from its start to now; and what is
largest on that."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from freebody.core import Array, CompiledModel, State
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Num, Sym

from .language.statements import Integral, symbols_in
from .stretches import zeros
from .user_symbols import AMPLITUDE, LARGEST, SUMMED, Masses, Meaning, Values

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)
_PANELS = 12
EXACT = 1e-13  # tolerance of runs whose course matters
_SAME = 1e-9  # by how much two places may differ, relative
_DOUBLED = 10  # times that a motion is followed twice as long, until something on it has had its largest value
_LOOKS, _FINER, _NEARLY = 129, 4, 0.03
"""Times at which it is looked for, how often again between two, and what part of its changes it may lack where it is looked for first."""
_NEAR = 1e-11  # tolerance of the motion whose amplitude is asked for
_BACK = 1e-8  # of what it goes to and fro, by which it may miss when it comes back
_TURNS = 8, 32, 128  # of the time typical of it, on which it turns three times
_ENDS = ("1", "2", "f", "e")
"""Indices of the moment at which a stretch ends."""


@dataclass(frozen=True)
class Quadrature(Meaning):
    """∫ f(x) dx between limits, where f holds nothing else that moves."""

    node: Integral | None = None
    known: Mapping[Sym, Meaning] = field(default_factory=dict, compare=False)

    @property
    def is_vector(self) -> bool:
        return False

    def needed(self, dots: int) -> list[str]:
        return [text for symbol, meaning in self.known.items() for text in meaning.needed(symbol.dots)]

    def value(self, dots: int, values: Values, masses: Masses) -> Array:
        assert self.node is not None
        there = {n.key: meaning.value(n.dots, values, masses) for n, meaning in self.known.items()}
        count = len(next(iter(values.values()), np.zeros(1)))
        low, high = (np.broadcast_to(sampled(end, there), (count,)) for end in (self.node.lower, self.node.upper))
        total = np.zeros(count)
        for x, weight in zip(_NODES, _WEIGHTS, strict=True):
            at = low + (high - low) * (1 + x) / 2
            total = total + weight * (high - low) / 2 * sampled(self.node.of, {**there, self.node.by.key: at})
        return total


def meaning(node: Integral, known: Mapping[str, Meaning], measure: Callable[[object], str], constants: Sequence[str]) -> Meaning:
    """What an integral is, without its dimension; ``measure`` writes an expression in the model language. Raises ``StatementError`` at limits
    that are no stretch of the motion."""
    by = node.by.name
    inside = [n for n in symbols_in(node.of) if n.name != by]
    upper = node.by if _is_end(node.upper, by, known) else node.upper
    begins = isinstance(node.lower, Sym) and folded(node.lower.name) in (folded(f"{by}_0"), "t0", folded(f"{by}_1"), "t1")
    if by != "t" and not begins and all(n.name in constants for n in inside):
        node = Integral(node.of, node.by, node.lower, upper)
        return Quadrature("quadrature", (measure(node.by),), node=node, known={n: known[n.name] for n in symbols_in(node)})
    if upper != node.by:
        what = f"the stretch over which is integrated ends where `{by}` is something else"
        raise StatementError(what, node.upper.span, f"integrate up to `{by}`, and say where with `at {by} = …:`")
    low = "" if begins or _is_time(node.lower, node.upper) else measure(node.lower)
    return Meaning("integral", (f"{SUMMED}{measure(node.of)};{measure(node.by)};{low}",))


def _is_end(upper: object, by: str, known: Mapping[str, Meaning]) -> bool:
    """Whether a limit is where the motion is: t, x or t₁, x₁."""
    if not isinstance(upper, Sym) or upper.dots:
        return False
    ends = {folded(f"{of}_{index}") for of in (by, "t") for index in _ENDS}
    return upper.name in (by, "t") or (upper.name not in known and folded(upper.name) in ends)


def _is_time(lower: object, upper: object) -> bool:
    """Whether the limits are times, of which the first is 0."""
    return isinstance(lower, Num) and lower.value == 0 and isinstance(upper, Sym) and folded(upper.name).rstrip("12fe_") == "t"


def summed(text: str, core: CompiledModel, start: State, state: State) -> float:
    """An integral along the motion from its start to a state; NaN where that does not begin at the lower limit."""
    of, by, low = text.removeprefix(SUMMED).split(";")
    if low:
        (first, begins), (last,) = core.evaluate([by, low], start), core.evaluate([by], state)
        if abs(first - begins) > _SAME * max(abs(last), abs(first)):
            return float("nan")
    if state.t <= start.t:
        return 0.0
    motion = core.simulate(start, state.t, rtol=EXACT, max_steps=5000)
    edges = np.linspace(start.t, state.t, _PANELS + 1)
    half = np.diff(edges)[:, None] / 2
    times = (edges[:-1, None] + half * (1 + _NODES)).ravel()
    values = motion.evaluate([of, f"rate({by})"] if by != "t" else [of, "1"], times)
    return float(np.sum((half * _WEIGHTS).ravel() * values[:, 0] * values[:, 1]))


def extreme(text: str, core: CompiledModel, start: State, typical: float) -> float:
    """The largest value on the motion from a start, or the least, before anything switches at which it does not go on to grow; NaN where it
    does so at the end. ``typical``: a time of the motion, in s."""
    word, of = text.split(": ", 1)
    sign = 1.0 if word == LARGEST else -1.0
    for doubled in range(2, _DOUBLED):
        motion = core.simulate(start, start.t + typical * 2**doubled, rtol=EXACT, max_steps=5000)
        ends = min([motion.end.t, *(change.t for change in motion.changes if change.t > start.t)])
        times, most = np.linspace(start.t, ends, _LOOKS), -np.inf
        values = sign * motion.evaluate([of], times)[:, 0]
        near = int(np.argmax(values >= values.max() - _NEARLY * np.ptp(values)))
        place = near + int(np.argmax(values[near : near + _LOOKS // 8]))
        if place <= _LOOKS // 4 and np.ptp(values) > 0 and (place or _has_returned(values)):  # it has fallen long since
            highest = float(values.max())
            for _ in range(_FINER):
                step = times[1] - times[0]
                times = np.linspace(max(times[place] - step, start.t), times[place] + step, _LOOKS)
                found = sign * motion.evaluate([of], times)[:, 0]
                place, most = int(np.argmax(found)), float(found.max())
            if most >= highest - _SAME * np.ptp(values):
                return sign * most
        if ends < motion.end.t:
            grows = ends > start.t and values[-1] == values.max()
            return extreme(text, core, motion.state(ends), typical) if grows else float("nan")
    return float("nan")


def amplitude(text: str, core: CompiledModel, state: State) -> float:
    """Half of what something goes to and fro on the motion from a state on, if it comes back as far; else NaN."""
    one, other = turning(text.removeprefix(AMPLITUDE), core, state)
    return abs(one - other) / 2


def turning(of: str, core: CompiledModel, state: State) -> tuple[float, float]:
    """The values between which something goes to and fro on the motion from a state on, if it comes back as far; else NaN."""
    rate = core.free_bodies(state).usual_rate(core.metadata["coordinates"], state.u)
    for turns in _TURNS:
        motion = core.simulate(state, state.t + turns / rate, rtol=_NEAR, max_steps=5000)
        read = lambda times, motion=motion: motion.evaluate([f"rate({of})"], times)[:, 0]
        if len(found := [*zeros(read, state.t, motion.end.t, 3)]) == 3:
            one, other, again = motion.evaluate([of], np.array(found))[:, 0].tolist()
            return (one, other) if abs(again - one) <= _BACK * abs(one - other) else (math.nan, math.nan)
    return math.nan, math.nan


def _has_returned(values: Array) -> bool:
    """Whether what is largest where it begins has come near that again and left it, or has settled."""
    least = values[0] - _NEARLY * np.ptp(values)
    gone = values[int(np.argmax(values < least)) :]
    back = gone[int(np.argmax(gone >= least)) :] if (gone >= least).any() else gone[:0]
    return bool((back < least).any() or np.ptp(values[len(values) // 2 :]) <= values[0] - least)

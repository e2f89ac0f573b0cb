"""Periodic motions: fixed points of a return map, with their multipliers."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from freebody.core import Array, MotionError
from freebody.find.curve import Curve
from freebody.find.response import Sample
from freebody.find.roots import roots
from freebody.model.errors import ModelProblem
from freebody.periodic.return_map import NoReturn, Return, ReturnMap
from freebody.periodic.variation import NotDifferentiable
from freebody.solve.figures import Known

_STEPS = 40
_FOUND = 1e-12
"""Step of Newton's method, over the sizes of the unknowns on the way, below which a fixed point is found."""
_ROUND_OFF = 1e-15
"""Part of these sizes by which a motion that repeats itself misses its start by round-off."""
_NEUTRAL = 1e-10
"""Singular value of the derivative less the identity, in these sizes, along which a whole family of motions repeats itself; at least the
tolerance of the map, below which it is not told from 0."""
_HALF = 0.5
"""Part of the step before to which one must come while Newton's method converges, however slowly."""
_CLOSED = 1e-10
"""Part of these sizes by which the motion may miss its start."""
_REPEATED = 1e-6
"""Part of their largest on the way, or of those that make rates of the unknowns' sizes within the period, by which accelerations after it
may differ from those at the start."""
_SHORTEST = 2.0**-10
"""Part of a step of Newton's method below which it is given up."""
_SAME = 1e-7
"""Distance, over the bounds, below which two fixed points are one."""


class NoPeriodicMotion(ValueError):
    """No fixed point was found: from where, and how far Newton's method came."""


@dataclass(frozen=True)
class PeriodicMotion:
    """A motion that repeats itself: the ``values`` of the unknowns with which it starts, its ``period`` (s), the derivative of the
    return map there, ``slopes`` (k, k), and its ``multipliers`` (k,), largest first: the factors by which perturbations grow
    over a period. ``checks`` say how it was verified: how far it misses its start, the next step of Newton's method, which is how far
    the values are known (along a multiplier 1 they are open), both over the sizes of the unknowns, and the checks of the
    derivative (``Return``)."""

    values: Mapping[str, float]
    period: float
    slopes: Array
    multipliers: NDArray[np.complex128]
    checks: Mapping[str, float]
    returned: Return

    @property
    def start(self) -> Array:
        """The values of the unknowns (k,)."""
        return np.array(list(self.values.values()))

    @property
    def stable(self) -> bool:
        """Whether all perturbations die out."""
        return bool(np.abs(self.multipliers).max() < 1)

    @property
    def exponents(self) -> NDArray[np.complex128]:
        """ln μ / T, 1/s: the growth of perturbations, and the angular frequency (within ±π/T) with which they turn."""
        return np.log(self.multipliers) / self.period


@dataclass(frozen=True)
class PeriodicMotions(Sequence[PeriodicMotion]):
    """Those that were found within bounds, in order of the first unknown, and how it was ``looked`` for them; from ``lost`` of the
    ``starts`` there was none: Newton's method came to none, or with one unknown, the motion did not come back."""

    motions: tuple[PeriodicMotion, ...]
    starts: int
    lost: int
    looked: str

    def __getitem__(self, i: Any) -> Any:
        return self.motions[i]

    def __len__(self) -> int:
        return len(self.motions)

    @property
    def sentence(self) -> str:
        """How many there are, and how it was looked for them."""
        found = f"{len(self)} motion{'s' * (len(self) != 1)} that repeat{'s' * (len(self) == 1)}"
        return f"{found} within these bounds, {self.looked}"


def find(returns: ReturnMap, start: Sequence[float] | Array, **others: Any) -> PeriodicMotion:
    """The periodic motion to which Newton's method comes from a start. Raises ``NoPeriodicMotion``."""
    values, before = np.asarray(start, float), np.inf
    try:
        here = returns(values, **others)
        for _ in range(_STEPS):
            size, miss = _sizes(here, values), _miss(here, values)
            step = _step(here, values, size, max(_NEUTRAL, returns.rtol) if miss <= _FOUND else 0.0)
            length = float(np.abs(step / size).max())
            if miss <= _FOUND and (length <= _FOUND or (miss <= _ROUND_OFF and length > _HALF * before)):
                return _periodic(returns, values, here, length)
            values, here = _shortened(returns, values, here, step, others)
            before = length
    except (NoReturn, NotDifferentiable, MotionError) as error:
        raise NoPeriodicMotion(f"{_at(returns, values)}: {error}") from error
    raise NoPeriodicMotion(f"Newton's method did not settle, last at {_at(returns, values)}; try a start nearer to the motion")


def by_size(multipliers: Array) -> NDArray[np.complex128]:
    """Multipliers in order, the largest first; of a pair the one with the positive imaginary part."""
    multipliers = multipliers.astype(complex)
    return multipliers[np.lexsort((-multipliers.imag, -np.abs(multipliers).round(12)))]


def _shortened(returns: ReturnMap, values: Array, here: Return, step: Array, others: Mapping[str, Any]) -> tuple[Array, Return]:
    """A step of Newton's method, halved until the motion comes back nearer to its start."""
    part = 1.0
    while part >= _SHORTEST:
        there = values + part * step
        try:
            new = returns(there, **others)
        except (NoReturn, NotDifferentiable, MotionError):
            new = None
        if new and (_miss(new, there) < max(_miss(here, values), _CLOSED) or (len(values) > 1 and part < _SHORTEST * 2)):
            return there, new
        part /= 2
    raise NoReturn("no shorter step comes nearer to a motion that repeats itself")


def _step(here: Return, values: Array, size: Array, neutral: float) -> Array:
    """The step of Newton's method; none along singular values of the derivative less the identity up to ``neutral``."""
    left, singular, right = np.linalg.svd((here.slopes - np.eye(len(values))) * size / size[:, None])
    inverse = np.divide(1.0, singular, out=np.zeros_like(singular), where=singular > neutral)
    return size * (right.T @ (inverse * (left.T @ ((values - here.values) / size))))


def _sizes(returned: Return, values: Array) -> Array:
    """Of the unknowns on the way, 1 where they have none."""
    size = np.maximum(returned.scales, np.abs(values))
    return np.where(size > 0, size, 1.0)


def _miss(returned: Return, values: Array) -> float:
    return float((np.abs(returned.values - values) / _sizes(returned, values)).max())


def _at(returns: ReturnMap, values: Array) -> str:
    return ", ".join(f"{name} = {value:g}" for name, value in zip(returns.unknowns, values, strict=True))


def _periodic(returns: ReturnMap, values: Array, returned: Return, step: float) -> PeriodicMotion:
    if (miss := _miss(returned, values)) > _CLOSED:
        raise NoReturn(f"the motion misses its start by {miss:.1e} of its size")
    _check_repeats(returns, returned)
    multipliers = by_size(np.linalg.eigvals(returned.slopes))
    named = dict(zip(returns.unknowns, values.tolist(), strict=True))
    checks = {"return": miss, "next step": step, **returned.checks}
    return PeriodicMotion(named, returned.time, returned.slopes, multipliers, checks, returned)


def _check_repeats(returns: ReturnMap, returned: Return) -> None:
    """Raises ``NoReturn`` where rates that come back after a period go on otherwise than at the start."""
    pairs = zip(returns.unknowns, returns.returns, returned.scales.tolist(), strict=True)
    same = {f"accel{name[4:]}": scale for name, text, scale in pairs if name == text and name.startswith("rate(")}
    if returns.section or not same:
        return
    motion, begin = returned.run.motion, returned.run.start.t
    first, last, *_ = found = motion.evaluate(list(same), np.array([begin, begin + returned.time, *motion.steps]))
    sizes = np.maximum(np.abs(found).max(axis=0), np.array(list(same.values())) / returned.time)
    other = np.abs(last - first) > _REPEATED * sizes
    if other.any():
        raise NoReturn(
            f"after a period {', '.join(np.array(list(same))[other])} differ from those at the start: laws of time have another period, or "
            "an angle has turned, which is to come back less its turn, returns={'theta': 'theta - 2*pi', …}"
        )


def find_all(returns: ReturnMap, within: Sequence[tuple[float, float]], starts: int = 32, **others: Any) -> PeriodicMotions:
    """The periodic motions within bounds of the unknowns. The map of one unknown is followed from at least ``starts`` places until it is
    resolved, as ``freebody.find`` does; of more, those are found to which Newton's method comes from at least ``starts`` points
    spread evenly over the bounds (Sobol), which need not be all."""
    low, high = np.array(within, float).T
    if len(within) == 1:
        miss = _Miss(returns, others)
        curve = Curve(miss, *within[0], max(starts, 4) + 1)
        points, tried = [[float(root.where)] for root in roots(miss, curve, 0.0)], len(curve.samples)
    else:
        points = low + (high - low) * qmc.Sobol(len(low), scramble=False).random_base2(int(np.ceil(np.log2(starts))) + 1)[1:]
        tried = len(points)
    reached = [motion for point in points if (motion := _reached(returns, point, others)) is not None]
    if len(within) == 1:
        lost = sum(not sample.is_known for sample in curve.samples)
        looked = f"looked for at {curve.sentence('')}; at {lost} of the places the motion does not come back"
    else:
        lost = tried - len(reached)
        looked = f"from {tried} starts; from {lost} of these Newton's method came to none. There may be others: more starts look further"
    found: list[PeriodicMotion] = []
    for motion in (each for each in reached if ((low <= each.start) & (each.start <= high)).all()):
        if all((np.abs(motion.start - known.start) / (high - low)).max() > _SAME for known in found):
            found.append(motion)
    return PeriodicMotions(tuple(sorted(found, key=lambda each: each.start[0])), tried, lost, looked)


def _reached(returns: ReturnMap, point: Sequence[float] | Array, others: Mapping[str, Any]) -> PeriodicMotion | None:
    try:
        return find(returns, point, **others)
    except (NoPeriodicMotion, ModelProblem):
        return None


@dataclass
class _Miss:
    """By how much a motion of one unknown misses its start: what ``freebody.find`` follows."""

    returns: ReturnMap
    others: Mapping[str, Any]
    samples: dict[float, Sample] = field(default_factory=dict)

    def __call__(self, x: float) -> Sample:
        """The miss after a start with x, and what happened on the way."""
        if x not in self.samples:
            try:
                run, end = self.returns.run(np.array([x]), self.others)
                value = float(run.source.evaluate(self.returns.returns, run.motion.state(end))[0])
                story = tuple(" ".join([each.kind, *each.of]) for each in run.changes if each.t <= end)
                self.samples[x] = Sample(x, value - x, story)
            except (NoReturn, MotionError, ModelProblem) as error:
                self.samples[x] = Sample(x, math.nan, why=str(error))
        return self.samples[x]

    def known(self, x: float) -> Known:
        """The same with its error."""
        return Known(self(x).y, _CLOSED * abs(x), abs(x))

    def error(self, samples: Sequence[Sample]) -> float:
        """The largest error of some."""
        return max(_CLOSED * abs(each.x) for each in samples)

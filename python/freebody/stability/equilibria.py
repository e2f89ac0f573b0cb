"""Places of rest: near a state, and all that are found within bounds; which of them are stable."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from freebody.core import Array, CompiledModel, MotionError, State, quote
from freebody.solve.instant import Instant
from freebody.solve.perturbed_states import Closing
from freebody.stability.modes import Mode, eigenvalues, modes
from freebody.stability.state_space import SingularConfiguration, StateSpace, state_space

# Coordinates are angles in rad, and lengths as parts of the size of the mechanism.
_STEPS = 60
_LONGEST = 0.2
"""Step of Newton's method beyond which it is shortened; of lengths it doubles with every step."""
_FOUND = 1e-11
"""Step below which the place is found."""
_HALF = 0.5
"""Part of the accelerations that a step may leave by its linear equations; there it is singular if it leaves more."""
_SMALL = 1e-9
"""Part of the largest slope below which nothing holds a perturbation."""
_SAME = 1e-6
"""Distance below which two places are one."""
_ALONG_ONE, _ALONG_TWO, _STARTS = 128, 16, 512
"""Starts where one coordinate has bounds, along each of two, and of more."""
_SYMMETRIC = 1e-9
"""Difference of entries across the diagonal, relative to the largest, below which a matrix is symmetric."""


@dataclass(frozen=True)
class Equilibrium:
    """A place of rest with its linear equations, and whether it is ``stable``, ``unstable`` or ``neutral``, and ``why``. At it the
    accelerations by two routes are 0 to round-off; ``instant`` has the static forces and reactions."""

    state: State
    space: StateSpace
    stability: str
    why: str
    source: CompiledModel

    @property
    def coordinates(self) -> dict[str, float]:
        """Where it is, m and rad."""
        return dict(zip(self.space.coordinates, self.state.q.tolist(), strict=True))

    @cached_property
    def modes(self) -> tuple[Mode, ...]:
        """From slow to fast."""
        return modes(self.space)

    @cached_property
    def instant(self) -> Instant:
        """All forces and reactions at rest."""
        return Instant(self.source, self.state)


def equilibrium(
    source: CompiledModel, state: State, inputs: Sequence[str] = (), outputs: Sequence[str] = (), touching: State | None = None
) -> Equilibrium | None:
    """The place of rest that Newton's method comes to from a state, None if to none. Raises as ``state_space``."""
    state = state.at(state.q)
    rest = rest_near(source, state, touching) if is_moving(source, state) else state
    if rest is None or not _rests(source, rest, "newton_euler"):
        return None
    space = state_space(source, rest, inputs, outputs)
    return Equilibrium(rest, space, *_judged(source, space), source)


def equilibria(
    source: CompiledModel,
    state: State,
    bounds: Mapping[str, tuple[float, float]],
    inputs: Sequence[str] = (),
    outputs: Sequence[str] = (),
) -> tuple[list[Equilibrium], list[State]]:
    """All places of rest that are found where coordinates are within ``bounds``, in their order: by Newton's method from starts that
    fill the bounds, and from between any two of these, of a mechanism of one freedom, where the acceleration changes its sign; and those
    that are singular, of which no linear equations say whether they are stable."""
    names, units = _named(source, state)
    if wrong := [name for name in bounds if name not in names]:
        raise ValueError(f"no coordinate is called {wrong[0]!r}; there are {', '.join(names)}")
    found: list[State] = []
    for start in _starts(source, state, bounds):
        rest = rest_near(source, start) if is_moving(source, start) else start
        inside = rest is not None and all(a - _SAME <= rest.q[names.index(n)] <= b + _SAME for n, (a, b) in bounds.items())
        if inside and all(np.abs((rest.q - other.q) / units).max() > _SAME for other in found):
            found.append(rest)
    found.sort(key=lambda rest: tuple(np.round(rest.q[[names.index(name) for name in bounds]], 9)))
    judged: list[Equilibrium | None] = []
    singular: list[State] = []
    for rest in found:
        try:
            judged.append(equilibrium(source, rest, inputs, outputs))
        except SingularConfiguration:
            singular.append(rest)
    return [each for each in judged if each is not None], singular


def is_moving(source: CompiledModel, state: State) -> bool:
    """Whether anything moves or accelerates in a state, or a state of the model's own changes."""
    own = [f"rate({quote(name)})" for name in source.metadata["states"]]
    return bool(Instant(source, state).nonequilibrium()) or bool(own and source.evaluate(own, state).any())


def _rests(source: CompiledModel, state: State, route: str = "minimal") -> bool:
    """Whether accelerations are round-off: of the loads, or where nothing loads it of what a perturbation of round-off would cause."""
    instant = Instant(source, state, route)
    if not instant.nonequilibrium():
        return True
    space, (names, units) = state_space(source, state), _named(source, state)
    free, moving = ([names.index(name) for name in part] for part in (space.free, space.moving))
    slopes = space.a[len(free) : len(free) + len(moving), : len(free)] * units[free] / units[moving, None]
    left = np.array([instant.accelerations[name] for name in space.moving]) / units[moving]
    return bool(np.abs(left).max(initial=0.0) <= _FOUND * np.abs(slopes).max(initial=0.0))


def rest_near(source: CompiledModel, state: State, touching: State | None = None) -> State | None:
    """The place of rest that Newton's method comes to on closed loops, from a state, and with closed what touches in it, or in
    another; None if to none."""
    names, units = _named(source, state)
    closing = Closing(source, touching or state, source.free_bodies(touching or state))
    by_contacts = bool(closing.closed) and not any(motion["engaged"] for motion in source.metadata["motions"])

    def closed(q: Array) -> Array:
        if not by_contacts:
            return source.assemble(state.p, state.t, guess=dict(zip(names, q.tolist(), strict=True)), history=state.history)[0].q
        if (found := closing.place(q)) is None:
            raise np.linalg.LinAlgError("what touches does not close there")
        return found

    turns, is_pulled = np.array([c["dimension"] == "rad" for c in source.metadata["coordinates"]], bool), False
    try:
        rest = state.at(closed(np.array(state.q, dtype=float)) if by_contacts else np.array(state.q, dtype=float))
        for k in range(_STEPS):
            change, own, is_enough = newton_step(source, rest)
            if not (is_enough or is_pulled):  # where nothing holds a perturbation, the way on is that of the loads
                pull, is_pulled = source.instant(rest).accelerations / units, True
                rest = rest.at(closed(rest.q + _LONGEST * units * pull / np.abs(pull).max()))
                continue
            sizes = np.abs(change / units)
            longest = np.where(turns, _LONGEST, _LONGEST * 2.0**k)  # a length may be far off, an angle comes round again
            part = float((longest / np.maximum(sizes, longest)).min(initial=1.0))
            p = np.append(rest.p[: len(rest.p) - len(own)], rest.p[len(rest.p) - len(own) :] + own)
            rest = replace(rest, p=p).at(closed(rest.q + part * change))
            if sizes.max(initial=0.0) < _FOUND and np.abs(own).max(initial=0.0) <= _FOUND * np.abs(p).max(initial=1.0):
                return rest if _rests(source, rest) else None
    except (MotionError, ValueError, SingularConfiguration):  # a law of forces has no value everywhere
        pass
    return None


def newton_step(source: CompiledModel, state: State) -> tuple[Array, Array, bool]:
    """What Newton's method changes of the coordinates, and of the model's own states, for accelerations and rates of these to vanish, along
    perturbations that keep loops closed; the least change where nothing holds some. With it whether it brings them to vanish."""
    space, own = state_space(source, state), source.metadata["states"]
    free, last = len(space.free), len(space.states) - len(own)
    rates = [*(f"accel({quote(name)})" for name in space.moving), *(f"rate({quote(name)})" for name in own)]
    slopes = space.a[free:, [*range(free), *range(last, len(space.states))]]
    left = source.evaluate(rates, state)
    change = np.linalg.lstsq(slopes, -left, rcond=_SMALL)[0]
    is_enough = np.linalg.norm(slopes @ change + left) <= _HALF * np.linalg.norm(left)
    return space.places[:, :free] @ change[:free], change[free:], bool(is_enough)


def _starts(source: CompiledModel, state: State, bounds: Mapping[str, tuple[float, float]]) -> Iterator[State]:
    """States on closed loops that fill the bounds, and of one freedom those near which the acceleration changes its sign."""
    from scipy.optimize import brentq  # equations load without it, which takes half a second

    low, high = (np.array([pair[i] for pair in bounds.values()]) for i in (0, 1))
    names = source.coordinate_names
    if len(bounds) == 1:
        parts = np.linspace(0, 1, _ALONG_ONE + 1)[:, None]
    elif len(bounds) == 2:
        parts = np.stack(np.meshgrid(*[np.linspace(0, 1, _ALONG_TWO + 1)] * 2), axis=-1).reshape(-1, 2)
    else:
        from scipy.stats import qmc

        parts = qmc.Halton(len(bounds), scramble=False).random(_STARTS)

    def at(values: Array) -> State:
        fixed = dict(zip(bounds, values.tolist(), strict=True))
        guess = {name: value for name, value in zip(names, state.q.tolist(), strict=True) if name not in fixed}
        return source.assemble(state.p, state.t, fixed=fixed, guess=guess, history=state.history)[0]

    def acceleration(value: float) -> float:
        return float(source.instant(at(np.array([value]))).accelerations[names.index(next(iter(bounds)))])

    before: tuple[float, float] | None = None
    for values in low + parts * (high - low):
        try:
            yield (start := at(values))
            if len(bounds) == 1:
                now = (float(values[0]), float(source.instant(start).accelerations[names.index(next(iter(bounds)))]))
                if before is not None and before[1] * now[1] < 0:
                    yield at(np.array([brentq(acceleration, before[0], now[0], xtol=_SAME * (now[0] - before[0]))]))
                before = now
        except MotionError:
            before = None


def _named(source: CompiledModel, state: State) -> tuple[list[str], Array]:
    coordinates = source.metadata["coordinates"]
    return [c["name"] for c in coordinates], source.free_bodies(state).units(coordinates)


def _judged(source: CompiledModel, space: StateSpace) -> tuple[str, str]:
    """Whether an equilibrium is stable, and why, by its linear equations and, where these leave it open, by energy."""
    values = eigenvalues(space)
    if len(values) == 0:
        return "stable", "nothing is free to move"
    if (fastest := values.real.max()) > 0:
        return "unstable", f"a perturbation grows at {fastest:.6g} 1/s"
    if not values.all():
        return "neutral", "nothing brings some perturbation back"
    if (slowest := values.real.max()) < 0:
        return "stable", f"all perturbations die away, the slowest at {-slowest:.6g} 1/s"
    if len(space.states) != 2 * len(space.free):
        return "neutral", "undamped oscillations, which linear equations do not decide"
    f, places = len(space.free), space.places[:, : len(space.free)]
    mass = places.T @ source.mass_matrix(space.state) @ places
    stiffness, damping = -mass @ space.a[f:, :f], -mass @ space.a[f:, f:]
    conservative = np.abs(stiffness - stiffness.T).max() <= _SYMMETRIC * np.abs(stiffness).max()
    if conservative and np.linalg.eigvalsh(stiffness).min() > 0 and np.linalg.eigvalsh(damping + damping.T).min() >= -_SYMMETRIC:
        return "stable", "the potential energy has a minimum there"
    return "neutral", "undamped oscillations, which linear equations do not decide"

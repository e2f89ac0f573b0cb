"""Small perturbations of a state, at rest or along a motion, in numbers: ẋ = A x + B w, y = C x + D w.

The perturbations x are those of independent coordinates and of their rates; all others follow, so that loops stay closed, and what
touches, sticks or rolls goes on to do so."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr

from freebody.core import GROUND, Array, CompiledModel, RowDerivatives, State, quote

_DEPENDENT = 1e-9
"""Pivot, relative to the largest, below which a row depends on others."""


_ROUND_OFF = 1e-12
"""Size of a row, relative to the largest, below which it holds nothing."""
_BESIDE = 0.01
"""Perturbation at which it is seen whether rows that depend on each other do so everywhere: rad, or part of the mechanism."""


class SingularConfiguration(ValueError):
    """A place where loops lose their independence, so that no linear equations say what moves there."""


@dataclass(frozen=True)
class StateSpace:
    """ẋ = A x + B w, y = C x + D w in SI units: x are perturbations of ``states`` (independent coordinates, independent rates, states of
    the model's own), w of ``inputs``, y of ``outputs``. Along a motion this holds at the time of ``state``. δq = ``places`` x and
    δu = ``rates`` x are the perturbations of all ``coordinates``."""

    state: State
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    a: Array
    b: Array
    c: Array
    d: Array
    coordinates: tuple[str, ...]
    places: Array
    rates: Array

    @property
    def free(self) -> tuple[str, ...]:
        """The coordinates whose perturbations are independent."""
        return tuple(name for name in self.states if name in self.coordinates)

    @property
    def moving(self) -> tuple[str, ...]:
        """The coordinates whose rates are independent."""
        return tuple(name for name in self.coordinates if f"rate({quote(name)})" in self.states)


def state_space(
    source: CompiledModel,
    state: State,
    inputs: Sequence[str] = (),
    outputs: Sequence[str] = (),
    free: Sequence[str] | None = None,
) -> StateSpace:
    """The linear equations of perturbations of a state; what is in place, touches, sticks and slides goes on to do so.

    ``inputs`` are parameters that move neither parts nor what is prescribed: of forces, of controllers, of prescribed accelerations;
    a mass only at rest, since along a motion what is added or lost has a momentum of its own.
    ``outputs`` are any expressions. ``free`` are the independent coordinates, by default those that the others follow most slowly.
    Raises ``ValueError`` for inputs that are none, coordinates that are not independent and what has no derivatives,
    ``SingularConfiguration``, and what solving an instant raises."""
    names = source.coordinate_names
    n, rows = len(names), source.row_derivatives(state)
    columns, own = ([1 + 2 * n + _parameter(source, name) for name in each] for each in (inputs, source.metadata["states"]))
    free, moving, places, rates = _perturbations(source, state, rows, own, free and [names.index(name) for name in free])
    accelerations, parts = [f"accel({quote(name)})" for name in names], _places_of_bodies(source, state) if inputs else []
    if inputs and (
        moved := [x for x, by in zip(inputs, source.derivatives(["kinetic()"], state)[0, columns], strict=True) if by]
    ):
        raise ValueError(f"{moved[0]} is no input along a motion: its change is one of mass, whose momentum is not known")
    texts = [*accelerations, *(f"rate({quote(name)})" for name in source.metadata["states"]), *outputs, *parts]
    found, of_places = np.split(source.derivatives(texts, state), [len(texts) - len(parts)])
    if not np.isfinite(found).all():
        raise ValueError(f"{texts[int(np.argmin(np.isfinite(found).all(axis=1)))]} has no derivatives at this state")
    for name, column in zip(inputs, columns, strict=True):
        _require_input(name, [row.name for row in rows if _moves(row, column)], parts, of_places[:, column])
    by_state = found[:, 1 : 1 + n] @ places + found[:, 1 + n : 1 + 2 * n] @ rates
    by_state[:, len(free) + len(moving) :] += found[:, own]
    by_input, changing, given = found[:, columns], [*moving, *range(n, n + len(own))], n + len(own)
    return StateSpace(
        state=state,
        states=(*(names[i] for i in free), *(f"rate({quote(names[i])})" for i in moving), *source.metadata["states"]),
        inputs=tuple(inputs),
        outputs=tuple(outputs),
        a=np.vstack([rates[free], by_state[changing]]),
        b=np.vstack([np.zeros((len(free), len(inputs))), by_input[changing]]),
        c=by_state[given:],
        d=by_input[given:],
        coordinates=tuple(names),
        places=places,
        rates=rates,
    )


def along_motion(
    source: CompiledModel, states: Iterable[State], inputs: Sequence[str] = (), outputs: Sequence[str] = ()
) -> list[StateSpace]:
    """The linear equations at states of one motion, all in the perturbations that are independent at the first. Raises as
    ``state_space``."""
    found: list[StateSpace] = []
    for state in states:
        found.append(state_space(source, state, inputs, outputs, found[0].free if found else None))
    return found


def by_parameter(source: CompiledModel, state: State, space: StateSpace, which: int) -> tuple[Array, Array]:
    """How the dependent coordinates (n,), and the accelerations of the free ones, change by a parameter while the free ones stay: of a
    state at rest with its linear equations."""
    n = len(state.q)
    column = 1 + 2 * n + which
    rows = [row for row in source.row_derivatives(state) if row.value is not None]
    free = [space.coordinates.index(name) for name in space.free]
    texts = [f"accel({quote(name)})" for name in space.free]
    found, dependent = source.derivatives(texts, state), [i for i in range(n) if i not in free]
    places = np.zeros(n)
    if rows:
        held = np.array([row.value for row in rows])
        places[dependent] = _following(held[:, 1 : 1 + n], dependent, held[:, column])
    return places, found[:, column] + found[:, 1 : 1 + n] @ places


def _perturbations(
    source: CompiledModel, state: State, rows: Sequence[RowDerivatives], own: Sequence[int], asked: Sequence[int] | None
) -> tuple[list[int], list[int], Array, Array]:
    """The coordinates that are free, those whose rates are, and what perturbations of these make of all coordinates and rates."""
    n = len(state.q)
    units = source.free_bodies(state).units(source.metadata["coordinates"]) if rows else np.ones(n)
    places, by_places, by_rates, by_own = _matrices(rows, n, own)
    dependent = _dependent(by_rates * units, [i for i in range(n) if asked is None or i not in asked])
    placed = _dependent(places * units, dependent)
    free, moving = ([i for i in range(n) if i not in follow] for follow in (placed, dependent))
    if asked is not None and list(asked) != free:
        names = source.coordinate_names
        raise ValueError(f"{', '.join(names[i] for i in asked)} are not as many independent coordinates as there are")
    fixed = len(free) + len(moving)
    size = fixed + len(own)
    q, u = np.zeros((n, size)), np.zeros((n, size))
    q[free, range(len(free))] = 1
    u[moving, range(len(free), fixed)] = 1
    q[placed] = _following(places * units, placed, places @ q) * units[placed, None]
    left = by_rates @ u + by_places @ q
    left[:, fixed:] += by_own
    u[dependent] = _following(by_rates * units, dependent, left) * units[dependent, None]
    if len(dependent) < len(by_rates):
        _require_regular(source, state, q[:, : len(free)], units, len(dependent))
    return free, moving, q, u


def _matrices(rows: Sequence[RowDerivatives], n: int, own: Sequence[int] = ()) -> tuple[Array, ...]:
    """What rows hold of places, by coordinates; and of rates, by coordinates, by rates and by the model's own states."""
    on_q, on_u = list(range(1, 1 + n)), list(range(1 + n, 1 + 2 * n))
    going = [row for row in rows if row.rate is not None]
    kept = [row.rate[on_u] if row.sticks else row.value[on_q] for row in going if row.sticks or row.value is not None]
    of_rates = ([row.rate[on] for row in going] for on in (on_q, on_u, list(own)))
    return tuple(
        np.array(part).reshape(len(part), -1) if part else np.zeros((0, k))
        for part, k in zip((kept, *of_rates), (n, n, n, len(own)), strict=True)
    )


def _require_regular(source: CompiledModel, state: State, ways: Array, units: Array, rank: int) -> None:
    """Raises ``SingularConfiguration`` where rows that depend on each other do not do so beside it."""
    names = source.coordinate_names
    for way in ways.T:
        guess = dict(zip(names, state.q + _BESIDE * way / np.abs(way / units).max(), strict=True))
        beside = source.assemble(state.p, state.t, guess=guess, history=state.history)[0]
        held = _matrices(source.row_derivatives(beside), len(names))[2]
        if len(_dependent(held * units, range(len(names)))) > rank:
            raise SingularConfiguration(
                "this configuration is singular: loops lose their independence, and no linear equations say what moves there; "
                "give a state beside it"
            )


def _dependent(rows: Array, among: Sequence[int]) -> list[int]:
    """As many of the columns as rows are independent, those by which the others are followed most slowly."""
    sizes = np.linalg.norm(rows, axis=1)
    rows = (rows / np.where(sizes, sizes, 1.0)[:, None])[sizes > _ROUND_OFF * sizes.max(initial=0.0)]
    if not rows.size or not among:
        return []
    _, triangle, order = qr(rows[:, among], mode="economic", pivoting=True)
    pivots = np.abs(np.diag(triangle))
    return sorted(among[i] for i in order[: int((pivots > _DEPENDENT * pivots[0]).sum())])


def _following(rows: Array, dependent: Sequence[int], left: Array) -> Array:
    """The changes of dependent columns that cancel what is ``left`` of rows."""
    size = np.linalg.norm(rows, axis=1, keepdims=True)
    size[size <= _ROUND_OFF * size.max(initial=0.0)] = np.inf
    return np.linalg.lstsq(rows[:, dependent] / size, -left / size, rcond=None)[0]


def _parameter(source: CompiledModel, name: str) -> int:
    known = [p["name"] for p in source.metadata["parameters"]]
    if name not in known:
        raise ValueError(f"no parameter is called {name!r}; there are {', '.join(known) or 'none'}")
    return known.index(name)


def _places_of_bodies(source: CompiledModel, state: State) -> list[str]:
    """Where the named points of bodies are, and how these are turned."""
    points = {name: body for name, (body, *_) in source.points(state.p).items() if body != GROUND}
    turned = [f"angle({quote(body)})" for body in dict.fromkeys(points.values())]
    return [f"{axis}({quote(name)})" for name in points for axis in "xy"] + turned


def _moves(row: RowDerivatives, column: int) -> bool:
    return any(part is not None and abs(part[column]) > _DEPENDENT * np.abs(part).max() for part in (row.value, row.rate))


def _require_input(name: str, moved: Sequence[str], places: Sequence[str], by_input: Array) -> None:
    """Raises ``ValueError`` for a parameter whose change is a motion, of which the linear equations know nothing."""
    if moved := [*moved, *(place for place, change in zip(places, by_input, strict=True) if change)]:
        raise ValueError(
            f"{name} is no input: its change moves {moved[0]}; a parameter of a force, of a controller or of an acceleration "
            "that is prescribed is one"
        )

"""What is asked of motions that come back: periodic motions, all of them within bounds, steps, boundaries, limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
import scipy.linalg

from freebody.core import Array, CompiledModel, MotionError, State, quote
from freebody.model.errors import ModelProblem
from freebody.model.names import suggestion
from freebody.model.start import parameter_values, quantity
from freebody.periodic import boundary, motion
from freebody.periodic.boundary import Crossing
from freebody.periodic.limit import Limit, limit
from freebody.periodic.motion import PeriodicMotion, PeriodicMotions
from freebody.periodic.return_map import RTOL, NoReturn, Return, ReturnMap

if TYPE_CHECKING:
    from freebody.model.builder import Builder
    from freebody.periodic.symbolic_map import SymbolicMap

_INDEPENDENT = 1e-9
"""Part of the largest singular value of the rows below which one follows from the others."""


@dataclass(frozen=True)
class Periodic:
    """A return map and the values (k,) of its unknowns at the start of the model."""

    map: ReturnMap
    start: Array

    def step(self, values: Mapping[str, float] | None = None, **changes: Any) -> Return:
        """One return from the start, or from ``values`` of unknowns."""
        return self.map(self._from(values), **changes)

    def steps(self, number: int, values: Mapping[str, float] | None = None, **changes: Any) -> list[tuple[Array, float]]:
        """The values of the unknowns after each of a ``number`` of returns, each begun with those of the one before; and its time."""
        here, found = self._from(values), []
        for _ in range(number):
            here, time = self.map.value(here, **changes)
            found.append((here, time))
        return found

    def find(self, values: Mapping[str, float] | None = None, **changes: Any) -> PeriodicMotion:
        """The periodic motion to which Newton's method comes from the start, or from ``values`` of unknowns. Raises
        ``NoPeriodicMotion``."""
        return motion.find(self.map, self._from(values), **changes)

    def find_all(self, within: Mapping[str, tuple[Any, Any]], starts: int = 32, **changes: Any) -> PeriodicMotions:
        """The periodic motions with unknowns within bounds. With one unknown the map is followed until it is resolved; with more,
        those that Newton's method reaches from at least ``starts`` points spread over the bounds; see ``PeriodicMotions.looked``."""
        self._from(dict.fromkeys(within, 0.0))
        if missing := [name for name in self.map.unknowns if name not in within]:
            raise ModelProblem(f"`{missing[0]}` has no bounds", "give (lowest, highest) for every unknown")
        bounds = [self._range(name, within[name]) for name in self.map.unknowns]
        return motion.find_all(self.map, bounds, starts, **changes)

    def boundary(self, parameter: str, within: tuple[Any, Any], samples: int = 24, **changes: Any) -> list[Crossing]:
        """All values of a parameter within bounds at which a multiplier of the periodic motion comes to the unit circle; see
        ``freebody.periodic.boundary.crossings``."""
        known = [each["name"] for each in self.map.mechanism.compile().metadata["parameters"]]
        if parameter not in known:
            raise ModelProblem(f"there is no parameter `{parameter}`", suggestion(parameter, known, "parameters"))
        return boundary.crossings(self.map, parameter, self._range(parameter, within), self.start, samples, **changes)

    def boundary_curve(
        self, parameter: str, within: tuple[Any, Any], along: str, values: Sequence[float], samples: int = 24, **changes: Any
    ) -> list[Crossing]:
        """The same for each of the ``values`` of another parameter, ``along``: the boundary in the plane of both."""
        return [each for value in values for each in self.boundary(parameter, within, samples, **changes, **{along: value})]

    def limit(self, parameter: str, first: Any, values: Mapping[str, float] | None = None, **changes: Any) -> Limit:
        """The periodic motion as a parameter tends to 0 from ``first``, with an estimate of its error; see ``freebody.periodic.limit``."""
        return limit(self.map, parameter, self._value(parameter, first), self._from(values), **changes)

    def symbolic(self, values: Mapping[str, float] | None = None) -> SymbolicMap:
        """The map in symbols, of one unknown and one freedom; held against numbers near the start, or near ``values``. Raises
        ``NoSymbolicMap``; see ``freebody.periodic.symbolic_map``."""
        from freebody.periodic.symbolic_map import symbolic_map

        return symbolic_map(self.map, float(self._from(values)[0]))

    def _from(self, values: Mapping[str, float] | None) -> Array:
        if unknown := [name for name in values or {} if name not in self.map.unknowns]:
            raise ModelProblem(f"`{unknown[0]}` is not among the unknowns", f"they are {', '.join(self.map.unknowns)}")
        return np.array([(values or {}).get(name, own) for name, own in zip(self.map.unknowns, self.start, strict=True)])

    def _range(self, name: str, within: tuple[Any, Any]) -> tuple[float, float]:
        """Bounds in SI, from numbers or quantities like ``"30 deg"``. Raises ``ModelProblem`` where they are none."""
        low, high = (self._value(name, x) for x in within)
        if not low < high:
            raise ModelProblem(f"`{name}` is sought from {low:g} to {high:g}", "give the lowest and then the highest")
        return low, high

    def _value(self, name: str, given: Any) -> float:
        """A value of an unknown or a parameter in SI."""
        return quantity(name, given, self.unit_of(name))

    def unit_of(self, name: str) -> str:
        """The unit of SI of an unknown or a parameter; "" where it is not known."""
        metadata = self.map.mechanism.compile().metadata
        units = {each["name"]: each["unit"] for each in metadata["parameters"]}
        for each in metadata["coordinates"]:
            units |= {quote(each["name"]): each["dimension"], f"rate({quote(each['name'])})": f"{each['dimension']}/s"}
        return units.get(name, "")


def periodic(
    mechanism: Builder,
    returns: Mapping[str, str] | Sequence[str] | None = None,
    *,
    section: str | None = None,
    period: str | float | None = None,
    horizon: float | str | None = None,
    rtol: float = RTOL,
    **changes: Any,
) -> Periodic:
    """Motions that come back after a ``period``, or whenever ``section`` switches; see ``Mechanism.periodic``."""
    if (section is None) == (period is None):
        raise ModelProblem(
            "say when the motion comes back: by `section` or by `period`", "a section is an event, contact or stop"
        )
    source = mechanism.compile()
    state, _ = mechanism.start(**changes)
    named = returns if isinstance(returns, Mapping) else {name: name for name in returns or independent(source, state)}
    _check_section(source, section)
    parameters = parameter_values(source, state.p)
    readings = [name for name in named if name not in parameters]
    read = dict(zip(readings, source.evaluate(readings, state).tolist(), strict=True)) if readings else {}
    start = np.array([parameters[name] if name in parameters else read[name] for name in named])
    longest = float(mechanism.run_plan(horizon, {}).until) if section else 0.0
    text = None if period is None else str(period)
    found = ReturnMap(mechanism, tuple(named), tuple(named.values()), section, text, changes, rtol, longest)
    return Periodic(found if returns or section else _turned_back(found, start), start)


def _turned_back(returns: ReturnMap, start: Array) -> ReturnMap:
    """The map of a driven mechanism in which angles come back less the whole turns that they make in the period from the start."""
    try:
        there, _ = returns.value(start)
    except (NoReturn, MotionError):
        return returns
    angles = {quote(each["name"]) for each in returns.mechanism.compile().metadata["coordinates"] if each["dimension"] == "rad"}
    turns = np.rint((there - start) / (2 * np.pi)).astype(int).tolist()
    read = [f"{name} - {2 * n}*pi" if n and name in angles else name for name, n in zip(returns.unknowns, turns, strict=True)]
    return replace(returns, returns=tuple(read))


def independent(source: CompiledModel, state: State) -> list[str]:
    """Coordinates that are free of one another and of prescribed motions, then their rates, and the model's own states."""
    names, n = [quote(each["name"]) for each in source.metadata["coordinates"]], len(state.q)
    rows = np.array([row.value[1 : 1 + n] for row in source.row_derivatives(state) if row.value is not None]).reshape(-1, n)
    free = scipy.linalg.null_space(rows, rcond=_INDEPENDENT)
    _, _, order = scipy.linalg.qr(free.T, pivoting=True)
    chosen = [names[i] for i in sorted(order[: free.shape[1]])]
    return [*chosen, *(f"rate({name})" for name in chosen), *source.metadata["states"]]


def _check_section(source: CompiledModel, section: str | None) -> None:
    known = [each["name"] for each in (*source.spec["events"], *source.metadata["limits"], *source.metadata["joints"])]
    if section and section not in {*known, *(name.partition("[")[0] for name in known)}:
        raise ModelProblem(f"there is no event, contact, string, stop or joint `{section}`", f"there is {', '.join(known)}")

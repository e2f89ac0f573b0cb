"""What is asked of a mechanism near rest: its equilibria with modes, response and feedback; curves of them along a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from freebody.core import State
from freebody.model.start import quantity
from freebody.solve.rich_tables import PlainText, table
from freebody.stability import modes
from freebody.stability.continuation import STEPS, Curve, follow
from freebody.stability.equilibria import Equilibrium, equilibria, equilibrium

if TYPE_CHECKING:
    from freebody.model.builder import Builder


_ROUND_OFF = 1e-13
"""Coordinate, rad or m, that is printed as 0."""
_ABREAST = 3
"""Shapes beside one another, so that no figure is cut on a narrow terminal."""


class NoEquilibrium(ValueError):
    """Nothing rests where it was looked for."""


@dataclass(frozen=True)
class Stability(PlainText):
    """The equilibria that were asked for, and where they were looked for."""

    equilibria: tuple[Equilibrium, ...]
    looked: str

    def __iter__(self) -> Iterator[Equilibrium]:
        return iter(self.equilibria)

    def __getitem__(self, i: int) -> Equilibrium:
        return self.equilibria[i]

    def __len__(self) -> int:
        return len(self.equilibria)

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        yield self.looked
        for i, rest in enumerate(self.equilibria, 1):
            units = {c["name"]: c["dimension"] for c in rest.source.metadata["coordinates"]}
            title = f"equilibrium {i}: {rest.stability}" if len(self) > 1 else f"equilibrium: {rest.stability}"
            yield f"\n{title}; {rest.why}\n"
            places = [(n, x if abs(x) > _ROUND_OFF else 0.0, units[n]) for n, x in rest.coordinates.items()]
            yield table("", ["coordinate", "value", "unit"], places)
            yield from mode_tables(rest)

    def to_json(self) -> dict[str, Any]:
        """For scripts, SI."""
        return {"looked": self.looked, "equilibria": [_plain(rest) for rest in self]}


@dataclass(frozen=True)
class Curves(PlainText):
    """Curves of equilibria along a ``parameter`` of a ``unit``; ``left``: how many branch points wait from which none was followed."""

    parameter: str
    unit: str
    curves: tuple[Curve, ...]
    left: int = 0

    @property
    def missing(self) -> list[str]:
        """What was not followed, in sentences."""
        cut = [f"curve {i} goes on: {STEPS} steps were made" for i, curve in enumerate(self.curves, 1) if curve.is_cut]
        more = f"{len(self.curves)} curves were followed; at {self.left} more branch points others may begin"
        return cut + [more] * (self.left > 0)

    def __iter__(self) -> Iterator[Curve]:
        return iter(self.curves)

    def __rich_console__(self, console: Any, options: Any) -> Iterator[Any]:
        for i, curve in enumerate(self.curves, 1):
            first = curve.equilibria[0]
            units = {c["name"]: c["dimension"] for c in first.source.metadata["coordinates"]}
            names = [f"{name} [{units[name]}]" for name in first.space.coordinates]
            points = [(x, *rest.coordinates.values(), rest.stability) for x, rest in _told(curve)]
            head = f"{self.parameter} [{self.unit}]" if self.unit else self.parameter
            yield table(f"curve {i} of {len(self.curves)}", [head, *names, ""], points, [head, *names])
            special = [(each.kind, each.value, *each.state.q.tolist()) for each in curve.special]
            if special:
                yield table("special points", ["", head, *names], special, [head, *names])
        yield from self.missing

    def to_json(self) -> list[dict[str, Any]]:
        """For scripts, SI."""
        return [
            {
                "parameter": self.parameter,
                "is_cut": curve.is_cut,
                "left": self.left,
                "values": curve.values.tolist(),
                "coordinates": [rest.coordinates for rest in curve.equilibria],
                "stability": [rest.stability for rest in curve.equilibria],
                "special": [{"kind": s.kind, "value": s.value, "q": s.state.q.tolist()} for s in curve.special],
            }
            for curve in self.curves
        ]


def stability(
    mechanism: Builder,
    state: State,
    bounds: Mapping[str, tuple[Any, Any]] | None,
    inputs: Sequence[str],
    outputs: Sequence[str],
) -> Stability:
    """The equilibrium near a state, or all within bounds. Raises ``NoEquilibrium`` where there is none."""
    source = mechanism.source()
    if not bounds:
        if (found := equilibrium(source, state, inputs, outputs)) is None:
            raise NoEquilibrium(
                "no equilibrium was found from there; give coordinates near one, or bounds for some (theta=-2..2)"
            )
        return Stability((found,), "Newton's method from the state that was given; two routes find accelerations of 0.")
    units = {c["name"]: c["dimension"] for c in source.metadata["coordinates"]}
    if wrong := [name for name in bounds if name not in units]:
        raise ValueError(f"no coordinate is called {wrong[0]!r}; there are {', '.join(units)}")
    within = {name: tuple(quantity(name, x, units[name]) for x in pair) for name, pair in bounds.items()}
    _require_order(within)
    all_found, singular = equilibria(source, state, within, inputs, outputs)
    said = ", ".join(f"{name} from {low:g} to {high:g} {units[name]}" for name, (low, high) in within.items())
    places = (", ".join(f"{n} = {x:g}" for n, x in zip(units, rest.q.tolist(), strict=True)) for rest in singular)
    left = "".join(f"\nNot judged, since this configuration is singular: {place}." for place in places)
    if not all_found:
        raise NoEquilibrium(f"no equilibrium was found with {said}; look in wider bounds, or begin nearer to one{left}")
    how = "Newton's method from starts that fill the bounds"
    how += ", and between any two where the acceleration changes its sign" if len(within) == 1 else ""
    return Stability(tuple(all_found), f"{len(all_found)} with {said}: {how}; two routes find accelerations of 0.{left}")


def _require_order(within: Mapping[str, tuple[float, float]]) -> None:
    """Raises ``ValueError`` for bounds of which the first is the greater."""
    if wrong := [name for name, (low, high) in within.items() if not low < high]:
        low, high = within[wrong[0]]
        raise ValueError(f"{wrong[0]} from {low:g} to {high:g}: give the lower bound first")


def curves(mechanism: Builder, state: State, parameter: str, within: tuple[Any, Any], changes: Mapping[str, Any]) -> Curves:
    """The curves of equilibria along a parameter through the one near a state. Raises ``NoEquilibrium``, ``ValueError``."""
    source = mechanism.source()
    known = {p["name"]: p["unit"] for p in source.metadata["parameters"]}
    if parameter not in known:
        raise ValueError(f"no parameter is called {parameter!r}; there are {', '.join(known) or 'none'}")
    low, high = (quantity(parameter, x, known[parameter]) for x in within)
    _require_order({parameter: (low, high)})
    here = float(state.p[list(known).index(parameter)])
    if not low <= here <= high:
        raise ValueError(
            f"{parameter} is {here:g} at the start, outside {low:g} to {high:g}: begin within, with {parameter}={low:g}"
        )
    if (first := equilibrium(source, state)) is None:
        raise NoEquilibrium("no equilibrium was found from the start; give coordinates near one")
    others = {name: value for name, value in changes.items() if name in known}

    def bind(value: float) -> Any:
        return mechanism.initial_state({**others, parameter: value})["p"]

    found, left = follow(source, first.state, parameter, (low, high), bind)
    return Curves(parameter, known[parameter], tuple(found), left)


def response_table(rest: Equilibrium, frequencies: ArrayLike) -> Any:
    """Amplitude and phase of each output for each input at frequencies in Hz."""
    found = modes.response(rest.space, frequencies)
    pairs = [(i, j) for i in range(len(rest.space.outputs)) for j in range(len(rest.space.inputs))]
    rows = [
        (float(f), rest.space.outputs[i], rest.space.inputs[j], float(abs(g[i, j])), float(np.angle(g[i, j], deg=True)))
        for f, g in zip(np.atleast_1d(frequencies), found, strict=True)
        for i, j in pairs
    ]
    return table("frequency response", ["f [Hz]", "output", "input", "amplitude, SI", "phase [deg]"], rows)


def mode_tables(rest: Equilibrium) -> Iterator[Any]:
    """Frequencies and damping ratios; and the shapes: amplitude and phase of each coordinate."""
    modes = list(enumerate(rest.modes, 1))
    rows = [(f"{i}", each.eigenvalue.real, each.eigenvalue.imag, each.frequency, each.damping) for i, each in modes]
    yield table("modes", ["", "Re λ [1/s]", "Im λ [1/s]", "frequency [Hz]", "damping ratio"], rows)
    for first in range(0, len(modes), _ABREAST):
        abreast = modes[first : first + _ABREAST]
        shapes = [(name, *(_phasor(each.shape[name]) for _, each in abreast)) for name in rest.space.coordinates]
        heads = [f"mode {i}" for i, _ in abreast]
        yield table("" if first else "shapes, SI", ["", *heads], shapes, heads)


def _phasor(amplitude: complex) -> str:
    """An amplitude, with its phase in degrees where it is neither 0 nor 180."""
    size, angle = abs(amplitude), float(np.degrees(np.angle(amplitude)))
    if size < 1e-9:
        return "0"
    if abs(amplitude.imag) < 1e-6 * size:
        return f"{amplitude.real:.4g}"
    return f"{size:.3g} ∠ {angle:.0f}°"


def _told(curve: Curve) -> list[tuple[float, Equilibrium]]:
    """At most some twenty points of a curve."""
    every = max(1, len(curve.values) // 20)
    pairs = list(zip(curve.values.tolist(), curve.equilibria, strict=True))
    return [pair for i, pair in enumerate(pairs) if i % every == 0 or i == len(pairs) - 1]


def _plain(rest: Equilibrium) -> dict[str, Any]:
    def parts(shape: Mapping[str, complex]) -> dict[str, list[float]]:
        return {name: [x.real, x.imag] for name, x in shape.items()}

    space, instant = rest.space, rest.instant
    return {
        "coordinates": rest.coordinates,
        "stability": rest.stability,
        "why": rest.why,
        "reactions": {name: list(map(float, each.values)) for name, each in instant.reactions.items()},
        "motions": instant.motions,
        "modes": [
            {
                "eigenvalue": [mode.eigenvalue.real, mode.eigenvalue.imag],
                "frequency": mode.frequency,
                "damping": mode.damping,
                "shape": parts(mode.shape),
                "outputs": parts(mode.outputs),
            }
            for mode in rest.modes
        ],
        "states": space.states,
        "inputs": space.inputs,
        "outputs": space.outputs,
        **{name: getattr(space, name).tolist() for name in "abcd"},
    }

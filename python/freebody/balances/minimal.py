"""As many balance equations as degrees of freedom, without reactions where such exist."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from freebody.balances.candidates import WORTH, Candidate, bits, candidates
from freebody.balances.equation import BalanceEquation, equation
from freebody.balances.search import Supports, grown, plainest, set_cost, within
from freebody.balances.system import problem
from freebody.balances.twists import NamedPoints
from freebody.free_body import FreeBodies


@dataclass(frozen=True)
class MinimalForm:
    """Independent equations that hold the accelerations of ``coordinates``, as many as there are, and no other unknowns.

    Where loops leave no such set, it is larger by the fewest reactions that cannot be kept out, ``stays``; ``equations`` is
    empty where these are more than four.
    """

    coordinates: tuple[str, ...]
    equations: tuple[BalanceEquation, ...]
    stays: tuple[str, ...]

    def __str__(self) -> str:
        from freebody.balances.show import show

        return show(self)

    def _repr_html_(self) -> str:
        from freebody.equations.rendering.page import lines

        return lines(str(self))


def minimal_form(states: Sequence[FreeBodies], points: NamedPoints | None = None) -> MinimalForm:
    """The minimal form at ``states[0]``; the arguments are those of ``smallest_set``."""
    given = problem(states)
    coordinates = tuple(unknown.coordinate for unknown in given.unknowns if unknown.coordinate)
    loads = bits(i for i, unknown in enumerate(given.unknowns) if not unknown.coordinate)
    by_loads: dict[int, list[Candidate]] = {}
    for support, alike in candidates(given, points or {}, counted=loads).by_support.items():
        by_loads.setdefault(support & loads, []).extend(alike)
    accelerations = bits(range(len(given.unknowns))) & ~loads
    for size in range(WORTH + 1 if coordinates else 0):
        if found := _form(by_loads, accelerations, size, len(coordinates)):
            chosen, stays = found
            names = tuple(unknown.name for i, unknown in enumerate(given.unknowns) if stays >> i & 1)
            return MinimalForm(coordinates, tuple(equation(given, candidate) for candidate in chosen), names)
    return MinimalForm(coordinates, (), ())


def _form(by_loads: Supports, accelerations: int, size: int, freedom: int) -> tuple[list[Candidate], int] | None:
    """The best set in all accelerations and ``size`` loads, and these loads as bits."""
    sets = ((unknowns, within(by_loads, unknowns)) for unknowns in grown(by_loads, 0, size, size))
    solved = ((plainest(equations, size + freedom, accelerations), unknowns) for unknowns, equations in sets)
    return min(((chosen, stays) for chosen, stays in solved if chosen), key=lambda f: set_cost(f[0], accelerations), default=None)

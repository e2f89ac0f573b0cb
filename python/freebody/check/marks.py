"""What equations say, however they are arranged."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from functools import cached_property

import numpy as np

from freebody.symbolic.evaluate import Array
from freebody.symbolic.tree import Sym

from .language.statements import Equation, symbols_in
from .residual import HOLDS, Residual

_NOTHING = 1e-12  # relative: a solution below it is 0


class Marks:
    """Those of the edits of one ``equation``, where symbols have any values: those ``given`` bound by what the model defines its
    parameters to be, or all free."""

    def __init__(
        self,
        equation: Equation,
        parameters: Collection[Sym],
        given: Collection[str],
        places: tuple[Mapping[str, Array], Mapping[str, Array]],
        at_start: bool,
        residual: Callable[[Equation, Mapping[str, Array]], Residual | None],
    ) -> None:
        self._equation, self._parameters, self._given, self._at_start = equation, {*parameters}, {*given}, at_start
        self._other, self._free = places
        self._residual = residual
        self._linear: dict[str, bool] = {}

    def of(self, equation: Equation) -> tuple[float, ...] | None:
        """What an equation says, however it is arranged; None where it says nothing (a = a)."""
        places = self._other if {n.key for n in symbols_in(equation)} - self._given else self._free
        found = self._residual(equation, places)
        defines = {*symbols_in(equation)} <= self._parameters
        # What a parameter is, or a force at one instant, may be asked.
        if (defines or self._at_start) and found and found.worst < HOLDS:
            places, found = self._free, self._residual(equation, self._free)
        there = np.isfinite(found.ratio).all(axis=1) if found else np.zeros(0, dtype=bool)  # not every root has a value
        if found is None or not there.any() or np.all(np.abs(found.ratio[there]) < HOLDS):
            return None
        left, known = found.sides.residual, {n.key for n in symbols_in(equation)}
        linear = (
            self._solved_for(key, equation, left, places) for key in self._candidates if key in known and self._is_linear(key)
        )
        # m (…) = 0 says m = 0.
        solved = next((each for each in linear if each is not None and np.abs(each[there]).max() > _NOTHING), None)
        if solved is None and left.shape[1] > 1:
            solved = (left / left[np.arange(len(left)), np.abs(left).argmax(axis=1)][:, None]).ravel()
        if solved is None:
            ratio = np.nan_to_num(found.ratio.ravel())
            solved = ratio * np.sign(ratio[np.argmax(np.abs(ratio))])
        return tuple(np.round(np.nan_to_num(solved), 7).tolist())

    @cached_property
    def _candidates(self) -> list[str]:
        """Symbols for which the equation given may be solved, accelerations first."""
        known = [n for n in symbols_in(self._equation) if n.key in self._other and self._other[n.key].ndim == 1]
        return [n.key for n in sorted(known, key=lambda n: -n.dots)]

    def _is_linear(self, key: str) -> bool:
        """Whether the equation given is linear in a symbol; in a long one most are never asked for."""
        if key not in self._linear:
            found = self._given_residual
            self._linear[key] = (
                found is not None and self._solved_for(key, self._equation, found.sides.residual, self._other) is not None
            )
        return self._linear[key]

    @cached_property
    def _given_residual(self) -> Residual | None:
        return self._residual(self._equation, self._other)

    def _solved_for(self, key: str, equation: Equation, base: Array, places: Mapping[str, Array]) -> Array | None:
        """The equation solved for a symbol in which it is linear."""
        once, twice = (self._residual(equation, {**places, key: places[key] + step}) for step in (1.0, 2.0))
        if base.shape[1] != 1 or once is None or twice is None:
            return None
        slope, bend = once.sides.residual - base, twice.sides.residual - 2 * once.sides.residual + base
        there = np.isfinite(base)
        return places[key] - (base / slope)[:, 0] if np.all(np.abs(bend[there]) < 1e-7 * np.abs(slope[there])) else None

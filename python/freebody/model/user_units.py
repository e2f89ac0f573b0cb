"""The units in which a person reads figures: numbers are in SI everywhere, and become others only here, as they are shown.

A choice is a list of units and of names of ``PRESETS``, like ``lb-ft, deg``; what it does not name stays in SI. What is data, as ``--json``, is
always in SI.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from typing import NamedTuple

from freebody.symbolic.dimensions import FORCE, LENGTH, Dimension

from .errors import ModelProblem
from .units import quantity
from .units import unit as read

PRESETS = {"SI": "", "lb-ft": "ft, lbf, slug", "lb-in": "in, lbf, slinch", "N-mm": "mm, N, t"}
"""Choices with a name."""
_WORK = {"J": "{}*{}", "W": "{}*{}/s"}
"""What has no unit of its own where forces and lengths have others."""


class Shown(NamedTuple):
    """A unit of SI as it is shown: the text of the other, and how much SI one of it is."""

    unit: str
    size: float = 1.0


@cache
def choice(text: str) -> dict[Dimension, str]:
    """The units of a choice by what they measure. Raises ``ModelProblem``."""
    hint = f"write {', '.join(f'`{name}`' for name in PRESETS)}, or a list like `mm, deg` or `lb-ft, rpm`"
    chosen: dict[Dimension, str] = {}
    words = ",".join(PRESETS.get(part.strip(), part) for part in text.split(","))
    for word in filter(None, map(str.strip, words.split(","))):
        try:
            dimension = read(word).dimension
        except ModelProblem as problem:
            raise ModelProblem(problem.what, hint) from None
        if dimension in chosen:
            raise ModelProblem(f"`{chosen[dimension]}` and `{word}` measure the same", hint)
        chosen[dimension] = word
    return chosen


_chosen: ContextVar[str | None] = ContextVar("units", default=None)


@contextmanager
def units(text: str) -> Iterator[None]:
    """Within, tables and plots are in these units: ``with fb.units("lb-ft"): print(now)``. Raises ``ModelProblem``."""
    choice(text)
    token = _chosen.set(text)
    try:
        yield
    finally:
        _chosen.reset(token)


def prefer(text: str) -> None:
    """The wish of a model file, which counts within ``units("")``."""
    if _chosen.get() == "":
        _chosen.set(text)


def as_asked(*texts: str | None) -> None:
    """The units of quantities that a question names, like ``30 deg``, for what is not chosen within ``units``."""
    for found in filter(None, (quantity(text) for text in texts if text)):
        chosen = _chosen.get() or ""
        if found.unit and found.dimension not in choice(chosen):
            _chosen.set(", ".join(filter(None, (chosen, found.unit))))


def shown(unit: str) -> Shown:
    """How what is in a unit of SI, like ``N*m``, is shown."""
    return _shown(unit, _chosen.get() or "")


@cache
def _shown(unit: str, text: str) -> Shown:
    chosen = choice(text)
    if not unit or not chosen:
        return Shown(unit)
    size, dimension = read(unit)
    if dimension in chosen and "N" not in unit:  # a couple is no energy
        other = chosen[dimension]
    else:
        other = re.sub(r"[^\W\d_²³]+", lambda word: _instead(word[0], chosen), unit)
    return Shown(other, float(read(other).size / size)) if other != unit else Shown(unit)


def _instead(word: str, chosen: dict[Dimension, str]) -> str:
    """What stands for a unit within a product."""
    if (dimension := read(word).dimension) in chosen:
        return chosen[dimension]
    if word in _WORK and (LENGTH in chosen or FORCE in chosen):
        return _WORK[word].format(chosen.get(FORCE, "N"), chosen.get(LENGTH, "m"))
    return word

"""On which side of its start a place is: of distances that the model reads, and of the ends of strings."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np

from freebody.core import Array, CompiledModel, State, quote

_TOUCHING = 1e-9
"""Least square of a distance on the way, relative to that at its ends: below it the distance has been 0."""


def changes_side(core: CompiledModel, squares: Sequence[str], start: Array, state: State) -> bool:
    """Whether one of the ``squares`` of distances would be 0 on the straight way from the coordinates ``start``: then its two points
    would have changed sides, and what is x on the one is −x on the other; or whether one is below 0 at its end."""
    first, half, last = np.array([core.evaluate(squares, state.at(q)) for q in (start, (start + state.q) / 2, state.q)])
    a, b = 2 * (first - 2 * half + last), 4 * half - 3 * first - last  # along a line d² is a parabola, c + b s + a s²
    with np.errstate(all="ignore"):
        size = np.maximum(first, last)
        between = (first > _TOUCHING * size) & (-b > 0) & (-b < 2 * a)  # what begins at 0 leaves it
        return bool(np.any((last < 0) | between & (first - b**2 / (4 * a) < _TOUCHING * size)))


def turns_over(core: CompiledModel, spec: Mapping[str, Any], one: State, other: State) -> bool:
    """Whether a spring or damper points the other way in another state: what is drawn together farther than it is long."""
    return _turn_over(core, _between(spec), one, other)


def strings_turn_over(core: CompiledModel, spec: Mapping[str, Any], one: State, other: State) -> bool:
    """Whether a straight part of a string does: what hangs from a pulley is above it."""
    return _turn_over(core, [(a, b) for (a, _), (b, _) in _straight_parts(spec)], one, other)


def _turn_over(core: CompiledModel, between: Sequence[Sequence[str]], one: State, other: State) -> bool:
    pairs = [(quote(a), quote(b)) for a, b in between]
    texts = [f"{axis}({b}) - {axis}({a})" for a, b in pairs for axis in "xy"]
    spans = [core.evaluate(texts, state).reshape(-1, 2) for state in (one, other)]
    return bool(np.any(np.sum(spans[0] * spans[1], axis=1) < 0))


def _between(spec: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [force["with"]["between"] for force in spec["forces"] if "between" in force["with"]]


def squares(spec: Mapping[str, Any]) -> Iterator[str]:
    """The squares of the distances that springs, dampers, polar coordinates and expressions of a model read, and of the free lengths
    of its strings."""
    pairs = _between(spec) + [joint["with"]["of"] for joint in spec["joints"] if joint["type"] == "polar"]
    yield from (f"distance({quote(a)}, {quote(b)})^2" for a, b in pairs)
    yield from (f"{read}^2" for read in re.findall(r"distance\([^()]*\)", json.dumps(spec, ensure_ascii=False)))
    yield from (f"distance({quote(a)}, {quote(b)})^2 - (({r}) + ({s}))^2" for (a, r), (b, s) in _straight_parts(spec))


def _straight_parts(spec: Mapping[str, Any]) -> Iterator[tuple[tuple[str, Any], tuple[str, Any]]]:
    """The circles between which strings are straight, each by its centre and radius."""
    chains = [(string["ends"][0], *string["over"], string["ends"][1]) for string in spec["strings"]]
    wound = [joint["with"] for joint in spec["joints"] if joint["type"] == "wound_string"]
    chains += [({"tied": ends["from"]}, {"wound": ends["drum"]}) for ends in wound]
    for chain in chains:
        yield from pairwise(map(_circle, chain))


def _circle(item: Mapping[str, Any]) -> tuple[str, Any]:
    """The centre and the radius of what a string ends at or goes over: a point, an eyelet, a pulley or a drum."""
    (place,) = item.values()
    return (place, 0) if isinstance(place, str) else (place["centre"], place["radius"])

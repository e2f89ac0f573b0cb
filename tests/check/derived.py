"""Equations of models of the catalogue as the core derives them, as a person would type them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from freebody.core import SymbolicAnswers
from freebody.equations import text
from freebody.mechanism import Mechanism
from freebody.symbolic.tree import Tree, add, negative, read

MODELS = (
    "19.3.1/model", "19.3.3/polar", "19.3.10/model", "19.3.15/model", "19.3.16/model", "19.3.17/model",
    "19.3.18/model", "19.3.19/model", "19.3.20/model", "19.3.23/model", "19.3.25/model", "19.3.26/model",
    "19.3.28/model", "EX-ARM/relative", "GEN-CHAIN/two_bars", "GEN-FOURBAR/model", "GEN-SLIDER/model", "S19.16/model",
    "S19.17/model", "S19.18/model", "S19.19/model", "S19.20/model", "S19.21/model", "examples/new_gun",
)  # fmt: skip
"""Models without contacts, each of another kind of mechanism."""
_POINTS = 4  # about which moments are taken, for each group
_LONGEST = 260  # characters of an equation that a person types


def equations(mechanism: Mechanism, rng: np.random.Generator) -> list[str]:
    """Equations of the coordinates, Lagrange's, loops, and balances of groups about points and along axes; each once."""
    found = dict.fromkeys(_written(left, right, rng) for left, right in _derived(mechanism, rng))
    return [line for line in found if 3 < len(line) <= _LONGEST and _has_letters(line)]


def numbers(mechanism: Mechanism) -> dict[str, str]:
    """Symbols that the core gives to masses and inertias that are plain numbers in the model, with these numbers."""
    table = _ask(mechanism, []).symbols
    return {name: f"{e['value']!r} {e['unit']}" for name, e in table.items() if e["kind"] == "number" and name != "g"}


def _has_letters(line: str) -> bool:
    return any(sign.isalpha() for sign in line)


def _ask(mechanism: Mechanism, questions: list[dict[str, Any]]) -> SymbolicAnswers:
    state, _ = mechanism.start()
    return mechanism.compile().symbolic_answers(state, questions)


def _derived(mechanism: Mechanism, rng: np.random.Generator) -> Iterator[tuple[Tree, Tree]]:
    metadata = mechanism.compile().metadata
    names = [c["name"] for c in metadata["coordinates"]]
    questions = [{"ask": "coordinate", "name": name} for name in names] + list(_balances(mechanism, metadata, rng))
    *balances, rows, lagrange = _ask(mechanism, [*questions, {"ask": "rows"}, {"ask": "lagrange"}]).answers
    for answer in balances:
        yield read(answer["left"]), add(*(read(part["tree"]) for part in answer["inertia"]))
    for row in rows:
        yield from ((read(row[level]), read({"num": "0"})) for level in ("rate", "acceleration") if row.get(level))
    yield from ((read(e["residual"]), read({"num": "0"})) for e in lagrange["equations"])


def _balances(mechanism: Mechanism, metadata: dict[str, Any], rng: np.random.Generator) -> Iterator[dict[str, Any]]:
    """Moments about random points, and forces along the axes, for each body and for all."""
    state, _ = mechanism.start()
    points = list(mechanism.compile().points(state.p))
    bodies = [b["name"] for b in metadata["bodies"]]
    for group in [[], *([name] for name in bodies if len(bodies) > 1)]:
        for i in rng.permutation(len(points))[:_POINTS]:
            yield {"ask": "equation", "bodies": group, "about": {"point": points[i]}}
        yield from ({"ask": "equation", "bodies": group, "along": axis} for axis in ("x", "y", {"body": bodies[0]}))


def _written(left: Tree, right: Tree, rng: np.random.Generator) -> str:
    """In one of the ways in which programs print it, with all terms on one side or on two."""
    ascii = bool(rng.random() < 0.5)
    if rng.random() < 0.3:
        left, right = add(left, negative(right)), read({"num": "0"})
    return f"{text(left, ascii=ascii)} = {text(right, ascii=ascii)}"

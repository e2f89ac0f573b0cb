"""Models in which a coordinate stays where it is: a block that is held, a crank that is locked."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.names import spell
from freebody.run.records import quote

from .hypotheses import free_parameter

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .api import Checker, Declared

_STILL = r"(?:is\s+)?(?:(?:held|kept)(?:\s+(?:still|fixed|fast|in place|at rest))?|locked|clamped)|(?:does\s+not|can\s?not|could\s+not)\s+move"
_HELD = re.compile(
    rf"(?:(.*),)?\s*(?:the\s+)?((?!while|once|until|during|as\b|so\b)[^,]+?)\s+(?:{_STILL})(?:\s+at\s+([^,]+))?\s*(?:,(.*))?"
)
_MOVED = 1e-9  # of the sizes of the model: what a coordinate moves less it does not move


def held(checker: Checker, declared: Declared, what: str, place: str) -> Checker | None:
    """The same of the model in which what ``what`` names, a coordinate, a body or a point, stays where it starts, or a coordinate at a ``place``;
    None where it names none, or all that moves."""
    sampler = checker.sampler
    names = _coordinates(checker, declared, what)
    if not names or len(names) == len(sampler.names) or (place and len(names) > 1):
        return None
    laws = {}
    for name in names:
        is_number = re.fullmatch(r"-?[\d.e-]+", place) is not None
        laws[name] = place + _unit(checker, name) * is_number if place else _at_start(checker, name)
    return _with_laws(checker, laws)


def without_others(checker: Checker, name: str) -> Checker | None:
    """The same of the model in which nothing but one coordinate moves; None where the others have to do with how that one does."""
    sampler = checker.sampler
    n, k = len(sampler.names), sampler.names.index(name)
    slopes = sampler.core.derivatives([f"accel({quote(name)})"], sampler.own)[0, 1 : 1 + 2 * n]
    parts = np.abs(slopes) * np.concatenate([sampler.sizes, sampler.rate * sampler.sizes])
    if sampler.loops or np.delete(parts, [k, k + n]).max() > _MOVED * parts.max() or _shares_inertia(checker, k):
        return None
    return _with_laws(checker, {other: _at_start(checker, other) for other in sampler.names if other != name})


def _with_laws(checker: Checker, laws: Mapping[str, str]) -> Checker:
    """The same of the model in which coordinates follow laws of time."""

    def hold(mechanism: Builder) -> None:
        for name, law in laws.items():
            _hold(mechanism, name, law)

    return checker.of_model(("held", *laws.items()), hold)


def _at_start(checker: Checker, coordinate: str) -> str:
    """Where a coordinate is at the start, as a law."""
    q = checker.sampler.own.q[checker.sampler.names.index(coordinate)]
    return repr(float(q)) + _unit(checker, coordinate)


def _shares_inertia(checker: Checker, k: int) -> bool:
    """Whether the kinetic energy has a product of a coordinate's rate with others."""
    sampler = checker.sampler
    moved = np.diag(sampler.sizes)
    energy = lambda u: float(sampler.core.evaluate(["kinetic()"], replace(sampler.own, u=u))[0])
    own, most = energy(moved[k]), max(map(energy, moved))
    return any(abs(energy(moved[k] + u) - own - energy(u)) > _MOVED * most for i, u in enumerate(moved) if i != k)


def _unit(checker: Checker, coordinate: str) -> str:
    """The unit of a coordinate, to stand behind a number."""
    is_angle = {each["name"]: each["dimension"] == "rad" for each in checker.sampler.coordinates}
    return " rad" if is_angle[coordinate] else " m"


def with_held(checker: Checker, declared: Declared, condition: str) -> tuple[Checker, str, str] | None:
    """The same of the model in which what a condition says to be held is so, what else it says, and how that is read; None where it says of
    nothing that it is held."""
    if (found := _HELD.fullmatch(condition)) is None:
        return None
    if found[3] and free_parameter(found[2], checker, declared):  # of what moves it
        given = f"{found[2]} = {found[3]}"
        return checker, ", ".join(filter(None, (found[1], given, found[4]))), f"`{found[2]} held` is read as: {given}."
    if (there := held(checker, declared, found[2], found[3] or "")) is None:
        return None
    return there, ", ".join(filter(None, (found[1], found[4]))), f"`{found[2]} held` is read as: it does not move."


def _hold(mechanism: Builder, name: str, law: str) -> None:
    driven = [motion for motion, given in mechanism.model.motions.items() if given.of in (name, spell(name))]
    for motion in driven:
        del mechanism.model.motions[motion]
    mechanism.motion(driven[0] if driven else _free(mechanism, "hold"), spell(name), law)
    start = mechanism.model.initial
    if start is not None:
        start.rates.pop(name, None)
        for given in (start.model_extra or {}, start.guess):
            given.pop(name, None)


def _free(mechanism: Builder, name: str) -> str:
    """A name that no motion has."""
    return name if name not in mechanism.model.motions else _free(mechanism, f"{name}_")


def _coordinates(checker: Checker, declared: Declared, what: str) -> list[str]:
    """The coordinate of a symbol; those that move the mass centre of a body, or turn it, by its name, or move a point."""
    sampler = checker.sampler
    meaning = checker.symbols(declared).spelt(what)
    if meaning is not None and meaning.texts[0] in sampler.names:
        return [meaning.texts[0]]
    bodies = [body["name"] for body in sampler.spec["bodies"] if re.search(rf"\b{re.escape(body['name'])}\b", what)]
    points = [name for name in sampler.core.points(sampler.own.p) if name.rpartition(".")[2] == what]
    if len(bodies) == 1:
        parts = [part.format(quote(bodies[0])) for part in ("x({}.G)", "y({}.G)", "angle({})")]
    elif points and not bodies:
        parts = [f"x({points[0]})", f"y({points[0]})"]
    else:
        return []
    by = sampler.core.derivatives(parts, sampler.own)
    moves = np.abs(by[:, 1 : 1 + len(sampler.names)]).max(axis=0) > _MOVED
    return [name for name, its in zip(sampler.names, moves, strict=True) if its]

"""Models in which a coordinate stays where it is: a block that is held, a crank that is locked."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.names import spell
from freebody.run.records import quote

if TYPE_CHECKING:
    from freebody.model.builder import Builder

    from .api import Checker, Declared

_HELD = re.compile(r"(?:(.*),)?\s*(?:the\s+)?([^,]+?)\s+(?:is\s+)?held(?:\s+still)?(?:\s+at\s+([^,]+))?\s*(?:,(.*))?")
_MOVED = 1e-9  # of the sizes of the model: what a coordinate moves less it does not move


def held(checker: Checker, declared: Declared, what: str, place: str) -> Checker | None:
    """The same of the model in which the coordinate that ``what`` names, itself or by its body, stays at a ``place``, or where it starts; None
    where it names none."""
    name = _coordinate(checker, declared, what)
    if name is None:
        return None
    k = checker.sampler.names.index(name)
    value = place or repr(float(checker.sampler.own.q[k]))
    unit = " rad" if checker.sampler.coordinates[k]["dimension"] == "rad" else " m"
    law = value + unit * (re.fullmatch(r"-?[\d.e-]+", value) is not None)
    return checker.of_model(("held", name, law), lambda mechanism: _hold(mechanism, name, law))


def with_held(checker: Checker, declared: Declared, condition: str) -> tuple[Checker, str, str] | None:
    """The same of the model in which what a condition says to be held is so, what else it says, and how that is read; None where it says of
    nothing that it is held."""
    found = _HELD.fullmatch(condition)
    if found is None or (there := held(checker, declared, found[2], found[3] or "")) is None:
        return None
    return there, ", ".join(filter(None, (found[1], found[4]))), f"`{found[2]} held` is read as: it does not move."


def _hold(mechanism: Builder, name: str, law: str) -> None:
    mechanism.motion(_free(mechanism, "hold"), spell(name), law)
    start = mechanism.model.initial
    if start is not None:
        start.rates.pop(name, None)
        for given in (start.model_extra or {}, start.guess):
            given.pop(name, None)


def _free(mechanism: Builder, name: str) -> str:
    """A name that no motion has."""
    return name if name not in mechanism.model.motions else _free(mechanism, f"{name}_")


def _coordinate(checker: Checker, declared: Declared, what: str) -> str | None:
    """The coordinate of a symbol; the only one that moves the mass centre of a body, or turns it, by its name."""
    sampler = checker.sampler
    meaning = checker.symbols(declared).spelt(what)
    if meaning is not None and meaning.texts[0] in sampler.names:
        return meaning.texts[0]
    bodies = [body["name"] for body in sampler.spec["bodies"] if re.search(rf"\b{re.escape(body['name'])}\b", what)]
    if len(bodies) != 1:
        return None
    body = quote(bodies[0])
    by = sampler.core.derivatives([f"x({body}.G)", f"y({body}.G)", f"angle({body})"], sampler.own)
    moves = np.abs(by[:, 1 : 1 + len(sampler.names)]).max(axis=0) > _MOVED
    return sampler.names[int(np.argmax(moves))] if moves.sum() == 1 else None

"""Further derivations beside the equations of motion, by name. A new one is a file here and an entry in ``TOPICS``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature
from typing import TYPE_CHECKING, Any

from freebody.document.document import Document
from freebody.equations.topics.common import NotHere
from freebody.equations.topics.elimination import elimination
from freebody.equations.topics.frame import frame
from freebody.equations.topics.impact import impact
from freebody.equations.topics.lagrange import lagrange
from freebody.equations.topics.linear import linear
from freebody.equations.topics.moment import moment
from freebody.equations.topics.out_of_plane import out_of_plane
from freebody.equations.topics.particle import particle

if TYPE_CHECKING:
    from freebody.core import State
    from freebody.model.builder import Builder

__all__ = ["TOPICS", "NotHere", "Topic", "topic"]


@dataclass(frozen=True)
class Topic:
    """A derivation: ``make(mechanism, state, **options)`` gives its document; ``doc`` says in a line what it is."""

    make: Callable[..., Document]
    doc: str


TOPICS: Mapping[str, Topic] = {
    "lagrange": Topic(lagrange, "Lagrange's equations, and how each is made of balance equations"),
    "linear": Topic(linear, "small perturbations from an equilibrium: matrices, eigenvalues, stability; options: coordinates"),
    "frame": Topic(frame, "a point through a moving body: transport, relative, Coriolis; options: point, body"),
    "particle": Topic(particle, "a particle along i, j and in polar coordinates; options: body, about"),
    "moment": Topic(moment, "moments about a fixed or moving point, each with its right-hand side; options: about, bodies"),
    "elimination": Topic(elimination, "fewer equations by conserved momenta"),
    "impact": Topic(
        impact,
        "an impact in the run, or of a point at rest: impulses, what is absent and why, momentum, restitution; options: number, of, at, or point, direction, impulse",
    ),
    "out_of_plane": Topic(out_of_plane, "what the plane exerts; options: gravity"),
}
"""By name, as in ``freebody equations MODEL --form NAME``."""


def topic(mechanism: Builder, name: str, state: State | None = None, **options: Any) -> Document:
    """The document of a topic for a mechanism at a state, by default its start. Raises ``ValueError`` for a topic or an option that
    there is not; ``NotHere`` (one of these) where the mechanism has nothing for it."""
    if name not in TOPICS:
        raise ValueError(f"topic {name!r} is unknown; there are {', '.join(TOPICS)}")
    taken = [p for p in signature(TOPICS[name].make).parameters.values() if p.kind in (p.KEYWORD_ONLY, p.VAR_KEYWORD)]
    if not any(p.kind is p.VAR_KEYWORD for p in taken):
        for option in options.keys() - {p.name for p in taken}:
            known = ", ".join(p.name for p in taken) or "none"
            raise ValueError(f"{name} has no option {option!r}; its options: {known}")
    return TOPICS[name].make(mechanism, mechanism.start()[0] if state is None else state, **options)

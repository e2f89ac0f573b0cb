"""Further derivations beside the equations of motion, by name. A new one is a file here and an entry in ``TOPICS``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from inspect import Parameter, getdoc, signature
from typing import TYPE_CHECKING, Any

from freebody.document.document import Document
from freebody.equations.topics.common import Asked, NotHere
from freebody.equations.topics.elimination import elimination
from freebody.equations.topics.frame import frame
from freebody.equations.topics.impact import impact
from freebody.equations.topics.lagrange import lagrange
from freebody.equations.topics.linear import linear
from freebody.equations.topics.mass_centre import mass_centre
from freebody.equations.topics.moment import moment
from freebody.equations.topics.out_of_plane import out_of_plane
from freebody.equations.topics.particle import particle
from freebody.equations.topics.virtual_power import virtual_power

if TYPE_CHECKING:
    from freebody.core import State
    from freebody.model.builder import Builder

__all__ = ["TOPICS", "NotHere", "described", "topic"]

TOPICS: Mapping[str, Callable[..., Document]] = {
    make.__name__: make
    for make in (lagrange, linear, frame, particle, moment, mass_centre, elimination, impact, out_of_plane, virtual_power)
}
"""By name, as in ``freebody equations MODEL --form NAME``: what makes the document of a mechanism at a state. Its keywords are the
options; its docstring says what it derives, then in a second paragraph the options."""


def described(name: str) -> tuple[str, str]:
    """What a topic derives, and its options, in words."""
    what, options, *_ = [" ".join(part.replace("``", "`").split()) for part in (getdoc(TOPICS[name]) or "").split("\n\n")] + [""]
    return what, options.partition(" Raises")[0]


def topic(mechanism: Builder, name: str, state: State | None = None, **options: Any) -> Document:
    """The document of a topic for a mechanism at a state, by default its start. Raises ``ValueError`` for a topic or an option that
    there is not; ``NotHere`` (one of these) where the mechanism has nothing for it."""
    if name not in TOPICS:
        raise ValueError(f"topic {name!r} is unknown; there are {', '.join(TOPICS)}")
    parameters = signature(TOPICS[name]).parameters.values()
    known = [each.name for each in parameters if each.kind is Parameter.KEYWORD_ONLY]
    if (unknown := [*options.keys() - known]) and all(each.kind is not Parameter.VAR_KEYWORD for each in parameters):
        raise ValueError(f"{name} has no option {unknown[0]!r}; its options: {', '.join(known) or 'none'}")
    return TOPICS[name](Asked(mechanism, mechanism.moment()[0] if state is None else state), **options)

"""Virtual power: equations without reactions, in symbols."""

from __future__ import annotations

from freebody.document.document import Document
from freebody.equations.derivation import virtual
from freebody.equations.topics.common import Asked, NotHere, document


def virtual_power(asked: Asked) -> Document:
    """The principle of virtual power: how the coordinates may change with all loops closed, and that the power of inertia is that of loads."""
    subject = asked.subject
    if not subject.coordinates:
        raise NotHere("the mechanism cannot move: no virtual motion is left")
    wanted = len(virtual.virtual_power(subject))
    if not wanted:
        raise NotHere("what is closed leaves no virtual motion")
    return document(subject, "virtual power", virtual.section(subject, wanted))

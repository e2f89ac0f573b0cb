"""What the figures of derivations show, as data: a derivation names a drawing, and ``views`` draws it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from freebody.core import CompiledModel, FreeBodies, State
    from freebody.impact.impacts import Impulsive


class Picture(Protocol):
    """Something drawn when it is asked for."""

    @property
    def description(self) -> str:
        """What is seen, in words."""

    def inline(self) -> str:
        """SVG for a page with others: its identifiers are its own."""

    def save(self, path: Path) -> Path:
        """Writes a file, .svg or .pdf."""


@dataclass(frozen=True)
class ConfigurationDrawing:
    """A mechanism at a state with its coordinates; or, ``each_body``, with those of bodies that are placed each by itself."""

    source: CompiledModel
    state: State
    each_body: bool = False


@dataclass(frozen=True)
class FreeBodyDrawing:
    """What acts on some bodies together at a state, and m a and I α beside it; ``given`` are the loads where they are not its own."""

    source: CompiledModel
    state: State
    bodies: Sequence[str]
    given: FreeBodies | None = None


@dataclass(frozen=True)
class ImpulseDrawing:
    """The impulses on every body during an impact, and the jumps of its momentum."""

    impact: Impulsive


@singledispatch
def drawn(drawing: Any) -> Picture:
    """The picture of a drawing; ``views.figures`` registers how each is drawn."""
    raise TypeError(f"nothing draws {type(drawing).__name__}")

"""What the topics share: subjects, documents, derivatives with respect to time."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from freebody.core import GROUND
from freebody.document.blocks import Block, Heading
from freebody.document.document import Document
from freebody.equations.derivation import preamble
from freebody.equations.derivation.derive import has_decimals, used
from freebody.equations.derivation.sentences import lettered, readable
from freebody.solve.symbolic_state import Arrow, SymbolicState
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.presentation import PATIENCE, presented
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Tree, add, mul, negative

if TYPE_CHECKING:
    from freebody.core import State
    from freebody.model.builder import Builder


_ELSEWHERE = "ask of fewer bodies, or about another point"


class NotHere(ValueError):
    """A topic that a mechanism has nothing for; the sentence says why."""


@dataclass(frozen=True)
class Asked:
    """What a topic is asked of: a mechanism at a state."""

    mechanism: Builder
    state: State

    @cached_property
    def subject(self) -> SymbolicState:
        """The two, to be asked symbolically."""
        return SymbolicState(self.mechanism.source(), self.state)


def document(subject: SymbolicState, title: str, blocks: Sequence[Block], more: Sequence[SymbolEntry] = ()) -> Document:
    """A document with a title and the meaning of its symbols; ``more`` are those that the model does not have."""
    usual, renamed = subject.nomenclature, subject.symbols.taken.renamed
    own = {symbol.name: renamed[symbol.doc] for symbol in more if symbol.doc in renamed}
    first = Heading(subject.titled(title), 1)
    short = [readable(block, _ELSEWHERE) for block in blocks]
    symbols = {**usual, **{symbol.name: symbol for symbol in more}}
    nomenclature = Nomenclature(symbols, usual.renamed | own, decimals=any(map(has_decimals, short)))
    made = (first, *preamble.configuration(subject), *preamble.nomenclature(nomenclature, used(short)), *short)
    return Document(tuple(lettered(block, nomenclature) for block in made), nomenclature)


def own(subject: SymbolicState, kind: str, unit: str, doc: str, *wanted: str) -> SymbolEntry:
    """A symbol of a topic's own: the first of the names that means nothing else in the model, or the last one numbered."""
    name = subject.symbols.taken.give(doc, *map(Name.parse, wanted))
    return SymbolEntry(name.ascii(), kind, unit, doc, name)


def rates(pair: tuple[Tree, Tree], coordinates: Collection[str]) -> tuple[Tree, Tree]:
    """The derivative of a vector along fixed axes."""
    return along_motion(pair[0], coordinates), along_motion(pair[1], coordinates)


def cross(a: tuple[Tree, Tree], b: tuple[Tree, Tree]) -> Tree:
    """The component along k of a × b."""
    return add(mul(a[0], b[1]), negative(mul(a[1], b[0])))


def brief(tree: Tree, nomenclature: Nomenclature) -> Tree:
    """The shortest form found; it takes up to seconds."""
    return presented(tree, nomenclature, patience=PATIENCE)


def spread(tree: Tree) -> Tree:
    """The sum of all products, sin² + cos² being 1, with what they have in common in front."""
    return presented(tree, multiplied_out=True)


def point_of(subject: SymbolicState, name: str) -> str:
    """A named point; that of a body at a hinge, where a hinge has the name. Raises ``ValueError``."""
    if name not in subject.points:
        hinge = next((j for j in subject.source.spec["joints"] if j["name"] == name and j["type"] == "hinge"), None)
        there = [point for point in (hinge["with"]["of"] if hinge else ()) if subject.points.get(point, (GROUND,))[0] != GROUND]
        name = there[0] if there else name
    known(name, subject.points, "point")
    return name


def place_of(subject: SymbolicState, point: str) -> Arrow:
    """The position of a named point."""
    known(point, subject.points, "point")
    return subject.balances([{"ask": "equation", "bodies": [], "about": {"point": point}}])[0].place


def group_of(subject: SymbolicState, bodies: Sequence[str] | str) -> list[str]:
    """Bodies by name, or one of them."""
    group = [bodies] if isinstance(bodies, str) else list(bodies)
    for name in group:
        known(name, subject.free.bodies, "body")
    return group


def known(name: str, names: Collection[str], what: str) -> None:
    """Raises ``ValueError`` for a name that is none of these."""
    if name not in names:
        raise ValueError(f"no {what} is called {name!r}; there are {', '.join(names)}")

r"""Formulas of LaTeX that are too wide for a line, over several: ``m (a + b) - c`` breaks before its signs, within brackets where it must.

Widths are those of Computer Modern, roughly, in em."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

ROOM = 30.0
"""Width of a line of an article with a number beside it."""
INDENT = 1.0
_TOKEN = re.compile(r"\\(?:[a-zA-Z]+|.)|\d+(?:\.\d+)?|.", re.S)
_LETTER, _CAPITAL, _DIGIT, _SCRIPT = 0.52, 0.76, 0.5, 0.7
_WIDTHS = {
    "+": 1.22, "-": 1.22, "=": 1.33, ",": 0.45, "(": 0.39, ")": 0.39, "m": 0.88, "w": 0.72, "l": 0.3, "i": 0.35, "t": 0.36,
    r"\cdot": 0.72, r"\,": 0.17, r"\ ": 0.25, r"\quad": 1.0, r"\sin": 1.5, r"\cos": 1.55, r"\tan": 1.65, r"\ln": 1.1, r"\exp": 1.75,
    r"\bigl": 0.1, r"\bigr": 0.1, r"\Bigl": 0.1, r"\Bigr": 0.1,
}  # fmt: skip
_FRACTIONS = {r"\frac": 1.0, r"\tfrac": _SCRIPT}
_WORDS = (r"\text", r"\mathrm", r"\operatorname")
_OVER = {r"\dot": 0.0, r"\ddot": 0.0, r"\mathbf": 0.05, r"\boldsymbol": 0.05, r"\sqrt": 0.85}
_BAR = 0.24
"""What a fraction takes beyond what stands in it."""


@dataclass(frozen=True)
class _Node:
    """A part that is never broken: its LaTeX, its width, and whether it joins terms, opens or closes a bracket."""

    latex: str
    width: float
    joins: bool = False
    turn: int = 0


def width(math: str) -> float:
    """How wide a formula is on one line."""
    return sum(node.width for node in _nodes(math))


def lines(math: str, room: float = ROOM) -> list[str]:
    """The formula on lines of at most ``room``, as far as it can be broken; those after the first begin with their sign."""
    made: list[list[_Node]] = []
    left = 0.0
    for part in _parts([*_nodes("".join(_unstacked(math, room)))], room - INDENT, 0):
        needed = sum(node.width for node in part)
        if not made or needed > left:
            made.append([])
            left = room - INDENT * (len(made) > 1)
        made[-1] += part
        left -= needed
    shown = ["".join(node.latex for node in line).strip() for line in made]
    # Brackets that grow cannot be broken.
    size = "Big" if r"\frac" in math else "big"
    torn = any(line.count(r"\left") != line.count(r"\right") for line in shown)
    return [re.sub(r"\\(left|right)(?![a-z])", lambda found: rf"\{size}{found[1][0]}", line) for line in shown] if torn else shown


def _unstacked(math: str, room: float) -> Iterator[str]:
    """The formula with fractions that are too wide as what is above times one over what is below: that can be broken."""
    for node in _nodes(math):
        if node.latex.startswith(r"\frac{") and node.width > room:
            above, below = _Reader(node.latex.removeprefix(r"\frac")).arguments()
            yield rf"\frac{{1}}{{{below}}} \left({above}\right)"
        else:
            yield node.latex


def _parts(nodes: list[_Node], room: float, depth: int) -> Iterator[list[_Node]]:
    """What stands between the signs that are in at most ``depth`` brackets; in more where that is too wide."""
    for part in _split(nodes, depth):
        if sum(node.width for node in part) <= room or not any(node.joins for node in part[1:]):
            yield part
        else:
            yield from _parts(part, room, depth + 1)


def _split(nodes: Sequence[_Node], wanted: int) -> Iterator[list[_Node]]:
    depth, part = 0, []
    for node in nodes:
        if part and depth <= wanted and node.joins:
            yield part
            part = []
        depth += node.turn
        part.append(node)
    yield part


def _nodes(math: str) -> Iterator[_Node]:
    reader = _Reader(math)
    before: _Node | None = None
    while node := reader.node():
        if node.joins and (before is None or before.joins or before.turn > 0):
            node = _Node(node.latex, node.width, turn=node.turn)
        if not node.latex.isspace():
            before = node
        yield node


class _Reader:
    """Reads LaTeX from left to right, part by part."""

    def __init__(self, math: str) -> None:
        self._math, self._place = math, 0

    def node(self) -> _Node | None:
        """The next part; None at the end."""
        start = self._place
        token = self._next()
        if not token:
            return None
        if token in (r"\left", r"\right"):
            self._next()
            return self._node(start, 0.5, turn=1 if token == r"\left" else -1)
        if token in "+-":
            return self._node(start, _WIDTHS[token], joins=True)
        return self._node(start, self._width(token), turn=(token in "([") - (token in ")]"))

    def arguments(self) -> tuple[str, str]:
        """The next two."""
        return self._argument(), self._argument()

    def _node(self, start: int, width: float, joins: bool = False, turn: int = 0) -> _Node:
        return _Node(self._math[start : self._place], width, joins, turn)

    def _next(self) -> str:
        found = _TOKEN.match(self._math, self._place)
        self._place = found.end() if found else self._place
        return found[0] if found else ""

    def _argument(self) -> str:
        """What stands in braces, or the next sign."""
        token = self._next()
        while token.isspace():
            token = self._next()
        if token != "{":
            return token
        start, depth = self._place, 1
        while depth and (token := self._next()):
            depth += (token == "{") - (token == "}")
        return self._math[start : self._place - 1]

    def _width(self, token: str) -> float:
        if token in ("_", "^"):
            return _SCRIPT * width(self._argument())
        if token in _FRACTIONS:
            return _FRACTIONS[token] * max(map(width, self.arguments())) + _BAR
        if token in _WORDS:
            return _DIGIT * len(re.sub(r"\\(?=.)", "", self._argument())) + 0.33 * (token == r"\operatorname")
        if token in _OVER:
            return width(self._argument()) + _OVER[token]
        if token in _WIDTHS:
            return _WIDTHS[token]
        if token.isspace() or token in "{}":
            return 0.0
        return _DIGIT * len(token) if token[0].isdecimal() else _CAPITAL if token.isupper() else _LETTER

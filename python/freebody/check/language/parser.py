"""Reads a statement, plain text or LaTeX, one or several lines.

Rules of reading:

- Side by side is times, like ``*``; ``*``, ``/`` and side by side go from left to right, so ``/`` takes the next factor only:
  ``a/b c`` is (a/b)·c, and ``m l/(M+m) (…)`` is (m l/(M+m))·(…).
- ``×`` binds looser than these and ``·`` looser still: ``k·r×m a`` is k·(r×(m a)).
- A function without brackets takes one letter, with a number before it and a ``t`` directly behind it: ``cosθ θ̈`` is
  (cos θ) θ̈, ``sin 2ωt`` is sin(2ωt).
- ``(a, b)`` is a column, ``[a, b; c, d]`` a matrix; brackets without commas only group.
- Lines end at line ends, at ``;`` and ``,`` outside brackets, and at the words *where*, *with*, *and*. A line that starts with
  ``=``, ``+``, ``*``, ``/``, follows an operator, or starts with ``-`` where one of the two has no ``=``, goes on.
- A lone letter on the left that is not known and stands in another line, too, gets its meaning there.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from .alphabet import folded
from .errors import StatementError
from .grammar import CLOSES, RELATIONS, SIGNED, Line
from .nodes import Assignment, Equation, Letter, Node, Program, walk
from .tokens import Names, Token, tokens


def parse(text: str, names: Iterable[str] = ()) -> Program:
    """The lines of a statement. ``names`` are the letters that are known; unknown ones stay as they are written.

    Raises ``StatementError`` where the text cannot be read, with the place.
    """
    known = Names.of(names)
    known = known.also(_assigned(tokens(text, known), known))
    try:
        rows = [Line(row, known, text).line() for row in _lines(tokens(text, known))]
    except StatementError as error:
        raise error.within(text) from None
    if not rows:
        raise StatementError("there is no equation", (0, len(text)), "write one, like `m*a = F`", text)
    return Program(tuple(_meanings(rows, set(names))), text, span=(0, len(text)))


def parse_expression(text: str, names: Iterable[str] = ()) -> Node:
    """An expression without a sign of relation. Raises ``StatementError``."""
    known = Names.of(names)
    row = [t for t in tokens(text, known) if t.kind != "line"]
    try:
        parser = Line(row, known, text)
        found = parser.sum()
        parser.expect("end")
    except StatementError as error:
        raise error.within(text) from None
    return found


def _assigned(row: Sequence[Token], names: Names) -> list[str]:
    """Unknown letters that stand alone on the left of a line."""
    out = []
    for before, token, after in zip([None, *row], row, row[1:], strict=False):
        starts = before is None or before.kind in ("line", ",", ";")
        if starts and token.kind == "letter" and after.kind == "=" and not names.find(folded(token.text)):
            out.append(token.text)
    return out


def _meanings(rows: Sequence[Sequence[Equation]], known: set[str]) -> list[Assignment | Equation]:
    """The lines, those that only give a name as assignments; links of a chain state something."""
    out: list[Assignment | Equation] = []
    given: set[Node] = set()
    for row in rows:
        name = row[0].left
        elsewhere = {n for other in rows if other is not row for line in other for n in walk(line)}
        alone = len(row) == 1 and isinstance(name, Letter) and name.name not in known and row[0].relation == "="
        if alone and name in elsewhere - given and name not in walk(row[0].right):
            given.add(name)
            out.append(Assignment(name, row[0].right, span=row[0].span))
        else:
            out += row
    return out


def _lines(row: Sequence[Token]) -> list[list[Token]]:
    """The tokens of each line, closed by an ``end``."""
    out: list[list[Token]] = [[]]
    depth = 0
    for place, token in enumerate(row, 1):
        depth += (token.kind in CLOSES) - (token.kind in CLOSES.values())
        ends = token.kind == "line" or (token.kind in (",", ";") and depth == 0)
        if ends and depth == 0 and not (token.kind == "line" and _goes_on(out[-1], _next(row, place))):
            out[-1].append(Token("end", "", (token.span[0], token.span[0])))
            out.append([])
        elif token.kind != "line":
            out[-1].append(token)
    return [line for line in out if len(line) > 1]


def _next(row: Sequence[Token], place: int) -> Sequence[Token]:
    """From the first token of the next line that is not empty."""
    return row[next((i for i in range(place, len(row)) if row[i].kind != "line"), len(row)) :]


def _goes_on(line: Sequence[Token], rest: Sequence[Token]) -> bool:
    """Whether the next line belongs to this one: by the signs between them, or a minus where one of the two says nothing alone."""
    if not line or not rest:
        return False
    behind = next((token.kind for token in rest if token.kind in (*RELATIONS, "line", ",", ";")), "end")
    alone = behind in RELATIONS and any(token.kind in RELATIONS for token in line)
    return line[-1].kind in SIGNED or rest[0].kind in ("=", "+", "*", "/", "·", "×") or (rest[0].kind == "-" and not alone)

"""Reads a statement, plain text or LaTeX, one or several lines.

Rules of reading:

- Side by side is times, like ``*``; ``*``, ``/`` and side by side go from left to right, so ``/`` takes the next factor only:
  ``a/b c`` is (a/b)·c, and ``m l/(M+m) (…)`` is (m l/(M+m))·(…).
- ``×`` binds looser than these and ``·`` looser still: ``k·r×m a`` is k·(r×(m a)).
- A function without brackets takes one symbol, with a number before it and a ``t`` behind it: ``cosθ θ̈`` is (cos θ) θ̈,
  ``sin 2ω t`` is sin(2ωt).
- ``(a, b)`` is a column, ``[a, b; c, d]`` a matrix; brackets without commas only group.
- Lines end at line ends, at ``;`` and ``,`` outside brackets, and at the words *where*, *with*, *and*. A line that starts with
  ``=``, ``+``, ``*``, ``/``, follows an operator, or starts with ``-`` where one of the two has no ``=``, goes on.
- A lone symbol on the left that is not known and stands in another line, too, gets its meaning there; so does one on the right
  (``x' = v``) that no line begins with. Its rates follow.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from itertools import dropwhile
from typing import Any

from freebody.symbolic.differentiate import partial, rate
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Fn, Node, Num, Pow, Sym, exchange, substitute, walk

from .grammar import CLOSES, RELATIONS, SIGNED, Line
from .statements import Assignment, Equation, Partial, Program, Rate, written_out
from .tokens import Names, Token, tokens


def parse(
    text: str,
    names: Iterable[str] = (),
    constants: Iterable[str] = (),
    units: bool = False,
    tight: bool = False,
    apart: bool = False,
    no_rates: Iterable[str] = (),
) -> Program:
    """The lines of a statement. ``names`` are the symbols that are known, of which those in ``constants`` do not change with time;
    unknown ones stay as they are written. ``units``: a unit behind a number goes before a symbol of that name; ``tight``: what stands directly behind a
    factor below a stroke is below it, too, 2k/(3m) for ``2k/3m``; ``apart``: letters side by side are no name with an index, m r for ``mr``
    though m_r is known; ``no_rates``: those behind whose sine ``t`` is a factor.

    Raises ``StatementError`` where the text cannot be read, with the place.
    """
    return _parsed(text, tuple(names), frozenset(constants), frozenset(no_rates), units, tight, apart)


@lru_cache(maxsize=64)  # one statement is read several times on the way to its verdict
def _parsed(text: str, own: tuple[str, ...], constants: frozenset[str], no_rates: frozenset[str], *way: bool) -> Program:
    known = _names(own, constants, *way, no_rates)
    try:
        row = tokens(text, known)
        if assigned := _assigned(row, known):
            known = _names((*own, *assigned), constants, *way, no_rates)
            row = tokens(text, known)
        rows = [Line(row, known, text).line() for row in _lines(row)]
        lines = _written_out(_meanings(rows, set(own)), known)
        program = Program((*_rates(lines, known), *lines), text, *way, span=(0, len(text)))
    except StatementError as error:
        raise error.within(text) from None
    except RecursionError:
        raise StatementError("brackets in brackets without end", (0, len(text)), "give parts names of their own", text) from None
    if not rows:
        raise StatementError("there is no equation", (0, len(text)), "write one, like `m*a = F`", text)
    return program


@lru_cache(maxsize=16)
def _names(*of: Any) -> Names:
    """Names, whose spellings are found once."""
    return Names(*of)


def parse_expression(text: str, names: Iterable[str] = (), constants: Iterable[str] = ()) -> Node:
    """An expression without a sign of relation. Raises ``StatementError``."""
    known = Names(tuple(names), frozenset(constants))
    try:
        line = Line([t for t in tokens(text, known) if t.kind != "line"], known, text)
        found = line.sum()
        line.expect("end")
    except StatementError as error:
        raise error.within(text) from None
    return found


def _assigned(row: Sequence[Token], names: Names) -> list[str]:
    """Unknown symbols that stand alone on the left of a line, or on its right; not the rate of one that does."""
    ends = ("line", ",", ";", "end")
    out = []
    for before, token, after in zip([None, *row], row, row[1:], strict=False):
        starts = (before is None or before.kind in ends) and after.kind == "="
        closes = before is not None and before.kind == "=" and after.kind in ends
        if token.kind == "symbol" and (starts or closes) and not names.find(folded(token.text)):
            out.append(token.text)
    return [name for name in out if name.rstrip("'") == name or name.rstrip("'") not in out]


def _meanings(rows: Sequence[Sequence[Equation]], known: set[str]) -> list[Assignment | Equation]:
    """The lines, those that only give a name as assignments; links of a chain state something."""
    out: list[Assignment | Equation] = []
    alone = [side for row in rows for line in row for side in (line.left, line.right) if isinstance(side, Sym)]
    taken = set(known)
    for row in rows:
        others = [n for other in rows if other is not row for line in other for n in walk(line)]
        used = {n.name for n in others if isinstance(n, Sym)}
        begun = {line.left for other in rows if other is not row for line in other}
        found = None if len(row) > 1 or row[0].relation != "=" else _definition(row[0], taken, begun, alone)
        if found is not None and found.name.name in used:
            taken.add(found.name.name)
            out.append(found)
        else:
            out += row
    return out


def _definition(line: Equation, taken: set[str], begun: set[Node], alone: Sequence[Sym]) -> Assignment | None:
    """The line as one that gives a name: to its left side, or, where no other line begins with it, to its right side; also by its square,
    p² = k/m. The rate of a name that stands ``alone`` somewhere is none."""
    for side, other in ((line.left, line.right), (line.right, line.left)):
        name, said = (side, other) if (root := _squared(side)) is None else (root, Fn("sqrt", (other,), span=other.span))
        if not isinstance(name, Sym) or name.name in taken or (side is line.right and side in begun):
            continue
        own = any(isinstance(n, Sym) and n.name == name.name for n in walk(said))
        if not own and not (name.dots and Sym(name.name) in alone):
            return Assignment(name, said, span=line.span)
    return None


def _squared(side: Node) -> Sym | None:
    """The name of which a side is the square; a frequency is said by its square, and judged."""
    match side:
        case Pow(base=Sym(name=name) as base, exponent=Num(value=2.0)) if not name.startswith(("ω", "omega")):
            return base
    return None


def _written_out(lines: list[Assignment | Equation], names: Names) -> list[Assignment | Equation]:
    """The lines with partial derivatives of names that lines give written out."""
    given = written_out(line for line in lines if isinstance(line, Assignment))
    while (found := next((n for line in lines for n in walk(line) if isinstance(n, Partial)), None)) is not None:
        if found.of not in given:
            hint = f"give it in a line: `{found.of.key} = …`"
            raise StatementError(f"what `{found.of.key}` is made of is not said", found.of.span, hint)
        new = partial(given[found.of], found.by)
        lines = [exchange(line, found, new) for line in lines]
    while (rates := [n for line in lines for n in walk(line) if isinstance(n, Rate)]) != []:
        lines = [exchange(line, rates[-1], rate(substitute(rates[-1].of, given), names.constants)) for line in lines]
    return lines


def _rates(lines: Sequence[Assignment | Equation], names: Names) -> list[Assignment]:
    """What the rates are that lines ask for of names that lines give."""
    given = {line.name: line for line in lines if isinstance(line, Assignment)}
    out: list[Assignment] = []
    asked = [n for line in lines for n in walk(line) if isinstance(n, Sym)]
    while asked:
        symbol = asked.pop()
        below = Sym(symbol.name, symbol.dots - 1)
        if symbol in given or not symbol.dots or Sym(symbol.name) not in given:
            continue
        if below not in given:
            asked += [symbol, below]
            continue
        given[symbol] = Assignment(symbol, rate(given[below].expression, names.constants), span=given[below].span)
        out.append(given[symbol])
        asked += [n for n in walk(given[symbol].expression) if isinstance(n, Sym)]
    return out


def _lines(row: Sequence[Token]) -> list[list[Token]]:
    """The tokens of each line, closed by an ``end``."""
    out: list[list[Token]] = [[]]
    depth = 0
    for place, token in enumerate(row, 1):
        depth += (token.kind in CLOSES) - (token.kind in CLOSES.values())
        ends = token.kind == "line" or (token.kind in (",", ";") and depth == 0)
        if (
            ends
            and depth == 0
            and not (token.kind == "line" and _goes_on(out[-1], [*dropwhile(lambda t: t.kind == "line", row[place:])]))
        ):
            out[-1].append(Token("end", "", (token.span[0], token.span[0])))
            out.append([])
        elif token.kind != "line":
            out[-1].append(token)
    return [line for line in out if len(line) > 1]


def _goes_on(line: Sequence[Token], rest: Sequence[Token]) -> bool:
    """Whether the next line belongs to this one: by the signs between them, or a minus where one of the two says nothing alone."""
    if not line or not rest:
        return False
    behind = next((token.kind for token in rest if token.kind in (*RELATIONS, "line", ",", ";")), "end")
    alone = behind in RELATIONS and any(token.kind in RELATIONS for token in line)
    return line[-1].kind in SIGNED or rest[0].kind in ("=", "+", "*", "/", "·", "×") or (rest[0].kind == "-" and not alone)

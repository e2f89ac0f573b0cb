"""Letters of vectors that stand for their sizes: ``v_B = L ω`` says that \\|v_B\\| is \\|L ω\\|."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import replace

from freebody.symbolic.tree import (
    Add,
    Column,
    Cross,
    Dot,
    Fn,
    Matrix,
    Mul,
    Negative,
    Node,
    Pow,
    Quotient,
    Sym,
    exchange,
    is_zero,
    walk,
)

from .statements import Equation, Program

_MARKED = re.compile(r"\\(?:vec|mathbf|boldsymbol|bm|overrightarrow|hat)\b|\u20d7")
_K = Sym("k")


class _Mixed(Exception):
    """A vector stands where a number has to."""


def with_sizes(program: Program, vectors: Collection[str], loose: Collection[str]) -> tuple[Program, list[str]]:
    """The same with the ``loose`` ones of the vectors as their sizes, where it makes sense only so and the text marks no vectors, with the
    names of these; a number before × turns about k."""
    program = _turning(program, vectors)
    if _MARKED.search(program.text) or not loose or not any(_is_mixed(line, vectors) for line in program.equations):
        return program, []
    read: list[str] = []
    lines = []
    for line in program.lines:
        for symbol in [n for n in walk(line) if isinstance(n, Sym) and n.name in loose]:
            read.append(symbol.name)
            line = exchange(line, symbol, Fn("abs", (symbol,), span=symbol.span))
        lines.append(_without_signs(line) if isinstance(line, Equation) else line)
    sized = replace(program, lines=tuple(lines))
    still = any(_is_mixed(line, vectors) for line in sized.equations)
    return (program, []) if still else (sized, list(dict.fromkeys(read)))


def _turning(program: Program, vectors: Collection[str]) -> Program:
    """The same with numbers before × as vectors along k."""
    holds = lambda node: any((isinstance(n, Sym) and n.name in vectors) or isinstance(n, Column | Matrix) for n in walk(node))
    for node in [n for n in walk(program) if isinstance(n, Cross)]:
        if holds(node.right) and not holds(node.left):
            program = exchange(program, node.left, Mul((node.left, _K), span=node.left.span))
    return program


def _without_signs(line: Equation) -> Equation:
    """Both sides by their size, where each is one term and a size stands in one as a factor."""
    sides = (line.left, line.right)
    alone = any(isinstance(f, Fn) and f.name == "abs" for side in sides for f in _factors(side))
    if not alone or any(isinstance(side, Add) for side in sides) or any(map(is_zero, sides)) or line.relation != "=":
        return line
    left, right = (side if isinstance(side, Fn) and side.name == "abs" else Fn("abs", (side,), span=side.span) for side in sides)
    return replace(line, left=left, right=right)


def _factors(side: Node) -> Iterator[Node]:
    """The factors of a term, above a stroke and below."""
    match side:
        case Negative(of=of):
            yield from _factors(of)
        case Mul(factors=factors):
            for factor in factors:
                yield from _factors(factor)
        case Quotient(top=top, bottom=bottom):
            yield from (*_factors(top), *_factors(bottom))
        case _:
            yield side


def _is_mixed(line: Equation, vectors: Collection[str]) -> bool:
    """Whether a vector stands in an equation where a number has to, or beside one."""
    try:
        kinds = {_is_vector(side, vectors) for side in (line.left, line.right) if not is_zero(side)}
        return len(kinds - {None}) > 1
    except _Mixed:
        return True


def _is_vector(node: Node, vectors: Collection[str]) -> bool | None:
    """Whether it is a vector; None for columns, which may be either. Raises ``_Mixed``."""
    inside = lambda part: _is_vector(part, vectors)
    match node:
        case Sym(name=name):
            return name in vectors
        case Negative(of=of):
            return inside(of)
        case Column() | Matrix():
            return None
        case Cross():
            return True
        case Dot(left=left, right=right):
            kinds = [inside(left), inside(right)]
            return _at_most_one(kinds) if False in kinds else False
        case Fn(name="abs"):
            return False
        case Add(terms=parts):
            kinds = {inside(part) for part in parts if not is_zero(part)} - {None}
            return _one_of(kinds)
        case Mul(factors=parts):
            found = [inside(part) for part in parts]
            return _at_most_one(found)
        case Quotient(top=top, bottom=bottom):
            return _at_most_one([inside(top), *([True] if inside(bottom) else [])]) and not inside(bottom)
        case Pow(base=base) if inside(base):
            raise _Mixed
        case Fn(args=arguments) if any(map(inside, arguments)):
            raise _Mixed
    return False


def _one_of(kinds: set[bool | None]) -> bool | None:
    if len(kinds) > 1:
        raise _Mixed
    return next(iter(kinds), None)


def _at_most_one(found: list[bool | None]) -> bool | None:
    if sum(kind is True for kind in found) > 1:
        raise _Mixed
    return None if None in found else any(found)

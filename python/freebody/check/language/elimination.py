"""A writer's own unknowns, such as the tension T₁ of a cord that the model does without: one line of several gives each."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from freebody.symbolic.tree import Add, Mul, Negative, Node, Num, Quotient, Sym, addends, walk

from .statements import Assignment, Equation, Program, symbols_in


@dataclass(frozen=True)
class Elimination(Assignment):
    """A line solved for an unknown of the writer's own, which stands in the others."""


def eliminated(program: Program, unknowns: Iterable[Sym], chains: bool = False) -> Program:
    """The lines, each unknown given by the first line in which it stands once and linearly, and which leaves another line that
    states something of it; those for which there is none stay unknown. With ``chains`` it may also be only what the rest of a chain,
    P = M ω = dE/dt or ω₁/ω₂ = r₂/r₁ = n, is called."""
    lines = list(program.lines)
    for unknown in unknowns:
        holding = [i for i, line in enumerate(lines) if unknown in symbols_in(line)]
        for i in holding if len(holding) > 1 else ():
            line = lines[i]
            if isinstance(line, Equation) and line.relation == "=" and (value := _solved(line, unknown)) is not None:
                lines[i] = Elimination(unknown, value, span=line.span)
                break
        if chains and len(holding) == 1 and _begins_chain(lines, *holding, unknown):
            lines[holding[0]] = Elimination(unknown, lines[holding[0]].right, span=lines[holding[0]].span)
        elif chains and len(holding) == 1 and _ends_chain(lines, *holding, unknown):
            lines[holding[0]] = Elimination(unknown, lines[holding[0]].left, span=lines[holding[0]].span)
    whole = replace(program, lines=tuple(lines))
    return whole if whole.equations else program


def _begins_chain(lines: list[Assignment | Equation], i: int, unknown: Sym) -> bool:
    """Whether a line only says that an unknown is what the next begins with."""
    line, after = lines[i], lines[i + 1] if i + 1 < len(lines) else None
    return isinstance(line, Equation) and line.left == unknown and isinstance(after, Equation) and after.left is line.right


def _ends_chain(lines: list[Assignment | Equation], i: int, unknown: Sym) -> bool:
    """Whether a line only says that an unknown is what the one before ends with: r₂/r₁ = ω₁/ω₂ = n."""
    line, before = lines[i], lines[i - 1] if i else None
    return isinstance(line, Equation) and line.right == unknown and isinstance(before, Equation) and before.right is line.left


def _solved(line: Equation, unknown: Sym) -> Node | None:
    """What a line makes of an unknown that stands in it once, as a factor of one of its terms."""
    terms = [*addends(line.left), *((-sign, term) for sign, term in addends(line.right))]
    held = [(sign, term) for sign, term in terms if unknown in symbols_in(term)]
    if len(held) != 1 or sum(n == unknown for n in walk(held[0][1])) > 1:
        return None
    sign, term = held[0]
    factor = _factor(term, unknown)
    if factor is None:
        return None
    others = [Negative(other) if own * sign > 0 else other for own, other in terms if other is not term]
    return Quotient(Add(tuple(others)) if others else Num(0.0, "0"), factor)


def _factor(term: Node, unknown: Sym) -> Node | None:
    """What an unknown is multiplied by in a term."""
    match term:
        case Sym():
            return Num(1.0, "1")
        case Negative(of=of) if (inner := _factor(of, unknown)) is not None:
            return Negative(inner)
        case Quotient(top=top, bottom=bottom) if unknown in symbols_in(top) and (inner := _factor(top, unknown)) is not None:
            return Quotient(inner, bottom)
        case Mul(factors=factors):
            (inside,) = (factor for factor in factors if unknown in symbols_in(factor))
            inner = _factor(inside, unknown)
            return None if inner is None else Mul((inner, *(factor for factor in factors if factor is not inside)))
    return None

"""Rates of one sense, where what acts depends on it, a drag written c v² resists what moves forward alone, or where one is said to be a root."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import quote
from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, exchange, is_zero, walk

from .language.spelling import spell
from .language.statements import Equation, symbols_in, terms

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

_BOTH = 2  # terms
_SIZE = re.compile(r"speed\(|hypot\(|distance\(")
_DEPENDS = re.compile(r"\b(?:abs|sign)\(")
_RUBBED = re.compile(r"\bsign\(((?:rate|omega|vx|vy)\([^()]*\))\)")
"""What dry friction takes the sense of."""


def one_sense(case: Case, equation: Equation) -> tuple[Family, str] | None:
    """The motions in which the rates that an equation has in a higher power keep the sense that they have at the start, else those of
    which dry friction does, in words; None where nothing depends on one."""
    known = case.meaning
    if not _DEPENDS.search(known.mechanics):
        return None
    powers = (n for n in walk(equation) if isinstance(n, Pow) and isinstance(n.base, Sym) and isinstance(n.exponent, Num))
    rates = [n.base for n in powers if n.exponent.value > 1 and known.vocabulary.is_rate(n.base)]
    logarithms = (n for n in walk(equation) if isinstance(n, Fn) and n.name == "ln")
    rates += [n for each in logarithms for n in each.args if known.vocabulary.is_rate(n)]
    said = {n: known.read_from(n) for n in dict.fromkeys(rates)}
    said = {n: text for n, text in said.items() if f"({text})" in known.mechanics.replace(" ", "")} or said
    return _as_at_start(case, said or {Sym(text): text for text in _RUBBED.findall(known.mechanics)})


def of_root(case: Case, equation: Equation) -> tuple[Family, str] | None:
    """The same of a rate that is said to be a root, θ' = √(…), and of those of which a size is made, v_B = L ω; of the differences of parameters
    of which one is made, r = (m e − M a) …, or that stand below a line, the sign that they have in the model."""
    known, pairs = case.meaning, said_of_each(equation)
    rates = [one for one, other in pairs if isinstance(one, Sym) and one.dots == 1 and is_root(other)]
    sizes = [other for one, other in pairs if isinstance(one, Sym) and any(map(_SIZE.match, known.texts(Sym(one.name))))]
    linear = (n for other in sizes for n in symbols_in(other) if known.vocabulary.is_rate(n))
    moving = {n: known.read_from(n) for n in linear if n not in known.vocabulary.parameters}
    fixed = {*known.vocabulary.parameters}
    below = [n.bottom for n in walk(equation) if isinstance(n, Quotient)]
    differences = [n for each in (*sizes, *below) for n in _sums(each) if n.symbols <= fixed and _has_minus(n)]
    with suppress(StatementError, ModelProblem):
        moving |= {n: known.symbols.expression(spell(n)) for n in differences}
    return _as_at_start(case, {n: known.read_from(n) for n in rates} | moving)


def said_of_each(equation: Equation) -> list[tuple[Node, Node]]:
    """Each side with what it is said to be; of ω − √(…) = 0 each term."""
    sides = [equation.left, equation.right]
    if any(map(is_zero, sides)) and len(found := terms(equation)) == _BOTH:
        sides = [each.of if isinstance(each, Negative) else each for each in found]
    return [(sides[0], sides[1]), (sides[1], sides[0])]


def holds_with_either_root(case: Case, equation: Equation) -> bool:
    """Whether it holds on every motion with one of the two signs of its only root, of which that on the motion from the start is meant."""
    roots = [n for n in walk(equation) if isinstance(n, Fn) and n.name == "sqrt"]
    if len(roots) != 1:
        return False
    one, other = (case.residual(each) for each in (equation, exchange(equation, roots[0], Negative(roots[0]))))
    return replace(one, ratio=np.fmin(np.abs(one.ratio), np.abs(other.ratio))).holds_but_for_few


def _sums(node: Node) -> Iterator[Add]:
    """The sums by which a product or a quotient has its sign."""
    match node:
        case Add():
            yield node
        case Mul(factors=factors):
            yield from (each for factor in factors for each in _sums(factor))
        case Quotient(top=top, bottom=bottom):
            yield from (*_sums(top), *_sums(bottom))
        case Negative(of=of):
            yield from _sums(of)


def _has_minus(whole: Add) -> bool:
    return any(isinstance(term, Negative) for term in whole.terms)


def _as_at_start(case: Case, texts: Mapping[Node, str]) -> tuple[Family, str] | None:
    """The motions in which rates have the sense that they have at the start, in words."""
    if not texts:
        return None
    read, own = case.sampler.core.evaluate, case.sampler.own
    began = dict(zip(texts, read([*texts.values()], own), strict=True))
    for n in (n for n in texts if isinstance(n, Sym) and not began[n] and n.name in case.sampler.names):  # as it is at once
        began[n] = float(read([f"accel({quote(n.name)})"], own)[0])
    words = ", ".join(f"{spell(n)} {'<' if began[n] < 0 else '>'} 0" for n in texts)
    above = tuple(f"-({text})" if began[n] < 0 else text for n, text in texts.items())
    return replace(case.hypothesis, above=(*case.hypothesis.above, *above)), words


def is_root(node: Node) -> bool:
    """Whether a root stands in it as a factor."""
    factors = node.factors if isinstance(node, Mul) else (node.top,) if isinstance(node, Quotient) else (node,)
    return any(isinstance(factor, Fn) and factor.name == "sqrt" for factor in factors)

"""Rates of one sense, where what acts depends on it: a drag written c v² resists what moves forward alone."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from freebody.symbolic.tree import Num, Pow, Sym, walk

from .language.statements import Equation

if TYPE_CHECKING:
    from .case import Case
    from .families import Family

_DEPENDS = re.compile(r"\b(?:abs|sign)\(")


def one_sense(case: Case, equation: Equation) -> tuple[str, Family] | None:
    """The motions in which the rates that an equation has in a higher power keep the sense that they have at the start, in words; None
    where it has none, or nothing depends on it."""
    known = case.meaning
    if not _DEPENDS.search(known.mechanics):
        return None
    powers = (n for n in walk(equation) if isinstance(n, Pow) and isinstance(n.base, Sym) and isinstance(n.exponent, Num))
    rates = dict.fromkeys(n.base for n in powers if n.exponent.value > 1 and known.vocabulary.is_rate(n.base))
    said = {n: known.read_from(n) for n in rates}
    texts = {n: text for n, text in said.items() if f"({text})" in known.mechanics.replace(" ", "")} or said
    if not texts:
        return None
    began = dict(zip(texts, case.sampler.core.evaluate([*texts.values()], case.sampler.own), strict=True))
    words = ", ".join(f"{n.key} {'<' if began[n] < 0 else '>'} 0" for n in texts)
    above = tuple(f"-({text})" if began[n] < 0 else text for n, text in texts.items())
    return words, replace(case.hypothesis, above=(*case.hypothesis.above, *above))

"""Statements with one slip of a student, made in their text, so that the rest stays as it was written."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from freebody.check.figures import says_a_figure
from freebody.check.language.statements import Equation, symbols_in
from freebody.check.vocabulary import Vocabulary
from freebody.symbolic.dimensions import LENGTH
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, children, walk

WEIGHTS = {
    "sign": 4.0,
    "factor": 4.0,
    "missing term": 4.0,
    "function": 2.0,
    "letter": 2.0,
    "lost factor": 1.5,
    "exponent": 1.0,
    "twice": 1.0,
    "arm": 1.0,
    "derivative": 1.0,
    "other body": 2.0,
    "square": 1.0,
}
"""How often each slip is made, beside the others: as students make them."""
_NUMBERS = {
    "1/2": ("", "1/3", "1/4"),
    "1/3": ("1/2", "1/12", ""),
    "1/12": ("1/3", "1/2"),
    "1/4": ("1/2", ""),
    "3/2": ("1/2", ""),
    "3/4": ("1/2", "1/4"),
    "1/6": ("1/2", "1/24", "1/3"),
    "1/24": ("1/6", "1/12"),
    "2/5": ("1/2", "2/3"),
    "7/10": ("1/2",),
    "2": ("", "4"),
    "3": ("", "2"),
    "4": ("2",),
    "6": ("3", "12"),
}
"""What is written for a number by mistake."""


@dataclass(frozen=True)
class _Text:
    """An equation and its text, in which every part knows its place."""

    text: str
    equation: Equation
    vocabulary: Vocabulary

    def put(self, node: Node, new: str) -> str:
        return self.at(*node.span, new)

    def at(self, begin: int, end: int, new: str) -> str:
        return self.text[:begin] + new + self.text[end:]

    def said(self, node: Node) -> str:
        return self.text[slice(*node.span)]

    def parts(self) -> list[Node]:
        """All parts that stand in the text."""
        return [n for n in walk(self.equation) if n.span[1] > n.span[0]]

    def sign_before(self, term: Node) -> int | None:
        """Where the sign before a term is."""
        if isinstance(term, Negative):
            return term.span[0]
        before = self.text[: term.span[0]].rstrip(" ({\\,")
        return len(before) - 1 if before.endswith(("+", "−", "-")) else None


def slipped(rng: np.random.Generator, text: str, equation: Equation, vocabulary: Vocabulary) -> Iterator[tuple[str, str]]:
    """The text with one slip and its kind, the likely ones first by chance; each kind once."""
    written, left = _Text(text, equation, vocabulary), dict(WEIGHTS)
    while left:
        kinds = list(left)
        kind = kinds[int(rng.choice(len(kinds), p=np.array([*left.values()]) / sum(left.values())))]
        del left[kind]
        made = [new for new in dict.fromkeys(_SLIPS[kind](written)) if new != text]
        if made:
            yield kind, made[int(rng.integers(len(made)))]


def _signs(of: _Text) -> Iterator[str]:
    for whole in (n for n in of.parts() if isinstance(n, Add)):
        for term in whole.terms[1:] if _starts_plainly(whole) else whole.terms:
            place = of.sign_before(term)
            if place is not None:
                yield of.at(place, place + 1, "−" if of.text[place] == "+" else "+")
    for side in (of.equation.left, of.equation.right):
        if isinstance(side, Negative) and side.span[1]:
            yield of.at(side.span[0], side.span[0] + 1, "")
        elif isinstance(side, Mul | Quotient | Sym) and side is of.equation.right and side.span[1]:
            yield of.at(side.span[0], side.span[0], "−")


def _starts_plainly(whole: Add) -> bool:
    """Whether the first term of a sum has no sign of its own."""
    return not isinstance(whole.terms[0], Negative)


def _factors(of: _Text) -> Iterator[str]:
    exponents = [n.exponent for n in walk(of.equation) if isinstance(n, Pow)]
    inside = [part for n in of.parts() if _is_fraction(n) for part in children(n)]
    for node in of.parts():
        if any(node is each for each in (*exponents, *inside)) or of.said(node) in "⁰¹²³⁴⁵":
            continue
        value = _figure(node)
        below = of.text[: node.span[0]].rstrip(" ({").endswith(("/", "frac", "}", "sqrt"))
        for new in _NUMBERS.get(value, ()) if value else ():
            if below and not new:
                continue  # nothing would be left there
            yield of.at(node.span[0], node.span[1], f"({new})") if new else _cut(of, node)
        if isinstance(node, Mul) and not any(isinstance(n, Num) for factor in node.factors for n in (factor, *children(factor))):
            place = node.span[0] - isinstance(node.factors[0], Add)
            yield from (of.at(place, place, f"{new} ") for new in ("1/2", "2"))


def _is_fraction(node: Node) -> bool:
    return isinstance(node, Quotient) and isinstance(node.top, Num) and isinstance(node.bottom, Num)


def _figure(node: Node) -> str:
    match node:
        case Quotient(top=Num(value=above), bottom=Num(value=below)):
            return f"{above:g}/{below:g}"
        case Num(value=value, text=text) if "." not in text:
            return f"{value:g}"
    return ""


def _cut(of: _Text, node: Node) -> str:
    """Without a factor, and the sign of multiplication behind it."""
    behind = re.match(r"\s*[*·]?\s*", of.text[node.span[1] :])
    return of.at(node.span[0], node.span[1] + (behind.end() if behind else 0), "")


def _functions(of: _Text) -> Iterator[str]:
    other = {"sin": "cos", "cos": "sin"}
    for node in of.parts():
        if isinstance(node, Fn) and node.name in other:
            yield of.put(node, of.said(node).replace(node.name, other[node.name], 1))


def _letters(of: _Text) -> Iterator[str]:
    for node in of.parts():
        if isinstance(node, Sym) and not says_a_figure(of.equation):
            for other in of.vocabulary.alike(node):
                if of.said(node).startswith(node.name) and other not in symbols_in(of.equation):
                    yield of.at(node.span[0], node.span[0] + len(node.name), other.name)


def _exponents(of: _Text) -> Iterator[str]:
    for node in of.parts():
        if isinstance(node, Pow) and of.said(node).startswith(of.said(node.base)) and node.base.span[1]:
            end = node.base.span[1]
            yield of.at(end, node.span[1], "") if of.text[end : end + 1] != ")" else ""


def _missing(of: _Text) -> Iterator[str]:
    for whole in (n for n in of.parts() if isinstance(n, Add)):
        for i, term in enumerate(whole.terms):
            if not term.span[1] or of.said(term).count("(") != of.said(term).count(")"):
                continue
            place = of.sign_before(term)
            if i and place is not None:
                yield of.at(place, term.span[1], "")
            elif not i and (len(whole.terms) > 2 or not isinstance(whole.terms[1], Negative)):
                behind = re.match(r"\s*\+?\s*", of.text[term.span[1] :])
                yield of.at(term.span[0], term.span[1] + (behind.end() if behind else 0), "")


def _twice(of: _Text) -> Iterator[str]:
    for side in (of.equation.left, of.equation.right):
        for term in side.terms if isinstance(side, Add) else ():
            if any(n.name == "g" for n in symbols_in(term)):
                bare = term.of if isinstance(term, Negative) else term
                yield of.at(term.span[1], term.span[1], f" {'−' if isinstance(term, Negative) else '+'} {of.said(bare)}")


def _arms(of: _Text) -> Iterator[str]:
    for node in of.parts():
        if isinstance(node, Sym) and of.vocabulary.parameters.get(node) == LENGTH:
            yield of.put(node, f"({of.said(node)}/2)")


def _derivatives(of: _Text) -> Iterator[str]:
    for node in of.parts():
        if isinstance(node, Sym) and of.said(node).endswith("''"):
            yield of.put(node, of.said(node)[:-1])
        elif isinstance(node, Sym) and node.dots == 2 and of.text[: node.span[0]].rstrip("{ ").endswith(r"\ddot"):
            place = of.text.rindex(r"\ddot", 0, node.span[0])
            yield of.at(place, place + 5, r"\dot")
        elif isinstance(node, Sym) and node.dots == 1 and of.said(node).endswith("'"):
            yield of.put(node, of.said(node) + "'")
        elif isinstance(node, Sym) and "\u0308" in (marked := unicodedata.normalize("NFD", of.said(node))):
            yield of.put(node, unicodedata.normalize("NFC", marked.replace("\u0308", "\u0307")))


def _lost_factors(of: _Text) -> Iterator[str]:
    for node in (n for n in of.parts() if isinstance(n, Mul)):
        for factor in node.factors:
            if isinstance(factor, Sym) and factor in of.vocabulary.parameters and factor.span[1]:
                yield _cut(of, factor)


def _other_bodies(of: _Text) -> Iterator[str]:
    """The mass, length or rate of another body, of which the equation speaks, too."""
    for node in of.parts():
        if isinstance(node, Sym) and of.said(node) == node.name and not says_a_figure(of.equation):
            there = [other for other in of.vocabulary.alike(node) if other in symbols_in(of.equation)]
            yield from (of.put(node, other.name) for other in there)


def _squares(of: _Text) -> Iterator[str]:
    """A length or a rate squared that is not."""
    bases = [n.base for n in walk(of.equation) if isinstance(n, Pow)]
    for node in of.parts():
        if isinstance(node, Sym) and (of.vocabulary.parameters.get(node) == LENGTH or node.dots == 1):
            yield from () if any(node is base for base in bases) else (of.at(node.span[1], node.span[1], "^2"),)


_SLIPS = {
    "sign": _signs,
    "factor": _factors,
    "missing term": _missing,
    "function": _functions,
    "letter": _letters,
    "lost factor": _lost_factors,
    "exponent": _exponents,
    "twice": _twice,
    "arm": _arms,
    "derivative": _derivatives,
    "other body": _other_bodies,
    "square": _squares,
}

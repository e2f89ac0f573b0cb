"""What a statement is made of before it is read: words, formulas, and the signs that part clauses."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass

from freebody.symbolic.alphabet import LATEX_WORDS

from .language.tokens import CALLS

_LONG = 4  # letters from which on what stands behind an operator is a word, and no name
_SHORT = re.compile(r"a[nst]|b[ey]|do|he|i[fnst]|no|o[fnr]|so|to|up|we", re.I)
"""Words of two letters, which are no symbols where they stand among others."""
_COMMON = re.compile(
    r"all|and|are|as|at|bar|by|end|for|from|has|is|it|its|just|let|not|of|off|on|one|out|rod|so|than|that|the|then|this|two|us|was|way|we|when|with",
    re.I,
)
"""Words that are words, though letters of them may be symbols."""
_NO_WORDS = {*CALLS, "const", "inf", "infinity", "lim", "min", "max", "deg", "rad", "rpm"}
_WORD = re.compile(r"(?:\A|(?<=[\s,;:(]))[A-Za-z]+(?:-[a-z]+)*(?:(?<=[a-z]{3})['’]s?)?(?=[\s,;:)]|\Z)")
RATE = re.compile(r"d{0,2}dot\Z|['’]+\Z")
"""Of the name of a rate, as programs have it or with primes."""
_FIGURE = re.compile(r"(?<![^\W\d])(?<![_^])[\d.]+\Z")
"""A number, behind which a unit may stand."""
_OPERATORS = "=+*/^·<>≤≥≈→"
_SKIP = re.compile(r"\\[A-Za-z]+|\\.")
RELATION = re.compile(r"=|[<>≤≥≈→]|\\(?:leq?|geq?|approx|to|rightarrow|lt|gt)(?![A-Za-z])")
_ARROW = re.compile(r"\A(?:→|\\rightarrow)(?=\s*(?:[A-Za-z]{2}|\Z))|(?:→|\\(?:to|rightarrow))\Z")
"""A direction that is counted as positive."""


@dataclass(frozen=True)
class Piece:
    """Words, a formula, or a sign that parts clauses; ``relation``: whether a formula says that something is equal or tends to something."""

    kind: str
    start: int
    stop: int
    relation: bool = False


def pieces_of(text: str, known: Collection[str]) -> Iterator[Piece]:
    """Words, formulas, and the signs that part clauses, in their order."""
    at, depth, start, relation = 0, 0, 0, False

    def formula(stop: int) -> Iterator[Piece]:
        if said := text[start:stop].strip(" ~"):
            yield Piece("formula", start, stop, relation and relates(said))

    while at < len(text):
        char, stop = text[at], at + 1
        if depth == 0 and (word := _WORD.match(text, at)) and _is_word(word[0], text[:at].rstrip(), text[word.end() :], known):
            yield from formula(at)
            yield Piece("words", at, word.end())
            start, relation, stop = word.end(), False, word.end()
        elif depth == 0 and char in ",;:" and text[at : at + 2] != ":=":
            yield from formula(at)
            yield Piece(char, at, stop)
            start, relation = stop, False
        elif found := _SKIP.match(text, at):
            relation |= depth == 0 and RELATION.match(found[0]) is not None
            stop = found.end()
        else:
            depth += (char in "([{") - (char in ")]}" and depth > 0)
            relation |= depth == 0 and RELATION.match(char) is not None
        at = stop
    yield from formula(len(text))


def _is_word(word: str, before: str, after: str, known: Collection[str]) -> bool:
    """Whether letters in a row between others are a word, and no symbol, function or unit."""
    if len(word) == 1:
        return word in "aA" and word not in known and re.match(r"\s+[a-z]{3}", after) is not None
    if _COMMON.fullmatch(word) and word not in known:
        return before[-1:] not in [*_OPERATORS]
    measures = (_FIGURE.search(before) is not None and len(word) <= _LONG) or (
        before[-1:] in [*_OPERATORS] and (len(word) < _LONG or word.startswith("const"))
    )
    if word in known or word.lower() in _NO_WORDS or measures or {*word.split("-")} <= {*known}:
        return False
    if len(word) < 3:
        return _SHORT.fullmatch(word) is not None
    named = RATE.sub("", word) in {*known, *LATEX_WORDS}
    return re.search("[aeiouyAEIOUY]", word) is not None and not named and not {*word} <= {*known, "'", "’"}


def relates(clause: str) -> bool:
    """Whether a clause says that something is equal, or tends to something."""
    return RELATION.search(_ARROW.sub("", clause.strip())) is not None

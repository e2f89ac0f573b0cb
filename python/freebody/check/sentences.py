"""Whole sentences around equations, as a worked solution has them: what they claim, and the conditions that they name. ``While the crate does
not slip, it gets its acceleration from friction alone, so that F = m a.``"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from itertools import pairwise

from freebody.symbolic.symbols import folded

from .pieces import RELATION, pieces_of, relates
from .sentence_words import (
    ADJACENT,
    AMBIGUOUS,
    CONDITIONAL,
    CONJUNCTION,
    DETERMINERS,
    FOLLOWED,
    IS,
    LEADS,
    NAMED_VALUES,
    PREMISES,
    PREPOSITIONS,
    PRONOUNS,
    VANISHES,
    VERBS,
    plain_words,
)

_EDGE, _HENCE = "\x1f", "\x1e"  # of a formula that is set apart; before what follows
_APART = re.compile(rf"(?<![=<>+*/-])\s*{_EDGE}\s*(?![=<>])")
"""Between formulas that are set apart; one that goes on behind a sign is the same."""
_SET_APART = re.compile(r"\$+|\\[\[\]()]")
_TEXT = re.compile(r"\\(?:text|textrm|textit|mbox)\s*\{([^{}]*)\}(?![_^'])|\\(?:mathrm|mathit)\s*\{([^{}]*[a-z]{2} [^{}]*)\}")
_BLANK = re.compile(r"\\(?:(?:q?quad|textstyle|displaystyle)(?![A-Za-z])|[,;:!> ])")
_IMPLIES = re.compile(
    r"⇒|⟹|⟺|⇔|∴|=>|\\(?:Rightarrow|Longrightarrow|implies|therefore|iff|Leftrightarrow)(?![A-Za-z])|(?:→|\\to\b)(?!\s*(?:∞|\\infty|inf|0\b))(?=(?:[^→=,;:()]|\([^()]*\))*=)"
)
MUCH_LESS = re.compile(r"([^\s,;:()=]+)\s*(?:≪|<<|\\ll(?![a-z]))\s*1(?![\d.])")
_ENDS = re.compile(rf"(?<=[\w)}}²³'′″%{_EDGE}])\s*[.?!]\s+(?=[A-Z\\({_EDGE}])|;\s+|\n+")
"""Where a sentence ends."""
_LAST = re.compile(r"\s*[.!]\s*\Z")
_ONE = r"\\?[^\W\d][\w{}\\]*['′″\u0307\u0308¨˙]*"
_NUMBER = r"[-−+]?\s*(?:[\d.]+\s*(?:°|deg)?|\d*\s*(?:π|\\pi)(?:\s*/\s*\d)?|\d+⁺?)"
_VALUE = re.compile(
    rf"(?:{_ONE}|{_NUMBER})(?:\s*=\s*[-−+]?\s*(?:{_ONE}|{_NUMBER}))+[+⁺]?|[^=<>]{{1,20}}[<>]\s*[^=<>]{{1,8}}|[^=]{{1,8}}(?:→|->|\\to\b).*|.*(?:≈|\\approx).*"
)
"""``θ = θ_0``, ``x' > 0``, ``c → 0``: what says where, and seldom what is claimed."""
_DOTTED = re.compile(r"\\d+ot\s*\{?\s*(\\?\w+)\s*\}?")
_GLYPHS = re.compile(r"[{}]|\\(?:[dt]?frac|cdot|left|right)(?![a-z])")
_FUNCTIONS = ("sin", "cos", "tan", "sqrt", "pi", "deg")
_LABELLED = re.compile(r"[^=<>:.;]*:(?![^.;]*[.;]\s+[A-Z])")
_BOTH_SIDES = re.compile(r"\((?:just )?(?:after|before)\)")
"""``l φ' (after) = v (before)``: of two moments."""
_OF_PERIOD = re.compile(r"\A\s*(?:T|τ|\\tau)?\s*=\s*")
_SUM = re.compile(r"\s*(?:\\[Ss]um|\\Sigma|[Σ∑])[^=]*=\s*0\s*\Z")
"""``ΣM_O = 0``, a law from which another follows."""
_SAME = re.compile(r"(?:that is|namely|or|viz)?")
"""Words before a relation that says the words before it once more."""


@dataclass
class Sentence:
    """What sentences claim, the relations that they name as conditions, words that say when, and other words, which may do so;
    ``labelled``: whether all conditions stand before a colon; ``follows``: whether something is said to follow."""

    claims: list[str] = field(default_factory=list)
    conditions: list[str] = field(default_factory=list)
    when: list[str] = field(default_factory=list)
    beside: list[str] = field(default_factory=list)
    labelled: bool = False
    follows: bool = False


class _Role(IntEnum):
    """What words before a relation make of it."""

    CLAIM = 0
    EITHER = 1
    CONDITION = 2
    PREMISE = 3


@dataclass(frozen=True)
class _Relation:
    """One that is written in a clause: its ``role`` by the words before it; ``aside``: in brackets; ``again``: the words that say when, of
    which it is a second way to say that; ``leads``: behind a sign of what follows; ``joined`` to the one before; ``colons`` before it."""

    text: str
    role: _Role
    aside: bool
    again: str
    leads: bool
    joined: bool
    colons: int

    @property
    def is_value(self) -> bool:
        return _VALUE.fullmatch(_DOTTED.sub(r"\1'", self.text)) is not None


def sentence(text: str, known: Collection[str], fixed: Collection[str] = ()) -> Sentence | None:
    """What sentences around equations say; None where they claim nothing. Names that are ``known`` are no words; a relation between those
    that are ``fixed``, from which something follows, is a condition."""
    if _BOTH_SIDES.search(text):
        return None
    parser = _Parser(known)
    for part in _ENDS.split(_plain(text)):
        for clause, aside in _asides(_LAST.sub("", part), known):
            parser.read(clause, aside)
    relations, said = parser.in_question(), parser.said
    said.labelled, said.follows = _LABELLED.match(text) is not None, _IMPLIES.search(text) is not None
    claims = _claimed(relations, fixed)
    for i, relation in enumerate(relations):
        (said.claims if i in claims else said.conditions).append(relation.text)
        if i not in claims and relation.again in said.when:  # the relation says it better
            said.when.remove(relation.again)
            said.beside.append(relation.again)
    return said if said.claims else None


def _claimed(relations: Sequence[_Relation], fixed: Collection[str]) -> list[int]:
    """Which of some relations are claimed: those that nothing makes a condition; else the last that might be one."""
    outer = [i for i, relation in enumerate(relations) if not relation.aside and relation.role < _Role.CONDITION]
    outer = [i for i in outer if not is_of(relations[i].text, fixed)] or outer
    ways = (
        [i for i in outer if not (relations[i].role or (relations[i].is_value and not relations[i].leads))],
        [i for i in outer if not relations[i].is_value][-1:],
        [i for i in outer if not relations[i].role][-1:],
        [*range(len(relations))][-1:],
    )
    found = next(filter(None, ways), [])
    pairs = [i - 1 for i in found if relations[i].joined and i - 1 in outer and not relations[i - 1].role]
    return sorted({*found, *pairs})


def is_of(text: str, names: Collection[str]) -> bool:
    """Whether a relation is between some names alone, and no rates of them."""
    said = [folded(word) for word in re.findall(r"\\?[^\W\d]\w*", _GLYPHS.sub("", text))]
    return "'" not in text and bool(names) and {*said} <= {*map(folded, names), *_FUNCTIONS}


# -- sentences and clauses


def _plain(text: str) -> str:
    """Sentences with marks where formulas are set apart; a consequence ends a sentence, too."""
    said = _SET_APART.sub(f" {_EDGE} ", _TEXT.sub(lambda found: f" {_EDGE} {found[1] or found[2] or ''} {_EDGE} ", text))
    return plain_words(MUCH_LESS.sub(r"small \1", _IMPLIES.sub(f" ; {_HENCE} ", _BLANK.sub(" ", said))))


def _asides(text: str, known: Collection[str]) -> Iterator[tuple[str, bool]]:
    """A sentence without what stands in brackets and is no factor, and each of these: ``no damping (c = 0)``."""
    begins, depth, kept, inner = 0, 0, "", []
    for i, char in enumerate(text):
        begins = i if char in "([" and depth == 0 else begins
        closes = char in ")]" and depth == 1
        depth += (char in "([") - (char in ")]" and depth > 0)
        if closes:
            said = text[begins + 1 : i]
            apart = relates(said) or any(piece.kind == "words" for piece in pieces_of(said, known))
            inner += [said] if apart else []
            kept += "" if apart else text[begins : i + 1]
        elif depth == 0:
            kept += char
    yield kept + (text[begins:] if depth else ""), False
    yield from ((said, True) for said in inner)


class _Parser:
    """Takes sentences apart, clause by clause: what they say in words goes to ``said``, what they write to ``relations``."""

    def __init__(self, known: Collection[str]) -> None:
        self.known, self.said, self.relations, self.colons = known, Sentence(), list[_Relation](), 0

    def in_question(self) -> list[_Relation]:
        """The relations that may be claimed or conditions: those in a label are conditions; premises only where there are no others."""
        last = max((relation.colons for relation in self.relations), default=0)
        every = [replace(each, role=max(each.role, _Role.CONDITION)) if each.colons < last else each for each in self.relations]
        return [each for each in every if each.role < _Role.PREMISE] or every

    def read(self, text: str, aside: bool) -> None:
        """Takes a sentence, or what stands in brackets, ``aside``, apart."""
        words: list[str] = []
        before: list[str] = []  # the words of the clause before
        label = False
        for kind, written in self._parts(text):
            if kind == "word":
                words.append(written)
                continue
            if kind == "relation":
                self._write(written, words, before, aside, label)
                before, label = [], False
            else:
                self._end(words, aside)
                label |= written == ":"
                self.colons += written == ":"
                before = (words or before) if written == "," else []
            words = []
        self._end(words, aside)

    def _parts(self, text: str) -> Iterator[tuple[str, str]]:
        """The parts of a sentence, each a relation, a sign that parts clauses, or a word or symbol."""
        last = ""
        for piece in pieces_of(text, self.known):
            written = text[piece.start : piece.stop]
            if piece.kind in ",;:":
                yield "sign", written
            elif piece.kind == "words":
                last = written if written not in IS else last
                yield "word", written
            else:
                for each in filter(None, (part.strip(" .~") for part in _APART.split(written))):
                    said = _OF_PERIOD.sub("", each)
                    if last in NAMED_VALUES and (said != each or not relates(each)):  # the period is 2 π √(m/k)
                        yield "relation", f"{last} = {said}"
                        continue
                    is_law = any(map(RELATION.match, (each[:1], each[-1:])))  # lost energy = gained energy
                    yield ("relation" if relates(each) and not is_law else "word"), each

    def _write(self, text: str, words: Sequence[str], before: Sequence[str], aside: bool, label: bool) -> None:
        """Puts a relation behind ``words`` to the others; ``before``: those of the clause before; ``label``: directly behind a colon."""
        role, again = _role(words), ""
        if _SAME.fullmatch(" ".join(words).lower()) and _is_conditional(before):
            role = max(role, _Role.EITHER) if words or _VALUE.fullmatch(text) else role
            again = self.said.when[-1] if self.said.when else ""
        role = _Role.PREMISE if _SUM.match(text) else role
        leads = not role and (words[-1:] == [_HENCE] if words else label)
        self.relations.append(_Relation(text, role, aside, again, leads, words == ["and"], self.colons))
        self._take([word for word in words if word != _HENCE], drops=role > _Role.CLAIM)

    def _end(self, words: Sequence[str], aside: bool) -> None:
        """Ends a clause in words, which may say that something vanishes: ``l φ' + s' is zero``."""
        for i in range(1, len(words)):
            if VANISHES.fullmatch(" ".join(words[i:])) and re.search(r"[^A-Za-z-]", words[i - 1]):
                role = _role(words[: i - 1])
                self.relations.append(_Relation(f"{words[i - 1]} = 0", role, aside, "", False, False, self.colons))
                break
        self._take(words)

    def _take(self, words: Sequence[str], drops: bool = False) -> None:
        """Puts the words of a clause to those that say when, or to the others; ``drops`` the condition at its end, which a relation says."""
        clause, at = " ".join(words), 0
        begins = [*CONJUNCTION.finditer(clause)]
        for found, following in zip(begins, [*(each.start() for each in begins[1:]), len(clause)], strict=False):
            if found.start() < at:
                continue
            self.said.beside += _apart(clause[at : found.start()].strip())
            at = found.start() + _ends(clause[found.start() : following], found.end() - found.start())
            if (of_what := clause[found.end() : at].strip()) and not of_what.startswith("="):
                condition = clause[found.start() : at].strip()
                (self.said.beside if drops and at == len(clause) else self.said.when).append(condition)
        self.said.beside += _apart(clause[at:].strip())


# -- words


def _is_conditional(words: Sequence[str]) -> bool:
    """Whether a clause says what is so somewhere."""
    return bool(words) and (words[0].lower() in CONDITIONAL or CONJUNCTION.match(" ".join(words)) is not None)


def _role(words: Sequence[str]) -> _Role:
    """What the words directly before a relation make of it."""
    near = [word.lower() for word in words[-ADJACENT:]]
    if not near or near[-1] in VERBS:
        return _Role.CLAIM
    if not PREMISES.isdisjoint(near):
        return _Role.PREMISE
    found = [word for word in near if word in CONDITIONAL]
    if near[-1] in LEADS or not found:
        return _Role.CLAIM
    return _Role.EITHER if found[-1] in AMBIGUOUS else _Role.CONDITION


def _apart(words: str) -> list[str]:
    """Words that say nothing of when, where they begin with a place apart from what goes on: ``On the ramp | the friction points up``."""
    first, space, _ = words.partition(" ")
    ends = _ends(words, len(first)) if space and first.lower() in PREPOSITIONS else len(words)
    return [part for part in (words[:ends].strip(), words[ends:].strip()) if part]


def _ends(clause: str, begins: int) -> int:
    """Where a condition ends that a clause begins with, up to ``begins`` in its first words, and the main clause begins:
    ``just after the impact | the rod pulls with``."""
    found = [*re.finditer(r"\S+", clause[begins:])]
    for before, word in pairwise(found):
        one, last = word[0].lower(), before[0].lower()
        if one in PRONOUNS or (one in DETERMINERS and last not in FOLLOWED | DETERMINERS):
            return begins + (before if last == "only" else word).start()
    return len(clause)

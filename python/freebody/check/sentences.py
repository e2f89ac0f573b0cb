"""Whole sentences around equations, as a worked solution has them: what they claim, and the conditions that they name. ``While the crate does
not slip, it gets its acceleration from friction alone, so that F = m a.``"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace

from freebody.symbolic.symbols import folded

from .pieces import RELATION, pieces_of, relates
from .sentence_words import (
    ADJACENT,
    DETERMINERS,
    DOING,
    FOLLOWED,
    IS,
    LEADS,
    NAMED_VALUES,
    OPENERS,
    PLACE,
    PREMISES,
    PRONOUNS,
    SETS,
    SHORT,
    VANISHES,
    VERBS,
    WEAKLY,
    plain_words,
    says,
)

_EDGE, _HENCE = "\x1f", "\x1e"  # of a formula that is set apart; before what follows
_APART = re.compile(rf"(?<![=<>+*/-])\s*{_EDGE}\s*(?![=<>])")
_SET_APART = re.compile(r"\$+|\\[\[\]()]")
_TEXT = re.compile(r"\\(?:text|textrm|textit|mbox)\s*\{([^{}]*)\}(?![_^'])|\\(?:mathrm|mathit)\s*\{([^{}]*[a-z]{2} [^{}]*)\}")
_BLANK = re.compile(r"\\(?:(?:q?quad|textstyle|displaystyle)(?![A-Za-z])|[,;:!> ])")
_IMPLIES = re.compile(
    r"⇒|⟹|⟺|⇔|∴|=>|\\(?:Rightarrow|Longrightarrow|implies|therefore|iff|Leftrightarrow)(?![A-Za-z])|(?:→|\\to\b)(?=(?:[^→=,;:()]|\([^()]*\))*=)"
)
_SMALL = re.compile(r"([^\s,;:()=]+)\s*(?:≪|<<|\\ll(?![a-z]))\s*1(?![\d.])")
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

    @property
    def says_all(self) -> bool:
        """Whether no other words may say when, in ways that are not understood: ``thrown back``."""
        labels = (words for words in self.beside if len(words.split()) <= SHORT and not says(words))
        return not any(DOING.search(words) for words in labels)


@dataclass(frozen=True)
class _Relation:
    """One that is written in a clause; ``opened``: how surely words make it a condition, ``aside``: in brackets; ``again``: the words that
    it says once more, if it is one; ``leads``: behind words or signs for what follows; ``joined`` to the one before."""

    text: str
    opened: int
    aside: bool = False
    again: str = ""
    leads: bool = False
    joined: bool = False

    @property
    def is_value(self) -> bool:
        return _VALUE.fullmatch(_DOTTED.sub(r"\1'", self.text)) is not None


_NOT, _PERHAPS, _SURELY, _BEFORE = range(4)
_LABEL_ENDS = _Relation(":", _BEFORE)
"""The colon behind which a statement begins: relations before it are conditions."""


def sentence(text: str, known: Collection[str], fixed: Collection[str] = ()) -> Sentence | None:
    """What sentences around equations say; None where they claim nothing. Names that are ``known`` are no words; a relation between those
    that are ``fixed``, from which something follows, is a condition."""
    if _BOTH_SIDES.search(text):
        return None
    said, relations = Sentence(labelled=_LABELLED.match(text) is not None, follows=_IMPLIES.search(text) is not None), []
    for part in _ENDS.split(_plain(text)):
        for clause, aside in _asides(_LAST.sub("", part), known):
            relations += _read(clause, aside, known, said)
    label = max((i for i, relation in enumerate(relations[:-1]) if relation is _LABEL_ENDS), default=0)
    relations = [
        replace(each, opened=_SURELY) if i < label and each.opened < _BEFORE else each for i, each in enumerate(relations)
    ]
    relations = [each for each in relations if each is not _LABEL_ENDS]
    relations = [each for each in relations if each.opened < _BEFORE] or relations
    claims = _claimed(relations, fixed)
    for i, relation in enumerate(relations):
        (said.claims if i in claims else said.conditions).append(relation.text)
        if i not in claims and relation.again in said.when:  # the relation says it better
            said.when.remove(relation.again)
            said.beside.append(relation.again)
    return said if said.claims else None


def _claimed(relations: Sequence[_Relation], fixed: Collection[str]) -> list[int]:
    """Which of some relations are claimed: those that nothing makes a condition; else the last that might be one."""
    outer = [i for i, relation in enumerate(relations) if not relation.aside and relation.opened < _SURELY]
    outer = [i for i in outer if not _is_of(relations[i].text, fixed)] or outer
    ways = (
        [i for i in outer if not (relations[i].opened or (relations[i].is_value and not relations[i].leads))],
        [i for i in outer if not relations[i].is_value][-1:],
        [i for i in outer if not relations[i].opened][-1:],
        [*range(len(relations))][-1:],
    )
    found = next(filter(None, ways), [])
    pairs = [i - 1 for i in found if relations[i].joined and i - 1 in outer and not relations[i - 1].opened]
    return sorted({*found, *pairs})


def _is_of(text: str, names: Collection[str]) -> bool:
    """Whether a relation is between some names alone, and no rates of them."""
    said = [folded(word) for word in re.findall(r"\\?[^\W\d]\w*", _GLYPHS.sub("", text))]
    return "'" not in text and bool(names) and {*said} <= {*map(folded, names), *_FUNCTIONS}


def _plain(text: str) -> str:
    """Sentences with marks where formulas are set apart; a consequence ends a sentence, too."""
    said = _SET_APART.sub(f" {_EDGE} ", _TEXT.sub(lambda found: f" {_EDGE} {found[1] or found[2] or ''} {_EDGE} ", text))
    return plain_words(_SMALL.sub(r"small \1", _IMPLIES.sub(f" ; {_HENCE} ", _BLANK.sub(" ", said))))


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


def _read(text: str, aside: bool, known: Collection[str], said: Sentence) -> Iterator[_Relation]:
    """The relations of a sentence, clause by clause; its words go to what is ``said``."""
    words: list[str] = []
    before: list[str] = []  # the words of the clause before
    label = False
    for kind, written in _parts(text, known):
        if kind == "relation":
            opened, same = _opens(words), _SAME.fullmatch(" ".join(words).lower()) is not None and _sets(before)
            if same and (words or _VALUE.fullmatch(written)):
                opened = max(opened, _PERHAPS)
            again = said.when[-1] if same and said.when else ""
            opened = _BEFORE if _SUM.match(written) else opened
            leads = not opened and (words[-1:] == [_HENCE] if words else label)
            yield _Relation(written, opened, aside, again, leads, words == ["and"])
            _take([word for word in words if word != _HENCE], said, drops=opened > _NOT)
            before, words, label = [], [], False
        elif kind == "sign":
            yield from _vanishing(words, aside)
            _take(words, said)
            if written == ":":
                yield _LABEL_ENDS
                label = True
            before, words = ((words or before) if written == "," else []), []
        else:
            words.append(written)
    yield from _vanishing(words, aside)
    _take(words, said)


def _parts(text: str, known: Collection[str]) -> Iterator[tuple[str, str]]:
    """The parts of a sentence, each a relation, a sign that parts clauses, or a word or symbol."""
    last = ""
    for piece in pieces_of(text, known):
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


def _vanishing(words: Sequence[str], aside: bool) -> Iterator[_Relation]:
    """``l φ' + s' is zero``."""
    for i in range(1, len(words)):
        if VANISHES.fullmatch(" ".join(words[i:])) and re.search(r"[^A-Za-z-]", words[i - 1]):
            yield _Relation(f"{words[i - 1]} = 0", _opens(words[: i - 1]), aside)
            return


def _sets(words: Sequence[str]) -> bool:
    """Whether a clause says what is so somewhere."""
    return bool(words) and (SETS.fullmatch(words[0]) is not None or OPENERS.match(" ".join(words)) is not None)


def _opens(words: Sequence[str]) -> int:
    """How surely words directly before a relation make it a condition."""
    near = words[-ADJACENT:]
    if near and VERBS.fullmatch(near[-1]):
        return _NOT
    if any(map(PREMISES.fullmatch, near)):
        return _BEFORE
    if not near or (LEADS.fullmatch(near[-1]) and not SETS.fullmatch(near[-1])):
        return _NOT
    found = [word for word in near if SETS.fullmatch(word)]
    return _NOT if not found else _PERHAPS if WEAKLY.fullmatch(found[-1]) else _SURELY


def _take(words: Sequence[str], said: Sentence, drops: bool = False) -> None:
    """Puts the words of a clause to those that say when, or to the others; ``drops`` the condition at its end, which a relation says."""
    clause = " ".join(words)
    at = 0
    openers = [*OPENERS.finditer(clause)]
    for i, found in enumerate(openers):
        if found.start() < at:
            continue
        said.beside += _apart(clause[at : found.start()].strip())
        following = openers[i + 1].start() if i + 1 < len(openers) else len(clause)
        at = found.start() + _ends(clause[found.start() : following], found.end() - found.start())
        condition = clause[found.start() : at].strip()
        if len(condition) > found.end() - found.start() and not condition[found.end() - found.start() :].lstrip().startswith("="):
            (said.beside if drops and at == len(clause) else said.when).append(condition)
    said.beside += _apart(clause[at:].strip())


def _apart(words: str) -> list[str]:
    """Words that say nothing of when, where they begin with a place apart from what goes on: ``On the ramp | the friction points up``."""
    place = PLACE.match(words)
    ends = _ends(words, place.end()) if place else len(words)
    return [part for part in (words[:ends].strip(), words[ends:].strip()) if part]


def _ends(clause: str, opener: int) -> int:
    """Where a condition ends that a clause begins with, and the main clause begins, ``just after the impact | the rod pulls with``."""
    found = [*re.finditer(r"\S+", clause[opener:])]
    for i, word in enumerate(found[1:], 1):
        one, before = word[0].lower(), found[i - 1][0].lower()
        goes_on = FOLLOWED.fullmatch(before) or before in DETERMINERS
        if one in PRONOUNS or (one in DETERMINERS and not goes_on):
            return opener + word.start()
    return len(clause)

"""The verdict about an equation within sentences, under the conditions that these name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice, product
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded

from .clause_words import reworded
from .clauses import CLAIM
from .language.statements import symbols_in
from .later import AT_FIRST
from .phases import alike, kind_of
from .pieces import relates
from .sentence_words import AWAY, CIRCUMSTANCES, DETERMINERS, FOLLOWED, FROM_REST, FROM_START, SHORT, SMALL, says
from .sentences import Sentence, sentence
from .verdict import EVERY_TERM_IS_0, NO_AMPLITUDE, NOTHING_LEFT, Kind, Verdict
from .wording import BLOW, DOING

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .stated import Correction

_MOST = 16  # readings that are tried
_NOTHING = 1e-12  # of a unit, below which a side is 0 but for round-off
LIKELY = 2.0
"""Size of a correction by which a statement is wrong, whatever some words ask."""
_LONG = 4  # letters of a word that may name what happens
_EMPTY = re.compile(r"\s*if\s*:")
_SOMEWHERE = re.compile(
    r"\b(?:about|around)\b(?! (?:the |its )?(?:(?:static )?equilibrium|(?:place|position) of (?:rest|equilibrium)|rest|level))"
)
"""Small motions about some other place."""
_NAME = re.compile(r"\\?[^\W\d]\w*")
_CHAIN = re.compile(r"([^=<>→]+(?:=[^=<>→]+)+)=([^=<>→]+)")
_FIGURE = re.compile(r"[-−+]?[\d.]+\s*(?:°|deg)?")
_LARGEST = re.compile(r"\s*([^\s=]+?)\s*=\s*\1_?\{?\s*\\?(?:text|mathrm)?\{?(max|min)\}*\s*")
_ABOUT_ONE = re.compile(
    r"\\?sin\s*\(?\s*(\\?[^\W\d]\w*)\)?\s*(?:[≈→=]|\\approx|\\to)\s*\1|\\?cos\s*\(?\s*(\\?[^\W\d]\w*)\)?\s*(?:[≈→=]|\\approx|\\to)\s*1"
)
"""``sin θ ≈ θ``, ``cos θ → 1``."""


def as_said(checker: Checker, text: str, letters: Declared | None, correcting: bool) -> Verdict:
    """The verdict about a text as it stands; where it is not true so, but as sentences say it, that. Raises ``StatementError``."""
    said = _spoken(checker, text, letters)
    if said is None:
        return _of_something(checker.check(text, letters, correcting=correcting), text)
    judging, asked = copy(checker), copy(checker)
    judging.correcting, asked.correcting = False, correcting and checker.correcting
    try:
        verdict = judging.check(text, letters)
    except StatementError as error:
        if "did you mean" not in error.hint and (found := _in_sentences(asked, text, said, letters, None)):
            return found
        raise
    if verdict.kind is Kind.UNDECIDABLE and verdict.reason.startswith((NOTHING_LEFT, NO_AMPLITUDE)):
        return verdict
    if verdict.ok and not (said.follows and _is_empty(verdict)):
        return _of_something(verdict, text)
    found = _in_sentences(asked, text, said, letters, verdict)
    return found or (asked.check(text, letters) if asked.correcting else verdict)


def _of_something(verdict: Verdict, text: str) -> Verdict:
    """A verdict; not decidable where nothing is left of a statement under the condition that it gives: ``v = 0: ½ m v² = m g s``."""
    if _is_empty(verdict) and relates(text.rpartition(":")[0]):
        return replace(verdict, kind=Kind.UNDECIDABLE, reason=f"{verdict.reason}: under that condition nothing is left of it")
    return verdict


def _is_empty(verdict: Verdict) -> bool:
    """Whether nothing is left of what is true."""
    return verdict.ok and bool(verdict.untested) and verdict.reason.startswith(EVERY_TERM_IS_0)


def _spoken(checker: Checker, text: str, letters: Declared | None) -> Sentence | None:
    """What sentences say; None where a text is none, or a claim in words of its own."""
    if CLAIM.match(text) or _EMPTY.match(text):
        return None
    known = {*checker.mechanism.parameters, *checker.sampler.names, *checker.declared, *(letters or ())}
    said = sentence(text, known, {*checker.mechanism.parameters, *checker.sampler.names})
    in_words = said and (said.when or said.beside or said.follows or (said.labelled and said.conditions))
    return said if in_words else None


def _in_sentences(
    checker: Checker, text: str, said: Sentence, letters: Declared | None, before: Verdict | None
) -> Verdict | None:
    """The verdict about what sentences claim, in the first way in which that is true; where it is in none, and the text could not be read,
    so that there is no verdict ``before``, in the first way in which it can be read, else the likelier corrected one of both. None where
    they say no more than the text did."""
    fails = before is None or before.kind is Kind.UNDECIDABLE or before.ok
    elsewhere = any(_SOMEWHERE.search(words) and SMALL in says(words) for words in (*said.when, *said.beside))
    if elsewhere or not (fails or says_all(said)):
        return None
    judging = copy(checker)
    judging.correcting = False
    first: tuple[Verdict, _Reading] | None = None
    for reading in islice(_Readings.of(judging, said, letters).all(fails, before is None), _MOST):
        if first and first[1].is_whole and not reading.is_whole and said.when:  # they are understood
            break
        with suppress(StatementError):
            found = _judged(judging, reading, said.claims, letters)
            told = f"It is read as: {reading.before(', '.join(said.claims))}."
            found = replace(found, text=text.strip(), notes=(*found.notes, told))
            at_first = not said.when and any(note.startswith(AT_FIRST) for note in found.notes)
            if found.ok and not (found.untested or at_first or _says_nothing(found, said.claims)):
                return found
            if not found.ok and (first is None or first[0].kind is Kind.UNDECIDABLE):
                first = found, reading
    if first is None or (before and fails and not (first[1].condition and first[0].kind is Kind.WRONG)):
        return None
    return _wrong(checker, said, letters, *first) if fails else _corrected(checker, text, said, letters, before, *first)


def says_all(said: Sentence) -> bool:
    """Whether no words beside those that say when may do so, too, in ways that are not understood: ``thrown back``."""
    labels = (words for words in said.beside if len(words.split()) <= SHORT and not (says(words) or kind_of(words)))
    return not any(DOING.search(words) or AWAY.search(words) for words in labels)


def _corrected(
    checker: Checker, text: str, said: Sentence, letters: Declared | None, before: Verdict, found: Verdict, reading: _Reading
) -> Verdict | None:
    """The verdict in a reading of all words, with its corrections, where they are likely, and none of the text as it stands is; that first
    where something that is said is 0 as it stands."""
    if not (checker.correcting and reading.is_whole and found.kind is Kind.WRONG):
        return None
    ways = [
        lambda: checker.check(text, letters),
        lambda: replace(found, mends=_judged(checker, reading, said.claims, letters).mends),
    ]
    first, second = reversed(ways) if before.is_idle and not found.is_idle else ways
    one = first()
    if one.kind is not Kind.WRONG or _is_likely(one.mends) or not (checker.whole or checker.budget).lasts():
        return one
    other = second()
    return other if _is_likely(other.mends) else one


def _is_likely(mends: Sequence[Correction]) -> bool:
    return bool(mends) and mends[0].size <= LIKELY


def _wrong(checker: Checker, said: Sentence, letters: Declared | None, found: Verdict, reading: _Reading) -> Verdict | None:
    """What is not true in one reading, with its corrections; None where not all of that is understood, and none of them is likely."""
    if found.kind is not Kind.WRONG or not (checker.correcting or not reading.is_whole):
        return found if reading.is_whole else None
    correcting = copy(checker)
    correcting.correcting = True
    mends = _judged(correcting, reading, said.claims, letters).mends
    nothing = any(mend.equation.endswith("= 0") for mend in mends[:1]) and not any(claim.endswith("0") for claim in said.claims)
    if not (reading.is_whole or (_is_likely(mends) and not nothing)):  # where nothing moves it may not be meant
        return None
    return replace(found, mends=mends if checker.correcting else ())


def _judged(checker: Checker, reading: _Reading, claims: Sequence[str], letters: Declared | None) -> Verdict:
    """The verdict about all claims in one reading: the first that is not true, else the last."""
    for claim in claims:
        found = checker.check(reading.before(claim), letters)
        if not found.ok:
            break
    return found


def _says_nothing(found: Verdict, claims: Sequence[str]) -> bool:
    """Whether all that it is of is 0 there, though it does not say so."""
    zero = any(re.search(r"=\s*0\s*\Z", claim) for claim in claims)
    return not zero and found.evidence is not None and np.allclose([found.evidence.left, found.evidence.right], 0, atol=_NOTHING)


@dataclass(frozen=True)
class _Reading:
    """A condition in the words of claims; ``is_whole``: whether all that is said to be one is in it."""

    condition: str
    is_whole: bool

    def before(self, claim: str) -> str:
        return f"{self.condition}: {claim}" if self.condition else claim


@dataclass(frozen=True)
class _Readings:
    """Ways to read the conditions of a sentence: ``names`` are the coordinates, ``claimed`` those of which something is claimed, ``jumps``
    whether that is of velocities alone, as what a blow does, ``happens`` what switches."""

    said: Sentence
    names: Sequence[str]
    claimed: Sequence[str]
    jumps: bool
    happens: Sequence[str]

    @classmethod
    def of(cls, checker: Checker, said: Sentence, letters: Declared | None) -> _Readings:
        """Those of what is said of a model."""
        names = [*checker.sampler.names]
        claimed = [name for name in names if any(_mentions(claim, name) for claim in said.claims)]
        lasts = any("const" in claim for claim in said.claims)  # where nothing moves all stays the same
        happens = [] if lasts else [event["name"] for event in checker.sampler.spec["events"]]
        return cls(said, names, claimed, all(_jumps(checker, claim, letters) for claim in said.claims), happens)

    def all(self, fails: bool, unread: bool) -> Iterator[_Reading]:
        """All of them, the likelier ones first. Where a text does not ``fail`` to be judged without them, only those that say more; where it is
        ``unread``, also those in which not all words that say when are taken for that."""
        surely, perhaps = self._surely(), self._perhaps()
        whole = [self._ways(words) for words in self.said.when]
        for chosen in product(*whole, *surely):
            if fails or chosen or self.said.conditions:
                yield self._reading(chosen, self._is_clear)
        for more in perhaps:
            yield from (self._reading((more, *chosen), False) for chosen in product(*whole, *surely))
        if not unread or not whole or self.said.labelled:
            return
        starts = [self._starts(words) for words in self.said.when]
        yield from (self._reading(chosen, False) for chosen in product(*starts, *surely))
        for extra in ((), *((more,) for more in perhaps)):
            yield from (self._reading((*extra, *chosen), False) for chosen in product(*surely))

    def _reading(self, chosen: Sequence[str], is_whole: bool) -> _Reading:
        given = (each for condition in self.said.conditions for each in _plainly(condition))
        return _Reading(_joined([*chosen, *given]), is_whole)

    # -- words that may say when without a conjunction

    @cached_property
    def _asked(self) -> list[str]:
        """Those that are short or begin as a circumstance does, and are no label by their form."""
        likely = (words for words in self.said.beside if len(words.split()) <= SHORT or _first(words) in CIRCUMSTANCES)
        return [words for words in likely if not _is_label(words)]

    @cached_property
    def _states(self) -> list[str]:
        """Those that are read as they stand: ``rolling``, ``on the ramp``."""
        asked = [words for words in self._asked if kind_of(words) and not self._found(words)]
        return [*asked, *filter(_is_label, self.said.beside)]

    @property
    def _is_clear(self) -> bool:
        """Whether all that begins as a circumstance does is understood."""
        open_ones = (words for words in self._asked if _first(words) in CIRCUMSTANCES)
        return all(self._found(words) or words in self._states for words in open_ones)

    def _surely(self) -> list[list[str]]:
        """For each of these that is a condition the ways to read it."""
        found = [self._found(words) for words in self._asked]
        return [*filter(None, found), *([re.sub(r"\A[A-Z]", lambda first: first[0].lower(), words)] for words in self._states)]

    def _perhaps(self) -> list[str]:
        """What other words may say."""
        others = [condition for words in self.said.beside if words not in self._asked for condition in self._found(words)]
        return [*dict.fromkeys([*others, *(each for words in self.said.beside for each in self._named(words))])]

    # -- what words say

    def _ways(self, words: str) -> list[str]:
        """Ways to read words that say when: what is found in them, and they themselves."""
        first, *others = words.split()
        found = [] if _is_label(words) else self._found(words)
        found.append(" ".join([first.lower(), *others]))
        if first.lower() == "after" and self.jumps and re.search(BLOW, words):  # what is so from then on is so just then
            found.append(f"just after {' '.join(others)}")
        return found

    def _starts(self, words: str) -> list[str]:
        """The first of the words that say when, for those behind them may be of the main clause."""
        first, *others = words.split()
        ends = (n for n in range(min(len(others), SHORT) - 1, 0, -1) if others[n].lower() not in FOLLOWED | DETERMINERS)
        return [" ".join([first.lower(), *others[: n + 1]]) for n in ends]

    def _found(self, words: str) -> list[str]:
        """The conditions that words name; small is what they say is so, else what something is claimed of."""
        found = [each for each in says(words) if each != "at rest" or kind_of(words) is None]  # at rest on the deck
        if SMALL not in found:
            return found
        others = [each for each in found if each != SMALL]
        if small := [name for name in self.names if _mentions(words, name)]:
            return [f"for small {', '.join(small)}", *others]
        return [*([f"for small {', '.join(self.claimed)}"] if self.claimed else []), *found]

    def _named(self, words: str) -> Iterator[str]:
        """The stretch behind what happens that a word is alike to, and what is so just after it."""
        for event in self.happens:
            if any(alike(event, word.lower()) for word in words.split() if len(word) >= _LONG and word.isalpha()):
                yield f"after {event}"
                if self.jumps:
                    yield f"just after {event}"


def _is_label(words: str) -> bool:
    """Whether words are read in exercise books' own way, but of what is small."""
    read = reworded(words)
    return read is not None and "small" not in read


def _first(words: str) -> str:
    return words.partition(" ")[0].lower()


def _mentions(text: str, name: str) -> bool:
    return any(folded(word) == folded(name) for word in _NAME.findall(text))


def _jumps(checker: Checker, claim: str, letters: Declared | None) -> bool:
    """Whether a claim is of velocities, and of no forces and accelerations."""
    with suppress(StatementError, ModelProblem):  # of a letter that cannot be read
        case = checker.case(claim, letters)
        known = case.meaning.vocabulary
        used = [n for n in symbols_in(case.program) if n not in known.parameters]
        return any(map(known.is_rate, used)) and not any(map(known.is_load, used))
    return False


def _joined(conditions: Sequence[str]) -> str:
    """Conditions as one."""
    small = [each for each in dict.fromkeys(conditions) if "small" in each][:1]
    others = [each for each in dict.fromkeys(conditions) if "small" not in each]
    if FROM_REST in others:  # what is so at the start
        others = [FROM_REST, *filter(None, (_at_start(each) for each in others if each not in (FROM_REST, FROM_START)))]
    first = ", ".join(others)
    headed = f"if {first}" if re.match("(?!if )[^,]*[=<>→]", first) else first
    return ", ".join(filter(None, (headed, *small)))


def _at_start(condition: str) -> str:
    """A place in letters of the start: ``θ_0 = 90°``."""
    name, equals, value = (part.strip() for part in condition.partition("="))
    if not equals or name.endswith("_0"):
        return condition
    return f"{name}_0 = {value}" if folded(f"{name}_0") != folded(value) else ""


def _plainly(condition: str) -> list[str]:
    """A relation in the words of claims: each of a chain, what is largest, what is small."""
    if found := _LARGEST.fullmatch(condition):
        return [f"at the {'greatest' if found[2] == 'max' else 'least'} {found[1]}"]
    if found := _ABOUT_ONE.fullmatch(condition.strip()):
        return [f"for small {found[1] or found[2]}"]
    if _CHAIN.fullmatch(condition):
        sides = [side.strip() for side in condition.split("=")]
        value = next((side for side in sides if _FIGURE.fullmatch(side)), sides[-1])
        return [f"{side} = {value}" for side in sides if side != value]
    return [condition.replace("·", " ")]

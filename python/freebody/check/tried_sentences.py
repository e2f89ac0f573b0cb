"""The verdict about an equation within sentences, under the conditions that these name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, replace
from itertools import islice, product
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded

from .clause_words import reworded
from .language.statements import symbols_in
from .later import AT_FIRST
from .phases import alike, kind_of
from .sentence_words import DETERMINERS, FOLLOWED, FROM_REST, FROM_START, SHORT, SMALL, WEAK, says
from .sentences import Sentence, sentence
from .verdict import Kind, Verdict
from .wording import BLOW

if TYPE_CHECKING:
    from .api import Checker, Declared

_MOST = 16  # readings that are tried
_NOTHING = 1e-12  # of a unit, below which a side is 0 but for round-off
LIKELY = 2.0
"""Size of a correction by which a statement is wrong, whatever some words ask."""
_LONG = 4  # letters of a word that may name what happens
_CLAIM = re.compile(r"\s*(?:constant|limit|only if|follows|shorter|report|same at|no [^:]* in)\b|\s*if\s*:")
_SOMEWHERE = re.compile(
    r"\b(?:about|around)\b(?! (?:the |its )?(?:(?:static |position of )?equilibrium|(?:place|position) of (?:rest|equilibrium)|rest|level))"
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


def spoken(checker: Checker, text: str, letters: Declared | None) -> Sentence | None:
    """What sentences say; None where a text is none, or a claim in words of its own."""
    if _CLAIM.match(text):
        return None
    known = {*checker.mechanism.parameters, *checker.sampler.names, *checker.declared, *(letters or ())}
    said = sentence(text, known, {*checker.mechanism.parameters, *checker.sampler.names})
    in_words = said and (said.when or said.beside or said.follows or (said.labelled and said.conditions))
    return said if in_words else None


def in_sentences(checker: Checker, text: str, said: Sentence, letters: Declared | None, before: Verdict | None) -> Verdict | None:
    """The verdict about what sentences claim, in the first way in which that is true; where they can be read in none so, in the first that
    can be read, if the text as it stands could not be judged, ``before``: wrong where not all is understood only if a likely correction is
    true. None where they say no more than that."""
    fails = before is None or before.kind is Kind.UNDECIDABLE
    elsewhere = any(_SOMEWHERE.search(words) and SMALL in says(words) for words in (*said.when, *said.beside))
    if elsewhere or not (fails or said.says_all):
        return None
    judging, first = copy(checker), None
    judging.correcting = False
    for read, is_whole in islice(_Readings.of(judging, said, letters).all(fails, before is None), _MOST):
        if first and first[1] and not is_whole and said.when:  # they are understood
            break
        with suppress(StatementError):
            found = _judged(judging, read, said.claims, letters)
            told = f"It is read as: {f'{read}: ' * bool(read)}{', '.join(said.claims)}."
            found = replace(found, text=text.strip(), notes=(*found.notes, told))
            at_first = not said.when and any(note.startswith(AT_FIRST) for note in found.notes)
            if found.ok and not (found.untested or at_first or _says_nothing(found, said.claims)):
                return found
            if not found.ok and (first is None or first[2].kind is Kind.UNDECIDABLE):
                first = read, is_whole, found
    return _wrong(checker, said, letters, *first) if first and before is None else None


def _wrong(
    checker: Checker, said: Sentence, letters: Declared | None, read: str, is_whole: bool, found: Verdict
) -> Verdict | None:
    """What is not true in one reading, with its corrections; None where not all of that is understood, and none of them is likely."""
    if found.kind is not Kind.WRONG or not (checker.correcting or not is_whole):
        return found if is_whole else None
    correcting = copy(checker)
    correcting.correcting = True
    mends = _judged(correcting, read, said.claims, letters).mends
    if not is_whole and not (mends and mends[0].size <= LIKELY):
        return None
    return replace(found, mends=mends if checker.correcting else ())


def _judged(checker: Checker, read: str, claims: Sequence[str], letters: Declared | None) -> Verdict:
    """The verdict about all claims under a condition: the first that is not true, else the last."""
    for claim in claims:
        found = checker.check(f"{read}: {claim}" if read else claim, letters)
        if not found.ok:
            break
    return found


def _says_nothing(found: Verdict, claims: Sequence[str]) -> bool:
    """Whether all that it is of is 0 there, though it does not say so."""
    zero = any(re.search(r"=\s*0\s*\Z", claim) for claim in claims)
    return not zero and found.evidence is not None and np.allclose([found.evidence.left, found.evidence.right], 0, atol=_NOTHING)


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

    def all(self, fails: bool, unread: bool) -> Iterator[tuple[str, bool]]:
        """Conditions in the words of claims, the likelier ones first; each with whether all that is said to be one is in it. Where a text does
        not ``fail`` to be judged without them, only those that say more."""
        given = [each for condition in self.said.conditions for each in _plainly(condition)]
        asked = [words for words in self.said.beside if len(words.split()) <= SHORT or WEAK.match(words)]
        asked = [words for words in asked if not _is_label(words)]
        states = [words for words in asked if kind_of(words) and not self._found(words)]
        states += [words for words in self.said.beside if _is_label(words)]
        ways = [[*self._ways(words)] for words in self.said.when]
        starts = [[*self._starts(words)] for words in self.said.when]
        sure = [
            *(found for words in asked if (found := self._found(words))),
            *([words[0].lower() + words[1:]] for words in states),
        ]
        unclear = any(WEAK.match(words) and not self._found(words) and words not in states for words in asked)
        others = [condition for words in self.said.beside if words not in asked for condition in self._found(words)]
        perhaps = dict.fromkeys([*others, *(each for words in self.said.beside for each in self._named(words))])
        for chosen in product(*ways, *sure):
            if fails or chosen or given:
                yield _joined([*chosen, *given]), not unclear
        for more in perhaps:
            for chosen in product(*ways, *sure):
                yield _joined([more, *chosen, *given]), False
        if not unread or not ways or self.said.labelled:
            return
        for chosen in product(*starts, *sure):
            yield _joined([*chosen, *given]), False
        for extra in [[], *([more] for more in perhaps)]:
            for chosen in product(*sure):
                yield _joined([*extra, *chosen, *given]), False

    def _ways(self, words: str) -> Iterator[str]:
        """Ways to read words that say when: what is found in them, and they themselves."""
        if not _is_label(words):
            yield from self._found(words)
        first, *others = words.split()
        yield " ".join([first.lower(), *others])
        if first.lower() == "after" and self.jumps and re.search(BLOW, words):  # what is so from then on is so just then
            yield f"just after {' '.join(others)}"

    def _starts(self, words: str) -> Iterator[str]:
        """The first of the words that say when, for those behind them may be of the main clause."""
        first, *others = words.split()
        for count in range(min(len(others), SHORT) - 1, 0, -1):
            if not FOLLOWED.fullmatch(last := others[count]) and last not in DETERMINERS:
                yield " ".join([first.lower(), *others[: count + 1]])

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

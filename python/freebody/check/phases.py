"""Stretches and moments of the model's own motion in words: while it slips, once it rolls, when it breaks loose."""

from __future__ import annotations

import re
from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from freebody.core import GROUND

from .wording import LASTS

if TYPE_CHECKING:
    from .api import Checker

_STOPS = r"(?:(?:stop|cease)(?:s|d|ped)?|no longer|(?:does|do) not|without)\s+(?:to\s+)?"
_OVER = r"\s+(?:has\s+|is\s+)?(?:stop|cease|end|over)\w*"
_KINDS = {
    "stick": rf"{_STOPS}(?:slip|slid|skid)\w*|(?:slip|slid|skid)\w*{_OVER}|roll(?:s|ing)?|sticks?|sticking|stuck|grips?",
    "slip": rf"{_STOPS}(?:roll|stick)\w*|(?:roll|stick)\w*{_OVER}|slip(?:s|ping)?|slid(?:es?|ing)|skid(?:s|ding)?|(?:breaks?|tears?|torn)\s+(?:loose|away|free)",
    "taut": "taut|tight|stretched|straight",
    "slack": "slack|loose",
    "touch": "touch(?:es)?|touching|(?:moment|instant|time) of contact|into contact|meets?|strikes?|hits?|collides?|lands?",
    "lift-off": r"leaves?|lifts?\s+off|separates?|loses?\s+(?:contact|touch)",
}
"""What goes on in words; ``touch`` and ``lift-off`` are of a moment."""
_CHANGES = {"touch": ("impact", "contact")}
_STATES = {"stick": "stuck", "slip": "sliding", "taut": "taut", "slack": "slack"}
"""What a contact or a string is in then."""
_BEFORE = {"stick": "sliding", "slip": "stuck"}
"""What a joint with friction was in before its first change."""
_MOMENT = re.compile(
    r"\b(?:moment|instant|(?:begin|start|become|go|get|come|turn)(?:e?s)?\b|(?:breaks?|tears?|torn)\s+(?:loose|away|free))|-off\b|-down\b"
)
_ALL = re.compile(r"\b(?:both|all|they)\b")
_STEM = 3  # letters that words of one meaning begin with


@dataclass(frozen=True)
class Phase:
    """What words say of the model's own motion: a stretch on which something goes on, from the start or from each of the ``changes`` on;
    or the moment of these."""

    at_first: bool
    changes: tuple[str, ...]
    is_moment: bool


def phase(checker: Checker, words: str) -> Phase | None:
    """What words say of the model's own motion; None where that does not have it."""
    said = [(len(found[0]), kind) for kind, of in _KINDS.items() for found in re.finditer(rf"\b(?:{of})\b", words)]
    kind = max(said, key=lambda each: each[0], default=(0, None))[1]  # rolling that ends is slipping
    if kind is None or words.startswith("until"):
        return None
    run, _ = checker.moment("end")
    kinds, lasts = _CHANGES.get(kind, (kind,)), LASTS.match(words) is not None
    found = [(change.t, part, f"{change.kind} {part}") for change in run.changes for part in change.of if change.kind in kinds]
    firsts = {name: (t, part) for t, part, name in reversed(found) if t > run.t[0]}
    limits = checker.sampler.core.instant(checker.sampler.own).limits
    able = {
        name for name in limits if kind not in _STATES or limits[name].state in _STATES.values()
    }  # what has no friction never slides
    meant = _meant(words, {*(part for _, part in firsts.values()), *able} or {*limits}, limits)
    times = {name: t for name, (t, part) in sorted(firsts.items(), key=lambda each: each[1]) if part in meant}
    every = _ALL.search(words) is not None
    times = {name: t for name, t in times.items() if t == max(times.values())} if every else times
    changes = {t: name for name, t in reversed(times.items())}
    states = {limits[name].state for name in meant if name in limits} & {*_STATES.values()}
    began = {part: change.kind for change in reversed(run.changes) for part in change.of if change.kind in _BEFORE}
    states |= {_BEFORE[began[name]] for name in meant if name in began and name not in limits}
    there = states == {_STATES.get(kind)} if every else _STATES.get(kind) in states
    at_first = there or (lasts and not states) if kind in _STATES else lasts
    is_moment = not lasts and (kind not in _STATES or _MOMENT.search(words) is not None)
    return Phase(at_first and not is_moment, tuple(reversed(changes.values())), is_moment) if changes or at_first else None


def _meant(words: str, parts: Collection[str], limits: Any) -> set[str]:
    """Those of several parts that words name, by their own names or those of their bodies; all where they name none."""
    said = re.findall(r"\w+", words)
    bodies = {name: {limits[name].first, limits[name].second} - {GROUND} if name in limits else set() for name in parts}
    ways = (
        {name for name in parts if name in words or bodies[name] & {*said}},
        {name for name in parts if any(alike(each, word) for each in (name, *bodies[name]) for word in said)},
    )
    return next(filter(None, ways), {*parts})


def alike(name: str, word: str) -> bool:
    """Whether two words begin alike: cut and cutting."""
    return len(word) >= _STEM and name.lower().startswith(word.lower()[:_STEM])

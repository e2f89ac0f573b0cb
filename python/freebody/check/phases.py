"""Stretches and moments of the model's own motion in words: while it slips, once it rolls, when it breaks loose."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND, quote
from freebody.model.errors import ModelProblem
from freebody.run.moments import ORDINALS

from .asked_model import does
from .wording import IN_WORDS, LASTS, THINGS

if TYPE_CHECKING:
    from .api import Checker, Declared

_STOPS = r"(?:(?:stop|cease)(?:s|d|ped)?|no(?:t|\s+longer|\s+more)?|(?:does|do) not|without)\s+(?:to\s+)?"
_OVER = r"\s+(?:(?:has\s+|is\s+|have\s+)?(?:stop|cease|end)\w*|(?:is|are)\s+over\b)"
_KINDS = {
    "stick": rf"at\s+rest\s+(?:on|in)\b|(?:(?:end|stop)\s+of\s+(?:the\s+)?|{_STOPS}|neither\s+(?:\w+\s+)?)(?:slip|slid|skid)\w*|(?:slip|slid|skid)\w*{_OVER}"
    r"|roll(?:s|ing)?|rid(?:es?|ing)|sticks?|sticking|stuck|grips?"
    r"|(?:moves?|goes|turns?)\s+with|(?:is|are)\s+carried",
    "slip": rf"{_STOPS}(?:roll|stick|rid)\w*|(?:roll|stick|rid)\w*{_OVER}|slip(?:s|ping)?|slid(?:es?|ing)|skid(?:s|ding)?|rub(?:s|bing)?"
    r"|(?:breaks?|tears?|torn)\s+(?:loose|away|free)",
    "taut": "taut|tight|stretched|straight|jerks?",
    "slack": "slack|loose",
    "touch": rf"touch(?:e[sd])?|touching|(?:moment|instant|time) of contact|in(?:to)? (?:contact|touch)|meets?|strikes?|hits?|reach(?:es|ed)\s+(?:the\s+)?(?:other|spring|buffer|bumper|stop|wall|floor|ground|target|toy|net|anvil|{THINGS})|collides?|knocks?|bumps?|land(?:s|ed|ing)|touch(?:es|ed|ing)? down|touchdown"
    r"|blow|impact|collision|shock|bounce"
    r"|(?:rests?|stands?|sits?|lies|leans?|stays?|is|are)\s+(?:\w+\s+)?(?:on|against)|\A(?:(?:the )?(?:whole )?\w+ )?on (?:(?:the|its|his|her) )?(?!way\b|point\b|(?:left|right)\Z)\w+(?: \w+)?\Z|(?:com)?pressed|engaged|closed|shut|seated"
    r"|(?:do|does|has|have)\s+not\s+(?:yet\s+)?(?:leave|left|lift|los[et]|separate|part)\w*",
    "lift-off": r"leav(?:es?|ing)|(?:is|are|has\s+been)\s+left(?!\s+(?:alone|to|with))|takes?[ -]?off|lifts?(?:\s+off|(?!\s+(?:an?|the)\b))|comes?\s+(?:off|free)|(?:has|have)\s+(?:left|parted|lifted(?:\s+off)?|come\s+(?:off|free))|separate[sd]?|separation|(?:los(?:es?|ing|t))\s+(?:contact|touch)"
    r"|(?:touch(?:es|ing)?|not|no longer)\s+(?:on|nothing|touch(?:ing)?)|flight|hop(?:s|ping)?|fl(?:ies|ying)|in the air|airborne|(?:is|are)\s+off|hang(?:s|ing)?(?!\s+(?:still|at\s+rest))|open(?:s|ed|ing)?|blows\s+off",
    "reversal": r"(?:turn|swing|mov|slid|com|go|roll)(?:e?s|ing|es)?\s+back|(?:on\s+the\s+)?(?:way|swing|stroke)\s+back|(?:back|second)\s+swing|revers\w+|turning\s+point|first\s+(?:comes?\s+to\s+rest|stops?)"
    r"|(?:highest|top)(?:\s+\w+)?\s+of\s+(?:the|its)\s+(?:swing|rise)"
    r"|end\s+of\s+(?:the|its)\s+(?:first\s+)?(?:half[\s-])?(?:swing|stroke)",
    "rest": r"(?:hangs?|stands?|lies|stays?)\s+at\s+rest|(?:comes?|came)\s+to\s+(?:rest|a\s+(?:stop|halt|standstill))|(?:has|have)\s+stopped|stands?\s+still",
    "released": r"breaks?|broken?|cut(?:ting)?|snap(?:s|ped)?|release[sd]?|lets?\s+go|fail(?:s|ed)?|gives?\s+way",
}
"""What goes on in words; ``touch`` and ``lift-off`` are of a moment, unless they last, and ``released`` is of one."""
_CHANGES = {"touch": (("impact", "contact"),), "lift-off": (("lift-off",), ("impact",))}  # what rebounds has left, too
_STATES = {"stick": "stuck", "slip": "sliding", "taut": "taut", "slack": "slack"}
"""What a contact or a string is in then."""
_OF_STRINGS = ("taut", "slack", "off")
_ON = re.compile(r"(?:(?:the\s+)?(?:whole\s+)?\w+\s+)?on (?:(?:the|its|his|her) )?(?:\w+ )?(\w+)\Z")
"""``on the floor:``, ``foot on the ground:``."""
_BEFORE = {"stick": "sliding", "slip": "stuck"}
"""What a joint with friction was in before its first change."""
_TOUCHES = ("impact", "contact")
_MOMENT = re.compile(
    r"\b(?:moment|instant|end of|(?:begin|start|become|go|get|come|turn|end|stop|cease)(?:e?s)?\b(?!\s+with\b)|is over|jerks?|(?:breaks?|tears?|torn)\s+(?:loose|away|free))|-off\b|-down\b"
)
_RESTS_ON = re.compile(r"\bat\s+rest\s+(?:on|in)\b")
_LASTED = re.compile(r"\b(?:has|have|had)\b")
"""``once it has left``: from then on."""
_GOES_ON = re.compile(
    r"\bhang(?:s|ing)?\b|\bin the air\b|\bairborne\b|\bfl(?:ies|ying)\b|\bflight\b|\bhop\b|\b(?:is|are)\s+(?:open|off)\b"
)
"""``once it hangs free``."""
_GROUND = re.compile(r"\b(?:ground|floor|land(?:s|ed|ing)?|touch\w*down|wall|table|ice|road|street|slope|incline)\b")
_TOGETHER = re.compile(r"\b(?:collid\w+|collision|each other|one another|together|both|two)\b")
"""Of what touches ground, and of what touches another body."""
_ONLY = re.compile(r"\bonly\b")
_AGAIN = re.compile(r"\bagain\b")
_ALL = re.compile(r"\b(?:both|all|they)\b")
NOT_FIRST = re.compile(rf"\b(?:{'|'.join(each for each, n in ORDINALS.items() if n > 1)}|last)\b")
"""Of what happens several times."""
_NUMBERED = re.compile(rf"\b({'|'.join(ORDINALS)})\s+([A-Za-z]\w*)")
_IS_ON = re.compile(r"(?<!\bis )(?<!\bare )\bon(?:\s+it)?\Z|\bwith\s+(?:the\s+)?\w+\s+on\b|\b(?:caught|attached|aboard)\b")
_JOINED = re.compile(r"\b(?:coupled|joined|hooked|latched|locked)(?:\s+together)?\b")
"""What bodies are that an event puts together."""
_Change = tuple[float, str, str]
"""When something changes, s, what does, and the name of that change."""
_HOLDS = re.compile(
    r"\b(?:held|stopped|caught|kept|blocked|locked)\s+by\s+(?:the\s+)?(\w+)|\b(\w+)\s+(?:holds|catches|engages|bites|bears|acts|has\s+caught)\b"
)
_DOING = re.compile(r"\b([a-z]{3,}?)(?:ing|e?s)\b")
_FACT = re.compile(
    r"\b(?:impact|blow|collision|shock|contact)s?\s+(?:is|are)\s+(?:[a-z]+\s+)?(?:(?:in)?elastic|plastic|smooth|rough|short|central|oblique)\b"
)
"""``the impact is plastic``, which says how, and not when."""
_MOVES = re.compile(
    r"(?:while|(?P<comes>once|when|after)|as long as)\s+(?:the\s+)?(?P<body>\w+)\s+(?:still\s+)?"
    r"(?:(?P<moves>moves|(?:is\s+)?(?:moving|in\s+motion|under\s+way))|stands(?:\s+still)?|does\s+not\s+move|(?:is|stays)\s+(?:still\s+)?at\s+rest)"
)
_SEEN, _STANDS = 7, 1e-18  # moments of a stretch that are looked at; of the largest energy, below which a body stands
_STEM = 3  # letters that words of one meaning begin with


@dataclass(frozen=True)
class Phase:
    """What words say of the model's own motion: a stretch on which something goes on, from the start or from each of the ``changes`` on;
    or the moment of these. ``is_named``: a part is called by its name, so that no other stretch is meant."""

    at_first: bool
    changes: tuple[str, ...]
    is_moment: bool
    is_named: bool = False


def with_names(words: str, names: Iterable[str]) -> str:
    """Words in which parts that are numbered have their names: the second coupling is ``coupling_2``."""

    def named(found: re.Match[str]) -> str:
        number, noun = ORDINALS[found[1]], re.escape(found[2])
        own = [name for name in names if re.fullmatch(rf"{noun}[ _]?{number}", name, re.IGNORECASE)]
        return own[0] if len(own) == 1 else found[0]

    names = [*names]
    return _NUMBERED.sub(named, words)


def kind_of(words: str) -> str | None:
    """What goes on in words, of the kinds above."""
    said = [(len(found[0]), kind) for kind, of in _KINDS.items() for found in re.finditer(rf"\b(?:{of})\b", words, re.IGNORECASE)]
    return max(said, key=lambda each: each[0], default=(0, None))[1]  # rolling that ends is slipping


def is_moment(words: str, kind: str | None = None) -> bool:
    """Whether words of what goes on are of a moment: what a contact or a string is in lasts, and so does what has happened."""
    lasts = ((kind or kind_of(words)) in _STATES or _GOES_ON.search(words)) and _MOMENT.search(words) is None
    return not (lasts or _LASTED.search(words))


def phase(checker: Checker, words: str) -> Phase | None:
    """What words say of the model's own motion; None where that does not have it."""
    limits = checker.sampler.core.instant(checker.sampler.own).limits
    if _FACT.search(words):
        return None
    words = with_names(words, limits)
    for name in (name for name in checker.symbols().bodies if kind_of(name)):  # the stick is no sticking
        words = re.sub(rf"\b(the|an?|its)\s+{re.escape(name)}\b", r"\1 body", words)
    if moving := _moving(checker, words):
        return moving
    if joins := _joining(checker, words) or checker.happens.freeing(words):
        return Phase(False, (joins,), False)
    if not words.startswith("until") and (held := _held_by(checker, words, limits)):
        return held
    kind, place, rests = kind_of(words), _ON.match(words.lower()), _RESTS_ON.search(words) is not None
    lasts = LASTS.match(words) is not None or place is not None or rests
    if rests and not any(limit.state in _STATES.values() for limit in limits.values()):  # nothing rubs
        kind = "touch"
    touched = {body for limit in limits.values() for body in (limit.first, limit.second)}
    on_body = place and place[1] in checker.symbols().bodies - touched
    if kind is None or words.startswith("until") or on_body or (lasts and kind == "released"):
        return None
    if not limits and kind in _BEFORE and (locking := _locking(checker, kind, lasts, words)):
        return locking
    if kind == "touch" and lasts and place is None and not (checker.sampler.spec["contacts"] or checker.sampler.spec["stops"]):
        return None  # what is on another without a contact is held there
    run, begins = checker.happens.run, checker.happens.begins
    settled = [f"rest {change.of[0]}" for change in run.changes if change.kind == "rest" and change.t > begins]
    if rests and settled:
        return Phase(False, tuple(dict.fromkeys(settled)), False)
    comes = kind == "rest"
    if comes:  # what slides comes to it by sticking
        kind = "stick"
        if not any(change.kind == kind and change.t > begins for change in run.changes):
            return None
    begun = _begun(run, _STATES[kind]) if kind in _BEFORE else []
    firsts = _firsts(run, begins, kind, begun, _AGAIN.search(words) is not None)
    rubs = lambda name: limits[name].state in _STATES.values()  # what has no friction never slides
    able = {name for name in limits if (rubs(name) if kind in _STATES else limits[name].state not in _OF_STRINGS)}
    parts = {*(part for _, part in firsts.values()), *able} or {*limits}
    surfaces = parts & {contact["name"] for contact in checker.sampler.spec["contacts"]} if kind in _CHANGES else set()
    meant = _meant(words, parts, limits, surfaces or parts)
    is_off = any(name in limits and limits[name].state == "open" for name in meant - {part for _, part in firsts.values()})
    lasts = lasts or (kind == "lift-off" and _GOES_ON.search(words) is not None)
    lasts = lasts or (kind == "lift-off" and _LASTED.search(words) is not None and is_off)  # it has left from the start
    if not lasts and not meant & {part for _, part in firsts.values()}:  # what is called so goes on under another name
        meant = parts
    if kind == "touch" and lasts and (alone := _left_alone(run, begins, limits, surfaces - meant)) and _ONLY.search(words):
        return Phase(False, (alone,), False)
    if kind == "touch" and lasts:
        checker.sampler.require_touch(meant)
    times = {name: t for name, (t, part) in sorted(firsts.items(), key=lambda each: each[1]) if part in meant}
    every = _ALL.search(words) is not None
    times = {name: t for name, t in times.items() if t == max(times.values())} if every else times
    changes = {t: name for name, t in reversed(times.items())}
    at_once = {part for change in run.changes if change.t <= begins and change.kind in _TOUCHES for part in change.of}
    states = {name: limits[name].state for name in meant if name in limits}
    if kind in _BEFORE:  # what touches at once rubs or sticks from then on
        states = {name: state for name, state in states.items() if state != "open" or name not in at_once}
    again = _AGAIN.search(words) is not None and bool(changes)
    at_first = not (comes or again) and _goes_on_at_first(
        kind, lasts and not (begun and times), every, states, run, meant, not limits and not _sets_free(checker)
    )
    if not lasts and NOT_FIRST.search(words):
        return None
    of_moment = not lasts and is_moment(words, kind)
    return Phase(at_first and not of_moment, tuple(reversed(changes.values())), of_moment) if changes or at_first else None


def stretch_of(checker: Checker, declared: Declared, parts: Sequence[str]) -> tuple[Phase, str] | None:
    """The stretch of the model's own motion of which parts of a label say what goes on, ``rope slack, on the buffer``, with their words; the
    first on which all of that does, else that of the first of them. None where they say nothing of the kind, or it is so from the start."""

    def lasting(asked: Checker, words: str) -> Phase | None:
        found = phase(asked, words) if IN_WORDS.fullmatch(words) else None
        return found if found and not found.is_moment else None

    bodies = checker.symbols(declared).bodies  # a roll, and not what rolls
    said = {words: found for words in parts if words not in bodies and (found := lasting(checker, words))}
    later = next(((found, words) for words, found in said.items() if found.changes), None)
    if later is None or len(said) < 2:
        return later
    for name in checker.happens.switches:
        with suppress(ModelProblem):
            there = checker.beside("after", name, {})
            if all((found := lasting(there, words)) and found.at_first for words in said):
                return Phase(False, (name,), False), ", ".join(said)
    return later


def _moving(checker: Checker, words: str) -> Phase | None:
    """The first stretch on which a body moves, ``while the cart moves``, or stands; a later one where it comes to that."""
    found = _MOVES.fullmatch(words)
    if found is None or found["body"] not in checker.symbols().bodies:
        return None
    run, energy = checker.happens.run, f"kinetic({quote(found['body'])})"
    begins = {run.t[0]: ""} | {
        change.t: f"{change.kind} {change.of[0]}" for change in reversed(run.changes) if change.t > run.t[0]
    }
    times = sorted(begins)
    within = [np.linspace(one, other, _SEEN)[1:-1] for one, other in pairwise([*times, run.t[-1]])]
    largest = np.array([run.evaluate(energy, each).max() for each in within])
    fits = (largest > _STANDS * largest.max()) == bool(found["moves"])
    comes = found["comes"] is not None and not fits[0]
    k = next((k for k in range(len(fits)) if fits[k] and (k or not comes)), None)
    return None if k is None else Phase(k == 0, (begins[times[k]],) if k else (), False)


def _held_by(checker: Checker, words: str, limits: Mapping[str, Any]) -> Phase | None:
    """The stretch on which a stop or a contact holds something, which words call by its name, ``once the pawl holds``, ``foot pushing``; None
    where they call none."""
    said = [*(found[1] or found[2] for found in _HOLDS.finditer(words)), *_DOING.findall(words)]
    name = next((name for name in said if name in limits), None)
    if name is None:
        return None
    firsts = _firsts(checker.happens.run, checker.happens.begins, "touch", (), False)
    changes = tuple(change for change, (_, part) in firsts.items() if part == name)[-1:]
    at_first = limits[name].state != "open"
    return Phase(at_first, changes, False, is_named=True) if at_first or changes else None


def _locking(checker: Checker, kind: str, lasts: bool, words: str) -> Phase | None:
    """What sticks from an event on that locks it, and slides before that, or from one on that unlocks it; None unless exactly one event
    locks something."""
    events = checker.sampler.spec["events"]
    locks, unlocks = ([event["name"] for event in events if does(event, what)] for what in ("lock", "unlock"))
    if len(locks) != 1:
        return None
    changes = locks if kind == "stick" else unlocks
    return Phase(lasts and kind == "slip", (*changes,), not lasts and is_moment(words, kind))


def _sets_free(checker: Checker) -> bool:
    """Whether an event of the model releases something."""
    return any(does(event, "release") for event in checker.sampler.spec["events"])


def _firsts(run: Any, begins: float, kind: str, begun: Sequence[_Change], again: bool) -> dict[str, tuple[float, str]]:
    """When changes of a kind come first after a time, beside those by which something has ``begun``, with their parts, by their names;
    where it is so ``again``, and was not at first, when they come for the second time."""
    happened = {change.kind for change in run.changes if change.t > begins}
    kinds = next((kinds for kinds in _CHANGES.get(kind, ()) if happened & {*kinds}), (kind,))
    found = [(change.t, part, f"{change.kind} {part}") for change in run.changes for part in change.of if change.kind in kinds]
    later = sorted({each for each in (*found, *begun) if each[0] > begins})
    before = (_BEFORE[change.kind] for change in run.changes if change.kind in _BEFORE)
    if again and next(before, None) != _STATES.get(kind, kind):
        names = [name for *_, name in later]
        second = [(t, part, f"second {name}") for i, (t, part, name) in enumerate(later) if names[:i].count(name) == 1]
        later = second if second or kind in _STATES else later  # what touches for the first time has done so before it started
    return {name: (t, part) for t, part, name in reversed(later)}


def _joining(checker: Checker, words: str) -> str | None:
    """The only event that puts a part on another, where words say of a body that it is on: ``with the ring on it``."""
    events = (event for event in checker.sampler.spec["events"] if not event["opening"])
    joining = [event["name"] for event in events if does(event, "engage")]
    is_on = _IS_ON.search(words) and not LASTS.match(words)  # while it is on may be at first
    said = {*checker.symbols().bodies} & {*re.findall(r"\w+", words)} if is_on else set()
    joined = _JOINED.search(words) is not None
    return joining[0] if (said or joined) and len(joining) == 1 else None


def _left_alone(run: Any, begins: float, limits: Any, others: Collection[str]) -> str | None:
    """By what name the last of other contacts opens that are closed when a run begins; None where none is, or one does not."""
    closed = {name for name in others if limits[name].state != "open"}
    opens = {
        part: change.t
        for change in reversed(run.changes)
        for part in change.of
        if change.kind == "lift-off" and change.t > begins
    }
    return f"lift-off {max(closed, key=opens.__getitem__)}" if closed and closed <= opens.keys() else None


def _begun(run: Any, state: str) -> list[_Change]:
    """When parts touch that are in a state from then on, each with the name of that change."""
    last = {name: limit.state for name, limit in run.source.instant(run.motion.end).limits.items()}
    found: list[_Change] = []
    for change in reversed(run.changes):
        for part in change.of:
            if change.kind in (*_TOUCHES, "rest") and last.get(part) == state:  # bounces end, too
                found.append((change.t, part, f"{change.kind} {part}"))
            last[part] = _BEFORE.get(change.kind, "")
    return found


def _goes_on_at_first(
    kind: str, lasts: bool, every: bool, states: Mapping[str, str], run: Any, meant: Collection[str], flies: bool
) -> bool:
    """Whether something of a kind goes on where a run starts, of parts that are meant, those that have ``states``, there; ``flies`` where
    nothing can touch anything."""
    if kind == "reversal":
        return False
    if kind not in _STATES:
        apart = {state == "open" for state in states.values()} or {flies}
        return lasts and (kind == "lift-off") in apart
    began = {part: change.kind for change in reversed(run.changes) for part in change.of if change.kind in _BEFORE}
    found = {*states.values()} & {*_STATES.values()}
    found |= {_BEFORE[began[name]] for name in meant if name in began and name not in states}
    there = found == {_STATES[kind]} if every else _STATES[kind] in found
    return there or (lasts and not found)


def _meant(words: str, parts: Collection[str], limits: Any, unnamed: Collection[str]) -> set[str]:
    """Those of several parts that words name best, by their own names, those of their bodies, and whether one of these is ground; the
    ``unnamed`` where they name none."""
    said = re.findall(r"\w+", words)

    def named(name: str) -> int:
        return 2 if name in words else any(alike(name, word) for word in said)

    def score(part: str) -> int:
        bodies = {limits[part].first, limits[part].second} if part in limits else set()
        place = _GROUND if GROUND in bodies else _TOGETHER
        return named(part) + sum(map(named, bodies - {GROUND})) + 2 * (bool(bodies) and place.search(words) is not None)

    scores = {part: score(part) for part in parts}
    best = max(scores.values(), default=0)
    return {part for part, its in scores.items() if its == best} if best else {*unnamed}


def called(names: Iterable[str], said: Collection[str]) -> list[str]:
    """Those of several names that some words are, else those that they are alike to."""
    names = [*names]
    return [name for name in names if name in said] or [name for name in names if any(alike(name, word) for word in said)]


def alike(name: str, word: str) -> bool:
    """Whether two words begin alike: cut and cutting."""
    return len(word) >= _STEM and name.lower().startswith(word.lower()[:_STEM])

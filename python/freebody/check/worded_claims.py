"""Claims under conditions in words: a label, a stretch of the motion, what becomes of a part, before or after an event."""

from __future__ import annotations

import re
from collections.abc import Sequence
from contextlib import suppress
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.run.moments import Unreached, time_of
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Sym

from . import timed_claims
from .beginnings import events_named, is_start
from .corners import on_corner
from .described import described, place_of, way_of
from .families import ALL, BEFORE, SINCE_START
from .hypotheses import WORDS
from .language.statements import symbols_in
from .later import AT_FIRST, only_at_first
from .phases import NOT_FIRST, Phase, is_moment, kind_of, phase
from .user_symbols import INITIAL
from .verdict import Kind, Verdict
from .wording import IN_WORDS, LASTS

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .families import Family


def in_words(checker: Checker, declared: Declared, condition: str, statement: str, problem: ModelProblem) -> Verdict:
    """Under a hypothesis of which a part is words: of what becomes of a part of the model, a label, or a moment."""
    parts = [part.strip() for part in re.split(r",|\band\b", condition)]
    for part in parts:
        others = ", ".join(other for other in parts if other is not part)
        under = f"if {others}: {statement}" if others else statement
        if beside := _BESIDE.fullmatch(part):
            return beside_words(checker, declared, beside[1], beside[2], beside[3], under)
        if there := on_corner(checker, part):
            verdict = there.check(under, declared, correcting=checker.correcting)
            return replace(verdict, notes=(*verdict.notes, f"`{part}` is read as while it stays on that corner."))
        if IN_WORDS.fullmatch(part) and (found := phase(checker, part)):
            return _of_phase(checker, declared, found, part, under, problem)
    known = _letters(checker, declared)
    words = [part for part in parts if (IN_WORDS.fullmatch(part) or part in known) and part not in WORDS]
    if not words or len(words) == len(parts):
        return labelled(checker, declared, condition, statement, problem)
    under = f"if {', '.join(part for part in parts if part not in words)}: {statement}"
    return labelled(checker, declared, ", ".join(words), under, problem)


def labelled(checker: Checker, declared: Declared, words: str, statement: str, problem: ModelProblem) -> Verdict:
    """Behind words that are no hypothesis: those that name a part are a label; with others it has to be true without them, too, else
    that is the ``problem``. Raises it."""
    if is_start(checker, words):
        return checker.check(f"at the start: {statement}", declared, correcting=checker.correcting)
    if place := place_of(words, checker):
        verdict = checker.check(f"at {place}: {statement}", declared, correcting=checker.correcting)
        return replace(verdict, notes=(*verdict.notes, f"`{words}` is read as at {place}."))
    lasts, said = LASTS.match(words) is not None, _is_plain(words)
    if said and (ending := checker.happens.ending(words)):
        verdict = _until(checker, declared, ending, statement)
        return replace(verdict, notes=(*verdict.notes, f"`{words}` is read as before {ending}."))
    if not lasts and not _CONDITION.match(statement) and (event := checker.happens.event(words)):
        return timed_claims.at(checker, declared, event, statement)
    if IN_WORDS.fullmatch(words) and (found := phase(checker, words)):
        return _of_phase(checker, declared, found, words, statement, problem)
    if _TO_REST.fullmatch(words):  # nothing sticks there
        return checker.check(f"if at rest: {statement}", declared, correcting=checker.correcting)
    if not lasts and (verdict := _of_moment(checker, declared, words, statement)):
        return verdict
    if said and (until := _UNTIL.fullmatch(words)):
        with suppress(ModelProblem):
            return _until(checker, declared, until[1], statement)
    if said and (given := described(words, checker, declared)):
        verdict = _described(checker, declared, given, words, statement)
        if verdict is not None:
            return verdict
    return _label_or_stretch(checker, declared, words, statement, problem)


def _until(checker: Checker, declared: Declared, event: str, statement: str) -> Verdict:
    """Up to something that happens; or just there, of what is summed up from the start to it. Raises ``ModelProblem``."""
    verdict = beside_event(checker, declared, "", "before", event, statement)
    if verdict.ok or not (_speaks_of_start(checker, declared, statement) or _speaks_of_time(checker, declared, statement)):
        return verdict
    for side in ("before", "after"):
        with suppress(ModelProblem, StatementError):
            there = beside_event(checker, declared, "just ", side, event, statement)
            if there.ok and not _says_nothing(there):
                return replace(there, notes=(*there.notes, f"`until {event}` is read as just {side} that."))
    return verdict


def _of_moment(checker: Checker, declared: Declared, words: str, statement: str) -> Verdict | None:
    """At a moment that words call by what goes on, or by the name of an event, or after it; None where they call none."""
    named = events_named(checker, words)
    if len(named) == 1 and len(named[0].split()) > 1:
        return in_phase(checker, declared, Phase(False, (named[0],), True), words, statement)
    if kind_of(words) == "reversal" and not NOT_FIRST.search(words):
        if len(checker.sampler.names) == 1:
            return checker.check(f"if {checker.sampler.names[0]}' = 0, from the start: {statement}", declared)
        if len(turning := _moves_in(checker, declared, statement)) == 1:
            return checker.check(f"at the greatest {turning[0]}: {statement}", declared)
    if _OVER.search(words):
        with suppress(ModelProblem):
            return in_phase(checker, declared, Phase(False, (checker.happens.called(words),), False), words, statement)
    if kind := kind_of(words):
        lasts = kind in ("taut", "slack") and not is_moment(words)  # what a string is, not what it does
        with suppress(ModelProblem):  # an event by what goes on from there
            return in_phase(checker, declared, Phase(False, (checker.happens.called(words),), not lasts), words, statement)
    return None


def _label_or_stretch(checker: Checker, declared: Declared, words: str, statement: str, problem: ModelProblem) -> Verdict:
    """Behind words of which nothing is known but that they name a part, or that they last: as the model is at first, or on a later
    stretch of its own motion. Raises the ``problem`` where they are neither, and it is not true without them."""
    lasts, said = LASTS.match(words) is not None, _is_plain(words)
    parts = {*checker.symbols(declared).bodies, *(joint["name"] for joint in checker.sampler.metadata["joints"])}
    meshing = {
        word for joint in checker.sampler.metadata["joints"] if joint["type"] == "gear" for word in ("mesh", joint["name"])
    }
    names = bool((parts | meshing) & {*re.findall(r"\w+", words)}) or words in _letters(checker, declared)
    placed = _PLACED.match(words) is not None
    stretch = (lasts or placed) and said and not names and _ONE_PART.search(words) is None
    asked = checker.at_first() if lasts or placed else checker
    asked = copy(asked)
    asked.correcting = checker.correcting and (names or stretch)
    verdict = (_at_first(asked, declared, statement) if lasts else asked.check(statement, declared)) if said else None
    if verdict is None or not (names or stretch or verdict.ok):
        if lasts and verdict is not None and not (found := _later(checker, declared, words, statement, verdict, problem)).ok:
            return found  # whichever stretch is meant
        raise problem
    run = checker.happens.run
    others = any(change.t > run.t[0] for change in run.changes)  # stretches of the motion
    waits = _awaits(checker, declared, statement, verdict) or (lasts and _stands(verdict))  # while it tips, it moves
    elsewhere = not verdict.ok or (others and waits)
    idle = lasts and others and verdict.is_idle  # of a part by its name, which does nothing yet
    if (stretch or (placed and others) or idle) and elsewhere and not _FIRST_OF_ALL.search(words):
        return _later(checker, declared, words, statement, verdict, problem)
    at_first = (lasts or placed) and others
    how = "at first" if at_first else "a label, and not judged"
    if not at_first and verdict.kind is Kind.TRUE and any(note.startswith(AT_FIRST) for note in verdict.notes):
        verdict = only_at_first(verdict)
    return replace(verdict, notes=(*verdict.notes, f"`{words}` is read as {how}."))


def _is_plain(words: str) -> bool:
    """Whether they are words alone, without a relation."""
    return bool(words) and re.search(r"[=<>≤≥→]|->", words) is None


def _moves_in(checker: Checker, declared: Declared, statement: str) -> list[str]:
    """The coordinates of which a statement speaks."""
    with suppress(StatementError):
        said = {n.name for n in symbols_in(checker.case(statement, declared).program)}
        return [name for name in checker.sampler.names if name in said]
    return []


def _letters(checker: Checker, declared: Declared) -> set[str]:
    """What a label may be of, as in ``Lagrange, for θ:``."""
    return {*checker.mechanism.parameters, *checker.sampler.names, *declared}


def _described(checker: Checker, declared: Declared, given: Family, words: str, statement: str) -> Verdict | None:
    """Of motions that words describe; None where the model's own begins so, and it holds at first."""
    verdict = checker.check(statement, declared, given)
    if verdict.kind is Kind.UNDECIDABLE:  # it may come only after something switches
        later = given.since and checker.check(statement, declared, replace(given, through=True))
        verdict = later or on_later_stretch(checker, declared, words, statement) or verdict
    sampler = checker.sampler
    soon = sampler.run(sampler.own, _SOON / sampler.rate).end
    begins_so = not given.since and sampler.are_above(given.above, soon)
    if not verdict.ok and begins_so and _judged_at(checker, declared, ("", "", ""), statement, False).ok:
        return None
    has_a_way = given.above != checker.hypothesis.above
    if verdict.ok or not has_a_way or given.since or begins_so:
        return verdict
    return on_later_stretch(checker, declared, words, statement) or verdict  # it moves that way after something that happens


def _of_phase(checker: Checker, declared: Declared, found: Phase, words: str, statement: str, problem: ModelProblem) -> Verdict:
    """On a stretch or at a moment in words; where no part is called as they say, on any later stretch, too."""
    if not found.is_moment and (way := way_of(words, checker)):
        statement = f"if {way}: {statement}"
    lasting = replace(found, is_moment=False) if found.is_moment and _FROM_THEN_ON.match(words) else None
    if lasting and (verdict := in_phase(checker, declared, lasting, words, statement)).ok:
        return verdict
    verdict = in_phase(checker, declared, found, words, statement)
    if lasting and verdict.ok:
        only = f"just after {' or '.join(found.changes)}"
        return replace(verdict, kind=Kind.TRUE_IF, assumption=only, reason=f"true only {only}, not from then on")
    if found.is_moment and not verdict.ok and (there := _before_another(checker, declared, found, words, statement)):
        return there
    unclear = found == Phase(True, (), False) and not verdict.ok and kind_of(words) not in ("stick", "slip")
    return _later(checker, declared, words, statement, verdict, problem) if unclear else verdict


def _before_another(checker: Checker, declared: Declared, found: Phase, words: str, statement: str) -> Verdict | None:
    """True just before an event that words may mean beside what they are taken for; else None."""
    for name in dict.fromkeys(event.name for event in checker.happens.run.events if event.name not in " ".join(found.changes)):
        with suppress(ModelProblem, StatementError):
            there = beside_event(checker, declared, "just ", "before", name, statement)
            if there.ok and not _says_nothing(there):
                return replace(there, notes=(*there.notes, f"`{words}` is read as just before {name}."))
    return None


def _later(checker: Checker, declared: Declared, words: str, statement: str, at_first: Verdict, problem: ModelProblem) -> Verdict:
    """What does not hold as the model is at first, behind words that say how long it should: true where it holds after something
    that happens, wrong where it holds on none of these stretches, whichever is meant. Raises the ``problem`` of the words for what
    should stay the same, of which nothing says how long."""
    run = checker.happens.run
    happens = dict.fromkeys([*(event.name for event in run.events), *(part for change in run.changes for part in change.of)])
    found = in_phase(checker, declared, Phase(False, tuple(happens), False), words, statement, [at_first])
    judging = copy(checker)
    judging.correcting = False
    for name in [] if found.ok else dict.fromkeys(event.name for event in run.events):
        with suppress(ModelProblem, StatementError):
            before = beside_event(judging, declared, "", "before", name, statement)
            if before.ok and not _says_nothing(before):
                return replace(before, notes=(*before.notes, f"`{words}` is read as before {name}."))
    if not found.ok and ("constant:" in statement or found.kind not in (*_WRONG, Kind.TRUE_IF)):
        raise problem
    if found.ok or at_first.mends or not checker.correcting:
        return found
    first = checker.at_first().check(statement, declared)
    return _least_wrong([replace(first, notes=(*first.notes, found.notes[-1])), found])


def on_later_stretch(checker: Checker, declared: Declared, condition: str, statement: str) -> Verdict | None:
    """Under a hypothesis of which there are no motions as the model is at first, as of what slides back: after what switches."""
    for name in () if checker.is_at_first else checker.happens.switches:
        with suppress(ModelProblem, StatementError):
            found = in_phase(checker, declared, Phase(False, (name,), False), condition, f"if {condition}: {statement}")
            if found.kind is not Kind.UNDECIDABLE:
                return found
    return None


def in_phase(
    checker: Checker, declared: Declared, when: Phase, words: str, statement: str, verdicts: Sequence[Verdict] = ()
) -> Verdict:
    """On a stretch of the model's own motion, or at a moment of it: true where it holds on one that may be meant, wrong where on none, with
    the corrections of that where least is wrong; beside ``verdicts`` about others."""
    sides = [("just ", "after"), ("just ", "before")] if when.is_moment else [("", "after")]
    places = [("", "", "")] * when.at_first + [(just, side, name) for name in when.changes for just, side in sides]
    names = ["at first"] * bool(verdicts) + [f"{just}{side} {name}" if side else "at first" for just, side, name in places]
    unclear = len(places) > 1 and _WHICH_OF_THEM.search(words) is not None
    found: list[tuple[Place | None, Verdict]] = [(None, one) for one in verdicts]
    problem: ModelProblem | StatementError = ModelProblem(f"`{words}` is nothing that this model comes to")
    for place, name in zip(places, names[len(names) - len(places) :], strict=True):
        if found and not (checker.whole or checker.budget).lasts(_AT_MOST):
            return Verdict(Kind.UNDECIDABLE, statement, f"there was no time for all stretches that `{words}` may mean: say which")
        try:
            one = _judged_at(checker, declared, place, statement, checker.correcting and len(places) == 1)
        except (ModelProblem, StatementError) as error:
            problem = error
            continue
        if one.ok:
            one = replace(one, notes=(*one.notes, f"`{words}` is read as {name}."))
            if not (unclear or _says_nothing(one)):
                return one
        found.append((place, one))
    if not found:
        raise problem
    if unclear and any(one.ok for _, one in found) and any(one.kind in _WRONG for _, one in found):
        what = f"it holds on some of the stretches that `{words}` may mean, and not on others"
        return Verdict(Kind.UNDECIDABLE, statement, what)
    found = [(place, one) for place, one in found if not one.ok] or found  # what is 0 there is spoken of elsewhere
    found = [(place, one) for place, one in found if not one.of_no_motion] or found
    nearest = next((one for _, one in found if one.kind not in _WRONG), None)
    nearest = nearest or _least_wrong(
        _corrected(checker, declared, found, statement) if len(places) > 1 else [one for _, one in found]
    )
    how = f"is read as {names[0]}" if len(names) == 1 else f"is not judged: it does not hold {' or '.join(names)}"
    return nearest if nearest.ok else replace(nearest, notes=(*nearest.notes, f"`{words}` {how}."))


def _judged_at(checker: Checker, declared: Declared, place: Place, statement: str, correcting: bool) -> Verdict:
    """On one stretch, or at one moment; the model as it is at first, where none is named."""
    asked = copy(checker)
    asked.correcting = correcting
    if place[1]:
        return beside_event(asked, declared, *place, statement)
    return _at_first(asked.at_first(), declared, statement)


def _at_first(checker: Checker, declared: Declared, statement: str) -> Verdict:
    """On the model's first stretch, of any motions, else of those from the start: what sticks does so where it starts."""
    one = checker.check(statement, declared, correcting=checker.correcting)
    if one.kind is not Kind.WRONG or checker.hypothesis != ALL:
        return one
    since = checker.check(statement, declared, SINCE_START, correcting=False)
    return since if since.ok and not since.untested else one


def _corrected(
    checker: Checker, declared: Declared, found: Sequence[tuple[Place | None, Verdict]], statement: str
) -> list[Verdict]:
    """Verdicts about stretches with corrections: first of those on which all letters of the statement take part, then of the others."""
    given = [one for place, one in found if place is None]
    for idle in (False, True) if checker.correcting else ():
        asked = [place for place, one in found if place and one.is_idle is idle]
        some = [_judged_at(checker, declared, place, statement, True) for place in checker.budget.within(asked, 1.0)]
        if any(one.mends for one in (*given, *some)):
            return [*given, *some]
    return [one for _, one in found]


def _awaits(checker: Checker, declared: Declared, statement: str, one: Verdict) -> bool:
    """Whether it is of what a contact, a string or a stop does, which does nothing where it was judged."""
    if not one.untested or one.evidence is None:
        return bool(one.untested)
    case = checker.case(statement, declared)
    still = [n.name for n in symbols_in(case.program) if one.evidence.letters.get(n.key) == 0]
    read = {owner for name in still for text in case.meaning.texts(Sym(name)) for owner in _OWNER.findall(text)}
    return any(case.meaning.symbols.named.owners.get(owner) in ("contact", "string", "stop") for owner in read)


def _says_nothing(one: Verdict) -> bool:
    """Whether something that a statement is of is 0 where it holds, and may act on another stretch."""
    return bool(one.untested) and one.is_idle


def _stands(one: Verdict) -> bool:
    """Whether no part moves of which something is said."""
    rates = [value for name, value in one.evidence.letters.items() if name.endswith("dot")] if one.evidence else []
    return bool(one.untested) and bool(rates) and not np.any(rates)


def _least_wrong(verdicts: Sequence[Verdict]) -> Verdict:
    """That with the smallest correction, first of stretches on which all letters of the statement take part, and nothing is taken from it:
    what it is of may not be there."""

    def order(one: Verdict) -> tuple[bool, bool, bool, float]:
        if not one.mends:
            return True, True, True, np.inf
        return False, one.is_idle, any(kind == "extra term" for kind, *_ in one.mends[0].edits), one.mends[0].size

    return min(verdicts, key=order)


def beside_words(checker: Checker, declared: Declared, just: str, side: str, event: str, statement: str) -> Verdict:
    """The same of something in words; where nothing that happens is called so, true where it holds after one thing that does, wrong where after none.
    Raises the problem of the words for what should stay the same."""
    if just and side == "after" and is_start(checker, event):
        return checker.check(f"at the start: {statement}", declared, correcting=checker.correcting)
    try:
        return beside_event(checker, declared, just, side, event, statement)
    except ModelProblem:
        happens = () if side == "before" or NOT_FIRST.search(event) or re.search("[=<>]", event) else checker.happens.switches
        if not happens:
            raise
        words = " ".join(filter(None, ((just or "").strip(), side, event)))
        found = in_phase(checker, declared, Phase(False, happens, bool(just)), words, statement)
        if not found.ok and ("constant:" in statement or found.kind not in (Kind.WRONG, Kind.DIMENSIONS)):
            raise
        return found


def beside_event(checker: Checker, declared: Declared, just: str, side: str, event: str, statement: str) -> Verdict:
    """Before or after something that happens on a motion, at once or until the next change."""
    if checker.sampler.moment and _is_past(checker, event):
        if side == "before" or just:
            raise ModelProblem(f"`{event}` is past there", "say one moment or stretch")
        return checker.check(statement, declared)
    held = {name: float(value) for name, value in checker.hypothesis.held if _FIGURE.fullmatch(str(value))}
    if just and side == "after" and not checker.sampler.spec["events"] and not checker.happens.run.changes:
        verdict = checker.check(statement, declared, replace(checker.hypothesis, at_start=True))
        return replace(
            verdict, notes=(*verdict.notes, f"`{event}` is read as what the model starts with: nothing else happens on it.")
        )
    there = checker.beside(side, event, held)
    just = just or there.sampler.stated  # before what happens at the start there is no motion
    given = replace(checker.hypothesis, at_start=True) if just else checker.hypothesis
    verdict = there.check(statement, declared, given)
    verdict = replace(verdict, moment=verdict.moment or f"{just}{side} {event}")
    of_start = any(INITIAL in note for note in verdict.notes) or _speaks_of_time(there, declared, statement)
    if not verdict.ok and (of_start or _is_integral(there, declared, statement)):
        # v₀ is that of the start before
        verdict = there.check(statement, declared, replace(given, since=BEFORE))
    if verdict.ok or just or side == "after":
        return verdict
    up_to = replace(SINCE_START, until=checker.happens.called(event))  # what is before it may be the motion up to it
    until = checker.check(statement, declared, up_to)
    if until.ok and until.untested:  # it stands still until something lets it go
        until = checker.check(statement, declared, replace(up_to, through=True))
    return until if until.ok or (until.mends and not verdict.mends) else verdict


def _is_past(checker: Checker, event: str) -> bool:
    """Whether what happens has done so already at the moment of which is spoken."""
    with suppress(ModelProblem, Unreached):
        return time_of(checker.happens.run, checker.happens.called(event)) <= checker.sampler.own.t * (1 + _ROUND_OFF)
    return False


def _speaks_of_start(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether a statement has letters of the start."""
    with suppress(ModelProblem, StatementError):
        case = checker.case(statement, declared)
        return any(map(case.meaning.speaks_of_start, case.equations))
    return False


def _is_integral(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether it says of rates, and of no force or acceleration, what they are in parameters alone: so it is of what came before."""
    with suppress(ModelProblem, StatementError):
        case = checker.case(statement, declared)
        known = case.meaning.vocabulary
        sides = [{*symbols_in(side)} - {*known.parameters} for each in case.equations for side in (each.left, each.right)]
        moving = set().union(*sides)
        return not all(sides) and any(map(known.is_rate, moving)) and not any(map(known.is_load, moving))
    return False


def _speaks_of_time(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether something of a statement is asked of the time since the start."""
    with suppress(ModelProblem, StatementError):
        return any(n.name == "t" for n in symbols_in(checker.case(statement, declared).program))
    return False


Place = tuple[str, str, str]
"""``just`` or nothing, ``before`` or ``after``, and what happens there."""
_AT_MOST = 3.0  # times what a statement may take, for all the stretches that words may mean
_WRONG = (Kind.WRONG, Kind.DIMENSIONS)
_ROUND_OFF = 1e-9  # of a time, by which moments of two runs of one motion differ
_SOON = 0.01  # of the time typical of a model
_BESIDE = re.compile(r"(just )?(after|before) (.+)", re.S)
_UNTIL = re.compile(r"until (.+)", re.S)
_TO_REST = re.compile(r"(?:(?:when|once)\s+)?(?:it|all|everything)\s+has\s+come\s+to\s+rest")
_FROM_THEN_ON = re.compile(r"once\b")
_OVER = re.compile(r"\b(?:has|have|had)\b")
"""``once the drum has stopped``: what is so after something that happens."""
_PLACED = re.compile(r"(?:with|once)\b|(?:.+\b)?(?:on|in|against) the\b")
"""``with the lump on the rim``: words that may be of a later stretch."""
_WHICH_OF_THEM = re.compile(r"\b(?:ahead|forwards?|backwards?|the\s+other\s+way)\b")
"""Which of several stretches of one kind is meant: not understood, so that no other is taken for it."""
_FIRST_OF_ALL = re.compile(r"\bfirst\s+(?:half[\s-])?(?:swing|stroke|stage|phase|part|stretch|period)")
"""``during the first swing``: no later stretch is meant."""
_ONE_PART = re.compile(
    r"\b(?:small|slow|steady|constant|rest|back|up|down|left|right|ris|fall|return|forward|impact|blow|impulse|collision|shock|hit)"
)
"""What lasts, and what is a part of that, or a moment, which no stretch between two events is."""
_CONDITION = re.compile(r"[^=:]*:(?!=)")
_OWNER = re.compile(r"(\w[\w .]*)\.\w+")
"""The part of which a reading is, ``blow`` of ``blow.N``."""
_FIGURE = re.compile(r"\(?-?\d+(?:\.\d*)?\)?")

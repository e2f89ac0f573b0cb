"""What happens on the model's own run, and by which words people call it."""

from __future__ import annotations

import re
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, Any

from freebody.model.errors import ModelProblem
from freebody.model.start import quantity
from freebody.run.moments import ORDINALS, PATIENT, Unreached, time_of

from .asked_model import does
from .phases import NOT_FIRST, alike, called, kind_of, phase, with_names
from .wording import BLOW

if TYPE_CHECKING:
    from .api import Checker

_ENDS = re.compile(r"\b(?:instant|moment) of\b|\b(?:begin|start|end|stop|cease)s?\b")
"""Words that say of something that it happens."""
_BLOW = re.compile(BLOW)
_FREELY = re.compile(r"\b(?:swing|mov|turn|roll|fall|fl|runn?|ris|slid)(?:y|es|ies|e?s|ing)\s+free(?:ly)?\b")
_ON, _OFF = re.compile(r"\b(?:on|under)\b"), re.compile(r"\boff\b")
_ARTICLE = re.compile(r"\A(?:the|an?)\s+")
_SAME_TIME = 1e-6  # of a run: by less the moments of two runs of one motion differ


class Happenings:
    """What happens on the ``run`` of a checker's model, by name. The run starts where the model does; what is asked of it is so from
    ``begins`` on."""

    def __init__(self, checker: Checker) -> None:
        self._checker, self._sampler, self._mechanism = checker, checker.sampler, checker.mechanism
        self._runs: dict[float | None, Any] = {}  # by when they end, once they are asked for

    @property
    def _events(self) -> list[dict[str, Any]]:
        return self._sampler.spec["events"]

    def called(self, event: str) -> str:
        """The name of what happens on the model's own run that words speak of."""
        events = {e["name"]: None for e in self._events}
        said = _ARTICLE.sub("", event)
        if said in events:
            return said
        parts = self._parts
        said = with_names(said, parts)
        which, _, again = said.partition(" ")
        if {said, again if which in ORDINALS else said} & {
            f"{change.kind} {part}" for change in self.run.changes for part in change.of
        }:
            return said
        if (found := NOT_FIRST.search(said)) and (often := self._again(found[0], said)):
            return often
        if found:
            raise ModelProblem(
                f"the motion of this model does not come to a {found[0]} of these",
                "write `at 0.3 s: …`, or say when it is",
            )
        if found := self._named(said) or self._meant(said):
            return found
        what = ", ".join({**events, **parts}) or "nothing does"
        raise ModelProblem(f"`{event}` is nothing that happens on the motion of this model", f"what happens: {what}")

    def _named(self, said: str) -> str | None:
        """That to whose name, or to the name of what begins or ends there, words are alike; else the only one of a kind."""
        kinds = {e["name"]: "released" if does(e, "release") else kind_of(e["name"]) for e in self._events}
        of_kind = [name for name, its in kinds.items() if (kind := kind_of(said)) and kind == its]
        if len(of_kind) == 1 and kinds[of_kind[0]] == "released":  # before the cord is cut: not of the cord else
            return of_kind[0]
        words = re.findall(r"\w+", said)
        begins, ends = (when.changes if (when := phase(self._checker, f"{said}{over}")) else () for over in ("", " is over"))
        for found in (called(kinds, words), begins, called(self._parts, words), ends):  # after slipping: what goes on ends
            if len(found) == 1:
                return found[0]
        return of_kind[0] if len(of_kind) == 1 else None

    def _meant(self, said: str) -> str | None:
        """The first of several that touch; else the only one that words can mean."""
        words, run = re.findall(r"\w+", said), self.run
        several = [part for part in self._parts if any(alike(own, word) for own in part.split() for word in words)]
        if several and kind_of(said) == "touch":
            return several[0]
        times = [event.t for event in run.events]
        later = [change for change in run.changes if change.t > run.t[0] and change.t not in times]
        if len(self.impacts) == 1 and _BLOW.search(said):
            return next(iter(self.impacts))
        return self._events[0]["name"] if len(self._events) == 1 and not later else None

    @property
    def _parts(self) -> dict[str, None]:
        """Those of which something changes on the run."""
        return dict.fromkeys(part for change in self.run.changes for part in change.of)

    def _again(self, which: str, words: str) -> str | None:
        """The name of the second impact, say, of all, or of the part that words name; None where there is none."""
        kinds = ("impact", "contact") if kind_of(words) == "touch" else ()
        parts = called(self._parts, re.findall(r"\w+", words))
        for kind in kinds:
            name = f"{which} {kind} {parts[0]}" if len(parts) == 1 else f"{which} {kind}"
            with suppress(Unreached):
                time_of(self.run, name)
                return name
        return None

    @property
    def begins(self) -> float:
        """The moment of which is spoken, else when the run starts, s."""
        return self._sampler.own.t if self._sampler.moment else float(self.run.t[0])

    @property
    def switches(self) -> tuple[str, ...]:
        """What switches on the model's own run for the first time after its moment, by its kind and part."""
        run = self.run
        begins = self.begins + (_SAME_TIME * float(run.outcome.t) if self._sampler.moment else 0.0)
        first: dict[str, float] = {}
        for change in run.changes:
            for part in change.of:
                first.setdefault(f"{change.kind} {part}", change.t)
        return tuple(name for name, t in first.items() if t > begins)

    @cached_property
    def impacts(self) -> set[str]:
        """The parts at which there are impacts on the model's own run, and the strings that jerk when they first go taut."""
        first = {part: change for change in reversed(self.run.changes) for part in change.of}
        found = (change for change in self.run.impacts if change.kind == "impact" or first[change.of[0]] is change)
        return {change.of[0].partition(".")[0] for change in found if change.kind in ("impact", "taut")}

    def jump(self, words: str) -> str | None:
        """What the only impacts on the model's own run are at; where there are none, the only event to whose name words are alike and that
        holds something fast."""
        if len(self.impacts) > 1:
            return None
        for part in self.impacts:
            t = next(change.t for change in self.run.impacts if change.of[0].partition(".")[0] == part)
            at_once = [event.name for event in self.run.events if event.t == t]
            return at_once[0] if part.startswith("lock ") and at_once else part  # what an event locks is no part with a name
        joining = [event["name"] for event in self._events if does(event, "lock") or does(event, "engage")]
        found = called(joining, re.findall(r"\w+", words))
        return found[0] if len(found) == 1 else None

    @cached_property
    def only_impact(self) -> str | None:
        """What the impacts on the model's own run are at, where it is one part, and nothing happens at its start."""
        if self._sampler.moment or any(event["opening"] for event in self._events):
            return None
        starts = any(change.t == self.run.t[0] and change.of[0] in self.impacts for change in self.run.impacts)
        return next(iter(self.impacts)) if len(self.impacts) == 1 and not starts else None

    @property
    def only_one(self) -> str | None:
        """The only impact on the model's own run, else the only event that changes the model; None where there are several."""
        events = [event["name"] for event in self._events if event["then"] not in ([], ["stop"])]
        return self.only_impact or (events[0] if len(events) == 1 and not self._sampler.moment else None)

    def ending(self, words: str) -> str | None:
        """The event that ends what words say is on, ``power on`` where one is called ``power off``; None where something is called as they say."""
        names = [event["name"] for event in self._events]
        if not _ON.search(words) or any(_ON.search(name) for name in called(names, re.findall(r"\w+", words))):
            return None
        ends = called([name for name in names if _OFF.search(name)], re.findall(r"[^\W\d]{3,}", words))
        return ends[0] if len(ends) == 1 else None

    def freeing(self, words: str) -> str | None:
        """The only event that cuts or releases something, where words are of what moves freely; else None."""
        names = [event["name"] for event in self._events if does(event, "release")]
        return names[0] if len(names) == 1 and _FREELY.search(words) else None

    def event(self, words: str) -> str | None:
        """The only event to whose name one of several words is alike and that changes nothing in the model, so that there is one state
        there: ``the lowest point``, ``the clutch grips``."""
        said = re.findall(r"\w+", words) if re.search("[=<>]", words) is None else []
        named = called([e["name"] for e in self._events], said)
        found = [e for e in self._events if e["name"] in named]
        found = found or (self._events if _ENDS.search(words) and kind_of(words) != "reversal" else [])
        return found[0]["name"] if len(found) == 1 and not found[0]["opening"] and found[0]["then"] in ([], ["stop"]) else None

    @cached_property
    def run(self) -> Any:
        """The model's own run; where the model does not say how long it runs, one on which something switches that may."""
        run, _ = self.moment("end")
        open_ended = self._mechanism.run_numbers().until is None and not any(change.t > run.t[0] for change in run.changes)
        may_switch = bool(self._events) or bool(self._sampler.core.instant(self._sampler.own).limits)
        if open_ended and may_switch:
            return self._run_until(PATIENT)
        return run

    def _run_until(self, until: float | None) -> Any:
        """The model's own run up to a time, s; as long as the model says where that is None."""
        if until not in self._runs:
            self._runs[until] = self._mechanism.simulate(until)
        return self._runs[until]

    def moment(self, name: str) -> tuple[Any, float]:
        """The model's own run, and the time of a moment: ``start``, ``end``, an event, or a time like ``0.3 s``."""
        name = name if name in (events := {e["name"] for e in self._events}) else _ARTICLE.sub("", name)
        until = None if self._mechanism.run_numbers().until is not None else 1.0
        with suppress(ModelProblem):
            until = until and max(until, quantity("at", name, "s"))
        if until and name in events:
            until = PATIENT  # it may come late
        run = self._run_until(until)
        times = {"start": float(run.t[0]), "end": float(run.outcome.t)}
        times |= {event.name: event.t for event in reversed(run.events)}
        try:
            return run, times[name] if name in times else quantity("at", name, "s")
        except ModelProblem:
            raise ModelProblem(
                f"the run has no moment `{name}`", f"there are {', '.join(times)}, and times like `0.3 s`"
            ) from None

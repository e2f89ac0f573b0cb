"""What a model starts with, in words: a take-off, a touch-down, a catch that is opened."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from .phases import called

if TYPE_CHECKING:
    from .api import Checker

_LAUNCH = re.compile(r"(?:the\s+)?(?:take-?off|launch|throw|push-off|kick-off|kick|shot)")
_LET_GO = re.compile(
    r"(?:the\s+)?[a-z]+\s+(?:is|are)\s+(?:opened|released|let\s+go|removed|taken\s+away|pulled(?:\s+out)?|withdrawn|cut|burnt)"
)
_LANDING = re.compile(r"(?:the\s+)?(?:touch-?down|landing)")


def is_start(checker: Checker, words: str) -> bool:
    """Whether words are of how something comes to fly that does so from the start, or to the ground that stands there."""
    if events_named(checker, words):
        return False
    if _LET_GO.fullmatch(words) and not checker.sampler.spec["events"]:
        parts = [*checker.symbols().bodies, *checker.sampler.core.instant(checker.sampler.own).limits]
        return not called(parts, re.findall(r"\w+", words))  # of what is not in the model
    happens = {one.kind for one in checker.happens.run.changes}
    lands = _LANDING.fullmatch(words) is not None and not happens & {"impact", "contact"}
    return lands or (_LAUNCH.fullmatch(words) is not None and "lift-off" not in happens)


def events_named(checker: Checker, words: str) -> list[str]:
    """The names of the model's events of which all words stand among these."""
    said = {*re.findall(r"\w+", words)}
    return [event["name"] for event in checker.sampler.spec["events"] if {*re.findall(r"\w+", event["name"])} <= said]

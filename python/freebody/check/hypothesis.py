"""Hypotheses in words: ``m1 = 2*m2, at rest`` as a family of motions."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING, Any

from freebody.model.errors import ModelProblem

from .families import ALL, Family

if TYPE_CHECKING:
    from .api import Checker, Declared

FAR = 1e7
"""How far a parameter goes that goes to infinity (its inverse: to 0)."""

SMALL = 1e-3
"""How small a coordinate is that is small, in rad or m."""

_WORDS: dict[str, dict[str, Any]] = {
    "at rest": {"at_rest": True},
    "at the start": {"at_start": True},
    "the start is at rest": {"since": "rest"},
    "from the start": {"since": "start"},
    "without gravity": {"gravity": False},
    "with these numbers": {"numbers": True, "zeros": False},
}
_RELEASED = re.compile(r"(?:it |the motion )?(?:(?:is )?(?:released|started|starting|starts|begins) (?:from|at) rest|from rest)")
_INFINITE = ("inf", "infinity", "∞", "oo")


def family(text: str, checker: Checker, declared: Declared) -> Family:
    """The motions of which a hypothesis is true: parts with commas or ``and`` between them, each ``at rest``, ``at the start``,
    ``without gravity``, ``with these numbers``, ``p = value``, ``expression = value``, ``p -> inf`` or ``p -> 0``.

    ``declared`` are symbols of the statement's own. Raises ``ModelProblem``.
    """
    parts = [part.strip() for part in re.split(r",|\band\b", text) if part.strip()]
    if not parts:
        raise ModelProblem("the hypothesis is empty", f"write one, like `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(_WORDS)}")
    return reduce(lambda given, part: _also(given, part, checker, declared), parts, ALL)


def _also(given: Family, part: str, checker: Checker, declared: Declared) -> Family:
    """Those of some motions of which a part is true, too."""
    part = "the start is at rest" if _RELEASED.fullmatch(part) else part
    if part in _WORDS:
        return replace(given, **_WORDS[part])
    if found := re.fullmatch(r"(\S+)\s*(?:->|→)\s*(\S+)", part):
        return _limit(given, found[1], found[2], checker, declared)
    if part.count("=") != 1:
        raise ModelProblem(f"`{part}` is no hypothesis", f"write `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(_WORDS)}")
    left, right = (side.strip() for side in part.split("="))
    if (name := _parameter(left, checker, declared)) is not None:
        return replace(given, held=(*given.held, (name, _meant(right, checker, declared))))
    return replace(given, vanishing=(*given.vanishing, _meant(f"({left}) - ({right})", checker, declared)))


def _limit(given: Family, name: str, value: str, checker: Checker, declared: Declared) -> Family:
    """A parameter that goes to infinity or to 0; 0 itself where the model can have it; or a coordinate that stays near a
    value (``theta -> 0``: small motions, to first order)."""
    found = _parameter(name, checker, declared)
    if found is None and value not in _INFINITE:
        return replace(given, small=(*given.small, (_meant(f"({name}) - ({value})", checker, declared), SMALL)))
    if found is None or value not in ("0", *_INFINITE):
        raise ModelProblem(f"`{name} → {value}` is no limit that can be taken", "a free parameter goes to `inf` or to `0`")
    zero = replace(given, held=(*given.held, (found, 0.0)))
    if value == "0" and checker.sampler.has(zero):
        return zero
    return replace(given, scaled=(*given.scaled, (found, FAR if value != "0" else 1 / FAR)))


def _meant(expression: str, checker: Checker, declared: Declared) -> str:
    """An expression of the statement's symbols in the model language."""
    return checker.letters({**declared, "hypothesis": expression}).meanings["hypothesis"].texts[0]


def _parameter(name: str, checker: Checker, declared: Declared) -> str | None:
    """The free parameter of the model that a symbol stands for, or None."""
    known = checker.letters(declared).meanings
    texts = known[name].texts if name in known else (name,)
    return texts[0] if len(texts) == 1 and texts[0] in checker.sampler.free_parameters else None

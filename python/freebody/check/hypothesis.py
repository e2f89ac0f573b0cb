"""Hypotheses in words: ``m1 = 2*m2, at rest`` as a family of motions."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

from freebody.model.errors import ModelProblem

from .families import ALL, Family
from .motion_sampler import MotionSampler
from .symbols import Letters

FAR = 1e7
"""How far a parameter goes that goes to infinity (its inverse: to 0)."""

SMALL = 1e-3
"""How small a coordinate is that is small, in rad or m."""

_WORDS: dict[str, Callable[[Family], Family]] = {
    "at rest": lambda f: replace(f, at_rest=True),
    "at the start": lambda f: replace(f, at_start=True),
    "the start is at rest": lambda f: replace(f, since="rest"),
    "from the start": lambda f: replace(f, since="start"),
    "without gravity": lambda f: replace(f, gravity=False),
    "with these numbers": lambda f: replace(f, numbers=True, zeros=False),
}
_RELEASED = re.compile(r"(?:it |the motion )?(?:(?:is )?(?:released|started|starting|starts|begins) (?:from|at) rest|from rest)")
_INFINITE = ("inf", "infinity", "∞", "oo")


def family(text: str, sampler: MotionSampler, letters: Callable[[dict[str, str]], Letters], given: Family = ALL) -> Family:
    """The motions of which a hypothesis is true: parts with commas or ``and`` between them, each ``at rest``, ``at the start``,
    ``without gravity``, ``with these numbers``, ``p = value``, ``expression = value``, ``p -> inf`` or ``p -> 0``.

    ``letters`` are those of the statement with some more declared. Raises ``ModelProblem``.
    """
    parts = [part.strip() for part in re.split(r",|\band\b", text) if part.strip()]
    if not parts:
        raise ModelProblem("the hypothesis is empty", f"write one, like `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(_WORDS)}")
    for part in parts:
        given = _part(part, sampler, letters, given)
    return given


def _part(part: str, sampler: MotionSampler, letters: Callable[[dict[str, str]], Letters], given: Family) -> Family:
    if _RELEASED.fullmatch(part):
        part = "the start is at rest"
    if part in _WORDS:
        return _WORDS[part](given)
    if found := re.fullmatch(r"(\S+)\s*(?:->|→)\s*(\S+)", part):
        return limit(found[1], found[2], sampler, letters, given)
    if part.count("=") != 1:
        raise ModelProblem(f"`{part}` is no hypothesis", f"write `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(_WORDS)}")
    left, right = (side.strip() for side in part.split("="))
    name = parameter(left, sampler, letters)
    if name is not None:
        text = letters({"hypothesis": right}).meanings["hypothesis"].texts[0]
        return replace(given, held=(*given.held, (name, text)))
    zero = letters({"hypothesis": f"({left}) - ({right})"}).meanings["hypothesis"].texts[0]
    return replace(given, vanishing=(*given.vanishing, zero))


def limit(name: str, value: str, sampler: MotionSampler, letters: Callable[[dict[str, str]], Letters], given: Family) -> Family:
    """A parameter that goes to infinity or to 0; 0 itself where the model can have it; or a coordinate that stays near a
    value (``theta -> 0``: small motions, to first order). Raises ``ModelProblem``."""
    found = parameter(name, sampler, letters)
    if found is None and value not in _INFINITE:
        text = letters({"hypothesis": f"({name}) - ({value})"}).meanings["hypothesis"].texts[0]
        return replace(given, small=(*given.small, (text, SMALL)))
    if found is None or value not in ("0", *_INFINITE):
        raise ModelProblem(f"`{name} → {value}` is no limit that can be taken", "a free parameter goes to `inf` or to `0`")
    if value == "0":
        zero = replace(given, held=(*given.held, (found, 0.0)))
        if sampler.has(zero):
            return zero
    return replace(given, scaled=(*given.scaled, (found, FAR if value != "0" else 1 / FAR)))


def parameter(name: str, sampler: MotionSampler, letters: Callable[[dict[str, str]], Letters]) -> str | None:
    """The free parameter of the model that a letter stands for, or None."""
    meaning = letters({}).meanings.get(name)
    texts = (name,) if meaning is None else meaning.texts
    return texts[0] if len(texts) == 1 and texts[0] in sampler.free_parameters else None

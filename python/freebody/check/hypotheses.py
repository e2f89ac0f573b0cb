"""What a hypothesis says in words: the motions of which a statement is made."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import ModelError, MotionError
from freebody.model.errors import ModelProblem
from freebody.model.names import spell
from freebody.solve.perturbed_states import independent
from freebody.symbolic.dimensions import ANGLE
from freebody.symbolic.errors import StatementError

from .families import Family
from .user_symbols import OF_TIME

if TYPE_CHECKING:
    from .api import Checker, Declared

FAR = 1e7, 1e5, 1e3
"""How far a parameter goes that goes to infinity (its inverse: to 0): as far as closed loops still close to round-off."""

LATE = 1e3
"""How many times the time typical of a model a motion lasts whose end is asked for: what dies away has done so to round-off."""

SMALL = 1e-3
"""How small a coordinate is that is small, in rad or typical lengths of the model."""

WORDS: dict[str, dict[str, Any]] = {
    "at rest": {"at_rest": True},
    "at the start": {"at_start": True},
    "the start is at rest": {"since": "rest"},
    "from the start": {"since": "start"},
    "without gravity": {"gravity": False},
    "in the steady state": {"steady": True},
    "with these numbers": {"numbers": True, "zeros": False},
}
"""Hypotheses that are said in words alone."""
_MORE = (">", "≥", ">=")
_ABOVE = re.compile(r"([^=<>≤≥]+)(>=?|<=?|[≤≥])([^=<>≤≥]+)")
_SQUARE = re.compile(r"(\S+?)\s*(?:²|\^\{?2\}?)")
_OTHER_THAN = re.compile(r"([^=<>≤≥≠]+)(?:≠|\\neq?(?![a-z])|!=)([^=<>≤≥≠]+)")
_STILL = re.compile(r"(?:\\d?dot\s*\{?\s*\\?\w+\s*\}?|[^\W\d]\w*(?:['′″]+|[\u0307\u0308]\w*))\s*=\s*0")
"""``x'' = 0``, which is so in equilibrium."""
_NO_FORCE = re.compile(r"\(+([\w ]+)\.N\)+ - \(?0\)?")
_ABOUT = re.compile(r".*\babout\s+(.+?)\s*(?:->|→)\s*0")
"""What is small about a place in words: ``oscillations about the top -> 0``."""
_WORDS_ALONE = re.compile(r"(?:an?|the)\s+[a-z]+(?:[\s-]+[a-z]+)*")
SMALL_MOTIONS = "small motions"
"""About where the model swings, or where all coordinates are 0."""
IN_EQUILIBRIUM = "in equilibrium"
AT_CONSTANT_SPEED = "at constant speed"
_INFINITE = ("inf", "infinity", "∞", "oo")
_HELD = 1e-9  # of the rates that can be given at will, below which a coordinate has none


def family(text: str, checker: Checker, declared: Declared) -> Family:
    """The motions of which a hypothesis is true: parts with commas or ``and`` between them, each ``at rest``, ``at the start``,
    ``without gravity``, ``with these numbers``, ``p = value``, ``expression = value``, ``p -> inf`` or ``p -> 0``.

    ``declared`` are symbols of the statement's own. Raises ``ModelProblem``.
    """
    parts = [part.strip() for part in re.split(r",|\band\b", text) if part.strip()]
    if not parts:
        raise ModelProblem("the hypothesis is empty", f"write one, like `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(WORDS)}")
    if any("=" in part for part in parts):  # for a solid disk, k² = ½ R²: less is taken for granted without the words
        known = {*WORDS, SMALL_MOTIONS, IN_EQUILIBRIUM, AT_CONSTANT_SPEED}
        parts = [part for part in parts if part in known or not _WORDS_ALONE.fullmatch(part)]
    each = [one for part in parts for one in _each(part)]
    if IN_EQUILIBRIUM in each:  # at the place that is said
        each = [*(one for one in each if one != IN_EQUILIBRIUM and not _STILL.fullmatch(one)), IN_EQUILIBRIUM]
    return reduce(lambda given, part: _also(given, part, checker, declared), each, checker.hypothesis)


def _each(part: str) -> list[str]:
    """The equations of a chain: ``a = b = 0``."""
    *sides, last = re.split(r"(?<![<>:])=", part)
    return [f"{side.strip()} = {last.strip()}" for side in sides] or [part]


def _also(given: Family, part: str, checker: Checker, declared: Declared) -> Family:
    """Those of some motions of which a part is true, too."""
    if part == SMALL_MOTIONS:
        rest = checker.vibration.rest
        places = rest.q if rest else np.zeros(len(checker.sampler.names))
        model = checker.sampler
        rates = model.rates_free_in(model.core.free_bodies(rest)) if rest else model.free_rates
        # What is prescribed, or moves to second order alone, cannot be small.
        free = np.abs(rates).max(axis=1, initial=0.0) > _HELD
        named = zip(checker.sampler.names, places.tolist(), free, strict=True)
        near = tuple((f"({spell(name)}) - ({q!r})", SMALL) for name, q, moves in named if moves)
        return replace(given, small=(*given.small, *near))
    if part in (IN_EQUILIBRIUM, AT_CONSTANT_SPEED):
        names = checker.sampler.names
        if part == IN_EQUILIBRIUM:  # at rest the others follow
            names = [names[i] for i in independent(checker.sampler.free_rates)]
        still = (f"accel({spell(name)})" for name in names)
        rests = part == IN_EQUILIBRIUM
        vanishing = (*given.vanishing, *still)
        return replace(given, at_rest=given.at_rest or rests, near=given.near or rests, vanishing=vanishing)
    if part in WORDS:
        return replace(given, **WORDS[part])
    if lost := {"without damping": checker.sampler.dampings, "without friction": checker.sampler.frictions}.get(part):
        return replace(given, held=(*given.held, *((name, 0.0) for name in lost)))
    if found := re.fullmatch(r"(\S+)\s*(?:->|→)\s*(.+)", part):
        return _with_limit(given, found[1], found[2], checker, declared)
    if found := _ABOUT.fullmatch(part):
        raise ModelProblem(
            f"`{found[1]}` is no place that is known", "say it by a coordinate, like `small oscillations about θ = 180°`"
        )
    if found := _OTHER_THAN.fullmatch(part):
        return replace(given, above=(*given.above, f"abs({_meant(f'({found[1]}) - ({found[2]})', checker, declared)}) - {SMALL}"))
    if found := _ABOVE.fullmatch(part):
        more, less = (found[1], found[3]) if found[2] in _MORE else (found[3], found[1])
        above = _meant(f"({more}) - ({less})", checker, declared)
        return replace(given, above=(*given.above, above), since=given.since or ("start" if OF_TIME.search(above) else ""))
    if part.count("=") != 1:
        raise ModelProblem(f"`{part}` is no hypothesis", f"write `m1 = 2*m2`, `M -> inf`, or one of: {', '.join(WORDS)}")
    left, right = (side.strip() for side in part.split("="))
    if (square := _SQUARE.fullmatch(left)) and free_parameter(square[1], checker, declared):
        left, right = square[1], f"sqrt({right})"
    if (name := free_parameter(left, checker, declared)) is not None and not _moves(
        value := _meant(right, checker, declared), checker
    ):
        return replace(given, held=(*given.held, (name, value)))
    vanishing = _meant(f"({left}) - ({right})", checker, declared)
    if found := _NO_FORCE.fullmatch(vanishing):
        checker.sampler.require_touch([found[1]])
    # A whole turn makes no difference.
    if _are_moving_angles(left, right, checker, declared) or _goes_round(left, checker, declared):
        vanishing = f"sin(({vanishing})/2)"
    asks_past = "⟦" in vanishing or OF_TIME.search(vanishing)
    since = given.since or ("start" if asks_past else "")
    return replace(given, vanishing=(*given.vanishing, vanishing), since=since)


def _are_moving_angles(left: str, right: str, checker: Checker, declared: Declared) -> bool:
    """Whether two sides are angles that both change as the model moves."""
    with suppress(ModelProblem, StatementError):
        moving = all(_moves(_meant(side, checker, declared), checker) for side in (left, right))
        return moving and checker.symbols(declared).measured(left)[1] == ANGLE
    return False


def _goes_round(side: str, checker: Checker, declared: Declared) -> bool:
    """Whether a side is an angle that is driven."""
    driven = {spell(motion["of"]) for motion in checker.sampler.spec["motions"]}
    with suppress(ModelProblem, StatementError):
        return _meant(side, checker, declared).strip("()") in driven and checker.symbols(declared).measured(side)[1] == ANGLE
    return False


def _moves(text: str, checker: Checker) -> bool:
    """Whether an expression changes as the model moves."""
    with suppress(ModelError, MotionError):
        return bool(
            checker.sampler.core.derivatives([text], checker.sampler.own)[0, 1 : 1 + 2 * len(checker.sampler.names)].any()
        )
    return False


def _with_limit(given: Family, name: str, value: str, checker: Checker, declared: Declared) -> Family:
    """A parameter that goes to infinity or to 0; 0 itself where the model can have it; or a coordinate that stays near a
    value (``theta -> 0``: small motions, to first order)."""
    if name == "t" and value in _INFINITE:
        return replace(given, since="start", late=LATE)
    found = free_parameter(name, checker, declared)
    if found is None and value not in _INFINITE:
        return replace(given, small=(*given.small, (_meant(f"({name}) - ({value})", checker, declared), SMALL)))
    if found is None:
        raise ModelProblem(
            f"`{name} → {value}` is no limit that can be taken", "a free parameter goes to `inf`, to `0` or a value"
        )
    if value not in ("0", *_INFINITE):
        return replace(given, held=(*given.held, (found, _meant(value, checker, declared))))
    zero = replace(given, held=(*given.held, (found, 0.0)))
    if value == "0" and checker.sampler.has(zero):
        return zero
    powers = (far if value != "0" else 1 / far for far in FAR)
    scaled = [replace(given, scaled=(*given.scaled, (found, power))) for power in powers]
    return next(filter(checker.sampler.has, scaled), scaled[0])


def _meant(expression: str, checker: Checker, declared: Declared) -> str:
    """An expression of the statement's symbols in the model language, read as a statement is: 2L is no volume where L is a length."""
    try:
        return checker.symbols(declared).expression(expression)
    except (StatementError, ModelProblem) as error:
        try:
            return checker.symbols({**declared, "hypothesis": expression}).meanings["hypothesis"].texts[0]
        except ModelProblem as problem:
            if isinstance(error, StatementError) and "has no meaning" in error.what:
                raise ModelProblem(error.what, error.hint) from None
            raise problem from None


def free_parameter(name: str, checker: Checker, declared: Declared) -> str | None:
    """The free parameter of the model that a symbol stands for, or None."""
    known = checker.symbols(declared)
    found = known.meanings.get(name) or known.spelt(name)
    texts = found.texts if found else (name,)
    return texts[0] if len(texts) == 1 and texts[0] in checker.sampler.free_parameters else None

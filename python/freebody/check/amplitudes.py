"""Amplitudes: half of what something goes to and fro, in the steady state of what is driven, else on the motion from the start."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded

from .hypotheses import SMALL_MOTIONS
from .user_symbols import AMPLITUDE, LAG
from .usual_names import ENERGIES
from .verdict import NO_AMPLITUDE, Kind

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .verdict import Verdict

_SYMBOL = r"\\?[^\W\d]\w*'*(?:_\{\w+\})?"
_SAID = re.compile(
    r"(?P<before>[^=:]*?)\b(?:steady[\s-](?:state[\s-])?|forced\s+)?amplitudes?\b(?:\s+of\s+(?:the\s+)?(?:(?:steady|forced)\s+)?"
    rf"(?:(?P<what>{_SYMBOL})(?![\w-])|[a-z]+(?:\s+of\s+(?:the\s+)?\w+)?))?(?P<after>[^=:]*?)(?:\s+is\s|\s*[:=,])\s*(?P<rest>\S.*)",
    re.S,
)
"""``steady-state amplitude of x: X = …``."""
_IS = re.compile(rf"({_SYMBOL})\s*=(?!=)\s*(.+)", re.S)
_LIMIT = re.compile(r"limit: ?(.+) as ([^:]+)", re.S)
_REPEATS = "in the steady state"
_STEADY = re.compile(rf"if ([^:]*\b{_REPEATS}\b[^:]*): ?([^:]+)", re.S)
_MOST = re.compile(r"([^\W\d]\w*?)_\{?(?:\\(?:text|mathrm|operatorname)?\{?)?max\b")
_TANGENT = re.compile(rf"(?<![^\W_])\\?tan(?![A-Za-z])\s*(?:\\left\s*)?[({{]?\s*({_SYMBOL})")
_NAME = "amp"
"""What it is called that has no letter of its own."""
_WORDS = re.compile(r"\s*(?:(?:in|for|the|its|resulting|steady|state|motion|vibrations?|oscillations?)\b[\s,]*)*")


def of_amplitudes(checker: Checker, declared: Declared, claim: str) -> Verdict | None:
    """The verdict about a claim that speaks of amplitudes, in words or by capitals in a steady state, ``X`` of ``x``; None where it
    does not."""
    limited = _LIMIT.fullmatch(claim)
    if said := _SAID.fullmatch(limited[1] if limited else claim):
        before = re.sub(r"\A\s*if\s+|[\s:,]+\Z", "", said["before"])
        if not _WORDS.fullmatch(said["after"]) or not (_WORDS.fullmatch(before) or claim.startswith("if ")):
            return None
        rest, *names = re.split(r",?\s+(?:where|with)\s+", said["rest"].rstrip(" ,"), maxsplit=1)
        found = _IS.fullmatch(rest)
        letter, value = (found[1], found[2]) if found and "=" not in found[2] else ("", rest)
        if (what := _of(checker, declared, said["what"], letter)) is None:
            return None
        given = {**declared, (letter or _NAME): f"{AMPLITUDE}{what}"}
        statement = f"{letter or _NAME} = {value}{''.join(f' where {each}' for each in names)}"
        if limited:
            return _in_limit(checker, given, limited[2], statement)
        return _judged(checker, given, "" if _WORDS.fullmatch(before) else before, statement)
    steady = _STEADY.fullmatch(claim)
    if not steady and not (limited and _REPEATS in limited[2]):
        return None
    conditions, statement = (steady[1], steady[2]) if steady else (limited[2], limited[1])
    if lag := _lag(checker, declared, statement):
        letter, of = lag
        limits = conditions.replace(SMALL_MOTIONS, f"{of} -> 0") if limited else f"{_REPEATS}, {of} -> 0"
        with suppress(StatementError, ModelProblem):  # of other letters, too
            return checker.check(f"limit: {statement} as {limits}", {**declared, letter: f"{LAG}{of}"})
    named = _capitals(checker, declared, statement) | ({} if steady else _most(checker, declared, statement))
    given = {**declared, **{name: f"{AMPLITUDE}{of}" for name, of in named.items()}}
    return (_judged if steady else _in_limit)(checker, given, conditions, statement) if named else None


def _judged(checker: Checker, declared: Declared, conditions: str, statement: str) -> Verdict:
    """Of the steady state where that is said or something drives the model."""
    steady = _REPEATS in conditions or checker.sampler.is_driven
    under = ", ".join(filter(None, (_REPEATS if steady else "from the start", conditions.replace(_REPEATS, "").strip(" ,"))))
    return _sized(checker, declared, lambda said: f"if {under}: {said}", statement)


def _in_limit(checker: Checker, declared: Declared, limits: str, statement: str) -> Verdict:
    """The same of small motions, or where something goes to 0; not decidable where they are not found to go to and fro."""
    steady = f"{_REPEATS}, " if checker.sampler.is_driven and _REPEATS not in limits else ""
    of = (said.removeprefix(AMPLITUDE) for said in declared.values() if isinstance(said, str) and said.startswith(AMPLITUDE))
    small = limits.replace(SMALL_MOTIONS, ", ".join(f"{each} -> 0" for each in of))
    verdict = _sized(checker, declared, lambda said: f"limit: {said} as {steady}{small}", statement)
    return replace(verdict, reason=NO_AMPLITUDE) if verdict.kind is Kind.UNDECIDABLE else verdict


def _sized(checker: Checker, declared: Declared, claim: Callable[[str], str], statement: str) -> Verdict:
    """Of amplitudes the size is judged: a sign says how they follow what drives."""
    verdict = checker.check(claim(statement), declared)
    said, *names = re.split(r"(?=\swhere\s)", statement, maxsplit=1)
    sides = said.split("=")
    if verdict.ok or len(sides) != 2:
        return verdict
    sized = checker.check(claim(f"abs({sides[0]}) = abs({sides[1]}){''.join(names)}"), declared, correcting=False)
    return replace(sized, text=verdict.text) if sized.ok else verdict


def _of(checker: Checker, declared: Declared, what: str | None, letter: str) -> str | None:
    """Of which quantity an amplitude is; None where that is not clear."""
    meaning = checker.symbols(declared).spelt(what) if what else None
    if meaning or (what and not what.islower()):
        return meaning.texts[0] if meaning else None
    found = _capitals(checker, declared, letter)
    if letter in found:
        return found[letter]
    names = checker.sampler.names
    return names[0] if len(names) == 1 else None


def _capitals(checker: Checker, declared: Declared, statement: str) -> dict[str, str]:
    """The capitals in a statement without a meaning of their own, with the quantities whose small letters they are."""
    known = checker.symbols(declared)
    found = {}
    for name in dict.fromkeys(re.findall(_SYMBOL, statement)):
        small = name.lower()
        is_new = name != small and name not in ENERGIES and known.spelt(name) is None
        meaning = known.spelt(small) if is_new else None
        if meaning and meaning.kind in ("coordinate", "gauge", "declared"):
            found[name.removeprefix("\\")] = meaning.texts[0]
    return found


def _lag(checker: Checker, declared: Declared, statement: str) -> tuple[str, str] | None:
    """The letter without a meaning of its own of which a tangent is taken: the angle, rad, by which the only coordinate that is free lags
    behind what drives it; with that coordinate."""
    known, prescribed = checker.symbols(declared), {motion["of"] for motion in checker.sampler.spec["motions"]}
    names = [name for name in checker.sampler.names if name not in prescribed]
    found = {folded(name): name for name in _TANGENT.findall(statement) if known.spelt(name) is None}
    if len(names) != 1 or len(found) != 1 or not checker.vibration.drive:
        return None
    (letter,) = found.values()
    return letter.removeprefix("\\"), names[0]


def _most(checker: Checker, declared: Declared, statement: str) -> dict[str, str]:
    """The names ``x_max`` in a statement, with the coordinates of which they are."""
    known, found = checker.symbols(declared), {}
    for name in set(_MOST.findall(statement)):
        meaning = known.spelt(name)
        if meaning and meaning.kind == "coordinate" and f"{name}_max" not in declared:
            found[f"{name}_max"] = meaning.texts[0]
    return found

"""Claims about two moments of a motion: what changes between them, from a moment 1 to a moment 2, across an impact."""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError

from .language.spelling import spell
from .language.statements import terms
from .verdict import Verdict

if TYPE_CHECKING:
    from .api import Checker, Declared
    from .symbols import Symbols


def changes(checker: Checker, declared: Declared, left: str, right: str) -> Verdict:
    """``ΔT + ΔV = 0``: a sum that stays the same, each term of it a change."""
    alone = _CHANGED.fullmatch(left.strip()) and not _CHANGE.search(right) and right.strip() != "0"
    if alone or "∫" in left + right or r"\int" in left + right:
        since = (_CHANGED.sub(r"(\1 - \1(0))", side) for side in (left, right))
        return checker.check(" = ".join(since), declared)
    case = checker.case(f"({_CHANGE.sub('', left)}) - ({_CHANGE.sub('', right)}) = 0", declared)
    (equation,), found = case.equations, _CHANGE.findall(left + right)
    if len(terms(equation)) != len(found):
        what = "a change stands beside what is none"
        raise ModelProblem(what, "write `Δ` before each term, or the work of a force by its name, like `motor.work`")
    return checker.check(f"constant: {spell(equation.left)}", declared, correcting=checker.correcting)


def between(checker: Checker, declared: Declared, label: str, statement: str) -> Verdict:
    """From a moment 1 to a moment 2, ``J (ω₂ − ω₁) = M (t₂ − t₁)``: the first is the start, the second any time; letters with these
    indices of the model or the person are what they are."""
    since = replace(checker.hypothesis, since=checker.hypothesis.since or "start")
    verdict = checker.check(_since_start(checker, declared, statement), declared, since)
    return replace(verdict, notes=(*verdict.notes, f"`{label}` is read as from the start to any time."))


def between_places(checker: Checker, declared: Declared, name: str, first: str, last: str, statement: str) -> Verdict:
    """From one place to another, ``from θ = 0 to θ = 90°: ½ I (ω₂² − ω₁²) = m g d``: of a motion that begins at the first."""
    said = _since_start(checker, declared, statement)
    return checker.check(f"if {name}_0 = {first}, {name} = {last}, from the start: {said}", declared)


def _since_start(checker: Checker, declared: Declared, statement: str) -> str:
    """A statement in which what has the index of the first of two moments is asked of the start."""
    known = checker.symbols(declared)

    def at_moment(found: re.Match[str]) -> str:
        letter, index, is_known = _letter(known, found)
        if is_known:
            return found[0]
        return f"{found[1] or ''}{letter}{found[3]}{found[6]}{'(0)' * (index == '1')}"

    return _INDEXED.sub(at_moment, statement)


def across_impact(checker: Checker, declared: Declared, label: str, statement: str) -> Verdict | None:
    """``stroke: Δ[J θ' + I φ'] = 0``, ``impact: v_2 = -e v_1``: just before and just after the only thing that there are impacts at; None
    where no letter is of these moments."""
    happening = checker.happens.jump(label)
    if re.search(r"Δ|\\Delta|[12₁₂⁺⁻]|\^\{?[-−+]", statement) is None or happening is None:
        return None
    known, letters = checker.symbols(declared), dict[str, str]()

    def beside(said: str, name: str, index: str) -> str:
        letters[f"{name}_{index}"] = f"{known.expression(said)} @ {'before ' * (index == '1')}{happening}"
        return f"{name}_{index}"

    def change(found: re.Match[str]) -> str:
        name = f"S{chr(97 + len(letters) // 2)}"
        return f"({beside(found[1] or found[2], name, '2')} - {beside(found[1] or found[2], name, '1')})"

    def at_moment(found: re.Match[str]) -> str:
        letter, index, is_known = _letter(known, found)
        if is_known:
            return found[0]
        primes = found[3] + found[6] + "}" * ((found[1] or "").count("{") - found[3].count("}"))
        dotted = f"{found[1] or ''}{letter}{primes}"
        name = re.sub(r"\\(?:var)?", "", letter) + "dot" * (re.search("dot|'", dotted) is not None)
        return f" {beside(dotted, name, index)} "

    def signed(found: re.Match[str]) -> str:
        letter = re.sub(r"\\(?:var)?(?!d*dot)|\\d*dot|[\W_]", "", found[1])
        is_after, dot = re.search("[+⁺]", found[2]) is not None, "dot" * (re.search("dot|'|\u0307", found[1]) is not None)
        name = f"{letter}{dot}_{'after' if is_after else 'before'}".translate(_FIGURES)
        letters[name] = f"{known.expression(found[1])} @ {'' if is_after else 'before '}{happening}"
        return f" {name} "

    with suppress(StatementError, ModelProblem):
        said = _DELTA.sub(change, _SIGNED.sub(signed, _INDEXED.sub(at_moment, statement)))
        if letters:
            verdict = checker.check(said, {**declared, **letters}, correcting=checker.correcting)
            read = f"`{label}` is read as the impact at {happening}, 1 or ⁻ as just before it and 2 or ⁺ as just after it."
            return replace(verdict, notes=(*verdict.notes, read))
    return None


def _letter(known: Symbols, found: re.Match[str]) -> tuple[str, str, bool]:
    """A letter without the index of a moment, that index, and whether with it the letter has a meaning of its own."""
    letter, index = f"{found[2]}{f'_{found[4]}' * bool(found[4])}", "1" if found[5] in "1₁" else "2"
    return letter, index, known.spelt(f"{letter}{'' if found[4] else '_'}{index}") is not None


_FIGURES = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_SIGNED = re.compile(
    r"((?:\\d*dot\s*\{?\s*)?(?:\\[A-Za-z]+|[^\W\d_]\u0307*)(?:_\{\w+\}|_?\w)?'*\}?)\s*([⁺⁻]|\^(?:\{[-−+]\}|[-−+](?=\s*(?:[-=+−*/·),^]|\Z|\s[^\W\d]))))"
)
"""``v⁻`` and ``v_1^+``: just before and just after."""
_CHANGE = re.compile(r"(?:Δ|\\Delta)\s*(?=\w|\\)")
"""The change of something since the start."""
_CHANGED = re.compile(r"(?:Δ|\\Delta)\s*((?:\\[A-Za-z]+|[^\W\d_])(?:_\{\w+\}|_?\w+)?)")
_DELTA = re.compile(
    r"(?:Δ|\\Delta)\s*(?:(?:\\left)?[\[(]((?:[^()\[\]]|[(\[][^()\[\]]*[)\]])*)(?:\\right)?[)\]]|((?:\\[A-Za-z]+|[^\W\d_])(?:_\{\w+\}|_?\w+)?'*))"
)
_STATE = r"(?:(?:the\s+)?(?:time|instant|moment|state|position|place|point)s?\s+)?\$?(?:t\s*=\s*)?(?:t_?)?\{?"
BETWEEN = rf"(?:[^:=]*[,\s])?((?:from|between)\s+{_STATE}[1₁]\}}?\$?\s+(?:to|and)\s+{_STATE}[2₂]\}}?\$?)\s*"
"""``rear wheel, from t₁ to t₂``, ``between the states 1 and 2``."""
PLACES = r"(?:[^:=]*,\s*)?(?:from|between)\s+\$?([^\s:=]+)\s*=\s*([^:=]+?)\$?\s+(?:to|and)\s+\$?(?:\1\s*=\s*)?([^:=,]+?)\$?\s*"
"""``from θ = 0 to θ = 90°``."""
_INDEXED = re.compile(r"(\\d*dot\s*\{?\s*)?(\\[A-Za-z]+|[^\W\d_]\u0307*)('*\}?)_?\{?([A-Za-z]*)([12₁₂])(?![A-Za-z0-9{])\}?('*)")
"""A letter with its dots and the index of a moment, behind another that it may have: ``v_{y1}``."""

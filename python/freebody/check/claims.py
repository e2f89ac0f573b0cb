"""Claims that are more than an equation: constants, limits, figures at a moment, consequences, and what holds only if."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.model.errors import ModelProblem
from freebody.run.records import Array
from freebody.solve.perturbed_states import independent
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import sampled
from freebody.symbolic.tree import Sym

from . import timed_claims
from .amplitudes import of_amplitudes
from .case import Case
from .condition_edits import other_conditions
from .constant_claims import constant, reading
from .families import Samples
from .frequency_claims import frequencies
from .held import with_held
from .hypotheses import family
from .language.parser import parse_expression
from .language.spelling import spell
from .language.statements import Equation, symbols_in, terms
from .limit_claims import limit
from .phases import NOT_FIRST, phase, stretch_of
from .residual import jacobian, magnitude, residual
from .search import MOST
from .two_moments import BETWEEN, PLACES, across_impact, between, between_places, changes
from .verdict import Evidence, Kind, Verdict, evidence
from .worded_claims import beside_words, in_phase, in_words, labelled, on_later_stretch
from .wording import BLOW, as_claim, named, with_condition_first

if TYPE_CHECKING:
    from .api import Checker, Declared

_NEWTON = 20  # steps by which premises are made true
_FEWEST = 8  # places at which they have to be


def claimed(checker: Checker, text: str, declared: Declared) -> Verdict | None:
    """The verdict about a claim; None where the text is none of the forms. Raises ``StatementError`` and ``ModelProblem``."""
    given, claim = _defined(with_condition_first(text))
    if (found := _JUST.match(claim)) and (happening := checker.happens.only_one):
        claim = f"{found[1]} {happening}:{claim[found.end() :]}"
    claim = as_claim(claim)
    if found := of_amplitudes(checker, {**declared, **given}, claim):
        return found
    if (found := _AT_BLOW.match(claim)) and (
        verdict := across_impact(checker, {**declared, **given}, found[1].strip(), claim[found.end() :])
        or _after_blow(checker, {**declared, **given}, found[1].strip(), claim[found.end() :])
    ):
        return verdict
    label, colon, said = claim.partition(":")
    if colon and _SIGNED.search(said) and (verdict := across_impact(checker, {**declared, **given}, label.strip(), said)):
        return verdict
    forms = [form for form in _FORMS if form[1] is not changes or not _named_changes({**checker.declared, **declared}, claim)]
    for pattern, judge in forms:
        if found := pattern.fullmatch(claim):
            said = ((part or "").strip() for part in found.groups())
            return judge(checker, {**declared, **given}, *said)
    if colon and (stretch := stretch_of(checker, declared, [part.strip(_BESIDE_WORDS) for part in re.split("[,()]", label)])):
        return in_phase(checker, {**declared, **given}, *stretch, said)
    for word, form in _WHOLE.items():
        if re.match(rf"{word}\s*:", claim):
            raise ModelProblem(f"a part of this claim is missing: `{' '.join(claim.split())}`", f"write `{form}`")
    return None


def _after_blow(checker: Checker, declared: Declared, words: str, statement: str) -> Verdict | None:
    """Behind ``impact:`` with letters of no moment, what is so just after it, or nearly so; else None."""
    if checker.happens.only_impact is None or _BESIDE_BLOW.match(words) or NOT_FIRST.search(words):
        return None
    with suppress(ModelProblem, StatementError):
        after = checker.check(f"just after {checker.happens.only_impact}: {statement}", declared, correcting=checker.correcting)
        if (after.ok and not after.assumption) or after.mends:
            return replace(after, notes=(*after.notes, f"`{words}` is read as just after it."))
    return None


def _named_changes(declared: Declared, claim: str) -> bool:
    """Whether a letter of the writer's own begins as a change does: ΔE, the energy that is lost."""
    return any(name.startswith("Δ") and name in claim for name in declared)


def _defined(text: str) -> tuple[dict[str, str], str]:
    """The names that lines before a claim give, or words behind it (*where*), and the claim."""
    *before, last = re.split(r"\s*[;\n]\s*", text)
    claim, *after = re.split(r"\s+(?:where|with)\s+(?=[^:]*=[^:]*$)", last) if ":" in last else [last]
    said = [*before, *(line for part in after for line in re.split(r",(?![^()\[\]]*[)\]])|\band\b", part))]
    lines = [found for line in said if (found := _NAME.fullmatch(line))]
    if ":" not in last or not lines or len(lines) < len(said):
        return {}, text
    return dict(named(*found.groups()) for found in lines), claim


def _if(checker: Checker, declared: Declared, condition: str, statement: str) -> Verdict:
    """Under a hypothesis."""
    letters, condition = _letters_of(checker, declared, condition)
    declared = {**declared, **letters}
    if letters and not condition:
        return checker.check(statement, declared, correcting=checker.correcting)
    if found := with_held(checker, declared, condition):
        there, others, read = found
        claim = f"if {others}: {statement}" if others else statement
        verdict = there.check(claim, declared, correcting=checker.correcting)
        # what moves at the start is not held there, but may stand still later
        stands = phase(checker, _IS_HELD.sub("stands still", f"while {condition}")) if verdict.of_no_motion else None
        if stands is None:
            return replace(verdict, notes=(*verdict.notes, read))
        return in_phase(checker, declared, stands, condition, claim)
    try:
        given = family(condition, checker, declared)
    except ModelProblem as problem:
        return in_words(checker, declared, condition, statement, problem)
    verdict = checker.check(statement, declared, given)
    if verdict.ok:
        return replace(verdict, assumption=condition)
    if given.above and verdict.kind is Kind.UNDECIDABLE and (found := on_later_stretch(checker, declared, condition, statement)):
        return found
    places = () if given.at_start else _PLACES.findall(condition)  # at the top (v = 0): of the motion that comes there
    if event := next((event for words in places if (event := checker.happens.event(words))), None):
        there = timed_claims.at(checker, declared, event, statement)
        if there.ok:
            return there
    if verdict.kind is Kind.WRONG and checker.correcting:
        mends = (*other_conditions(checker, declared, condition, statement), *verdict.mends)
        verdict = replace(verdict, mends=mends[:MOST])
    turns = any("rate(" in expression for expression in given.vanishing) and ":" not in statement
    if turns and {n.name for n in symbols_in(checker.case(statement, declared).program)} <= {*checker.mechanism.parameters}:
        reason = f"it is of parameters alone, and motions that come to `{condition}` were not looked for"
        return Verdict(Kind.UNDECIDABLE, statement, reason)
    if (
        verdict.kind is Kind.UNDECIDABLE
        and any(str(value) in _ZEROS for _, value in given.held)
        and not checker.sampler.has(given)
    ):
        return limit(checker, declared, statement, _TO_ZERO.sub(" -> 0", condition))  # without it there are no motions
    release = replace(given, since="", at_start=True, at_rest=given.since == "rest")
    others = [(release, condition)] if given.since == "rest" else []
    later = (
        places
        or verdict.kind is Kind.UNDECIDABLE
        or _is_of_start(checker, declared, statement)
        or _OF_RATES.search("".join(given.vanishing)) is not None
    )
    if given.near and verdict.kind is Kind.UNDECIDABLE:
        others.append((replace(given, near=False), condition))
    if given.vanishing and later:  # it may be so only where something switches, or has done so
        others += [(replace(given, since="start", through=through), condition) for through in (bool(given.since), True)]
    elif given.since and not others:
        return verdict
    elif given.at_rest and "at rest" in condition and _is_of_places(checker, declared, statement):
        others = [(family(rest := condition.replace("at rest", "in equilibrium"), checker, declared), rest)]
    for other, words in others:
        found = checker.check(statement, declared, other, correcting=not verdict.mends)
        if found.ok and (other is not release or (found.evidence and not found.untested)):  # what is 0 at once says nothing
            return replace(found, assumption=words)
        if found.kind is verdict.kind and found.mends and not verdict.mends:
            verdict = replace(verdict, mends=found.mends)
        if verdict.kind is Kind.UNDECIDABLE is not found.kind or (
            found.kind is Kind.UNDECIDABLE and _is_of_start(checker, declared, statement)
        ):
            verdict = found
    return verdict


def _is_of_start(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether it speaks of motions from the start alone, so that no others break it."""
    with suppress(StatementError):
        case = checker.case(statement, declared)
        return any(map(case.meaning.speaks_of_start, case.equations))
    return False


def _letters_of(checker: Checker, declared: Declared, condition: str) -> tuple[dict[str, str], str]:
    """The letters of the writer's own that a condition gives, ``u = x' cos ψ``, ``φ' = Ω``, and what it says beside."""
    found, rest = {}, []
    for part in condition.split(","):
        said = _NAME.fullmatch(part)
        sides = [side.strip() for side in said.groups()] if said else []
        ways = zip(sides, reversed(sides), strict=True)
        new = next((way for way in ways if way[0].isidentifier() and not _has_meaning(checker, declared, way[0])), None)
        found |= dict([new]) if new else {}
        rest += [] if new else [part]
    return found, ",".join(rest).strip()


def _has_meaning(checker: Checker, declared: Declared, name: str) -> bool:
    """Whether a symbol has one in the model, or by what it usually is."""
    try:
        known = checker.symbols(declared)
        if not isinstance(parse_expression(name, known.names), Sym):  # π is a number
            return True
        return bool((program := known.read(f"{name} = 0")).equations and known.require(program))
    except StatementError:
        return False


def _at(checker: Checker, declared: Declared, moment: str, statement: str) -> Verdict:
    """At a moment of the model's own run."""
    try:
        checker.happens.moment(moment)
    except ModelProblem as problem:
        return labelled(checker, declared, moment, statement, problem)
    return timed_claims.at(checker, declared, moment, statement)


def _is_of_places(checker: Checker, declared: Declared, statement: str) -> bool:
    """Whether equations are of the configuration alone."""
    with suppress(StatementError):
        case = checker.case(statement, declared)
        known, used = case.meaning.vocabulary, symbols_in(case.program)
        return not any(n.dots or n in known.others for n in used) and any(n in known.coordinates for n in used)
    return False


def _only_if(checker: Checker, declared: Declared, condition: str, statement: str) -> Verdict:
    """True under a hypothesis, and broken by an example without it."""
    under = _if(checker, declared, condition, statement)
    if not under.ok:
        return under
    always = checker.check(statement, declared, correcting=False)
    if always.ok and not always.assumption:
        return replace(always, kind=Kind.WRONG, reason=f"it holds without `{condition}`, too")
    reason = f"holds where {condition}; broken without it"
    return Verdict(Kind.TRUE, statement, reason, condition, evidence=always.evidence)


def _independent(checker: Checker, declared: Declared, names: str, expression: str) -> Verdict:
    """The value of an expression, when some coordinates or rates are changed and all else stays."""
    case = reading(checker, declared, expression)
    node, values = case.equations[0].left, case.values()
    before, size = sampled(node, values), magnitude(node, values)
    for name, moved in _changed_alone(checker, declared, names, case):
        after = sampled(node, moved)
        change = np.abs(after - before) / np.maximum(size, 1e-300)
        if change.max() > 1e-8:
            k = int(np.argmax(change.reshape(len(change), -1).max(axis=1)))
            seen = Evidence({name: "changed alone"}, before[k].tolist(), after[k].tolist(), float(change.max()), len(change))
            return Verdict(Kind.WRONG, expression, f"it depends on {name}", evidence=seen)
    return Verdict(Kind.TRUE, expression, f"unchanged when {names} change alone, on {len(before)} motions")


def _coefficients(checker: Checker, declared: Declared, names: str, unknowns: str, statement: str) -> Verdict:
    """The factors of unknowns in equations, when some coordinates or rates are changed and all else stays."""
    case, known = checker.case(statement, declared), checker.symbols(declared).names
    wanted = [n for name in unknowns.split(",") if isinstance(n := parse_expression(name.strip(), known), Sym)]
    if not (wanted := [n for n in wanted if n.key in case.values()]):
        raise ModelProblem(f"`{unknowns}` has no factor: it stands in none of these equations", "name symbols that are in them")

    def factors(equation: Equation, values: Mapping[str, Array]) -> Array:
        """What stands before each unknown, (K, rows, unknowns)."""
        keys = [n.key for n in wanted]
        return jacobian([equation], {**values, **{key: np.zeros_like(values[key]) for key in keys}}, keys)[1]

    before = [factors(equation, case.values()) for equation in case.equations]
    for name, values in _changed_alone(checker, declared, names, case):
        for number, (equation, earlier) in enumerate(zip(case.equations, before, strict=True), 1):
            change = np.abs(factors(equation, values) - earlier).max(axis=(0, 1))
            if change.max() > 1e-7 * np.abs(earlier).max():
                place = f"the factor of {spell(wanted[int(np.argmax(change))])} in equation {number}"
                return Verdict(Kind.WRONG, statement, f"{place} depends on {name}")
    stated = f"no factor of {unknowns} in {len(before)} equations changes with {names}, on {len(case.samples().states)} motions"
    return Verdict(Kind.TRUE, statement, stated)


def _shorter(checker: Checker, declared: Declared, statement: str, other: str) -> Verdict:
    """True equations with fewer terms than others that are true, brackets multiplied out."""
    counts = []
    for text in (statement, other):
        verdict = checker.check(text, declared)
        if not verdict.ok:
            kind = verdict.kind if verdict.kind is Kind.UNDECIDABLE else Kind.WRONG
            return Verdict(kind, statement, f"`{text}`: {verdict.kind.value}", evidence=verdict.evidence)
        counts.append(sum(len(terms(equation, expand=True)) for equation in checker.case(text, declared).equations))
    stated = f"{counts[0]} terms against {counts[1]}, brackets multiplied out; all these equations are true"
    return Verdict(Kind.TRUE if counts[0] < counts[1] else Kind.WRONG, statement, stated)


def _changed_alone(checker: Checker, declared: Declared, names: str, case: Case) -> Iterator[tuple[str, Mapping[str, Array]]]:
    """Each coordinate or rate by its name, with the values of all symbols when it alone has changed."""
    sampler, known = checker.sampler, checker.symbols(declared).names
    for name in (part.strip() for part in names.split(",")):
        symbol = parse_expression(name, known)
        if not isinstance(symbol, Sym) or symbol.name not in sampler.names or symbol.dots > 1 or sampler.loops:
            raise ModelProblem(f"`{getattr(symbol, 'key', symbol)}` cannot be changed alone", "name a coordinate or its rate")
        step = (sampler.rate if symbol.dots else 1.0) * 0.7 * (np.array(sampler.names) == symbol.name)
        states = [replace(state, history=None) for state in case.samples().states]
        moved = [replace(s, u=s.u + step) if symbol.dots else replace(s, q=s.q + step) for s in states]
        yield name, case.meaning.values(Samples(sampler.core, moved))


def _follows(checker: Checker, declared: Declared, statement: str, premises: str) -> Verdict:
    """Whether an equation is true wherever others are, whatever the mechanics."""
    known = checker.symbols(declared)
    then, given = known.read(statement), known.read(premises.replace(" and ", "\n")).equations
    conclusion, case = then.equations[0], checker.case(statement + "\n" + premises.replace(" and ", "\n"), declared)
    rng = np.random.default_rng(3)
    values = {k: v * rng.uniform(0.5, 1.5, v.shape) for k, v in case.meaning.values(case.samples()).items()}
    said = [n for e in given for n in symbols_in(e) if n.key in values and values[n.key].ndim == 1]
    order = [n.key for n in sorted(dict.fromkeys(said), key=lambda n: -n.dots)]  # made true by the symbols with most dots
    columns = jacobian(given, values, order)[1][0].T * np.array([[values[key][0]] for key in order])
    free = [order[i] for i in independent(columns / np.abs(columns).max(axis=0))]
    most = np.array([np.max(np.abs(values[key])) for key in free])  # of a step: what is squared may have no root there
    for _ in range(_NEWTON):
        base, slopes = jacobian(given, values, free)
        steps = np.clip(np.einsum("kij,kj->ki", np.linalg.pinv(slopes), base), -most, most)
        values |= {key: values[key] - steps[:, i] for i, key in enumerate(free)}
    made = np.max([np.abs(residual(e, values).ratio).max(axis=1) for e in given], axis=0) < 1e-9
    if made.sum() < _FEWEST:
        return Verdict(Kind.UNDECIDABLE, statement, "the premises could not be made true by their accelerations and forces")
    there = {key: value[made] for key, value in values.items()}
    found = residual(conclusion, there)
    if found.worst < 1e-8:
        return Verdict(Kind.TRUE, statement, f"holds wherever `{premises}` does, on {len(found.ratio)} random numbers")
    return Verdict(Kind.WRONG, statement, f"does not follow: `{premises}` can hold without it", evidence=evidence(found, there))


_JUST = re.compile(r"(?:[^=<>:;\n]*:\s*)?((?:(?:just|immediately|right|shortly)\s+)?(?:after|before))\s*:")
"""Of what happens, where only one thing does."""
_AT_BLOW = re.compile(
    rf"\s*(?:(?:at|in|on|during)\s+)?((?:\w+\s+){{0,3}}?\w*(?:{BLOW}|stroke)\w*(?:\s+(?:on|at|against|with|in)\s+(?:the\s+)?\w+)?)\s*(?:,[^=<>:;\n]*)?:",
    re.IGNORECASE,
)
"""``impact:``, ``at the stroke:``."""
_SIGNED = re.compile(r"[⁻⁺]|\^\{[-−+]\}")
_BESIDE_BLOW = re.compile(r"(?:\w+\s+)?(?:after|before|between|while|until|once|when|with|without|no|during)\b")
_IS_HELD = re.compile(r"\b(?:(?:is|are)\s+)?held\b(?:\s+still)?")
_OF_RATES = re.compile(r"\b(?:rate|omega|v[xy]|speed)\(")
"""What comes to 0 on a motion from the start, as a speed where something stops."""
_PLACES = re.compile(r"\bthe [\w\s-]+(?=,|\Z)")
_ZEROS = ("0", "0.0")
_TO_ZERO = re.compile(r"\s*=\s*0(?![.\d])")
_BESIDE_WORDS = " ↑↓→←↺↻+()"
"""What stands beside the words of a label: in which sense is counted."""
_NAME = re.compile(r"\s*([^\s:=]+)\s*:?=\s*([^=:]+)")
_WHOLE = {
    "limit": "limit: … as p -> 0",
    "follows": "follows: … from …",
    "shorter": "shorter: … than …",
    "report": "report: NAME = 1.23",
}
"""Words with which a claim begins, and how it goes on."""
_FORMS: tuple[tuple[re.Pattern[str], Callable[..., Verdict]], ...] = (
    (re.compile(r"only if\b(.*?):(.+)", re.S), _only_if),
    (re.compile(r"if\b(.*?):(.+)", re.S), _if),
    (re.compile(r"frequencies(?: (\d))?:(.+)", re.S), frequencies),
    (re.compile(r"constant:(.+)", re.S), constant),
    (re.compile(rf"{BETWEEN}:(.+)", re.S), between),
    (re.compile(rf"{PLACES}:(.+)", re.S), between_places),
    (re.compile(r"limit:(.+)\bas\b(.*)", re.S), limit),
    (re.compile(r"no (.+?) in:(.+)", re.S), _independent),
    (re.compile(r"no (.+?) in the factors of (.+?):(.+)", re.S), _coefficients),
    (re.compile(r"shorter:(.+)\bthan\b(.+)", re.S), _shorter),
    (re.compile(r"same at (.+?) for (\S+) = (.+?):(.+)", re.S), timed_claims.same),
    (re.compile(r"follows:(.+)\bfrom\b(.+)", re.S), _follows),
    (re.compile(r"at (.+?):(.+)", re.S), _at),
    (re.compile(r"(just )?(after|before) (.+?):(.+)", re.S), beside_words),
    (re.compile(r"([^:;\n]*(?:Δ|\\Delta)[^:;\n]*)=([^:;\n]*)"), changes),
    (re.compile(r"report:(.+)=(.+)", re.S), timed_claims.report),
)
"""Forms of claims, each with what judges it."""

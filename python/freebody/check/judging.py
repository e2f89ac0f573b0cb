"""How the verdict about a statement is come to: on true motions, under an assumption, or with corrections."""

from __future__ import annotations

import re
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import replace
from itertools import chain, islice

import numpy as np

from freebody.core import Array, ModelError, MotionError
from freebody.model.errors import ModelProblem
from freebody.symbolic.differentiate import rate
from freebody.symbolic.errors import StatementError
from freebody.symbolic.evaluate import is_zero
from freebody.symbolic.tree import Column, Node, Sym

from .assumptions import FROM_START, OWN_NUMBERS, assumption, is_of_higher_order, leaves_out, linearised, nearer, of_family, tiny
from .case import Case
from .correction import SECOND, corrections
from .families import ALL, Family, NoMotion, Samples
from .figures import corrected_figures, is_computed, rounding, says_a_figure, says_a_measure
from .language.spelling import spell
from .language.statements import Equation, symbols_in, terms
from .motion_sampler import SAMPLES
from .nearest import nearest
from .residual import FAILS, HOLDS, OFTEN, Residual, equation_sides, jacobian, residual, sizes, unreached
from .search import MOST
from .senses import holds_with_either_root, of_root, one_sense
from .stated import Correction
from .verdict import EVERY_TERM_IS_0, Kind, Verdict, evidence

_FAR = 2.0  # size of a correction from which on one is looked for among the balances
_SIZE = re.compile(r"\b(?:speed|hypot|abs|sqrt)\(")
"""What has no sign."""
_GLANCE = 3  # states, on which most of what is wrong shows
_SETS = 3  # of samples, where one has few at which there is a value
_MANY, _ODD = 40, 0.05  # motions, of which so few may be odd
_ROUND_OFF = 1e-9  # of the largest component of an equation: one that stays below is 0
_DEPENDENT = 1e-8  # singular value, of rows whose largest entry is 1, below which equations depend on each other
_ORDER = [Kind.TRUE, Kind.TRUE_IF, Kind.UNDECIDABLE, Kind.WRONG, Kind.DIMENSIONS, Kind.UNREADABLE]


def judged(case: Case) -> Verdict:
    """The verdict about all equations of a statement together. Raises ``StatementError`` where it has no meaning."""
    parts = [judged_one(case, equation) for equation in case.equations]
    text = case.program.text
    if len(parts) == 1:
        return parts[0]
    worst = max(parts, key=lambda part: _ORDER.index(part.kind))
    which = [f"equation {i}: {p.kind.value}" for i, p in enumerate(parts, 1) if not p.ok]
    reason = "; ".join(which) or _sufficiency(case)
    together = tuple(chain(*(part.mends for part in parts)))
    assumed = "; ".join(dict.fromkeys(p.assumption for p in parts if p.assumption))
    untested = tuple(chain(*(part.untested for part in parts)))
    true, differs = (
        "\n  ".join(dict.fromkeys(filter(None, said))) for said in ([p.true for p in parts], [p.differs for p in parts])
    )
    return Verdict(worst.kind, text, reason, assumed, together, worst.evidence, untested, true, differs)


def judged_one(case: Case, equation: Equation) -> Verdict:
    """The verdict about one equation; a figure under a condition is that of the model's own numbers."""
    text = case.program.text[slice(*equation.span)].strip() or case.program.text
    if case.hypothesis != ALL and says_a_figure(equation):
        case = replace(case, hypothesis=replace(case.hypothesis, numbers=True, zeros=False), known={})
    try:
        found = case.residual(equation)
    except NoMotion as error:
        return Verdict.without_motion(text, error)
    except StatementError as error:
        if any(n.key not in case.values() for n in symbols_in(equation)):
            raise error.within(case.program.text) from None
        return of_wrong_dimensions(case, [equation], text, error.what)
    if np.isnan(found.worst):
        values = case.values()
        lost = [n for n in symbols_in(equation) if n.key in values and not np.isfinite(values[n.key]).all()]
        where = np.isfinite(found.ratio).all(axis=1)
        if stressed := [n.key for n in lost if case.meaning.solved(n)]:
            what = f"{', '.join(stressed)} is not determined by the balances of this model (its parts can be pre-stressed)"
            return Verdict(Kind.UNDECIDABLE, text, what)
        if where.sum() < OFTEN:
            case = _of_more(case)
            found = case.residual(equation)
            where = np.isfinite(found.ratio).all(axis=1)
        if equation.relation != "=" or where.sum() < OFTEN:
            return _without_value(case, equation, text)
        found = Residual(found.sides, np.where(where[:, None], found.ratio, 0.0))
    if equation.relation != "=":  # one side is not above the other, on every state
        gap = found.ratio if equation.relation.startswith("<") else -found.ratio
        if gap.max() <= HOLDS:
            return Verdict(Kind.TRUE, text, f"holds on {len(gap)} random motions", evidence=evidence(found, case.values()))
        broken = Residual(found.sides, np.maximum(gap, 0.0))
        return Verdict(Kind.WRONG, text, "broken by an example", evidence=evidence(broken, case.values()))
    if found.worst >= HOLDS and _vanishes(case, equation):
        return Verdict(Kind.TRUE, text, f"{EVERY_TERM_IS_0} in every motion of which it is said")
    worst = found.worst
    if HOLDS <= worst <= FAILS:  # on fresh states, badly conditioned ones aside if they are few
        again = case.residual(equation, fresh=7)
        worst = float(np.median(np.abs(again.ratio).max(axis=1))) if again.holds_but_for_few else again.worst
    in_digits = HOLDS <= worst <= FAILS or (case.hypothesis.numbers and worst >= HOLDS)
    if worst < HOLDS or (in_digits and np.all(np.abs(found.sides.residual) <= rounding(equation, case.values()))):
        return _true(case, equation, text, found)
    if worst <= FAILS:
        what = f"the two sides differ by {worst:.1e} of their terms: more than round-off, less than a mistake"
        return Verdict(Kind.UNDECIDABLE, text, what, evidence=evidence(found, case.values()))
    if loose := case.depends_on_stress(equation):
        what = f"{', '.join(loose)} is not determined by the balances of this model: its parts can be pre-stressed"
        return Verdict(Kind.UNDECIDABLE, text, what, evidence=evidence(found, case.values()))
    if _holds_near_by(case, equation):
        few = f"with numbers far from the model's it may fail: it does so on {_off(found).sum()} of {len(found.ratio)} random motions"
        usual = Residual(found.sides, np.where(_off(found)[:, None], 0.0, found.ratio))
        return replace(_true(case, equation, text, usual), notes=(few,))
    return _not_true(case, equation, text, found)


def _off(found: Residual) -> Array:
    """On which states an equation does not hold."""
    return np.abs(found.ratio).max(axis=1) >= HOLDS


def _holds_near_by(case: Case, equation: Equation) -> bool:
    """Whether it fails on hardly any motion, and on none whose numbers are among the nearer half to the model's: with others the parts may
    lie otherwise, as a rope that comes off the other side of a pulley."""
    own = case.sampler.own.p
    for fresh in (0, 7):
        off, states = _off(case.residual(equation, fresh=fresh)), case.samples(fresh=fresh).states
        if len(off) < _MANY or len(off) != len(states) or np.mean(off) > _ODD:
            return False
        with np.errstate(divide="ignore", invalid="ignore"):
            far = np.array([np.nanmax(np.abs(np.log(np.abs(state.p / own))), initial=0.0) for state in states])
        if off[far <= np.median(far)].any():
            return False
    return True


def _vanishes(case: Case, equation: Equation) -> bool:
    """Whether where it is said all terms are 0 but for round-off of what they are elsewhere."""
    given = case.hypothesis
    if not given.vanishing or given.small or given.scaled:
        return False
    with suppress(NoMotion, StatementError):
        usual = np.median(sizes(equation, case.values(ALL)), axis=0)
        return bool((sizes(equation, case.values()) <= HOLDS * usual).all())
    return False


def _of_more(case: Case) -> Case:
    """The same beside several sets of motions."""
    sets = [case.values(fresh=i) for i in range(_SETS)]
    return replace(
        case, known={(case.hypothesis, 0, SAMPLES): {key: np.concatenate([each[key] for each in sets]) for key in sets[0]}}
    )


def _without_value(case: Case, equation: Equation, text: str) -> Verdict:
    """The verdict about an equation that has no value at most motions: true under an assumption, or not decidable."""
    if case.correcting and equation.relation == "=" and (assumed := assumption(case, equation)):
        return Verdict(Kind.TRUE_IF, text, f"true only if: {'; or: '.join(assumed)}", assumed[0])
    what = "it has no value at some motions: a division by 0, a root or a logarithm of something negative"
    return Verdict(Kind.UNDECIDABLE, text, what)


def holds(case: Case, *equations: Equation) -> bool:
    """Whether equations hold on true states; without any, all of a statement."""
    try:
        return all(case.residual(equation).worst < HOLDS for equation in equations or case.equations)
    except (NoMotion, StatementError):
        return False


def of_wrong_dimensions(case: Case, equations: Iterable[Equation], text: str, reason: str) -> Verdict:
    """The verdict where dimensions do not fit: each equation with its corrections, or with the nearest true one."""
    if not case.correcting:
        return Verdict(Kind.DIMENSIONS, text, reason)
    try:
        fixes = {equation: tuple(islice(corrections(case, equation), MOST)) for equation in equations}
    except NoMotion:
        return Verdict(Kind.DIMENSIONS, text, reason)
    every = tuple(chain(*fixes.values()))
    least = min((each.size for each in every), default=np.inf)
    inside = _in_figures(case, list(fixes)) if least > 1.5 else ()
    if inside and min(each.size for each in inside) < least:
        return Verdict(Kind.WRONG, text, "figures are in SI units", mends=inside)
    likely = tuple(each for each in every if len(each.edits) == 1 or each.size <= _FAR)
    near = (nearest(case, equation) for equation, found in fixes.items() if not {*found} & {*likely})
    true = "\n  ".join(found.text for found in near if found)
    return Verdict(Kind.DIMENSIONS, text, reason, mends=likely if true else every, true=true)


def _in_figures(case: Case, equations: Iterable[Equation]) -> tuple[Correction, ...]:
    """The corrections of equations whose figures stand for measures in SI units; none where dimensions do not fit so, either."""
    other = replace(case, meaning=case.meaning.in_figures())
    if not all(map(other.meaning.fits, equations)):
        return ()
    return tuple(chain(*(corrections(other, equation, SECOND) for equation in equations if not holds(other, equation))))


def _true(case: Case, equation: Equation, text: str, found: Residual) -> Verdict:
    values = case.values()
    unseen = [term for term in unreached(equation, values) if not _is_nothing(term)]
    blind = [spell(term) for term in unseen]
    idle = {
        n.key: owner for term in unseen for n in symbols_in(term) if (owner := case.meaning.limit(n)) and not values[n.key].any()
    }
    if idle:
        what = f"{', '.join(idle)} is 0 on all motions that were tried, which leave {', '.join({*idle.values()})} as at the start"
        return Verdict(Kind.UNDECIDABLE, text, f"{what}: nothing is known of others", untested=tuple(blind))
    if blind and len(blind) == sum(not _is_nothing(term) for term in terms(equation, expand=True)):
        motions = "of this model" if case.hypothesis == ALL else "of which it is said"
        alone = len(blind) == 1  # it says that this is 0, and so it is
        return Verdict(Kind.TRUE, text, f"{EVERY_TERM_IS_0} in every motion {motions}", untested=() if alone else tuple(blind))
    bound = case.hypothesis.vanishing and {n.key for n in symbols_in(equation)} <= case.meaning.given()  # by what vanishes
    if not bound and residual(equation, case.elsewhere(values)).worst < HOLDS:
        return Verdict(Kind.TRUE, text, "the two sides are the same by themselves: it says nothing of the motion")
    which = "from the start of this model " if case.hypothesis.since else ""
    share = f"{max(found.worst, 1e-16):.0e} of its terms"
    numbers = "the model's own numbers" if case.hypothesis.numbers else "random parameters"
    reason = f"holds on {len(found.ratio)} random motions {which}with {numbers}, to {share}"
    return Verdict(Kind.TRUE, text, reason, evidence=evidence(found, case.values()), untested=tuple(blind))


def _is_nothing(term: Node) -> bool:
    """Whether it is a column of zeros, as on the right side of a constraint."""
    return isinstance(term, Column) and all(map(is_zero, term.items))


def _not_true(case: Case, equation: Equation, text: str, found: Residual) -> Verdict:
    """Under an assumption that a person would make; else wrong, with its corrections, also where what was left out would be 0 at
    rest or without a part of the model."""
    seen = evidence(found, case.values())
    if plainly := _of_one_sense(case, equation) or _from_start(case, equation) or _as_figures(case, equation):
        return plainly
    known = case.meaning.vocabulary
    placed = any(n in known.coordinates for n in symbols_in(equation))
    placed &= not any(n.dots or known.is_load(n) for n in symbols_in(equation) if n not in known.parameters)
    if placed and case.sampler.rolls_in_loop and _stays(case, equation):
        what = "the angles of what rolls are measured from a place where both sides are equal"
        return Verdict(
            Kind.TRUE_IF, text, f"true only if {what}: they differ by what they differ by at the start", what, evidence=seen
        )
    if not case.correcting:
        return Verdict(Kind.WRONG, text, evidence=seen)
    if case.hypothesis.numbers and says_a_figure(equation):
        others, last = corrected_figures(equation, case.values())
        return Verdict(Kind.WRONG, text, "off in the last digit" if last else "", mends=others, evidence=seen)
    fixes = tuple(islice(corrections(nearer(case), equation), MOST))
    single = [each for each in fixes if len(each.edits) == 1]
    slip = any(each.is_slip for each in single)
    lacks = bool(single) and not slip and is_of_higher_order(case, equation)  # who keeps sines has not taken all for small
    if not lacks and (small := linearised(case, equation)):
        return Verdict(Kind.TRUE_IF, text, f"true only for {small}", small, evidence=seen)
    assumed = () if slip else assumption(case, equation)
    words = "; or: ".join(assumed)
    if assumed and not leaves_out(assumed[0], bool(single), lacks, not case.sampler.own.u.any()):
        return Verdict(Kind.TRUE_IF, text, f"true only if: {words}", assumed[0], fixes, seen)
    if not fixes and (small := tiny(case, equation)):
        given, beside = small
        fixes = tuple(replace(each, given=given) for each in islice(corrections(beside, equation, SECOND), MOST))
    if not fixes or fixes[0].size > _FAR:
        near = nearest(case, equation)
        fixes = (near.correction,) if near and near.correction else fixes
    reason, first = (f"it would hold only if: {words}", assumed[0]) if assumed else ("", "")
    if fixes:
        return Verdict(Kind.WRONG, text, reason, first, fixes, seen)
    what = reason or ("" if case.budget.spent else "no single or double edit corrects it")
    true, differs = (near.text, near.differs) if near else ("", "")
    return Verdict(Kind.WRONG, text, what, first, evidence=seen, true=true, differs=differs)


def _of_one_sense(case: Case, equation: Equation) -> Verdict | None:
    """That it is true where rates have one sense, if what acts depends on it, or where a rate that is said to be a root has the sense of
    the start; else None."""
    for kind, found in ((Kind.TRUE_IF, one_sense(case, equation)), (Kind.TRUE, of_root(case, equation))):
        family, words = found or (None, "")
        if family and of_family(case, equation, family, _GLANCE) and of_family(case, equation, family):
            reason = f"true only if: {words}" if kind is Kind.TRUE_IF else f"holds where {words}, as at the start"
            return Verdict(kind, case.program.text, reason, words)
    return None


def _from_start(case: Case, equation: Equation) -> Verdict | None:
    """That it is true of motions from the start of the model, also through what switches on them, where its letters are of these; where that
    is at rest and everything moves from there, so that a term which is left out is 0; where what it says is 0 never changes; or where a
    size or a root in it has the sign that it has on these. Else None."""
    given, figure = case.hypothesis, says_a_figure(equation)
    if replace(given, vanishing=(), above=(), held=(), numbers=False, zeros=True) != ALL or (figure and not given.vanishing):
        return None
    if given.vanishing and not case.sampler.free_rates.size:  # what is driven was followed from the start already
        return None
    since = replace(given, since="start")
    glance = lambda: case.sampler.starts_to_move and of_family(case, equation, since, _GLANCE)
    # What is said of after an event is of the motion that has come there.
    known = figure or case.meaning.speaks_of_start(equation) or "after" in case.sampler.moment
    if not (
        known
        or _never_changes(case, equation)
        or ((_has_sizes(case, equation) or holds_with_either_root(case, equation)) and of_family(case, equation, since, _GLANCE))
        or glance()
    ):
        return None
    ways = [since, replace(since, through=True)]
    if forward := one_sense(case, equation):
        ways.append(replace(since, above=forward[0].above))
    later = any(case.sampler.spec[kind] for kind in ("contacts", "stops", "strings"))  # a term may take part behind what switches
    for family in ways:
        if not _at_a_glance(case, equation, family):
            continue
        whole = of_family(case, equation, family, SAMPLES)
        if whole or later or _never_changes(case, equation):  # what is 0 by symmetry from this start takes part elsewhere
            verdict = judged_one(replace(case, hypothesis=family, known={}), equation)
            untested = verdict.untested if whole or later else ()
            return replace(verdict, assumption=FROM_START, untested=untested) if verdict.ok else None
    if case.sampler.moment and case.meaning.speaks_of_start(equation) and not any(map(case.sampler.has, ways)):
        what = f"no motions from the start were found that come to where it is said of, {case.sampler.own.moment}, as the model's own does"
        return Verdict(Kind.UNDECIDABLE, case.program.text, what)
    return None


def _at_a_glance(case: Case, equation: Equation, family: Family) -> bool:
    """Whether an equation holds on a few motions of a family, whether or not every term takes part."""
    with suppress(NoMotion, StatementError, ModelError, MotionError):
        return residual(equation, case.values(family, count=_GLANCE)).holds_but_for_few
    return False


def _never_changes(case: Case, equation: Equation) -> bool:
    """Whether by what its sides differ is constant on every motion, though both change."""
    with suppress(StatementError, NoMotion, ModelProblem):
        slope = Equation(*(rate(side, case.meaning.symbols.constants) for side in (equation.left, equation.right)))
        needed = [n for n in symbols_in(slope) if n.key not in case.values()]
        changes = not (is_zero(slope.left) and is_zero(slope.right))
        return changes and not needed and case.residual(slope).worst < HOLDS
    return False


def _has_sizes(case: Case, equation: Equation) -> bool:
    """Whether sizes of velocities stand in it."""
    return any(_SIZE.search(text) for n in symbols_in(equation) for text in case.meaning.texts(Sym(n.name)))


def _as_figures(case: Case, equation: Equation) -> Verdict | None:
    """That a measure alone on its side, ``a = 2.91 m/s²``, or one that was computed is that of the model's own numbers, of any motion or of
    those from its start; else None."""
    measured = says_a_measure(equation) and any(map(case.meaning.is_answer, symbols_in(case.program)))
    if case.hypothesis != ALL or not (measured or is_computed(equation)):
        return None
    own = replace(case.hypothesis, numbers=True, zeros=False)
    for family, assumed in ((own, OWN_NUMBERS), (replace(own, since="start"), f"{OWN_NUMBERS}, {FROM_START}")):
        if of_family(case, equation, family):
            verdict = judged_one(replace(case, hypothesis=family, known={}), equation)
            return replace(verdict, assumption=assumed) if verdict.ok else None
    return None


def _stays(case: Case, equation: Equation) -> bool:
    """Whether the two sides go on to differ by what they differ by at the start of each motion."""
    samples = case.samples()
    if not samples.starts:
        return False
    began = case.meaning.values(Samples(samples.core, samples.starts, samples.starts))
    change = equation_sides(equation, case.values()).residual - equation_sides(equation, began).residual
    left = [equation_sides(equation, values).left for values in (case.values(), began)]
    moved = np.abs(left[0] - left[1]).reshape(change.shape)
    return bool(moved.any() and np.all(np.abs(change) <= FAILS * moved))


def _sufficiency(case: Case) -> str:
    """What a set of true equations is worth: how many are independent in their unknowns, accelerations and forces."""
    values, equations = case.values(), case.equations
    said = dict.fromkeys(n for equation in equations for n in symbols_in(equation) if n.key in values)
    unknown = [n.key for n in said if case.meaning.solved(n) and values[n.key].any()]
    found = [sizes(equation, values).max(axis=0) for equation in equations]
    rows = np.concatenate([size > _ROUND_OFF * size.max() for size in found])  # forces have two components, moments one
    if not unknown:
        return f"all {np.sum(rows)} true"
    slopes = jacobian(equations, values, unknown)[1][:, rows]
    ranks = np.linalg.matrix_rank(slopes / (np.abs(slopes).max(axis=2, keepdims=True) + 1e-300), tol=_DEPENDENT)
    if (rank := int(np.median(ranks))) < np.sum(rows):
        return f"all true; {np.sum(rows)} equations, but only {rank} of them independent in the accelerations and forces in them"
    return f"all {rank} true, and independent in {', '.join(unknown)}"

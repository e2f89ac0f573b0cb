"""The verdict about equations in the ways in which they can be read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from freebody.symbolic.dimensions import ANGLE, NUMBER_ONLY, TIME
from freebody.symbolic.errors import StatementError
from freebody.symbolic.tree import Add, Cross, Dot, Sym, walk

from .case import Case
from .judging import judged, of_wrong_dimensions
from .language.dimensions import misfit
from .language.statements import Program, symbols_in
from .senses import is_root, said_of_each
from .symbols import DOUBTFUL, Symbols
from .usual_names import ENERGIES
from .verdict import Verdict

if TYPE_CHECKING:
    from .api import Checker, Declared

_TENSION = re.compile(r"`T` is .*\(N\)\Z|is a force .*`T` is")
_RATE = ANGLE.times(TIME, -1)


def stated(checker: Checker, text: str, letters: Declared | None) -> Verdict:
    """The verdict about equations; where they are not true, but are in another way in which they can be read, of that reading."""
    judging = copy(checker)
    judging.correcting = False
    case = judging.case(text, letters)
    first = _judged(judging, text, letters, case)
    if first.ok:
        return first
    for other, tight, note in _readings(checker, text, letters or {}):
        said = {**(letters or {}), **other}
        found = _judged(judging, text, said, judging.case(text, said, tight=tight))
        if found.ok:
            return replace(found, notes=(*found.notes, *note))
    return _judged(checker, text, letters, replace(case, correcting=True)) if checker.correcting else first


def _judged(checker: Checker, text: str, letters: Declared | None, case: Case) -> Verdict:
    """The verdict about equations, read as in a case."""
    if case.program.units and (found := _in_figures(checker.case(text, letters, units=False))):
        return found
    if (error := misfit(case.program, case.meaning.symbols.dimensions)) is None:
        verdict = judged(case)
    elif case.meaning.symbols.assumed.get("T") == ENERGIES["T"] and _TENSION.search(error.what):
        what = "the symbol `T` has no meaning in this model but its kinetic energy, and that is no force"
        raise StatementError(what, error.span, "declare it, like `T: …`, on the command line by `--where 'T=…'`", text)
    else:
        verdict = _in_figures(case) or of_wrong_dimensions(case, case.equations, text, error.what)
    unfinished = (case.budget.words,) if case.budget.spent else ()
    return replace(verdict, notes=(*case.meaning.symbols.notes(case.program), *unfinished))


def _in_figures(case: Case) -> Verdict | None:
    """The verdict where an equation is true whose dimensions do not fit, since figures in it are measures in SI units."""
    verdict = judged(replace(case, correcting=False))
    return replace(verdict, reason=f"{verdict.reason}; figures are in SI units") if verdict.ok else None


def _readings(checker: Checker, text: str, letters: Declared) -> Iterator[tuple[Declared, bool, tuple[str, ...]]]:
    """Other ways to read a statement: with what stands directly behind a factor below a stroke below it, with sizes of vectors, and
    with the only body turning clockwise; each with declarations, whether it is read so tightly, and what is to be said of it."""
    if DOUBTFUL.search(text):
        yield {}, True, ()
    known = checker.symbols(letters)
    program = known.read(text)
    if sized := _sized(program, known):
        yield sized, False, tuple(f"Here {name} is read as: the size of that, without a sign." for name in sized)
    if rooted := _rooted(checker.case(text, letters), known):
        yield rooted, False, tuple(f"Here {name} is read as: the size of that, without a sign." for name in rooted)
    turned = {name: said for name, said in known.senses.items() if name in known.assumed}
    if turned and any(n.name in turned for n in symbols_in(program)):
        yield turned, False, tuple(f"Here {name} is read clockwise: {said}." for name, said in turned.items())


def _rooted(case: Case, known: Symbols) -> dict[str, str]:
    """The sizes of letters that are said to be a root: v = √(2 g h); but no turn that goes on backwards."""
    pairs = [pair for line in case.program.equations for pair in said_of_each(line)]
    found = [one.name for one, other in pairs if isinstance(one, Sym) and not one.dots and is_root(other)]
    meanings = {name: known.meanings[name] for name in found if name in known.meanings}
    sized = {name: m for name, m in meanings.items() if len(m.texts) == 1 and m.kind in ("declared", "reading")}
    return {name: f"abs({m.texts[0]})" for name, m in sized.items() if m.dimension != _RATE or np.any(case.values()[name] > 0)}


def _sized(program: Program, known: Symbols) -> dict[str, str]:
    """The sizes of the letters of vectors that a statement about nothing else compares, each side one term: a_B = 2 a_A. One with a
    unit direction marks its vectors."""
    used = [n.name for n in symbols_in(program)]
    vectors = {name: known.meanings[name] for name in used if name in known.meanings and known.meanings[name].is_vector}
    alone = not any(isinstance(n, Add | Cross | Dot) for n in walk(program)) and not known.own & {*vectors}
    alone = alone and all(meaning.dimension != NUMBER_ONLY for meaning in vectors.values())
    return {name: "hypot({}, {})".format(*m.texts[:2]) for name, m in vectors.items()} if alone else {}

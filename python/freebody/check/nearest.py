"""The true equation that is nearest to a wrong one: the balance, or the closure of a loop, that holds the same symbols."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, Any

from freebody.equations import Nomenclature as Printed
from freebody.equations import Tree, equation_text, read, symbols
from freebody.equations.balances.system import Problem, groups, problem
from freebody.equations.balances.virtual_motions import named_motions
from freebody.symbolic.tree import ZERO, Sym

from .families import NoMotion
from .language.statements import Equation, symbols_in

if TYPE_CHECKING:
    from .case import Case

_MOST = 150  # balances that are looked at, those of few bodies first
_LONG = 1500  # signs, beyond which nobody reads an equation
_WORD = re.compile(r"'[^']+'\.\w+|[^\W\d][\w.\[\]]*")
_LEVELS = ("value", "rate", "acceleration")
_KINDS = {"number": "constant"}


@dataclass(frozen=True)
class _True:
    """A true equation with its words and what is unknown in it."""

    words: str
    left: Tree
    right: Tree
    unknown: frozenset[Sym]

    def distance(self, said: frozenset[Sym], unknown: frozenset[Sym]) -> tuple[int, int, int]:
        """How far its symbols are from those of a statement: unknown ones, then all, then how many there are."""
        own = frozenset(symbols(self.left, self.right))
        return len(unknown ^ self.unknown), len(said ^ own), len(own)


def nearest(case: Case, equation: Equation) -> str:
    """The nearest true equation in the model's symbols, with what it is; "" where none holds an unknown of the statement."""
    try:
        state = case.samples().states[0]
    except NoMotion:
        return ""
    core = case.sampler.core
    given = problem([core.free_bodies(state)])
    points = core.points(core.bind())
    stated = core.symbolic_answers(state, [{"ask": "rows"}])
    said = _said(case, equation, stated.symbols)
    kinds = {name: entry["kind"] for name, entry in stated.symbols.items()}
    unknown = frozenset(s for s in said if s.dots == 2 or kinds[s.name] == "unknown")
    level = max((s.dots for s in said), default=0)
    found = []
    for words, question in case.budget.within(islice(_questions(given, points), _MOST)):
        (answer,) = core.symbolic_answers(state, [{**question, "terms": False, "momentum": False}]).answers
        there = frozenset(read(each["symbol"]) for each in answer["linear"]["coefficients"])
        found.append(_True(words, read(answer["left"]), read(answer["right"]), there))
    for row in stated.answers[0]:  # what loops ask of the configuration, the rates or the accelerations
        if (stated_there := row[_LEVELS[level]]) is None:
            continue  # what sticks or rolls holds rates, and no place
        tree = read(stated_there)
        there = frozenset(s for s in symbols(tree) if s.dots == level)
        found.append(_True(f"the closure at {row['name']}", tree, ZERO, there))
    wanted = unknown or frozenset(s for s in said if s.dots == 1)
    common = [each for each in found if wanted & each.unknown]
    if not common:
        return ""
    best = min(common, key=lambda each: each.distance(said, wanted))
    table = Printed.read({n: {**e, "kind": _KINDS.get(e["kind"], e["kind"])} for n, e in stated.symbols.items()})
    stated = equation_text(best.left, best.right, table, width=_LONG)
    return f"{best.words} reads: {stated}" if len(stated) < _LONG else f"{best.words} is too long to be printed"


def _questions(given: Problem, points: Mapping[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Balances of bodies that hang together, about points and along directions that have a name."""
    twists = sorted(named_motions(given, points), key=lambda twist: twist.rank)
    for group in groups(given)[0]:
        bodies = [given.bodies[i] for i in group]
        for twist in twists:
            if twist.question is not None:
                how = "moments about" if "about" in twist.question else "forces along"
                words = f"the balance of {how} {twist.name} for {' + '.join(bodies)}"
                yield words, {"ask": "equation", "bodies": bodies, **twist.question}


def _said(case: Case, equation: Equation, table: Mapping[str, Any]) -> frozenset[Sym]:
    """The symbols of the model that a statement holds."""
    found = set()
    for symbol in symbols_in(equation):
        for text in case.meaning.texts(Sym(symbol.name)):
            dots = symbol.dots + (2 if "accel(" in text else 1 if "rate(" in text else 0)
            words = [word for word in _WORD.findall(text) if word in table]
            found |= {Sym(word, dots if table[word]["kind"] == "coordinate" else 0) for word in words}
    return frozenset(found)

"""The true equation that is nearest to a wrong one: the balance, or the closure of a loop, that holds the same symbols."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import islice
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.equations import Nomenclature as Printed
from freebody.equations import Tree, equation_text, read, symbols
from freebody.equations.balances.system import Problem, groups, problem
from freebody.equations.balances.virtual_motions import named_motions
from freebody.symbolic.dimensions import FORCE
from freebody.symbolic.evaluate import Array, sampled
from freebody.symbolic.tree import ZERO, Add, Fn, Negative, Node, Num, Sym, exchange, is_zero, walk

from .beside import Difference, Letters, difference, said_terms
from .edits import OTHER, Edit
from .families import NoMotion
from .language.dimensions import dimension
from .language.spelling import spell
from .language.statements import Equation, symbols_in, terms, without_ones
from .powers import powers_of, written
from .residual import HOLDS, residual
from .search import vanishes
from .slips import why
from .stated import Correction

if TYPE_CHECKING:
    from .case import Case

_COMMON = 2  # terms that a statement has of a balance at least, to be one that lacks some
_MOST_MISSING = 4
_PART = 0.9  # of the budget, at which no more is looked for
_AT_LEAST = 0.1  # of it, for the nearest whatever the time
_MOST_DIFFERENT = 6  # terms that are told
_EACH = 0.2  # by which a correction is larger for each term
_MOST = 150  # balances that are looked at, those of few bodies first
_ONE = 1e-9  # off 1, below which a cosine is 1 at a moment
_LONG = 1500  # signs, beyond which nobody reads an equation
_WORD = re.compile(r"'[^']+'\.\w+|[^\W\d][\w.\[\]]*")
_LEVELS = ("value", "rate", "acceleration")
_KINDS = {"number": "constant"}


@dataclass(frozen=True)
class Nearest:
    """A true equation in words, and how a statement differs from it; ``correction`` where it only lacks some of its terms."""

    text: str
    differs: str = ""
    correction: Correction | None = None


@dataclass(frozen=True)
class _True:
    """A true equation with its words, what is unknown in it, and how a statement differs from it."""

    words: str
    left: Tree
    right: Tree
    unknown: frozenset[Sym]
    difference: Difference | None = None

    def distance(self, said: frozenset[Sym], unknown: frozenset[Sym]) -> tuple[Any, ...]:
        """How far it is from a statement: whether terms are common, how many unknowns of it are not here, by how many terms they differ;
        then by symbols, unknown ones, all, and how many there are."""
        own = frozenset(symbols(self.left, self.right))
        alone, strange, missing = self.difference.rank if self.difference else (True, 0, 0)
        absent = 0 if alone else len(unknown - self.unknown)
        return alone, absent, strange, missing, len(unknown ^ self.unknown), len(said ^ own), len(own)


def nearest(case: Case, equation: Equation) -> Nearest | None:
    """The nearest true equation; None where none holds an unknown of the statement."""
    try:
        state = case.samples().states[0]
    except NoMotion:
        return None
    core = case.sampler.core
    free = core.free_bodies(state)
    stated = core.symbolic_answers(state, [{"ask": "rows"}])
    said = _said(case, equation, stated.symbols)
    kinds = {name: entry["kind"] for name, entry in stated.symbols.items()}
    unknown = frozenset(s for s in said if s.dots == 2 or kinds[s.name] == "unknown")
    wanted = unknown or frozenset(s for s in said if s.dots == 1)
    level = max((s.dots for s in said), default=0)
    letters = Letters(case, equation, stated.symbols) if case.admissible else None
    own = said_terms(equation, case.admissible) if letters else []
    own = [] if any(value.ndim > 1 for _, value in own) else own  # no balance here is one of vectors
    touched = Counter(part.body for load in free.loads if Sym(load.symbol) in said for part in load.on)
    joints = [joint for joint in case.sampler.metadata["joints"] if {Sym(n, 2) for n in joint["coordinates"]} & said]
    touched.update(joint["second"] for joint in joints)
    points = core.points(core.bind())
    dimensions = {dimension(term, case.meaning.vocabulary.dimensions) for term in terms(equation, expand=True)}
    asked = _questions(problem([free]), points, touched, {joint["name"] for joint in joints}, FORCE in dimensions)
    found = []
    for words, question in case.budget.at_least(islice(asked, _MOST), _PART, _AT_LEAST):
        (answer,) = core.symbolic_answers(state, [{**question, "terms": False, "momentum": False}]).answers
        there = frozenset(read(each["symbol"]) for each in answer["linear"]["coefficients"])
        left, right = read(answer["left"]), read(answer["right"])
        if there & wanted:
            beside = difference(own, [*letters.terms(left, right)]) if letters and own else None
            found.append(_True(words, left, right, there, beside))
    kinematic = all(its is None or not its.mass for its in dimensions)
    for row in stated.answers[0] if kinematic else ():  # what loops ask of the configuration, the rates or the accelerations
        if (stated_there := row[_LEVELS[level]]) is None:
            continue  # what sticks or rolls holds rates, and no place
        tree = read(stated_there)
        there = frozenset(s for s in symbols(tree) if s.dots == level)
        found += [_True(f"the closure at {row['name']}", tree, ZERO, there)] if there & wanted else []
    if not found:
        return None
    best = min(found, key=lambda each: each.distance(said, wanted))
    table = Printed.read({n: {**e, "kind": _KINDS.get(e["kind"], e["kind"])} for n, e in stated.symbols.items()})
    text = equation_text(best.left, best.right, table, width=_LONG)
    if letters and letters.are_others:
        sides = ([term for term, _ in letters.terms(side, ZERO)] for side in (best.left, best.right))
        text = spell(Equation(*(_sum(terms) for terms in sides)))
    text = f"{best.words} reads: {text}" if len(text) < _LONG else f"{best.words} is too long to be printed"
    return Nearest(text, _in_words(best.difference), _lacking(case, equation, best.difference))


def _in_words(found: Difference | None) -> str:
    """How a statement differs from a balance with which it has terms in common."""
    if found is None or not found.common or not 0 < len(found.strange) + len(found.missing) <= _MOST_DIFFERENT:
        return ""
    strange, missing = (", ".join(f"`{spell(term)}`" for term in each) for each in (found.strange, found.missing))
    return (
        "; ".join(filter(None, (strange and f"{strange} is not in it", missing and f"of it {missing} is missing")))
        + ", all on the left"
    )


def _lacking(case: Case, equation: Equation, found: Difference | None) -> Correction | None:
    """The statement with all that it lacks of a balance, if that is all."""
    if found is None or found.strange or found.common < _COMMON:
        return None
    missing = [*filter(None, (_as_here(term, case.values()) for term in found.missing))]
    if not 0 < len(missing) <= _MOST_MISSING:
        return None
    lost = _gathered([*map(_opposite, missing)])
    lost = _with_letters(lost, case)
    after = Equation(equation.left, lost if is_zero(equation.right) else _sum([equation.right, lost]))
    if not {n.key for n in symbols_in(after)} <= case.values().keys():
        return None  # it has symbols that nothing confirms
    if not case.meaning.fits(after) or not residual(after, case.values()).worst < HOLDS:
        return None
    vocabulary = case.meaning.vocabulary
    reasons = (why(Edit("missing term", None, term, after), equation, vocabulary) for term in missing)
    size = 1.0 + _EACH * len(missing)
    return Correction((("missing term", "", spell(lost)),), spell(after), size, why="; ".join(dict.fromkeys(reasons)))


def _as_here(term: Node, values: Mapping[str, Array]) -> Node | None:
    """A term without sines and cosines that are 1 on all states; nothing where it is 0 there, as at the moment at which a bar hangs."""
    if not {n.key for n in symbols_in(term)} <= values.keys():
        return term
    if vanishes(term, values):
        return None
    for call in [n for n in walk(term) if isinstance(n, Fn) and n.name in OTHER]:
        if np.allclose(sampled(call, values), 1.0, rtol=0.0, atol=_ONE):
            term = exchange(term, call, Num(1.0, "1"))
    return without_ones(term)


def _opposite(term: Node) -> Node:
    return term.of if isinstance(term, Negative) else Negative(term)


def _with_letters(node: Node, case: Case) -> Node:
    """What is written with roots, with a letter for each that has one."""
    values, letters = case.values(), case.meaning.vocabulary.letters
    known = {n: values[n.key] for n in letters if n.key in values}
    for root in [n for n in walk(node) if isinstance(n, Fn) and n.name == "sqrt" and {k.key for k in n.symbols} <= values.keys()]:
        size = sampled(root, values)
        letter = next((n for n, value in known.items() if value.shape == size.shape and np.allclose(value, size)), None)
        node = exchange(node, root, letter) if letter else node
    return node


def _gathered(parts: Sequence[Node]) -> Node:
    """The sum of terms, what all have in common before it."""
    found = [powers_of(part) for part in parts]
    common = dict(reduce(lambda one, other: one & other, (set(powers.items()) for _, powers in found)))
    if len(parts) < 2 or not common:
        return _sum(parts)
    rest = [written(number, {base: n for base, n in powers.items() if base not in common}) for number, powers in found]
    return written(1.0, {**common, _sum(rest): 1})


def _sum(parts: Sequence[Node]) -> Node:
    flat = [inner for term in parts for inner in (term.terms if isinstance(term, Add) else (term,))]
    return Add(tuple(flat)) if len(flat) > 1 else flat[0] if flat else Num(0.0, "0")


def _questions(
    given: Problem, points: Mapping[str, Any], touched: Mapping[str, int], joints: set[str], forces: bool
) -> Iterator[tuple[str, dict[str, Any]]]:
    """Balances of bodies that hang together, about points and along directions that have a name; first of the bodies ``touched`` most by
    what was said, of ``forces`` or else of moments, and at its ``joints``."""
    order = lambda twist: (("along" in (twist.question or {})) is not forces, twist.name not in joints, twist.rank)
    twists = sorted(named_motions(given, points), key=order)
    every = [[given.bodies[i] for i in group] for group in groups(given)[0]]
    outside = lambda bodies: len([body for body in bodies if body not in touched])
    for bodies in sorted(every, key=lambda each: (outside(each), len(each), -sum(touched.get(body, 0) for body in each))):
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

"""What is closed put into balances, where that is shorter: ẍ by φ̈ of a rod in a corner, accelerations that a motion prescribes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial

from freebody.document.blocks import Equation
from freebody.equations.derivation import loop_closure
from freebody.equations.derivation.balance_text import Stated
from freebody.equations.derivation.plain_rows import at_rest, below, level_by_level, plain, root_of, times, with_rates
from freebody.solve.figures import figure
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.algebra import difference, factored, opposite, pythagorean, quotient, signed, spread
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.factoring import factor
from freebody.symbolic.linear import linear_in
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.presentation import length
from freebody.symbolic.symbols import SUPERSCRIPTS, Name
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import (
    ONE,
    ZERO,
    Add,
    Fn,
    Mul,
    Num,
    Pow,
    Sym,
    Tree,
    add,
    is_negative,
    is_zero,
    minus,
    mul,
    negative,
    number,
    operations,
    power,
    rebuilt,
    symbols,
    walk,
)
from freebody.symbolic.tree import replace as put

_MOST = 200
"""Operations of an equation, and of what is closed, above which nothing is put in."""
_OFTEN = 3
"""How often a root is in the rows at least that gets a symbol."""
_SHORT = 60
"""Printed signs of an acceleration up to which it is given by itself."""


@dataclass(frozen=True)
class Closed:
    """What is closed at a subject."""

    subject: SymbolicState

    @cached_property
    def rows(self) -> list[Row]:
        """What is closed or prescribed, as a page has it."""
        made = plain([row for row, _ in self._prescribed], self.subject.names, self.subject.values)
        made = loop_closure.written(made)
        return [level_by_level(row.with_trees(self.settled)) for row in made] if self.named else made

    @cached_property
    def rates(self) -> list[tuple[SymbolEntry, float]]:
        """Symbols for numbers with a unit in the laws of motions, and their values, SI."""
        return [entry for _, entries in self._prescribed for entry in entries]

    @cached_property
    def _prescribed(self) -> list[tuple[Row, list[tuple[SymbolEntry, float]]]]:
        made = []
        for row in self.subject.rows:
            given: list[tuple[SymbolEntry, float]] = []
            give = partial(self._rate, row, given)
            made.append((with_rates(row, self.subject.names, give), given))
        return made

    def _rate(self, row: Row, given: list[tuple[SymbolEntry, float]], size: float, order: int, in_angle: bool) -> Sym:
        """The symbol of a number of a law that is times a power of t: ω or v where it is the rate, Ω in an angle, else c."""
        turns = in_angle or any(
            c["name"] in {x.name for x in row.linear.coefficients} and c["dimension"] == "rad" for c in self.subject.coordinates
        )
        unit = f"{'rad' if turns else 'm'}/s{order if order > 1 else ''}".translate(SUPERSCRIPTS)
        alone = order == 1 and sum(part == Sym("t") for part in walk(row.value)) == 1
        what = f"{figure(size)} {unit}"
        wanted = "Omega" if in_angle and order == 1 else ("omega" if turns else "v") if alone else "c"
        name = self.subject.symbols.taken.give(f"{what} of {row.name}", Name.parse(wanted))
        entry = SymbolEntry(name.ascii(), "constant", "", what, name)
        if (entry, size) not in given:
            given.append((entry, size))
        return Sym(entry.name)

    @cached_property
    def lengths(self) -> dict[Tree, Tree]:
        """What stands under roots, and each of them: b of a row √A = b, a symbol of any other."""
        return self._known | {base: Sym(entry.name) for entry, base in self.named}

    @cached_property
    def _known(self) -> dict[Tree, Tree]:
        moving = {*self.subject.names, "t"}
        return {found[0]: found[1] for row in self.subject.rows if (found := root_of(row, moving))}

    @cached_property
    def named(self) -> list[tuple[SymbolEntry, Tree]]:
        """Symbols for roots that are in rows again and again, and what stands under them: of a wound string the length that is free."""
        levels = (tree for row in self.subject.rows for tree in (row.value, row.rate, row.acceleration) if tree is not None)
        roots = [part.base for tree in levels for part in walk(tree) if isinstance(part, Pow) and part.exponent.denominator == 2]
        seen = [[base] for base in self._known]
        for base in (base for base in roots if isinstance(base, Add) and symbols(base) - self.subject.constants.keys()):
            same = next((each for each in seen if is_zero(difference(each[0], base))), None)
            (same.append if same else lambda base: seen.append([base]))(base)
        often = [each[0] for each in seen[len(self._known) :] if len(each) >= _OFTEN]
        wanted = [Name("s", (str(i),) if len(often) > 1 else ()) for i in range(1, len(often) + 1)]
        given = (self.subject.symbols.taken.give(f"the root {name.ascii()}", name) for name in wanted)
        return [(SymbolEntry(name.ascii(), "coordinate", "m", "", name), base) for name, base in zip(given, often, strict=True)]

    @cached_property
    def values(self) -> dict[Sym, float]:
        """The numbers of all symbols, those of roots as well."""
        values, tables = self.subject.values, self.subject.tables
        values = values | {Sym(entry.name): size for entry, size in self.rates}
        return values | {Sym(entry.name): evaluate(power(base, "1/2"), values, tables) for entry, base in self.named}

    @property
    def symbols(self) -> list[SymbolEntry]:
        """Those that a page has besides: of roots, and of numbers in laws."""
        return [entry for entry, _ in (*self.rates, *self.named)]

    def settled(self, tree: Tree) -> Tree:
        """An expression without roots that are known, or have a symbol."""

        def put(part: Tree) -> Tree | None:
            base, exponent = (part.base, part.exponent) if isinstance(part, Pow) else (part, Fraction(1))
            found = self._by_length(base) if isinstance(base, Add) or part is not base else None
            if found is None:
                return quotient(mul(*(rebuilt(f, put) for f in part.factors)), ONE) if isinstance(part, Mul) else None
            root, more, size = found
            whole = exponent.denominator == 1
            scaled = number((1 / size) ** int(exponent)) if whole else ONE if size == 1 else power(number(1 / size), exponent)
            return mul(scaled, power(root, 2 * exponent) if is_zero(more) else power(add(power(root, 2), more), exponent))

        return rebuilt(tree, put) if self.lengths else tree

    def _by_length(self, base: Tree) -> tuple[Tree, Tree, Fraction] | None:
        """A known root b, what does not move, c, and a number k, where an expression is (b² + c)/k."""
        if base in self._tried:
            return self._tried[base]
        fixed = self.subject.constants.keys()
        self._tried[base] = None
        near = [(inside, root) for inside, root in self.lengths.items() if symbols(inside) - fixed == symbols(base) - fixed]
        for size in map(Fraction, (1, 2, "1/2", -1)):
            for inside, root in near:
                more = difference(mul(number(size), base), inside)
                if symbols(more) <= fixed:
                    self._tried[base] = root, more, size
                    return self._tried[base]
        return None

    @cached_property
    def _tried(self) -> dict[Tree, tuple[Tree, Tree, Fraction] | None]:
        """What ``_by_length`` has found before."""
        return {}

    @cached_property
    def follow(self) -> dict[Sym, Tree]:
        """Places, rates and accelerations that others give, where that takes no root and no division by what moves."""
        found: dict[Sym, Tree] = {}
        for dots, level in enumerate(("value", "rate", "acceleration")):
            rows = [row for row in self.rows if row.kind != "motion" or dots == 2]
            for tree in (getattr(row, level) for row in rows):
                if tree is not None and (one := self._one(put(tree, found), dots)):
                    found = {x: put(known, dict([one])) for x, known in found.items()} | dict([one])
        return found

    def _one(self, tree: Tree, dots: int) -> tuple[Sym, Tree] | None:
        """The symbol with the plainest factor that depends on nothing that moves, in what vanishes, and what it is."""
        names, found = {*self.subject.names}, []
        for x in (x for x in symbols(tree) if x.dots == dots and x.name in names) if operations(tree) <= _MOST else ():
            try:
                linear = linear_in(tree, [x])
            except ValueError:
                continue
            factor = linear.coefficients[x]
            if not is_zero(factor) and not {y.name for y in symbols(factor)} & names:
                found.append((operations(factor), x.name, x, quotient(negative(linear.rest), factor)))
        return min(found)[2:] if found else None

    def put(self, tree: Tree) -> Tree:
        """An expression with these put in, where that makes it shorter."""
        tree = self.settled(tree)
        if operations(tree) > _MOST or not symbols(tree) & self.follow.keys():
            return tree
        return min(tree, factored(self.put_in(tree)), key=lambda each: length(each)[0])

    def put_in(self, tree: Tree) -> Tree:
        """An expression with these put in."""
        return _plain(put(tree, self.follow))

    def reduced(self, stated: Stated) -> tuple[Stated, list[Sym]]:
        """A balance with these put in, where its scalar equation is shorter so, and the accelerations that are."""
        if self.lengths:
            stated = replace(stated, balance=stated.balance.with_trees(self.settled))
        for x in (x for x, known in self.follow.items() if x.dots == 0 and is_zero(known)):
            stated = replace(stated, balance=stated.balance.with_trees(lambda tree, x=x: at_rest(tree, x)))
        factor = self._below(stated.sides)
        if factor != ONE:
            multiplied = stated.balance.with_trees(lambda tree: times(tree, factor))
            stated = self._shorter(stated, replace(stated, balance=multiplied, factor=factor))
        given = symbols(*stated.sides)
        known = [x for x in self.follow if x.dots == 2 and x in given]
        if not known or sum(map(operations, stated.sides)) > _MOST:
            return stated, []
        made = replace(stated, balance=stated.balance.with_trees(self.put_in), own=0)
        return (made, known) if self._shorter(stated, made) is made else (stated, [])

    def _below(self, sides: Sequence[Tree]) -> Tree:
        """Roots that do not move below a line of some term, and what does not move below a line of every term."""
        terms = [term for side in sides if not is_zero(side) for term in (side.terms if isinstance(side, Add) else (side,))]
        found = [
            [f.base for f in (t.factors if isinstance(t, Mul) else ()) if isinstance(f, Pow) and f.exponent < 0] for t in terms
        ]
        every = set(found[0]).intersection(*found) if found else set()
        fixed = self.subject.constants.keys()
        wanted = lambda part: symbols(part) <= fixed and (part.exponent.denominator == 2 or part.base in every)
        return below(sides, wanted)

    def _shorter(self, *ways: Stated) -> Stated:
        """That of which the scalar equation is shorter."""
        return min(ways, key=lambda each: sum(length(side)[0] for side in each.sides))

    def alone(self, left: Tree, right: Tree) -> tuple[Tree, Tree]:
        """Two sides; with a load alone on the left where it is the only unknown and no acceleration is; 0 on the right."""
        if is_zero(left):
            left, right = right, left
        kinds = self.subject.nomenclature.kind
        unknown = [x for x in symbols(left, right) if x.dots == 2 or kinds(x.name) == "unknown"]
        if len(unknown) != 1 or unknown[0].dots:
            return left, right
        linear = linear_in(minus(right, left), unknown)
        factor = linear.coefficients[unknown[0]]
        if not isinstance(factor, Num) or abs(factor.value) != 1:
            return left, right
        return unknown[0], opposite(linear.rest) if factor.value > 0 else linear.rest

    def result(self, equation: Equation) -> list[Equation]:
        """The acceleration, where it is the only unknown of an equation and short."""
        whole = minus(equation.left, equation.right)
        moving = [x for x in symbols(whole) if x.dots == 2]
        known = all(self.subject.nomenclature.kind(x.name) != "unknown" for x in symbols(whole))
        if len(moving) != 1 or not known or operations(whole) > _SHORT:
            return []
        try:
            linear = linear_in(whole, moving)
        except ValueError:
            return []
        found = quotient(negative(linear.rest), linear.coefficients[moving[0]])
        found = from_sympy(factor(to_sympy(found)))
        found = signed(opposite(negative(found)) if is_negative(found) else found, self.subject.constants)
        return [Equation(moving[0], found, "So")] if not is_zero(found) and length(found)[0] <= _SHORT else []


def _plain(tree: Tree) -> Tree:
    """Multiplied out, nothing that vanishes, double angles by single ones, sin² + cos² being 1."""

    def single(part: Tree) -> Tree | None:
        match part:
            case Pow(base) | Fn("sin", (base,)) if is_zero(base):
                return ZERO
            case Fn("cos", (angle,)) if is_zero(angle):
                return ONE
            case Fn("sin", (Mul((Num(count), angle)),)) if count == 2:
                return mul(number(2), Fn("sin", (angle,)), Fn("cos", (angle,)))
            case Fn("cos", (Mul((Num(count), angle)),)) if count == 2:
                return add(power(Fn("cos", (angle,)), 2), negative(power(Fn("sin", (angle,)), 2)))
        return None

    return spread(pythagorean(spread(rebuilt(tree, single))))

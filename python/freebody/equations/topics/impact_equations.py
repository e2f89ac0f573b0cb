"""An impact symbolically: what touches, rates before and after, impulses in place of forces."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import GROUND, Load, MotionError
from freebody.equations.answers import AGREES
from freebody.equations.balances.minimal import minimal_form
from freebody.equations.derivation.balance_text import Stated, of_bodies
from freebody.equations.derivation.coordinates import stated
from freebody.equations.solve import Singular, TooLarge
from freebody.impact.impacts import Impulsive
from freebody.impact.symbols import ImpulsiveState
from freebody.solve.symbolic_state import Balance
from freebody.solve.symbols import load_words
from freebody.symbolic.algebra import quotient
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.linear import linear_in
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import (
    ZERO,
    Add,
    Mul,
    Num,
    Pow,
    Sym,
    Tree,
    add,
    is_zero,
    mul,
    negative,
    operations,
    power,
    rebuilt,
    symbols,
    walk,
)
from freebody.symbolic.tree import replace as put

if TYPE_CHECKING:
    from freebody.core import Change

_NOTHING = 1e-9
"""Part of what it is measured by, as the mechanism's size and its largest rate, below which a length, an arm or a rate is 0: what an
event leaves of it."""
_HALF = Fraction(1, 2)
MOST_OPERATIONS = 300
"""In a system, or in an answer before it is shortened, above which none is sought symbolically."""

Row = tuple[list[Tree], Tree]


@dataclass(frozen=True)
class Condition:
    """A rate that is 0 after an impact, or minus ``back`` of what it was."""

    name: str
    rate: Tree
    back: Tree


@dataclass(frozen=True)
class Impact:
    """An impact of a run and the mechanism symbolically during it."""

    subject: ImpulsiveState

    @classmethod
    def of(cls, happened: Impulsive) -> Impact:
        """What happened, symbolically. Raises ``Singular`` where what is held then asks more than there are motions."""
        subject = ImpulsiveState.of(happened)
        try:
            _ = subject.table  # asks the core
        except MotionError as error:
            raise Singular(f"there are no equations for this impact, since with the rates before it {error.what}") from None
        return cls(subject)

    @property
    def change(self) -> Change:
        """What the run says of it."""
        return self.subject.impact.change

    @property
    def restitution(self) -> Mapping[str, float]:
        """How much comes back of the approach, by name."""
        return {} if self.change.impulses is None else self.change.impulses.restitution

    @cached_property
    def coefficients(self) -> dict[str, Sym]:
        """The symbol of how much comes back, by name: that of the model, if it has one."""
        spec = self.subject.source.spec
        given = {limit["name"]: limit["restitution"] for kind in ("contacts", "strings", "stops") for limit in spec[kind]}
        named = {name: x for name, x in given.items() if isinstance(x, str) and x.isidentifier()}
        back = [name for name, e in self.restitution.items() if e]
        return {name: Sym(named.get(name, re.sub(r"\W+", "_", f"e_{name}").strip("_"))) for name in back}

    def symbol(self, load: Load) -> Sym:
        """The symbol of an impulse."""
        return Sym(self.subject.impact.given.get(load.name) or impulse(load))

    @cached_property
    def impulses(self) -> dict[Sym, Sym]:
        """The impulse for each unknown force."""
        return {Sym(load.symbol): Sym(impulse(load)) for load in self.forces}

    @property
    def forces(self) -> list[Load]:
        """Unknown loads, which may grow beyond all bounds."""
        return [load for load in self.subject.impact.acting if load.unknown and not load.follows]

    @property
    def slides(self) -> list[Load]:
        """Friction of what slides throughout the impact."""
        return [load for load in self.subject.impact.acting if load.follows]

    def law(self, load: Load) -> Tree:
        """The impulse of friction that slides, by that of the normal force: what it gives along its own direction."""
        place, body = self.subject.free.loads.index(load), load.on[0].body
        group = body if body != GROUND else load.on[1].body
        [balance] = self.subject.balances([{"ask": "equation", "bodies": [group], "along": {"load": place}}])
        share = next(c.tree for c in balance.contributions if c.load == place)
        of, ratio = load.follows or (0, 0.0)
        unit = {Sym(self.subject.free.loads[of].symbol): 1.0}
        same = float(evaluate(share, self.subject.values | unit)) * ratio > 0
        return put(share if same else negative(share), self.impulses)

    @cached_property
    def roots(self) -> dict[Tree, Tree]:
        """What stands under the roots of distances that what holds keeps, and what the roots are there."""
        found = (_root(row.value) for row in self.subject.rows if row.value is not None)
        return dict(pair for pair in found if pair is not None)

    def with_roots(self, tree: Tree) -> Tree:
        """An expression with the ``roots`` as what they are at the impact."""

        def put(part: Tree) -> Tree | None:
            if isinstance(part, Pow) and part.exponent.denominator == 2 and part.base in self.roots:
                return power(self.roots[part.base], 2 * part.exponent)
            return None

        return rebuilt(tree, put) if self.roots else tree

    def after(self, tree: Tree) -> Tree:
        """An expression with the rates after the impact."""
        return put(tree, {Sym(name, 1): Sym(after(name), 1) for name in self.subject.names})

    def jump(self, balance: Balance) -> Tree:
        """Momentum after less momentum before; what is struck from outside stood still."""
        if self.subject.impact.given:
            return self.after(balance.momentum)
        return add(self.after(balance.momentum), negative(balance.momentum))

    def acting(self, balance: Balance) -> Tree:
        """What all impulses give to a balance."""
        happened = self.subject.impact
        parts = [c.tree for c in balance.contributions if not c.absent and happened.grows(happened.free.loads[c.load])]
        return put(add(*parts), self.impulses)

    def conditions(self) -> list[Condition]:
        """What holds after the impact: rates that are 0, or so much of what they were."""
        made = []
        for row in (row for row in self.subject.rows if row.rate is not None):
            closes = row.value is not None and not self.vanishes(row.rate)  # a gap
            back = self.coefficients.get(row.name, ZERO) if closes else ZERO
            made.append(Condition(row.name, self.with_roots(row.rate), back))
        return made

    def conserved(self) -> list[tuple[str, Balance]]:
        """Balances without any impulse, with their titles, as many as stay after what holds; empty where there are none."""
        found = minimal_form([self.subject.free], self.subject.points).equations
        if not found:
            return []
        balances = self.subject.balances([equation.question for equation in found])
        values = self.values | dict.fromkeys(self.impulses, 1.0)  # in numbers: symbols may not see what touches
        grow = [self.subject.impact.grows(load) for load in self.subject.free.loads]
        parts = [c.tree for balance in balances for c in balance.contributions if not c.internal and grow[c.load]]
        if any(abs(float(evaluate(part, values, self.subject.tables))) >= _NOTHING * self.subject.free.extent for part in parts):
            return []
        return [(e.title, b.with_trees(self.with_roots)) for e, b in zip(found, balances, strict=True)]

    @cached_property
    def zeros(self) -> dict[Sym, Tree]:
        """Coordinates, and rates before the impact, that are 0 there; and coordinates that are then as long as what holds."""
        names, units = self.subject.names, self.subject.free.units(self.subject.coordinates)
        places, rates = (np.abs(np.array(of) / units) for of in (self.subject.q, self.subject.u))
        sizes = (places, rates / (rates.max(initial=0.0) or 1.0))
        rest = [Sym(n, dots) for dots, of in enumerate(sizes) for n, x in zip(names, of, strict=True) if x < _NOTHING]
        zeros: dict[Sym, Tree] = dict.fromkeys(rest, ZERO)
        along: dict[Sym, Tree] = {}  # a coordinate that is all of a distance where others are 0: y = −l of what hangs below
        for under, root in self.roots.items():
            factor, square = to_sympy(put(under, zeros)).as_coeff_Mul()
            symbol = from_sympy(square.base) if square.is_Pow and square.exp == 2 else None
            if isinstance(symbol, Sym) and symbol.name in names:
                size = mul(root, from_sympy(factor ** (-to_sympy(Num(_HALF)))))
                along[symbol] = size if self.subject.values[symbol] > 0 else negative(size)
        return zeros | along

    def of_coordinates(self) -> list[Stated]:
        """The balances of the coordinates."""
        return [replace(each, balance=each.balance.with_trees(self.with_roots)) for each in stated(self.subject)]

    def of_bodies(self) -> list[Stated]:
        """The three balances of every body, two of a particle."""
        return [replace(each, balance=each.balance.with_trees(self.with_roots)) for each in of_bodies(self.subject)]

    @cached_property
    def nomenclature(self) -> Nomenclature:
        """The symbols of the model, of impulses and of rates after the impact."""
        known, written = self.subject.nomenclature, self.subject.impulses
        made = [SymbolEntry(after(n), "coordinate", known[n].unit, f"{n}, rate after the impact") for n in self.subject.names]
        for load in self.subject.impact.acting:
            if load.name in self.subject.impact.given:
                made.append(SymbolEntry(self.symbol(load).name, "parameter", "N*s", "the applied impulse"))
            else:
                words = f"impulse of the {load_words(load).removeprefix('the ')}"
                made.append(SymbolEntry(impulse(load), "unknown", "N*s", words, written[load.symbol]))
        own = {name: e.name for name, e in self.coefficients.items() if e.name not in known}
        made += [SymbolEntry(e, "parameter", "", f"restitution at {name}") for name, e in own.items()]
        return Nomenclature({**known, **{symbol.name: symbol for symbol in made}})

    @cached_property
    def values(self) -> dict[Sym, float]:
        """The numbers of the symbols before the impact."""
        return self.subject.values | {e: self.restitution[name] for name, e in self.coefficients.items()}

    @property
    def rates_after(self) -> dict[Sym, float]:
        """Those after it."""
        return {Sym(after(name), 1): u for name, u in self.change.after.u.items()} if self.change.after else {}

    def vanishes(self, rate: Tree) -> bool:
        """Whether a rate is 0 just before the impact."""
        return abs(float(evaluate(rate, self.values, self.subject.tables))) <= _NOTHING * self._size(rate)

    def holds(self, condition: Condition) -> bool:
        """Whether a condition holds after the impact, to the rounding of the rates."""
        values = self.values | self.rates_after
        one, other = (float(evaluate(side, values, self.subject.tables)) for side in self.sides(condition))
        return abs(one - other) <= 10 * AGREES * self._size(condition.rate)

    def sides(self, condition: Condition) -> tuple[Tree, Tree]:
        """Of its equation: the rate after the impact, and what it is; not one less than nothing."""
        parts = condition.rate.terms if isinstance(condition.rate, Add) else (condition.rate,)
        turned = all(isinstance(part, Mul) and isinstance(part.factors[0], Num) and part.factors[0].value < 0 for part in parts)
        rate = negative(condition.rate) if turned else condition.rate
        return self.after(rate), negative(mul(condition.back, rate))

    def agrees(self, solution: Mapping[Sym, Tree]) -> bool:
        """Whether rates after the impact are those that happened, and impulses those that the jumps of momenta take."""
        sizes = {x: size for x, size in self.sizes().items() if x in solution and not np.isnan(size)}
        usual = np.nan_to_num([abs(load.value) for load in self.subject.impact.impulses.loads]).max(initial=0.0)
        after = zip(self.rates_after.items(), self._usual_rates.values(), strict=True) if self.change.after else ()
        pairs = [(x, u, most) for (x, u), most in after] + [(x, size, usual) for x, size in sizes.items()]
        found = {x: float(evaluate(solution[x], self.values, self.subject.tables)) for x, *_ in pairs}
        return all(abs(found[x] - true) <= 10 * AGREES * most for x, true, most in pairs)

    def otherwise(self) -> str:
        """Why an impact is not what its equations say."""
        if any(load.kind == "friction" for load in self.forces):
            return (
                "sliding reverses or stops during the impact, so that the impulse of friction is neither the largest in one direction "
                "nor what sticking takes; the run resolves that stage by stage"
            )
        return f"the run takes another law of impact. {self.change.note}".strip()

    @cached_property
    def _usual_rates(self) -> dict[str, float]:
        """What the rate of each coordinate is measured by: the largest before and after, in radians and sizes of the mechanism."""
        units = self.subject.free.units(self.subject.coordinates)
        sides = [list(each.u.values()) for each in (self.change.before, self.change.after) if each]
        largest = max((np.abs(u / units).max(initial=0.0) for u in sides), default=0.0) or 1.0
        return dict(zip(self.subject.names, (largest * units).tolist(), strict=True))

    def _size(self, rate: Tree) -> float:
        """What an expression that is linear in the rates is measured by: what the usual ones give to it."""
        at_rest = self.values | {Sym(name, 1): 0.0 for name in self.subject.names}
        base = evaluate(rate, at_rest, self.subject.tables)
        usual = ({Sym(name, 1): size} for name, size in self._usual_rates.items())
        return float(sum(abs(evaluate(rate, at_rest | one, self.subject.tables) - base) for one in usual))

    def sizes(self) -> dict[Sym, float]:
        """The impulses in numbers; NaN of one that the momenta do not determine."""
        happened = self.subject.impact
        return {self.symbol(load): load.value for load in happened.impulses.loads if load.name not in happened.given}


def _root(value: Tree) -> tuple[Tree, Tree] | None:
    """The one root with coordinates in a distance that is 0: what stands under it, and what it is then by what has none."""
    under = {part.base for part in walk(value) if isinstance(part, Pow) and part.exponent == _HALF}
    if len(under) != 1:
        return None
    [base], root = under, Sym("root")
    try:
        parts = linear_in(rebuilt(value, lambda part: root if part == Pow(base, _HALF) else None), [root])
    except ValueError:
        return None
    if root not in parts.coefficients or symbols(base) & symbols(parts.rest, parts.coefficients[root]):
        return None
    return base, quotient(negative(parts.rest), parts.coefficients[root])


def impulse(load: Load) -> str:
    """The symbol of an impulse: ``bump.J_N``, ``pivot.J_x``."""
    owner, _, part = load.symbol.rpartition(".")
    return f"{owner or load.name}.J_{part.removeprefix('F') or part}"


def after(name: str) -> str:
    """The symbol of a coordinate whose rate is that after the impact."""
    return re.sub(r"(?<=[^0-9])(?=[0-9]+$)", "_", name) + "_after"


@dataclass(frozen=True)
class Rows:
    """What an impact asks, linear in what is unknown: the ``mass`` matrix and, of impulses, what they give to the balance of each
    coordinate (with what is given besides); then of each ``condition`` the factors of the rates, and the rest."""

    mass: list[list[Tree]]
    gives: list[Row]
    conditions: list[tuple[Condition, Row]]
    impulses: list[Sym]

    @classmethod
    def of(cls, found: Impact) -> Rows:
        """Those of an impact, without impulses that no coordinate feels, and without conditions that hold by themselves."""
        before = [Sym(name, 1) for name in found.subject.names]
        now, impulses = [Sym(after(x.name), 1) for x in before], list(found.impulses.values())
        balances = [each.balance for each in found.of_coordinates()]
        gives = [_row(found.acting(each), impulses) for each in balances]
        felt = [k for k in range(len(impulses)) if any(not is_zero(row[k]) for row, _ in gives)]
        asked = [(each, _row(each.rate, before)) for each in found.conditions()]
        return cls(
            [_row(found.jump(each), now)[0] for each in balances],
            [([row[k] for k in felt], rest) for row, rest in gives],
            [(each, row) for each, row in asked if not all(map(is_zero, row[0]))],
            [impulses[k] for k in felt],
        )

    def matrix(self, found: Impact) -> tuple[list[list[float]], list[float]]:
        """A and b of A (rates after, impulses) = b, in numbers."""
        n, m, values, tables = len(self.mass), len(self.impulses), found.values, found.subject.tables
        before = np.array([values[Sym(name, 1)] for name in found.subject.names])

        def number(tree: Tree) -> float:
            return float(evaluate(tree, values, tables))

        rows = (self.mass, [row for row, _ in self.gives], [row for _, (row, _) in self.conditions])
        shapes = zip(rows, (n, m, n), strict=True)
        mass, gives, held = (np.array([[number(x) for x in row] for row in of]).reshape(len(of), k) for of, k in shapes)
        rest = [number(rest) for _, rest in self.gives]
        back = [-number(mul(each.back, each.rate)) - number(rest) for each, (_, rest) in self.conditions]
        a = np.block([[mass, -gives], [held, np.zeros((len(held), m))]])
        return a.tolist(), [*(mass @ before + rest), *back]


def _row(tree: Tree, unknowns: Sequence[Sym]) -> Row:
    parts = linear_in(tree, unknowns)
    return [parts.coefficients.get(x, ZERO) for x in unknowns], parts.rest


def require_brief(trees: Sequence[Tree], most: int = MOST_OPERATIONS) -> None:
    """Raises ``TooLarge``."""
    if (size := sum(map(operations, trees))) > most:
        raise TooLarge(f"what acts together has {size} operations, which is too long for a symbolic answer")

"""The return map in symbols: of a mechanism of one freedom that loses nothing between an impact and the next.

Energy says the square of the rate just before the impact. The motion that is free after it keeps its momentum, since no impulse is in
its balance (Ruina & Pratap, *Introduction to Statics and Dynamics*, on collisions; Coleman, PhD thesis, Cornell 1998, on the wheel).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import GROUND
from freebody.document.blocks import Equation, Heading, Paragraph
from freebody.document.document import Document
from freebody.equations.derivation.conserved import energy
from freebody.equations.language import NoForm, definitions, read_text
from freebody.impact.impacts import NoImpact, find
from freebody.impact.symbols import ImpulsiveState
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.factoring import factor
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import Mul, Sym, Tree, replace

if TYPE_CHECKING:
    from freebody.periodic.return_map import ReturnMap
    from freebody.run.simulation import Run

_AGREES = 1e-9
"""Part by which the map in symbols may differ from a return that is followed in numbers."""
_BESIDE = (1.0, 1.01, 1.03)
"""Parts of the start from which both are compared."""
_PLACE = 1e-9
"""Angle, rad, or part of the place, within which a zero in symbols is where the impact is."""


class NoSymbolicMap(ValueError):
    """A return map that is not found in symbols: why."""


@dataclass(frozen=True)
class SymbolicMap(Document):
    """x₊² = ``gain`` x² + ``feed`` for the one unknown x of a return map; the square of the x that repeats itself, ``fixed``; and the
    ``multiplier`` dx₊/dx of perturbations there, which is ``gain``. ``begins`` and ``ends`` are where the coordinate that is free
    starts and where it is at the impact, which multiplies its rate by ``factor``. Trees in symbols of the model, SI.

    It was held against ``checked`` returns in numbers. Whether a motion with ``fixed`` comes as far as the impact, only these say."""

    begins: Tree = field(kw_only=True)
    ends: Tree = field(kw_only=True)
    factor: Tree = field(kw_only=True)
    gain: Tree = field(kw_only=True)
    feed: Tree = field(kw_only=True)
    fixed: Tree = field(kw_only=True)
    checked: int = field(kw_only=True)

    @property
    def multiplier(self) -> Tree:
        """dx₊/dx = ``gain`` x/x₊ where both are one."""
        return self.gain


def symbolic_map(returns: ReturnMap, start: float) -> SymbolicMap:
    """The map of one unknown, a rate, held against numbers near a ``start``. Raises ``NoSymbolicMap``, ``NoReturn``."""
    if len(returns.unknowns) != 1:
        raise NoSymbolicMap(
            f"the map has {len(returns.unknowns)} unknowns; in symbols it is found for one, the rate of the start"
        )
    step = _Step(returns, returns([start]).run)
    begins, ends = step.begins(), step.ends()
    before, after = step.ways(step.impact.rows_before), step.ways(step.impact.rows)
    inertia = _short(step.twice_kinetic(before))
    left = step.twice_kinetic(after)
    momentum = (step.twice_kinetic([v + w for v, w in zip(before, after, strict=True)]) - step.twice_kinetic(before) - left) / 2
    factor = _short((momentum / left).subs(step.free, ends))
    first, last = (inertia.subs(step.free, place) for place in (begins, ends))
    given = sympy.integrate(-step.force(before), (step.free, begins, ends))
    own, put_in = step.rate_read(after) ** 2, _short(2 * given / last)
    kept = _short(step.rate_at_start() ** 2 * first / last)
    gain = _short(own * factor**2 * kept)
    trees = {"begins": begins, "ends": ends, "factor": factor, "gain": gain, "feed": own * factor**2 * put_in}
    trees["fixed"] = _short(trees["feed"] / (1 - gain))
    named = {name: from_sympy(tree) for name, tree in trees.items()}
    checked = _held(returns, start, step.numbers, named["gain"], named["feed"])
    return SymbolicMap(*_stated(step, named, kept, own, put_in), **named, checked=checked)


class _Step:
    """One return: a phase in which nothing switches, and the impact that ends it, in symbols."""

    def __init__(self, returns: ReturnMap, run: Run) -> None:
        try:
            happened = find(run, 1)
        except NoImpact as error:
            raise NoSymbolicMap(f"the map in symbols goes from impact to impact: {error}") from None
        if early := [change for change in run.changes if run.start.t < change.t < happened.change.t]:
            raise NoSymbolicMap(f"{', '.join(early[0].of)}: {early[0].kind} at t = {early[0].t:.6g} s, before the impact")
        self.returns, self.start = returns, returns.mechanism.lowered().start
        self.impact = ImpulsiveState.of(happened)
        self.subject = SymbolicState(run.source, run.start, given=run.source.free_bodies(run.start))
        kinetic, potential, lost = energy(self.subject)
        if lost:
            raise NoSymbolicMap(f"the energy does not stay on the way: {lost}")
        self.defined = {Sym(x): tree for x, tree in definitions(run.source, set(returns.unknowns)).items()}
        self.kinetic, self.potential = self.spelt(kinetic), self.spelt(potential)
        self.names = self.subject.names
        self.places, self.rates = ([to_sympy(Sym(name, dots)) for name in self.names] for dots in (0, 1))
        moving = [i for i, u in enumerate(happened.state.u) if u]
        turning = [i for i in moving if self.subject.coordinates[i]["dimension"] == "rad"]
        if not moving:
            raise NoSymbolicMap("nothing moves before the impact")
        self.which = (turning or moving)[0]
        self.free = self.places[self.which]
        self.numbers = dict(self.subject.values)
        self.end = float(happened.state.q[self.which])

    def spelt(self, tree: Tree) -> Any:
        """A tree as SymPy has it, parameters by those that define them."""
        return to_sympy(replace(tree, self.defined))

    def read(self, text: Any) -> Any:
        """An expression of the model file. Raises ``NoSymbolicMap``."""
        try:
            return self.spelt(read_text(str(text)))
        except NoForm as error:
            raise NoSymbolicMap(f"`{text}` has no symbolic form: {error}") from None

    def ways(self, rows: Sequence[Row]) -> list[Any]:
        """The rates of all coordinates for a unit of the free one, where rows hold. Raises ``NoSymbolicMap``."""
        others = [rate for i, rate in enumerate(self.rates) if i != self.which]
        held = [self.spelt(row.rate) for row in rows if row.rate is not None]
        found = (sympy.solve(held, others, dict=True) if others else [{}]) or [{}]
        made = [found[0].get(rate, rate).subs(self.rates[self.which], 1) for rate in self.rates]
        if any(way.has(*others) for way in made if others):
            raise NoSymbolicMap("more than one freedom is left; in symbols the map of one is found")
        return made

    def twice_kinetic(self, ways: Sequence[Any]) -> Any:
        """2 T of rates."""
        return 2 * self.kinetic.subs(dict(zip(self.rates, ways, strict=True)), simultaneous=True)

    def force(self, ways: Sequence[Any]) -> Any:
        """∂V along a motion, by the free coordinate alone."""
        slope = _short(sum(self.potential.diff(q) * way for q, way in zip(self.places, ways, strict=True)))
        slope = _short(slope.subs(self.closed))
        if slope.has(*(place for place in self.places if place != self.free)):
            raise NoSymbolicMap(f"the potential energy is not found by {self.names[self.which]} alone")
        return slope

    @cached_property
    def closed(self) -> Mapping[Any, Any]:
        """The other coordinates by the free one, as far as what holds on the way says."""
        others = [place for place in self.places if place != self.free]
        held = [self.spelt(row.value) for row in self.impact.rows_before if row.value is not None]
        return (sympy.solve(held, others, dict=True) or [{}])[0] if held and others else {}

    def begins(self) -> Any:
        """The free coordinate at the start. Raises ``NoSymbolicMap``."""
        for name, text in self.start.fixed.items():
            if (reading := self.reading(name)) is not None and reading.free_symbols & {*self.places} == {self.free}:
                return _short(sympy.solve(reading - self.read(text), self.free)[0])
        raise NoSymbolicMap(f"`initial` does not say {self.names[self.which]}")

    def ends(self) -> Any:
        """The free coordinate where what begins to hold at the impact closes. Raises ``NoSymbolicMap``."""
        for row in self.impact.rows:
            if row.value is not None:
                gap = sympy.expand(self.spelt(row.value).subs(self.closed))
                for zero in _zeros(gap, self.free, self.value):
                    if abs(self.value(zero) - self.end) <= _PLACE * max(1.0, abs(self.end)):
                        return _short(zero)
        raise NoSymbolicMap("where the impact is, is not found in symbols")

    def value(self, expression: Any) -> float:
        """The number of an expression, with the free coordinate as it is at the impact."""
        return float(evaluate(from_sympy(expression), self.numbers | {Sym(self.names[self.which]): self.end}))

    def reading(self, name: str) -> Any:
        """A coordinate, or the angle of a hinge that closes a loop, by the coordinates; None for others."""
        if name in self.names:
            return to_sympy(Sym(name))
        joints = self.subject.source.metadata["joints"]
        for joint in (each for each in joints if each["type"] == "hinge" and each["coordinates"] == [name]):
            angles = {motion.body: self.spelt(motion.angle) for motion in self.subject.motions} | {GROUND: sympy.Integer(0)}
            return angles[joint["second"]] - angles[joint["first"]]
        return None

    def rate_at_start(self) -> Any:
        """The rate of the free coordinate for a unit of the unknown. Raises ``NoSymbolicMap``."""
        unknown = self.read(self.returns.unknowns[0])
        stated = self.start.rates | {name: name for name in self.names if unknown == to_sympy(Sym(name, 1))}
        for name, text in stated.items():
            reading = self.reading(name)
            rate = unknown if text == name else self.read(text)
            if reading is not None and reading.free_symbols & {*self.places} == {self.free} and rate.has(unknown):
                share = sympy.expand(rate / reading.diff(self.free)).coeff(unknown)
                if _short(rate - share * unknown) == 0:
                    return share
        raise NoSymbolicMap(f"{self.names[self.which]} does not start with a rate proportional to {self.returns.unknowns[0]}")

    def rate_read(self, ways: Sequence[Any]) -> Any:
        """What is read when the motion comes back, for a unit of the rate of the free coordinate. Raises ``NoSymbolicMap``."""
        read = self.read(self.returns.returns[0])
        share = read.subs(dict(zip(self.rates, ways, strict=True)), simultaneous=True)
        if share.has(*self.places) or read.subs(dict.fromkeys(self.rates, 0)) != 0:
            raise NoSymbolicMap(f"`{self.returns.returns[0]}` is not proportional to the rates; give back a rate")
        return share


def _zeros(expression: Any, x: Any, value: Any) -> Iterator[Any]:
    """Zeros of an expression that is a product once sums of sines and cosines are made products: of an angle that of all nearest to
    the place at which ``value`` evaluates."""
    from sympy.simplify.fu import TR8, TR9

    made = TR8(expression)
    for _ in range(3):
        made = sympy.factor_terms(TR9(made))
    for part in sympy.Mul.make_args(factor(made)):
        inner = part.args[0] if isinstance(part, (sympy.sin, sympy.cos)) else part
        if inner.has(x) and sympy.expand(inner).diff(x, 2) == 0:
            quarter = sympy.pi / 2 if isinstance(part, sympy.cos) else sympy.Integer(0)
            turns = round((value(inner) - float(quarter)) / np.pi) if inner is not part else 0
            yield from sympy.solve(inner - quarter - turns * sympy.pi, x)


def _short(expression: Any) -> Any:
    """The shortest of some forms."""
    from sympy.simplify.fu import TR8, TR9

    simple = sympy.trigsimp(factor(sympy.trigsimp(expression)))
    above, below = (TR8(sympy.expand(part)) for part in sympy.fraction(sympy.together(simple)))
    forms = [expression, simple, TR9(sympy.expand(simple)), sympy.cancel(above / below)]
    return min(map(sympy.factor_terms, forms), key=sympy.count_ops)


def _held(returns: ReturnMap, start: float, numbers: Mapping[Sym, float], gain: Tree, feed: Tree) -> int:
    """At how many starts the map agrees with numbers. Raises ``NoSymbolicMap`` where it does not."""
    k, c = (float(evaluate(tree, numbers)) for tree in (gain, feed))
    for part in _BESIDE:
        there = float(returns.value(np.array([part * start]))[0][0])
        if abs(there**2 - (k * (part * start) ** 2 + c)) > _AGREES * max(there**2, abs(c)):
            raise NoSymbolicMap(f"the map in symbols says {(k * (part * start) ** 2 + c) ** 0.5:g} where numbers say {there:g}")
    return len(_BESIDE)


def _stated(step: _Step, named: Mapping[str, Tree], kept: Any, own: Any, put_in: Any) -> tuple[list[Any], Nomenclature]:
    """The derivation as a document, with a symbol for what the impact leaves of the rate."""
    name, known, place = step.returns.unknowns[0], step.subject.nomenclature, Sym(step.names[step.which])
    x, back, eta = (sympy.Symbol(each) for each in (name, f"{name}_back", "eta_impact"))
    entries = [SymbolEntry(f"{name}_back", "parameter", known[name].unit if name in known else "", f"{name} when it comes back"),
               SymbolEntry("eta_impact", "parameter", "", "what the impact multiplies the rate by")]  # fmt: skip
    part = own * eta**2
    blocks = [
        Heading(step.subject.titled("return map"), 1),
        Equation(place, named["begins"], "At the start"),
        Equation(place, named["ends"], "At the impact"),
        Paragraph(["In between the energy stays, and the impact multiplies the rate of ", place, " by"]),
        Equation(from_sympy(eta), named["factor"]),
        Equation(from_sympy(back**2), Mul((from_sympy(part), from_sympy(kept * x**2 + put_in))), "So it comes back with"),
        Equation(from_sympy(x**2), from_sympy(part * put_in / (1 - part * kept)), "It repeats itself with"),
        Equation(Sym("multiplier"), from_sympy(part * kept), "where perturbations are multiplied by"),
    ]
    return blocks, Nomenclature({**known, **{entry.name: entry for entry in entries}})

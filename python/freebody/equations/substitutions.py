"""What a question sets: symbols to exact numbers, ``45 deg`` is π/4, or to other symbols."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from dataclasses import replace as replaced
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.core import Array, MotionError, State
from freebody.equations.language import definitions
from freebody.model.start import evaluate as quantity
from freebody.model.start import parameter_values
from freebody.solve.perturbed_states import alike
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.decimals import exact, with_exact_numbers
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.nomenclature import is_heavy
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import PI, ZERO, Sym, Tree, mul, number, replace, symbols

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_DEGREES = re.compile(r"\s*(-?\d+(?:\.\d+)?(?:/\d+)?)\s*(?:deg|°)\s*")
_NUMBER = re.compile(r"\s*-?\d+(?:\.\d+)?(?:/\d+)?\s*")
_NEAR = 0.15
"""How far other states for checks are, in rad and m, and parts of parameters."""


@dataclass(frozen=True)
class Substitutions:
    """Symbols with what they are set to; ``measured``: lengths and angles among them, because symbols would fill pages.
    ``immobile``: coordinates whose rates and accelerations are 0. ``defined``: parameters by those that define them. ``follow``:
    coordinates and rates by the others on which they depend. ``at_start``: symbols set to where they start."""

    trees: Mapping[str, Tree]
    measured: bool = False
    immobile: frozenset[str] = frozenset()
    defined: Mapping[str, Tree] = field(default_factory=dict)
    follow: Mapping[Sym, Tree] = field(default_factory=dict)
    at_start: frozenset[str] = frozenset()

    def is_immobile(self, symbol: Sym) -> bool:
        """Whether a symbol is the rate or acceleration of a coordinate that stands still."""
        return symbol.dots > 0 and symbol.name in self.immobile

    def put(self, tree: Tree) -> Tree:
        """An expression with the symbols replaced, and plain numbers exact."""
        new = {Sym(name): value for name, value in self.trees.items()}
        new |= {Sym(name, dots): ZERO for name in self.immobile for dots in (1, 2)}
        new |= self.follow
        given = with_exact_numbers(tree)
        made = replace(given, {Sym(name): value for name, value in self.defined.items()})
        return from_sympy(to_sympy(replace(made, new))) if made != given or symbols(made) & new.keys() else made

    def settled(self) -> dict[str, Tree]:
        """What is set, and what is defined, by symbols that are neither."""
        set_to = {Sym(name): tree for name, tree in self.trees.items()}
        return dict(self.trees) | {name: replace(tree, set_to) for name, tree in self.defined.items()}

    def and_numbers(self, numbers: Mapping[str, float]) -> Substitutions:
        """With more symbols set, to measured numbers."""
        return replaced(self, trees={name: exact(value) for name, value in numbers.items()} | dict(self.trees), measured=True)

    def start(self, mechanism: Builder, at_rest: bool, initial: Mapping[str, Any] | None, **moment: Any) -> State:
        """The start of the model with these values, or another moment of the motion from there. Raises ``ModelFileError``, ``MotionError``."""
        first, _ = mechanism.start(initial)
        changes = self._numbers(parameter_values(mechanism.source(), first.p))
        if at_rest:
            changes["at_rest"] = True
            if initial is None and mechanism.lowered().start.rates:
                changes["rates"] = {}
        return mechanism.moment(initial=initial, **changes, **moment)[0]

    def near(self, subject: SymbolicState, rng: np.random.Generator) -> State | None:
        """Another state, at rest if the subject is, in which the same symbols are set, and what moves does so in the same sense;
        None where it cannot be assembled."""
        source, state = subject.source, subject.state
        names = source.coordinate_names
        p = self.parameters_near(subject, state, rng)
        q = dict(zip(names, (state.q + rng.uniform(-_NEAR, _NEAR, len(names))).tolist(), strict=True))
        fixed = {name: x for name, x in self._consistent(parameter_values(source, p)).items() if name in q}
        parts = rng.uniform(-1, 1, len(names))
        rates = [] if subject.at_rest else [u * (1 + part / 2) if u else part for u, part in zip(state.u, parts, strict=True)]
        try:
            found, _ = source.assemble(
                p, state.t, fixed=fixed, guess={n: x for n, x in q.items() if n not in fixed}, history=state.history
            )
            return replaced(found, u=np.array(rates)) if rates and source.metadata["freedom"]["count"] == len(names) else found
        except MotionError:
            return None

    def parameters_near(self, subject: SymbolicState, state: State, rng: np.random.Generator) -> Array:
        """Parameters beside those of a state, with which it may not close; what is set stays so."""
        values = parameter_values(subject.source, state.p * rng.uniform(1 - _NEAR, 1 + _NEAR, len(state.p)))
        set_to = self._consistent(values)
        return subject.source.bind({name: set_to.get(name, value) for name, value in values.items()})

    def generic(self, subject: SymbolicState) -> State:
        """The state where no parameter is 0 by chance, so that what drops out of a balance does so whatever they are."""
        source, state = subject.source, subject.state
        values = {name: value or _NEAR for name, value in parameter_values(source, state.p).items()}
        set_to = self._consistent(values)
        p = source.bind({name: set_to.get(name, value) for name, value in values.items()})
        try:
            place, _ = source.assemble(
                p, state.t, guess=dict(zip(source.coordinate_names, state.q.tolist(), strict=True)), history=state.history
            )
        except MotionError:
            return state
        found = replaced(place, u=state.u)
        return found if alike(replaced(subject, state=found).free, subject.free) else state

    def _consistent(self, parameters: Mapping[str, float]) -> dict[str, Any]:
        """What is set, and what is defined, where the other parameters are as given."""
        set_to = self._numbers(parameters)
        values = {Sym(name): value for name, value in (dict(parameters) | set_to).items()}
        return set_to | {name: float(evaluate(tree, values)) for name, tree in self.defined.items() if name in parameters}

    def _numbers(self, parameters: Mapping[str, float]) -> dict[str, Any]:
        values = {Sym(name): value for name, value in parameters.items()}
        return {name: float(evaluate(tree, values)) for name, tree in self.trees.items()}


def substitutions_of(mechanism: Builder, set: Mapping[str, Any], free: Collection[str] = ()) -> Substitutions:
    """What is set, exactly, and lengths and angles that the model defines by others, but what is ``free``. Raises ``ValueError`` where it is no
    quantity and no symbol."""
    source = mechanism.source()
    units = {p["name"]: p["unit"] for p in source.metadata["parameters"]}
    parameters, known = [*units], [*units, *source.coordinate_names]
    for name in set:
        if name not in known:
            raise ValueError(f"{name!r} cannot be set; there are {', '.join(known)}")
    defined = {name: tree for name, tree in definitions(source, {*set, *free}).items() if not is_heavy(units[name])}
    named = {Sym(name): tree for name, tree in defined.items()}
    return Substitutions({name: replace(_exact(value, parameters), named) for name, value in set.items()}, defined=defined)


def _exact(value: Any, parameters: list[str]) -> Tree:
    from freebody.model.errors import ModelProblem

    if isinstance(value, int | float | Fraction) and not isinstance(value, bool):
        return exact(float(value))
    if found := _DEGREES.fullmatch(str(value)):
        return mul(number(Fraction(found[1]) / 180), Sym(PI))
    if _NUMBER.fullmatch(str(value)):
        return number(Fraction(str(value).strip()))
    if str(value).strip() in parameters:
        return Sym(str(value).strip())
    try:
        return exact(quantity(str(value), {}))
    except ModelProblem as problem:
        raise ValueError(f"{str(value)!r} is no quantity and none of {', '.join(parameters)}: {problem.what}") from None

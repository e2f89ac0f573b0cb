"""What a part of a wrong equation would have to be: the equation solved for that part, on every state."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from freebody.symbolic.evaluate import Array, sampled, spread
from freebody.symbolic.tree import Add, Dot, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, is_zero, unsigned

from .language.statements import Equation

_INVERSES: Mapping[str, Callable[[Array], Array]] = {
    "sqrt": lambda root: np.where(root >= 0, root**2, np.nan),
    "exp": np.log,
    "ln": np.exp,
}
"""What a function is of, by its value."""
_PARALLEL = 1e-9  # sine of the angle below which two vectors have one direction


@dataclass(frozen=True)
class RequiredTerm:
    """A part with its value and the value that would make the equation true; ``addend``: it is added to something."""

    node: Node
    value: Array
    needed: Array
    addend: bool = False

    @property
    def missing(self) -> Array:
        """What has to be added to it."""
        return self.needed - self.value

    @property
    def factor(self) -> Array | None:
        """By what it has to be multiplied, (K,); None where a vector would have to turn."""
        if self.value.ndim == 1:
            return self.needed / self.value
        along = np.sum(self.value * self.needed, axis=1) / np.sum(self.value**2, axis=1)
        off = np.linalg.norm(self.needed - along[:, None] * self.value, axis=1)
        size = np.linalg.norm(self.needed, axis=1) + np.linalg.norm(self.value, axis=1)
        return along if np.all(off <= _PARALLEL * size) else None


def is_asked(side: Node) -> bool:
    """Whether an equation may be solved for a side: a symbol, or the sum or difference of some."""
    return all(isinstance(unsigned(term), Sym) for term in (side.terms if isinstance(side, Add) else (side,)))


def required_terms(equation: Equation, values: Mapping[str, Array]) -> Iterator[RequiredTerm]:
    """Every part of numbers or vectors for which the equation can be solved, sides first."""
    with np.errstate(all="ignore"):
        left, right = (None if is_zero(side) else sampled(side, values) for side in (equation.left, equation.right))
        if left is not None and right is not None and left.ndim != right.ndim:
            return  # a number beside a vector
        for side, value, other in ((equation.left, left, right), (equation.right, right, left)):
            if value is not None and value.ndim < 3:
                yield from parts_inside(RequiredTerm(side, value, np.zeros_like(value) if other is None else other, True), values)


def parts_inside(required: RequiredTerm, values: Mapping[str, Array]) -> Iterator[RequiredTerm]:
    """A part, and what the parts inside it would have to be."""
    yield required
    match required.node:
        case Add(terms=terms):
            parts = [(term, sampled(term, values)) for term in terms if not is_zero(term)]
            for term, value in parts:
                yield from parts_inside(RequiredTerm(term, value, value + required.missing, True), values)
        case Negative(of=of):
            yield from parts_inside(RequiredTerm(of, -required.value, -required.needed, required.addend), values)
        case Mul(factors=factors):
            yield from _factors(required, factors, values)
        case Dot(left=left, right=right):
            yield from _factors(required, (left, right), values)
        case Quotient(top=top, bottom=bottom):
            yield from _quotient(required, top, bottom, values)
        case Pow(base=base, exponent=Num(value=n)) if n and not isinstance(base, Fn):
            value = sampled(base, values)
            root = np.abs(required.needed) ** (1 / n) * np.sign(value)
            if value.ndim == 1 and np.all(required.needed >= 0):
                yield from parts_inside(RequiredTerm(base, value, root), values)
        case Fn(name=function, args=(of,)) if function in _INVERSES and required.needed.ndim == 1:
            needed = _INVERSES[function](required.needed)
            if np.isfinite(needed).all():
                yield from parts_inside(RequiredTerm(of, sampled(of, values), needed), values)


def _factors(required: RequiredTerm, factors: tuple[Node, ...], values: Mapping[str, Array]) -> Iterator[RequiredTerm]:
    found = [sampled(factor, values) for factor in factors]
    if any(value.ndim > 2 for value in found) or sum(value.ndim == 2 for value in found) > 1:
        return
    for i, (factor, value) in enumerate(zip(factors, found, strict=True)):
        others = [v for j, v in enumerate(found) if j != i]
        scalars = np.prod([np.ones(len(value)), *(v for v in others if v.ndim == 1)], axis=0)
        vector = next((v for v in others if v.ndim == 2), None)
        if value.ndim == 2:
            wanted: Array | None = required.needed / scalars[:, None]
        elif vector is None:
            wanted = required.needed / scalars
        else:
            along = RequiredTerm(factor, vector, required.needed).factor
            wanted = None if along is None else along / scalars
        if wanted is not None:
            yield from parts_inside(RequiredTerm(factor, value, wanted), values)


def _quotient(required: RequiredTerm, top: Node, bottom: Node, values: Mapping[str, Array]) -> Iterator[RequiredTerm]:
    if isinstance(top, Num) and isinstance(bottom, Num):
        return  # ½ is one figure
    above, below = sampled(top, values), sampled(bottom, values)
    if below.ndim == 1:
        yield from parts_inside(RequiredTerm(top, above, required.needed * spread(below, above)), values)
        if (factor := required.factor) is not None:
            yield from parts_inside(RequiredTerm(bottom, below, below / factor), values)

"""Correct equations with one slip: what a check must not accept, and should mend."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from rearranged import number

from freebody.check.language.statements import Equation, symbols_in
from freebody.check.vocabulary import Vocabulary
from freebody.symbolic.dimensions import LENGTH, MASS
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, addends, exchange, walk

Random = np.random.Generator
Slip = Callable[[Random, Equation, Vocabulary], Equation | None]


def _pick(rng: Random, items: list) -> object:
    return items[int(rng.integers(len(items)))]


@dataclass(frozen=True)
class Mutant:
    """An equation with one slip of a kind."""

    kind: str
    equation: Equation


def mutant(rng: Random, equation: Equation, vocabulary: Vocabulary) -> Mutant | None:
    """The equation with one slip, each kind that finds a place being as likely."""
    for i in rng.permutation(len(SLIPS)):
        kind = list(SLIPS)[int(i)]
        made = SLIPS[kind](rng, equation, vocabulary)
        if made is not None and made != equation:
            return Mutant(kind, made)
    return None


def _places(equation: Equation) -> list[Node]:
    """What is added to something, at any depth."""
    sides = [side for side in (equation.left, equation.right) if not isinstance(side, Add)]
    inner = [term for n in walk(equation) if isinstance(n, Add) for term in n.terms]
    return [n for n in (*sides, *inner) if not (isinstance(n, Num) and n.value == 0)]


def _at(rng: Random, equation: Equation, found: list, change: Callable[[Node], Node | None]) -> Equation | None:
    if not found:
        return None
    old = found[int(rng.integers(len(found)))]
    new = change(old)
    return None if new is None else exchange(equation, old, new)


def _sign(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    return _at(rng, e, _places(e), lambda n: n.of if isinstance(n, Negative) else Negative(n))


def _number(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    factor = float(_pick(rng, [2.0, 3.0, 0.5]))  # type: ignore[arg-type]

    def change(n: Node) -> Node:
        return Quotient(n, number(2)) if factor == 0.5 else Mul((number(factor), n))

    return _at(rng, e, _places(e), change)


def _function(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    calls = [n for n in walk(e) if isinstance(n, Fn) and n.name in ("sin", "cos")]
    return _at(rng, e, calls, lambda n: Fn("cos" if n.name == "sin" else "sin", n.args))  # type: ignore[union-attr]


def _symbol(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in walk(e) if isinstance(n, Sym) and vocabulary.alike(n)]
    return _at(rng, e, found, lambda n: _pick(rng, vocabulary.alike(n)))  # type: ignore[arg-type, return-value]


def _derivative(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in walk(e) if isinstance(n, Sym) and n.dots]
    return _at(rng, e, found, lambda n: Sym(n.name, 3 - n.dots))  # type: ignore[union-attr]


def _lost_term(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in _places(e) if n not in (e.left, e.right) and _is_single(n)]
    return _at(rng, e, found, lambda n: Num(0.0, "0"))


def _is_single(node: Node) -> bool:
    """Whether it is one term, multiplied out."""
    return len(addends(node, expand=True)) == 1


def _twice(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """A term again, on the other side or on its own."""
    found = [n for n in _places(e) if n not in (e.left, e.right)] or _places(e)
    term = _pick(rng, found)
    return Equation(Add((*(e.left.terms if isinstance(e.left, Add) else (e.left,)), term)), e.right)  # type: ignore[arg-type]


def _extra_term(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """A term again, with a cosine or a sine."""
    found = [n for n in _places(e) if n not in (e.left, e.right)]
    if not found or not vocabulary.angles:
        return None
    call = Fn(str(_pick(rng, ["sin", "cos"])), (vocabulary.angles[0],))
    term = found[int(rng.integers(len(found)))]
    return exchange(e, e.left, Add((*(e.left.terms if isinstance(e.left, Add) else (e.left,)), Mul((term, call)))))


def _lost_factor(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    def change(n: Node) -> Node:
        assert isinstance(n, Mul)
        i = int(rng.integers(len(n.factors)))
        inside = addends(n.factors[i])
        if len(inside) > 1 and not all(isinstance(term, Sym) for _, term in inside):
            return None  # a bracket of terms is more than a slip
        rest = n.factors[:i] + n.factors[i + 1 :]
        return rest[0] if len(rest) == 1 else Mul(rest)

    return _at(rng, e, [n for n in walk(e) if isinstance(n, Mul)], change)


def _extra_factor(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    sizes = [n for n in symbols_in(e) if n in vocabulary.parameters and n not in vocabulary.angular]
    return _at(rng, e, _places(e), lambda n: Mul((n, _pick(rng, sizes)))) if sizes else None  # type: ignore[arg-type]


def _arm(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    lengths = [n for n in walk(e) if isinstance(n, Sym) and vocabulary.dimension(n) == LENGTH and n in vocabulary.parameters]
    return _at(rng, e, lengths, lambda n: Quotient(n, number(2)))


def _angle(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """θ ± φ for θ in a sine or cosine."""
    calls = [n for n in walk(e) if isinstance(n, Fn) and n.name in ("sin", "cos") and isinstance(n.args[0], Sym)]

    def change(n: Node) -> Node | None:
        assert isinstance(n, Fn)
        rest = [a for a in vocabulary.angles if a != n.args[0]]
        if not rest:
            return None
        other: Node = _pick(rng, rest)  # type: ignore[assignment]
        return Fn(n.name, (Add((n.args[0], other if rng.random() < 0.5 else Negative(other))),))

    return _at(rng, e, calls, change)


def _mass(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """m1 + m2 for m1."""
    masses = [n for n in walk(e) if isinstance(n, Sym) and vocabulary.dimension(n) == MASS and n in vocabulary.parameters]
    found = [n for n in masses if vocabulary.alike(n)]
    return _at(rng, e, found, lambda n: Add((n, _pick(rng, vocabulary.alike(n)))))  # type: ignore[arg-type]


def _rates(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """u1 u2 for u1²."""

    def fits(n: Node) -> bool:
        return isinstance(n, Pow) and isinstance(n.base, Sym) and n.base.dots == 1 and bool(vocabulary.alike(n.base))

    found = [n for n in walk(e) if fits(n)]
    return _at(rng, e, found, lambda n: Mul((n.base, _pick(rng, vocabulary.alike(n.base)))))  # type: ignore[union-attr, arg-type]


def _power(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    return _at(rng, e, [n for n in walk(e) if isinstance(n, Pow)], lambda n: n.base)  # type: ignore[union-attr]


SLIPS: dict[str, Slip] = {
    "sign": _sign,
    "factor": _number,
    "function": _function,
    "letter": _symbol,
    "derivative": _derivative,
    "lost term": _lost_term,
    "term twice": _twice,
    "extra term": _extra_term,
    "lost factor": _lost_factor,
    "extra factor": _extra_factor,
    "arm": _arm,
    "power": _power,
    "angle": _angle,
    "mass": _mass,
    "rates": _rates,
}

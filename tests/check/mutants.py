"""Correct equations rearranged, and correct equations with one slip: what a check must accept, and what it must not."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from dataclasses import replace as with_

import numpy as np

from freebody.check.language.nodes import (
    Call,
    Equation,
    Letter,
    Negative,
    Node,
    Number,
    Power,
    Product,
    Quotient,
    Sum,
    addends,
    letters,
    replace,
    walk,
)
from freebody.check.vocabulary import Vocabulary

Random = np.random.Generator


def number(value: float) -> Number:
    """A whole number as it is written."""
    return Number(float(value), f"{value:g}")


def _pick(rng: Random, items: list) -> object:
    return items[int(rng.integers(len(items)))]


# --- rearranged ------------------------------------------------------------------------------------


def rearranged(rng: Random, equations: list[Equation], vocabulary: Vocabulary) -> Equation:
    """A consequence of equations: scaled, combined, moved about, and with some of its letters written otherwise."""
    equation = equations[int(rng.integers(len(equations)))]
    if len(equations) > 1 and rng.random() < 0.4:
        equation = _combined(rng, equation, equations[int(rng.integers(len(equations)))], vocabulary)
    steps: list[Callable[[Random, Equation, Vocabulary], Equation]] = [_scaled, _moved, _written_otherwise, _turned, _shuffled]
    for _ in range(int(rng.integers(1, 4))):
        equation = _pick(rng, steps)(rng, equation, vocabulary)  # type: ignore[operator]
    return equation


def _factor(rng: Random, vocabulary: Vocabulary) -> Node:
    sizes = [n for n in vocabulary.parameters if n not in vocabulary.angular]
    made: list[Node] = [number(int(rng.integers(2, 6))), _pick(rng, sizes)]  # type: ignore[list-item]
    if vocabulary.angles:
        made.append(Call("cos", (vocabulary.angles[0],)))
    return made[int(rng.integers(len(made)))]


def _combined(rng: Random, a: Equation, b: Equation, vocabulary: Vocabulary) -> Equation:
    factor = _factor(rng, vocabulary)
    return Equation(Sum((a.left, Product((factor, b.left)))), Sum((a.right, Product((factor, b.right)))))


def _scaled(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    factor = _factor(rng, vocabulary)
    if rng.random() < 0.5:
        return Equation(Product((factor, e.left)), Product((factor, e.right)))
    return Equation(Quotient(e.left, factor), Quotient(e.right, factor))


def _moved(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    """One term to the other side."""
    terms = addends(e.left)
    if len(terms) < 2:
        return Equation(e.right, e.left)
    i = int(rng.integers(len(terms)))
    sign, moved = terms[i]
    left = [node if s > 0 else Negative(node) for j, (s, node) in enumerate(terms) if j != i]
    return Equation(left[0] if len(left) == 1 else Sum(tuple(left)), Sum((e.right, Negative(moved) if sign > 0 else moved)))


def _written_otherwise(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    """A sine or cosine, or a letter, by an identity."""
    calls = [n for n in walk(e) if isinstance(n, Call) and n.function in ("sin", "cos")]
    if not calls:
        return e
    call = calls[int(rng.integers(len(calls)))]
    x, half = call.arguments[0], Quotient(Number(np.pi, "pi"), number(2))
    if call.function == "sin":
        forms = [Call("cos", (Sum((x, Negative(half))),)), Negative(Call("sin", (Negative(x),))), _doubled(x)]
    else:
        forms = [Call("sin", (Sum((x, half)),)), Call("cos", (Negative(x),)), _one_less(x)]
    return replace(e, call, forms[int(rng.integers(len(forms)))])


def _doubled(x: Node) -> Node:
    half = Quotient(x, number(2))
    return Product((number(2), Call("sin", (half,)), Call("cos", (half,))))


def _one_less(x: Node) -> Node:
    return Sum((number(1), Negative(Product((number(2), Power(Call("sin", (Quotient(x, number(2)),)), number(2)))))))


def _turned(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    return Equation(Negative(e.right), Negative(e.left))


def _shuffled(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    if not isinstance(e.left, Sum):
        return e
    return with_(e, left=Sum(tuple(e.left.terms[int(i)] for i in rng.permutation(len(e.left.terms)))))


# --- slips -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Mutant:
    """An equation with one slip of a kind."""

    kind: str
    equation: Equation


def mutant(rng: Random, equation: Equation, vocabulary: Vocabulary) -> Mutant | None:
    """The equation with one slip at random; None where the kind drawn finds no place."""
    kind = list(SLIPS)[int(rng.integers(len(SLIPS)))]
    made = SLIPS[kind](rng, equation, vocabulary)
    return None if made is None or made == equation else Mutant(kind, made)


def _places(equation: Equation) -> list[Node]:
    """What is added to something, at any depth."""
    sides = [side for side in (equation.left, equation.right) if not isinstance(side, Sum)]
    inner = [term for n in walk(equation) if isinstance(n, Sum) for term in n.terms]
    return [n for n in (*sides, *inner) if not (isinstance(n, Number) and n.value == 0)]


def _at(rng: Random, equation: Equation, found: list, change: Callable[[Node], Node | None]) -> Equation | None:
    if not found:
        return None
    old = found[int(rng.integers(len(found)))]
    new = change(old)
    return None if new is None else replace(equation, old, new)


def _sign(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    return _at(rng, e, _places(e), lambda n: n.of if isinstance(n, Negative) else Negative(n))


def _number(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    factor = float(_pick(rng, [2.0, 3.0, 0.5]))  # type: ignore[arg-type]

    def change(n: Node) -> Node:
        return Quotient(n, number(2)) if factor == 0.5 else Product((number(factor), n))

    return _at(rng, e, _places(e), change)


def _function(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    calls = [n for n in walk(e) if isinstance(n, Call) and n.function in ("sin", "cos")]
    return _at(rng, e, calls, lambda n: Call("cos" if n.function == "sin" else "sin", n.arguments))  # type: ignore[union-attr]


def _letter(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in walk(e) if isinstance(n, Letter) and vocabulary.alike(n)]
    return _at(rng, e, found, lambda n: _pick(rng, vocabulary.alike(n)))  # type: ignore[arg-type, return-value]


def _derivative(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in walk(e) if isinstance(n, Letter) and n.dots]
    return _at(rng, e, found, lambda n: Letter(n.name, 3 - n.dots))  # type: ignore[union-attr]


def _lost_term(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    found = [n for n in _places(e) if n not in (e.left, e.right)]
    return _at(rng, e, found, lambda n: Number(0.0, "0"))


def _extra_term(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    """A term again, with a cosine or a sine."""
    found = [n for n in _places(e) if n not in (e.left, e.right)]
    if not found or not vocabulary.angles:
        return None
    call = Call(str(_pick(rng, ["sin", "cos"])), (vocabulary.angles[0],))
    term = found[int(rng.integers(len(found)))]
    return replace(e, e.left, Sum((*(e.left.terms if isinstance(e.left, Sum) else (e.left,)), Product((term, call)))))


def _lost_factor(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    def change(n: Node) -> Node:
        assert isinstance(n, Product)
        i = int(rng.integers(len(n.factors)))
        rest = n.factors[:i] + n.factors[i + 1 :]
        return rest[0] if len(rest) == 1 else Product(rest)

    return _at(rng, e, [n for n in walk(e) if isinstance(n, Product)], change)


def _extra_factor(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    sizes = [n for n in letters(e) if n in vocabulary.parameters and n not in vocabulary.angular]
    return _at(rng, e, _places(e), lambda n: Product((n, _pick(rng, sizes)))) if sizes else None  # type: ignore[arg-type]


def _arm(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    lengths = [n for n in walk(e) if isinstance(n, Letter) and vocabulary.powers(n) == (1, 0, 0) and n in vocabulary.parameters]
    return _at(rng, e, lengths, lambda n: Quotient(n, number(2)))


def _power(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation | None:
    return _at(rng, e, [n for n in walk(e) if isinstance(n, Power)], lambda n: n.base)  # type: ignore[union-attr]


SLIPS: dict[str, Callable[[Random, Equation, Vocabulary], Equation | None]] = {
    "sign": _sign,
    "factor": _number,
    "function": _function,
    "letter": _letter,
    "derivative": _derivative,
    "lost term": _lost_term,
    "extra term": _extra_term,
    "lost factor": _lost_factor,
    "extra factor": _extra_factor,
    "arm": _arm,
    "power": _power,
}

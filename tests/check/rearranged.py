"""Correct equations rearranged, as every reader of another textbook finds them: what a check must accept."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace as with_

import numpy as np
from other_symbols import Other

from freebody.check.language.statements import Equation, symbols_in
from freebody.check.vocabulary import Vocabulary
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, addends, exchange, substitute, walk

Random = np.random.Generator
_LONG = 40  # terms; brackets of more are not multiplied out


def number(value: float) -> Node:
    """A whole number as it is written."""
    return Num(float(value), f"{value:g}")


def rearranged(rng: Random, equations: list[Equation], vocabulary: Vocabulary, others: list[Other]) -> Equation:
    """A consequence of equations: scaled, combined, multiplied out, moved about, in other symbols and other coordinates."""
    equation = equations[int(rng.integers(len(equations)))]
    if len(equations) > 1 and rng.random() < 0.4:
        equation = _combined(rng, equation, equations[int(rng.integers(len(equations)))], vocabulary)
    for _ in range(int(rng.integers(1, 5))):
        equation = STEPS[int(rng.integers(len(STEPS)))](rng, equation, vocabulary)
    return in_other_symbols(rng, equation, others) if rng.random() < 0.5 else equation


def in_other_symbols(rng: Random, equation: Equation, others: list[Other]) -> Equation:
    """With one of its symbols in terms of another."""
    found = set(symbols_in(equation))
    fitting = [other for other in others if not found.isdisjoint(other.replaced)]
    return substitute(equation, fitting[int(rng.integers(len(fitting)))].replaced) if fitting else equation


def arranged(rng: Random, equation: Equation, vocabulary: Vocabulary) -> Equation:
    """The same terms in other places, with brackets or without."""
    for step in (_moved, _expanded, _shuffled, _turned):
        equation = step(rng, equation, vocabulary) if rng.random() < 0.5 else equation
    return equation


def _factor(rng: Random, vocabulary: Vocabulary) -> Node:
    """Something that is not 0: a number, a size, a function that has no zero at a true state by chance."""
    sizes = [n for n in vocabulary.parameters if n not in vocabulary.angular]
    made: list[Node] = [number(int(rng.integers(2, 6))), *sizes]
    if vocabulary.angles:
        angle = vocabulary.angles[int(rng.integers(len(vocabulary.angles)))]
        made += [Fn("cos", (angle,)), Add((number(2), Fn("sin", (angle,))))]
    return made[int(rng.integers(len(made)))]


def _combined(rng: Random, a: Equation, b: Equation, vocabulary: Vocabulary) -> Equation:
    factor = _factor(rng, vocabulary)
    return Equation(Add((a.left, Mul((factor, b.left)))), Add((a.right, Mul((factor, b.right)))))


def _scaled(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    factor = _factor(rng, vocabulary)
    if rng.random() < 0.5:
        return Equation(Mul((factor, e.left)), Mul((factor, e.right)))
    return Equation(Quotient(e.left, factor), Quotient(e.right, factor))


def _moved(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    """One term to the other side."""
    terms = addends(e.left)
    if len(terms) < 2:
        return Equation(e.right, e.left)
    i = int(rng.integers(len(terms)))
    sign, moved = terms[i]
    left = [node if s > 0 else Negative(node) for j, (s, node) in enumerate(terms) if j != i]
    return Equation(left[0] if len(left) == 1 else Add(tuple(left)), Add((e.right, Negative(moved) if sign > 0 else moved)))


def _expanded(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    """A side with its brackets multiplied out."""
    terms = addends(e.left, expand=True)
    if not 1 < len(terms) < _LONG:
        return e
    return with_(e, left=Add(tuple(node if sign > 0 else Negative(node) for sign, node in terms)))


def _written_otherwise(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    """A sine or cosine by an identity."""
    calls = [n for n in walk(e) if isinstance(n, Fn) and n.name in ("sin", "cos")]
    if not calls:
        return e
    call = calls[int(rng.integers(len(calls)))]
    x, half = call.args[0], Quotient(Num(np.pi, "pi"), number(2))
    if call.name == "sin":
        forms = [Fn("cos", (Add((x, Negative(half))),)), Negative(Fn("sin", (Negative(x),))), _doubled(x)]
    else:
        forms = [Fn("sin", (Add((x, half)),)), Fn("cos", (Negative(x),)), _one_less(x)]
    forms += _addition(call)
    return exchange(e, call, forms[int(rng.integers(len(forms)))])


def _doubled(x: Node) -> Node:
    half = Quotient(x, number(2))
    return Mul((number(2), Fn("sin", (half,)), Fn("cos", (half,))))


def _one_less(x: Node) -> Node:
    return Add((number(1), Negative(Mul((number(2), Pow(Fn("sin", (Quotient(x, number(2)),)), number(2)))))))


def _addition(call: Fn) -> list[Node]:
    """The theorem of addition for a sum or difference of two."""
    match call.args[0]:
        case Add(terms=(a, Negative(of=b))):
            sign = -1
        case Add(terms=(a, b)):
            sign = 1
        case _:
            return []
    names, sign = (("sin", "cos", "cos", "sin"), sign) if call.name == "sin" else (("cos", "cos", "sin", "sin"), -sign)
    first = Mul((Fn(names[0], (a,)), Fn(names[1], (b,))))
    second = Mul((Fn(names[2], (a,)), Fn(names[3], (b,))))
    return [Add((first, second if sign > 0 else Negative(second)))]


def _turned(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    return Equation(Negative(e.right), Negative(e.left))


def _shuffled(rng: Random, e: Equation, vocabulary: Vocabulary) -> Equation:
    if not isinstance(e.left, Add):
        return e
    return with_(e, left=Add(tuple(e.left.terms[int(i)] for i in rng.permutation(len(e.left.terms)))))


STEPS: list[Callable[[Random, Equation, Vocabulary], Equation]] = [
    _scaled,
    _moved,
    _expanded,
    _written_otherwise,
    _turned,
    _shuffled,
]

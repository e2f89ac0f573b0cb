"""Other coordinates for a model: symbols declared by its own, and what its own are in them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import permutations

from freebody.check.vocabulary import Vocabulary
from freebody.symbolic.tree import Add, Mul, Negative, Node, Num, Quotient, Sym


@dataclass(frozen=True)
class Other:
    """A symbol ``name`` declared as ``said``; ``replaced``: the model's symbols in terms of it; ``own``: it in terms of them."""

    name: str
    said: str
    replaced: Mapping[Sym, Node]
    own: Mapping[Sym, Node]


def others(vocabulary: Vocabulary) -> list[Other]:
    """Angles from another axis, in the other sense, relative to another; lengths the other way; parameters by their doubles."""
    angles = [n for n in vocabulary.coordinates if n in vocabulary.angular and n.name.isidentifier()]
    lengths = [n for n in vocabulary.coordinates if n not in vocabulary.angular and n.name.isidentifier()]
    made = [_shifted(n, "psi", 1.0, (math.pi / 2, "pi/2")) for n in angles]
    made += [_shifted(n, "chi", -1.0, (math.pi, "pi")) for n in angles]
    made += [_shifted(n, "zeta", -1.0, (0.0, "")) for n in (*angles, *lengths)]
    made += [_relative(a, b) for a, b in permutations(angles, 2)]
    made += [_double(n) for n in vocabulary.parameters if n not in vocabulary.angular and n.name.isidentifier()]
    return made


def _shifted(symbol: Sym, name: str, sign: float, offset: tuple[float, str]) -> Other:
    """psi = ± q + offset."""
    value, text = offset
    name = f"{name}_{symbol.name}"
    plus = Num(value, text)
    said = f"{'-' if sign < 0 else ''}{symbol.name}" + (f" + {text}" if text else "")

    def swapped(source: str, target: str, back: bool) -> dict[Sym, Node]:
        out: dict[Sym, Node] = {}
        for dots in range(3):
            one: Node = Sym(source, dots)
            one = one if sign > 0 else Negative(one)
            if dots == 0 and text:
                one = Add((one, Negative(plus) if back and sign > 0 else plus))
            out[Sym(target, dots)] = one
        return out

    return Other(name, said, swapped(name, symbol.name, True), swapped(symbol.name, name, False))


def _relative(a: Sym, b: Sym) -> Other:
    """eta = a − b, so that a = eta + b."""
    name = f"eta_{a.name}_{b.name}"
    there: dict[Sym, Node] = {Sym(a.name, n): Add((Sym(name, n), Sym(b.name, n))) for n in range(3)}
    back: dict[Sym, Node] = {Sym(name, n): Add((Sym(a.name, n), Negative(Sym(b.name, n)))) for n in range(3)}
    return Other(name, f"{a.name} - {b.name}", there, back)


def _double(n: Sym) -> Other:
    """A parameter by its double."""
    name, two = f"{n.name}_d", Num(2.0, "2")
    return Other(name, f"2*{n.name}", {n: Quotient(Sym(name), two)}, {Sym(name): Mul((two, n))})

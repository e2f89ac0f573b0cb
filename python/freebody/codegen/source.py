"""Expressions of generated code: numbers, brackets, and the sharing of subexpressions."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

from freebody.codegen.languages import Language
from freebody.symbolic.tree import PI, Add, Fn, Mul, Num, Pow, Sym, Tree, children

_SUM, _PRODUCT, _ATOM = range(3)
_LONGEST_POWER = 4  # whole powers up to it are products
Step = tuple[str, str]
"""A name and the expression that it stands for."""
Code = tuple[str, int]
"""An expression, and how strongly it binds."""


class Writer:
    """Writes trees of one function; equal subexpressions are computed once."""

    def __init__(self, spelling: Language, named: Mapping[Sym, str]) -> None:
        self.spelling, self.named = spelling, named
        self.steps: list[Step] = []
        self._nodes: list[tuple[Tree, tuple[int, ...]]] = []  # with the numbers of those that a node is made of
        self._numbers: dict[tuple, int] = {}  # of a node, by what it is made of
        self._seen: dict[int, int] = {}  # of a node, by its identity

    def write(self, trees: Sequence[Tree]) -> list[str]:
        """The expressions of the trees; ``steps`` are what has to be computed before."""
        roots = [self._number(tree) for tree in trees]
        uses = Counter([*roots, *(part for _, below in self._nodes for part in below)])
        codes: list[Code] = []
        # A node has a higher number than all that it is made of.
        for node, (tree, below) in enumerate(self._nodes):
            code = self._express(tree, [codes[part] for part in below])
            if uses[node] > 1 and not isinstance(tree, Num | Sym):
                self.steps.append((f"s{len(self.steps) + 1}", code[0]))
                code = (self.steps[-1][0], _ATOM)
            codes.append(code)
        return [codes[root][0] for root in roots]

    def _number(self, tree: Tree) -> int:
        if id(tree) not in self._seen:
            below = tuple(self._number(child) for child in children(tree))
            match tree:
                case Num(value):
                    own: Any = (isinstance(value, float), value)
                case Sym():
                    own = tree
                case Pow(_, own) | Fn(own, _):
                    pass
                case _:
                    own = None
            number = self._numbers.setdefault((type(tree), below, own), len(self._nodes))
            if number == len(self._nodes):
                self._nodes.append((tree, below))
            self._seen[id(tree)] = number
        return self._seen[id(tree)]

    def _express(self, tree: Tree, parts: Sequence[Code]) -> Code:
        codes = [code for code, _ in parts]
        match tree:
            case Num(value):
                return _literal(value)
            case Sym():
                return (repr(math.pi) if tree == Sym(PI) and tree not in self.named else self.named[tree]), _ATOM
            case Add():
                return codes[0] + "".join(f" - {code[1:]}" if code[0] == "-" else f" + {code}" for code in codes[1:]), _SUM
            case Mul(factors):
                minus = isinstance(factors[0], Num) and factors[0].value == -1 and len(factors) > 1
                return "-" * minus + "*".join(map(_bracketed, parts[minus:])), _PRODUCT
            case Pow(_, exponent):
                return self._power(parts[0], exponent)
            case Fn(name, _):
                return self.spelling.call(name, codes), _ATOM

    def _power(self, base: Code, exponent: Fraction) -> Code:
        size = abs(exponent)
        rank = _ATOM
        if size == Fraction(1, 2):
            made = self.spelling.call("sqrt", [base[0]])
        elif size.denominator == 1 and size <= _LONGEST_POWER and (size == 1 or base[0].isidentifier()):
            made, rank = "*".join([_bracketed(base)] * int(size)), _ATOM if size == 1 else _PRODUCT
        else:
            made = self.spelling.call("power", [base[0], _literal(size)[0]])
        return (made, rank) if exponent > 0 else (f"(1.0/{_bracketed((made, rank))})", _ATOM)


def _bracketed(code: Code) -> str:
    return code[0] if code[1] == _ATOM else f"({code[0]})"


def _literal(value: Fraction | float) -> Code:
    if isinstance(value, float) or value.denominator == 1:
        return repr(float(value)), _ATOM if value >= 0 else _SUM
    return f"({float(value.numerator)!r}/{float(value.denominator)!r})", _ATOM

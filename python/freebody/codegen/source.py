"""What the languages of generated code have in common: numbers, brackets, and the sharing of subexpressions."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar

from freebody.symbolic.tree import PI, Add, Fn, Mul, Num, Pow, Sym, Tree, children

if TYPE_CHECKING:
    from freebody.codegen.systems import Systems

_SUM, _PRODUCT, _ATOM = range(3)
_LONGEST_POWER = 4  # whole powers up to it are products
Step = tuple[str, str]
"""A name and the expression that it stands for."""


class Language(ABC):
    """A language: the ``word`` that asks for it, the ``ending`` of its files, and what it is in a few words; how its ``functions`` are
    called."""

    word: ClassVar[str]
    ending: ClassVar[str]
    doc: ClassVar[str]
    functions: ClassVar[Mapping[str, str]]

    def call(self, name: str, args: Sequence[str]) -> str:
        """A function of printed arguments."""
        if name not in self.functions:
            raise ValueError(f"{name!r} is a table of the model; generated code knows only {', '.join(self.functions)}")
        return self.functions[name].format(*args)

    @abstractmethod
    def function(
        self, name: str, arrays: Sequence[str], steps: Sequence[Step], results: Sequence[str], shape: tuple[int, ...]
    ) -> str:
        """One function."""

    @abstractmethod
    def file(self, header: Sequence[str], functions: Sequence[str]) -> str:
        """Functions below a comment."""

    @abstractmethod
    def solvers(self, systems: Systems) -> str:
        """What solves the equations of a mechanism by such functions: names and numbers, accelerations, reactions, first-order form."""


class Writer:
    """Writes trees of one function; equal subexpressions are computed once."""

    def __init__(self, spelling: Language, named: Mapping[Sym, str]) -> None:
        self.spelling, self.named = spelling, named
        self.steps: list[Step] = []
        self._nodes: list[Tree] = []
        self._below: list[tuple[int, ...]] = []  # the nodes that a node is made of
        self._numbers: dict[tuple, int] = {}  # of a node, by what it is made of
        self._seen: dict[int, int] = {}  # of a node, by its identity
        self._code: dict[int, tuple[str, int]] = {}  # what is written for a node, and how strongly it binds

    def write(self, trees: Sequence[Tree]) -> list[str]:
        """The expressions of the trees; ``steps`` are what has to be computed before."""
        roots = [self._number(tree) for tree in trees]
        uses = [0] * len(self._nodes)
        for node in (*roots, *(below for nodes in self._below for below in nodes)):
            uses[node] += 1
        # A node has a higher number than all that it is made of.
        for node, tree in enumerate(self._nodes):
            code = self._express(tree, self._below[node])
            if uses[node] > 1 and not isinstance(tree, Num | Sym):
                name = f"s{len(self.steps) + 1}"
                self.steps.append((name, code[0]))
                code = (name, _ATOM)
            self._code[node] = code
        return [self._code[root][0] for root in roots]

    def _number(self, tree: Tree) -> int:
        if id(tree) in self._seen:
            return self._seen[id(tree)]
        below = tuple(self._number(child) for child in children(tree))
        key = (type(tree), below, None if below and not isinstance(tree, Pow | Fn) else _leaf(tree))
        if key not in self._numbers:
            self._numbers[key] = len(self._nodes)
            self._nodes.append(tree)
            self._below.append(below)
        self._seen[id(tree)] = self._numbers[key]
        return self._numbers[key]

    def _express(self, tree: Tree, below: tuple[int, ...]) -> tuple[str, int]:
        match tree:
            case Num(value):
                return _literal(value)
            case Sym():
                return (repr(math.pi) if tree == Sym(PI) and tree not in self.named else self.named[tree]), _ATOM
            case Add():
                return self._sum([self._code[node][0] for node in below]), _SUM
            case Mul():
                return self._product(tree.factors, below), _PRODUCT
            case Pow(_, exponent):
                return self._power(below[0], exponent)
            case Fn(name, _):
                return self.spelling.call(name, [self._code[node][0] for node in below]), _ATOM

    def _sum(self, terms: Sequence[str]) -> str:
        made = terms[0]
        for term in terms[1:]:
            made += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
        return made

    def _product(self, factors: Sequence[Tree], below: Sequence[int]) -> str:
        minus = isinstance(factors[0], Num) and factors[0].value == -1 and len(factors) > 1
        return "-" * minus + "*".join(self._within(node, _ATOM) for node in below[minus:])

    def _power(self, base: int, exponent: Fraction) -> tuple[str, int]:
        size = abs(exponent)
        if size == Fraction(1, 2):
            made, rank = self.spelling.call("sqrt", [self._code[base][0]]), _ATOM
        elif size.denominator == 1 and size <= _LONGEST_POWER and (size == 1 or self._is_short(base)):
            made, rank = "*".join([self._within(base, _ATOM)] * int(size)), _ATOM if size == 1 else _PRODUCT
        else:
            made, rank = self.spelling.call("power", [self._code[base][0], _literal(size)[0]]), _ATOM
        if exponent > 0:
            return made, rank
        return f"(1.0/{made if rank == _ATOM else f'({made})'})", _ATOM

    def _is_short(self, node: int) -> bool:
        return self._code[node][0].isidentifier()

    def _within(self, node: int, rank: int) -> str:
        code, own = self._code[node]
        return code if own >= rank else f"({code})"


def _leaf(tree: Tree) -> tuple:
    match tree:
        case Num(value):
            return (isinstance(value, float), value)
        case Sym(name, dots):
            return (name, dots)
        case Pow(_, exponent):
            return (exponent,)
        case Fn(name, _):
            return (name,)
        case _:
            return ()


def _literal(value: Fraction | float) -> tuple[str, int]:
    if isinstance(value, float) or value.denominator == 1:
        return repr(float(value)), _ATOM if value >= 0 else _SUM
    return f"({float(value.numerator)!r}/{float(value.denominator)!r})", _ATOM

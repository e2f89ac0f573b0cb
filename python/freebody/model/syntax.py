"""Expressions as trees: parsed by the core, measured and worked out here."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from freebody import core
from freebody.core import ExpressionError, cards
from freebody.symbolic.evaluate import value as value_of
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Span, Sym, walk

from . import units
from .errors import ModelProblem
from .names import suggestion
from .units import ANGLE, NUMBER_ONLY, TIME, Dimension

Lookup = Callable[[str], "Dimension | None"]


@dataclass(frozen=True)
class Expression:
    """A parsed expression: its text in SI, its tree, and the dimension of each number by its place in the text (None: bare).

    Places count the bytes of the text. Comparisons and what joins them are functions called ``<``, ``and``, ``not`` …"""

    text: str
    tree: Node
    numbers: Mapping[Span, Dimension | None]

    def show(self, tree: Node) -> str:
        """A part as it is written."""
        start, end = tree.span
        return self.text.encode()[start:end].decode(errors="replace")


@lru_cache(maxsize=4096)
def parse(text: str) -> Expression:
    """The expression of a text in which numbers may carry a unit (``2*l*sin(30 deg)``). Raises ``ModelProblem``."""
    rewritten = units.rewrite(text)
    try:
        tree = _node(core.parse(rewritten.text))
    except UnicodeEncodeError:
        raise ModelProblem("the expression holds a character that is none", "type it anew") from None
    except ExpressionError as error:
        place, what = rewritten.text[error.start : error.end].strip(), error.what
        raise ModelProblem(
            f"`{text}` is no expression: {what}" + (f" (at `{place}`)" if place and f"`{place}`" not in what else ""), error.hint
        ) from None
    places = (node.span for node in walk(tree) if isinstance(node, Num))
    return Expression(rewritten.text, tree, dict(zip(places, rewritten.numbers, strict=True)))


def _node(data: Mapping[str, Any]) -> Node:
    """The tree that the core tells."""
    span = tuple(data["span"])
    match data:
        case {"number": number}:
            return Num(float(number), span=span)
        case {"name": name}:
            return Sym(name, span=span)
        case {"negate": inner}:
            return Negative(_node(inner), span=span)
        case {"not": inner}:
            return Fn("not", (_node(inner),), span=span)
        case {"call": [name, arguments]}:
            return Fn(name, tuple(map(_node, arguments)), span=span)
        case {"chain": [first, [(("+" | "-"), _), *_] as rest]}:
            terms = [Negative(_node(part), span=tuple(part["span"])) if sign == "-" else _node(part) for sign, part in rest]
            return Add((_node(first), *terms), span=span)
        case {"chain": [first, rest]}:
            total = _node(first)
            for sign, part in rest:
                right = _node(part)
                total = _joined(sign, total, right, (total.span[0], right.span[1]))
            return total
    raise AssertionError(data)


def _joined(sign: str, left: Node, right: Node, span: Span) -> Node:
    if sign == "*":
        return Mul((left, right), span=span)
    if sign in ("/", "^"):
        return (Quotient if sign == "/" else Pow)(left, right, span=span)
    return Fn(sign, (left, right), span=span)


def names(tree: Node) -> list[str]:
    """All names that an expression reads, those of functions left out."""
    return [node.name for node in walk(tree) if isinstance(node, Sym)]


# -- dimensions ----------------------------------------------------------------------------------

# Functions of plain numbers, and functions whose arguments are all alike.
_PLAIN_FUNCTIONS = {"exp", "ln", "sinh", "cosh", "tanh", "sin", "cos", "tan", "asin", "acos", "atan"}
_ALIKE = {"min", "max", "hypot", "clamp", "abs"}
FUNCTIONS = _PLAIN_FUNCTIONS | _ALIKE | set(cards.functions()) | {"sqrt", "atan2", "sign", "step", "if", "rate", "accel"}
"""All functions of the language; tables come on top."""
COMPARISONS = {"<", "<=", ">", ">=", "==", "!="}
CONSTANTS = {"pi", "t"}


class Measure:
    """The dimension of an expression. Bare numbers, and names that ``lookup`` gives as None, fit anywhere."""

    def __init__(self, expression: Expression, lookup: Lookup, tables: Callable[[str], bool] = lambda _: False) -> None:
        self.expression, self.lookup, self.tables = expression, lookup, tables

    def of(self, tree: Node) -> Dimension | None:
        """The dimension of a tree; None when it fits anywhere. Raises ``ModelProblem``."""
        match tree:
            case Num():
                return self.expression.numbers[tree.span]
            case Sym("pi"):
                return None
            case Sym(name):
                return self.lookup(name)
            case Negative(inner) | Fn("not", (inner,)):
                return self.of(inner)
            case Add(terms):
                return self._same(terms)
            case Mul((left, right)):
                return _product(self.of(left), self.of(right), 1, right)
            case Quotient(left, right):
                return _product(self.of(left), self.of(right), -1, right)
            case Pow(base, exponent):
                return self._power(self.of(base), exponent)
            case Fn(name, (left, right)) if name in COMPARISONS:
                return self._same((left, right)) and None
            case Fn("and" | "or", parts):
                return [self.of(part) for part in parts] and None
            case Fn(name, arguments):
                return self._call(name, list(arguments))
        raise AssertionError(tree)

    def _same(self, terms: Sequence[Node]) -> Dimension | None:
        total = self.of(terms[0])
        for term in terms[1:]:
            total = self._alike(total, self.of(term), terms[0], term)
        return total

    def _power(self, base: Dimension | None, exponent: Node) -> Dimension | None:
        self._must_be_number(self.of(exponent), exponent, "an exponent")
        try:
            power = Fraction(evaluate(exponent, _no_name)).limit_denominator(12)
        except (ModelProblem, ArithmeticError, ValueError):
            if base is not None and not base.is_number:
                raise ModelProblem(
                    f"the exponent in `{self.expression.text}` must be a number, because its base is {base.words()}",
                    "write the number itself",
                ) from None
            return base
        return None if base is None else base.to_the(power)

    def _call(self, name: str, arguments: list[Node]) -> Dimension | None:
        if name in cards.functions():
            return units.unit(cards.functions()[name].unit).dimension
        if self.tables(name):
            return [self.of(a) for a in arguments] and None
        if name not in FUNCTIONS:
            raise ModelProblem(f"no function is called `{name}`", suggestion(name, FUNCTIONS - set("xy")))
        found = [self.of(a) for a in arguments]
        first = found[0] if found else None
        if name in ("rate", "accel"):
            return None if first is None else first.times(TIME, -1 if name == "rate" else -2)
        if name == "sqrt":
            return None if first is None else first.to_the(Fraction(1, 2))
        if name in _PLAIN_FUNCTIONS:
            for dimension, argument in zip(found, arguments, strict=True):
                self._must_be_number(dimension, argument, f"the argument of `{name}`")
            return ANGLE if name.startswith("a") else NUMBER_ONLY
        return self._mixed(name, found, arguments)

    def _mixed(self, name: str, found: list[Dimension | None], arguments: list[Node]) -> Dimension | None:
        if name == "if":
            found, arguments = found[1:], arguments[1:]
        total = found[0] if found else None
        for dimension, argument in zip(found[1:], arguments[1:], strict=True):
            total = self._alike(total, dimension, arguments[0], argument)
        if name == "atan2":
            return ANGLE
        return NUMBER_ONLY if name in ("sign", "step") else total

    def _must_be_number(self, dimension: Dimension | None, tree: Node, what: str) -> None:
        if dimension is not None and not dimension.is_number:
            hint = "check the units of the parameters"
            raise ModelProblem(
                f"{what} must be an angle or a plain number; `{self.expression.show(tree)}` is {dimension.words()}", hint
            )

    def _alike(self, a: Dimension | None, b: Dimension | None, left: Node, right: Node) -> Dimension | None:
        if a is None or b is None:
            return a if b is None else b
        if a.fits(b):
            return a
        both = f"`{self.expression.show(left)}` is {a.words()} and `{self.expression.show(right)}` is {b.words()}"
        raise ModelProblem(
            f"in `{self.expression.text}`, {both}: they cannot be added or compared", "check the units of the parameters"
        )


def _product(a: Dimension | None, b: Dimension | None, power: int, right: Node) -> Dimension | None:
    """Bare numbers may hide a unit (``9.81*m``), but a whole number that divides, a root and π do not (``m2/3``, ``a*sqrt(2)``)."""
    if b is None and (_is_root_or_pi(right) or (power == -1 and _whole_number(right))):
        return a
    return None if a is None or b is None else a.times(b, power)


def _whole_number(tree: Node) -> bool:
    return isinstance(tree, Num) and float(tree.value).is_integer()


def _is_root_or_pi(tree: Node) -> bool:
    match tree:
        case Sym("pi"):
            return True
        case Fn("sqrt", (argument,)):
            return _whole_number(argument)
    return False


def _no_name(name: str) -> float:
    raise ModelProblem(f"`{name}` is no number")


# -- values --------------------------------------------------------------------------------------

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(math, name) for name in ("sqrt", "exp", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "hypot")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh")},
    "ln": math.log, "abs": abs, "min": min, "max": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "step": lambda x: float(x >= 0),
    "clamp": lambda x, low, high: min(max(x, low), high),
    "^": math.pow, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
    "and": lambda a, b: bool(a) and bool(b), "or": lambda a, b: bool(a) or bool(b), "not": operator.not_,
}  # fmt: skip
"""Numbers of a model, by the functions of ``math``, which refuse what has no value."""


def evaluate(tree: Node, value: Callable[[str], float]) -> float:
    """The number of a tree of parameters only. Raises ``ModelProblem``, and ``ArithmeticError`` or ``ValueError`` like ``math``."""
    for call in walk(tree):
        if isinstance(call, Fn) and call.name != "if" and call.name not in _FUNCTIONS:
            raise ModelProblem(f"`{call.name}(…)` changes with the motion; a number of the model depends on parameters only")
    letter = lambda each: math.pi if each.name == "pi" else value(each.name)
    try:
        return value_of(tree, letter, float, _FUNCTIONS)
    except TypeError:
        found = next(call for call in walk(tree) if isinstance(call, Fn) and not _takes(call))
        raise ModelProblem(f"`{found.name}` does not take {len(found.args)} arguments") from None


def _takes(call: Fn) -> bool:
    """Whether a function takes so many arguments."""
    try:
        call.name == "if" or _FUNCTIONS[call.name](*[0.5] * len(call.args))
    except TypeError:
        return False
    return True

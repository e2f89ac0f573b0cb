"""Expressions as trees: parsed by the core, measured and worked out here."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from freebody import core
from freebody.core import ExpressionError, cards
from freebody.symbolic.dimensions import ALIKE, TIME, Dimension, Known, Rules, Shape
from freebody.symbolic.evaluate import value as value_of
from freebody.symbolic.tree import Add, Fn, Mul, Negative, Node, Num, Pow, Quotient, Span, Sym, Unit, walk

from . import units
from .errors import ModelProblem
from .names import suggestion

Lookup = Callable[[str], Known]


@dataclass(frozen=True)
class Expression:
    """A parsed expression: its text in SI, its tree, and the dimension of each number by its place in the text (None: bare).

    Places count the bytes of the text. Comparisons and what joins them are functions called ``<``, ``and``, ``not`` …"""

    text: str
    tree: Node
    numbers: Mapping[Span, Known]

    def show(self, tree: Node) -> str:
        """A part as it is written."""
        (start, end), text = tree.span, self.text.encode()
        # A product begins behind the bracket of its first factor.
        while text.count(b")", start, end) > text.count(b"(", start, end):
            start = text.rindex(b"(", 0, start)
        while text.count(b"(", start, end) > text.count(b")", start, end):
            end = text.index(b")", end) + 1
        return text[start:end].decode(errors="replace")


def parse(text: str, known: Callable[[str], bool] | None = None, in_full: Callable[[str], str] = str) -> Expression:
    """The expression of a text in which numbers may carry a unit (``2*l*sin(30 deg)``), with its names ``in_full``; ``known`` tells
    which words are names. Raises ``ModelProblem``."""
    if (quantity := units.quantity(text)) is not None:
        shown, span = repr(quantity.value), (0, len(text))
        return Expression(shown, Num(quantity.value, span=span), {span: quantity.dimension})
    rewritten = units.rewrite(text, known or (lambda _: False))
    in_si = in_full(rewritten.text)
    try:
        tree = _tree(in_si)
    except UnicodeEncodeError:
        raise ModelProblem("the expression holds a character that is none", "type it anew") from None
    except ExpressionError as error:
        place, what = in_si[error.start : error.end].strip(), error.what
        raise ModelProblem(
            f"`{text}` is no expression: {what}" + (f" (at `{place}`)" if place and f"`{place}`" not in what else ""), error.hint
        ) from None
    places = (node.span for node in walk(tree) if isinstance(node, Num))
    return Expression(in_si, tree, dict(zip(places, rewritten.numbers, strict=True)))


@lru_cache(maxsize=4096)
def _tree(text: str) -> Node:
    return _node(core.parse(text))


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
                span = total.span[0], right.span[1]
                if sign in ("/", "^"):
                    total = (Quotient if sign == "/" else Pow)(total, right, span=span)
                else:
                    total = Mul((total, right), span=span) if sign == "*" else Fn(sign, (total, right), span=span)
            return total
    raise AssertionError(data)


def names(tree: Node) -> list[str]:
    """All names that an expression reads, those of functions left out."""
    return [node.name for node in walk(tree) if isinstance(node, Sym)]


# -- dimensions ----------------------------------------------------------------------------------

FUNCTIONS = {
    *ALIKE,
    *cards.functions(),
    *["exp", "ln", "sinh", "cosh", "tanh", "sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "if", "rate", "accel"],
}
"""All functions of the language; tables come on top."""
COMPARISONS = {"<", "<=", ">", ">=", "==", "!="}
CONSTANTS = {"pi", "t"}


class Measure(Rules):
    """The dimension of an expression. Bare numbers, and names that ``lookup`` gives as None, fit anywhere."""

    def __init__(self, expression: Expression, lookup: Lookup, tables: Callable[[str], bool] = lambda _: False) -> None:
        self.expression, self.lookup, self.tables = expression, lookup, tables

    def leaf(self, node: Num | Sym | Unit) -> Known:
        if isinstance(node, Num):
            return self.expression.numbers[node.span]
        return None if node == Sym("pi") else self.lookup(node.name)

    def times(self, left: Shape, right: Shape, node: Node, power: int = 1) -> Shape:
        """Bare numbers may hide a unit (``9.81*m``), but a whole number that divides, a root and π do not (``m2/3``, ``a*sqrt(2)``)."""
        root = isinstance(node, Fn) and node.name == "sqrt" and len(node.args) == 1 and _whole_number(*node.args)
        plain = right is None and (root or node == Sym("pi") or (power == -1 and _whole_number(node)))
        return left if plain else super().times(left, right, node, power)

    def power(self, node: Pow) -> Shape:
        self.must_be_number(node.exponent, node)
        found, base = super().power(node), self.of(node.base)
        if found is None and base is not None:
            what = f"the exponent in `{self.expression.text}` must be a number, because its base is {base.words()}"
            raise ModelProblem(what, "write the number itself")
        return found

    def call(self, node: Fn) -> Known:
        name = node.name
        if name in cards.functions():
            return units.unit(cards.functions()[name].unit).dimension
        if name in COMPARISONS:
            return self.agreed(node.args) and None
        if name in ("and", "or", "not") or self.tables(name):
            return [self.of(part) for part in node.args] and None
        if name not in FUNCTIONS:
            raise ModelProblem(f"no function is called `{name}`", suggestion(name, FUNCTIONS - set("xy")))
        if name == "if":
            self.agreed(node.args[:1])
            return self.agreed(node.args[1:])
        if name in ("rate", "accel"):
            inside = self.agreed(node.args[:1])
            return None if inside is None else inside.times(TIME, -1 if name == "rate" else -2)
        return super().call(node)

    def unlike(self, term: Node, its: Dimension, other: Node, others: Dimension) -> ModelProblem:
        in_order = sorted(((term, its), (other, others)), key=lambda pair: pair[0].span)
        both = " and ".join(f"`{self.expression.show(node)}` is {dimension.words()}" for node, dimension in in_order)
        what = f"in `{self.expression.text}`, {both}: they cannot be added or compared"
        return ModelProblem(what, "check the units of the parameters")

    def no_number(self, node: Node, its: Dimension, within: Fn | Pow) -> ModelProblem:
        what = f"the argument of `{within.name}`" if isinstance(within, Fn) else "an exponent"
        shown = self.expression.show(node)
        hint = f"divide by a size of its kind, `{shown}/(1 {its.unit().removeprefix('1')})`, or check the units of the parameters"
        return ModelProblem(f"{what} must be an angle or a plain number; `{shown}` is {its.words()}", hint)


def _whole_number(tree: Node) -> bool:
    return isinstance(tree, Num) and float(tree.value).is_integer()


# -- values --------------------------------------------------------------------------------------

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(math, name) for name in ("sqrt", "exp", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "hypot")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh")},
    "if": lambda condition, yes, no: yes if condition else no, "ln": math.log, "abs": abs, "min": min, "max": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "step": lambda x: float(x >= 0),
    "clamp": lambda x, low, high: min(max(x, low), high),
    "mod": lambda a, b: a - b * math.floor(a / b),
    "^": math.pow, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
    "and": lambda a, b: bool(a) and bool(b), "or": lambda a, b: bool(a) or bool(b), "not": operator.not_,
}  # fmt: skip
"""Numbers of a model, by the functions of ``math``, which refuse what has no value."""


def evaluate(tree: Node, value: Callable[[str], float]) -> float:
    """The number of a tree of parameters only. Raises ``ModelProblem``, and ``ArithmeticError`` or ``ValueError`` like ``math``."""
    for call in (node for node in walk(tree) if isinstance(node, Fn)):
        if call.name not in _FUNCTIONS:
            raise ModelProblem(f"`{call.name}(…)` changes with the motion; a number of the model depends on parameters only")
        try:
            _FUNCTIONS[call.name](*[0.5] * len(call.args))
        except TypeError:
            raise ModelProblem(f"`{call.name}` does not take {len(call.args)} arguments") from None
    return value_of(tree, lambda each: math.pi if each.name == "pi" else value(each.name), float, _FUNCTIONS)


# -- numbers of a model: bare, a quantity like ``400 mm``, or an expression of parameters -----------


def number(text: Any, value: Callable[[str], float], known: Callable[[str], bool] | None = None) -> float:
    """The value of a number of the model in SI; ``value`` knows those of names. Raises ``ModelProblem``, also where it is not finite."""
    if not isinstance(text, str):
        if not math.isfinite(text):
            raise ModelProblem(f"`{text}` is no finite number", "give it a value")
        return float(text)
    try:
        return float(evaluate(parse(text, known).tree, value))
    except (ArithmeticError, ValueError) as error:
        hint = "check for a division by 0 or a root of a negative number"
        raise ModelProblem(f"`{text}` has no value: {error}", hint) from None


def dimension(text: Any, lookup: Lookup, known: Callable[[str], bool] | None = None) -> Known:
    """The dimension of a number of the model (None: fits anywhere). Raises ``ModelProblem``."""
    if not isinstance(text, str):
        return None
    expression = parse(text, known)
    return Measure(expression, lookup).of(expression.tree)

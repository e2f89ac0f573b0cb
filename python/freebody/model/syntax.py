"""Expressions as trees: parsed by the core, measured and worked out here."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from freebody import core
from freebody.core import ExpressionError

from . import units
from .errors import ModelProblem
from .names import suggestion
from .units import ANGLE, ENERGY, FORCE, LENGTH, NUMBER_ONLY, TIME, Dimension

Tree = dict[str, Any]
"""A tree of the core: ``{"number": 2.0}``, ``{"name": …}``, ``{"call": [name, […]]}``, ``{"negate": …}``,
``{"not": …}`` or ``{"chain": [first, [[operator, tree], …]]}``, each with its ``span``."""

Lookup = Callable[[str], "Dimension | None"]


@dataclass(frozen=True)
class Expression:
    """A parsed expression: its text in SI, its tree, and the dimension of each number in it (None: bare)."""

    text: str
    tree: Tree
    numbers: tuple[Dimension | None, ...]


@lru_cache(maxsize=4096)
def parse(text: str) -> Expression:
    """The expression of a text in which numbers may carry a unit (``2*l*sin(30 deg)``). Raises ``ModelProblem``."""
    rewritten = units.rewrite(text)
    try:
        tree = core.parse(rewritten.text)
    except UnicodeEncodeError:
        raise ModelProblem("the expression holds a character that is none", "type it anew") from None
    except ExpressionError as error:
        place, what = rewritten.text[error.start : error.end].strip(), error.what
        raise ModelProblem(
            f"`{text}` is no expression: {what}" + (f" (at `{place}`)" if place and f"`{place}`" not in what else ""), error.hint
        ) from None
    return Expression(rewritten.text, tree, tuple(rewritten.numbers))


def names(tree: Tree) -> list[str]:
    """All names that an expression reads, those of functions left out."""
    match tree:
        case {"name": name}:
            return [name]
        case {"negate": inner} | {"not": inner}:
            return names(inner)
        case {"call": [_, arguments]}:
            return [n for argument in arguments for n in names(argument)]
        case {"chain": [first, rest]}:
            return names(first) + [n for _, part in rest for n in names(part)]
    return []


# -- dimensions ----------------------------------------------------------------------------------

# Functions of plain numbers, and functions whose arguments are all alike.
_PLAIN_FUNCTIONS = {"exp", "ln", "sinh", "cosh", "tanh", "sin", "cos", "tan", "asin", "acos", "atan"}
_ALIKE = {"min", "max", "hypot", "clamp", "abs"}
_READINGS = {
    "m": "x y distance along across centre_x centre_y",
    "rad": "angle direction",
    "m/s": "vx vy speed",
    "rad/s": "omega",
    "m/s^2": "ax ay",
    "rad/s^2": "alpha",
    "J": "kinetic potential energy friction_work",
    "N": "tension",
    "N*s": "momentum_x momentum_y",
    "N*m*s": "angular_momentum",
}
_READS = {word: unit for unit, words in _READINGS.items() for word in words.split()}
READINGS = frozenset(_READS)
"""Functions that read places, motions and sums of the whole."""
_PARTS = {"Fx": FORCE, "Fy": FORCE, "F": FORCE, "Fs": FORCE, "Fn": FORCE, "F1": FORCE, "F2": None, "tension": FORCE, "M": ENERGY}
_PARTS |= {"N": FORCE, "T": FORCE, "gap": LENGTH, "slack": LENGTH, "slip": LENGTH.times(TIME, -1)}
_PARTS |= {"power": ENERGY.times(TIME, -1), "work": ENERGY}
FUNCTIONS = _PLAIN_FUNCTIONS | _ALIKE | set(_READS) | {"sqrt", "atan2", "sign", "step", "if", "rate", "accel"}
"""All functions of the language; tables come on top."""
COMPARISONS = {"<", "<=", ">", ">=", "==", "!="}
CONSTANTS = {"pi", "t"}


def part(name: str) -> Dimension | None:
    """The dimension of ``joint.Fx``, ``force.power`` …; None when it is not known from the last word."""
    return _PARTS.get(name.rpartition(".")[2])


class Measure:
    """The dimension of an expression. Bare numbers, and names that ``lookup`` gives as None, fit anywhere."""

    def __init__(self, expression: Expression, lookup: Lookup, tables: Callable[[str], bool] = lambda _: False) -> None:
        self.text = expression.text
        self.numbers = iter(expression.numbers)
        self.lookup = lookup
        self.tables = tables

    def of(self, tree: Tree) -> Dimension | None:
        """The dimension of a tree; None when it fits anywhere. Raises ``ModelProblem``."""
        match tree:
            case {"number": _}:
                return next(self.numbers)
            case {"name": "pi"}:
                return None
            case {"name": name}:
                return self.lookup(name)
            case {"negate": inner} | {"not": inner}:
                return self.of(inner)
            case {"call": [name, arguments]}:
                return self._call(name, arguments)
            case {"chain": [first, rest]}:
                return self._chain(first, rest)
        raise AssertionError(tree)

    def _chain(self, first: Tree, rest: list[tuple[str, Tree]]) -> Dimension | None:
        total, shown = self.of(first), first
        for operator, tree in rest:
            if operator == "^":
                return self._power(total, tree)
            dimension = self.of(tree)
            if operator in ("*", "/"):
                total = _product(total, dimension, operator, tree)
            elif operator in ("and", "or"):
                total = None
            else:
                total = self._alike(total, dimension, shown, tree)
        return None if rest and rest[0][0] in COMPARISONS else total

    def _power(self, base: Dimension | None, exponent: Tree) -> Dimension | None:
        self._must_be_number(self.of(exponent), exponent, "an exponent")
        try:
            power = Fraction(evaluate(exponent, _no_name)).limit_denominator(12)
        except (ModelProblem, ArithmeticError, ValueError):
            if base is not None and not base.is_number:
                raise ModelProblem(
                    f"the exponent in `{self.text}` must be a number, because its base is {base.words()}",
                    "write the number itself",
                ) from None
            return base
        return None if base is None else base.to_the(power)

    def _call(self, name: str, arguments: list[Tree]) -> Dimension | None:
        if name in _READS:
            return units.unit(_READS[name]).dimension
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

    def _mixed(self, name: str, found: list[Dimension | None], arguments: list[Tree]) -> Dimension | None:
        if name == "if":
            found, arguments = found[1:], arguments[1:]
        total = found[0] if found else None
        for dimension, argument in zip(found[1:], arguments[1:], strict=True):
            total = self._alike(total, dimension, arguments[0], argument)
        if name == "atan2":
            return ANGLE
        return NUMBER_ONLY if name in ("sign", "step") else total

    def _must_be_number(self, dimension: Dimension | None, tree: Tree, what: str) -> None:
        if dimension is not None and not dimension.is_number:
            hint = "check the units of the parameters"
            raise ModelProblem(f"{what} must be an angle or a plain number; `{self._show(tree)}` is {dimension.words()}", hint)

    def _alike(self, a: Dimension | None, b: Dimension | None, left: Tree, right: Tree) -> Dimension | None:
        if a is None or b is None:
            return a if b is None else b
        if a.fits(b):
            return a
        both = f"`{self._show(left)}` is {a.words()} and `{self._show(right)}` is {b.words()}"
        raise ModelProblem(f"in `{self.text}`, {both}: they cannot be added or compared", "check the units of the parameters")

    def _show(self, tree: Tree) -> str:
        start, end = tree["span"]
        return self.text.encode()[start:end].decode(errors="replace")


def _product(a: Dimension | None, b: Dimension | None, operator: str, tree: Tree) -> Dimension | None:
    """Bare numbers may hide a unit (``9.81*m``), but a whole number that divides, a root and π do not (``m2/3``, ``a*sqrt(2)``)."""
    if b is None and (_is_root_or_pi(tree) or (operator == "/" and _whole_number(tree))):
        return a
    if a is None or b is None:
        return None
    return a.times(b, 1 if operator == "*" else -1)


def _whole_number(tree: Tree) -> bool:
    return float(tree.get("number", 0.5)).is_integer()


def _is_root_or_pi(tree: Tree) -> bool:
    match tree:
        case {"name": "pi"}:
            return True
        case {"call": ["sqrt", [argument]]}:
            return _whole_number(argument)
    return False


def _no_name(name: str) -> float:
    raise ModelProblem(f"`{name}` is no number")


# -- values --------------------------------------------------------------------------------------

_OPERATORS: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b,
    "^": lambda a, b: math.pow(a, b),
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "!=": lambda a, b: a != b,
    "and": lambda a, b: bool(a) and bool(b),
    "or": lambda a, b: bool(a) or bool(b),
}
_CALLS: dict[str, Callable[..., float]] = {
    **{name: getattr(math, name) for name in ("sqrt", "exp", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "hypot")},
    **{name: getattr(math, name) for name in ("sinh", "cosh", "tanh")},
    "ln": math.log,
    "abs": abs,
    "min": min,
    "max": max,
    "sign": lambda x: float((x > 0) - (x < 0)),
    "step": lambda x: float(x >= 0),
    "clamp": lambda x, low, high: min(max(x, low), high),
}


def evaluate(tree: Tree, value: Callable[[str], float]) -> float:
    """The number of a tree of parameters only. Raises ``ModelProblem``, and ``ArithmeticError`` or ``ValueError`` like ``math``."""
    match tree:
        case {"number": number}:
            return float(number)
        case {"name": "pi"}:
            return math.pi
        case {"name": name}:
            return value(name)
        case {"negate": inner}:
            return -evaluate(inner, value)
        case {"not": inner}:
            return not evaluate(inner, value)
        case {"call": ["if", [condition, then, otherwise]]}:
            return evaluate(then if evaluate(condition, value) else otherwise, value)
        case {"call": [name, arguments]} if name in _CALLS:
            return _called(name, [evaluate(a, value) for a in arguments])
        case {"call": [name, _]}:
            raise ModelProblem(f"`{name}(…)` changes with the motion; a number of the model depends on parameters only")
        case {"chain": [first, rest]}:
            total = evaluate(first, value)
            for operator, tree in rest:
                total = _OPERATORS[operator](total, evaluate(tree, value))
            return total
    raise AssertionError(tree)


def _called(name: str, arguments: list[float]) -> float:
    try:
        return _CALLS[name](*arguments)
    except TypeError:
        raise ModelProblem(f"`{name}` does not take {len(arguments)} arguments") from None

"""One line of tokens as a tree: sums, products, functions, columns and matrices; see ``parser`` for the rules."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache

from freebody.symbolic.differentiate import rate as rate_of
from freebody.symbolic.errors import Span, StatementError
from freebody.symbolic.evaluate import ARGUMENTS, FUNCTIONS
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Matrix, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit, walk

from ...model import units
from ...model.errors import ModelProblem
from .glyphs import ARROWS
from .statements import Directed, Equation, Integral, Partial, Rate
from .tokens import Names, Token

RELATIONS = ("=", "<=", ">=", "<", ">")
_ADDS = ("+", "-")
SIGNED = (*_ADDS, "*", "/", "·", "×", *RELATIONS)
_BEGINS = ("number", "symbol", "function", "rate", "∂", "(", "[", "{", "frac", "matrix[", "|", "∫")
CLOSES = {"(": ")", "[": "]", "{": "}", "matrix[": "]"}
_AT_START = re.compile(r"\((t=)?0\)")
_UPRIGHT = re.compile(r"(?:\\[,;: ]|[~\s])*\\(?:mathrm|text|operatorname)\{\s*([^}]*)\}")
_UNIT_PIECE = re.compile(r"(?:(?P<tie>[·*/])|\s*[·*/]?\s*)(?P<word>[^\W\d_²³]+|°)(?:\^-?\d|[²³])?")


def _is_time(token: Token) -> bool:
    """Whether it is the time, or one of several times."""
    return token.kind == "symbol" and not token.dots and re.fullmatch(r"t(?:_?\d)?", token.text) is not None


class Line:
    """One line of tokens; each method reads what its name says and leaves ``at`` behind it."""

    def __init__(self, row: Sequence[Token], names: Names, text: str) -> None:
        self.row, self.names, self.text, self.at = row, names, text, 0

    @property
    def now(self) -> Token:
        return self.row[self.at]

    def take(self) -> Token:
        self.at += 1
        return self.row[self.at - 1]

    def accept(self, *kinds: str) -> Token | None:
        """The token that stands here, if it is of one of these kinds."""
        return self.take() if self.now.kind in kinds else None

    def expect(self, kind: str) -> Token:
        if self.now.kind == kind:
            return self.now if kind == "end" else self.take()
        if self.now.kind == "end":
            raise StatementError(f"it ends where a `{kind}` is missing", self.end())
        if kind == "end" and self.now.kind in (")", "]", "}"):
            raise StatementError(f"a `{self.now.text}` that was never opened", self.now.span)
        expected = {"end": "the end", "symbol": "a symbol"}.get(kind, f"`{kind}`")
        hint = "conditions are `if …:`, `at rest:`, `at the start:`, `at θ = 0:`" if self.now.kind == ":" else ""
        raise StatementError(f"`{self.now.text}` stands where {expected} is expected", self.now.span, hint)

    def end(self) -> Span:
        """The last character of the line."""
        last = self.row[max(self.at - 1, 0)].span[1]
        return (max(last - 1, 0), last)

    def span(self, first: Node | Token) -> Span:
        """From a node to where the reading stands."""
        return (first.span[0], self.row[max(self.at - 1, 0)].span[1])

    # --- lines ---------------------------------------------------------------------------------

    def line(self) -> list[Equation]:
        """The equations of a line; a = b = c is two."""
        begins, left, out = self.now.span[0], self.sum(), []
        while self.now.kind in RELATIONS:
            relation = self.take().kind
            behind, right = self.now.span[0], self.sum()
            if arrow := self.accept(*ARROWS):
                right = Directed(right, arrow.kind, span=self.span(right))
            out.append(Equation(left, right, relation, span=(begins, self.row[self.at - 1].span[1])))
            begins, left = behind, right
        self.expect("end")
        if not out:
            raise StatementError("this is no equation: it has no `=`", left.span, "write both sides, like `m*a = F`")
        return out

    # --- levels, loose to tight ----------------------------------------------------------------

    def sum(self) -> Node:
        found = [self.term()]
        while self.now.kind in _ADDS:
            found.append(self.term())
        return found[0] if len(found) == 1 else Add(tuple(found), span=self.span(found[0]))

    def term(self) -> Node:
        """A term with its sign."""
        return self.signed(lambda: self.chain(("·", "."), Dot, lambda: self.chain(("×",), Cross, self.product)))

    def signed(self, inner: Callable[[], Node]) -> Node:
        if not (sign := self.accept(*_ADDS)):
            return inner()
        of = self.signed(inner)
        return Negative(of, span=self.span(sign)) if sign.kind == "-" else of

    def chain(self, signs: Sequence[str], node: type[Dot] | type[Cross], inner: Callable[[], Node]) -> Node:
        left = inner()
        while self.accept(*signs):
            left = node(left, self.signed(inner), span=self.span(left))
        return left

    def product(self) -> Node:
        """Factors side by side, with ``*`` and ``/``, from left to right."""
        factors = [self.factor()]
        while True:
            if isinstance(factors[-1], Num) and self.accept("%"):
                factors[-1] = Quotient(factors[-1], Num(100.0), span=self.span(factors[-1]))
            elif unit := self.unit(factors[-1]):
                factors.append(unit)
            elif self.accept("/"):
                top, below = _product(factors), [self.signed(self.factor)]
                while self.names.tight and self.now.attached and self.now.kind in _BEGINS:
                    below.append(self.factor())
                bottom = _product(below)
                factors = [Quotient(top, bottom, span=self.span(top))]
            elif self.accept("*"):
                factors.append(self.signed(self.factor))
            elif self.now.kind in _BEGINS and not (self.now.kind == "|" and sum(t.kind == "|" for t in self.row[: self.at]) % 2):
                if self.now.kind == "number":
                    hint = "write `*` between them, or `,` between the entries of a matrix"
                    raise StatementError(f"the number {self.now.text} stands behind a factor", self.now.span, hint)
                factors.append(self.factor())
            else:
                return _product(factors)

    def factor(self) -> Node:
        base = self.primary()
        while self.now.kind in ("raised", "^", "primes"):
            if self.now.kind == "primes":
                base = self.rate(base, self.take().dots, base)
                continue
            exponent = self.exponent()
            if isinstance(base, Matrix | Column) and exponent in (Sym("T"), Sym("⊤")):
                rows = base.rows if isinstance(base, Matrix) else tuple((item,) for item in base.items)
                base = _matrix(tuple(zip(*rows, strict=True)), base.span)
            else:
                base = Pow(base, exponent, span=self.span(base))
        return base

    def exponent(self) -> Node:
        """What stands behind ^, or what small figures are."""
        token = self.take()
        if token.kind == "^":
            return self.signed(self.factor)
        digits = token.text.lstrip("-")
        if not digits.isdecimal():
            return Sym(token.text, span=token.span)
        number = _number(digits, token.span)
        return Negative(number, span=token.span) if token.text.startswith("-") else number

    # --- the smallest pieces -------------------------------------------------------------------

    def primary(self) -> Node:
        token = self.now
        if token.kind == "end":
            raise StatementError("something is missing at the end", self.end(), "a number, a symbol or a bracket is expected")
        if token.kind in (*SIGNED, ")", "]", "}", ",", ";", "^"):
            raise StatementError(f"something is missing before `{token.text}`", token.span)
        if token.kind not in _BEGINS:
            raise StatementError(f"`{token.text}` has no place in an equation", token.span)
        if token.kind == "∂" or (token.kind == "frac" and self.row[self.at + 2].kind == "∂"):
            return self.partial()
        self.take()
        match token.kind:
            case "number":
                return _number(token.text, token.span)
            case "symbol":
                return self.symbol(token)
            case "function":
                return self.call(token)
            case "(" | "{":
                return self.group(token)
            case "[" | "matrix[":
                return self.matrix(token)
            case "∫":
                return self.integral(token)
            case "rate":
                return self.rate(self.factor(), token.dots, token)
            case "frac":
                top, bottom = self.group(self.take()), self.group(self.take())
                return Quotient(top, bottom, span=self.span(token))
        inside = self.sum()
        self.expect("|")
        return Fn("abs", (inside,), span=self.span(token))

    def integral(self, token: Token) -> Node:
        """What stands between the limits and the dx."""
        lower, upper = self.group(self.take()), self.group(self.take())
        of = Num(1.0, "1", span=token.span) if self.now.kind == "differential" else self.sum()
        if self.now.kind != "differential":
            raise StatementError("an integral without its `dt`", self.span(token), "write `∫_0^t … dt`")
        by = self.take()
        return Integral(of, Sym(by.text, span=by.span), lower, upper, span=self.span(token))

    def symbol(self, token: Token) -> Node:
        """A symbol; written as a function of time, θ(t), it is the same, and θ(0) is what it is at the start; e with a power, where it is no
        name, is the exponential function."""
        behind = "".join(t.text for t in self.row[self.at : self.at + 5])
        if behind.startswith("(t)") and self.now.attached:
            self.at += 3
        elif (found := _AT_START.match(behind)) and token.text not in self.names.constants:
            self.at += 5 if found[1] else 3
            return Sym(f"{token.text}(0)", token.dots, span=self.span(token))
        if token.text == "pi" and not self.names.find("pi"):
            return Num(math.pi, "pi", span=token.span)
        if token.text == "e" and self.now.kind == "^" and not self.names.find("e"):
            return Fn("exp", (self.exponent(),), span=self.span(token))
        return Sym(token.text, token.dots, span=self.span(token))

    def group(self, open_: Token) -> Node:
        """What is in brackets: an expression, or a column."""
        items = self.items(",", ";")
        self.expect(CLOSES[open_.kind])
        return items[0] if len(items) == 1 else Column(items, span=self.span(open_))

    def items(self, *commas: str) -> tuple[Node, ...]:
        """Expressions with commas between them."""
        found = [self.sum()]
        while self.accept(*commas):
            found.append(self.sum())
        return tuple(found)

    def matrix(self, open_: Token) -> Node:
        """[a, b; c, d], [[a, b], [c, d]], or an expression in square brackets."""
        start, rows = self.at, self.nested()
        if not rows:
            self.at, comma = start, "&" if open_.kind == "matrix[" else ","
            rows = [self.items(comma)]
            while self.accept(";"):
                rows += [] if self.now.kind == "]" else [self.items(comma)]
        self.expect("]")
        span = self.span(open_)
        if len({len(row) for row in rows}) > 1:
            raise StatementError("the rows of this matrix have different lengths", span, "put `;` between the rows")
        return rows[0][0] if rows == [(rows[0][0],)] else _matrix(rows, span)

    def nested(self) -> list[tuple[Node, ...]]:
        """Rows that have brackets of their own; empty where they have none."""
        rows: list[tuple[Node, ...]] = []
        while self.accept("["):
            rows.append(self.items(","))
            if self.now.kind != "]" or self.row[self.at + 1].kind not in (",", ";", "]"):
                return []
            self.take()
            self.accept(",", ";")
        return rows

    # --- functions -----------------------------------------------------------------------------

    def call(self, token: Token) -> Node:
        power = self.exponent() if self.now.kind in ("raised", "^") else None  # the 2 of sin²θ
        if isinstance(power, Negative):
            inverse = f"a{token.text}"  # as textbooks write it: sin⁻¹ is no 1/sin
            if power != Negative(Num(1.0)) or inverse not in FUNCTIONS:
                hint = f"write `1/{token.text}(…)`, or `{inverse}(…)` for the inverse function"
                raise StatementError(f"`{token.text}` to a negative power has two meanings", self.span(token), hint)
            token, power = replace(token, text=inverse), None
        arguments = self.arguments(token)
        span = self.span(token)
        if token.text in ("cross", "dot"):
            return (Cross if token.text == "cross" else Dot)(*arguments, span=span)
        if token.text == "diff":  # diff(θ, t) and diff(θ, t, 2)
            of, time, *order = arguments
            if time != Sym("t"):
                raise StatementError("things are differentiated by t alone here", span, "like `diff(theta, t, 2)`")
            return self.rate(of, int(order[0].value) if order and isinstance(order[0], Num) else 1, token)
        found = Fn(token.text, arguments, span=span)
        return Pow(found, power, span=span) if power else found

    def arguments(self, token: Token) -> tuple[Node, ...]:
        found: tuple[Node, ...]
        if open_ := self.accept("(", "[", "{"):
            found = self.items(",")
            self.expect(CLOSES[open_.kind])
        else:
            found = (self.bare_argument(token),)
        wanted = {"cross": (2,), "dot": (2,), "diff": (2, 3)}.get(token.text, (ARGUMENTS.get(token.text, 1),))
        if len(found) not in wanted:
            count = " or ".join(map(str, wanted))
            raise StatementError(f"`{token.text}` takes {count} in its brackets, not {len(found)}", self.span(token))
        return found

    def bare_argument(self, token: Token) -> Node:
        """One symbol, a number before it, and behind it a ``t`` or ``t_1``, or directly behind what is constant what is not: sin pδ, or a
        bracket that begins with t: cos p(t − t_1)."""
        sign = self.accept("-")
        if self.now.kind not in ("number", "symbol", "frac", "function"):
            raise StatementError(f"`{token.text}` of what?", token.span, f"write `{token.text}(…)`")
        factors = [self.primary()]
        if isinstance(factors[0], Num):
            if unit := self.unit(factors[0]):
                factors.append(unit)
            elif self.now.kind == "symbol" and token.text != "sqrt":
                factors.append(self.primary())
        if isinstance(factors[-1], Num) and self.now.kind == "symbol" and _is_time(self.row[self.at + 1]):  # 2π f t
            factors.append(self.primary())
        fixed = isinstance(factors[-1], Sym) and not factors[-1].dots and factors[-1].name in self.names.constants
        changing = fixed and self.now.attached and self.now.text not in self.names.constants
        of_time = _is_time(self.now) and not (isinstance(factors[-1], Sym) and factors[-1].name in self.names.no_rates)
        if self.now.kind == "symbol" and not self.now.dots and (of_time or changing):
            factors.append(self.primary())
        if fixed and self.now.kind == "(" and self.now.attached and self._brackets_of_time():  # cos p(t − t_1)
            factors.append(self.primary())
        found = _product(factors)
        return Negative(found, span=self.span(sign)) if sign else found

    def _brackets_of_time(self) -> bool:
        """Whether the bracket that opens here begins with t."""
        return _is_time(self.row[self.at + 1]) and self.row[self.at + 2].kind in _ADDS

    def rate(self, of: Node, count: int, begins: Token | Node) -> Node:
        """A derivative by time, written out where it can be."""
        lasting = any(isinstance(n, Partial) for n in walk(of))
        for _ in range(count):
            of = Rate(of) if lasting else rate_of(of, self.names.constants)
        return replace(of, span=self.span(begins))

    def partial(self) -> Node:
        """∂L/∂θ̇, or the same as a LaTeX fraction."""
        start, found = self.now, []
        signs = (("frac", "{"), ("}", "{"), ("}",)) if start.kind == "frac" else ((), ("/",), ())
        for number, kinds in enumerate(signs):
            found += [self.changing()] if number else []
            for kind in kinds:
                self.expect(kind)
        return Partial(*found, span=self.span(start))

    def changing(self) -> Sym:
        """The symbol behind a ∂."""
        self.expect("∂")
        token = self.expect("symbol")
        return Sym(token.text, token.dots, span=token.span)

    # --- units ---------------------------------------------------------------------------------

    def unit(self, before: Node) -> Unit | None:
        """A unit behind a number or a bracket: words that are units, not all of them symbols that are known."""
        after_bracket = self.row[self.at - 1].kind in (")", "]")
        if not (isinstance(before, Num) or after_bracket) or not (self.names.known or self.now.text == "°"):
            return None
        start = self.row[self.at - 1].span[1]
        inside = self.now.kind in CLOSES.values() or self.now.span[0] < start  # ½, or the braces of a fraction
        if inside or self.now.kind == "differential" or _RATE.match(self.text, start):
            return None
        if self.now.text == "°" and self.text.startswith("^", self.now.span[0]):
            return self.unit_of("°", start, self.now.span[1])
        if upright := _UPRIGHT.match(self.text, start):
            # A word with a subscript, or one that is a symbol here, is printed upright as well.
            named = self.text.startswith("_", upright.end()) or (len(upright[1]) > 1 and self.names.find(folded(upright[1])))
            return None if named else self.unit_of(upright[1].replace(r"\cdot", "·"), start, upright.end())
        for end in reversed(self.unit_ends(start, self.names.units and not after_bracket)):
            if found := self.unit_of(self.text[start:end], start, end):
                return found
        return None

    def unit_ends(self, start: int, common: bool) -> list[int]:
        """Where a unit that starts here can end: where tokens do, and some word of it is no symbol that is known.

        A known symbol goes on with a unit only when a sign without blanks ties it to that, as in ``N·m`` and ``m/s``; where those
        that are ``common`` go first a symbol that has the name of a common one is one.
        """
        ends, at, some_unknown = [], start, False
        stops = {t.span[1] for t in self.row}
        while found := _UNIT_PIECE.match(self.text, at):
            is_known = lambda name: self.names.find(folded(name)) is not None
            # 2md is no day, 2mg no mass.
            is_product = (word := found["word"]) not in units.COMMON or (word == "mg" and not common)
            named = is_known(word) or (is_product and all(map(is_known, word)))
            known = named and not (common and found["word"] in units.COMMON)
            if at > start and known and (not found["tie"] or self.text[at - 1] == "°"):
                break
            at, some_unknown = found.end(), some_unknown or not known
            ends += [at] if at in stops and some_unknown else []
        return ends

    def unit_of(self, written: str, start: int, end: int) -> Unit | None:
        """The unit that a text is, read up to ``end``; None where it is none."""
        if (size := _size_of(written)) is None:
            return None
        self.at = next(i for i, t in enumerate(self.row) if t.span[0] >= end or t.kind == "end")
        return Unit(size, written.strip(), span=(start + len(written) - len(written.lstrip()), end))


_RATE = re.compile(r"\s*d[^\W\d]\w*\s*/\s*dt\b")
"""``(m + M) da/dt``."""


@lru_cache(4096)
def _number(digits: str, span: Span) -> Num:
    value = float(digits)
    if math.isinf(value) or (value < sys.float_info.min and digits.lower().partition("e")[0].strip("0.")):
        raise StatementError(f"`{digits}` is beyond the range of numbers here", span, "they go from 1e-307 to 1e308")
    return Num(value, digits, span=span)


def _size_of(unit: str) -> float | None:
    """A unit in SI; None where a text is none."""
    try:
        return float(units.unit(unit).size)
    except ModelProblem:
        return None


def _product(factors: Sequence[Node]) -> Node:
    if len(factors) == 1:
        return factors[0]
    return Mul(tuple(factors), span=(factors[0].span[0], factors[-1].span[1]))


def _matrix(rows: Sequence[tuple[Node, ...]], span: Span) -> Node:
    """A matrix, or a column where each row has one entry."""
    return Column(tuple(row[0] for row in rows), span=span) if len(rows[0]) == 1 else Matrix(tuple(rows), span=span)

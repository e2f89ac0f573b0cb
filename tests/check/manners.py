"""The manners in which students write one equation: signs of products and quotients, dots and primes, indices, brackets, sides, labels,
displays and remarks. What is said stays the same, so must the verdict."""

from __future__ import annotations

import random
import re
import unicodedata
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from freebody.check import Checker
from freebody.check.language.spelling import level, signed
from freebody.check.language.statements import Assignment, Equation, Program
from freebody.model.errors import ModelProblem
from freebody.symbolic.alphabet import GREEK
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import SUBSCRIPTS, SUPERSCRIPTS
from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit, is_zero, walk

_SUM, _DOT, _CROSS, _PRODUCT, _FACTOR, _ATOM = range(6)
_NAME = re.compile(r"([^\W\d_]+?)(?:_(\w+)|(\d+))?")
_LATEX_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_MARKS = ("", "\u0307", "\u0308", "\u20db")
_SMALL = {"1/2": "½", "1/3": "⅓", "2/3": "⅔", "1/4": "¼", "3/4": "¾", "1/6": "⅙", "1/8": "⅛", "3/8": "⅜", "2/5": "⅖", "1/5": "⅕"}
CDOT, TIMES = r"\cdot", r"\times"
_KNOWN = {"sin", "cos", "tan", "exp", "ln"}
CHOICES = {
    "latex": (True, False),
    "frac": (r"\frac", r"\dfrac", r"\tfrac"),
    "brackets": ((r"\left(", r"\right)"), ("(", ")"), (r"\bigl(", r"\bigr)"), (r"\left[", r"\right]"), (r"\Big(", r"\Big)")),
    "plain_brackets": (("(", ")"), ("[", "]"), ("( ", " )")),
    "times": (r"\,", " ", r" \cdot ", r"\;", r"\, "),
    "plain_times": (" ", "*", "·", " * "),
    "number": ("small", "stroke", "decimal", "long"),
    "dots": ("marks", "primes", "leibniz", "words"),
    "power": ("^", "^{}", "**", "small"),
    "of": ("bare", "brackets"),
    "index": ("_", "_{}", "small", ""),
    "greek": ("sign", "word"),
    "hats": ("", r"\hat", r"\mathbf"),
}
"""What a style says of each piece."""
DISPLAYS = (
    "{}", "${}$", r"\[ {} \]", "$$ {} $$", r"\begin{{equation}} {} \end{{equation}}", r"\boxed{{{}}}", "{}.", "{}  (1)", r"\therefore\; {}",
)  # fmt: skip
LABELS = (
    "", "ΣM_G: ", "LMB x: ", "Energy: ", "Newton II for the bar: ", "Thus, ", "So ", "hence ", "∴ ", "⇒ ", "(2) ", "a) ", "b) ", "=> ",
    "AMB about G: ", "therefore ", "We get ", r"\Rightarrow ", r"\text{and so } ", "for all t: ",
)  # fmt: skip
REMARKS = (
    "", " (1)", " (clockwise +)", ", as expected", " (Newton)", " for all t", " ✓", r" \quad (2)", ".", ";", " QED", " (from (1) and (2))",
    ", which is positive", " (3a)", " at any time", r"\qquad\blacksquare", " (to the second law)",
)  # fmt: skip
BETWEEN = ("; ", ", ", "\n", " and ", r" \\ ", r",\quad ", ", so ", " ⇒ ", r" \Rightarrow ", "; hence ", " (1)\n")
_CONDITION = re.compile(r"\s*([^:=]*(?:[a-z]{2}|→|->|[<>])[^:=]*(?:=[^:]*)?:(?!=))\s*")
"""Words may say of which motions it is."""
_SAID_WITHIN = re.compile(r"\A\s*(?:at|when|if|where)\b|\(0\)")
"""A condition behind a label, and what is of the start by a letter."""
_BEHIND = re.compile(r"\s+as\s+\S+\s*(?:→|->).*$|\s*=\s*(?:\\text\{)?const\}?\s*$")


@dataclass(frozen=True)
class Style:
    """How each piece is written; ``latex`` or plain."""

    latex: bool
    frac: str
    brackets: tuple[str, str]
    plain_brackets: tuple[str, str]
    times: str
    plain_times: str
    number: str
    dots: str
    power: str
    of: str
    index: str
    greek: str
    hats: str

    @classmethod
    def drawn(cls, rng: random.Random) -> Style:
        return cls(**{name: rng.choice(choices) for name, choices in CHOICES.items()})

    # --- lines

    def line(self, node: Node) -> str:
        match node:
            case Assignment(name=left, expression=right):
                return f"{self.write(left)} = {self.write(right)}"
            case Equation(left=left, right=right, relation=relation):
                return f"{self.write(left)} {relation} {self.write(right)}"
        raise TypeError(type(node).__name__)

    # --- terms

    def write(self, node: Node, least: int = _SUM) -> str:
        loose = level(node) < least and not (
            self.latex and isinstance(node, Quotient) and not self._is_number(node) and least < _ATOM
        )
        text = self.inside(node)
        return (
            self.brackets_around(text)
            if loose and not (self._is_number(node) and self.number == "small" and text in _SMALL.values())
            else text
        )

    def brackets_around(self, text: str) -> str:
        begin, end = self.brackets if self.latex else self.plain_brackets
        return f"{begin}{text}{end}"

    def inside(self, node: Node) -> str:
        match node:
            case Num(text="pi"):
                return r"\pi" if self.latex else "π"
            case Num(value=value, text=text):
                return text or f"{value:g}"
            case Unit(text=text):
                return text
            case Sym():
                return self.symbol(node)
            case Add(terms=terms):
                return signed(terms, lambda term: self.write(term, _DOT))
            case Negative(of=of):
                return "-" + self.write(of, _DOT)
            case Dot(left=left, right=right):
                return f"{self.write(left, _DOT)} {self.pick(CDOT, '·')} {self.write(right, _CROSS)}"
            case Cross(left=left, right=right):
                tight = replace(self, times=r"\,", plain_times=" ")  # a dot binds looser than a cross
                return f"{tight.write(left, _CROSS)} {self.pick(TIMES, '×')} {tight.write(right, _PRODUCT)}"
            case Mul(factors=factors):
                return self.product(factors)
            case Quotient(top=top, bottom=bottom):
                return self.quotient(node, top, bottom)
            case Pow(base=Fn(name=name, args=(argument,)), exponent=Num() as exponent) if name in _KNOWN:
                return self.function(name, argument, self.raised(exponent))
            case Pow(base=base, exponent=exponent):
                inside = self.write(base, _ATOM)
                marked = isinstance(base, Sym) and base.dots and self.dots in ("primes", "leibniz")
                inside = (
                    self.brackets_around(inside)
                    if isinstance(base, Quotient | Fn) and not inside.startswith(("(", "[", r"\left", r"\big", r"\Big"))
                    else inside
                )
                inside = self.brackets_around(inside) if marked and self.dots == "leibniz" else inside
                return inside + self.raised(exponent)
            case Fn(name="sqrt", args=(of,)):
                return rf"\sqrt{{{self.write(of)}}}" if self.latex else f"√({self.write(of)})"
            case Fn(name=name, args=(argument,)):
                return self.function(name, argument, "")
            case Column(items=items):
                return "(" + ", ".join(map(self.write, items)) + ")"
        raise TypeError(type(node).__name__)

    def pick(self, latex: str, plain: str) -> str:
        return latex if self.latex else plain

    def function(self, name: str, argument: Node, power: str) -> str:
        called = ("\\" + name if name in _KNOWN else r"\operatorname{" + name + "}") if self.latex else name
        alone = isinstance(argument, Sym) and self.of == "bare" and self.dots != "leibniz" * bool(argument.dots)
        return f"{called}{power} {self.write(argument)}" if alone else called + power + self.brackets_around(self.write(argument))

    def raised(self, exponent: Node) -> str:
        whole = isinstance(exponent, Num) and float(exponent.value).is_integer()
        if isinstance(exponent, Fraction):
            return f"^({exponent})" if not self.latex else f"^{{{exponent}}}"
        text = self.write(exponent, _SUM)
        if whole and self.power == "small":
            return text.translate(SUPERSCRIPTS)
        if self.latex:
            return f"^{text}" if self.power == "^" and whole and len(text) == 1 else f"^{{{text}}}"
        return ("**" if self.power == "**" else "^") + (text if whole else self.brackets_around(text))

    def product(self, factors: tuple[Node, ...]) -> str:
        out = self.write(factors[0], _PRODUCT)
        for before, factor in pairwise(factors):
            if isinstance(factor, Unit):
                out += (r"\,\text{" + factor.text + "}") if self.latex else " " + factor.text
                continue
            figure = self.write(factor, _FACTOR)[:1].isdigit()
            sign = self.pick(self.times, self.plain_times)
            vector = any(isinstance(n, Sym) and n.name in ("i", "j", "k") for n in (before, factor))
            if figure and "dot" not in sign and "*" not in sign:
                sign = self.pick(r" \cdot ", "*")
            elif vector and ("cdot" in sign or "·" in sign):
                sign = " "
            out += sign + self.write(factor, _FACTOR)
        return out

    def _is_number(self, node: Node) -> bool:
        return (
            isinstance(node, Quotient)
            and isinstance(node.top, Num)
            and isinstance(node.bottom, Num)
            and bool(node.top.text.isdigit() and node.bottom.text.isdigit())
        )

    def quotient(self, node: Node, top: Node, bottom: Node) -> str:
        if self._is_number(node):
            said = f"{top.text}/{bottom.text}"
            value = top.value / bottom.value
            if self.number == "small" and said in _SMALL:
                return _SMALL[said]
            if self.number == "decimal" and round(value, 4) == value:
                return f"{value:g}"
            if self.latex and self.number == "stroke" and len(said) == 3:
                return f"{self.frac}{top.text}{bottom.text}"
        if self.latex:
            return f"{self.frac}{{{self.write(top)}}}{{{self.write(bottom)}}}"
        return f"{self.write(top, _PRODUCT)}/{self.write(bottom, _FACTOR)}"

    def symbol(self, symbol: Sym) -> str:
        if symbol.name in ("i", "j", "k") and not symbol.dots and self.latex and self.hats:
            return rf"{self.hats}{{{symbol.name}}}"
        found = _NAME.fullmatch(symbol.name)
        if not found or (len(found[1]) > 1 and found[1] not in GREEK and found[1] not in GREEK.values()):
            base, index, plain = symbol.name, "", True
        else:
            base, index, plain = found[1], found[2] or found[3] or "", False
        base = self.letter(base)
        if index:
            index = self.indexed(index, bool(found[3]))
        match self.dots:
            case "leibniz" if symbol.dots and symbol.dots < 3:
                order = str(symbol.dots) if symbol.dots > 1 else ""
                high = (f"^{order}" if self.latex else order.translate(SUPERSCRIPTS)) if order else ""
                if self.latex:
                    return rf"\frac{{d{high}{base}{index}}}{{dt{high}}}"
                return f"(d{high}{base}{index}/dt{high})"
            case "marks" if symbol.dots and self.latex and not plain:
                return (
                    rf"{_LATEX_DOTS[symbol.dots]}{{{base}}}{index}"
                    if index or not base.startswith("\\")
                    else rf"{_LATEX_DOTS[symbol.dots]}{base}"
                )
            case "marks" if symbol.dots and not plain and len(base) == 1:
                return unicodedata.normalize("NFC", base + _MARKS[symbol.dots]) + index
            case "words" if symbol.dots and not self.latex and not index:
                return base + "d" * (symbol.dots - 1) + "dot"
        return base + index + "'" * symbol.dots

    def letter(self, base: str) -> str:
        greek = base if base in GREEK else next((word for word, sign in GREEK.items() if sign == base), None)
        if greek is None:
            return base
        return (
            "\\" + greek if self.latex and self.greek == "word" else GREEK[greek] if self.greek == "sign" or self.latex else greek
        )

    def indexed(self, index: str, digits: bool) -> str:
        if self.index == "small" and index.isdigit():
            return index.translate(SUBSCRIPTS)
        if self.index == "" and digits:
            return index if not self.latex else f"_{index}" if len(index) == 1 else f"_{{{index}}}"
        if self.latex or self.index == "_{}":
            return f"_{{{index}}}"
        return f"_{index}"


def arranged(rng: random.Random, line: Equation) -> Equation:
    """Sides exchanged, or all terms on one side."""
    way = rng.randrange(4)
    if way == 1 and not isinstance(line.right, Column):
        return Equation(line.right, line.left, {"<": ">", ">": "<", "<=": ">=", ">=": "<="}.get(line.relation, line.relation))
    if way == 2 and line.relation == "=" and not is_zero(line.right):
        return Equation(Add((line.left, Negative(line.right))), Num(0.0, "0"))
    if way == 3 and line.relation == "=" and not is_zero(line.left) and not isinstance(line.left, Sym):
        return Equation(Num(0.0, "0"), Add((line.right, Negative(line.left))))
    return line


def fits(program: Program) -> bool:
    """Whether all of it can be written in every manner."""
    return all(
        type(n) in (Add, Column, Cross, Dot, Fn, Mul, Negative, Num, Pow, Quotient, Sym, Unit, Equation, Assignment, Program)
        for n in walk(program)
    )


def rewritten(rng: random.Random, checker: Checker, says: str, dressed: bool = True) -> str | None:
    """A statement in another manner, ``dressed`` with labels, remarks and displays; None where it is of a kind that is not rewritten."""
    body, before, behind = says.strip(), "", ""
    if body.startswith("$") and body.endswith("$") and body.count("$") == 2:
        body = body[1:-1]
    if found := _CONDITION.match(body):
        before, body = f"{found[1]} ", body[found.end() :]
    if found := _BEHIND.search(body):
        behind, body = found[0], body[: found.start()]
    constant = before.startswith("constant") or "const" in behind
    if _SAID_WITHIN.search(body) or (constant and "=" in body):  # a chain would fall into lines
        return None
    try:
        program = checker.case(body + " = 0" * constant).program
    except (StatementError, ModelProblem):
        return None
    if "$" in body or not fits(program):
        return None
    style = Style.drawn(rng)
    lines = [line if isinstance(line, Assignment) or constant else arranged(rng, line) for line in program.lines]
    text = rng.choice(BETWEEN).join(style.write(line.left) if constant else style.line(line) for line in lines)
    if not dressed:
        return before + text + behind
    display = rng.choice(DISPLAYS) if len(lines) == 1 and not behind and rng.random() < 0.6 else "{}"
    label = rng.choice(LABELS) if not before and rng.random() < 0.5 else ""
    remark = rng.choice(REMARKS) if display == "{}" and rng.random() < 0.6 else ""
    return before + label + display.format(text + behind) + remark

"""LaTeX as people write it, of what was read: it reads back as the same."""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence

from freebody.check.language.spelling import level, signed, spell
from freebody.check.language.statements import Assignment, Equation, Program
from freebody.symbolic.alphabet import GREEK
from freebody.symbolic.tree import Add, Column, Cross, Dot, Fn, Matrix, Mul, Negative, Node, Num, Pow, Quotient, Sym, Unit

_SUM, _DOT, _CROSS, _PRODUCT, _FACTOR, _ATOM = range(6)
_RELATIONS = {"=": "=", "<=": r"\le", ">=": r"\ge", "<": "<", ">": ">"}
_LATEX_DOTS = ("", r"\dot", r"\ddot", r"\dddot")
_LATEX_FUNCTIONS = {"asin": r"\arcsin", "acos": r"\arccos", "atan": r"\arctan"}
_NAMED = {"sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "exp", "ln", "min", "max"}
_NAME = re.compile(r"([A-Za-z]+?)(?:_(.*?)|(\d.*?))?('*)")


def latex(node: Node) -> str:
    """LaTeX, without dollar signs: ``l\\,\\ddot{\\theta} = -g\\,\\sin\\theta``."""
    match node:
        case Program(lines=lines):
            return r" \\ ".join(latex(line) for line in lines)
        case Assignment(name=left, expression=right):
            return f"{latex(left)} = {latex(right)}"
        case Equation(left=left, right=right, relation=relation):
            return f"{latex(left)} {_RELATIONS[relation]} {latex(right)}"
    return _tex(node, _SUM)


def _tex(node: Node, least: int) -> str:
    text = _tex_inside(node)
    return rf"\left({text}\right)" if level(node) < least and not isinstance(node, Quotient) else text


def _tex_inside(node: Node) -> str:
    match node:
        case Num(text="pi"):
            return r"\pi"
        case Unit(text=text):
            return rf"\mathrm{{{text}}}"
        case Sym():
            return _tex_letter(node)
        case Add(terms=terms):
            return signed(terms, lambda term: _tex(term, _DOT))
        case Negative(of=of):
            return "-" + _tex(of, _DOT)
        case Dot(left=left, right=right):
            return rf"{_tex(left, _DOT)} \cdot {_tex(right, _CROSS)}"
        case Cross(left=left, right=right):
            return rf"{_tex(left, _CROSS)} \times {_tex(right, _PRODUCT)}"
        case Mul(factors=factors):
            return _tex_times(factors)
        case Quotient(top=top, bottom=bottom):
            return rf"\frac{{{_tex(top, _SUM)}}}{{{_tex(bottom, _SUM)}}}"
        case Pow(base=Fn(name=function, args=arguments), exponent=exponent) if function in _NAMED and not isinstance(
            exponent, Negative
        ):
            return rf"\{function}^{{{_tex(exponent, _SUM)}}}{_tex_arguments(arguments)}"
        case Pow(base=base, exponent=exponent):
            inside = _tex(base, _ATOM)
            inside = rf"\left({inside}\right)" if isinstance(base, Quotient | Fn) else inside
            return rf"{inside}^{{{_tex(exponent, _SUM)}}}"
        case Fn(name="sqrt", args=(of,)):
            return rf"\sqrt{{{_tex(of, _SUM)}}}"
        case Fn(name=function, args=arguments):
            name = rf"\{function}" if function in _NAMED else _LATEX_FUNCTIONS.get(function, rf"\operatorname{{{function}}}")
            return name + _tex_arguments(arguments)
        case Column(items=items):
            return _tex_matrix([(item,) for item in items])
        case Matrix(rows=rows):
            return _tex_matrix(rows)
    return spell(node)


def _tex_arguments(arguments: Sequence[Node]) -> str:
    if len(arguments) == 1 and isinstance(arguments[0], Sym):
        return "{" + _tex(arguments[0], _ATOM) + "}"
    return r"\left(" + ", ".join(_tex(a, _SUM) for a in arguments) + r"\right)"


def _tex_times(factors: Sequence[Node]) -> str:
    """Factors with thin spaces; a dot between figures."""
    out = _tex(factors[0], _FACTOR if isinstance(factors[0], Mul) else _PRODUCT)
    for before, factor in itertools.pairwise(factors):
        figures = isinstance(factor, Num) or (isinstance(factor, Pow) and isinstance(factor.base, Num))
        between = r" \cdot " if figures and isinstance(before, Num) else r"\,"
        out += between + _tex(factor, _FACTOR)
    return out


def _tex_matrix(rows: Sequence[Sequence[Node]]) -> str:
    inside = r" \\ ".join(" & ".join(_tex(item, _SUM) for item in row) for row in rows)
    return rf"\begin{{bmatrix}} {inside} \end{{bmatrix}}"


def _tex_letter(letter: Sym) -> str:
    """A letter with Greek, index and dots: ``theta_1`` → ``\\theta_{1}``."""
    found = _NAME.fullmatch(letter.name)
    if not found:
        return rf"\mathrm{{{letter.name}}}" if not letter.dots else rf"{_LATEX_DOTS[letter.dots]}{{\mathrm{{{letter.name}}}}}"
    base = "\\" + found[1] if found[1] in GREEK else found[1] if len(found[1]) == 1 else rf"\mathrm{{{found[1]}}}"
    index = found[2] or found[3]
    dotted = rf"{_LATEX_DOTS[letter.dots]}{{{base}}}" if letter.dots else base
    return dotted + (f"_{{{index}}}" if index else "") + found[4]

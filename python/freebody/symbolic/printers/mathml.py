r"""LaTeX of formulas as MathML, which browsers typeset by themselves: ``\dot\theta_1`` is ``<msub><mover>…</mover><mn>1</mn></msub>``.

What ``latex.py`` and ``names.py`` print is read, and nothing else; so a page shows what LaTeX shows."""

from __future__ import annotations

import html
import re
from collections.abc import Callable, Iterator, Mapping

from freebody.symbolic.symbols import GREEK

_TOKEN = re.compile(r"\\([a-zA-Z]+|.)|(\d+(?:\.\d+)?)|(.)", re.S)
_OPERATORS = {
    "times": "×", "cdot": "·", "to": "→", "le": "≤", "ge": "≥", "ne": "≠", "approx": "≈", "pm": "±",
    "sum": "∑", "{": "{", "}": "}", "&": "&",
}  # fmt: skip
_LETTERS = GREEK | {"phi": "ϕ", "infty": "∞", "partial": "∂", "surd": "√"}
_SPACES = {",": ".17em", " ": ".3em", ";": ".3em", "quad": "1em"}
_FUNCTIONS = ("sin", "cos", "tan", "ln", "exp")
_ACCENTS = {"dot": "˙", "ddot": "¨"}
_OPEN, _CLOSE = "([", ")]"
_RELATIONS = "=≤≥→≠≈<>"
_BINARY, _UNARY = '<mo form="infix">', '<mo form="prefix">'


def mathml(latex: str) -> str:
    """A formula in a sentence. Raises ``ValueError`` for LaTeX that is not printed here."""
    return _math("".join(_Reader(latex).row()))


def broken(latex: str) -> str:
    """A formula on lines of its own: a browser breaks it before =, + and −, within brackets only where it must."""
    return _terms(_Reader(latex).row(), 0)


def _math(inner: str, display: bool = False) -> str:
    style = ' displaystyle="true"' if display else ""
    return f"<math{style}>{inner}</math>" if inner else ""


def _terms(nodes: list[str], depth: int) -> str:
    """Each term by itself; one with brackets can be broken within them."""
    return "".join(_term(part, depth) for part in _split(nodes, depth))


def _term(nodes: list[str], depth: int) -> str:
    if not any(map(_is_sign, nodes[1:])):
        return _math("".join(nodes), display=True)
    return f"<span>{_terms(nodes, depth + 1)}</span>"


def _split(nodes: list[str], wanted: int) -> Iterator[list[str]]:
    """The parts before signs that stand in at most ``wanted`` brackets."""
    depth, part = 0, []
    for node in nodes:
        if part and depth <= wanted and _is_sign(node):
            yield part
            part = []
        depth += _is_bracket(node, _OPEN) - _is_bracket(node, _CLOSE)
        part.append(node)
    yield part


def _is_sign(node: str) -> bool:
    return node.startswith(_BINARY)


def _is_bracket(node: str, signs: str) -> bool:
    return any(node.endswith(f">{sign}</mo>") for sign in signs)


class _Reader:
    """Reads LaTeX from left to right into MathML elements."""

    def __init__(self, latex: str) -> None:
        self._latex, self._place = latex, 0

    def row(self, *ends: str) -> list[str]:
        """Elements up to one of the ends, which is read; with no ends, to the end of all."""
        made: list[str] = []
        while (token := self._next()) not in ends:
            if token is None:
                if ends:
                    raise ValueError(f"LaTeX ends before {' or '.join(ends)}: {self._latex!r}")
                break
            if token in ("_", "^"):
                made.append(self._raised(token, made.pop() if made else "<mrow/>"))
            elif token in ("+", "-"):
                joins = made and not _is_bracket(made[-1], _OPEN) and not _is_sign(made[-1])
                made.append(f"{_BINARY if joins else _UNARY}{'−' if token == '-' else '+'}</mo>")
            else:
                made += self._element(token)
        self.ended = token
        return made

    def _next(self) -> str | None:
        """The next sign: a command with its backslash, a number, or a letter."""
        found = _TOKEN.match(self._latex, self._place)
        if not found:
            return None
        self._place = found.end()
        return found[0]

    def _argument(self) -> str:
        token = self._next()
        while token and token.isspace():
            token = self._next()
        if token is None:
            raise ValueError(f"something is missing at the end of {self._latex!r}")
        return _row(self.row("}") if token == "{" else self._element(token))

    def _raised(self, sign: str, base: str) -> str:
        shown = self._argument()
        lower = re.fullmatch(r"<msub>(.*)</msub>", base)
        if sign == "^" and lower:
            return f"<msubsup>{lower[1]}{shown}</msubsup>"
        return f"<msub>{base}{shown}</msub>" if sign == "_" else f"<msup>{base}{shown}</msup>"

    def _element(self, token: str) -> list[str]:
        if token == "{":
            return self.row("}")
        if not token.startswith("\\"):
            return _sign(token)
        word = token[1:]
        if word in _SPACES:
            return [f'<mspace width="{_SPACES[word]}"/>']
        if word in _FUNCTIONS:
            return [f'<mo form="prefix" lspace=".17em" rspace=".17em">{word}</mo>']
        if word in _OPERATORS:
            return [_operator(_OPERATORS[word])]
        if word in _LETTERS:
            return [f"<mi>{_LETTERS[word]}</mi>"]
        if word not in _COMMANDS:
            raise ValueError(f"LaTeX that is not printed here: {token} in {self._latex!r}")
        return _COMMANDS[word](self)

    def text(self) -> str:
        """What stands in braces, as text."""
        self._next()
        made, depth = "", 1
        while token := self._next():
            depth += (token == "{") - (token == "}")
            if not depth:
                break
            made += _TEXT.get(token, token.removeprefix("\\"))
        return re.sub(r"\{\}", "", made)

    def word(self) -> list[str]:
        return _name(self.text())

    def bold(self) -> list[str]:
        inner = re.sub(r"<[^>]*>", "", self._argument())
        return [f"<mi>{''.join(map(_bold, inner))}</mi>"]

    def accented(self, sign: str) -> list[str]:
        return [f'<mover accent="true">{self._argument()}<mo stretchy="false">{sign}</mo></mover>']

    def fraction(self, style: str = "") -> list[str]:
        return [f"<mfrac{style}>{self._argument()}{self._argument()}</mfrac>"]

    def root(self) -> list[str]:
        return [f"<msqrt>{self._argument()}</msqrt>"]

    def between(self) -> list[str]:
        """What stands between brackets that grow with it."""
        opening = self._next()
        inner = self.row("\\right")
        closing = self._next()
        return [f'<mo stretchy="true">{opening}</mo>', *inner, f'<mo stretchy="true">{closing}</mo>']

    def matrix(self) -> list[str]:
        """An environment of rows and columns."""
        kind = self.text()
        if kind == "array":
            self.text()
        elif kind != "bmatrix":
            raise ValueError(f"LaTeX that is not printed here: {kind}")
        rows, cells = [], []
        while True:
            cells.append(f"<mtd>{''.join(self.row('&', chr(92) * 2, chr(92) + 'end'))}</mtd>")
            if self.ended != "&":
                rows.append(f"<mtr>{''.join(cells)}</mtr>")
                cells = []
            if self.ended == "\\end":
                self.text()
                table = f"<mtable>{''.join(rows)}</mtable>"
                return [table if kind == "array" else f"<mrow><mo>[</mo>{table}<mo>]</mo></mrow>"]


_COMMANDS: Mapping[str, Callable[[_Reader], list[str]]] = {
    "mathrm": _Reader.word, "text": _Reader.word, "operatorname": _Reader.word, "mathbf": _Reader.bold, "boldsymbol": _Reader.bold,
    "frac": _Reader.fraction, "tfrac": lambda reader: reader.fraction(' displaystyle="false"'), "sqrt": _Reader.root,
    "left": _Reader.between, "begin": _Reader.matrix,
    **{word: (lambda reader, sign=sign: reader.accented(sign)) for word, sign in _ACCENTS.items()},
}  # fmt: skip
_TEXT = {r"\textbackslash": "\\", r"\textasciitilde": "~", r"\textasciicircum": "^"}


def _row(elements: list[str]) -> str:
    return elements[0] if len(elements) == 1 else f"<mrow>{''.join(elements)}</mrow>"


def _name(word: str) -> list[str]:
    return [f'<mi mathvariant="normal">{html.escape(word)}</mi>']


def _sign(sign: str) -> list[str]:
    if sign[0].isdecimal():
        return [f"<mn>{sign}</mn>"]
    if sign.isalpha():
        return [f"<mi>{sign}</mi>"]
    return [] if sign.isspace() else [_operator(sign)]


def _operator(sign: str) -> str:
    if sign in _RELATIONS:
        return f"{_BINARY}{html.escape(sign)}</mo>"
    stretch = ' stretchy="false"' if sign in "()[]|" else ""
    return f"<mo{stretch}>{html.escape(sign)}</mo>"


def _bold(letter: str) -> str:
    """The bold letter of mathematics, upright for Latin letters."""
    for first, start in (("a", 0x1D41A), ("A", 0x1D400), ("α", 0x1D736)):
        if 0 <= (step := ord(letter) - ord(first)) < 26:
            return chr(start + step)
    return letter

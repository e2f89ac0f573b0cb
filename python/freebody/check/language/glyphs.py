"""The characters of a statement, plain or LaTeX, as one row of glyphs."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, replace
from enum import Enum
from functools import lru_cache
from itertools import pairwise

from freebody.symbolic.alphabet import LATEX_WORDS, READ
from freebody.symbolic.errors import Span, StatementError
from freebody.symbolic.symbols import dots, folded, plain

from ...model.names import nearest


class Kind(Enum):
    """What a glyph is."""

    WORD = "a letter"
    DIGIT = "a digit"
    LOW = "a piece of a name that cannot stand alone: an underscore, a subscript"
    PRIME = "a prime"
    RAISED = "an exponent, as in R²"
    SIGN = "a sign"
    SPACE = "a blank"
    LINE = "the end of a line"


@dataclass(frozen=True)
class Glyph:
    """A character or LaTeX command: its plain spelling, its place, the dots above it, and whether it is Greek."""

    kind: Kind
    text: str
    span: Span
    dots: int = 0
    greek: bool = False


_SAME = {
    **dict.fromkeys("−–‐‒﹣", "-"),
    **dict.fromkeys("⋅∙•", "·"),
    **{"∗": "*", "⨯": "×", "∧": "×", "÷": "/", "⁄": "/", "≤": "<=", "≥": ">=", "√": "sqrt", "|": "|", "≔": "="},
    **dict.fromkeys("≈≃≅", "="),
}
_FRACTION = re.compile("[½⅓⅔¼¾⅕⅖⅗⅘⅙⅚⅛⅜⅝⅞]|[⁰¹²³⁴-⁹]+⁄[₀-₉]+")
"""A number in small figures."""
_DEGREE = re.compile(r"\^\s*(?:\{\s*\\circ\s*\}|\\circ(?![A-Za-z]))")
"""``30^\\circ``."""
_COMMANDS = {
    **{"cdot": "·", "times": "×", "wedge": "×", "ast": "*"},
    **dict.fromkeys(("approx", "simeq", "cong", "equiv"), "="),
    **{"le": "<=", "leq": "<=", "ge": ">=", "geq": ">=", "lt": "<", "gt": ">"},
    **{"frac": "frac", "tfrac": "frac", "dfrac": "frac", "sqrt": "sqrt", "{": "(", "}": ")", "lbrack": "[", "rbrack": "]"},
    **{"partial": "∂", "circ": "°", "degree": "°", "|": "|", "%": "%"},
    **dict.fromkeys(("to", "rightarrow", "longrightarrow", "xrightarrow"), "→"),
    **{"leftarrow": "←", "uparrow": "↑", "downarrow": "↓", "nearrow": "↗", "searrow": "↘", "nwarrow": "↖", "swarrow": "↙"},
    **{"circlearrowleft": "↺", "circlearrowright": "↻", "curvearrowleft": "↺", "curvearrowright": "↻"},
}
_DOTS = {"dot": 1, "ddot": 2, "dddot": 3}
_WORDS = {"mathrm", "mathsf", "operatorname", "text", "textbf"}
"""Commands of fonts whose names may have blanks in them."""
_SAME_WORDS = {"Sigma": "sum"}
_FONTS = {
    *_WORDS,
    *("vec", "hat", "mathbf", "boldsymbol", "bm", "bar", "underline", "overrightarrow"),
    *("boxed", "mathit", "widehat", "overline", "tilde", "pmb", "mathbb"),
}
"""Commands that change how a letter looks, and not what it is."""
_SCRIPT = {"L": "ℒ", "H": "ℋ", "E": "ℰ", "F": "ℱ", "M": "ℳ", "T": "T", "V": "V"}
_NOTHING = {
    *",!;:()[]>",
    *("left", "right", "big", "Big", "bigl", "bigr", "Bigl", "Bigr"),
    *("displaystyle", "allowdisplaybreaks", "notag", "nonumber", "limits"),
}
ARROWS = tuple("→←↑↓↗↘↖↙↺↻")
"""Which way a vector points, behind it; else what follows."""
_THEREFORE = {"quad", "qquad", "Rightarrow", "implies", "therefore", "Longrightarrow", "Leftrightarrow", "iff"}
_FUNCTIONS = {"sin", "cos", "tan", "cot", "sec", "csc", "sinh", "cosh", "tanh", "exp", "ln", "log", "arcsin", "arccos", "arctan"}
_COMMAND = re.compile(r"\\(?:[A-Za-z]+|.)", re.DOTALL)
_ENVIRONMENT = re.compile(r"\\(begin|end)\s*\{([A-Za-z]*)\*?\}(?:\{[clr|]*\})?")
_NUMBER = re.compile(r"(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_LIMITS = re.compile(
    r"(?:\s|\\limits)*(?:_(?:\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}|([^\s^{}]+))|([₀-₉]+))"
    r"\s*(?:\^(?:\{([^{}]*(?:\{[^{}]*\}[^{}]*)*)\}|(\\[A-Za-z]+|\w[\w']*))|([ᵗˣˢ⁰-⁹]+))"
)
"""The limits of an integral, as in ``_0^{t_1}`` and ``₀ᵗ``."""
_UPRIGHT = {Kind.LOW: Kind.DIGIT, Kind.RAISED: Kind.WORD}
_BLANKS = re.compile(r"\s*")
_COMMENT = re.compile(r"(?<!\\)(?:#|%(?<!\d%)(?<!\d %))[^\n]*")
CONDITION = (
    r"at|as|between|when|once|if|in|for|with|after|before|initially|just|immediately|right(?=\s+(?:after|before|at|when)\b)|until|while|during|lim|given|assuming|provided"
    r"|neglecting|without|suppose|starting|released|from rest"
)
"""Words with which no label begins: what stands there says of which motions it is."""
_ARROW = (
    rf"(?:[{''.join(ARROWS)}]|\\(?:(?:circle|curve)arrow\w+|(?:right|left|up|down|[ns][ew])arrow)"
    r"|\\(?:x(?:right|left)arrow|overset|stackrel)\s*\{[^{}]*\}(?:\s*\{[^{}]*\})?)"
)
_SENSE = rf"(?:[(\[]?\s*\+?\s*{_ARROW}\s*\+?\s*[)\]]?:?)"
"""What is positive, as in ``(↺+)`` and ``+→``."""
_SUM = r"\s*(?:\\sum|\\Sigma|[Σ∑])"
_LABEL = re.compile(
    rf"(?m)(?:^|(?<=;))(?!\s*(?:{CONDITION})\b)(?:(?:[^=:;\n\\]|{_ARROW}|\\(?:perp|parallel)\b)*|[^=:;\n\\]*[A-Za-z]{{3}}(?:[^=:;\n\\]|\\[A-Za-z,;> ])*):(?!=)|(?:^|(?<=;))\s*(?:[A-Za-z]\w?\s*,)?\s*{_SENSE}?{_SUM}[^:;\n]*:(?!=)"
    r"|(?:^|(?<=;))\s*(?:\\(?:d?dot|vec|mathbf|bm)\s*\{?\s*)+\w\}*(?:_\w|_\{\w+\})?\s*:(?!=)"
    rf"|^\s*{_SENSE}{_SUM}[^:;\n]*=\s*(?:0|[^:;\n]*(?:a|α|M_?\{{?k)[^:;\n]*);|^\s*{_SENSE}(?={_SUM})"
    r"|:(?==)|=(?==)|\\(?:tag|label)\*?\s*\{[^}]*\}|(?:(?<=\s\s)|\\q?quad\s*)\(\d+\w?\)\s*$"
)
_LAID_OUT = re.compile(r"(\\resizebox\{[^{}]*\}\{!\}\{\$|\{\\allowdisplaybreaks\b)(.*?)(\$\}|(?<=\\end\{align\})\})", re.DOTALL)
"""What fits a formula to the width, or lets it go on overleaf, and the formula."""


@lru_cache(maxsize=64)  # with other names the same text is read again
def glyphs(text: str) -> tuple[Glyph, ...]:
    """All glyphs of a statement. Comments, labels in front of a colon, numbers of equations at the end and how it is laid out
    read as blanks. Raises ``StatementError``."""
    bare = _LAID_OUT.sub(lambda found: f"{' ' * len(found[1])}{found[2]}{' ' * len(found[3])}", _COMMENT.sub(_blank, text))
    return tuple(_carried_on(_pointing(_Reader(_LABEL.sub(_blank, bare)).all())))


def _pointing(row: list[Glyph]) -> list[Glyph]:
    """The glyphs, where an arrow with something behind it is the end of a line: it says what follows."""
    out = list(row)
    for i, glyph in enumerate(row):
        behind = next((other for other in row[i + 1 :] if other.kind is not Kind.SPACE), None)
        if (
            glyph.text in ARROWS
            and behind is not None
            and behind.kind is not Kind.LINE
            and behind.text not in (",", ";", ".", ")")
        ):
            out[i] = replace(glyph, kind=Kind.LINE, text="\n")
    return out


def _carried_on(row: list[Glyph]) -> list[Glyph]:
    """The glyphs, where an indented line that begins within brackets goes on with the one before."""
    out, depth = [], 0
    for glyph, after in pairwise([*row, Glyph(Kind.LINE, "\n", (0, 0))]):
        depth = max(0, depth + (glyph.text in ("(", "[")) - (glyph.text in (")", "]")))
        goes_on = glyph.kind is Kind.LINE and depth > 0 and after.kind is Kind.SPACE
        out.append(replace(glyph, kind=Kind.SPACE, text=" ") if goes_on else glyph)
        depth = 0 if out[-1].kind is Kind.LINE else depth
    return out


def _blank(found: re.Match[str]) -> str:
    return " " * len(found[0])


class _Reader:
    def __init__(self, text: str) -> None:
        self.text, self.at, self.matrices = text, 0, 0

    def all(self) -> list[Glyph]:
        out: list[Glyph] = []
        while self.at < len(self.text):
            found = self.next()
            if out and out[-1].text == "sum" and [g.kind for g in found] == [Kind.SPACE]:
                continue  # Σ F is one letter
            out.extend(found)
        return out

    def next(self) -> list[Glyph]:
        """The glyphs of what begins here; none where it is only dress."""
        start, char = self.at, self.text[self.at]
        if char == "\\":
            return self.command()
        if number := _NUMBER.match(self.text, start):
            # A number at once behind a letter is the index of the letter; the tokens decide.
            self.at = number.end()
            return [Glyph(Kind.DIGIT, number[0], (start, self.at))]
        if fraction := _FRACTION.match(self.text, start):
            self.at = fraction.end()
            plainly = unicodedata.normalize("NFKC", fraction[0]).replace("⁄", "/")
            return [Glyph(Kind.SIGN, f"({plainly})", (start, self.at))]
        if degree := _DEGREE.match(self.text, start):
            self.at = degree.end()
            return [_plain_glyph("°", (start, self.at))]
        self.at += 1
        if char == "∫":
            return self.integral(start)
        while self.at < len(self.text) and unicodedata.combining(self.text[self.at]):
            self.at += 1
        if char == "_" and self.text[self.at : self.at + 1] == "{":  # what stands in braces is one piece of the name
            inner = "".join(g.text for g in self.group() if g.kind is not Kind.SPACE)
            return [Glyph(Kind.LOW, text, (start, self.at)) for text in ("", folded(inner))]
        if char == "_":
            return [Glyph(Kind.LOW, "", (start, self.at))]
        if char == "&" and not self.matrices:
            return []
        return [_plain_glyph(self.text[start : self.at], (start, self.at))]

    def group(self) -> list[Glyph]:
        """The glyphs of a braced group, or of the one thing that stands here: of 12 only the 1."""
        start = self.at = _BLANKS.match(self.text, self.at).end()  # type: ignore[union-attr]
        if start >= len(self.text):
            raise StatementError("something is missing at the end", (start - 1, start), "LaTeX commands want `{…}` behind them")
        if self.text[start] != "{" and not self.text[start].isdecimal():
            return self.next()
        self.at += 1
        if self.text[start].isdecimal():
            return [Glyph(Kind.DIGIT, self.text[start], (start, self.at))]
        out: list[Glyph] = []
        while self.text[self.at : self.at + 1] != "}":
            if self.at >= len(self.text):
                raise StatementError("a `{` is never closed", (start, start + 1))
            out += self.braced() if self.text[self.at] == "{" else self.next()
        self.at += 1
        return out

    def braced(self) -> list[Glyph]:
        """A group or one thing, with its braces."""
        start = _BLANKS.match(self.text, self.at).end()  # type: ignore[union-attr]
        inner = self.group()
        return [Glyph(Kind.SIGN, "{", (start, start + 1)), *inner, Glyph(Kind.SIGN, "}", (self.at - 1, self.at))]

    def command(self) -> list[Glyph]:
        start = self.at
        if found := _ENVIRONMENT.match(self.text, start):
            return self.environment(found)
        found = _COMMAND.match(self.text, start)
        if not found:
            raise StatementError("a `\\` with nothing behind it", (start, start + 1))
        self.at = found.end()
        word, span = _SAME_WORDS.get(found[0][1:], found[0][1:]), (start, found.end())
        if word in _DOTS:
            inside = self.group()
            if inside and (inside[0].text, inside[-1].text) in (("(", ")"), ("[", "]")):  # the rate of a bracket
                return [*inside, *[Glyph(Kind.PRIME, "'", span)] * _DOTS[word]]
            first = next((g for g in inside if g.kind is Kind.WORD), None)  # dots stand on the first letter
            return [replace(g, dots=g.dots + _DOTS[word]) if g is first else g for g in inside]
        if word in ("mathcal", "mathscr"):  # a Lagrangian is no length
            return [replace(g, text=_SCRIPT.get(g.text, g.text)) for g in self.group()]
        if word in _FONTS:
            return [g for g in self.group() if word not in _WORDS or g.kind is not Kind.SPACE]
        if word in LATEX_WORDS:
            greek = word not in ("ell", "imath", "jmath", "sum", "prime")
            return [Glyph(Kind.PRIME if word == "prime" else Kind.WORD, LATEX_WORDS[word], span, greek=greek)]
        return self.sign(word, span)

    def sign(self, word: str, span: Span) -> list[Glyph]:
        if word in _THEREFORE:
            return [Glyph(Kind.LINE, "\n", span)]
        if word == "int":
            return self.integral(span[0])
        if word == "\\":
            return [Glyph(Kind.SIGN, ";", span) if self.matrices else Glyph(Kind.LINE, "\n", span)]
        if word in ("max", "min"):
            return [Glyph(Kind.WORD, word, span)]
        if word in _FUNCTIONS:
            return [Glyph(Kind.SIGN, "function:" + word, span)]
        if word in _NOTHING or word.isspace():
            return [Glyph(Kind.SPACE, " ", span)]
        if word not in _COMMANDS:
            near = nearest(word, [*_COMMANDS, *LATEX_WORDS, *_FUNCTIONS, *_DOTS])
            hint = f"did you mean `\\{near}`?" if near else "Greek letters, \\frac, \\sqrt, \\dot, \\cdot, \\times … are"
            raise StatementError(f"`\\{word}` is not known here", span, hint)
        sign = Glyph(Kind.SPACE if _COMMANDS[word] == " " else Kind.SIGN, _COMMANDS[word], span)
        return [sign, *self.braced(), *self.braced()] if sign.text == "frac" else [sign]

    def integral(self, start: int) -> list[Glyph]:
        """The sign of an integral and its limits, each in braces."""
        found = _LIMITS.match(self.text, self.at)
        if not found:
            raise StatementError("an integral without limits", (start, self.at), "write `∫_0^t … dt`")
        out, self.at = [Glyph(Kind.SIGN, "∫", (start, self.at))], found.end()
        for low, group, marked in ((1, 2, 3), (4, 5, 6)):
            name = next(number for number in (low, group, marked) if found[number] is not None)
            inside = _Reader(self.text[: found.end(name)])
            inside.at = found.start(name)
            row = [replace(g, kind=_UPRIGHT[g.kind]) if name == marked and g.kind in _UPRIGHT else g for g in inside.all()]
            ends = [Glyph(Kind.SIGN, brace, found.span(name)) for brace in "{}"]
            out += [ends[0], *row, ends[1]]
        return out

    def environment(self, found: re.Match[str]) -> list[Glyph]:
        self.at = found.end()
        if not found[2].endswith("matrix") and found[2] != "array":
            return [Glyph(Kind.SPACE, " ", found.span())]
        begins = found[1] == "begin"
        self.matrices += 1 if begins else -1
        return [Glyph(Kind.SIGN, "matrix[" if begins else "]", found.span())]


def _plain_glyph(char: str, span: Span) -> Glyph:
    """The glyph of one character with its marks."""
    base = unicodedata.normalize("NFD", char)[0]
    form = unicodedata.decomposition(base)
    if char in "\n\r⇒⟹∴⇔":
        return Glyph(Kind.LINE, "\n", span)
    if char.isspace() or char in "~$":
        return Glyph(Kind.SPACE, " ", span)
    if form.startswith("<super>"):
        return Glyph(Kind.RAISED, _SAME.get(raised := chr(int(form.split()[1], 16)), raised), span)
    if form.startswith("<sub>"):
        return Glyph(Kind.LOW, plain(base), span)
    if base in "'’′″":
        return Glyph(Kind.PRIME, READ.get(base, base), span)
    if (base.isalpha() and char not in _SAME) or base == "∑":
        return Glyph(Kind.WORD, plain(base), span, dots(char), base in READ and base not in "ℓıȷΣ∑")
    return Glyph(Kind.SIGN, _SAME.get(char, char), span)

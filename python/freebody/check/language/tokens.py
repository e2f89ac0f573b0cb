"""From glyphs to tokens: which rows of characters are names, which are several names side by side."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import accumulate, chain, pairwise, takewhile

from freebody.symbolic.errors import Span, StatementError
from freebody.symbolic.evaluate import FUNCTIONS
from freebody.symbolic.symbols import folded

from .glyphs import Glyph, Kind, glyphs

ALIASES = {
    **{
        "arcsin": "asin",
        "arccos": "acos",
        "arctan": "atan",
        "arctg": "atan",
        "tg": "tan",
        "log": "ln",
        "sgn": "sign",
        "cross": "cross",
        "dot": "dot",
    },
    **{f"{before}{of}": f"a{of}" for before in ("ar", "arc", "arg") for of in ("sinh", "cosh", "tanh")},
}
CALLS = {**{name: name for name in FUNCTIONS}, **ALIASES, "diff": "diff"}
_SUFFIXES = {"dddot": 3, "ddot": 2, "dot": 1}
_SHORT = re.compile(r"(?P<before>d{1,2})?(?P<name>.+?)(?(before)|(?P<after>d{1,2}))")
"""Rates as programs have them: dtheta, ddtheta, thetad, theta_dd."""
_OF_LETTERS = re.compile(r"([2-9]|[1-9]\d)(e)([+-])(\d)")
"""``5e-2`` where e is a letter."""
_LONGEST = 400  # glyphs of names without a sign between them
_WORDS = {"with", "where", "and"}
_OPERANDS = {"symbol", "number", "raised", ")", "]"}
_IN_NAMES = (Kind.WORD, Kind.DIGIT, Kind.LOW, Kind.PRIME)
# r_G1/O, ΣM/O, H_123/A: a label after a stroke that is part of a name, where no declared name decides
_RELATIVE = re.compile(r"(?:sum)?(?:[rvaLHM][A-Z]?\w*|[a-z]+[A-Z]\w*)/[A-Z]\d*'?")
# {d^2 θ}{dt^2}, {d}{dt}
_FRACTION = re.compile(
    r"\{d(?:\^?(\{)?(?P<order>\d|²)(?(1)\}))?(?P<of>[A-Za-z][\w']*)?\}\{dt(?:\^?(?:(?P=order)|\{(?P=order)\}))?\}"
)


@dataclass(frozen=True)
class Token:
    """A piece of a statement. ``kind``: number, symbol, function, raised, primes, line, end, or the sign itself.

    ``text``: the name, digits or sign; ``dots``: time derivatives of a symbol, or of the bracket before ``primes``; ``attached``: no blank before it.
    """

    kind: str
    text: str
    span: Span
    dots: int = 0
    attached: bool = False


@dataclass(frozen=True)
class Names:
    """The symbols that are known, by which rows of characters are read: ``mg`` is m·g where m and g are known."""

    known: tuple[str, ...] = ()
    constants: frozenset[str] = frozenset()
    """Those that do not change with time."""
    units: bool = False
    """Whether what may be a unit behind a number is one, known symbol or not."""
    tight: bool = False
    """Whether what stands directly behind a factor below a stroke is below it, too."""
    apart: bool = False
    """Whether letters side by side are no name with an index, which they would spell."""
    no_rates: frozenset[str] = frozenset()
    """Those that are no angular rates, so that v sin β t is v sin(β) t."""

    @cached_property
    def by_spelling(self) -> dict[str, str]:
        """The declared name of each folded spelling; a name that is spelled just so goes first. ``Mg`` is no M_g where it is M times g,
        but φ is no p times h times i."""
        made = lambda n: n.isascii() and n not in self.constants and self.constants.issuperset(folded(n))
        indexed = lambda n: self.apart and "_" in n and {*self.known}.issuperset(folded(n))
        folding = (n for n in reversed(self.known) if not (made(n) or indexed(n)))
        return {**{folded(n): n for n in folding}, **{n: n for n in self.known}}

    @cached_property
    def odd(self) -> list[str]:
        """Folded names with strokes, points and brackets in them, long ones first."""
        return sorted((s for s in self.by_spelling if not re.fullmatch(r"[\w']+", s)), key=len, reverse=True)

    def find(self, spelling: str) -> tuple[str, int] | None:
        """The name and its number of time derivatives, e.g. of ``thetaddot``; None where it is not known."""
        known = self.by_spelling
        if spelling in known:
            return known[spelling], 0
        for suffix, count in _SUFFIXES.items():
            if (stem := spelling.removesuffix(suffix)) != spelling and stem in known:
                return known[stem], count
        ends = [n for n in range(len(spelling.rstrip("'")), len(spelling)) if spelling[:n] in known]
        if len(ends) == 1:  # each prime behind a known name is a derivative, unless two names could be meant
            return known[spelling[: ends[0]]], len(spelling) - ends[0]
        short = _SHORT.fullmatch(spelling) if "d" not in known else None
        name = known.get(short["name"]) if short else None
        if short is None or name is None or name == "t" or name in self.constants:
            return None
        return name, len(short["before"] or short["after"])


def tokens(text: str, names: Names = Names()) -> list[Token]:
    """The tokens of a statement, plain or LaTeX, closed by one of kind ``end``. Raises ``StatementError``."""
    row = glyphs(text)
    row = tuple(chain(*map(_of_letters, row))) if "e" in names.known else row
    return [*_Reader(row, names).all(), Token("end", "", (len(text), len(text)))]


def _of_letters(glyph: Glyph) -> Iterable[Glyph]:
    """A number as ``5e-2`` as 5 e − 2, which it is where e is a letter; ``1e-3`` and ``2.5e-2`` nobody writes of one."""
    parts = _OF_LETTERS.fullmatch(glyph.text) if glyph.kind is Kind.DIGIT else None
    if parts is None:
        return [glyph]
    kinds, at = (Kind.DIGIT, Kind.WORD, Kind.SIGN, Kind.DIGIT), glyph.span[0]
    return [Glyph(kind, parts[i], (at + parts.start(i), at + parts.end(i))) for i, kind in enumerate(kinds, 1)]


@dataclass(frozen=True)
class _Piece:
    """A name or function in a row of glyphs, up to the glyph ``end``."""

    kind: str
    name: str
    dots: int
    end: int


class _Reader:
    def __init__(self, row: Sequence[Glyph], names: Names) -> None:
        self.row, self.names, self.at = [*row, Glyph(Kind.LINE, "\n", (0, 0))], names, 0
        self.out: list[Token] = []
        self.blank, self.integrals = True, 0
        self.best = lru_cache(None)(self._best)

    def all(self) -> list[Token]:
        while self.at < len(self.row) - 1:
            glyph = self.row[self.at]
            if glyph.kind is Kind.SPACE:
                self.at += 1
                self.blank = True
            elif glyph.kind is Kind.PRIME and self.out and self.out[-1].kind in (")", "]"):
                self.primes()
            elif glyph.kind in (Kind.WORD, Kind.LOW, Kind.PRIME):
                self.run()
            elif glyph.kind is Kind.RAISED:
                start = self.at
                while self.row[self.at].kind is Kind.RAISED:
                    self.at += 1
                self.put("raised", self.spelling(start, self.at), start)
            else:
                self.sign(glyph)
        return self.out

    def primes(self) -> None:
        """Those behind a bracket: of all in it."""
        start = self.at
        while self.row[self.at].kind is Kind.PRIME:
            self.at += 1
        text = self.spelling(start, self.at)
        self.put("primes", text, start, len(text))

    def put(self, kind: str, text: str, start: int, dots: int = 0) -> None:
        """A token from the glyph ``start`` to where the reading stands."""
        self.out.append(Token(kind, text, self.span(start, self.at), dots, not self.blank))
        self.blank = False

    def span(self, start: int, end: int) -> Span:
        return self.row[start].span[0], self.row[end - 1].span[1]

    def sign(self, glyph: Glyph) -> None:
        start, kind, text = self.at, glyph.text, glyph.text
        if text == "frac" and (found := self.fraction_derivative()):
            return self.take([found])
        self.at += 1
        pair = text + self.spelling(self.at, self.at + 1)
        if glyph.kind is Kind.DIGIT:
            kind = "number"
        elif glyph.kind is Kind.LINE:
            kind = "line"
        elif text.startswith("function:"):
            kind, text = "function", CALLS[text.removeprefix("function:")]
        elif text == "sqrt":
            kind = "function"
        elif text == "∫":
            self.integrals += 1
        elif len(text) == 1 and pair in ("<=", ">=", "**"):
            self.at += 1
            kind = text = "^" if pair == "**" else pair
        elif text.startswith("(") and len(text) > 1:  # a sign like ½, as a quotient in brackets
            for piece in re.findall(r"\d+|\D", text):
                self.put("number" if piece.isdecimal() else piece, piece, start)
            return
        self.put(kind, text, start)

    # --- names ---------------------------------------------------------------------------------

    def run(self) -> None:
        """The names that stand side by side from here."""
        if self.integrals and (found := self.differential()):
            self.integrals -= 1
            return self.take([found])
        if found := self.derivative():
            return self.take([found])
        if found := self.slope():
            return self.take(found)
        end = self.run_end(self.at)
        if (count := end - self.at) > _LONGEST:
            what = f"{count} letters without a sign between them"
            raise StatementError(what, self.span(self.at, end), "write signs between them")
        text = self.spelling(self.at, end)
        if text in _WORDS and not self.names.find(text):
            return self.take([_Piece("line", "\n", 0, end)])
        between = self.blank and self.row[end].kind is Kind.SPACE and self.out and self.out[-1].kind in _OPERANDS
        if text == "x" and between and self.names.known and not self.names.find("x"):  # no symbol, but a cross product
            return self.take([_Piece("×", "×", 0, end)])
        self.take(self.best(self.at, end) or self.unknown(self.at, end))

    def take(self, pieces: Iterable[_Piece]) -> None:
        for piece in pieces:
            start, self.at = self.at, piece.end
            self.put(piece.kind, piece.name, start, piece.dots)

    def run_end(self, start: int) -> int:
        return next(i for i in range(start, len(self.row)) if self.row[i].kind not in _IN_NAMES)

    def spelling(self, start: int, end: int) -> str:
        return "".join(g.text for g in self.row[start:end])

    def marks(self, start: int, end: int) -> int:
        return sum(g.dots for g in self.row[start:end])

    def _best(self, start: int, end: int) -> tuple[_Piece, ...] | None:
        """The fewest known names that the glyphs from ``start`` to ``end`` are; None where there is no way."""
        if start >= end:
            return ()
        ways = [(p, *rest) for p in self.pieces(start, end) if (rest := self.best(p.end, end)) is not None]
        if not ways:
            return None
        least = min(ways, key=len)
        rivals = [way for way in ways if len(way) == len(least) and way[0].end <= end]
        if len(rivals) > 1 and start == self.at and least[0].end <= end:
            shown = " or ".join(f"`{' '.join(piece.name for piece in way)}`" for way in rivals)
            raise StatementError(f"this can be read as {shown}", self.span(start, end), "put blanks between the symbols")
        return least

    def pieces(self, start: int, end: int) -> list[_Piece]:
        """The known names and functions that begin at a glyph; one with a stroke in it can reach beyond ``end``."""
        for name in self.names.odd:
            if (after := self.matches(start, name)) is not None:
                primes = len(list(takewhile(lambda glyph: glyph.kind is Kind.PRIME, self.row[after:])))
                dots = self.marks(start, after) + len(self.spelling(after, after + primes))
                return [_Piece("symbol", self.names.by_spelling[name], dots, after + primes)]
        out = []
        for stop in range(start + 1, end + 1):
            if (stop < end and self.row[stop].kind in (Kind.LOW, Kind.PRIME)) or self.row[stop - 1].text == "":
                continue
            spelling = self.spelling(start, stop)
            known, marks = self.names.find(spelling), self.marks(start, stop)
            calls = spelling in CALLS and not marks and self.row[start].kind is Kind.WORD
            if calls and (not known or self.is_argument(stop)):
                out.append(_Piece("function", CALLS[spelling], 0, stop))
            elif known or (spelling == "pi" and not marks):  # no p times i
                name, dots = known or (spelling, 0)
                out.append(_Piece("symbol", name, dots + marks, stop))
        return out

    def is_argument(self, at: int) -> bool:
        """Whether what stands here may be what a function before it is of."""
        after = next(glyph for glyph in self.row[at:] if glyph.kind is not Kind.SPACE)
        return after.kind in (Kind.WORD, Kind.DIGIT) or after.text in ("(", "[", "{", "sqrt", "frac")

    def matches(self, start: int, name: str) -> int | None:
        """The glyph behind a name with signs in it, where it stands here."""
        at, left = start, name
        while left:
            glyph = self.row[at]
            text = "" if glyph.kind is Kind.SPACE and ("'" in name or "(" in name) else glyph.text
            if not left.startswith(text) or not (text or at > start):
                return None
            at, left = at + 1, left.removeprefix(text)
        behind = self.row[at].kind
        if behind is Kind.PRIME and self.names.known:
            return at
        return None if behind in (Kind.LOW, Kind.PRIME) or (behind in _IN_NAMES and name[-1].isalnum()) else at

    def unknown(self, start: int, end: int) -> list[_Piece]:
        """Names that nobody declared: Latin and Greek letters part, and a label after a stroke belongs to the name."""
        if (after := self.relative(start, end)) is not None:
            return [_Piece("symbol", self.written(start, after), self.marks(start, after), after)]
        ends, greek = [], self.row[start].greek
        for i in range(start + 1, end):
            if self.row[i].kind is Kind.WORD and self.row[i].greek != greek and self.row[i - 1].kind is not Kind.LOW:
                ends.append(i)
                greek = not greek
        out: list[_Piece] = []
        for first, stop in pairwise([start, *ends, end]):
            known = self.best(first, stop) if (first, stop) != (self.at, end) else None
            out += known or [self.bare(first, stop)]
        return out

    def bare(self, start: int, end: int) -> _Piece:
        """An unknown symbol; the word ``dot`` behind it is still a derivative."""
        spelling, count = self.spelling(start, end), self.marks(start, end)
        if not spelling.strip("'"):
            raise StatementError("a mark without a symbol before it", self.row[start].span)
        if spelling in CALLS and not count:
            return _Piece("function", CALLS[spelling], 0, end)
        for suffix, dots in _SUFFIXES.items():
            if spelling.endswith(suffix) and spelling != suffix:
                return _Piece("symbol", spelling.removesuffix(suffix), dots + count, end)
        return _Piece("symbol", self.written(start, end), count, end)

    def written(self, start: int, end: int) -> str:
        """An unknown name as a person would write it plainly: with its underscores."""
        text = "".join("_" if g.kind is Kind.LOW and not g.text else g.text for g in self.row[start:end])
        return re.sub("^sum(?=.)", "Σ", text.replace("_/", "/"))

    def relative(self, start: int, end: int) -> int | None:
        """The glyph behind a name like ``r_G1/O``, or None."""
        if self.row[end].text == "/":
            after = self.run_end(end + 1)
            base = self.spelling(start, end)
            low = any(g.kind is Kind.LOW for g in self.row[start:end]) or base.removeprefix("sum") in ("H", "M", "L")
            if low and not self.best(end + 1, after) and _RELATIVE.fullmatch(self.spelling(start, after)):
                return after
        elif "/" in self.spelling(start, end):
            return end
        return None

    # --- derivatives ---------------------------------------------------------------------------

    def derivative(self) -> _Piece | None:
        """dθ/dt and d²θ/dt², from a d on."""
        row, at = self.row, self.at
        if row[at].text != "d" or row[at].dots:
            return None
        order, at = self.order(at + 1)
        while row[at].kind is Kind.SPACE:
            at += 1
        stroke = self.run_end(at)
        if self.spelling(stroke, stroke + 3) != "/dt":
            return None
        again, end = self.order(stroke + 3)
        if stroke == at and again == order:
            return _Piece("rate", "d/dt", order, end)
        if again != order or row[end].kind in _IN_NAMES:
            return None
        spelling = self.spelling(at, stroke)
        name, dots = self.names.find(spelling) or (spelling, 0)
        return _Piece("symbol", name, dots + order + self.marks(at, stroke), end)

    def differential(self) -> _Piece | None:
        """dθ, with which an integral ends."""
        end = self.run_end(self.at)
        spelling = self.spelling(self.at, end)
        name = self.names.find(spelling[1:])
        if not spelling.startswith("d") or self.names.find(spelling) == (spelling, 0) or (name or ("", 0))[1]:
            return None
        if name is None and spelling != "dt":
            return None
        return _Piece("differential", name[0] if name else "t", 0, end)

    def fraction_derivative(self) -> _Piece | None:
        """The same, and the derivative of what stands behind, d/dt and d²/dt², written as a LaTeX fraction."""
        inside = [i for i in range(self.at + 1, len(self.row)) if self.row[i].kind is not Kind.SPACE]
        texts = ["²" if self.row[i].kind is Kind.RAISED else self.row[i].text for i in inside]
        found = _FRACTION.match("".join(texts))
        if not found:
            return None
        last = next(i for i, length in enumerate(accumulate(map(len, texts))) if length >= found.end())
        end, order = inside[last] + 1, int((found["order"] or "1").replace("²", "2"))
        if not found["of"]:
            return _Piece("rate", "d/dt", order, end)
        name, dots = self.names.find(folded(found["of"])) or (found["of"], 0)
        return _Piece("symbol", name, dots + order + self.marks(self.at, end), end)

    def slope(self) -> list[_Piece] | None:
        """dv/dx, from a d on, of two known names: the quotient of their rates, in brackets."""
        middle = self.run_end(self.at)
        end = self.run_end(middle + 1) if self.row[middle].text == "/" else middle
        top, bottom = self.spelling(self.at, middle), self.spelling(middle + 1, end)
        if not top.startswith("d") or not bottom.startswith("d") or self.names.find(top):
            return None
        found = [self.names.find(text[1:]) for text in (top, bottom)]
        if None in found:
            return None
        rates = [_Piece("symbol", name, dots + 1, end) for name, dots in found]
        return [_Piece("(", "(", 0, end), rates[0], _Piece("/", "/", 0, end), rates[1], _Piece(")", ")", 0, end)]

    def order(self, at: int) -> tuple[int, int]:
        """The order of a derivative written here (1 where nothing is), and the glyph behind it."""
        written = "".join("^" * (g.kind is Kind.RAISED) + g.text for g in self.row[at : at + 4])
        if not (found := re.match(r"\^(\d)|\^\{(\d)\}", written)):
            return 1, at
        raised = self.row[at].kind is Kind.RAISED
        return int(found[1] or found[2]), at + found.end() - raised

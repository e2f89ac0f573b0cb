"""Symbols and their glyphs: how a name is printed (``theta1`` is θ₁, ``m_rod`` has a subscript, ``pivot.x`` belongs to the pivot),
and which spellings are one symbol: θ, theta and \\theta; m1, m_1, m₁ and m_{1}."""

from __future__ import annotations

import itertools
import re
import unicodedata
from dataclasses import dataclass, field, replace
from functools import lru_cache

from freebody.symbolic.alphabet import GREEK, READ, SPELT
from freebody.symbolic.formula import Atom, Formula, Script, dotted, joined
from freebody.symbolic.printers.latex import latex

_MARKS = {"\u0307": 1, "\u0308": 2, "\u20db": 3}
_NUMBERED = re.compile(r"[_{},\s]")
_EPS = re.compile(r"eps(?=\d*$)")
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_FROM_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_COMBINING = ("", "\u0307", "\u0308")
_COMMA = (Atom(",", "sign"),)


@dataclass(frozen=True)
class Name:
    """A name in parts: ``arm.theta_1`` is owner ``arm``, stem ``theta``, below it ``1``; N of the track is ``Name("N", ("track",))``."""

    stem: str
    below: tuple[str, ...] = ()
    owner: str = ""

    @classmethod
    def parse(cls, name: str) -> Name:
        """In parts: what follows the first underscore, digits at the end, and what is in brackets is below."""
        owner, _, last = name.translate(_FROM_SUBSCRIPTS).replace("'", "").rpartition(".")
        found = re.fullmatch(r"([^\W\d_]+)(?:_?(\d+)|_([\w ]+))?(?:\[(\d+)\])?", last)
        stem, *below = found.groups() if found else (last,)
        return cls(SPELT.get(stem, stem), tuple(filter(None, below)), owner)

    @property
    def is_letter(self) -> bool:
        """Whether the stem is one letter, Latin or Greek."""
        return len(self.stem) == 1 or self.stem in GREEK

    def unicode(self, dots: int = 0) -> str:
        """``θ̈₁``, ``N_track``, ``pivot_x``; the rate of a word of several letters has primes."""
        stem = GREEK.get(self.stem, _word(self.stem))
        below = "".join(
            part.translate(SUBSCRIPTS) if part.isdigit() else f"_{GREEK.get(part, _word(part))}" for part in self.below
        )
        made = stem + _COMBINING[dots] + below if self.is_letter else stem + below + "′" * dots
        return f"{self.owner.replace(' ', '_')}.{made}" if self.owner else made

    def ascii(self) -> str:
        """``N_track``, ``N_floor1``."""
        return (
            f"{self.owner}." * bool(self.owner)
            + _word(self.stem)
            + "".join(part if part.isdigit() else f"_{_word(part)}" for part in self.below)
        )

    def formula(self, dots: int = 0, *, bold: bool = False) -> Formula:
        """Set in type: θ̈₁, N with ``track`` below it; a ``bold`` stem is a vector."""
        a, b = self.stem if len(self.stem) == 2 and self.stem not in GREEK else ("", "")
        # Of mA the second letter is below.
        stem, below = (a, (b, *self.below)) if a.isupper() != b.isupper() else (self.stem, self.below)
        letter = (Atom(GREEK.get(stem, stem), "bold") if bold else _letter(stem, "word"),)
        shown = [*((_letter(part, "label"),) for part in below if part), *([(Atom(self.owner, "word"),)] if self.owner else [])]
        return (Script(dotted(letter, dots), joined(shown, _COMMA)),) if shown else dotted(letter, dots)

    def latex(self, dots: int = 0, *, bold: bool = False) -> str:
        r"""``\ddot\theta_1``, ``N_{\text{track}}``; for mathtext as well."""
        return latex(self.formula(dots, bold=bold))


def unicode_name(text: str, dots: int = 0) -> str:
    """``theta1`` with two dots is θ̈₁; the rate of a word of several letters has primes."""
    return Name.parse(text).unicode(dots)


def ascii_name(text: str, dots: int = 0) -> str:
    """The name with Greek spelt and a prime for each dot: ``theta1''``."""
    plain = re.sub(r"\[(\d+)\]", r"\1", text.translate(_FROM_SUBSCRIPTS)).replace(" ", "_")
    return "".join(SPELT.get(sign, sign) for sign in plain) + "'" * dots


def name_formula(text: str, dots: int = 0, *, reaction: bool = False) -> Formula:
    """``theta1`` with two dots is θ̈₁; of a reaction ``pivot.x`` the owner is the letter."""
    name = Name.parse(text)
    return Name(name.owner, (name.stem + "".join(name.below),)).formula() if reaction and name.owner else name.formula(dots)


def direction(name: str, dots: int = 0) -> Formula:
    """A unit vector, ``e_r``: bold, with what is below it as a name by itself."""
    stem, _, below = name.partition("_")
    letter = dotted((Atom(stem, "bold"),), dots)
    return (Script(letter, name_formula(below)),) if below else letter


def _letter(text: str, otherwise: str) -> Atom:
    """A number, a letter, or a word of its kind."""
    kind = "number" if text.isdigit() else "letter" if len(text) == 1 or text in GREEK else otherwise
    return Atom(GREEK.get(text, re.sub("[_.]", " ", text)), kind)


def _word(text: str) -> str:
    """A name of several words as one."""
    return re.sub(r"\W+", "_", text).strip("_")


# -- what people write ---------------------------------------------------------------------------


def plain(char: str) -> str:
    """One character of a name in plain spelling; subscripts come down, marks above are dropped."""
    if char in READ:
        return READ[char]
    base = unicodedata.normalize("NFD", char)[0]
    kind, _, code = unicodedata.decomposition(base).rpartition("> ")
    if kind == "<sub":
        base = chr(int(code, 16))
    return READ.get(base, base)


@lru_cache(4096)
def folded(name: str) -> str:
    """The spelling by which names are compared: ``m₁``, ``m_1`` → ``m1``; ``θ_A`` → ``thetaA``; ``eps``, ``ε`` → ``epsilon``."""
    spelt = _NUMBERED.sub("", "".join(plain(c) for c in name if not unicodedata.combining(c)))
    return "epsilon" + spelt[3:] if _EPS.match(spelt) else spelt


def dots(char: str) -> int:
    """How many dots the character and its marks carry: 1 for ṙ, 2 for ÿ."""
    return sum(_MARKS.get(c, 0) for c in unicodedata.normalize("NFD", char))


# -- one symbol, one meaning ---------------------------------------------------------------------


@dataclass(frozen=True)
class Renamed:
    """``what`` is not written by its ``usual`` name, which means something else, but as ``name``."""

    usual: Name
    meaning: str
    what: str
    name: Name

    def __str__(self) -> str:
        return f"Here {self.usual.unicode()} is {self.meaning}; {self.what} is written {self.name.unicode()}."


@dataclass
class Taken:
    """The symbols that are given away, each with one meaning; ``renamed`` are those, by what they mean, that are not the usual."""

    owners: dict[str, tuple[str, str]] = field(default_factory=dict)
    renamed: dict[str, Renamed] = field(default_factory=dict)

    def give(self, what: str, *wanted: Name, key: str = "") -> Name:
        """The first of some names that reads like none before, or the last of them numbered, for ``what`` it shall mean.

        What asks again by the same ``key``, which is ``what`` by default, gets the same."""
        key, last = key or what, wanted[-1]
        numbered = (replace(last, below=(*last.below, str(number))) for number in itertools.count(2))
        name = next(name for name in itertools.chain(wanted, numbered) if self._held(name)[0] in ("", key))
        if name != wanted[0]:
            self.renamed[key] = Renamed(wanted[0], self.owner(wanted[0]), what, name)
        self.owners |= dict.fromkeys(_spellings(name), (key, what))
        return name

    def owner(self, name: Name) -> str:
        """What a name means already; empty where nothing reads like it."""
        return self._held(name)[1]

    def _held(self, name: Name) -> tuple[str, str]:
        return next((self.owners[each] for each in _spellings(name) if each in self.owners), ("", ""))


def _spellings(name: Name) -> set[str]:
    """How a name may be read from text, from plain text and from LaTeX."""
    latex = re.sub(r"\\(?:text|mathrm)\b|[\\.\s]", "", name.latex())
    return {folded(name.unicode()), folded(name.ascii()), folded(latex)}

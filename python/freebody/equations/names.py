"""Names of letters as they are printed: ``theta1`` is θ₁, ``m_rod`` has a subscript, ``pivot.x`` belongs to the pivot."""

from __future__ import annotations

import re
from dataclasses import dataclass

from freebody.results import GREEK as SMALL_GREEK

GREEK = SMALL_GREEK | {
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ",
    "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
SPELT = {sign: word for word, sign in GREEK.items()}
_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")
_FROM_SUBSCRIPTS = str.maketrans("₀₁₂₃₄₅₆₇₈₉", "0123456789")
_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_COMBINING = ("", "\u0307", "\u0308")


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
            part.translate(_SUBSCRIPTS) if part.isdigit() else f"_{GREEK.get(part, _word(part))}" for part in self.below
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

    def latex(self, dots: int = 0) -> str:
        r"""``\ddot\theta_1``, ``N_{\text{track}}``; for mathtext as well."""
        stem, below = self._letter_below()
        letter = _letter(stem)
        dotted = letter if not dots else f"\\{'d' * dots}ot{letter if letter.startswith(chr(92)) else f' {letter}'}"
        if not self.is_letter and dots:
            dotted = f"\\{'d' * dots}ot{{{letter}}}"
        shown = ",".join(part for part in (*map(_subscript, below), upright(self.owner)) if part)
        return f"{dotted}_{_braced(shown)}" if shown else dotted

    def _letter_below(self) -> tuple[str, tuple[str, ...]]:
        """Stem and what is below it; of ``mA`` the second letter is."""
        a, b = self.stem if len(self.stem) == 2 and self.stem not in GREEK else ("", "")
        return (a, (b, *self.below)) if a.isupper() != b.isupper() else (self.stem, self.below)


def unicode_name(text: str, dots: int = 0) -> str:
    """``theta1`` with two dots is θ̈₁; the rate of a word of several letters has primes."""
    return Name.parse(text).unicode(dots)


def ascii_name(text: str, dots: int = 0) -> str:
    """The name with Greek spelt and a prime for each dot: ``theta1''``."""
    plain = re.sub(r"\[(\d+)\]", r"\1", text.translate(_FROM_SUBSCRIPTS)).replace(" ", "_")
    return "".join(SPELT.get(sign, sign) for sign in plain) + "'" * dots


def latex_name(text: str, dots: int = 0, *, reaction: bool = False) -> str:
    r"""``theta1`` with two dots is ``\ddot\theta_1``; a reaction ``pivot.x`` is ``\mathrm{pivot}_x``."""
    name = Name.parse(text)
    return Name(name.owner, (name.stem + "".join(name.below),)).latex() if reaction and name.owner else name.latex(dots)


def upright(text: str) -> str:
    """Upright LaTeX of any text, signs of TeX escaped."""
    return rf"\mathrm{{{escaped(text)}}}".replace(" ", r"\ ") if text else ""


def escaped(text: str) -> str:
    """Text for LaTeX, outside and inside of formulas."""
    words = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    return "".join(words.get(sign, f"\\{sign}" if sign in "_%#&{}$" else sign) for sign in text)


def superscript(text: str) -> str:
    """Digits and the minus sign, raised: ``²``."""
    return text.translate(_SUPERSCRIPTS)


def subscript(digits: str) -> str:
    """Digits, lowered: ``₁₂``."""
    return digits.translate(_SUBSCRIPTS)


def _letter(stem: str) -> str:
    return f"\\{stem}" if stem in GREEK else stem if len(stem) == 1 else upright(stem.replace("_", " "))


def _subscript(text: str) -> str:
    if text.isdigit() or len(text) == 1:
        return text
    return f"\\{text}" if text in GREEK else rf"\text{{{escaped(text.replace('_', ' '))}}}" if text else ""


def _word(text: str) -> str:
    """A name of several words as one."""
    return re.sub(r"\W+", "_", text).strip("_")


def _braced(text: str) -> str:
    return text if len(text) == 1 else f"{{{text}}}"

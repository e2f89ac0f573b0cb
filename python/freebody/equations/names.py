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
    """A name in parts: ``arm.theta_1`` is owner ``arm``, stem ``theta``, subscript ``1``."""

    owner: str
    stem: str
    below: str

    @classmethod
    def parse(cls, name: str) -> Name:
        """In parts: what follows the first underscore, or digits at the end, is the subscript."""
        owner, _, last = name.translate(_FROM_SUBSCRIPTS).replace("'", "").rpartition(".")
        found = re.fullmatch(r"([^\W\d_]+)(?:_?(\d+)|_(\w+))?", last)
        stem, digits, word = found.groups() if found else (last, None, None)
        return cls(owner, SPELT.get(stem, stem), digits or word or "")

    @property
    def is_letter(self) -> bool:
        """Whether the stem is one letter, Latin or Greek."""
        return len(self.stem) == 1 or self.stem in GREEK


def unicode_name(text: str, dots: int = 0) -> str:
    """``theta1`` with two dots is θ̈₁; the rate of a word of several letters has primes."""
    name = Name.parse(text)
    stem = GREEK.get(name.stem, name.stem)
    below = name.below.translate(_SUBSCRIPTS) if name.below.isdigit() else f"_{name.below}" if name.below else ""
    made = stem + _COMBINING[dots] + below if name.is_letter else stem + below + "′" * dots
    return f"{name.owner}.{made}" if name.owner else made


def ascii_name(text: str, dots: int = 0) -> str:
    """The name with Greek spelt and a prime for each dot: ``theta1''``."""
    return "".join(SPELT.get(sign, sign) for sign in text.translate(_FROM_SUBSCRIPTS)) + "'" * dots


def latex_name(text: str, dots: int = 0, *, reaction: bool = False) -> str:
    r"""``theta1`` with two dots is ``\ddot\theta_1``; a reaction ``pivot.x`` is ``\mathrm{pivot}_x``."""
    name = Name.parse(text)
    if reaction and name.owner:
        return rf"{upright(name.owner)}_{_braced(_subscript(name.stem + name.below))}"
    letter = _letter(name.stem)
    dotted = letter if not dots else f"\\{'d' * dots}ot{letter if letter.startswith(chr(92)) else f' {letter}'}"
    if not name.is_letter and dots:
        dotted = f"\\{'d' * dots}ot{{{letter}}}"
    below = ",".join(part for part in (_subscript(name.below), upright(name.owner)) if part)
    return f"{dotted}_{_braced(below)}" if below else dotted


def upright(text: str) -> str:
    """Upright LaTeX of any text, signs of TeX escaped."""
    return rf"\mathrm{{{escaped(text)}}}" if text else ""


def escaped(text: str) -> str:
    """Text for LaTeX, outside and inside of formulas."""
    words = {"\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}"}
    return "".join(words.get(sign, f"\\{sign}" if sign in "_%#&{}$" else sign) for sign in text)


def superscript(text: str) -> str:
    """Digits and the minus sign, raised: ``²``."""
    return text.translate(_SUPERSCRIPTS)


def _letter(stem: str) -> str:
    return f"\\{stem}" if stem in GREEK else stem if len(stem) == 1 else upright(stem)


def _subscript(text: str) -> str:
    if text.isdigit() or len(text) == 1:
        return text
    return f"\\{text}" if text in GREEK else rf"\text{{{escaped(text)}}}" if text else ""


def _braced(text: str) -> str:
    return text if len(text) == 1 else f"{{{text}}}"

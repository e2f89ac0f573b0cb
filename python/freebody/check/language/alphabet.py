"""Letters and their spellings: θ, theta and \\theta are one; so are m1, m_1, m₁ and m_{1}."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache

_GREEK = [
    "alpha",
    "beta",
    "gamma",
    "delta",
    "epsilon",
    "zeta",
    "eta",
    "theta",
    "iota",
    "kappa",
    "lambda",
    "mu",
    "nu",
    "xi",
    "omicron",
    "pi",
    "rho",
    "sigma",
    "tau",
    "upsilon",
    "phi",
    "chi",
    "psi",
    "omega",
]
_SIGNS = "αβγδεζηθικλμνξοπρστυφχψω"
NAMES: dict[str, str] = {
    **dict(zip(_SIGNS, _GREEK, strict=True)),
    **{sign.upper(): name.capitalize() for sign, name in zip(_SIGNS, _GREEK, strict=True)},
    **{
        "ϑ": "theta",
        "ϕ": "phi",
        "ϵ": "epsilon",
        "ϱ": "rho",
        "ς": "sigma",
        "ϖ": "pi",
        "µ": "mu",
        "ℓ": "l",
        "Σ": "sum",
        "∑": "sum",
    },
    **{"ı": "i", "ȷ": "j", "′": "'", "’": "'", "″": "''"},
}
"""A sign and how its name is spelled with plain letters."""

SIGNS: dict[str, str] = {name: sign for sign, name in zip(_SIGNS, _GREEK, strict=True)}
SIGNS.update({sign_name.capitalize(): sign.upper() for sign_name, sign in SIGNS.items() if sign.upper() not in "ΑΒΕΖΗΙΚΜΝΟΡΤΥΧ"})

LATEX_WORDS: dict[str, str] = {
    **{name: name for name in SIGNS},
    **{f"var{name}": name for name in ("theta", "phi", "epsilon", "rho", "sigma", "pi")},
    **{"ell": "l", "imath": "i", "jmath": "j", "sum": "sum", "prime": "'"},
}
"""LaTeX commands that are letters."""

_NUMBERED = re.compile(r"[_{},\s]")
_EPS = re.compile(r"eps(?=\d*$)")


def plain(char: str) -> str:
    """One character of a name in plain spelling; subscripts come down, marks above are dropped."""
    if char in NAMES:
        return NAMES[char]
    base = unicodedata.normalize("NFD", char)[0]
    kind, _, code = unicodedata.decomposition(base).rpartition("> ")
    if kind == "<sub":
        base = chr(int(code, 16))
    return NAMES.get(base, base)


@lru_cache(4096)
def folded(name: str) -> str:
    """The spelling by which names are compared: ``m₁``, ``m_1`` → ``m1``; ``θ_A`` → ``thetaA``; ``eps``, ``ε`` → ``epsilon``."""
    spelt = _NUMBERED.sub("", "".join(plain(c) for c in name if not unicodedata.combining(c)))
    return "epsilon" + spelt[3:] if _EPS.match(spelt) else spelt


def dots(char: str) -> int:
    """How many dots the character and its marks carry: 1 for ṙ, 2 for ÿ."""
    marks = {"\u0307": 1, "\u0308": 2, "\u20db": 3}
    return sum(marks.get(c, 0) for c in unicodedata.normalize("NFD", char))

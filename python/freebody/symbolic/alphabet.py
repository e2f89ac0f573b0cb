"""Alphabets: Greek letters by their names, signs that people write for letters, LaTeX commands that are letters; how wide text is."""

import unicodedata

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ", "eta": "η",
    "theta": "θ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "tau": "τ", "upsilon": "υ", "phi": "φ", "chi": "χ", "psi": "ψ", "omega": "ω",
    "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ", "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ",
    "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
SPELT = {sign: word for word, sign in GREEK.items()}
READ: dict[str, str] = {
    **{sign.upper(): word.capitalize() for word, sign in GREEK.items() if word.islower()},
    **SPELT, "ο": "omicron", "Ο": "Omicron", "ϑ": "theta", "ϕ": "phi", "ϵ": "epsilon", "ϱ": "rho", "ς": "sigma", "ϖ": "pi",
    "µ": "mu", "ℓ": "l", "Σ": "sum", "∑": "sum", "ı": "i", "ȷ": "j", "′": "'", "’": "'", "″": "''",
}  # fmt: skip
"""A sign that people write, and how its name is spelled with plain letters."""
LATEX_WORDS: dict[str, str] = {
    **{name: name for name in (*GREEK, "omicron")},
    **{f"var{name}": name for name in ("theta", "phi", "epsilon", "rho", "sigma", "pi")},
    **{"ell": "l", "imath": "i", "jmath": "j", "sum": "sum", "prime": "'"},
}
"""LaTeX commands that are letters."""


def columns(line: str) -> int:
    """How many columns a line takes; marks that combine with a letter take none."""
    return sum(not unicodedata.combining(sign) for sign in line)

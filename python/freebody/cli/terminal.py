"""Standard output: JSON for scripts; what a terminal that takes ASCII only is given."""

from __future__ import annotations

import codecs
import json
import math
import shutil
import sys
import unicodedata
from collections.abc import Mapping
from typing import Any

from freebody.symbolic.alphabet import READ
from freebody.symbolic.printers.text import WIDTH

_SIGNS = {
    "·": "*", "⋅": "*", "×": "x", "−": "-", "–": "-", "—": "-", "•": "*", "→": "->", "←": "<-", "≤": "<=", "≥": ">=", "≈": "~",
    "≠": "!=", "⟂": " perpendicular ", "∫": "integral ", "∂": "d", "√": "sqrt", "°": " deg", "∞": "inf", "±": "+-", "⁄": "/",
    "‘": "'", "“": '"', "”": '"', "\u0307": "'", "\u0308": "''",
}  # fmt: skip
"""Of signs that are neither letters nor made of others; a dot above is a prime."""


def spelt(text: str) -> str:
    """Signs beyond ASCII in plain spelling: ``theta''^2``, ``kg*m^2``."""
    out, raised = "", False
    for sign in text:
        form = unicodedata.decomposition(sign)
        out += "^" * (form.startswith("<super>") and not raised)
        raised = form.startswith("<super>")
        parts = unicodedata.normalize("NFKD", sign)
        plain = _SIGNS.get(sign) or READ.get(sign) or (parts if parts.isascii() else spelt(parts) if parts != sign else None)
        out += plain if plain is not None else "" if unicodedata.combining(sign) else "?"
    return out


def _spelt(error: UnicodeEncodeError) -> tuple[str, int]:
    run, before = error.object[error.start : error.end], error.object[: error.start][-1:]
    return unicodedata.normalize("NFD", run)[0] if before.isalpha() and run == "ü" else spelt(run), error.end


def width() -> int:
    """Columns of the terminal, as far as a text is easily read."""
    return min(shutil.get_terminal_size((WIDTH, 24)).columns, WIDTH)


def speaks_unicode() -> bool:
    """Whether standard output takes all signs."""
    return (getattr(sys.stdout, "encoding", None) or "utf-8").lower().replace("-", "").startswith("utf")


SPELT = "spelt"
"""The name of what a stream does with signs that it cannot take."""
codecs.register_error(SPELT, _spelt)


def print_json(data: Any) -> None:
    """Data for a script; what is not a finite number is null."""
    print(json.dumps(_finite(data), ensure_ascii=not speaks_unicode(), indent=1, allow_nan=False))


def _finite(data: Any) -> Any:
    if isinstance(data, Mapping):
        return {key: _finite(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_finite(value) for value in data]
    return None if isinstance(data, float) and not math.isfinite(data) else data

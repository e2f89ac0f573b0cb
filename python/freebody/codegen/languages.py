"""The languages of generated code: a template in ``templates/`` for each, and its entry here."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Language:
    """A language: the ``word`` that asks for it, the ``ending`` of its files and of its template, and what it is in a few words; how
    its ``functions`` are called."""

    word: str
    ending: str
    doc: str
    functions: Mapping[str, str]

    def call(self, name: str, args: Sequence[str]) -> str:
        """A function of printed arguments."""
        if name not in self.functions:
            raise ValueError(f"{name!r} is a table of the model; generated code knows only {', '.join(self.functions)}")
        return self.functions[name].format(*args)


_LISTED = (
    Language("python", "py", "Python that needs NumPy only", {
        "sin": "np.sin({})", "cos": "np.cos({})", "tan": "np.tan({})", "exp": "np.exp({})", "ln": "np.log({})",
        "atan2": "np.arctan2({}, {})", "abs": "np.abs({})", "sign": "np.sign({})",
        "sqrt": "np.sqrt({})", "power": "np.power({}, {})",
    }),
    Language("c", "c", "C99", {
        "sin": "sin({})", "cos": "cos({})", "tan": "tan({})", "exp": "exp({})", "ln": "log({})",
        "atan2": "atan2({}, {})", "abs": "fabs({})", "sign": "sign({})", "sqrt": "sqrt({})", "power": "pow({}, {})",
    }),
)  # fmt: skip
LANGUAGES: dict[str, Language] = {each.word: each for each in _LISTED}
"""By their words; the first is taken where none is asked for."""

"""The languages of generated code: one file for each, and its entry here."""

from freebody.codegen.c import C99
from freebody.codegen.python import NumPy
from freebody.codegen.source import Language

LANGUAGES: dict[str, Language] = {each.word: each for each in (NumPy(), C99())}
"""By their words; the first is taken where none is asked for."""

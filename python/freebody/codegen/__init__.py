"""CompiledModel code that computes the accelerations and all reactions of a mechanism, in Python or C, by itself."""

from __future__ import annotations

from freebody.codegen import c, python
from freebody.codegen.functions import generate
from freebody.codegen.refusals import CannotGenerate, check
from freebody.codegen.systems import systems
from freebody.core import CompiledModel, State

LANGUAGES = ("python", "c")
_SOLVERS = {"python": python.solvers, "c": c.solvers}

__all__ = ["LANGUAGES", "CannotGenerate", "program"]


def program(source: CompiledModel, state: State, language: str = "python") -> str:
    """CompiledModel code of the equations of a mechanism, ``python`` (needs NumPy) or ``c`` (C99).

    ``state`` says what is in place, and on which branch; the functions hold for all coordinates q, rates u, parameters p and times t.
    Raises ``CannotGenerate`` for what switches (contacts, strings, friction, laws with cases) or comes from a table, and where
    reactions are not determined; ``MotionError`` for a state without an answer."""
    if language not in LANGUAGES:
        raise ValueError(f"language {language!r} is unknown; there are {', '.join(LANGUAGES)}")
    check(source, source.free_bodies(state))
    found = systems(source, state)
    if not found.is_square:
        raise CannotGenerate(
            "loops and motions ask more of the accelerations than their loads can give; release a joint or a motion"
        )
    functions = generate(found.functions(), found.letters, {"python": "numpy"}.get(language, language))
    return f"{functions}\n\n{_SOLVERS[language](found)}" if language == "python" else f"{functions}\n{_SOLVERS[language](found)}"

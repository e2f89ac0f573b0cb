"""A whole mechanism as code that computes by itself."""

from __future__ import annotations

from freebody.codegen.functions import generate
from freebody.codegen.refusals import CannotGenerate, check
from freebody.codegen.systems import systems
from freebody.core import CompiledModel, State


def program(source: CompiledModel, state: State, language: str = "python") -> str:
    """Code of the equations of a mechanism, in one of ``LANGUAGES``.

    ``state`` says what is in place, and on which branch; the functions hold for all coordinates q, rates u, parameters p and times t.
    Raises ``CannotGenerate`` for what switches (contacts, strings, friction, laws with cases) or comes from a table, and where
    reactions are not determined; ``MotionError`` for a state without an answer."""
    check(source, source.free_bodies(state))
    found = systems(source, state)
    if not found.is_square:
        raise CannotGenerate(
            "loops and motions ask more of the accelerations than their loads can give; release a joint or a motion"
        )
    return generate(found.functions(), found.nomenclature, language, found)

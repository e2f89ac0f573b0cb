"""What an output format is."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from freebody.document.blocks import Block
from freebody.symbolic.nomenclature import Nomenclature


@dataclass(frozen=True)
class Format:
    """How documents are printed: the ``ending`` of their files; the ``word`` that asks for it on the command line, and what it is in a
    few words; ``render``, which takes blocks, what the symbols in them mean, and how the names of figures' files begin (empty: there
    are none); the ending of those ``figures``, where they are not inside."""

    ending: str
    word: str
    doc: str
    render: Callable[[Sequence[Block], Nomenclature, str], str]
    figures: str = ""

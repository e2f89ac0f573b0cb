"""Loads in sentences have the letters that they have in the equations."""

from __future__ import annotations

import re
from dataclasses import replace

from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Words, pieces
from freebody.symbolic.letters import Letters
from freebody.symbolic.tree import Sym


def lettered(block: Block, letters: Letters) -> Block:
    """The block with every unknown load that its sentences name by its symbol, ``track.Fn``, as a letter."""
    symbols = sorted(letters.of_kind("unknown"), key=len, reverse=True)
    if not symbols:
        return block
    named = re.compile(rf"(?<![\w.])({'|'.join(map(re.escape, symbols))})(?![\w])")
    match block:
        case Heading(words) | Paragraph(words):
            return replace(block, words=_lettered(words, named))
        case Bullets(items):
            return Bullets([_lettered(item, named) for item in items])
        case Equation():
            return replace(block, name=_lettered(block.name, named), note=_lettered(block.note, named))
        case _:
            return block


def _lettered(words: Words, named: re.Pattern[str]) -> Words:
    if not any(isinstance(piece, str) and named.search(piece) for piece in pieces(words)):
        return words
    found: list = []
    for piece in pieces(words):
        if not isinstance(piece, str):
            found.append(piece)
            continue
        for place, part in enumerate(named.split(piece)):
            found += [Sym(part) if place % 2 else part] if part else []
    return found

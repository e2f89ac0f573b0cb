"""Sentences of a derivation: lists of names, loads by their symbols in the equations, and what is too long to be printed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from freebody.document.blocks import (
    Block,
    Bullets,
    Equation,
    Heading,
    Matrices,
    Matrix,
    MatrixEquation,
    Paragraph,
    Words,
    is_tree,
    pieces,
)
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.tree import Sym, walk

LONGEST = 2500
"""Symbols, numbers and operations of an expression beyond which nobody reads it."""


def joined(words: Sequence[str]) -> str:
    """``a, b and c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"


def clause(names: Sequence[str], one: str, several: str) -> str:
    """The names with a verb in their number: ``a and b are``."""
    return f"{joined(names)} {one if len(names) == 1 else several}"


def lettered(block: Block, nomenclature: Nomenclature) -> Block:
    """The block with every unknown load that its sentences name, ``track.Fn``, as a symbol."""
    symbols = sorted(nomenclature.of_kind("unknown"), key=len, reverse=True)
    named = re.compile(rf"(?<![\w.])({'|'.join(map(re.escape, symbols))})(?![\w])")

    def put(words: Words) -> Words:
        said, found = [piece for piece in pieces(words) if piece != ""], []
        for piece in said:
            parts = named.split(piece) if isinstance(piece, str) else [piece]
            found += [Sym(part) if place % 2 else part for place, part in enumerate(parts) if part != ""]
        return words if found == said else found

    match block:
        case Heading(words) | Paragraph(words) if symbols:
            return replace(block, words=put(words))
        case Bullets(items) if symbols:
            return replace(block, items=[put(item) for item in items])
        case Equation() if symbols:
            return replace(block, name=put(block.name), note=put(block.note))
    return block


def readable(block: Block, elsewhere: str, longest: int = LONGEST) -> Block:
    """The block, or a sentence in its place where an expression in it is longer than the ``longest``; ``elsewhere`` says where it is."""
    match block:
        case Bullets(items):
            sizes = [signs(pieces(item)) for item in items]
            texts = ([piece for piece in pieces(words) if isinstance(piece, str)] for words in items)
            long = ([*said, f"an expression of {size} signs"] for said, size in zip(texts, sizes, strict=True))
            kept = [words if size <= longest else said for words, size, said in zip(items, sizes, long, strict=True)]
            return replace(block, items=kept)
        case Equation(_, Matrices((Matrix(rows),))):
            size = max(map(signs, rows), default=0)
        case Equation(left, right):
            size = signs([left, right])
        case MatrixEquation(matrix, _, right):
            size = max(map(signs, [*matrix, right]), default=0)
        case _:
            return block
    if size <= longest:
        return block
    name = [*pieces(block.name), ": "] if block.name else []
    return Paragraph([*name, f"an expression of {size} signs, too long to be read; {elsewhere}."])


def signs(parts: Sequence[object]) -> int:
    """Symbols, numbers and operations of all expressions among some parts."""
    return sum(1 for tree in parts if is_tree(tree) for _ in walk(tree))

"""What is too long to be read is not printed."""

from __future__ import annotations

from collections.abc import Sequence

from freebody.document.blocks import Block, Bullets, Equation, Matrices, Matrix, MatrixEquation, Paragraph, Words, is_tree, pieces
from freebody.symbolic.tree import Tree, walk

ELSEWHERE = "it is among the equations as data and in the generated code"
LONGEST = 2500
"""Letters, numbers and operations of an expression beyond which nobody reads it."""


def readable(block: Block, elsewhere: str = ELSEWHERE) -> Block:
    """The block, or a sentence in its place where an expression in it is too long; ``elsewhere`` says where it is."""
    match block:
        case Equation(left, right) if (size := _size([left, right])) > LONGEST:
            return Paragraph([*_named(block.name), *_instead(size, elsewhere)])
        case Equation(_, Matrices((Matrix(rows),))) if (size := max(map(_size, rows), default=0)) > LONGEST:
            return Paragraph([*_named(block.name), *_instead(size, elsewhere)])
        case MatrixEquation(matrix, _, right) if (size := max(map(_size, [*matrix, right]), default=0)) > LONGEST:
            return Paragraph([*_named(block.name), *_instead(size, elsewhere)])
        case Bullets(items):
            return Bullets([_item(item) for item in items])
        case _:
            return block


def _item(words: Words) -> Words:
    size = _size(pieces(words))
    return words if size <= LONGEST else [*(p for p in pieces(words) if isinstance(p, str)), f"an expression of {size} signs"]


def _named(name: Words) -> list:
    return [*pieces(name), ": "] if name else []


def _instead(size: int, elsewhere: str) -> list[str]:
    return [f"an expression of {size} signs, too long to be read; {elsewhere}."]


def _size(parts: Sequence[object]) -> int:
    trees: list[Tree] = [part for part in parts if is_tree(part)]
    return sum(1 for tree in trees for _ in walk(tree))

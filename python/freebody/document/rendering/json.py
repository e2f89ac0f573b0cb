"""Documents as JSON: every block with its kind and fields, and the letters."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from freebody.document.blocks import Block, Figure, Matrices, Vector, Written, is_tree
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import side_formula
from freebody.document.rendering.text import side_text
from freebody.symbolic.letters import Letters
from freebody.symbolic.printers.latex import latex
from freebody.symbolic.tree import write


def render(blocks: Sequence[Block], letters: Letters, beside: str = "") -> str:
    """All blocks, and what the letters mean."""
    made = {"letters": letters.write(), "blocks": [_block(each, letters) for each in blocks]}
    return json.dumps(made, ensure_ascii=False, indent=1)


def _block(made: Block, letters: Letters) -> dict[str, Any]:
    """The kind of the block and its fields; every expression is ``{"tree": …, "text": …, "latex": …}``, a picture what it shows."""
    return (
        {"kind": type(made).__name__.lower()}
        | {field.name: _value(getattr(made, field.name), letters) for field in fields(made) if field.name != "picture"}
        | ({"shows": made.picture.description} if isinstance(made, Figure) else {})
    )


def _value(value: Any, letters: Letters) -> Any:
    if is_tree(value) or isinstance(value, Vector | Written):
        printed = {"text": side_text(value, letters), "latex": latex(side_formula(value, letters))}
        if isinstance(value, Vector):
            return {"vector": [[write(tree), direction] for tree, direction in value.components]} | printed
        return {"tree": write(value)} | printed if is_tree(value) else printed
    if isinstance(value, Matrices):
        return {"matrices": [_value(matrix.rows, letters) for matrix in value.factors]}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_value(each, letters) for each in value]
    return value


FORMAT = Format("json", "json", "JSON, for scripts.", render)

"""Documents as JSON: every block with its kind and fields, and the symbols."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import fields
from typing import Any

from freebody.document.blocks import Block, Figure, Matrices, Vector, Written, is_tree
from freebody.document.rendering.format import Format
from freebody.document.rendering.markup import side_formula
from freebody.document.rendering.text import side_text
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.printers.latex import latex
from freebody.symbolic.tree import ONE, write


def render(blocks: Sequence[Block], nomenclature: Nomenclature, beside: str = "") -> str:
    """All blocks, and what the symbols mean."""
    made = {"letters": nomenclature.write(), "blocks": [_block(each, nomenclature) for each in blocks]}
    return json.dumps(made, ensure_ascii=False, indent=1)


def _block(made: Block, nomenclature: Nomenclature) -> dict[str, Any]:
    """The kind of the block and its fields; every expression is ``{"tree": …, "text": …, "latex": …}``, a picture what it shows."""
    return (
        {"kind": type(made).__name__.lower()}
        | {field.name: _value(getattr(made, field.name), nomenclature) for field in fields(made) if field.name != "drawing"}
        | ({"shows": made.picture.description} if isinstance(made, Figure) else {})
    )


def _value(value: Any, nomenclature: Nomenclature) -> Any:
    if is_tree(value) or isinstance(value, Vector | Written):
        printed = {"text": side_text(value, nomenclature), "latex": latex(side_formula(value, nomenclature))}
        if isinstance(value, Vector):
            named = (
                (tree, d if isinstance(d, str) else side_text(Vector(((ONE, d),)), nomenclature)) for tree, d in value.components
            )
            return {"vector": [[write(tree), direction] for tree, direction in named]} | printed
        return {"tree": write(value)} | printed if is_tree(value) else printed
    if isinstance(value, Matrices):
        return {"matrices": [_value(matrix.rows, nomenclature) for matrix in value.factors]}
    if isinstance(value, Sequence) and not isinstance(value, str):
        return [_value(each, nomenclature) for each in value]
    return value


FORMAT = Format("json", "json", "JSON, for scripts.", render)

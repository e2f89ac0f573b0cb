"""Equations in letters: expressions, how a person writes them, SymPy, generated code, answers, documents.

SymPy is imported where it is first needed."""

from __future__ import annotations

from freebody.equations.code import generate
from freebody.equations.document import (
    Bullets, Document, Equation, Figure, Heading, MatrixEquation, Paragraph, Table, Vector, Written, letters_table,
)  # fmt: skip
from freebody.equations.latex import equation_latex, latex, matrix_latex
from freebody.equations.letters import Letter, Letters
from freebody.equations.text import equation_text, text
from freebody.equations.to_sympy import from_sympy, to_sympy
from freebody.equations.tree import Add, Fn, Mul, Num, Pow, Sym, Tree, evaluate, read, symbols, write

__all__ = [
    "Add", "Bullets", "Document", "Equation", "Figure", "Fn", "Heading", "Letter", "Letters", "MatrixEquation", "Mul", "Num",
    "Paragraph", "Pow", "Sym", "Table", "Tree", "Vector", "Written", "equation_latex", "equation_text", "evaluate", "from_sympy",
    "generate", "latex", "letters_table", "matrix_latex", "read", "symbols", "text", "to_sympy", "write",
]  # fmt: skip

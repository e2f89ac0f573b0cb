"""Symbolic equations: expressions, how a person writes them, SymPy, generated code, answers, documents.

SymPy is imported where it is first needed."""

from __future__ import annotations

from freebody.codegen.functions import generate
from freebody.equations.solve import Singular, TooLarge, coefficients, limit, linear_system, solve, solve_equations, substitute
from freebody.equations.stability import Eigenvalue, Stability, characteristic, eigenvalues, stability
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.printers.text import equation_text, text
from freebody.symbolic.printers.typeset import equation_latex, latex
from freebody.symbolic.to_sympy import from_sympy, to_sympy
from freebody.symbolic.tree import Add, Fn, Mul, Num, Pow, Sym, Tree, read, symbols, write

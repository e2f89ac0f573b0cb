"""Expressions written: on a line of text, and set in type: LaTeX, MathML."""

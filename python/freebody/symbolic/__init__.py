"""Symbolic expressions: one tree, its evaluation, differentiation, dimensions, symbols and how a person writes it."""

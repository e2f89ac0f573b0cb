"""Expressions written: text, LaTeX, MathML for a reader, NumPy and C for a machine."""

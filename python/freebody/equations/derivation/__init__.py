"""Derivations, as a good textbook writes them: the equations of a mechanism in three forms, by ``derive``."""

"""Derivations, as a good textbook writes them: the equations of a mechanism in three forms."""

from __future__ import annotations

from freebody.equations.derivation.derive import FORMS, Equations, derive

__all__ = ["FORMS", "Equations", "derive"]

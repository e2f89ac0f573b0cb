"""Forces between the bodies that are named before a balance of them: these have no place in it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from freebody.core import GROUND

from .language.glyphs import CONDITION
from .symbols import Symbols

_ALL = re.compile(rf"(?!\s*(?:{CONDITION})\b)[^=]*\b(?:all|both|whole|system|together|entire)\b", re.IGNORECASE)


def inner_forces(label: str, known: Symbols, spec: Mapping[str, Any]) -> frozenset[str]:
    """The joints and forces between two of the bodies that a label names, or of all, ``whole system, ΣF_y``."""
    named = known.bodies - {GROUND} if _ALL.match(label) else known.bodies & {*re.findall(r"\w+", label)}
    parts = {each["name"]: {*re.findall(r"\w+", str(each["with"]))} for each in (*spec["joints"], *spec["forces"])}
    return frozenset(owner for owner, ends in parts.items() if len(ends & named) > 1 and GROUND not in ends)

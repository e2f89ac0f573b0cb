"""What has no place in a balance of the bodies that are named before it: forces between them, and masses of others."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

from freebody.core import GROUND

from .language.glyphs import CONDITION
from .symbols import Symbols

_CONDITION = re.compile(rf"\s*(?:{CONDITION})\b")
_ALL = re.compile(r"[^=]*\b(?:all|both|whole|system|together|entire)\b", re.IGNORECASE)


def without_place(label: str, known: Symbols, spec: Mapping[str, Any]) -> frozenset[str]:
    """The joints and forces between two of the bodies that a label names, or of all, ``whole system, ΣF_y``; and the parameters that are
    masses and inertias of bodies that it does not name, ``step alone``."""
    words = {*re.findall(r"\w+", label)}
    condition = _CONDITION.match(label)
    named = known.bodies - {GROUND} if _ALL.match(label) and not condition else known.bodies & words
    parts = {each["name"]: {*re.findall(r"\w+", str(each["with"]))} for each in (*spec["joints"], *spec["forces"])}
    inner = {owner for owner, ends in parts.items() if len(ends & named) > 1 and GROUND not in ends}
    if not named or condition:
        return frozenset(inner)
    own, others = (
        json.dumps([body["pieces"] for body in spec["bodies"] if (body["name"] in named) is there], ensure_ascii=False)
        for there in (True, False)
    )
    weighed = {piece.get(what) for body in spec["bodies"] for piece in body["pieces"] for what in ("mass", "inertia")}
    written = lambda text: {*re.findall(r"[^\W\d]\w*", text)}
    return frozenset(inner | {name for name in weighed if isinstance(name, str)} & (written(others) - written(own)))

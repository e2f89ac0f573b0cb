"""Corrections of a balance of several bodies that are named before it: forces between these have no place in it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from .stated import Correction
from .symbols import Symbols
from .verdict import Verdict


def without_inner_forces(verdict: Verdict, label: str, known: Symbols, spec: Mapping[str, Any]) -> Verdict:
    """A verdict, without corrections by a force between two of the bodies that a label names, where there are others."""
    named = known.bodies & {*re.findall(r"\w+", label)}
    if len(named) < 2 or not verdict.mends:
        return verdict
    parts = {each["name"]: {*re.findall(r"\w+", str(each["with"]))} for each in (*spec["joints"], *spec["forces"])}
    inner = {owner for owner, ends in parts.items() if len(ends & named) > 1}

    def has_inner(correction: Correction) -> bool:
        texts = (text for word in re.findall(r"\w+", correction.edits[0][2]) for text in _texts(known, word))
        return any(owner in inner for text in texts for owner in re.findall(r"(\w+)\.", text))

    kept = tuple(each for each in verdict.mends if not has_inner(each))
    return replace(verdict, mends=kept or verdict.mends)


def _texts(known: Symbols, name: str) -> tuple[str, ...]:
    return known.meanings[name].texts if name in known.meanings else ()

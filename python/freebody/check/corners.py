"""A contact that stays on one corner of its track for a while, as where a wheel turns about an edge: nothing switches there that has a name."""

from __future__ import annotations

import re
from contextlib import suppress
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from freebody.core import ModelError, quote

if TYPE_CHECKING:
    from .api import Checker

_ABOUT = re.compile(
    r"\b(?:turn|tip|rock|pivot|swing|roll|rotat|sink|climb)\w*\s+(?:about|over|on|round|around)\s+(?:the\s+)?(?:(?:edge|corner)\s+)?([A-Z]\w*)\Z"
)
"""``while the wheel turns about A``, ``tipping over the edge A``."""
_MOMENTS, _ENOUGH = 400, 5  # of the model's own run that are looked at; of them, on which it stays there at least
_THERE = 1e-9  # of the size of the model, within which a contact is at a point


def on_corner(checker: Checker, words: str) -> Checker | None:
    """The checker of the stretch of the model's own motion on which a contact acts at the point of the ground that words say something
    turns about; None where there is none."""
    found = _ABOUT.search(words)
    if found is None or not checker.sampler.spec["contacts"]:
        return None
    sampler, end = checker.sampler, checker.happens.run.t[-1]
    run = sampler.run(sampler.first, end - sampler.first.t)
    times = np.linspace(sampler.first.t, min(end, run.end.t), _MOMENTS)
    for contact in sampler.spec["contacts"]:
        name, point = quote(contact["name"]), f"ground.{quote(found[1])}"
        with suppress(ModelError):
            values = run.evaluate([f"{name}.x - x({point})", f"{name}.y - y({point})"], times)
            there = np.abs(values).max(axis=1) <= _THERE * sampler.length  # it has no place where it is open
            stretches = [[*some] for is_there, some in groupby(range(len(times)), there.__getitem__) if is_there]
            stretch = next((some for some in stretches if _ENOUGH <= len(some) < len(times)), None)
            if stretch:
                return checker.at_time(float(times[stretch[len(stretch) // 2]]))
    return None

"""Mechanisms of textbooks with statements as students write them, right and with a slip, in ``books/``: none is made by a rule.

A file holds a ``model``, ``letters``, and ``statements``: what is said, the ``verdict`` that a person came to, and the ``correction``
that a tutor would give. Both were written down before the program had seen them.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from ruamel.yaml import YAML

from freebody.check import Checker
from freebody.check.file import WORDS, judged_alone
from freebody.check.residual import residual
from freebody.check.verdict import Verdict
from freebody.mechanism import Mechanism

FILES = {path.stem: path for path in sorted((Path(__file__).parent / "books").glob("*.yaml"))}


@dataclass(frozen=True)
class Said:
    """A statement with its verdict; ``kind`` is what a person says of it."""

    book: str
    statement: dict[str, Any]
    verdict: Verdict

    @property
    def kind(self) -> object:
        return WORDS[self.statement["verdict"]]


class Book:
    """One mechanism and what is said of it."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.data = YAML(typ="safe").load(FILES[name].read_text(encoding="utf-8"))

    @cached_property
    def checker(self) -> Checker:
        return Checker(Mechanism.loads(json.dumps({"freebody": 1, **self.data["model"]})), self.data.get("letters"))

    def says_the_same(self, one: str, other: str) -> bool:
        """Whether two equations are one but for a factor that is a number, wherever their symbols have any values."""
        cases = [self.checker.case(text) for text in (one, other)]
        values = {**cases[0].values(), **cases[1].values()}
        places = cases[0].elsewhere(values, bound=False)
        first, second = (residual(case.equations[0], places).sides.residual for case in cases)
        if first.shape != second.shape:
            return False
        factor = np.sum(first * second) / np.sum(second**2)
        return bool(np.allclose(first, factor * second, rtol=1e-7, atol=1e-9 * np.abs(first).max()))

    def verdicts(self, correcting: bool = True) -> Iterator[Said]:
        self.checker.correcting = correcting
        for statement in self.data["statements"]:
            yield Said(self.name, statement, judged_alone(self.checker, statement["says"]))

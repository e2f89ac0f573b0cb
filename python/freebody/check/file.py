"""Files of many statements about a model."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError, field_validator
from ruamel.yaml import YAML, YAMLError

from freebody.model.errors import ModelProblem
from freebody.symbolic.errors import StatementError

from .api import Checker
from .verdict import Kind, Verdict

if TYPE_CHECKING:
    from freebody.model.builder import Builder

_SAID = str | list[str | float]


class Statement(BaseModel):
    """One statement: ``says`` is an equation, lines of them or a claim. ``model`` (beside the file), ``set`` (parameters; a list
    of numbers tries each) and ``letters`` are added to those of the file; ``verdict`` is what is expected, if it is said."""

    model_config = ConfigDict(extra="forbid", populate_by_name=True)

    id: str = Field(description="name of the statement")
    says: str = Field(description="an equation, lines of them, or a claim")
    model: str | None = Field(None, description="another model, a file beside this one")
    set_: dict[str, Any] = Field({}, alias="set", description="parameters with other numbers; a list tries each")
    letters: dict[str, _SAID] = Field({}, description="symbols of your own")
    verdict: Literal["right", "if", "wrong", "undecidable", "dimensions", "unreadable"] | None = Field(
        None, description="what is expected: right, if, wrong, undecidable, dimensions or unreadable"
    )
    note: str = Field("", description="what a reader should know")


class Statements(BaseModel):
    """A file of statements about a model."""

    model_config = ConfigDict(extra="forbid")

    model: str = Field("model.yaml", description="the model, a file beside this one")
    letters: dict[str, _SAID] = Field({}, description="symbols of your own for all statements")
    statements: list[Statement] = Field(description="the statements, in order; one that is only a text is named by its number")

    @field_validator("statements", mode="before")
    @classmethod
    def _named(cls, found: Any) -> Any:
        """Statements without a name, by their numbers."""
        if not isinstance(found, list):
            return found
        whole = ({"says": one} if isinstance(one, str) else one for one in found)
        return [{"id": str(i), **one} if isinstance(one, dict) else one for i, one in enumerate(whole, 1)]


@dataclass(frozen=True)
class Judged:
    """A statement with its verdict. ``as_expected`` is None where the file expects nothing."""

    statement: Statement
    verdict: Verdict
    as_expected: bool | None

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {"id": self.statement.id, **as_json(self.verdict), "as expected": self.as_expected, "note": self.statement.note}


WORDS = {
    "right": Kind.TRUE,
    "if": Kind.TRUE_IF,
    "wrong": Kind.WRONG,
    "undecidable": Kind.UNDECIDABLE,
    "dimensions": Kind.DIMENSIONS,
    "unreadable": Kind.UNREADABLE,
}
"""Verdicts as a file writes them."""


def read(path: Path) -> Statements:
    """The statements of a file. Raises ``ModelProblem``."""
    try:
        data = YAML(typ="safe").load(path.read_text(encoding="utf-8"))
        if isinstance(data, dict) and "statements" not in data:
            what = "is a model, and there is no equation to check" if "freebody" in data else "holds no statements"
            raise ModelProblem(
                f"{path} {what}", f"give one, like `freebody check {path.name} \"m x'' = F\"`, or a file of `statements`"
            )
        return Statements.model_validate(data)
    except YAMLError as error:
        raise ModelProblem(f"{path}: {error}") from None
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise ModelProblem(f"{path}: {place}: {first['msg']}", "see docs/check.md for what a file of statements holds") from None


def judge(path: Path, load: Callable[[Path], Builder]) -> Iterator[Judged]:
    """The verdicts about all statements of a file, one by one; ``load`` reads their models. Raises ``ModelProblem`` where the file or a model cannot be read."""
    given = read(path)
    checkers: dict[tuple[str, str], Checker] = {}
    for statement in given.statements:
        said = {name: value if isinstance(value, list) else [value] for name, value in statement.set_.items()}
        counts = {len(each) for each in said.values()} - {1} or {1}  # a list tries each number
        if len(counts) > 1 or 0 in counts:
            raise ModelProblem(
                f"{path}: `{statement.id}`: the lists of `set` have different lengths", "give each as many numbers"
            )
        settings = [{name: each[i % len(each)] for name, each in said.items()} for i in range(*counts)]
        found = [_one(load, path, given, statement, values, checkers) for values in settings]
        verdict = next((v for v in found if not v.ok), found[0])
        expected = None if statement.verdict is None else verdict.kind is WORDS.get(statement.verdict)
        yield Judged(statement, verdict, expected)


def _one(
    load: Callable[[Path], Builder],
    path: Path,
    given: Statements,
    statement: Statement,
    values: Mapping[str, Any],
    checkers: dict[tuple[str, str], Checker],
) -> Verdict:
    key = (statement.model or given.model, json.dumps(values, sort_keys=True))
    if key not in checkers:
        mechanism = load(path.parent / key[0])
        mechanism.parameters.update(values)
        checkers[key] = Checker(mechanism, given.letters)
    verdict = judged_alone(checkers[key], statement.says, statement.letters)
    stated = ", ".join(f"{name} = {value}" for name, value in values.items())
    return replace(verdict, reason=f"{verdict.reason} ({stated})") if stated and not verdict.ok else verdict


def judged_alone(checker: Checker, text: str, letters: Mapping[str, _SAID] | None = None) -> Verdict:
    """The verdict about one statement among many, which do not suffer if it cannot be read."""
    try:
        return checker.check(text, letters)
    except StatementError as error:
        return Verdict(Kind.UNREADABLE, text, str(error))


def as_json(verdict: Verdict) -> dict[str, Any]:
    """A verdict as plain data."""
    return {
        "statement": verdict.text,
        "verdict": verdict.kind.value,
        "reason": verdict.reason,
        "moment": verdict.moment,
        "assumption": verdict.assumption,
        "mends": [
            {
                "edits": [dict(zip(("kind", "before", "after"), e, strict=True)) for e in m.edits],
                "equation": m.equation,
                "given": m.given,
                "why": m.why,
                "where": list(m.where),
            }
            for m in verdict.mends
        ],
        "nearest true equation": verdict.true,
        "untested": list(verdict.untested),
        "evidence": None if verdict.evidence is None else vars(verdict.evidence),
    }

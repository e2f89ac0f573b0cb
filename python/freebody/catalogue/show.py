"""The catalogue as a person reads it."""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import rich
from rich import box
from rich.table import Table
from rich.text import Text

from freebody.catalogue.answers import Answer, Asked
from freebody.catalogue.system import System
from freebody.check.verdict import Kind
from freebody.solve.figures import figure
from freebody.solve.rich_tables import table

if TYPE_CHECKING:
    from freebody.check.file import Judged

_SHOWN = 4
"""Figures of a long row that a table shows."""
_UNEXPECTED = " (not as expected)"


def show_list(systems: Iterable[System]) -> None:
    """The systems with their titles."""
    rows = [(system.id, system.title, len(system.models), len(system.questions())) for system in systems]
    counts = ("models", "questions")
    rich.print(table("", ("system", "what it is", *counts), rows, counts, edge=True))


def show_asked(asked: Asked, full: bool = False) -> None:
    """One question with its answers; ``full``: with all figures of long rows."""
    rows = []
    for answer in asked.answers:
        digits = "missing" if math.isnan(answer.digits) else f"{answer.digits:.1f}"
        cells = (answer.label, answer.said or figures(answer, full), answer.unit, digits, _source(answer))
        rows.append([Text(cell, "" if answer.ok else "bold red") for cell in cells])
    rich.print(table(asked.label, ("", "freebody", "unit", "digits", "agrees with"), rows, ("freebody", "digits"), edge=True))
    if asked.failure:
        rich.print(Text(f"  failed: {asked.failure}\n", "bold red"))


def show_statements(system: System, judged: Iterable[Judged]) -> None:
    """The statements about a system, each with its verdict and what is behind it."""
    shown = Table(box=box.SIMPLE_HEAD, title=Text(f"{system.id}: {system.title}", "bold"), title_justify="left")
    shown.add_column("statement", no_wrap=True)
    shown.add_column("verdict", no_wrap=True)
    shown.add_column("what is stated, and what is behind the verdict", overflow="fold")
    for one in judged:
        kind = one.verdict.kind
        lines = [Text(one.statement.says.strip())]
        lines += [Text(f"→ {line}", "dim" if one.verdict.ok else "") for line in one.verdict.details]
        lines += [Text(f"note: {one.statement.note}", "italic")] if one.statement.note else []
        verdict = Text(kind.short + _UNEXPECTED * (one.as_expected is False), kind.colour)
        shown.add_row(one.statement.id, verdict, Text("\n").join(lines))
    rich.print(shown)


def show_verdicts(system: System, judged: Iterable[Judged]) -> None:
    """Which of the statements about a system are true, which are wrong."""
    by_kind: dict[Kind, list[str]] = {}
    for one in judged:
        by_kind.setdefault(one.verdict.kind, []).append(one.statement.id + _UNEXPECTED * (one.as_expected is False))
    rich.print(Text("What is stated about it", "bold"))
    for kind, names in by_kind.items():
        rich.print(Text.assemble("  ", (f"{kind.short}: ", kind.colour), ", ".join(names)))
    rich.print(Text(f"  why: freebody systems {system.id} --statements\n"))


def show_totals(judged: Iterable[Judged]) -> None:
    """How many statements are true, how many are wrong, and whether all have the verdict that their file expects."""
    every = list(judged)
    counts = Counter(one.verdict.kind for one in every)
    stated = ", ".join(f"{counts[kind]} {kind.short}" for kind in Kind if counts[kind])
    rich.print(Text(f"{len(every)} statements: {stated}", "bold"))
    if wrong := [one.statement.id for one in every if one.as_expected is False]:
        rich.print(Text(f"not as expected: {', '.join(wrong)}", "bold red"))


def show_summary(results: dict[str, list[Asked]]) -> None:
    """One line for every system; answers are those with an independent check."""
    rows = []
    for identity, asked in results.items():
        answers = [answer for question in asked for answer in question.answers if not answer.own]
        fewest = min((answer.digits for answer in answers), default=math.nan)
        verdict = Text("ok", "green") if all(question.ok for question in asked) else Text("FAILED", "bold red")
        seconds = f"{sum(question.seconds for question in asked):.1f}"
        rows.append((identity, len(asked), len(answers), f"{fewest:.1f}", seconds, verdict))
    counts = ("questions", "answers", "fewest digits", "seconds")
    rich.print(table("", ("system", *counts, ""), rows, counts, edge=True))


def figures(answer: Answer, full: bool = False) -> str:
    """A figure, or the first of a long row or all of it, with the digits that hold."""
    row = answer.known
    shown = row if full or len(row) <= _SHOWN else row[:_SHOWN]
    told = ", ".join(figure(x, 8) for x in shown)
    return told if len(shown) == len(row) else f"{told}, … ({len(row)}; --full)"


def write_csv(path: Path, results: dict[str, list[Asked]]) -> None:
    """A table with every figure of every answer beside its check, one a row."""
    heads = ("system", "question", "answer", "place", "value", "unit", "check", "digits", "agrees with", "same run", "in letters")
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(heads)
        for identity, asked in ((identity, each) for identity, every in results.items() for each in every):
            for answer in asked.answers:
                values, checks = np.broadcast_arrays(*(np.ravel(np.asarray(x, float)) for x in (answer.value, answer.check)))
                about = (f"{answer.digits:.1f}", answer.against, int(answer.own), answer.said)
                for place, (value, check) in enumerate(zip(values.tolist(), checks.tolist(), strict=True), 1):
                    rows.writerow((identity, asked.label, answer.label, place, repr(value), answer.unit, repr(check), *about))


def _source(answer: Answer) -> str:
    if answer.ok:
        return f"the same run: {answer.against}" if answer.own else answer.against
    value, check = np.broadcast_arrays(np.ravel(answer.value).astype(float), np.ravel(answer.check).astype(float))
    worst = int(np.argmax(np.nan_to_num(np.abs(value - check), nan=np.inf)))
    return f"{answer.against}: {check[worst]:.10g}, not {value[worst]:.10g}"

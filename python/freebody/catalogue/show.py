"""The catalogue as a person reads it."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from freebody.catalogue.answers import Answer, Asked
from freebody.catalogue.system import System
from freebody.check.verdict import Kind

if TYPE_CHECKING:
    from freebody.check.file import Judged


def show_list(systems: Iterable[System], console: Console | None = None) -> None:
    """The systems with their titles."""
    table = Table(box=box.SIMPLE_HEAD)
    for head in ("system", "what it is", "models", "questions"):
        table.add_column(head, justify="right" if head in ("models", "questions") else "left")
    for system in systems:
        table.add_row(system.id, Text(system.title), str(len(system.models)), str(len(system.questions())))
    (console or Console()).print(table)


def show_asked(asked: Asked, console: Console | None = None) -> None:
    """One question with its answers."""
    console = console or Console()
    table = Table(box=box.SIMPLE_HEAD, title=Text(asked.label, "bold"), title_justify="left")
    table.add_column("")
    table.add_column("freebody", justify="right")
    table.add_column("unit")
    table.add_column("digits", justify="right")
    table.add_column("agrees with")
    for answer in asked.answers:
        style = "" if answer.ok else "bold red"
        cells = [answer.label, answer.said or figures(answer.value), answer.unit, _digits(answer), _source(answer)]
        table.add_row(*(Text(cell, style) for cell in cells))
    console.print(table)
    if asked.failure:
        console.print(Text(f"  failed: {asked.failure}\n", "bold red"))


def show_statements(system: System, judged: Iterable[Judged], console: Console | None = None) -> None:
    """The statements about a system, each with its verdict and what is behind it."""
    table = Table(box=box.SIMPLE_HEAD, title=Text(_headed(system), "bold"), title_justify="left")
    table.add_column("statement", no_wrap=True)
    table.add_column("verdict", no_wrap=True)
    table.add_column("what is stated, and what is behind the verdict", overflow="fold")
    for one in judged:
        kind = one.verdict.kind
        table.add_row(one.statement.id, Text(kind.short + _unexpected(one), kind.colour), _behind(one))
    (console or Console()).print(table)


def show_verdicts(system: System, judged: Iterable[Judged], console: Console | None = None) -> None:
    """Which of the statements about a system are true, which are wrong."""
    console, by_kind = console or Console(), dict[Kind, list[str]]()
    for one in judged:
        by_kind.setdefault(one.verdict.kind, []).append(one.statement.id + _unexpected(one))
    console.print(Text("What is stated about it", "bold"))
    for kind, names in by_kind.items():
        console.print(Text.assemble("  ", (f"{kind.short}: ", kind.colour), ", ".join(names)))
    console.print(Text(f"  why: freebody systems {system.id} --statements\n"))


def show_totals(judged: Iterable[Judged], console: Console | None = None) -> None:
    """How many statements are true, how many are wrong, and whether all have the verdict that their file expects."""
    every = list(judged)
    counts = Counter(one.verdict.kind for one in every)
    stated = ", ".join(f"{counts[kind]} {kind.short}" for kind in Kind if counts[kind])
    (console or Console()).print(Text(f"{len(every)} statements: {stated}", "bold"))
    if wrong := [one.statement.id for one in every if one.as_expected is False]:
        (console or Console()).print(Text(f"not as expected: {', '.join(wrong)}", "bold red"))


def _headed(system: System) -> str:
    return f"{system.id}: {system.title}"


def _unexpected(one: Judged) -> str:
    return " (not as expected)" if one.as_expected is False else ""


def _behind(one: Judged) -> Text:
    lines = [Text(one.statement.says.strip())]
    lines += [Text(f"→ {line}", "dim" if one.verdict.ok else "") for line in one.verdict.details]
    if one.statement.note:
        lines.append(Text(f"note: {one.statement.note}", "italic"))
    return Text("\n").join(lines)


def show_summary(results: dict[str, list[Asked]], console: Console | None = None) -> None:
    """One line for every system."""
    table = Table(box=box.SIMPLE_HEAD)
    for head in ("system", "questions", "answers", "fewest digits", "seconds", ""):
        table.add_column(head, justify="left" if head in ("system", "") else "right")
    for identity, asked in results.items():
        answers = [answer for question in asked for answer in question.answers]
        fewest = min((answer.digits for answer in answers), default=math.nan)
        verdict = Text("ok", "green") if all(question.ok for question in asked) else Text("FAILED", "bold red")
        seconds = f"{sum(question.seconds for question in asked):.1f}"
        table.add_row(identity, str(len(asked)), str(len(answers)), f"{fewest:.1f}", seconds, verdict)
    (console or Console()).print(table)


def figures(value) -> str:
    """A figure, or the first of a long row."""
    row = np.atleast_1d(np.asarray(value, float))
    shown = ", ".join(f"{x:.8g}" for x in row[:4])
    return shown if len(row) <= 4 else f"{shown}, … ({len(row)})"


def _digits(answer: Answer) -> str:
    return "missing" if math.isnan(answer.digits) else f"{answer.digits:.1f}"


def _source(answer: Answer) -> str:
    if answer.ok:
        return answer.against
    value, check = np.broadcast_arrays(np.ravel(answer.value).astype(float), np.ravel(answer.check).astype(float))
    worst = int(np.argmax(np.nan_to_num(np.abs(value - check), nan=np.inf)))
    return f"{answer.against}: {check[worst]:.10g}, not {value[worst]:.10g}"

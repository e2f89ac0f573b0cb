"""The catalogue as a person reads it."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from freebody.catalogue.answers import Answer, Asked
from freebody.catalogue.system import System


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
        cells = [answer.label, figures(answer.value), answer.unit, _digits(answer), _source(answer)]
        table.add_row(*(Text(cell, style) for cell in cells))
    console.print(table)
    if asked.failure:
        console.print(Text(f"  failed: {asked.failure}\n", "bold red"))


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

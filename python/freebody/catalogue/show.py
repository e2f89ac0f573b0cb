"""The catalogue as a person reads it."""

from __future__ import annotations

import csv
import math
from collections import Counter
from collections.abc import Iterable
from itertools import groupby
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING

import numpy as np
import rich
from rich import box
from rich.rule import Rule
from rich.table import Table
from rich.text import Text

from freebody.catalogue.answers import Answer, Asked
from freebody.catalogue.sentences import checks, folded, sentence
from freebody.catalogue.system import System
from freebody.check.verdict import Kind
from freebody.solve.rich_tables import table

if TYPE_CHECKING:
    from freebody.check.file import Judged

_UNEXPECTED = " (not as expected)"


def show_list(systems: Iterable[System]) -> None:
    """The systems with their titles."""
    rows = [(system.id, system.title, len(system.models), len(system.questions())) for system in systems]
    counts = ("models", "questions")
    rich.print(table("", ("system", "what it is", *counts), rows, counts, edge=True))


def show_title(system: System) -> None:
    """The name of a system above its questions."""
    rich.print(Rule())
    _line(f"{system.id}: {system.title}\n", 0, "bold")


def show_asked(asked: Asked, full: bool = False) -> None:
    """One question, what was found, and how it was checked in a small print. Variants are folded into a paragraph each unless ``full``,
    which also tells all figures of long rows."""
    _line(asked.label, 0, "bold")
    variants: dict[str, list[Answer]] = {}
    for answer in asked.answers:
        variants.setdefault(answer.variant, []).append(answer)
    _show_answers(variants.pop("", []), full)
    for variant, answers in variants.items():
        if full:
            _line(f"{variant}:", 2, "italic")
            _show_answers(answers, full)
        else:
            _line(folded(variant, answers), 2, _style(answers), hanging=2)
    if variants and not full:
        _line(checks([answer for answers in variants.values() for answer in answers]), 4, "dim")
    if asked.failure:
        _line(f"failed: {asked.failure}", 2, "bold red")
    rich.print()


def _show_answers(answers: Iterable[Answer], full: bool) -> None:
    """Answers, and below those that were checked alike how they were."""
    for _, alike in groupby(answers, lambda answer: (answer.against, answer.ok)):
        group = list(alike)
        for answer in group:
            _line(sentence(answer, full), 2, _style([answer]))
        _line(checks(group), 4, "dim" if group[0].ok else "bold red")


def _style(answers: Iterable[Answer]) -> str:
    return "" if all(answer.ok for answer in answers) else "bold red"


def _line(text: str, indent: int, style: str, hanging: int = 0) -> None:
    console = rich.get_console()
    errors = getattr(console.file, "errors", None) or "strict"
    spelt = text.encode(console.encoding, errors).decode(console.encoding)  # as a terminal of ASCII will show it
    for line in Text(spelt, style).wrap(console, console.width - indent - hanging):
        line.rstrip()
        rich.print(Text(" " * indent) + line)
        indent += hanging
        hanging = 0


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
    """One line for every system, and one for all; answers are those with an independent check."""
    rows = []
    for identity, asked in results.items():
        digits = _digits(asked)
        verdict = Text("ok", "green") if all(question.ok for question in asked) else Text("FAILED", "bold red")
        seconds = f"{sum(question.seconds for question in asked):.1f}"
        rows.append((identity, len(asked), len(digits), f"{min(digits, default=math.nan):.1f}", seconds, verdict))
    counts = ("questions", "answers", "fewest digits", "seconds")
    rich.print(table("", ("system", *counts, ""), rows, counts, edge=True))
    every = [question for asked in results.values() for question in asked]
    digits = _digits(every)
    wrong = sum(not answer.ok for question in every for answer in question.answers) + sum(bool(q.failure) for q in every)
    told = f"{len(results)} systems, {len(every)} questions, {len(digits)} answers, each beside an independent value: "
    told += f"at least {min(digits):.1f} digits agree, {median(digits):.1f} in the median; "
    _line(told + (f"{wrong} do not agree" if wrong else "none disagrees"), 0, "bold red" if wrong else "bold")


def _digits(asked: Iterable[Asked]) -> list[float]:
    return [answer.digits for question in asked for answer in question.answers if not answer.own]


def write_csv(path: Path, results: dict[str, list[Asked]]) -> None:
    """A table with every figure of every answer beside its check, one a row."""
    heads = (
        "system",
        "question",
        "variant",
        "answer",
        "place",
        "value",
        "unit",
        "check",
        "digits",
        "agrees with",
        "same run",
        "in letters",
    )
    with path.open("w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file)
        rows.writerow(heads)
        for identity, asked in ((identity, each) for identity, every in results.items() for each in every):
            for answer in asked.answers:
                values, checks = np.broadcast_arrays(*(np.ravel(np.asarray(x, float)) for x in (answer.value, answer.check)))
                head = (identity, asked.label, answer.variant, answer.label)
                about = (f"{answer.digits:.1f}", answer.against, int(answer.own), answer.said)
                for place, (value, check) in enumerate(zip(values.tolist(), checks.tolist(), strict=True), 1):
                    rows.writerow((*head, place, repr(value), answer.unit, repr(check), *about))

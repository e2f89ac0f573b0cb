"""Every statement about a system of the catalogue has the verdict that its file says."""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path

from store import every
from typer.testing import CliRunner

from freebody import catalogue
from freebody.check import Verdict
from freebody.check.file import Judged, judge, read
from freebody.cli import app
from freebody.mechanism import Mechanism

FILES = {system.id: system.statements for system in catalogue.systems() if system.statements.exists()}
STATED = {
    "BLOCK": 8, "ARM": 5, "WEDGE": 11, "GUN": 9, "SLOPE": 6, "MOTOR": 4, "WHEEL": 4, "BAR": 14, "CART": 1, "LEGS": 1, "GEN": 2,
}  # fmt: skip
"""How many printed statements there are of each kind; one that says several things has several entries, `BLOCK-8a`, `BLOCK-8b`. All
others are what a solution would claim."""


@cache
def judged(path: Path) -> list[Judged]:
    return list(judge(path, Mechanism.load))


def verdict(system: str, statement: str) -> Verdict:
    return next(one.verdict for one in judged(FILES[system]) if one.statement.id == statement)


@every(FILES, "system")
def test_statements_have_their_verdicts(system: str) -> None:
    assert all(statement.verdict for statement in read(FILES[system]).statements)
    wrong = [(one.statement.id, one.verdict.kind) for one in judged(FILES[system]) if not one.as_expected]
    assert not wrong


@every(FILES, "system")
def test_what_is_wrong_is_mended_or_shown(system: str) -> None:
    for one in judged(FILES[system]):
        if one.verdict.kind.name in ("WRONG", "DIMENSIONS"):
            found = one.verdict
            assert found.mends or found.reason or found.true or any("no more was looked for" in note for note in found.notes), (
                one.statement.id
            )


def test_no_statement_is_left_out() -> None:
    names = [statement.id for path in FILES.values() for statement in read(path).statements]
    stated = {re.sub("[a-z]$", "", name) for name in names if name.partition("-")[0] in STATED}
    assert stated == {f"{kind}-{number}" for kind, count in STATED.items() for number in range(1, count + 1)}


MENDS = {
    ("EX-BLOCK", "BLOCK-1"): "m2*(xddot*i + y'ddot*j') · i",
    ("EX-BLOCK", "BLOCK-6"): "- m2*g*j =",
    ("EX-ARM", "ARM-1"): "m1*g*(-j)",
    ("EX-ARM", "ARM-2"): "m2*g*(-j)",
    ("S19.15", "WEDGE-6"): "(μ*C - S) + μ)",
    ("S19.17", "GUN-4"): "-m2*Rddot + m2*R*ω^2",
    ("S19.17", "GUN-7"): "t = 1.147 s",
    ("S19.17", "GUN-9b"): "theta = 2.87",
    ("S19.18", "SLOPE-3"): "- thetadot^2*sin(theta)",
    ("S19.18", "SLOPE-4"): "- m/M*thetadot^2*sin(theta)*cos(theta)",
    ("S19.18", "SLOPE-5"): "= -g*sin(theta - α)",
    ("S19.19", "MOTOR-1"): "sin(theta)*xddot",
    ("S19.20", "WHEEL-1b"): "-(1.25*i + 2.17*j)",
    ("S19.20", "WHEEL-1c"): "(-3.50*i + 4.33*j)",
    ("S19.20", "WHEEL-4a"): "-(17.32*i + 8.00*j)",
    ("S19.20", "WHEEL-4b"): "-(8.66*i + 4.00*j)",
    ("S19.21", "BAR-4"): "ℓ2*βddot/2*n2",
    ("S19.21", "BAR-5"): "ℓ3*φddot/2*n3",
    ("S19.21", "BAR-7"): "R_D",  # its moment about A, r_D/A × R_D or d R_Dy
    ("S19.22", "BAR-8a"): "(n1 · λ3)/(n2 · λ3)",
    ("S19.22", "BAR-8b"): "(n1 · λ2)/(n3 · λ2)",
    ("S19.22", "BAR-9"): "- [-cos(β), cos(φ); sin(β), -sin(φ)]",
    ("S19.22", "BAR-10c"): "R_D",
}
"""What each mended equation, or the nearest balance where there is none, must hold; each was found by hand from the mechanics of the
system."""


@every(dict.fromkeys(system for system, _ in MENDS), "system")
def test_the_wrong_term_is_mended(system: str) -> None:
    for statement, term in ((name, term) for (of, name), term in MENDS.items() if of == system):
        found = verdict(system, statement)
        assert term in (found.mends[0].equation if found.mends else found.true), statement


def test_the_command_lists_statements_with_their_verdicts() -> None:
    done = CliRunner().invoke(app, ["systems", "19.3.24", "--statements"])
    assert done.exit_code == 0, done.output
    assert "7 statements: 4 true, 3 wrong" in done.output
    as_json = CliRunner().invoke(app, ["systems", "19.3.17", "--statements", "--json"])
    assert [(row["system"], row["id"], row["verdict"]) for row in json.loads(as_json.output)] == [("19.3.17", "CART-1", "true")]


def test_a_system_tells_what_is_stated_about_it() -> None:
    done = CliRunner().invoke(app, ["systems", "19.3.17"])
    assert "true: CART-1" in done.output

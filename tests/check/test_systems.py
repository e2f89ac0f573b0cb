"""Every statement about a system of the catalogue has the verdict that its file says."""

from __future__ import annotations

from pathlib import Path

import pytest

import freebody
from freebody.check.file import judge, read

FILES = sorted((Path(freebody.__file__).parent / "systems").glob("*/statements.yaml"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.parent.name)
def test_statements_have_their_verdicts(path: Path) -> None:
    assert all(statement.verdict for statement in read(path).statements)
    wrong = [(one.statement.id, one.verdict.kind) for one in judge(path) if not one.as_expected]
    assert not wrong


MENDS = {
    ("EX-BLOCK", "BLOCK-6"): "- m2*g*j =",
    ("EX-ARM", "ARM-1"): "m1*g*(-j)",
    ("EX-ARM", "ARM-2"): "m2*g*(-j)",
    ("S19.15", "WEDGE-6"): "(mu*C - S) + mu)",
    ("S19.17", "GUN-4"): "= R*thetadot^2",
    ("S19.18", "SLOPE-3"): "- thetadot^2*sin(theta)",
    ("S19.19", "MOTOR-1"): "sin(theta)*xddot",
    ("S19.21", "BAR-5"): "l3*phiddot/2*n3",
    ("S19.21", "BAR-7"): "r_D/A × R_D",
    ("S19.22", "BAR-8a"): "(n1 · λ3)/(n2 · λ3)",
}
"""What each mended equation must hold; each was found by hand from the mechanics of the system."""


@pytest.mark.parametrize(("system", "statement"), MENDS, ids=lambda x: x)
def test_the_wrong_term_is_mended(system: str, statement: str) -> None:
    path = next(path for path in FILES if path.parent.name == system)
    verdict = next(one.verdict for one in judge(path) if one.statement.id == statement)
    assert MENDS[system, statement] in verdict.mends[0].equation

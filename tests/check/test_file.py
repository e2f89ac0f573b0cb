"""Files of statements, and the command that reads them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from typer.testing import CliRunner

from freebody.check import Kind
from freebody.check.file import judge, read
from freebody.cli import app
from freebody.mechanism import Mechanism
from freebody.model.errors import ModelProblem

MODEL = """
freebody: 1
parameters: {m: 2 kg, l: 0.8 m, g: 9.81 m/s^2}
gravity: g
bodies: {rod: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: {name: theta, zero: down}}}
initial: {theta: 0.4}
"""
FILE = """
letters: {phi: theta - pi/2}
statements:
  - {id: A, says: "2*l*theta'' = -3*g*sin(theta)"}
  - {id: B, says: "2*l*phi'' = -3*g*cos(phi)"}
  - {id: C, says: "2*l*theta'' = 3*g*sin(theta)", verdict: wrong, note: the other sense}
  - {id: D, says: "theta'' = -6*sin(theta)*g/k0", letters: {k0: 4*l}, set: {l: [0.5, 2]}}
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "model.yaml").write_text(MODEL)
    (tmp_path / "statements.yaml").write_text(FILE)
    return tmp_path


def test_a_file_of_statements_is_judged(folder: Path) -> None:
    done = {one.statement.id: one for one in judge(folder / "statements.yaml", Mechanism.load)}
    assert [done[name].verdict.kind for name in "ACD"] == [Kind.TRUE, Kind.WRONG, Kind.TRUE]
    assert done["C"].as_expected
    assert done["A"].as_expected is None


def test_an_own_angle_from_another_axis(folder: Path) -> None:
    done = {one.statement.id: one for one in judge(folder / "statements.yaml", Mechanism.load)}
    # sin θ = sin(φ + π/2) = cos φ
    assert done["B"].verdict.ok


def test_what_a_file_may_hold_is_reported(folder: Path) -> None:
    (folder / "bad.yaml").write_text("statements: [{id: A, say: x = 1}]")
    with pytest.raises(ModelProblem, match="says"):
        read(folder / "bad.yaml")


def test_the_command_ends_with_its_verdict(folder: Path) -> None:
    run = CliRunner().invoke
    model = str(folder / "model.yaml")
    good = run(app, ["check", model, "2*l*theta'' = -3*g*sin(theta)"])
    assert good.exit_code == 0
    assert "true" in good.output
    bad = run(app, ["check", model, "2*l*phi'' = 3*g*cos(phi)", "--where", "phi=theta-pi/2", "--json"])
    assert bad.exit_code == 3
    stated = json.loads(bad.output)
    assert stated[0]["verdict"] == "wrong"
    assert stated[0]["mends"][0]["edits"][0]["kind"] == "sign"
    assert run(app, ["check", str(folder / "statements.yaml")]).exit_code == 0


def test_a_model_without_an_equation_is_said_so(folder: Path) -> None:
    run = CliRunner().invoke(app, ["check", str(folder / "model.yaml")])
    assert run.exit_code == 2
    assert "no equation to check" in run.output
    (folder / "nothing.yaml").write_text("model: model.yaml")
    with pytest.raises(ModelProblem, match="no statements"):
        read(folder / "nothing.yaml")


def test_one_statement_that_cannot_be_read_does_not_stop_the_others(folder: Path) -> None:
    (folder / "many.yaml").write_text(
        "statements: [\"l q'' = 0\", {says: 'x = (1'}, \"2*l*theta'' = -3*g*sin(theta)\", {id: end, says: 'limit: g = 1'}]"
    )
    done = [(one.statement.id, one.verdict.kind) for one in judge(folder / "many.yaml", Mechanism.load)]
    assert done == [("1", Kind.UNREADABLE), ("2", Kind.UNREADABLE), ("3", Kind.TRUE), ("end", Kind.UNREADABLE)]
    run = CliRunner().invoke(app, ["check", str(folder / "model.yaml"), "l q'' = 0", "2*l*theta'' = -3*g*sin(theta)"])
    assert run.exit_code == 3
    assert "`q''` has no meaning" in run.output
    assert "\n  true\n" in run.output

"""The command line as a fixture, and small models for it."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from freebody import cli

DOOR = """\
freebody: 1
bodies:
  door[1]: {shape: rod, length: 1 m, mass: 2 kg}
joints:
  upper: {type: hinge, of: [ground.O, "door[1].start"]}
  lower: {type: hinge, of: [ground.O, "door[1].start"]}
run: {until: 0.2 s}
"""
BURSTING = """\
freebody: 1
parameters: {k: 1 N/m^2}
gravity: none
bodies:
  ball: {shape: particle, mass: 1 kg}
forces:
  blow: {type: force, at: ball.centre, x: k*ball.x^2, y: 0}
initial: {ball.x: 1 m}
run: {until: 100 s}
"""
FALLING = """\
freebody: 1
bodies:
  ball: {shape: particle, mass: 1 kg}
joints:
  fall: {type: slot, along: {through: ground.O, angle: 90 deg}, point: ball.centre, coordinate: h}
initial: {h: 1 m}
run: {until: 1 s}
"""


@pytest.fixture
def command():
    """Runs the command line on some words."""
    return lambda *words: CliRunner().invoke(cli.app, words)


@pytest.fixture
def door(tmp_path):
    """A door on two hinges in one place: each alone would hold it."""
    return _written(tmp_path / "door.yaml", DOOR)


@pytest.fixture
def bursting(tmp_path):
    """A motion that leaves every bound in finite time."""
    return _written(tmp_path / "bursting.yaml", BURSTING)


@pytest.fixture
def handing(tmp_path):
    """A fall that goes on as another model."""
    _written(tmp_path / "second.yaml", FALLING)
    event = "events: {over: {when: h - 0.5 m, then: {hand_over: second.yaml}}}\n"
    return _written(tmp_path / "first.yaml", FALLING + event)


def _written(path, text):
    path.write_text(text)
    return str(path)

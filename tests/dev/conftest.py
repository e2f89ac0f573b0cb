"""The command line as a fixture, and small models for it."""

from __future__ import annotations

import pytest
from small_models import BURSTING, DOOR, FALLING
from typer.testing import CliRunner

from freebody import cli


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

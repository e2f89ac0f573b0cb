"""Stand-ins for mechanisms and their results, so that the command line is tested by itself."""

from __future__ import annotations

import json
from types import SimpleNamespace

import numpy as np
import pytest
from freebody.instant import Indeterminate
from freebody.results import Energy, Event, Outcome, Reported
from typer.testing import CliRunner

from freebody import cli

ABOUT = {
    "bodies": [{"name": "bob [1]", "mass": 2.0, "inertia": 0.0, "centre": [0, 0], "particle": True}],
    "coordinates": [{"name": "theta", "dimension": "rad", "doc": "angle of the pivot"}],
    "joints": [{"name": "pivot", "type": "hinge", "first": "ground", "second": "bob [1]", "cut": False}],
    "forces": [],
    "motions": [],
    "freedom": {"count": 1},
    "notes": ["no friction"],
}


class FakeReaction(SimpleNamespace):
    """A reaction whose couple no balance equation determines."""

    name, first, second = "pivot", "ground", "bob [1]"
    Fx, Fy, Fs, Fn = 3.0, 4.0, 5.0, 0.0

    @property
    def M(self):
        raise Indeterminate("pivot.M is not determined")


class FakeInstant(SimpleNamespace):
    """One instant, with the route it was asked for."""

    accelerations = {"theta": -9.81}
    reactions = {"pivot": FakeReaction()}
    motions = {}
    residual, residuals = 1e-16, {"bob [1]": (0.0, 0.0, 0.0)}
    freedom, explanation, self_stress = 1, "one way to move", []

    def tables(self):
        return ["ACCELERATIONS", "REACTIONS", "RESIDUALS"]


class FakeRun(SimpleNamespace):
    """A run whose energy ledger closes to 1e-12."""

    name = "pendulum"
    reactions = {"pivot": FakeReaction()}
    events = [Event("bottom", 0.5, "crossing", 1, {"theta": 0.0}, {"theta": 3.0})]
    report = {"top speed": Reported(4.43, "m/s", 0.5), "never": Reported(None, "", note="up did not happen")}
    energy = Energy(np.array([0.0, 1.0]), ("kinetic", "potential", "balance"), np.array([[0, 1, 0], [1, 0, 1e-12]]))
    stats = {"accepted": 10}

    def peak(self, text):
        if text.endswith(".M"):
            raise Indeterminate(text)
        return 0.5, 58.9

    def save(self, path):
        path.write_text("saved")
        return path


class FakeMechanism:
    """Remembers what was asked of it."""

    def __init__(self, ok=True):
        self.outcome = Outcome("reached_end" if ok else "step_too_small", ok, 1.0, "It ran." if ok else "It broke at t = 1 s.")
        self.asked = {}

    def simulate(self, progress, **settings):
        assert progress(0.5)
        self.asked = settings
        return FakeRun(outcome=self.outcome)

    def solve(self, route, **state):
        self.asked = state
        return FakeInstant(route=route)

    def drawing(self):
        return SimpleNamespace(figure=SimpleNamespace(savefig=lambda path: path.write_text("drawn")))

    def compile(self):
        return SimpleNamespace(describe=lambda: json.dumps(ABOUT))


@pytest.fixture
def command():
    """Runs the command line on some words."""
    return lambda *words: CliRunner().invoke(cli.app, words)


@pytest.fixture
def mechanism(monkeypatch):
    """Every model file is this mechanism."""
    found = FakeMechanism()
    monkeypatch.setattr(cli, "opened", lambda path, changes=None: found)
    return found

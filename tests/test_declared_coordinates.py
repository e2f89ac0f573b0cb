"""A coordinate that a model declares keeps its name, value and acceleration where its joint can be released."""

import json
import math

import numpy as np
import pytest
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app

MODEL = """
freebody: 1
parameters: {{g: 9.81 m/s^2, R: 1.2 m}}
ground:
  points: {{B: [2 m, 0], T: [0, R]}}
  lines: {{incline: {{through: O, angle: -30 deg}}}}
  curves: {{tube: {{arc: {{centre: T, radius: R}}}}}}
bodies:
  ball: {{shape: particle, mass: 2 kg}}
  box: {{shape: rectangle, width: 0.2 m, height: 0.1 m, mass: 3 kg, lines: {{base: {{through: centre, angle: 0}}}}}}
joints:
  other: {{{other}}}
  guide: {{{guide}}}
events: {{let go: {{when: t - 1 s, then: {then}}}}}
initial: {{X: 0.5}}
run: {{until: 1 s}}
"""
BALL, BOX = "type: free, of: [ground.O, ball.centre]", "type: free, of: [ground.O, box.centre]"
SLOPE = 9.81 / 2
"""Down an incline of 30°, m/s²."""
CIRCLE = -9.81 / 1.2 * math.cos(0.5)
"""Of the angle from the x axis to a place on a circle of 1.2 m, at 0.5 rad, rad/s²."""
RELEASES = {
    "slot, ends free": (BOX, "type: slot, along: [ground.O, ground.B], point: ball.centre, coordinate: X", "ends: free", 0.0),
    "slider, ends free": (BALL, "type: slider, along: [ground.O, ground.B], line: box.base, coordinate: X", "ends: free", 0.0),
    "slot, one-sided": (BOX, "type: slot, along: ground.incline, point: ball.centre, coordinate: X", "one_sided: true", SLOPE),
    "slider, one-sided": (BALL, "type: slider, along: ground.incline, line: box.base, coordinate: X", "one_sided: true", SLOPE),
    "slot, released": (BOX, "type: slot, along: ground.incline, point: ball.centre, coordinate: X", None, SLOPE),
    "curved slot, released": (BOX, "type: curved_slot, along: ground.tube, point: ball.centre, coordinate: X", None, CIRCLE),
}


def models(kind):
    """The model without and with what releases the guide."""
    other, guide, word, _ = RELEASES[kind]
    plain = MODEL.format(other=other, guide=guide, then="record")
    if word is None:
        return plain, MODEL.format(other=other, guide=guide, then="{release: guide}")
    return plain, MODEL.format(other=other, guide=f"{guide}, {word}", then="record")


@pytest.mark.parametrize("kind", RELEASES)
def test_equations_are_those_without_the_release(kind):
    for form in ("minimal", "brute"):
        plain, released = (fb.Mechanism.loads(text).equations(form).text() for text in models(kind))
        assert released == plain


@pytest.mark.parametrize("kind", RELEASES)
def test_validate_and_solve_tell_it_with_and_without_the_release(kind, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for text in models(kind):
        (tmp_path / "m.yaml").write_text(text)
        commands = (["validate"], ["solve"], ["solve", "--json"])
        stated, solved, data = (CliRunner().invoke(app, [*words, "m.yaml"]).stdout for words in commands)
        assert " of `b" in next(line for line in stated.splitlines() if line.split()[:1] == ["X"])
        assert any(line.split()[:1] == ["X"] for line in solved.splitlines())
        found = json.loads(data)
        assert found["state"]["X"] == pytest.approx(0.5)
        assert found["accelerations"]["X"] == pytest.approx(RELEASES[kind][-1], abs=1e-6)


@pytest.mark.parametrize("kind", RELEASES)
def test_a_guess_that_does_not_hold_is_named(kind):
    for text in models(kind):
        notes = fb.Mechanism.loads(text).solve(guess={"X": 0.2}).core.notes
        assert any(note.startswith("X: guess 0.200000, assembled 0.5") for note in notes), notes


@pytest.mark.parametrize("kind", RELEASES)
def test_it_is_a_column_of_the_motion_with_and_without_the_release(kind, tmp_path):
    """X = X₀ + a t² / 2 on a straight guide, and the ball on its circle has X as its angle; the same from a file."""
    *_, acceleration = RELEASES[kind]
    for text in models(kind):
        run = fb.Mechanism.loads(text).simulate(until=0.5)
        names, values = [column.name for column in run.columns], np.hstack(list(run.blocks.values()))
        x, rate, accel = (values[:, names.index(name)] for name in ("X", "rate(X)", "accel(X)"))
        if kind.startswith("curved"):
            assert run["x(ball.centre)"] == pytest.approx(1.2 * np.cos(x), abs=1e-8)
            assert accel[0] == pytest.approx(acceleration)
        else:
            assert x == pytest.approx(0.5 + acceleration * run.t**2 / 2, abs=1e-7)
            assert rate == pytest.approx(acceleration * run.t, abs=1e-7)
            assert accel == pytest.approx(np.full(len(run.t), acceleration), abs=1e-6)
        for ending in ("csv", "nc"):
            assert fb.Run.load(run.save(tmp_path / f"run.{ending}"))["rate(X)"] == pytest.approx(rate, nan_ok=True)


@pytest.mark.parametrize("kind", [kind for kind in RELEASES if kind.endswith("released")])
def test_what_is_released_stands_in_no_answer(kind, tmp_path):
    """Neither its coordinate nor its reaction, and the freedom that it took is counted."""
    (tmp_path / "m.yaml").write_text(models(kind)[1].replace("until: 1 s", "until: 2 s"))
    path = str(tmp_path / "m.yaml")
    solved, equations = (
        CliRunner().invoke(app, [*words, path, "--after", "let go"]).stdout for words in (["solve"], ["equations", "--long"])
    )
    data = json.loads(CliRunner().invoke(app, ["solve", path, "--after", "let go", "--json"]).stdout)
    assert not {"X", "guide"} & {*data["state"], *data["accelerations"], *data["reactions"]} and "guide" not in solved
    assert data["freedom"] == 5 and f"has {data['freedom']} degrees of freedom" in " ".join(equations.split())

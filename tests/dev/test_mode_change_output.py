"""What switches, on the command line: tables, the instants about opening events, named ends and exit codes."""

from __future__ import annotations

import json

import pytest

BALL = """\
freebody: 1
bodies:
  ball: {shape: particle, mass: 1 kg}
ground: {lines: {level: {through: O, angle: 0}}}
contacts:
  floor: {of: [ball.centre, ground.level], restitution: 0.7}
initial: {ball.x: 0, ball.y: 1 m, at_rest: true}
run: {until: 5 s}
"""
CRADLE = """\
freebody: 1
name: cradle
gravity: none
bodies: {"ball[i = 1 .. 3]": {shape: particle, mass: 1 kg}}
joints: {"track[i = 1 .. 3]": {type: slot, along: {through: ground.O, angle: 0}, point: "ball[i].centre", coordinate: "x[i]"}}
stops: {"gap[i = 1 .. 2]": {of: "x[i+1] - x[i]", least: 0.1 m, restitution: 1}}
initial: {"x[1]": -0.5 m, "x[2]": 0, "x[3]": 0.1 m, rates: {"x[1]": 1 m/s}}
run: {until: 1 s}
"""
CUT = """\
freebody: 1
bodies:
  bob: {shape: particle, mass: 2 kg}
ground: {points: {P: [0, 1 m]}}
strings:
  leash: {ends: [ground.P, bob.centre]}
initial: {bob.x: 0, bob.y: 0, at_rest: true, equilibrium: true}
events: {begin: {at: start, then: {cut: leash}}}
run: {until: 0.1 s}
"""


@pytest.fixture
def run_command(command, tmp_path):
    """Runs a command on the text of a model."""

    def tell(word, text, *more):
        path = tmp_path / "model.yaml"
        path.write_text(text)
        return command(word, str(path), *more, *(["--no-report"] if word == "run" else []))

    return tell


def test_of_many_changes_the_first_and_the_last_are_shown(run_command):
    done = run_command("run", BALL)
    lines = done.output.split("mode changes")[1].split("kinetic")[0].splitlines()
    times = [line.split()[0] for line in lines if "floor" in line]
    assert done.exit_code == 0 and len(times) == 15
    assert times[0] == "0.451524" and "more" in done.output and "rest" in done.output
    assert "work of impacts" in done.output and "ball free" not in done.output


def test_changes_are_json_too(run_command):
    data = json.loads(run_command("run", BALL, "--json").stdout)
    first, last = data["changes"][0], data["changes"][-1]
    assert first["kind"] == "impact" and first["of"] == ["floor"] and last["kind"] == "rest"
    assert first["impulses"]["contacts"]["floor"][1] == pytest.approx(1.7 * (2 * 9.81) ** 0.5)
    assert [peak["joint"] for peak in data["peaks"]] == ["floor"]


def test_an_undecided_impact_ends_the_run_by_name(run_command):
    done = run_command("run", CRADLE)
    assert done.exit_code == 3
    first, second, *lines = done.output.splitlines()
    assert first.startswith("cradle: simultaneous_impact, t = 0.4 s, at x[1] = -0.1")
    assert second.startswith("  `gap[1]` and `gap[2]` strike at once")
    assert any(line.startswith("  choose a rule, `impacts: newton`") for line in lines)


def test_what_is_violated_at_the_start_is_a_mistake(run_command):
    done = run_command("run", BALL.replace("ball.y: 1 m", "ball.y: -0.1 m"))
    assert done.exit_code == 2 and "`floor` is violated by 0.1 m at the start" in done.output + done.stderr


def test_solve_shows_both_sides_of_the_events_at_the_start(run_command):
    printed = run_command("solve", CUT).output
    before, after = printed.split("just after the events at the start")
    assert "just before the events at the start" in before and "taut" in before and "19.62" in before
    assert "released" in after and "off" in after and "-9.81" in after
    data = json.loads(run_command("solve", CUT, "--json").output)
    assert data["limits"]["leash"]["N"] == pytest.approx(19.62) and data["accelerations"]["bob.y"] == 0
    assert data["after_opening"]["accelerations"]["bob.y"] == pytest.approx(-9.81)


def test_validate_lists_what_can_touch_and_hold(run_command):
    assert "leash string ground – bob" in " ".join(run_command("validate", CUT).output.split())

"""The command line by itself: what it asks for, what it prints, how it ends."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from freebody.cli.models import pairs
from freebody.cli.user_errors import UserError, problems
from freebody.core import ModelError, MotionError

ROOT = Path(__file__).parents[2]
GUN = str(ROOT / "examples" / "new_gun.yaml")
DRIVEN = str(ROOT / "python/freebody/systems/19.3.16-block-with-a-rod/driven.yaml")
# What only shows when the motion is computed, and the item that is to blame.
AT_RUN_TIME = {
    "contradictory_motions": ("slow:", "fast:"),
    "contradictory_start": "drive:",
    "loop_that_cannot_close": "C:",
    "no_equilibrium": "initial:",
    "spin_without_inertia": "crank:",
}
COMMANDS = [
    "run",
    "solve",
    "validate",
    "animate",
    "compare",
    "certify",
    "systems",
    "code",
    "find",
    "stability",
    "schema",
    "version",
]


def test_help_names_every_command(command):
    printed = command("--help").output
    assert all(name in printed for name in COMMANDS)


def test_help_loads_no_number_cruncher():
    code = "import sys, freebody.cli; print({'numpy', 'matplotlib', 'pint', 'pydantic', 'sympy'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "set()"


def test_run_says_what_happened(command):
    done = command("run", GUN, "--no-report", "--until", "2 s", "--rtol", "1e-8")
    assert done.exit_code == 0
    for words in ("new gun: the event `leaves` ended the run, t = 1.14724 s", "exit speed", "2.36899", "work of motor", "pivot"):
        assert words in done.output
    assert "-0 " not in done.output and "parameter changes" not in done.output


def test_code_is_printed_or_written(command, tmp_path):
    printed = command("code", GUN, "--set", "l=2 m")
    assert printed.exit_code == 0 and "'l': 2.0,  # [m]" in printed.output and "def accelerations(" in printed.output
    assert "int accelerations(" in command("code", GUN, "--c").output
    written = tmp_path / "gun.c"
    assert command("code", GUN, "-o", str(written)).exit_code == 0
    assert "int accelerations(" in written.read_text(encoding="utf-8")
    refused = command("code", str(ROOT / "examples" / "tossed_box.yaml"))
    assert refused.exit_code == 2 and "contacts.floor opens and closes" in refused.output


def test_run_as_json_is_json(command, tmp_path):
    done = command("run", GUN, "--no-report", "--json", "-o", str(tmp_path / "run.csv"))
    data = json.loads(done.stdout)
    assert data["outcome"]["ok"] and data["report"]["exit speed"]["unit"] == "m/s"
    assert [peak["couple"] for peak in data["peaks"]] == [None, None]
    assert data["files"] == [str(tmp_path / "run.csv")] and (tmp_path / "run.csv").exists()


def test_a_bad_end_is_code_3_and_says_when_and_where(command, bursting):
    done = command("run", bursting, "--no-report")
    assert done.exit_code == 3
    stated = " ".join(done.output.split())
    assert (
        "StepUnderflow, t = " in stated
        and ", at ball.x = " in stated
        and "the tolerance asks for" in stated
        and "Traceback" not in stated
    )


def test_solve_hands_the_state_on(command):
    printed = command("solve", GUN, "--at", "R=0.5 m", "--set", "T=0").output
    assert "accelerations" in printed and "momentum balances" not in printed


def test_the_assembly_that_was_taken_is_said_with_the_others(command, tmp_path):
    """A slider-crank closes on either side of the crank: x = r cos θ ± √(l² − r² sin² θ)."""
    path = tmp_path / "crank.yaml"
    path.write_text("""
freebody: 1
gravity: none
bodies:
  crank: {shape: rod, length: 75 mm, mass: 1}
  rod: {shape: rod, length: 200 mm, mass: 3}
  piston: {shape: particle, mass: 1.5}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: beta}
  D: {type: hinge, of: [rod.end, piston.centre]}
  guide: {type: slot, along: {through: ground.O, angle: 0}, point: piston.centre, coordinate: x}
initial: {theta: 30 deg}
run: {until: 1 ms}
""")
    places = [f"x = {0.075 * np.sqrt(0.75) + side * np.sqrt(0.2**2 - 0.0375**2):.6f}" for side in (-1, 1)]
    for called in (["solve"], ["validate"], ["run", "--no-report"]):
        shown = command(called[0], str(path), *called[1:]).stdout
        words = ("assembled: theta", "other assembly: ")
        taken, other = (next(line for line in shown.splitlines() if line.startswith(word)) for word in words)
        assert sorted(place for place in places for line in (taken, other) if place in line) == sorted(places)
    solved = json.loads(command("solve", str(path), "--json").stdout)
    assert len(solved["assembly"]) == 2 and f"x = {solved['state']['x']:.6f}" in solved["assembly"][0]


def test_solve_by_all_routes_says_how_far_they_agree(command):
    printed = command("solve", GUN, "--route", "all", "--balance").output
    assert "newton_euler agrees with minimal to " in printed and "constraints agrees with minimal" in printed
    assert "momentum balances" in printed


def test_solve_never_makes_a_number_of_what_is_indeterminate(command, door):
    data = json.loads(command("solve", door, "--json").output)
    assert data["reactions"]["upper"] == {"on": "door[1]", "Fx": None, "Fy": None, "M": 0.0}
    assert "indeterminate" in command("solve", door, "--axes", "joint").output
    assert "indeterminate" in command("run", door, "--no-report").output


def test_validate_takes_no_name_for_markup(command, door):
    printed = command("validate", door).output
    assert "door[1]" in printed and "no friction" in printed and "1 degree of freedom" in printed


def test_validate_tells_prescribed_motions_and_draws(command, tmp_path):
    done = command("validate", DRIVEN, "-o", str(tmp_path / "m.svg"))
    assert "prescribed motions" in done.output and f"wrote {tmp_path / 'm.svg'}" in done.output.replace("\n", "")
    assert (tmp_path / "m.svg").exists()


@pytest.mark.parametrize(("line", "value"), [(30, 10), (-50, 20), (0, 40), (150, -70)])
def test_an_angle_is_said_as_it_is_measured(command, tmp_path, line, value):
    """The angle on a slot counts from its line: the body stands at the angles of both together."""
    path = tmp_path / "slot.yaml"
    path.write_text(f"""
freebody: 1
ground: {{lines: {{way: {{through: O, angle: {line} deg}}}}}}
bodies: {{b: {{shape: rod, length: 1, mass: 1}}}}
joints: {{t: {{type: slot, along: ground.way, point: b.start, coordinates: [s, phi]}}}}
initial: {{s: 0, phi: {value} deg, at_rest: true}}
report: {{a: angle(b)}}
run: {{until: 1 ns}}
""")
    started = json.loads(command("run", str(path), "--no-report", "--json").stdout)["report"]["a"]["value"]
    assert np.degrees(started) == pytest.approx(line + value)
    coordinates = json.loads(command("validate", str(path), "--json").stdout)["coordinates"]
    doc = next(each["doc"] for each in coordinates if each["name"] == "phi")
    assert (f"from the direction at {line}° to" in doc) if line else ("from `ground`" in doc)


def test_equal_runs_are_told_in_a_line(command, tmp_path):
    saved = str(tmp_path / "run.csv")
    command("run", GUN, "--no-report", "-o", saved)
    assert "are the same at all" in command("compare", saved, saved).output


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "wrong").glob("*.yaml")), ids=lambda path: path.stem)
def test_a_wrong_model_is_said_with_a_hint(command, path):
    done = command("run", str(path), "--no-report")
    print(done.output)  # pytest -s shows what a newcomer reads
    assert done.exit_code == 2 and "Traceback" not in done.output
    assert len(done.output.strip().splitlines()) >= 2, "what is wrong, then what to try"
    named = re.match(rf".*{path.name}:(\d+):\d+: ", done.output)
    assert named or path.stem == "division_by_nothing", "that one only shows in the numbers"
    if path.stem in AT_RUN_TIME:
        assert path.read_text().splitlines()[int(named[1]) - 1].strip().startswith(AT_RUN_TIME[path.stem])


@pytest.mark.parametrize("text", ["theta", "=3", "theta=", ""])
def test_a_change_needs_a_name_and_a_value(text):
    with pytest.raises(UserError):
        pairs([text])


def test_a_value_may_hold_an_equals_sign():
    assert pairs([" k = if(a == 1, 2, 3) "]) == {"k": "if(a == 1, 2, 3)"}


def test_a_missing_file_is_said_in_a_line(command):
    done = command("compare", "nowhere.csv", "nowhere.csv")
    assert done.exit_code == 2
    assert "nowhere.csv" in done.output and "Traceback" not in done.output


@pytest.mark.parametrize(
    "error, said",
    [
        (
            ModelError("joints.pivot.of[1]", "no point is called rod.Z", "did you mean rod.A?"),
            "joints.pivot.of[1]: no point",
        ),
        (MotionError("cannot_assemble", "", "the loop stays open by 2 mm", "give a guess"), "the loop stays open"),
        (RuntimeError("an MP4 needs ffmpeg"), "an MP4 needs"),
        (ValueError("until must be positive"), "until must be positive"),
    ],
)
def test_what_a_user_can_mend_is_reported(error, said):
    (problem,) = problems(error)
    assert f"{problem.where.path}: {problem.what}".removeprefix(": ").startswith(said)


@pytest.mark.parametrize("error", [KeyError("x"), IndexError(), TypeError("x"), RecursionError(), AssertionError()])
def test_our_own_slips_are_not_hidden(error):
    assert problems(error) is None


def test_version_is_the_installed_one(command):
    assert command("version").output.strip()[0].isdigit()


def test_a_model_that_hands_over_is_shown_with_its_successor(command, handing, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = command("run", handing, "-o", str(tmp_path / "run.csv"))
    assert done.exit_code == 0
    assert done.output.index("the event `over` ended the run") < done.output.index("the end time was reached")
    assert {"run.csv", "run-2.csv", "first.html", "first-2.html"} <= {path.name for path in tmp_path.iterdir()}
    both = json.loads(command("run", handing, "--no-report", "--json").stdout)
    assert [run["outcome"]["name"] for run in both] == ["StoppedByEvent", "Completed"]


def test_find_says_all_values_none_and_extremes(command):
    asked = ("find", GUN, "--of", "t @ leaves")
    found = command(*asked, "--is", "1 s", "--vary", "T=0.5..3", "--points", "9", "--json")
    (root,) = json.loads(found.stdout)["roots"]
    assert root["found"] == pytest.approx(1, abs=1e-9) and root["where_error"] < 1e-8 and found.exit_code == 0
    none = command(*asked, "--is", "9 s", "--vary", "T=0.5..3", "--points", "9")
    assert none.exit_code == 3 and "t @ leaves is 9 s for no T between 0.5 and 3 N*m" in none.output
    best = command(*asked, "--vary", "T=0.5..3", "--points", "9")
    assert best.exit_code == 0 and "least" in best.output and "(an edge)" in best.output
    assert command(*asked, "--vary", "T").exit_code == 2
    assert command("find", GUN, "--of", "R", "--limit").exit_code == 2

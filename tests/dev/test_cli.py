"""The command line by itself: what it asks for, what it prints, how it ends."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

from freebody import _core, cli
from freebody.cli.mistakes import Mistake, explained

COMMANDS = ["run", "solve", "validate", "animate", "compare", "systems", "schema", "version"]


def test_help_names_every_command(command):
    printed = command("--help").output
    assert all(name in printed for name in COMMANDS)


def test_help_loads_no_number_cruncher():
    code = "import sys, freebody.cli; print({'numpy', 'matplotlib', 'pint', 'pydantic', 'sympy'} & set(sys.modules))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "set()"


def test_run_says_what_happened(command, mechanism):
    done = command("run", "m.yaml", "--no-report", "--until", "200 ms", "--rtol", "1e-6")
    assert done.exit_code == 0
    assert mechanism.asked == {"until": "200 ms", "rtol": 1e-6}
    for words in ("pendulum: It ran.", "bottom", "top speed", "m/s", "up did not happen", "1.0e-12", "58.9", "indeterminate"):
        assert words in done.output


def test_run_as_json_is_json(command, mechanism, tmp_path):
    done = command("run", "m.yaml", "--no-report", "--json", "-o", str(tmp_path / "run.csv"))
    data = json.loads(done.stdout)
    assert data["outcome"]["ok"] and data["report"]["top speed"]["value"] == 4.43
    assert data["peaks"]["pivot"]["couple"]["value"] is None
    assert data["files"] == [str(tmp_path / "run.csv")] and (tmp_path / "run.csv").exists()


def test_a_bad_end_is_code_3_and_its_sentence(command, mechanism, monkeypatch):
    mechanism.__init__(ok=False)
    done = command("run", "m.yaml", "--no-report")
    assert done.exit_code == 3
    assert "It broke at t = 1 s." in done.output


def test_solve_hands_the_state_on(command, mechanism):
    done = command("solve", "m.yaml", "--at", "theta=30 deg", "--at", "arm.x = 1 m")
    assert mechanism.asked == {"theta": "30 deg", "arm.x": "1 m"}
    assert "ACCELERATIONS" in done.output and "RESIDUALS" not in done.output


def test_solve_by_all_routes_says_how_far_they_agree(command, mechanism):
    printed = command("solve", "m.yaml", "--route", "all", "--balance").output
    assert "newton_euler agrees with minimal to 0.0e+00" in printed
    assert "constraints agrees with minimal" in printed
    assert "RESIDUALS" in printed


def test_solve_never_makes_a_number_of_what_is_indeterminate(command, mechanism):
    data = json.loads(command("solve", "m.yaml", "--json", "--axes", "joint").output)
    assert data["reactions"]["pivot"] == {"on": "bob [1]", "Fs": 5.0, "Fn": 0.0, "M": None}
    assert "indeterminate" in command("solve", "m.yaml", "--axes", "joint").output


def test_validate_takes_no_name_for_markup(command, mechanism):
    printed = command("validate", "m.yaml").output
    assert "bob [1]" in printed and "no friction" in printed and "degrees of freedom: 1" in printed


def test_validate_draws(command, mechanism, tmp_path):
    assert f"wrote {tmp_path / 'm.svg'}" in command("validate", "m.yaml", "-o", str(tmp_path / "m.svg")).output
    assert (tmp_path / "m.svg").exists()


@pytest.mark.parametrize("text", ["theta", "=3", "theta=", ""])
def test_a_change_needs_a_name_and_a_value(text):
    with pytest.raises(Mistake):
        cli.pairs([text])


def test_a_value_may_hold_an_equals_sign():
    assert cli.pairs([" k = if(a == 1, 2, 3) "]) == {"k": "if(a == 1, 2, 3)"}


def test_a_missing_file_is_said_in_a_line(command):
    done = command("compare", "nowhere.csv", "nowhere.csv")
    assert done.exit_code == 2
    assert "nowhere.csv" in done.output and "Traceback" not in done.output


@pytest.mark.parametrize(
    "error, told",
    [
        (
            _core.ModelError("joints.pivot.of[1]", "no point is called rod.Z", "did you mean rod.A?"),
            "joints.pivot.of[1]: no point",
        ),
        (_core.MotionError("cannot_assemble", "the loop stays open by 2 mm", "give a guess"), "the loop stays open"),
        (RuntimeError("an MP4 needs ffmpeg"), "an MP4 needs"),
        (ValueError("until must be positive"), "until must be positive"),
    ],
)
def test_what_a_user_can_mend_is_told(error, told):
    assert explained(error).startswith(told)


@pytest.mark.parametrize("error", [KeyError("x"), IndexError(), TypeError("x"), RecursionError(), AssertionError()])
def test_our_own_slips_are_not_hidden(error):
    assert explained(error) is None


def test_version_is_the_installed_one(command):
    assert command("version").output.strip()[0].isdigit()

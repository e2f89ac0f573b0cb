"""Figures in the user's units: what is shown is the SI figure over the size of its unit, head and rows alike; data stays in SI."""

from __future__ import annotations

import base64
import json

import numpy as np
import pytest
from typer.testing import CliRunner

import freebody as fb
from freebody.cli import app
from freebody.model.errors import ModelProblem
from freebody.model.user_units import choice, shown
from freebody.solve.figures import Known
from freebody.solve.rich_tables import captured, table
from freebody.views import plots
from freebody.views.report import report_html
from freebody.views.report.data import report_data

FOOT, POUND_FORCE = 0.3048, 0.45359237 * 9.80665
"""Their definitions: m, and N."""


@pytest.mark.parametrize(
    ("text", "unit", "expected", "size"),
    [
        ("lb-ft", "m", "ft", FOOT),
        ("lb-ft", "N*m", "lbf*ft", POUND_FORCE * FOOT),
        ("lb-ft", "J", "lbf*ft", POUND_FORCE * FOOT),
        ("lb-ft", "W", "lbf*ft/s", POUND_FORCE * FOOT),
        ("lb-ft", "kg·m²", "slug·ft²", POUND_FORCE * FOOT),  # a slug is lbf s²/ft
        ("lb-ft", "rad/s", "rad/s", 1.0),
        ("lb-ft, deg", "rad/s²", "deg/s²", 3.141592653589793 / 180),
        ("N-mm", "N*m", "N*mm", 1e-3),
        ("N-mm", "m/s^2", "mm/s^2", 1e-3),
        ("rpm", "rad/s", "rpm", 3.141592653589793 / 30),
        ("rpm", "rad", "rad", 1.0),
        ("kJ", "J", "kJ", 1e3),
        ("kJ", "N*m", "N*m", 1.0),  # a couple is no energy
        ("SI", "N", "N", 1.0),
    ],
)
def test_a_unit_is_shown_in_another_of_its_kind(text, unit, expected, size):
    with fb.units(text):
        assert shown(unit) == (expected, pytest.approx(size, rel=1e-15))
    assert shown(unit) == (unit, 1.0)


@pytest.mark.parametrize("text", ["lb-foot", "mm, in", "lb-ft, m"])
def test_a_choice_that_is_none_is_refused(text):
    with pytest.raises(ModelProblem):
        choice(text)


def test_a_table_turns_heads_and_rows_and_leaves_what_is_text():
    rows = [("a", 0.3048, 1.0, "N", "1e-3"), ("b", None, 2.0, "rad", "2e-3")]
    with fb.units("lb-ft"):
        made = captured(table("", ["", "x [m]", "value", "unit", "rest [N]"], rows), 90).split()
    assert made[:8] == ["x", "[ft]", "value", "unit", "rest", "[N]", made[6], "a"]
    assert made[8:] == ["1", "0.224809", "lbf", "1e-3", "b", "2", "rad", "2e-3"]


def test_digits_that_hold_are_no_others_in_another_unit():
    with fb.units("N-mm"):
        assert "2.00e+03" in captured(table("", ["x [m]"], [(Known(2.0001, 1e-3, 2.0),)]), 90)


MODEL = """
freebody: 1
units: lb-ft
bodies: {block: {shape: particle, mass: 2 kg}}
joints: {track: {type: slot, point: block.centre, along: {through: ground.O, angle: 0}, coordinate: s}}
initial: {s: 3.048 m}
run: {until: 0.1 s}
"""


def test_a_file_wishes_an_option_decides_and_json_is_si(tmp_path):
    path = tmp_path / "block.yaml"
    path.write_text(MODEL)

    def solved(*options: str) -> str:
        done = CliRunner().invoke(app, ["solve", str(path), *options])
        assert done.exit_code == 0, done.output
        return done.stdout

    assert "19.62" in solved("--units", "SI") and "[lbf]" not in solved("--units", "SI")
    assert "[lbf]" in solved() and f"{19.62 / POUND_FORCE:.6g}" in solved() and "[N]" not in solved()
    data = json.loads(solved("--json"))
    assert data["reactions"]["track"]["Fy"] == pytest.approx(19.62)


def test_what_a_motion_takes_is_told_in_units_of_choice():
    """A drive that is held at a constant speed against a weight, at 0: m g l of torque, and a pin that carries m g."""
    model = fb.Mechanism("arm")
    arm = model.body("arm", shape="general", mass="2 kg", inertia="1 kg*m^2", centre=["0.5 m", 0], points={"A": [0, 0]})
    model.hinge(model.ground.O, arm.A, name="pin", coordinate="theta")
    model.motion("drive", "theta", "0*t")
    with fb.units("lb-ft"):
        told = captured(model.solve().tables()[4], 90)
    assert f"{9.81 / POUND_FORCE / FOOT:.6g}" in told and "lbf*ft" in told


def test_plots_are_in_the_units_of_their_axes():
    run = fb.Mechanism.loads(MODEL).simulate()
    with fb.units("lb-ft"):
        ax = plots.series(run, "s")
    assert ax.get_ylabel().endswith("[ft]") and ax.lines[0].get_ydata()[0] == pytest.approx(10.0)


def test_a_report_is_in_units_of_choice():
    """Plots and tables have them; the page turns the rest, the numbers of its arrows, by what it is told."""
    run = fb.Mechanism.loads(MODEL).simulate()
    with fb.units("lb-ft"):
        data, page = report_data(run), report_html(run)
    place, force = (next(plot for plot in data["plots"] if plot["title"].startswith(title)) for title in ("Coord", "React"))
    first = [np.frombuffer(base64.b64decode(plot["curves"][0]["y"]), "<f4")[0] for plot in (place, force)]
    assert (place["unit"], force["unit"]) == ("ft", "lbf") and first == pytest.approx([10.0, 19.62 / POUND_FORCE])
    assert data["units"]["N*m"] == {"unit": "lbf·ft", "size": pytest.approx(POUND_FORCE * FOOT)}
    peak = "".join(f'<td class="number">{19.62 / POUND_FORCE:.6g}</td>')
    assert (
        peak in page
        and "force / lbf" in page
        and "Figures in ft, slug" in page
        and "SI units and radians; x right" in report_html(run)
    )


def test_columns_of_choice_have_their_units_in_their_heads(tmp_path):
    run = fb.Mechanism.loads(MODEL).simulate()
    with fb.units("lb-ft"):
        table = run.to_pandas("block.centre", "track.F")
        lines = run.save(tmp_path / "table.csv", "block.centre", "track.F").read_text().splitlines()
    assert list(table) == ["x(block.centre) [ft]", "y(block.centre) [ft]", "track.F [lbf]"]
    assert lines[0] == ",".join(["t [s]", *table]) and len(lines) == len(run.t) + 1
    last = [float(figure) for figure in lines[-1].split(",")]
    assert last == [0.1, *table.iloc[-1]] == pytest.approx([0.1, 10.0, 0.0, 19.62 / POUND_FORCE])
    with pytest.raises(ValueError, match=r"written as \.csv or \.svg, not '\.nc'"):
        run.save(tmp_path / "table.nc", "track.F")


RESTING = """
freebody: 1
parameters: {k: 98.1 N/m, c: 1 N*s/m, F: 1 N, Omega: 10 rad/s}
bodies: {block: {shape: particle, mass: 1 kg}}
joints: {track: {type: slot, point: block.centre, along: {through: ground.O, angle: 90 deg}, coordinate: s}}
forces: {spring: {type: spring, along: s, stiffness: k}, push: {type: law, along: s, value: F*sin(Omega*t) - c*rate(s)}}
initial: {s: -0.1 m}
"""


def test_rest_and_motions_that_come_back_are_in_units_of_choice(tmp_path):
    """A weight on a spring rests at −m g/k = −0.1 m; pushed to and fro it comes back after 2 π/10 s."""
    (still := tmp_path / "still.yaml").write_text(RESTING.replace("F*sin(Omega*t)", "0"))
    (pushed := tmp_path / "pushed.yaml").write_text(RESTING)

    def told(*asked: object) -> list[str]:
        done = CliRunner().invoke(app, [*map(str, asked), "--units", "mm, ms"])
        assert done.exit_code == 0, done.output
        return done.output.split()

    words = told("stability", still)
    assert words[words.index("s") : words.index("s") + 3] == ["s", "-100", "mm"]
    words = told("periodic", pushed, "--period", "2*pi/Omega")
    assert words[words.index("after") + 1 :][:2] == ["628.318530718", "ms,"]
    assert words[words.index("s") + 2] == "mm"

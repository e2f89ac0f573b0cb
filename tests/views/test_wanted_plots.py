"""Plots that a model asks for: the same curves in the report and in matplotlib."""

import base64

import numpy as np
import pytest

from freebody import Mechanism
from freebody.model.errors import ModelFileError
from freebody.views.plots import wanted
from freebody.views.report.series import plots

MODEL = """
freebody: 1
bodies: {rod: {shape: rod, length: 1, mass: 1}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
initial: {theta: 1}
run: {until: 1 s}
plots:
  speeds: [speed(rod.end), speed(rod.centre)]
  force over the angle: {of: pin.F, over: theta}
  hodograph: {of: speed(rod.end), around: theta}
"""


@pytest.fixture(scope="module")
def run():
    return Mechanism.loads(MODEL).simulate()


def numbers(told):
    return np.frombuffer(base64.b64decode(told), "<f4")


def test_they_stand_first_in_the_report_with_the_values_of_the_run(run):
    speeds, force, hodograph = plots(run)[:3]
    assert [plot["title"] for plot in (speeds, force, hodograph)] == ["speeds", "force over the angle", "hodograph"]
    assert [curve["name"] for curve in speeds["curves"]] == ["speed(rod.end)", "speed(rod.centre)"] and "across" not in speeds
    t = numbers(force["t"]).astype(float)
    assert numbers(force["curves"][0]["y"]) == pytest.approx(run.evaluate("pin.F", t), rel=1e-4)
    assert numbers(force["across"]["y"]) == pytest.approx(run["theta"][np.searchsorted(run.t, t - 1e-6)], rel=1e-4)
    assert (force["across"]["around"], hodograph["across"]["around"], hodograph["unit"]) == (False, True, "m/s")


@pytest.mark.parametrize(
    ("title", "lines", "across"), [("speeds", 2, "t"), ("force over the angle", 3, "theta"), ("hodograph", 1, "theta")]
)
def test_they_are_the_same_in_matplotlib(run, title, lines, across):
    ax = wanted(run, title)
    assert ax.get_title("left") == title and len(ax.lines) >= lines
    x = ax.lines[0].get_xdata()
    assert np.nanmax(x) == pytest.approx(run[across].max())


@pytest.mark.parametrize(
    ("plot", "what"),
    [("[speed(rod.end), theta]", "measure the same"), ("{of: theta}", "either `over`"), ("{of: a + , over: t}", "no expression")],
)
def test_a_plot_that_cannot_be_is_refused(plot, what):
    with pytest.raises(ModelFileError, match=what):
        Mechanism.loads(MODEL + f"  wrong: {plot}\n").simulate()


def test_one_that_is_not_there_is_told_which_are(run):
    with pytest.raises(KeyError, match="there are speeds"):
        wanted(run, "nothing")

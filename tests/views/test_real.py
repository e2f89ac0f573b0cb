"""A run of the real core, as everything that reads runs sees it."""

from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.axes import Axes

from freebody.mechanism import Mechanism
from freebody.run.peaks import peak_reactions
from freebody.run.simulation import Run
from freebody.views import plots, shapes
from freebody.views.labels import Label, Obstacles, placed
from freebody.views.report import report_html

matplotlib.use("Agg")

ROOT = Path(__file__).parents[2]
MODEL = ROOT / "examples" / "four_bar.yaml"
SLIDER = ROOT / "systems" / "GEN-SLIDER-slider-crank" / "model.yaml"


@pytest.fixture(scope="module")
def mechanism():
    return Mechanism.load(MODEL)


@pytest.fixture(scope="module")
def run(mechanism):
    return mechanism.simulate(until=0.5)


PLOTS = {
    "series": lambda run: plots.series(run),
    "two units": lambda run: plots.series(run, "theta", "rate(theta)"),
    "phase": lambda run: plots.phase(run, "theta"),
    "against": lambda run: plots.against(run, "theta", "phi"),
    "polar": lambda run: plots.polar(run, "theta", "phi"),
    "paths": lambda run: plots.paths(run),
    "energy": lambda run: plots.energy(run),
    "reactions": lambda run: plots.reactions(run),
    "couples": lambda run: plots.reactions(run, "A", part="M"),
    "overlay": lambda run: plots.overlay(run, run, ["theta"]),
}


@pytest.mark.parametrize("plot", PLOTS.values(), ids=PLOTS)
def test_every_plot_is_drawn(plot, run):
    ax = plot(run)
    assert isinstance(ax, Axes) and ax.lines
    ax.figure.canvas.draw()


def test_the_drawing_shows_the_whole_mechanism(mechanism):
    texts = {text.get_text() for text in mechanism.drawing().texts}
    assert {"crank", "coupler", "rocker", "A", "B", "C", "D"} <= texts


def test_a_label_keeps_off_narrow_places_between_lines():
    lines = shapes.dense([np.array([[-200.0, y], [200.0, y]]) for y in (-6.0, 6.0)])
    [label] = placed([Label("C", np.zeros((1, 2)))], Obstacles.of((lines, 8.0)))
    assert abs(label.centre[1]) > 6.0 + label.half[1]


def test_a_label_stays_within_the_frame():
    frame = np.array([[0.0, 0.0], [100.0, 50.0]])
    for label in placed([Label("a long label", np.array([[98.0, 49.0]]))], Obstacles.of((frame, 1.0)), frame):
        assert (label.centre - label.half >= frame[0]).all() and (label.centre + label.half <= frame[1]).all()


def test_what_rounding_left_of_a_couple_is_not_shown():
    run = Mechanism.load(SLIDER).simulate(until=0.2)
    assert run.reactions["guide"].M.any(), "round-off is there"
    assert {peak.joint: peak.couple for peak in peak_reactions(run)}["guide"] == 0.0
    page = report_html(run)
    assert "Reactions, couple" not in page and "<aside></aside>" in page


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_a_saved_run_comes_back(suffix, run, tmp_path):
    back = Run.load(run.save(tmp_path / f"run{suffix}"))
    assert np.array_equal(back.t, run.t)
    for kind, block in run.blocks.items():
        assert np.array_equal(back.blocks[kind], block, equal_nan=True), kind
    for part in ("columns", "events", "outcome", "report", "settings", "stats"):
        assert getattr(back, part) == getattr(run, part), part


def test_going_on_is_the_same_as_not_stopping(mechanism, run):
    rest = mechanism.simulate(until=0.2).continue_(0.5)
    assert rest.t[0] == 0.2 and rest.t[-1] == 0.5
    assert rest.q[-1] == pytest.approx(run.q[-1], abs=1e-9)
    assert rest.u[-1] == pytest.approx(run.u[-1], abs=1e-9)


def test_tables(run):
    data, table = run.to_xarray(), run.to_pandas()
    assert dict(data.sizes) == {"time": len(run.t), "coordinate": 3, "joint": 4, "part": 3, "ledger": 5, "body": 3, "place": 3}
    assert list(data["coordinate"].values) == run.coordinates
    assert list(table.columns) == [column.name for column in run.columns]
    assert np.array_equal(table["phi"], data["q"].sel(coordinate="phi"))

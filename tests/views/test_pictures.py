"""Plots, scenes, drawings and animations: structure, and that nothing is shown or left open."""

import base64
import json
import shutil
from itertools import combinations

import numpy as np
import pytest

from freebody.mechanism import Mechanism
from freebody.views import animate as animation
from freebody.views import plots, shapes
from freebody.views.animate import animate
from freebody.views.diagram import diagram
from freebody.views.draw import drawing
from freebody.views.render import height
from freebody.views.report.data import report_data
from freebody.views.scene import drawn, of_run
from freebody.views.sketch import sketch_of_state

from .models import run_double_pendulum
from .zoo import zoo


@pytest.mark.parametrize(
    "plot",
    [
        lambda run, ax: plots.series(run, ax=ax),
        lambda run, ax: plots.series(run, "theta", "rate(theta)", ax=ax),
        lambda run, ax: plots.phase(run, "theta", ax=ax),
        lambda run, ax: plots.against(run, "theta", "'main bearing'.F", ax=ax),
        lambda run, ax: plots.paths(run, ax=ax),
        lambda run, ax: plots.energy(run, ax=ax),
        lambda run, ax: plots.reactions(run, ax=ax),
    ],
)
def test_plots_draw_on_the_given_axes(plot, four_bar):
    from matplotlib.figure import Figure

    ax = Figure().add_subplot()
    assert plot(four_bar, ax) is ax and ax.lines and ax.get_xlabel() and ax.get_ylabel()
    fresh = plot(four_bar, None)
    fresh.figure.canvas.draw()


def test_polar_makes_its_own_axes(four_bar):
    assert plots.polar(four_bar, "theta", "'main bearing'.F").name == "polar"


def test_plots_leave_no_figure_open(four_bar):
    import matplotlib.pyplot as plt

    plots.series(four_bar)
    drawing(four_bar.source, four_bar.start)
    assert not plt.get_fignums()


def test_three_units_are_refused(four_bar):
    with pytest.raises(ValueError, match="3 units"):
        plots.series(four_bar, "theta", "rate(theta)", "'main bearing'.Fx")


def test_an_indeterminate_reaction_is_named_not_drawn(indeterminate):
    ax = plots.reactions(indeterminate)
    assert "knee" in ax.get_title(loc="left") and [line.get_label() for line in ax.lines][:1] == ["pivot"]


def test_units_are_written_as_people_do():
    assert plots.pretty_unit("N*m/s^2") == "N·m/s²" and plots.with_unit("x", "m") == "x  [m]"


def test_names_that_look_like_mathematics_are_drawn():
    run = run_double_pendulum(until=0.1, upper="50% $a_b^c")
    plots.series(run).figure.canvas.draw()
    drawing(run.source, run.start).figure.canvas.draw()
    free = run.instant(0.0).free_bodies()
    assert "<svg" in diagram(run.source, run.start, free).svg()


def test_rounded_hull_keeps_its_distance():
    hull = shapes.rounded_hull(np.array([[0, 0], [2, 0], [1, 1], [1, 0.3]]), 0.1)
    assert (np.hypot(*(hull - [2, 0]).T) >= 0.1 - 1e-12).all()
    assert hull[:, 1].min() == pytest.approx(-0.1, abs=1e-3) and hull[:, 0].max() == pytest.approx(2.1, abs=1e-3)
    assert np.hypot(*(shapes.rounded_hull(np.array([[1.0, 2.0]]), 0.5) - [1.0, 2.0]).T) == pytest.approx(0.5)
    assert np.ptp(shapes.rounded_hull(np.array([[0, 0], [1, 0]]), 0.2), axis=0) == pytest.approx([1.4, 0.4], abs=1e-2)


def test_a_scene_is_data(four_bar):
    stated = json.loads(json.dumps(report_data(four_bar), allow_nan=False))["scene"]
    assert [figure["name"] for figure in stated["figures"]] == ["ground", "crank", "coupler", "rocker"]
    assert len(base64.b64decode(stated["poses"])) == 4 * 12 * len(stated["t"])
    assert stated["pairs"][0]["kind"] == "spring" and stated["traced"] == ["coupler.P"]
    assert "coupler.P" in [point["name"] for point in stated["points"]]
    scene = of_run(four_bar, four_bar.t[::20])
    assert scene.pair_lines(scene.pairs[0])[0][-1] == pytest.approx([1.25, 0.75])


def test_a_scene_of_a_state_is_that_of_the_run(four_bar):
    one, many = drawn(sketch_of_state(four_bar.source, four_bar.start)), of_run(four_bar)
    assert one.poses[0] == pytest.approx(many.poses[0]) and len(one.figures) == len(many.figures)


@pytest.mark.long
def test_every_joint_symbol_can_be_drawn():
    source, state = zoo()
    scene = drawn(sketch_of_state(source, state))
    styles = {stroke.style for figure in scene.figures.values() for stroke in figure.strokes}
    assert {"body", "band", "mass", "mark", "slot", "pin", "weld", "rail", "hatch", "dash", "block"} <= styles
    assert {pair.kind for pair in scene.pairs} == {"spring", "damper", "link", "belt"}
    drawing(source, state)


def test_a_drawing_names_everything_and_no_two_labels_overlap(four_bar):
    ax = drawing(four_bar.source, four_bar.start)
    stated = {text.get_text() for text in ax.texts}
    boxes = [text.get_window_extent() for text in ax.texts if text.get_label() == "label"]
    assert len(boxes) > 10 and not any(a.overlaps(b) for a, b in combinations(boxes, 2))
    assert {"crank", "coupler", "rocker", "main bearing", "crank pin", "motor", "return spring", "coupler.P", "x", "y"} <= stated
    assert "θ = 57.3°" in stated


def guided_blocks() -> Mechanism:
    """Two blocks on one rail with a spring between their coordinates; the first is pulled by its left side and pushed by its right."""
    m = Mechanism("blocks")
    rail = m.ground.line("rail", m.ground.O, angle=0)
    for name in ("first", "second"):
        block = m.rectangle(name, mass=1, width=0.8, height=0.5)
        m.slider(along=rail, line=block.line("base", block.centre, angle=0), coordinate=f"x_{name}")
        for side, at in (("left", -0.4), ("right", 0.4)):
            point = block.point(side, [at, 0])
            m.force(name=f"{name} {side}", at=point, x=-2)
    m.spring(name="spring", along="x_second - x_first", stiffness=5, rest_length=2)
    m.initial(x_first=0, x_second=3, at_rest=True)
    return m


def test_a_spring_along_the_difference_of_coordinates_lies_between_what_they_measure():
    m = guided_blocks()
    state, notes = m.start()
    sketch = drawn(sketch_of_state(m.source(notes), state))
    [spring] = [pair for pair in sketch.pairs if pair.name == "spring"]
    ends = [sketch.moved(sketch.names[i], np.array([[x, y]]))[0] for i, x, y in spring.ends]
    np.testing.assert_allclose(ends, [[0, 0], [3, 0]], atol=1e-12)


def test_a_force_that_pulls_begins_where_it_acts_and_one_that_pushes_ends_there():
    ax = guided_blocks().drawing(layers=["forces"])
    arrows = [(note.xyann[0], note.xy[0]) for note in ax.texts if note.get_text() == "" and note.xyann[0] - note.xy[0] > 0.1]
    for place, pulls in ((-0.4, True), (0.4, False), (2.6, True), (3.4, False)):
        assert any((start if pulls else end) == pytest.approx(place, abs=1e-9) for start, end in arrows)


def test_lines_of_ground_lie_behind_bodies():
    assert height("rail", "ground") < height("body", "crate") < height("rail", "crate")


def test_gif_and_frames(pendulum, tmp_path):
    from PIL import Image

    gif = Image.open(animate(pendulum, tmp_path / "run.gif", fps=10, speed=2))
    assert gif.n_frames == 11
    first = animate(pendulum, tmp_path / "frame.svg", fps=2)
    assert first.name == "frame_0.svg" and len(list(tmp_path.glob("frame_*.svg"))) == 5
    with pytest.raises(ValueError, match=r"\.gif, \.mp4 or \.svg"):
        animate(pendulum, tmp_path / "run.avi")


def test_mp4_where_ffmpeg_is(pendulum, tmp_path, monkeypatch):
    if shutil.which("ffmpeg"):
        assert animate(pendulum, tmp_path / "run.mp4", fps=10).stat().st_size > 1000
    monkeypatch.setattr(animation.shutil, "which", lambda name: None)
    with pytest.raises(RuntimeError, match="ffmpeg"):
        animate(pendulum, tmp_path / "run.mp4")

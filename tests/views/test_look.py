"""The look of a body: one definition for diagrams, films and the player, and no mechanics."""

import numpy as np
import pytest

from freebody import Mechanism
from freebody.model.errors import ModelFileError
from freebody.views.report.data import report_data
from freebody.views.scene import of_run
from freebody.views.style import PALETTE

MODEL = """
freebody: 1
parameters: {r: 60 mm}
ground: {points: {A: [1, 0.3], B: [1, 1]}}
bodies:
  cart: {shape: rectangle, width: 0.6, height: 0.3, mass: 2, look: {wheels: r, colour: grey}}
  flywheel: {shape: disk, radius: 0.2, mass: 1, look: {spokes: 6, colour: pink, layer: front}}
  hoop: {shape: ring, radius: 0.15, mass: 1, look: {thickness: 30 mm, layer: behind}}
joints:
  pin: {type: hinge, of: [ground.O, cart.centre], coordinate: a}
  axle: {type: hinge, of: [ground.A, flywheel.centre], coordinate: b}
  other: {type: hinge, of: [ground.B, hoop.centre], coordinate: c}
run: {until: 0.1 s}
"""


@pytest.fixture(scope="module")
def run():
    return Mechanism.loads(MODEL).simulate()


def strokes(run, body, style):
    return [stroke.points for stroke in of_run(run, run.t[:2]).figures[body].strokes if stroke.style == style]


def test_a_cart_stands_on_wheels_within_its_rectangle(run):
    wheels = strokes(run, "cart", "block")
    assert [np.ptp(wheel[:, 1]) for wheel in wheels] == pytest.approx([0.12, 0.12], rel=1e-2)
    corners = np.vstack([*wheels, *strokes(run, "cart", "body")])
    assert np.abs(corners).max(axis=0) == pytest.approx([0.3, 0.15])


def test_a_wheel_keeps_its_radius_and_has_its_spokes(run):
    rim, hub = strokes(run, "flywheel", "body")
    assert np.hypot(*rim.T).max() == pytest.approx(0.2)
    assert np.hypot(*rim.T).min() > np.hypot(*hub.T).max()
    assert len(strokes(run, "flywheel", "mark")) == 6
    [hoop] = strokes(run, "hoop", "body")
    assert np.hypot(*hoop.T).min() == pytest.approx(0.15 - 0.03)


def test_colours_and_layers_are_those_of_the_player_too(run):
    figures = {figure["name"]: figure for figure in report_data(run)["scene"]["figures"]}
    assert [PALETTE[figures[name]["tone"]] for name in ("cart", "flywheel", "hoop")] == ["#6b6b6b", "#cc79a7", PALETTE[2]]
    assert [figures[name]["layer"] for name in ("ground", "cart", "flywheel", "hoop")] == [0, 0, 1, -1]
    drawn = {stroke.body: stroke for stroke in of_run(run, run.t[:2]).strokes()}
    assert (drawn["flywheel"].tint, drawn["flywheel"].layer, drawn["hoop"].layer) == ("#cc79a7", 1, -1)


def test_pieces_have_looks_of_their_own():
    """Also those that are repeated, beside the look of their body; the player has their colours, too."""
    rim, spoke = "shape: ring, radius: 1, mass: 1", "shape: rod, length: 1, mass: 1"
    pieces = f'{{rim: {{{rim}, look: {{thickness: 50 mm, colour: orange}}}}, "s[k = 1 .. 2]": {{{spoke}, look: {{thickness: 20 mm*k}}}}}}'
    model = f'freebody: 1\nbodies: {{"star[k = 1 .. 2]": {{pieces: {pieces}, look: {{thickness: 10 mm, colour: pink}}}}}}\nrun: {{until: 0.1}}'
    of_pieces = Mechanism.loads(model).simulate()
    [star] = [figure for figure in report_data(of_pieces)["scene"]["figures"] if figure["name"] == "star[2]"]
    hoop, one, two = (each for each in star["strokes"] if each["style"] == "body")
    assert (PALETTE[star["tone"]], PALETTE[hoop["tone"]], "tone" in one) == ("#cc79a7", "#d55e00", False)
    assert np.hypot(*np.transpose(hoop["points"])).min() == pytest.approx(0.95, abs=1e-3)
    assert [np.ptp(each["points"], axis=0)[1] for each in (one, two)] == pytest.approx([0.02, 0.04], rel=1e-2)


DRAWN = "{mass: 1, inertia: 1, outline: {path: 'M 0 0 H 40 V 20 Q 20 60 0 20 Z M 10 5 h 10 v 10 h -10 z', unit: 1 mm, at: [1, 0], y: WAY}}"


@pytest.mark.parametrize(("way", "lowest", "highest"), [("up", 0, 0.04), ("down", -0.04, 0)])
def test_an_outline_is_a_path_of_svg(way, lowest, highest):
    """A parabola from (0, 20) to (40, 20), the tangents of which meet at (20, 60), reaches up to 40; the square within is cut out."""
    given = Mechanism.loads(f"freebody: 1\nbodies: {{b: {DRAWN.replace('WAY', way)}}}\nrun: {{until: 0.1}}").simulate()
    [outline], [hole] = strokes(given, "b", "body"), strokes(given, "b", "slot")
    assert [*outline.min(axis=0), *outline.max(axis=0)] == pytest.approx([1, lowest, 1.04, highest])
    assert np.ptp(hole, axis=0) == pytest.approx([0.01, 0.01])


@pytest.mark.parametrize(
    "path", ["", "hello", "M 0", "L 1 1", "M 0 0", "M 0 0 L 1", "M 0 0 L 1e999 0 Z", "M 0 0 X 3 3", "M 0 0 A 1 1"]
)
def test_a_path_that_cannot_be_read_is_refused_where_it_stands(path):
    with pytest.raises(ModelFileError, match=r"model:2:\d+: (`.*` is no SVG path|this path draws nothing)"):
        Mechanism.loads(f"freebody: 1\nbodies: {{b: {{mass: 1, inertia: 1, outline: {{path: '{path}'}}}}}}").simulate(until=0.1)


@pytest.mark.parametrize(
    ("body", "what"),
    [
        ("{shape: rod, length: 1, mass: 1, look: {spokes: 3}}", "no spokes"),
        ("{shape: disk, radius: 1, mass: 1, look: {wheels: 10 mm}}", "no wheels"),
        ("{shape: rod, length: 1, mass: 1, look: {thickness: 3 kg}}", "thickness"),
        ("{shape: rod, length: 1, mass: 1, look: {colour: red}}", "colour"),
        ("{pieces: [{shape: rod, length: 1, mass: 1, look: {spokes: 3}}]}", "no spokes"),
        ("{mass: 1, inertia: 1, outline: 3}", "no outline"),
        ("{mass: 1, inertia: 1, outline: {path: M 0 0 L 1 1, unit: 3 kg}}", "unit"),
    ],
)
def test_a_look_that_nothing_can_have_is_refused(body, what):
    with pytest.raises(ModelFileError, match=what):
        Mechanism.loads(f"freebody: 1\nbodies: {{b: {body}}}").simulate(until=0.1)

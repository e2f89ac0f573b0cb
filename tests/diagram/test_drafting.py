"""The drafting standard of docs/diagrams.md, held on the data of the drawings of every model."""

from itertools import combinations

import numpy as np
import pytest
import store
from store import WITHOUT_ANSWER, every, mechanism
from store import diagram as drawn

from freebody.mechanism import Mechanism
from freebody.views.diagram.arrows import Arrow, shared
from freebody.views.diagram.configuration import Configuration
from freebody.views.diagram.scenery import _ROOM
from freebody.views.labels import AIR
from freebody.views.render import ORDER
from freebody.views.shapes import dense, inside

SHAFT, HEAD, HALF_HEAD = 14.0, 5.6, 2.5  # pt
BLUNT = 1.5  # pt at an end of a line, where it may touch what it ends on
FULL = 10  # labels on a panel, beyond which there may be no room for all
SOLID = ("body", "block", "band", "mass")
every_model = every(sorted(set(store.SYSTEMS) - WITHOUT_ANSWER), share=60)
sheets = pytest.mark.parametrize(("of", "to_scale"), [(None, False), (None, True), ("all", False)])


def panels(model, of, to_scale, full=FULL):
    """The halves of all diagrams of a sheet, but those that are full."""
    for cut in drawn(model, of, to_scale).cuts:
        for panel in (*cut.panels, *cut.apart):
            if len(panel.labels) <= full:
                yield panel


def forces(panel):
    return [mark for mark in panel.marks if isinstance(mark, Arrow)]


def couples(panel):
    return [mark for mark in panel.marks if not isinstance(mark, Arrow)]


def boxes(panel):
    return [(label.centre - label.half + AIR, label.centre + label.half - AIR, label.label.text) for label in panel.labels]


def passes(lines, low, high):
    """Whether one of some lines goes through a box; ``lines`` as places that are close to each other."""
    return bool(((lines > low) & (lines < high)).all(axis=1).any())


def seen(stroke, strokes):
    """Places along a stroke that no block covers."""
    places = dense([stroke.line], 1.0)
    for block in (each.points for each in strokes if each.style == "block" and stroke.style in ORDER[: ORDER.index("block")]):
        places = places[~inside(block, places)]
    return places


def blunted(line, by=BLUNT):
    """A polyline without its ends."""
    ways = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    if ways[-1] < 3 * by:
        return line
    kept = np.array([by, *ways[(ways > by) & (ways < ways[-1] - by)], ways[-1] - by])
    return np.column_stack([np.interp(kept, ways, coordinate) for coordinate in line.T])


def triangle(line):
    """The head of an arrow of a force."""
    way = (line[-1] - line[-2]) / np.hypot(*(line[-1] - line[-2]))
    corners = line[-1] - HEAD * way + HALF_HEAD * np.outer([1, -1], [-way[1], way[0]])
    return np.array([line[-1], *corners, line[-1]])


def cross(one, other):
    """Whether two polylines meet, but for their ends."""
    (p, d), (r, e) = ((line[:-1], np.diff(line, axis=0)) for line in (blunted(one), blunted(other)))
    w = r[None] - p[:, None]
    turned = d[:, None, 0] * e[None, :, 1] - d[:, None, 1] * e[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (w[..., 0] * e[None, :, 1] - w[..., 1] * e[None, :, 0]) / turned
        t = (w[..., 0] * d[:, None, 1] - w[..., 1] * d[:, None, 0]) / turned
    return bool(((s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)).any())


def test_what_meets_is_seen_to_meet():
    """The two looks of this file can tell what is right from what is wrong."""
    across, up = np.array([[0.0, 5.0], [20.0, 5.0]]), np.array([[10.0, 0.0], [10.0, 20.0]])
    assert cross(across, up) and not cross(across + (0, 16), up) and not cross(across + (10, 0), up)
    line = dense([across], 1.0)
    assert passes(line, np.array([8.0, 0.0]), np.array([12.0, 9.0])) and not passes(line, np.zeros(2), np.array([9.0, 4.0]))


@pytest.mark.parametrize("model", ["GEN-SUSP/one_sided", "GEN-SUSP/model"])
def test_a_body_that_is_loaded_far_away_is_drawn_as_small_as_it_takes(model):
    """The road presses on a quarter car's wheel, a particle, a tyre's deflection away, which was drawn a yard long."""
    for panel in panels(model, None, False):
        assert (np.ptp(panel.scenery.obstacles, axis=0) < (2 * _ROOM[0], 2 * _ROOM[1])).all()


@every_model
@sheets
def test_every_arrow_has_a_shaft(model, of, to_scale):
    for panel in panels(model, of, to_scale, full=np.inf):
        for mark in forces(panel):
            assert mark.length - HEAD >= SHAFT - 0.1, mark.action.label


@every_model
@sheets
def test_a_couple_is_smaller_than_half_its_body_or_apart(model, of, to_scale):
    for panel in panels(model, of, to_scale):
        for mark in couples(panel):
            own = [s for s in panel.scenery.strokes if s.body == mark.action.body and s.style != "rail"]
            across = np.hypot(*np.ptp(np.vstack([stroke.points for stroke in own]), axis=0))
            apart = not any(inside(s.points, mark.line).any() for s in panel.scenery.strokes if s.style in SOLID)
            assert apart or 2 * np.hypot(*(mark.line[0] - mark.centre)) <= across / 2 + 1e-9, mark.action.label


@every_model
@sheets
def test_no_arrow_crosses_a_couple(model, of, to_scale):
    for panel in panels(model, of, to_scale):
        for couple in couples(panel):
            for mark in panel.marks:
                assert mark is couple or not cross(mark.line, couple.line), (mark.action.label, couple.action.label)


@every_model
@sheets
def test_no_arrow_crosses_that_of_a_coordinate(model, of, to_scale):
    """But for arcs among forces to scale, which may be longer than any arc is wide."""
    for panel in panels(model, of, to_scale):
        for dimension in (each for each in panel.scenery.dimensions if not (each.angle and to_scale)):
            for mark in panel.marks:
                assert not cross(mark.line, dimension.arrow), (mark.action.label, dimension.text)


@every_model
@sheets
def test_no_label_lies_on_another(model, of, to_scale):
    for panel in panels(model, of, to_scale, full=np.inf):
        for (low, high, text), (lower, upper, other) in combinations(boxes(panel), 2):
            assert not ((low < upper) & (lower < high)).all(), (text, other)


@every_model
@sheets
def test_no_label_lies_on_an_arrow_or_a_line(model, of, to_scale):
    """Neither forces and couples with their heads, nor outlines, springs and strings, nor coordinates."""
    for panel in panels(model, of, to_scale):
        scenery = panel.scenery
        ink = [mark.line for mark in panel.marks] + [each.arrow for each in scenery.dimensions]
        ink += [triangle(mark.line) for mark in panel.marks]
        drawn_there = np.vstack([dense(ink + scenery.inner, 1.0), *(seen(stroke, scenery.strokes) for stroke in scenery.strokes)])
        for low, high, text in boxes(panel):
            assert not passes(drawn_there, low, high), text


@every_model
@sheets
def test_what_leads_to_a_label_crosses_no_arrow_and_no_other_label(model, of, to_scale):
    for panel in panels(model, of, to_scale):
        for led in (label for label in panel.labels if label.leader is not None):
            way = dense([led.leader], 1.0)
            others = [each for each in panel.labels if each is not led]
            assert not any(passes(way, each.centre - each.half + AIR, each.centre + each.half - AIR) for each in others)
            assert not any(cross(blunted(led.leader, 4.0), mark.line) for mark in panel.marks), led.label.text


@every_model
def test_no_label_of_a_sketch_lies_on_the_arrow_of_a_coordinate(model):
    state, _ = store.start(model)
    for each_body in (False, True):
        [row] = Configuration(mechanism(model).source(), state, each_body).rows
        [panel] = row.panels
        for low, high, text in boxes(panel) if len(panel.labels) <= FULL else ():
            assert not passes(dense([each.arrow for each in panel.scenery.dimensions], 1.0), low, high), text


@every_model
def test_what_slides_is_drawn_wide_and_what_rolls_with_its_wheels(model):
    for cut in drawn(model).cuts:
        [body] = cut.group
        strokes = cut.panels[0].scenery.strokes
        for block in (stroke.points for stroke in strokes if stroke.style == "block" and len(stroke.points) == 4):
            assert np.hypot(*(block[1] - block[0])) >= 1.5 * np.hypot(*(block[2] - block[1])) >= 24.0
        for mark in forces(cut.panels[0]):
            joint = next((j for j in mechanism(model).source().spec["joints"] if j["name"] == mark.action.name), None)
            if joint and joint["type"] == "rollers" and joint["with"]["points"][0].partition(".")[0] == body:
                wheels = [stroke.points for stroke in strokes if stroke.style == "slot"]
                wheel = min(wheels, key=lambda rim: np.hypot(*(rim - mark.at).T).min())
                radius = np.hypot(*(wheel - wheel.mean(axis=0)).T).mean()
                assert radius >= 3.0 and np.hypot(*(wheel.mean(axis=0) - mark.at)) == pytest.approx(radius, rel=1e-2)


def test_accelerations_have_their_body_below_where_there_are_several():
    for of in (None, "all"):
        marks = [mark for cut in drawn("GEN-FOURBAR/model", of).cuts for mark in cut.effective]
        assert marks and all(r"\text{ab}" in m.action.label or "bc" in m.action.label or "dc" in m.action.label for m in marks)
    [alone] = drawn("19.3.6/model").cuts
    assert {mark.action.label for mark in alone.effective} == {r"m\,a_x", r"m\,a_y", r"I_{\text{rod}}\,\alpha"}


HIP = """
freebody: 1
bodies: {trunk: {shape: rod, length: 0.8, mass: 30}, LEGS}
joints: {hip: {type: free, of: [ground.O, trunk.start]}, JOINTS}
"""


def test_many_forces_at_one_place_are_drawn_in_a_detail_side_by_side():
    legs = ", ".join(f"leg{i}: {{shape: rod, length: 0.5, mass: 8}}" for i in range(4))
    joints = ", ".join(f"h{i}: {{type: hinge, of: [trunk.start, leg{i}.start]}}" for i in range(4))
    cut = Mechanism.loads(HIP.replace("LEGS", legs).replace("JOINTS", joints)).diagram("trunk").cuts[0]
    [detail] = cut.apart
    assert {mark.action.kind for mark in cut.panels[0].marks} == {"weight"} and len(cut.forces) == 1 + len(detail.marks) == 9
    for one, other in combinations(detail.marks, 2):
        assert shared(one, other) == 0.0 and np.hypot(*(one.head - other.head)) >= 10.0
    for mark in detail.marks:  # from the rim of the place, away from it
        assert (mark.tail - mark.action.at * detail.scenery.scale) @ mark.action.force > 0


BELT = """
freebody: 1
ground: {points: {A: [0, 0], B: [0.8, 0.2]}}
bodies: {small: {shape: disk, radius: 0.1, mass: 2}, large: {shape: disk, radius: 0.25, mass: 5}}
joints:
  A: {type: hinge, of: [ground.A, small.G]}
  B: {type: hinge, of: [ground.B, large.G]}
  belt: {type: belt, of: [small.G, large.G], radii: [0.1, 0.25]}
"""


def test_a_belt_pulls_at_the_rim_of_each_wheel():
    """Its force is tangential there: its arm about the centre is the radius, without a shift along its line."""
    for cut, radius in zip(Mechanism.loads(BELT).diagram().cuts, (0.1, 0.25), strict=True):
        [mark] = (mark for mark in cut.forces if mark.action.name == "belt")
        arm = mark.action.at - cut.panels[0].scenery.sketch.place(f"{cut.group[0]}.G")
        assert np.hypot(*arm) == pytest.approx(radius, rel=1e-9)
        assert arm @ mark.action.force == pytest.approx(0.0, abs=1e-9)


BOOM = """
freebody: 1
bodies:
  boom: {shape: polygon, mass: 8, corners: [[0, -0.15], [2, 0.5], [4, -0.1], [4, 0.15], [2, 0.95], [0, 0.15]], points: {E: [2.2, 1.3]}}
joints: {A: {type: hinge, of: [ground.O, boom.origin]}}
"""


def test_the_arm_of_a_body_that_is_bent_begins_on_it():
    """The middle of this boom's corners lies below it; the arm to E above lay across and came out there."""
    [cut] = Mechanism.loads(BOOM).diagram().cuts
    scenery = cut.panels[0].scenery
    arm, boom = sorted((each.points for each in scenery.strokes if each.style == "body"), key=lambda outline: len(outline) == 6)
    tip, E = scenery.sketch.place("boom.E") * scenery.scale, arm[np.hypot(*arm.T).argmax()]
    assert np.hypot(*(tip - E)) < 10.0
    lowest = arm[arm[:, 1].argmin()]
    assert lowest[1] > 0.5 * scenery.scale and inside(boom, lowest[None]).any()


SEESAW = """
freebody: 1
bodies:
  plank: {shape: rectangle, width: 3, height: 0.1, mass: 20, points: {U: [-1.5, 0.05], V: [1.5, 0.05]}}
  box: {shape: rectangle, width: 0.4, height: 0.3, mass: 15, points: {a: [-0.2, -0.15], b: [0.2, -0.15]}}
joints:
  P: {type: hinge, of: [ground.O, plank.centre]}
  lying: {type: slider, along: [plank.U, plank.V], line: [box.a, box.b], coordinate: s}
initial: {s: 2}
"""


@pytest.mark.parametrize("of", [None, "all"])
def test_a_small_block_lies_on_the_face_along_which_it_slides(of):
    """Beside a plank of ten times its height it is still a block of its own: its guide is the plank's upper side."""
    scenery = Mechanism.loads(SEESAW).diagram(of).cuts[0].panels[0].scenery
    [rail] = [each.points for each in scenery.strokes if each.style == "rail" and each.body == "plank"]
    assert rail[:, 1] / scenery.scale == pytest.approx([0.05, 0.05])


GEARS = """
freebody: 1
ground: {points: {B: [0.14, 0], D: [0.265, 0]}}
bodies:
  pinion: {shape: disk, radius: 0.04, mass: 0.5}
  middle: {shape: disk, radius: 0.1, mass: 2}
  output: {shape: disk, radius: 0.09, mass: 2}
joints:
  A: {type: hinge, of: [ground.O, pinion.centre]}
  B: {type: hinge, of: [ground.B, middle.centre]}
  D: {type: hinge, of: [ground.D, output.centre]}
  first: {type: gear, of: [pinion.centre, middle.centre], radii: [0.04, 0.1]}
  second: {type: gear, of: [middle.centre, output.centre], radii: [0.035, 0.09]}
"""


def test_a_pitch_circle_on_a_wheel_is_drawn_upon_it_and_a_rim_once():
    """The force of the second pair of teeth acts within the middle wheel, on a circle that its disk hid."""
    found = {}
    for cut in Mechanism.loads(GEARS).diagram().cuts:
        scenery = cut.panels[0].scenery
        for rim in (each.points for each in scenery.strokes if each.style == "dash"):
            found[cut.group] = np.hypot(*(rim - scenery.centres[cut.group[0]]).T) / scenery.scale
    assert list(found) == [("middle",)] and found["middle",] == pytest.approx(0.035)
    assert ORDER.index("dash") > ORDER.index("body")


BARROW = """
freebody: 1
ground: {lines: {floor: {through: O, angle: 0}}}
bodies:
  barrow: {mass: 40, inertia: 6, centre: [0.45, 0.25], points: {A: [0, 0], H: [1.4, 0.45]}}
  wheel: {shape: disk, radius: 0.2, mass: 4, look: {spokes: 6}}
joints:
  roll: {type: rolling, on: ground.floor, circle: {centre: wheel.centre, radius: 0.2}}
  A: {type: hinge, of: [wheel.centre, barrow.A]}
forces: {lift: {type: force, at: barrow.A, value: LIFT, direction: 90 deg}}
"""


@pytest.mark.parametrize(("lift", "to_scale", "pushes"), [(0, False, True), (0, True, True), (900, True, False)])
def test_the_floor_pushes_a_wheel_from_below(lift, to_scale, pushes):
    """Its arrow ends at the rim, clear of the spokes; one that has to hold the wheel down pulls, downwards."""
    cut = Mechanism.loads(BARROW.replace("LIFT", str(lift))).diagram("all", to_scale=to_scale).cuts[0]
    [mark] = (mark for mark in cut.forces if mark.action.label.startswith("N"))
    assert (mark.action.force[1] > 0) == mark.action.presses == pushes
    assert np.array_equal(mark.at, mark.head) or not pushes

"""Nothing that is drawn sinks into what it touches: what ends in a point of contact, and what meets a stop."""

import numpy as np
import pytest

import freebody as fb
from freebody.views.scene import of_run

LADDER = """
freebody: 1
bodies: {ladder: {shape: rod, length: 4 m, mass: 10 kg, points: {A: start, B: end}}}
ground: {lines: {floor: {through: O, angle: 0}}}
contacts: {floor: {of: [ladder.A, ground.floor]}}
joints: {top: {type: slot, point: ladder.B, along: {through: ground.O, angle: 90 deg}, coordinate: h}}
initial: {points: {ladder.A: [1.2 m, 0]}, at_rest: true}
run: {until: 0.9 s}
"""
CUSHION = """
freebody: 1
parameters: {slope: 20 deg}
bodies: {ball: {shape: disk, radius: 0.2 m, mass: 2 kg}}
ground: {lines: {floor: {through: O, angle: slope}}}
joints: {free: {type: free, of: [ground.O, ball.G], coordinates: [x, y, phi]}}
contacts: {tyre: {of: [SURFACES], stiffness: 2 kN/m, damping: 5 N*s/m, friction: 0.4}}
initial: {y: 0.4 m, at_rest: true}
run: {until: 0.6 s}
"""
SLIDE = """
freebody: 1
gravity: none
bodies: {block: {SHAPE, mass: 2 kg}}
joints: {track: {type: slider, line: {through: block.origin, angle: 0}, along: {through: ground.O, angle: 20 deg}, coordinate: s}}
stops: {buffer: {of: s, least: 0.2, most: 1.5 m, restitution: 1}}
initial: {s: 1.2 m, rates: {s: 1}}
run: {until: 2 s}
"""
SWING = """
freebody: 1
bodies: {rod: {shape: rod, length: 0.8 m, mass: 1 kg}}
joints: {pivot: {type: hinge, of: OF, coordinate: theta}}
stops: {buffer: {of: theta, LIMIT, restitution: 0.7}}
initial: {theta: START, rates: {theta: RATE}}
run: {until: 1 s}
"""


def sketched(model):
    run = fb.Mechanism.loads(model).simulate()
    return of_run(run, np.linspace(run.edges[0], run.edges[-1], 400))


def rails(sketch, name="ground"):
    return [stroke.points for stroke in sketch.figures[name].strokes if stroke.style == "rail" and stroke.about is not None]


def test_a_rod_ends_in_the_point_that_touches():
    sketch = sketched(LADDER)
    [outline] = [stroke.points for stroke in sketch.figures["ladder"].strokes if stroke.style == "body"]
    lowest = [sketch.moved("ladder", outline, k)[:, 1].min() for k in range(len(sketch.t))]
    assert min(lowest) > -1e-3 * sketch.size and np.ptp(outline[:, 1]) == pytest.approx(1.6 * sketch.size)
    assert outline[:, 0].max() > 2.0  # where nothing touches it is round


@pytest.mark.parametrize("ends", ["{A: start, B: end}", "{A: end, B: start}"])
def test_a_rod_that_comes_to_lie_on_a_line_lies_on_it(ends):
    both = LADDER.replace("{A: start, B: end}", ends).replace("contacts: {", "contacts: {top: {of: [ladder.B, ground.floor]}, ")
    free = both.replace(
        "joints: {top: {type: slot, point: ladder.B, along: {through: ground.O, angle: 90 deg}, coordinate: h}}\n", ""
    )
    sketch = sketched(free.replace("[1.2 m, 0]}", "[1.2 m, 0], ladder.B: [-1.2 m, 3.2 m]}").replace("0.9 s", "1.5 s"))
    [outline] = [stroke.points for stroke in sketch.figures["ladder"].strokes if stroke.style == "body"]
    places = [sketch.moved("ladder", outline, k)[:, 1] for k in range(len(sketch.t))]
    assert min(map(np.min, places)) > -1e-3 * sketch.size and np.max(places[-1]) == pytest.approx(1.6 * sketch.size)


@pytest.mark.parametrize("surfaces", ["ball, ground.floor", "ground.floor, ball"])
def test_the_spring_of_a_contact_stands_in_the_ground_while_it_acts(surfaces):
    """From as deep as the ball is pressed in, straight down from the surface, whichever is named first and whatever the friction."""
    sketch = sketched(CUSHION.replace("SURFACES", surfaces))
    [spring] = sketch.cords
    gap = sketch.gap("tyre")
    assert 0 < spring.shown.sum() < len(gap) and not spring.shown[gap > 1e-9].any()
    up = np.array([-np.sin(np.radians(20)), np.cos(np.radians(20))])
    top, foot = spring.path[spring.shown, 0], spring.path[spring.shown, -1]
    assert top @ up == pytest.approx(gap[spring.shown], abs=1e-9)
    reach = (top - foot) @ up
    assert np.hypot(*(top - foot).T) == pytest.approx(reach) and reach.min() > 2 * sketch.size and np.ptp(reach) > 0


@pytest.mark.parametrize("shape", ["shape: rectangle, width: 0.3 m, height: 0.2 m", "inertia: 1"])
def test_a_block_comes_as_far_as_the_faces_of_its_stop(shape):
    """From 0.2 m to 1.5 m along the guide, and half the block further."""
    sketch = sketched(SLIDE.replace("SHAPE", shape))
    way = np.array([np.cos(np.radians(20)), np.sin(np.radians(20))])
    [outline] = [
        each.points for each in sketch.figures["block"].strokes if each.style in ("body", "block") and len(each.points) == 4
    ]
    half = float((outline @ [1, 0]).max())
    least, most = (face @ way for face in rails(sketch))
    assert least == pytest.approx(0.2 - half) and most == pytest.approx(1.5 + half)
    hatches = [each.points @ way for each in sketch.figures["ground"].strokes if each.style == "hatch" and each.about is not None]
    assert hatches and all(each.max() < 0.2 - half + 1e-9 or each.min() > 1.5 + half - 1e-9 for each in hatches)


@pytest.mark.parametrize(
    ("of", "start", "limit", "rate"),
    [("[ground.O, rod.start]", "-90 deg", "most: 0", 9), ("[rod.start, ground.O]", "90 deg", "least: 0", -9)],
)
def test_a_face_beside_a_hinge_is_where_the_rod_is_stopped(of, start, limit, rate):
    """A rod that hangs is stopped when it is level: its edge lies on the face, which is hatched above."""
    sketch = sketched(SWING.replace("OF", of).replace("LIMIT", limit).replace("START", start).replace("RATE", str(rate)))
    [face] = [points for points in rails(sketch) if points[:, 1].min() > 0]
    assert face[:, 1] == pytest.approx(0.8 * sketch.size) and abs(face[:, 0]).min() > 3 * sketch.size
    above = [s.points[:, 1].max() for s in sketch.figures["ground"].strokes if s.style == "hatch" and s.points[:, 1].min() > 0]
    assert above and max(above) > 0.9 * sketch.size

"""The sketch of a derivation: every coordinate of every joint is drawn as meaning."""

import re
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from store import SYSTEMS, every, mechanism, start

from freebody.core import CompiledModel
from freebody.core.cards import joints
from freebody.document.blocks import Figure
from freebody.equations.topics import topic
from freebody.mechanism import Mechanism
from freebody.views.diagram.configuration import Configuration
from freebody.views.diagram.names import symbol
from freebody.views.dimension_lines import dimension_lines
from freebody.views.sketch import sketch_of_state

HEAD = """
freebody: 1
gravity: none
ground: {points: {A: [0.1, 0.2]}, curves: {arc: {x: "2*cos(s)", y: "2*sin(s)"}}}
bodies:
  wheel: {pieces: [{shape: disk, radius: 0.3, mass: 1}], points: {P: [0.3, 0], Q: [-0.2, 0.1]}}
joints: {pair: {type: TYPE, FIELDS, coordinates: [NAMES]}}
"""
LINE, CIRCLE = "{through: ground.A, angle: 20 deg}", "{centre: wheel.G, radius: 0.3}"
FIELDS = {
    "hinge": "of: [ground.A, wheel.P]",
    "slider": f"along: {LINE}, line: {{through: wheel.P, angle: 10 deg}}",
    "rollers": f"along: {LINE}, points: [wheel.P, wheel.Q]",
    "slot": f"along: {LINE}, point: wheel.P",
    "curved_slot": "along: ground.arc, point: wheel.P",
    "cam": f"along: ground.arc, follower: {CIRCLE}",
    "one_sided_cam": f"along: ground.arc, follower: {CIRCLE}, right: true",
    "link": "of: [ground.A, wheel.P], length: 0.9",
    "rolling": f"on: {LINE}, circle: {CIRCLE}",
    "rolling_circles": f"on: {{centre: ground.A, radius: 0.8}}, circle: {CIRCLE}",
    "free": "of: [ground.A, wheel.P]",
    "polar": "of: [ground.A, wheel.P]",
    "parallel": "of: [ground.A, wheel.P]",
    "wound_string": f"from: ground.A, drum: {CIRCLE}",
}
VALUES = np.array([0.8, 0.5, -1.1])


@cache
def drawn(model, each_body=False):
    state, notes = start(model)
    return Configuration(mechanism(model).source(notes), state, each_body)


every_model = every(sorted(SYSTEMS), share=60)


@every_model
def test_every_coordinate_has_its_mark_and_it_can_be_seen(model):
    found = drawn(model)
    assert [each.text for each in found.scenery.dimensions] == [symbol(c["name"]) for c in found.source.metadata["coordinates"]]
    for each in found.scenery.dimensions:
        assert np.hypot(*np.diff(each.arrow, axis=0).T).sum() >= 5.0


@every_model
@pytest.mark.parametrize("each_body", [False, True])
def test_no_two_labels_overlap_and_all_are_on_the_paper(model, each_body):
    [row] = drawn(model, each_body).rows
    [panel] = row.panels
    low, high = panel.box()
    for label in panel.labels:
        assert (low <= label.centre - label.half + 1e-9).all() and (label.centre + label.half <= high + 1e-9).all()
    for a, b in combinations(panel.labels, 2):
        assert (np.abs(a.centre - b.centre) >= a.half + b.half - 1e-9).any(), (a.label.text, b.label.text)


@every_model
def test_every_body_is_placed_by_itself(model):
    """x and y of its mass centre from the origin, and its angle from the x axis, as the state is drawn."""
    found = drawn(model, each_body=True)
    bodies = found.source.spec["bodies"]
    marks = {each.text: each for each in found.scenery.dimensions}
    assert list(marks) == [
        symbol(f"{word}_{body['name']}") for body in bodies for word in ("x", "y", "phi")[: 2 if body["particle"] else 3]
    ]
    scale, sketch = found.scenery.scale, found.scenery.sketch
    for body in bodies:
        name = body["name"]
        place = sketch.place(f"{name}.G") - sketch.place("ground.O")
        for word, along, unit in zip("xy", place, np.eye(2), strict=True):
            way = marks[symbol(f"{word}_{name}")].arrow @ unit
            if abs(along) > sketch.size:
                assert way[1] - way[0] == pytest.approx(scale * abs(along), rel=1e-9)
            assert way[1] > way[0]  # x and y grow with the axes, wherever the body is
        if not body["particle"]:
            vertex, end = marks[symbol(f"phi_{name}")].guides[1]
            turn = sketch.poses[0, sketch.names.index(name), 2]
            assert (end - vertex) / np.hypot(*(end - vertex)) == pytest.approx([np.cos(turn), np.sin(turn)], abs=1e-9)


@pytest.mark.parametrize("model", ["GEN-FOURBAR/model", "19.3.20/model", "S19.19/model"])
def test_the_sketch_with_constraints_has_their_coordinates(model):
    made = mechanism(model).equations("constraints")
    stated = [name for name in made.letters if made.letters.kind(name) == "coordinate"]
    assert sorted(symbol(name) for name in stated) == sorted(
        each.text for each in drawn(model, each_body=True).scenery.dimensions
    )
    html = made.html()
    assert html.count("<svg") == 1 and "[Figure" not in html


def test_every_joint_with_coordinates_is_looked_at():
    assert set(FIELDS) == {card.type for card in joints().values() if card.coordinates}


def pair(kind):
    """Source and state of a wheel on a joint."""
    names = ", ".join(f"q{i}" for i, _ in enumerate(joints()[kind].coordinates))
    text = HEAD.replace("TYPE", kind).replace("FIELDS", FIELDS[kind]).replace("NAMES", names)
    made = Mechanism.loads(text)
    state, _ = made.start()
    return made.source(), replace(state, q=VALUES[: len(state.q)].copy())


@pytest.mark.parametrize("kind", FIELDS)
def test_an_arrow_lies_between_zero_and_the_value_in_the_positive_sense(kind):
    """An arc turns by the value of its coordinate, a straight arrow is as long; where the coordinate grows, the end at its value
    goes on along the arrow, the head of what is positive and the tail of what is negative, and the end at zero stays."""
    source, state = pair(kind)
    sketch = sketch_of_state(source, state)
    for i, measure in enumerate(dimension_lines(sketch)):
        step, value = 1e-3, state.q[i]
        beyond = sketch_of_state(source, replace(state, q=state.q + step * np.eye(len(state.q))[i]))
        beyond.size = sketch.size
        after = list(dimension_lines(beyond))[i]
        way, turned = np.diff(measure.arrow, axis=0), np.diff(after.arrow, axis=0)
        length, longer = (np.hypot(*each.T).sum() for each in (way, turned))
        if measure.angle:
            turn = np.unwrap(np.arctan2(way[:, 1], way[:, 0]))
            sides = len(turn)  # of an arc: the outer halves of the first and the last side are missing
            assert (turn[-1] - turn[0]) * sides / (sides - 1) == pytest.approx(abs(value), rel=1e-9)
        elif source.metadata["coordinates"][i]["dimension"]:  # the parameter of a curve has none
            assert length == pytest.approx(abs(value), rel=1e-9)
        assert np.sign(longer - length) == np.sign(value)
        zero, moving = (0, -1) if value > 0 else (-1, 0)
        assert after.arrow[zero] == pytest.approx(measure.arrow[zero], abs=2e-3 * length)
        assert (after.arrow[moving] - measure.arrow[moving]) @ way[0 if moving == 0 else -1] > 0


def turned(line, vertex):
    """From the first to the second end of a line as seen from a vertex, counter-clockwise."""
    (ax, ay), (bx, by) = line[0] - vertex, line[-1] - vertex
    return np.arctan2(ax * by - ay * bx, ax * bx + ay * by)


@every_model
@pytest.mark.parametrize("side", [-1, 1])
def test_arrows_point_where_their_coordinates_grow(model, side):
    """In any pose, with coordinates on either side of their zeros: from zero the end at the value goes along the arrow."""
    source, (state, _) = mechanism(model).source(), start(model)
    nothing_in_the_way = source.spec | {part: [] for part in ("contacts", "strings", "stops", "events", "forces")}
    size, source = sketch_of_state(source, state).size, replace(CompiledModel.of(nothing_in_the_way), model=source.model)
    least = np.array([0.5 if c["dimension"] == "rad" else 8 * size for c in source.metadata["coordinates"]])
    state = replace(state, history=None, q=side * least * (1 + np.arange(len(least)) % 4 / 3), u=np.zeros(len(least)))
    sketch, step = sketch_of_state(source, state), 1e-4
    for i, measure in enumerate(dimension_lines(sketch)):
        beyond = sketch_of_state(source, replace(state, q=state.q + step * least * np.eye(len(state.q))[i]))
        beyond.size = sketch.size
        after, moving = list(dimension_lines(beyond))[i], 0 if measure.below else -1
        assert measure.below == (side < 0)
        if measure.angle:
            vertices = measure.guides[0][0], after.guides[0][0]
            ends = np.array([measure.arrow[moving] - vertices[0], after.arrow[moving] - vertices[1]])
            assert turned(ends, np.zeros(2)) * turned(measure.arrow[:2], vertices[0]) > 0
        else:
            value, further = ((each.arrow[-1] - each.arrow[0]) * side for each in (measure, after))
            assert (further - value) @ (measure.arrow[-1] - measure.arrow[0]) > 0


def test_a_zero_is_shown_by_its_sense():
    source, state = pair("free")
    for measure in dimension_lines(sketch_of_state(source, replace(state, q=np.zeros(3)))):
        assert np.hypot(*np.diff(measure.arrow, axis=0).T).sum() > 0


def test_a_direction_that_a_body_does_not_show_is_named():
    """Legs that lie along their y axes, and the links of a chain along x."""
    named = {each.text: each.axis for each in drawn("19.3.24/model").scenery.dimensions}
    assert {axis.text for axis in named.values()} == {r"x_{\text{stance}}", r"x_{\text{swing}}"}
    assert not any(each.axis for each in drawn("GEN-CHAIN/model").scenery.dimensions)


def test_it_is_in_every_derivation_of_what_moves():
    model = mechanism("19.3.3/model")
    for document in (model.equations(), model.equations("brute"), topic(model, "lagrange")):
        html = document.html()
        figures = [block.name for block in document.blocks if isinstance(block, Figure)]
        assert figures[:1] == ["sketch"] and html.count("<svg") == len(figures) and "[Figure" not in html
        own = re.findall(r' id="([^"]*)"', html)
        assert own and len(own) == len(set(own))
        assert set(re.findall(r"url\(#([^)]*)\)", html)) <= set(own)
        assert "x, x of P from ground at plane" in document.markdown()


def test_pictures_of_different_models_have_no_identifier_in_common():
    found = [drawn(model).inline() for model in ("EX-ARM/model", "EX-ARM/relative")]
    assert not set.intersection(*(set(re.findall(r' id="([^"]*)"', each)) for each in found))

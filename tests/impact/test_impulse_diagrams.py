"""Impulse diagrams: complete, equal and opposite, without finite forces, legible."""

from collections import Counter, defaultdict
from functools import cache
from itertools import combinations

import numpy as np
import pytest
from colliding import ALL, first_impacts, mechanism
from matplotlib.transforms import Bbox
from store import every
from typer.testing import CliRunner

from freebody.catalogue import model_file
from freebody.cli import app
from freebody.views.diagram.arrows import Arrow
from freebody.views.diagram.impulses import impulse_diagram
from freebody.views.labels import extent

every_model = every(ALL, "name", share=4)


@cache
def drawn(name):
    [impact, *_] = first_impacts(name)
    return impact, impulse_diagram(impact)


def acts(part):
    return any(part.force) or part.couple != 0


@every_model
def test_every_impulse_on_a_body_is_drawn_once_and_nothing_else(name):
    impact, diagram = drawn(name)
    for cut in diagram.cuts:
        [body] = cut.group
        due = Counter(load.symbol for load in impact.acting for part in load.on if part.body == body and acts(part))
        made = Counter(load.symbol for mark in cut.forces for load in mark.action.loads)
        assert made == due
        assert all("J_" in mark.action.label for mark in cut.forces)


@every_model
def test_two_sides_of_a_cut_are_equal_and_opposite(name):
    impact, diagram = drawn(name)
    sides = defaultdict(list)
    for cut in diagram.cuts:
        for mark in cut.forces:
            if isinstance(mark, Arrow):
                sides[mark.action.loads[0].symbol].append(mark)
    pairs = [load for load in impact.acting if len({part.body for part in load.on} - {"ground"}) == 2 == len(load.on)]
    for load in pairs:
        if sides[load.symbol]:
            one, other = (mark.action for mark in sides[load.symbol])
            assert one.label == other.label
            assert one.force == pytest.approx(-other.force, abs=1e-9)


@every_model
def test_the_other_side_is_the_jump_of_momentum(name):
    impact, diagram = drawn(name)
    for cut in diagram.cuts:
        [body] = cut.group
        stated = {mark.action.label for mark in cut.effective}
        assert all(r"\Delta" in label for label in stated)
        struck_body = bool(impact.impulses.on(body)) and impact.impulses.bodies[body].mass > 0
        assert bool(stated) == struck_body


@every_model
def test_what_is_absent_is_said_below(name):
    impact, diagram = drawn(name)
    for cut in diagram.cuts:
        assert [f"Absent: {sentence}." for sentence in impact.absent(*cut.group)] == list(cut.notes)


@every_model
@pytest.mark.parametrize("scaled", [False, True])
def test_no_two_labels_overlap(name, scaled):
    [impact, *_] = first_impacts(name)
    figure = impulse_diagram(impact, scaled=scaled).figure
    [axes] = figure.axes
    boxes = []
    for text in axes.texts:
        if text.get_label() == "label":
            size = extent(text.get_text(), text.get_fontsize(), text.get_fontweight() == "bold")
            boxes.append(Bbox.from_bounds(*np.subtract(text.get_position(), size / 2), *size))
    for a, b in combinations(boxes, 2):
        assert min(a.x1, b.x1) <= max(a.x0, b.x0) or min(a.y1, b.y1) <= max(a.y0, b.y0)


@every_model
def test_to_scale_the_arrows_add_up(name):
    [impact, *_] = first_impacts(name)
    for cut in impulse_diagram(impact, scaled=True).cuts:
        if cut.per_newton is None or any("not determined" in note or "longer" in note for note in cut.notes):
            continue
        sums = [sum((mark.head - mark.tail for mark in marks if isinstance(mark, Arrow)), np.zeros(2))
                for marks in (cut.forces, cut.effective)]  # fmt: skip
        assert sums[0] == pytest.approx(sums[1], abs=1e-6)


def test_the_command_writes_a_picture(tmp_path):

    model, file = str(model_file("19.3.22/model")), tmp_path / "blow.svg"
    done = CliRunner().invoke(app, ["diagram", model, "--impact", "1", "-o", str(file)])
    assert done.exit_code == 0, done.output
    assert "impulse diagrams" in file.read_text(encoding="utf-8")
    wrong = CliRunner().invoke(app, ["diagram", model, "--impact", "7", "-o", str(file)])
    assert wrong.exit_code == 2 and "none of number 7" in wrong.output
    placed = CliRunner().invoke(app, ["diagram", model, "--impact", "1", "--at", "xA=0", "-o", str(file)])
    assert placed.exit_code == 2 and "--at takes a time" in placed.output


def test_groups_and_times():
    m = mechanism("links")
    [cut] = m.impulse_diagram("all").cuts
    assert {mark.action.loads[0].name for mark in cut.forces} == {"way"}
    assert m.impulse_diagram(at="10 ms").cuts

"""Free-body diagrams of every model of the catalogue: complete, equal and opposite, legible."""

import json
from collections import Counter, defaultdict
from functools import cache
from itertools import combinations

import numpy as np
import pytest

from freebody import catalogue
from freebody.model import Mechanism
from freebody.views.diagram.arrows import Arrow

MODELS = {f"{system.id}/{path.stem}": path for system in catalogue.systems() for path in system.models}
WITHOUT_ANSWER = {"19.3.23/idle"}  # a body without inertia moves freely: no instant, so no loads
every_model = pytest.mark.parametrize("model", sorted(set(MODELS) - WITHOUT_ANSWER))


@cache
def mechanism(model):
    return Mechanism.load(MODELS[model])


@cache
def drawn(model, of=None):
    return mechanism(model).diagram(of)


@cache
def told(model):
    """The loads as the core tells them."""
    state, _ = mechanism(model).start()
    return json.loads(mechanism(model).compile().free_bodies(state.p, state.t, state.q, state.u))["loads"]


def way(mark):
    """Unit direction of an arrow with a 0, or the sense of a couple behind two of them."""
    if isinstance(mark, Arrow):
        return np.array([*(mark.head - mark.tail) / np.hypot(*(mark.head - mark.tail)), 0.0])
    start, end = mark.line[0] - mark.centre, mark.line[1] - mark.centre
    return np.array([0.0, 0.0, np.sign(start[0] * end[1] - start[1] * end[0])])


def drawn_loads(cut):
    return Counter(load.symbol for mark in cut.forces for load in mark.action.loads)


def test_only_models_without_answer_have_no_diagram():
    from freebody import MotionError

    for model in WITHOUT_ANSWER:
        with pytest.raises(MotionError):
            mechanism(model).diagram()


def acts(on):
    return any(on["force"]) or on["couple"] != 0


def still(model):
    """Known loads that are 0 at the instant: they have a direction only a little further on."""
    return {load["symbol"] for load in told(model) if not any(acts(on) for on in load["on"])}


@every_model
def test_every_load_on_a_body_is_drawn_once(model):
    for cut in drawn(model).cuts:
        [body] = cut.group
        due = Counter(load["symbol"] for load in told(model) for on in load["on"] if on["body"] == body and acts(on))
        assert Counter({s: n for s, n in drawn_loads(cut).items() if s not in still(model)}) == due


@every_model
def test_a_load_that_is_zero_is_drawn_as_well(model):
    seen = sum((drawn_loads(cut) for cut in drawn(model).cuts), Counter())
    assert all(seen[symbol] for symbol in still(model))


def test_there_are_loads_that_are_zero():
    assert still("S19.19/model") == {"spring"}
    assert len(still("GEN-STEP/model")) == 6


@every_model
def test_what_acts_within_a_group_is_not_drawn(model):
    [cut] = drawn(model, "all").cuts
    outer = [load for load in told(model) if "ground" in load["of"] or "ground" in [on["body"] for on in load["on"]]]
    due = Counter(load["symbol"] for load in outer for on in load["on"] if on["body"] in cut.group and acts(on))
    assert Counter({s: n for s, n in drawn_loads(cut).items() if s not in still(model)}) == due


@every_model
def test_two_sides_of_a_cut_are_equal_and_opposite(model):
    sides = defaultdict(list)
    for cut in drawn(model).cuts:
        for mark in cut.forces:
            for load in mark.action.loads:
                sides[load.symbol].append(mark)
    pairs = [
        load["symbol"] for load in told(model) if len({on["body"] for on in load["on"]} - {"ground"}) == 2 == len(load["on"])
    ]
    for symbol in pairs:
        one, other = sides[symbol]
        assert one.action.label == other.action.label
        assert way(one) == pytest.approx(-way(other), abs=1e-9), symbol


def test_there_are_cuts_between_bodies_to_be_equal_and_opposite():
    assert sum(len({on["body"] for on in load["on"]} - {"ground"}) == 2 for load in told("GEN-FOURBAR/model")) == 4


@every_model
@pytest.mark.parametrize("of", [None, "all"])
def test_no_two_labels_overlap(model, of):
    figure = drawn(model, of).figure
    figure.canvas.draw()
    [axes] = figure.axes
    boxes = [text.get_window_extent() for text in axes.texts if text.get_label() == "label"]
    for a, b in combinations(boxes, 2):
        width, height = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
        assert width <= 0 or height <= 0, (width, height)
    page = figure.bbox
    for box in boxes:
        assert page.x0 <= box.x0 and box.x1 <= page.x1 and page.y0 <= box.y0 and box.y1 <= page.y1


@every_model
def test_forces_of_hinges_touch_their_pins(model):
    now = mechanism(model).solve()
    joints = {j["name"]: j["with"]["of"] for j in json.loads(mechanism(model).source().spec)["joints"] if j["type"] == "hinge"}
    for cut in drawn(model).cuts:
        scale = cut.row.panels[0].scenery.scale
        for mark in cut.forces:
            if mark.action.kind == "joint" and mark.action.name in joints:
                pin = scale * np.array([[now[f"x({p})"], now[f"y({p})"]] for p in joints[mark.action.name]])
                ends = np.array([mark.tail, mark.head])
                gaps = np.hypot(*(pin[:, None] - ends[None]).transpose(2, 0, 1))
                assert gaps.min() < 1e-6 * scale, (mark.action.label, gaps)


@every_model
def test_arrows_can_be_seen(model):
    marks = [mark for cut in drawn(model).cuts for mark in cut.forces + cut.effective]
    for mark in marks:
        assert np.hypot(*np.diff(mark.line, axis=0).T).sum() >= 36.0 - 1e-9


@every_model
def test_to_scale_the_arrows_on_a_body_add_up_to_the_effective_side(model):
    for cut in mechanism(model).diagram(to_scale=True).cuts:
        if cut.row.per_newton is None or any("not determined" in note or "longer" in note for note in cut.row.notes):
            continue
        scale = cut.row.panels[0].scenery.scale
        sides = []
        for marks in (cut.forces, cut.effective):
            rows = [np.zeros(3)]
            for mark in marks:
                if isinstance(mark, Arrow):
                    force, at = (mark.head - mark.tail) / cut.row.per_newton, mark.at / scale
                    rows.append(np.array([*force, at[0] * force[1] - at[1] * force[0]]))
                else:
                    rows.append(np.array([0.0, 0.0, mark.action.couple]))
            sides.append(np.array(rows))
        size = np.abs(np.vstack(sides)).max(axis=0)
        particle = cut.row.panels[0].scenery.sketch.spec["bodies"]
        only_forces = any(body["particle"] and body["name"] in cut.group for body in particle)
        gap = np.abs(sides[0].sum(axis=0) - sides[1].sum(axis=0))
        assert (gap[:2] <= 1e-8 * size[:2].max()).all()
        assert only_forces or gap[2] <= 1e-8 * max(size[2], size[:2].max() * 100 / scale)

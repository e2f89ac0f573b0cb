"""Free-body diagrams of every model of the catalogue: complete, equal and opposite, legible."""

from collections import Counter, defaultdict
from dataclasses import replace
from functools import cache
from itertools import combinations

import numpy as np
import pytest
import store
from store import WITHOUT_ANSWER, every, mechanism
from store import diagram as drawn

from freebody.core import FreeBodies, cards
from freebody.equations import Nomenclature, Sym, SymbolEntry, latex
from freebody.solve.symbols import Symbols
from freebody.views.diagram.arrows import Arrow, shared
from freebody.views.labels import extent

LONG_LETTERS = {"GEN-CAR/driveshaft": 110}  # mm; "pinion bearing" and "axle" at the two ends of the car, and three more between
every_model = every(sorted(set(store.SYSTEMS) - WITHOUT_ANSWER), share=60)


@cache
def free_bodies(model):
    """The bodies and loads as the core tells them."""
    state, _ = store.start(model)
    return mechanism(model).compile().mechanism.free_bodies(state.arrays)


@cache
def stated(model):
    return free_bodies(model)["loads"]


def going(body, place):
    """Velocity of a place on a body, a moment later, fixed axes."""
    x, y = np.subtract(place, body["G"])
    return sum(
        step * (np.array(body[v]) + body[w] * np.array([-y, x])) for v, w, step in (("v", "omega", 1), ("a", "alpha", 1e-3))
    )


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


def immobile(model):
    """Known loads that are 0 at the instant: they have a direction only a little further on."""
    return {load["symbol"] for load in stated(model) if not any(acts(on) for on in load["on"])}


@every_model
def test_every_load_on_a_body_is_drawn_once(model):
    for cut in drawn(model).cuts:
        [body] = cut.group
        due = Counter(load["symbol"] for load in stated(model) for on in load["on"] if on["body"] == body and acts(on))
        assert Counter({s: n for s, n in drawn_loads(cut).items() if s not in immobile(model)}) == due


@every_model
def test_a_load_that_is_zero_is_drawn_as_well(model):
    seen = sum((drawn_loads(cut) for cut in drawn(model).cuts), Counter())
    assert all(seen[symbol] for symbol in immobile(model))


def test_there_are_loads_that_are_zero():
    assert immobile("S19.19/model") == {"spring", "motor.weight", "load.weight"}
    assert immobile("19.3.23/model") == {"rod1.weight"}
    assert len(immobile("GEN-STEP/model")) == 6


@pytest.mark.parametrize("model", ["S19.19/model", "19.3.23/model"])
def test_a_weight_that_is_zero_points_down(model):
    weights = [mark for cut in drawn(model).cuts for mark in cut.forces if mark.action.kind == "weight"]
    assert len(weights) == 2
    for mark in weights:
        assert way(mark) == pytest.approx([0, -1, 0], abs=1e-9)


def test_a_mass_that_is_zero_by_a_parameter_has_an_effective_side():
    upper, _ = drawn("19.3.23/model").cuts
    assert {mark.action.label for mark in upper.effective} >= {r"m_1\,a_{\text{rod1},x}", r"m_1\,a_{\text{rod1},y}"}


@every_model
def test_a_load_has_one_symbol_on_diagrams_and_in_equations(model):
    """LaTeX of its symbol printed with the symbols of the model; a pair of loads has two symbols."""
    loads = {load.symbol: load for load in FreeBodies.read(free_bodies(model)).loads}
    source = mechanism(model).source()
    names = Symbols.of(source, loads.values(), {}).loads
    letters = Nomenclature({symbol: SymbolEntry(symbol, "unknown", written=name) for symbol, name in names.items()})
    printed = {symbol: latex(Sym(symbol), letters) for symbol in names}
    for cut in drawn(model).cuts:
        for mark in cut.forces:
            [load] = mark.action.loads
            if load.kind != "weight" and not load.follows:
                assert mark.action.label == printed[load.symbol]
    reactions = [printed[symbol] for symbol, load in loads.items() if load.unknown]
    assert len(set(reactions)) == len(reactions)


def sliding(model):
    return [load for load in stated(model) if load["follows"]]


@pytest.mark.parametrize("model", ["S19.15/model", "S19.15/free"])
def test_friction_that_slides_is_against_the_sliding(model):
    """Its power on the two bodies together, at the velocities that their touching points take up, is below zero."""
    free = free_bodies(model)
    bodies = {body["name"]: body for body in free["bodies"]}
    assert sliding(model)
    for load in sliding(model):
        marks = {
            mark.action.body: mark
            for cut in drawn(model).cuts
            for mark in cut.forces
            if mark.action.loads[0].symbol == load["symbol"]
        }
        power = sum(
            way(marks[on["body"]])[:2] @ going(bodies[on["body"]], on["point"]) for on in load["on"] if on["body"] in marks
        )
        assert power < 0
        assert all(mark.action.label.startswith(r"\mu\,N_{\text{face}") for mark in marks.values())


@every_model
def test_what_acts_within_a_group_is_not_drawn(model):
    [cut] = drawn(model, "all").cuts
    outer = [
        load for load in stated(model) if "ground" in load["of"] or any(on["body"] == "ground" and acts(on) for on in load["on"])
    ]
    due = Counter(load["symbol"] for load in outer for on in load["on"] if on["body"] in cut.group and acts(on))
    assert Counter({s: n for s, n in drawn_loads(cut).items() if s not in immobile(model)}) == due


@every_model
def test_two_sides_of_a_cut_are_equal_and_opposite(model):
    sides = defaultdict(list)
    for cut in drawn(model).cuts:
        for mark in cut.forces:
            for load in mark.action.loads:
                sides[load.symbol].append(mark)
    pairs = [
        load["symbol"] for load in stated(model) if len({on["body"] for on in load["on"]} - {"ground"}) == 2 == len(load["on"])
    ]
    for symbol in pairs:
        one, other = sides[symbol]
        assert one.action.label == other.action.label
        assert way(one) == pytest.approx(-way(other), abs=1e-9), symbol


def test_there_are_cuts_between_bodies_to_be_equal_and_opposite():
    assert sum(len({on["body"] for on in load["on"]} - {"ground"}) == 2 for load in stated("GEN-FOURBAR/model")) == 4


def test_the_motor_of_an_elbow_is_internal_to_both_arms():
    """It drives a difference of absolute angles, of which nothing is left for ground to take."""
    upper, forearm = (drawn_loads(cut) for cut in drawn("EX-ARM/held").cuts)
    assert upper["'elbow motor'.force"] == forearm["'elbow motor'.force"] == 1
    assert set(drawn_loads(drawn("EX-ARM/held", "all").cuts[0])) == {
        "shoulder.Fx", "shoulder.Fy", "'shoulder motor'.force", "upper.weight", "forearm.weight"}  # fmt: skip


@every_model
def test_a_tension_pulls(model):
    """The arrow of a string, a link or a spring between points begins at its body."""
    spec = mechanism(model).source().spec
    springs = {force["name"] for force in spec["forces"] if force["type"] == "spring" and "between" in force["with"]}
    links = {joint["name"] for joint in spec["joints"] if joint["type"] == "link"}
    for cut in drawn(model).cuts:
        for mark in cut.forces:
            action = mark.action
            if action.kind == "string" or action.name in links or (action.kind == "force" and action.name in springs):
                assert mark.at is mark.tail


def test_strings_that_are_taut_without_load_are_drawn():
    """On both of their ends, though they carry nothing at the start; to scale a line says so."""
    seen = sum((drawn_loads(cut) for cut in drawn("19.3.2/with_spin").cuts), Counter())
    assert seen["p.tension"] == seen["q.tension"] == 2
    assert [cut.notes for cut in drawn("19.3.2/with_spin", None, True).cuts] == [["T_p, T_q = 0"], ["T_p = 0"], ["T_q = 0"]]


def test_there_are_tensions():
    marks = [
        mark for model in ("19.3.21/model", "S19.18/model", "19.3.14/model") for cut in drawn(model).cuts for mark in cut.forces
    ]
    assert sum(mark.action.pulls for mark in marks) >= 4


@every_model
def test_the_couple_of_a_motor_stands_at_its_joint(model):
    """The open circle goes round the joint, or stands beside it."""
    hinges = {j["name"]: (j["with"]["of"][1], {j["first"], j["second"]}) for j in joints(model) if j["type"] == "hinge"}
    now = store.instant(model)
    for cut in drawn(model).cuts:
        scale = cut.panels[0].scenery.scale
        for mark in cut.forces:
            [load] = mark.action.loads
            places = [point for point, pair in hinges.values() if pair == set(load.of)]
            if mark.action.turns and mark.action.kind in ("force", "motion") and len(places) == 1:
                pin = scale * np.array([now[f"x({places[0]})"], now[f"y({places[0]})"]])
                assert np.hypot(*(mark.centre - pin)) <= 38.0 + 1e-6 * scale


def joints(model):
    """The joints of a model with their fields and the names of their bodies."""
    source = mechanism(model).source()
    metadata = {joint["name"]: joint for joint in source.metadata["joints"]}
    spec = source.spec["joints"]
    return [joint | metadata[joint["name"]] | {"type": joint["type"]} for joint in spec if joint["name"] in metadata]


def labels(axes):
    return [text for text in axes.texts if text.get_label() == "label"]


def middle(text):
    return np.array(text.get_position())  # a unit of the axes is a point of the page


def size(text):
    return extent(text.get_text(), text.get_fontsize(), text.get_fontweight() == "bold")


@pytest.mark.parametrize("model", ["19.3.13/model", "GEN-CHAIN/model"])
def test_labels_are_as_large_and_where_they_are_taken_to_be(model):
    [axes] = drawn(model).figure.axes
    for text in labels(axes):
        box = text.get_window_extent()
        assert (box.width, box.height) == pytest.approx(size(text), abs=1.5)
        assert (box.x0 + box.x1) / 2 == pytest.approx(middle(text)[0], abs=1.0)
        assert (box.y0 + box.y1) / 2 == pytest.approx(middle(text)[1], abs=1.0)


@every_model
def test_a_sheet_is_no_wider_than_its_column(model):
    """160 mm, and for every body by itself also 85 mm, if the symbols on one line leave room for the body; they are as large on both."""
    sheets = [drawn(model), drawn(model, "all"), drawn(model, None, True)]
    narrow = LONG_LETTERS.get(model, 85)
    for sheet, column in [*((each, 160) for each in sheets), (drawn(model, column=85.0), narrow)]:
        assert sheet.figure.get_size_inches()[0] * 25.4 <= column + 1e-6
        assert min(text.get_fontsize() for text in sheet.figure.axes[0].texts) >= 8.0


@every_model
def test_forces_of_hinges_touch_their_pins(model):
    """Or stand beside them, where another force has the same line; not those of a detail, which begin at its rim."""
    now = store.instant(model)
    joints = {j["name"]: j["with"]["of"] for j in mechanism(model).source().spec["joints"] if j["type"] == "hinge"}
    for cut in drawn(model).cuts:
        scale = cut.panels[0].scenery.scale
        for mark in cut.panels[0].marks:
            if mark.action.kind == "joint" and mark.action.name in joints:
                pin = scale * np.array([[now[f"x({p})"], now[f"y({p})"]] for p in joints[mark.action.name]])
                ends = np.array([mark.tail, mark.head])
                gaps = np.hypot(*(pin[:, None] - ends[None]).transpose(2, 0, 1))
                others = [other for other in cut.panels[0].marks if other is not mark and isinstance(other, Arrow)]
                beside = any(shared(onto(mark, scale), onto(other, scale)) for other in others)
                assert gaps.min() < (12.0 if beside else 1e-6 * scale), (mark.action.label, gaps)


def onto(mark, scale):
    """An arrow moved onto its own line, and made long enough to meet any other there."""
    way, at = (mark.head - mark.tail) / mark.length, scale * mark.action.at
    return replace(mark, at=at, tail=at - 72.0 * way, head=at + 72.0 * way)


@every_model
@pytest.mark.parametrize("of", [None, "all"])
@pytest.mark.parametrize("to_scale", [False, True])
def test_no_arrow_lies_on_another(model, of, to_scale):
    """Where they meet they touch."""
    for cut in drawn(model, of, to_scale).cuts:
        for panel in (*cut.panels, *cut.apart):
            for one, other in combinations((mark for mark in panel.marks if isinstance(mark, Arrow)), 2):
                assert shared(one, other) <= 0.5, (cut.group, one.action.label, other.action.label)


@every_model
def test_the_normal_forces_of_the_ground_are_drawn_upwards(model):
    """N stands on the side that supports: against gravity, where a guide of the ground is not upright."""
    spec = mechanism(model).compile().spec
    gravity = np.array([x if isinstance(x, float | int) else 0.0 for x in spec.get("gravity") or (0, 0)])
    for mark in (mark for cut in drawn(model).cuts for mark in cut.forces):
        for load in mark.action.loads:
            if load.kind == "joint" and load.card.presses and "ground" in load.of and mark.action.body != "ground":
                assert mark.action.force @ gravity < 1e-9 * (1 + np.hypot(*gravity)), load.symbol


@every_model
@pytest.mark.parametrize("to_scale", [False, True])
def test_what_presses_is_drawn_from_outside_onto_its_surface(model, to_scale):
    """Normal forces of contacts push with their heads; those of sliders on the face that lies on the guide, in no body."""
    for cut in drawn(model, None, to_scale).cuts:
        scenery = cut.panels[0].scenery
        sliders = {joint["name"] for joint in scenery.sketch.metadata["joints"] if cards.joints()[joint["type"]].slides}
        for mark in (mark for mark in cut.forces if isinstance(mark, Arrow)):
            [load, *_] = mark.action.loads
            slides = load.kind == "joint" and load.name in sliders and load.card.presses
            if slides or (load.kind == "contact" and load.card.presses):
                assert np.array_equal(mark.head, mark.at), load.symbol
            if slides and mark.action.body == load.of[1]:
                assert not scenery.within(mark.head + np.linspace(0.05, 0.95, 9)[:, None] * (mark.tail - mark.head)), load.symbol


@every_model
def test_a_sheet_to_scale_has_one_scale(model):
    """Arrows of one length are forces of one size, on whichever body; only what would be all head is drawn longer, and said."""
    found = drawn(model, None, True)
    assert len({cut.per_newton for cut in found.cuts if cut.per_newton is not None}) <= 1
    for cut in found.cuts:
        longer = next((note for note in cut.notes if note.startswith("drawn longer than to scale: ")), "")
        for mark in (mark for mark in cut.forces + cut.effective if isinstance(mark, Arrow)):
            true = mark.action.size * cut.per_newton
            assert mark.length == pytest.approx(true, rel=1e-9) or (mark.length > true and mark.action.sign.plain in longer)


@every_model
def test_to_scale_the_arrows_on_a_body_add_up_to_the_effective_side(model):
    for cut in drawn(model, None, True).cuts:
        if cut.per_newton is None or any("not determined" in note or "longer" in note for note in cut.notes):
            continue
        scale = cut.panels[0].scenery.scale
        sides = []
        for marks in (cut.forces, cut.effective):
            rows = [np.zeros(3)]
            for mark in marks:
                if isinstance(mark, Arrow):
                    force, at = (mark.head - mark.tail) / cut.per_newton, mark.action.at
                    rows.append(np.array([*force, at[0] * force[1] - at[1] * force[0]]))
                else:
                    rows.append(np.array([0.0, 0.0, mark.action.couple]))
            sides.append(np.array(rows))
        size = np.abs(np.vstack(sides)).max(axis=0)
        particle = cut.panels[0].scenery.sketch.spec["bodies"]
        only_forces = any(body["particle"] and body["name"] in cut.group for body in particle)
        gap = np.abs(sides[0].sum(axis=0) - sides[1].sum(axis=0))
        assert (gap[:2] <= 1e-8 * size[:2].max()).all()
        assert only_forces or gap[2] <= 1e-8 * max(size[2], size[:2].max() * 100 / scale)

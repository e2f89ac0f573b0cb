"""Files and the builder say the same; comments survive; the committed schema is current."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from freebody.mechanism import Mechanism
from freebody.model import file, schema
from freebody.model.errors import ModelFileError
from freebody.model.reading import reads

COMMENTED = """\
# the new gun
freebody: 1
name: new gun
parameters: {T: 1 N*m, l: 1.0 m, m2: 1 kg, m1: m2/3}   # as in the book
gravity: none
bodies:
  # the barrel
  rod:    {shape: rod, length: l, mass: m1, points: {A: start, B: end}}   # uniform

  collar: {shape: particle, mass: m2, points: {C: centre}}
joints:
  pivot:  {type: hinge, of: [ground.O, rod.A], coordinate: theta}
  track:  {type: slot, point: collar.C, along: [rod.A, rod.B], coordinate: R}
forces:
  motor:  {type: torque, on: rod, from: ground, value: T}
initial:  {theta: 0, R: 0.1 m, at_rest: true}
events:
  leaves: {when: R - l, direction: rising, then: stop}
run:      {until: 5 s, rtol: 1e-10}
report:
  exit speed: speed(collar.C) @ leaves   # m/s
"""


def new_gun() -> Mechanism:
    m = Mechanism("new gun", gravity="none")
    m.parameter("T", "1 N*m")
    length = m.parameter("l", "1.0 m")
    m2 = m.parameter("m2", "1 kg")
    m1 = m.parameter("m1", "m2/3")
    rod = m.rod("rod", length=length, mass=m1)
    collar = m.particle("collar", mass=m2)
    a, b = rod.point("A", rod.start), rod.point("B", rod.end)
    c = collar.point("C", collar.centre)
    m.hinge(m.ground.O, a, name="pivot", coordinate="theta")
    m.slot(name="track", point=c, along=[a, b], coordinate="R")
    m.torque(name="motor", on=rod, from_="ground", value="T")
    m.initial(theta=0, R="0.1 m", at_rest=True)
    m.event("leaves", when="R - l", direction="rising", then="stop")
    m.run_settings(until="5 s", rtol=1e-10)
    m.report("exit speed", "speed(collar.C) @ leaves")
    return m


def test_file_and_builder_say_the_same():
    assert reads(COMMENTED)[0] == new_gun().model


def test_what_the_builder_made_reads_back(tmp_path):
    m = new_gun()
    for name in ("gun.yaml", "gun.json"):
        m.save(tmp_path / name)
        assert Mechanism.load(tmp_path / name) == m


def test_an_unchanged_file_is_saved_as_it_was(tmp_path):
    (tmp_path / "gun.yaml").write_text(COMMENTED)
    Mechanism.load(tmp_path / "gun.yaml").save(tmp_path / "copy.yaml")
    kept = (tmp_path / "copy.yaml").read_text()
    assert [line.split("#")[0].split() for line in kept.splitlines()] == [
        line.split("#")[0].split() for line in COMMENTED.splitlines()
    ]


def test_comments_survive_a_change(tmp_path):
    (tmp_path / "gun.yaml").write_text(COMMENTED)
    m = Mechanism.load(tmp_path / "gun.yaml")
    m.disk("wheel", radius="200 mm", mass=2)
    m.hinge(m.ground.O, m["wheel"].centre, name="axle")
    m.model.parameters["T"] = "2 N*m"
    m.save(tmp_path / "gun.yaml")
    text = (tmp_path / "gun.yaml").read_text()
    for comment in ("# the new gun", "# as in the book", "# the barrel", "# uniform", "# m/s"):
        assert comment in text
    assert "1.0 m" in text
    assert Mechanism.load(tmp_path / "gun.yaml") == m


def test_saving_twice_changes_nothing(tmp_path):
    new_gun().save(tmp_path / "a.yaml")
    Mechanism.load(tmp_path / "a.yaml").save(tmp_path / "b.yaml")
    assert (tmp_path / "a.yaml").read_text() == (tmp_path / "b.yaml").read_text()


def test_the_example_of_the_page_runs():
    page = (Path(__file__).parents[2] / "docs" / "model_file.md").read_text()
    example = page.split("```yaml\n")[1].split("```")[0]
    m = Mechanism.loads(example)
    q = m.compile().assemble(**m.initial_state())[0].q
    assert list(q) == [0.0, 0.1]
    assert m.report_items()[0].at == "leaves"


def test_every_example_of_the_page_is_in_the_language():
    page = (Path(__file__).parents[2] / "docs" / "model_file.md").read_text()
    examples = [text.split("```")[0] for text in page.split("```yaml\n")[2:]]
    assert examples and all(reads(f"freebody: 1\n{text}")[0] for text in examples)


def test_json_with_tabs_is_accepted():
    text = json.dumps(new_gun().model.written(), indent="\t")
    assert reads(text)[0] == new_gun().model


# -- any model reads back as it was ----------------------------------------------------------------

words = st.text("abcxyzÄθ _0123456789", min_size=1, max_size=8).map(str.strip).filter(lambda w: w and not w[0].isdigit())
odd_texts = st.sampled_from(
    ["no", "null", "1", "1e3", "~", "-", "yes", "a: b", "# x", "2020-01-01", "=", "0x10", "'q'", '"', "x  y", "*a", "{a}"]
)
numbers = st.one_of(
    st.integers(-(10**20), 10**20),
    st.floats(allow_nan=False, allow_infinity=False),
    st.sampled_from(["400 mm", "2*l", "30 deg", "m2/3", "'crank drive'.force"]),
    odd_texts.filter(lambda text: text != "2020-01-01"),  # a date is no number
)
refs = st.sampled_from(["ground.O", "rod.start", "crank drive.end", "link[1].end"])
pairs = st.lists(numbers, min_size=2, max_size=2)
named = lambda values: st.dictionaries(st.one_of(words, odd_texts), values, max_size=3)
bodies = st.one_of(
    st.fixed_dictionaries(
        {"shape": st.just("rod"), "length": numbers, "mass": numbers}, optional={"points": named(st.one_of(refs, pairs))}
    ),
    st.fixed_dictionaries({"mass": numbers}, optional={"inertia": numbers, "centre": pairs, "outline": st.just("none")}),
    st.fixed_dictionaries(
        {"shape": st.just("polygon"), "corners": st.lists(pairs, min_size=3, max_size=5), "mass": numbers},
        optional={"lines": named(st.fixed_dictionaries({"through": refs, "angle": numbers}))},
    ),
)
coordinates = st.one_of(words, st.fixed_dictionaries({"name": words}, optional={"zero": numbers, "absolute": st.booleans()}))
joints = st.one_of(
    st.fixed_dictionaries(
        {"type": st.just("hinge"), "of": st.lists(refs, min_size=2, max_size=3)}, optional={"coordinate": coordinates}
    ),
    st.fixed_dictionaries({"type": st.just("slot"), "along": st.lists(refs, min_size=2, max_size=2), "point": refs}),
    st.fixed_dictionaries(
        {"type": st.just("gear"), "of": st.lists(refs, min_size=2, max_size=2), "radii": pairs, "internal": st.booleans()}
    ),
)
surfaces = st.one_of(
    refs,
    st.lists(refs, min_size=2, max_size=2),
    st.fixed_dictionaries({"centre": refs, "radius": numbers}, optional={"hollow": st.booleans()}),
    st.fixed_dictionaries({"polyline": st.lists(refs, min_size=2, max_size=3)}),
)
ends = st.one_of(
    refs,
    st.fixed_dictionaries({"drum": refs, "radius": numbers, "sense": st.sampled_from(["ccw", "clockwise"]), "wound": numbers}),
)
several = st.one_of(words, st.lists(words, min_size=1, max_size=2))
deeds = st.one_of(
    st.sampled_from(["record", "stop"]),
    st.fixed_dictionaries({"cut": several}, optional={"set": named(numbers), "lock": words, "reset": named(numbers)}),
    st.fixed_dictionaries({"weld": st.lists(words, min_size=2, max_size=3)}, optional={"release": several, "hand_over": words}),
)
models = st.fixed_dictionaries(
    {"freebody": st.just(1)},
    optional={
        "name": st.one_of(words, odd_texts),
        "parameters": named(numbers),
        "gravity": st.one_of(st.just("none"), numbers, pairs),
        "bodies": named(bodies),
        "joints": named(joints),
        "initial": st.dictionaries(words, numbers, max_size=3),
        "events": named(
            st.fixed_dictionaries(
                {"when": numbers.map(str)}, optional={"then": st.one_of(deeds, st.lists(deeds, max_size=2)), "if": words}
            )
        ),
        "contacts": named(
            st.fixed_dictionaries(
                {"of": st.lists(surfaces, min_size=2, max_size=2)}, optional={"friction": numbers, "engaged": st.booleans()}
            )
        ),
        "strings": named(
            st.fixed_dictionaries(
                {"ends": st.lists(ends, min_size=2, max_size=2)}, optional={"over": st.lists(refs, max_size=2), "length": numbers}
            )
        ),
        "stops": named(st.fixed_dictionaries({"of": words, "least": numbers}, optional={"most": numbers})),
        "report": named(st.one_of(words, st.fixed_dictionaries({"max": words}, optional={"over": pairs, "unit": words}))),
    },
)


@settings(max_examples=150, deadline=None)
@given(models)
def test_any_model_reads_back(data):
    model = schema.Model.model_validate(data)
    text = file.dumps(model)
    assert reads(text)[0] == model
    assert reads(file.dumps(model, text))[0] == model
    assert file.dumps(reads(text)[0]) == text


@settings(max_examples=60, deadline=None)
@given(models, models)
def test_any_change_of_a_file_reads_back(before, after):
    written = "# on top\n" + file.dumps(schema.Model.model_validate(before))
    changed = schema.Model.model_validate(after)
    text = file.dumps(changed, written)
    assert reads(text)[0] == changed


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=60))
def test_no_text_makes_a_traceback(text):
    for whole in (text, f"freebody: 1\nbodies:\n  rod: {{shape: rod, length: {text}}}\n"):
        try:
            reads(whole)[0]
        except ModelFileError as error:
            assert error.problems


# -- the schema ------------------------------------------------------------------------------------


def test_the_committed_schema_is_current():
    committed = Path(__file__).parents[2] / "docs" / "model.schema.json"
    assert json.loads(committed.read_text()) == schema.schema(), "./dev schema > docs/model.schema.json"


def test_the_schema_speaks_of_joints_and_units():
    made = schema.schema()
    assert made["$schema"].endswith("2020-12/schema")
    assert made["$defs"]["Hinge"]["properties"]["type"]["const"] == "hinge"
    assert made["$defs"]["Body"]["properties"]["mass"]["x-unit"] == "kg"
    assert "if" in made["$defs"]["Event"]["properties"]
    with pytest.raises(ModelFileError):
        reads("freebody: 1\nbodys: {}\n")[0]

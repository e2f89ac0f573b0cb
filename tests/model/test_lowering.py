"""From a model to the core: repetition, parts, bodies, curves, start, report, and the way back for errors."""

from __future__ import annotations

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from freebody.core import CompiledModel, ModelError, ReportItem
from freebody.mechanism import Mechanism
from freebody.model import lower, reading, syntax
from freebody.model.errors import ModelFileError


def lowered(text: str, file: str | None = None) -> lower.Lowered:
    model, source = reading.reads("freebody: 1\n" + text)
    return lower.lower(model, source, file)


def value(text, **names) -> float:
    return syntax.evaluate(syntax.parse(text).tree, names.__getitem__) if isinstance(text, str) else text


CHAIN = """
parameters: {N: 3, l: 400 mm}
bodies:
  link[i = 1 .. N]: {shape: rod, length: l*i, mass: 1 kg}
joints:
  pin[i = 1 .. 1]: {type: hinge, of: [ground.O, "link[1].start"], coordinate: "phi[i]"}
  pin[i = 2 .. N]:
    type: hinge
    of:
      - link[i-1].end
      - link[i].start
    coordinate: phi[i]
forces:
  pull: {type: force, at: "link[N].end", x: 2}
initial: {'phi[i = 1 .. N]': i*10 deg, at_rest: true}
report:
  tip of link[i = 1 .. N]: x(link[i].end) @ end
"""


def test_a_chain_is_written_out():
    made = lowered(CHAIN)
    assert [b["name"] for b in made.spec["bodies"]] == ["link[1]", "link[2]", "link[3]"]
    assert made.spec["bodies"][1]["pieces"][0]["sizes"] == {"length": "l*2"}
    assert made.spec["joints"][2]["with"] == {"of": ["link[2].end", "link[3].start"]}
    assert made.spec["forces"][0]["with"] == {"at": "link[3].end", "x": "2.0"}
    assert {k: value(v) for k, v in made.start.fixed.items()} == {
        f"phi[{i}]": pytest.approx(math.radians(10 * i)) for i in (1, 2, 3)
    }
    assert [r.label for r in made.report] == [f"tip of link[{i}]" for i in (1, 2, 3)]


def test_repetition_in_repetition():
    made = lowered("bodies:\n  node[i = 1 .. 2][j = i .. 2]: {mass: 1, centre: [i, j*2]}\n")
    assert [b["name"] for b in made.spec["bodies"]] == ["node[1][1]", "node[1][2]", "node[2][2]"]
    assert [value(v) for v in made.spec["bodies"][1]["pieces"][0]["at"]] == [1, 4]


def test_a_composite_body_with_spokes():
    text = "parameters: {n: 4}\nbodies:\n  wheel:\n    pieces:\n      rim: {shape: ring, radius: 1, mass: 2}\n"
    text += "      spoke[k = 1 .. n]: {shape: rod, length: 1, mass: 0.1, angle: 2*pi*k/n}\n"
    assert len(lowered(text).spec["bodies"][0]["pieces"]) == 5


LEG = """
freebody: 1
name: a leg
parameters: {l: 1 m, m: 2 kg, half: l/2}
ground: {points: {wall: [-1, 0]}}
bodies:
  thigh: {shape: rod, length: l, mass: m, points: {knee: end, middle: [0, half]}, lines: {axis: [start, end]}}
joints:
  hip: {type: hinge, of: [ground.wall, thigh.start], coordinate: angle}
gauges: {height: y(thigh.knee) - l}
forces:
  muscle: {type: torque, on: thigh, value: table(angle)*sin(t)}
tables: {table: {x: [0, 1], y: [0, 2]}}
initial: {angle: 30 deg}
"""


def test_parts_come_in_under_their_name(tmp_path):
    (tmp_path / "leg.yaml").write_text(LEG)
    text = "parameters: {size: 0.4 m}\nparts:\n  left: {file: leg.yaml, parameters: {l: size}}\n  right: {file: leg.yaml}\n"
    text += "bodies: {foot: {mass: 1}}\njoints: {ankle: {type: weld, of: [left.thigh.knee, foot.origin]}}\n"
    text += "initial: {right.angle: 0.1}\nreport: {h: left.height - right.l @ end}\n"
    made = lowered(text, str(tmp_path / "model.yaml"))
    parameters = {p["name"]: p["value"] for p in made.spec["parameters"]}
    assert parameters["left.l"] == 0.4
    assert parameters["right.half"] == "right.l/2"
    assert {"name": "ground.left.wall", "body": "ground", "at": [-1.0, 0.0]} in made.spec["points"]
    assert made.spec["joints"][1]["with"]["of"] == ["ground.left.wall", "left.thigh.start"]
    assert made.spec["joints"][1]["coordinates"] == [{"name": "left.angle"}]
    assert made.spec["gauges"][0]["value"] == "y(left.thigh.knee) - left.l"
    assert made.spec["forces"][0]["with"]["value"] == "left.table(left.angle)*sin(t)"
    assert made.start.fixed == {"left.angle": math.radians(30), "right.angle": 0.1}
    assert made.report[0].value == "left.height - right.l"


def test_a_pin_of_several_bodies_is_named_in_its_part_as_outside(tmp_path):
    leg = "bodies: {thigh: {shape: rod, length: 1, mass: 1}, shank: {shape: rod, length: 1, mass: 1}}\n"
    leg += "joints: {hip: {type: hinge, of: [ground.O, thigh.start, shank.start]}}\n"
    (tmp_path / "leg.yaml").write_text("freebody: 1\n" + leg)
    (tmp_path / "model.yaml").write_text("freebody: 1\nparts: {left: {file: leg.yaml}}\ninitial: {left.hip.thigh.angle: 0.2}\n")
    made = Mechanism.load(tmp_path / "model.yaml")
    assert made.compile().coordinate_names == ["left.hip.thigh.angle", "left.hip.shank.angle"]
    assert made.solve()["left.hip.thigh.angle"] == 0.2
    assert made.compile().metadata["joints"][0]["name"] == "left.hip.thigh"


def test_a_wrong_parameter_of_a_part(tmp_path):
    (tmp_path / "leg.yaml").write_text(LEG)
    with pytest.raises(ModelFileError, match="has no parameter `length`"):
        lowered("parts: {left: {file: leg.yaml, parameters: {length: 1}}}\n", str(tmp_path / "model.yaml"))


def test_bodies():
    made = lowered(
        """
parameters: {a: 2 m}
bodies:
  box:  {shape: rectangle, width: a, height: 30 cm, mass: 3, centre: [0.1, 0], point_masses: [{at: [1, 2], mass: 1}]}
  tri:  {shape: triangle, corners: [[0, 0], [1, 0], [0, 1]], mass: 1, points: {top: [0, 1], same: top, c: G}}
  any:  {mass: 2, inertia: 0.5, centre: [1, 1]}
  bob:  {shape: particle, mass: 1 lbm}
joints:
  t: {type: slot, along: {through: tri.c, angle: 30 deg}, point: bob.centre}
"""
    ).spec
    box, tri, thing, bob = made["bodies"]
    assert box["pieces"][0] == {"shape": "rectangle", "mass": 3.0, "sizes": {"width": "a", "height": 0.3}, "at": [0.1, 0.0]}
    assert box["pieces"][1] == {"shape": "point", "mass": 1.0, "at": [1.0, 2.0]}
    assert tri["pieces"][0]["shape"] == "polygon"
    assert thing["pieces"] == [{"shape": "given", "mass": 2.0, "inertia": 0.5, "at": [1.0, 1.0]}]
    assert bob["particle"] and bob["pieces"][0]["mass"] == 0.45359237
    assert {p["name"]: p["at"] for p in made["points"]}["tri.same"] == [0.0, 1.0]
    assert made["joints"][0]["with"]["along"] == {"point": "tri.G", "angle": math.radians(30)}


def test_coordinates_gravity_motions_events():
    made = lowered(
        """
parameters: {g: 3 m/s^2, w: 2 rad/s}
gravity: g
bodies: {a: {mass: 1}}
joints:
  j: {type: hinge, of: [ground.O, a.origin], coordinate: {name: th, zero: down, sense: clockwise, absolute: true}}
motions: {m: {of: th, is: w*t, level: position}, n: {of: sin(th), is: 0.1, level: velocity}}
events:
  e: {when: th - 90 deg, direction: falling, if: t > 1, then: [{set: {g: 2*g}}, stop]}
  f: {when: a.x}
""".replace("  f: {when: a.x}\n", "  f: {when: x(a.origin)}\n")
    ).spec
    assert made["gravity"] == [0.0, "-(g)"]
    assert made["joints"][0]["coordinates"] == [{"name": "th", "zero": "-pi/2", "sense": -1, "absolute": True}]
    assert made["motions"][0] == {"name": "m", "of": "th", "is": "w*t", "level": "position", "by": None, "engaged": True}
    assert made["events"][0]["then"] == [{"set": {"g": "2*g"}}, "stop"]
    assert (made["events"][0]["direction"], made["events"][0]["condition"]) == (-1, "t > 1")
    assert made["events"][1]["then"] == []


def test_a_track_of_lines_and_arcs():
    text = """
parameters: {r: 2}
ground:
  points: {A: [0, 0], B: [3, 0], C: [3, r], D: [3 + r, r], E: [3 + r, 5]}
  curves: {track: [{line: [A, B]}, {arc: {centre: C, to: D}}, {line: [D, E]}], wheel: {arc: {centre: C, radius: r}}}
"""
    track, wheel = lowered(text).spec["curves"]
    quarter = math.pi  # a quarter of a circle of radius 2
    for s, wanted in {
        -1: (-1, 0),
        1: (1, 0),
        3: (3, 0),
        3 + quarter / 2: (3 + math.sqrt(2), 2 - math.sqrt(2)),
        3 + quarter + 1: (5, 3),
    }.items():
        assert (value(track["x"], s=s, r=2), value(track["y"], s=s, r=2)) == pytest.approx(wanted, abs=1e-12)
    assert (value(wheel["x"], s=0, r=2), value(wheel["y"], s=0, r=2)) == (5, 2)


def test_a_track_with_a_gap():
    with pytest.raises(ModelFileError, match="has a gap"):
        lowered("ground:\n  points: {A: [0, 0], B: [3, 0], C: [4, 0]}\n  curves: {track: [{line: [A, B]}, {line: [C, B]}]}\n")


REPORTS = {
    "v @ end": ReportItem("q", "v", at="end"),
    "v @ 0.3 s": ReportItem("q", "v", at=0.3),
    "v @ 2*T": ReportItem("q", "v", at=4.0),
    "t @ hits the wall": ReportItem("q", "t", at="hits the wall"),
    "v": ReportItem("q", "v", at="end"),
    "max of abs(v)": ReportItem("q", "abs(v)", how="max"),
    "mean of v over 1 s .. T": ReportItem("q", "v", how="mean", over=(1.0, 2.0)),
    "{value: v, at: end, unit: mph}": ReportItem("q", "v", at="end", unit="mph"),
    "{value: v @ end, unit: km/h}": ReportItem("q", "v", at="end", unit="km/h"),
    "{rms: v, over: [0.5 s, 1.5]}": ReportItem("q", "v", how="rms", over=(0.5, 1.5)),
    "{integral: v, unit: mm}": ReportItem("q", "v", how="integral", unit="mm"),
}


@pytest.mark.parametrize("text", REPORTS)
def test_reports(text):
    model = (
        f"parameters: {{v: 3 m/s, T: 2 s}}\nevents: {{hits the wall: {{when: v}}}}\nrun: {{until: 3*T}}\nreport: {{q: {text}}}\n"
    )
    if not text.startswith("{"):
        model = model.replace(f"{{q: {text}}}", f'{{q: "{text}"}}')
    m = Mechanism.loads("freebody: 1\n" + model)
    values = {"v": 3.0, "T": 2.0}
    assert m.report_items(values) == [REPORTS[text]]
    assert m.run_numbers(values).until == 6.0
    assert m.run_numbers({"T": 1.0}).until == 3.0


# -- the way back ----------------------------------------------------------------------------------


@pytest.fixture
def complaining(monkeypatch):
    def complain(*problem):
        def refuse(spec):
            raise ModelError(*problem)

        monkeypatch.setattr(CompiledModel, "of", refuse)

    return complain


def test_complaints_of_the_core_get_their_place(complaining):
    complaining("joints.pin[2].of[1]", "something is wrong", "do better")
    with pytest.raises(ModelFileError) as caught:
        assert lowered(CHAIN).compiled
    (problem,) = caught.value.problems
    assert (problem.where.line, problem.where.column, problem.hint) == (12, 9, "do better")
    complaining("points.link[3].end", "something is wrong", "")
    with pytest.raises(ModelFileError, match="model:5"):
        assert lowered(CHAIN).compiled


def test_complaints_about_the_builder_name_the_call(complaining):
    m = Mechanism("x")
    rod = m.rod("rod", length=1, mass=2)
    m.hinge(m.ground.O, rod.start, name="pivot")
    complaining("joints.pivot.of[0]", "something is wrong", "")
    with pytest.raises(ModelFileError) as caught:
        m.compile()
    where = caught.value.problems[0].where
    assert where.file == __file__
    assert 'm.hinge(m.ground.O, rod.start, name="pivot")' in where.excerpt


# -- never a traceback -----------------------------------------------------------------------------

pieces = st.sampled_from(
    [
        "l",
        "theta",
        "rod",
        "rod.start",
        "t",
        "pi",
        "s",
        "2",
        "0",
        "1e308",
        "3",
        "kg",
        "m",
        "deg",
        "(",
        ")",
        "+",
        "-",
        "*",
        "/",
        "^",
        ",",
        "<",
        "==",
        "and",
        "not",
        "if(",
        "sin(",
        "x(",
        "max(",
        "sqrt(",
        "distance(",
        "angle(",
        "[",
        "]",
        "'",
        "@",
        "of",
        "over",
        "..",
        "i",
        "=",
        "1/0",
        "f(",
        "~",
    ]
)
texts = st.one_of(st.lists(pieces, max_size=8).map(" ".join), st.lists(pieces, max_size=8).map("".join), st.text(max_size=12))


@settings(max_examples=400, deadline=None)
@given(texts, st.integers(0, 12))
def test_no_expression_makes_a_traceback(text, field):
    t = ["0"] * 13
    t[field] = text
    data = {
        "freebody": 1,
        "parameters": {"l": "1 m", "p": t[0], f"q[i = 1 .. {t[1]}]" if t[1] != "0" else "q": "1"},
        "gravity": t[2],
        "bodies": {"rod": {"shape": "rod", "length": "l", "mass": t[3], "points": {"A": t[4] if t[4] != "0" else "start"}}},
        "joints": {"j": {"type": "hinge", "of": ["ground.O", t[5] if t[5] != "0" else "rod.start"], "coordinate": "theta"}},
        "tables": {"f": {"x": [0, 1], "y": [0, 1]}},
        "gauges": {"g": t[6]},
        "motions": {"m": {"of": "g", "is": t[7], "level": "velocity"}},
        "forces": {"s": {"type": "spring", "along": t[8], "stiffness": 2}},
        "initial": {"theta": t[9], "branch": {t[10] or "0": "positive"}},
        "run": {"until": t[11]},
        "report": {"r": t[12]},
    }
    try:
        model, source = reading.reads(json.dumps(data))
        lower.lower(model, source)
    except ModelFileError as error:
        assert error.problems

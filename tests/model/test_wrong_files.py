"""Wrong model files: each error points at its place and says what to do."""

from __future__ import annotations

import pytest

from freebody.model import lower, reading
from freebody.model.errors import ModelFileError

GOOD = """\
freebody: 1
name: pendulum
parameters: {l: 1 m, m1: 1 kg, T: 1 N*m}
bodies:
  rod: {shape: rod, length: l, mass: m1, points: {A: start, B: end}}
joints:
  pivot: {type: hinge, of: [ground.O, rod.A], coordinate: theta}
forces:
  motor: {type: torque, on: rod, value: T}
initial: {theta: 30 deg, at_rest: true}
run: {until: 5 s}
"""

# name: (what stands in GOOD, what stands there instead, line, column, words of the message)
CASES = {
    "unknown section": ("joints:", "joint:", 6, 1, ["unknown key `joint`", "did you mean `joints`?"]),
    "unknown key of a body": ("length: l", "lenght: l", 5, 21, ["unknown key `lenght`", "did you mean `length`?"]),
    "size of another shape": ("length: l", "length: l, radius: 1", 5, 8, ["a rod has no `radius`", "disk or ring"]),
    "size missing": ("length: l, ", "", 5, 8, ["a rod needs a `length`"]),
    "unknown shape": ("shape: rod", "shape: rid", 5, 16, ["`rid`", "did you mean `rod`?"]),
    "body without mass": (" mass: m1,", "", 5, 8, ["this body has no mass", "`mass: 0`"]),
    "negative mass": ("mass: m1", "mass: -2 kg", 5, 38, ["a mass cannot be negative", "-2"]),
    "negative mass by parameters": ("m1: 1 kg", "m1: 1 kg - 3 kg", 5, 38, ["a mass cannot be negative", "`m1` is -2"]),
    "number is empty": ("length: l", "length: ", 5, 28, ["nothing stands here", "write a number"]),
    "unknown joint": ("type: hinge", "type: hinje", 7, 10, ["there is no joint `hinje`", "did you mean `hinge`?"]),
    "joint without type": ("type: hinge, ", "", 7, 10, ["the joint `pivot` has no `type`", "type: hinge"]),
    "field missing": ("of: [ground.O, rod.A], ", "", 7, 3, ["`of` is missing", "add `of:`"]),
    "unknown field": ("coordinate: theta", "coordinat: theta", 7, 47, ["unknown key `coordinat`", "did you mean `coordinate`?"]),
    "one point only": ("[ground.O, rod.A]", "[rod.A]", 7, 28, ["a list of two points"]),
    "unknown point": ("rod.A], coo", "rod.C], coo", 7, 39, ["`rod` has no point `C`", "`A`", "`start`"]),
    "unknown body of a point": ("rod.A], coo", "rd.A], coo", 7, 39, ["there is no body `rd`", "did you mean `rod`?"]),
    "body in place of a point": ("rod.A], coo", "rod], coo", 7, 39, ["a point is needed", "is a body", "rod."]),
    "unknown force": ("type: torque", "type: torqe", 9, 10, ["there is no force `torqe`", "did you mean `torque`?"]),
    "unknown body": ("on: rod", "on: rob", 9, 29, ["there is no body `rob`", "did you mean `rod`?"]),
    "unknown parameter": ("value: T", "value: 2*Tau", 9, 41, ["nothing is called `Tau`", "there is"]),
    "wrong unit": ("value: T", "value: 3 kg", 9, 41, ["`value` is a torque", "(N*m)", "`3 kg` is a mass (kg)"]),
    "wrong unit by parameters": ("value: T", "value: T/l", 9, 41, ["`value` is a torque", "`T/l` is a force"]),
    "unknown unit": ("l: 1 m,", "l: 1 metr,", 3, 17, ["there is no unit `metr`", "`mm`"]),
    "sum of unlike": ("value: T", "value: T + l", 9, 41, ["`T` is a torque", "`l` is a length", "cannot be added"]),
    "sine of a length": ("value: T", "value: T*sin(l)", 9, 41, ["argument of `sin`", "`l` is a length"]),
    "unknown function": ("value: T", "value: T*sine(2)", 9, 41, ["no function is called `sine`"]),
    "broken expression": ("value: T", "value: T*(2", 9, 41, ["`T*(2` is no expression", "closing parenthesis"]),
    "unit after a division": ("value: T", "value: T*1/3 ft", 9, 41, ["can be read in two ways", "with the unit inside"]),
    "circle of parameters": ("l: 1 m, m1: 1 kg", "l: m1, m1: l", 3, 17, ["in a circle", "l → m1 → l"]),
    "mass that moves": ("mass: m1", "mass: theta", 5, 38, ["`theta` is a coordinate", "parameters only"]),
    "point as a number": ("value: T", "value: 3*rod.A", 9, 41, ["`rod.A` is a point", "x(rod.A)"]),
    "name used twice": ("initial:", "run: {until: 3 s}\ninitial:", 12, 1, ["`run` is used twice", "line 10"]),
    "coordinate called like a parameter": (
        "coordinate: theta",
        "coordinate: T",
        7,
        59,
        ["coordinate `T`", "name of a parameter"],
    ),
    "reserved name": ("T: 1 N*m", "t: 1 N*m", 3, 32, ["`t` has a meaning of its own"]),
    "name with a point": ("m1: 1 kg", "m.1: 1 kg", 3, 22, ["a name cannot hold `.`"]),
    "tab": ("  motor:", "\tmotor:", 9, 1, ["a tab character", "spaces"]),
    "brace not closed": ("on: rod, value: T}", "on: rod, value: T", 10, 8, ["bracket or brace is not closed"]),
    "indentation": ("  motor:", "   motor:\n  x:", 10, 3, ["indentation"]),
    "colon in a text": ("name: pendulum", "name: pendulum: 2", 2, 15, ["second `:`", "quotes"]),
    "brackets in flow style": ("rod.A], coo", "rod[1].A], coo", 7, 42, ["name with brackets needs quotes", '"link[1].end"']),
    "a star": ("value: T", "value: *T", 9, 41, ["alias", "quotes"]),
    "version of the future": ("freebody: 1", "freebody: 7", 1, 11, ["version 7", "update freebody"]),
    "no version": ("freebody: 1\n", "", 1, 1, ["version of the language is missing", "`freebody: 1`"]),
    "no gravity": ("name: pendulum", "gravity: [1]", 2, 10, ["two coordinates are needed"]),
    "unknown coordinate": ("{theta: 30 deg", "{teta: 30 deg", 10, 11, ["no coordinate `teta`", "did you mean `theta`?"]),
    "parameter as a coordinate": ("{theta: 30 deg", "{l: 30 deg", 10, 11, ["`l` is a parameter, not a coordinate"]),
    "angle in metres": ("theta: 30 deg", "theta: 30 mm", 10, 18, ["`theta` is an angle", "`30 mm` is a length"]),
    "rates at rest": ("at_rest: true", "at_rest: true, rates: {theta: 1}", 10, 48, ["`at_rest` and `rates` contradict"]),
    "time in metres": ("until: 5 s", "until: 5 m", 11, 14, ["`until` is a time", "`5 m` is a length"]),
    "unknown method": ("until: 5 s", "until: 5 s, method: dop835", 11, 27, ["`dop835`", "did you mean `dop853`?"]),
    "a place for a name": (
        "bodies:",
        "ground: {lines: {wall: {through: [1 m, 0], angle: 90 deg}}}\nbodies:",
        4,
        34,
        ["a name is needed here", "`points: {P: [1 m, 0]}`"],
    ),
    "event by equality": (
        "run:",
        "events: {e: {when: pivot.Fx = 0}}\nrun:",
        11,
        20,
        ["`pivot.Fx = 0` is a comparison", "write `when: pivot.Fx`"],
    ),
    "event by a comparison": (
        "run:",
        'events: {e: {when: "theta >= -30 deg"}}\nrun:',
        11,
        20,
        ["is a comparison", "write `when: theta - (-30 deg), direction: rising`"],
    ),
    "unknown action": ("run:", "events: {e: {when: theta, then: stopp}}\nrun:", 11, 33, ["`stopp`", "did you mean `stop`?"]),
    "setting what is none": (
        "run:",
        "events: {e: {when: theta, then: {set: {TT: 0}}}}\nrun:",
        11,
        40,
        ["no parameter `TT`", "there is"],
    ),
    "unknown moment": (
        "run:",
        "events: {hits: {when: theta}}\nreport: {x: theta @ hit}\nrun:",
        12,
        13,
        ["`hit` is no moment", "did you mean `hits`?"],
    ),
    "unit of the report": (
        "run:",
        "report: {x: {value: theta, unit: kg}}\nrun:",
        11,
        34,
        ["the value is an angle", "`kg` is the unit of a mass"],
    ),
    "moment of a maximum": (
        "run:",
        "report: {x: max of theta @ end}\nrun:",
        11,
        13,
        ["`max of` looks at a whole run", "over 1 s .. 2 s"],
    ),
    "repetition of a half": (
        "run:",
        "gauges: {'g[i = 1 .. l/2]': theta}\nrun:",
        11,
        10,
        ["`l/2` is 0.5, which is no whole number"],
    ),
    "too many": ("run:", "gauges: {'g[i = 1 .. 1e6]': theta}\nrun:", 11, 10, ["1000000 items", "100000"]),
    "repetition over a name": ("run:", "gauges: {'g[1]': theta, 'g[i = 1 .. 2]': theta}\nrun:", 11, 25, ["`g[1]` is used twice"]),
    "table out of order": (
        "run:",
        "tables: {f: {x: [0, 2, 1], y: [1, 2, 3]}}\nrun:",
        11,
        24,
        ["the arguments of a table must grow"],
    ),
    "line across bodies": (
        "forces:",
        "  track: {type: slot, along: [ground.O, rod.B], point: rod.A}\nforces:",
        8,
        30,
        ["the points of a line belong to two bodies"],
    ),
    "joint of one body": ("[ground.O, rod.A]", "[rod.B, rod.A]", 7, 10, ["both sides of this joint are on `rod`"]),
    "force that reads an answer": ("value: T", "value: pivot.Fx*l", 9, 41, ["pivot.Fx", "cannot be read here"]),
    "gauge that reads the time": ("run:", "gauges: {g: theta + t}\nrun:", 11, 13, ["`t`"]),
    "part that is not there": ("run:", "parts: {leg: {file: leg.yaml}}\nrun:", 11, 21, ["there is no file `leg.yaml`"]),
    "part from elsewhere": ("run:", "parts: {leg: {file: ../../leg.yaml}}\nrun:", 11, 21, ["outside the folder of the model"]),
}


def problems(text: str, tmp_path) -> list:
    path = tmp_path / "model.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ModelFileError) as caught:
        model, source = reading.read(path)
        assert lower.lower(model, source, path).compiled
    assert str(caught.value).startswith(str(tmp_path))
    return caught.value.problems


def test_the_right_file_is_right(tmp_path):
    path = tmp_path / "model.yaml"
    path.write_text(GOOD)
    model, source = reading.read(path)
    assert lower.lower(model, source, path).spec["joints"][0]["name"] == "pivot"


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_file(case, tmp_path):
    before, after, line, column, words = CASES[case]
    assert GOOD.count(before) == 1, "the case must change one place"
    found = problems(GOOD.replace(before, after), tmp_path)
    first = next((p for p in found if (p.where.line, p.where.column) == (line, column)), None)
    shown = "\n".join(str(p) for p in found)
    assert first is not None, shown
    for word in words:
        assert word in f"{first.what}\n{first.hint}", shown


def test_all_that_is_wrong_is_said_at_once(tmp_path):
    text = GOOD.replace("rod.A], coo", "rod.C], coo").replace("value: T", "value: 3 kg").replace("30 deg", "30 mm")
    assert [p.where.line for p in problems(text, tmp_path)] == [7, 9, 10]


def test_what_only_follows_from_another_problem_is_not_reported(tmp_path):
    found = problems(GOOD.replace("l: 1 m,", "l: 1 metr, k: 2*l,"), tmp_path)
    assert [p.where.path for p in found] == ["parameters.l"]


def test_empty_and_foreign_texts(tmp_path):
    assert "a mapping of sections" in problems("", tmp_path)[0].what
    assert "a mapping of sections" in problems("- 1\n- 2\n", tmp_path)[0].what
    (tmp_path / "latin.yaml").write_bytes(b"name: caf\xe9")
    with pytest.raises(ModelFileError, match="UTF-8"):
        reading.read(tmp_path / "latin.yaml")


def test_a_missing_file_names_its_neighbour(tmp_path):
    (tmp_path / "four_bar.yaml").write_text(GOOD)
    with pytest.raises(ModelFileError, match=r"did you mean `four_bar.yaml`"):
        reading.read(tmp_path / "fourbar.yaml")


def test_aliases_that_hold_themselves_or_explode(tmp_path):
    assert "nested" in problems("freebody: 1\nbodies: &b {x: *b}\n", tmp_path)[0].what
    bomb = "a0: &a0 [" + ", ".join("1" * 9) + "]\n"
    bomb += "".join(f"a{i}: &a{i} [{', '.join([f'*a{i - 1}'] * 20)}]\n" for i in range(1, 9))
    assert "too large" in problems("freebody: 1\n" + bomb, tmp_path)[0].what


def test_a_circle_of_parts(tmp_path):
    (tmp_path / "leg.yaml").write_text("freebody: 1\nparts: {model: {file: model.yaml}}\n")
    found = problems("freebody: 1\nparts: {leg: {file: leg.yaml}}\n", tmp_path)
    assert "in a circle: model.yaml → leg.yaml → model.yaml" in found[0].what
    assert found[0].where.file.endswith("leg.yaml")


def test_a_problem_inside_a_repetition_points_at_its_line(tmp_path):
    text = "freebody: 1\nbodies:\n  link[i = 1 .. 3]:\n    {shape: rod, length: 1 kg, mass: 1}\n"
    found = problems(text, tmp_path)
    assert {(p.where.line, p.where.column) for p in found} == {(4, 26)}

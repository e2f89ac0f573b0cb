"""What switches: contacts, strings, stops, guides with ends and what events do, as the core receives them."""

from __future__ import annotations

import math
from typing import Any

import pytest
from switching import MODEL, lowered

from freebody.core import cards
from freebody.mechanism import Mechanism
from freebody.model import elements, lower, reading
from freebody.model.errors import ModelFileError


def named(items: list[dict[str, Any]], name: str) -> dict[str, Any]:
    return next(item for item in items if item["name"] == name)


def test_a_contact_with_all_its_words():
    words = "of: [ball, ground.floor], restitution: e, friction: 0.3, static_friction: 0.4, engaged: false"
    made = named(lowered(("of: [ball, ground.floor]", words)).spec["contacts"], "floor")
    assert made == {
        "name": "floor",
        "of": [{"circle": {"centre": "ball.centre", "radius": "r"}}, {"line": {"point": "ground.A", "towards": "ground.B"}}],
        "friction": 0.3,
        "static_friction": 0.4,
        "rough": False,
        "restitution": "e",
        "engaged": False,
    }
    assert lowered(("of: [ball, ground.floor]", "of: [ball, ground.floor], rough: true")).spec["contacts"][0]["rough"]


SURFACES = {
    "bob": {"point": "bob.centre"},
    "hoop": {"circle": {"centre": "hoop.centre", "radius": "2*r"}},
    "box.C": {"point": "box.C"},
    "ball.G": {"point": "ball.G"},
    "[box.C, box.G]": {"line": {"point": "box.C", "towards": "box.G"}},
    "{through: box.C, angle: 90 deg}": {"line": {"point": "box.C", "angle": math.pi / 2}},
    "{centre: box.C, radius: 2 cm}": {"circle": {"centre": "box.C", "radius": 0.02, "hollow": False}},
    "{centre: box.C, radius: r, hollow: true}": {"circle": {"centre": "box.C", "radius": "r", "hollow": True}},
    "{polyline: [rod.start, rod.end]}": {"polyline": ["rod.start", "rod.end"]},
    "{polygon: [rod.start, rod.end, rod.G]}": {"polygon": ["rod.start", "rod.end", "rod.G"]},
}


@pytest.mark.parametrize("surface", SURFACES)
def test_surfaces(surface):
    assert lowered(("of: [ball, ", f"of: [{surface}, ")).spec["contacts"][0]["of"][0] == SURFACES[surface]


OUTLINES = {
    "box": [[-0.5, -0.25], [0.5, -0.25], [0.5, 0.25], [-0.5, 0.25]],
    "wedge": [[0, 0], [1, 0], [0, 1]],
    "tilted": [[1.5, -1], [1.5, 1], [0.5, 1], [0.5, -1]],
}


@pytest.mark.parametrize("body", OUTLINES)
def test_a_body_of_corners_is_its_polygon(body):
    spec = lowered(("of: [ball, ", f"of: [{body}, ")).spec
    points = {point["name"]: point for point in spec["points"]}
    corners = [points[name] for name in spec["contacts"][0]["of"][0]["polygon"]]
    assert {corner["body"] for corner in corners} == {body}
    assert [corner["at"] for corner in corners] == [pytest.approx(place, abs=1e-15) for place in OUTLINES[body]]


def test_one_moved_piece_is_a_moved_circle():
    spec = lowered(("of: [ball, ", "of: [moved, ")).spec
    circle = spec["contacts"][0]["of"][0]["circle"]
    assert circle == {"centre": "moved.outline[1]", "radius": "r"}
    assert named(spec["points"], "moved.outline[1]") == {"name": "moved.outline[1]", "body": "moved", "at": [0.0, 1.0]}


def test_a_string_over_everything():
    ends = "ends: [{drum: ball.centre, radius: r, sense: clockwise, wound: 0.5 m}, {drum: hoop.G, radius: 2, sense: ccw, attached: 90 deg}]"
    over = "over: [ground.P, {pulley: ground.A, radius: 10 cm, sense: clockwise}]"
    string = lowered(("ends: [ground.P, ball.centre], length: 1 m", f"{ends}, {over}, restitution: e")).spec["strings"][0]
    drum, other = (end["drum"] for end in string["ends"])
    assert drum == {"centre": "ball.centre", "radius": "r", "sense": -1, "attached": None, "wound": 0.5}
    assert (other["sense"], other["attached"], other["wound"]) == (1, pytest.approx(math.pi / 2), None)
    assert string["over"] == [{"eyelet": "ground.P"}, {"pulley": {"centre": "ground.A", "radius": 0.1, "sense": -1}}]
    assert (string["length"], string["restitution"], string["engaged"]) == (None, "e", True)


STOPS = {
    "of: theta, least: 0 deg, most: 180 deg": {"knee.least": "theta - 0.0", "knee.most": f"{math.pi!r} - theta"},
    "of: theta, least: -1": {"knee": "theta - (-1.0)"},
    "of: 2*theta, most: e, restitution: 0.2": {"knee": "(e) - (2*theta)"},
}


@pytest.mark.parametrize("words", STOPS)
def test_stops(words):
    made = lowered(("of: theta, least: 0 deg, most: 150 deg", words)).spec["stops"]
    assert {stop["name"]: stop["gap"] for stop in made if stop["name"] != "low"} == STOPS[words]


# -- guides and one-sided joints -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("coordinate", "start", "end"),
    [
        ("R", "R", "1.0 - R"),
        ("{name: R, zero: 20 cm}", "0.2 + R", "1.0 - (0.2 + R)"),
        ("{name: R, sense: backward}", "-R", "1.0 - (-R)"),
    ],
)
def test_the_ends_of_a_guide(coordinate, start, end):
    free = lowered(("coordinate: R", f"coordinate: {coordinate}, ends: free")).spec["events"]
    assert [(e["name"], e["when"]) for e in free[:2]] == [("track leaves start", start), ("track leaves end", end)]
    assert all(e["guard"] and e["direction"] == -1 and e["then"] == [{"release": ["track"]}] for e in free[:2])
    held = lowered(("coordinate: R", f"coordinate: {coordinate}, ends: stop, end_restitution: 0.5, engaged: false")).spec["stops"]
    assert [(s["name"], s["gap"]) for s in held[:2]] == [("track.start", start), ("track.end", end)]
    assert all(s["restitution"] == 0.5 and not s["engaged"] for s in held[:2])


def test_a_guide_of_parameters_is_as_long_as_they_say():
    made = lowered(
        ("length: 1 m, mass: 1}\n  lump", "length: 3*r, mass: 1}\n  lump"), ("coordinate: R", "coordinate: R, ends: free")
    )
    assert made.spec["events"][1]["when"] == "(hypot((((3*r)/2) - (-(3*r)/2)), 0.0)) - R"


ONE_SIDED = {
    "slider, along: ground.floor, line: [box.G, box.C]": {"j lifts off": "j.F1"},
    "slot, along: ground.floor, point: box.C": {"j lifts off": "j.F1"},
    "rollers, along: ground.floor, points: [box.G, box.C]": {"j lifts off 1": "j.F1", "j lifts off 2": "j.F2"},
    "rolling, on: ground.floor, circle: {centre: hoop.G, radius: r}": {"j lifts off": "j.F1"},
    "rolling_circles, on: {centre: ground.O, radius: 1}, circle: {centre: hoop.G, radius: r}, inside: true": {
        "j lifts off": "-j.F1"
    },
}


@pytest.mark.parametrize("joint", ONE_SIDED)
def test_a_joint_that_only_pushes(joint):
    made = lowered(("forces:", f"  j: {{type: {joint}, one_sided: true}}\nforces:"))
    lifting = [event for event in made.spec["events"] if event["guard"]]
    assert {event["name"]: event["when"] for event in lifting} == ONE_SIDED[joint]
    assert all(event["then"] == [{"release": ["j"]}] for event in lifting)
    assert made.where(f"events.{lifting[0]['name']}").path == "joints.j.one_sided"


@pytest.mark.parametrize("word", cards.joints())
def test_every_joint_can_come_later_and_only_pushers_are_one_sided(word):
    fields = elements.JOINTS[word].model_fields
    assert "engaged" in fields and ("one_sided" in fields) == bool(cards.joints()[word].presses)


def test_an_event_cannot_have_the_name_of_one_that_a_joint_makes():
    with pytest.raises(ModelFileError, match="the joint `track` has an event `track leaves end`"):
        lowered(("coordinate: R", "coordinate: R, ends: free"), ("  e: {when", "  track leaves end: {when"))


# -- events ----------------------------------------------------------------------------------------

DEEDS = {
    "{release: [pivot, pull, turn]}": [{"release": ["pivot", "pull", "turn"]}],
    "{release: [knee, knee]}": [{"release": ["knee.least", "knee.most"]}],
    "{release: [low, knee.most]}": [{"release": ["low", "knee.most"]}],
    "[{cut: leash}, record]": [{"release": ["leash"]}],
    "{engage: floor, set: {T: 2*T}, release: pivot}": [{"release": ["pivot"]}, {"engage": ["floor"]}, {"set": {"T": "2*T"}}],
    "[{lock: theta}, {unlock: [h, 2*theta]}, stop]": [{"lock": ["theta"]}, {"unlock": ["h", "2*theta"]}, "stop"],
    "{reset: {theta: 60 rpm, h: 0}}": [{"reset": {"theta": f"{2 * math.pi!r}", "h": "0.0"}}],
    "{weld: [box, wedge]}": [{"engage": ["e weld"]}],
    "[{weld: [box, wedge, hoop]}, {weld: [lump, ground]}]": [{"engage": ["e weld", "e weld 2"]}, {"engage": ["e weld 3"]}],
    "{remove: box}": [{"release": ["pull"]}],
    "{remove: ball}": [{"release": ["axle", "lift", "floor", "leash", "low"]}],
    "{remove: rod}": [{"release": ["pivot", "track", "axle", "coil", "turn", "knee.least", "knee.most"]}],
    "{remove: lump}": [],
}


@pytest.mark.parametrize("then", DEEDS)
def test_deeds(then):
    assert lowered(("{when: theta}", f"{{when: theta, then: {then}}}")).spec["events"][0]["then"] == DEEDS[then]


def test_welds_are_joints_that_come_later():
    made = lowered(("{when: theta}", "{when: theta, then: {weld: [box, ground, lump]}}\nreport: {f: \"'e weld'.Fx\"}"))
    first, second = made.spec["joints"][-2:]
    assert (first["name"], first["type"], first["engaged"]) == ("e weld", "weld", False)
    assert (first["with"]["of"], second["with"]["of"]) == (["box.origin", "ground.O"], ["ground.O", "lump.origin"])
    assert made.where("joints.e weld").path == "events.e.then"


@pytest.mark.parametrize(
    ("words", "when", "direction", "opening"),
    [
        ("at: 200 ms", "t - 0.2", 1, False),
        ("at: 2*e, if: theta > 0", "t - (2*e)", 1, False),
        ("at: start", "1", 0, True),
        ("when: tension(leash) - 50 N, direction: rising", "tension(leash) - 50.0", 1, False),
    ],
)
def test_when_events_happen(words, when, direction, opening):
    event = lowered(("{when: theta}", f"{{{words}, then: {{cut: leash}}}}")).spec["events"][0]
    assert (event["when"], event["direction"], event["opening"]) == (when, direction, opening)


def test_what_is_put_in_place_later():
    made = lowered(
        ("coordinate: theta}", "coordinate: theta, engaged: false}"),
        ("is: t}", "is: t, engaged: false}"),
        ("value: 3}", "value: 3, engaged: false}"),
    )
    joint, force, motion = (named(made.spec[s], n) for s, n in (("joints", "pivot"), ("forces", "lift"), ("motions", "turn")))
    assert not (joint["engaged"] or force["engaged"] or motion["engaged"])


def test_a_body_that_is_only_joined_later_is_free_until_then():
    text = "freebody: 1\nbodies: {a: {mass: 1}}\njoints: {j: {type: hinge, of: [ground.O, a.origin], engaged: false}}\n"
    assert lowered(text=text + "initial: {a.y: 2 m}\n").start.fixed == {"a.y": 2.0}


def test_parts_bring_what_switches_under_their_name(tmp_path):
    (tmp_path / "leg.yaml").write_text(MODEL.replace("{when: theta}", "{when: theta, then: {cut: leash, weld: [box, lump]}}"))
    text = "freebody: 1\nparts: {leg: {file: leg.yaml}}\nevents: {x: {at: 1, then: {release: [leg.floor, leg.knee], remove: leg.box}}}\n"
    model, source = reading.reads(text)
    spec = lower.lower(model, source, tmp_path / "model.yaml").spec
    assert [spec[section][0]["name"] for section in ("contacts", "strings", "stops")] == [
        "leg.floor",
        "leg.leash",
        "leg.knee.least",
    ]
    assert spec["contacts"][0]["of"][1] == {"line": {"point": "ground.leg.A", "towards": "ground.leg.B"}}
    gone = ["leg.floor", "leg.knee.least", "leg.knee.most", "leg.e weld", "leg.pull"]
    assert named(spec["events"], "x")["then"] == [{"release": gone}]
    assert named(spec["events"], "leg.e")["then"] == [{"release": ["leg.leash"]}, {"engage": ["leg.e weld"]}]


def test_repetition_makes_contacts():
    text = MODEL.replace("  floor: {of: [ball, ", "  'floor[i = 1 .. 3]': {friction: i/10, of: [ball, ")
    assert [c["name"] for c in lowered(text=text).spec["contacts"]] == ["floor[1]", "floor[2]", "floor[3]"]


def test_run_and_start():
    made = lowered(("events:", "run: {until: 1, impacts: poisson, painleve: impact}\ninitial: {equilibrium: true}\nevents:"))
    assert (made.run["impacts"], made.run["painleve"], made.start.equilibrium) == ("poisson", "impact", True)
    assert (lowered().run["impacts"], lowered().run["painleve"], lowered().start.equilibrium) == ("stop", "stop", False)


# -- the builder -----------------------------------------------------------------------------------

SAID = """\
freebody: 1
ground: {points: {A: [-1, 0], B: [1, 0]}, lines: {floor: [ground.A, ground.B]}}
bodies:
  ball: {shape: disk, radius: 0.1, mass: 1}
  rod: {shape: rod, length: 1, mass: 1}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta, engaged: false}
  track: {type: slot, along: [rod.start, rod.end], point: ball.G, ends: free, one_sided: true}
contacts:
  floor: {of: [ball, ground.floor], restitution: 0.7}
strings:
  leash: {ends: [ground.O, {drum: ball.centre, radius: 0.1, sense: ccw, wound: 0}], over: [ground.A]}
stops:
  knee: {of: theta, most: 150 deg}
events:
  snap: {when: tension(leash) - 50, then: {cut: leash}}
  start: {at: start, then: [{release: [floor, pivot]}, {remove: ball}, {lock: theta}, {reset: {theta: 2}}]}
"""


def said() -> Mechanism:
    m = Mechanism()
    a, b = m.ground.point("A", [-1, 0]), m.ground.point("B", [1, 0])
    ball = m.disk("ball", radius=0.1, mass=1)
    rod = m.rod("rod", length=1, mass=1)
    pivot = m.hinge(m.ground.O, rod.start, name="pivot", coordinate="theta", engaged=False)
    m.slot(name="track", along=[rod.start, rod.end], point=ball.G, ends="free", one_sided=True)
    floor = m.contact("floor", ball, m.ground.line("floor", a, b), restitution=0.7)
    leash = m.string(
        "leash", m.ground.O, {"drum": ball.centre, "radius": 0.1, "sense": "ccw", "wound": 0}, over=[m.ground.A], length=None
    )
    m.stop("knee", pivot.coordinate, most="150 deg")
    m.event("snap", "tension(leash) - 50", then={"cut": leash})
    reset = {"reset": {pivot.coordinate: 2}}
    m.event("start", at="start", then=[{"release": [floor, pivot]}, {"remove": ball}, {"lock": pivot.coordinate}, reset])
    return m


def test_file_and_builder_say_the_same(tmp_path):
    assert reading.reads(SAID)[0] == said().model
    for name in ("m.yaml", "m.json"):
        said().save(tmp_path / name)
        assert Mechanism.load(tmp_path / name) == said()
    assert said().lowered().spec == lowered(text=SAID).spec


def test_a_wrong_word_is_said_at_the_call():
    m = said()
    with pytest.raises(ModelFileError, match="did you mean `restitution`") as caught:
        m.contact("other", "ball", "ground.floor", restitutoin=1)
    assert "m.contact(" in caught.value.problems[0].where.excerpt

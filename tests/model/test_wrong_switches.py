"""What is wrong with contacts, strings, stops and events is reported with its place and with what to try."""

from __future__ import annotations

import pytest
from switching import lowered

from freebody.model.errors import ModelFileError

FLOOR, LEASH, KNEE, EVENT = (
    "of: [ball, ground.floor]",
    "ends: [ground.P, ball.centre], length: 1 m",
    "least: 0 deg, most: 150 deg",
    "when: theta",
)

# name: (what stands in MODEL, what stands there instead, path of the problem, words of the message)
WRONG = {
    "one surface": (FLOOR, "of: [ball]", "contacts.floor.of", ["two surfaces"]),
    "unknown body": (FLOOR, "of: [bal, ground.floor]", "contacts.floor.of[0]", ["no body `bal`", "`ball`"]),
    "unknown line": (FLOOR, "of: [ball, ground.flor]", "contacts.floor.of[1]", ["no point `flor`"]),
    "rod": (FLOOR, "of: [rod, ground.floor]", "contacts.floor.of[0]", ["a rod", "`rod.start`", "two contacts"]),
    "no shape": (FLOOR, "of: [lump, ground.floor]", "contacts.floor.of[0]", ["`lump` has no shape"]),
    "several pieces": (FLOOR, "of: [two, ground.floor]", "contacts.floor.of[0]", ["several pieces"]),
    "whole ground": (FLOOR, "of: [ball, ground]", "contacts.floor.of[1]", ["the ground has no outline"]),
    "curve": (FLOOR, "of: [ball, ground.bow]", "contacts.floor.of[1]", ["is a curve", "polyline"]),
    "half a circle": (FLOOR, "of: [ball, {centre: ground.O}]", "contacts.floor.of[1]", ["no surface", "radius"]),
    "hollow line": (FLOOR, "of: [ball, {polyline: [ground.A, ground.B], hollow: true}]", "contacts.floor.of[1]", ["`hollow`"]),
    "two corners": (FLOOR, "of: [ball, {polygon: [ground.A, ground.B]}]", "contacts.floor.of[1]", ["3 corners"]),
    "corners of two": (
        FLOOR,
        "of: [ball, {polyline: [ground.A, rod.start]}]",
        "contacts.floor.of[1].polyline",
        ["several bodies"],
    ),
    "more than all speed": (FLOOR, f"{FLOOR}, restitution: 2", "contacts.floor.restitution", ["at most 1", "2"]),
    "restitution by parameters": (FLOOR, f"{FLOOR}, restitution: 2*e", "contacts.floor.restitution", ["`2*e` is 1.4"]),
    "friction with a unit": (FLOOR, f"{FLOOR}, friction: 1 N", "contacts.floor.friction", ["plain number", "a force"]),
    "negative friction": (FLOOR, f"{FLOOR}, friction: -1", "contacts.floor.friction", ["cannot be negative"]),
    "rest below sliding": (FLOOR, f"{FLOOR}, friction: 0.3, static_friction: 0.2", "contacts.floor.static_friction", ["below"]),
    "rough with friction": (FLOOR, f"{FLOOR}, rough: true, friction: 0.3", "contacts.floor", ["never slides"]),
    "one end": (LEASH, "ends: [ground.P]", "strings.leash.ends", ["two ends"]),
    "no ends": (LEASH, "length: 1 m", "strings.leash.ends", ["`ends` is missing"]),
    "drum of neither": (
        LEASH,
        "ends: [ground.P, {drum: ball.G, radius: r, sense: ccw}]",
        "strings.leash.ends[1]",
        ["`attached` or `wound`"],
    ),
    "drum without sense": (
        LEASH,
        "ends: [ground.P, {drum: ball.G, radius: r, wound: 0}]",
        "strings.leash.ends[1].sense",
        ["`sense`"],
    ),
    "string over a body": (LEASH, f"{LEASH}, over: [box]", "strings.leash.over[0]", ["a point is needed"]),
    "string of seconds": (LEASH, LEASH.replace("1 m", "1 s"), "strings.leash.length", ["a length", "a time"]),
    "stop in metres": (KNEE, "least: 1 m", "stops.knee.least", ["an angle", "a length"]),
    "stop of nothing": (KNEE, "restitution: 0", "stops.knee", ["stops nothing", "`least:`"]),
    "least above most": (KNEE, "least: 2, most: 1", "stops.knee.least", ["not below"]),
    "name used twice": ("knee:", "track:", "stops.track", ["name of a joint"]),
    "ends without points": (
        "along: [rod.start, rod.end], coordinate: R",
        "along: {through: rod.G, angle: 0}, ends: free",
        "joints.track.ends",
        ["one point to another", "[P, Q]"],
    ),
    "restitution of free ends": ("coordinate: R", "end_restitution: 0.5", "joints.track.end_restitution", ["`ends: stop`"]),
    "ends of a hinge": (
        "coordinate: theta",
        "ends: stop",
        "joints.pivot.ends",
        ["a hinge takes no `ends`", "slot", "under `stops`"],
    ),
    "hinge of one side": ("coordinate: theta", "one_sided: true", "joints.pivot.one_sided", ["a hinge takes no", "a contact"]),
    "neither when nor at": (EVENT, "then: stop", "events.e", ["`when` is missing", "`at:`"]),
    "both when and at": (EVENT, "when: theta, at: 2", "events.e", ["not both"]),
    "direction of a time": (EVENT, "at: 2, direction: rising", "events.e", ["no `direction`"]),
    "time in metres": (EVENT, "at: 2 m", "events.e.at", ["a time", "a length"]),
    "time nought": (EVENT, "at: 0 s", "events.e.at", ["`at: start`"]),
    "unknown to release": (
        EVENT,
        f"{EVENT}, then: {{release: pivott}}",
        "events.e.then.release",
        ["`pivott`", "did you mean `pivot`"],
    ),
    "body to release": (EVENT, f"{EVENT}, then: [stop, {{release: [ball]}}]", "events.e.then[1].release[0]", ["`ball`"]),
    "contact to cut": (
        EVENT,
        f"{EVENT}, then: {{cut: floor}}",
        "events.e.then.cut",
        ["only strings are cut", "`release: floor`"],
    ),
    "unknown to cut": (EVENT, f"{EVENT}, then: {{cut: leesh}}", "events.e.then.cut", ["did you mean `leash`"]),
    "unknown to remove": (EVENT, f"{EVENT}, then: {{remove: bal}}", "events.e.then.remove", ["no body `bal`"]),
    "ground to remove": (EVENT, f"{EVENT}, then: {{remove: ground}}", "events.e.then.remove", ["cannot be removed"]),
    "one to weld": (EVENT, f"{EVENT}, then: {{weld: box}}", "events.e.then", ["two bodies or more"]),
    "rate in metres": (EVENT, f"{EVENT}, then: {{reset: {{h: 2 m}}}}", "events.e.then.reset.h", ["a speed", "a length"]),
    "unknown to lock": (EVENT, f"{EVENT}, then: {{lock: thet}}", "events.e.then.lock", ["did you mean `theta`"]),
    "unknown deed": (EVENT, f"{EVENT}, then: {{relase: pivot}}", "events.e.then.relase", ["did you mean `release`"]),
    "no deed": (EVENT, f"{EVENT}, then: {{}}", "events.e.then", ["no action"]),
    "no file": (EVENT, f"{EVENT}, then: {{hand_over: nowhere.yaml}}", "events.e.then.hand_over", ["no file `nowhere.yaml`"]),
    "file elsewhere": (EVENT, f"{EVENT}, then: {{hand_over: ../x.yaml}}", "events.e.then.hand_over", ["outside the folder"]),
    "tension of a joint": (EVENT, "when: tension(pivot)", "events.e.when", ["no string `pivot`", "`leash`"]),
    "unknown law of impacts": (
        "events:",
        "run: {impacts: newtn}\nevents:",
        "run.impacts",
        ["did you mean `newton`"],
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong(case):
    before, after, path, words = WRONG[case]
    with pytest.raises(ModelFileError) as caught:
        lowered((before, after))
    problem = next((p for p in caught.value.problems if p.where.path == path), None)
    assert problem is not None, str(caught.value)
    assert problem.where.line > 0
    for word in words:
        assert word in f"{problem.what}\n{problem.hint}", str(problem)

"""What letters mean that nobody declared, as textbooks use them: ``α`` of the only body, ``a_{Gx}``, ``v_B``, ``r_{B/O}``, ``I_O``, ``k_G``,
``H_O``, ``ΣM_O``, ``ω_1``, ``T``, ``V``. They come after all names of the model and of the person, and the verdict says how they were read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import permutations
from typing import Any

from freebody.core import GROUND
from freebody.model.names import spell

_LETTER = re.compile(r"[^\W\d_]\w?")
_COUNTER = ", along k"
_PARALLEL = ("slider", "parallel", "weld")
"""Joints whose two bodies do not turn beside each other."""
ENERGIES = {**dict.fromkeys(("T", "K", "KE"), "kinetic()"), **dict.fromkeys(("V", "U", "PE"), "potential()"), "E": "energy()"}
"""What they mean where no line of the statement makes them something else."""
_RATES = {"rate": "accel", "omega": "alpha"}

Points = Mapping[str, tuple[str, str]]
"""Body and name of each point that has a letter."""


def usual(spec: Mapping[str, Any], metadata: Mapping[str, Any], declared: Mapping[str, str]) -> dict[str, str]:
    """Letters with what they mean in a model, as a declaration; only those that can mean but one thing. ``declared`` are expressions of
    a person's own symbols: ω is the rate of turning to the α that is one of them."""
    points, rigid = _points(spec, declared), _turning(spec, metadata)
    turns = spell(metadata["coordinates"][0]["name"]) if len(metadata["coordinates"]) == 1 else ""
    found = [*_partners(declared), *_of_points(points, turns), *_of_hinge(spec, rigid)]
    found += [(f"ΣF_{axis}", f"force on all along {axis}") for axis in "xy"]
    found += [pair for body in rigid for pair in _of_body(spec, body, points, alone=len(rigid) == 1)]
    found += [*_of_coordinates(spec, metadata)]
    found += [(f"T_{name}", f"{spell(name)}.tension") for name in (each["name"] for each in spec["strings"])]
    if len(spec["bodies"]) == 1:
        centre = f"{spell(spec['bodies'][0]['name'])}.G"
        found += [("v", f"velocity of {centre}"), ("a", f"acceleration of {centre}")]
        found += [(f"a_{part}", dict(found)[f"a_G{part}"]) for part in "nt" if f"a_G{part}" in dict(found)]
    found += [*_polar(spec), *_of_polar_joint(spec)]
    return dict(reversed(found))  # what comes first stays


def senses(spec: Mapping[str, Any], metadata: Mapping[str, Any], usual: Mapping[str, str]) -> dict[str, str]:
    """Letters clockwise: the ``usual`` moments and angular momenta where angles are measured so; ω and α of the only body where no
    coordinate says which sense is meant."""
    signs = {c["name"]: c.get("sense", 1) for joint in spec["joints"] for c in joint.get("coordinates", ()) if "name" in c}
    angles = [c["name"] for c in metadata["coordinates"] if c["dimension"] == "rad"]
    if angles and all(signs.get(name) == -1 for name in angles):
        return {name: said.replace(_COUNTER, ", along -k") for name, said in usual.items() if said.endswith(_COUNTER)}
    rigid = _turning(spec, metadata)
    if len(rigid) != 1 or angles:
        return {}
    return {symbol: f"-{read}({spell(rigid[0])})" for symbol, read in (("ω", "omega"), ("α", "alpha"))}


def _turning(spec: Mapping[str, Any], metadata: Mapping[str, Any]) -> list[str]:
    """The rigid bodies, without those that joints always keep parallel to the ground."""
    switched = str(spec["events"])
    pairs = [{j["first"], j["second"]} for j in metadata["joints"] if j["type"] in _PARALLEL and j["name"] not in switched]
    still = {GROUND}
    for _ in pairs:
        still |= {body for pair in pairs if still & pair for body in pair}
    return [body["name"] for body in spec["bodies"] if not body["particle"] and body["name"] not in still]


def _partners(declared: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """ω where only α is declared, and the other way."""
    for one, other, words in (("α", "ω", {b: a for a, b in _RATES.items()}), ("ω", "α", _RATES)):
        if one in declared and other not in declared:
            yield other, re.sub(rf"\b({'|'.join(words)})(?=\()", lambda found, words=words: words[found[1]], declared[one])


def _points(spec: Mapping[str, Any], declared: Mapping[str, str]) -> dict[str, tuple[str, str]]:
    """Body and name of each point that has a letter, its own, its body's, or that of the joint there; G of the only body, or of that of
    which a person's own symbols read it."""
    named = [(point["body"], point["name"], point["name"].rpartition(".")[2]) for point in spec["points"]]
    named += [(body["name"], f"{spell(body['name'])}.G", body["name"]) for body in spec["bodies"] if body["particle"]]
    joints = [(joint["with"].get("point") or (joint["with"].get("of") or [""])[-1], joint["name"]) for joint in spec["joints"]]
    held = {
        joint["name"]: [of.rpartition(".")[2] for of in map(str, joint["with"].get("of") or ()) if not of.startswith("ground.")]
        for joint in spec["joints"]
    }
    named += [
        (point.rpartition(".")[0], point, letter)
        for point, letter in joints
        if isinstance(point, str) and "." in point and letter not in held[letter]
    ]
    bodies = [body["name"] for body in spec["bodies"]]
    centred = [name for name in bodies if any(f"{spell(name)}.G" in said for said in declared.values())] or bodies
    if len(centred) == 1:
        named.append((centred[0], f"{spell(centred[0])}.G", "G"))
    letters = [each for each in dict.fromkeys(named) if _LETTER.fullmatch(each[2])]
    moving = {letter for body, _, letter in letters if body != "ground"}
    letters = [each for each in letters if each[0] != "ground" or each[2] not in moving]
    letters += [] if any(letter == "O" for *_, letter in letters) else [("ground", "ground.O", "O")]
    return {letter: (body, point) for body, point, letter in letters if sum(letter == other for *_, other in letters) == 1}


def _of_hinge(spec: Mapping[str, Any], rigid: Sequence[str]) -> Iterator[tuple[str, str]]:
    """ω and α of the only body on a hinge of the ground, in the sense in which its angle grows."""
    hinges = [joint for joint in spec["joints"] if joint["type"] == "hinge" and joint.get("coordinates")]
    if len(rigid) == len(hinges) == 1 and "name" in hinges[0]["coordinates"][0]:
        first, second = (str(of).rpartition(".")[0] for of in hinges[0]["with"]["of"])
        if (first, second) == ("ground", rigid[0]):
            name = spell(hinges[0]["coordinates"][0]["name"])
            yield from (("ω", f"rate({name})"), ("α", f"accel({name})"))


def _of_points(points: Points, turns: str) -> Iterator[tuple[str, str]]:
    """Places, velocities, accelerations with their components, along the path as the only coordinate ``turns``, too, and one relative to
    the other; moments and angular momenta about them."""
    for letter, (_, point) in points.items():
        for symbol, read in (("", ""), ("v_", "v"), ("a_", "a")):
            parts = [f"{read}{axis}({point})" for axis in "xy"]
            names = [f"{symbol or axis + '_'}{letter}{axis * bool(symbol)}" for axis in "xy"]
            yield from zip(names, parts, strict=True)
            yield (symbol or "r_") + letter, f"[{', '.join(parts)}]"
        speed = f"hypot(vx({point}), vy({point}))"
        yield f"a_{letter}n", f"abs(vx({point})*ay({point}) - vy({point})*ax({point}))/{speed}"
        if turns:
            yield f"a_{letter}t", f"(ax({point})*vx({point}) + ay({point})*vy({point}))/{speed}*sign(rate({turns}))"
        yield f"ΣM_{letter}", f"moment on all about {point}, along k"
        yield f"H_{letter}", f"angular momentum of all about {point}, along k"
    words = (("r", "position of {} from {}"), ("v", "velocity of {} relative to {}"), ("a", "acceleration of {} relative to {}"))
    for one, other in permutations(points, 2):
        yield from ((f"{symbol}_{one}/{other}", said.format(points[one][1], points[other][1])) for symbol, said in words)


def _of_body(spec: Mapping[str, Any], body: str, points: Points, alone: bool) -> Iterator[tuple[str, str]]:
    """Rates of turning, moments of inertia and radii of gyration: α, α_AB or α_rod, I_O, k_G."""
    own = [letter for letter, (of, _) in points.items() if of == body]
    held = [joint["name"] for joint in spec["joints"] if f'"{body}.' in str(joint["with"]).replace("'", '"')]
    pairs = [a + b for a, b in permutations(dict.fromkeys([*own, *filter(_LETTER.fullmatch, held)]), 2)]
    for symbol, read in (("ω", "omega"), ("α", "alpha")):
        names = [*([symbol] if alone else []), *(f"{symbol}_{each}" for each in (*pairs, body))]
        yield from ((name, f"{read}({spell(body)})") for name in names)
    pins = dict(each["with"]["of"] for each in spec["joints"] if each["type"] == "hinge")
    centres = {letter: points[letter][1] for letter in [*own, *(["O"] if alone and "O" in points else [])]}
    centres = {letter: pins.get(point, point) if alone else point for letter, point in centres.items()}
    centres |= {"G": f"{spell(body)}.G"} if alone else {}
    for letter, point in centres.items():
        yield f"I_{letter}", f"inertia of {body} about {point}"
        yield f"k_{letter}", f"radius of gyration of {body} about {point}"
    if alone and all(joint["type"] != "hinge" for joint in spec["joints"]):  # else it may be about a pin
        yield "I", f"inertia of {body} about {centres['G']}"


def _polar(spec: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Directions, velocity and acceleration along and across a slot of a turning body, in which the only thing slides: e_r, a_r, a_θ, where
    r and θ are the coordinates."""
    hinges = {str(joint["with"]["of"][1]).rpartition(".")[0]: joint for joint in spec["joints"] if joint["type"] == "hinge"}
    slots = [joint for joint in spec["joints"] if joint["type"] == "slot" and "angle" in joint["with"]["along"]]
    slots = [joint for joint in slots if str(joint["with"]["along"]["point"]).rpartition(".")[0] in hinges]
    if len(slots) != 1:
        return
    slot, line = slots[0], slots[0]["with"]["along"]
    body = str(line["point"]).rpartition(".")[0]
    names = [(hinges[body]["coordinates"] or [{}])[0], (slot["coordinates"] or [{}])[0]]
    if not all("name" in each for each in names) or len(slot["coordinates"]) != 1:
        return
    turn, (across, along) = f"(angle({spell(body)}) + ({line['angle']}))", (each["name"] for each in names)
    sign = "-" if names[0].get("sense") == -1 else ""
    directions = {along: (f"cos{turn}", f"sin{turn}"), across: (f"-({sign}sin{turn})", f"{sign}cos{turn}")}
    point = slot["with"]["point"]
    for name, (x, y) in directions.items():
        yield f"e_{name}", f"[{x}, {y}]"
        yield from ((f"{symbol}_{name}", f"{symbol}x({point})*{x} + {symbol}y({point})*({y})") for symbol in "va")


def _of_polar_joint(spec: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """The same of the only point that goes about a fixed one by polar coordinates."""
    polar = [joint for joint in spec["joints"] if joint["type"] == "polar"]
    names = [each for joint in polar for each in joint["coordinates"] if "name" in each]
    if len(polar) != 1 or len(names) != 2 or len(polar[0]["coordinates"]) != 2:
        return
    (first, second), (along, across) = polar[0]["with"]["of"], names
    if not str(first).startswith("ground."):
        return
    cosine, sine = (f"{f}(direction({first}, {second}))" for f in ("cos", "sin"))
    sign = "-" if across.get("sense") == -1 else ""
    directions = {along["name"]: (cosine, sine), across["name"]: (f"-({sign}{sine})", f"{sign}{cosine}")}
    for name, (x, y) in directions.items():
        yield f"e_{name}", f"[{x}, {y}]"
        yield from ((f"{symbol}_{name}", f"{symbol}x({second})*({x}) + {symbol}y({second})*({y})") for symbol in "va")


def _of_coordinates(spec: Mapping[str, Any], metadata: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Velocity and acceleration along the only length, or the only angle, among the coordinates, and of x₁, φ₂ by their index."""
    polar = {each.get("name") for joint in spec["joints"] if joint["type"] == "polar" for each in joint["coordinates"]}
    for dimension, symbols in (("m", "va"), ("rad", "ωα")):
        names = [c["name"] for c in metadata["coordinates"] if c["dimension"] == dimension]
        names = [name for name in names if dimension == "rad" or name not in polar]  # what goes about has more than that
        indices = [(found[1], name) for name in names if (found := re.fullmatch(r"[^\W\d_]+_?(\d+)", name))]
        read = [(symbol, word) for symbol, word in zip(symbols, ("rate", "accel"), strict=True)]
        if len(names) == 1:
            yield from ((symbol, f"{word}({spell(names[0])})") for symbol, word in read)
        yield from ((f"{symbol}_{index}", f"{word}({spell(name)})") for symbol, word in read for index, name in indices)

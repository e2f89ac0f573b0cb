"""What letters mean that nobody declared, as textbooks use them: ``α`` of the only body, ``a_{Gx}``, ``v_B``, ``I_O``, ``ΣM_O``, ``θ₀``,
``T`` and ``V``. They come after all names of the model and of the person, and the verdict says how they were read."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from freebody.model.names import spell
from freebody.model.start import Start

from .user_symbols import INITIAL

_LETTER = re.compile(r"[^\W\d_]\w?")
ENERGIES = {**dict.fromkeys(("T", "K", "KE"), "kinetic()"), **dict.fromkeys(("V", "U", "PE"), "potential()"), "E": "energy()"}
"""What they mean where no line of the statement makes them something else."""


def usual(spec: Mapping[str, Any], metadata: Mapping[str, Any], start: Start) -> Iterator[tuple[str, str]]:
    """Letters with what they mean in a model, as a declaration; only those that can mean but one thing."""
    points, rigid = _points(spec), [body["name"] for body in spec["bodies"] if not body["particle"]]
    for letter, (_, point) in points.items():
        for symbol, read in (("", ""), ("v_", "v"), ("a_", "a")):
            parts = [f"{read}{axis}({point})" for axis in "xy"]
            yield from (
                (f"{symbol or axis + '_'}{letter}{axis * bool(symbol)}", part) for axis, part in zip("xy", parts, strict=True)
            )
            if symbol:
                yield symbol + letter, f"[{', '.join(parts)}]"
        yield f"ΣM_{letter}", f"moment on all about {point}, along k"
    yield from ((f"ΣF_{axis}", f"force on all along {axis}") for axis in "xy")
    yield from (pair for body in rigid for pair in _of_body(body, points, alone=len(rigid) == 1))
    yield from _of_coordinates(metadata, start)


def _points(spec: Mapping[str, Any]) -> dict[str, tuple[str, str]]:
    """Body and name of each point that has a letter, its own or that of the joint there; G of the only body."""
    named = [(point["body"], point["name"], point["name"].rpartition(".")[2]) for point in spec["points"]]
    ground = ("ground", "ground.O", "O")
    joints = [(joint["with"].get("point") or (joint["with"].get("of") or [""])[-1], joint["name"]) for joint in spec["joints"]]
    named += [(point.rpartition(".")[0], point, letter) for point, letter in joints if isinstance(point, str) and "." in point]
    if len(spec["bodies"]) == 1:
        named.append((spec["bodies"][0]["name"], f"{spell(spec['bodies'][0]['name'])}.G", "G"))
    letters = [each for each in named if _LETTER.fullmatch(each[2])]
    moving = {letter for *_, letter in letters}
    letters += [] if "O" in moving else [ground]
    return {letter: (body, point) for body, point, letter in letters if sum(letter == other for *_, other in letters) == 1}


def _of_body(body: str, points: Mapping[str, tuple[str, str]], alone: bool) -> Iterator[tuple[str, str]]:
    """Rates of turning and moments of inertia: α or α_AB, I_O."""
    own = [letter for letter, (of, _) in points.items() if of == body]
    pairs = [a + b for a in own for b in own if a != b]
    for symbol, read in (("ω", "omega"), ("α", "alpha")):
        yield from (
            (name, f"{read}({spell(body)})") for name in (*([symbol] if alone else []), *(f"{symbol}_{pair}" for pair in pairs))
        )
    yield from ((f"I_{letter}", f"inertia of {body} about {points[letter][1]}") for letter in own)
    if alone and "O" in points and "O" not in own:
        yield "I_O", f"inertia of {body} about {points['O'][1]}"


def _of_coordinates(metadata: Mapping[str, Any], start: Start) -> Iterator[tuple[str, str]]:
    """Velocity and acceleration along the only coordinate; where each coordinate starts, and how fast, if nothing else decides it."""
    names, lengths = [c["name"] for c in metadata["coordinates"]], [c["dimension"] == "m" for c in metadata["coordinates"]]
    free = not metadata["closure_coordinates"] and not start.equilibrium and not start.points
    for name in names if free else ():
        yield f"{name}_0", f"{INITIAL}{start.fixed.get(name, 0)}"
    if len(names) == 1:
        v, a = ("v", "a") if lengths[0] else ("ω", "α")
        yield from ((v, f"rate({spell(names[0])})"), (a, f"accel({spell(names[0])})"))
        if free:
            yield f"{v}_0", f"{INITIAL}{start.rates.get(names[0], 0)}"

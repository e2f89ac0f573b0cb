"""Models drawn at random, in the language of model files: trees with loops, forces, motions and limits, some of them not engaged,
under names that have another meaning as well."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

import freebody as fb
from freebody.core.cards import joints
from freebody.run.records import quote
from freebody.solve.perturbed_states import others

NAMES = ("g", "t", "pi", "e", "i", "m", "N", "kg", "rad", "x", "T", "s", "l", "sin", "E_k", "alpha", "lambda", "λ", "θ", "m_rod",
         "I_rod", "upper arm", "b[1]", "d")  # fmt: skip
"""Units, constants, functions, symbols that are printed for other things, Greek ones, and names that must be quoted."""
RESERVED = ("t", "pi")
"""Refused as names of coordinates and parameters."""
RIGID = tuple(kind for kind, card in joints().items() if card.coordinates and kind != "wound_string")
"""Joints that hold at any values of their coordinates; a wound string has a free length above 0."""
PARTICLE = ("link", "slot", "curved_slot", "one_sided_cam", "free", "polar")
LOOPS = ("link", "slot", "hinge", "coupling")
FORCES = ("force", "torque", "spring", "torsion_spring", "damper", "law")
LIMITS = ("contact", "string", "stop")


class Draw:
    """A model being drawn; places in m, a few kg and N."""

    def __init__(self, seed: int, apart: bool = False) -> None:
        """``apart``: followers that a curve can only push are off it."""
        self.apart = apart
        self.rng = np.random.default_rng(seed)
        self.names = iter(self.rng.permutation(NAMES).tolist())
        self.letters = iter(
            [name for name in self.rng.permutation(NAMES).tolist() if name not in RESERVED and quote(name) == name]
        )
        self.bodies: dict[str, dict[str, Any]] = {}
        self.values: dict[str, float] = {}
        self.model: dict[str, Any] = {
            "freebody": 1, "parameters": {}, "gravity": self.of("none", 9.81, [3.0, -8.0]), "bodies": self.bodies, "joints": {},
            "ground": {"points": {"S": [0.3, 1.7]}, "lines": {}, "curves": {"wave": {"x": "s", "y": "0.4*s^2 + 0.1*s"}}},
            "forces": {}, "motions": {}, "contacts": {}, "strings": {}, "stops": {}, "events": {},
        }  # fmt: skip

    def of(self, *choices: Any) -> Any:
        return choices[self.rng.integers(len(choices))]

    def about(self, size: float) -> float:
        return round(float(self.rng.uniform(-size, size)), 3)

    def within(self, low: float, high: float) -> float:
        return round(float(self.rng.uniform(low, high)), 3)

    def engaged(self) -> dict[str, bool]:
        return {} if self.rng.random() < 0.8 else {"engaged": False}

    def body(self) -> None:
        """One more body, joined to ground or to a rigid body."""
        carriers = ["ground", *(name for name, body in self.bodies.items() if body.get("shape") != "particle")]
        name, carrier = next(self.names), self.of(*carriers)
        if self.rng.random() < 0.3:
            self.bodies[name] = {"shape": "particle", "mass": self.mass()}
            kind, point = self.of(*PARTICLE), f"{name}.centre"
        else:
            self.bodies[name] = {
                "mass": self.mass(), "inertia": self.within(0.05, 0.5), "centre": [self.about(0.3), self.about(0.3)],
                "points": {"P": [self.about(0.5), self.about(0.5)], "Q": [0.6, self.about(0.5)]},
                "curves": {"wave": {"x": "s", "y": "0.3*s^2 - 0.2*s"}},
            }  # fmt: skip
            kind, point = self.of(*RIGID), f"{name}.P"
        at = f"{carrier}.Q" if carrier != "ground" else "ground.O"
        line, circle = {"through": at, "angle": self.about(3)}, {"centre": point, "radius": 0.1}
        pushed = {**circle, "radius": self.of(0, 0.1)}
        fields: dict[str, Any] = {
            "slider": {"along": line, "line": {"through": point, "angle": self.about(3)}},
            "rollers": {"along": line, "points": [point, f"{name}.Q"]},
            "slot": {"along": line, "point": point},
            "curved_slot": {"along": f"{carrier}.wave", "point": point},
            "cam": {"along": f"{carrier}.wave", "follower": circle},
            "one_sided_cam": {"along": f"{carrier}.wave", "follower": pushed, "right": self.of(True, False)},
            "rolling": {"on": line, "circle": circle},
            "rolling_circles": {"on": {"centre": at, "radius": 0.4}, "circle": circle},
            "link": {"of": [at, point], "length": self.within(0.4, 1)},
        }.get(kind, {"of": [at, point]})
        card = [c for c in joints()[kind].coordinates if c.name != "angle" or "points" in self.bodies[name]]
        own = [f"q{len(self.values) + k}" if self.rng.random() < 0.5 else next(self.letters) for k in range(len(card))]
        self.model["joints"][f"J {name}"] = {"type": kind, **fields, "coordinates": own}
        for each, coordinate in zip(card, own, strict=True):
            if each.gap:
                gap = self.within(0.2, 0.8)
                self.values[coordinate] = self.of(gap if self.apart else 0.0, gap)
            else:
                self.values[coordinate] = self.within(0.5, 1.5) if each.name == "r" else self.about(1)

    def mass(self) -> float | str:
        """A number, or a parameter."""
        if self.rng.random() < 0.5:
            return self.within(0.3, 3)
        name = next(self.letters)
        self.model["parameters"][name] = f"{self.within(0.3, 3)} kg"
        return name

    def point(self) -> str:
        name = self.of(*self.bodies)
        return f"{name}.{self.of('P', 'Q') if 'points' in self.bodies[name] else 'centre'}"

    def place(self, point: str) -> np.ndarray:
        """Where a point is at the values drawn."""
        tree = self.mechanism(loops=False)
        state, _ = tree.start()
        texts = [f"{axis}({quote(point)})" for axis in "xy"]
        return np.array(tree.source().evaluate(texts, state))

    def ground_point(self, place: np.ndarray) -> str:
        name = f"A{len(self.model['ground']['points'])}"
        self.model["ground"]["points"][name] = [float(x) for x in place]
        return f"ground.{name}"

    def loop(self) -> None:
        """A joint to ground, or a coupling, that holds at the values drawn."""
        kind, point, name = self.of(*LOOPS), self.point(), f"loop {len(self.model['joints'])}"
        at = self.place(point)
        if kind == "hinge" and (len(self.values) < 3 or "centre" in point):
            kind = "slot"
        if kind == "coupling":
            first, second = self.rng.permutation(list(self.values))[:2] if len(self.values) > 1 else 2 * list(self.values)
            gone = self.values[first] + 0.5 * self.values[second]
            fields: dict[str, Any] = {"zero": f"{quote(first)} + 0.5*{quote(second)} - ({gone!r})"}
        elif kind == "link":
            away = np.array([self.within(0.5, 1), self.about(0.5)])
            fields = {"of": [self.ground_point(at + away), point], "length": float(np.hypot(*away))}
        elif kind == "slot":
            fields = {"along": {"through": self.ground_point(at), "angle": self.about(3)}, "point": point}
        else:
            fields = {"of": [self.ground_point(at), point]}
        self.model["joints"][name] = {"type": kind, **fields}

    def force(self) -> None:
        kind, point, other = self.of(*FORCES), self.point(), self.of("ground.S", self.point())
        other = "ground.S" if other.split(".")[0] == point.split(".")[0] else other
        rigid = [name for name, body in self.bodies.items() if "points" in body]
        coordinate, turning = quote(self.of(*self.values)), kind in ("torque", "torsion_spring")
        if turning and not rigid:
            kind, turning = "law", False
        on = {"on": self.of(*rigid)} if turning else {}
        fields: dict[str, Any] = {
            "force": {"at": point, "x": self.about(5), "y": f"{self.about(5)}*cos(2*t)"},
            "torque": on | {"value": self.about(3)},
            "spring": {"stiffness": self.within(5, 20)} | self.of({"between": [other, point]}, {"along": coordinate}),
            "torsion_spring": on | {"stiffness": self.within(1, 5), "rest_angle": self.about(1)},
            "damper": {"along": coordinate, "damping": self.within(0.1, 1)},
            "law": {"along": coordinate, "value": f"{self.about(3)}*cos({coordinate}*1)"},
        }[kind]
        self.model["forces"][f"F{len(self.model['forces'])}"] = {"type": kind, **fields, **self.engaged()}

    def motion(self) -> None:
        coordinate = self.of(*self.values)
        level, law = self.of(
            ("position", f"{self.values[coordinate]!r} + 0.2*sin(3*t)"),
            ("velocity", "0.4*cos(2*t)"),
            ("acceleration", "1.5*sin(1*t)"),
        )
        self.model["motions"]["drive"] = {"of": quote(coordinate), "is": law, "level": level, **self.engaged()}

    def lock(self) -> None:
        """A coordinate that is held from the start on."""
        self.model["events"]["hold"] = {"at": "start", "then": {"lock": quote(self.of(*self.values))}}

    def limit(self) -> None:
        """A contact, string or stop that is closed at the values drawn."""
        kind, point = self.of(*LIMITS), self.point()
        name, at = f"limit {self.rng.integers(100)}", self.place(point)
        if kind == "contact":
            line = {"through": self.ground_point(at).split(".")[1], "angle": self.about(0.5)}
            self.model["ground"]["lines"][name] = line
            friction = self.of({}, {"friction": 0.3}, {"rough": True})
            self.model["contacts"][name] = {"of": [point, f"ground.{name}"], **friction, **self.engaged()}
        elif kind == "string":
            away = np.array([self.about(0.5), self.within(0.5, 1)])
            self.model["strings"][name] = {"ends": [self.ground_point(at + away), point], **self.engaged()}
        else:
            coordinate = self.of(*self.values)
            self.model["stops"][name] = {"of": quote(coordinate), "least": self.values[coordinate]} | self.engaged()

    def switches(self) -> None:
        """A floor below a point, a stop that is still open, a force that begins to act, and crossings to be recorded."""
        point, place = (chosen := self.point()), self.place(chosen)
        surface = {"through": self.ground_point(place - [0, self.within(0.1, 0.6)]).split(".")[1], "angle": self.about(0.3)}
        self.model["ground"]["lines"]["floor"] = surface
        touch = {"restitution": self.of(0, 0.4, 0.8)} | self.of({}, {"friction": 0.2})
        self.model["contacts"]["floor"] = {"of": [point, "ground.floor"], **touch}
        for name, sign in (("rise", 1), ("fall", -1)):
            coordinate = self.of(*self.values)
            self.model["events"][name] = {
                "when": f"{quote(coordinate)} - ({self.values[coordinate] + sign * self.within(0.05, 0.4)!r})"
            }
        coordinate = self.of(*self.values)
        value = self.values[coordinate]
        self.model["stops"]["open"] = {
            "of": quote(coordinate),
            "most": value + self.within(0.1, 0.5),
            "restitution": self.of(0, 0.5),
        }
        law = f"-20*max(0, {quote(coordinate)} - ({value + self.within(0.05, 0.3)!r}))"
        self.model["forces"]["buffer"] = {"type": "law", "along": quote(coordinate), "value": law}
        self.model["run"] = {"until": 1.5, "impacts": "newton", "painleve": "impact"}

    def mechanism(self, loops: bool = True) -> fb.Mechanism:
        values = {"guess": self.values} if loops else self.values
        model = self.model | {"initial": {**values, "at_rest": True}}
        if not loops:
            tree = {name: joint for name, joint in model["joints"].items() if "coordinates" in joint}
            model |= {"joints": tree} | {word: {} for word in ("motions", "contacts", "strings", "stops", "forces", "events")}
        return fb.Mechanism.loads(json.dumps(model), "random")


def drawn(seed: int) -> fb.Mechanism:
    """A model of one to three bodies with up to one loop, motion, limit and lock, and up to three forces."""
    return _drawn(seed).mechanism()


def _drawn(seed: int, apart: bool = False) -> Draw:
    draw = Draw(seed, apart)
    for _ in range(draw.rng.integers(1, 4)):
        draw.body()
    for add, chance in ((draw.loop, 0.3), (draw.motion, 0.3), (draw.limit, 0.4), *(3 * [(draw.force, 0.6)]), (draw.lock, 0.2)):
        if draw.rng.random() < chance:
            add()
    return draw


def rough(seed: int) -> fb.Mechanism:
    """A model whose slides have friction. It moves, with rates that keep closed what is closed, where no motion prescribes them."""
    draw = _drawn(seed)
    bare = draw.mechanism()
    for joint in draw.model["joints"].values():
        joint |= {"friction": draw.within(0.1, 0.4)} if joint["type"] in ("slider", "slot", "curved_slot") else {}
    source, start = bare.source(), {"guess": draw.values, "at_rest": True}
    moving = [] if draw.model["motions"] else others(source, bare.start()[0])
    names = [quote(coordinate["name"]) for coordinate in source.metadata["coordinates"]]
    for state in moving[:1]:
        start = {word: dict(zip(names, part.tolist(), strict=True)) for word, part in (("guess", state.q), ("rates", state.u))}
    return fb.Mechanism.loads(json.dumps(draw.model | {"initial": start}), "random")


def resting(seed: int) -> fb.Mechanism:
    """A model that has a place of rest near the values drawn: springs and dampers on its coordinates, steady forces, a motion that
    stands still or follows a law of places and rates."""
    draw = Draw(seed)
    for _ in range(draw.rng.integers(1, 4)):
        draw.body()
    for add, chance in ((draw.loop, 0.4), (draw.limit, 0.4), *(2 * [(draw.force, 0.6)])):
        if draw.rng.random() < chance:
            add()
    for force in draw.model["forces"].values():
        force |= {"y": force["y"].split("*")[0]} if "y" in force else {}
    for place, (coordinate, value) in enumerate(draw.values.items()):
        spring = f"-{draw.within(20, 90)!r}*({quote(coordinate)} - ({value!r})) - {draw.of(0.0, draw.within(0.1, 2))!r}*rate({quote(coordinate)})"
        draw.model["forces"][f"hold {place}"] = {"type": "law", "along": quote(coordinate), "value": spring}
    if draw.rng.random() < 0.3:
        coordinate = draw.of(*draw.values)
        value, law = (
            draw.values[coordinate],
            f"-{draw.within(2, 9)!r}*({quote(coordinate)} - (VALUE)) - 0.5*rate({quote(coordinate)})",
        )
        level, law = draw.of(("position", repr(value)), ("acceleration", law.replace("VALUE", repr(value))))
        draw.model["motions"]["drive"] = {"of": quote(coordinate), "is": law, "level": level}
    for joint in draw.model["joints"].values():
        joint |= {"friction": 0.2} if joint["type"] in ("slider", "slot", "curved_slot") and draw.rng.random() < 0.15 else {}
    return draw.mechanism()


def switching(seed: int) -> fb.Mechanism:
    """Such a model with more that switches on its way."""
    draw = _drawn(seed)
    draw.switches()
    return draw.mechanism()


def locked(seed: int) -> tuple[fb.Mechanism, fb.Mechanism, str]:
    """A model with a coordinate that is locked at the start; the same with a motion that keeps its rate at 0 instead; the coordinate."""
    draw = _drawn(seed)
    draw.lock()
    held, coordinate = draw.mechanism(), draw.model["events"].pop("hold")["then"]["lock"]
    draw.model["motions"]["hold"] = {"of": coordinate, "is": 0, "level": "velocity"}
    return held, draw.mechanism(), coordinate

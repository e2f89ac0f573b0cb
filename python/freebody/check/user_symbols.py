"""What a declared symbol means: an expression of the model language, components of a vector, or a phrase."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from freebody.core.compiled import BEFORE
from freebody.model.errors import ModelProblem
from freebody.model.names import spell, suggestion
from freebody.symbolic.dimensions import ACCELERATION, ANGLE, ENERGY, FORCE, LENGTH, MASS, NUMBER_ONLY, SPEED, TIME, Dimension

from .rates import derivative

Array = NDArray[np.float64]
Values = Mapping[str, Array]
"""Values (K,) of expressions of the model language, by their text."""
Masses = Callable[[], Mapping[str, tuple[Array, Array]]]
"""Mass (K,) and moment of inertia about the mass centre (K,) of each body by name."""


@dataclass(frozen=True)
class Meaning:
    """What a symbol is. ``texts`` are one expression for a number, three for a vector along i, j, k.

    ``kind`` is parameter, coordinate, gauge, time, gravity, direction, reaction, initial, amplitude or declared; ``dimension`` None fits any.
    """

    kind: str
    texts: tuple[str, ...]
    dimension: Dimension | None = None

    @property
    def is_vector(self) -> bool:
        """Whether it has components along i, j, k."""
        return len(self.texts) == 3

    def needed(self, dots: int) -> list[str]:
        """The expressions from which its derivative of that order is read. Raises ``ModelProblem``."""
        if self.kind in ("initial", "integral"):
            return [OF_START.sub(lambda found: f"⟦{_rate_of(found[1], dots)}⟧", text) for text in self.texts]
        return [derivative(text, dots) for text in self.texts]

    def value(self, dots: int, values: Values, masses: Masses) -> Array:
        """Its derivative of that order over K samples: (K,), a vector (K, 3)."""
        found = [values[text] for text in self.needed(dots)]
        return np.stack(found, axis=-1) if self.is_vector else found[0]


@dataclass(frozen=True)
class OfBodies(Meaning):
    """A sum over bodies as a vector along i, j, k: Σ (m x, m y, m z + I s), where ``texts`` are x, y, z, s of each body; the
    resultant of the forces from outside, their moment, or a momentum. ``rates``: the same of the derivatives that are known.
    ``axis`` leaves one component, a number."""

    bodies: tuple[str, ...] = ()
    rates: tuple[tuple[str, ...], ...] = ()
    axis: int | None = None

    @property
    def is_vector(self) -> bool:
        return self.axis is None

    def needed(self, dots: int) -> list[str]:
        if dots > len(self.rates):
            raise ModelProblem("only the first rate of a momentum is known, and none of a force or a moment")
        return list((self.texts, *self.rates)[dots])

    def value(self, dots: int, values: Values, masses: Masses) -> Array:
        parts, known = np.array([values[text] for text in self.needed(dots)]), masses()
        weights = np.array([(m, m, m, i) for m, i in map(known.__getitem__, self.bodies)])
        x, y, z, s = (weights * parts.reshape(weights.shape)).swapaxes(0, 1)
        found = np.stack([sum(x), sum(y), sum(z + s)], axis=-1)
        return found if self.axis is None else found[:, self.axis]


@dataclass(frozen=True)
class RadiusOfGyration(OfBodies):
    """√(I/m) of one body."""

    def value(self, dots: int, values: Values, masses: Masses) -> Array:
        return np.sqrt(super().value(dots, values, masses) / masses()[self.bodies[0]][0])


_KINDS = {"position": ("x", LENGTH), "velocity": ("vx", SPEED), "acceleration": ("ax", ACCELERATION)}
_AT_MOMENT = re.compile(r"(.+?)\s*@\s*(.+)")
_POINT = r"(\S+)"
_PLACE = re.compile(rf"(position|velocity|acceleration) of {_POINT}(?: (?:from|relative to) {_POINT})?")
_DIRECTION = re.compile(rf"(direction|normal) from {_POINT} to {_POINT}")
_JOINT = re.compile(r"(force|couple) (?:of|at) (.+) on (.+)")
_GROUP = re.compile(r"(angular momentum|moment) (?:of|on) (.+) about (\[.+\]|\S+?)(, along -?k)?")
_MOMENTUM = re.compile(r"momentum of (.+) along \[(.+)\]")
_FORCE = re.compile(r"force on (.+?)(?: along ([xy]))?")
_INERTIA = re.compile(rf"(inertia|radius of gyration) of (.+) about {_POINT}")
INITIAL = "at the start: "
"""How a declaration begins of what something is where the motion starts."""
LARGEST, LEAST = "the largest", "the least"
"""How one begins of what a quantity has along the motion from the start."""
AMPLITUDE = "the amplitude of "
"""How one begins of half of what a quantity goes to and fro from a state on."""
LAG = "the phase lag of "
"""How one begins of the angle by which a forced vibration is behind what drives it."""
OF_START = re.compile("⟦(.+?)⟧")
"""A part of a text whose value where the motion starts is asked, or at a moment that stands behind it."""
OF_TIME = re.compile(r"(?<![\w.])t(?![\w.(])")
"""The time itself in an expression of the model language."""
MOMENT = " @ "
"""What stands between an expression and the moment of the motion at which its value is asked."""
WORK = re.compile(r"\.work\b|\bfriction_work\(")
"""What is summed up from the start of a motion on."""
SUMMED = "summed up: "
"""How a text begins of an integral along the motion: what is summed up, over what, from where."""
LOAD = "load "
"""How a text begins that names a load of the free-body diagrams, one place of a contact that holds at several, by its symbol."""


@dataclass(frozen=True)
class Reader:
    """Reads declarations. ``measured`` gives the text in SI and the dimension of an expression; ``joints`` the first and second
    body of each; ``particles`` the bodies without rotation, ``happenings`` the events and what may change on a motion."""

    measured: Callable[[str], tuple[str, Dimension | None]]
    joints: Mapping[str, tuple[str, str]]
    bodies: Sequence[str]
    particles: frozenset[str]
    happenings: Sequence[str]

    def read(self, said: str | Sequence[str | float]) -> Meaning:
        """The meaning of an expression, a list of two or three components, or a phrase. Raises ``ModelProblem``."""
        if isinstance(said, str) and said.strip().startswith("[") and said.strip().endswith("]"):
            said = _parts(said.strip()[1:-1])
        if not isinstance(said, str):
            return self.components(list(said))
        phrase = " ".join(said.split())
        if phrase.startswith(INITIAL):
            text, dimension = self.measured(phrase.removeprefix(INITIAL))
            return Meaning("initial", (f"⟦{text}⟧",), dimension)
        for word in (LARGEST, LEAST):
            if phrase.startswith(f"{word}: "):
                text, dimension = self.measured(phrase.removeprefix(f"{word}: "))
                return Meaning("initial", (f"⟦{word}: {text}⟧",), dimension)
        if phrase.startswith(AMPLITUDE):
            text, dimension = self.measured(phrase.removeprefix(AMPLITUDE))
            return Meaning("amplitude", (f"{AMPLITUDE}{text}",), dimension)
        if phrase.startswith(LAG):
            return Meaning("amplitude", (f"{LAG}{self.measured(phrase.removeprefix(LAG))[0]}",), ANGLE)
        if asked := _AT_MOMENT.fullmatch(phrase):
            text, dimension = self.measured(asked[1])
            return Meaning("initial", (f"⟦{text}{self.at_moment(asked[2])}⟧",), dimension)
        if phrase.startswith(LOAD):
            return Meaning("reaction", (phrase,), FORCE)
        phrases = {_PLACE: self.place, _DIRECTION: self.direction, _JOINT: self.reaction}
        phrases |= {_GROUP: self.moment, _MOMENTUM: self.momentum, _FORCE: self.resultant, _INERTIA: self.inertia}
        for pattern, reading in phrases.items():
            if found := pattern.fullmatch(phrase):
                return reading(*found.groups())
        text, dimension = self.measured(said)
        return Meaning("declared", (text,), dimension)

    def at_moment(self, said: str) -> str:
        """How a text goes on that is asked at a moment: ``start``, a time, what happens, or just ``before`` that. Raises ``ModelProblem``."""
        name = said.removeprefix("after ").removeprefix(BEFORE)
        if name == "start":
            return ""
        if not (name in self.happenings or name[0].isdigit()):
            known = ", ".join(self.happenings) or "nothing does"
            raise ModelProblem(f"`{name}` is nothing that happens on a motion of this model", f"what may happen: {known}")
        return f"{MOMENT}{said.removeprefix('after ')}"

    def components(self, said: Sequence[str | float]) -> Meaning:
        """A vector of two components along i and j, or three."""
        if len(said) not in (2, 3):
            raise ModelProblem(f"a vector has two components (i, j) or three (i, j, k), not {len(said)}")
        found = [self.measured(str(part)) for part in said]
        dimension = next((d for _, d in found if d is not None), None)
        for text, other in found:
            if other is not None and dimension is not None and not other.fits(dimension):
                raise ModelProblem(f"`{text}` is {other.words()}, another component {dimension.words()}")
        return self.vector(map(str, said), dimension)

    def vector(self, said: Iterable[str], dimension: Dimension | None) -> Meaning:
        """A vector by its components along i and j, and k if that is not 0."""
        return Meaning("declared", (*(self.measured(part)[0] for part in said), "0")[:3], dimension)

    def place(self, kind: str, point: str, base: str | None) -> Meaning:
        """``acceleration of upper.G relative to ground.O``; without a base point, from the fixed origin."""
        word, dimension = _KINDS[kind]
        texts = (f"{w}({point})" + (f" - {w}({base})" if base else "") for w in (word, word.replace("x", "y")))
        return self.vector(texts, dimension)

    def direction(self, kind: str, start: str, end: str) -> Meaning:
        """The unit vector from one point to another; ``normal``: turned a quarter to the left."""
        cosine, sine = (f"{f}(direction({start}, {end}))" for f in ("cos", "sin"))
        return self.vector([cosine, sine] if kind == "direction" else [f"-{sine}", cosine], NUMBER_ONLY)

    def reaction(self, what: str, joint: str, body: str) -> Meaning:
        """What a joint does to one of its two bodies; a couple is along k."""
        if joint not in self.joints:
            raise ModelProblem(f"there is no joint `{joint}`", suggestion(joint, self.joints))
        first, second = self.joints[joint]
        if body not in (first, second):
            raise ModelProblem(f"`{joint}` does not touch `{body}`", f"it joins `{first}` and `{second}`")
        sign = "" if body == second else "-"
        if what == "couple":
            return self.vector(["0", "0", f"{sign}{joint}.M"], ENERGY)
        return self.vector([f"{sign}{joint}.Fx", f"{sign}{joint}.Fy"], FORCE)

    def momentum(self, bodies: str, along: str) -> Meaning:
        """That of bodies along a unit vector, a number."""
        group = self.group(bodies)
        x, y = (self.measured(part)[0] for part in _parts(along))
        along, rate = (
            tuple(text for body in map(spell, group) for text in (f"({x})*{v}x({body}.G) + ({y})*{v}y({body}.G)", "0", "0", "0"))
            for v in "va"
        )
        return OfBodies("declared", along, FORCE.times(TIME), group, (rate,), 0)

    def moment(self, what: str, bodies: str, point: str, number: str | None) -> Meaning:
        """Angular momentum of bodies about a point, or the moment on them; as a vector, or as a ``number`` along k or against it."""
        group, axis = self.group(bodies), 2 if number else None
        sign = "-" if number == ", along -k" else ""
        first, second = (self.orbits(group, point, v, spin, sign) for v, spin in (("v", "omega"), ("a", "alpha")))
        if what == "moment":
            return OfBodies("declared", second, ENERGY, group, axis=axis)
        return OfBodies("declared", first, ENERGY.times(TIME), group, (second,), axis)

    def orbits(self, group: Sequence[str], point: str, symbol: str, spin: str, sign: str) -> tuple[str, ...]:
        """For each body r × v by its mass, and its spin by its inertia."""
        out: list[str] = []
        x, y = [self.measured(part)[0] for part in _parts(point[1:-1])] if point[0] == "[" else (f"x({point})", f"y({point})")
        for body in group:
            g = f"{spell(body)}.G"
            turn = f"{sign}((x({g}) - ({x}))*{symbol}y({g}) - (y({g}) - ({y}))*{symbol}x({g}))"
            turns = "0" if body in self.particles else self.measured(f"{sign}{spin}({spell(body)})")[0]
            out += ["0", "0", self.measured(turn)[0], turns]
        return tuple(out)

    def inertia(self, what: str, body: str, point: str) -> Meaning:
        """The moment of inertia of a body about a point, by the parallel axis, or its radius of gyration."""
        (name,) = self.group(body)
        square = f"(x({point}) - x({spell(name)}.G))^2 + (y({point}) - y({spell(name)}.G))^2"
        parts = ("0", "0", self.measured(square)[0], "0" if name in self.particles else "1")
        kind = "inertia" if point.startswith(f"{spell(name)}.") else "declared"
        if what != "inertia":
            return RadiusOfGyration(kind, parts, LENGTH, (name,), axis=2)
        return OfBodies(kind, parts, MASS.times(LENGTH, 2), (name,), axis=2)

    def resultant(self, bodies: str, axis: str | None) -> Meaning:
        """All that acts on bodies from outside: Σ m a of their mass centres; its component along an axis."""
        group = self.group(bodies)
        found = [[self.measured(f"{a}({body}.G)")[0] for a in ("ax", "ay")] for body in map(spell, group)]
        return OfBodies(
            "declared", tuple(text for x, y in found for text in (x, y, "0", "0")), FORCE, group, (), axis and "xy".index(axis)
        )

    def group(self, bodies: str) -> tuple[str, ...]:
        """The bodies of ``upper, lower`` or ``all``."""
        if bodies.strip() == "all":
            return tuple(self.bodies)
        names = [name.strip() for name in re.split(r",| and ", bodies) if name.strip()]
        for name in names:
            if name not in self.bodies:
                raise ModelProblem(f"there is no body `{name}`", suggestion(name, self.bodies))
        return tuple(names)


def _rate_of(asked: str, dots: int) -> str:
    """The derivative of what is asked of a moment, at that."""
    text, at, moment = asked.partition(MOMENT)
    return derivative(text, dots) + at + moment


def _parts(text: str) -> list[str]:
    """The parts of a list, at the commas outside brackets."""
    out, depth = [""], 0
    for char in text:
        depth += (char in "([") - (char in ")]")
        if char == "," and not depth:
            out.append("")
        else:
            out[-1] += char
    return out

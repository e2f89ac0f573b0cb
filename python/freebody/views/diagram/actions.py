"""What acts on a group of bodies cut free, as arrows that know nothing yet of the paper."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from freebody.core import Array, Body, FreeBodies, Load, Part
from freebody.views.diagram.names import Labels, Sign
from freebody.views.dimension_lines import digits, place_between
from freebody.views.sketch import Sketch

_ROUND_OFF = 1e-9
"""Relative to the largest force of a diagram, below which an arrow would show only round-off."""

_NOTHING = 1e-12
"""Relative to the largest force a little further on, below which there is none."""

_ACROSS = 50.0
"""Sizes of symbols in a mechanism: how far a force may be from where its moment is taken."""
_WAYS = ("to the right", "up and to the right", "up", "up and to the left", "to the left", "down and to the left", "down",
         "down and to the right")  # fmt: skip


@dataclass(frozen=True)
class Action:
    """A force or a couple on one body. ``at`` (2,) in m and ``force`` (2,), fixed axes; ``couple`` is counter-clockwise. Of a
    symbolic diagram ``force`` is a unit direction and ``couple`` a sign; to scale they are in N and N·m.

    ``name`` and ``kind`` are those of the load; ``kind`` ``effective`` is a term m a or I α. ``pulls``: it can only be drawn away
    from its body, as the pull of a string is; ``presses``: it is drawn towards the surface that it presses on.
    """

    name: str
    kind: str
    sign: Sign
    body: str
    at: Array
    force: Array
    couple: float = 0.0
    loads: tuple[Load, ...] = ()
    pulls: bool = False
    presses: bool = False

    @property
    def label(self) -> str:
        """What is written at it, in LaTeX."""
        return self.sign.latex

    @property
    def turns(self) -> bool:
        """Whether it is a couple."""
        return not self.force.any()

    @property
    def size(self) -> float:
        """In N or N·m, to scale."""
        return abs(self.couple) if self.turns else float(np.hypot(*self.force))

    @property
    def way(self) -> str:
        """Its direction in words."""
        if self.turns:
            return "counter-clockwise" if self.couple > 0 else "clockwise"
        return _WAYS[round(float(np.arctan2(*self.force[::-1])) / (np.pi / 4)) % 8]


def symbolic(free: FreeBodies, near: FreeBodies, group: Collection[str], labels: Labels, sketch: Sketch) -> Iterator[Action]:
    """Every load on a group in the positive sense of its symbol, friction that slides as it acts. ``near``: the same a little
    further on, where what is 0 now has a direction."""
    beyond = {load.symbol: load for load in near.on(*group)}
    for load in free.on(*group):
        if not load.unknown and all(part.idle for part in load.on):
            # Now it is 0: its directions are those that it has a little further on.
            now, then = {part.body: part.point for part in load.on}, beyond.get(load.symbol, load).on
            load = replace(load, on=tuple(replace(part, point=now.get(part.body, part.point)) for part in then))
        for part in (part for part in load.on if part.body in group):
            force, couple = _sense(load, part, sketch)
            size, plain = np.hypot(*force), _acts(load, part, labels.of(load), force, couple, sketch)
            if size > 0:
                yield replace(plain, force=force / size, couple=0.0)
            if couple:
                yield replace(plain, force=np.zeros(2), couple=float(np.sign(couple)))


def _acts(load: Load, part: Part, sign: Sign, force: Array, couple: float, sketch: Sketch) -> Action:
    at = attached(load, part, sketch)
    others = [other.point for other in load.on if other is not part]
    pulls = load.card.pulls and force @ part.force > 0  # a string or a link; else a spring between two points
    if not load.card.pulls and load.kind == "force" and len(others) == 1:
        pulls = force @ np.subtract(others[0], part.point) > 0
    presses = load.card.presses and (load.kind != "joint" or _upon(load, part, force, at, sketch))
    size = float(np.hypot(*force))
    if load.kind == "joint" and load.name in sketch.faces and size > 0:
        # A slider or roller is pressed where it lies on its guide, not in its middle.
        presses = True
        body, faces = sketch.faces[load.name]
        push = force / size if part.body == body else -force / size
        at = at + push * ((sketch.moved(body, faces) - at) @ push).min()
    return Action(load.name, load.kind, sign, part.body, at, force, couple, (load,), bool(pulls), presses)


def _upon(load: Load, part: Part, force: Array, at: Array, sketch: Sketch) -> bool:
    """Whether the force of a joint pushes a wheel and what it rolls on apart; other joints hold what may be on either side."""
    joint = next(each for each in sketch.spec["joints"] if each["name"] == load.name)
    if "circle" not in joint["with"]:
        return False
    centre = joint["with"]["circle"]["centre"]
    push = force if part.body == sketch.at[centre][0] else -force
    return float((sketch.place(centre) - at) @ push) > 0


def attached(load: Load, part: Part, sketch: Sketch) -> Array:
    """Where a diagram shows a part: of a link or string at its own end, of a belt on its own rim, of a follower where it touches its
    curve, of a torque at the joint of its two bodies, else where it acts."""
    name = load.name.removesuffix(".contact") if load.kind == "stop" else load.name  # of a one-sided cam
    joint = next((j for j in sketch.spec["joints"] if j["name"] == name), None)
    if load.kind in ("joint", "stop") and joint:
        fields = joint["with"]
        if load.card.pulls:
            ends = fields.get("of") or [fields["from"]]
            return next((sketch.place(point) for point in ends if sketch.at[point][0] == part.body), np.array(part.point))
        if joint["type"] == "belt":  # where its strand leaves the rim of this wheel
            centre = next(sketch.place(point) for point in fields["of"] if sketch.at[point][0] == part.body)
            way = np.array(part.force) / np.hypot(*part.force)
            return np.array(part.point) + ((centre - part.point) @ way) * way
        if "follower" in fields:
            centre, size = sketch.place(fields["follower"]["centre"]), np.hypot(*part.force)
            on_follower = part.body == sketch.at[fields["follower"]["centre"]][0]
            push = np.array(part.force) / (size if on_follower else -size)
            away = -push if load.kind == "joint" and fields.get("right") else push  # a normal force is positive to the left
            return centre - sketch.number(fields["follower"]["radius"]) * away
    if load.kind in ("force", "motion", "lock") and not any(part.force):
        place = place_between(sketch, set(load.of))
        return np.array(part.point) if place is None else place
    return np.array(part.point)


def _sense(load: Load, part: Part, sketch: Sketch) -> tuple[Array, float]:
    """Force and couple of a part in the sense in which the load's symbol is positive."""
    force, couple = np.array(part.force), part.couple
    if load.follows and load.follows[1] < 0:
        return -force, -couple
    if load.unknown or load.kind == "weight":
        return force, couple
    others = [other for other in load.on if other is not part]
    spec = next((f for f in sketch.spec.get("forces", []) if f["name"] == load.name), None)
    if spec is None:
        return force, couple
    if load.card.couple and "on" in spec["with"]:
        return np.zeros(2), 1.0 if part.body == spec["with"]["on"] else -1.0
    if "between" in spec["with"] and len(others) == 1:
        pull = np.subtract(others[0].point, part.point)
        return (pull if pull.any() else force), 0.0
    return force, couple


def to_scale(
    free: FreeBodies, near: FreeBodies, group: Collection[str], labels: Labels, sketch: Sketch, effective: bool
) -> tuple[list[Action], list[Action], list[str]]:
    """What acts on a group at the instant, the components of a pin's force together; m a and I α where asked for; and what
    cannot be drawn, in words. ``near``: the same a little further on, beside whose forces those of a mechanism at rest are 0."""
    loads = free.on(*group)
    forces = list(_acting(loads, group, labels, sketch))
    terms = [term for name in group for term in _terms(free.bodies[name], labels)] if effective else []
    largest = max((action.size for action in forces + terms if not action.turns), default=0.0)
    turning = max([action.size for action in forces + terms if action.turns] + [largest * _ACROSS * sketch.size])
    usual = max((abs(load.value) * float(np.hypot(*part.force)) for load in near.loads for part in load.on), default=0.0)
    least = max(_ROUND_OFF * largest, _NOTHING * usual), max(_ROUND_OFF * turning, _NOTHING * usual * sketch.size)

    def seen(actions: list[Action]) -> list[Action]:
        return [action for action in actions if action.size > least[action.turns]]

    shown = {load.symbol for action in seen(forces) for load in action.loads}
    unknown = [labels.of(load).plain for load in loads if not load.determinate]
    none = [labels.of(load).plain for load in loads if load.determinate and load.symbol not in shown]
    notes = [f"not determined: {', '.join(unknown)}"] * bool(unknown) + [f"{', '.join(none)} = 0"] * bool(none)
    return [_with_value(a, labels) for a in seen(forces)], [_with_value(a, labels) for a in seen(terms)], notes


def _acting(loads: Collection[Load], group: Collection[str], labels: Labels, sketch: Sketch) -> Iterable[Action]:
    found: dict[tuple[str, bool, str], Action] = {}
    for load in (load for load in loads if load.determinate):
        for i, part in enumerate(load.on):
            if part.body not in group:
                continue
            force, couple = load.value * np.array(part.force), load.value * part.couple
            new = _acts(load, part, labels.whole(load), force, couple, sketch)
            for one in (replace(new, couple=0.0), replace(new, force=np.zeros(2))):
                key = (f"{load.path} {one.label} {i * (load.kind == 'string')}", one.turns, one.body)
                if one.force.any() or one.couple:
                    if first := found.get(key):
                        forces, loads = first.force + one.force, first.loads + one.loads
                        one = replace(first, force=forces, couple=first.couple + one.couple, loads=loads)
                    found[key] = one
    return found.values()


def _with_value(action: Action, labels: Labels) -> Action:
    if not labels.figures:
        return action
    unit, sign, value = (
        labels.turning_unit if action.turns else labels.unit,
        action.sign,
        digits(action.size, most=labels.figures),
    )
    mantissa, _, power = value.partition("e")
    figure = rf"{mantissa}\times 10^{{{int(power.replace('−', '-'))}}}" if power else value
    shown = rf"{sign.latex} = {figure}\ \mathrm{{{unit}}}".replace("·", r"\,")
    return replace(action, sign=Sign(shown, f"{sign.plain} = {value} {unit}"))


def effective(free: FreeBodies, near: FreeBodies, group: Collection[str], labels: Labels) -> Iterator[Action]:
    """The other side of the balance, symbolic: m a at every mass centre, by components for a body by itself; I α. Of a body
    that is massless only by a parameter's value, as ``near`` tells, they are there."""
    for name in group:
        body = replace(free.bodies[name], mass=near.bodies[name].mass, inertia=near.bodies[name].inertia, alpha=1.0)
        for term in _terms(body if any(body.a) else replace(body, a=(1.0, 1.0)), labels):
            if term.turns:
                yield replace(term, couple=1.0)
            elif len(group) > 1:
                yield replace(term, force=term.force / np.hypot(*term.force))
            else:
                for part, way in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
                    yield replace(term, sign=labels.mass(name) * labels.component(name, part), force=np.array(way))


def _terms(body: Body, labels: Labels) -> Iterator[Action]:
    """m a and I α of a body, as far as they are not 0."""
    name = body.name
    plain = Action(name, "effective", Sign("", ""), name, np.array(body.G), np.zeros(2))
    if body.mass and any(body.a):
        yield replace(plain, sign=labels.mass(name) * labels.acceleration(name), force=body.mass * np.array(body.a))
    if body.inertia and not body.particle and body.alpha:
        yield replace(plain, sign=labels.inertia(name) * labels.angular(name), couple=body.inertia * body.alpha)

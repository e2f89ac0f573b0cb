"""What acts on a group of bodies cut free, as arrows that know nothing yet of the paper."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np

from freebody.free_body import FreeBodies, Load, Part
from freebody.results import Array
from freebody.views.diagram.names import Letters
from freebody.views.measures import digits, place_of
from freebody.views.scene import Sketch

_ROUND_OFF = 1e-9
"""Relative to the largest force of a diagram, below which an arrow would show only round-off."""


@dataclass(frozen=True)
class Action:
    """A force or a couple on one body. ``at`` (2,) in m and ``force`` (2,), fixed axes; ``couple`` is counter-clockwise. Of a
    symbolic diagram ``force`` is a unit direction and ``couple`` a sign; to scale they are in N and N·m.

    ``name`` and ``kind`` are those of the load; ``kind`` ``effective`` is a term m a or I α.
    """

    name: str
    kind: str
    label: str
    body: str
    at: Array
    force: Array
    couple: float = 0.0
    loads: tuple[Load, ...] = ()

    @property
    def turns(self) -> bool:
        """Whether it is a couple."""
        return not self.force.any()


def symbolic(free: FreeBodies, group: Collection[str], letters: Letters, sketch: Sketch) -> Iterator[Action]:
    """Every load on a group in the positive sense of its letter."""
    for load in free.on(*group):
        for part in load.on:
            if part.body in group:
                yield from _positive(load, part, letters.of(load), sketch)


def _positive(load: Load, part: Part, label: str, sketch: Sketch) -> Iterator[Action]:
    force, couple = _sense(load, part, sketch)
    size, at = np.hypot(*force), attached(load, part, sketch)
    plain = Action(load.name, load.kind, label, part.body, at, force, couple, (load,))
    if size > 0:
        yield replace(plain, force=force / size, couple=0.0)
    if couple:
        yield replace(plain, force=np.zeros(2), couple=float(np.sign(couple)))


def attached(load: Load, part: Part, sketch: Sketch) -> Array:
    """Where a diagram shows a part: of a link at its own end, of a torque at the joint of its two bodies, else where it acts."""
    joint = next((j for j in sketch.spec["joints"] if j["name"] == load.name and j["type"] == "link"), None)
    if joint is not None:
        return next(sketch.place(point) for point in joint["with"]["of"] if sketch.at[point][0] == part.body)
    if load.kind in ("force", "motion") and not any(part.force):
        between = {j["name"] for j in sketch.about["joints"] if {j["first"], j["second"]} == set(load.of)}
        places = [place_of(sketch, j) for j in sketch.spec["joints"] if j["name"] in between]
        return next((place for place in places if place is not None), np.array(part.point))
    return np.array(part.point)


def _sense(load: Load, part: Part, sketch: Sketch) -> tuple[Array, float]:
    """Force and couple of a part in the sense in which the load's letter is positive."""
    force, couple = np.array(part.force), part.couple
    if load.unknown or load.kind == "weight":
        return force, couple
    others = [other for other in load.on if other is not part]
    spec = next((f for f in sketch.spec.get("forces", []) if f["name"] == load.name), None)
    if spec is None:
        return force, couple
    if spec["type"] in ("torque", "torsion_spring"):
        return np.zeros(2), 1.0 if part.body == spec["with"]["on"] else -1.0
    if "between" in spec["with"] and len(others) == 1:
        pull = np.subtract(others[0].point, part.point)
        return (pull if pull.any() else force), 0.0
    return force, couple


def to_scale(free: FreeBodies, group: Collection[str], letters: Letters, sketch: Sketch) -> tuple[list[Action], list[str]]:
    """What acts on a group at the instant, the components of a pin's force together, and what cannot be drawn, in words."""
    found: dict[tuple[str, bool, str], Action] = {}
    missing = [f"{load.symbol} is not determined" for load in free.on(*group) if not load.determinate]
    for load in (load for load in free.on(*group) if load.determinate):
        for i, part in enumerate(load.on):
            force, couple = load.value * np.array(part.force), load.value * part.couple
            if part.body not in group or not (force.any() or couple):
                continue
            new = Action(
                load.name, load.kind, letters.whole(load), part.body, attached(load, part, sketch), force, couple, (load,)
            )
            for one in (replace(new, couple=0.0), replace(new, force=np.zeros(2))):
                key = (f"{load.path} {one.label} {i * (load.kind == 'string')}", one.turns, one.body)
                if one.force.any() or one.couple:
                    found[key] = _together(found[key], one) if key in found else one
    largest = max((float(np.hypot(*action.force)) for action in found.values()), default=0.0)
    kept = [a for a in found.values() if a.turns or np.hypot(*a.force) > _ROUND_OFF * largest]
    return [_with_value(action) for action in kept], missing


def _together(first: Action, second: Action) -> Action:
    return replace(first, force=first.force + second.force, couple=first.couple + second.couple, loads=first.loads + second.loads)


def _with_value(action: Action) -> Action:
    size, unit = (abs(action.couple), r"N\,m") if action.turns else (float(np.hypot(*action.force)), "N")
    return replace(action, label=rf"{action.label} = {_figure(size)}\ \mathrm{{{unit}}}")


def effective(free: FreeBodies, group: Collection[str], letters: Letters, scaled: bool) -> Iterator[Action]:
    """The other side of the balance: m a at every mass centre, I α."""
    for name in group:
        body = free.bodies[name]
        at, mass = np.array(body.G), letters.mass(name)
        plain = Action(name, "effective", "", name, at, np.zeros(2))
        if scaled:
            force, couple = body.mass * np.array(body.a), body.inertia * body.alpha
            vector = replace(plain, label=rf"{mass}\,{letters.acceleration(name)}", force=force)
            terms = [
                vector,
                replace(plain, label=rf"{letters.inertia(name)}\,{letters.angular(name, len(group) == 1)}", couple=couple),
            ]
            yield from (_with_value(term) for term in terms if term.force.any() or term.couple)
            continue
        if body.mass and len(group) == 1:
            for part, way in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
                yield replace(plain, label=rf"{mass}\,{letters.acceleration(name, part)}", force=np.array(way))
        elif body.mass:
            way = np.array(body.a) if np.any(body.a) else np.array([1.0, 1.0])
            yield replace(plain, label=rf"{mass}\,{letters.acceleration(name)}", force=way / np.hypot(*way))
        if body.inertia and not body.particle:
            yield replace(plain, label=rf"{letters.inertia(name)}\,{letters.angular(name, len(group) == 1)}", couple=1.0)


def _figure(value: float) -> str:
    text = digits(float(f"{value:.3g}"))
    mantissa, _, exponent = text.partition("e")
    return rf"{mantissa}\times 10^{{{int(exponent.replace('−', '-'))}}}" if exponent else text

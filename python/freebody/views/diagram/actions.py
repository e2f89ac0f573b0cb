"""What acts on a group of bodies cut free, as arrows that know nothing yet of the paper."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np

from freebody.free_body import FreeBodies, Load, Part
from freebody.results import Array
from freebody.views.diagram.names import Letters
from freebody.views.measures import digits
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
    size = np.hypot(*force)
    if size > 0 and couple:
        part, couple = _on_its_line(load, part, force, couple, sketch)
    plain = Action(load.name, load.kind, label, part.body, np.array(part.point), force, couple, (load,))
    if size > 0:
        yield replace(plain, force=force / size, couple=0.0)
    if couple:
        yield replace(plain, force=np.zeros(2), couple=float(np.sign(couple)))


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


def _on_its_line(load: Load, part: Part, force: Array, couple: float, sketch: Sketch) -> tuple[Part, float]:
    """A force with a couple is the same force on another line; it is moved there where that meets the body."""
    shift = np.array([-force[1], force[0]]) * couple / (force @ force)
    place = np.array(part.point) + shift
    index = sketch.names.index(part.body)
    seen = [sketch.place(name) for name, (body, _) in sketch.at.items() if body == part.body]
    seen += [sketch.poses[0, index, :2]]
    low, high = np.min(seen, axis=0) - 2 * sketch.size, np.max(seen, axis=0) + 2 * sketch.size
    if (place < low).any() or (place > high).any():
        return part, couple
    return replace(part, point=(float(place[0]), float(place[1])), couple=0.0), 0.0


def to_scale(free: FreeBodies, group: Collection[str], letters: Letters) -> tuple[list[Action], list[str]]:
    """What acts on a group at the instant, the components of a reaction together, and what cannot be drawn, in words."""
    found: dict[tuple[str, str, str, tuple[float, float]], Action] = {}
    missing = []
    for load in free.on(*group):
        if not load.determinate:
            missing.append(f"{load.label} is not determined")
            continue
        for part in (part for part in load.on if part.body in group):
            for force, couple in ((load.value * np.array(part.force), 0.0), (np.zeros(2), load.value * part.couple)):
                if force.any() or couple:
                    key = (load.path, "force" if force.any() else "couple", part.body, part.point)
                    new = Action(load.name, load.kind, letters.of(load), part.body, np.array(part.point), force, couple, (load,))
                    found[key] = _together(found[key], new) if key in found else new
    largest = max((float(np.hypot(*action.force)) for action in found.values()), default=0.0)
    kept = [a for a in found.values() if a.turns or np.hypot(*a.force) > _ROUND_OFF * largest]
    return [_with_value(action) for action in kept], missing


def _together(first: Action, second: Action) -> Action:
    label = first.label.rpartition("_{")[0] or first.label
    return replace(first, force=first.force + second.force, couple=first.couple + second.couple,
                   label=label, loads=first.loads + second.loads)  # fmt: skip


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
            terms = [vector, replace(plain, label=rf"{letters.inertia(name)}\,{letters.angular(name)}", couple=couple)]
            yield from (_with_value(term) for term in terms if term.force.any() or term.couple)
            continue
        if body.mass and len(group) == 1:
            for part, way in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
                yield replace(plain, label=rf"{mass}\,{letters.acceleration(name, part)}", force=np.array(way))
        elif body.mass:
            way = np.array(body.a) if np.any(body.a) else np.array([1.0, 1.0])
            yield replace(plain, label=rf"{mass}\,{letters.acceleration(name)}", force=way / np.hypot(*way))
        if body.inertia and not body.particle:
            yield replace(plain, label=rf"{letters.inertia(name)}\,{letters.angular(name)}", couple=1.0)


def _figure(value: float) -> str:
    text = digits(float(f"{value:.3g}"))
    mantissa, _, exponent = text.partition("e")
    return rf"{mantissa}\times 10^{{{int(exponent.replace('−', '-'))}}}" if exponent else text

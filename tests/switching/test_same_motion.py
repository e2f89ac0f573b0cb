"""One switching motion seen in other worlds: turned, shifted, mirrored, under other names and in another order."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
import pytest
from seen import changes, imbalance, model, unbalanced, within

import freebody as fb

G = 9.81


@dataclass(frozen=True)
class World:
    """Where x is: mirrored in the y axis, then turned by ``turn`` (rad) and shifted (m); names from a list."""

    turn: float = 0.0
    shift: complex = 0j
    mirrored: bool = False
    names: tuple[str, ...] = ("box", "disk", "floor_box", "floor_disk", "pair", "cord")
    backwards: bool = False

    def vector(self, z: complex) -> complex:
        return (-z.conjugate() if self.mirrored else z) * cmath.exp(1j * self.turn)

    def place(self, z: complex) -> complex:
        return self.vector(z) + self.shift

    def spin(self, w: float) -> float:
        return -w if self.mirrored else w

    def angle(self, a: float) -> float:
        return self.spin(a) + self.turn

    def line(self, first: complex, second: complex) -> tuple[complex, complex]:
        """A line keeps its free side."""
        ends = self.place(first), self.place(second)
        return ends[::-1] if self.mirrored else ends

    def section(self, items: dict[str, str]) -> str:
        """Items under the names of this world, in its order."""
        old = World().names
        stated = [f"  {self.names[old.index(k)]}: {self.renamed(v)}" for k, v in items.items()]
        return "\n".join(stated[::-1] if self.backwards else stated)

    def renamed(self, text: str) -> str:
        for i, name in enumerate(World().names):
            text = text.replace(f"<{name}>", f"<{i}>")
        for i, name in enumerate(self.names):
            text = text.replace(f"<{i}>", name)
        return text


def pair(z: complex) -> str:
    return f"[{z.real!r}, {z.imag!r}]"


def thrown(world: World) -> str:
    """A box and a disk that fall on a slope, strike, slide, roll and meet; the disk is tied to a peg."""
    left, right = world.line(-1, 1 + 0.2j)
    bodies = world.section(
        {
            "box": "{shape: rectangle, width: 0.4 m, height: 0.3 m, mass: 2 kg}",
            "disk": "{shape: disk, radius: 0.2 m, mass: 1 kg}",
        }
    )
    contacts = world.section(
        {
            "floor_box": "{of: [<box>, ground.floor], friction: 0.4, static_friction: 0.5, restitution: 0.3}",
            "floor_disk": "{of: [ground.floor, <disk>], friction: 0.3, restitution: 0.5}",
            "pair": "{of: [<box>, <disk>], friction: 0.2, restitution: 0.6}",
        }
    )
    strings = world.section({"cord": "{ends: [ground.peg, <disk>.centre], length: 0.8 m}"})
    rows = []
    for body, z, a, v, w in (("box", 0.3 + 0.6j, 0.2, -1.5 + 0.5j, 1.0), ("disk", -0.7 + 0.3j, 0.0, 1.5 + 0j, -2.0)):
        z, v, name = world.place(z), world.vector(v), f"<{body}>"
        rows.append((f"{name}.x: {z.real!r}, {name}.y: {z.imag!r}, {name}.angle: {world.angle(a)!r}",))
        rows[-1] += (f"{name}.x: {v.real!r}, {name}.y: {v.imag!r}, {name}.angle: {world.spin(w)!r}",)
    initial = world.renamed(f"{{{rows[0][0]}, {rows[1][0]}, rates: {{{rows[0][1]}, {rows[1][1]}}}}}")
    peg = world.place(-0.9 + 0.5j)
    return f"""
gravity: {pair(world.vector(-1j * G))}
bodies:
{bodies}
ground: {{points: {{L: {pair(left)}, R: {pair(right)}, peg: {pair(peg)}}}, lines: {{floor: [L, R]}}}}
contacts:
{contacts}
strings:
{strings}
initial: {initial}
"""


WORLDS = {
    "turned": World(turn=0.7),
    "turned half": World(turn=math.pi),
    "shifted": World(shift=3 - 2j),
    "mirrored": World(mirrored=True),
    "all": World(turn=-2.1, shift=-1 + 4j, mirrored=True),
    "names": World(names=("z", "a", "s", "r", "q", "b")),
    "order": World(backwards=True),
}
UNTIL = 1.2


def run_in(world: World) -> fb.Run:
    run = model(thrown(world)).simulate(until=UNTIL, rtol=1e-12, impacts="newton")
    assert run.outcome.ok, run.outcome.sentence
    return run


@pytest.fixture(scope="module")
def plain() -> fb.Run:
    return run_in(World())


def test_there_is_much_to_see(plain):
    stated = [change.kind for change in changes(plain)]
    assert len(stated) > 10
    assert {"impact", "taut", "slip", "stick", "slack"} & set(stated) >= {"impact", "taut"}
    assert imbalance(plain) < 1e-9


@pytest.mark.parametrize("name", WORLDS)
def test_the_same_happens_at_the_same_instants(plain, name):
    world = WORLDS[name]
    run = run_in(world)
    there = lambda of: sorted(world.renamed(f"<{one}>") for one in of)
    # What happens at one instant has no order.
    tell = lambda rows: sorted(rows, key=lambda row: (round(row[0], 7), row[1:]))
    known = tell([(c.t, c.kind, there(c.of)) for c in changes(plain)])
    seen = tell([(c.t, c.kind, sorted(c.of)) for c in changes(run)])
    assert [row[1:] for row in seen] == [row[1:] for row in known]
    assert [row[0] for row in seen] == pytest.approx([row[0] for row in known], abs=1e-9)
    assert sum(c.lost for c in changes(run)) == pytest.approx(sum(c.lost for c in changes(plain)), abs=1e-9)
    times = np.linspace(0, UNTIL, 25)
    for body in ("box", "disk"):
        other = world.renamed(f"<{body}>")
        at = lambda r, n: r.evaluate(f"{n}.x", times) + 1j * r.evaluate(f"{n}.y", times)
        moved = np.array([world.place(z) for z in at(plain, body)])
        assert np.abs(at(run, other) - moved).max() < 1e-9
        turned = [world.angle(a) for a in plain.evaluate(f"{body}.angle", times)]
        assert run.evaluate(f"{other}.angle", times) == pytest.approx(turned, abs=1e-9)
    assert imbalance(run) < 1e-9


@pytest.mark.parametrize("law", ["newton", "poisson"])
def test_newton_and_euler_at_random_instants(law):
    """What the contacts are said to do, and where, is what the box needs for its acceleration as seen in its motion."""
    run = model(thrown(World())).simulate(until=UNTIL, rtol=1e-12, impacts=law)
    times = within(run, 300, seed=5)
    assert unbalanced(run, "box", ["floor_box", "pair"], times, (0, -G)) < 1e-6

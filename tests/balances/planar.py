"""Hand-made free bodies: rigid bodies in absolute coordinates, joined, driven and loaded, solved by Newton and Euler.

It speaks the data of ``_core.Mechanism.free_bodies``, and shares nothing with the core: the coordinates are x, y and angle of
every body, and every joint is a row.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

GRAVITY = 9.81
READINGS = {"x": "Fx", "y": "Fy", "normal force": "Fn", "couple": "M", None: "force"}
FACTS = {"stem": "F", "pulls": False, "presses": False, "tangent": False, "flank": False}


def left(v):
    return np.array([-v[1], v[0]])


def turned(angle, v):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * v[0] - s * v[1], s * v[0] + c * v[1]])


@dataclass
class Fake:
    """Bodies at given places; rates are random within what the joints allow."""

    rng: np.random.Generator
    bodies: dict = field(default_factory=dict)
    unknown: list = field(default_factory=list)
    known: list = field(default_factory=list)
    biases: list = field(default_factory=list)

    def body(self, name, G, angle=0.0, mass=1.0, inertia=0.1):
        self.bodies[name] = {"G": np.array(G, float), "angle": angle, "mass": mass, "inertia": inertia}
        self.load(f"weight of {name}", ("ground", name), [(name, G, (0.0, -mass * GRAVITY), 0.0)], kind="weight")

    def rod(self, name, start, end, mass=1.0):
        start, end = np.array(start, float), np.array(end, float)
        d = end - start
        self.body(name, (start + end) / 2, np.arctan2(d[1], d[0]), mass, mass * d @ d / 12)

    def load(self, name, of, parts, kind="force"):
        self.known.append(self._load(name, kind, None, of, parts))

    def hinge(self, name, first, second, at):
        for component, e in (("x", (1.0, 0.0)), ("y", (0.0, 1.0))):
            self._pair(name, "joint", component, first, second, at, e, self._hinged(first, second, at, e))

    def slot(self, name, first, second, at, direction):
        n = left(np.array(direction, float))
        self._pair(name, "joint", "normal force", first, second, at, n, self._sliding(first, second, at, n))

    def slider(self, name, first, second, at, direction):
        self.slot(name, first, second, at, direction)
        self._couple(name, "joint", "couple", first, second, 0.0)

    def motor(self, name, first, second, acceleration):
        self._couple(name, "motion", None, first, second, acceleration)

    def _couple(self, name, kind, component, first, second, bias):
        parts = [(second, self._place(second), (0.0, 0.0), 1.0), (first, self._place(first), (0.0, 0.0), -1.0)]
        self.unknown.append(self._load(name, kind, component, (first, second), parts))
        self.biases.append(lambda v: bias)

    def _pair(self, name, kind, component, first, second, at, e, bias):
        parts = [(second, at, tuple(e), 0.0), (first, at, tuple(-np.array(e)), 0.0)]
        self.unknown.append(self._load(name, kind, component, (first, second), parts))
        self.biases.append(bias)

    def _load(self, name, kind, component, of, parts):
        on = [{"body": b, "point": list(map(float, p)), "force": list(map(float, f)), "couple": c} for b, p, f, c in parts]
        card = {"name": component or kind, "reading": READINGS[component], "couple": component == "couple", **FACTS}
        axis = component if component in ("x", "y") else None
        stated = {"name": name, "path": f"{kind}s.{name}", "symbol": f"{name}.{card['reading']}", "kind": kind}
        stated |= {"axis": axis, "card": card, "number": None}
        return {**stated, "follows": None, "of": list(of), "on": on}

    def _place(self, name):
        return self.bodies[name]["G"] if name in self.bodies else np.zeros(2)

    def _spin(self, name, v):
        return v[3 * list(self.bodies).index(name) + 2] if name in self.bodies else 0.0

    def _point(self, name, at, v):
        if name not in self.bodies:
            return np.zeros(2)
        i = 3 * list(self.bodies).index(name)
        return v[i : i + 2] + v[i + 2] * left(np.array(at) - self._place(name))

    def _towards_centre(self, name, at, v):
        return -(self._spin(name, v) ** 2) * (np.array(at) - self._place(name))

    def _hinged(self, first, second, at, e):
        return lambda v: np.dot(e, self._towards_centre(first, at, v) - self._towards_centre(second, at, v))

    def _sliding(self, first, second, at, n):
        def bias(v):
            shift = self._point(second, at, v) - self._point(first, at, v)
            coriolis = 2 * self._spin(first, v) * left(shift)
            return np.dot(n, self._towards_centre(first, at, v) - self._towards_centre(second, at, v) + coriolis)

        return bias

    def column(self, load):
        """What a load does to all bodies, at their mass centres (3 n,)."""
        w = np.zeros(3 * len(self.bodies))
        for part in load["on"]:
            if part["body"] in self.bodies:
                i = 3 * list(self.bodies).index(part["body"])
                r, f = np.array(part["point"]) - self._place(part["body"]), np.array(part["force"])
                w[i : i + 3] += [*f, part["couple"] + r[0] * f[1] - r[1] * f[0]]
        return w

    def data(self):
        """The JSON, solved."""
        names = list(self.bodies)
        W = np.column_stack([self.column(load) for load in self.unknown])
        _, sizes, turn = np.linalg.svd(W.T)
        free = turn[(sizes > 1e-9).sum() :].T
        v = free @ self.rng.normal(size=free.shape[1]) if free.shape[1] else np.zeros(3 * len(names))
        bias = np.array([rule(v) for rule in self.biases])
        M = np.diag([x for b in self.bodies.values() for x in (b["mass"], b["mass"], b["inertia"])])
        f = sum(self.column(load) for load in self.known)
        m = W.shape[1]
        solved = np.linalg.solve(np.block([[M, -W], [W.T, np.zeros((m, m))]]), [*f, *bias])
        a, values = solved[: 3 * len(names)], solved[3 * len(names) :]
        coordinates = [f"{name}.{part}" for name in names for part in ("x", "y", "angle")]
        bodies = []
        for i, (body, b) in enumerate(self.bodies.items()):
            own = slice(3 * i, 3 * i + 3)
            by = {name: [float(k == 3 * i + j) for j in range(3)] for k, name in enumerate(coordinates)}
            place = {"at": list(b["G"]), "angle": float(b["angle"]), "G": list(b["G"])}
            motion = {"v": list(v[own][:2]), "omega": v[own][2], "a": list(a[own][:2]), "alpha": a[own][2]}
            plain = {"name": body, "particle": False, "mass": b["mass"], "inertia": b["inertia"]}
            bodies.append({**plain, **place, **motion, "by_accelerations": by, "bias": [0.0, 0.0, 0.0]})
        loads = [
            {**x, "unknown": True, "value": float(y), "determinate": True} for x, y in zip(self.unknown, values, strict=True)
        ]
        loads += [{**x, "unknown": False, "value": None, "determinate": True} for x in self.known]
        rows = [
            {"name": x["name"], "coefficients": dict(zip(coordinates, map(float, w), strict=True)), "right": float(y)}
            for x, w, y in zip(self.unknown, W.T, bias, strict=True)
        ]
        found = dict(zip(coordinates, map(float, a), strict=True))
        return {"bodies": bodies, "loads": loads, "rows": rows, "accelerations": found}


def chain(rng, n):
    """``n`` rods hung from ground, each on the one before."""
    fake, at = Fake(rng), np.zeros(2)
    for k in range(1, n + 1):
        start, at = at, at + turned(-1.2 + 0.4 * k + rng.normal(scale=0.3), [1.0 + 0.1 * k, 0.0])
        fake.rod(f"rod{k}", start, at, 1.0 + 0.2 * k)
        fake.hinge("ABCDEFGH"[k - 1], f"rod{k - 1}" if k > 1 else "ground", f"rod{k}", start)
    return fake


def driven_chain(rng, n):
    fake = chain(rng, n)
    for k in range(1, n + 1):
        fake.motor(f"T{k}", f"rod{k - 1}" if k > 1 else "ground", f"rod{k}", rng.normal())
    return fake


def four_bar(rng, driven=True):
    """Crank OA, coupler AB, rocker CB; a motor turns the crank."""
    O, C = np.zeros(2), np.array([1.5, 0.1])
    A = O + turned(1.1 + rng.normal(scale=0.2), [0.5, 0.0])
    B = C + turned(1.5 + rng.normal(scale=0.2), [1.2, 0.0])
    fake = Fake(rng)
    fake.rod("crank", O, A, 1.0)
    fake.rod("coupler", A, B, 2.0)
    fake.rod("rocker", C, B, 1.5)
    fake.hinge("O", "ground", "crank", O)
    fake.hinge("A", "crank", "coupler", A)
    fake.hinge("B", "coupler", "rocker", B)
    fake.hinge("C", "ground", "rocker", C)
    if driven:
        fake.motor("T", "ground", "crank", rng.normal())
    return fake


def block_on_slope(rng):
    fake, s = Fake(rng), rng.normal()
    fake.body("block", turned(0.4, [s, 0.3]), 0.4, 2.0, 0.2)
    fake.slider("slope", "ground", "block", turned(0.4, [s, 0.0]), turned(0.4, [1.0, 0.0]))
    return fake


def ladder(rng):
    """A rod on a smooth floor and a smooth wall."""
    fake, angle = Fake(rng), 1.0 + rng.normal(scale=0.2)
    foot, top = np.array([2 * np.cos(angle), 0.0]), np.array([0.0, 2 * np.sin(angle)])
    fake.rod("ladder", foot, top, 3.0)
    fake.slot("floor", "ground", "ladder", foot, (1.0, 0.0))
    fake.slot("wall", "ground", "ladder", top, (0.0, -1.0))
    return fake


def slider_crank(rng, driven=True):
    """Crank OA, rod AB, a slide of B along the x axis."""
    fake = Fake(rng)
    A = turned(0.9 + rng.normal(scale=0.2), [0.5, 0.0])
    B = np.array([A[0] + np.sqrt(2.25 - A[1] ** 2), 0.0])
    fake.rod("crank", (0, 0), A, 1.0)
    fake.rod("rod", A, B, 2.0)
    fake.body("block", B, 0.0, 1.5, 0.1)
    fake.hinge("O", "ground", "crank", (0, 0))
    fake.hinge("A", "crank", "rod", A)
    fake.hinge("B", "rod", "block", B)
    fake.slider("slide", "ground", "block", B, (1.0, 0.0))
    if driven:
        fake.motor("T", "ground", "crank", rng.normal())
    return fake


def branched(rng, driven=True):
    """A rod on a pin, two more hung from its far end and one from its middle."""
    fake = Fake(rng)
    far = turned(rng.normal(), [1.0, 0.0])
    fake.rod("beam", (0, 0), far, 2.0)
    fake.hinge("O", "ground", "beam", (0, 0))
    for name, at in (("left", far), ("right", far), ("middle", 0.4 * far)):
        fake.rod(name, at, at + turned(rng.normal() - 1.5, [0.8, 0.0]), 1.0)
        fake.hinge(f"pin of {name}", "beam", name, at)
    if driven:
        fake.motor("T", "ground", "beam", rng.normal())
        fake.motor("S", "beam", "left", rng.normal())
    return fake


def watt(rng, driven=True):
    """A four-bar and a dyad from its coupler to ground."""
    fake = four_bar(rng, driven)
    coupler = fake.bodies["coupler"]
    D = coupler["G"] + turned(coupler["angle"], [0.1, 0.4])
    F = np.array([2.5, 0.2])
    E = np.array([2.2, 1.6]) + rng.normal(scale=0.1, size=2)
    fake.rod("arm", D, E, 1.0)
    fake.rod("lever", F, E, 1.2)
    fake.hinge("D", "coupler", "arm", D)
    fake.hinge("E", "arm", "lever", E)
    fake.hinge("F", "ground", "lever", F)
    return fake


def car_on_slope(rng):
    """A block that slides on a slope and carries a rod on a pin."""
    fake, s = Fake(rng), rng.normal()
    at = turned(0.4, [s, 0.3])
    fake.body("block", at, 0.4, 2.0, 0.2)
    fake.slider("slope", "ground", "block", turned(0.4, [s, 0.0]), turned(0.4, [1.0, 0.0]))
    fake.rod("rod", at, at + turned(rng.normal(), [1.0, 0.0]), 1.0)
    fake.hinge("pin", "block", "rod", at)
    return fake

"""One of every joint and force symbol, standing still: what drawings are looked at with."""

from __future__ import annotations

import numpy as np

from freebody.core import State

from .models import point, source


class _Zoo:
    def __init__(self):
        self.bodies, self.points, self.joints, self.poses = [], [point("ground.O", "ground", [0, 0])], [], {}

    def body(self, name, shape, at, angle=0.0, sizes=None, corners=(), **points):
        self.bodies.append(
            {"name": name, "pieces": [{"shape": shape, "mass": 1.0, "sizes": sizes or {}, "corners": list(corners)}]}
        )
        self.poses[name] = [*at, angle]
        for key, place in {"origin": [0, 0], "G": [0, 0], **points}.items():
            self.points.append(point(f"{name}.{key}", name, place))

    def ground(self, name, at):
        self.points.append(point(f"ground.{name}", "ground", at))

    def joint(self, name, kind, coordinate="", **fields):
        coordinates = [{"name": coordinate}] if coordinate else []
        self.joints.append({"name": name, "type": kind, "with": fields, "coordinates": coordinates})


def level(name):
    return {"point": name, "angle": 0.0}


def zoo():
    """Model and state."""
    z = _Zoo()
    z.body("piston", "given", [0.5, 0])
    z.ground("S", [0.2, 0])
    z.joint("guide", "slider", along=level("ground.S"), line=level("piston.origin"))
    z.body("block", "rectangle", [1.2, 0], sizes={"width": 0.3, "height": 0.16})
    z.ground("S2", [1.0, 0])
    z.joint("slide", "slider", along=level("ground.S2"), line=level("block.origin"))
    z.body("arm", "rod", [0.4, 0.5], 0.3, sizes={"length": 0.8}, A=[-0.4, 0], B=[0.4, 0])
    z.body("collar", "point", [0.4 + 0.1 * np.cos(0.3), 0.5 + 0.1 * np.sin(0.3)])
    z.joint("track", "slot", along={"point": "arm.A", "towards": "arm.B"}, point="collar.origin")
    z.body("wheel", "disk", [1.3, 0.55], -0.5, sizes={"radius": 0.15})
    z.ground("R", [1.0, 0.4])
    z.joint("roll", "rolling", circle={"centre": "wheel.origin", "radius": 0.15}, on=level("ground.R"))
    z.body("cart", "rectangle", [2.0, 0.1], sizes={"width": 0.4, "height": 0.1}, P=[-0.15, -0.08], Q=[0.15, -0.08])
    z.ground("K", [1.8, 0.02])
    z.joint("rollers", "rollers", along=level("ground.K"), points=["cart.P", "cart.Q"])
    z.body("g1", "disk", [1.8, 0.7], sizes={"radius": 0.12})
    z.body("g2", "disk", [2.12, 0.7], 0.6, sizes={"radius": 0.2})
    z.joint("gears", "gear", of=["g1.origin", "g2.origin"], radii=[0.12, 0.2])
    z.body("b1", "ring", [1.8, 1.15], sizes={"radius": 0.08})
    z.body("b2", "disk", [2.3, 1.2], 0.6, sizes={"radius": 0.16})
    z.joint("belt", "belt", of=["b1.origin", "b2.origin"], radii=[0.08, 0.16])
    z.ground("L", [0.2, 1.3])
    z.body("plate", "polygon", [0.5, 1.0], 0.2, corners=[[0, 0], [0.3, 0], [0.1, 0.2]], V=[0.1, 0.2])
    z.joint("tie", "link", of=["ground.L", "plate.V"], length=0.3)
    z.body("bar", "rod", [1.1, 1.2], 0.9, sizes={"length": 0.4}, E=[-0.2, 0], F=[0.2, 0])
    z.ground("W", [1.1 - 0.2 * np.cos(0.9), 1.2 - 0.2 * np.sin(0.9)])
    z.joint("clamp", "weld", of=["ground.W", "bar.E"])
    z.body("bead", "point", [2.8 + 0.25 * np.cos(0.9), 0.9 + 0.25 * np.sin(0.9)])
    z.joint("wire", "curved_slot", "sigma", along="ground.wire", point="bead.origin")
    z.body("sun", "disk", [2.75, 0.2], sizes={"radius": 0.12})
    z.body("planet", "disk", [2.95, 0.2], 0.4, sizes={"radius": 0.08})
    z.joint(
        "planetary",
        "rolling_circles",
        circle={"centre": "planet.origin", "radius": 0.08},
        on={"centre": "sun.origin", "radius": 0.12},
    )
    spec = {
        "name": "zoo",
        "parameters": [{"name": "sigma", "value": 0.9}],
        "gravity": [0.0, -9.81],
        "bodies": z.bodies,
        "points": z.points,
        "curves": [{"name": "ground.wire", "body": "ground", "x": "2.8+0.25*cos(s)", "y": "0.9+0.25*sin(s)"}],
        "joints": z.joints,
        "forces": [
            {"name": "strut", "type": "spring", "with": {"between": ["bar.F", "b1.origin"], "stiffness": 10.0, "damping": 2.0}},
            {"name": "damper", "type": "damper", "with": {"between": ["g1.origin", "cart.origin"], "damping": 2.0}},
            {"name": "push", "type": "force", "with": {"at": "cart.P", "value": 3.0, "direction": 0.0}},
            {"name": "drive", "type": "torque", "with": {"on": "g2", "from": "ground", "value": 3.0}},
        ],
        "poses": z.poses,
    }
    made = source(spec)
    q = np.array([z.poses[body["name"]][2] for body in z.bodies])
    return made, State(made.bind({}), 0.0, q, 0 * q)

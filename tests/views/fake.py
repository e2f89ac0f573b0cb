"""A stand-in for the compiled core: bars on hinges, solved in body coordinates and integrated by SciPy.

It honours the contract of ``freebody/_core.pyi`` as far as the views need it. Coordinates are the angles of
the bodies from the fixed x axis; a hinge whose second body is already placed closes a loop.
"""

from __future__ import annotations

import re

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import fsolve

G = 9.81
SHAPES = {
    "rod": lambda s: s["length"] ** 2 / 12,
    "disk": lambda s: s["radius"] ** 2 / 2,
    "rectangle": lambda s: (s["width"] ** 2 + s["height"] ** 2) / 12,
    "point": lambda s: 0.0,
    "polygon": lambda s: 0.1,
    "given": lambda s: 0.1,
    "ring": lambda s: s["radius"] ** 2,
}


def turned(angle, at):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([c * at[0] - s * at[1], s * at[0] + c * at[1]])


class FakeMechanism:
    def __init__(self, spec) -> None:
        self.spec = spec
        self.numbers = {p["name"]: self._number(p["value"], {}) for p in self.spec.get("parameters", [])}
        self.names = [b["name"] for b in self.spec["bodies"]]
        self.points_ = {p["name"]: (p["body"], [self._number(x) for x in p["at"]]) for p in self.spec["points"]}
        self.mass = np.array([sum(self._number(q["mass"]) for q in b["pieces"]) for b in self.spec["bodies"]])
        self.inertia = np.array(
            [sum(self._number(q["mass"]) * self._gyration(q) for q in b["pieces"]) for b in self.spec["bodies"]]
        )
        self.hinges = [(j["name"], *j["with"]["of"]) for j in self.spec["joints"] if j["type"] == "hinge"]
        placed = {"ground"}
        self.tree, self.cut = [], []
        for hinge in self.hinges:
            second = self.points_[hinge[2]][0]
            (self.cut if second in placed else self.tree).append(hinge)
            placed.add(second)
        self.loose = {n: tuple(self.spec.get("poses", {}).get(n, (0, 0))) for n in self.names if n not in placed}
        self.unknown = set(self.spec.get("indeterminate", []))

    def _gyration(self, piece):
        sizes = {key: self._number(value) for key, value in piece.get("sizes", {}).items()}
        return SHAPES[piece["shape"]](sizes)

    def _number(self, value, names=None):
        return float(eval(str(value), {"pi": np.pi}, self.numbers if names is None else names))

    def describe(self):
        joint = lambda j: {"name": j["name"], "type": j["type"], "first": self._ends(j)[0], "second": self._ends(j)[1],
                           "point": "", "cut": False, "coordinates": [c["name"] for c in j.get("coordinates", [])], "reaction": ["Fx", "Fy"], "couple": False}  # fmt: skip
        return {
            "bodies": [{"name": n, "mass": m, "inertia": i, "centre": [0, 0], "particle": False}
                       for n, m, i in zip(self.names, self.mass, self.inertia, strict=True)],
            "parameters": [{"name": n, "unit": "", "value": v} for n, v in self.numbers.items()],
            "coordinates": [{"name": self._coordinate(n), "joint": self._joint_of(n), "dimension": "rad", "absolute": True, "doc": ""} for n in self.names],
            "closure_coordinates": [],
            "joints": [joint(j) for j in self.spec["joints"]]
                      + [{"name": f"{n} free", "type": "free", "first": "ground", "second": n, "point": "", "cut": False,
                          "coordinates": [], "reaction": [], "couple": False} for n in self.names if self._joint_of(n) == f"{n} free"],
            "limits": [],
            "forces": [{"name": f["name"], "type": f["type"], "conservative": f["type"] == "spring"} for f in self.spec.get("forces", [])],
            "motions": [],
            "locks": [],
            "events": [e["name"] for e in self.spec.get("events", [])],
            "freedom": {"count": 1, "joints_count": len(self.hinges)},
            "notes": ["hinges without friction", "air is ignored"],
        }  # fmt: skip

    def _ends(self, joint):
        with_ = joint["with"]
        of = [with_[k] for k in ("of", "along", "line", "point", "points", "circle", "on") if k in with_]
        flat = [x for item in of for x in (item if isinstance(item, list) else [item])]
        names = [x if isinstance(x, str) else x.get("point") or x["centre"] for x in flat]
        bodies = list(dict.fromkeys(self.points_[n][0] if n in self.points_ else n.split(".")[0] for n in names))
        return (bodies * 2)[:2]

    def _joint_of(self, body):
        return next((name for name, _, b in self.tree if self.points_[b][0] == body), f"{body} free")

    def _coordinate(self, body):
        return self.spec.get("angles", {}).get(body, f"{body}.angle")

    def bind(self, values):
        return np.array([{**self.numbers, **values}[n] for n in self.numbers])

    def points(self, p):
        return {name: [body, *at] for name, (body, at) in self.points_.items()}

    # Kinematics: mass centres from the angles, from hinge to hinge

    def centres(self, q):
        at = {
            "ground": (np.zeros(2), 0.0),
            **{n: (np.array(self.loose[n][:2], float), q[self.names.index(n)]) for n in self.loose},
        }
        for _, a, b in self.tree:
            (first, s), (second, r) = self.points_[a], self.points_[b]
            pin = at[first][0] + turned(at[first][1], s)
            angle = q[self.names.index(second)]
            at[second] = (pin - turned(angle, r), angle)
        return at

    def place(self, q, point):
        body, s = self.points_[point]
        centre, angle = self.centres(q)[body]
        return centre + turned(angle, s)

    def gaps(self, q):
        return np.concatenate([self.place(q, a) - self.place(q, b) for _, a, b in self.cut]) if self.cut else np.zeros(0)

    def assemble(self, p, t=0.0, fixed=None, guess=None, rates=None, points=None, branch=None):
        start = {**(guess or {}), **(fixed or {})}
        q = np.array([start.get(self._coordinate(n), 0.0) for n in self.names])
        if self.cut:
            free = [i for i, n in enumerate(self.names) if self._coordinate(n) not in (fixed or {})]

            def gap(x):
                y = q.copy()
                y[free] = x
                return self.gaps(y)

            q[free] = fsolve(gap, q[free], xtol=1e-14)
        u = np.array([(rates or {}).get(self._coordinate(n), 0.0) for n in self.names])
        return q, u, {"branch": [], "adjusted": []}

    # Forces and one instant

    def _loads(self, t, q):
        load, at = np.zeros((len(self.names), 3)), self.centres(q)
        load[:, 1] = -G * self.mass
        for force in self.spec.get("forces", []):
            w = force["with"]
            if force["type"] == "torque":
                load[self.names.index(w["on"]), 2] += self._number(w["value"])
            elif force["type"] == "spring":
                a, b = (self.place(q, point) for point in w["between"])
                pull = self._number(w["stiffness"]) * (b - a)
                for point, end, sign in zip(w["between"], (a, b), (1, -1), strict=True):
                    body = self.points_[point][0]
                    if body != "ground":
                        arm = end - at[body][0]
                        load[self.names.index(body)] += sign * np.array([*pull, arm[0] * pull[1] - arm[1] * pull[0]])
        return load

    def _solve(self, t, q, u):
        nb, nh = len(self.names), len(self.hinges)
        at = self.centres(q)
        jac, bias = np.zeros((2 * nh, 3 * nb)), np.zeros(2 * nh)
        for k, (_, *ends) in enumerate(self.hinges):
            for sign, point in zip((-1, 1), ends, strict=True):
                body, s = self.points_[point]
                if body == "ground":
                    continue
                i, arm = self.names.index(body), turned(at[body][1], s)
                jac[2 * k : 2 * k + 2, 3 * i : 3 * i + 3] += sign * np.array([[1, 0, -arm[1]], [0, 1, arm[0]]])
                bias[2 * k : 2 * k + 2] += sign * u[i] ** 2 * arm
        m = np.diag(np.column_stack([self.mass, self.mass, self.inertia]).ravel())
        system = np.block([[m, -jac.T], [jac, np.zeros((2 * nh, 2 * nh))]])
        solution = np.linalg.lstsq(system, np.concatenate([self._loads(t, q).ravel(), bias]), rcond=None)[0]
        return solution[: 3 * nb].reshape(nb, 3), solution[3 * nb :].reshape(nh, 2)

    def instant(self, state, route="minimal"):
        _, t, q, u = state
        bodies, forces = self._solve(t, q, u)
        where = {name: force for (name, *_), force in zip(self.hinges, forces, strict=True)}
        least = np.array([[*where.get(j["name"], (0, 0)), 0] for j in self.spec["joints"]])
        known = np.ones_like(least, dtype=bool)
        known[[j["name"] in self.unknown for j in self.spec["joints"]], 0] = False
        rank = {"freedom": 1, "count": 1, "rows": 2, "redundant": 0, "always_redundant": 0, "driven": 0, "uncertain": False, "explanation": "1 degree of freedom: 3 − 2",
                "self_stress": [f"{n} can be pulled along x" for n in self.unknown]}  # fmt: skip
        return {
            "accelerations": bodies[:, 2], "body_accelerations": bodies, "reactions": np.where(known, least, np.nan),
            "least_reactions": least, "determinate": known, "motions": {}, "couplings": {}, "locks": {}, "residual": 1e-16,
            "body_residuals": np.full((len(bodies), 3), 1e-16), "rank": rank, "sizes": (1.0, 1.0), "limits": [],
        }  # fmt: skip

    def energies(self, q, u):
        at = self.centres(q)
        rate = np.array([self._velocity(q, u, n) for n in self.names])
        kinetic = 0.5 * (self.mass * (rate**2).sum(1) + self.inertia * u**2).sum()
        potential = sum(m * G * at[n][0][1] for m, n in zip(self.mass, self.names, strict=True))
        for force in self.spec.get("forces", []):
            if force["type"] == "spring":
                a, b = (self.place(q, point) for point in force["with"]["between"])
                potential += 0.5 * self._number(force["with"]["stiffness"]) * (a - b) @ (a - b)
        return kinetic, potential

    def _velocity(self, q, u, body, s=(0, 0)):
        h = 1e-30
        at = self.centres(q + 1j * h * u)[body]
        return np.imag(at[0] + turned(at[1], s)) / h

    def evaluate(self, texts, state):
        _, t, q, u = state
        return np.array([self._value(text, t, q, u) for text in texts])

    def _value(self, text, t, q, u, work=np.nan):
        lookup = {"t": t, **self.numbers, **dict(zip(map(self._coordinate, self.names), q, strict=True))}

        def call(match):
            word, arg = match[1], match[2].replace("'", "")
            if word in ("kinetic", "potential", "energy"):
                kinetic, potential = self.energies(q, u)
                return repr(float({"kinetic": kinetic, "potential": potential, "energy": kinetic + potential}[word]))
            if word in ("x", "y"):
                return repr(float(self.place(q, arg)["xy".index(word)]))
            if word == "speed":
                body, s = self.points_[arg]
                return repr(float(np.hypot(*self._velocity(q, u, body, s))))
            i = [self._coordinate(n) for n in self.names].index(arg) if word in ("rate", "accel") else self.names.index(arg)
            return repr(float({"rate": u, "omega": u, "angle": q}[word][i] if word != "accel" else self._solve(t, q, u)[0][i, 2]))

        text = re.sub(r"\b(x|y|speed|rate|accel|omega|angle|kinetic|potential|energy)\(([^()]*)\)", call, text)
        now = self.instant((None, t, q, u))
        for i, joint in enumerate(self.spec["joints"]):
            fx, fy, m = now["reactions"][i]
            parts = {"Fx": fx, "Fy": fy, "M": m, "F": np.hypot(fx, fy), "Fs": fx, "Fn": fy}
            for part, value in parts.items():
                for name in (joint["name"], f"'{joint['name']}'"):
                    text = re.sub(rf"(?<![\w']){re.escape(name)}\.{part}\b", f"({float(value)!r})", text)
        text = text.replace("motor.work", repr(float(work)))
        for name in sorted(lookup, key=len, reverse=True):
            text = text.replace(f"'{name}'", repr(float(lookup[name])))
            if not name.isidentifier():
                text = text.replace(name, repr(float(lookup[name])))
        functions = {n: getattr(np, n) for n in ("sin", "cos", "sqrt", "abs", "exp")}
        return float(eval(text.replace("^", "**"), {**functions, "nan": np.nan, "pi": np.pi}, lookup))

    def simulate(
        self,
        state,
        until,
        method="dop853",
        rtol=1e-9,
        step=None,
        max_step=None,
        route="auto",
        max_steps=0,
        progress=None,
        impacts="stop",
        painleve="stop",
        after=None,
    ):
        return FakeTrajectory(self, *state, until)


class FakeTrajectory:
    def __init__(self, core, p, t, q, u, until):
        self.core, self.p, n = core, p, len(q)
        torque = next((f["with"] for f in core.spec.get("forces", []) if f["type"] == "torque"), None)
        self.torque = core._number(torque["value"]) if torque else 0.0
        on = core.names.index(torque["on"]) if torque else 0

        def slope(t, y):
            return np.concatenate([y[n : 2 * n], core._solve(t, y[:n], y[n : 2 * n])[0][:, 2], [self.torque * y[n + on]]])

        def watch(text):
            found = lambda t, y: core._value(text, t, y[:n], y[n : 2 * n])
            return found

        asked = core.spec.get("events", [])
        run = solve_ivp(slope, (t, until), np.concatenate([q, u, [0.0]]), "DOP853", dense_output=True, rtol=1e-10, atol=1e-10, events=[watch(e["when"]) for e in asked])  # fmt: skip
        self.n, self.dense, self.steps = n, run.sol, run.t
        self.work0 = 0.0
        happened = [
            {
                "name": e["name"],
                "t": float(when),
                "kind": "crossing",
                "direction": 1,
                "q": y[:n].tolist(),
                "u": y[n : 2 * n].tolist(),
            }
            for e, times, ys in zip(asked, run.t_events or [], run.y_events or [], strict=True)
            for when, y in zip(times, ys, strict=True)
        ]
        self.told = {
            "events": sorted(happened, key=lambda e: e["t"]),
            "changes": [],
            "outcome": {"name": "Completed", "ok": True, "t": until, "sentence": f"reached t = {until:g} s"},
            "stats": {"accepted": len(run.t), "rejected": 0, "evaluations": int(run.nfev), "method": "dop853", "rtol": 1e-10, "closure": 1e-13},
        }  # fmt: skip

    def record(self):
        return self.told

    def sample(self, times):
        y = self.dense(np.asarray(times)).T
        return y[:, : self.n], y[:, self.n : 2 * self.n]

    def _each(self, times, what):
        y = self.dense(np.asarray(times)).T
        return np.array([what(t, row[: self.n], row[self.n : 2 * self.n], row[-1]) for t, row in zip(times, y, strict=True)])

    def evaluate(self, texts, times):
        return self._each(times, lambda t, q, u, w: [self.core._value(text, t, q, u, w) for text in texts])

    def poses(self, times):
        def pose(t, q, u, w):
            at = self.core.centres(q)
            return [[*at[name][0], at[name][1]] for name in self.core.names]

        return self._each(times, pose)

    def instants(self, times):
        values = self._each(times, lambda t, q, u, w: self.core.instant((self.p, t, q, u))["reactions"])
        return values, ~np.isnan(values)

    def ledger(self, times):
        start = sum(self.core.energies(*(x[0] for x in self.sample(self.steps[:1]))))

        def row(t, q, u, w):
            kinetic, potential = self.core.energies(q, u)
            return [kinetic, potential, w, kinetic + potential - w - start]

        return ["kinetic", "potential", "motor.work", "balance"], self._each(times, row)

    def end(self):
        q, u = (x[0] for x in self.sample(self.steps[-1:]))
        return self.p, float(self.steps[-1]), q, u

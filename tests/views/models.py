"""Models for the views' tests, as the JSON that the core reads."""

from __future__ import annotations

from freebody.core import CompiledModel, Settings
from freebody.run.records import ReportItem
from freebody.run.simulation import Run, simulate

from .fake import FakeMechanism


def rod(name, length, mass=1.0):
    return {"name": name, "pieces": [{"shape": "rod", "mass": mass, "sizes": {"length": length}}]}


def ends(name, length):
    half = length / 2
    places = {"start": [-half, 0], "end": [half, 0], "origin": [0, 0], "G": [0, 0]}
    return [point(f"{name}.{key}", name, at) for key, at in places.items()]


def point(name, body, at):
    return {"name": name, "body": body, "at": list(at)}


def hinge(name, first, second):
    return {"name": name, "type": "hinge", "with": {"of": [first, second]}, "coordinates": []}


def compiled(spec):
    return CompiledModel(FakeMechanism(spec), spec)


def source(spec, report=()):
    return CompiledModel(FakeMechanism(spec), spec, {"freebody": 1, "name": spec["name"]}, tuple(report))


def double_pendulum(upper="upper", **more):
    spec = {
        "name": "double pendulum",
        "parameters": [],
        "bodies": [rod(upper, 1.0, 2.0), rod("lower", 0.8)],
        "points": [point("ground.O", "ground", [0, 0]), *ends(upper, 1.0), *ends("lower", 0.8)],
        "joints": [hinge("pivot", "ground.O", f"{upper}.start"), hinge("knee", f"{upper}.end", "lower.start")],
        "forces": [],
        "events": [{"name": "level", "when": "phi1"}],
        "angles": {upper: "phi1", "lower": "phi2"},
        **more,
    }
    items = [
        ReportItem("tip speed at the end", "speed(lower.end)"),
        ReportItem("largest pull", "pivot.F", "max"),
        ReportItem("mean height", "y(lower.end)", "mean"),
        ReportItem("angle when level", "phi2", at="level", unit="deg"),
        ReportItem("never", "phi2", at="leaves"),
    ]
    return source(spec, items)


def four_bar():
    ground = [
        point("ground.O", "ground", [0, 0]),
        point("ground.B", "ground", [0.9, 0]),
        point("ground.S", "ground", [1.25, 0.75]),
    ]
    spec = {
        "name": "four-bar with a motor",
        "parameters": [{"name": "T", "value": 2.0, "unit": "N*m"}],
        "bodies": [rod("crank", 0.3), rod("coupler", 0.9), rod("rocker", 0.6)],
        "points": [
            *ground,
            *ends("crank", 0.3),
            *ends("coupler", 0.9),
            *ends("rocker", 0.6),
            point("coupler.P", "coupler", [0.1, 0.28]),
        ],
        "joints": [
            hinge("main bearing", "ground.O", "crank.start"),
            hinge("crank pin", "crank.end", "coupler.start"),
            hinge("rocker bearing", "ground.B", "rocker.start"),
            hinge("rocker pin", "coupler.end", "rocker.end"),
        ],
        "forces": [
            {"name": "motor", "type": "torque", "with": {"on": "crank", "from": "ground", "value": "T"}},
            {"name": "return spring", "type": "spring", "with": {"between": ["rocker.end", "ground.S"], "stiffness": 20.0}},
        ],
        "events": [{"name": "crank level", "when": "sin(theta)"}],
        "angles": {"crank": "theta", "coupler": "beta", "rocker": "psi"},
    }
    items = [
        ReportItem("largest bearing load", "'main bearing'.F", "max"),
        ReportItem("rms crank speed", "omega(crank)", "rms"),
        ReportItem("work of the motor", "motor.work"),
    ]
    return source(spec, items)


def run_double_pendulum(until=2.0, **more) -> Run:
    made = double_pendulum(**more)
    return simulate(made, made.assemble(made.bind(), fixed={"phi1": 0.0, "phi2": -0.4})[0], Settings(until=until))


def run_four_bar(until=3.0) -> Run:
    made = four_bar()
    start, _ = made.assemble(made.bind(), fixed={"theta": 1.0}, guess={"beta": 0.4, "psi": 1.4})
    return simulate(made, start, Settings(until=until))

"""What the tests of switching motions look at: the changes of a run, its ledger, Newton's laws at its instants."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import SimpleNamespace

import numpy as np

import freebody as fb


def model(text: str, **parameters: float) -> fb.Mechanism:
    """The mechanism of a model file without its first line, with other values of its parameters."""
    mechanism = fb.Mechanism.loads("freebody: 1\n" + text)
    assert set(parameters) <= set(mechanism.parameters)
    mechanism.parameters.update(parameters)
    return mechanism


def motion(text: str, until: float, settings: Mapping[str, object] | None = None, **parameters: float) -> fb.Run:
    """The run of such a model, which must come to its end; its energy ledger must close."""
    run = model(text, **parameters).simulate(until=until, **(settings or {}))
    assert run.outcome.ok, run.outcome.sentence
    assert imbalance(run) < 1e-9
    return run


def changes(run: fb.Run, *kinds: str) -> list[SimpleNamespace]:
    """Mode changes, in order of time; only of these kinds, if any are given."""
    stated = [SimpleNamespace(**change) for change in run.motion.record["changes"]]
    return [change for change in stated if not kinds or change.kind in kinds]


def kinds(run: fb.Run) -> list[tuple[str, tuple[str, ...]]]:
    """Mode changes, without the times."""
    return [(change.kind, tuple(change.of)) for change in changes(run)]


def imbalance(run: fb.Run) -> float:
    """How far the energy ledger is open at most, over the largest kinetic energy or change of another column."""
    times = np.linspace(run.edges[0], run.edges[-1], 1001)
    names, values = run.motion.ledger(np.union1d(times, run.edges))
    scale = max(values[:, 0].max(), np.ptp(values[:, :-1], axis=0).max())
    assert names[-1] == "balance"
    return float(np.abs(values[:, -1]).max() / scale) if scale else float(np.abs(values[:, -1]).max())


def unbalanced(run: fb.Run, body: str, touches: Iterable[str], times: np.ndarray, gravity: tuple[float, float]) -> float:
    """The largest residual of Newton's and Euler's laws of a body on which only gravity and these contacts act.

    The accelerations are second differences of nothing but the motion; forces and where they act are what the run tells.
    In N and, for moments about the mass centre, N·m.
    """
    metadata = next(b for b in run.metadata["bodies"] if b["name"] == body)
    mass, inertia = metadata["mass"], metadata["inertia"]
    ax, ay, alpha = acceleration(run, body, times)
    force = [-mass * ax + mass * gravity[0], -mass * ay + mass * gravity[1]]
    moment = -inertia * alpha
    x, y = run.evaluate(f"x({body}.G)", times), run.evaluate(f"y({body}.G)", times)
    for name in touches:
        fx, fy = run.evaluate(f"{name}.Fx", times), run.evaluate(f"{name}.Fy", times)
        on = np.hypot(fx, fy) > 0  # elsewhere it acts nowhere
        px, py = run.evaluate(f"{name}.x", times[on]), run.evaluate(f"{name}.y", times[on])
        force = [force[0] + fx, force[1] + fy]
        moment[on] += (px - x[on]) * fy[on] - (py - y[on]) * fx[on]
    return float(max(np.abs(force[0]).max(), np.abs(force[1]).max(), np.abs(moment).max()))


def acceleration(run: fb.Run, body: str, times: np.ndarray, h: float = 1e-4) -> np.ndarray:
    """Acceleration (3, nt) of a mass centre and angular acceleration, from velocities by differences of the fourth order."""
    rates = [f"vx({body}.G)", f"vy({body}.G)", f"omega({body})"]
    at = lambda k: np.array([run.evaluate(rate, times + k * h) for rate in rates])
    return (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h)


def within(run: fb.Run, count: int, seed: int, start: float = 0.0, margin: float = 5e-4) -> np.ndarray:
    """Random times within a run, none so near to a change that a difference would reach over it."""
    times = np.random.default_rng(seed).uniform(start + margin, run.outcome.t - margin, count)
    switched = np.array([change.t for change in changes(run)] or [-1.0])
    return times[np.abs(times[:, None] - switched).min(axis=1) > margin]

"""Linear equations in numbers: against differences of the nonlinear equations on closed loops, of whole motions, and closed forms."""

import math

import numpy as np
import pytest
import store
from scipy.integrate import solve_ivp
from store import ANSWERED, every

import freebody as fb
from freebody.core import quote
from freebody.stability.state_space import SingularConfiguration, state_space

STEP = 2e-3
"""The longest step of differences, of an angle, or of a length in parts of the mechanism."""
SINGULAR = {"GEN-SLIDER/dead_point"}
"""Models that stay where loops lose their independence."""


@every(ANSWERED)
def test_perturbations_are_limits_of_differences_on_closed_loops(model):
    """Of coordinates, rates and accelerations, between states that the core assembles near by: trees, loops, contacts, rolling."""
    run = store.run(model)
    core, state = run.source, run.motion.state(0.37 * run.end.t)
    if model in SINGULAR:
        with pytest.raises(SingularConfiguration):
            state_space(core, state)
        return
    found = state_space(core, state)
    free, size = found.free, len(found.states)
    if size != 2 * len(free):
        pytest.skip("a rate is prescribed where its place is not: an assembly is not asked for that")
    names, i = list(found.coordinates), [found.coordinates.index(name) for name in free]
    texts, here = [f"accel({quote(name)})" for name in free], np.concatenate([state.q[i], state.u[i]])

    def near(x):
        places, rates = (dict(zip(free, values, strict=True)) for values in np.split(here + x, 2))
        guess = dict(zip(names, state.q + found.places @ x, strict=True))
        there = core.assemble(state.p, state.t, fixed=places, guess=guess, rates=rates, history=state.history)[0]
        return np.concatenate([there.q, there.u, core.evaluate(texts, there)])

    units = np.tile(core.free_bodies(state).units(core.metadata["coordinates"])[i], 2)
    exact = np.vstack([found.places, found.rates, found.a[len(free) :]])
    fastest = max(1.0, np.abs(state.u).max(initial=0.0))
    for k, way in enumerate(np.eye(size)):
        coarse, fine = ((near(h * way) - near(-h * way)) / (2 * h) for h in (STEP * units[k], STEP / 2 * units[k]))
        limit, error = fine + (fine - coarse) / 3, np.abs(fine - coarse)
        assert (np.abs(exact[:, k] - limit) <= 1e-7 * fastest * np.abs(limit).max() + error).all()


@pytest.mark.parametrize(
    "model",
    [
        "GEN-CHAIN/two_bars",
        "S19.21/model",
        "GEN-SLIDER/model",
        pytest.param("GEN-CAR/driveshaft", marks=pytest.mark.long),
        "EX-ARM/relative",
    ],
)
def test_perturbations_of_a_motion_grow_as_its_linear_equations_say(model):
    """ẋ = A(t) x along the motion, against differences of motions from starts beside each other: trees, loops, rolling."""
    mechanism, until = store.mechanism(model), 0.4
    settings = {"rtol": 1e-12, "until": until}
    run = mechanism.simulate(**settings)
    found = state_space(run.source, run.motion.state(0.0))
    free = found.free
    i = [found.coordinates.index(name) for name in free]
    start, size = run.motion.state(0.0), len(found.states)

    def matrix(t):
        return state_space(run.source, run.motion.state(t), free=free).a

    def growth(t, x):
        return (matrix(t) @ x.reshape(size, size)).ravel()

    whole = solve_ivp(growth, (0, until), np.eye(size).ravel(), "DOP853", rtol=1e-10, atol=1e-12)
    grown = whole.y[:, -1].reshape(size, size)

    def end(way, h):
        places, rates = np.split(np.concatenate([start.q[i], start.u[i]]) + h * way, 2)
        guess = {name: value for name, value in zip(found.coordinates, start.q, strict=True) if name not in free}
        changed = {"rates": dict(zip(free, rates, strict=True)), "guess": guess} | dict(zip(free, places, strict=True))
        last = mechanism.simulate(initial=changed, **settings).motion.state(until)
        return np.concatenate([last.q[i], last.u[i]])

    for way, column in zip(np.eye(size), grown.T, strict=True):
        coarse, fine = ((end(way, h) - end(way, -h)) / (2 * h) for h in (2 * STEP, STEP))
        limit, error = fine + (fine - coarse) / 3, 0.1 * np.abs(fine - coarse)
        assert (np.abs(limit - column) <= 1e-7 * np.abs(column).max() + error).all()


CART = """
freebody: 1
parameters: {M: 2 kg, m: 1 kg, l: 0.5 m, g: 9.81 m/s^2, k: 30 N/m, F: 0 N, a: 0 m/s^2}
gravity: [0, -g]
ground: {lines: {rail: {through: O, angle: 0}}}
bodies:
  cart: {mass: M, inertia: 0.1, points: {C: [0, 0]}}
  bob: {shape: particle, mass: m, points: {P: centre}}
joints:
  guide: {type: slider, along: ground.rail, line: {through: cart.C, angle: 0}, coordinate: x}
  rod: {type: link, of: [cart.C, bob.P], length: l, coordinate: {name: theta, zero: down}}
forces:
  spring: {type: spring, along: x, stiffness: k, rest_length: 0 m}
  push: {type: force, at: cart.C, value: F, direction: 0}
initial: {x: 0, theta: 0}
"""


def test_a_cart_with_a_pendulum_has_the_matrices_of_its_closed_form():
    """M ẍ + k x = F + m g θ and l θ̈ = −g θ − ẍ near rest, with F as input; the rod's tension does not change at first order."""
    model = fb.Mechanism.loads(CART)
    (mass, m, length, g, k) = (2.0, 1.0, 0.5, 9.81, 30.0)
    found = state_space(model.source(), model.start()[0], inputs=["F"], outputs=["x(bob.P)", "rod.tension", "accel(x)"])
    assert found.states == ("x", "theta", "rate(x)", "rate(theta)")
    by_x, by_theta = -k / mass, m * g / mass
    lower = [[by_x, by_theta, 0, 0], [-by_x / length, -(g + by_theta) / length, 0, 0]]
    assert found.a == pytest.approx(np.vstack([np.eye(4)[2:], lower]), abs=1e-12)
    assert found.b[:, 0] == pytest.approx([0, 0, 1 / mass, -1 / (mass * length)], abs=1e-14)
    assert found.c == pytest.approx(np.array([[1, length, 0, 0], [0, 0, 0, 0], [by_x, by_theta, 0, 0]]), abs=1e-12)
    assert found.d[:, 0] == pytest.approx([0, 0, 1 / mass], abs=1e-14)


@pytest.mark.parametrize("name, moved", [("l", r"its change moves x\(bob.G\)"), ("L", "no parameter is called 'L'")])
def test_what_is_no_input_is_refused_by_name(name, moved):
    model = fb.Mechanism.loads(CART)
    with pytest.raises(ValueError, match=moved):
        state_space(model.source(), model.start(theta=math.pi / 6)[0], inputs=[name])

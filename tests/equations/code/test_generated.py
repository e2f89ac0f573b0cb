"""Generated Python and C give what the core gives, at random states with random parameters, to round-off."""

from __future__ import annotations

import ast
from functools import cache

import numpy as np
import pytest
from programs import FUNCTIONS, ROOT, State, in_c, in_python, model, run, states

import freebody as fb

STATES = 20
EQUAL = 1e-12
TREES = [
    "systems/EX-ARM-two-link-arm/model.yaml",  # two links, absolute angles, motors
    "systems/EX-ARM-two-link-arm/relative.yaml",  # the same with relative angles
    "systems/EX-BLOCK-block-on-tipped-block/model.yaml",
    "systems/GEN-CHAIN-open-chains/model.yaml",  # three bars
    "systems/S19.17-new-gun/model.yaml",  # a collar on a turning rod
    "systems/S19.18-pendulum-on-an-incline/model.yaml",  # link: a pendulum on a slope
    "systems/S19.19-unbalanced-motor/model.yaml",  # springs, without gravity
    "systems/19.3.3-two-long-springs/polar.yaml",  # polar coordinates, springs
    "systems/19.3.15-rod-on-a-cart/model.yaml",  # a pendulum on a cart
    "systems/19.3.17-pendulum-on-a-cart/model.yaml",
    "systems/19.3.20-guide-and-pendulum/model.yaml",
    "systems/19.3.23-massless-double-pendulum/model.yaml",  # a part without mass
    "systems/19.3.24-straight-legs/model.yaml",
    "systems/S19.17-new-gun/free_end.yaml",  # a joint that is released later
    "systems/19.3.11-gun-on-a-cart/model.yaml",  # a curved slot that is left later
]
LOOPS = [
    "systems/19.3.30-rimless-wheel/hinged.yaml",  # a joint that is released later, its coordinate without a name
    "systems/GEN-SLIDER-slider-crank/model.yaml",
    "systems/S19.21-four-bar-inverse/model.yaml",
    "systems/S19.22-four-bar-torque/model.yaml",
    "examples/four_bar.yaml",
]
MOTIONS = [
    "systems/19.3.16-block-with-a-rod/driven.yaml",  # accelerations prescribed
    "systems/19.3.19-pumped-string/shaken.yaml",  # a function of time
    "systems/EX-ARM-two-link-arm/held.yaml",
    "systems/GEN-FOURBAR-four-bar-positions/model.yaml",  # loop and motion
    "systems/GEN-FOURBAR-four-bar-positions/watt.yaml",  # two loops and a motion
    "systems/S19.20-wheel-on-a-rod/model.yaml",  # everything prescribed
    "systems/S19.22-four-bar-torque/driven.yaml",
]
MODELS = [*TREES, *LOOPS, *MOTIONS]


@cache
def visited(path: str) -> tuple[State, ...]:
    return tuple(states(path, STATES))


def core_mass_matrix(state: State, coordinates) -> np.ndarray:
    """Of kinetic energy: Σ m vᵀv + I ω² from the velocities that the core finds for each rate alone."""
    bodies = state.free.bodies.values()
    rows = [[b.by_accelerations[c] * np.sqrt([b.mass, b.mass, b.inertia]) for b in bodies] for c in coordinates]
    columns = np.array(rows).reshape(len(coordinates), -1)
    return columns @ columns.T


def agree(found, expected, scale: float = 0.0) -> bool:
    return np.abs(found - expected).max(initial=0.0) <= EQUAL * max(np.abs(expected).max(initial=0.0), scale)


def check(functions, names, path: str) -> None:
    """``functions`` against the core, at all states of a model."""
    for state in visited(path):
        at, (force, acceleration) = (state.q, state.u, state.all, state.t), state.now.sizes
        values = {load.symbol: load.value for load in state.free.loads if load.unknown}
        assert all(load.determinate for load in state.free.loads)
        assert set(names.LOADS) == set(values)
        assert agree(functions.mass_matrix(*at), core_mass_matrix(state, names.COORDINATES))
        assert agree(functions.accelerations(*at), state.now.accelerations, acceleration)
        if names.LOADS:
            assert agree(functions.reactions(*at), np.array([values[name] for name in names.LOADS]), force)
        if hasattr(names, "MULTIPLIERS"):
            assert agree(functions.multipliers(*at), np.array([values[name] for name in names.MULTIPLIERS]), force)


@pytest.mark.parametrize("path", MODELS)
def test_python_gives_what_the_core_gives(path):
    check(in_python(path), in_python(path), path)


@pytest.mark.parametrize("path", MODELS)
def test_c_gives_what_the_core_and_python_give(path, tmp_path):
    python = in_python(path)
    c = in_c(model(path), python, tmp_path)
    check(c, python, path)
    assert np.array_equal(c.DEFAULTS, python.DEFAULTS)
    for state in visited(path)[:5]:
        at = state.q, state.u, state.all, state.t
        for name in FUNCTIONS:
            if hasattr(python, name):
                assert agree(getattr(c, name)(*at), getattr(python, name)(*at), state.now.sizes[0] * (name == "reactions"))
        y = np.concatenate([state.q, state.u])
        assert agree(c.derivative(state.t, y, state.all), python.derivative(state.t, y, state.all), state.now.sizes[1])


@pytest.mark.parametrize("path", LOOPS + MOTIONS)
def test_accelerations_obey_the_constraints_whose_loads_do_no_work(path):
    python = in_python(path)
    for state in visited(path):
        at = state.q, state.u, state.all, state.t
        rows, bias, held = (getattr(python, f)(*at) for f in ("constraint_jacobian", "constraint_bias", "multiplier_matrix"))
        assert agree(rows @ state.now.accelerations, -bias, np.abs(rows * state.now.accelerations).max())
        *_, directions = np.linalg.svd(rows)
        allowed = directions[len(rows) :]  # motions that the constraints allow
        assert np.abs(allowed @ held).max(initial=0.0) < 1e-12 * np.abs(held).max()


@pytest.mark.parametrize(
    "path", ["systems/GEN-CHAIN-open-chains/model.yaml", "examples/four_bar.yaml", "systems/19.3.19-pumped-string/shaken.yaml"]
)
def test_an_integrator_reproduces_the_run(path):
    from scipy.integrate import solve_ivp

    python, mechanism = in_python(path), model(path)
    core, start = mechanism.compile(), mechanism.start()[0]
    run_there = core.simulate(start, start.t + 1.0, rtol=1e-11)
    ours = solve_ivp(
        python.derivative, (start.t, start.t + 1.0), np.concatenate([start.q, start.u]), "DOP853", rtol=1e-11, atol=1e-11
    )
    end = run_there.end
    assert end.t == pytest.approx(ours.t[-1]) and ours.success
    assert np.abs(ours.y[:, -1] - np.concatenate([end.q, end.u])).max() < 1e-7


@pytest.mark.parametrize("path", MODELS)
def test_generated_python_needs_numpy_only(path):
    tree = ast.parse(model(path).code())
    imported = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    assert [name.name for node in imported for name in node.names] == ["numpy"]


def test_numbers_that_the_model_leaves_without_a_name_are_parameters():
    text = (ROOT / "examples/four_bar.yaml").read_text(encoding="utf-8")
    python = in_python("examples/four_bar.yaml")
    assert {"g", "m_crank", "m_coupler", "m_rocker"} <= set(python.PARAMETERS)
    heavier = text.replace("length: b, mass: 1 kg", "length: b, mass: 1.3 kg")
    assert heavier != text
    other = fb.Mechanism.loads(f"{heavier}\ngravity: 3.7")
    state, _ = other.start()
    there = other.compile().instant(state).accelerations
    p = np.array(list((python.PARAMETERS | {"g": 3.7, "m_coupler": 1.3}).values()))
    assert agree(python.accelerations(state.q, state.u, p, state.t), there)


def test_defaults_are_those_of_the_model_and_of_changes():
    mechanism = model("systems/S19.17-new-gun/model.yaml")
    state, _ = mechanism.start()
    python, changed = in_python("systems/S19.17-new-gun/model.yaml"), run(mechanism.code(l="2 m"))
    assert python.accelerations(state.q, state.u) == pytest.approx(mechanism.solve()._solved.accelerations, rel=1e-12)
    assert python.PARAMETERS["l"] == 1.0 and changed.PARAMETERS["l"] == 2.0
    assert "m2/3 in the model" in mechanism.code()


def test_what_is_zero_in_the_model_is_free_in_code():
    """S19.19 has no gravity, but a symbol for it: with it the guide carries both weights of the resting motor and its load."""
    python = in_python("systems/S19.19-unbalanced-motor/model.yaml")
    assert python.PARAMETERS["g"] == 0.0
    values = python.PARAMETERS | {"g": 2.0, "T": 0.0}
    hanging = [0.0, -np.pi / 2]  # the spring relaxed, the arm straight down
    carried = python.reactions(hanging, [0.0, 0.0], np.array(list(values.values())))[python.LOADS.index("guide.Fn")]
    assert carried == pytest.approx(2.0 * (values["M"] + values["m"]), rel=1e-12)

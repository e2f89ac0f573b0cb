"""Many motions at once are those that `simulate` makes one by one, in any order and on any number of threads: by steps of their own side by
side within the tolerance, else to the same bits."""

import numpy as np
import pytest
from store import MODELS, every, mechanism

import freebody as fb
from freebody.core import MotionError
from freebody.model.errors import ModelFileError

STEP = {"until": 0.3, "method": "rk4", "step": 0.01}
PENDULUMS = """
freebody: 1
parameters: {L: 1 m, m2: 0.4 kg, J: m2*L^2/12}
gravity: 9.81
bodies:
  upper: {shape: rod, length: L, mass: 1 kg}
  lower: {shape: general, mass: m2, inertia: J, points: {top: [0, 0.3], end: [0, -0.4]}}
joints:
  A: {type: hinge, of: [upper.start, ground.O], coordinate: {name: alpha, sense: clockwise}}
  B: {type: hinge, of: [upper.end, lower.top], coordinate: {name: beta, absolute: true}}
initial: {alpha: 0.3, beta: 0.2}
"""
"""One joint read against its sense, the other from the fixed axis."""
CART = """
freebody: 1
parameters: {L: 0.5 m, k: 50 N/m, c: 2 N*s/m, drag: 4 N*s/m}
gravity: 9.81
bodies:
  cart: {shape: rectangle, width: 0.4 m, height: 0.2 m, mass: 2 kg}
  rod: {shape: rod, length: L, mass: 1 kg}
  bead: {shape: particle, mass: 0.2 kg}
  plate: {shape: disk, radius: 0.1 m, mass: 0.5 kg}
joints:
  track: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.G, angle: 0}, coordinate: s}
  pivot: {type: hinge, of: [cart.G, rod.start], coordinate: theta}
  wire: {type: slot, along: {through: rod.end, angle: 0.3}, point: bead.centre, coordinate: z}
  loose: {type: free, of: [ground.O, plate.centre], coordinates: [x, y, phi]}
states: {memory: {rate: (rate(s) - memory)/(0.1 s), start: 0.2 m/s}}
forces:
  return: {type: spring, along: s, stiffness: k, damping: c}
  band: {type: spring, between: [rod.end, plate.centre], stiffness: 20 N/m, rest_length: 0.3 m}
  push: {type: force, at: cart.G, x: 3 N*sin(5*t/(1 s)) - drag*memory}
initial: {s: 0.1, theta: -0.9, z: 0.1, x: 1, y: -0.5, phi: 0, rates: {theta: 2}}
"""
"""Every kind of joint of a tree, springs on coordinates and between points, a law of time, a state with a rate of its own."""


def four_bar(rest: str, coupler: str = "L", rocker: str = "0.3 m", bodies: str = "", joints: str = "") -> str:
    """A crank of 0.1 m, a coupler and a rocker between O and D, with what else stands in the model."""
    return f"""
freebody: 1
gravity: 9.81
ground: {{points: {{D: [0.4, 0], E: [0, 1], F: [0, 2]}}}}
bodies:
  crank: {{shape: rod, length: 0.1 m, mass: 1 kg}}
  coupler: {{shape: rod, length: {coupler}, mass: 1 kg}}
  rocker: {{shape: rod, length: {rocker}, mass: 1 kg}}
{bodies}
joints:
  A: {{type: hinge, of: [ground.O, crank.start], coordinate: phi}}
  B: {{type: hinge, of: [crank.end, coupler.start]}}
  C: {{type: hinge, of: [coupler.end, rocker.end]}}
  D: {{type: hinge, of: [ground.D, rocker.start], coordinate: psi}}
{joints}
{rest}
"""


FREE = """
parameters: {L: 0.3 m}
initial: {phi: 1, guess: {psi: 1.5}, rates: {phi: 2}}
"""
FOUR_BAR = four_bar(f"{FREE}events: {{level: {{when: sin(phi), then: stop}}}}")
"""A loop, and an event that ends some of the motions."""
TURNED = """
parameters: {L: 0.3 m, w: 3 rad/s}
motions: {motor: {of: phi, is: 1 rad + w*t}}
"""
MOTOR = four_bar(f"{TURNED}initial: {{guess: {{psi: 1.5}}}}")
DRIVEN = four_bar(
    f"{TURNED}initial: {{guess: {{psi: 1.5}}, lower.angle: 90 deg}}",
    bodies="  door: {shape: rod, length: 1 m, mass: 5 kg}",
    joints="""
  lower: {type: hinge, of: [ground.E, door.start]}
  upper: {type: hinge, of: [ground.F, door.end]}
""",
)
"""A motor, and a door of which its hinges leave open which of them carries it."""
PARALLELOGRAM = four_bar(
    "parameters: {w: 5 rad/s}\ninitial: {phi: 1, guess: {psi: 1}, rates: {phi: w}}", coupler="0.4 m", rocker="0.1 m"
)
"""Where it lies flat the rows of its loop depend on each other."""
SLIDER_CRANK = """
freebody: 1
parameters: {L: 0.3 m, c: 5 N*s/m}
gravity: 9.81
ground: {lines: {axis: {through: O, angle: 0}}}
bodies:
  crank: {shape: rod, length: 0.1 m, mass: 1 kg}
  rod: {shape: rod, length: L, mass: 2 kg}
  slider: {shape: general, mass: 1.5 kg, inertia: 0.01, lines: {base: {through: origin, angle: 0}}}
joints:
  O: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: {name: beta, absolute: true}}
  C: {type: hinge, of: [rod.end, slider.origin], coordinate: {name: tilt, absolute: true}}
  guide: {type: slider, along: ground.axis, line: slider.base}
forces: {damper: {type: spring, between: [ground.O, slider.origin], stiffness: 30 N/m, damping: c}}
initial: {theta: 0.3, guess: {beta: -0.1}, rates: {theta: 20}}
"""
"""Its loop is closed by the slider, of which a row is an angle; the damper does work."""
OWN = {"until": 0.3, "rtol": 1e-8}
"""Each member by steps of its own."""
LADDER = """
freebody: 1
parameters: {L: 4 m, tilt: 70 deg}
gravity: 9.81
ground: {lines: {floor: {through: O, angle: 0}, wall: {through: O, angle: -90 deg}}}
bodies: {ladder: {shape: rod, length: L, mass: 10 kg, points: {A: start, B: end}}}
joints: {plane: {type: free, of: [ground.O, ladder.G], coordinates: [x, y, theta]}}
contacts: {floor: {of: [ladder.A, ground.floor]}, wall: {of: [ladder.B, ground.wall]}}
initial: {points: {ladder.A: [L*cos(tilt), 0], ladder.B: [0, L*sin(tilt)]}, at_rest: true}
"""
"""It slides down a wall until it leaves it."""


def members(count, *names, seed=1):
    rng = np.random.default_rng(seed)
    return {name: rng.uniform(0.1, 1, count) for name in names}


@pytest.mark.parametrize(
    "text, q0, u0, p",
    [
        (PENDULUMS, ("alpha", "beta"), ("beta",), ("L", "m2")),
        (CART, ("s", "theta", "z", "x"), ("theta", "phi"), ("L", "k")),
        (FOUR_BAR, ("phi",), ("phi",), ("L",)),
    ],
)
def test_each_member_is_what_simulate_makes_of_it_to_the_last_bit(text, q0, u0, p):
    m = fb.Mechanism.loads(text)
    assert m.compile().runs_in_lanes == (text is not FOUR_BAR)
    count = 5 if text is FOUR_BAR else 19
    q0, u0, p = members(count, *q0), members(count, *u0, seed=2), members(count, *p, seed=3)
    p["L"] = 0.3 + 0.05 * p["L"]
    times = [0, 0.05, 0.123, 0.3]
    made = m.batch(q0, u0, p, t_eval=times, **STEP)
    for i in range(count):
        of_member = {name: float(column[i]) for name, column in (q0 | p).items()}
        rates = {name: float(column[i]) for name, column in u0.items()}
        run = m.simulate(t_eval=times, **STEP, **of_member, **({"rates": m_rates(m, rates)} if rates else {}))
        assert made.outcome[i] == run.outcome.name
        assert made.end[i] == run.outcome.t
        known = len(run.t)
        np.testing.assert_array_equal(made.q[i, :known], run.q)
        np.testing.assert_array_equal(made.u[i, :known], run.u)
        assert np.isnan(made.q[i, known:]).all()


def m_rates(m, rates):
    """The rates of a start: those of the model, with others in their place."""
    return dict(m.model.initial.rates) | rates


@pytest.mark.parametrize(
    "initial",
    [
        "{phi: 1, guess: {psi: -1.5}, rates: {phi: 2}}",
        "{phi: 1, branch: {y(coupler.end): negative}}",
        "{points: {crank.end: [0.06 m, 0.08 m]}, guess: {psi: 1.5}}",
        "{phi: L/(0.3 m), guess: {psi: 2*phi0}, rates: {phi: 3 rad/s}}",
    ],
)
def test_loops_close_from_what_a_start_says_on_any_number_of_threads(initial):
    """Guesses, branches, places of points and formulas of parameters, which are others in each member."""
    text = FOUR_BAR.replace("{phi: 1, guess: {psi: 1.5}, rates: {phi: 2}}", initial)
    m = fb.Mechanism.loads(text.replace("{L: 0.3 m}", "{L: 0.3 m, phi0: 0.7 rad}"))
    lengths, angles = np.linspace(0.28, 0.32, 7), np.linspace(0.6, 0.8, 7)
    made = [m.batch(p={"L": lengths, "phi0": angles}, t_eval=[0], threads=threads, **STEP) for threads in (1, 2, 5)]
    assert made[0].identical(made[1]) and made[0].identical(made[2])
    for i, (length, angle) in enumerate(zip(lengths.tolist(), angles.tolist(), strict=True)):
        state, _ = m.start(L=length, phi0=angle)
        run = m.simulate(t_eval=[0], L=length, phi0=angle, **STEP)
        np.testing.assert_array_equal(made[0].q[i], run.q)
        np.testing.assert_array_equal(made[0].u[i], run.u)
        np.testing.assert_allclose(run.q[0], state.q, rtol=1e-12)  # the first step may close it to the last digits


@pytest.mark.parametrize(
    "text, p, settings",
    [
        (PENDULUMS, ("L", "m2"), STEP),
        (CART, ("L", "k"), STEP),
        (FOUR_BAR, ("L",), {"until": 3, "rtol": 1e-8}),
        (DRIVEN, ("L", "w"), {"until": 1, "rtol": 1e-8}),
        (LADDER, ("L", "tilt"), {"until": 1.5, "rtol": 1e-8}),
    ],
)
def test_accelerations_and_reactions_are_those_of_the_balances_of_every_body(text, p, settings):
    """Newton's and Euler's, in one system of equations with all reactions, at the states of `simulate`. That and the elimination each
    lose some digits of 16 where a loop stands stretched; 1e-9 of the largest leaves room for it."""
    m = fb.Mechanism.loads(text)
    p = {
        name: {"L": 0.3, "m2": 0.2, "k": 40, "w": 2, "tilt": 1.1}[name] + 0.1 * column for name, column in members(4, *p).items()
    }
    made = m.batch(p=p, reactions=True, **settings)
    for i in range(4):
        run = m.simulate(
            t_eval=made.time[: int(np.isfinite(made.q[i, :, 0]).sum())], **settings, **{n: float(x[i]) for n, x in p.items()}
        )
        for k in range(0, len(run.t), 10):
            now = m.compile().instant(run.motion.state(float(run.t[k])), "newton_euler")
            np.testing.assert_allclose(made.accelerations[i, k], now.accelerations, 1e-9, 1e-9 * abs(now.accelerations).max())
            expected = reactions_by_name(m, now)
            largest = np.nanmax(np.abs([*expected.values()]))
            np.testing.assert_allclose(made.reactions[i, k].sel(reaction=[*expected]), [*expected.values()], 1e-9, 1e-9 * largest)
        assert len(expected) == made.sizes["reaction"]
        assert np.isnan(
            made[["q", "u", "accelerations", "reactions"]].isel(member=i, time=slice(len(run.t), None)).to_array()
        ).all()
    assert np.isnan(made.reactions[0, 0]).any() == (text is DRIVEN)


def reactions_by_name(m, now):
    """Those of joints, motors and contacts at an instant."""
    names = [f"{joint['name']}.{part}" for joint in m.compile().metadata["joints"] for part in ("Fx", "Fy", "M")]
    limits = {f"{name}.F{axis}": getattr(limit, f"F{axis}") for name, limit in now.limits.items() for axis in "xy"}
    return dict(zip(names, now.reactions.ravel(), strict=True)) | now.motions | limits


@pytest.mark.parametrize(
    "text, q0, p, settings",
    [
        (PENDULUMS, ("alpha", "beta"), ("L",), STEP),
        (CART, ("s", "theta"), (), STEP),
        (CART, ("s",), ("L",), STEP),
        (FOUR_BAR, ("phi",), ("L",), STEP),
        (CART, ("s",), ("L",), OWN),
        (SLIDER_CRANK, ("theta",), ("L",), OWN),
    ],
)
def test_neither_threads_nor_neighbours_change_a_bit(text, q0, p, settings):
    m, count = fb.Mechanism.loads(text), 70 if settings is OWN else 21
    q0, p = members(count, *q0), {name: 0.3 + 0.1 * column for name, column in members(count, *p).items()}
    alone = m.batch(q0, p=p, threads=1, reactions=True, **settings)
    for threads in (2, 4):
        assert alone.identical(m.batch(q0, p=p, threads=threads, reactions=True, **settings))
    order = np.random.default_rng(4).permutation(count)
    mixed = m.batch({n: x[order] for n, x in q0.items()}, p={n: x[order] for n, x in p.items()}, reactions=True, **settings)
    assert mixed.drop_vars("member").identical(alone.isel(member=order).drop_vars("member"))
    assert alone[["q", "u", "outcome"]].identical(m.batch(q0, p=p, **settings)[["q", "u", "outcome"]])


@pytest.mark.parametrize(
    "text, p",
    [
        (PENDULUMS, ("L", "m2")),
        (CART, ("L", "k")),
        (four_bar(FREE), ("L",)),
        (SLIDER_CRANK, ("L",)),
        (MOTOR, ("L", "w")),
    ],
)
def test_by_steps_of_their_own_they_come_side_by_side_where_they_come_one_by_one(text, p):
    """By the equations of a route. Both are off by the tolerance, 1e-11, and a motion makes less than a thousand times as much of it."""
    m = fb.Mechanism.loads(text)
    p = {name: 0.3 + 0.1 * column for name, column in members(5, *p).items()}
    made, solved = (m.batch(p=p, reactions=True, until=1, rtol=1e-11, **how) for how in ({}, {"route": "minimal"}))
    assert made.ok.all()
    for name in ("q", "u", "accelerations", "reactions"):
        np.testing.assert_allclose(made[name], solved[name], 0, 1e-8 * abs(solved[name]).max().item())
    assert not made.identical(solved)  # else they are not by another way


def test_loops_are_closed_wherever_they_are_shown():
    """To round-off, in place and in rate, between steps as well."""
    m = fb.Mechanism.loads(SLIDER_CRANK)
    length = np.linspace(0.25, 0.45, 70)
    made = m.batch(p={"L": length}, until=0.3, rtol=1e-6)
    (theta, beta, tilt), (theta_rate, beta_rate, tilt_rate) = (
        [of.sel(coordinate=name).values for name in ("theta", "beta", "tilt")] for of in (made.q, made.u)
    )
    length = length[:, None]
    assert abs(0.1 * np.sin(theta) + length * np.sin(beta)).max() < 1e-15
    assert abs(0.1 * np.cos(theta) * theta_rate + length * np.cos(beta) * beta_rate).max() < 1e-14 * abs(theta_rate).max()
    assert max(abs(tilt).max(), abs(tilt_rate).max()) < 1e-13


def test_a_member_that_passes_where_rows_depend_on_each_other_is_made_by_itself():
    """As `simulate` makes it, to the last bit, and no other."""
    m = fb.Mechanism.loads(PARALLELOGRAM)
    speed = np.array([0.1, 5.0, 1.0, 12.0])
    made, passing = m.batch(p={"w": speed}, until=0.2, rtol=1e-8), []
    for i, w in enumerate(speed.tolist()):
        run = m.simulate(t_eval=made.time, until=0.2, rtol=1e-8, w=w)
        assert made.outcome[i] == run.outcome.name
        np.testing.assert_allclose(made.q[i], run.q, 0, 1e-6)
        above = np.sin(run.q[:, 0]) > 0
        passing.append(not above.all())
        assert np.array_equal(made.q[i], run.q) == passing[-1]
    assert any(passing) and not all(passing)


@pytest.mark.parametrize("text, p", [(PENDULUMS, ("L", "m2")), (CART, ("L", "k"))])
def test_side_by_side_all_has_the_bits_that_one_alone_has(text, p):
    """With no step to spare each is made by itself."""
    m = fb.Mechanism.loads(text)
    core, (state, _), columns = m.compile(), m.start(), members(70, *p)
    rows = [core.bind_rows({name: 0.3 + 0.1 * column for name, column in columns.items()})]
    rows += [np.tile(row, (70, 1)) for row in (state.q, state.u)]
    settings = {"method": "rk4", "step": 1 / 64, "rtol": 1e-9, "max_step": None, "route": "auto", "reactions": True}
    settings |= {"impacts": "stop", "painleve": "stop"}
    (made, _), (alone, ends) = (
        core.batch(*rows, 0.0, 0.5, np.array([0, 0.1, 0.5]), 1, max_steps=steps, **settings) for steps in (33, 32)
    )
    assert all(ends["ok"])
    np.testing.assert_array_equal(made, alone)


@every(MODELS)
def test_every_model_moves_among_others_as_alone_to_the_last_bit(model):
    """By `rk4` many trees are carried by a list of operations, one by the machine code that is made of it."""
    m = mechanism(model)
    core, (state, _) = m.compile(), m.start()
    rows, end = [np.tile(row, (3, 1)) for row in (state.p, state.q, state.u)], state.t + STEP["until"]
    settings = {"method": "rk4", "step": STEP["step"], "rtol": 1e-9, "max_step": None, "route": "auto", "reactions": False}
    settings |= {"impacts": "stop", "painleve": "stop"}
    made, _ = core.batch(*rows, state.t, end, np.array([end]), 1, **settings)
    run = m.simulate(**STEP | {"until": end}, t_eval=[end])
    reached = np.hstack([run.q, run.u]) if len(run.t) else np.nan
    np.testing.assert_array_equal(made[:, 0], np.broadcast_to(reached, made[:, 0].shape))


@pytest.mark.parametrize("text, p", [(PENDULUMS, ("L", "m2")), (CART, ("L", "k"))])
def test_motions_by_recorded_equations_are_those_of_instants_solved_one_by_one(text, p):
    """Those of a route. Each of 30 steps adds round-off, 1e-16 of what is largest, and the motion multiplies it by less than a hundred."""
    m = fb.Mechanism.loads(text)
    p = {name: 0.3 + 0.1 * column for name, column in members(5, *p).items()}
    made, solved = (m.batch(p=p, reactions=True, **STEP, **how) for how in ({}, {"route": "minimal"}))
    for name in ("q", "u", "accelerations", "reactions"):
        np.testing.assert_allclose(made[name], solved[name], 0, 3e-13 * abs(solved[name]).max().item())
    assert not made.identical(solved)  # else they are not by another way


def test_a_formula_that_goes_by_the_value_of_a_number_is_that_of_each_member():
    """A body without mass has its mass centre by another formula; a spring of no length has no direction, and pulls a moment later."""
    pieces = "[{shape: rod, length: L, mass: m}, {shape: disk, radius: 0.1 m, mass: m, at: [0.2 m, 0]}]"
    rod = f"rod: {{pieces: {pieces}, points: {{start: [-0.25 m, 0], end: [0.25 m, 0]}}}}"
    text = CART.replace("rod: {shape: rod, length: L, mass: 1 kg}", rod).replace("{L:", "{m: 1 kg, L:")
    text = text.replace(
        "between: [rod.end, plate.centre], stiffness: 20 N/m, rest_length: 0.3 m",
        "between: [ground.O, plate.centre], stiffness: 20 N/m",
    )
    m = fb.Mechanism.loads(text)
    x, mass = np.array([0, 0, 0.5, 0.5]), np.array([0, 1, 0, 1])
    made = m.batch({"x": x, "y": 0.0}, p={"m": mass}, **STEP)
    assert made.ok.all()
    for i in range(4):
        run = m.simulate(t_eval=made.time, x=x[i].item(), y=0.0, m=mass[i].item(), **STEP)
        np.testing.assert_array_equal(made.q[i], run.q)
        np.testing.assert_array_equal(made.u[i], run.u)
        solved = m.simulate(t_eval=made.time, x=x[i].item(), y=0.0, m=mass[i].item(), route="minimal", **STEP)
        np.testing.assert_allclose(run.q, solved.q, 0, 3e-13 * abs(solved.q).max())


def test_energy_of_pendulums_is_kept_to_the_fourth_power_of_the_step():
    """Bars of 1 m: E = θ̇²/6 + g sin(θ)/2 a kilogram. Halving the step divides the drift by 2⁴; for steps of a 500th of a period the next
    order is below 10 %."""
    m = fb.Mechanism("pendulum", gravity=9.81)
    rod = m.rod("rod", length=1, mass=1)
    m.hinge("ground.O", rod.start, coordinate="theta")
    m.initial(theta=0)
    q0 = {"theta": np.linspace(-1, 1, 10)}

    def drift(step):
        made = m.batch(q0, until=1, method="rk4", step=step, t_eval=[0, 1])
        energy = made.u[..., 0] ** 2 / 6 + 9.81 * np.sin(made.q[..., 0]) / 2
        return abs(energy[:, 1] - energy[:, 0]).max().item()

    assert drift(1e-3) < 1e-11
    assert drift(4e-3) / drift(2e-3) == pytest.approx(2**4, rel=0.1)


@pytest.mark.parametrize("settings", [STEP, OWN])
def test_a_member_that_fails_ends_alone(settings):
    """The square of its rate overflows; the others go on."""
    m = fb.Mechanism.loads(PENDULUMS)
    u0 = {"beta": np.array([1.0, 1e200, 2.0])}
    made = m.batch({}, u0, **settings)
    assert made.outcome.values.tolist() == ["Completed", "Overflow", "Completed"]
    assert made.ok.values.tolist() == [True, False, True]
    assert np.isfinite(made.q[[0, 2]]).all()
    assert np.isnan(made.q[1, 1:]).all()


@pytest.mark.parametrize(
    "given, what",
    [
        ({}, "nothing tells the members apart"),
        ({"q0": {"alpha": [1, 2]}, "p": {"L": [1, 2, 3]}}, r"p\['L'\] has 3 values, q0\['alpha'\] has 2"),
        ({"q0": {"alpha": [[1, 2]]}}, r"q0\['alpha'\] has the shape \(1, 2\)"),
        ({"q0": {"alpha": [1, np.nan]}}, r"q0\['alpha'\] is nan for member 1"),
        ({"q0": np.ones((4, 3))}, r"q0 has the shape \(4, 3\)"),
        ({"q0": {"gamma": [1, 2]}}, "there is no coordinate"),
        ({"q0": {"alpha": []}}, "is empty"),
        ({"q0": {"alpha": [1, 2]}, "t_eval": [0, 9]}, "t_eval has the time 9 s"),
        ({"q0": {"alpha": [1, 2]}, "t_eval": []}, "t_eval is empty"),
    ],
)
def test_arrays_that_do_not_fit_are_refused_with_what_and_where(given, what):
    with pytest.raises(ModelFileError, match=what):
        fb.Mechanism.loads(PENDULUMS).batch(**STEP, **given)


@pytest.mark.parametrize(
    "text, p, error, what",
    [
        (PENDULUMS, {"m2": [1, -1]}, fb.ModelError, "member 1"),
        (FOUR_BAR, {"L": [0.3, 0.2, 0.01, 0.3, 0.02]}, MotionError, "the parts do not fit together.*member 2"),
    ],
)
def test_the_first_member_with_numbers_that_cannot_be_is_named(text, p, error, what):
    for threads in (1, 3):
        with pytest.raises(error, match=what):
            fb.Mechanism.loads(text).batch(p=p, threads=threads, **STEP)

"""Inverse dynamics: what forward dynamics makes of the forces found is the motion that was given."""

import json

import numpy as np
import pytest
from random_models import _drawn

import freebody as fb
from freebody.core import quote
from freebody.inverse import NotRealizable, quintic, recorded, steady
from freebody.inverse.actuators import Actuators
from freebody.inverse.virtual_motions import allowed
from freebody.model.errors import ModelProblem
from freebody.solve.perturbed_states import others

ARM = """
freebody: 1
parameters: {T1: 0, T2: 0, T3: 0}
bodies: {upper: {shape: rod, length: 0.5, mass: 2}, forearm: {shape: rod, length: 0.4, mass: 1}}
joints:
  shoulder: {type: hinge, of: [ground.O, upper.start], coordinate: q1}
  elbow: {type: hinge, of: [upper.end, forearm.start], coordinate: q2}
forces:
  shoulder motor: {type: torque, on: upper, value: T1}
  elbow motor: {type: torque, on: forearm, from: upper, value: T2}
  cable motor: {type: law, along: q1 + q2, value: T3}
initial: {q1: 0.3, q2: 0.8, at_rest: true}
run: {until: 1 s}
"""


def driven(seed: int) -> tuple[fb.Mechanism, list[str]]:
    """A random mechanism of one to three bodies, some with a loop, and a force with a parameter of its own along every coordinate."""
    draw = _drawn(seed, apart=True)
    for word in ("motions", "contacts", "strings", "stops", "events"):
        draw.model[word] = {}
    names = [f"motor {i}" for i in range(len(draw.values))]
    draw.model["parameters"] |= {f"tau{i}": 0 for i in range(len(names))}
    for i, coordinate in enumerate(draw.values):
        draw.model["forces"][names[i]] = {"type": "law", "along": quote(coordinate), "value": f"tau{i}"}
    return fb.Mechanism.loads(json.dumps(draw.model | {"initial": {"guess": draw.values, "at_rest": True}}), "random"), names


@pytest.mark.parametrize("seed", range(60))
def test_forward_after_inverse_and_inverse_after_forward_are_the_identity(seed):
    """To 1e-12 times the condition number of the accelerations by the forces; and where fewer motors than freedoms bring a motion
    about, or more than freedoms, the forces of least norm are no larger than those that did."""
    mechanism, names = driven(seed)
    source, rng = mechanism.source(), np.random.default_rng(seed)
    start = mechanism.start()[0]
    for state in others(source, start)[:3] or [start]:
        freedom = allowed(source, source.free_bodies(state)).shape[1]
        for count in {freedom, len(names)} if freedom else ():
            motors = Actuators(source, names[:count], {}, least=True)
            forces = rng.uniform(-5, 5, count)
            p = state.p.copy()
            p[motors.places] = forces
            wanted = source.instant(type(state)(p, state.t, state.q, state.u)).accelerations
            found = motors.at(state, wanted)
            columns = source.derivatives([f"accel({quote(c['name'])})" for c in source.metadata["coordinates"]], state)
            by_force = columns[:, 1 + 2 * len(state.q) :][:, motors.places]
            values = np.linalg.svd(by_force, compute_uv=False)[: count - found.free.shape[1]]
            bound = 1e-12 * (values[0] / values[-1] if len(values) else 1.0)
            size = max(source.instant(state).sizes[0], np.abs(forces).max())
            again = source.instant(found.state).accelerations
            assert np.abs(again - wanted).max() <= bound * max(np.abs(wanted).max(), source.instant(state).sizes[1])
            assert found.error <= bound
            if found.free.size:
                assert np.linalg.norm(found.forces) <= np.linalg.norm(forces) * (1 + bound)
                assert np.abs(by_force @ found.free).max() <= bound * np.abs(by_force).max() * np.abs(found.free).max()
            else:
                assert np.abs(found.forces - forces).max() <= bound * size


@pytest.mark.long
def test_the_torques_of_a_path_return_the_path():
    """A hand path on a table of torques is followed by forward dynamics, and the works are the gain of energy."""
    arm = fb.Mechanism.loads(ARM)
    path = {"x(forearm.end)": quintic(0.3, 0.6, 0.8), "y(forearm.end)": quintic(0.5, -0.1, 0.8)}
    found = arm.inverse(path, ["shoulder motor", "elbow motor"], until=0.8)
    gain = found.run.evaluate("energy()", 0.8) - found.run.evaluate("energy()", 0.0)
    assert sum(found.work(motor) for motor in found.motors) == pytest.approx(gain, rel=1e-9)
    again = arm.inverse(found.run, ["shoulder motor", "elbow motor"])
    assert again["'elbow motor'.value"] == pytest.approx(found["'elbow motor'.value"], rel=1e-12)
    own = arm.inverse({"q1": {"is": 0, "level": "acceleration"}}, until=0.5)
    assert own.evaluate("energy()", 0.5) - own.evaluate("energy()", 0.0) == pytest.approx(own.work("motion of q1"), abs=1e-9)


def test_what_cannot_be_had_and_what_is_not_unique_are_named():
    arm = fb.Mechanism.loads(ARM)
    with pytest.raises(NotRealizable, match=r"at q1 = 0\.3, q2 = 0\.8: no actuator works .* what these give is the motion of q2"):
        arm.inverse("rest", "elbow motor").evaluate("t", 0.0)
    every = ["shoulder motor", "elbow motor", "cable motor"]
    with pytest.raises(fb.Indeterminate, match="1 shoulder motor and 1 elbow motor and -1 cable motor"):
        arm.inverse("rest", every).evaluate("t", 0.0)
    with pytest.raises(NotRealizable, match="dead position"):
        arm.inverse({"x(forearm.end)": "0.5 + 0.6*t", "y(forearm.end)": 0}, every[:2], until=1)
    for wrong, said in ((["motor"], "there is no force `motor`"), (["shoulder motor"] * 2, "share a parameter")):
        with pytest.raises(ValueError, match=said):
            arm.inverse("rest", wrong).evaluate("t", 0.0)


def test_a_recorded_motion_takes_what_its_law_takes(tmp_path):
    """The spline through a law at 400 times has its places exactly, and its accelerations to the square of the step."""
    arm, laws = fb.Mechanism.loads(ARM), {"q1": "0.3 + sin(2*t)^3", "q2": "1 - cos(3*t)"}
    t = np.linspace(0, 1, 401)
    q1, q2 = 0.3 + np.sin(2 * t) ** 3, 1 - np.cos(3 * t)
    rows = [f"{a!r},{b!r},{c!r}" for a, b, c in zip((1000 * t).tolist(), q1.tolist(), np.degrees(q2).tolist(), strict=True)]
    (tmp_path / "log.csv").write_text("\n".join(["t [ms],shoulder,elbow [deg]", *rows]))
    given = {"q1": recorded(tmp_path / "log.csv", "shoulder"), "q2": recorded(tmp_path / "log.csv", "elbow")}
    found, known = arm.inverse(given), arm.inverse(laws, until=1)
    assert found.run.edges[-1] == pytest.approx(1) and found.evaluate("q2", 0.5) == pytest.approx(1 - np.cos(1.5), abs=1e-12)
    assert found.evaluate("accel(q1)", found.run.edges[-1]) == pytest.approx(0, abs=1)  # no step where the table ends
    inside = np.linspace(0.2, 0.8, 7)
    for motor in ("'motion of q1'.force", "'motion of q2'.force"):
        assert found.evaluate(motor, inside) == pytest.approx(known.evaluate(motor, inside), abs=2e-3)
    with pytest.raises(ModelProblem, match="no column `elbo`"):
        recorded(tmp_path / "log.csv", "elbo")


def test_what_the_motion_gives_a_rate_of_starts_where_the_model_starts():
    """The shoulder is put where its law begins; the elbow, whose speed is given, stays."""
    run = fb.Mechanism.loads(ARM).inverse({"q1": "1 + t", "q2": steady("2 rad/s")}, until=0.2).run
    assert [run.evaluate(q, 0.0) for q in ("q1", "q2")] == pytest.approx([1.0, 0.8], abs=1e-13)
    hand = fb.Mechanism.loads(ARM).inverse({"x(forearm.end)": 0.3, "q2": steady(1)}, until=0.2).run
    assert [hand.evaluate(q, 0.0) for q in ("x(forearm.end)", "q2")] == pytest.approx([0.3, 0.8], abs=1e-12)


def test_the_least_torques_stay_within_their_limits_where_they_can():
    """Statics: hips of weight m g l/2; a third motor takes what a limit leaves."""
    arm = fb.Mechanism.loads(ARM)
    every, x = ["shoulder motor", "elbow motor", "cable motor"], [0.25 * np.cos(0.3), 0.5 * np.cos(0.3), 0.2 * np.cos(1.1)]
    sums = 9.81 * np.array([2 * x[0] + x[1] + x[2], x[2]])  # what the shoulder and cable, and the elbow and cable, give together
    free = arm.inverse("rest", every, least=True)
    forces = free.found(0.0).forces
    assert forces[[0, 1]] + forces[2] == pytest.approx(sums, rel=1e-12)
    assert forces @ [1, 1, -1] == pytest.approx(0, abs=1e-12)  # no part along what is free
    held = arm.inverse("rest", every, least=True, limits={"shoulder motor": "5 N*m"})
    assert held.found(0.0).forces == pytest.approx([5, sums[1] - sums[0] + 5, sums[0] - 5], rel=1e-9)
    assert not held.beyond
    alone = arm.inverse("rest", every[:2], limits={"shoulder motor": 9})
    assert alone.beyond == {"shoulder motor": [(0.0, 1.0)]}


def test_a_pendulum_that_turns_steadily():
    """T = m g l/2 cos(ωt), pin force m (a + g) at the centre, shaking force its opposite; the work of a turn is 0."""
    m, length, w = 2.0, 0.6, 5.0
    model = fb.Mechanism("pendulum")
    model.rod("bar", length=length, mass=m)
    model.hinge("ground.O", "bar.start", name="pin", coordinate="a")
    found = model.inverse({"a": steady(f"{w} rad/s")}, until=2 * np.pi / w)
    torque = found.summary("'motion of a'.force")
    most = m * 9.81 * length / 2
    assert [torque.greatest.value, torque.least.value, torque.rms] == pytest.approx([most, -most, most / np.sqrt(2)], rel=1e-10)
    assert torque.least.angle == pytest.approx(np.pi, abs=1e-7)
    assert [place.angle for place in torque.zeros] == pytest.approx([np.pi / 2, 3 * np.pi / 2], rel=1e-9)
    assert found.work("motion of a") == 0
    t = np.linspace(0.1, 1.2, 9)
    x, y, moment = found.values(list(found.shaking), t).T
    inwards = m * w**2 * length / 2
    assert x == pytest.approx(inwards * np.cos(w * t), abs=1e-8)
    assert y == pytest.approx(inwards * np.sin(w * t) - m * 9.81, abs=1e-8)
    assert moment == pytest.approx(-most * np.cos(w * t), abs=1e-8)
    assert found.evaluate("pin.Fx", t) == pytest.approx(-x, abs=1e-12)
    along, across = found.values(found.pin_load("pin", "bar"), t).T  # in the axes of the bar its weight turns
    assert along == pytest.approx(m * 9.81 * np.sin(w * t) - inwards, abs=1e-8)
    assert across == pytest.approx(m * 9.81 * np.cos(w * t), abs=1e-8)
    assert found.run.unit_of("hypot(pin.Fx, pin.Fy)") == "N" and found.run.unit_of("pin.Fx*sin(a)/2") == "N"


def test_a_pendulum_that_speeds_up_shakes_its_ground_by_its_motor():
    """T = (m l²/3) α + m g l/2 cos a by the motor, whose couple on the ground is the whole moment there about the pin."""
    model = fb.Mechanism("pendulum")
    model.rod("bar", length=0.6, mass=2)
    model.hinge("ground.O", "bar.start", coordinate="a")
    found = model.inverse({"a": "1.5*t^2"}, until=1)
    t = np.linspace(0.1, 0.9, 5)
    torque = 2 * 0.6**2 / 3 * 3 + 2 * 9.81 * 0.3 * np.cos(1.5 * t**2)
    assert found.evaluate("'motion of a'.force", t) == pytest.approx(torque, rel=1e-10)
    assert found.values(list(found.shaking), t)[:, 2] == pytest.approx(-torque, rel=1e-10)


@pytest.mark.parametrize("law", ["max(0, t)", "if(t < 0, 0, t)", "abs(t)", "min(t, 9)"])
def test_a_law_that_switches_just_at_the_start_is_on_the_side_to_which_it_goes(law):
    model = fb.Mechanism("pendulum", gravity="none")
    model.rod("bar", length=1, mass=1)
    model.hinge("ground.O", "bar.start", coordinate="a")
    model.motion("drive", "a", law)
    assert model.simulate(1).evaluate("a", 0.7) == pytest.approx(0.7, rel=1e-12)


HIP = """
freebody: 1
bodies: {trunk: {shape: rod, length: 0.5, mass: 2}, left: {shape: rod, length: 0.4, mass: 1}, right: {shape: rod, length: 0.4, mass: 1}}
joints:
  neck: {type: hinge, of: [ground.O, trunk.end], coordinate: a}
  hip: {type: hinge, of: [trunk.start, left.start, right.start]}
initial: {a: -0.4, hip.left.angle: 0.3, hip.right.angle: -0.2, at_rest: true}
"""


def test_coordinates_of_a_pin_of_three_bodies_have_their_names_everywhere():
    """What keeps a leg at rest carries its weight beside the hip: −m g l/2 cos of its angle from the x axis."""
    model = fb.Mechanism.loads(HIP)
    found = model.inverse("rest")
    for leg, angle in (("left", -0.1), ("right", -0.6)):
        assert found.evaluate(f"hip.{leg}.angle", 0.5) == pytest.approx(angle + 0.4, abs=1e-12)
        assert found.evaluate(f"'motion of hip {leg} angle'.force", 0.0) == pytest.approx(9.81 * 0.2 * np.cos(angle), rel=1e-12)
    with pytest.raises(fb.ModelFileError, match=r"`hip\.angle`"):
        model.simulate(until=0.1, **{"hip.angle": 0})

"""What a lock holds is shown like what a joint holds: in tables, in the largest reactions, in impulses, in free bodies."""

from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import freebody as fb
from freebody.run.peaks import peak_reactions
from freebody.views import plots

G = 9.81
PARTICLE = """
freebody: 1
bodies: {{b: {{shape: particle, mass: {mass} kg}}}}
initial: {{b.x: 0 m, b.y: 0 m, rates: {{b.x: {speed} m/s}}}}
events: {{hold: {{at: {when}, then: {{lock: [b.x, b.y]}}}}}}
run: {{until: 1 s}}
"""
ROD = """
freebody: 1
bodies: {rod: {shape: rod, length: 2 m, mass: 3 kg, points: {A: start}}}
joints: {pivot: {type: hinge, of: [ground.O, rod.A], coordinate: theta}}
initial: {theta: 0, rates: {theta: 0.5 rad/s}}
events: {hold: {at: start, then: {lock: theta}}, go: {at: 0.5 s, then: {unlock: theta}}}
run: {until: 0.6 s}
"""


def model(path: Path, text: str) -> fb.Mechanism:
    file = path / "model.yaml"
    file.write_text(text)
    return fb.load(file)


@pytest.mark.parametrize("mass", [0.1, 1.0, 7.0])
def test_a_particle_is_held_by_its_weight(tmp_path: Path, mass: float) -> None:
    m = model(tmp_path, PARTICLE.format(mass=mass, speed=0, when="start"))
    run = m.simulate()
    held = run.instant(0.5)
    assert_allclose([held.locks["lock b.x"], held.locks["lock b.y"]], [0, mass * G], atol=1e-12)
    assert held.free_bodies().bodies["b"].a == (0.0, 0.0)
    peaks = {peak.joint: peak for peak in peak_reactions(run)}
    assert_allclose(peaks["lock b.y"].size, mass * G)
    assert m.solve(before="start").locks == {} and m.solve().locks == pytest.approx(held.locks)
    assert_allclose(run["'lock b.y'.force"], mass * G)


@pytest.mark.parametrize("saved", ["run.nc", "run.csv"])
def test_what_a_prescribed_motion_needs_is_among_the_largest_reactions(tmp_path: Path, saved: str) -> None:
    """A rod held level by a motor: the moment of its weight, M g l/2; also of a run from a file."""
    motor = ROD.partition("initial:")[0] + "motions: {motor: {of: theta, is: 0}}\nrun: {until: 0.6 s}\n"
    run = model(tmp_path, motor).simulate()
    for each in (run, fb.Run.load(run.save(tmp_path / saved))):
        [peak] = [peak for peak in peak_reactions(each) if peak.joint == "motor"]
        assert peak.size is None and peak.body == ""
        assert_allclose(peak.couple, 3 * G)
        [curve] = plots.reactions(each, "motor", part="M").lines[:1]
        assert curve.get_label() == "motor.force"
        assert_allclose(curve.get_ydata(), 3 * G)


def test_a_report_names_the_force_of_a_lock(tmp_path: Path) -> None:
    """About the pivot the couple is the moment of the weight, M g l/2; the one along twice the angle is half of it."""
    work = model(tmp_path, ROD + "report: {work: \"'lock theta'.work\"}\n").simulate().report["work"]
    assert (work.value, work.unit) == (0, "J")
    twice = ROD.replace("{unlock: theta}", "stop").replace("lock: theta", "lock: 2*theta")
    half = model(tmp_path, twice + "report: {held: \"'lock 2*theta'.force\"}\n").simulate().report["held"]
    assert_allclose(half.value, 3 * G / 2)
    assert half.unit == "N*m"


@pytest.mark.parametrize(("mass", "speed"), [(1.0, 2.0), (0.5, -3.0)])
def test_the_impulse_of_a_lock_takes_the_momentum(tmp_path: Path, mass: float, speed: float) -> None:
    run = model(tmp_path, PARTICLE.format(mass=mass, speed=speed, when="0.3 s")).simulate()
    [impact] = [change for change in run.changes if change.impulses]
    assert_allclose([impact.impulses.locks["lock b.x"], impact.impulses.locks["lock b.y"]], [-mass * speed, mass * G * 0.3])
    assert_allclose(impact.impulses.sizes["lock b.x"], abs(mass * speed))
    assert_allclose(impact.lost, mass * (speed**2 + (G * 0.3) ** 2) / 2)


def test_a_locked_angle_passes_a_couple_until_it_is_unlocked(tmp_path: Path) -> None:
    """About the pivot the couple is the moment of the weight, M g l/2; its impulse the angular momentum, M l²/3 ω."""
    m = model(tmp_path, ROD)
    run = m.simulate()
    assert_allclose(run.instant(0.2).locks["lock theta"], 3 * G)
    assert run.instant(0.55).locks == {}
    [impact] = [change for change in run.changes if change.impulses]
    assert_allclose(impact.impulses.locks["lock theta"], -3 * 4 / 3 * 0.5)
    [peak] = [peak for peak in peak_reactions(run) if peak.joint == "lock theta"]
    assert_allclose(peak.couple, 3 * G)
    assert peak.size is None
    load = next(load for load in run.instant(0.2).free_bodies().loads if load.kind == "lock")
    assert load.card.couple
    assert_allclose(load.unit(["rod"]), [0, 0, 1], atol=1e-12)
    assert np.isclose(load.value, 3 * G)


def test_the_command_line_tells_what_locks_hold(tmp_path: Path) -> None:
    from typer.testing import CliRunner

    from freebody.cli import app

    model(tmp_path, PARTICLE.format(mass=1, speed=0, when="start"))
    file = str(tmp_path / "model.yaml")
    for command in (["solve", file], ["run", file, "--no-report"]):
        stated = CliRunner().invoke(app, command).output
        assert "b.y" in stated and "9.81" in stated.replace("-9.81", "")


AT_ITS_STOP = """
freebody: 1
gravity: none
parameters: {e: 0.4, a: 0.7 m, v: 1 m/s, angle: 0.6}
ground: {points: {C: [0, -0.2 m]}, lines: {floor: {through: C, angle: 0}}}
bodies: {ball: {shape: particle, mass: 2 kg}}
joints: {free: {type: free, of: [ground.O, ball.centre], coordinates: [x, y]}}
stops: {end: {of: "distance(ground.O, ball.centre)", least: a, restitution: 0.3}}
contacts: {bounce: {of: [ball.centre, ground.floor], restitution: e}}
initial: {x: a*cos(angle), y: a*sin(angle), rates: {x: v*sin(angle), y: -v*cos(angle)}}
events: {hold: {at: start, then: {lock: "distance(ground.O, ball.centre)"}}}
run: {until: 4 s, impacts: newton}
"""


@pytest.mark.parametrize("rtol", [1e-3, 1e-6])
def test_a_lock_holds_between_the_steps_too(tmp_path: Path, rtol: float) -> None:
    """The radius of that ball, with no stop or floor there: locked, released after 2 s and locked again after 3 s."""
    alone = "".join(line for line in AT_ITS_STOP.splitlines(True) if not line.startswith(("stops", "contacts")))
    later = """
  release: {when: t - 2, then: {release: "lock distance(ground.O, ball.centre)"}},
  again: {when: t - 3, then: {lock: "distance(ground.O, ball.centre)"}},
"""
    run = model(tmp_path, alone.replace("{hold", "{" + later + "  hold")).simulate(rtol=rtol)
    distances = np.hypot(run["x"], run["y"])
    assert run.outcome.ok
    assert_allclose(distances[run.t < 2], 0.7, rtol=1e-14)
    # Free for 1 s, at 1 m/s along the tangent.
    assert_allclose(distances[run.t > 3], np.hypot(0.7, 1), rtol=rtol)
    assert np.ptp(distances[run.t > 3]) < 1e-14


@pytest.mark.parametrize("rtol", np.logspace(-5, -13, 9))
def test_a_stop_at_which_a_lock_holds_takes_no_part_in_an_impact(tmp_path: Path, rtol: float) -> None:
    """A ball on a circle, its radius locked at the stop of that radius, meets a floor after a (φ + asin(0.2/0.7))/v."""
    run = model(tmp_path, AT_ITS_STOP).simulate(rtol=rtol)
    [impact] = run.impacts
    assert run.outcome.ok and impact.t == pytest.approx(0.7 * (0.6 + np.arcsin(2 / 7)), abs=10 * rtol)
    assert np.hypot(*(run.at(impact.t)[each] for each in ("rate(x)", "rate(y)"))) == pytest.approx(0.4, abs=1e-9)
    assert_allclose(np.hypot(run["x"], run["y"]), 0.7, rtol=1e-12)

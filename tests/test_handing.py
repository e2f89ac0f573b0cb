"""Motions that go on as another model, and starts that say they are in equilibrium."""

from __future__ import annotations

import numpy as np
import pytest

import freebody as fb

SWING = """\
freebody: 1
name: a rod that lets go
parameters: {m: 2 kg, l: 1 m}
bodies:
  rod: {shape: rod, length: l, mass: m}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: angle}
gauges: {x: x(rod.G), y: y(rod.G)}
initial: {angle: 0, rates: {angle: 6}}
events:
  lets go: {when: angle - 0.5, direction: rising, then: {hand_over: flight.yaml}}
run: {until: 1 s}
"""
FLIGHT = """\
freebody: 1
name: a rod in flight
parameters: {m: 1 kg, l: 3 m, k: 7}
bodies:
  rod: {shape: rod, length: l, mass: m}
joints:
  free: {type: free, of: [ground.O, rod.G], coordinates: [x, y, angle]}
initial: {x: 100, at_rest: true}
run: {until: 0.5 s}
"""


@pytest.fixture
def swing(tmp_path):
    (tmp_path / "flight.yaml").write_text(FLIGHT)
    (tmp_path / "swing.yaml").write_text(SWING)
    return tmp_path / "swing.yaml"


def test_place_rates_and_parameters_go_over(swing):
    run = fb.load(swing).simulate(rtol=1e-11)
    flight = run.next
    assert (run.outcome.name, flight.outcome.name, flight.next) == ("StoppedByEvent", "Completed", None)
    begun, angle, rate = flight.start, float(run.end.q[0]), float(run.end.u[0])
    assert (begun.t, flight.t[-1], flight.settings.rtol) == (run.t[-1], 1.0, 1e-11)
    assert begun.p.tolist() == [2.0, 1.0, 7.0]
    assert begun.q == pytest.approx([0.5 * np.cos(angle), 0.5 * np.sin(angle), 0.5])
    assert begun.u == pytest.approx([-0.5 * np.sin(angle) * rate, 0.5 * np.cos(angle) * rate, rate])
    # A free rod keeps its spin, and its mass centre falls.
    assert flight["rate(angle)"] == pytest.approx(np.full(len(flight.t), rate))
    assert flight["vy(rod.G)"][-1] == pytest.approx(begun.u[1] - 9.81 * (1.0 - begun.t))


def test_the_longer_end_holds(swing):
    (swing.parent / "flight.yaml").write_text(FLIGHT.replace("0.5 s", "3 s"))
    run = fb.load(swing).simulate()
    assert run.next.t[-1] == 3.0


def test_without_the_event_there_is_no_next(swing):
    assert fb.load(swing).simulate(until=0.01).next is None


def test_mechanisms_made_in_python_hand_over_and_are_saved_beside(tmp_path):
    swing, flight = fb.Mechanism.loads(SWING.replace(", then: {hand_over: flight.yaml}", "")), fb.Mechanism.loads(FLIGHT)
    swing.event("goes on", "angle - 0.4", then={"hand_over": flight})
    run = swing.simulate()
    assert run.next.name == "a rod in flight"
    swing.save(tmp_path / "swing.yaml")
    again = fb.load(tmp_path / "swing.yaml")
    assert again == swing and fb.load(tmp_path / "a rod in flight.yaml") == flight
    assert again.simulate().next.end.q == pytest.approx(run.next.end.q, abs=1e-12)


def test_models_can_hand_over_to_and_fro(tmp_path):
    one = "freebody: 1\nbodies: {a: {shape: particle, mass: 1}}\njoints: {j: {type: slot, along: {through: ground.O, angle: 0}, "
    one += "point: a.centre, coordinate: s}}\nforces: {f: {type: force, at: a.centre, x: SIGN}}\n"
    one += "events: {e: {when: s, direction: DIRECTION, then: {hand_over: OTHER}}}\ninitial: {s: 1}\nrun: {until: 6}\n"
    for name, other, sign, direction in (("right", "left", -1, "falling"), ("left", "right", 1, "rising")):
        text = one.replace("OTHER", f"{other}.yaml").replace("SIGN", str(sign)).replace("DIRECTION", direction)
        (tmp_path / f"{name}.yaml").write_text(text)
    run, times = fb.load(tmp_path / "right.yaml").simulate(), []
    while run is not None:
        times.append(run.end.t)
        run = run.next
    # ±1 N on 1 kg from 1 m: a quarter in √2 s, then halves of 2√2 s.
    assert times == pytest.approx([np.sqrt(2), 3 * np.sqrt(2), 6.0])


def test_a_wrong_second_model_is_reported(swing):
    (swing.parent / "flight.yaml").write_text(FLIGHT.replace("length: l", "lenght: l"))
    with pytest.raises(fb.ModelFileError, match=r"flight.yaml:5:\d+: .*`lenght`"):
        fb.load(swing).simulate()


# -- static starts ---------------------------------------------------------------------------------

HANGING = """\
freebody: 1
parameters: {m: 2 kg, k: 50 N/m}
bodies: {block: {mass: m}}
joints: {guide: {type: slider, along: {through: ground.O, angle: -90 deg}, line: {through: block.G, angle: -90 deg}, coordinate: s}}
forces: {spring: {type: spring, along: s, stiffness: k}}
initial: {s: m*9.81/k, equilibrium: true}
run: {until: 0.1 s}
"""


def test_an_equilibrium_is_believed():
    run = fb.Mechanism.loads(HANGING).simulate()
    assert abs(run["s"] - run["s"][0]).max() < 1e-12


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("s: m*9.81/k", "s: 0.1"), "`s` accelerates with"),
        (("equilibrium", "rates: {s: 1}, equilibrium"), "`s` moves with 1 m/s"),
    ],
)
def test_no_equilibrium_is_said_by_name(change, words):
    with pytest.raises(fb.ModelFileError, match=words) as caught:
        fb.Mechanism.loads(HANGING.replace(*change)).simulate()
    assert caught.value.problems[0].where.path == "initial.equilibrium"


def test_other_starts_are_not_held_to_it():
    assert fb.Mechanism.loads(HANGING).simulate(initial={"s": 0}).outcome.ok


# -- laws of impacts -------------------------------------------------------------------------------


@pytest.mark.parametrize("setting", [{"impacts": "newtn"}, {"painleve": "never"}])
def test_an_unknown_law_is_reported(setting):
    with pytest.raises(ValueError, match=next(iter(setting.values()))):
        fb.Mechanism.loads(HANGING).simulate(**setting)


def test_known_laws_are_taken():
    m = fb.Mechanism.loads(HANGING)
    m.run_settings(impacts="poisson")
    run = m.simulate(painleve="impact")
    assert (run.settings.impacts, run.settings.painleve) == ("poisson", "impact")

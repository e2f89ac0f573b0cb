"""The independent routes, checked against one another: a check is only as good as its source."""

import cmath
import math

import numpy as np
import pytest

from freebody import catalogue
from freebody.catalogue import reference
from freebody.systems._linkages import CrankSlider, FourBar, cross, dot


def test_motion_and_event_of_a_swing():
    def rates(t, y):
        return [y[1], -y[0]]

    assert reference.motion(rates, [1, 0], [1, 3])[:, 0] == pytest.approx(np.cos([1, 3]), rel=1e-12)
    t, y = reference.event(rates, [1, 0], lambda t, y: y[0] - 0.5, before=4)
    assert t == pytest.approx(math.pi / 3, rel=1e-13)
    assert y[1] == pytest.approx(-math.sin(t), rel=1e-12)


def test_motion_stops_at_kinks():
    """ẍ = −sign x: pieces of parabolas with kinks where x = 0."""

    def rates(t, y):
        return [y[1], -np.sign(y[0])]

    start, period = [0.5, 0.0], 4.0  # four falls of 1 s from 1/2
    assert reference.motion(rates, start, [period, 2 * period], kink=lambda t, y: y[0])[:, 0] == pytest.approx(0.5, rel=1e-11)


def test_many_digits():
    import mpmath as mp

    with mp.workdps(40):
        (state,) = reference.many_digits(lambda t, y: [y[1], -mp.sin(y[0])], [2, 0], [5.0], digits=30, step=0.05)
        (coarse,) = reference.many_digits(lambda t, y: [y[1], -mp.sin(y[0])], [2, 0], [5.0], digits=30, step=0.1)
        assert abs(state[0] - coarse[0]) < mp.mpf("1e-16")
        energy = state[1] ** 2 / 2 - mp.cos(state[0]) + mp.cos(2)
        assert abs(energy) < mp.mpf("1e-22")


@pytest.mark.parametrize("side", [1, -1])
def test_four_bar_by_hand(side):
    """Moments of AB about its centre and virtual power were not used for the forces."""
    bars = FourBar(0.3, 0.7, 0.6, 0.8, (0.8, 1.5, 1.1), side, 9.81)
    m = bars.motion(2.6, -3.0, 5.0)
    torque, a, b, _, d = bars.forces(m)
    assert torque == pytest.approx(bars.torque_by_power(m), rel=1e-12)
    tip = bars.l1 * cmath.exp(2.6j)
    assert torque - cross(tip / 2, a) - cross(tip / 2, b) == pytest.approx(0.8 * 0.3**2 / 12 * 5.0, rel=1e-10)
    assert bars.free(2.6, -3.0, torque) == pytest.approx(5.0, rel=1e-12)
    assert abs(a + d - sum(k * (x + 9.81j) for k, x in zip(bars.masses, m.acceleration, strict=True))) < 1e-12


def test_crank_slider_by_hand():
    machine = CrankSlider(0.1, 0.3, (1, 2, 1.5))
    m = machine.motion(1.0, 20.0, 7.0)
    torque = machine.forces(m)[0]
    inertia = (1 * 0.1**2 / 12, 2 * 0.3**2 / 12, 0)
    rows = zip(machine.masses, inertia, m.acceleration, m.velocity, m.turning, m.rate, strict=True)
    assert torque * 20 == pytest.approx(sum(k * dot(a + 9.81j, v) + i * t * w for k, i, a, v, t, w in rows), rel=1e-12)


def test_car_by_hand():
    """The road's force was found from the wheel; the momentum of the whole must agree."""
    (car,) = (s for s in catalogue.systems() if s.id == "GEN-CAR")
    q = car._module()
    theta, rate = q.START, 80.0
    turning = q.acceleration(theta, rate)
    engine = q.Engine(theta)
    rod = engine.rod[1].real * turning + engine.rod[2].real * rate**2
    assert q.forces(theta, rate, turning)["road"] == pytest.approx(q.WHOLE * q.KAPPA * turning + q.ROD * rod + 150, rel=1e-10)
    step = 1e-5
    slopes = [
        (getattr(q.Engine(theta + step), n)[0] - getattr(q.Engine(theta - step), n)[0]) / 2 / step
        for n in ("psi", "piston", "rod")
    ]
    assert slopes == pytest.approx([engine.psi[1], engine.piston[1], engine.rod[1]], rel=1e-8)

"""Equilibria, their stability and modes, response, gains and curves along a parameter: against closed forms and independent runs."""

from math import hypot, pi, sqrt

import numpy as np
import pytest
import store
from scipy.special import jn_zeros
from store import every

import freebody as fb
from freebody.stability.answers import NoEquilibrium
from freebody.stability.modes import gains, response
from freebody.stability.state_space import state_space

G = 9.81
FULL_TURN = ("-10 deg", "200 deg")


def test_a_double_pendulum_has_four_equilibria_of_which_one_is_stable():
    """det(K − ω² M) = 0 with M = [4/3, 1/2; 1/2, 1/3] m l² and K = diag(3/2, 1/2) m g l; a bar that stands up turns its sign in K, one
    of two the sign of the coupling in M."""
    found = store.mechanism("19.3.28/model").stability(bounds={"phi1": FULL_TURN, "phi2": FULL_TURN})
    places = [tuple(round(x / pi) for x in rest.coordinates.values()) for rest in found]
    assert places == [(0, 0), (0, 1), (1, 0), (1, 1)]
    assert [rest.stability for rest in found] == ["stable", "unstable", "unstable", "unstable"]
    for rest, (up1, up2) in zip(found, places, strict=True):
        m, k = np.array([[4 / 3, (-1) ** (up1 + up2) / 2], [(-1) ** (up1 + up2) / 2, 1 / 3]]), np.diag([1.5, 0.5]) * G
        squares = np.linalg.eigvals(np.linalg.solve(m, k * [(-1) ** up1, (-1) ** up2])).real
        stated = sorted(mode.eigenvalue.real**2 - mode.eigenvalue.imag**2 for mode in rest.modes if mode.eigenvalue.real >= 0)
        assert stated == pytest.approx(sorted(-squares), rel=1e-10)


def test_an_equilibrium_holds_by_static_forces():
    """Both hinges of a hanging double pendulum carry what hangs on them."""
    (rest,) = store.mechanism("19.3.28/model").stability(phi1="20 deg", phi2="-10 deg")
    assert [rest.instant.reactions[name].values[1] for name in ("ceiling", "elbow")] == pytest.approx([2 * G, G], rel=1e-12)


def test_none_within_bounds_is_said():
    with pytest.raises(NoEquilibrium, match=r"phi1 from 0\.5 to 1 rad"):
        store.mechanism("19.3.28/model").stability(bounds={"phi1": (0.5, 1.0), "phi2": (0.5, 1.0)})


OSCILLATOR = """
freebody: 1
parameters: {m: 2 kg, k: 50 N/m, c: 4 N*s/m, F: 0 N, w: 1 1/s}
gravity: none
bodies: {cart: {shape: particle, mass: m}}
joints: {rail: {type: slot, along: {through: ground.O, angle: 0}, point: cart.centre, coordinate: x}}
forces:
  spring: {type: spring, along: x, stiffness: k, damping: c}
  push: {type: force, at: cart.centre, x: F}
initial: {x: 0}
"""


def test_an_oscillator_has_its_frequency_damping_and_response():
    """λ = −c/2m ± i √(k/m − (c/2m)²); x = F/(k − m ω² + i c ω), and its acceleration is −ω² x."""
    m, k, c = 2.0, 50.0, 4.0
    (rest,) = fb.Mechanism.loads(OSCILLATOR).stability(inputs=["F"], outputs=["x", "accel(x)"])
    (mode,) = rest.modes
    assert mode.eigenvalue == pytest.approx(-c / (2 * m) + 1j * sqrt(k / m - (c / (2 * m)) ** 2), rel=1e-13)
    assert mode.damping == pytest.approx(c / (2 * sqrt(k * m)), rel=1e-13)
    frequencies = np.array([0.1, 0.7, 3.0])
    w = 2 * pi * frequencies
    x = 1 / (k - m * w**2 + 1j * c * w)
    np.testing.assert_allclose(response(rest.space, frequencies)[:, :, 0], np.stack([x, -(w**2) * x], axis=1), rtol=1e-12)
    closed = np.linalg.eigvals(rest.space.a + rest.space.b @ gains(rest.space, [-3, -4]))
    np.testing.assert_allclose(np.sort(closed.real), [-4, -3], rtol=1e-10)


HOOP = """
freebody: 1
parameters: {R: 1 m, m: 1 kg, g: 9.81 m/s^2, w: 1 rad/s}
gravity: [0, -g]
bodies: {bead: {shape: particle, mass: m}}
joints: {hoop: {type: link, of: [ground.O, bead.centre], length: R, coordinate: {name: theta, zero: down}}}
forces: {spin: {type: force, at: bead.centre, x: m*w^2*x(bead.centre)}}
initial: {theta: 0}
"""


def test_a_bead_on_a_turning_hoop_leaves_the_bottom_at_a_pitchfork():
    """At ω² = g/R; beyond it cos θ = g/(ω² R) is stable, and the bottom no longer."""
    bottom, side = fb.Mechanism.loads(HOOP).equilibria_along("w", ("1 rad/s", "6 rad/s"))
    for curve in (bottom, side):
        (special,) = curve.special
        assert (special.kind, special.value) == ("branch point", pytest.approx(sqrt(G), rel=1e-9))
    assert [rest.stability for rest in bottom.equilibria] == ["stable" if w < sqrt(G) else "unstable" for w in bottom.values]
    for w, rest in zip(side.values, side.equilibria, strict=True):
        if w > 1.001 * sqrt(G):
            assert rest.stability == "stable"
            assert np.cos(rest.coordinates["theta"]) == pytest.approx(G / w**2, rel=1e-9)
    assert side.values[[0, -1]] == pytest.approx([6, 6], rel=1e-9)


TRUSS = """
freebody: 1
parameters: {b: 1 m, h: 0.4 m, k: 100 N/m, F: 0 N}
gravity: none
ground: {points: {A: [-b, 0]}}
bodies: {node: {shape: particle, mass: 1 kg}}
joints: {guide: {type: slot, along: {through: ground.O, angle: 90 deg}, point: node.centre, coordinate: y}}
forces:
  bar: {type: spring, between: [ground.A, node.centre], stiffness: k, rest_length: sqrt(b^2 + h^2)}
  load: {type: force, at: node.centre, y: -F}
initial: {y: h}
"""


def test_a_shallow_truss_snaps_through_at_its_folds():
    """F = k y (L/√(b² + y²) − 1) has its extremes at b² + y² = (L b²)^(2/3)."""
    (curve,) = fb.Mechanism.loads(TRUSS).equilibria_along("F", (-3, 3))
    length = hypot(1.0, 0.4)
    y = sqrt(length ** (2 / 3) - 1)
    greatest = 100 * y * (length / hypot(1, y) - 1)
    assert [each.kind for each in curve.special] == ["fold", "fold"]
    assert sorted(each.value for each in curve.special) == pytest.approx([-greatest, greatest], rel=1e-10)
    assert sorted(each.state.q[0] for each in curve.special) == pytest.approx([-y, y], rel=1e-7)
    for force, rest in zip(curve.values, curve.equilibria, strict=True):
        place = rest.coordinates["y"]
        assert 100 * place * (length / hypot(1, place) - 1) == pytest.approx(force, abs=1e-8)
        assert abs(abs(place) - y) < 1e-6 or (rest.stability == "stable") == (abs(place) > y)


CHAIN = """
freebody: 1
parameters: {{N: {n}, l: 1/{n}}}
bodies: {{'link[i = 1 .. N]': {{shape: rod, length: l, mass: 1/N}}}}
joints:
  pin[1]: {{type: hinge, of: [ground.O, 'link[1].start'], coordinate: {{name: 'phi[1]', zero: down}}}}
  pin[i = 2 .. N]: {{type: hinge, of: ['link[i-1].end', 'link[i].start'], coordinate: {{name: 'phi[i]', absolute: true, zero: down}}}}
initial: {{at_rest: true}}
"""
"""A chain of 1 m that hangs."""


@every([str(n) for n in range(2, 101)], "links", share=25)
def test_a_hanging_chain_approaches_the_rope_with_the_square_of_its_links(links):
    """A hanging rope has ω = ½ j √(g/L), j the zeros of J₀ (D. Bernoulli, 1733). Of the frequencies of n and 2n links the
    error of n is three times and a third their difference, but for terms of order four."""
    n = int(links)

    def ratios(n):
        model = fb.Mechanism.loads(CHAIN.format(n=n))
        space = state_space(model.source(), model.start()[0])
        squares = np.sort(-np.linalg.eigvals(space.a[n:, :n]).real)
        k = min(n, 3)
        return np.sqrt(squares[:k]) / (jn_zeros(0, k) / 2 * sqrt(G))

    coarse, fine = ratios(n), ratios(2 * n)[: min(n, 3)]
    order = np.log2((coarse - 1) / (fine - 1))
    waves = jn_zeros(0, 3)[: len(order)] / n
    assert (np.abs(order - 2) < 0.35 * np.minimum(waves, 1) + 1e-3).all()
    assert (np.abs((4 * fine - coarse) / 3 - 1) < 0.1 * waves**4 + 1e-11).all()


def test_a_start_at_which_nothing_holds_a_perturbation_and_one_that_is_far_off_come_to_rest():
    """A level bar of a double pendulum, whose weight has no slope there; a drum many times its unbalance away: it hangs in two springs
    at 45°, which together have the stiffness of one."""
    (rest,) = store.mechanism("19.3.28/model").stability()
    assert [np.sin(x) for x in rest.coordinates.values()] == pytest.approx([0, 0], abs=1e-9)
    (rest,) = store.mechanism("GEN-SUSP/washer").stability(x="3 cm", y="-3 cm")
    assert rest.coordinates == pytest.approx({"x": 0, "y": -40.5 * 9.81 / 4000, "theta": 0}, abs=1e-9)

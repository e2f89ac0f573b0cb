"""Normal forces along curves: `Fn` is that along the normal of the curve at the contact, to the left as its parameter grows."""

import math

import numpy as np
import pytest

import freebody as fb

G = 9.81

RING = """
freebody: 1
parameters: {r: 0.5 m, m: 2 kg}
gravity: 9.81
bodies: {bead: {shape: particle, mass: m}}
ground: {curves: {ring: {x: r*cos(s), y: WAY*r*sin(s)}}}
joints: {j: {type: curved_slot, along: ground.ring, point: bead.centre, coordinate: {name: phi, zero: 40 deg, sense: SENSE}}}
"""


@pytest.mark.parametrize("sense", ["forward", "backward"])
@pytest.mark.parametrize("way", [1, -1])
def test_a_ring_bears_a_bead_along_its_radius(way, sense):
    """Inwards m v²/r less what gravity has inwards: to the left where the ring is written counter-clockwise."""
    m = fb.Mechanism.loads(RING.replace("WAY", str(way)).replace("SENSE", sense))
    rng = np.random.default_rng(5)
    for _ in range(20):
        phi, rate, r, mass = rng.uniform(-3, 3), rng.uniform(-4, 4), rng.uniform(0.1, 3), rng.uniform(0.5, 5)
        m.parameters.update(r=r, m=mass)
        now = m.solve(phi=phi, rates={"phi": rate})
        height = way * math.sin(math.radians(40) + (phi if sense == "forward" else -phi))
        inwards = mass * (r * rate**2 - G * height)
        assert now["j.Fn"] == pytest.approx(way * inwards, rel=1e-9, abs=1e-9)
        assert now["j.Fs"] == pytest.approx(0, abs=1e-9 * abs(inwards) + 1e-12)
        (load,) = (load for load in now.free_bodies().loads if load.symbol == "j.Fn")
        assert load.value == pytest.approx(now["j.Fn"], rel=1e-12)


CAM = """
freebody: 1
parameters: {e: 10 mm, r: 30 mm, rr: 8 mm, n: 40 rad/s, t0: 0, k: 2000 N/m}
gravity: 9.81
bodies:
  cam: {mass: 0.5 kg, inertia: 2e-4 kg*m^2, curves: {profile: {x: e + r*cos(s), y: -r*sin(s)}}}
  follower: {shape: rod, length: 100 mm, mass: 0.1 kg}
joints:
  shaft: {type: hinge, of: [ground.O, cam.origin], coordinate: theta}
  guide: {type: slider, along: {through: ground.O, angle: 90 deg}, line: [follower.start, follower.end], coordinate: y}
  touch: {type: cam, along: cam.profile, follower: {centre: follower.start, radius: rr}}
forces: {spring: {type: spring, along: y, stiffness: k, rest_length: 20 mm}}
motions: {motor: {of: theta, is: t0 + n*t}}
initial: {theta: t0, guess: {y: 40 mm, touch.s: t0 - pi/2}}
"""


def test_an_eccentric_presses_its_follower_along_the_line_of_centres():
    """y = e sin θ + √(L² − e² cos²θ), L = r + rr; what presses is inclined to the guide by sin φ = e cos θ/L and has the part
    m (ÿ + g) + k (y − y₀) along it."""
    m, rng = fb.Mechanism.loads(CAM), np.random.default_rng(6)
    for _ in range(20):
        theta, n = rng.uniform(-3, 3), rng.uniform(-60, 60)
        m.parameters.update(t0=theta, n=n)
        now = m.solve()
        e, length, sin, cos = 0.01, 0.038, math.sin(theta), math.cos(theta)
        root = math.sqrt(length**2 - (e * cos) ** 2)
        below = e**2 * sin * cos / root  # d root/dθ
        y = e * sin + root
        accel = n**2 * (-e * sin + (e**2 * (cos**2 - sin**2) - below**2) / root)
        push = (0.1 * (accel + G) + 2000 * (y - 0.02)) / (root / length)
        assert now["y"] == pytest.approx(y, rel=1e-9)
        assert now["touch.Fn"] == pytest.approx(push, rel=1e-8)
        assert now["touch.Fs"] == pytest.approx(0, abs=1e-9 * push)


GUN = """
freebody: 1
parameters: {mu: 0.2}
gravity: 9.81
bodies:
  cart: {mass: 100 kg, lines: {axle: {through: origin, angle: 0}}, points: {C: [0, 3.2]}, curves: {tube: {arc: {centre: C, radius: 1.2 m}}}}
  ball: {shape: particle, mass: 5 kg}
ground: {lines: {road: {through: O, angle: 0}}}
joints:
  wheels: {type: slider, along: ground.road, line: cart.axle, coordinate: X}
  tube: {type: curved_slot, along: cart.tube, point: ball.centre, coordinate: {name: phi, zero: 180 deg}, friction: mu}
initial: {X: 0, phi: 0.3, rates: {X: 0.5, phi: 2}}
"""
RELEASE = "events: {exit: {when: phi - 90 deg, then: {release: tube}}}\n"


@pytest.mark.parametrize("mu", [0, 0.2])
def test_what_can_be_released_bears_the_loads_of_what_stays(mu):
    """The same loads on the same bodies, with the same sizes, as long as the release is not used."""
    stays, leaves = (fb.Mechanism.loads(text) for text in (GUN, GUN + RELEASE))
    found = []
    for m in (stays, leaves):
        m.parameters.update(mu=mu)
        loads = m.solve().free_bodies().loads
        found.append({load.symbol: (load.of, [part.body for part in load.on], load.acting({"ball"})) for load in loads})
    assert found[0].keys() == found[1].keys()
    for symbol, (of, on, acting) in found[0].items():
        assert found[1][symbol][:2] == (of, on)
        assert found[1][symbol][2] == pytest.approx(acting, rel=1e-9, abs=1e-9)

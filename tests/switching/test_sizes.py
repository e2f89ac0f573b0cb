"""Of a mechanism made larger, heavier or slower the motion is the same: lengths, masses and times are judged by its own.

Each number below is one of lengths L, masses M and times T. Where these are powers of two no digit of the motion may change, so
nothing in it can be measured by a metre, a kilogram or a second.
"""

from __future__ import annotations

import math

import numpy as np
from seen import changes, model
from store import every

import freebody as fb

PENDULUM = """
bodies: {rod: {shape: rod, length: L, mass: M}}
joints: {pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
stops: {stop: {of: theta, least: -2.2, most: 0.3, restitution: 0.6}}
initial: {theta: -0.4, at_rest: true}
"""
FOUR_BAR = """
ground: {points: {D: [1.2*L, 0]}}
bodies:
  crank: {shape: rod, length: 0.4*L, mass: M}
  coupler: {shape: rod, length: 0.6*L, mass: M}
  rocker: {shape: rod, length: 1.1*L, mass: M}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, coupler.start]}
  D: {type: hinge, of: [ground.D, rocker.start], coordinate: phi}
  C: {type: hinge, of: [coupler.end, rocker.end]}
initial: {theta: 90 deg, guess: {phi: 130 deg}, rates: {theta: 0.7/T}}
"""
STRING = """
bodies: {bob: {shape: particle, mass: M}}
strings: {string: {ends: [ground.O, bob.centre], length: L, restitution: 0.3}}
initial: {bob.x: 0.3*L, bob.y: -0.2*L, rates: {bob.x: 0.9*L/T, bob.y: 1.4*L/T}}
"""
WOUND = """
ground: {points: {eye: [0.5*L, 0.8*L]}}
bodies: {bob: {shape: particle, mass: M}, drum: {shape: disk, radius: 0.2*L, mass: 2*M}}
joints: {axle: {type: hinge, of: [ground.O, drum.centre], coordinate: turn}}
strings: {string: {ends: [{drum: drum.centre, radius: 0.2*L, sense: ccw, wound: L}, bob.centre], over: [ground.eye]}}
initial: {turn: 0, bob.x: 0.9*L, bob.y: 0.1*L, rates: {turn: -0.4/T, bob.x: 0.5*L/T, bob.y: 0.2*L/T}}
"""
BOX = """
ground: {lines: {floor: {through: O, angle: 0.1}}}
bodies: {box: {shape: rectangle, width: L, height: 0.6*L, mass: M}}
contacts: {floor: {of: [box, ground.floor], restitution: 0.3, friction: 0.4, static_friction: 0.5}}
initial: {box.x: 0, box.y: 1.2*L, box.angle: 0.4, rates: {box.x: 1.5*L/T, box.angle: -2/T}}
"""
BELT = """
bodies: {block: {shape: rectangle, width: 0.4*L, height: 0.2*L, mass: M}, belt: {shape: rod, length: L, mass: M}}
ground: {points: {P: [-L, 0], Q: [L, 0]}}
joints: {guide: {type: slider, along: [ground.P, ground.Q], line: [belt.start, belt.end], coordinate: s}}
motions: {drive: {of: s, is: 0.1*L/T*t}}
forces: {spring: {type: spring, along: block.x, stiffness: 3*M/T^2}}
contacts: {grip: {of: [block, [belt.start, belt.end]], friction: 0.2, static_friction: 0.4}}
initial: {block.x: 0, block.y: 0.1*L, s: 0, rates: {block.x: 0.1*L/T}}
"""
BALL = """
bodies: {ball: {shape: disk, radius: 0.1*L, mass: M}}
contacts: {floor: {of: [ball, [ground.O, ground.Q]], restitution: 0.6, friction: 0.2}}
ground: {points: {Q: [L, 0]}}
initial: {ball.x: 0, ball.y: L, rates: {ball.x: 0.5*L/T, ball.angle: 3/T}}
"""
SLIDER = """
ground: {points: {Q: [L, 0.2*L]}}
bodies: {cart: {shape: rectangle, width: 0.2*L, height: 0.1*L, mass: 2*M, points: {P: [0.1*L, 0]}}, bob: {shape: particle, mass: M}}
joints:
  rail: {type: slider, along: [ground.O, ground.Q], line: [cart.centre, cart.P], coordinate: s, friction: 0.1, static_friction: 0.15}
  arm: {type: polar, of: [cart.P, bob.centre], coordinates: [r, a]}
forces: {spring: {type: spring, between: [cart.P, bob.centre], stiffness: 20*M/T^2, rest_length: 0.5*L}}
stops: {ends: {of: s, least: -0.3*L, most: 0.4*L, restitution: 0.5}}
initial: {s: 0, r: 0.6*L, a: -1, rates: {s: 0.2*L/T, a: 0.1/T}}
"""
PILE = """
ground: {points: {Q: [L, 0]}}
bodies:
  a: {shape: rectangle, width: L, height: 0.5*L, mass: M}
  b: {shape: rectangle, width: 0.8*L, height: 0.4*L, mass: 0.5*M}
  c: {shape: disk, radius: 0.2*L, mass: 0.3*M}
contacts:
  floor: {of: [a, [ground.O, ground.Q]], friction: 0.5}
  on: {of: [b, a], friction: 0.4, restitution: 0.2}
  top: {of: [c, b], friction: 0.3, restitution: 0.4}
  side: {of: [c, a], friction: 0.3, restitution: 0.4}
  low: {of: [c, [ground.O, ground.Q]], friction: 0.3}
  far: {of: [b, [ground.O, ground.Q]], friction: 0.3}
initial: {a.x: 0, a.y: 0.25*L, b.x: 0.3*L, b.y: 0.9*L, b.angle: 0.1, c.x: 0.35*L, c.y: 1.5*L}
"""
SOFT = """
ground: {points: {Q: [L, 0]}}
bodies: {box: {shape: rectangle, width: L, height: 0.6*L, mass: M}}
contacts: {floor: {of: [box, [ground.O, ground.Q]], friction: 0.4, stiffness: 900*M/T^2, damping: 3*M/T}}
initial: {box.x: 0, box.y: 0.8*L, box.angle: 0.2, rates: {box.x: L/T}}
"""
BEAD = """
ground: {points: {C: [0, L]}, curves: {ring: {arc: {centre: C, radius: L}}}}
bodies: {bead: {shape: particle, mass: M}}
joints: {track: {type: curved_slot, along: ground.ring, point: bead.centre, coordinate: s, friction: 0.1}}
events: {off: {when: s - 1.75*pi, direction: rising, then: {release: track}}}
initial: {s: pi, at_rest: true}
"""
BEARING = """
bodies: {rod: {shape: rod, length: L, mass: M}, end: {shape: rod, length: 0.5*L, mass: 0.5*M}}
joints:
  pivot: {type: hinge, of: [ground.O, rod.start], coordinate: theta, friction: 0.3, bearing_radius: 0.1*L}
  elbow: {type: hinge, of: [rod.end, end.start], coordinate: beta, friction: 0.2, bearing_radius: 0.05*L}
initial: {theta: 0.1, beta: 0.5, rates: {beta: 1/T}}
"""
GRAIN = """
ground: {points: {Q: [L, 0]}}
bodies: {grain: {shape: particle, mass: M}}
contacts: {floor: {of: [grain, [ground.O, ground.Q]], restitution: 0.6, friction: 0.3}}
initial: {grain.x: 0, grain.y: L, rates: {grain.x: L/T}}
"""
CHUTE = """
ground: {points: {A: [-L, L], B: [2*L, 0]}, curves: {slope: [{line: [A, B]}], bowl: {x: s*L, y: 0.5*s^2*L}}}
bodies:
  sled: {shape: rectangle, width: 0.4*L, height: 0.1*L, mass: 3*M, points: {P: [0.1*L, 0]}}
  bead: {shape: particle, mass: M}
joints:
  runner: {type: curved_slot, along: ground.slope, point: sled.P, coordinate: way}
  track: {type: curved_slot, along: ground.bowl, point: bead.centre, coordinate: r, friction: 0.05}
events: {off: {when: way - 2*L, direction: rising, then: {release: runner}}}
initial: {way: 0.1*L, sled.angle: 0.7, r: -0.8, rates: {way: L/T, sled.angle: 2/T, r: 0.1/T}}
"""
CRANK = """
bodies:
  crank: {shape: rod, length: 0.3*L, mass: M}
  rod: {shape: rod, length: L, mass: M}
  piston: {shape: rectangle, width: 0.2*L, height: 0.1*L, mass: M, points: {P: [0.1*L, 0]}}
ground: {points: {Q: [L, 0]}}
joints:
  A: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start]}
  C: {type: hinge, of: [rod.end, piston.centre]}
  bore: {type: slider, along: [ground.O, ground.Q], line: [piston.centre, piston.P], coordinate: x, friction: 0.1}
forces: {load: {type: spring, along: x, stiffness: 2*M/T^2}}
initial: {theta: 0.4, rates: {theta: 1/T}, guess: {x: 1.2*L}}
"""
WHEELS = """
ground: {lines: {slope: {through: O, angle: -0.2}}, points: {hub: [0, 2*L]}}
bodies:
  wheel: {shape: disk, radius: 0.3*L, mass: M}
  a: {shape: disk, radius: 0.2*L, mass: M}
  b: {shape: disk, radius: 0.4*L, mass: 2*M}
joints:
  roll: {type: rolling, on: ground.slope, circle: {centre: wheel.centre, radius: 0.3*L}, coordinate: way}
  ha: {type: hinge, of: [ground.hub, a.centre], coordinate: alpha}
  hb: {type: hinge, of: [a.centre, b.centre], coordinate: beta}
initial: {way: 0, alpha: 0, beta: 0, rates: {alpha: 1/T}}
forces: {brake: {type: torque, on: b, from: a, value: -0.1*M*L^2/T*rate(beta)}}
"""
FLOATING = """
gravity: none
bodies: {a: {shape: particle, mass: M}, b: {shape: particle, mass: 2*M}}
forces: {spring: {type: spring, between: [a.centre, b.centre], stiffness: 3*M/T^2, rest_length: 0.5*L}}
initial: {a.x: 0, a.y: 0, b.x: L, b.y: 0, at_rest: true}
"""
THROW = """
bodies: {a: {shape: particle, mass: M}}
initial: {a.x: 0, a.y: 0, rates: {a.x: L/T}}
"""
MODELS = {name: text for name, text in list(globals().items()) if name.isupper() and isinstance(text, str)}


LARGER = [(4.0**k, 1.0, 2.0**k) for k in (-15, -10, -5, 5, 10)]
OTHERWISE = [(1.0, 2.0**-60, 1.0), (1.0, 2.0**66, 1.0), (1.0, 1.0, 2.0**-15), (1.0, 1.0, 2.0**20), (4.0**-15, 2.0**-40, 2.0**10)]

UNEVEN = [(length, 1.0, 1.0) for length in (1e-9, 1e-6, 1e-3, 1e3, 1e6)]  # m, m/s², kg
UNEVEN += [(1.0, gravity, 1.0) for gravity in (1e-12, 1e-6, 1e-3, 1e3, 1e6, 1e9)]
UNEVEN += [(1.0, 1.0, mass) for mass in (1e-18, 1e-9, 1e9, 1e20)] + [(1e-9, 1e9, 1e-18), (1e6, 1e-12, 1e20)]


def run(text: str, scales: tuple[float, float, float]) -> fb.Run:
    """The motion in 6 T, under the gravity L/T² unless there is none."""
    length, mass, time = scales
    gravity = "" if "gravity:" in text else "gravity: [0, -L/T^2]\n"
    text = "parameters: {L: 1 m, M: 1 kg, T: 1 s}\n" + gravity + text
    return model(text, L=length, M=mass, T=time).simulate(until=6 * time, every=0.1 * time)


def seen(run: fb.Run, scales: tuple[float, float, float]) -> tuple[list[tuple], np.ndarray, np.ndarray]:
    """How it ended and what happened; when, in T; coordinates and rates at the output times, in L and T."""
    length, _, time = scales
    happened = [(run.outcome.name, ()), *((change.kind, tuple(change.of)) for change in changes(run))]
    when = [run.t[-1], *(change.t for change in changes(run))]
    units = [length if c["dimension"] == "m" or c["name"] == "way" else 1.0 for c in run.metadata["coordinates"]]
    times = np.linspace(0, 1, 50) * run.t[-1]
    q, u = run.motion.sample(times)
    return happened, np.array(when) / time, np.hstack([q / units, u / units * time])


@every(MODELS, "name", share=2)
def test_no_digit_of_a_motion_depends_on_the_units(name):
    """From 1e-9 m to 1e6 m under one gravity, with time as √L; and with other masses and times by themselves."""
    known = seen(run(MODELS[name], (1, 1, 1)), (1, 1, 1))
    for scales in LARGER + OTHERWISE:
        happened, when, motion = seen(run(MODELS[name], scales), scales)
        assert happened == known[0], scales
        assert (when == known[1]).all(), scales
        # Speeds that fall without end reach numbers that lose digits.
        np.testing.assert_allclose(motion, known[2], rtol=0, atol=1e-300, err_msg=str(scales))


@every(MODELS, "name", share=2)
def test_a_motion_is_the_same_at_every_size_gravity_and_mass(name):
    """As above, where the sizes are no powers of two: within some hundred times the tolerance 1e-9."""
    known = seen(run(MODELS[name], (1, 1, 1)), (1, 1, 1))
    for length, gravity, mass in UNEVEN:
        scales = (length, mass, math.sqrt(length / gravity))
        happened, when, motion = seen(run(MODELS[name], scales), scales)
        assert happened == known[0], scales
        np.testing.assert_allclose(when, known[1], rtol=1e-7, err_msg=str(scales))
        np.testing.assert_allclose(motion, known[2], rtol=1e-6, atol=1e-6, err_msg=str(scales))


def test_what_lands_where_all_is_counted_from_balances_there() -> None:
    """Before and after a particle lands at the origin on a cart that is there, in a model without a length but that of its inertia."""
    m = model("""
gravity: 9.81 m/s^2
ground: {lines: {rail: {through: O, angle: 0}}}
bodies: {cart: {mass: 19.6 kg, inertia: 2 kg*m^2, lines: {deck: {through: origin, angle: 0}}}, parcel: {shape: particle, mass: 7.3 kg}}
joints:
  rail: {type: slider, along: ground.rail, line: cart.deck, coordinate: X}
  air: {type: free, of: [ground.O, parcel.centre], coordinates: [x, y]}
contacts: {deck: {of: [parcel, cart.deck], friction: 0.3}}
initial: {X: 0, x: -0.4 m, y: 0.36 m, rates: {x: 3 m/s, y: -1.5 m/s, X: 0}}
run: {until: 1 s}
""")
    x, y, fall = 3.0, -1.5, (math.hypot(1.5, math.sqrt(2 * 9.81 * 0.36)) - 1.5) / 9.81
    m.initial(X=0, x=-x * fall, y=0.36, rates={"x": x, "y": y, "X": 0})
    for moment in ({"before": "deck"}, {"after": "deck"}):
        assert m.solve(**moment).residual < 1e-12  # of their largest term, which is a weight

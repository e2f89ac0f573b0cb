"""Random control laws: the conditions that are printed hold exactly where the core's own accelerations have stable eigenvalues,
whatever the signs of all gains are, and do not depend on what stands in the file."""

from dataclasses import replace

import numpy as np
import sympy
from differences import first_order
from store import every

import freebody as fb
from freebody.equations import to_sympy
from freebody.equations.topics import topic

CART = """
freebody: 1
name: a rod on a cart, driven by laws with gains
parameters: {PARAMETERS}
gravity: g
bodies: {cart: {mass: M}, bob: {shape: rod, length: l, mass: m}}
joints:
  rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: s}
  pin: {type: hinge, of: [cart.origin, bob.start], coordinate: {name: theta, zero: ZERO}}
forces: {FORCES}
motions: {MOTIONS}
initial: {s: 0, theta: 0, at_rest: true}
"""
SHAPE = {"M": ("kg", 2.0), "m": ("kg", 1.0), "l": ("m", 1.2), "k": ("N/m", 12.0), "c": ("N*s/m", 2.0), "g": ("m/s^2", 9.81)}
"""Parameters, their units, and their values in SI; c may have any sign."""
LAWS = {
    "hand": ("motion", {"theta": "m/s^2", "rate(theta)": "m/s", "s": "1/s^2", "rate(s)": "1/s"}),
    "held": ("motion at zero", {}),
    "push": ("force on s", {"theta": "N", "rate(theta)": "N*s", "s": "N/m", "rate(s)": "N*s/m"}),
    "motor": ("torque", {"theta": "N*m", "rate(theta)": "N*m*s", "s": "N", "rate(s)": "N*s"}),
}
"""What drives, and the units of its gains."""
POINTS, NEAR = 60, 1e-3


def model(rng: np.random.Generator) -> tuple[str, dict[str, float]]:
    """A model, and its gains with their values in the file."""
    kind, terms = LAWS[rng.choice(list(LAWS))]
    count = int(rng.integers(1, 3)) if terms else 0
    law = {f"K{i}": term for i, term in enumerate(rng.permutation(list(terms))[:count].tolist())}
    gains = {name: round(float(rng.uniform(-9, 9)), 2) for name in law}
    value = " + ".join(f"{name}*{term}" for name, term in law.items())
    forces = {"spring": "{type: spring, along: s, stiffness: k, damping: c}"} if rng.random() < 0.6 and kind != "motion" else {}
    motions = {}
    if kind == "motion":
        motions["hand"] = f"{{of: s, is: {value}, level: acceleration}}"
    elif kind == "motion at zero":
        motions["hand"], forces = "{of: s, is: 0 m, level: position}", {}
        forces["motor"] = "{type: torque, on: bob, value: K0*theta + K1*rate(theta)}"
        gains, law = {"K0": float(rng.uniform(-9, 9)), "K1": float(rng.uniform(-9, 9))}, {"K0": "theta", "K1": "rate(theta)"}
        terms = LAWS["motor"][1]
    else:
        forces["law"] = (
            f"{{type: law, along: s, value: {value}}}" if kind == "force on s" else f"{{type: torque, on: bob, value: {value}}}"
        )
    units = {name: (terms[term], gains[name]) for name, term in law.items()}
    used = {name: each for name, each in SHAPE.items() if name not in "kc" or "spring" in forces}
    parameters = ", ".join(f'{name}: "{value!r} {unit}"' for name, (unit, value) in (used | units).items())
    parts = (", ".join(f"{name}: {each}" for name, each in of.items()) for of in (forces, motions))
    text = CART.replace("PARAMETERS", parameters).replace("ZERO", str(rng.choice(["up", "down"])))
    for word, part in zip(("FORCES", "MOTIONS"), parts, strict=True):
        text = text.replace(word, part)
    return text, gains | ({"c": 2.0} if "spring" in forces else {})


@every(map(str, range(40)), "seed", share=20)
def test_conditions_hold_exactly_where_eigenvalues_say_so(seed):
    """At random values of gains, masses and lengths, not close to the border; the gains of the file are among them."""
    rng = np.random.default_rng(int(seed))
    text, gains = model(rng)
    mechanism = fb.Mechanism.loads(text)
    found, source = topic(mechanism, "linear"), mechanism.source()
    assert found.stability is not None
    names = [each["name"] for each in source.metadata["parameters"]]
    values, judged = dict(zip(names, found.rest.p.tolist(), strict=True)), 0
    for _ in range(POINTS):
        at = {name: float(rng.uniform(-9, 9)) if name in gains else x * rng.uniform(0.4, 2) for name, x in values.items()}
        roots = np.linalg.eigvals(first_order(source, replace(found.rest, p=source.bind(at)), found.equations.coordinates))
        numbers = {sympy.Symbol(name): value for name, value in at.items()}
        conditions = [float(to_sympy(each).subs(numbers)) for each in found.stability.conditions]
        size = np.abs(roots).max()
        moving = [root for root in roots if abs(root) > NEAR * size]
        worst = max(root.real for root in moving) / size
        damped = found.stability.kind != "oscillates"
        if len(moving) < len(roots) - 2 or (damped and abs(worst) < NEAR):
            continue
        judged += 1
        holds = not found.stability.never and all(each > 0 for each in conditions)
        assert holds == (worst < (0 if damped else NEAR)), (at, conditions, roots)
    assert judged > POINTS / 2


def test_what_is_a_gain_is_no_length_and_no_stiffness():
    """Of a law F = −k x − c ẋ, k and c stay conditions; the stiffness of a spring is positive."""
    text = """
freebody: 1
name: a cart
parameters: {M: 2 kg, k: 5 N/m, c: 1 N*s/m}
bodies: {cart: {mass: M}}
joints: {rail: {type: slider, along: {through: ground.O, angle: 0}, line: {through: cart.origin, angle: 0}, coordinate: x}}
forces: {FORCES}
initial: {x: 0, at_rest: true}
"""
    law = topic(fb.Mechanism.loads(text.replace("FORCES", "law: {type: law, along: x, value: -k*x - c*rate(x)}")), "linear")
    spring = topic(
        fb.Mechanism.loads(text.replace("FORCES", "spring: {type: spring, along: x, stiffness: k, damping: c}")), "linear"
    )
    assert {str(to_sympy(each)) for each in law.stability.conditions} == {"k", "c"}
    assert {str(to_sympy(each)) for each in spring.stability.conditions} == {"c"}

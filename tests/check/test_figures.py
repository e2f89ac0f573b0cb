"""Figures of runs, printed to two to five digits: right ones are true, and those that are off by one in the last digit are wrong."""

from __future__ import annotations

import random
from decimal import Decimal
from itertools import cycle, islice

import pytest

from freebody.check import Checker, Kind
from freebody.mechanism import Mechanism

_MODELS = {
    "a bob on a spring": """
freebody: 1
parameters: {m: 1.3 kg, k: 800 N/m, l0: 0.7 m}
bodies: {bob: {shape: particle, mass: m}}
joints: {place: {type: free, of: [ground.O, bob.centre], coordinates: [x, y]}}
forces: {spring: {type: spring, between: [ground.O, bob.centre], stiffness: k, rest_length: l0}}
initial: {x: 0.9 m, y: 0, rates: {x: 0, y: 2}}
run: {until: 3 s}
""",
    "a double pendulum": """
freebody: 1
parameters: {l: 0.8 m, m: 1.3 kg}
bodies: {upper: {shape: rod, length: l, mass: m}, lower: {shape: rod, length: l, mass: m}}
joints:
  A: {type: hinge, of: [ground.O, upper.start], coordinate: theta}
  B: {type: hinge, of: [upper.end, lower.start], coordinate: phi}
initial: {theta: -0.3, phi: 0.4, rates: {theta: 1, phi: 0}}
run: {until: 2 s}
""",
    "a slider-crank with a motor": """
freebody: 1
parameters: {r: 0.12 m, l: 0.37 m, m: 0.9 kg, M: 2.3 N*m, c: 1.7 N*s/m}
bodies:
  crank: {shape: rod, length: r, mass: m}
  rod: {shape: rod, length: l, mass: m}
  piston: {shape: particle, mass: 1.4 kg}
joints:
  O: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: phi}
  C: {type: hinge, of: [rod.end, piston.centre]}
  guide: {type: slot, along: {through: ground.O, angle: 0}, point: piston.centre, coordinate: x}
forces:
  motor: {type: torque, on: crank, from: ground, value: M}
  drag: {type: damper, along: x, damping: c}
initial: {theta: 0.7, guess: {phi: -0.9, x: 0.4}, rates: {theta: 3}}
run: {until: 1.5 s}
""",
    "a wheel that rolls down, with a block on a rope and a spring": """
freebody: 1
parameters: {R: 0.31 m, m: 2.2 kg, k: 61 N/m, M: 0.8 kg}
ground: {lines: {slope: {through: ground.O, angle: -20 deg}}, points: {A: [1.3, 0.4]}}
bodies: {wheel: {shape: disk, radius: R, mass: m}, bob: {shape: particle, mass: M}}
joints:
  roll: {type: rolling, on: ground.slope, circle: {centre: wheel.centre, radius: R}, coordinate: s}
  place: {type: link, of: [wheel.centre, bob.centre], length: 0.45 m, coordinate: psi}
forces: {spring: {type: spring, between: [ground.A, bob.centre], stiffness: k, rest_length: 0.5 m}}
initial: {s: 0.2 m, psi: -1.1, rates: {s: 0.4, psi: 1.2}}
run: {until: 2 s}
""",
}
_FIGURES = 200 // len(_MODELS)  # of each model
_SCALES = (1, 10, 1000)
_READ = ("{}", "rate({})", "accel({})")


def _printed(value: float, digits: int) -> str:
    """So many significant digits; with a power of ten where these end before the units."""
    mantissa, power = f"{value:.{digits - 1}e}".split("e")
    return f"{Decimal(f'{mantissa}e{power}'):f}" if -3 < int(power) < digits else f"{mantissa}e{int(power)}"


def _next(figure: str, step: int) -> str:
    """One more, or one less, in the last digit."""
    mantissa, e, power = figure.partition("e")
    number = Decimal(mantissa)
    return f"{number + step * Decimal(1).scaleb(number.as_tuple().exponent):f}{e}{power}"


def _is_ambiguous(figure: str) -> bool:
    """8290 has three significant digits or four."""
    return figure.isdecimal() and len(figure) > 3 and figure.endswith("0")


@pytest.mark.parametrize("name", _MODELS)
def test_a_printed_figure_is_true_to_its_last_digit(name: str) -> None:
    rng, mechanism = random.Random(5), Mechanism.loads(_MODELS[name])
    checker = Checker(mechanism)
    run, undecided = mechanism.simulate(rtol=1e-13), 0  # the check judges by a run of its own, at the model's tolerance
    _, end = checker.happens.moment("end")
    for scale in islice(cycle(_SCALES), _FIGURES):
        t, reading = round(rng.uniform(0.05, end), 3), rng.choice(_READ).format(rng.choice(checker.sampler.names))
        figure = _printed(scale * float(run.evaluate(reading, t)), rng.randint(2, 5))
        for step in (0, 1, -1):
            stated = _next(figure, step)
            if _is_ambiguous(stated.lstrip("-")):
                continue
            verdict = checker.check(f"at {t} s: {scale}*{reading} = {stated}")
            if verdict.kind is Kind.UNDECIDABLE:
                undecided += 1
                continue
            assert (verdict.kind is Kind.TRUE) == (step == 0), f"{stated} for {figure}: {verdict}"
            if step:
                assert [edit[2] for mend in verdict.mends for edit in mend.edits] == [figure.lstrip("-")]
    assert undecided <= 3, "only where an acceleration passes through 0 it is not known to so many digits"


def test_a_figure_of_which_no_digit_holds_is_not_decided() -> None:
    text = (
        _MODELS["a double pendulum"].replace("theta: -0.3, phi: 0.4", "theta: -0.7, phi: 3").replace("until: 2 s", "until: 40 s")
    )
    checker = Checker(Mechanism.loads(text + "report: {turned: theta}\n"))
    run, end = checker.happens.moment("end")
    assert run.accuracy.none_from is not None
    for figure in (run.evaluate("theta", end), run.evaluate("theta", end) + 0.1):
        for claim in (f"at end: theta = {figure:.4g}", f"report: turned = {figure:.4g}"):
            assert checker.check(claim).kind is Kind.UNDECIDABLE
    for until, kind in (("1 s", Kind.TRUE), ("40 s", Kind.UNDECIDABLE)):  # the mass does not matter
        assert checker.check(f"same at {until} for m = 1 kg, 3 kg: theta").kind is kind
    energy = run.evaluate("energy()", end)
    assert checker.check(f"at end: E = {energy:.5g} where E = energy()").kind is Kind.TRUE


@pytest.mark.parametrize(
    ("statement", "kind"),
    [
        ("at start: T = 575", Kind.TRUE),
        ("at start: T = 574", Kind.WRONG),
        ("at start: -4.8195 T = -2770", Kind.TRUE),  # 2769.3: three figures are three figures
        ("at start: -4.8195 T = -2780", Kind.WRONG),
        ("at start: T i = 575 i", Kind.TRUE),
        ("at start: T = 5.75e2 N", Kind.TRUE),
        ("at start: T = 6e2 N", Kind.TRUE),
        ("at start: 2 T = 1149 N", Kind.TRUE),
        ("at start: T = 0", Kind.WRONG),
        ("at start: T^2 = 10 T", Kind.WRONG),  # a number beside a symbol is exact
    ],
)
def test_whole_numbers_have_significant_digits_too(statement: str, kind: Kind) -> None:
    model = "freebody: 1\nparameters: {T: 574.6 N}\nbodies: {b: {shape: particle, mass: 1 kg}}\njoints: {j: {type: free, of: [ground.O, b.centre]}}\n"
    assert Checker(Mechanism.loads(model)).check(statement).kind is kind

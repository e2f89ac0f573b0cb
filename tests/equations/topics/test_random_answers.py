"""Random models with friction, rolling, strings and loops: what is printed as solved is what the core solves, or is refused."""

import numpy as np
import pytest
import sympy
from random_models import rough
from store import every

import freebody as fb
from freebody.equations import Singular, TooLarge, to_sympy
from freebody.equations.answers import Answers
from freebody.equations.solve import Unconfirmed
from freebody.equations.velocity_ratios import ratios
from freebody.solve.instant import NOTHING, Instant
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.tree import Sym

AGREE = 1e-9
"""Of the largest acceleration among the terms that balance."""
PATIENCE = 0.1
JAMS = {"inconsistent_constraints", "inconsistent_velocities", "self_locking", "painleve_indeterminate", "painleve_inconsistent"}
"""What a start may be refused for, and be right."""
SHARE = 25


def number(answers: Answers, wanted: str, known: dict[Sym, float]) -> float:
    """An answer by SymPy, of places, rates and parameters alone."""
    values = {to_sympy(x): value for x, value in known.items()}
    for x, tree in answers.named.items():
        values[to_sympy(x)] = to_sympy(tree).subs(values).evalf()
    return float(to_sympy(answers[wanted]).subs(values | {sympy.Symbol("pi"): sympy.pi}).evalf())


def agree(mechanism: fb.Mechanism, instant: Instant, answers: Answers) -> None:
    """Answers are the accelerations of an instant."""
    state, table = instant.state, mechanism.source().symbolic_answers(instant.state, []).symbols
    names = [coordinate["name"] for coordinate in mechanism.source().metadata["coordinates"]]
    known = {Sym(name): entry["value"] for name, entry in table.items()} | {Sym("t"): state.t}
    for dots, values in enumerate((state.q, state.u)):
        known |= {Sym(name, dots): value for name, value in zip(names, values.tolist(), strict=True)}
    true = np.array([instant.accelerations[name] for name in answers.values])
    found = np.array([number(answers, name, known) for name in answers.values])
    assert np.abs(found - true).max() < AGREE * max(instant.sizes[1], np.abs(true).max(), NOTHING)


@every(map(str, range(200)), "seed", share=SHARE)
def test_an_answer_is_what_the_core_solves_or_is_refused(seed, record_property):
    try:
        mechanism = rough(int(seed))
        instant = mechanism.solve()
    except fb.MotionError as error:
        assert error.kind.value in JAMS, error
        pytest.skip(error.kind.value)
    try:
        answers = mechanism.solve_in_letters(patience=PATIENCE)
    except (TooLarge, Singular, Unconfirmed) as error:
        assert str(error)
        record_property("refused", str(error))
        return
    agree(mechanism, instant, answers)


CRANK = """
freebody: 1
name: slider-crank with friction in its guide
parameters: {r: 0.1 m, l: 0.3 m, mu: 0.2, M: 2 kg}
bodies:
  crank: {shape: rod, length: r, mass: 1 kg}
  rod: {shape: rod, length: l, mass: 1.5 kg}
  piston: {mass: M, inertia: 0.01 kg*m^2}
joints:
  O: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  B: {type: hinge, of: [crank.end, rod.start], coordinate: phi}
  C: {type: hinge, of: [rod.end, piston.origin]}
  guide: {type: slider, along: {through: ground.O, angle: 0}, line: {through: piston.origin, angle: 0}, coordinate: x, friction: mu}
initial: {theta: 40 deg, guess: {x: 0.37}, rates: {theta: 3}}
"""


@pytest.mark.long
def test_friction_in_the_guide_of_a_slider_crank_stays_in_the_answer():
    mechanism = fb.Mechanism.loads(CRANK)
    agree(mechanism, mechanism.solve(), mechanism.solve_in_letters(patience=PATIENCE))
    with pytest.raises(TooLarge, match=r"guide\.Fn has power"):
        subject = SymbolicState(mechanism.source(), mechanism.start()[0])
        ratios(subject, lambda tree: tree, "theta")

"""One symbol, one meaning: models whose names are those that freebody would give itself, units, constants and Greek symbols.

In every form of the equations, in generated code and in what the check reads, each name means what the model says."""

from __future__ import annotations

import random
from collections.abc import Iterator
from functools import cache
from types import SimpleNamespace

import numpy as np
from store import every

import freebody as fb
from freebody.check import Checker, Kind
from freebody.document.blocks import Equation, Matrices, Written, is_tree
from freebody.document.document import Document
from freebody.equations import equation_latex
from freebody.equations.derivation.derive import FORMS
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.symbols import folded
from freebody.symbolic.tree import Sym

NAMES = (
    "g", "gravity", "m_rod", "mrod", "I_rod", "m_tip", "mass_rod", "e", "i", "j", "k", "m", "s", "kg", "N", "theta", "θ", "alpha",
    "α", "F_x", "Fx", "F_coil", "a_rod", "r_tip", "x_rod", "phi_rod", "E_k", "L", "H", "lambda_rod", "n_rod", "l", "m1", "m_1",
    "pin_x", "d", "S", "E", "sin", "mass_matrix", "sqrt", "out",
)  # fmt: skip
"""Names that are given elsewhere, and such as read alike."""
SEEDS = every(map(str, range(16)), "seed", share=4)


def named(seed: str) -> str:
    """A rod with a collar on it, sprung and driven; its two coordinates, three parameters and its bodies are named at random."""
    draw = random.Random(int(seed))
    a, b, length, load, stiffness = draw.sample(NAMES, 5)
    rod, tip = draw.choice((("rod", "tip"), ("theta", "1"), ("m", "rod")))
    return f"""
freebody: 1
name: names {seed}
parameters: {{{length}: 0.7 m, {load}: 3 N, {stiffness}: 40 N/m}}
bodies:
  "{rod}": {{shape: rod, length: {length}, mass: 1.5 kg}}
  "{tip}": {{shape: particle, mass: 0.4 kg}}
joints:
  pin: {{type: hinge, of: [ground.O, "{rod}.start"], coordinate: {a}}}
  guide: {{type: slot, along: ["{rod}.start", "{rod}.end"], point: "{tip}.centre", coordinate: {b}}}
forces:
  coil: {{type: spring, along: {b} - 0.2 m, stiffness: {stiffness}}}
  push: {{type: force, at: "{tip}.centre", value: {load}, direction: 0.3}}
initial: {{{a}: 0.4, {b}: 0.3 m, rates: {{{a}: 1.1, {b}: 0.2}}}}
"""


@cache
def model(seed: str) -> fb.Mechanism:
    return fb.Mechanism.loads(named(seed))


def states(mechanism: fb.Mechanism, seed: str) -> Iterator[SimpleNamespace]:
    """Random states with random parameters, and the values of all symbols there as the core has them."""
    rng, core, start = np.random.default_rng(int(seed)), mechanism.compile(), mechanism.start()[0]
    names = [each["name"] for each in mechanism.source().metadata["parameters"]]
    for _ in range(3):
        p = core.bind(dict(zip(names, start.p * rng.uniform(0.6, 1.7, len(names)), strict=True)))
        q, u = start.q + rng.uniform(-0.2, 0.6, len(start.q)), rng.uniform(-2, 2, len(start.u))
        state = type(start)(p, 0.0, q, u)
        yield SimpleNamespace(state=state, subject=SymbolicState(mechanism.source(), state), instant=core.instant(state))


@SEEDS
def test_all_forms_hold_at_other_states_of_the_core(seed: str) -> None:
    mechanism = model(seed)
    residuals = {form: mechanism.equations(form).equations for form in FORMS[:2]}
    for at in states(mechanism, seed):
        values = at.subject.values
        for form, trees in residuals.items():
            assert np.allclose([evaluate(tree, values) for tree in trees], 0, atol=1e-11), form


@SEEDS
def test_generated_code_gives_what_the_core_gives(seed: str) -> None:
    mechanism = model(seed)
    made: dict = {}
    exec(mechanism.code(), made)
    for at in states(mechanism, seed):
        state, table = at.state, at.subject.table
        listed = [each["name"] for each in mechanism.source().metadata["parameters"]]
        known = dict(zip(listed, state.p, strict=True)) | {n: e["value"] for n, e in table.items() if e["kind"] == "number"}
        p = np.array([known[name] for name in made["PARAMETERS"]])
        assert np.allclose(made["accelerations"](state.q, state.u, p), at.instant.accelerations, rtol=1e-11)


@SEEDS
def test_what_is_printed_is_read_back_as_true(seed: str) -> None:
    mechanism = model(seed)
    checker = Checker(mechanism)
    for form in FORMS:
        document = mechanism.equations(form)
        stated = [
            block for block in document.blocks if isinstance(block, Equation) and not isinstance(block.right, Matrices | Written)
        ]
        lines = [Document((Equation(block.left, block.right),), document.letters).text(width=400) for block in stated]
        lines += [
            equation_latex(block.left, block.right, document.letters, room=1e6)
            for block in stated
            if is_tree(block.left) and is_tree(block.right)
        ]
        for line in lines:
            assert checker.check(line, correcting=False).kind is Kind.TRUE, (form, line)


@SEEDS
def test_no_two_symbols_of_a_derivation_read_alike(seed: str) -> None:
    """In text, in plain text and in LaTeX; and every name that is not the usual one is listed where the symbols are."""
    mechanism = model(seed)
    for form in FORMS:
        made = mechanism.equations(form)
        unit = [Sym(name) for name in made.letters]
        for write in (lambda d: d.text(), lambda d: d.text(ascii=True), lambda d: d.latex()):
            read = [folded(write(Document((Equation(symbol, Sym("zero")),), made.letters)).split("=")[0]) for symbol in unit]
            assert len(set(read)) == len(read), read
        shown = " ".join(made.text().split())
        assert all(str(said) in shown for said in made.letters.renamed.values())


def test_the_case_of_the_coordinate_g() -> None:
    """A hinged rod: the moment of its weight is −½ m g l cos of its angle, whatever that is called."""
    text = """
        freebody: 1
        name: a rod whose coordinate is called g
        bodies: {rod: {shape: rod, length: 1 m, mass: 1 kg}}
        joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: g}}
        initial: {g: 0.3, at_rest: true}
    """
    mechanism = fb.Mechanism.loads(text)
    made: dict = {}
    exec(mechanism.code(), made)
    assert np.allclose(made["accelerations"](np.array([0.3]), np.zeros(1)), -1.5 * 9.81 * np.cos(0.3), rtol=1e-14)
    said = "Here g is the coordinate g; gravity is written gravity."
    assert said in mechanism.equations().text() and said in mechanism.code() and said in mechanism.diagram().svg()
    assert mechanism.check("⅓ m_rod g̈ = −½ m_rod gravity cos g").ok
    assert said in str(mechanism.check("⅓ m_rod g̈ = −½ m_rod g cos g"))

"""Every equation that is printed is read back, and true: freebody's own words are those that the check understands."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import pytest
from random_models import drawn
from store import every, family

import freebody as fb
from freebody.catalogue import model_file
from freebody.check import Checker, Kind
from freebody.check.families import ALL
from freebody.core import State
from freebody.document.blocks import Block, Equation, Matrices, MatrixEquation, Written
from freebody.document.document import Document
from freebody.equations.derivation.derive import FORMS
from freebody.equations.topics import NotHere, topic
from freebody.symbolic.errors import StatementError
from freebody.symbolic.symbols import folded

NAMED = (
    "19.3.1/side",  # particles
    "EX-ARM/held",  # prescribed motions with names of two words
    "19.3.16/model",  # one degree of freedom, wheels
    "S19.18/rod_as_body",  # a body without a mass
    "GEN-FOURBAR/model",  # a loop, angles of a joint that closes it
)
WORDS = """
freebody: 1
name: names with blanks, brackets and numbers
parameters: {k: 30 N/m}
bodies:
  upper arm: {shape: rod, length: 0.4 m, mass: 2 kg}
  tip[1]: {shape: particle, mass: 0.5 kg}
joints:
  left shoulder: {type: hinge, of: [ground.O, upper arm.start], coordinate: theta}
  guide[1]: {type: slot, along: [upper arm.start, upper arm.end], point: "tip[1].centre", coordinate: s}
forces:
  coil: {type: spring, along: s - 0.2 m, stiffness: k}
initial: {theta: 0.4, s: 0.3 m, rates: {theta: 1, s: 0.2}}
"""
COLLAR = """
freebody: 1
name: a spring whose length is the coordinate, on one side of its anchor
parameters: {w: 4 rad/s, k: 50 N/m, m: 2 kg, l0: 0.3 m}
gravity: none
bodies: {rod: {shape: rod, length: 1 m, mass: 0}, collar: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, rod.start], coordinate: theta}
  slide: {type: slot, along: [rod.start, rod.end], point: collar.centre, coordinate: r}
motions: {drive: {of: theta, is: w*t}}
forces: {spring: {type: spring, between: [rod.start, collar.centre], stiffness: k, rest_length: l0}}
initial: {r: 0.4 m, rates: {r: 0}}
"""
STRING = """
freebody: 1
name: a string as long as its start makes it, numbers of ten digits, and a time that is no tonne
bodies: {bob: {shape: particle, mass: 0.642}}
joints: {place: {type: free, of: [ground.O, bob.centre], coordinates: [x, y]}}
ground: {points: {A: [0.66, -0.046]}}
strings: {thread: {ends: [ground.A, bob.centre]}}
forces: {wind: {type: force, at: bob.centre, x: "0.103 + 1.746*cos(x*1)", y: "0.24*cos(y*1) + 0.565*cos(2*t)"}}
initial: {x: 0.564, y: -0.843}
"""
LINK = """
freebody: 1
name: a motor on a link without mass, its rate in an angle
parameters: {L: 0.834 m, m: 2 kg}
bodies: {plate: {mass: m, inertia: 0.234, points: {P: [-0.235, 0.434]}, centre: [-0.016, 0.063]}}
joints: {rod: {type: link, of: [ground.O, plate.P], length: L, coordinates: [phi, theta]}}
motions: {drive: {of: phi, is: 0.3 + 0.2*sin(3*t) + 0.7*t}}
initial: {theta: -0.8}
"""
HANGING = """
freebody: 1
name: four bars, each hung with its own end named first
bodies:
  a: {shape: rod, length: 1 m, mass: 1 kg}
  b: {shape: rod, length: 1.3 m, mass: 1 kg}
  c: {shape: rod, length: 0.7 m, mass: 2 kg}
  d: {shape: rod, length: 0.9 m, mass: 1 kg}
joints:
  A: {type: hinge, of: [ground.O, a.start], coordinate: p}
  B: {type: hinge, of: [b.start, a.end], coordinate: q}
  C: {type: hinge, of: [c.start, b.end], coordinate: r}
  D: {type: hinge, of: [d.start, c.end], coordinate: s}
initial: {p: 0.3, q: 0.4, r: 1.2, s: 0.2}
"""
APART = """
freebody: 1
name: a particle on a rod without mass from a crank, and one on a cord from it
parameters: {l: 1.3 m, c: 0.7 m, m: 2 kg}
bodies: {crank: {shape: rod, length: c, mass: m}, A: {shape: particle, mass: m}, B: {shape: particle, mass: m}}
joints:
  O: {type: hinge, of: [ground.O, crank.start], coordinate: theta}
  fa: {type: free, of: [ground.O, A.centre], coordinates: [x_A, y_A]}
  fb: {type: free, of: [ground.O, B.centre], coordinates: [x_B, y_B]}
  bar: {type: link, of: [crank.end, A.centre], length: l}
strings: {cord: {ends: [A.centre, B.centre]}}
initial: {theta: 0.3, x_A: 0.9 m, x_B: 0.9 m, y_B: -1.7 m, guess: {y_A: -1}, rates: {theta: 0, x_A: 0, y_A: 0, x_B: 3, y_B: 0}}
"""
TEXTS = {"apart": APART, "words": WORDS, "collar": COLLAR, "string": STRING, "link": LINK, "hanging": HANGING}


@pytest.fixture(scope="module", params=family([*NAMED, *TEXTS]))
def model(request: pytest.FixtureRequest) -> fb.Mechanism:
    return fb.Mechanism.loads(TEXTS[request.param]) if request.param in TEXTS else fb.Mechanism.load(model_file(request.param))


def _stated(document: Document) -> Iterator[Block]:
    """The equations of a document."""
    for block in document.blocks:
        if isinstance(block, MatrixEquation) or (isinstance(block, Equation) and not _chosen(block)):
            yield replace(block, name="", note="")


def _chosen(block: Equation) -> bool:
    """Whether it only names something: whole matrices by symbols, or a virtual motion, which is free."""
    left, right = block.left, block.right
    return isinstance(left, Written) and (isinstance(right, Written | Matrices) or left.text.startswith("δ"))


def _printed(block: Block, document: Document) -> Iterator[str]:
    alone = Document((block,), document.letters)
    if isinstance(block, Equation):
        yield from (alone.text(), alone.text(ascii=True, width=60))
    yield from (alone.latex(), alone.markdown())


@pytest.mark.parametrize(("form", "long"), [*((form, True) for form in FORMS[:3]), ("minimal", False), ("first-order", False)])
def test_every_printed_equation_is_read_back_as_true(model: fb.Mechanism, form: str, long: bool) -> None:
    checker, document = Checker(model), model.equations(form, long=long)
    lines = list(dict.fromkeys(text for block in _stated(document) for text in _printed(block, document)))
    assert len(lines) > (8 if long else 1) or (not long and "too long to be read" in document.text())
    for line in lines:
        assert checker.check(line).kind is Kind.TRUE, line


LINES = 10
"""Of each random model at each moment, drawn from all that is printed: of all of them at least 2000."""
MATRICES = 1
"""More of them, of equations of matrices: entries that have a name there have one that means nothing else."""
MOMENTS: dict[str, dict[str, float]] = {"start": {}, "later": {"at": 0.1}}
TOPICS = ("lagrange", "mass_centre")
"""Those whose symbols are those of the model; the others give names of their own, of a frame, a particle, a point."""


def _unloaded(mechanism: fb.Mechanism, asked: dict[str, float]) -> bool:
    """Whether something is closed without a load: it is printed as closed, which it need not stay."""
    model = mechanism.model
    names = {*model.contacts, *model.strings, *model.stops}
    return any(load.value == 0 and load.name in names for load in mechanism.free_bodies(**asked).loads)


def _documents(mechanism: fb.Mechanism, state: State, asked: dict[str, float]) -> Iterator[Document]:
    """What a model is derived to, in every form that there is for it."""
    for form in TOPICS:
        with suppress(NotHere, fb.MotionError):
            yield topic(mechanism, form, state)
    for form, long in (*((form, True) for form in FORMS), ("minimal", False)):
        with suppress(fb.MotionError):
            yield mechanism.equations(form, long=long, **asked)


def _alone(document: Document) -> Iterator[str]:
    """Its equations, one by one; a derivative of the energy behind the line that says what that is, a root by its symbol likewise; matrices as they are set in type,
    but those that are too wide for it, whose entries are listed."""
    energy, roots = "", {}
    for block in _stated(document):
        alone = Document((block,), document.letters)
        if isinstance(block, MatrixEquation) and "not listed" not in (line := alone.markdown()):
            yield line
        elif isinstance(block, Equation):
            line = alone.text(width=400)
            energy = energy or line
            before = [root for name, root in roots.items() if re.search(rf"(?<!\w){name}(?!\w)", line)]
            if found := re.match(r"\s*(s[₁-₉]?) = √", line):
                roots[found[1]] = line
            yield "\n".join([*before, *([energy] if "∂" in line else []), line])


@every(map(str, range(120)), "seed", share=30)
@pytest.mark.parametrize("moment", MOMENTS)
def test_what_is_printed_of_a_random_model_is_true(seed: str, moment: str) -> None:
    mechanism, asked, rng = drawn(int(seed)), MOMENTS[moment], random.Random(seed)
    if len(set(map(folded, mechanism.model.bodies))) < len(mechanism.model.bodies):
        pytest.skip("two of its bodies read alike")
    try:
        state = mechanism.solve(**asked).state
    except (fb.MotionError, ValueError) as error:  # it does not start, or does not come there
        pytest.skip(str(error))
    checker = Checker(mechanism, **asked).at_first()  # what is printed is of that mode
    if not checker.sampler.has(ALL):
        assert not mechanism.simulate(state.t + 0.01).outcome.ok, "it moves, and yet no motion was found"
        pytest.skip("no motion goes on from there")
    lines = [line for document in _documents(mechanism, state, asked) for line in _alone(document)]
    matrices = [line for line in lines if line.startswith("$$")]
    for line in [*rng.sample(lines, min(LINES, len(lines))), *rng.sample(matrices, min(MATRICES, len(matrices)))]:
        try:
            verdict = checker.check(line, correcting=False)
            if verdict.kind is Kind.WRONG and _unloaded(mechanism, asked):
                assert checker.check(line).assumption == "at the start", line
                continue
            assert verdict.kind is Kind.TRUE, f"{line}: {verdict}"
        except StatementError as error:
            assert error.what == "the derivative of this is too long", line


def test_a_printed_symbol_does_not_hide_one_of_the_model() -> None:
    model = fb.Mechanism.loads(WORDS.replace("{k: 30 N/m}", "{k: 30 N/m, r_tip: 2 N}"))
    assert Checker(model).check("r_tip = 2 N").kind is not Kind.DIMENSIONS


@pytest.mark.parametrize("form", ["minimal", "brute"])
def test_the_name_of_an_entry_is_none_of_the_model(form: str) -> None:
    mechanism = drawn(5)
    assert "b[1]" in mechanism.solve().accelerations  # printed as b₁, as the first entry of b would be
    lines = [line for line in _alone(mechanism.equations(form, long=True)) if line.startswith("$$")]
    assert lines and all(Checker(mechanism).check(line).kind is Kind.TRUE for line in lines)

"""What stands below a symbolic diagram: the law of every force that is more than a symbol, in the sense of its arrow."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from matplotlib.mathtext import MathTextParser
from store import SYSTEMS, every, mechanism, start

import freebody as fb
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.printers.typeset import latex
from freebody.views.diagram import diagram
from freebody.views.diagram.laws import Laws
from freebody.views.diagram.rows import MARGIN

FORCED = [name for name, path in SYSTEMS.items() if "\nforces:" in path.read_text(encoding="utf-8") and name != "19.3.27/plate"]
"""The friction of a plate is integrated over its area: its arrows have no law."""
COLUMN = 453.0


@cache
def moved(model):
    """Source, a state off the start in all coordinates and rates, so that springs pull and motors turn, and what acts there."""
    source, (state, _) = mechanism(model).source(), start(model)
    rng = np.random.default_rng(3)
    for size in (0.05, 0.0):  # one that closes loops stays where they are closed
        try:
            then = replace(state, q=state.q + size * rng.random(len(state.q)), u=state.u + size * rng.random(len(state.u)))
            return source, then, source.free_bodies(then)
        except fb.MotionError:
            continue
    raise AssertionError(model)


def drawn(source, state, free):
    return [mark.action for cut in diagram(source, state, free).cuts for mark in cut.forces if mark.action.kind == "force"]


@every(FORCED, share=60)
def test_a_law_is_what_acts_along_its_arrow(model):
    """Its symbols put to numbers give the force, or the couple, of the load as data."""
    source, state, free = moved(model)
    laws, subject = Laws(source, state, free), SymbolicState(source, state)
    actions = drawn(source, state, free)
    assert actions
    for action in actions:
        size = laws.size(action)
        [load] = (load for load in free.loads if load.symbol == action.loads[0].symbol)
        x, y, moment = sum((part.wrench(part.point) for part in load.on if part.body == action.body), np.zeros(3))
        if size is not None:
            acts = moment * np.sign(action.couple) if action.turns else np.array([x, y]) @ action.force
            assert evaluate(size, subject.values) == pytest.approx(acts, rel=1e-9, abs=1e-12), action.label
        else:
            assert x and y  # aslant


@every(FORCED, share=60)
@pytest.mark.parametrize("column", [COLUMN, 241.0])
def test_what_is_more_than_a_symbol_is_said_and_can_be_printed(model, column):
    source, state, free = moved(model)
    parser = MathTextParser("path")
    for cut in diagram(source, state, free, column=column).cuts:
        stated = " ".join(cut.laws)
        for mark in cut.forces:
            size = Laws(source, state, free).size(mark.action) if mark.action.kind == "force" else None
            if size is not None:
                assert (f"{mark.action.label} =" in stated) == (latex(size) != mark.action.label)
        for line in cut.laws:
            width, *_ = parser.parse(line, dpi=72)
            assert 0 < width <= 1.7 * (column - 2 * MARGIN)  # at 12 pt of the default font, where notes have 8


def test_a_spring_aslant_is_said_by_its_length():
    m = fb.Mechanism("particle and rod", gravity=0)
    particle, rod = m.particle("a", mass=1), m.rod("b", mass=1, length=2)
    m.free(m.ground.O, particle.centre, coordinates=["x", "y"])
    m.free(m.ground.O, rod.G, coordinates=["X", "Y", "phi"])
    m.spring(name="spring", between=[rod.end, particle.centre], stiffness=2, damping=1, rest_length=3)
    m.initial(x=1, y=2, X=3, Y=5)
    length = r"\overline{b_{\text{end}} a}"
    first, second = m.diagram("a").cuts[0].laws
    assert first == rf"where $F_{{\text{{spring}}}} = 2\,\left({length} - 3\right)$".replace(r"} a}", r"}\,a}")
    assert second == rf"$F_{{\text{{damper}}}} = \frac{{d}}{{dt}}{length}$".replace(r"} a}", r"}\,a}")


def test_nothing_is_said_below_a_diagram_to_scale():
    spring = mechanism("19.3.20/model")
    assert spring.diagram("block").cuts[0].laws == [r"where $F_{\text{spring}} = k\,y$"]
    assert not spring.diagram("block", to_scale=True).cuts[0].laws

"""Points of random models through frames and by chains of bodies: the terms are what vectors of the core's bodies give, of which no
symbol knows anything, and add up to the motion of the point."""

import numpy as np
import pytest
from random_models import drawn
from store import every
from test_random_topics import directions, turned

import freebody as fb
from freebody.catalogue import model_file
from freebody.document.blocks import Equation, Heading, Vector
from freebody.equations import TooLarge, evaluate
from freebody.equations.derivation.directions import axes
from freebody.equations.topics import NotHere, topic
from freebody.solve.perturbed_states import RATES, others
from freebody.solve.symbolic_state import SymbolicState

AGREE = 1e-8
"""Of the largest term."""


def moving(body, place):
    """Place, velocity and acceleration of a place on a body."""
    arm = np.subtract(place, body.G)
    return place, body.v + turned(body.omega, arm), body.a + turned(body.alpha, arm) - body.omega**2 * arm


def told(made, at):
    """Every term in numbers at a state, by its level, name and body; and each along the axes of its body."""

    def pair(trees):
        return np.array([float(evaluate(tree, at.values, at.tables)) for tree in trees])

    return {(t.level, t.name, t.body): (pair(t.arrow.xy), pair(t.own)) for t in made.terms}


def hold(made, at, point):
    """The terms at a state (Goldstein, Classical Mechanics, 4.10), from pin to pin, and their sums."""
    found, bodies = told(made, at), dict.fromkeys(t.body for t in made.terms if t.body)
    pin = next(value for (level, _, body), (value, _) in found.items() if level == "r" and not body)
    largest = max(1.0, *(np.abs(value).max() for value, _ in found.values()))
    for name in bodies:
        body, terms = at.free.bodies[name], {key[:2]: value for key, (value, _) in found.items() if key[2] == name}
        place, v, a = moving(body, pin)
        if name == next(iter(bodies)):
            for level, true in zip("rva", (place, v, a), strict=True):
                origin = next(value for (lev, _, of), (value, _) in found.items() if lev == level and not of)
                assert np.abs(origin - true).max() < AGREE * largest
        arm, seen = terms["r", f"in the frame of {name}"], terms["v", "relative"]
        for (level, word), true in {
            ("v", "transport"): turned(body.omega, arm),
            ("a", "tangential"): turned(body.alpha, arm),
            ("a", "centripetal"): turned(body.omega, turned(body.omega, arm)),
            ("a", "Coriolis"): 2 * turned(body.omega, seen),
        }.items():
            assert np.abs(terms[level, word] - true).max() < AGREE * largest, (name, word)
        c, s = np.cos(body.angle), np.sin(body.angle)
        for (_, word, of), (value, own) in found.items():
            if of == name:
                assert np.abs([[c, -s], [s, c]] @ own - value).max() < AGREE * largest, (name, word)
        pin = pin + arm
    for level, words in {"r": "{0}('{1}')", "v": "v{0}('{1}')", "a": "a{0}('{1}')"}.items():
        true = at.source.evaluate([words.format(axis, point) for axis in "xy"], at.state)
        whole = sum(value for (of, *_), (value, _) in found.items() if of == level)
        assert np.abs(whole - true).max() < AGREE * largest, level


def hold_print(made, at):
    """What is printed of each term, in turning directions and in i and j, is the term."""
    units = directions(made.blocks, at.values) | dict(zip(axes(at.symbols.taken), np.eye(2), strict=False))
    values = {term.written.text: np.array(term.value) for term in made.terms}
    values |= {
        block.left.text: None for block in made.blocks if isinstance(block, Equation) and hasattr(block.left, "text")
    } | values
    prescribed = False
    for block in made.blocks:
        prescribed = block.words == "With what is prescribed" if isinstance(block, Heading) else prescribed
        if isinstance(block, Equation) and isinstance(block.right, Vector) and not prescribed:
            shown = sum((evaluate(t, at.values, at.tables) * units[u] for t, u in block.right.components), np.zeros(2))
            true = values[block.left.text]
            true = made.values[block.left.text[0]] if true is None else true
            assert np.abs(shown - true).max() < AGREE * max(1.0, np.abs(true).max()), block


def look(mechanism: fb.Mechanism, rng: np.random.Generator) -> str:
    """Holds a random point through random frames; the reason where there is nothing to hold."""
    try:
        first = SymbolicState(mechanism.source(), mechanism.solve().state)
        bodies = [*first.free.bodies]
        point = str(rng.choice([name for name, (body, *_) in first.points.items() if body in bodies]))
        frames = (None, str(rng.choice(bodies)), [str(name) for name in rng.permutation(bodies)[:2]])[rng.integers(3)]
        made = topic(mechanism, "frame", first.state, point=point, body=frames)
    except (fb.MotionError, NotHere, TooLarge) as error:
        return str(error)
    hold_print(made, first)
    for at in (first, *(SymbolicState(first.source, state) for state in others(first.source, first.state)[::RATES])):
        hold(made, at, point)
    return ""


@every([str(seed) for seed in range(120)], "seed", share=20)
def test_the_terms_are_those_of_the_bodies_and_add_up_to_the_motion_of_the_point(seed, record_property):
    if refused := look(drawn(int(seed)), np.random.default_rng(int(seed))):
        record_property("refused", refused)


def test_a_point_of_the_frame_itself_is_at_rest_in_it():
    made = fb.load(model_file("S19.17/model")).equations(of="rod.end", frame="rod")
    assert {term.name for term in made.terms if not term.vanishes} == {
        "in the frame of rod",
        "transport",
        "tangential",
        "centripetal",
    }


def test_what_is_not_there_is_named():
    collar = fb.load(model_file("S19.17/model"))
    with pytest.raises(ValueError, match=r"no point is called 'rod\.Z'; there are .*rod\.A"):
        collar.equations(of="rod.Z")
    with pytest.raises(ValueError, match="no body is called 'hut'"):
        collar.equations(of="collar.G", frame="hut")
    with pytest.raises(ValueError, match="stays where it is"):
        collar.equations(of="ground.O")
    with pytest.raises(ValueError, match="not for form"):
        collar.equations("brute", of="collar.G")

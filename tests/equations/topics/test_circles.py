"""Nothing that is printed says cos² + sin² of an angle where it could say 1."""

from itertools import combinations
from pathlib import Path

import pytest

import freebody as fb
from freebody.catalogue import model_file
from freebody.equations.derivation.derive import FORMS
from freebody.equations.solve import TooLarge
from freebody.equations.topics import TOPICS, NotHere, topic
from freebody.symbolic.algebra import pythagorean
from freebody.symbolic.tree import Add, Fn, Sym, Tree, add, children, mul, number, power

SOME = ("19.3.10", "19.3.17", "19.3.28", "GEN-FOURBAR", "S19.17", "S19.18")
EXAMPLES = Path(__file__).parents[3] / "examples"
COLLIDING = [model_file("19.3.22/latch"), model_file("19.3.30/hinged")]
COLLIDING += [pytest.param(path, marks=pytest.mark.long) for path in (model_file("19.3.30/model"), EXAMPLES / "tossed_box.yaml")]


def trees(part):
    """All expressions in a part of a document."""
    if isinstance(part, Tree):
        yield part
    elif isinstance(part, list | tuple):
        for each in part:
            yield from trees(each)
    elif hasattr(part, "__dataclass_fields__"):
        for name in part.__dataclass_fields__:
            yield from trees(getattr(part, name))


def circles(tree):
    """Sums in which two terms are one times sin² and cos² of an angle."""
    waiting, seen = [tree], set()
    while waiting:
        node = waiting.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        waiting.extend(children(node))
        if isinstance(node, Add) and any(not isinstance(pythagorean(add(*pair)), Add) for pair in combinations(node.terms, 2)):
            yield node


def test_a_circle_is_seen():
    sin, cos = (power(Fn(name, (Sym("a"),)), 2) for name in ("sin", "cos"))
    assert list(circles(mul(Sym("m"), add(mul(number(2), sin), Sym("b"), mul(number(2), cos)))))
    assert not list(circles(add(mul(number(2), sin), mul(number(3), cos))))


@pytest.mark.parametrize("name", SOME)
@pytest.mark.parametrize("kind", [*FORMS, *TOPICS])
def test_no_squares_of_sine_and_cosine_are_added(name, kind):
    mechanism = fb.load(model_file(f"{name}/model"))
    try:
        made = topic(mechanism, kind) if kind in TOPICS else mechanism.equations(kind)
    except (NotHere, TooLarge) as reason:
        pytest.skip(str(reason))
    assert not [found for tree in trees(list(made.blocks)) for found in circles(tree)]


@pytest.mark.parametrize("path", COLLIDING, ids=lambda path: path.stem)
def test_none_are_added_to_an_impact(path):
    made = topic(fb.load(path), "impact")
    assert not [found for tree in trees(list(made.blocks)) for found in circles(tree)]


def test_the_momentum_of_a_sliding_collar_has_none():
    made = topic(fb.load(EXAMPLES / "new_gun.yaml"), "moment", about="collar.C")
    assert not [found for tree in trees(list(made.blocks)) for found in circles(tree)]

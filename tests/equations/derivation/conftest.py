"""States of the models of the catalogue at random, and what all letters are there."""

from pathlib import Path

import numpy as np
import pytest

import freebody as fb
from freebody import _core
from freebody.equations.derivation.told import Subject
from freebody.equations.tree import Sym
from freebody.instant import State

ROOT = Path(__file__).parents[3]
FILES = sorted([*ROOT.glob("systems/*/*.yaml"), *ROOT.glob("examples/*.yaml")])
FILES = [path for path in FILES if "statements" not in path.stem]
MOVED, FAST = 0.1, 0.7
TRIES = 8


def named(path):
    return str(path.relative_to(ROOT))


def loaded(path):
    mechanism = fb.load(path)
    return mechanism, mechanism.start()[0]


@pytest.fixture(params=FILES, ids=named)
def model(request):
    """A model of the catalogue at its start."""
    mechanism, start = loaded(request.param)
    try:
        mechanism.solve()
    except _core.MotionError:
        pytest.skip("the model has no motion at all")
    return Subject(mechanism.source(), start)


def states(source, start, count=2):
    """The start and states near by, in motion, on closed loops, in which the same loads act."""
    found, rng = [Subject(source, start)], np.random.default_rng(3)
    acting = [load.symbol for load in found[0].free.loads]
    if any(load.component == "tooth force" for load in found[0].free.loads):
        return found  # another flank may carry there
    names = [c["name"] for c in source.about["coordinates"]]
    for attempt in range(TRIES):
        step = MOVED / (attempt + 1)
        guess = dict(zip(names, start.q + step * rng.uniform(-1, 1, len(names)), strict=True))
        rates = dict(zip(names, start.u + FAST * step * rng.uniform(-1, 1, len(names)), strict=True))
        try:
            q, u, _ = source.core.assemble(start.p, start.t, guess=guess, rates={} if len(rates) != freedom(source) else rates)
            subject = Subject(source, State(start.p, start.t, q, u))
            if [load.symbol for load in subject.free.loads] == acting:
                found.append(subject)
        except _core.MotionError:
            continue
        if len(found) > count:
            break
    return found


def freedom(source):
    return source.about["freedom"]["count"]


def numbers(subject):
    """The numbers of all letters, places of bodies among them, as the form with constraints has them."""
    found = dict(subject.values)
    for body in subject.free.bodies.values():
        for k, word in enumerate("xy"):
            pairs = enumerate((body.G, body.v, body.a))
            found |= {Sym(f"{word}_{body.name}", dots): pair[k] for dots, pair in pairs}
        found |= {Sym(f"phi_{body.name}", dots): x for dots, x in enumerate((body.angle, body.omega, body.alpha))}
    return found


def other_parameters(subject):
    """The same mechanism with no parameter as it was, loops closed; None where the same things do not act then."""
    source, start = subject.source, subject.state
    names = [c["name"] for c in source.about["coordinates"]]
    given = zip(source.about["parameters"], start.p, np.random.default_rng(4).uniform(0.05, 0.15, len(start.p)), strict=True)
    p = source.core.bind({each["name"]: float(x) * (1 + part) + part * (x == 0) for each, x, part in given})
    try:
        q, u, _ = source.core.assemble(p, start.t, guess=dict(zip(names, start.q, strict=True)))
        other = Subject(source, State(p, start.t, q, u))
        alike = [load.symbol for load in other.free.loads] == [load.symbol for load in subject.free.loads]
        return other if alike else None
    except _core.MotionError:
        return None

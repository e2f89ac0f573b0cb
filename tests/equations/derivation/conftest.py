"""States of the models of the catalogue at random, and what all letters are there."""

from pathlib import Path

import numpy as np

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


def loaded(path):
    mechanism = fb.load(path)
    return mechanism, mechanism.start()[0]

"""What the tests of derivations evaluate: all symbols at a state, the rate of an expression, other parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from freebody.solve.perturbed_states import Closing, alike
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, Sym, Tree

STEP = 1e-3
"""By how much angles go on, rad, and lengths, m, in the step of a difference: one of fourth order is then good to 1e-11 of what is
smooth, and round-off leaves less than that."""


def numbers(subject: SymbolicState) -> dict[Sym, float]:
    """The numbers of all symbols, places of bodies among them, as the form with constraints has them."""
    found = dict(subject.values)
    for body in subject.free.bodies.values():
        for k, word in enumerate("xy"):
            pairs = enumerate((body.G, body.v, body.a))
            found |= {Sym(f"{word}_{body.name}", dots): pair[k] for dots, pair in pairs}
        found |= {Sym(f"phi_{body.name}", dots): x for dots, x in enumerate((body.angle, body.omega, body.alpha))}
    return found


def rate(tree: Tree, subject: SymbolicState, values: Mapping[Sym, float] | None = None) -> float:
    """d/dt of an expression of coordinates and rates along the true motion; all other symbols, time too, stay as they are."""
    values, names = values or numbers(subject), subject.names
    bodies = subject.free.bodies.values()
    rates = [*(abs(values[Sym(n, 1)]) for n in names), *(abs(body.omega) for body in bodies)]
    changes = [*(abs(values[Sym(n, 2)]) for n in names), *(abs(body.alpha) for body in bodies)]
    h = STEP / max(1.0, *rates, *(change**0.5 for change in changes))

    def at(t: float) -> float:
        moved = {Sym(n): values[Sym(n)] + t * values[Sym(n, 1)] + t * t / 2 * values[Sym(n, 2)] for n in names}
        moved |= {Sym(n, 1): values[Sym(n, 1)] + t * values[Sym(n, 2)] for n in names}
        return evaluate(tree, values | moved, subject.tables)

    return (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h)


POWER = 1e-8
"""Of the largest power: a difference of fourth order along the motion leaves 1e-11 of what is smooth."""


def balanced(kinetic: Tree, potential: Tree, subject: SymbolicState) -> tuple[float, float]:
    """Holds the rate of kinetic energy against the power of all loads on all bodies, that of potential energy, turned round, against
    the power of weights and conservative forces. Returns the rate of their sum, and what of it is rounding, W."""
    conservative = {force["name"]: force["conservative"] for force in subject.source.metadata["forces"]}
    bodies, given = subject.free.bodies, []
    for load in subject.free.loads:
        parts = [(part, bodies[part.body]) for part in load.on if part.body in bodies]
        given.append((load, [load.value * np.dot(part.wrench(body.G), (*body.v, body.omega)) for part, body in parts]))
    rounding = POWER * max([1.0, *(abs(x) for _, powers in given for x in powers)])
    elastic = ("spring", "torsion_spring")  # beside a damper, too
    limits = [each for kind in ("contacts", "strings", "stops") for each in subject.source.spec[kind]]
    soft = {
        each["name"] for each in limits if each.get("stiffness") and not each.get("damping")
    }  # what touches on a spring alone
    stored = [x for load, x in given if load.kind == "weight" or (load.name in soft and load.kind != "friction")
              or (load.kind == "force" and (conservative[load.name] or load.card.name in elastic))]  # fmt: skip
    rates = rate(kinetic, subject), rate(potential, subject)
    assert rates[0] == pytest.approx(sum(sum(x) for _, x in given), abs=rounding)
    assert rates[1] == pytest.approx(-sum(map(sum, stored)), abs=rounding)
    return sum(rates), rounding


def other_parameters(subject: SymbolicState) -> SymbolicState | None:
    """The same mechanism with no parameter as it was, what is closed or touches still so; None where it cannot be."""
    source, start = subject.source, subject.state
    given = zip(source.metadata["parameters"], start.p, np.random.default_rng(4).uniform(0.05, 0.15, len(start.p)), strict=True)
    p = source.bind({each["name"]: float(x) * (1 + part) + part * (x == 0) for each, x, part in given})
    closing = Closing(source, replace(start, p=p), subject.free)
    q = closing.place(start.q)
    if q is None:
        return None
    other = SymbolicState(source, closing.moving(q, start.u, start.t))
    return other if alike(other.free, subject.free) and other.regular is other.state else None


def off(part, values, tables):
    """What is left of an equation, relative to the largest of its terms, or to 1."""
    size = max([1.0, *(abs(x) for side in (part.left, part.right) for x in terms(side, values, tables))])
    return abs(evaluate(part.residual, values, tables)) / size


def terms(tree, values, tables):
    return [evaluate(term, values, tables) for term in (tree.terms if isinstance(tree, Add) else (tree,))]

"""Clever, brute force, most brute force: every system of the catalogue in three ways.

A body has three balances, a particle two: c in all. With n coordinates of the tree, of which loops, motions and contacts leave f free, brute
force has c + (n − f) equations, as many as accelerations and forces; most brute force 2c − f, as every joint stands as a constraint. What
is redundant adds a force, the parameter of a curve a coordinate to most brute force. A clever set has f equations without reactions;
where loops leave none, those of the tree hold what is passed where the loops are cut: as many components as the loops hold
accelerations.
"""

from functools import cache

import numpy as np

from freebody.catalogue import Answer, ask, systems
from freebody.equations.derivation.brute import brute
from freebody.equations.derivation.constrained import constrained
from freebody.equations.derivation.minimal import minimal
from freebody.equations.topics.lagrange import equations as lagrange
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Add, Sym

COUNT = "count: balances, and what rank leaves free"
MOMENT = {"19.3.2": {"at": 0.1}}
"""Where the start is singular: there the strings have no free length."""


@cache
def every(case):
    """The systems that have models of their own: mechanism and symbolic state at the start."""
    mechanisms = [(each.id, case.mechanism(f"{each.id}/model")) for each in systems() if each.models]
    return [(name, m, SymbolicState(m.source(), m.moment(**MOMENT.get(name, {}))[0])) for name, m in mechanisms]


def free(subject, but=()):
    """Accelerations that loops, motions and contacts leave free, and those they hold, by rank at a state near by; ``but`` are names of
    what is left out."""
    rows = np.array([list(row.coefficients.values()) for row in subject.neighbours[-1].rows if row.name not in but])
    held = np.linalg.matrix_rank(rows, tol=1e-9 * np.abs(rows).max()) if rows.size else 0
    return len(subject.names) - held, held


def redundant(subject):
    return len(subject.source.instant(subject.state).rank.self_stress)


def numbers(subject):
    """The numbers of all symbols, with the places of bodies, which are coordinates of most brute force."""
    found = dict(subject.values)
    for body in subject.free.bodies.values():
        for dots, (x, y) in enumerate((body.G, body.v, body.a)):
            found |= {Sym(f"x_{body.name}", dots): x, Sym(f"y_{body.name}", dots): y}
        found |= {Sym(f"phi_{body.name}", dots): x for dots, x in enumerate((body.angle, body.omega, body.alpha))}
    return found


def solved(system, subject):
    """The unknowns of A x = b with the numbers of the state, and the same as the core has them: accelerations, then forces if they are
    determinate."""
    values = numbers(subject)
    matrix = [[float(evaluate(x, values, subject.tables)) for x in row] for row in system.matrix]
    right = [float(evaluate(x, values, subject.tables)) for x in system.right]
    told = [i for i, x in enumerate(system.unknowns) if x.dots or not redundant(subject)]
    return np.linalg.lstsq(np.array(matrix), np.array(right), rcond=1e-12)[0][told], np.array(
        [values[x] for x in system.unknowns]
    )[told]


@ask("How many equations, with how many unknowns, do brute force and most brute force have?")
def counts(case):
    says = "{} with {} by brute force, {} with {} by most brute force."
    for name, mechanism, subject in every(case):
        bodies = sum(2 if body.particle else 3 for body in subject.free.bodies.values())
        curves = sum(joint.type == "curved_slot" for joint in mechanism.model.joints.values())
        forms, (left, held), more = (brute(subject), constrained(subject)[0]), free(subject), redundant(subject)
        value = [len(side) for form in forms for side in (form.system.matrix, form.system.unknowns)]
        most = 2 * bodies - left + more + curves
        check = [bodies + held, bodies + held + more, most, most]
        yield Answer("equations and unknowns", value, "", check, COUNT, 0.0, says=says, variant=name)


@ask("Which systems have a clever set, as many equations as accelerations and no reaction in them?")
def clever(case):
    found = {}
    for name, mechanism, subject in every(case):
        form = mechanism.minimal_form(**MOMENT.get(name, {}))
        if not form.least:
            found.setdefault(len(form.equations), {})[name] = free(subject)[0] + len(form.frictional)
    for count, checks in sorted(found.items()):
        says = f"{{}} equation{'s' * (count != 1)}: {', '.join(checks)}."
        yield Answer("equations", [count] * len(checks), "", list(checks.values()), COUNT, 0.0, says=says)


@ask("Which have none: what reactions cannot be kept out of the balances, and what does virtual power leave?")
def unavoidable(case):
    for name, mechanism, subject in every(case):
        form = mechanism.minimal_form(**MOMENT.get(name, {}))
        if form.least:
            left, _ = free(subject)
            stay = ", ".join(x.name for x in minimal(subject).system.unknowns if not x.dots)
            cut = free(subject, but=mechanism.model.motions)[1]
            says, against = f"{{}} cannot be kept out: {stay}.", "closed form: components where the loops are cut"
            yield Answer("stay", form.least, "", cut, against, 0.0, says=says, variant=name)
            says = f"Virtual power gives {{}} equation{'s' * (form.virtual != 1)} without any."
            yield Answer("virtual power", form.virtual, "", left, COUNT, 0.0, says=says, variant=name)


def nothing_left(what, left, against, tolerance):
    """That nothing is left in any system, by the one in which most is."""
    worst = max(left, key=left.get)
    yield Answer(worst, left[worst], "", 0.0, against, tolerance, 1.0, says=f"{what} in all {len(left)} systems.")


@ask("Do the forms, each solved for accelerations and forces, agree with the numbers of the core to round-off?")
def agreement(case):
    forms = {"Clever": minimal, "Brute": brute, "Most brute": lambda subject: constrained(subject)[0]}
    for word, form in forms.items():
        apart = {}
        for name, _, subject in every(case):
            case.instant(f"{name}/model", **MOMENT.get(name, {}))
            value, check = solved(form(subject).system, subject)
            apart[name] = float(np.max(np.abs(value - check), initial=0.0) / np.max(np.abs(check), initial=1.0))
        yield from nothing_left(f"{word} ones do", apart, "other route: articulated bodies, in numbers", 1e-11)


@ask("Do Lagrange's equations give the same motion?")
def by_lagrange(case):
    left = {}
    for name, _, subject in every(case):
        terms = [each.residual.terms if isinstance(each.residual, Add) else (each.residual,) for each in lagrange(subject)[2]]
        sizes = [[float(evaluate(term, subject.values, subject.tables)) for term in row] for row in terms]
        left[name] = max(abs(sum(row)) for row in sizes) / max([1.0, *(abs(x) for row in sizes for x in row)])
    yield from nothing_left("The accelerations of the balances satisfy them", left, "balances", 1e-12)

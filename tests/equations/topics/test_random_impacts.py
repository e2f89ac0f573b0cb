"""Impacts of random mechanisms with loops, rolling, strings, stops, friction: what is printed as solved are the rates and impulses that
the core has, and every printed balance holds with these, or the answer is refused."""

from dataclasses import replace

import numpy as np
import pytest
import sympy
from random_models import drawn, switching
from store import every

import freebody as fb
from freebody.core import quote
from freebody.equations import Singular, Sym, TooLarge, Tree, to_sympy
from freebody.equations.solve import Unconfirmed
from freebody.equations.topics.impact_equations import Impact, after
from freebody.equations.topics.impulse_momentum import jumps
from freebody.impact.applied_impulse import strike
from freebody.impact.impacts import NoImpact, impacts

AGREE = 1e-7
"""Of the largest rate, or impulse: to which events are found, and closed what has touched before."""
MOST = 2
"""Impacts of a run that are looked at."""


def core_impulses(found: Impact) -> dict[str, np.ndarray]:
    """As the core tells them: of every contact and string on its first body and of every joint on its second, x, y in N·s; of stops,
    motions, couplings and locks along what they hold."""
    stated = found.change.impulses
    along = {name: np.array([size]) for name, size in {**stated.stops, **stated.drives, **stated.locks}.items()}
    return along | {name: np.array(force[:2]) for name, force in {**stated.contacts, **stated.joints}.items()}


def on_body(found: Impact, sizes: dict[Sym, float], true: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same by the impulses of single loads."""
    metadata, made = found.subject.source.metadata, dict[str, np.ndarray]()
    first = {each["name"]: each["first"] for each in metadata["limits"] if each["type"] != "stop"}
    body = first | {each["name"]: each["second"] for each in metadata["joints"] if each["reaction"]}
    for load in found.subject.impact.acting:
        size = sizes[found.symbol(load)]
        if load.name in body:
            part, sign = next(((p, 1) for p in load.on if p.body == body[load.name]), (load.on[0], -1))
            made[load.name] = made.get(load.name, np.zeros(2)) + sign * size * np.array(part.force)
        elif load.name in true:
            made[load.name] = np.array([size])
    return made


def value(tree: Tree, numbers: dict[sympy.Symbol, float]) -> float:
    return float(to_sympy(tree).subs(numbers | {sympy.Symbol("pi"): sympy.pi}).evalf())


def balanced(found: Impact, sizes: dict[Sym, float]) -> None:
    """On every body impulses, couples among them, add up to m Δv and, about its mass centre, I Δω."""
    impact, change = found.subject.impact, found.change
    jumps = impact.velocities({name: u - change.before.u[name] for name, u in change.after.u.items()})
    largest, left = 0.0, []
    for body, jump in zip(impact.free.bodies.values(), jumps, strict=True):
        acting = [
            (1.0 if load.name in impact.given else sizes[found.symbol(load)]) * np.array(load.unit([body.name], body.G))
            for load in impact.acting
        ]
        momentum = np.array([body.mass, body.mass, body.inertia]) * jump
        left.append(np.abs(sum(acting, -momentum))[: 2 if body.particle else 3].max())
        largest = max(largest, np.abs([momentum, *acting]).max())
    assert max(left) <= AGREE * largest, left


def agree(found: Impact) -> None:
    """Rates after and impulses that are printed are the core's; of those that follow from others by friction too."""
    numbers, given = {to_sympy(x): number for x, number in found.values.items()}, found.subject.impact.given
    solved = {x: value(tree, numbers) for x, tree in jumps(found).spelt().items()}
    most = max(1e-12, *(abs(u) for each in (found.change.before, found.change.after) for u in each.u.values()))
    for name, u in found.change.after.u.items():
        assert solved[Sym(after(name), 1)] == pytest.approx(u, abs=AGREE * most), name
    known = numbers | {to_sympy(x): size for x, size in solved.items()}
    sizes = solved | {found.symbol(load): value(found.law(load), known) for load in found.slides}
    if not all(found.symbol(load) in sizes or load.name in given for load in found.subject.impact.acting):
        return
    balanced(found, sizes)
    if given:
        return
    true = core_impulses(found)
    largest = max((np.abs(each).max() for each in true.values()), default=0.0)
    for name, impulse in on_body(found, sizes, true).items():
        assert impulse == pytest.approx(true.get(name, np.zeros(2)), abs=AGREE * largest), name


@every([f"{seed}-{place}" for seed in range(200) for place in range(MOST)], "name", share=30)
def test_an_impact_is_that_of_the_core_or_is_refused(name, record_property):
    seed, place = map(int, name.split("-"))
    try:
        mechanism = switching(seed)
        run = mechanism.simulate()
    except fb.MotionError as error:
        record_property("refused", str(error))
        return
    if place >= len(list(impacts(run))):
        record_property("refused", "there is no such impact")
        return
    try:
        agree(Impact.of(mechanism.blow(place + 1)))
    except (TooLarge, Singular, Unconfirmed) as error:
        record_property("refused", str(error))


@every([f"{seed}" for seed in range(200)], "seed", share=60)
def test_an_impulse_that_is_applied_is_balanced_or_refused(seed, record_property):
    """A point of a model at rest is struck in a direction at random; half the impulse by the velocity of its point is the energy given,
    unless something slides (Kelvin)."""
    rng = np.random.default_rng(int(seed))
    try:
        mechanism = drawn(int(seed))
        state, points = mechanism.moment()[0], mechanism.source().points(mechanism.start()[0].p)
        moving = sorted(point for point, (body, *_) in points.items() if body != "ground")
        point, angle = moving[rng.integers(len(moving))], float(rng.uniform(-3, 3))
        found = Impact.of(strike(mechanism, state, point, angle, 1.7))
        agree(found)
    except (fb.MotionError, NoImpact, TooLarge, Singular, Unconfirmed) as error:
        record_property("refused", str(error))
        return
    u = np.array([*found.change.after.u.values()])
    rates = [f"rate({axis}({quote(point)}))" for axis in "xy"]
    velocity = mechanism.source().evaluate(rates, replace(state, u=u))
    given = 1.7 * (np.array([np.cos(angle), np.sin(angle)]) @ velocity) / 2
    if not found.slides:
        assert -found.change.lost == pytest.approx(given, rel=1e-9, abs=1e-12)

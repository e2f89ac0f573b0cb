"""Every joint of the list, by what its card says: solved by all routes, derived, drawn, released and engaged."""

from dataclasses import replace

import numpy as np
import pytest

import freebody as fb
from freebody.check import Checker, Kind
from freebody.core import cards
from freebody.document.blocks import Equation, is_tree
from freebody.document.document import Document
from freebody.equations.derivation.derive import FORMS, derive
from freebody.run.records import quote
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.tree import Sym, symbols

BODIES = """
freebody: 1
ground:
  points: {P: [0.2 m, 0.1 m], R: [0.6 m, 0.3 m]}
  lines: {rail: {through: P, angle: 20 deg}}
  curves: {bow: {x: 2*s, y: 0.3*s^2}}
bodies:
  plate: {mass: 2 kg, inertia: 0.1 kg*m^2, centre: [0.1 m, 0.05 m], points: {A: [0.3 m, 0.1 m], B: [-0.2 m, 0.2 m]},
          lines: {edge: {through: A, angle: 10 deg}}, curves: {bow: {x: 2*s, y: 0.3*s^2}}}
forces:
  push: {type: force, at: plate.B, x: 3 N, y: 1 N}
"""
FIELDS = {
    "points": (["ground.P", "plate.A"], ["ground.P", "ground.R"], ["plate.A", "plate.B"]),
    "point": (None, "ground.P", "plate.A"),
    "line": (None, "ground.rail", "plate.edge"),
    "circle": (None, "{centre: ground.P, radius: 0.5 m}", "{centre: plate.A, radius: 0.3 m}"),
    "curve": (None, "ground.bow", "plate.bow"),
    "numbers": "[0.4 m, 0.3 m]",
    "number": "0.9 m",
}
"""What is written in a field: for both bodies, the ground, the plate; or a number."""
EVENTS = """
events:
  let go: {when: t - 0.1, then: [{release: it}]}
  hold: {when: t - 0.2, then: [{engage: it}]}
"""
ROUTES = ("minimal", "newton_euler", "constraints")


def written(card, *, turned=False):
    """The fields of a joint that must be given; ``turned``: the plate comes first, the ground second."""
    role = {"both": 0, "first": 2, "second": 1} if turned else {"both": 0, "first": 1, "second": 2}
    chosen = {f.name: FIELDS[f.kind] if f.role == "number" else FIELDS[f.kind][role[f.role]] for f in card.fields if f.required}
    pairs = {name: v[::-1] if turned and isinstance(v, list) else v for name, v in chosen.items()}
    return ", ".join(f"{name}: [{', '.join(v)}]" if isinstance(v, list) else f"{name}: {v}" for name, v in pairs.items())


def model(card, *, alone, events="", turned=False):
    """The plate on the joint alone, or on free coordinates beside it, so that it closes a loop."""
    text = BODIES
    # One along a curve that can be released has but the place on the curve for a coordinate.
    names = [f"c{i}" for i in range(1 if on_curve(card) and events else len(card.coordinates))]
    if alone:
        joints = f"  it: {{type: {card.type}, {written(card, turned=turned)}, coordinates: [{', '.join(names)}]}}\n"
        values = ", ".join(f"{name}: {0.7 - 0.2 * i}" for i, name in enumerate(names))
        start = f"initial: {{{values}, rates: {{{', '.join(f'{name}: 0.5' for name in names)}}}}}\n"
    else:
        joints = f"  it: {{type: {card.type}, {written(card, turned=turned)}}}\n"
        joints += "  where: {type: free, of: [ground.P, plate.A], coordinates: [x, y, phi]}\n"
        start = "initial: {guess: {x: 0.9, y: 0.4, phi: 0.3}}\n"
    return fb.Mechanism.loads(f"{text}joints:\n{joints}{start}run: {{until: 0.3 s}}\n{events}")


def on_curve(card):
    return any(field.kind == "curve" for field in card.fields)


def cases():
    """Every joint of bodies, in the tree if it can be there, and closing a loop if it can do that."""
    for card in cards.joints().values():
        if not any(field.role == "second" or field.role == "both" for field in card.fields):
            continue  # a coupling joins coordinates
        if card.coordinates:
            yield card, True
        if card.rows and not on_curve(card):
            yield card, False


def each(*some):
    """A member of a family for every joint: each is visited, in a part of its places."""
    marks = pytest.mark
    made = [(card, alone, marks.family(card.type, 1)) for card, alone in some]
    return [pytest.param(card, alone, id=f"{card.type}-{'tree' if alone else 'loop'}", marks=mark) for card, alone, mark in made]


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("card", "alone"), each(*cases()))
def test_joint(card, alone, turned):
    mechanism = model(card, alone=alone, turned=turned)
    solved = {route: mechanism.solve(route=route) for route in ROUTES}
    first = solved["minimal"]
    reaction = first.reactions["it"]
    assert reaction.has_couple == any(row.couple for row in card.rows) or card.type in ("rollers", "belt")
    assert reaction.has_couple or reaction.M == 0.0
    for route, other in solved.items():
        assert other.residual < 1e-12, route
        for name, value in first.accelerations.items():
            assert other.accelerations[name] == pytest.approx(value, rel=1e-10, abs=1e-10), route
        assert np.abs(other.reactions["it"].values - reaction.values).max() < 1e-10, route
    for row in card.rows:
        assert np.isfinite(first[f"{quote('it')}.{row.reading}"])
    assert (card.glyph or card.outline or not card.rows) and mechanism.diagram().svg()


@pytest.mark.parametrize(("card", "alone"), each(*cases()))
def test_its_equations_are_true(card, alone):
    mechanism = model(card, alone=alone)
    checker = Checker(mechanism)
    for form in FORMS:
        document = mechanism.equations(form, long=True)
        equations = [block for block in document.blocks if isinstance(block, Equation) and block.label]
        assert equations or form == "first-order" or mechanism.solve().freedom == 0, form
        for block in equations:
            line = Document((replace(block, name="", note=""),), document.letters).text()
            assert checker.check(line).kind is Kind.TRUE, line


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(
    ("card", "alone"), each(*(case for case in cases() if case[1] and case[0].rows and not on_curve(case[0])))
)
def test_it_starts_alike_whether_or_not_it_can_be_released(card, alone, turned):
    """Rows that count only changes (rolling, a string that winds up) leave its place open, and other assemblies are near."""
    fixed, released = (model(card, alone=alone, events=events, turned=turned).solve() for events in ("", EVENTS))
    assert np.abs(released.reactions["it"].values - fixed.reactions["it"].values).max() < 1e-9
    assert released.bodies["plate"] == pytest.approx(fixed.bodies["plate"], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("card", "alone"), each(*(case for case in cases() if case[0].rows)))
def test_joint_is_released_and_engaged(card, alone, turned):
    run = model(card, alone=alone, events=EVENTS, turned=turned).simulate()
    assert run.outcome.name == "Completed", run.outcome
    kinds = [change.kind for change in run.changes]
    assert kinds.index("released") < kinds.index("engaged")


def symbols_at(subject):
    """The numbers of all symbols, places of bodies among them, as the form with constraints has them."""
    [plate] = subject.free.bodies.values()
    places = {"x_plate": [v[0] for v in (plate.G, plate.v, plate.a)], "y_plate": [v[1] for v in (plate.G, plate.v, plate.a)]}
    places["phi_plate"] = [plate.angle, plate.omega, plate.alpha]
    return subject.values | {Sym(name, dots): x for name, levels in places.items() for dots, x in enumerate(levels)}


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize(("card", "alone"), each(*(case for case in cases() if case[0].rows)))
def test_its_equations_are_true_where_it_was_engaged(card, alone, turned):
    """The plate has moved since the joint was released, so that it is engaged apart from where it closes."""
    mechanism = model(card, alone=alone, events=EVENTS, turned=turned)
    states = [SymbolicState(mechanism.source(), mechanism.moment(at=t)[0]) for t in (0.22, 0.3)]
    if card.type == "rolling_circles":
        with pytest.raises(ValueError, match="where its circles do not touch"):
            derive(states[0])
        return
    seen = 0
    for form in FORMS:
        document = derive(states[0], form, long=True)
        equations = [
            (b.left, b.right) for b in document.blocks if isinstance(b, Equation) and is_tree(b.left) and is_tree(b.right)
        ]
        for at in states:
            values = symbols_at(at)
            # What a page names on the way, as energies, is no symbol of the state.
            sides = [pair for pair in equations if all(symbols(side) <= values.keys() for side in pair)]
            seen += len(sides) + len(document.parts)
            for left, right in sides:
                one, other = evaluate(left, values, at.tables), evaluate(right, values, at.tables)
                assert one == pytest.approx(other, rel=1e-8, abs=1e-7), (form, left, right)
            for part in document.parts:
                assert evaluate(part.residual, values, at.tables) == pytest.approx(0.0, abs=1e-7), (form, part.title)
    assert seen


@pytest.mark.parametrize("pair", ["[bar, clay]", "[clay, bar]"])
def test_a_lump_sticks_to_what_turns_in_either_order(pair):
    """Angular momentum about the pin: m v b = (M L²/3 + m b²) θ̇, and the clay stays b from it."""
    made = fb.Mechanism.loads(f"""
freebody: 1
bodies:
  bar: {{shape: rod, length: 1 m, mass: 4 kg}}
  clay: {{shape: particle, mass: 0.5 kg}}
joints:
  O: {{type: hinge, of: [ground.O, bar.start], coordinate: {{name: θ, zero: down}}}}
  flight: {{type: free, of: [ground.O, clay.centre], coordinates: [x, y]}}
events: {{hit: {{at: start, then: {{weld: {pair}}}}}}}
initial: {{θ: 0, x: 0, y: -0.7 m, rates: {{θ: 0, x: 12 m/s, y: 0}}}}
""")
    assert made.moment(after="hit")[0].u[0] == pytest.approx(0.5 * 12 * 0.7 / (4 / 3 + 0.5 * 0.49), rel=1e-12)
    later, _ = made.moment(at=0.1)
    assert np.hypot(*later.q[1:]) == pytest.approx(0.7, rel=1e-9)
    assert later.q[1] == pytest.approx(0.7 * np.sin(later.q[0]), rel=1e-9)


@pytest.mark.parametrize("joint", ["weld", "hinge"])
def test_a_joint_that_comes_later_in_axes_of_a_particle_is_refused(joint):
    """They do not turn with the other body: it would be held at the angle at which it was met, or stopped."""
    text = f"""
freebody: 1
bodies:
  bar: {{shape: rod, length: 1 m, mass: 4 kg}}
  clay: {{shape: particle, mass: 0.5 kg}}
joints:
  O: {{type: hinge, of: [ground.O, bar.start], coordinate: θ}}
  flight: {{type: free, of: [ground.O, clay.centre], coordinates: [x, y]}}
  grip: {{type: {joint}, of: [clay.centre, bar.end], engaged: false}}
events: {{hit: {{at: 0.1 s, then: {{engage: grip}}}}}}
initial: {{θ: 0, x: 0.7 m, y: 0.1 m, rates: {{θ: 2, x: 0, y: 0}}}}
"""
    refused = r"the particle `clay` has none that turn\n(.*\n)*.*`of: \[bar.end, clay.centre\]`"
    with pytest.raises(fb.ModelFileError, match=refused):
        fb.Mechanism.loads(text).simulate(until=0.2)
    turned = fb.Mechanism.loads(text.replace("[clay.centre, bar.end]", "[bar.end, clay.centre]")).simulate(until=1.0)
    apart = turned.evaluate("sin(atan2(y, x) - θ)", np.array([0.1, 0.5, 1.0]))
    assert np.ptp(apart) < 1e-9


@pytest.mark.parametrize("joined", ["weld: [a, b]", "engage: grip"])
def test_two_particles_are_joined_where_they_meet_and_not_at_a_distance(joined):
    """At a distance they would go on without turning, which loses angular momentum."""
    text = f"""
freebody: 1
gravity: none
bodies: {{a: {{shape: particle, mass: 1}}, b: {{shape: particle, mass: 2}}}}
joints:
  path: {{type: free, of: [ground.O, a.centre], coordinates: [x, y]}}
  grip: {{type: hinge, of: [a.centre, b.centre], engaged: false}}
events: {{hit: {{at: 0.5 s, then: {{{joined}}}}}}}
initial: {{x: 0, y: 0, b.x: 1, b.y: HEIGHT, rates: {{x: 2, y: 0, b.x: 0, b.y: 0}}}}
"""
    apart = fb.Mechanism.loads(text.replace("HEIGHT", "0.5")).simulate(until=1.0).outcome
    assert (str(apart.name), apart.t) == ("no_axes", pytest.approx(0.5)) and "`link`" in apart.sentence
    met = fb.Mechanism.loads(text.replace("HEIGHT", "0")).simulate(until=1.0)
    assert met.outcome.ok and met.evaluate("rate(x)", np.array([1.0])) == pytest.approx(2 / 3)

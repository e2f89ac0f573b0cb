"""What the topics say, against the numbers of the core at random states, and against each other."""

from inspect import signature
from itertools import pairwise
from unicodedata import normalize

import numpy as np
import pytest
from models import atwood, random_subjects, spring_pendulum, system
from numpy.testing import assert_allclose
from store import but_long
from typer.testing import CliRunner

import freebody as fb
from freebody.catalogue import model_file
from freebody.cli import app
from freebody.core import State
from freebody.document.blocks import Equation
from freebody.equations import Sym, evaluate, symbols
from freebody.equations.derivation.coordinates import stated
from freebody.equations.linearization import linearised, numbers
from freebody.equations.topics import TOPICS, NotHere, described, topic
from freebody.equations.topics.common import place_of, rates
from freebody.equations.topics.elimination import eliminated
from freebody.equations.topics.lagrange import combination, equations
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.tree import ONE, ZERO, Tree, add, minus, mul, number, read

TREES = ["19.3.1", "19.3.10", "19.3.15", "19.3.17", "19.3.20", "19.3.28", "EX-BLOCK", "GEN-CHAIN", "S19.17", "S19.18"]
LOOPS = ["GEN-FOURBAR", "GEN-SLIDER", "S19.21", "S19.22"]


def value(subject: SymbolicState, tree: Tree, more: dict | None = None) -> float:
    return float(evaluate(tree, subject.values | (more or {}), subject.tables))


@pytest.mark.parametrize("name", [*TREES, *LOOPS])
def test_lagrange_holds_where_the_balances_do(name: str) -> None:
    """The accelerations and reactions of the core satisfy Lagrange's equations."""
    for subject in random_subjects(system(name)):
        for each in equations(subject)[2]:
            terms = each.residual.terms if hasattr(each.residual, "terms") else (each.residual,)
            scale = max(abs(value(subject, term)) for term in terms) or 1.0
            assert abs(value(subject, each.residual)) < 1e-9 * max(scale, 1.0), each.coordinate


@pytest.mark.parametrize("name", ["19.3.15", "19.3.28", "S19.17", "S19.18"])
def test_lagrange_is_made_of_balances(name: str) -> None:
    subject = next(random_subjects(system(name)))
    found, balances = equations(subject)[2], stated(subject)
    factors = combination(subject, found, balances)
    assert factors is not None
    for each, row in zip(found, factors, strict=True):
        made = add(*(mul(factor, b.balance.residual) for factor, b in zip(row, balances, strict=True)))
        assert equal(each.residual, made)


def test_lagrange_of_absolute_angles() -> None:
    """The moment balance of both bars about the ceiling less that of the lower one about the elbow is the first equation."""
    subject = next(random_subjects(system("19.3.28")))
    assert combination(subject, equations(subject)[2], stated(subject)) == [[ONE, number(-1)], [ZERO, ONE]]


@pytest.mark.parametrize(
    ("make", "place"), [("19.3.17", {}), ("19.3.20", {"y": 3 * 9.81 / 100}), ("GEN-CHAIN", {}), ("19.3.28", {}), ("19.3.24", {})]
)
def test_linear_matrices_are_slopes_of_accelerations(make: str, place: dict[str, float]) -> None:
    """M⁻¹ K and M⁻¹ C are slopes of the core's accelerations, at equilibria where most coordinates are 0."""
    mechanism = system(make)
    state = mechanism.start()[0]
    rest = np.array([place.get(c["name"], 0.0) for c in mechanism.source().metadata["coordinates"]])
    rest_state = State(state.p, 0.0, rest, np.zeros_like(state.u))
    subject = SymbolicState(mechanism.source(), rest_state, at_rest=True)
    found = linearised(subject, {})
    m, c, k = (numbers(subject, matrix) for matrix in (found.mass, found.damping, found.stiffness))
    core, h = mechanism.compile(), 1e-6

    def slopes(which: str) -> np.ndarray:
        columns = []
        for i in range(len(rest_state.q)):
            step = np.zeros_like(rest_state.q)
            step[i] = h
            q, u = (step, 0 * step) if which == "q" else (0 * step, step)
            ahead, behind = (core.instant(State(rest_state.p, 0.0, rest + s * q, s * u)).accelerations for s in (1, -1))
            columns.append((ahead - behind) / (2 * h))
        return np.array(columns).T

    scale = np.abs(np.linalg.solve(m, k)).max() + 1
    assert_allclose(-np.linalg.solve(m, k), slopes("q"), atol=1e-7 * scale)
    assert_allclose(-np.linalg.solve(m, c), slopes("u"), atol=1e-7 * scale)


def test_stability_of_an_inverted_pendulum() -> None:
    """Up: k > m g l. Down without spring: frequency √(g/l). Timoshenko, Theory of Elastic Stability, ch. 2 (the first by energy)."""
    mechanism = spring_pendulum()
    said = topic(mechanism, "linear").text()
    assert "k − m g l > 0" in said or "−m g l + k > 0" in said or "k/m − g l > 0" in said, said
    hanging = topic(mechanism, "linear", theta="180 deg", k=0).text()
    assert "√(g/l)" in hanging, hanging


def test_linear_needs_an_equilibrium() -> None:
    """A block slides off its slope wherever it is; a rod beside its equilibrium has one near by."""
    with pytest.raises(NotHere, match="no equilibrium"):
        topic(system("EX-BLOCK"), "linear")
    assert "The nearest equilibrium found is at x = 0, θ = π/2." in topic(system("19.3.15"), "linear", theta="80 deg").text()


@pytest.mark.parametrize("name", ["19.3.10", "19.3.28", "EX-ARM", "S19.17", "S19.20", "S19.21"])
def test_moving_frame(name: str) -> None:
    """The parts add up to the velocity and acceleration that the core has; direct differentiation gives them, too."""
    for subject in random_subjects(system(name), 2):
        bodies = [motion.body for motion in subject.motions]
        for body, point in pairwise(bodies):
            [stated] = subject.ask([{"ask": "through", "point": f"{point}.G", "frames": [body]}])
            [parts], truth = stated["stretches"], subject.free.bodies[point]

            def summed(origin: str, *words: str, stated=stated, parts=parts, subject=subject) -> list[float]:
                pairs = [stated["origin"][origin], *(parts[word] for word in words)]
                return np.sum([[value(subject, read(x)) for x in pair["xy"]] for pair in pairs], axis=0)

            assert_allclose(summed("r", "r"), truth.G, atol=1e-10)
            assert_allclose(summed("v", "turned", "v_relative"), truth.v, atol=1e-10)
            whole = summed("a", "tangential", "centripetal", "coriolis", "a_relative")
            assert_allclose(whole, truth.a, atol=1e-8 * (1 + np.abs(truth.a).max()))
            names = subject.names
            v = rates(place_of(subject, f"{point}.G").xy, names)
            assert_allclose([value(subject, x) for x in v], truth.v, atol=1e-10)
            assert_allclose([value(subject, x) for x in rates(v, names)], truth.a, atol=1e-8 * (1 + np.abs(truth.a).max()))


def test_coriolis_of_a_collar_on_a_turning_rod() -> None:
    document = topic(system("S19.17"), "frame", point="collar.G", body="rod")
    assert normalize("NFD", "2 ω × v_rel = 2 θ̇ Ṙ n_rod") in normalize("NFD", document.text())


@pytest.mark.parametrize("name", ["19.3.15", "19.3.28", "EX-ARM", "S19.17"])
def test_moments_about_a_moving_point(name: str) -> None:
    """Σ M is what the core's loads give, and dH/dt + v × L; without v × L it is wrong somewhere."""
    wrong = 0
    for subject in random_subjects(system(name), 2):
        names = subject.names
        for point in [name for name, (body, _, _) in subject.points.items() if body in subject.free.bodies]:
            of, x, y = subject.balances(
                [{"ask": "equation", "bodies": [], **q} for q in ({"about": {"point": point}}, {"along": "x"}, {"along": "y"})]
            )
            v = rates(of.place.xy, names)
            changing = value(subject, along_motion(of.momentum, names))
            extra = value(subject, minus(mul(v[0], y.momentum), mul(v[1], x.momentum)))
            acting = subject.free.acting(*subject.free.bodies, about=tuple(value(subject, c) for c in of.place.xy))[2]
            assert changing + extra == pytest.approx(acting, rel=1e-8, abs=1e-8)
            wrong += abs(extra) > 1e-3
    assert wrong


@pytest.mark.parametrize("name", [*TREES, *LOOPS])
def test_balances_about_the_mass_centre(name: str) -> None:
    """Where the mass centre is, and both sides of every balance, against the core's mass centre and all that acts from outside."""
    for subject in random_subjects(system(name), 1):
        centre, bodies = subject.free.centre(*subject.free.bodies), subject.free.bodies
        blocks = [b for b in topic(system(name), "mass_centre", subject.state).blocks if isinstance(b, Equation)]
        assert_allclose([value(subject, b.right) for b in blocks if not b.label], centre, atol=1e-9)
        acting = subject.free.acting(*bodies, about=centre)
        for block, true in zip((b for b in blocks if b.label), acting, strict=True):
            sides = value(subject, block.left), value(subject, block.right)
            assert sides[0] == pytest.approx(sides[1], rel=1e-8, abs=1e-8)
            assert abs(sides[1]) == pytest.approx(abs(true), rel=1e-8, abs=1e-8)


@pytest.mark.parametrize(
    "name", ["19.3.10", "S19.20", *(pytest.param(name, marks=pytest.mark.long) for name in ("19.3.16", "19.3.17"))]
)
def test_elimination(name: str) -> None:
    """The equations that are left hold at the core's states, with the constants that the momenta have there."""
    try:
        eliminated(next(random_subjects(system(name))))
    except NotHere:
        pytest.skip("nothing is conserved")
    for subject in random_subjects(system(name), 2):
        found = eliminated(subject)
        constants = {Sym(found.constants[c].name): value(subject, momentum) for c, momentum in found.momenta.items()}
        for x, tree in found.rates.items():
            assert value(subject, tree, constants) == pytest.approx(subject.values[x], rel=1e-9)
        for tree in found.equations.values():
            assert value(subject, tree, constants) == pytest.approx(0.0, abs=1e-8)
            assert not {symbol.name for symbol in symbols(tree)} & set(found.momenta)


@pytest.mark.parametrize("name", but_long(["19.3.1", "19.3.3", "19.3.17", "S19.17", "19.3.25"], "19.3.17", "19.3.25"))
def test_polar_form_of_a_particle(name: str) -> None:
    """Both sides of both polar equations at random states, with r and φ from the place of the particle."""
    for subject in random_subjects(system(name), 2):
        mechanism = system(name)
        made = topic(mechanism, "particle", subject.state)
        sides = [block for block in made.blocks if isinstance(block, Equation) and str(block.name).startswith("Σ F·e")]
        body = next(each for each in subject.free.bodies.values() if each.particle)
        r, (x, y), (vx, vy), (ax, ay) = np.hypot(*body.G), body.G, body.v, body.a
        out, across = (x * vx + y * vy) / r, (x * vy - y * vx) / r
        a_out, a_across = (x * ax + y * ay) / r, (x * ay - y * ax) / r
        below = [symbol for symbol in made.letters if symbol in ("r", "phi", "r_polar", "phi_polar")][-2:]
        polar = {Sym(below[0]): r, Sym(below[0], 1): out, Sym(below[0], 2): a_out + across**2 / r}
        polar |= {Sym(below[1]): np.arctan2(y, x), Sym(below[1], 1): across / r}
        polar[Sym(below[1], 2)] = (a_across - 2 * out * across / r) / r
        assert len(sides) == 2
        for side, true in zip(sides, (a_out, a_across), strict=True):
            assert value(subject, side.left, polar) == pytest.approx(body.mass * true, rel=1e-8, abs=1e-8)
            assert value(subject, side.right, polar) == pytest.approx(body.mass * true, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("name", but_long(["19.3.10", "S19.20"], "S19.20"))
def test_every_topic_prints_for_the_catalogue_or_says_why_not(name: str) -> None:
    mechanism = fb.load(model_file(f"{name}/model"))
    for each in TOPICS:
        try:
            made = topic(mechanism, each)
        except NotHere as reason:
            assert len(str(reason)) > 20
        else:
            assert made.text() and made.latex() and made.markdown() and made.json()


def test_unknown_words_are_named() -> None:
    with pytest.raises(ValueError, match="lagrange"):
        topic(atwood(), "hamilton")
    with pytest.raises(ValueError, match="point, body"):
        topic(system("19.3.15"), "frame", corner="rod.A")
    with pytest.raises(ValueError, match=r"rod\.A"):
        topic(system("19.3.15"), "frame", point="rod.Z")


def test_the_command_line_lists_every_topic_with_its_options() -> None:
    said = " ".join(CliRunner().invoke(app, ["equations", "--forms"]).output.split())
    for name, make in TOPICS.items():
        assert f"{name} {described(name)[0]}" in said
        options = [each for each in signature(make).parameters.values() if each.kind is each.KEYWORD_ONLY]
        assert all(f"`{each.name}`" in described(name)[1] for each in options), name


def test_the_command_line_makes_a_topic() -> None:
    asked = ["equations", str(model_file("S19.17/model")), "--form"]
    done = CliRunner().invoke(app, [*asked, "frame", "--set", "point=collar.G"])
    assert done.exit_code == 0 and "Coriolis" in done.output, done.output
    assert CliRunner().invoke(app, [*asked, "hamilton"]).exit_code == 2
    through = CliRunner().invoke(app, [*asked[:2], "--of", "collar.G", "--frame", "rod", "--at", "0.1"])
    assert "Coriolis" in through.output and "At t = 0.1 s" in through.output, through.output


def test_prescribed_rates_are_put_into_what_a_frame_gives() -> None:
    """A point at r on a wheel that turns at ω₂ against a rod of l, which turns at ω₁: a = −l ω₁² λ − r (ω₁ − ω₂)² λ_wheel."""
    said = topic(system("S19.20"), "frame", point="wheel.P", body="rod").text()
    assert "a_P = −l w₁² λ_rod − r (w₁ − w₂)² λ_wheel" in said


@pytest.mark.long
def test_what_nobody_reads_is_not_printed() -> None:
    said = " ".join(topic(system("GEN-STEP"), "moment").text().split())
    assert "too long to be read; ask of fewer bodies" in said

"""The digits that a run claims for its figures, beside solutions of many more digits."""

import json
import math
from functools import cache
from itertools import product

import numpy as np
import pytest
from store import MODELS, WITHOUT_ANSWER, every, family, mechanism
from typer.testing import CliRunner

import freebody as fb
from freebody import cli
from freebody.core import Settings, quote
from freebody.run.digits import Accuracy, expression, other_settings
from freebody.solve.figures import Known, figure

RTOLS = (1e-5, 1e-7, 1e-9, 1e-11)
G = 9.81
LONG = np.longdouble


def chain(seed: int, sensitive: bool):
    """Two rods, one hanging from the other: lengths, masses, angles from down and rates; thrown from above, or swinging a little."""
    rng = np.random.default_rng([seed, sensitive])
    reach, spin = (math.pi, 2.0) if sensitive else (0.4, 0.3)
    return [rng.uniform(a, b, 2).round(3) for a, b in ((0.5, 1.2), (0.5, 2.0), (-reach, reach), (-spin, spin))]


def rods(lengths, masses, angles, rates):
    """Its model."""
    m = fb.Mechanism("chain", gravity=G)
    at, start = m.ground.O, {}
    for i, (length, mass) in enumerate(zip(lengths, masses, strict=True)):
        rod = m.rod(f"rod{i}", length=float(length), mass=float(mass))
        m.hinge(at, rod.start, coordinate={"name": f"th{i}", "zero": "down", "absolute": True})
        at, start[f"th{i}"] = rod.end, float(angles[i])
    m.initial(**start, rates={f"th{i}": float(rate) for i, rate in enumerate(rates)})
    return m


def exact(draws, times, step):
    """Angles and rates (nt, 2n, nd) of such chains in extended precision: Lagrange's equations, by Gragg's midpoint rule extrapolated
    to order 26 (Hairer, Nørsett & Wanner, Solving ODEs I, II.9)."""
    lengths, masses, angles, rates = (np.array(each, LONG).T for each in zip(*draws, strict=True))
    n, carried = len(lengths), np.cumsum(masses[::-1], axis=0)[::-1] - masses
    lever = lengths * (masses / 2 + carried)
    c = np.array([[lengths[min(i, j)] * lever[max(i, j)] for j in range(n)] for i in range(n)])
    for i in range(n):
        c[i, i] = lengths[i] ** 2 * (masses[i] / 3 + carried[i])

    def rate(y):
        apart = y[:n, None] - y[None, :n]
        a, b = c * np.cos(apart), -(c * np.sin(apart) * y[None, n:] ** 2).sum(1) - LONG(G) * lever * np.sin(y[:n])
        for k in range(n):
            for i in range(k + 1, n):
                factor = a[i, k] / a[k, k]
                a[i], b[i] = a[i] - factor * a[k], b[i] - factor * b[k]
        for k in reversed(range(n)):
            b[k] = (b[k] - (a[k, k + 1 :] * b[k + 1 :]).sum(0)) / a[k, k]
        return np.concatenate([y[n:], b])

    def midpoint(y, h, count):
        before, now = y, y + h * rate(y)
        for _ in range(count - 1):
            before, now = now, before + 2 * h * rate(now)
        return now

    y, found = np.concatenate([angles, rates]), []
    for span in np.diff(times, prepend=0.0):
        count = math.ceil(span / step)
        for _ in range(count):
            h, table = LONG(span) / count, []
            for j in range(1, 14):
                row = midpoint(y, h / (2 * j), 2 * j)
                for k in range(len(table)):
                    ratio = (LONG(j) / (len(table) - k)) ** 2
                    table[k], row = row, row + (row - table[k]) / (ratio - 1)
                table.append(row)
            y = table[-1]
        found.append(y)
    return np.array(found)


TIMES = np.linspace(0, 10, 601)[1:]
JUDGED = TIMES >= 0.5  # before, the largest error so far is not yet seen by these times
FROM_135 = [np.array([1.0, 1.0]), np.array([1.0, 1.0]), np.radians([135.0, 135.0]), np.zeros(2)]
DRAWS = {f"{kind} {seed}": chain(seed, kind == "sensitive") for kind in ("sensitive", "tame") for seed in range(20)}
DRAWS |= {"from 135°": FROM_135}


@cache
def solutions():
    """The motions (nt, 4) of all chains."""
    return dict(zip(DRAWS, np.moveaxis(exact(list(DRAWS.values()), TIMES, 0.02), -1, 0), strict=True))


def true_digits(values, exactly):
    """How many digits (nt, k) of values are right: of the largest size so far, by the largest error so far."""
    error = np.maximum.accumulate(np.abs(values - exactly).astype(float))
    size = np.maximum.accumulate(np.abs(exactly).astype(float))
    return np.floor(np.clip(-np.log10(np.maximum(error, 1e-300) / size), 0, 15))


@pytest.mark.parametrize("name", family(DRAWS, 10, "exact solutions"))
def test_no_more_digits_are_claimed_than_are_right(name):
    model = rods(*DRAWS[name])
    for rtol in RTOLS:
        done = model.simulate(10, rtol=rtol)
        claimed = np.array([done.digits(text, TIMES) for text in ("th0", "th1", "rate(th0)", "rate(th1)")]).T
        excess = (claimed - true_digits(np.hstack(done.motion.sample(TIMES)), solutions()[name]))[JUDGED]
        assert excess.max() <= 0, rtol
        if "tame" in name:
            assert excess.min() >= -1, rtol


def test_a_double_pendulum_from_135_degrees_has_no_digit_after_20_seconds():
    done = rods(*FROM_135).simulate(20)
    assert done.digits("th0", 20.0) == 0 and done.digits("th0", 1.0) >= 6
    assert "no digit holds" in done.accuracy.sentence


@every(sorted(set(MODELS) - WITHOUT_ANSWER))
def test_figures_of_the_catalogue_are_as_near_to_a_tight_run_as_they_claim(model):
    loose, tight = mechanism(model).simulate(rtol=1e-8), mechanism(model).simulate(rtol=1e-13)
    for text in loose.coordinates:
        text = quote(text)
        [known] = loose.accuracy.figures(expression(text), float(loose.edges[-1]))
        apart = abs(known - tight.evaluate(text, float(tight.edges[-1])))
        assert apart <= max(known.error, 1e-16), text  # what is zero but for round-off has no digit to be right
    for label, known in loose.accuracy.report.items():
        if known.value is not None:
            assert abs(known.value - tight.report[label].value) <= known.value.error, label


def test_the_tolerance_that_is_proposed_gives_as_many_digits():
    model = mechanism("GEN-CHAIN/two_bars")
    before = model.simulate(rtol=1e-9).accuracy
    rtol, until = before.better
    assert until == math.inf and f"at rtol {rtol:.0e} it would hold to 6 digits to the end" in before.sentence
    after = model.simulate(rtol=rtol).accuracy
    assert before.until(6) < math.inf and after.until(6) == math.inf


def test_what_hangs_on_the_last_bit_of_a_number_is_seen():
    m = fb.Mechanism("from the top", gravity=G)
    rod = m.rod("rod", length=1.0, mass=1.0)
    m.hinge(m.ground.O, rod.start, coordinate={"name": "th", "zero": "down"})
    m.initial(th="180 deg")
    done = m.simulate(15, rtol=1e-12)
    assert done.digits("th", 1.0) > 10 and done.digits("th", 15.0) == 0


def ball(height: float):
    """A ball that bounces on the ground from a height (m)."""
    m = fb.Mechanism("ball", gravity=G)
    ball = m.particle("ball", mass=1.0)
    m.contact("floor", ball.centre, m.ground.line("level", m.ground.O, angle=0), restitution=0.5)
    m.initial(**{"ball.x": 0, "ball.y": height})
    return m


def test_instants_of_an_impact_are_compared_and_not_what_jumps_there():
    runs = [ball(height).simulate(1.2) for height in (1.0, 1.0 + 1e-9)]
    accuracy = Accuracy(*runs)
    first = next(change for change in accuracy.changes if change.kind == "impact")
    apart = math.sqrt(2 / G) * 0.5e-9
    assert abs(first.t - math.sqrt(2 / G)) < first.t.error == pytest.approx(3 * apart, rel=1e-3)
    # m (1 + e) √(2 g h), which changes by half of what the height does; what is lost, by all of it.
    impulse = first.sizes["floor"]
    assert impulse == pytest.approx(1.5 * math.sqrt(2 * G)) and impulse.error == pytest.approx(1.5e-9 * impulse, rel=1e-3)
    assert first.lost.error == pytest.approx(3e-9 * first.lost, rel=1e-3) and first.work is None
    assert accuracy.digits("rate(ball.y)", np.array([0.3, 0.6, 0.8])).min() >= 7


def test_the_work_of_a_drive_in_an_impact_is_known_as_far_as_it_is_in_the_other_run():
    """What strikes a bat that keeps its speed V: the drive does (1 + e) m V²."""
    runs = [
        fb.Mechanism.loads(f"""
freebody: 1
gravity: none
ground: {{lines: {{way: {{through: O, angle: 0}}}}}}
bodies: {{bat: {{shape: particle, mass: 9}}, ball: {{shape: particle, mass: 3}}}}
joints:
  g: {{type: slot, along: ground.way, point: bat.centre, coordinate: z}}
  b: {{type: slot, along: ground.way, point: ball.centre, coordinate: x}}
stops: {{hit: {{of: x - z, least: 0, restitution: 0.4}}}}
motions: {{push: {{of: z, is: "{speed!r}*t"}}}}
initial: {{x: 1, rates: {{x: 0}}}}
""").simulate(1)
        for speed in (2.0, 2.0 + 2e-9)
    ]
    accuracy = Accuracy(*runs)
    (hit,) = accuracy.changes
    for work in (hit.work, accuracy.energy["work of push"]):
        assert work == pytest.approx(1.4 * 3 * 2**2) and work.error == pytest.approx(6e-9 * work, rel=1e-3)


def test_nothing_holds_after_the_events_of_the_two_runs_part():
    runs = [ball(height).simulate(1.2) for height in (1.0, 8.0)]
    accuracy = Accuracy(*runs)
    assert accuracy.parting == pytest.approx(math.sqrt(2 / G))
    assert accuracy.digits("ball.y", np.array([0.5])).max() == 0
    assert accuracy.time(runs[0].impacts[0].t).digits == 0


def test_when_a_run_ends_is_known_as_far_as_two_runs_agree():
    ended = [
        fb.Mechanism.loads(f"""
freebody: 1
bodies: {{b: {{shape: particle, mass: 1}}}}
initial: {{b.x: 0, b.y: {height} m, at_rest: true}}
events: {{down: {{when: b.y, then: stop}}}}
""").simulate(2)
        for height in (1.0, 1.0 + 1e-9)
    ]
    end = Accuracy(*ended).end
    assert end == pytest.approx(math.sqrt(2 / G)) and end.error == pytest.approx(1.5e-9 * end, rel=1e-3)
    assert ball(1.0).simulate(0.1).accuracy.end.error == 0
    assert Accuracy(ended[0], ball(8.0).simulate(0.1)).end.digits == 0


def test_another_method_follows_where_the_tolerance_is_at_its_end_or_steps_are_fixed():
    assert other_settings(Settings(rtol=1e-9)).method == "dop853"
    assert other_settings(Settings(rtol=1e-14)).method != "dop853"
    fixed = rods(*DRAWS["tame 1"]).simulate(5, method="rk4", step=0.01)
    assert fixed.accuracy.other.settings.method == "dop853"
    right = true_digits(np.hstack(fixed.motion.sample(TIMES[:300])), solutions()["tame 1"][:300])
    assert abs(fixed.digits("th0", 5.0) - right[-1, 0]) <= 1


@pytest.mark.parametrize(
    ("value", "error", "size", "printed"),
    [
        (1.23456789, 1e-12, 2.0, "1.23457"),
        (1.23456789, 3e-3, 2.0, "1.23"),
        (1.2000001, 3e-3, 2.0, "1.20"),
        (-123456.0, 20.0, 2e5, "-1.235e+05"),
        (120.0, 0.3, 120.0, "120"),
        (1e-9, 1e-7, 1.0, "0"),
        (0.0, 1e-7, 1.0, "0"),
        (0.7, 3.0, 1.0, "no digit"),
        (0.7, math.inf, 1.0, "no digit"),
        (0.7, math.nan, 1.0, "0.7"),
        (0.7, 0.0, 1.0, "0.7"),
    ],
)
def test_a_figure_is_printed_with_the_digits_that_hold(value, error, size, printed):
    assert figure(Known(value, error, size)) == printed


def test_the_command_line_prints_no_digit_that_does_not_hold():
    asked = ["run", str(MODELS["GEN-CHAIN/two_bars"]), "--until", "30", "--no-report"]
    printed = CliRunner().invoke(cli.app, asked).output
    assert "no digit holds" in printed and printed.count("no digit ") >= 2
    data = json.loads(CliRunner().invoke(cli.app, [*asked, "--json"]).output)
    assert 0 < data["digits"]["until"]["6"] < data["digits"]["none_from"] < 30
    assert data["digits"]["better"]["rtol"] == pytest.approx(1e-14)


def test_an_instant_of_a_motion_is_told_with_how_far_that_is_known(tmp_path):
    m = rods(*FROM_135)
    m.save(tmp_path / "m.yaml")
    told = CliRunner().invoke(cli.app, ["solve", str(tmp_path / "m.yaml"), "--at", "20 s"]).output
    assert "The motion until then holds to 6 digits until" in told and "no digit" in told
    assert "digits" not in CliRunner().invoke(cli.app, ["solve", str(tmp_path / "m.yaml")]).output
    data = json.loads(CliRunner().invoke(cli.app, ["solve", str(tmp_path / "m.yaml"), "--at", "1 s", "--json"]).output)
    assert data["digits"]["none_from"] is None and data["digits"]["until"]["6"] is None


@pytest.mark.parametrize("g", [9.81, 9.7, 10, 3.7])
@pytest.mark.parametrize("side", ["--before", "--after"])
def test_how_far_an_impact_is_known_does_not_hang_on_which_of_two_runs_comes_to_it_first(tmp_path, side, g):
    (tmp_path / "m.yaml").write_text(f"""
freebody: 1
gravity: {g}
bodies: {{long: {{shape: rod, length: 1, mass: 1}}, short: {{shape: rod, length: 0.6, mass: 1}}}}
joints:
  O: {{type: hinge, of: [ground.O, long.start], coordinate: {{name: th, zero: down}}}}
  C: {{type: hinge, of: [ground.O, short.start], coordinate: {{name: ph, zero: down}}}}
initial: {{th: -1, ph: 0, at_rest: true}}
stops: {{hit: {{of: ph - th, least: 0, restitution: 0.5}}}}
run: {{until: 2}}
""")
    told = CliRunner().invoke(cli.app, ["solve", str(tmp_path / "m.yaml"), side, "hit"]).output
    assert "The motion until then holds to" in told and "no digit" not in told


@pytest.mark.parametrize("file", ["fbd.svg", "page.md", "page.tex", "page.html", "page.txt", "page.json"])
def test_what_is_drawn_and_printed_of_an_instant_tells_how_far_that_is_known(tmp_path, monkeypatch, file):
    monkeypatch.chdir(tmp_path)
    rods(*FROM_135).save(tmp_path / "m.yaml")
    told = [
        CliRunner().invoke(cli.app, ["diagram" if file == "fbd.svg" else "equations", "m.yaml", "-o", file, *asked]).exit_code
        or "The motion until then holds to" in (tmp_path / file).read_text(encoding="utf-8")
        for asked in (["--at", "1 s"], [])
    ]
    assert told == [True, False]


def test_of_several_equal_extremes_any_time_will_do():
    m = rods(*DRAWS["tame 0"])
    accuracy = m.simulate(2).accuracy
    band = accuracy.band(expression("th0"))
    value, small = float(band.values[100, 0]), 1e-12
    far, near = (accuracy.extreme(band, 0, (0.5, value), (there, value + small))[0] for there in (1.5, 0.5 + 1e-6))
    assert far.digits is None and figure(far) == "0.5"
    assert near.digits == 5 and figure(near) == "0.50000"


SENSED = ("tame 0", "tame 3", "tame 7", "sensitive 1", "sensitive 5")


@cache
def sensitivities():
    """How much the motions (nt, 4) change for each relative change of the start so far, by differences in extended precision."""
    near, small = [], LONG(1e-13)
    for name, part, i in product(SENSED, (2, 3), (0, 1)):
        start = [each.astype(LONG) for each in DRAWS[name]]
        start[part][i] *= 1 + small
        near.append(start)
    moved = np.moveaxis(exact(near, TIMES, 0.02), -1, 0).reshape(len(SENSED), 4, len(TIMES), 4)
    apart = (np.abs(each - solutions()[name]).sum(0) / small for name, each in zip(SENSED, moved, strict=True))
    return {name: np.maximum.accumulate(each.astype(float)) for name, each in zip(SENSED, apart, strict=True)}


@pytest.mark.xdist_group("exact solutions")
@pytest.mark.parametrize("method", ["dop853", "tsit5", "radau"])
@pytest.mark.parametrize("name", SENSED)
def test_errors_are_as_small_as_is_asked_times_the_sensitivity_of_the_motion(name, method):
    for digits in range(3 if "tame" in name else 4, 14):
        done = rods(*DRAWS[name]).simulate(10, rtol=10.0**-digits, method=method)
        exactly = solutions()[name]
        error = np.abs(np.hstack(done.motion.sample(TIMES)) - exactly).astype(float)
        owed = 10.0**-digits * (sensitivities()[name] + np.abs(exactly).max(0).astype(float))
        assert (error <= 30 * owed).all(), digits


@pytest.mark.parametrize("method", ["dop853", "tsit5", "radau"])
def test_no_step_runs_away_at_a_loose_tolerance(method):
    """What is made of energy is less than the rods have to fall from upright: a wild step is not judged beside its own size."""
    for name in DRAWS:
        lengths, masses, *_ = DRAWS[name]
        done = rods(*DRAWS[name]).simulate(10, rtol=1e-3, method=method)
        assert done.outcome.ok, name
        assert np.abs(done.energy.balance).max() < 2 * G * masses.sum() * lengths.sum(), name


def test_a_run_that_was_interrupted_is_followed_no_further():
    def ends(t: float) -> bool:
        return t < 1e4

    done = rods(*DRAWS["tame 0"]).simulate(1e6, rtol=1e-6, progress=ends)
    assert not done.outcome.ok and done.end.t < 1e6
    assert done.accuracy.other.end.t == done.end.t


@pytest.mark.parametrize("method", ["dop853", "tsit5", "radau"])
def test_a_short_push_that_the_run_steps_over_is_seen_by_the_other(method):
    """A particle at rest is pushed for a few thousandths of the run: v = ∫F dt/m, or nothing is claimed."""
    for seed in range(4):
        at, width = np.random.default_rng(seed).uniform([2, 3e-3], [8, 2e-2]).tolist()
        m = fb.Mechanism.loads(f"""
freebody: 1
gravity: none
bodies: {{p: {{shape: particle, mass: 1}}}}
joints: {{s: {{type: slot, along: {{through: ground.O, angle: 0}}, point: p.centre, coordinate: x}}}}
forces: {{push: {{type: law, along: x, value: "exp(-((t - {at!r})/{width!r})^2)"}}}}
initial: {{x: 0, at_rest: true}}
""")
        [speed] = m.simulate(10, method=method, rtol=1e-6).accuracy.figures(expression("rate(x)"), 10.0)
        assert abs(speed - width * math.sqrt(math.pi)) <= speed.error


@pytest.mark.parametrize("reach", [0.1, 0.16, 0.3])
def test_what_grows_without_bound_towards_a_dead_position_has_no_digit(reach):
    """A slider pulled to where crank and rod are in line: nothing that is read at the end depends on how near a run comes."""
    model = fb.Mechanism.loads(f"""
freebody: 1
bodies: {{a: {{shape: rod, length: 0.2, mass: 1}}, b: {{shape: rod, length: {reach}, mass: 1}}, c: {{shape: particle, mass: 1}}}}
joints:
  A: {{type: hinge, of: [ground.O, a.start], coordinate: theta}}
  B: {{type: hinge, of: [a.end, b.start], coordinate: beta}}
  C: {{type: hinge, of: [b.end, c.centre]}}
  guide: {{type: slot, along: {{through: ground.O, angle: 0}}, point: c.centre, coordinate: x}}
motions: {{pull: {{of: x, is: {reach} + 0.12 + 0.1*t}}}}
initial: {{guess: {{theta: 0.7, beta: -1.4, x: {reach + 0.12}}}}}
run: {{until: 3 s}}
report: {{F: max of A.F, E: kinetic() @ end, mean: rms of pull.force, least: min of theta, first: theta @ 0.1 s}}
""")
    runs = [model.simulate(rtol=rtol) for rtol in (1e-4, 1e-9, 1e-12)]
    assert all(run.outcome.name == "dead_position" for run in runs)
    figures = [run.accuracy.report for run in runs]
    for some, others in product(figures, figures):
        for label, known in some.items():
            assert abs(known.value - others[label].value) <= known.value.error + others[label].value.error
        assert abs(some["least"].value) <= some["least"].value.error  # it ends at θ = 0
    for known in figures:
        assert known["F"].value.digits == known["E"].value.digits == known["mean"].value.digits == 0
        assert known["first"].value.digits >= 4
    dead = 0.8
    assert all(abs(run.accuracy.end - dead) <= run.accuracy.end.error < 1e-2 for run in runs)


def test_when_extremes_are_is_not_known_again_once_it_was_not():
    """Of a double pendulum from 135°, whose two runs have maxima of their own after some time."""
    model = rods(*FROM_135)
    model.report("top", "maxima of th0")
    known = [each.t for each in model.simulate(20, rtol=1e-4).accuracy.report.values()]
    digits, errors = [t.digits for t in known], [t.error for t in known]
    assert digits[0] >= 3 and digits[-1] == 0 and errors == sorted(errors)

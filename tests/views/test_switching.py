"""What switches, as a person sees it: changes, moments, columns, files, plots, drawings. Expected values are closed forms."""

import json

import matplotlib
import numpy as np
import pytest

from freebody.mechanism import Mechanism
from freebody.run.peaks import peak_reactions
from freebody.run.simulation import Run
from freebody.views import plots
from freebody.views.animate import animate
from freebody.views.compare import compare
from freebody.views.contact_glyphs import way
from freebody.views.impact_markers import LASTING
from freebody.views.report import report_html
from freebody.views.scene import of_run
from freebody.views.style import IMPACT

matplotlib.use("Agg")

G, HEIGHT, PART = 9.81, 1.0, 0.7
FIRST = np.sqrt(2 * HEIGHT / G)  # s: the fall from the height


def bouncing() -> Mechanism:
    m = Mechanism("bouncing ball", gravity=G)
    ball = m.particle("ball", mass=2)
    m.contact("floor", ball.centre, m.ground.line("level", m.ground.O, angle=0), restitution=PART)
    m.initial(**{"ball.x": 0, "ball.y": HEIGHT}, at_rest=True)
    return m


def hanging() -> Mechanism:
    """A mass on a string over a pulley and an eyelet, with a spring that is not stretched; the string is cut after 0.2 s, the spring released."""
    m = Mechanism("hanging", gravity=G)
    load = m.particle("load", mass=3)
    top, ring = m.ground.point("top", [0.0, 1.0]), m.ground.point("ring", [-1.0, 0.0])
    pulley = {"pulley": top, "radius": 0.1, "sense": "clockwise"}
    m.string("cable", ring, load.centre, over=[m.ground.point("eye", [-1.0, 0.5]), pulley])
    m.spring(name="coil", between=[m.ground.point("home", [0.1, -1.0]), load.centre], stiffness=1, rest_length=1)
    m.initial(**{"load.x": 0.1, "load.y": 0.0}, at_rest=True)
    m.event("cut", at=0.2, then=[{"cut": "cable"}, {"release": "coil"}])
    m.report("pull before", "tension(cable) @ before cut")
    m.report("pull at", "tension(cable) @ cut")
    m.report("fall before the start", "load.y @ start")
    return m


@pytest.fixture(scope="module")
def run():
    return bouncing().simulate(until=1.3)


@pytest.fixture(scope="module")
def cut():
    return hanging().simulate(until=0.4)


def test_impacts_tell_time_energy_impulse_and_states(run):
    first, second = run.impacts
    speed = G * FIRST
    assert (first.kind, first.of, first.note) == ("impact", ("floor",), "")
    assert first.t == pytest.approx(FIRST, rel=1e-10) and second.t == pytest.approx(FIRST * (1 + 2 * PART), rel=1e-10)
    assert first.lost == pytest.approx(2 * G * HEIGHT * (1 - PART**2), rel=1e-9)
    assert first.impulses.contacts["floor"] == pytest.approx((0, 2 * speed * (1 + PART)), rel=1e-9)
    assert first.before.u["ball.y"] == pytest.approx(-speed, rel=1e-9)
    assert first.after.u["ball.y"] == pytest.approx(PART * speed, rel=1e-9) and first.before.q == first.after.q
    assert "2 × impact" in str(run)


def test_a_switch_is_on_the_grid_with_what_is_just_after_it(run):
    i = int(np.flatnonzero(run.t == run.impacts[0].t)[0])
    assert run["rate(ball.y)"][i] == pytest.approx(PART * G * FIRST, rel=1e-9)
    assert run.before("rate(ball.y)", run.t[i]) == pytest.approx(-G * FIRST, rel=1e-9)
    assert run.before("ball.y", 0.0) == HEIGHT
    assert run["impacts"][-1] == -sum(change.lost for change in run.impacts)


def test_moments_before_an_event(cut):
    assert cut.report["pull before"].value == pytest.approx(3 * G, rel=1e-9)
    assert cut.report["pull before"].note == "just before" and cut.report["pull before"].t == pytest.approx(0.2)
    assert cut.report["pull at"].value == 0.0


def test_columns_of_contacts_have_their_expressions_values(run, cut):
    assert {c.name: c.unit for c in run.columns if c.kind == "limit"} == {"floor.N": "N", "floor.T": "N", "floor.gap": "m"}
    assert [c.name for c in cut.columns if c.kind == "limit"] == ["cable.tension", "cable.gap"]
    for each in (run, cut):
        for column, values in zip(each.columns, np.hstack(list(each.blocks.values())).T, strict=True):
            assert each[column.name] == pytest.approx(values, abs=1e-12), column.name


@pytest.mark.parametrize("suffix", [".nc", ".csv"])
def test_changes_come_back_from_a_file(suffix, cut, run, tmp_path):
    for each in (cut, run):
        back = Run.load(each.save(tmp_path / f"run{suffix}"))
        assert back.changes == each.changes and back.columns == each.columns
        assert np.array_equal(back.blocks["limit"], each.blocks["limit"])
        assert len(of_run(back).cords) == len(of_run(each).cords) and "Mode changes" in report_html(back)
        assert len(peak_reactions(back)) == len(peak_reactions(each))


def test_runs_are_compared_beside_what_switches(run):
    stated = compare(run, bouncing().simulate(until=1.3, rtol=1e-7))
    assert stated.largest.relative < 1e-5
    assert not set(stated.t) & {change.t for change in run.impacts} and not stated.parting
    longer = compare(run, bouncing().simulate(until=1.6))
    assert longer.parting.endswith("nothing in the first, impact of floor in the second")


def test_peaks_leave_out_what_cannot_carry_and_tell_contacts(run, cut):
    assert [peak.joint for peak in peak_reactions(run)] == ["floor"]
    (peak,) = peak_reactions(cut)
    assert peak.joint == "cable" and peak.size == pytest.approx(3 * G, rel=1e-9)


def test_curves_break_where_something_switches(run, cut):
    (line,) = [line for line in plots.series(run, "rate(ball.y)").lines if len(line.get_xdata()) > 10]
    t, rate = line.get_data()
    (gap, *_) = np.flatnonzero(np.isnan(rate))
    assert t[gap] == t[gap + 1] == run.impacts[0].t
    assert rate[gap - 1] == pytest.approx(-G * FIRST, rel=1e-9) and rate[gap + 1] == pytest.approx(PART * G * FIRST, rel=1e-9)
    drawn = {line.get_label(): line.get_ydata() for line in plots.reactions(cut).lines}
    assert np.nanmax(drawn["cable.tension"]) == pytest.approx(3 * G, rel=1e-9)
    assert "work of impacts" in {line.get_label() for line in plots.energy(run).lines}


def test_the_report_shows_what_switched(run):
    page = report_html(run)
    data = json.loads(page.split('id="data">')[1].split("</script>")[0])
    assert [mark["kind"] for mark in data["marks"] if mark["kind"] != "switch"] == ["impact", "impact"]
    assert "Contacts, strings, stops, locks and motions" in {plot["title"] for plot in data["plots"]}
    assert "<h2>Mode changes</h2>" in page and "ball free" not in page.split("Peak reactions")[1].split("</section>")[0]


def test_surfaces_are_hatched_on_the_solid_side(run):
    ground = of_run(run).figures["ground"]
    hatch = np.vstack([stroke.points for stroke in ground.strokes if stroke.style == "hatch"])
    assert len(hatch) > 8 and hatch[:, 1].min() < -1e-3 and hatch[:, 1].max() == 0


def test_a_string_is_drawn_until_it_is_cut(cut):
    scene = of_run(cut)
    (cord,) = scene.cords
    (coil,) = scene.pairs
    assert (cord.shown == (scene.t < 0.2)).all() and (coil.shown == cord.shown).all() and cord.taut[0]
    # From the ring to the eye, on to the pulley, a part of it round, and down: the length of what is drawn, by hand.
    free = np.hypot(1.0, 0.5)
    tangent = np.sqrt(free**2 - 0.1**2)
    bow = 0.1 * (np.pi / 2 + np.arctan2(0.5, 1.0) + np.arcsin(0.1 / free))
    length = np.hypot(*np.diff(cord.path[0], axis=0).T).sum()
    assert length == pytest.approx(0.5 + tangent + bow + 1.0, rel=1e-4)
    assert scene.pair_lines(coil, len(scene.t) - 1) == []


@pytest.mark.parametrize("senses", [(1, 1), (1, -1), (-1, 1)])
def test_strings_touch_their_circles(senses):
    """The straight part between two circles is √(L² − (r₁ ∓ r₂)²) long, as that of a belt, open or crossed."""
    r, s, apart = 0.3, 0.2, 1.5
    ends = [np.array([[-9.0, 0.3 * senses[0]]]), np.array([[9.0, 0.2]])]
    centres = [ends[0], np.zeros((1, 2)), np.array([[apart, 0.0]]), ends[1]]
    path = way(centres, (0.0, senses[0] * r, senses[1] * s, 0.0), np.zeros(1), np.array([0.0, -1.0]))[0]
    steps = np.hypot(*np.diff(path, axis=0).T)
    assert np.isclose(steps, np.sqrt(apart**2 - (senses[0] * r - senses[1] * s) ** 2)).any()


def test_what_is_slack_hangs_down():
    ends = [np.zeros((2, 2)), np.array([[1.0, 0.0]] * 2)]
    taut, slack = way(ends, (0.0, 0.0), np.array([0.0, 0.01]), np.array([0.0, -1.0]))
    assert np.allclose(taut[:, 1], 0) and slack[:, 1].min() < -0.05
    assert np.hypot(*np.diff(slack, axis=0).T).sum() == pytest.approx(1.01, abs=1e-3)


def test_the_drawing_names_strings_and_forces_of_contacts():
    stated = {text.get_text() for text in hanging().drawing().texts}
    assert "cable: 29.43 N" in stated
    m = bouncing()
    m.initial(**{"ball.y": 0})
    assert "floor: 19.62 N" in {text.get_text() for text in m.drawing().texts}


def test_an_instant_tells_its_contacts():
    now, after = hanging().solve(), hanging().opening()
    assert after is None and now.limits["cable"].state == "taut" and pytest.approx(3 * G) == now.limits["cable"].N
    assert "contacts, strings and stops" in str(now) and "load free" not in str(now)
    m = hanging()
    m.event("let go", at="start", then={"cut": "cable"})
    opening = m.opening()
    after = opening.instant(0.0)
    assert m.solve(before="start").accelerations["load.y"] == pytest.approx(0, abs=1e-12)
    assert after.accelerations["load.y"] == pytest.approx(-G) and after.limits["cable"].state == "off"
    assert after["cable.tension"] == 0 and after["load.y"] == 0
    m.report("pull just before", {"value": "cable.tension", "at": "before let go"})
    m.report("pull just after", "cable.tension @ let go")
    stated = m.simulate(until=0.01).report
    assert stated["pull just before"].value == pytest.approx(3 * G) and stated["pull just after"].value == 0
    assert [(change.kind, change.of) for change in opening.changes][-1] == ("released", ("cable",))


def test_impacts_flash_up_in_films_where_they_strike(run, cut):
    """The ball strikes at its own place, the second time with the part of the impulse that the first left."""
    first, second = of_run(run).impact_markers
    assert (first.t, second.t) == pytest.approx((FIRST, FIRST * (1 + 2 * PART)), abs=1e-9)
    assert first.at == pytest.approx((0, 0), abs=1e-9) and first.strength == 1
    assert second.strength == pytest.approx(np.sqrt(PART), rel=1e-9)
    assert [first.glow(first.t + dt, 0.2) for dt in (-1e-6, 0.0, 0.1, 0.2)] == pytest.approx([0, 1, 0.5, 0])
    assert of_run(cut).impact_markers == []


def test_frames_show_an_impact_for_a_moment_of_the_film(run, tmp_path):
    """Half as fast as life, so the flash is gone after half of its time in the film."""
    fps, speed = 20, 0.5
    first = animate(run, tmp_path / "ball.svg", fps=fps, speed=speed)
    frames = sorted(tmp_path.glob("ball_*.svg"))
    assert frames[0] == first
    times = np.linspace(0, run.edges[-1], len(frames))
    lit = [IMPACT in frame.read_text() for frame in frames]
    strikes = np.array([change.t for change in run.impacts])
    wanted = [bool(((strikes <= t) & (t < strikes + LASTING * speed)).any()) for t in times]
    assert lit == wanted and any(lit) and not all(lit)

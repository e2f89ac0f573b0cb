"""What a diagram is called, says and becomes on paper."""

import json
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from typer.testing import CliRunner

from freebody.catalogue import model_file
from freebody.cli import app
from freebody.mechanism import Mechanism
from freebody.views.diagram.gallery import write_gallery
from freebody.views.diagram.names import symbol
from freebody.views.diagram.paper import round_below
from freebody.views.diagram.rows import MARGIN
from freebody.views.labels import Label, Obstacles, placed

GUN = "systems/S19.17-new-gun/model.yaml"
TRACK = r"N_{\text{track}}"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def gun():
    return Mechanism.load(GUN)


def labels(cut):
    return {mark.action.label for mark in cut.forces}


def test_symbols_are_short_and_those_of_the_model(gun):
    rod, collar = gun.diagram().cuts
    assert labels(rod) == {r"\mathrm{pivot}_x", r"\mathrm{pivot}_y", TRACK, "T"}
    assert labels(collar) == {TRACK}
    assert {mark.action.label for mark in collar.effective} == {r"m_2\,a_{\text{collar},x}", r"m_2\,a_{\text{collar},y}"}


@pytest.mark.parametrize(
    ("name", "shown"),
    [("m2", "m_2"), ("mA", "m_A"), ("phi[3]", r"\phi_3"), ("m_rod", r"m_{\text{rod}}"), ("theta", r"\theta")],
)
def test_letters_of_names(name, shown):
    assert symbol(name) == shown


def test_a_spring_and_its_damper_have_symbols():
    m = Mechanism("two carts", gravity=0)
    bodies = [m.particle(name, mass=1) for name in ("a", "b")]
    for body, x in zip(bodies, ("xa", "xb"), strict=True):
        m.free(m.ground.O, body.centre, coordinates=[x, f"y{x[1]}"])
    m.spring(name="spring", between=[m.ground.O, bodies[0].centre], stiffness=2, damping=1)
    m.spring(name="hook", between=[bodies[0].centre, bodies[1].centre], stiffness=2, damping=1)
    m.initial(xa=1, xb=2)
    first, second = m.diagram().cuts
    hook = {r"F_{\text{hook}}", r"F_{\text{hook damper}}"}
    assert labels(first) == {r"F_{\text{spring}}", r"F_{\text{damper}}", *hook}
    assert labels(second) == hook
    lines = [mark for mark in first.forces if mark.action.name == "spring"]
    assert np.hypot(*(lines[0].tail - lines[1].tail)) >= 6.0  # beside each other, though on one line


ON_A_DOME = """
freebody: 1
ground: {curves: {dome: {x: "2*cos(s)", y: "WAY*2*sin(s)"}}}
bodies: {wheel: {shape: disk, radius: 0.3, mass: 1}}
joints: {touch: {type: cam, along: ground.dome, follower: {centre: wheel.G, radius: 0.3}, right: RIGHT, coordinates: [s, phi]}}
initial: {s: WAY*90 deg, phi: 0}
"""


@pytest.mark.parametrize(("way", "right", "side"), [("-1", "false", 1), ("1", "false", -1), ("1", "true", 1), ("-1", "true", -1)])
def test_a_follower_is_drawn_on_its_side_and_its_force_where_it_touches(way, right, side):
    """On the left of its curve: outside of a dome that is gone over clockwise, below one that is gone over counter-clockwise; on its
    right the other way round. What is hatched lies on the other side."""
    [cut] = Mechanism.loads(ON_A_DOME.replace("WAY", way).replace("RIGHT", right)).diagram().cuts
    panel = cut.panels[0]
    normal = next(mark for mark in cut.forces if mark.action.name == "touch")
    assert normal.at == pytest.approx(panel.scenery.scale * np.array([0, 2]), abs=1e-6)
    assert panel.scenery.centres["wheel"] == pytest.approx(panel.scenery.scale * np.array([0, 2 + side * 0.3]))
    hatches = [stroke.points for stroke in panel.scenery.sketch.strokes() if stroke.style == "hatch"]
    assert hatches and all(np.sign(np.hypot(*line[1]) - np.hypot(*line[0])) == -side for line in hatches)


def test_a_group_has_neither_the_forces_within_nor_its_bodies_alone(gun):
    [both] = gun.diagram("rod+collar").cuts
    assert both.group == ("rod", "collar")
    assert labels(both) == {r"\mathrm{pivot}_x", r"\mathrm{pivot}_y", "T"}
    assert [cut.group for cut in gun.diagram(["collar", "all"]).cuts] == [("collar",), ("rod", "collar")]


def test_the_effective_side_may_be_left_out(gun):
    assert not any(cut.effective for cut in gun.diagram(effective=False).cuts)


def test_a_place_may_be_given(gun):
    [cut] = gun.diagram("collar", theta="90 deg").cuts
    [normal] = cut.forces
    assert normal.head - normal.tail == pytest.approx([-np.hypot(*(normal.head - normal.tail)), 0], abs=1e-9)


def test_svg_is_said_to_those_who_cannot_see_it_and_its_text_is_text(gun):
    root = ElementTree.fromstring(gun.diagram()._repr_svg_())
    assert root.get("role") == "img"
    assert root[0].tag == f"{SVG}title" and gun.source().name in root[0].text
    assert root[1].tag == f"{SVG}desc" and "pivot_x to the right on rod" in root[1].text
    assert root.findall(f".//{SVG}text")


def test_the_same_model_gives_the_same_picture(gun):
    assert gun.diagram().svg() == Mechanism.load(GUN).diagram().svg()


def test_a_body_that_is_none(gun):
    with pytest.raises(ValueError, match="no body is called 'barrel'; there are rod, collar"):
        gun.diagram("rod+barrel")


def test_a_column_without_room(gun):
    with pytest.raises(ValueError, match="a column of 60 mm or more, not 20"):
        gun.diagram(column=20)


def test_a_time_that_is_never_reached(gun):
    with pytest.raises(ValueError, match="the motion ends at"):
        gun.diagram(at="100 s")


@pytest.mark.parametrize("suffix", ["svg", "png", "pdf", "tex"])
def test_the_command_writes_a_picture(tmp_path, suffix):
    file = tmp_path / f"fbd.{suffix}"
    done = CliRunner().invoke(app, ["diagram", GUN, "-o", str(file), "--of", "all", "--at", "theta=30 deg", "--to-scale"])
    assert done.exit_code == 0, done.output
    assert file.stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--of", "barrel"], "there are rod, collar"),
        (["-o", "fbd.docx"], ".svg, .png, .pdf or .tex"),
        (["--at", "1 s", "--at", "theta=0"], "--at takes one time, or coordinates"),
    ],
)
def test_mistakes_are_said_in_a_line(arguments, said):
    done = CliRunner().invoke(app, ["diagram", GUN, *arguments])
    assert done.exit_code == 2
    assert said in done.output


def test_the_list_of_forces_is_printed_and_adds_up():
    """Forces at their points and couples, times the values, give m a at G and the moment about it."""
    done = CliRunner().invoke(
        app, ["diagram", "systems/GEN-FOURBAR-four-bar-positions/model.yaml", "--json", "--of", "bc", "--of", "ab+bc"]
    )
    assert done.exit_code == 0, done.output
    for stated in json.loads(done.output):
        effective, sums = stated["effective"], np.zeros(3)
        for load in stated["loads"]:
            for part in load["on"]:
                (x, y), (fx, fy) = np.subtract(part["point"], effective["about"]), part["force"]
                sums += load["value"] * np.array([fx, fy, part["couple"] + x * fy - y * fx])
        assert sums == pytest.approx([*effective["force"], effective["moment"]], rel=1e-9, abs=1e-9)
        assert {load["letter"] for load in stated["loads"]} >= {"C_x", "C_y"}


def test_a_scale_bar_says_its_newtons_in_full():
    """Of 20000 N, that a quarter car's tyre takes at a kerb; it was 2e+04 N."""
    assert ">20000 N<" in Mechanism.load("systems/GEN-SUSP-suspensions/one_sided.yaml").diagram(to_scale=True).svg()


def test_a_pdf_has_pages(tmp_path):
    """Three bodies of a four-bar stand on one page, all seven of a walker on six, each no higher than the text of a page."""
    for model, pages in (("GEN-FOURBAR/model", 1), ("GEN-STEP/model", 6)):
        file = Mechanism.load(model_file(model)).diagram().save(tmp_path / "fbd.pdf")
        boxes = re.findall(rb"/MediaBox \[ ?0 0 ([0-9.]+) ([0-9.]+) ?\]", file.read_bytes())
        assert len(boxes) == pages
        assert all(float(height) <= 700 + 2 * MARGIN for _, height in boxes)


def test_the_page_of_all_diagrams(tmp_path):
    page = tmp_path / "page.html"
    done = CliRunner().invoke(app, ["systems", "19.3.23", "--diagrams", "-o", str(page)])
    assert done.exit_code == 0, done.output
    text = page.read_text(encoding="utf-8")
    assert text.count("<section ") == 3 and "no inertia" in text
    own = [line.split('"')[0] for line in text.split(' id="')[1:]]
    assert len(own) == len(set(own))
    assert {line.split('"')[0] for line in text.split(' href="#')[1:]} <= set(own)


@pytest.mark.long
def test_the_page_shows_the_first_impact_of_every_kind(tmp_path):
    """A wheel of eight feet that fall one after another has one kind; a foot and a stop at one time are two."""
    page = tmp_path / "page.html"
    models = {"19.3.30": "systems/19.3.30-rimless-wheel/model.yaml", "GEN-STEP": "systems/GEN-STEP-one-foot/floor.yaml"}
    write_gallery([(name, Mechanism.load(path)) for name, path in models.items()], page)
    text = page.read_text(encoding="utf-8")
    assert re.findall(r"<h3>Impact (\d+) of the run, of ([^,]*),", text) == [("1", "foot[2]"), ("1", "other"), ("2", "foot")]
    assert text.count("<title>impulse diagrams of ") == 1 + 2 * 2
    own = re.findall(r' id="([^"]*)"', text)
    assert len(own) == len(set(own))


def test_labels_of_one_place_make_room_for_each_other():
    wanted = [Label(f"label {i}", np.zeros((1, 2)), 9.0, "k") for i in range(12)]
    found = placed(wanted, Obstacles.of((np.zeros((1, 2)), 1.0)))
    for i, a in enumerate(found):
        for b in found[:i]:
            assert (np.abs(a.centre - b.centre) >= a.half + b.half - 1e-9).any()


@pytest.mark.parametrize(("value", "bar"), [(7.3, 5), (1.0, 1), (0.3, 0.2), (99, 50), (1e-3, 1e-3)])
def test_a_scale_bar_is_of_a_round_number(value, bar):
    assert round_below(value) == pytest.approx(bar)


def test_a_time_of_the_motion(gun):
    [then] = gun.diagram("collar", at="0.5 s", to_scale=True).cuts
    run = gun.simulate("0.5 s")
    [normal] = then.forces
    size = np.hypot(*(normal.head - normal.tail)) / then.per_newton
    assert size == pytest.approx(abs(run.evaluate("track.Fn", 0.5)), rel=1e-9)


def test_the_weight_of_a_speck_of_dust_is_a_figure():
    m = Mechanism("speck")
    m.free(m.ground.O, m.particle("speck", mass=1e-12).centre, coordinates=["x", "y"])
    [cut] = m.diagram(to_scale=True).cuts
    assert [mark.action.sign.plain for mark in cut.forces] == ["m_speck g = 9.81e−12 N"]


def test_what_was_released_acts_no_more():
    m = Mechanism("two carts, released at the start", gravity=0)
    bodies = [m.particle(name, mass=1) for name in ("a", "b")]
    m.free(m.ground.O, bodies[0].centre, coordinates=["xa", "ya"])
    m.free(m.ground.O, bodies[1].centre, coordinates=["xb", "yb"])
    m.link(bodies[0].centre, bodies[1].centre, name="bar", length=1)
    m.event("cut", at="start", then={"release": "bar"})
    m.initial(xb=1)
    before, after = m.diagram("a", before="start").cuts[0], m.diagram("a").cuts[0]
    assert [mark.action.name for mark in before.forces] == ["bar"]
    assert after.forces == []


@pytest.mark.parametrize("figures", range(6))
def test_values_have_the_figures_that_hold(figures):
    """Of 2 kg · 9.81 m/s² = 19.62 N, and none where no digit holds."""
    text = "freebody: 1\nbodies: {b: {shape: particle, mass: 2 kg}}\ninitial: {b.x: 0, b.y: 0, at_rest: true}"
    drawn = Mechanism.loads(text).diagram(to_scale=True, effective=False).with_remark("So far.", figures)
    value = ("g", "= 2e+01 N", "= 20 N", "= 19.6 N", "= 19.62 N", "= 19.62 N")[figures]
    [mark] = drawn.cuts[0].forces
    assert mark.action.sign.plain.endswith(value) and ("=" in mark.action.sign.plain) is bool(figures)

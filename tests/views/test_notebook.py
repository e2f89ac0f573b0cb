"""What a notebook shows, and what its tab key offers."""

import html
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import freebody as fb
from freebody.run.progress import reporting
from freebody.views import notebook
from freebody.views.report import report_html

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def four_bar():
    return fb.load(ROOT / "examples/four_bar.yaml")


@pytest.fixture(scope="module")
def run(four_bar):
    return four_bar.simulate(until=0.2)


def test_a_mechanism_shows_itself_as_soon_as_it_can_start(four_bar):
    shown = four_bar._repr_html_()
    assert shown.startswith("<svg") and all(name in shown for name in ("crank", "coupler", "rocker"))
    begun = fb.Mechanism("begun")
    assert begun._repr_html_() is None
    rod = begun.rod("rod", length=1, mass=1)
    begun.link(begun.ground.O, rod.start, name="tie", length=-1)
    assert begun._repr_html_() is None


def test_tables_say_what_is_solved(four_bar, run):
    now = four_bar.solve()
    rows = re.findall(r"<tr>(.*?)</tr>", now.reactions._repr_html_())
    shown = [re.findall(r"<td[^>]*>(.*?)</td>", row) for row in rows[1:]]
    stated = {
        (name, on): (float(x), float(y)) for (name, on, x, y), name in zip(shown, np.repeat(["A", "B", "D", "C"], 2), strict=True)
    }
    for name, reaction in now.reactions.items():
        for body in (reaction.first, reaction.second):
            side = reaction.on(body)
            assert stated[name, body] == pytest.approx((float(side.Fx), float(side.Fy)), rel=1e-5)
    assert now.reactions._repr_html_() in now._repr_html_() and "rad/s²" in now._repr_html_()
    assert f"{run['theta'].max():.6g}" in run._repr_html_() and run.outcome.sentence in run._repr_html_()
    assert f"{run.reactions['B'].size.max():.6g}" in run.reactions._repr_html_()
    assert "0x" not in repr(now) + repr(run)


def test_names_are_no_mark_up():
    made = fb.Mechanism("pendulum")
    made.hinge(made.ground.O, made.rod("<b>", length=1, mass=1)["start"], name="a<b", coordinate="theta")
    assert "<b>" not in made.solve()._repr_html_()


def test_all_that_is_offered_can_be_asked(four_bar, run):
    now = four_bar.solve()
    for owner in (four_bar, four_bar["crank"], four_bar.parameters, now, run):
        offered = owner._ipython_key_completions_()
        assert offered
        for key in offered:
            try:
                owner[key]
            except fb.Indeterminate:
                pytest.fail(f"{key} is offered and has no value")


def test_what_is_offered_of_a_mechanism_is_what_is_documented(four_bar):
    documented = " ".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md"))
    offered = set(dir(four_bar))
    asked = {name for name in re.findall(r"\bm\.(\w+)\(", documented) if hasattr(fb.Mechanism, name)}
    assert asked <= offered and {"rod", "hinge", "spring", "solve", "ground"} <= offered
    assert not any(name.startswith("_") for name in offered) and not offered & {"lowered", "core_errors", "validated", "put"}
    assert set(dir(fb)) == set(fb.__all__)


def test_the_package_has_types():
    assert (Path(fb.__file__).parent / "py.typed").exists()


def without(monkeypatch, module):
    monkeypatch.setitem(sys.modules, module, None)
    notebook._widget.cache_clear()


def test_a_player_is_the_report_in_a_frame_also_without_a_widget(run, monkeypatch):
    without(monkeypatch, "anywidget")
    shown = notebook.player(run)._repr_html_()
    assert html.unescape(re.search('srcdoc="(.*)"></iframe>', shown, re.DOTALL)[1]) == report_html(run)


def test_a_widget_shares_its_time(run):
    pytest.importorskip("anywidget")
    notebook._widget.cache_clear()
    player = notebook.player(run, height=400)
    assert player.page == report_html(run) and player.t == 0 and "postMessage" in str(player._esm)
    assert {"page", "height", "t"} <= {*player.keys}  # what the browser is told
    assert "window.parent" in player.page  # and what the page answers with


def test_a_bar_follows_a_run(four_bar, monkeypatch, capsys):
    pytest.importorskip("tqdm")
    four_bar.simulate(until=0.2, progress=True)
    assert "0.2 of 0.2 s" in capsys.readouterr().err
    with reporting(True, 2.0) as progress:
        assert progress(0.5) and progress(1.5)
    assert "2 of 2 s" in capsys.readouterr().err
    without(monkeypatch, "tqdm.auto")
    with pytest.raises(ImportError, match="pip install tqdm"):
        four_bar.simulate(until=0.2, progress=True)

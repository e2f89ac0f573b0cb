"""The report: complete, self-contained, harmless whatever names a model uses, and alive in a browser."""

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import numpy as np
import pytest

from freebody import Mechanism
from freebody.run.peaks import peak_reactions
from freebody.run.simulation import Run
from freebody.views.report import report_html, write_report
from freebody.views.report.data import report_data
from freebody.views.report.series import Curve, _resolved, plots
from freebody.views.report.tables import Table, beside, raised

from .models import run_double_pendulum

EVIL = '</script><script>document.title="hacked"</script><img src=x onerror=alert(1)>'


class Tags(HTMLParser):
    """All elements with their attributes, and the text of the data element."""

    def __init__(self, text):
        super().__init__()
        self.found, self.data, self._inside = [], "", False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        self._inside = dict(attrs).get("id") == "data"

    def handle_data(self, text):
        self.data += text if self._inside else ""

    def handle_endtag(self, tag):
        self._inside = False


def test_the_page_loads_nothing(four_bar):
    page = report_html(four_bar)
    tags = Tags(page).found
    assert not [
        tag for tag in tags if {"src", "href", "style", "srcset"} & tag[1].keys() or any(name.startswith("on") for name in tag[1])
    ]
    addresses = set(re.findall(r"https?://[^\"'` ]+", page))
    namespaces = {f"http://www.w3.org/{name}" for name in ("1998/Math/MathML", "1999/xhtml", "1999/xlink", "2000/svg", "2000/xmlns/",
                                                             "XML/1998/namespace")}  # fmt: skip
    assert addresses <= namespaces  # names of languages, not addresses to be fetched
    assert not re.search(r"@import|url\(|fetch\(|XMLHttpRequest|\.innerHTML|eval\(", page)


def test_names_are_harmless():
    run = run_double_pendulum(until=0.2, name=EVIL)
    page = report_html(run)
    tags = Tags(page)
    assert [tag for tag, _ in tags.found].count("script") == 2 and "img" not in [tag for tag, _ in tags.found]
    assert EVIL not in page and "&lt;script&gt;" in page
    assert EVIL not in tags.data


def test_the_page_says_it_all(four_bar):
    page = report_html(four_bar)
    for words in (
        "the end time was reached",
        "largest bearing load",
        "crank level",
        "Peak reactions",
        "Energy ledger",
        "rocker bearing",
        "joints have no friction and no clearance",
    ):
        assert words.lower() in page.lower(), words
    data = json.loads(Tags(page).data)
    titles = [plot["title"] for plot in data["plots"]]
    assert {"Coordinates", "Rates", "Accelerations", "Energy", "Reported quantities"} <= set(titles)
    assert len(data["scene"]["t"]) >= 180


def test_curves_of_another_run_lie_over_those_of_the_same_name():
    """At their own times and with their own values; what only one has stays alone."""
    one, other = run_double_pendulum(until=0.2), run_double_pendulum(until=0.1)
    alone, [theirs] = report_data(one)["plots"], [plot for plot in plots(other) if plot["title"] == "Coordinates"]
    for before, plot in zip(alone, report_data(one, {"short": other})["plots"], strict=True):
        own, added = plot["curves"][: len(before["curves"])], plot["curves"][len(before["curves"]) :]
        assert own == before["curves"] and [f"{own[each['beside']]['name']} (short)" for each in added] == [
            each["name"] for each in added
        ]
        if plot["title"] == "Coordinates":
            assert [(each["t"], each["y"]) for each in added] == [(theirs["t"], each["y"]) for each in theirs["curves"]]


def test_powers_of_ten_are_raised_and_nothing_else_is_markup():
    assert raised("1.2 × 10^−5 N & <b>") == "1.2 × 10<sup>−5</sup> N &amp; &lt;b&gt;"


def test_lines_that_are_alike_are_one():
    rows = [("tap", f"{t}", "touch") for t in range(7)] + [("knock", "9", "touch")]
    table = Table("Events", ("event", "t / s", "kind"), rows, alike=(0, 2))
    (line, folded), (none, single) = table.groups
    assert line == ["tap, 7 times", "0 to 6", "touch"] and folded == rows[:7]
    assert none is None and single == rows[7:]


def test_crossings_up_and_down_are_one_line():
    swing = "{shape: rod, length: 1, mass: 1}"
    hinge = "{type: hinge, of: [ground.O, rod.start], coordinate: a}"
    run = Mechanism.loads(
        f"freebody: 1\nbodies: {{rod: {swing}}}\njoints: {{pin: {hinge}}}\ninitial: {{a: -30 deg, at_rest: true}}\n"
        "events: {down: {when: a + 90 deg}}\nrun: {until: 20 s}"
    ).simulate()
    [events] = [table for table in beside(run) if table.title == "Events"]
    [(line, folded)] = events.groups
    assert line[0] == f"down, {len(run.events)} times" and {row[2] for row in folded} == {"crossing ↑", "crossing ↓"}


def test_what_is_round_off_is_zero():
    kept, none = _resolved([Curve("force", np.array([0.0, 3.0, -2.0])), Curve("noise", np.array([1e-12, -1e-13, np.nan]))])
    assert kept.y.tolist() == [0.0, 3.0, -2.0] and none.y[:2].tolist() == [0.0, 0.0] and np.isnan(none.y[2])


def test_an_indeterminate_reaction_has_no_figure(indeterminate):
    page = report_html(indeterminate)
    row = re.search(r"<tr><td>knee</td>.*?</tr>", page)[0]
    assert "indeterminate" in row and not re.search(r"\d", row)


def test_peaks_are_refined(four_bar):
    peaks = {peak.joint: peak for peak in peak_reactions(four_bar)}
    for name, reaction in four_bar.reactions.items():
        assert peaks[name].size >= reaction.size.max()
        assert peaks[name].Fx ** 2 + peaks[name].Fy ** 2 == pytest.approx(peaks[name].size ** 2)
    assert peaks["main bearing"].size == pytest.approx(four_bar.report["largest bearing load"].value, rel=1e-9)


def test_a_loaded_run_has_a_report(four_bar, tmp_path):
    back = Run.load(four_bar.save(tmp_path / "run.csv"))
    assert "Peak reactions" in report_html(back)


@pytest.mark.long
def test_a_browser_shows_and_moves_it(tmp_path):
    chromium = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))))
    page = write_report(run_double_pendulum(until=0.5), tmp_path / "report.html")
    flags = [
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-background-networking",
        "--enable-logging=stderr",
        "--v=0",
    ]
    command = [
        chromium,
        *flags,
        f"--user-data-dir={tmp_path / 'profile'}",
        "--virtual-time-budget=2000",
        "--dump-dom",
        page.as_uri(),
    ]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=True)
    assert "CONSOLE" not in done.stderr, done.stderr
    assert "<title>double pendulum</title>" in done.stdout
    assert done.stdout.count("<svg") >= 6 and "t = 0.00" in done.stdout
    assert len(re.findall(r'<path (?=[^>]*class="curve)[^>]* d="M', done.stdout)) >= 10

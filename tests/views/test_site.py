"""The pages of the catalogue: what a page shows is what was computed, every link leads somewhere, every part has an example that runs."""

import re
import shutil
import time
from html.parser import HTMLParser
from pathlib import Path

import pytest
from store import every

import freebody as fb
from freebody import catalogue
from freebody.catalogue import System
from freebody.catalogue.sentences import sentence
from freebody.site import write_site
from freebody.site.parts import FOLDER, PARTS, part_page
from freebody.views.moving_picture import HEIGHT, WIDTH, moving_picture
from views.test_front_end import in_browser

LINES = 17
"""An example is taken in at a glance."""
NAMES = {part.word: part for part in PARTS}
QUESTIONS = '''"""tiny: a particle falls.

v = g t."""

from freebody.catalogue import Answer, ask


@ask("How fast is it after 1 s?")
def speed(case):
    yield Answer("v", case.run().evaluate("-vy(ball.centre)", 1.0), "m/s", 9.81, "closed form: g t", 1e-10)
'''
MODEL = """freebody: 1
name: a particle falls
bodies: {ball: {shape: particle, mass: 1 kg}}
initial: {ball.y: 0, at_rest: true}
run: {until: 1 s}
"""


class Links(HTMLParser):
    """Where a page leads to, and the places in it."""

    def __init__(self, text):
        super().__init__()
        self.to, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.to += [given[name] for name in ("href", "src", "xlink:href") if given.get(name)]
        self.places |= {given["id"]} if given.get("id") else set()


def dead_links(folder: Path, elsewhere: bool = False) -> list[str]:
    """Links of pages to what is not there; and to ``elsewhere`` unless these are meant."""
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in folder.rglob("*.html")}
    dead = []
    for path, links in pages.items():
        for link in links.to:
            if elsewhere and ":" in link:
                continue
            file, _, place = link.partition("?")[0].partition("#")
            target = (path.parent / file).resolve() if file else path
            lost = ":" in link or not target.is_file() or (place and target in pages and place not in pages[target].places)
            dead += [f"{path.relative_to(folder)}: {link}"] if lost else []
    return dead


@pytest.fixture
def tiny(tmp_path):
    """A system of a particle that falls."""
    folder = tmp_path / "systems" / "tiny"
    folder.mkdir(parents=True)
    (folder / "questions.py").write_text(QUESTIONS)
    (folder / "model.yaml").write_text(MODEL)
    return System(folder)


def few_parts(monkeypatch):
    """In one process, and with three parts."""
    monkeypatch.setattr("os.cpu_count", lambda: 1)
    monkeypatch.setattr("freebody.site.PARTS", [NAMES["hinge"], NAMES["torque"], NAMES["stop"]])


def test_a_site_leads_nowhere_else_and_a_broken_system_is_named(tiny, tmp_path, monkeypatch):
    few_parts(monkeypatch)
    broken = tmp_path / "systems" / "broken"
    shutil.copytree(tiny.folder, broken)
    (broken / "model.yaml").write_text(MODEL.replace("bodies", "boddies"))
    cards = list(write_site([System(broken), tiny], tmp_path / "site"))
    assert [(card.id, card.ok) for card in cards] == [("broken", False), ("tiny", True)]
    assert dead_links(tmp_path / "site") == []
    index = (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    assert "<b>broken</b>" in index and "boddies" in index and 'href="tiny/index.html"' in index
    page = (tmp_path / "site" / "tiny" / "index.html").read_text(encoding="utf-8")
    (asked, *_) = catalogue.run(tiny)
    assert asked.label in page and sentence(asked.answers[0]) in page and "closed form: g t" in page
    assert "<math" in page and "v = g t." in page and (tmp_path / "site" / "tiny" / "model-report.html").is_file()


def test_a_dead_link_is_seen(tmp_path):
    (tmp_path / "a.html").write_text('<a id="here" href="b.html"></a><a href="#there"></a><a href="#here"></a>')
    assert dead_links(tmp_path) == ["a.html: b.html", "a.html: #there"]


def test_a_picture_is_the_motion_to_one_scale(tiny):
    """A particle falls from rest: after a half of the time it is a quarter of the way down."""
    picture = moving_picture(fb.load(tiny.models[0]).simulate())
    (shifts,) = re.findall(r'type="translate" values="([^"]*)"', picture)
    places = [tuple(map(float, place.split(","))) for place in shifts.split(";")]
    heights = [y for _, y in places]
    half = heights.index(heights[-1]) // 2
    fallen = (heights[half] - heights[0]) / (heights[-1] - heights[0])
    assert fallen == pytest.approx((half / heights.index(heights[-1])) ** 2, abs=0.05 / (heights[-1] - heights[0]) + 1e-3)
    assert all(0 < x < WIDTH and 0 < y < HEIGHT for x, y in places)


def test_every_part_has_an_example_and_every_example_is_of_a_part():
    assert {part.file for part in PARTS} == set(FOLDER.rglob("*.yaml"))
    for part in PARTS:
        assert len(part.file.read_text(encoding="utf-8").splitlines()) <= LINES, part.word
        if part.card:
            assert part.word in re.findall(r"type: (\w+)", part.model)


@every(NAMES, "word")
def test_an_example_runs_and_its_page_tells_what_is_reported(word):
    part = NAMES[word]
    page = part_page(part, [])
    assert part.purpose and all(name in page for name, *_ in part.fields())
    run = fb.load(part.file).simulate()
    assert run.outcome.ok and run.report and all(each.value is not None for each in run.report.values())


@pytest.mark.long
def test_the_whole_site(tmp_path):
    begun = time.monotonic()
    cards = list(write_site(catalogue.systems(), tmp_path))
    assert [card.id for card in cards if not card.ok] == []
    assert time.monotonic() - begun < 900
    assert dead_links(tmp_path) == []
    in_browser("site.test.ts", FREEBODY_SITE=str(tmp_path))

"""The documents say what is: tables are those of the cards, output is what commands print, snippets run, and every link leads somewhere."""

import re
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from views.test_front_end import in_browser
from views.test_site import dead_links

import freebody as fb
from freebody.equations import generate

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
FREEBODY = Path(sys.executable).with_name("freebody")
QUICK = sorted(path for path in DOCS.glob("*.md") if path.name != "derivations.md")
"""All but the table of pages, whose lines tests/equations/derivation/test_pages.py holds."""
PRINTED = [path for path in (ROOT / "README.md", *sorted(DOCS.glob("*.md"))) if "```console" in path.read_text(encoding="utf-8")]
ALONE = ("README.md", "docs/first_minutes.md", "docs/batch.md")
"""Pages whose Python needs nothing that is said elsewhere, and does not take long."""


ROD = """
freebody: 1
parameters: {l: 1 m, m: 2 kg, alpha: 20 deg}
bodies: {rod: {shape: rod, length: l, mass: m}}
joints: {pin: {type: hinge, of: [ground.O, rod.start], coordinate: theta}}
"""
AMONG = {
    **dict.fromkeys(("docs/python.md", "docs/inverse.md", "docs/find.md", "docs/periodic.md", "docs/stability.md"), dict),
    "docs/statements.md": lambda: {"model": fb.Mechanism.loads(ROD)},
    "docs/check.md": lambda: {"m": fb.load("systems/19.3.17-pendulum-on-a-cart/model.yaml")},
    "docs/equations.md": lambda: {"m": fb.load("systems/19.3.17-pendulum-on-a-cart/model.yaml"), "generate": generate},
}
"""Pages that take up what is said elsewhere, with what that is."""


@pytest.mark.parametrize("path", QUICK, ids=lambda path: path.name)
def test_tables_are_current(path):
    """Else: `.venv/bin/python docs/tables.py`."""
    text = path.read_text(encoding="utf-8")
    assert runpy.run_path(str(DOCS / "tables.py"))["written"](text) == text


FRAGMENTS = re.findall(r"```yaml\n(?:freebody: 1[^\n]*\n)?(.*?)```", (DOCS / "model_file.md").read_text("utf-8"), re.DOTALL)
LADDER = next(text for text in FRAGMENTS if "name: ladder" in text)
"""The example of contacts, from which a newcomer starts."""


@pytest.mark.parametrize("fragment", FRAGMENTS, ids=lambda text: text.split(":")[0])
def test_what_the_language_shows_is_read(fragment):
    """And where it has bodies, it is a model that moves."""
    mechanism = fb.Mechanism.loads(f"freebody: 1\n{fragment}")
    if "bodies:" in fragment:
        assert np.isfinite(list(mechanism.solve().accelerations.values())).all()


def test_the_ladder_leaves_the_wall_at_two_thirds_of_its_height():
    """From energy and N = m dv/dt: sin θ = ⅔ sin θ₀, where the push ends; until then m l²/3 θ̈ = −m g l/2 cos θ."""
    ladder = fb.Mechanism.loads(f"freebody: 1\n{LADDER}")
    run = ladder.simulate()
    leaves, start = (run.evaluate("sin(theta)", t) for t in (next(c.t for c in run.changes if c.kind == "lift-off"), 0.0))
    assert leaves == pytest.approx(start * 2 / 3, rel=1e-8)  # the motion holds to nine digits
    assert ladder.check("m l^2/3 thetaddot = -m g l/2 cos(theta)").ok


@pytest.mark.long
@pytest.mark.parametrize("path", PRINTED, ids=lambda path: path.name)
def test_what_commands_print_is_current(path):
    """Else: `.venv/bin/python docs/refresh.py`."""
    text = path.read_text(encoding="utf-8")
    assert runpy.run_path(str(DOCS / "refresh.py"))["printed"](text, str(FREEBODY)) == text


@pytest.mark.parametrize("page", [*ALONE, *(pytest.param(page, marks=pytest.mark.long) for page in AMONG)])
def test_python_runs(page, tmp_path, monkeypatch):
    """Where a newcomer stands: beside the examples and the catalogue, in a folder that can be written."""
    for name, place in {
        "examples": "examples",
        "systems": "systems",
        "cart_pendulum.yaml": "systems/19.3.17-pendulum-on-a-cart/model.yaml",
    }.items():
        (tmp_path / name).symlink_to(ROOT / place)
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(str(tmp_path))
    known = {"fb": fb} | AMONG.get(page, dict)()
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(encoding="utf-8"), re.DOTALL)
    assert blocks
    exec("\n".join(blocks), known)


@pytest.mark.parametrize("page", ["homework", "linkage"])
def test_the_model_of_a_page_is_its_file(page):
    model = (DOCS / f"{page}.yaml").read_text(encoding="utf-8")
    assert f"```yaml\n{model}```" in (DOCS / f"{page}.md").read_text(encoding="utf-8")


@pytest.mark.long
def test_the_first_model_of_ones_own(tmp_path):
    """Its file is written, and what is said of it there is tried."""
    page = (DOCS / "first_minutes.md").read_text(encoding="utf-8")
    (tmp_path / "pendulum.yaml").write_text(re.search(r"```yaml\n(.*?)```", page, re.DOTALL)[1])
    commands = re.findall(r"^\$ \./dev (.*pendulum\.yaml.*)", page, re.MULTILINE)
    assert len(commands) == 5
    for command in commands:
        subprocess.run(f"{FREEBODY} {command}", shell=True, cwd=tmp_path, check=True)
    assert {"drawing.svg", "fbd.svg", "pendulum.html"} <= {path.name for path in tmp_path.iterdir()}


@pytest.mark.long
def test_the_site_of_the_documents(tmp_path):
    """Every page is built without a warning, leads nowhere that is not, and opens in a browser."""
    subprocess.run([ROOT / "dev", "docs", tmp_path], check=True, timeout=300)
    assert dead_links(tmp_path, elsewhere=True) == []
    in_browser("site.test.ts", FREEBODY_SITE=str(tmp_path))

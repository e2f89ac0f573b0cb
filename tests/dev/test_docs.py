"""The tables of the documents are those of the cards."""

import re
import runpy
from pathlib import Path

import pytest

import freebody as fb

DOCS = Path(__file__).parents[2] / "docs"


QUICK = sorted(path for path in DOCS.glob("*.md") if path.name != "derivations.md")
"""All but the table of pages, whose lines tests/equations/derivation/test_pages.py holds."""


@pytest.mark.parametrize("path", QUICK, ids=lambda path: path.name)
def test_tables_are_current(path):
    """Else: `.venv/bin/python docs/tables.py`."""
    text = path.read_text(encoding="utf-8")
    assert runpy.run_path(str(DOCS / "tables.py"))["written"](text) == text


LADDER = next(
    text
    for text in re.findall(r"```yaml\n(.*?)```", (DOCS / "model_file.md").read_text("utf-8"), re.DOTALL)
    if "name: ladder" in text
)
"""The example of contacts, from which a newcomer starts."""


def test_the_ladder_leaves_the_wall_at_two_thirds_of_its_height():
    """From energy and N = m dv/dt: sin θ = ⅔ sin θ₀, where the push ends; until then m l²/3 θ̈ = −m g l/2 cos θ."""
    ladder = fb.Mechanism.loads(f"freebody: 1\n{LADDER}")
    run = ladder.simulate()
    leaves, start = (run.evaluate("sin(theta)", t) for t in (next(c.t for c in run.changes if c.kind == "lift-off"), 0.0))
    assert leaves == pytest.approx(start * 2 / 3, rel=1e-8)  # the motion holds to nine digits
    assert ladder.check("m l^2/3 thetaddot = -m g l/2 cos(theta)").ok

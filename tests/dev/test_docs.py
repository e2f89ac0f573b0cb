"""The tables of the documents are those of the cards."""

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"


QUICK = sorted(path for path in DOCS.glob("*.md") if path.name != "derivations.md")
"""All but the table of pages, whose lines tests/equations/derivation/test_pages.py holds."""


@pytest.mark.parametrize("path", QUICK, ids=lambda path: path.name)
def test_tables_are_current(path):
    """Else: `.venv/bin/python docs/tables.py`."""
    text = path.read_text(encoding="utf-8")
    assert runpy.run_path(str(DOCS / "tables.py"))["written"](text) == text

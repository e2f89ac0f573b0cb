"""The tables of the documents are those of the cards."""

import runpy
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize("path", sorted(DOCS.glob("*.md")), ids=lambda path: path.name)
def test_tables_are_current(path):
    """Else: `.venv/bin/python docs/tables.py`."""
    text = path.read_text(encoding="utf-8")
    assert runpy.run_path(str(DOCS / "tables.py"))["written"](text) == text

"""The comparison with other programs (benchmarks/peers), which needs an environment of its own: what can be said without it."""

import ast
import re
import runpy
from pathlib import Path

ROOT = Path(__file__).parents[2]
PEERS = ROOT / "benchmarks" / "peers"
RUN = runpy.run_path(str(PEERS / "run.py"))


def offers(peer: str) -> set[str]:
    """The names of a file's functions."""
    tree = ast.parse((PEERS / f"{peer}.py").read_text(encoding="utf-8"))
    return {each.name for each in tree.body if isinstance(each, ast.FunctionDef)}


def test_freebody_is_in_every_row_and_not_alone():
    known = {peer: offers(peer) for peer in RUN["PEERS"]}
    for row in RUN["ROWS"]:
        assert row.offered in known["ours"], row.key
        assert sum(row.offered in each for each in known.values()) > 1, row.key


def test_the_page_has_every_row_and_no_other():
    page = (ROOT / "docs" / "peers.md").read_text(encoding="utf-8")
    titles = [row.title for row in RUN["ROWS"]]
    assert re.findall(r"^## (.*)$", page, re.MULTILINE) == ["In short", *titles, "What is left out"]
    tables = re.split(r"^## ", page, flags=re.MULTILINE)[2:-1]
    assert all("| freebody" in table and table.count("\n| ") > 2 for table in tables)
    assert RUN["INTRODUCTION"] in page and RUN["LEFT_OUT"] in page


def test_peers_are_pinned():
    asked = re.findall(r'^  "(.*)",$', (PEERS / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)
    assert len(asked) > 8 and [each for each in asked if "==" not in each] == ["freebody[table]"]

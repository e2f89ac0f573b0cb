"""Which members of families are visited: all of them with ``--all``, else a sample."""

from __future__ import annotations

import os
from collections import Counter, defaultdict
from zlib import crc32

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # before numpy is loaded: the processes of a test run share the cores already

import pytest
from store import sample

from freebody.check.budget import Budget

SEED = 739_942
"""Any number would do; it is fixed, so that what passes on one day passes on the next. ``--sample`` takes another."""
SEEN = pytest.StashKey[dict]()
PATIENCE = 10
"""How many times the usual seconds a statement may take here, so that what is found does not depend on how fast a machine is."""
Budget.seconds_for = staticmethod(lambda bodies, usual=Budget.seconds_for: PATIENCE * usual(bodies))


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--all", action="store_true", help="visit every member of every family, and run what takes long")
    parser.addoption("--sample", type=int, default=SEED, help="seed of the sample of families")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "family(name, share): a member of a family, of which a sample is visited by default")
    config.addinivalue_line("markers", "long: runs with --all only")
    config.stash[SEEN] = {}


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    families, variants, seed = defaultdict(dict), defaultdict(list), config.getoption("sample")
    for item in items:
        if found := item.get_closest_marker("family"):
            name, share = found.args
            families[item.path, item.originalname][name] = share
            variants[item.path, item.originalname, name].append(item)
    visited = {test: sample({*names}, seed, max(names.values()), test[0].stem) for test, names in families.items()}
    drawn = {id(item) for (*test, name), some in variants.items() if name in visited[tuple(test)] for item in some_of(some, seed)}

    def is_taken(item: pytest.Item) -> bool:
        return not item.get_closest_marker("long") and (not item.get_closest_marker("family") or id(item) in drawn)

    members = [item for item in items if item.get_closest_marker("family")]
    if not config.getoption("all"):
        items[:], left_out = [item for item in items if is_taken(item)], [item for item in items if not is_taken(item)]
        config.hook.pytest_deselected(items=left_out)
    taken = [item for item in items if item.get_closest_marker("family")]
    config.stash[SEEN] |= {"families": len(families), "members": len(members), "taken": len(taken)}


def some_of(variants: list[pytest.Item], seed: int) -> list[pytest.Item]:
    """Of the ways in which a law visits one member, by form, scale or route, a third, for all laws the same of one member."""
    return sorted(variants, key=lambda item: crc32(f"{seed} {item.callspec.id}".encode()))[: -(-len(variants) // 3)]


def pytest_sessionfinish(session: pytest.Session) -> None:
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["seen"] = session.config.stash[SEEN]


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node, error) -> None:
    node.config.stash[SEEN] |= getattr(node, "workeroutput", {}).get("seen", {})


def pytest_terminal_summary(terminalreporter, config: pytest.Config) -> None:
    skipped = terminalreporter.stats.get("skipped", [])
    for reason, count in Counter(value for report in skipped for _, value in report.user_properties).most_common():
        terminalreporter.write_line(f"not visited: {count} cases, {reason}")
    if seen := config.stash[SEEN]:
        how = "all" if config.getoption("all") else f"sample {config.getoption('sample')}, --all for the rest"
        terminalreporter.write_line(
            f"families: {seen['taken']} of {seen['members']} cases of {seen['families']} laws visited ({how})"
        )

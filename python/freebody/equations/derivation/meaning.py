"""What the letters of a derivation mean, and what its loads, points and directions are called."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from freebody.equations.derivation.data import SymbolicState
from freebody.solve.symbols import load_words
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.symbols import Name


def meanings(subject: SymbolicState) -> Letters:
    """All letters in the order of the model: coordinates, parameters, what the model leaves without a name, unknowns, time."""
    table = subject.table
    found = {c["name"]: Letter(c["name"], "coordinate", c["dimension"] or "", plain(c["doc"])) for c in subject.coordinates}
    given = [p["name"] for p in subject.source.about["parameters"]]
    unnamed = [name for name, entry in table.items() if entry["kind"] == "number"]
    found |= {name: Letter(name, "parameter", table[name]["unit"]) for name in given if name in table}
    found |= {name: Letter(name, "constant", table[name]["unit"], table[name]["doc"]) for name in unnamed}
    written = subject.symbols.names
    found = {name: letter if written[name] == Name.parse(name) else replace(letter, written=written[name])
             for name, letter in found.items()}  # fmt: skip
    for load in subject.free.loads:
        if load.unknown and not load.follows:
            unit, doc = "N*m" if load.card.couple else "", f"{load_words(load)} ({load.symbol})"
            found[load.symbol] = Letter(load.symbol, "unknown", unit, doc, subject.symbols.loads[load.symbol])
    return Letters(found | {"t": Letter("t", "time", "s", "time")}, subject.symbols.renamed)


def plain(doc: str) -> str:
    """A description without the quotes of code."""
    return doc.replace("`", "")


def joined(words: Sequence[str], last: str = "and") -> str:
    """``a, b and c``."""
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} {last} {words[-1]}"

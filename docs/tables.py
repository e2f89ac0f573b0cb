"""Writes the tables of docs/*.md that come from the cards of the core and from the lists of topics, output formats
and languages, and those of derivations: `.venv/bin/python docs/tables.py`.

A table stands between `<!-- joints -->` and `<!-- /joints -->`; the word says which.
"""

import json
import re
from collections.abc import Callable, Iterable
from pathlib import Path

from ruamel.yaml import YAML

from freebody import Mechanism
from freebody.codegen.languages import LANGUAGES
from freebody.core import cards
from freebody.document.blocks import Figure
from freebody.document.rendering import FORMATS
from freebody.equations.topics import TOPICS, described

DOCS = Path(__file__).parent
WRITTEN = {
    "point": "P",
    "points": "[P, Q]",
    "line": "LINE",
    "circle": "{centre, radius}",
    "area": "AREA",
    "curve": "CURVE",
    "numbers": "[a, b]",
}
MARKED = re.compile(r"(<!-- (\w+) -->\n).*?(<!-- /\2 -->)", re.DOTALL)


def joints() -> str:
    """What a person writes for every joint, and what he reads of it."""
    rows = (
        (_word(card), _fields(card), _names(c.name for c in card.coordinates), _loads(card.rows))
        for card in cards.joints().values()
    )
    return _table(("type", "fields", "coordinates", "reaction"), rows)


def forces() -> str:
    """What a person writes for every force."""
    return _table(("type", "fields"), ((_word(card), _fields(card)) for card in cards.forces().values()))


def topics() -> str:
    """What every topic derives, and its options."""
    return _table(("form", "what it derives", "options"), ((f"`{name}`", *described(name)) for name in TOPICS))


def formats() -> str:
    """Output formats of documents."""
    beside = {"": "–"}
    rows = (
        (f"`--{f.word}`", f"`.{f.ending}`", f.doc.rstrip("."), beside.get(f.figures, f"`FILE-sketch{f.figures}`"))
        for f in FORMATS.values()
    )
    return _table(("option", "file", "what it is", "its figures are files"), rows)


def languages() -> str:
    """Languages of generated code."""
    return _table(("option", "file", "what it is"), ((f"`--{x.word}`", f"`.{x.ending}`", x.doc) for x in LANGUAGES.values()))


def functions() -> str:
    """What can be read by a function."""
    rows = []
    for function in cards.functions().values():
        arguments = ("PQ"[i] if kind == "point" else kind.upper() for i, kind in enumerate(function.takes))
        shown = f"`{function.word}({', '.join(arguments)})`" + f", `{function.word}()`" * function.optional
        rows.append((function.reach, shown, function.doc, function.unit))
    return _table(("reads a", "function", "value", "unit"), rows)


def readings() -> str:
    """What can be read of a part of the model by a word behind its name."""
    owners = {"joint": "JOINT", "motion": "MOTION, coupling", "force": "FORCE", "limit": "contact, string, stop"}
    rows = ((owners[kind], "; ".join(f"`.{word}` {doc}" for word, doc in words)) for kind, words in cards.phrases().items())
    return _table(("of", "word"), rows)


def methods() -> str:
    """The integrators."""
    rows = (
        (
            f"`{m.name}`",
            str(m.order),
            "fixed, `step`" if m.fixed_step else "adaptive",
            "conservative trees" * m.symplectic + "trees without switches" * m.analytic,
            m.citation,
        )
        for m in cards.methods().values()
    )
    return _table(("method", "order", "step", "only", "source"), rows)


def pages() -> str:
    """Of every derivation of ``derivations.yaml`` the balances of a book and of freebody, and how long the page is."""
    rows = []
    for each in YAML(typ="safe").load((DOCS / "derivations.yaml").read_text(encoding="utf-8")):
        mechanism = described_in(DOCS.parent / each["model"])
        found = mechanism.equations()
        own = [part.title for part in found.parts if part.title.startswith(("AMB", "LMB"))]
        takes = "the same" if set(own) == set(each["takes"]) else f"{'; '.join(own)}: {each['why']}"
        lines = sum(1 for line in found.text(width=100).splitlines() if line)
        figures = sum(isinstance(block, Figure) for block in found.blocks)
        rows.append((mechanism.source().name, each["book"], "; ".join(each["takes"]) or "–", takes, str(figures), str(lines)))
    return _table(("problem", "book", "it takes", "freebody takes", "figures", "lines"), rows)


def described_in(path: Path) -> Mechanism:
    """The mechanism of a model's file, or of one with statements about it."""
    given = YAML(typ="safe").load(path.read_text(encoding="utf-8"))
    if "model" not in given:
        return Mechanism.load(path)
    return Mechanism.loads(json.dumps({"freebody": 1, "name": path.stem.replace("_", " "), **given["model"]}))


def _word(card: cards.Card) -> str:
    return f"`{card.type}`: {card.doc[0].lower()}{card.doc[1:].rstrip('.')}"


def _fields(card: cards.Card) -> str:
    given = ((field, field.default or WRITTEN.get(field.kind, "")) for field in card.fields)
    return "; ".join(f"`{field.name}{': ' * bool(value)}{value}` {field.doc}" for field, value in given)


def _loads(loads: Iterable[cards.LoadCard]) -> str:
    return ", ".join(f"{load.name} `{load.reading}`" for load in loads) or "–"


def _names(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names) or "–"


def _table(heads: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    lines = [heads, *rows]
    made = [f"| {' | '.join(line)} |\n" for line in lines]
    return "".join([made[0], "|---" * len(heads) + "|\n", *made[1:]])


_MADE = (joints, forces, functions, readings, methods, topics, formats, languages, pages)
TABLES: dict[str, Callable[[], str]] = {made.__name__: made for made in _MADE}


def written(text: str) -> str:
    """A document with its tables as they are now."""
    return MARKED.sub(lambda found: found[1] + TABLES[found[2]]() + found[3], text)


if __name__ == "__main__":
    for path in DOCS.glob("*.md"):
        path.write_text(written(path.read_text(encoding="utf-8")), encoding="utf-8")

"""The catalogue as pages to walk through: an offline site with a page a system, and a page a joint, force and contact."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import partial
from importlib.resources import files
from pathlib import Path

from markupsafe import Markup

from freebody.catalogue import System
from freebody.catalogue.processes import shared
from freebody.document.templates import template
from freebody.formats import write
from freebody.site.parts import FAMILIES, PARTS, Part, part_page, part_picture
from freebody.site.systems import Card, natural, system_pages

__all__ = ["Card", "family", "write_site"]


def write_site(systems: Iterable[System], folder: Path) -> Iterator[Card]:
    """Write the pages of systems, each by a process of its own, and yield their cards as they are done; then the pages of parts and the
    index. A system that fails is named with its reason, on its card and in the index, and keeps no other from its pages."""
    folder.mkdir(parents=True, exist_ok=True)
    cards: list[Card] = []
    for _, card in shared(partial(system_pages, folder=folder), systems, lambda system: system.folder / "questions.py"):
        cards.append(card)
        yield card
    (folder / "parts").mkdir(exist_ok=True)
    for part in PARTS:
        used = natural(card for card in cards if part.word in card.parts)
        write(folder / part.page, part_page(part, used))
        write(folder / part.page.replace(".html", ".yaml"), part.file.read_text(encoding="utf-8"))
    shared_look = files("freebody.document.rendering").joinpath("templates")
    look = template(__package__, "site.css").render(formulas=shared_look.joinpath("formulas.css").read_text(encoding="utf-8"))
    write(folder / "site.css", look)
    write(folder / "site.js", template(__package__, "site.js").render())
    (folder / "math.woff").write_bytes(shared_look.joinpath("math.woff").read_bytes())
    write(
        folder / "parts" / "index.html",
        template(__package__, "parts.html").render(families={name: family(name) for name in FAMILIES}),
    )
    write(folder / "index.html", template(__package__, "index.html").render(cards=natural(cards)))


def family(name: str) -> list[tuple[Part, Markup]]:
    """The parts of a family, joints, forces or contacts, with their pictures."""
    return [(part, part_picture(part)) for part in PARTS if part.family == name]

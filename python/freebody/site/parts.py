"""One page a joint, force and kind of contact: what it is for, its fields, and a small model of it that runs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from markupsafe import Markup

from freebody.core import cards
from freebody.document.templates import template
from freebody.mechanism import Mechanism
from freebody.model import switches
from freebody.run.simulation import Run
from freebody.site.systems import Card
from freebody.solve.figures import figure
from freebody.views.moving_picture import moving_picture

FOLDER = Path(__file__).with_name("parts")
FAMILIES = ("joints", "forces", "contacts")


@dataclass(frozen=True, eq=False)
class Part:
    """A word of the model language with its example, a file that begins with what it is for."""

    family: str
    word: str
    card: cards.Card | None

    @property
    def name(self) -> str:
        return self.word.replace("_", " ")

    @property
    def page(self) -> str:
        """Its page in the site."""
        return f"parts/{self.word}.html"

    @property
    def file(self) -> Path:
        return FOLDER / self.family / f"{self.word}.yaml"

    @property
    def purpose(self) -> str:
        """When one chooses it."""
        return self.file.read_text(encoding="utf-8").partition("\n")[0].lstrip("# ")

    @property
    def model(self) -> str:
        """The example without its first line."""
        return self.file.read_text(encoding="utf-8").partition("\n")[2]

    def fields(self) -> Iterator[tuple[str, str, str, str]]:
        """Of each field its name, its default, unit and meaning."""
        if self.card:
            yield from ((f.name, f.default or "", f.unit or "", f.doc) for f in self.card.fields)
            return
        section = {"string": switches.String, "stop": switches.Stop}.get(self.word, switches.Contact)
        for name, field in section.model_fields.items():
            default = "" if field.is_required() or field.default in (None, ()) else str(field.default).lower()
            yield field.alias or name, default, "", (field.description or "").rstrip(".")


def _listed() -> Iterator[Part]:
    """The joints and forces of the core, in its order, then contacts, strings and stops by their examples."""
    yield from (Part("joints", word, card) for word, card in cards.joints().items())
    yield from (Part("forces", word, card) for word, card in cards.forces().items())
    yield from (Part("contacts", path.stem, None) for path in sorted((FOLDER / "contacts").glob("*.yaml")))


PARTS = tuple(_listed())


@cache
def _run(part: Part) -> Run:
    return Mechanism.load(part.file).simulate()


@cache
def part_picture(part: Part) -> Markup:
    """Its example in motion."""
    return Markup(moving_picture(_run(part)))


def part_page(part: Part, used: Sequence[Card]) -> str:
    """The page, with links to the systems of a site where it is used."""
    reported = [(label, figure(each.value), each.unit) for label, each in _run(part).accuracy.report.items()]
    return template(__package__, "part.html").render(part=part, picture=part_picture(part), reported=reported, used=used)

"""The page of a system, and the pages and files beside it."""

from __future__ import annotations

import inspect
import shutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from markupsafe import Markup

from freebody import catalogue
from freebody.catalogue import Asked, System
from freebody.catalogue.sentences import checks, sentence
from freebody.catalogue.statements import statements
from freebody.core import ModelError, MotionError
from freebody.document.rendering.html import Html
from freebody.document.templates import template
from freebody.formats import write
from freebody.mechanism import Mechanism
from freebody.model.errors import ModelFileError
from freebody.views.moving_picture import moving_picture
from freebody.views.report import write_report

if TYPE_CHECKING:
    from freebody.run.simulation import Run

T = TypeVar("T")


@dataclass(frozen=True)
class Card:
    """What the index shows of a system. ``parts``: the words of its joints, forces and contacts; ``failure``: why it has no page;
    ``ok``: whether every answer agrees with its check and every statement has the verdict that is expected."""

    id: str
    title: str = ""
    asks: str = ""
    questions: int = 0
    picture: str = ""
    parts: tuple[str, ...] = ()
    ok: bool = False
    failure: str = ""

    @property
    def page(self) -> str:
        return f"{self.id}/index.html"


@dataclass
class Shown:
    """A model on its page; what it has no answer for is a sentence in ``refusals``."""

    name: str
    file: str
    text: str
    title: str = ""
    picture: str = ""
    diagrams: list[Markup] = field(default_factory=list)
    derivation: str = ""
    reports: list[tuple[str, str]] = field(default_factory=list)
    parts: tuple[str, ...] = ()
    refusals: list[str] = field(default_factory=list)


def system_pages(system: System, folder: Path) -> Card:
    """Write what belongs to a system into a folder of its name, and return its card; a system that fails is named on it."""
    try:
        return _written(system, folder / system.id)
    except Exception as error:  # whatever is wrong with one system, the others have their pages
        return Card(system.id, failure=f"{type(error).__name__}: {error}")


def _written(system: System, folder: Path) -> Card:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    asked = list(catalogue.run(system))
    judged = [one for _, found in statements([system]) for one in found]
    models = [_shown(path, folder) for path in system.models]
    ok = all(each.ok for each in asked) and all(one.as_expected is not False for one in judged)
    pictures = (each.picture for each in models)
    parts = tuple(dict.fromkeys(word for each in models for word in each.parts))
    picture = next(filter(None, pictures), "")
    card = Card(system.id, system.title, asked[0].label if asked else "", len(asked), picture, parts, ok)
    shown = {"card": card, "questions": [_question(each) for each in asked], "statements": judged, "models": models}
    write(folder / "index.html", template(__package__, "system.html").render(**shown, behind=_behind(system)))
    return card


def _behind(system: System) -> str:
    """How the answers are checked, from the head of the questions."""
    return inspect.cleandoc(system.questions()[0].answers.__globals__["__doc__"] or "").partition("\n")[2].strip()


def _question(asked: Asked) -> dict[str, Any]:
    """A question with its answers by variants, each with how they were checked."""
    variants: dict[str, list[Any]] = {}
    for answer in asked.answers:
        variants.setdefault(answer.variant, []).append(answer)
    told = [
        {"name": name, "answers": [(_told(answer), answer.ok) for answer in answers], "checks": checks(answers).splitlines()}
        for name, answers in variants.items()
    ]
    return {"label": asked.label, "variants": told, "failure": asked.failure, "ok": asked.ok}


def _told(answer: catalogue.Answer) -> str:
    """The answer with all its figures; those of a row that is the same throughout once."""
    short = sentence(answer)
    return sentence(answer, full=True) if "--full" in short else short


def _shown(path: Path, folder: Path) -> Shown:
    """A model and all that is drawn, derived and computed of it."""
    mechanism = Mechanism.load(path)
    shutil.copy(path, folder / path.name)
    shown = Shown(path.stem, path.name, path.read_text(encoding="utf-8"), mechanism.model.name or path.stem)
    shown.parts = tuple(dict.fromkeys(_parts(mechanism)))

    def tried(work: Callable[[], T], otherwise: T) -> T:
        try:
            return work()
        except (MotionError, ModelError, ModelFileError) as error:
            if (told := str(getattr(error, "what", error))) not in shown.refusals:
                shown.refusals.append(told)
            return otherwise

    shown.diagrams = tried(lambda: list(_diagrams(mechanism)), [])
    shown.derivation = tried(lambda: _derivation(mechanism), "")
    if first := tried(mechanism.simulate, None):
        shown.picture = Markup(moving_picture(first, shown.title))
        shown.reports = [_report(stage, run, path.stem, folder) for stage, run in enumerate(_runs(first), 1)]
    return shown


def _diagrams(mechanism: Mechanism) -> Iterator[Markup]:
    each = mechanism.diagram()
    yield Markup(each.inline())
    if len(each.cuts) > 1:
        yield Markup(mechanism.diagram("all").inline())


def _derivation(mechanism: Mechanism) -> Markup:
    document = mechanism.equations()
    return Html(document.letters).render(document.blocks)


def _runs(first: Run) -> Iterator[Run]:
    """A run and those of the models that go on from it."""
    run: Run | None = first
    while run is not None:
        yield run
        run = run.next


def _report(stage: int, run: Run, stem: str, folder: Path) -> tuple[str, str]:
    """The report of a run, by its file and how it ended."""
    name = f"{stem}-report{f'-{stage}' if stage > 1 else ''}.html"
    write_report(run, folder / name)
    return name, run.outcome.sentence


def _parts(mechanism: Mechanism) -> Iterator[str]:
    """The words of the joints and forces of a model, and its strings and stops."""
    spec = mechanism.source().spec
    yield from (each["type"] for section in ("joints", "forces") for each in spec.get(section, []))
    yield from (word for word in ("string", "stop") if spec.get(f"{word}s"))


def natural(cards: Iterable[Card]) -> list[Card]:
    """In the order in which a person counts: 19.3.2 before 19.3.10."""
    return sorted(
        cards, key=lambda card: [(word.isdigit(), int(word) if word.isdigit() else 0, word) for word in card.id.split(".")]
    )

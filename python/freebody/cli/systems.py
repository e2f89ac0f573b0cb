"""``freebody systems``: the worked catalogue."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from freebody.cli.models import opened, written
from freebody.cli.options import AsJson
from freebody.cli.terminal import print_json, speaks_unicode
from freebody.cli.user_errors import NOT_TRUE, UserError
from freebody.formats import check_writable, replacing

if TYPE_CHECKING:
    from freebody.catalogue import System


def systems(
    identity: Annotated[str | None, typer.Argument(metavar="[ID]", help="Ask this one, like S19.17.")] = None,
    everything: Annotated[bool, typer.Option("--all", help="Ask them all, by several processes.")] = False,
    diagrams: Annotated[bool, typer.Option("--diagrams", help="Draw free-body diagrams, of all systems or of this one.")] = False,
    stated: Annotated[bool, typer.Option("--statements", help="Judge what is stated about all systems or this one.")] = False,
    output: Annotated[Path, typer.Option("-o", "--output", help="The page of --diagrams.")] = Path("diagrams.html"),
    as_json: AsJson = False,
    full: Annotated[bool, typer.Option("--full", help="Variants unfolded, and all figures of long rows.")] = False,
    table: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write every figure beside its check.")] = None,
    site: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write pages of all systems or this one, to be browsed offline.")
    ] = None,
    symbolic: Annotated[bool, typer.Option("--equations", help="Its equations in the three forms, instead of answers.")] = False,
) -> None:
    """The worked catalogue: list it, run systems and print their answers, draw their diagrams, or judge what is stated."""
    from freebody import catalogue

    try:
        listed = catalogue.systems()
        chosen = listed if identity is None else [catalogue.find(identity)]
    except KeyError as error:
        raise UserError(error.args[0], "freebody systems lists them") from None
    if diagrams:
        _draw(chosen, output)
    elif site:
        _pages(chosen, site)
    elif stated:
        _judge(chosen, as_json)
    elif identity is None and not everything:
        if as_json:
            print_json([{"id": system.id, "title": system.title} for system in listed])
        else:
            from freebody.catalogue import show

            show.show_list(listed)
    elif symbolic:
        _derive(chosen)
    else:
        if table:
            check_writable(table)
        _answer(chosen, as_json, full, table)


def _answer(systems: list[System], as_json: bool, full: bool, table: Path | None) -> None:
    """The questions of systems with their answers, printed as they come or all as JSON; of one system what is stated, too. Ends with
    an error where an answer disagrees."""
    from freebody import catalogue
    from freebody.catalogue import show
    from freebody.catalogue.statements import statements

    alone = len(systems) == 1
    results: dict[str, list[catalogue.Asked]] = {}
    for system, answered in ((systems[0], catalogue.run(systems[0])),) if alone else catalogue.run_all(systems):
        if not as_json and not alone:
            show.show_title(system)
        for asked in answered:
            results.setdefault(system.id, []).append(asked)
            if not as_json:
                show.show_asked(asked, full)
    if table:
        with replacing(table) as beside:
            show.write_csv(beside, results)
    if as_json:
        print_json(catalogue.rows(results))
    elif alone:
        for system, found in statements(systems):
            show.show_verdicts(system, found)
    else:
        show.show_summary(results)
    if not all(asked.ok for questions in results.values() for asked in questions):
        raise typer.Exit(NOT_TRUE)


def _pages(systems: list[System], folder: Path) -> None:
    """The pages of systems, a line for each. Ends with an error where one has no page, or has an answer or a verdict that is not as it
    should be."""
    from freebody.site import write_site

    found = []
    for card in write_site(systems, folder):
        found.append(card)
        print(f"{card.id}: {card.failure or card.title}{'' if card.ok else '  (not as expected)'}", flush=True)
    written(folder / "index.html")
    if not all(card.ok for card in found):
        raise typer.Exit(NOT_TRUE)


def _judge(systems: list[System], as_json: bool) -> None:
    """The verdicts about what is stated, in tables or as JSON. Ends with an error where one is not as expected."""
    from freebody.catalogue import show
    from freebody.catalogue.statements import statements

    results = []
    for system, found in statements(systems):
        results.append((system, found))
        if not as_json:
            show.show_statements(system, found)
    every = [one for _, found in results for one in found]
    if as_json:
        print_json([{"system": system.id, **one.to_json()} for system, found in results for one in found])
    else:
        show.show_totals(every)
    if any(one.as_expected is False for one in every):
        raise typer.Exit(NOT_TRUE)


def _derive(systems: list[System]) -> None:
    """The equations of the models of systems in all forms; of one that cannot move as it is, why."""
    from freebody.core import MotionError
    from freebody.equations.derivation.derive import FORMS

    for model in (path for system in systems for path in system.models):
        try:
            for form in FORMS:
                print(opened(model).equations(form).text(ascii=not speaks_unicode()))
        except MotionError as error:
            print(f"{model.name}: {error.what}\n")


def _draw(systems: list[System], page: Path) -> None:
    """A page with the diagrams of all models of some systems."""
    from freebody.views.diagram.gallery import write_gallery

    check_writable(page)
    models = ((f"{system.id}, {path.stem}: {system.title}", opened(path)) for system in systems for path in system.models)
    written(write_gallery(models, page))

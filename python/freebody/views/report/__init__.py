"""A run as one self-contained HTML page: summary, tables, plots and the moving mechanism, offline."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from markupsafe import Markup

from freebody.document.templates import template
from freebody.formats import write
from freebody.views.report import tables
from freebody.views.report.data import report_data

if TYPE_CHECKING:
    from freebody.run.simulation import Run


def write_report(run: Run, path: str | Path, beside: Mapping[str, Run] = MappingProxyType({})) -> Path:
    """Write the report of a run, with the curves of runs ``beside`` it, by name, dashed over its own."""
    return write(path, report_html(run, beside))


def report_html(run: Run, beside: Mapping[str, Run] = MappingProxyType({})) -> str:
    """The report as one page that needs nothing else and loads nothing; ``beside`` as for ``write_report``.

    The page's own policy forbids every script and style but the two it holds, and every address.
    All text of the model is escaped, or reaches the page as data that is only ever shown as text.
    """
    style, script = _bundled("report.css"), _bundled("report.js")
    return template(__package__, "page.html").render(
        policy=f"default-src 'none'; style-src '{_digest(style)}'; script-src '{_digest(script)}'; img-src data:",
        run=run,
        data=report_data(run, beside),
        style=style,
        script=script,
        outcome=tables.outcome(run),
        ending=tables.ending(run),
        beside=tables.beside(run),
        notes=[tables.sentence(note) for note in run.metadata["notes"]],
        below=tables.below(run),
        units=tables.units(),
        settings=tables.settings(run),
        is_figure=tables.is_figure,
        raised=tables.raised,
        marked=tables.marked,
    )


def _bundled(name: str) -> Markup:
    """A file that ``./dev web`` has built of web/."""
    return Markup(files(__package__).joinpath("bundle", name).read_text(encoding="utf-8"))


def _digest(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()

"""A run as one self-contained HTML page: summary, tables, plots and the moving mechanism, offline."""

from __future__ import annotations

import base64
import hashlib
import json
from html import escape
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any

from freebody.views.report.series import frames, plots
from freebody.views.report.tables import aside, headline, sections
from freebody.views.scene import of_run

if TYPE_CHECKING:
    from freebody.run.simulation import Run


def write_report(run: Run, path: str | Path) -> Path:
    """Write the report of a run."""
    path = Path(path)
    path.write_text(report_html(run), encoding="utf-8")
    return path


def report_html(run: Run) -> str:
    """The report as one page that needs nothing else and loads nothing.

    The page's own policy forbids every script and style but the two it holds, and every address.
    All text of the model is escaped, or reaches the page as data that is only ever shown as text.
    """
    style, script = _asset("style.css"), _asset("player.js") + _asset("plots.js")
    scene = of_run(run, frames(run))
    events = [{"name": event.name, "t": event.t, "kind": "event"} for event in run.events]
    events += [{"name": f"impact: {', '.join(change.of)}", "t": change.t, "kind": "impact"} for change in run.impacts]
    others = [change for change in run.changes if not change.impulses]
    ticks = [{"name": f"{change.kind}: {', '.join(change.of)}", "t": change.t} for change in others]
    return Template(_asset("page.html")).substitute(
        policy=f"default-src 'none'; style-src '{_digest(style)}'; script-src '{_digest(script)}'; img-src data:",
        title=escape(run.name),
        headline=headline(run),
        aside=aside(run),
        sections=sections(run),
        style=style,
        data=_data({"scene": scene.to_json(), "plots": plots(run), "events": events, "ticks": ticks}),
        script=script,
    )


def _asset(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def _digest(text: str) -> str:
    return "sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


def _data(value: dict[str, Any]) -> str:
    """JSON that can end no script element and open no comment."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    return (
        text.replace("<", "\\u003c")
        .replace(">", "\\u003e")
        .replace("&", "\\u0026")
        .replace("\u2028", "\\u2028")
        .replace("\u2029", "\\u2029")
    )

"""The text and tables of the report, as escaped HTML."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from freebody.run.storage import versions
from freebody.solve.instant import Instant
from freebody.views.peaks import peak_reactions
from freebody.views.plots import pretty_unit

if TYPE_CHECKING:
    from freebody.run.simulation import Run


def headline(run: Run) -> str:
    """Name, outcome and its sentence."""
    mood = "ok" if run.outcome.ok else "not-ok"
    badge = f'<span class="badge {mood}">{escape(run.outcome.name)}</span>'
    when = f"t = {_figure(run.outcome.t)} s"
    stated = escape(_sentence(run.outcome.sentence))
    words = f"{stated}, {when}" if run.outcome.ok else "<br>".join([when, *stated.split("; ")])
    return f"<h1>{escape(run.name)}</h1><p>{badge} {words}</p>"


def aside(run: Run) -> str:
    """What stands beside the moving mechanism: reported quantities and events."""
    return "\n".join(filter(None, (_reported(run), _events(run))))


def sections(run: Run) -> str:
    """Peak reactions, the energy ledger, bodies, what is modelled, and how the run was made."""
    return "\n".join((_switched(run), _peaks(run), _ledger(run), _bodies(run), _notes(run), _settings(run)))


def _notes(run: Run) -> str:
    lines = "".join(f"<li>{escape(_sentence(note))}</li>" for note in run.about["notes"])
    return f'<section class="card"><h2>Model assumptions</h2><ul>{lines}</ul></section>' if lines else ""


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:]


def _figure(value: float | None, digits: int = 6) -> str:
    """A number as people write it: a true minus sign, no e-notation where it can be helped."""
    if value is None:
        return "–"
    text = f"{value + 0.0:.{digits}g}"
    mantissa, _, power = text.partition("e")
    return (f"{mantissa} × 10^{int(power)}" if power else text).replace("-", "−")


def _cell(text: str) -> str:
    """One cell: escaped, powers of ten raised, numbers kept on one line."""
    inner = re.sub(r"× 10\^(−?\d+)", r"× 10<sup>\1</sup>", escape(text))
    return f'<td class="number">{inner}</td>' if re.match(r"−?\d|–", text) else f"<td>{inner}</td>"


def _table(title: str, heads: Sequence[str], rows: Iterable[Sequence[str]], remark: str = "", shape: str = "") -> str:
    """A titled table; empty text where there is no row. ``shape`` is a class of the card."""
    body = "".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    if not body:
        return ""
    head = "".join(f'<th scope="col">{escape(text)}</th>' for text in heads)
    below = f'<p class="remark">{escape(remark)}</p>' if remark else ""
    return (
        f'<section class="card {shape}"><h2>{escape(title)}</h2><div class="wide"><table>'
        f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>{below}</section>"
    )


def _reported(run: Run) -> str:
    rows = []
    for label, r in run.report.items():
        value = r.note if r.value is None else f"{_figure(r.value, 8)} {pretty_unit(r.unit)}".strip()
        when = f"{_figure(r.t)} ({r.note})" if r.note and r.value is not None else _figure(r.t)
        rows.append((label, value, when))
    return _table("Report", ("quantity", "value", "at t / s"), rows)


def _events(run: Run, most: int = 100) -> str:
    rows = [(e.name, _figure(e.t, 9), e.kind, {1: "rising", -1: "falling"}.get(e.direction, "")) for e in run.events[:most]]
    return _table(
        "Events",
        ("event", "t / s", "kind", "direction"),
        rows,
        f"the first {most} of {len(run.events)}" if len(run.events) > most else "",
    )


def _switched(run: Run, first: int = 60, last: int = 3) -> str:
    """Mode changes; of very much the first and the last."""
    shown = run.changes if len(run.changes) <= first + last else [*run.changes[:first], *run.changes[-last:]]
    rows = [
        (
            _figure(c.t, 9),
            c.kind,
            ", ".join(c.of),
            _figure(c.lost) if c.before else "",
            "; ".join(f"{name} {_figure(size)}" for name, size in (c.impulses.sizes if c.impulses else {}).items()),
            c.note,
        )
        for c in shown
    ]
    remark = f"the first {first} and the last {last} of {len(run.changes)}" if len(shown) < len(run.changes) else ""
    heads = ("t / s", "kind", "what", "energy lost / J", "impulse / N·s", "")
    return _table("Mode changes", heads, rows, remark, "across")


def _peaks(run: Run) -> str:
    peaks = peak_reactions(run)
    couples = any(peak.couple is not None for peak in peaks)
    all_known = all(peak.determinate for peak in peaks)
    heads = [
        "",
        "on",
        "force / N",
        "at t / s",
        "Fx / N",
        "Fy / N",
        *(["couple / N·m", "at t / s"] if couples else []),
        *([] if all_known else [""]),
    ]
    rows = []
    for p in peaks:
        figures = [_figure(x) for x in (p.size, p.t, p.Fx, p.Fy, *((p.couple, p.t_couple) if couples else ()))]
        rows.append([p.joint, p.body, *figures, *([] if all_known else ["" if p.determinate else "indeterminate"])])
    return _table(
        "Peak reactions",
        heads,
        rows,
        "Forces as they act on the body named, in the fixed axes, when the force is largest.",
        "across",
    )


def _ledger(run: Run) -> str:
    ledger = run.energy
    rows = [(name, _figure(y[0]), _figure(y[-1]), _figure(y.min()), _figure(y.max())) for name, y in ledger.entries.items()]
    worst = float(np.abs(ledger.balance).max())
    return _table(
        "Energy ledger",
        ("J", "start", "end", "least", "most"),
        rows,
        f"Energy error below {worst:.1e} J at all output times.".replace("e-", "e−"),
    )


def _settings(run: Run) -> str:
    s, stats = run.settings, run.stats
    rows = [
        ("degrees of freedom", str(Instant(run.source, run.start).freedom)),
        ("from, to", f"{_figure(run.edges[0])} s to {_figure(run.edges[-1])} s"),
        ("method", s.method),
        ("relative tolerance", _figure(s.rtol)),
        ("route", s.route),
        *(
            (key, _figure(value) if isinstance(value, (int, float)) else str(value))
            for key, value in stats.items()
            if key not in ("method", "rtol")
        ),
        *((f"version of {name}", version) for name, version in versions().items() if name != "platform"),
    ]
    return _table("How it was computed", ("", ""), rows)


def _bodies(run: Run) -> str:
    rows = [(b["name"], _figure(b["mass"]), "particle" if b["particle"] else _figure(b["inertia"])) for b in run.about["bodies"]]
    return _table("Bodies", ("body", "mass / kg", "inertia / kg·m²"), rows)

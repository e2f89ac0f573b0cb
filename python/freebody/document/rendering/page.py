"""HTML: how formulas and tables of a derivation look, and the whole page around them."""

from __future__ import annotations

import html

_FORMULAS = """\
.derivation .equation { display: flex; align-items: center; gap: 1em; margin: .35em 0 .35em 1.5em; }
.derivation .formula { flex: 1; min-width: 0; overflow: auto hidden; padding: .2em 0 .2em 2em; text-indent: -2em; line-height: 1.8; }
.derivation .formula span { display: inline-block; max-width: 100%; text-indent: 0; vertical-align: top; }
.derivation math { font-size: 1.06em; text-indent: 0; }
.derivation mover > mo { padding-bottom: .07em; }
.derivation table { border-collapse: collapse; margin: .7em 0; }
.derivation table :is(th, td) { text-align: left; vertical-align: baseline; padding: .2em 1.2em .2em 0; border-bottom: 1px solid #8886; }
.derivation table :is(th, caption) { font-weight: 600; text-align: left; }
.derivation figure { margin: 1em 0; }
.derivation figure svg { max-width: 100%; height: auto; background: #fff; }
.derivation figcaption { opacity: .75; }
"""
_PAGE = """\
:root { color-scheme: light dark; }
body { max-width: 56rem; margin: 2rem auto; padding: 0 1.2rem; font: 1.02rem/1.5 Georgia, "Times New Roman", serif; }
h1 { font-size: 1.5em; line-height: 1.25; }
h2 { font-size: 1.2em; margin: 1.8em 0 .5em; border-bottom: 1px solid #8886; }
h3 { font-size: 1.05em; }
@media print {
  body { max-width: none; margin: 0; padding: 0; font-size: 10.5pt; }
  h1, h2, h3 { break-after: avoid; }
  .equation, figure, tr { break-inside: avoid; }
  .derivation .formula { overflow: visible; }
}
"""


def fragment(body: str) -> str:
    """A part of a page, with its style."""
    return f'<div class="derivation">\n<style>\n{_FORMULAS}</style>\n{body}</div>\n'


def page(title: str, body: str) -> str:
    """A page by itself; it needs nothing from elsewhere."""
    head = f'<meta charset="utf-8">\n<meta name="viewport" content="width=device-width">\n<title>{html.escape(title)}</title>'
    style = f"<style>\n{_PAGE}</style>"
    return f'<!DOCTYPE html>\n<html lang="en">\n<head>\n{head}\n{style}\n</head>\n<body>\n{fragment(body)}</body>\n</html>\n'

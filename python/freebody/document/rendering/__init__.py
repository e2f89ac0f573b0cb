"""Documents as text, LaTeX, Markdown, HTML and JSON: one file for each, and its entry here."""

from freebody.document.rendering import html, json, latex, markdown, text
from freebody.document.rendering.format import Format

FORMATS: dict[str, Format] = {
    each.ending: each for each in (text.FORMAT, latex.FORMAT, markdown.FORMAT, html.FORMAT, json.FORMAT)
}
"""Output formats by the endings of their files; the first is that of the screen."""

"""Documents in their output formats: one file for each, and its entry here."""

from freebody.document.rendering import html, json, latex, markdown, notebook, text
from freebody.document.rendering.format import Format

_LISTED = (
    text.FORMAT,
    latex.FORMAT,
    markdown.FORMAT,
    html.FORMAT,
    notebook.FORMAT,
    json.FORMAT,
)
FORMATS: dict[str, Format] = {each.ending: each for each in _LISTED}
"""By the endings of their files; the first is that of the screen."""

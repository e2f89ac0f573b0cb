"""The site of the documents, built by `./dev docs`: the files beside this one, the docstrings, and the examples of parts in motion."""

import re
from pathlib import Path

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

from freebody.document.templates import template
from freebody.site import family

project = "freebody"
extensions = ["myst_parser", "sphinx.ext.autodoc"]
myst_heading_anchors = 3
autodoc_member_order = "bysource"
autodoc_typehints = "none"
html_theme = "furo"
html_title = "freebody"
html_show_sphinx = False
html_copy_source = False


class Parts(SphinxDirective):
    """The parts of a family with their examples in motion."""

    required_arguments = 1

    def run(self):
        name = self.arguments[0]
        shown = nodes.raw("", template("freebody.site", "cards.html").render(found=family(name)), format="html")
        return [nodes.section("", nodes.title(text=name.capitalize()), shown, ids=[name])]


class Gallery(SphinxDirective):
    """A link to the pages of the catalogue, where they lie beside those of the documents."""

    def run(self):
        if not (Path(self.env.app.outdir) / "gallery" / "index.html").is_file():
            return []
        link = nodes.reference("", "Walk through the catalogue", refuri="gallery/index.html")
        return [nodes.paragraph("", "", link, ".", classes=["gallery"])]


def plain(app, what, name, found, options, lines):
    """In docstrings of shapes, joints and forces each field has a line of its own."""
    if hasattr(found, "__signature__"):
        lines[:] = [re.sub(r"^(\w+): ", r"| ``\1``: ", line) for line in lines]


def setup(app):
    app.add_directive("parts", Parts)
    app.add_directive("gallery", Gallery)
    app.connect("autodoc-process-docstring", plain)

"""Derivations as documents: every renderer shows every block, and its output is well formed."""

from __future__ import annotations

import base64
import io
import json
import re
import subprocess
from html.parser import HTMLParser
from unicodedata import normalize

import pytest
from fontTools.ttLib import TTFont
from material import LETTERS, cos, half, product, sin, square, sym
from store import ANSWERED, MODELS, derived, every, mechanism
from typer.testing import CliRunner

from freebody.cli import app
from freebody.document.blocks import Bullets, Equation, Figure, Heading, MatrixEquation, Paragraph, Table, Vector, Written
from freebody.document.document import Document
from freebody.document.drawings import drawn
from freebody.document.rendering import FORMATS
from freebody.equations import latex, read
from freebody.equations.topics import topic
from freebody.symbolic.alphabet import columns
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import MINUS_ONE, ZERO, add, mul

TH1, A1, A2 = sym("theta1"), sym("theta1", 2), sym("theta2", 2)
M1, L = sym("m1"), sym("l")
LONG = add(*(mul(sym(f"k{n}"), A2, sin(TH1)) for n in range(14)))


class Shown:
    """A drawing that is its own picture."""

    description = "A box & nothing in it"

    def inline(self):
        return '<svg xmlns="http://www.w3.org/2000/svg"></svg>'

    def save(self, path):
        path.write_bytes(BOX if path.suffix == ".pdf" else self.inline().encode())
        return path


drawn.register(Shown, lambda drawing: drawing)
BOX = b"""%PDF-1.4
1 0 obj <</Type /Catalog /Pages 2 0 R>> endobj
2 0 obj <</Type /Pages /Kids [3 0 R] /Count 1>> endobj
3 0 obj <</Type /Page /Parent 2 0 R /MediaBox [0 0 9 9] /Resources <<>> >> endobj
trailer <</Root 1 0 R>>
"""
DOCUMENT = Document(
    [
        Heading("A pendulum & 100 % of it", 1),
        Paragraph(["The angle ", TH1, " is measured from the vertical; it costs $5_0 <here>."]),
        Equation(Written.of(Name("a", ("G",)), bold=True), Vector(((mul(L, A1, cos(TH1)), "i"), (add(L, M1), "j"), (MINUS_ONE, "e_r"), (ZERO, "k")))),
        Equation(mul(M1, square(L), A1), product(-1, M1, "g", L, sin(TH1)), "AMB about the pivot", "1", "The pin has no moment."),
        Equation(LONG, ZERO, "A long one"),
        MatrixEquation([[M1, half(M1, L)], [ZERO, L]], [A1, A2], [product("g", M1), ZERO], "Both", "2"),
        MatrixEquation([[LONG, ZERO], [ZERO, LONG]], [A1, A2], [ZERO, L], "Too wide for brackets"),
        Bullets(["energy", ["the mass ", M1]]),
        Table(("a", "b"), [("1|2", [TH1])], "Some numbers"),
        Table(("symbol", "what it is", "unit"), [([sym(each.name)], each.doc, each.unit) for each in LETTERS.values()]),
        Figure(Shown(), "A sketch", "sketch"),
    ],
    LETTERS,
)  # fmt: skip


def test_text():
    shown = DOCUMENT.text()
    assert shown.startswith("A pendulum & 100 % of it\n========")
    assert "The angle θ₁ is measured" in shown
    assert "    a_G = l θ̈₁ cos θ₁ i + (m₁ + l) j − e_r\n" in shown
    assert re.search(r"AMB about the pivot:\n    m₁ l² θ̈₁ = −m₁ g l sin θ₁ +\(1\)\nThe pin has no moment\.", shown)
    assert "    ⎡ m₁  ½ m₁ l ⎤ ⎡ θ̈₁ ⎤ = ⎡ m₁ g ⎤\n" in shown
    assert "    ⎡ A₁₁   0  ⎤ ⎡ θ̈₁ ⎤ = ⎡ 0 ⎤\n    ⎣  0   A₁₁ ⎦ ⎣ θ̈₂ ⎦   ⎣ l ⎦\n    A₁₁ = k₀ θ̈₂ sin θ₁" in shown
    assert "- the mass m₁" in shown and "sketch" not in shown
    assert max(map(columns, shown.split("\n"))) <= 100
    assert max(map(columns, DOCUMENT.text(width=72).split("\n"))) <= 72


@every([f"{name} {form}" for name in ANSWERED for form in ("minimal", "brute")], "case", share=300)
def test_no_line_of_a_text_is_wider_than_asked(case):
    name, form = case.split()
    made = derived(name, form)
    for width in (60, 80, 100):
        assert max(map(columns, made.text(width=width).split("\n"))) <= width


def test_the_width_is_that_of_the_terminal(monkeypatch):
    for width, room in ((60, 60), (80, 80), (100, 100), (200, 100)):
        monkeypatch.setenv("COLUMNS", str(width))
        shown = CliRunner().invoke(app, ["equations", str(MODELS["S19.17/model"]), "--form", "brute"]).output
        assert 0.8 * room < max(map(columns, shown.split("\n"))) <= room


def test_no_line_of_a_page_begins_with_what_ends_a_formula():
    shown = Document([Paragraph(["The mass ", M1, ", its length ", L, ": both are given."])], LETTERS).html()
    assert re.findall(r"</math>(?:.)(</span>)?", shown) == ["</span>"] * 2


def test_ascii_text_is_ascii():
    assert DOCUMENT.text(ascii=True).isascii()


@pytest.mark.parametrize("form", FORMATS.values(), ids=list(FORMATS))
def test_every_format_shows_every_block(form, tmp_path):
    path, *figures = DOCUMENT.save(tmp_path / f"made.{form.ending}")
    shown = path.read_text()
    assert shown == DOCUMENT.printed(form.ending, "made")
    assert [figure.suffix for figure in figures] == [form.figures] * bool(form.figures)
    for words in ("A pendulum", "AMB about the pivot", "The pin has no moment.", "the mass", "Some numbers", "what it is"):
        assert words in shown


def test_a_notebook_has_a_cell_for_each_section_with_its_figures():
    made = json.loads(DOCUMENT.printed("ipynb"))
    assert (made["nbformat"], [cell["cell_type"] for cell in made["cells"]]) == (4, ["markdown"])
    [cell] = made["cells"]
    [(name, picture)] = cell["attachments"].items()
    assert f"](attachment:{name})" in cell["source"]
    assert base64.b64decode(picture["image/svg+xml"]).decode() == DOCUMENT.blocks[-1].picture.inline()


def test_markdown():
    shown = DOCUMENT.markdown()
    assert shown.startswith("# A pendulum & 100 % of it\n")
    assert r"The angle $\theta_1$ is measured from the vertical; it costs \$5\_0 \<here\>." in shown
    assert shown.count("$$") == 2 * 6  # an entry of the wide matrix has an equation of its own
    assert r"= -m_1 g l \sin\theta_1 \tag{1}" in shown
    assert r"| 1\|2 | $\theta_1$ |" in shown


def test_latex_is_balanced():
    shown = DOCUMENT.latex()
    assert sorted(re.findall(r"\\begin\{(\w+)\}", shown)) == sorted(re.findall(r"\\end\{(\w+)\}", shown))
    assert shown.count("{") - shown.count(r"\{") == shown.count("}") - shown.count(r"\}")
    assert r"\section*{A pendulum \& 100 \% of it}" in shown and r"costs \$5\_0" in shown
    assert r"\mathbf{a}_G = l \ddot\theta_1 \cos\theta_1 \, \mathbf{i} + (m_1 + l) \, \mathbf{j} - \mathbf{e}_r" in shown


DERIVATIONS = {
    "of every block": lambda: DOCUMENT,
    "pendulum": lambda: mechanism("19.3.15/model").equations(),
    "four-bar": lambda: mechanism("GEN-FOURBAR/model").equations(long=True),
    "a point through a frame": lambda: mechanism("S19.20/model").equations(of="wheel.P", frame="rod"),
    "a point by a chain": lambda: mechanism("GEN-SLIDER/driven").equations(of="rod.end"),
    "smallest set": lambda: mechanism("S19.17/model").equations(want="pivot.Fx"),
    "impact": lambda: topic(mechanism("examples/tossed_box"), "impact"),
}


@pytest.mark.long
@pytest.mark.parametrize("which", DERIVATIONS)
def test_latex_compiles_with_its_figures(which, tmp_path):
    """Nothing is missing from the page, and nothing is wider."""
    head = r"\documentclass{article}\usepackage[utf8]{inputenc}\usepackage{amsmath,amssymb,graphicx}\begin{document}"
    _, *figures = DERIVATIONS[which]().save(tmp_path / "part.tex")
    (tmp_path / "made.tex").write_text(head + r"\input{part}\end{document}")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "made.tex"], cwd=tmp_path, capture_output=True
    )
    said = done.stdout.decode(errors="replace")
    assert done.returncode == 0, said[-2000:]
    assert all(figure.name in said for figure in figures) and "Overfull" not in said, said


def test_figures_are_written_beside_and_words_stand_for_them_elsewhere(tmp_path):
    assert DOCUMENT.save(tmp_path / "a b.md") == [tmp_path / "a b.md", tmp_path / "a b-sketch.svg"]
    assert DOCUMENT.save(tmp_path / "made.tex") == [tmp_path / "made.tex", tmp_path / "made-sketch.pdf"]
    assert DOCUMENT.save(tmp_path / "made.html") == [tmp_path / "made.html"]
    assert "](<a b-sketch.svg>)\n\nA sketch" in (tmp_path / "a b.md").read_text()
    assert r"\includegraphics{made-sketch.pdf}" in (tmp_path / "made.tex").read_text()
    assert r"\[Figure: A box & nothing in it\]" in DOCUMENT.markdown()
    assert r"[Figure: A box \& nothing in it]" in DOCUMENT.latex()
    assert json.loads(DOCUMENT.json())["blocks"][-1]["shows"] == Shown.description


class Nesting(HTMLParser):
    """Elements that are opened are closed; what formulas say, sign by sign."""

    def __init__(self):
        super().__init__()
        self.open, self.said = [], []

    def handle_starttag(self, tag, attrs):
        if tag != "meta":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_data(self, data):
        if "math" in self.open:
            self.said.append(data)


@pytest.mark.parametrize("shown", [DOCUMENT._repr_html_(), DOCUMENT.html()], ids=["fragment", "page"])
def test_html_is_well_formed_and_typeset(shown):
    parser = Nesting()
    parser.feed(shown)
    assert parser.open == []
    assert "\\" not in shown and "&lt;here&gt;" in shown and "<figure><svg" in shown
    assert "The angle <math><msub><mi>θ</mi><mn>1</mn></msub></math> is" in shown
    said = "".join(parser.said)
    assert "m1l2θ¨1=−m1glsinθ1" in said and "𝐚G=lθ¨1cosθ1𝐢+(m1+l)𝐣−𝐞r" in said


def test_a_page_is_whole_and_needs_nothing_from_elsewhere():
    page = DOCUMENT.html()
    assert page.startswith("<!DOCTYPE html>") and '<meta charset="utf-8">' in page
    assert "<title>A pendulum &amp; 100 % of it</title>" in page
    assert not re.search(r"<script|<link|src=|url\((?!#|data:)", page)


ITALIC = {*range(0x1D434, 0x1D468), *range(0x1D6E2, 0x1D6FB), *range(0x1D6FC, 0x1D71C)} - {0x1D455}
"""The letters as which a browser shows single ones (MathML Core, C.1); h is that of Planck."""


@every(ANSWERED, "name", share=100)
def test_a_page_brings_the_signs_of_its_formulas_and_brackets_that_grow(name):
    parser = Nesting()
    parser.feed(derived(name, "minimal").html())
    [font] = re.findall(r"data:font/woff;base64,([\w+/=]+)", derived(name, "minimal").html())
    font = TTFont(io.BytesIO(base64.b64decode(font)))
    said = {sign for sign in "".join(parser.said) if not sign.isspace()}
    slanted = {code for code in range(0x1D434, 0x1D71C) if normalize("NFKC", chr(code)) in {normalize("NFKC", x) for x in said}}
    assert {*map(ord, said), *(code for code in slanted if code in ITALIC)} <= font.getBestCmap().keys()
    grows = font["MATH"].table.MathVariants.VertGlyphCoverage.glyphs
    assert {font.getBestCmap()[ord(sign)] for sign in "()[]√"} <= {*grows}


def test_json_has_trees_and_what_is_printed():
    made = json.loads(DOCUMENT.json())
    assert [block["kind"] for block in made["blocks"]][:4] == ["heading", "paragraph", "equation", "equation"]
    equation = made["blocks"][3]
    assert read(equation["left"]["tree"]) == DOCUMENT.blocks[3].left
    assert equation["right"]["text"] == "−m₁ g l sin θ₁"
    assert equation["left"]["latex"] == latex(DOCUMENT.blocks[3].left, LETTERS)
    assert made["letters"]["theta1"] == {"kind": "coordinate", "unit": "rad", "doc": "angle of the upper rod"}


def test_sympy_solves_the_equations_of_a_document():
    import sympy
    from sympy.physics.mechanics import dynamicsymbols

    equations = DOCUMENT.sympy()
    assert len(equations) == 4
    theta, g, l = dynamicsymbols("theta1"), *sympy.symbols("g l")
    assert sympy.solve(equations[0], theta.diff("t", 2)) == [-g * sympy.sin(theta) / l]

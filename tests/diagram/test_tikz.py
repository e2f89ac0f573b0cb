"""Diagrams as TikZ have all that is on the sheet, and LaTeX takes them."""

import re
import subprocess

import pytest

from freebody.mechanism import Mechanism
from freebody.views.diagram.couples import CoupleArrow

MODELS = {
    "systems/GEN-FOURBAR-four-bar-positions/model.yaml": False,
    "systems/19.3.20-guide-and-pendulum/pulleys.yaml": False,
    "systems/GEN-SUSP-suspensions/half.yaml": True,
}
PAGE = r"\documentclass{article}\usepackage{amsmath,amssymb,tikz}\usetikzlibrary{arrows.meta}\begin{document}\noindent\input{part}\end{document}"


@pytest.mark.parametrize("model", MODELS)
def test_every_arrow_and_label_is_there(model, tmp_path):
    drawn = Mechanism.load(model).diagram(to_scale=MODELS[model])
    written = drawn.save(tmp_path / "part.tex").read_text()
    panels = [panel for cut in drawn.cuts for panel in (*cut.panels, *cut.apart)]
    marks = [mark for panel in panels for mark in panel.marks]
    dimensions = [each for panel in panels for each in panel.scenery.dimensions]
    assert written.count("Triangle[") == len(marks) + len(dimensions) + 2  # and those of x and y
    arcs = sum(isinstance(mark, CoupleArrow) for mark in marks) + sum(len(each.arrow) > 2 for each in dimensions)
    assert arcs <= len(re.findall(r"^\\path\[draw=\w+,line width=\S+bp\] ", written, re.MULTILINE))
    for panel in panels:
        for label in panel.labels:
            assert f"{{{label.label.text}}};" in written or label.label.bold


@pytest.mark.long
@pytest.mark.parametrize("model", MODELS)
def test_latex_takes_it(model, tmp_path):
    Mechanism.load(model).diagram(to_scale=MODELS[model]).save(tmp_path / "part.tex")
    (tmp_path / "made.tex").write_text(PAGE)
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "made.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True)
    assert done.returncode == 0, done.stdout.decode(errors="replace")[-2000:]

"""The most brute force: three coordinates a body, every joint a constraint."""

from __future__ import annotations

from dataclasses import replace

from freebody.document.blocks import Block, Equation, Figure, Heading, Matrices, Matrix, Paragraph, Written, listed
from freebody.document.drawings import ConfigurationDrawing
from freebody.equations.derivation import loop_closure
from freebody.equations.derivation.form import Form, Printed, System
from freebody.solve.symbolic_state import Row, SymbolicState
from freebody.symbolic.formula import GAP, NEGATIVE, Grid, typed
from freebody.symbolic.linear import Linear
from freebody.symbolic.nomenclature import Nomenclature, SymbolEntry
from freebody.symbolic.symbols import Name, Renamed
from freebody.symbolic.tree import is_zero, negative, read

_BLOCKS = Written(
    "[M −W; G 0] [a; λ]",
    (Grid(((typed("M"), (NEGATIVE, *typed("W"))), (typed("G"), typed("0")))), GAP, Grid(((typed("a"),), (typed("λ"),)))),
)
_RIGHT = Written("[f; c]", (Grid(((typed("f"),), (typed("c"),))),))
_LEGEND = (
    "M has the masses and inertias, W what a unit of each unknown force does to the bodies, G what the constraints ask of the "
    "accelerations a; λ are the unknown forces, f the known ones, c what of the constraints depends on velocities and time. "
)
_INTRODUCTION = (
    "Each body is placed by itself, by x and y of its mass centre and its angle φ (a particle by x and y): "
    "{} coordinates{}. The joints stand as constraints."
)
_ALONG_CURVES = ", those of joints along their curves among them"
_CAPTION = "Every body by itself: its mass centre from the origin, its angle from the x axis. What is 0 now is drawn a little further on."

_WHAT = {"x": ("m", "x of the mass centre of {}"), "y": ("m", "y of the mass centre of {}"), "phi": ("rad", "angle of {}")}
_STARTS = {"place_x": "x", "place_y": "y", "angle": "phi", "x": "x", "y": "y", "phi": "phi"}
"""How a symbol of the core begins: the long words where a parameter of the model has the usual name."""


def constrained(subject: SymbolicState) -> tuple[Form, Nomenclature]:
    """The form of a subject, and its symbols: the places of the bodies are the coordinates here."""
    [stated] = subject.ask([{"ask": "constraints"}])
    names, rows = stated["coordinates"], list(map(Row.read, stated["rows"]))
    equations = []
    for data in stated["balances"]:
        title = f"{data['kind'].replace('about G', 'about its mass centre')} for {data['body']}"
        equations.append(Printed(title, read(data["right"]), read(data["left"]), Linear.read(data["linear"])))
    nomenclature = _nomenclature(names, subject)
    form = Form.of(nomenclature, equations + loop_closure.printed(rows))
    made: list[Block] = [
        Heading("Coordinates"),
        Paragraph(_INTRODUCTION.format(len(names), _ALONG_CURVES if {*names} & {*subject.nomenclature} else "")),
    ]
    made.append(Figure(ConfigurationDrawing(subject.source, subject.state, each_body=True), _CAPTION, "sketch"))
    made += loop_closure.section(rows, names, everywhere=True) if rows else []
    made.append(Heading("Balance equations"))
    made += [Equation(e.left, e.right, e.title, str(i)) for i, e in enumerate(equations, 1)]
    return replace(form, blocks=(*made, *_in_blocks(form.system, len(equations)))), nomenclature


def _in_blocks(system: System, balances: int) -> list[Block]:
    """Balances above constraints, accelerations before forces; accelerations in the order of the balances that hold them."""
    moving = sum(1 for x in system.unknowns if x.dots)
    above, below = system.matrix[:balances], system.matrix[balances:]
    order = sorted(range(moving), key=lambda column: [is_zero(row[column]) for row in above])
    masses, held = ([[row[column] for column in order] for row in rows] for rows in (above, below))
    a, forces = [system.unknowns[column] for column in order], system.unknowns[moving:]
    legend = Paragraph([_LEGEND, "a = (", *listed(a), "), λ = (", *listed(forces), ")."])
    whole = Equation(_BLOCKS, _RIGHT, "Balances and constraints as one block system")
    made: list[Block] = [Heading("Matrix form"), whole, legend]
    off = any(not is_zero(entry) for i, row in enumerate(masses) for j, entry in enumerate(row) if i != j)
    if masses and not off and len(masses) == len(order):
        made.append(Paragraph(["M = diag(", *listed(row[i] for i, row in enumerate(masses)), ")"]))
        masses = []
    loads = [[negative(entry) for entry in row[moving:]] for row in above]
    f, c = ([[x] for x in side] for side in (system.right[:balances], system.right[balances:]))
    blocks = (("M", masses), ("W", loads), ("G", held), ("f", f), ("c", c))
    there = ((name, rows) for name, rows in blocks if rows and rows[0])
    return made + [Equation(Written(name, typed(name)), Matrices((Matrix(rows, name),))) for name, rows in there]


def _nomenclature(names: list[str], subject: SymbolicState) -> Nomenclature:
    found: dict[str, SymbolEntry] = {}
    known, renamed = subject.nomenclature, dict(subject.nomenclature.renamed)
    for name in names:
        if name in known:  # the coordinate of a joint along a curve
            found[name] = known[name]
            continue
        word, body = next(
            (word, name.removeprefix(f"{start}_")) for start, word in _STARTS.items() if name.startswith(f"{start}_")
        )
        unit, doc, usual = *_WHAT[word], f"{word}_{body}"
        found[name] = SymbolEntry(name, "coordinate", unit, doc.format(body))
        if name != usual:
            renamed[name] = Renamed(Name.parse(usual), f"the parameter {usual}", doc.format(body), Name.parse(name))
    rest = {symbol.name: symbol for symbol in known.values() if symbol.kind != "coordinate"}
    rest |= {
        symbol.name: replace(symbol, kind="parameter") for symbol in known.values() if symbol.written and symbol.name not in rest
    }
    return Nomenclature(found | rest, renamed)

"""The most brute force: three coordinates a body, every joint a constraint."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from freebody.document.blocks import Block, Equation, Figure, Heading, Matrices, Matrix, Paragraph, Written, listed
from freebody.equations.derivation import loop_closure
from freebody.equations.derivation.data import Row, SymbolicState
from freebody.equations.derivation.result import Form, Printed
from freebody.equations.derivation.system import System
from freebody.equations.linear import Linear
from freebody.symbolic.formula import GAP, NEGATIVE, Grid, typed
from freebody.symbolic.letters import Letter, Letters
from freebody.symbolic.symbols import Name, Renamed
from freebody.symbolic.tree import Tree, is_zero, negative, read

_BLOCKS = Written(
    "[M −W; G 0] [a; λ]",
    (Grid(((typed("M"), (NEGATIVE, *typed("W"))), (typed("G"), typed("0")))), GAP, Grid(((typed("a"),), (typed("λ"),)))),
)
_RIGHT = Written("[f; c]", (Grid(((typed("f"),), (typed("c"),))),))
_LEGEND = (
    "M has the masses and inertias, W what a unit of each unknown force does to the bodies, G what the constraints ask of the "
    "accelerations a; λ are the unknown forces, f the known ones, c what of the constraints depends on velocities and time. "
)

_CAPTION = "Every body by itself: its mass centre from the origin, its angle from the x axis. What is 0 now is drawn a little further on."

_WHAT = {"x": ("m", "x of the mass centre of {}"), "y": ("m", "y of the mass centre of {}"), "phi": ("rad", "angle of {}")}
_STARTS = {"place_x": "x", "place_y": "y", "angle": "phi", "x": "x", "y": "y", "phi": "phi"}
"""How a letter of the core begins: the long words where a parameter of the model has the usual name."""


def constrained(subject: SymbolicState) -> tuple[Form, Letters]:
    """The form of a subject, and its letters: the places of the bodies are the coordinates here."""
    stated = subject.ask([{"ask": "constraints"}])[0]
    names = stated["coordinates"]
    rows = [Row.read(each) for each in stated["rows"]]
    equations = [_balance(each) for each in stated["balances"]]
    made: list[Block] = [Heading("Coordinates"), Paragraph(_introduction(names)), _sketch(subject)]
    if rows:
        made += loop_closure.section(rows, names, everywhere=True)
    made.append(Heading("Balance equations"))
    made += [Equation(e.left, e.right, e.title, str(i)) for i, e in enumerate(equations, 1)]
    letters = _letters(names, subject)
    form = Form.of(letters, equations + loop_closure.printed(rows), [])
    made += _in_blocks(form.system, len(equations))
    return replace(form, blocks=tuple(made)), letters


def _sketch(subject: SymbolicState) -> Figure:
    """The mechanism with the place of every body."""
    from freebody.views.diagram.configuration import Places

    return Figure(Places(subject.source, subject.state), _CAPTION, "sketch")


def _in_blocks(system: System, balances: int) -> list[Block]:
    """Balances above constraints, accelerations before forces; accelerations in the order of the balances that hold them."""
    moving = sum(1 for x in system.unknowns if x.dots)
    above, below = system.matrix[:balances], system.matrix[balances:]
    order = sorted(range(moving), key=lambda column: [is_zero(row[column]) for row in above])
    masses, held = ([[row[column] for column in order] for row in rows] for rows in (above, below))
    loads = [[negative(entry) for entry in row[moving:]] for row in above]
    made: list[Block] = [Heading("Matrix form"), Equation(_BLOCKS, _RIGHT, "Balances and constraints as one block system")]
    made.append(
        Paragraph(
            [
                _LEGEND,
                "a = (",
                *listed([system.unknowns[column] for column in order]),
                "), λ = (",
                *listed(system.unknowns[moving:]),
                ").",
            ]
        )
    )
    diagonal = _diagonal(masses)
    if diagonal:
        made.append(Paragraph(["M = diag(", *listed(diagonal), ")"]))
    columns = (("f", system.right[:balances]), ("c", system.right[balances:]))
    blocks = [
        ("M", masses if not diagonal else []),
        ("W", loads),
        ("G", held),
        *((name, [[x] for x in side]) for name, side in columns),
    ]
    return made + [Equation(Written(name, typed(name)), Matrices((Matrix(rows, name),))) for name, rows in blocks if rows and rows[0]]


def _diagonal(rows: Sequence[Sequence[Tree]]) -> list[Tree]:
    """The diagonal of a matrix that has nothing else; else nothing."""
    off = any(not is_zero(entry) for i, row in enumerate(rows) for j, entry in enumerate(row) if i != j)
    return [] if off or any(len(row) != len(rows) for row in rows) else [row[i] for i, row in enumerate(rows)]


def _balance(data: dict) -> Printed:
    left, right = read(data["right"]), read(data["left"])
    where = data["kind"].replace("about G", "about its mass centre")
    return Printed(f"{where} for {data['body']}", left, right, Linear.read(data["linear"]))


def _letters(names: list[str], subject: SymbolicState) -> Letters:
    found: dict[str, Letter] = {}
    known, renamed = subject.letters, dict(subject.letters.renamed)
    for name in names:
        word, body = next((word, name.removeprefix(f"{start}_")) for start, word in _STARTS.items() if name.startswith(f"{start}_"))
        unit, doc = _WHAT[word]
        found[name] = Letter(name, "coordinate", unit, doc.format(body))
        usual = f"{word}_{body}"
        if name != usual:
            renamed[name] = Renamed(Name.parse(usual), f"the parameter {usual}", doc.format(body), Name.parse(name))
    rest = {letter.name: letter for letter in known.values() if letter.kind != "coordinate"}
    rest |= {letter.name: replace(letter, kind="parameter") for letter in known.values() if letter.written and letter.name not in rest}
    return Letters(found | rest, renamed)


def _introduction(names: list[str]) -> str:
    return (
        "Each body is placed by itself, by x and y of its mass centre and its angle φ (a particle by x and y): "
        f"{len(names)} coordinates. What the joints hold is told by constraints."
    )

"""The most brute force: three coordinates a body, every joint a constraint."""

from __future__ import annotations

from freebody.equations.derivation import closing
from freebody.equations.derivation.result import Form, Printed
from freebody.equations.derivation.told import Row, Subject
from freebody.equations.document import Block, Equation, Heading, Paragraph
from freebody.equations.letters import Letter, Letters
from freebody.equations.linear import Linear
from freebody.equations.tree import read

_WHAT = {"x": ("m", "x of the mass centre of {}"), "y": ("m", "y of the mass centre of {}"), "phi": ("rad", "angle of {}")}


def constrained(subject: Subject) -> tuple[Form, Letters]:
    """The form of a subject, and its letters: the places of the bodies are the coordinates here."""
    told = subject.ask([{"ask": "constraints"}])[0]
    names = told["coordinates"]
    rows = [Row.read(each) for each in told["rows"]]
    equations = [_balance(each) for each in told["balances"]]
    made: list[Block] = [Heading("Coordinates"), Paragraph(_introduction(names))]
    if rows:
        made += closing.section(rows, names, everywhere=True)
    made.append(Heading("Balance equations"))
    made += [Equation(e.left, e.right, e.title, str(i)) for i, e in enumerate(equations, 1)]
    letters = _letters(names, subject.letters)
    form = Form.of(letters, equations + closing.printed(rows), made)
    return form, letters


def _balance(data: dict) -> Printed:
    left, right = read(data["right"]), read(data["left"])
    where = data["kind"].replace("about G", "about its mass centre")
    return Printed(f"{where} for {data['body']}", left, right, Linear.read(data["linear"]))


def _letters(names: list[str], known: Letters) -> Letters:
    found: dict[str, Letter] = {}
    for name in names:
        word, _, body = name.partition("_")
        unit, doc = _WHAT[word]
        found[name] = Letter(name, "coordinate", unit, doc.format(body))
    rest = {letter.name: letter for letter in known.values() if letter.kind != "coordinate"}
    return Letters(found | rest)


def _introduction(names: list[str]) -> str:
    return (
        "Each body is placed by itself, by x and y of its mass centre and its angle φ (a particle by x and y): "
        f"{len(names)} coordinates. What the joints hold is told by constraints."
    )

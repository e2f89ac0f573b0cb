"""Small departures from equilibrium: matrices, eigenvalues, when it is stable, frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.told import Subject
from freebody.equations.document import Block, Bullets, Document, Equation, Heading, MatrixEquation, Paragraph, Words
from freebody.equations.given import exact, exact_angle, given
from freebody.equations.letters import Letter
from freebody.equations.solve import Singular, TooLarge, solve
from freebody.equations.stability import Eigenvalue, Stability, characteristic, eigenvalues, stability
from freebody.equations.text import text
from freebody.equations.topics.common import NotHere, document, moving_names, subject_of
from freebody.equations.tree import ONE, ZERO, Sym, Tree, add, evaluate, is_zero, mul, negative, read

if TYPE_CHECKING:
    from freebody.instant import State
    from freebody.model.builder import Builder

Matrix = list[list[Tree]]
REST = 1e-8
"""Out-of-balance force, relative to the largest load, below which a place is an equilibrium."""


@dataclass(frozen=True)
class Linearised:
    """M ẍ + C ẋ + K x = 0 for departures x of the coordinates from ``place``; ``left`` is what is out of balance there."""

    coordinates: tuple[str, ...]
    place: Mapping[str, Tree]
    mass: Matrix
    damping: Matrix
    stiffness: Matrix
    left: list[Tree]

    def first_order(self) -> Matrix:
        """A of ż = A z with z = (x, ẋ). Raises ``TooLarge``, ``Singular``."""
        n = len(self.coordinates)
        columns = [[row[j] for row in matrix] for matrix in (self.stiffness, self.damping) for j in range(n)]
        solved = [[negative(entry) for entry in solve(self.mass, column)] for column in columns]
        upper = [[ONE if j == n + i else ZERO for j in range(2 * n)] for i in range(n)]
        return upper + [[column[i] for column in solved] for i in range(n)]


def linearised(subject: Subject, set_to: Mapping[str, Tree] | None = None) -> Linearised:
    """The linear equations at the state of a subject, or where ``set_to`` says. Raises ``NotHere`` where coordinates depend on
    each other."""
    if subject.rows:
        names = list(dict.fromkeys(row.name for row in subject.rows))
        raise NotHere(f"the coordinates depend on each other ({joined(names)}); linear equations are for open trees at rest")
    names = moving_names(subject)
    told = subject.ask([{"ask": "linear", "at": {}}])[0]
    place = {c["name"]: _plain(c["dimension"], x) for c, x in zip(subject.coordinates, subject.state.q, strict=True)}
    place |= dict(set_to or {})

    def there(data: Any) -> Tree:
        return _put(read(data), place)

    rows = [
        [*map(there, (*m, *c, *k, left))] for m, c, k, left in zip(*(told[word] for word in ("M", "C", "K", "left")), strict=True)
    ]
    rows = [row if _is_upright(subject, row[i]) else [negative(entry) for entry in row] for i, row in enumerate(rows)]
    n = len(names)
    matrices = ([row[start : start + n] for row in rows] for start in (0, n, 2 * n))
    return Linearised(tuple(names), place, *matrices, [row[-1] for row in rows])


def _is_upright(subject: Subject, inertia: Tree) -> bool:
    """Whether the inertia of an equation's own coordinate is positive, as a person writes it."""
    return float(evaluate(inertia, subject.values, subject.tables)) >= 0


def linear(mechanism: Builder, state: State, **at: Any) -> Document:
    """Linear equations about an equilibrium: that of the state, or coordinates and parameters as given (``theta="180 deg"``).

    With them the characteristic polynomial, the eigenvalues, the frequencies, and when it is stable, as far as they are short.
    Raises ``NotHere`` where the place is no equilibrium."""
    subject = subject_of(mechanism, state, at_rest=True)
    set_to = given(mechanism, at).trees
    found = linearised(subject, set_to)
    _require_rest(subject, found)
    made: list[Block] = [Heading("Equilibrium"), Paragraph(_place(found))]
    made += [
        Heading("Linear equations"),
        Paragraph("For small departures of the coordinates from there, M ẍ + C ẋ + K x = 0, with"),
    ]
    shown = (("M", found.mass), ("C", found.damping), ("K", found.stiffness))
    made += [_matrix(letter, matrix, found, dots) for (letter, matrix), dots in zip(shown, (2, 1, 0), strict=True)]
    return document(
        subject,
        "linear equations about an equilibrium",
        made + _character(subject, found),
        [Letter("s", "parameter", "1/s", "eigenvalue")],
    )


def _plain(dimension: str | None, value: float) -> Tree:
    return exact_angle(float(value)) if dimension == "rad" else exact(float(value))


def _put(tree: Tree, place: Mapping[str, Tree]) -> Tree:
    import sympy

    from freebody.equations.to_sympy import from_sympy, to_sympy

    values = {sympy.Symbol(name): to_sympy(value) for name, value in place.items()}
    return from_sympy(sympy.factor_terms(sympy.expand(to_sympy(tree).subs(values, simultaneous=True))))


def _require_rest(subject: Subject, found: Linearised) -> None:
    values = dict(subject.values)
    largest = max((abs(float(evaluate(entry, values, subject.tables))) for row in found.stiffness for entry in row), default=0.0)
    for name, tree in zip(found.coordinates, found.left, strict=True):
        out = float(evaluate(tree, values, subject.tables))
        if abs(out) > REST * max(largest, 1.0):
            raise NotHere(
                f"this is no equilibrium: {text(tree, subject.letters)} ({out:.4g}) is out of balance for {name}; "
                "give the coordinates of one, theta=0"
            )


def _place(found: Linearised) -> Words:
    said: list[str | Tree] = ["At rest with "]
    for i, name in enumerate(found.coordinates):
        said += [", " * bool(i), Sym(name), " = ", found.place[name]]
    return [*said, " everything stays at rest."]


def _matrix(letter: str, matrix: Matrix, found: Linearised, dots: int) -> Block:
    if all(is_zero(entry) for row in matrix for entry in row):
        return Paragraph(f"{letter} = 0.")
    if len(matrix) == 1:
        return Equation(Sym(letter), matrix[0][0])
    unknowns = [Sym(name, dots) for name in found.coordinates]
    product = [add(*(mul(entry, x) for entry, x in zip(row, unknowns, strict=True) if not is_zero(entry))) for row in matrix]
    return MatrixEquation(matrix, unknowns, product, ["The product with ", letter])


def _character(subject: Subject, found: Linearised) -> list[Block]:
    made: list[Block] = []
    positive = [name for name, value in subject.values.items() if not name.dots and value > 0]
    names = [letter.name for letter in positive]
    try:
        matrix = found.first_order()
        polynomial = characteristic(matrix, subject.letters)
        made += [Heading("Eigenvalues"), Equation(_powers(polynomial), ZERO, "The characteristic equation")]
        made += _eigenvalues(matrix, subject, names)
        made += _when(_reduced(polynomial), subject, names)
    except (TooLarge, Singular) as error:
        made.append(Paragraph(f"In letters no more is said: {error}."))
    return made + _numbers(subject, found)


def _powers(polynomial: Sequence[Tree]) -> Tree:
    from freebody.equations.tree import power

    order = len(polynomial) - 1
    return add(*(mul(factor, power(Sym("s"), order - i)) for i, factor in enumerate(polynomial) if not is_zero(factor)))


def _eigenvalues(matrix: Matrix, subject: Subject, names: Sequence[str]) -> list[Block]:
    try:
        found = eigenvalues(matrix, subject.letters, positive=names)
    except TooLarge as error:
        return [Paragraph(f"{str(error).capitalize()}.")]
    return [
        Paragraph("The eigenvalues:"),
        Bullets([_told(value) for value in found]),
    ]


def _told(value: Eigenvalue) -> Words:
    real = [] if is_zero(value.real) and not is_zero(value.imaginary) else [value.real]
    imaginary = [] if is_zero(value.imaginary) else [*([" + "] if real else []), value.imaginary, " i"]
    return [*real, *imaginary, f", {value.count} times" * (value.count > 1)]


def _reduced(polynomial: Sequence[Tree]) -> list[Tree]:
    """Without the roots 0 of coordinates that nothing brings back."""
    kept = list(polynomial)
    while len(kept) > 1 and is_zero(kept[-1]):
        kept.pop()
    return kept


def _when(polynomial: list[Tree], subject: Subject, names: Sequence[str]) -> list[Block]:
    if len(polynomial) == 1:
        return [Paragraph("All eigenvalues are 0: nothing brings it back.")]
    found = stability(polynomial, subject.letters, positive=names)
    made: list[Block] = [Heading("Stability"), Paragraph(_verdict(found))]
    return made + [Bullets([[condition, " > 0"] for condition in found.conditions])] * bool(found.conditions and not found.never)


def _verdict(found: Stability) -> str:
    kind = "Small departures die out" if found.kind == "decays" else "Small departures stay small and oscillate"
    if found.never:
        return f"{kind} for no values of the letters: it is unstable."
    return f"{kind} if" if found.conditions else f"{kind} for all values of the letters (those of the model being positive)."


def _numbers(subject: Subject, found: Linearised) -> list[Block]:
    m, c, k = numbers(subject, found)
    n = len(m)
    try:
        roots = np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]))
    except np.linalg.LinAlgError:
        return []
    told = sorted({(round(float(r.real), 6), round(abs(float(r.imag)), 6)) for r in roots})
    said = [f"{a:.5g} 1/s" if not b else f"{a + 0.0:.5g} ± {b:.5g} i 1/s (period {2 * np.pi / b:.5g} s)" for a, b in told]
    return [Heading("In numbers"), Paragraph("With the parameters of the model the eigenvalues are"), Bullets(said)]


def numbers(subject: Subject, found: Linearised) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, C and K with the numbers of the model, SI."""
    values, tables = subject.values, subject.tables
    matrices = (found.mass, found.damping, found.stiffness)
    return tuple(np.array([[float(evaluate(e, values, tables)) for e in row] for row in matrix]) for matrix in matrices)

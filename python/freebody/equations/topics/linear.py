"""Small departures from equilibrium: matrices, eigenvalues, when it is stable, frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from freebody.balances.states import nearby
from freebody.equations.departures import Held, Linearised, Matrix, held, independent, is_natural, linearised, numbers, place_of
from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.told import Subject
from freebody.equations.document import Block, Bullets, Document, Equation, Heading, MatrixEquation, Paragraph, Words, listed
from freebody.equations.equilibrium import rest_near
from freebody.equations.given import Given, given
from freebody.equations.letters import Letter
from freebody.equations.measured import shown
from freebody.equations.solve import Singular, TooLarge
from freebody.equations.stability import Eigenvalue, Stability, characteristic, eigenvalues, stability
from freebody.equations.topics.common import NotHere, document, subject_of
from freebody.equations.tree import ZERO, Sym, Tree, add, evaluate, is_zero, mul
from freebody.instant import Instant

if TYPE_CHECKING:
    from freebody.instant import State
    from freebody.model.builder import Builder


_STANDS = 1e-9
"""Rate, rad/s or m/s, below which what is prescribed stands still."""


def linear(mechanism: Builder, state: State, **at: Any) -> Document:
    """Linear equations about an equilibrium: that of the state, or near it, coordinates and parameters being as given
    (``theta="180 deg"``); where that is none, the one that Newton's method finds from there.

    With them the characteristic polynomial, the eigenvalues, the frequencies, and when it is stable, as far as they are short.
    Where loops, motions or contacts hold, of the departures that they leave free. Raises ``NotHere`` where no equilibrium is found."""
    chosen = given(mechanism, at)
    first = chosen.start(mechanism, True, None) if at else replace(state, u=np.zeros_like(state.u))
    rest = _rest(mechanism, first)
    if rest is not first:
        chosen = Given({name: tree for name, tree in chosen.trees.items() if name not in place_of(subject_of(mechanism, first))})
    subject = subject_of(mechanism, rest, at_rest=True)
    _require_stillness(subject)
    _require_regular(subject)
    made, found = _departures(subject, chosen)
    where = [Heading("Equilibrium"), Paragraph(_place(subject, chosen, rest is not first))]
    title = "linear equations about an equilibrium"
    more = [Letter("s", "parameter", "1/s", "eigenvalue"), *_letters_of(subject).values()]
    return document(subject, title, where + made + _character(subject, found), more)


def _rest(mechanism: Builder, state: State) -> State:
    """The state, or the place of rest that is found near it."""
    source = mechanism.source()
    unrest = Instant(source.core, state, about=source.about).unrest()
    found = rest_near(source, state) if unrest else state
    if found is None:
        told = "; ".join(f"{name} {how}" for name, how in unrest.items())
        raise NotHere(
            f"this is no equilibrium: released there, {told}; and none was found near by. "
            "Give coordinates near one, theta=0, or a parameter that holds it"
        )
    return found


def _require_stillness(subject: Subject) -> None:
    """Raises ``NotHere`` for motions that are going on."""
    for row in subject.rows:
        if row.rate is not None and abs(float(evaluate(row.rate, subject.values, subject.tables))) > _STANDS:
            raise NotHere(f"{row.name} prescribes a rate that is not 0, so nothing stays at rest; set it to stand still")


def _require_regular(subject: Subject) -> None:
    """Raises ``NotHere`` where loops hold less than beside it."""
    names = [c["name"] for c in subject.coordinates]
    ranks = [
        len(independent(np.array([[row.coefficients[name] for name in names] for row in free.rows])))
        for free in nearby(subject.source, subject.state)
        if free.rows
    ]
    if ranks and ranks[0] < max(ranks):
        raise NotHere(
            "in this place loops lose their independence: more can move for an instant than elsewhere, and what moves there is not "
            "told by linear equations; give a place beside it"
        )


def _departures(subject: Subject, chosen: Given) -> tuple[list[Block], Linearised]:
    """The linear equations, and those of what is left free, in letters; where these are too long lengths and angles in numbers."""
    place = place_of(subject)
    put = {name: tree for name, tree in place.items() if is_natural(tree)} | dict(chosen.trees)
    whole = linearised(subject, put)
    made = _equations(subject, whole)
    if not subject.rows:
        return made, whole
    numbers: list[str] = []
    try:
        left = held(subject, whole, put)
    except TooLarge:
        numbers = [name for name in subject.letters.geometric() if name not in chosen.trees]
        subject, put = subject.with_numbers([n for n in numbers if n not in place]), place | dict(chosen.trees)
        left = held(subject, linearised(subject, put), put)
    return made + _left_free(subject, left, numbers), left.equations


def _letters_of(subject: Subject) -> dict[str, Letter]:
    """The letters of departures by coordinate: ξ where the coordinates themselves are in the equations, for their places at rest."""
    coordinates = subject.coordinates
    if not subject.rows and all(map(is_natural, place_of(subject).values())):
        return {c["name"]: subject.letters[c["name"]] for c in coordinates}
    stem = next(stem for stem in ("xi", "eta", "zeta") if not any(name.startswith(stem) for name in subject.letters))
    return {
        c["name"]: Letter(
            f"{stem}{i}" if len(coordinates) > 1 else stem, "coordinate", c["dimension"] or "", f"departure of {c['name']}"
        )
        for i, c in enumerate(coordinates, 1)
    }


def _equations(subject: Subject, found: Linearised) -> list[Block]:
    letters = _letters_of(subject)
    pairs = [(name, letter.name) for name, letter in letters.items() if name != letter.name]
    said: list[str | Tree] = ["For small departures"]
    for i, (name, letter) in enumerate(pairs):
        said += ["," * bool(i) + " ", Sym(letter), " of ", Sym(name)]
    said.append(f"{'' if pairs else ' of the coordinates'} from there, M ẍ + C ẋ + K x = ")
    said.append(
        "what the loads that hold it change by, these loads being in K as they are at rest:" if subject.rows else "0, with"
    )
    return [Heading("Linear equations"), Paragraph(said), *_matrices(found, letters)]


def _matrices(found: Linearised, letters: Mapping[str, Letter]) -> list[Block]:
    shown = (("M", found.mass, 2), ("C", found.damping, 1), ("K", found.stiffness, 0))
    unknowns = [letters[name].name for name in found.coordinates]
    return [_matrix(letter, matrix, unknowns, dots) for letter, matrix, dots in shown]


def _left_free(subject: Subject, left: Held, numbers: Sequence[str]) -> list[Block]:
    """How the other coordinates follow, and the equations of those that are free."""
    letters = _letters_of(subject)
    free = [Sym(letters[name].name) for name in left.equations.coordinates]
    names = joined(list(dict.fromkeys(row.name for row in subject.rows)))
    made: list[Block] = [Heading("What is left free")]
    if numbers:
        made.append(Paragraph(["In letters this fills pages; here ", *listed(map(Sym, numbers)), " are numbers, in SI."]))
    if left.follow:
        made.append(Paragraph(f"To first order {names} make these follow:"))
    made += [
        Equation(Sym(letters[name].name), shown(add(*(mul(entry, x) for entry, x in zip(ways, free, strict=True)))))
        for name, ways in left.follow.items()
    ]
    if not free:
        return [*made, Paragraph("Nothing is left free to move.")]
    if left.reactions:
        undecided = len(left.reactions) > len(left.follow)
        made.append(Paragraph(f"The loads at rest{', of which some are not determined and taken to be 0' * undecided}:"))
    made += [Equation(x, shown(tree)) for x, tree in left.reactions.items()]
    made.append(
        Paragraph(["What they change by does no work there. What is left is M ẍ + C ẋ + K x = 0 of ", *listed(free), ", with"])
    )
    return made + _matrices(left.equations, letters)


def _place(subject: Subject, chosen: Given, near: bool) -> Words:
    said: list[str | Tree] = ["The nearest found: at rest with " if near else "At rest with "]
    for i, (name, tree) in enumerate(place_of(subject).items()):
        said += [", " * bool(i), Sym(name), " = ", shown(chosen.trees.get(name, tree))]
    return [*said, " everything stays at rest."]


def _matrix(letter: str, matrix: Matrix, names: Sequence[str], dots: int) -> Block:
    if all(is_zero(entry) for row in matrix for entry in row):
        return Paragraph(f"{letter} = 0.")
    if len(matrix) == 1:
        return Equation(Sym(letter), shown(matrix[0][0]))
    unknowns = [Sym(name, dots) for name in names]
    matrix = [list(map(shown, row)) for row in matrix]
    product = [add(*(mul(entry, x) for entry, x in zip(row, unknowns, strict=True) if not is_zero(entry))) for row in matrix]
    return MatrixEquation(matrix, unknowns, product, ["The product with ", letter])


def _character(subject: Subject, found: Linearised) -> list[Block]:
    made: list[Block] = []
    positive = [name for name, value in subject.values.items() if not name.dots and value > 0]
    names = [letter.name for letter in positive]
    try:
        matrix = found.first_order()
        polynomial = characteristic(matrix, subject.letters)
        made += [Heading("Eigenvalues"), Equation(shown(_powers(polynomial)), ZERO, "The characteristic equation")]
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
    real = [] if is_zero(value.real) and not is_zero(value.imaginary) else [shown(value.real)]
    imaginary = [] if is_zero(value.imaginary) else [*([" + "] if real else []), shown(value.imaginary), " i"]
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
    return made + [Bullets([[shown(condition), " > 0"] for condition in found.conditions])] * bool(
        found.conditions and not found.never
    )


def _verdict(found: Stability) -> str:
    kind = "Small departures die out" if found.kind == "decays" else "Small departures stay small and oscillate"
    if found.never:
        return f"{kind} for no values of the letters: it is unstable."
    return f"{kind} if" if found.conditions else f"{kind} for all values of the letters (those of the model being positive)."


def _numbers(subject: Subject, found: Linearised) -> list[Block]:
    m, c, k = (numbers(subject, matrix) for matrix in (found.mass, found.damping, found.stiffness))
    n = len(m)
    try:
        roots = np.linalg.eigvals(np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(m, k), -np.linalg.solve(m, c)]]))
    except np.linalg.LinAlgError:
        return []
    told = sorted({(round(float(r.real), 6), round(abs(float(r.imag)), 6)) for r in roots})
    said = [f"{a:.5g} 1/s" if not b else f"{a + 0.0:.5g} ± {b:.5g} i 1/s (period {2 * np.pi / b:.5g} s)" for a, b in told]
    return [Heading("In numbers"), Paragraph("With the parameters of the model the eigenvalues are"), Bullets(said)]

"""small perturbations from equilibrium: matrices, eigenvalues, when it is stable, frequencies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from freebody.core import CompiledModel, MotionError, State
from freebody.document.blocks import Block, Equation, Heading, Matrices, Paragraph, Side, Words, Written, listed
from freebody.document.blocks import Matrix as Rows
from freebody.document.document import Document
from freebody.equations.derivation.sentences import clause, joined
from freebody.equations.linearization import (
    Held,
    Linearised,
    Matrix,
    held,
    independent,
    is_natural,
    linearised,
    numbers,
    place_of,
)
from freebody.equations.modes import Root
from freebody.equations.solve import TooLarge
from freebody.equations.stability import Stability
from freebody.equations.substitutions import Substitutions, substitutions_of
from freebody.equations.topics.common import Asked, NotHere, document, own
from freebody.equations.topics.stability_text import character
from freebody.solve.instant import Instant
from freebody.solve.perturbed_states import Closing, nearby
from freebody.solve.symbolic_state import SymbolicState
from freebody.stability.equilibria import rest_near
from freebody.stability.state_space import state_space
from freebody.symbolic.decimals import shown
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import bold, dotted
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.tree import ZERO, Add, Sym, Tree, add, is_zero, mul, symbols

_BOLD = tuple(Written(sign, bold(symbol)) for sign, symbol in (("𝐌", "M"), ("𝐂", "C"), ("𝐊", "K")))
"""The matrices, apart from any symbols of a model."""
_VECTOR = tuple(Written(sign, dotted(bold("x"), dots)) for dots, sign in enumerate(("𝐱", "𝐱\u0307", "𝐱\u0308")))
"""The perturbations, their rates and accelerations."""
_AGREES = 1e-7
"""Part of the largest entry by which linear equations at a place that Newton's method found may differ from exact derivatives."""
_STANDS = 1e-9
"""Rate that is prescribed, over what it is at the usual rates of the mechanism, below which it is round-off of 0."""

_BESIDE, _NEARER, _SEED = 1e-5, 4.0, 5
"""Size of perturbations, rad and m and these a second, that are taken to both sides of an equilibrium; nearer by this factor."""
_ONE_SIDED = 1e-3
"""Part of the change of accelerations that those on both sides may leave together; where it is of curvature it falls with the size."""
_ROUND_OFF = 1e-10
"""Of accelerations, beside those that balance."""


@dataclass(frozen=True)
class LinearEquations(Document):
    """The document, with the ``equations`` of the perturbations that are left free at ``rest``, of which the others ``follow``; their
    ``eigenvalues`` in numbers, 1/s; and the ``stability`` of what is not free to stay, where it is known symbolically."""

    rest: State = field(kw_only=True)
    equations: Linearised = field(kw_only=True)
    follow: Mapping[str, Sequence[Tree]] = field(kw_only=True)
    eigenvalues: tuple[Root, ...] = field(kw_only=True)
    stability: Stability | None = field(kw_only=True)


def linear(asked: Asked, **at: Any) -> LinearEquations:
    """M ẍ + C ẋ + K x = 0 of small perturbations from an equilibrium, those that loops and contacts leave free, with the
    characteristic polynomial, eigenvalues, frequencies, and when it is stable.

    coordinates and parameters, ``theta=180 deg``; where these are no equilibrium, Newton's method looks for one from there.
    Raises ``NotHere`` where none is found."""
    mechanism, state = asked.mechanism, asked.state
    if states := mechanism.source().metadata["states"]:
        raise NotHere(
            f"the rate of {joined(states)} is not among the linear equations of the coordinates; "
            "`solve().derivatives(…)` gives exact derivatives by coordinates, rates and states in numbers"
        )
    chosen = substitutions_of(mechanism, at)
    first = chosen.start(mechanism, True, None) if at else replace(state, u=np.zeros_like(state.u))
    names = mechanism.source().coordinate_names
    others = {name: value for name, value in at.items() if name not in names}
    touching = (
        substitutions_of(mechanism, others).start(mechanism, True, None) if others else replace(state, u=np.zeros_like(state.u))
    )
    rest = _rest(mechanism.source(), first, touching)
    if rest is not first:
        places = place_of(Asked(mechanism, first).subject)
        chosen = replace(chosen, trees={name: tree for name, tree in chosen.trees.items() if name not in places})
    subject = SymbolicState(mechanism.source(), rest, at_rest=True)
    _require_regular(subject)
    made, found, follow = _perturbations(subject, chosen)
    _require_two_sided(subject, rest, found.coordinates, follow)
    _require_agreement(subject, found, follow)
    root = own(subject, "indeterminate", "1/s", "eigenvalue", "s", "lambda")
    said, stability, eigenvalues = character(subject, found, _symbols_of(subject), root) if found.coordinates else ([], None, ())
    where = [Heading("Equilibrium"), Paragraph(_place(subject, chosen, rest is not first))]
    title = "linear equations about an equilibrium"
    whole = document(subject, title, where + made + said, [root, *_symbols_of(subject).values()])
    return LinearEquations(
        whole.blocks, whole.letters, rest=rest, equations=found, follow=follow, eigenvalues=eigenvalues, stability=stability
    )


def _rest(source: CompiledModel, state: State, touching: State) -> State:
    """The state, or the place of rest that is found near it, where what is ``touching`` in another does so."""
    nonequilibrium = Instant(source, state).nonequilibrium()
    found = rest_near(source, state, touching) if nonequilibrium else state
    if found is None:
        stated = "; ".join(f"{name} {how}" for name, how in nonequilibrium.items())
        raise NotHere(
            f"this is no equilibrium: released there, {stated}; and none was found near by. "
            "Give coordinates near one, theta=0, or a parameter that holds it"
        )
    return found


def _require_regular(subject: SymbolicState) -> None:
    """Raises ``NotHere`` for what is closed without a load, for motions that are going on, and where loops hold less than beside it."""
    if subject.idle:
        raise NotHere(
            f"{joined(subject.idle)} {'are' if len(subject.idle) > 1 else 'is'} closed without a load in this equilibrium, so perturbations to one "
            "side meet resistance and others none, which no linear equations describe; open what is closed, or load it"
        )
    if free := [row.name for row in subject.rows if row.kind == "non-holonomic"]:
        raise NotHere(
            f"{clause(free, 'constrains', 'constrain')} rates only, so that every place beside this equilibrium can be one, too, "
            "and these equations would not show it"
        )
    for row, size in zip(subject.rows, subject.usual_rate * subject.free.row_sizes(subject.coordinates), strict=True):
        if row.rate is not None and abs(float(evaluate(row.rate, subject.values, subject.tables))) > _STANDS * size:
            raise NotHere(f"{row.name} prescribes a rate that is not 0, so nothing stays at rest; prescribe that it stands still")
    states = [free.rows for free in nearby(subject.source, subject.state) if free.rows]
    ranks = [len(independent(np.array([[row.coefficients[name] for name in subject.names] for row in rows]))) for rows in states]
    if ranks and ranks[0] < max(ranks):
        raise NotHere(
            "this configuration is singular: loops lose their independence, and linear equations do not describe what moves there; "
            "give a configuration beside it"
        )


def _require_two_sided(subject: SymbolicState, rest: State, free: Sequence[str], follow: Mapping[str, Sequence[Tree]]) -> None:
    """Raises ``NotHere`` where a small perturbation and the opposite one do not accelerate oppositely: something closed bears to one
    side only, or friction is at its limit. In numbers of the core."""
    source, names = subject.source, subject.names
    sizes = np.random.default_rng(_SEED).uniform(0.5, 1.0, len(free))
    followed = dict(zip(follow, numbers(subject, list(follow.values())) @ sizes if follow else [], strict=True))
    way = np.array([{**dict(zip(free, sizes, strict=True)), **followed}.get(name, 0.0) for name in names])
    closing, still = Closing(source, rest, source.free_bodies(rest)), source.instant(rest)

    def together(h: float) -> tuple[float, float]:
        """What accelerations to both sides leave together, and their largest change."""
        places = [q for sign in (1, -1) if (q := closing.place(rest.q + sign * h * way)) is not None]
        if len(places) < 2:
            return 0.0, 0.0
        beside = [replace(rest, q=q) for q in places] + [replace(rest, u=sign * h * way) for sign in (1, -1)]
        by_place, back, by_rate, slower = (source.instant(state).accelerations - still.accelerations for state in beside)
        change = max(*(np.abs(each).max(initial=0.0) for each in (by_place, back, by_rate, slower)), _ROUND_OFF * still.sizes[1])
        return max(np.abs(by_place + back).max(initial=0.0), np.abs(by_rate + slower).max(initial=0.0)), change

    try:
        (far, _), (near, change) = together(_BESIDE), together(_BESIDE / _NEARER)
    except MotionError as error:
        raise NotHere(f"beside this equilibrium there is no motion: {error}") from None
    if near > _ONE_SIDED * change and near > far / _NEARER**1.5:  # curvature falls by the square
        raise NotHere(
            "small perturbations to one side of this equilibrium accelerate otherwise than those to the other, since something is closed "
            "without a load or friction is at its limit, which no linear equations describe; give parameters or loads that decide it"
        )


def _require_agreement(subject: SymbolicState, found: Linearised, follow: Mapping[str, Sequence[Tree]]) -> None:
    """Holds the printed equations against the exact derivatives of the core's accelerations, which share nothing with them. Raises
    ``NotHere`` where they differ, or where there are none."""
    names, units = list(found.coordinates), dict(zip(subject.names, subject.free.units(subject.coordinates), strict=True))
    if not names:
        return
    try:
        true = state_space(subject.source, subject.state, free=sorted(names, key=subject.names.index))
    except ValueError as problem:
        raise NotHere(f"linear equations cannot be held against the accelerations beside this equilibrium: {problem}") from None
    n, order = len(names), [true.free.index(name) for name in names]
    columns, of = [*order, *(n + i for i in order)], np.array([units[name] for name in names])
    mass, damping, stiffness = (numbers(subject, matrix) for matrix in (found.mass, found.damping, found.stiffness))
    own = -np.linalg.solve(mass, np.hstack([stiffness, damping]))
    ways = numbers(subject, list(follow.values())).reshape(-1, n)
    core = true.places[[true.coordinates.index(name) for name in follow]][:, order]
    following = np.array([units[name] for name in follow])
    for printed, exact, rows, by in (own, true.a[n:][order][:, columns], of, np.tile(of, 2)), (ways, core, following, of):
        scaled = by / rows.reshape(-1, 1)
        if not np.abs((printed - exact) * scaled).max(initial=0.0) <= _AGREES * max(1.0, np.abs(exact * scaled).max(initial=0.0)):
            raise NotHere(
                "the linear equations that were derived do not agree with the accelerations of the mechanism beside this equilibrium, "
                "so they are not printed; `freebody.stability.state_space` gives them in numbers"
            )


def _perturbations(subject: SymbolicState, chosen: Substitutions) -> tuple[list[Block], Linearised, Mapping[str, Sequence[Tree]]]:
    """The linear equations, and those of what is left free, symbolically; where these are too long lengths and angles in numbers.
    With the latter, and how the others follow."""
    place = place_of(subject)
    put = {name: tree for name, tree in place.items() if is_natural(tree)} | chosen.settled()
    lengths = [name for name in subject.nomenclature.geometric() if name not in chosen.trees]
    in_numbers = subject.with_numbers([n for n in lengths if n not in place]), place | dict(chosen.trees)
    measured = False
    try:
        whole = linearised(subject, put)
    except TooLarge:
        (subject, put), measured = in_numbers, True
        whole = linearised(subject, put)
    entries = [
        *whole.left,
        *(entry for matrix in (whole.mass, whole.damping, whole.stiffness) for row in matrix for entry in row),
    ]
    if Sym("t") in symbols(*entries, *(row.acceleration for row in subject.rows)):
        raise NotHere("loads or motions depend on the time, so nothing stays at rest; give them values that do not")
    fills = Paragraph(["The symbolic form fills pages; here ", *listed(map(Sym, lengths)), " are numbers, in SI."])
    made = [fills] * measured + _equations(subject, whole)
    if not subject.rows:
        return made, whole, {}
    try:
        left = held(subject, whole, put)
    except TooLarge:
        if measured:
            raise
        subject, put = in_numbers
        left = held(subject, linearised(subject, put), put)
        heading, *rest = _left_free(subject, left)
        return [*made, heading, fills, *rest], left.equations, left.follow
    return made + _left_free(subject, left), left.equations, left.follow


def _symbols_of(subject: SymbolicState) -> dict[str, SymbolEntry]:
    """The symbols of perturbations by coordinate: ξ where the coordinates themselves are in the equations, for their places at rest."""
    coordinates = subject.coordinates
    if not subject.rows and all(map(is_natural, place_of(subject).values())):
        return {c["name"]: subject.nomenclature[c["name"]] for c in coordinates}
    stem = next(stem for stem in ("xi", "eta", "zeta") if not any(name.startswith(stem) for name in subject.nomenclature))
    names = [f"{stem}{i}" for i, _ in enumerate(coordinates, 1)] if len(coordinates) > 1 else [stem]
    pairs = zip(names, coordinates, strict=False)
    return {c["name"]: SymbolEntry(x, "coordinate", c["dimension"] or "", f"perturbation of {c['name']}") for x, c in pairs}


def _equations(subject: SymbolicState, found: Linearised) -> list[Block]:
    shifts = _symbols_of(subject)
    pairs = [(name, symbol.name) for name, symbol in shifts.items() if name != symbol.name]
    said: list[str | Side] = ["For small perturbations"]
    for i, (name, symbol) in enumerate(pairs):
        said += ["," * bool(i) + " ", Sym(symbol), " of ", Sym(name)]
    said.append(f"{'' if pairs else ' of the coordinates'} from there")
    right = "changes of the constraint loads, which are in 𝐊 as they are in equilibrium" if subject.rows else ""
    return [Heading("Linear equations"), *_stated(found, shifts, said, right)]


def _stated(found: Linearised, shifts: Mapping[str, SymbolEntry], said: Sequence[str | Side], right: str = "") -> list[Block]:
    """M ẍ + C ẋ + K x = 0 with its matrices; of one coordinate as one equation. ``right``: what stands there if not 0."""
    perturbations = [shifts[name].name for name in found.coordinates]
    parts = ((found.mass, 2), (found.damping, 1), (found.stiffness, 0))
    if len(perturbations) == 1 and not right:
        terms = (mul(shown(matrix[0][0]), Sym(perturbations[0], dots)) for matrix, dots in parts if not is_zero(matrix[0][0]))
        return [Equation(Add(tuple(terms)), ZERO, said)]
    whole = [_BOLD[0], " ", _VECTOR[2], " + ", _BOLD[1], " ", _VECTOR[1], " + ", _BOLD[2], " ", _VECTOR[0], " = ", right or "0"]
    where = [" with ", _VECTOR[0], " = (", *listed(map(Sym, perturbations)), ") and"]
    return [Paragraph([*said, " ", *whole, *where]), *(_matrix(n, m) for n, (m, _) in zip(_BOLD, parts, strict=True))]


def _left_free(subject: SymbolicState, left: Held) -> list[Block]:
    """How the other coordinates follow, and the equations of those that are free."""
    shifts = _symbols_of(subject)
    free = [Sym(shifts[name].name) for name in left.equations.coordinates]
    names = list(dict.fromkeys(row.name for row in subject.rows if row.name not in left.laws))
    made: list[Block] = [Heading("Independent perturbations")]
    if left.follow:
        made.append(Paragraph(f"To first order {clause(names, 'gives', 'give')} the others:"))
    made += [
        Equation(Sym(shifts[name].name), shown(add(*(mul(entry, x) for entry, x in zip(ways, free, strict=True)))))
        for name, ways in left.follow.items()
    ]
    if not free:
        return [*made, Paragraph("No perturbation is independent: nothing can move.")]
    if left.reactions:
        undecided = ", of which some are not determined and taken to be 0" * left.undecided
        made.append(Paragraph(f"The loads in equilibrium{undecided}:"))
    made += [Equation(x, shown(tree)) for x, tree in left.reactions.items()]
    last = f", the law of {joined(list(left.laws))} last," if left.laws else ""
    said = ["Their changes do no work in these perturbations. The equations of ", *listed(free), f"{last} are"]
    return made + _stated(left.equations, shifts, said)


def _place(subject: SymbolicState, chosen: Substitutions, near: bool) -> Words:
    said: list[str | Tree] = ["The nearest equilibrium found is at " if near else "The equilibrium is at "]
    for i, (name, tree) in enumerate(place_of(subject).items()):
        said += [", " * bool(i), Sym(name), " = ", shown(chosen.trees.get(name, tree))]
    return [*said, "."]


def _matrix(name: Written, matrix: Matrix) -> Block:
    if all(is_zero(entry) for row in matrix for entry in row):
        return Equation(name, ZERO)
    return Equation(name, Matrices((Rows([list(map(shown, row)) for row in matrix], name.text),)))

"""What becomes of small perturbations: eigenvalues, what drifts, dies out or oscillates, and when."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Side, Words, listed
from freebody.equations.linearization import Linearised, numbers
from freebody.equations.modes import Modes, first_order, modes
from freebody.equations.solve import Singular, TooLarge
from freebody.equations.stability import Eigenvalue, Stability, characteristic, eigenvalues, factors, stability
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.decimals import shown
from freebody.symbolic.letters import Letter
from freebody.symbolic.tree import ZERO, Add, Mul, Sym, Tree, is_zero, mul, negative, power

_POSITIVE = ("kg", "kg*m^2", "m", "N/m")
"""Units of masses, inertias, lengths and stiffnesses."""
_TAKEN = "Masses, inertias, lengths, stiffnesses and gravity are taken as positive."
Factors = list[tuple[list[Tree], int]]


def character(subject: SymbolicState, found: Linearised, letters: Mapping[str, Letter]) -> list[Block]:
    """Characteristic equation, eigenvalues and stability of linear equations, symbolically as far as they are short."""
    made: list[Block] = []
    positive = _positive(subject)
    try:
        matrix = found.first_order()
        parts = factors(characteristic(matrix, subject.letters), subject.letters)
        made += [
            Heading("Eigenvalues"),
            Equation(shown(_product(parts)), ZERO, ["The characteristic equation of the eigenvalues ", Sym("s")]),
        ]
        try:
            found_ones = eigenvalues(matrix, subject.letters, positive=positive)
            made += [Paragraph("The eigenvalues:"), Bullets(_paired(found_ones))]
        except TooLarge as error:
            made.append(Paragraph(f"{str(error).capitalize()}."))
        made += _stability(parts, subject, found, letters, positive)
    except (TooLarge, Singular) as error:
        made.append(Paragraph(f"No more is given symbolically: {error}."))
    return made + _numbers(subject, found)


def _positive(subject: SymbolicState) -> list[str]:
    """Masses, inertias, lengths, stiffnesses and gravity: the only symbols that are taken as positive, where they are so. Gains,
    dampings and the rest may have any sign, whatever they are in the model."""
    spec, letters = subject.source.spec, subject.letters
    read_as = (str([spec["gravity"], *(force["with"].get("stiffness", "") for force in spec["forces"])]), "g")
    named = {word for text in read_as for word in re.findall(r"[^\W\d]\w*", text)}
    return [
        name
        for name in letters.of_kind("parameter", "constant")
        if (letters[name].unit in _POSITIVE or name in named) and subject.values[Sym(name)] > 0
    ]


def _product(parts: Factors) -> Tree:
    """The factors as a person writes them, powers of s falling."""
    made = []
    for coefficients, count in parts:
        terms = [mul(factor, power(Sym("s"), n)) for n, factor in enumerate(coefficients[::-1]) if not is_zero(factor)][::-1]
        spread = [part for term in terms for part in (term.terms if isinstance(term, Add) else (term,))]
        made.append(power(spread[0] if len(spread) == 1 else Add(tuple(spread)), count))
    return made[0] if len(made) == 1 else Mul(tuple(made))


def _paired(found: Sequence[Eigenvalue]) -> list[Words]:
    """Those that differ in a sign only as one line, with ±."""
    left, made = list(found), list[Words]()
    while left:
        value = left.pop()
        for part, other in (("imaginary", "real"), ("real", "imaginary")):
            size, same = getattr(value, part), getattr(value, other)
            twins = (v for v in left if equal(getattr(v, part), negative(size)) and equal(getattr(v, other), same))
            if not is_zero(size) and (twin := next(twins, None)):
                left.remove(twin)
                made.append(_stated(value, "± ", part))
                break
        else:
            made.append(_stated(value))
    return made[::-1]


def _stated(value: Eigenvalue, sign: str = "", signed: str = "") -> Words:
    """``signed`` names the part that has both signs."""
    real: list[str | Side] = [] if is_zero(value.real) and not is_zero(value.imaginary) else [shown(value.real)]
    imaginary: list[str | Side] = [] if is_zero(value.imaginary) else [shown(value.imaginary), " i"]
    between = (" " * bool(real) + sign) if signed == "imaginary" else " + " if real and imaginary else ""
    return [sign if signed == "real" else "", *real, between, *imaginary, f", {value.count} times" * (value.count > 1)]


def _stability(
    parts: Factors, subject: SymbolicState, found: Linearised, letters: Mapping[str, Letter], positive: Sequence[str]
) -> list[Block]:
    near = modes(subject, found)
    stated = [stability(p, subject.letters, positive=positive, symmetric=near.symmetric) for p, _ in parts if not is_zero(p[-1])]
    made: list[Block] = [Heading("Stability"), *_free(near, letters)]
    if not stated:
        return made
    if near.grows and not any(each.never for each in stated):
        return [
            *made,
            Paragraph("A repeated eigenvalue has one eigenvector only, so perturbations grow with time: it is unstable."),
        ]
    conditions = list(dict.fromkeys(c for each in stated for c in each.conditions))
    never = any(each.never for each in stated)
    moving = listed(Sym(letters[name].name) for name in near.moving)
    made.append(Paragraph(_verdict(stated, bool(near.free), bool(conditions), never, moving)))
    made += [Bullets([[shown(condition), " > 0"] for condition in conditions])] * bool(conditions and not never)
    return [*made, Paragraph(_TAKEN)]


def _free(near: Modes, letters: Mapping[str, Letter]) -> list[Block]:
    """What nothing brings back."""
    made: list[Block] = []
    if near.drifting:
        drifts = "they drift" if len(near.drifting) > 1 else "it drifts"
        names = listed(Sym(letters[name].name) for name in near.drifting)
        made.append(Paragraph(["No load restores ", *names, f": at any small constant speed {drifts} away."]))
    if rest := [name for name in near.free if name not in near.drifting]:
        names = listed(Sym(letters[name].name) for name in rest)
        made.append(Paragraph(["No load restores ", *names, ": a small perturbation stays as it is."]))
    return made


def _verdict(stated: Sequence[Stability], free: bool, conditions: bool, never: bool, moving: Sequence[str | Side]) -> Words:
    kinds = {each.kind for each in stated}
    what: list[str | Side] = ["Apart from that, small perturbations of ", *moving] if free else ["Small perturbations"]
    if never:
        return [*what, " grow, whatever the values of the symbols: it is unstable."]
    does = {"decays": "decay", "oscillates": "stay small and oscillate"}.get(*kinds) if len(kinds) == 1 else None
    does = does or "stay small: some decay, others oscillate"
    return [*what, f" {does}{' if' if conditions else ' for all values of the symbols.'}"]


def _numbers(subject: SymbolicState, found: Linearised) -> list[Block]:
    try:
        roots = np.linalg.eigvals(first_order(*(numbers(subject, part) for part in (found.mass, found.damping, found.stiffness))))
    except np.linalg.LinAlgError:
        return []
    said = []
    for real, imaginary in sorted({(round(float(r.real), 6), round(abs(float(r.imag)), 6)) for r in roots}):
        front = f"{real:.5g} ".replace("-", "−") if real or not imaginary else ""
        period = f"± {imaginary:.5g} i 1/s (period {2 * np.pi / imaginary:.5g} s)" if imaginary else "1/s"
        said.append(front + period)
    return [Heading("In numbers"), Paragraph("With the parameters of the model the eigenvalues are"), Bullets(said)]

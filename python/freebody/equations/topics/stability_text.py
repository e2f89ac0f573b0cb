"""What becomes of small perturbations: eigenvalues, what drifts, dies out or oscillates, and when."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import numpy as np

from freebody.document.blocks import Block, Bullets, Equation, Heading, Paragraph, Side, Words, listed
from freebody.equations.linearization import Linearised, numbers
from freebody.equations.modes import Modes, Root, first_order, modes, roots
from freebody.equations.solve import Singular, TooLarge, Unconfirmed
from freebody.equations.stability import Eigenvalue, Stability, characteristic, eigenvalues, factors, require_few, stability
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.algebra import equal
from freebody.symbolic.decimals import shown
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.tree import ZERO, Add, Mul, Sym, Tree, is_zero, mul, negative, power

_POSITIVE = ("kg", "kg*m^2", "m")
"""Units of masses, inertias and lengths, where bodies, joints and places have them."""
_SHAPES = ("bodies", "joints", "points", "lines", "curves", "contacts", "strings", "stops")
"""Parts of a model in which a number is no gain; in laws of forces and motions it may be one, whatever its unit is."""
_TAKEN = "Masses, inertias, lengths, stiffnesses and gravity are taken as positive."
Factors = list[tuple[list[Tree], int]]


def character(
    subject: SymbolicState, found: Linearised, shifts: Mapping[str, SymbolEntry], root: SymbolEntry
) -> tuple[list[Block], Stability | None, tuple[Root, ...]]:
    """Characteristic equation, with ``root`` for an eigenvalue, eigenvalues and stability of linear equations, symbolically as far as
    they are short; with the stability, where it is known, and the eigenvalues in numbers."""
    made: list[Block] = []
    stable: Stability | None = None
    positive, s = _positive(subject), Sym(root.name)
    try:
        require_few(2 * len(found.coordinates))
        matrix = found.first_order()
        parts = factors(characteristic(matrix, subject.nomenclature), subject.nomenclature)
        made += [
            Heading("Eigenvalues"),
            Equation(shown(_product(parts, s)), ZERO, ["The characteristic equation of the eigenvalues ", s]),
        ]
        try:
            found_ones = eigenvalues(matrix, subject.nomenclature, positive=positive)
            made += [Paragraph("The eigenvalues:"), Bullets(_paired(found_ones))]
        except TooLarge as error:
            made.append(Paragraph(f"{str(error).capitalize()}."))
        stable, said = _stability(parts, subject, found, shifts, positive)
        made += said
    except (TooLarge, Singular, Unconfirmed) as error:
        made.append(Paragraph(f"No more is given symbolically: {error}."))
    try:
        values = roots(first_order(*(numbers(subject, part) for part in (found.mass, found.damping, found.stiffness))))
    except np.linalg.LinAlgError:
        values = ()
    return made + _numbers(values), stable, values


def _positive(subject: SymbolicState) -> list[str]:
    """Masses, inertias, lengths, stiffnesses and gravity: the only symbols that are taken as positive, where they are so. Gains,
    dampings and the rest may have any sign, whatever they are in the model."""
    spec, nomenclature = subject.source.spec, subject.nomenclature
    lengths = [force["with"].get("rest_length", "") for force in spec["forces"]]
    shapes = [lengths, *(spec[word] for word in _SHAPES), *(each["value"] for each in spec["parameters"])]
    read, fallen = (set(re.findall(r"[^\W\d]\w*", str(each))) for each in (shapes, spec["gravity"]))
    loads = fallen | {str(force["with"].get("stiffness")) for force in spec["forces"]}

    def is_positive(name: str) -> bool:
        unit, own = nomenclature[name].unit, nomenclature[name].kind == "constant"  # of the model's numbers without a name
        is_size = unit in _POSITIVE and (own or name in read)
        return (is_size or name in loads or (own and unit == "m/s^2")) and subject.values[Sym(name)] > 0

    return list(filter(is_positive, nomenclature.of_kind("parameter", "constant")))


def _product(parts: Factors, s: Sym) -> Tree:
    """The factors as a person writes them, powers of s falling."""
    made = []
    for coefficients, count in parts:
        terms = [mul(factor, power(s, n)) for n, factor in enumerate(coefficients[::-1]) if not is_zero(factor)][::-1]
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
    parts: Factors, subject: SymbolicState, found: Linearised, shifts: Mapping[str, SymbolEntry], positive: Sequence[str]
) -> tuple[Stability, list[Block]]:
    near = modes(subject, found)
    stated = [
        stability(p, subject.nomenclature, positive=positive, symmetric=near.symmetric) for p, _ in parts if not is_zero(p[-1])
    ]
    made: list[Block] = [Heading("Stability"), *_free(near, shifts)]
    conditions = tuple(dict.fromkeys(c for each in stated for c in each.conditions))
    kinds, never = {each.kind for each in stated}, any(each.never for each in stated)
    whole = Stability(" and ".join(sorted(kinds)), conditions, never or near.grows)
    if not stated:
        return whole, made
    if near.grows and not never:
        lacking = "A repeated eigenvalue has one eigenvector only, so perturbations grow with time: it is unstable."
        return whole, [*made, Paragraph(lacking)]
    moving = listed(Sym(shifts[name].name) for name in near.moving)
    made.append(Paragraph(_verdict(whole, bool(near.free), moving)))
    made += [Bullets([[shown(condition), " > 0"] for condition in conditions])] * bool(conditions and not never)
    return whole, [*made, Paragraph(_TAKEN)]


def _free(near: Modes, shifts: Mapping[str, SymbolEntry]) -> list[Block]:
    """What nothing brings back."""
    made: list[Block] = []
    if near.drifting:
        drifts = "they drift" if len(near.drifting) > 1 else "it drifts"
        names = listed(Sym(shifts[name].name) for name in near.drifting)
        made.append(Paragraph(["No load restores ", *names, f": at any small constant speed {drifts} away."]))
    if rest := [name for name in near.free if name not in near.drifting]:
        names = listed(Sym(shifts[name].name) for name in rest)
        made.append(Paragraph(["No load restores ", *names, ": a small perturbation stays as it is."]))
    return made


def _verdict(stable: Stability, free: bool, moving: Sequence[str | Side]) -> Words:
    what: list[str | Side] = ["Apart from that, small perturbations of ", *moving] if free else ["Small perturbations"]
    if stable.never:
        return [*what, " grow, whatever the values of the symbols: it is unstable."]
    does = {"decays": "decay", "oscillates": "stay small and oscillate"}.get(
        stable.kind, "stay small: some decay, others oscillate"
    )
    return [*what, f" {does}{' if' if stable.conditions else ' for all values of the symbols.'}"]


def _numbers(values: Sequence[Root]) -> list[Block]:
    said = []
    for root in values:
        real, imaginary = root.value.real, root.value.imag
        if imaginary >= 0:
            front = f"{real:.5g} ".replace("-", "−") if real or not imaginary else ""
            period = f"± {imaginary:.5g} i 1/s (period {2 * np.pi / imaginary:.5g} s)" if imaginary else "1/s"
            said.append(front + period + f", {root.count} times" * (root.count > 1))
    data = [{"real": root.value.real, "imaginary": root.value.imag, "count": root.count} for root in values]
    named = Paragraph("With the parameters of the model the eigenvalues are")
    return [Heading("In numbers"), named, Bullets(said, data)] if values else []

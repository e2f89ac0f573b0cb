"""What stays constant, and why: energy, momentum along a direction, angular momentum about a point."""

from __future__ import annotations

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.equations.derivation import momenta
from freebody.equations.derivation.sentences import clause, joined
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.formula import Script, typed, word
from freebody.symbolic.tree import Sym, Tree, add, read, symbols


def section(subject: SymbolicState, in_letters: bool = True) -> list[Block]:
    """Every quantity that stays constant, with its reason, or why none does; ``in_letters``: and what it is in the coordinates."""
    kinetic, potential, why = energy(subject)
    reason = (
        f"not conserved: {why}."
        if why
        else "conserved: all forces have potentials, and the reactions of joints and contacts do no work."
    )
    made: list[Block] = [Heading("Conserved quantities")]
    if in_letters:
        left, right = energies(subject)
        made += [Equation(left, kinetic, "The kinetic and the potential energy"), Equation(right, potential)]
    lead = "Their sum" if in_letters else "The sum of kinetic and potential energy"
    return [*made, Paragraph(f"{lead} is {reason}"), *momenta.section(subject, in_letters)]


def energy(subject: SymbolicState) -> tuple[Tree, Tree, str]:
    """Kinetic and potential energy, and why their sum is not constant (empty if it is)."""
    [stated] = subject.ask([{"ask": "energy"}])
    kinetic, potential = read(stated["kinetic"]), read(stated["potential"])
    loads, laws, why = subject.free.loads, {letter.name for letter, _ in subject.laws}, []
    if names := stated["without_potential"]:
        why.append(f"{clause(names, 'does', 'do')} work that has no potential")
    if motions := list(dict.fromkeys(load.name for load in loads if load.kind == "motion")):
        why.append(f"the motion of {joined(motions)} is prescribed, which takes work")
    if rough := list(dict.fromkeys(load.name for load in loads if load.follows or load.symbol in laws)):
        why.append(f"{clause(rough, 'has', 'have')} friction")
    if Sym("t") in symbols(kinetic, potential):
        why.append("the potential depends on time")
    return kinetic, potential, "; ".join(why)


def energies(subject: SymbolicState) -> tuple[Written, Written]:
    """How the kinetic and the potential energy are written."""
    names = (subject.symbols.quantity(f"E_{kind[0]}", f"{kind} energy") for kind in ("kinetic", "potential"))
    kinetic, potential = (
        Written(x.unicode(), (Script(typed("E"), word(x.below[0])),) if x.stem == "E" and len(x.below) == 1 else x.formula())
        for x in names  # what is below E is the beginning of a word, which is upright
    )
    return kinetic, potential


def total(subject: SymbolicState) -> Tree | None:
    """The energy, where it is conserved."""
    kinetic, potential, why = energy(subject)
    return None if why else add(kinetic, potential)

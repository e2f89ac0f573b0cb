"""What stays constant, and why: energy, momentum along a direction, angular momentum about a point."""

from __future__ import annotations

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Written
from freebody.equations.derivation import momenta
from freebody.equations.derivation.data import SymbolicState
from freebody.equations.derivation.meaning import joined
from freebody.symbolic.formula import Script, typed, word
from freebody.symbolic.symbols import Name
from freebody.symbolic.tree import Sym, Tree, add, read, symbols

_CONSERVED = "Their sum is conserved: all forces have potentials, and the reactions of joints and contacts do no work."


def section(subject: SymbolicState, in_letters: bool = True) -> list[Block]:
    """Every quantity that stays constant, with its reason, or why none does; ``in_letters``: and what it is in the coordinates."""
    made: list[Block] = [Heading("Conserved quantities"), *(_energy(subject) if in_letters else _energy_words(subject))]
    return made + momenta.section(subject, in_letters)


def energy(subject: SymbolicState) -> tuple[Tree, Tree, str]:
    """Kinetic and potential energy, and why their sum is not constant (empty if it is)."""
    stated = subject.ask([{"ask": "energy"}])[0]
    kinetic, potential = read(stated["kinetic"]), read(stated["potential"])
    return kinetic, potential, _losses(subject, stated["without_potential"], symbols(kinetic, potential))


def energies(subject: SymbolicState) -> tuple[Written, Written]:
    """How the kinetic and the potential energy are written."""
    kinetic, potential = (subject.symbols.quantity(f"E_{word[0]}", f"{word} energy") for word in ("kinetic", "potential"))
    return _energy_name(kinetic), _energy_name(potential)


def _energy_name(name: Name) -> Written:
    """What is below E is the beginning of a word, which is upright."""
    usual = name.stem == "E" and len(name.below) == 1
    return Written(name.unicode(), (Script(typed("E"), word(name.below[0])),) if usual else name.formula())


def _losses(subject: SymbolicState, without: list[str], letters: set[Sym]) -> str:
    motions = [load.name for load in subject.free.loads if load.kind == "motion"]
    laws = {letter.name for letter, _ in subject.laws}
    has_friction = list(dict.fromkeys(load.name for load in subject.free.loads if load.follows or load.symbol in laws))
    why = [f"{joined(names)} {'does' if len(names) == 1 else 'do'} work that has no potential" for names in [without] if names]
    why += [f"the motion of {joined(list(dict.fromkeys(motions)))} is prescribed, which takes work"] if motions else []
    why += [f"{joined(has_friction)} {'has' if len(has_friction) == 1 else 'have'} friction"] if has_friction else []
    why += ["the potential depends on time"] if Sym("t") in letters else []
    return "; ".join(why)


def _energy(subject: SymbolicState) -> list[Block]:
    kinetic, potential, why = energy(subject)
    left, right = energies(subject)
    made: list[Block] = [Equation(left, kinetic, "The kinetic and the potential energy"), Equation(right, potential)]
    if why:
        return [*made, Paragraph(f"Their sum is not conserved: {why}.")]
    return [*made, Paragraph(_CONSERVED)]


def _energy_words(subject: SymbolicState) -> list[Block]:
    *_, why = energy(subject)
    said = (
        f"is not conserved: {why}."
        if why
        else "is conserved: all forces have potentials, and the reactions of joints and contacts do no work."
    )
    return [Paragraph(f"The sum of kinetic and potential energy {said}")]


def total(subject: SymbolicState) -> Tree | None:
    """The energy, where it is conserved."""
    kinetic, potential, why = energy(subject)
    return None if why else add(kinetic, potential)

"""What stays constant, and why: energy, momentum along a direction, angular momentum about a point."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from freebody.equations.derivation.meaning import joined
from freebody.equations.derivation.told import Balance, Subject
from freebody.equations.document import Block, Equation, Heading, Paragraph, Written
from freebody.equations.names import upright
from freebody.equations.tree import Sym, Tree, add, is_zero, read, symbols
from freebody.free_body import GROUND, Pair

_ABSENT = 1e-9
"""A part in a balance, in N or N·m, below which it may vanish identically."""
_KINETIC, _POTENTIAL = Written("E_k", r"E_\mathrm{k}"), Written("E_p", r"E_\mathrm{p}")

_CONSERVED = "Their sum is conserved: all forces have potentials, and what joints and contacts exert does no work."


def section(subject: Subject, in_letters: bool = True) -> list[Block]:
    """Every quantity that stays constant, with its reason, or why none does; ``in_letters``: and what it is in the coordinates."""
    made: list[Block] = [Heading("Conserved quantities"), *(_energy(subject) if in_letters else _energy_words(subject))]
    found = [block for block in _momenta(subject) if in_letters or isinstance(block, Paragraph)]
    return made + (
        found or [Paragraph("No momentum of the whole is conserved along x, along y, or about a point named on the ground.")]
    )


def energy(subject: Subject) -> tuple[Tree, Tree, str]:
    """Kinetic and potential energy, and why their sum is not constant (empty if it is)."""
    told = subject.ask([{"ask": "energy"}])[0]
    kinetic, potential = read(told["kinetic"]), read(told["potential"])
    return kinetic, potential, _losses(subject, told["without_potential"], symbols(kinetic, potential))


def _losses(subject: Subject, without: list[str], letters: set[Sym]) -> str:
    motions = [load.name for load in subject.free.loads if load.kind == "motion"]
    rubs = [load.name for load in subject.free.loads if load.follows or load.component == "friction force"]
    why = [f"{joined(names)} {'does' if len(names) == 1 else 'do'} work that no potential has" for names in [without] if names]
    why += [f"the motion of {joined(list(dict.fromkeys(motions)))} is prescribed, which takes work"] if motions else []
    why += [f"{joined(list(dict.fromkeys(rubs)))} rubs"] if rubs else []
    why += ["the potential depends on time"] if Sym("t") in letters else []
    return "; ".join(why)


def _energy(subject: Subject) -> list[Block]:
    kinetic, potential, why = energy(subject)
    made: list[Block] = [Equation(_KINETIC, kinetic, "The kinetic and the potential energy"), Equation(_POTENTIAL, potential)]
    if why:
        return [*made, Paragraph(f"Their sum is not conserved: {why}.")]
    return [*made, Paragraph(_CONSERVED)]


def _energy_words(subject: Subject) -> list[Block]:
    *_, why = energy(subject)
    said = (
        f"is not conserved: {why}."
        if why
        else "is conserved: all forces have potentials, and what joints and contacts exert does no work."
    )
    return [Paragraph(f"The sum of kinetic and potential energy {said}")]


def _momenta(subject: Subject) -> list[Block]:
    group, g = list(subject.free.bodies), subject.free.centre(*subject.free.bodies)
    found = [({"along": axis}, f"along {axis}", _vanishing(subject, group, (0.0, 0.0), place)) for place, axis in enumerate("xy")]
    found += [
        ({"about": {"point": name}}, f"about {name}", _vanishing(subject, group, (x, y), 2))
        for name, x, y in _fixed_points(subject)
    ]
    found.append(({"about": "centre"}, "about the mass centre of the whole", _vanishing(subject, group, g, 2)))
    asked = [(question, where) for question, where, likely in found if likely]
    balances = subject.balances([{"ask": "equation", "bodies": [], **question} for question, _ in asked])
    made: list[Block] = []
    for balance, (question, where) in zip(balances, asked, strict=True):
        if is_zero(balance.left) and not is_zero(balance.momentum):
            made += _constant(balance, where, _letter(question))
    return made


def _vanishing(subject: Subject, group: list[str], about: Pair, place: int) -> bool:
    """Whether, at this state, no load from outside has a part in a balance: else there is no need to look at it in letters."""
    loads = subject.free.on(*group)
    known = sum((load.unit(group, about)[place] for load in loads if not load.unknown), 0.0)
    return max(abs(v) for v in [known, *(load.unit(group, about)[place] for load in loads if load.unknown)]) < _ABSENT


def _fixed_points(subject: Subject) -> list[tuple[str, float, float]]:
    points = subject.points.items()
    return [(name, x, y) for name, (body, x, y) in points if body == GROUND and not name.endswith(".origin")]


def _letter(question: Mapping[str, Any]) -> Written:
    """``L_x``, ``H/ground.O``, about the mass centre of the whole ``H/G``."""
    if axis := question.get("along"):
        return Written(f"L_{axis}", f"L_{axis}")
    point = question["about"]["point"] if question["about"] != "centre" else "G"
    return Written(f"H/{point}", rf"H_{{/{upright(point)}}}")


def _constant(balance: Balance, where: str, letter: Written) -> list[Block]:
    if balance.turns:
        why = f"The angular momentum {where} is conserved: nothing from outside has a moment about that point."
    else:
        why = f"The momentum {where} is conserved: nothing from outside acts on the whole in that direction."
    return [Paragraph(why), Equation(letter, balance.momentum)]


def total(subject: Subject) -> Tree | None:
    """The energy, where it is conserved."""
    kinetic, potential, why = energy(subject)
    return None if why else add(kinetic, potential)

"""Coordinates eliminated by conserved momenta: fewer equations in fewer coordinates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from freebody.document.blocks import Block, Equation, Heading, Paragraph, Words, listed
from freebody.document.document import Document
from freebody.equations.derivation import conserved
from freebody.equations.solve import solve_equations
from freebody.equations.topics.common import Asked, NotHere, brief, document, own
from freebody.equations.topics.lagrange import equations
from freebody.solve.symbolic_state import SymbolicState
from freebody.symbolic.differentiate import along_motion
from freebody.symbolic.linear import linear_in
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.symbols import unicode_name
from freebody.symbolic.to_sympy import from_sympy, sympy, to_sympy
from freebody.symbolic.tree import ZERO, Sym, Tree, add, is_zero, mul, replace, symbols


@dataclass(frozen=True)
class Eliminated:
    """``momenta[c]`` is conserved for each coordinate c that only its rate matters of; ``constants[c]`` is its symbol; ``rates`` these
    rates by the others and the constants; ``equations`` of the other coordinates, which vanish; ``energy`` in them, where it is conserved."""

    momenta: Mapping[str, Tree]
    constants: Mapping[str, SymbolEntry]
    rates: Mapping[Sym, Tree]
    equations: Mapping[str, Tree]
    energy: Tree | None


def eliminated(subject: SymbolicState) -> Eliminated:
    """What is left when conserved momenta are used. Raises ``NotHere`` where no momentum of a coordinate is conserved, ``TooLarge``."""
    if subject.rows:
        raise NotHere("the coordinates depend on each other, so no momentum is that of one alone")
    kinetic, potential, found = equations(subject)
    where = symbols(kinetic, potential)
    free = [x for x in found if is_zero(x.force) and not is_zero(x.momentum) and Sym("t") not in where]
    gone = [x for x in free if Sym(x.coordinate) not in where]
    if not gone:
        raise NotHere("no momentum of a coordinate is conserved: every coordinate itself stands in the energies, or is driven")
    constants = {
        each.coordinate: own(
            subject, "constant", "", f"conserved momentum of {unicode_name(each.coordinate)}", f"p_{each.coordinate}"
        )
        for each in gone
    }
    rates = solve_equations(
        [(each.momentum, Sym(constants[each.coordinate].name)) for each in gone],
        [Sym(name, 1) for name in constants],
        subject.nomenclature,
    )
    kept = [each for each in found if each not in gone]
    others = [name for name in subject.names if name not in constants]
    second = {Sym(x.name, 2): along_motion(tree, others) for x, tree in rates.items()}
    left = {each.coordinate: _bare(subject, _put(subject, each.residual, rates, second)) for each in kept}
    total = conserved.total(subject)
    energy = None if total is None else _put(subject, total, rates, {})
    return Eliminated({each.coordinate: each.momentum for each in gone}, constants, rates, left, energy)


def elimination(asked: Asked) -> Document:
    """Coordinates of which only the rates matter, eliminated by their conserved momenta; often one equation is left."""
    subject = asked.subject
    found = eliminated(subject)
    names = list(found.momenta)
    why = " stand in no energy, only their rates, and no force without a potential works on them. So the momenta are constant:"
    if len(names) == 1:
        why = " stands in no energy, only its rate, and no force without a potential works on it. So its momentum "
        why += "∂E_k/∂q̇ is constant:"
    made: list[Block] = [Heading("Conserved"), Paragraph([*listed(map(Sym, names)), why])]
    made += [Equation(Sym(found.constants[name].name), momentum) for name, momentum in found.momenta.items()]
    made += [Heading("Rates by the conserved quantities")]
    made += [Equation(x, tree) for x, tree in found.rates.items()]
    left: Words = "Nothing: the rates above are the whole motion."
    if found.equations:
        count = "one equation" if len(found.equations) == 1 else f"{len(found.equations)} equations"
        said = f"With these rates, and their derivatives, Lagrange's equations of the other coordinates are {count} in "
        left = [said, *listed(map(Sym, found.equations)), " alone:"]
    made += [Heading("What is left"), Paragraph(left)]
    made += [Equation(tree, ZERO, ["For ", Sym(name)]) for name, tree in found.equations.items()]
    energy = own(subject, "constant", "J", "energy", "E", "energy")
    if found.energy is not None:
        made.append(Equation(Sym(energy.name), found.energy, "Its first integral, the energy, which is constant"))
    return document(subject, "elimination by what is conserved", made, [*found.constants.values(), energy])


def _put(subject: SymbolicState, tree: Tree, first: Mapping[Sym, Tree], second: Mapping[Sym, Tree]) -> Tree:
    for new in (second, first):
        tree = from_sympy(to_sympy(replace(tree, new)))
    return brief(tree, subject.nomenclature)


def _bare(subject: SymbolicState, tree: Tree) -> Tree:
    """What vanishes if the tree does, without factors of parameters and what stands below; accelerations with one factor each."""
    if is_zero(tree):
        return tree
    fixed = set(subject.nomenclature.of_kind("parameter", "constant"))
    above, _ = sympy.fraction(sympy.cancel(sympy.together(to_sympy(tree))))
    factors = sympy.factor_list(above)[1]
    kept = sympy.Mul(*(factor**n for factor, n in factors if not {str(x) for x in factor.free_symbols} <= fixed))
    moving = [Sym(name, 2) for name in subject.names]
    parts = linear_in(from_sympy(sympy.expand(kept)), moving)
    terms = [mul(brief(factor, subject.nomenclature), x) for x, factor in parts.coefficients.items()]
    return add(*terms, brief(parts.rest, subject.nomenclature))

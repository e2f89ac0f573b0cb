"""Why what stood in an equation is wrong, in a sentence."""

from __future__ import annotations

from freebody.symbolic.dimensions import ENERGY, FORCE, INERTIA, LENGTH, MASS, PER_SECOND, SPEED
from freebody.symbolic.tree import Add, Mul, Node, Num, Pow, Quotient, Sym, walk

from .edits import Edit
from .language.dimensions import dimension
from .language.statements import Equation, symbols_in
from .vocabulary import Vocabulary


def why(edit: Edit, equation: Equation, vocabulary: Vocabulary) -> str:
    """What is wrong with what stood there, in a sentence."""
    part = edit.new if edit.new is not None else edit.old
    if edit.kind in ("missing term", "extra term") and part is not None:
        verb = "is left out" if edit.kind == "missing term" else "has no place here, or is counted twice"
        return f"{_what(part, equation, vocabulary)} {verb}"
    if edit.kind == "convention" and edit.words.endswith("sense"):
        return "it acts, or counts, in the other sense, wherever it stands"
    if edit.kind == "convention" and "relative" in edit.words:
        return "a motion relative to a body that moves is not that seen from what is at rest"
    if edit.kind == "symbol" and isinstance(edit.new, Sym) and edit.new.dots == 1:
        return "one rate stands for another: that of the body for the relative one, or the other way round"
    if edit.kind == "factor" and edit.old is not None and sum(n.dots == 1 for n in symbols_in(_term(edit.old, equation))) > 1:
        return "the Coriolis part of an acceleration is twice the product of the two rates"
    if edit.kind in ("factor", "sign", "symbol") and is_constraint(equation, vocabulary):
        return "the constraint between these motions is another: count what moves along, and differentiate it term by term"
    if edit.kind == "factor" and (isinstance(edit.new, Add) or _is_of_inertia(edit.old, equation, vocabulary)):
        return "the moment of inertia is about another point: I about P is I_G + m d²"
    return _WHY.get(edit.kind, "")


_WHY = {
    "convention": "two things stand for each other throughout",
    "exchange": "two letters stand for each other: each force has an arm, and each motion a radius, of its own",
    "extension": "a spring stores energy by its extension, not by its length",
    "squares": "the speed is another: its square is the sum of those of two components at right angles, seen from what is at rest",
    "sign": "it acts, or counts, in the other sense",
    "function": "the component along the other direction is meant: sine and cosine are exchanged",
    "factor": "a number is wrong or forgotten: ½, 2, or one of an inertia or of a rotation that was left out",
    "ratio": "the ratio is upside down: what turns or moves faster has the smaller radius or arm",
    "upside down": "it is divided by what it should be multiplied by, or the other way round: a component is no longer than the whole",
    "ratio once": "the ratio counts twice: once for the motion and once for the force or moment, or squared with the rate",
    "symbol": "another quantity belongs here",
    "derivative": "the order of the derivative is another",
    "rates": "two rates are multiplied, or one is squared",
    "angle": "the angle is measured from elsewhere, or is that between others",
    "power": "the power is another: a centripetal term goes with the square of the rate, a moment of inertia with that of the distance",
    "root": "it is the root of this, or its square: what is squared in an energy is not yet so",
    "resultant": "components add up as vectors do: the size of what two at right angles make together is the root of the sum of their squares",
    "way": "it does not stay so on the way: what acts there does work, by which the square of the speed changes",
    "share": "it is only a share that counts: one part of all that moves or turns, or of what works through another",
    "missing factor": "a factor is forgotten: dimensions or an arm tell which",
    "extra factor": "a factor is one too many: dimensions tell which",
    "inverses": "the inverse of a sum is not the sum of the inverses: springs, masses or inertias count otherwise together",
    "brackets": "what stands behind a fraction is not below it",
    "unit vector": "a vector and a number cannot be equal: a direction is missing",
    "components": "the components along the direction of the balance are meant: project each force on it",
    "momentum": "an impact takes energy: it is momentum that it keeps, or that about a point through which all its impulses go",
    "other term": "this part is no balance of what acts and moves",
}


_OF_MOTION = ("a momentum, of a rotation or of another body,", "a kinetic energy, of a rotation or of another body,")


def _what(term: Node, equation: Equation, vocabulary: Vocabulary) -> str:
    """What a term is, in a balance or in an energy."""

    def order(symbol: Sym) -> int:
        """Of which derivative a symbol is, as its dimension says."""
        its = vocabulary.dimension(symbol)
        known = its is not None and its.mass == 0 and its.length in (0, 1) and symbol not in vocabulary.parameters
        return -its.time if known else symbol.dots if its is None else 0

    found = symbols_in(term)
    if any(n.dots == 1 and vocabulary.dimension(Sym(n.name)) == INERTIA for n in found):
        return "the change of the inertia with the motion"
    rates = [n for n in found if order(n) == 1]
    squared = any(isinstance(n, Pow) and n.exponent == Num(2.0, "2") and n.base in rates for n in walk(term))
    others = (n for n in symbols_in(equation) if n not in vocabulary.parameters and n not in vocabulary.energies)
    loads = (n for n in others if vocabulary.dimension(n) in (FORCE, ENERGY))
    balance = any(loads) or any(order(n) == 2 for n in symbols_in(equation))
    its = dimension(term, vocabulary.dimensions)
    if its == LENGTH:
        return "a part of an arm"
    if its in (SPEED, PER_SECOND):
        return "a part of the speed"
    if its == MASS.times(LENGTH, 1):
        return "a mass times its arm"
    if its is not None and its.time == 0 and its.length in (0, 2):
        return "a part of the inertia, of what turns as well or m d² of a parallel axis,"
    turns = any(vocabulary.dimension(n) == INERTIA for n in found)
    if turns and (any(order(n) == 2 for n in found) or (rates and its is not None and not its.mass)):
        return "the inertia of what turns as well"
    if any(order(n) == 2 for n in found):
        if its == ENERGY:
            return "r × m a of a point that accelerates, or of what moves as well,"
        return "a mass times its acceleration" if its is None or its.mass else "a part of the acceleration"
    if rates and not balance:
        energy = len(rates) > 1 or squared if its is None else its.time == -2
        return _OF_MOTION[energy] if its is None or its.mass else "a part of the motion"
    if squared:
        return "the centripetal part of the acceleration"
    if len(rates) > 1:
        return "the Coriolis part of the acceleration"
    if any(n.name in ("g", "gravity") for n in found):
        return "a weight, or its moment or energy,"
    return "a force or a moment" if balance else "this part"


def is_constraint(equation: Equation, vocabulary: Vocabulary) -> bool:
    """Whether an equation speaks of lengths and motions alone."""
    found = [vocabulary.dimension(n) for n in symbols_in(equation)]
    return all(its is not None and its.mass == 0 for its in found) and not any(
        n.name in ("g", "gravity") for n in symbols_in(equation)
    )


def _term(part: Node, equation: Equation) -> Node:
    """The least product in which a part stands; itself, where it stands in none."""
    products = [n for n in walk(equation) if isinstance(n, Mul) and any(each is part for each in walk(n))]
    return min(products, key=lambda n: sum(1 for _ in walk(n)), default=part)


def _is_of_inertia(old: Node | None, equation: Equation, vocabulary: Vocabulary) -> bool:
    """Whether a number stands in a term with the second derivative of an angle."""
    products = (n for n in walk(equation) if isinstance(n, Mul | Quotient) and any(part is old for part in walk(n)))
    return any(n.dots == 2 and Sym(n.name) in vocabulary.angular for product in products for n in symbols_in(product))

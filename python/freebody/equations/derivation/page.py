"""The page of a book: coordinates, accelerations, then for each balance its free body, what acts = what is moved, the scalar equation."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial

from freebody.document.blocks import Block, Equation, Figure, Heading, Paragraph, Vector, Words, Written, is_tree, listed, pieces
from freebody.document.drawings import ConfigurationDrawing, FreeBodyDrawing
from freebody.equations.balances.reasons import agree
from freebody.equations.derivation import loop_closure, preamble
from freebody.equations.derivation.balance_text import Stated, cancelling, dropped, numbers
from freebody.equations.derivation.plain_rows import on_two_sides
from freebody.equations.derivation.put_in import Closed
from freebody.equations.derivation.sentences import joined, signs
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.symbolic.algebra import less, opposite, quotient, signed
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import EQUALS, PLUS, Atom, typed
from freebody.symbolic.nomenclature import Nomenclature
from freebody.symbolic.presentation import presented
from freebody.symbolic.symbols import direction
from freebody.symbolic.tree import ONE, ZERO, Add, Pow, Sym, Tree, add, is_zero, mul, power, walk

_TURNS = ", counter-clockwise"
_SIGNS = {
    **{sign: Atom(sign, "bold") for sign in "rFa"}, **{sign: Atom(sign, kind) for sign, kind in (("(", "open"), (")", "close"))},
    "+": PLUS, "=": EQUALS, "×": Atom("×", "sign"), "Σ": Atom("∑", "sign"),
}  # fmt: skip
"""How the signs of a law are set in type; the others are letters."""
OF_A_PAGE = 250
"""Symbols, numbers and operations of an expression beyond which it does not stand on a page."""
_LONG = 1000
"""As many in both sides of a balance before it is written in a person's form, beyond which that is not done."""
_NONE = 1e-6
_AXIS = re.compile(r" along [xy](?= of )")
_BRIEFLY = tuple(
    (re.compile(long), short)
    for long, short in (
        (r"^(it|they) (is|are|acts|act) ", r"{} \2 "),
        (r"^(its|their) (lines?) of action ", r"the \2 of {} "),
        (r"^(its|their) sums? with (its|their) friction ", r"{} with \2 friction "),
        (r" internal to .*| a couple, which.*|couples, which.*", lambda found: found[0].split(" to ")[0].split(",")[0]),
    )
)
"""What a reason for an absence is in half a sentence."""


def beginning(subject: SymbolicState, known: Nomenclature, used: Collection[str], own: bool) -> list[Block]:
    """What the coordinates measure, where they are those of the model, what is given and what else is unknown; the sketch; what is not
    called by its usual name."""
    shown = [symbol for symbol in known.values() if symbol.name in used]
    given = [[Sym(x.name), f" ({x.doc})" * bool(x.doc)] for x in shown if x.kind in ("parameter", "constant")]
    loads: dict[str, list[Sym]] = {}
    for x in (x for x in shown if x.kind == "unknown"):
        loads.setdefault(_AXIS.sub("", x.doc.removesuffix(f" ({x.name})")), []).append(Sym(x.name))
    forces = [[*listed(names, " and "), f", {doc}"] for doc, names in loads.items()]
    said = [_coordinates(subject)] if own else []
    said += [["Given: ", *_listed(given, ", "), "."]] * bool(given)
    said += [["Unknown besides: ", *_listed(forces, "; "), "."]] * bool(forces)
    made: list[Block] = [Paragraph(_listed(said, " "))] if said else []
    if own:
        made += [Figure(ConfigurationDrawing(subject.source, subject.state), name="sketch"), *preamble.notes(subject)]
    return made + [Paragraph(" ".join(map(str, known.renamed.values())))] * bool(known.renamed)


def _coordinates(subject: SymbolicState) -> Words:
    if not subject.coordinates:
        return "The mechanism cannot move: there are no coordinates."
    meanings = [preamble.meaning(subject, c) for c in subject.coordinates]
    said: list[Words] = []
    for name, what in zip(subject.names, meanings, strict=True):
        if what.startswith("y of ") and said and said[-1][1:] == [f": x{what[1:]}"]:
            said[-1] = [*said[-1][:1], " and ", Sym(name), f": place{what[1:]}"]
        else:
            said.append([Sym(name), f": {what.removesuffix(_TURNS)}"])
    return [*_listed(said, "; "), f".{' Angles are counter-clockwise.' * any(what.endswith(_TURNS) for what in meanings)}"]


def kinematics(subject: SymbolicState, closed: Closed) -> list[Block]:
    """The unit directions in a sentence, and the acceleration of every mass centre that has one."""
    named = preamble.directions(subject, [motion.a for motion in subject.motions])
    moving = [motion for motion in subject.motions if not (is_zero(motion.mass) or all(map(is_zero, motion.a.xy)))]
    said = [[Written(pair.along, direction(pair.along)), " at ", pair.angle_along] for pair in named.pairs]
    name: Words = "Accelerations of the mass centres"
    if said:
        pairs = [("λ", "n")] * any(not pair.radius for pair in named.pairs)
        pairs += [(pair.along, pair.across) for pair in named.pairs if pair.radius]
        turned = [_turned(named.axes[2], *pair) for pair in pairs]
        start = Written(named.axes[0], direction(named.axes[0]))
        name = ["Accelerations, in unit directions ", *_listed(said, ", "), " from ", start, " and ", *listed(turned, " and ")]
    made: list[Block] = []
    for motion in moving:
        left = Written.of(subject.symbols.of_body("a", motion.body), bold=True)
        parts = ((signed(closed.put(tree), subject.constants), unit) for tree, unit in named.vector(motion.a).components)
        made.append(Equation(left, Vector(tuple(parts)), "" if made else name))
    return made


def _turned(axis: str, along: str, across: str) -> Written:
    """One direction as another that is turned by a right angle: n = k × λ."""
    return Written(
        f"{across} = {axis} × {along}", (*direction(across), *typed("="), *direction(axis), *typed("×"), *direction(along))
    )


def closure(subject: SymbolicState, closed: Closed) -> list[Block]:
    """What is closed or prescribed: the places, the velocities, the accelerations; first what roots are called."""
    if not closed.rows:
        return []
    made = roots(closed)
    for left, right in (pair for level in on_two_sides(closed.rows, subject.names) for pair in level):
        made.append(Equation(signed(left, subject.constants), signed(right, subject.constants) if is_tree(right) else right))
    return [Heading(loop_closure.title(subject.rows), 3), *made]


def roots(closed: Closed) -> list[Block]:
    """What the roots are that have symbols."""
    return [Equation(Sym(entry.name), power(base, "1/2")) for entry, base in closed.named]


def balances(subject: SymbolicState, stated: Sequence[Stated], closed: Closed) -> list[Block]:
    """Each balance: its free body, what does not enter, what acts = what is moved, part by part, and the scalar equation; of one that
    stands alone also the acceleration."""
    made: list[Block] = []
    shown: set[tuple[str, ...]] = set()
    for each in stated:
        bodies, raw = each.balance.bodies, (each.balance.right, each.balance.left)
        made.append(Heading(each.title, 3))
        if bodies not in shown:
            shown.add(bodies)
            made.append(free_body(subject, bodies, len(shown)))
        if signs(raw) > _LONG:  # no page has it, in whatever form
            made.append(Equation(*raw, [_absent(subject, each), *_law(each, len(bodies), len(bodies))], each.label))
        else:
            made += _balance(subject, *closed.reduced(each), closed)
    if len(stated) == 1 and isinstance(whole := made[-1], Equation):
        made += closed.result(whole)
    return made


def _balance(subject: SymbolicState, each: Stated, known: Sequence[Sym], closed: Closed) -> list[Block]:
    """What does not enter, what acts = what is moved, part by part, and the scalar equation."""
    short = signs(each.sides) <= OF_A_PAGE
    acting, carried, turned = _parts(subject, each, closed, closed.put_in if known else closed.put) if short else (ZERO, [], [])
    bodies = len(each.balance.bodies)
    name = [_absent(subject, each), *_law(each, *((len(carried), len(turned)) if short else (bodies, bodies)))]
    name += [", times ", each.factor] if each.factor != ONE else []
    name += [", with ", *listed(known, " and "), " as above"] if known else []
    whole = Equation(*closed.alone(*each.sides), name, each.label)
    split = (*carried, *turned)
    if is_zero(acting) or len(split) < 2 or not _below(acting, *split) <= _below(*each.sides):
        return [whole]
    return [Equation(acting, Add(split), name), replace(whole, name="")]


def free_body(subject: SymbolicState, bodies: Sequence[str], number: int) -> Figure:
    """What acts on some bodies, and m a and I α beside it; the figures are numbered."""
    return Figure(FreeBodyDrawing(subject.source, subject.state, bodies, subject.given), name=f"free-body-{number}")


def _parts(
    subject: SymbolicState, stated: Stated, closed: Closed, follow: Callable[[Tree], Tree]
) -> tuple[Tree, list[Tree], list[Tree]]:
    """The sum of what acts, and m a, or r × m a and I α, of each body, in the sense of the scalar equation; ``follow`` puts in what is
    closed."""
    given, cancelled, put = stated.balance, cancelling(subject, stated.balance), opposite if stated.turned else lambda tree: tree
    shown = partial(signed, constants=subject.constants)
    motions = subject.motions if given.turns else ()
    turning = {motion.body: follow(quotient(mul(motion.inertia, motion.alpha), ONE)) for motion in motions}
    apart = _is_plain(subject, given, closed.values)
    own = {body: turning.get(body, ZERO) if apart else ZERO for body, _ in given.inertia}
    carried = (tree if is_zero(own[body]) else less(tree, own[body]) for body, tree in given.inertia)
    acting = (presented(c.tree) for c in given.contributions if not c.absent and c.load not in cancelled)
    moved = ([shown(put(presented(tree))) for tree in trees if not is_zero(tree)] for trees in (carried, own.values()))
    return shown(add(*map(put, acting))), *moved


def _below(*trees: Tree) -> set[Tree]:
    """What stands below a line: of a body of two parts, their mass, which is not in the sum of its parts."""
    return {part.base for tree in trees for part in walk(tree) if isinstance(part, Pow) and part.exponent < 0}


def _is_plain(subject: SymbolicState, balance: Balance, values: Mapping[Sym, float]) -> bool:
    """Whether moments are not taken times a factor, as about where two lines meet they are times the sine of the angle between."""
    at = numbers(subject, balance)
    for each in balance.contributions:
        load = subject.free.loads[each.load]
        arm = load.unit(balance.bodies, at)[2] * load.value
        if not each.absent and abs(arm) > _NONE:
            return abs(evaluate(each.tree, values, subject.tables) / arm - 1) < _NONE
    return True


def _law(stated: Stated, carried: int, turned: int) -> list[str | Written]:
    """The law in symbols, for as many bodies as are ``carried`` along and ``turned``, and its sense."""
    each = "Σ " * (max(carried, turned) > 1)
    if not stated.balance.turns:
        return [_formula(f"Σ F = {each}m a"), ", positive against that direction" * stated.turned]
    parts = ["r × m a"] * (carried > 0) + ["I α"] * (turned > 0)
    inertia = f"Σ ({' + '.join(parts)})" if each and len(parts) > 1 else each + " + ".join(parts) or "0"
    return [_formula(f"Σ r × F = {inertia}"), ", clockwise" * stated.turned]


def _formula(law: str) -> Written:
    return Written(law, tuple(_SIGNS.get(sign) or Atom(sign) for sign in law if sign != " "))


def _absent(subject: SymbolicState, stated: Stated) -> str:
    """What is not in a balance, in half a sentence: ``A_x and A_y act at A.``"""
    said = []
    for why, loads in dropped(subject, stated).items():
        names = [f"the friction of {x.name}" if x.follows else x.symbol for x in loads]
        what, who = agree(why, len(names)), joined(names)
        for long, short in _BRIEFLY:
            what = long.sub(short, what)
        said.append(what.format(who))
    sentence = f"{'; '.join(said)}. " if said else ""
    return f"The{sentence[3:]}" if sentence.startswith("the ") else sentence


def _listed(parts: Sequence[Words], between: str) -> list:
    return [piece for i, part in enumerate(parts) for piece in ([between] if i else []) + pieces(part)]

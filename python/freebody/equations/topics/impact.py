"""A blow: impulses on each body, which are absent and why, impulse–momentum equations, restitution, rates after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from freebody.balances.reasons import agree
from freebody.equations.answers import AGREES, with_positive_divisors
from freebody.equations.collect import collected, without_circles
from freebody.equations.derivation.balancing import Stated, dropped
from freebody.equations.derivation.meaning import joined, load_words
from freebody.equations.derivation.told import Balance
from freebody.equations.document import Block, Bullets, Document, Equation, Figure, Heading, Paragraph, Words
from freebody.equations.letters import Letter, Letters
from freebody.equations.solve import Singular, TooLarge, linear_system, solve
from freebody.equations.topics.blow import Blow, after, blow, impulse
from freebody.equations.topics.common import document, moving_names
from freebody.equations.tree import Num, Sym, Tree, evaluate, is_zero, minus, operations, replace, symbols
from freebody.free_body import Load

if TYPE_CHECKING:
    from freebody.instant import State
    from freebody.model.builder import Builder

_Sides: TypeAlias = tuple[Tree, Tree]
_DEPENDS = 1e-9
"""Below it a row adds nothing to others."""
MOST_OPERATIONS = 300
"""Operations in all equations above which they are not solved in letters."""


def impact(
    mechanism: Builder, state: State | None = None, *, number: int | str = 1, of: str | None = None, at: str | float | None = None
) -> Document:
    """The blow of a ``number`` (from 1) in the run of a model: a contact, a string that becomes taut, a stop, what catches; ``of``
    counts only those of one of these by name, ``at`` only those from a time on. The run tells where it is, so ``state`` is not
    asked for. Raises ``NotHere`` where there is none."""
    found = blow(mechanism, int(number), of, at)
    made = [*_what(found), *_equations(found), *_restitution(found), *_answers(found), *_numbers(found)]
    title = f"blow at {joined(list(found.change.of))}" if found.change.of else "blow of what catches"
    return document(found.subject, title, made, _letters(found))


def rates_after(found: Blow) -> dict[Sym, Tree]:
    """Rates after the blow and impulses of what acts, in letters, with what is 0 at the blow left out. Raises ``TooLarge``,
    ``Singular``; ``ArithmeticError`` where they are not those of the run."""
    equations = [(found.acting(each.balance), found.jump(each.balance)) for each in found.of_coordinates()]
    conditions = [(left, right) for _, left, right in found.conditions()]
    if not all(_holds(found, *sides) for sides in conditions):
        raise ArithmeticError(_otherwise(found))
    equations += conditions
    equations = [(replace(left, found.zeros), replace(right, found.zeros)) for left, right in equations]
    equations = [sides for sides in equations if symbols(*sides)]  # 0 = 0 is held whatever happens
    there = set().union(*(symbols(*sides) for sides in equations))
    wanted = [Sym(after(name), 1) for name in moving_names(found.subject)]
    wanted += [x for x in found.impulses.values() if x in there]
    if len(wanted) != len(equations):
        raise TooLarge(f"{len(equations)} equations for {len(wanted)} unknowns: more is held than it takes")
    solved = _solved(found, equations, wanted)
    _check(found, solved)
    return {x: solved[x] for x in wanted}


def impulses_of_joints(found: Blow, solved: Mapping[Sym, Tree]) -> dict[Sym, Tree]:
    """The impulses that the balances of the coordinates do not have, those of tree joints, from the balances of single bodies and
    what is ``solved`` already. Raises as ``rates_after``."""
    sizes = found.sizes()
    wanted = [x for x in found.impulses.values() if x not in solved]
    balances = [(found.acting(each.balance), found.jump(each.balance)) for each in found.of_bodies()]
    balances = [(replace(left, found.zeros), replace(right, found.zeros)) for left, right in balances]
    if any(np.isnan(sizes[x]) for x in wanted):
        raise Singular("the impulses in the joints are not determined: more is held than it takes")
    equations = _enough(found, balances, wanted)
    return _solved(found, [(replace(left, solved), replace(right, solved)) for left, right in equations], wanted)


def _enough(found: Blow, equations: Sequence[_Sides], wanted: Sequence[Sym]) -> list[_Sides]:
    """The first equations that together give what is wanted, at the numbers of the blow."""
    values = _values(found)
    rates = {Sym(after(name), 1): u for name, u in (found.change.after.u if found.change.after else {}).items()}
    chosen: list[_Sides] = []
    rows: list[list[float]] = []
    for left, right in equations:
        row = [float(evaluate(minus(replace(left, {x: Num(1)}), replace(left, {x: Num(0)})), values | rates | found.sizes()))
               for x in wanted]  # fmt: skip
        if np.linalg.matrix_rank([*rows, row], tol=_DEPENDS) > len(rows):
            rows.append(row)
            chosen.append((left, right))
    return chosen


def _solved(found: Blow, equations: Sequence[_Sides], wanted: Sequence[Sym]) -> dict[Sym, Tree]:
    """First each equation that has only one unknown left, then the rest together."""
    for k, sides in enumerate(equations):
        unknown = [x for x in wanted if x in symbols(*sides)]
        if len(unknown) == 1 < len(wanted):
            first = _together(found, [sides], unknown)
            rest = [(replace(left, first), replace(right, first)) for left, right in (*equations[:k], *equations[k + 1 :])]
            return first | _solved(found, rest, [x for x in wanted if x not in first])
    return _together(found, equations, wanted) if wanted else {}


def _together(found: Blow, equations: Sequence[_Sides], wanted: Sequence[Sym]) -> dict[Sym, Tree]:
    if (size := sum(operations(side) for pair in equations for side in pair)) > MOST_OPERATIONS:
        raise TooLarge(f"{len(wanted)} equations with {size} operations are too long for an answer in letters")
    letters = Letters({**found.subject.letters.table, **{x.name: x for x in _letters(found)}})
    solution = solve(*linear_system(equations, wanted), letters)
    values = _values(found)
    return {x: with_positive_divisors(tree, values) for x, tree in zip(wanted, solution, strict=True)}


def _what(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("Impulses on each body")]
    made.append(
        Paragraph("In the short time of the blow nothing moves, but rates jump. Impulses are the integrals of forces over it.")
    )
    for body in found.subject.free.bodies:
        loads = [load for load in found.subject.blow.acting if any(part.body == body for part in load.on)]
        items: list[Words] = [[Sym(impulse(load)), f", of the {_plain(_on(load, body))}"] for load in loads]
        made += [Paragraph(f"On {body}:"), Bullets(items or ["no impulse"])]
    from freebody.views.diagram.impulses import Impulses

    missing = found.subject.blow.absent()
    made.append(
        Figure(
            Impulses(f"blow of {found.subject.source.name}", found.subject.blow),
            "Impulses, and the jumps of momentum.",
            "impulses",
        )
    )
    return [*made, Paragraph("Absent:"), Bullets(missing)] if missing else made


def _plain(words: str) -> str:
    return words.removeprefix("the ")


def _equations(found: Blow) -> list[Block]:
    free = found.conserved()
    made: list[Block] = [Heading("Impulse and momentum")]
    if free:
        made.append(
            Paragraph(
                "No impulse has a part in these, in the configuration of the blow, so the momenta are the same before and after:"
            )
        )
        made += [Equation(found.after(b.momentum), b.momentum, _title(title)) for title, b in free]
    made.append(Paragraph("With the impulses in them, one for each coordinate, impulse = momentum after − momentum before:"))
    of_coordinates = found.of_coordinates()
    made += [_with_impulses(found, each) for each in of_coordinates]
    return made + _of_bodies(found, [each.balance for each in of_coordinates])


def _of_bodies(found: Blow, balances: Sequence[Balance]) -> list[Block]:
    """The balances of the bodies on which impulses act that other balances do not have."""
    free, there = found.subject.free, {c.load for b in balances for c in b.contributions if not c.absent}
    kept_out = {load.symbol for i, load in enumerate(free.loads) if load in found.forces and i not in there}
    bodies = [body for body in free.bodies if any(load.symbol in kept_out for load in free.on(body))]
    if not bodies:
        return []
    words = Paragraph(f"Of {joined(bodies)} alone, on which impulses of joints act that are not in those:")
    return [words, *(_with_impulses(found, each) for each in found.of_bodies() if each.balance.bodies[0] in bodies)]


def _with_impulses(found: Blow, each: Stated) -> Equation:
    unknown = [Sym(after(name), 1) for name in moving_names(found.subject)]
    left = collected(found.acting(each.balance), list(found.impulses.values()))
    return Equation(left, collected(found.jump(each.balance), unknown), _title(each.title), note=_left_out(found, each))


def _left_out(found: Blow, each: Stated) -> Words:
    """Which impulses on the bodies are not in an equation, and why."""
    said: list[str | Sym] = []
    for why, loads in dropped(found.subject, each).items():
        letters = [Sym(impulse(load)) for load in loads]
        said += ["; " if said else "Not in it: ", letters[0], *(x for letter in letters[1:] for x in (", ", letter))]
        said.append(f" ({agree(why, len(loads))})")
    return [*said, "."] if said else ""


def _title(title: str) -> str:
    """Of a balance of impulses: ``angular impulse about …``."""
    return title.replace("AMB", "Angular impulse and momentum").replace("LMB", "Impulse and momentum")


def _restitution(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("Restitution, and what holds")]
    for name, left, right in found.conditions():
        if not symbols(left, right):
            continue  # the mechanism holds it by itself
        if not _holds(found, left, right):
            made.append(Paragraph(f"At {name}: {_otherwise(found)}."))
            continue
        struck = found.change.impulses is not None and name in found.change.impulses.restitution
        back = f"{name} throws back" if not is_zero(right) else f"at {name} nothing comes back" if struck else f"{name} holds"
        made.append(Equation(left, right, back))
    return made + _friction(found)


def _friction(found: Blow) -> list[Block]:
    """What friction does: of what slides its law, of what sticks that it could."""
    made: list[Block] = []
    sizes = found.sizes()
    for load in found.slides:
        note = "Coulomb's law, integrated over the blow: friction has all the impulse that it can, against the sliding."
        law = found.law(load)
        made.append(Equation(Sym(impulse(load)), law, f"{load.name} slides throughout the blow", note=note))
    stuck = all(_holds(found, left, right) for _, left, right in found.conditions())
    for normal, load in pairwise(found.forces):  # friction stands behind its normal force
        if load.kind == "friction" and stuck:
            n, f = Sym(impulse(normal)), Sym(impulse(load))
            words = f"{load.name} does not slide any more after the blow, for friction can give what that takes: "
            made.append(Paragraph([words, f, f" is {abs(sizes[f] / sizes[n]):.3g} of ", n, "."]))
    return made


def _answers(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("After the blow")]
    try:
        solved = rates_after(found)
        made += _given(found) + [Equation(x, without_circles(tree)) for x, tree in solved.items()]
        joints = impulses_of_joints(found, solved)
    except (TooLarge, Singular, ArithmeticError) as error:
        return [*made, Paragraph(f"In letters no more is said: {error}.")]
    told = [(x, without_circles(tree)) for x, tree in joints.items()]
    return made + [Equation(x, tree, "and in the joints" if i == 0 else "") for i, (x, tree) in enumerate(told)]


def _given(found: Blow) -> list[Block]:
    said: list[str | Sym] = [piece for x in found.zeros for piece in (x, " = ")]
    return [Paragraph(["At this blow ", *said, "0, so that"])] if said else []


def _numbers(found: Blow) -> list[Block]:
    change = found.change
    rows: list[Words] = [
        [Sym(name, 1), f": {change.before.u[name]:.6g} before, {change.after.u[name]:.6g} after"] for name in change.after.u
    ]
    impulses: list[Words] = [
        [x, " is not determined: more is held than it takes" if np.isnan(size) else f" = {size:.6g}"]
        for x, size in found.sizes().items()
    ]
    lost = Paragraph(f"The blow takes {change.lost:.6g} J." + f" {change.note}" * bool(change.note))
    return [
        Heading("In the run"),
        Paragraph(f"At t = {change.t:.6g} s, rates in m/s or rad/s:"), Bullets(rows),
        Paragraph("Impulses in N·s, of couples in N·m·s:"), Bullets(impulses), lost,
    ]  # fmt: skip


def _on(load: Load, body: str) -> str:
    """A pair of equal pushes or pulls is told as that on the body, what has a sign as it is counted."""
    return load_words(load, [body] if load.kind in ("contact", "string") else ())


def _letters(found: Blow) -> Sequence[Letter]:
    known = found.subject.letters
    made = [
        Letter(after(name), "coordinate", known[name].unit, f"{name}, rate after the blow")
        for name in moving_names(found.subject)
    ]
    written = found.written
    made += [
        Letter(impulse(load), "unknown", "N*s", f"impulse of the {_plain(load_words(load))}", written[load.symbol])
        for load in found.subject.blow.acting
    ]
    own = [(name, e) for name, e in found.coefficients.items() if e.name not in known]
    return made + [Letter(e.name, "parameter", "", f"restitution at {name}") for name, e in own]


def _values(found: Blow) -> dict[Sym, float]:
    return found.subject.values | {e: found.restitution[name] for name, e in found.coefficients.items()}


def _holds(found: Blow, left: Tree, right: Tree) -> bool:
    """Whether two sides are the same in the run, to the rounding of its rates."""
    after_it = {Sym(after(name), 1): u for name, u in found.change.after.u.items()}
    one, other = (float(evaluate(side, _values(found) | after_it, found.subject.tables)) for side in (left, right))
    return abs(one - other) <= 10 * AGREES * _fastest(found)


def _fastest(found: Blow) -> float:
    rates = (*found.change.after.u.values(), *found.change.before.u.values())
    return max((abs(u) for u in rates), default=1.0) or 1.0


def _check(found: Blow, solved: dict[Sym, Tree]) -> None:
    values = _values(found)
    for name, true in found.change.after.u.items():
        if abs(float(evaluate(solved[Sym(after(name), 1)], values)) - true) > 10 * AGREES * _fastest(found):
            raise ArithmeticError(_otherwise(found))


def _otherwise(found: Blow) -> str:
    """Why a blow is not what its equations say."""
    if any(load.kind == "friction" for load in found.forces):
        return (
            "what slides reverses or stops sliding during the blow, so that friction has neither all the impulse that it can, "
            "nor what it takes to stick; that is decided stage by stage, see the run"
        )
    return f"the run takes another law of impact. {found.change.note}".strip()

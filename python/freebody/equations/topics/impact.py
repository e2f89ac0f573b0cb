"""A blow: impulses on each body, which are absent and why, impulse–momentum equations, restitution, rates after."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from freebody.equations.answers import AGREES, with_positive_divisors
from freebody.equations.collect import collected
from freebody.equations.derivation.meaning import joined, load_words
from freebody.equations.derivation.told import Balance
from freebody.equations.document import Block, Bullets, Document, Equation, Heading, Paragraph, Words
from freebody.equations.letters import Letter, Letters
from freebody.equations.solve import Singular, TooLarge, linear_system, solve
from freebody.equations.topics.blow import Blow, after, blow, coefficient, impulse
from freebody.equations.topics.common import document, moving_names
from freebody.equations.tree import Sym, Tree, evaluate, is_zero, operations, replace, symbols

if TYPE_CHECKING:
    from freebody.instant import State
    from freebody.model.builder import Builder

MOST_OPERATIONS = 300
"""Operations in all equations above which they are not solved in letters."""


def impact(mechanism: Builder, state: State | None = None, *, number: int | str = 1) -> Document:
    """The blow of a ``number`` (from 1) in the run of a model: a contact, a string that becomes taut, what catches. The run tells
    where it is, so ``state`` is not asked for. Raises ``NotHere`` where there is none."""
    found = blow(mechanism, int(number))
    made = [*_what(found), *_equations(found), *_restitution(found), *_answers(found), *_numbers(found)]
    return document(found.subject, f"blow at {joined(list(found.change.of))}", made, _letters(found))


def rates_after(found: Blow) -> dict[Sym, Tree]:
    """Rates after the blow and impulses of what acts, in letters, with what is 0 at the blow left out. Raises ``TooLarge``, ``Singular``, ``ArithmeticError`` where they
    are not those of the run."""
    equations = [(found.acting(b), found.jump(b)) for _, b in found.of_coordinates()]
    equations += [(left, right) for _, left, right in found.conditions()]
    equations = [(replace(left, found.zeros), replace(right, found.zeros)) for left, right in equations]
    wanted = [Sym(after(name), 1) for name in moving_names(found.subject)]
    there = set().union(*(symbols(*pair) for pair in equations))
    wanted += [x for x in found.impulses.values() if x in there]
    if len(wanted) != len(equations):
        raise TooLarge(f"{len(equations)} equations for {len(wanted)} unknowns: friction or redundant holds need more than these")
    if (size := sum(operations(side) for pair in equations for side in pair)) > MOST_OPERATIONS:
        raise TooLarge(f"{len(wanted)} equations with {size} operations are too long for an answer in letters")
    letters = Letters({**found.subject.letters.table, **{x.name: x for x in _letters(found)}})
    solution = solve(*linear_system(equations, wanted), letters)
    values = _values(found)
    solved = {x: with_positive_divisors(tree, values) for x, tree in zip(wanted, solution, strict=True)}
    _check(found, solved)
    return solved


def _what(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("Impulses on each body")]
    made.append(
        Paragraph("In the short time of the blow nothing moves, but rates jump. Impulses are the integrals of forces over it.")
    )
    for body in found.subject.free.bodies:
        loads = [load for load in found.forces if any(part.body == body for part in load.on)]
        items: list[Words] = [[Sym(impulse(load)), f", of the {_plain(load_words(load))}"] for load in loads]
        made += [Paragraph(f"On {body}:"), Bullets(items or ["no impulse"])]
    finite = [load_words(load) for load in found.finite]
    if finite:
        made.append(
            Paragraph(f"Absent: {'; '.join(finite)}. They stay finite, so their impulses in a time that goes to 0 are 0.")
        )
    return made


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
    return made + [_with_impulses(found, title, b) for title, b in found.of_coordinates()]


def _with_impulses(found: Blow, title: str, balance: Balance) -> Equation:
    loads = found.subject.free.loads
    absent = [impulse(loads[c.load]) for c in balance.contributions if c.absent and loads[c.load] in found.forces]
    unknown = [Sym(after(name), 1) for name in moving_names(found.subject)]
    note = f"Not in it: {joined(absent)}." if absent else ""
    return Equation(collected(found.acting(balance), list(found.impulses.values())), collected(found.jump(balance), unknown),
                    _title(title), note=note)  # fmt: skip


def _title(title: str) -> str:
    """Of a balance of impulses: ``angular impulse about …``."""
    return title.replace("AMB", "Angular impulse and momentum").replace("LMB", "Impulse and momentum")


def _restitution(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("Restitution, and what holds")]
    for name, left, right in found.conditions():
        why = (
            f"{name} throws back"
            if not is_zero(right)
            else f"at {name} nothing comes back"
            if name in found.change.of
            else f"{name} holds"
        )
        made.append(Equation(left, right, why))
    return made


def _answers(found: Blow) -> list[Block]:
    made: list[Block] = [Heading("After the blow")]
    try:
        return made + _given(found) + [Equation(x, tree) for x, tree in rates_after(found).items()]
    except (TooLarge, Singular, ArithmeticError) as error:
        return [*made, Paragraph(f"In letters no more is said: {error}.")]


def _given(found: Blow) -> list[Block]:
    said: list[str | Sym] = [piece for x in found.zeros for piece in (x, " = ")]
    return [Paragraph(["At this blow ", *said, "0, so that"])] if said else []


def _numbers(found: Blow) -> list[Block]:
    change = found.change
    rows: list[Words] = [
        [Sym(name, 1), f": {change.before.u[name]:.6g} before, {change.after.u[name]:.6g} after"] for name in change.after.u
    ]
    lost = Paragraph(f"The blow takes {change.lost:.6g} J.")
    return [Heading("In the run"), Paragraph(f"At t = {change.t:.6g} s, rates in m/s or rad/s:"), Bullets(rows), lost]


def _letters(found: Blow) -> Sequence[Letter]:
    known = found.subject.letters
    made = [
        Letter(after(name), "coordinate", known[name].unit, f"{name}, rate after the blow")
        for name in moving_names(found.subject)
    ]
    made += [Letter(impulse(load), "unknown", "N*s", f"impulse of the {load_words(load)}") for load in found.forces]
    return made + [
        Letter(coefficient(name), "parameter", "", f"restitution at {name}") for name, e in found.restitution.items() if e
    ]


def _values(found: Blow) -> dict[Sym, float]:
    values = dict(found.subject.values)
    values |= {Sym(name, 1): x for name, x in found.change.before.u.items()}
    return values | {Sym(coefficient(name)): e for name, e in found.restitution.items()}


def _check(found: Blow, solved: dict[Sym, Tree]) -> None:
    values, speeds = _values(found), found.change.after.u
    scale = max((abs(u) for u in (*speeds.values(), *found.change.before.u.values())), default=1.0) or 1.0
    for name, true in speeds.items():
        if abs(float(evaluate(solved[Sym(after(name), 1)], values)) - true) > 10 * AGREES * scale:
            raise ArithmeticError(
                "what was struck does not hold as told here (it lifts off, slides, or strikes again); see the run"
            )

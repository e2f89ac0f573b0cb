"""A balance on a page: its free body, what is not in it, the law in vectors, what acts = what is moved, the scalar equation; as much of
it as the page has room for."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import groupby, takewhile

from freebody.document.blocks import Block, Equation, Figure, Heading, Paragraph, Vector, Words, Written, listed
from freebody.document.drawings import FreeBodyDrawing
from freebody.document.rendering.text import Text
from freebody.equations.balances.reasons import agree
from freebody.equations.derivation.balance_text import Stated, cancelling, dropped, numbers
from freebody.equations.derivation.directions import Directions
from freebody.equations.derivation.put_in import Closed
from freebody.equations.derivation.sentences import joined, signs
from freebody.equations.derivation.vector_law import VectorLaw
from freebody.solve.symbolic_state import Balance, SymbolicState
from freebody.symbolic.algebra import less, opposite, quotient, signed
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import EQUALS, PLUS, Atom
from freebody.symbolic.presentation import presented
from freebody.symbolic.printers.printer import Components, Cross
from freebody.symbolic.tree import ONE, ZERO, Add, Pow, Sym, Tree, add, is_zero, mul, walk

ROOM = 40
"""Lines that a page has."""
OF_A_PAGE = 250
"""Symbols, numbers and operations of an expression beyond which it does not stand on a page."""
FOR_A_PAGE = {"momentum": False, "inertia_within": 1000}
"""What is asked of a balance for a page: the inertia of each body up to so many in both sides, beyond which no person's form is sought."""
_OF_A_LAW = 2
"""Lines that a law in vectors may take."""
_INTERNAL = 4
"""Loads within a group that are named one by one."""
_DENSE = 40
"""Symbols, numbers and operations of a line at most."""
_SAID = 2
"""Lines of what is said of several balances at once."""
_WAYS = ("whole", "parts, whole", "law, parts, whole")
"""What is shown of all balances of a page, by the room that there is."""
_NONE = 1e-6
_LONGER = "; `--long` has it multiplied out."
_SIGNS = {
    **{sign: Atom(sign, "bold") for sign in "rFa"}, **{sign: Atom(sign, kind) for sign, kind in (("(", "open"), (")", "close"))},
    "+": PLUS, "=": EQUALS, "×": Atom("×", "sign"), "Σ": Atom("∑", "sign"),
}  # fmt: skip
"""How the signs of a law are set in type; the others are letters."""
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


@dataclass(frozen=True)
class Shown:
    """A balance of which a page shows more or less. ``number`` is that of its free body, 0 where that stands above already; ``named`` are
    the directions that the page introduces."""

    subject: SymbolicState
    stated: Stated
    closed: Closed
    number: int
    named: Directions

    @property
    def title(self) -> list[Block]:
        """Its heading, and its free body."""
        made: list[Block] = [Heading(self.stated.title, 3)]
        return [*made, free_body(self.subject, self.stated.balance.bodies, self.number)] if self.number else made

    def blocks(self, shows: str) -> list[Block]:
        """What it ``shows``: the ``law`` in vectors, the sum of its ``parts``, the ``whole`` as a scalar equation; and what is absent."""
        made = self.title
        said: Words = [self._absent, *self.law_in_symbols]
        if "law" in shows and self.law:
            made.append(Equation(*self.law, said))
            said = [self._along, *self._how]
        else:
            said = [*said, self._sense, *self._how]
        if "whole" not in shows:
            return (
                [*made[:-1], replace(made[-1], label=self.stated.label)]
                if isinstance(made[-1], Equation)
                else [*made, Paragraph([*said, _LONGER])]
            )
        split = [Equation(*self.split, said)] if "parts" in shows and self.split else []
        return [*made, *split, replace(self.whole, name="" if split else said)]

    def height(self, shows: str) -> int:
        """How many lines of a page that takes."""
        if shows not in self._heights:
            self._heights[shows] = lines(self.subject, self.blocks(shows))
        return self._heights[shows]

    @cached_property
    def _heights(self) -> dict[str, int]:
        return {}

    @cached_property
    def size(self) -> int:
        """Symbols, numbers and operations of the scalar equation."""
        return signs([self.whole.left, self.whole.right])

    @cached_property
    def law(self) -> tuple[Vector, Vector] | None:
        """The law in vectors, where that is short and says more than the scalar equation, and has not been written for the same bodies."""
        sides = VectorLaw(self.subject, self.stated).sides if self.number or self.stated.balance.turns else None
        units = {unit for side in sides or () for _, unit in side.components}
        if sides is None or not (len(units) > 1 or any(isinstance(unit, Cross) for unit in units)):
            return None
        if not directions_in(sides) <= {
            *self.named.axes,
            *(unit for pair in self.named.pairs for unit in (pair.along, pair.across)),
        }:
            return None
        text = Text(self.subject.nomenclature).block(Equation(*sides))
        return sides if text.count("\n") < _OF_A_LAW and "√" not in text else None

    @cached_property
    def whole(self) -> Equation:
        """The scalar equation."""
        given = self.stated.balance
        return Equation(
            *((given.right, given.left) if self.is_long else self.closed.alone(*self._reduced[0].sides)), "", self.stated.label
        )

    @cached_property
    def split(self) -> tuple[Tree, Tree] | None:
        """What acts, and what is moved part by part, where that is not the whole already."""
        acting, carried, turned = self._parts
        split = (*carried, *turned)
        if is_zero(acting) or len(split) < 2 or not _below(acting, *split) <= _below(*self._reduced[0].sides):
            return None
        return acting, Add(split)

    @cached_property
    def is_long(self) -> bool:
        """Whether no page has it, in whatever form."""
        return not self.stated.balance.inertia

    @property
    def _is_short(self) -> bool:
        return not self.is_long and signs(self._reduced[0].sides) <= OF_A_PAGE

    @cached_property
    def _reduced(self) -> tuple[Stated, Sequence[Sym]]:
        return (self.stated, []) if self.is_long else self.closed.reduced(self.stated)

    @cached_property
    def _parts(self) -> tuple[Tree, list[Tree], list[Tree]]:
        stated, known = self._reduced
        if not self._is_short:
            return ZERO, [], []
        return _parts(self.subject, stated, self.closed, self.closed.put_in if known else self.closed.put)

    @cached_property
    def lacks_pins_only(self) -> bool:
        """Whether nothing else is absent than what acts at the point, or between the bodies."""
        why = dropped(self.subject, self.stated)
        return self.stated.balance.turns and all(re.match(r"it (acts at|is internal to) ", each) for each in why)

    @property
    def law_in_symbols(self) -> list[str | Written]:
        """The law in symbols, for as many bodies as are carried along and turned."""
        carried, turned = map(len, self._parts[1:]) if self._is_short else [len(self.stated.balance.bodies)] * 2
        each = "Σ " * (max(carried, turned) > 1)
        if not self.stated.balance.turns:
            return [_formula(f"Σ F = {each}m a")]
        parts = ["r × m a"] * (carried > 0) + ["I α"] * (turned > 0)
        moved = " + ".join(parts) or "0"
        return [_formula(f"Σ r × F = {f'Σ ({moved})' if each and len(parts) > 1 else each + moved}")]

    @property
    def _sense(self) -> str:
        stated = self._reduced[0]
        return (", clockwise" if stated.balance.turns else ", positive against that direction") * stated.turned

    @property
    def _along(self) -> str:
        """Which part of the law the scalar equation is."""
        stated = self._reduced[0]
        if stated.balance.turns:
            return "Clockwise" if stated.turned else "Counter-clockwise"
        if stated.word == "across":
            return f"Across {stated.where}{self._sense}"
        return f"{'Against' if stated.turned else 'Along'} {stated.where}"

    @property
    def _how(self) -> list:
        """By what it is multiplied, and what is put in."""
        stated, known = self._reduced
        times = [", times ", stated.factor] if stated.factor != ONE else []
        return times + ([", with ", *listed(known, " and "), " as above"] if known else [])

    @cached_property
    def _absent(self) -> str:
        """What is not in a balance, in half a sentence: ``A_x and A_y act at A.``"""
        said = []
        for why, loads in dropped(self.subject, self._reduced[0]).items():
            names = [f"the friction of {x.name}" if x.follows else x.symbol for x in loads]
            if " internal to " in why and len(names) > _INTERNAL:
                said.append("what the bodies exert on each other is internal")
                continue
            what, who = agree(why, len(names)), joined(names)
            for long, short in _BRIEFLY:
                what = long.sub(short, what)
            said.append(what.format(who))
        sentence = f"{'; '.join(said)}. " if said else ""
        return sentence[:1].upper() + sentence[1:] if sentence.startswith(("the ", "what ")) else sentence


def fitted(shown: Sequence[Shown], room: float) -> list[Block]:
    """All balances in so many lines, as far as they can be: in full, else without the laws in vectors, without the sums of parts, at last
    some only by their law. Of one that stands alone also the acceleration."""
    short = [each.size <= OF_A_PAGE for each in shown]
    if not all(short) or not fit(shown, _WAYS[0], room):
        return _folded(shown, room, short)
    ways = takewhile(lambda way: fit(shown, way, room), _WAYS)
    *_, way = ways
    made = [block for each in shown for block in each.blocks(way)]
    return made + (shown[0].closed.result(shown[0].whole) if len(shown) == 1 else [])


def fit(shown: Sequence[Shown], way: str, room: float) -> bool:
    """Whether there is room for all balances, shown in a way."""
    return sum(each.size for each in shown) <= _DENSE * room and sum(each.height(way) for each in shown) <= room


def _folded(shown: Sequence[Shown], room: float, short: Sequence[bool]) -> list[Block]:
    """Balances of which there is not room for all: as many as can be by their scalar equations, ``short`` ones first, or by the law in
    vectors; of the others it is said what is absent, of all that stand together at once."""
    ways: list[str] = ["" for _ in shown]

    def runs() -> Iterator[tuple[bool, list[int]]]:
        """Balances one by one, and those together of which all is said at once."""
        for alike, run in groupby(range(len(shown)), lambda i: not ways[i] and shown[i].lacks_pins_only):
            places = list(run)
            yield from [(True, places)] if alike and len(places) > 1 else ((False, [i]) for i in places)

    def taken() -> int:
        return sum(len(run) + _SAID if alike else shown[run[0]].height(ways[run[0]]) for alike, run in runs())

    for way, places in (("whole", [i for i, can in enumerate(short) if can]), ("law", range(len(shown)))):
        for i in sorted(places, key=lambda i: shown[i].size):
            if not ways[i] and taken() < room and (way == "whole" or shown[i].law):
                ways[i] = way
                ways[i] = way if taken() <= room else ""
    return [
        block
        for alike, run in runs()
        for block in (_alike([shown[i] for i in run]) if alike else shown[run[0]].blocks(ways[run[0]]))
    ]


def _alike(shown: Sequence[Shown]) -> list[Block]:
    """The titles of balances that lack nothing but what acts at their points and within, and the law of all."""
    said = [
        "What acts at the point, and what the bodies exert on each other, is in none of them. In each ",
        *shown[0].law_in_symbols,
    ]
    return [*(block for each in shown for block in each.title), Paragraph([*said, _LONGER])]


def directions_in(sides: Iterable[Vector]) -> set[str]:
    """The names of the unit directions in vectors."""

    def inside(parts: Components) -> set[str]:
        units = {unit for _, unit in parts if isinstance(unit, str)}
        crossed = (side for _, unit in parts if isinstance(unit, Cross) for side in (unit.arm, unit.vector))
        return units.union(*map(inside, crossed))

    return set().union(*(inside(side.components) for side in sides))


def shown(subject: SymbolicState, stated: Sequence[Stated], closed: Closed, named: Directions) -> list[Shown]:
    """The balances of a page, the free bodies numbered."""
    groups = list(dict.fromkeys(each.balance.bodies for each in stated))
    firsts = {next(i for i, each in enumerate(stated) if each.balance.bodies == group): n for n, group in enumerate(groups, 1)}
    return [Shown(subject, each, closed, firsts.get(i, 0), named) for i, each in enumerate(stated)]


def lines(subject: SymbolicState, blocks: Sequence[Block]) -> int:
    """How many lines of a page some blocks take."""
    text = Text(subject.nomenclature)
    return sum(1 for block in blocks for line in text.block(block).splitlines() if line)


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


def _formula(law: str) -> Written:
    return Written(law, tuple(_SIGNS.get(sign) or Atom(sign) for sign in law if sign != " "))

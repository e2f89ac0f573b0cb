"""Unit directions and vectors in them: λ along the x axis of a body, n = k × λ across it."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, count

from freebody.document.blocks import Vector, Words, Written
from freebody.equations.derivation.sentences import joined
from freebody.solve.symbolic_state import Arrow, Motion
from freebody.symbolic.algebra import spread
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.presentation import presented
from freebody.symbolic.symbols import SUBSCRIPTS, Name, Taken, direction, folded, unicode_name
from freebody.symbolic.tree import PI, Add, Mul, Sym, Tree, add, is_zero, minus, mul, negative, number, symbols


@dataclass(frozen=True)
class Link:
    """A link between points of two bodies, whose ``angle`` at the state one ``coordinate`` tells; or a line that does not move, of none."""

    name: str
    first: str
    second: str
    coordinate: str
    angle: float

    def quarters(self, angle: Tree, moving: Collection[str], values: Mapping[Sym, float]) -> int | None:
        """By how many quarters of a turn the link is ahead of an angle that turns with it; None for another angle."""
        if {x.name for x in symbols(angle)} & set(moving) != {self.coordinate} - {""}:
            return None
        turns = (self.angle - evaluate(angle, values)) / (math.pi / 2)
        if abs(turns - round(turns)) > _QUARTER:
            return None
        return round(turns) % 4 if self.coordinate else None if round(turns) % 2 else 0


_QUARTER = 1e-9
"""Part of a right angle by which a link may be off the angle of a direction."""


@dataclass(frozen=True)
class Direction:
    """A pair of unit directions that turn with an angle: ``λ_below`` at the angle and some ``quarters`` of a turn, ``n_below`` a right
    angle on."""

    below: str
    angle: Tree
    owners: tuple[str, ...]
    turning: tuple[str, ...] = ()
    link: Link | None = None
    quarters: int = 0
    radius: str = ""
    """The other of two polar coordinates, of which the angle is one: the directions are e_r and e_φ."""

    @property
    def along(self) -> str:
        """Name of the first."""
        return f"e_{self.radius}" if self.radius else f"λ_{self.below}"

    @property
    def across(self) -> str:
        """Name of the second."""
        return f"{'e' if self.radius else 'n'}_{self.below}"

    @property
    def angle_along(self) -> Tree:
        """The angle of the first."""
        return add(self.angle, mul(number(Fraction(self.quarters - 4 * (self.quarters == 3), 2)), Sym(PI)))

    def sentence(self, axes: Sequence[str]) -> Words:
        """What it is, where the unit vectors along x, along y and across the plane are called ``axes``."""
        where = ""
        if self.link:
            where = f"along {self.link.name}, from {self.link.first} to {self.link.second}, ".replace(", from  to ", "")
        elif self.owners:
            where = f"along the x axis of {joined(self.owners)}, "
        elif self.turning:
            where = f"(turning with {joined(self.turning)}) "
        along, across = (Written(name, direction(name)) for name in (self.along, self.across))
        turned = [f" from {axes[0]}, counter-clockwise; ", across, f" = {axes[2]} × ", along, "."]
        return [along, f" points {where}at the angle ", self.angle_along, *turned]


@dataclass(frozen=True)
class Directions:
    """All pairs that some vectors need, in the order of the bodies."""

    pairs: tuple[Direction, ...]
    moving: frozenset[str]
    axes: tuple[str, str, str] = ("i", "j", "k")
    """Unit vectors along the fixed axes x and y, and across the plane."""

    @classmethod
    def of(
        cls,
        motions: Sequence[Motion],
        arrows: Iterable[Arrow],
        moving: Collection[str],
        links: Sequence[Link] = (),
        values: Mapping[Sym, float] | None = None,
        symbols: Taken | None = None,
        polar: Mapping[Tree, tuple[str, int]] | None = None,
    ) -> Directions:
        """The pairs for some vectors (``moving`` symbols change with time), named after bodies that turn with them, after the
        link that they are along, after the symbol of the angle, or numbered; ``values`` of the symbols tell links, ``symbols``
        what names mean something else; ``polar`` has angles of polar coordinates, with the radius and by how many quarters it is ahead."""
        symbols = symbols or Taken()
        angles = list(dict.fromkeys(part.angle for arrow in arrows for part in arrow.parts))
        bodies = [body for body in motions if not body.particle]
        ahead_of = {angle: {body.body: _quarters(body.angle, angle) for body in bodies} for angle in angles}
        owners = {angle: tuple(name for name, ahead in ahead_of[angle].items() if ahead is not None) for angle in angles}
        spins = {angle: angle_rate(angle, moving) for angle in angles}
        turning = {
            a: tuple(b.body for b in bodies if w is not None and not is_zero(w) and b.omega == w) for a, w in spins.items()
        }
        angles.sort(key=lambda angle: next((i for i, b in enumerate(bodies) if b.body in turning[angle]), len(bodies)))
        made: list[Direction] = []
        for angle in angles:
            alone = links if not (owners[angle] or turning[angle]) else ()
            quarters = ((link, link.quarters(angle, moving, values or {})) for link in alone)
            own = ahead_of[angle][owners[angle][0]] if owners[angle] else 0
            link, ahead = next(((link, k) for link, k in quarters if k is not None), (None, own or 0))
            named = [_word(body) for body in (*owners[angle], *turning[angle], *([link.name] if link else []))]
            named += [unicode_name(angle.name)] if isinstance(angle, Sym) else []
            if angle in (polar or {}) and isinstance(angle, Sym):
                radius, ahead = (polar or {})[angle]
                made.append(Direction(unicode_name(angle.name), angle, (), turning[angle], None, ahead, unicode_name(radius)))
                continue
            taken = {folded(pair.below) for pair in made}
            free = (word for word in chain(named, map(str, count(len(made) + 1))) if folded(word) not in taken)
            below = next(word for word in free if not any(symbols.owner(Name(stem, (word,))) for stem in "λn"))
            made.append(Direction(below, angle, owners[angle], turning[angle], link, ahead))
        return cls(tuple(made), frozenset(moving), axes(symbols))

    def vector(self, arrow: Arrow) -> Vector:
        """A vector in these directions and i, j."""
        parts: list[tuple[Tree, str]] = [(arrow.i, self.axes[0]), (arrow.j, self.axes[1])]
        stated = {part.angle: part for part in arrow.parts}
        for pair in (pair for pair in self.pairs if pair.angle in stated):
            x, y = stated[pair.angle].along, stated[pair.angle].across
            for _ in range(pair.quarters):
                x, y = y, negative(x)
            parts += [(x, pair.along), (y, pair.across)]
        return Vector(tuple((presented(tree), name) for tree, name in parts if not is_zero(tree)))

    def rates(self) -> list[tuple[Written, Vector]]:
        """How the directions turn: dλ/dt = ω n, dn/dt = −ω λ."""
        found: list[tuple[Written, Vector]] = []
        for pair in self.pairs:
            rate = angle_rate(pair.angle, self.moving)
            if rate is None or is_zero(rate):
                continue
            for name, size, to in ((pair.along, rate, pair.across), (pair.across, mul(number(-1), rate), pair.along)):
                found.append((Written(f"d{name}/dt", direction(name, 1)), Vector(((size, to),))))
        return found


def axes(symbols: Taken) -> tuple[str, str, str]:
    """The unit vectors along the fixed axes and across the plane: i, j, k, or e_x, e_y, e_z where the model has such symbols."""
    what = {"i": "the unit vector along x", "j": "the unit vector along y", "k": "the unit vector across the plane"}
    names = (symbols.give(what[symbol], Name(symbol), Name("e", (axis,))) for symbol, axis in zip("ijk", "xyz", strict=True))
    x, y, z = (name.unicode() for name in names)
    return x, y, z


def angle_rate(angle: Tree, moving: Collection[str]) -> Tree | None:
    """The rate of a sum of symbols with numbers, of which some are ``moving``; None for any other angle."""
    rates: list[Tree] = []
    for term in angle.terms if isinstance(angle, Add) else (angle,):
        changing = [symbol for symbol in symbols(term) if symbol.name in moving]
        factors = term.factors if isinstance(term, Mul) else (term,)
        if len(changing) > 1 or any(symbol not in factors for symbol in changing):
            return None
        rates += [mul(*(Sym(f.name, f.dots + 1) if f == x else f for f in factors)) for x in changing]
    return add(*rates)


def _quarters(angle: Tree, first: Tree) -> int | None:
    """By how many quarters of a turn an angle is ahead of another; None where by something else."""
    ahead = spread(minus(angle, first))
    if any(x != Sym(PI) for x in symbols(ahead)):
        return None
    turns = 2 * evaluate(ahead, {Sym(PI): math.pi}) / math.pi
    return round(turns) % 4 if abs(turns - round(turns)) < _QUARTER else None


def _word(name: str) -> str:
    return re.sub(r"\W+", "", re.sub(r"\[(\d+)\]", lambda found: found[1].translate(SUBSCRIPTS), name)) or "1"

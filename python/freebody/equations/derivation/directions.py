"""Unit directions and vectors in them: λ along the x axis of a body, n = k × λ across it."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from freebody.document.blocks import Vector, Words, Written
from freebody.equations.derivation.data import Arrow, Motion
from freebody.equations.derivation.meaning import joined
from freebody.symbolic.collect import factored
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.symbols import Name, Taken, direction, subscript, unicode_name
from freebody.symbolic.tree import PI, Add, Mul, Sym, Tree, add, is_zero, mul, negative, number, symbols


@dataclass(frozen=True)
class Link:
    """A link between points of two bodies, whose ``angle`` at the state one ``coordinate`` tells."""

    name: str
    first: str
    second: str
    coordinate: str
    angle: float

    def quarters(self, angle: Tree, moving: Collection[str], values: Mapping[Sym, float]) -> int | None:
        """By how many quarters of a turn the link is ahead of an angle that turns with it; None for another angle."""
        if {x.name for x in symbols(angle)} & set(moving) != {self.coordinate}:
            return None
        turns = (self.angle - evaluate(angle, values)) / (math.pi / 2)
        return round(turns) % 4 if abs(turns - round(turns)) < _QUARTER else None


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

    @property
    def along(self) -> str:
        """Name of the first."""
        return f"λ_{self.below}"

    @property
    def across(self) -> str:
        """Name of the second."""
        return f"n_{self.below}"

    def sentence(self, axes: Sequence[str]) -> Words:
        """What it is, where the unit vectors along x, along y and across the plane are called ``axes``."""
        if self.link:
            quarters = self.quarters - 4 * (self.quarters == 3)
            where = [f"along {self.link.name}, from {self.link.first} to {self.link.second}, "]
            angle = add(self.angle, mul(number(Fraction(quarters, 2)), Sym(PI)))
        else:
            angle, where = self.angle, []
            if self.owners:
                where = [f"along the x axis of {joined(self.owners)}, "]
            elif self.turning:
                where = [f"(turning with {joined(self.turning)}) "]
        across = [unit(self.across), f" = {axes[2]} × ", unit(self.along), "."]
        return [unit(self.along), " points ", *where, "at the angle ", angle, f" from {axes[0]}, counter-clockwise; ", *across]


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
    ) -> Directions:
        """The pairs for some vectors (``moving`` letters change with time), named after bodies that turn with them, after the
        link that they are along, after the letter of the angle, or numbered; ``values`` of the letters tell links, ``symbols``
        what names mean something else."""
        symbols = symbols or Taken()
        angles = list(dict.fromkeys(part.angle for arrow in arrows for part in arrow.parts))
        bodies = [body for body in motions if not body.particle]
        owners = {angle: tuple(body.body for body in bodies if body.angle == angle) for angle in angles}
        turning = {angle: _turning(angle, bodies, moving) for angle in angles}
        angles.sort(key=lambda angle: next((i for i, b in enumerate(bodies) if b.body in turning[angle]), len(bodies)))
        made: list[Direction] = []
        for angle in angles:
            alone = links if not (owners[angle] or turning[angle]) else ()
            link, quarters = next(
                ((x, k) for x in alone if (k := x.quarters(angle, moving, values or {})) is not None), (None, 0)
            )
            named = [_word(body) for body in (*owners[angle], *turning[angle], *([link.name] if link else []))]
            named += [unicode_name(angle.name)] if isinstance(angle, Sym) else []
            taken = {pair.below for pair in made}
            taken |= {word for word in named if any(symbols.owner(Name(stem, (word,))) for stem in "λn")}
            below = next((word for word in named if word not in taken), str(len(made) + 1))
            made.append(Direction(below, angle, owners[angle], turning[angle], link, quarters))
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
        return Vector(tuple((factored(tree), name) for tree, name in parts if not is_zero(tree)))

    def rates(self) -> list[tuple[Written, Vector]]:
        """How the directions turn: dλ/dt = ω n, dn/dt = −ω λ."""
        found: list[tuple[Written, Vector]] = []
        for pair in self.pairs:
            rate = angle_rate(pair.angle, self.moving)
            if rate is None or is_zero(rate):
                continue
            found.append((_rate(pair.along), Vector(((rate, pair.across),))))
            found.append((_rate(pair.across), Vector(((mul(number(-1), rate), pair.along),))))
        return found


def axes(symbols: Taken) -> tuple[str, str, str]:
    """The unit vectors along the fixed axes and across the plane: i, j, k, or e_x, e_y, e_z where the model has such letters."""
    what = {"i": "the unit vector along x", "j": "the unit vector along y", "k": "the unit vector across the plane"}
    names = (symbols.give(what[letter], Name(letter), Name("e", (axis,))) for letter, axis in zip("ijk", "xyz", strict=True))
    x, y, z = (name.unicode() for name in names)
    return x, y, z


def unit(name: str) -> Written:
    """A unit direction in a sentence."""
    return Written(name, direction(name))


def angle_rate(angle: Tree, moving: Collection[str]) -> Tree | None:
    """The rate of a sum of letters with numbers, of which some are ``moving``; None for any other angle."""
    terms = angle.terms if isinstance(angle, Add) else (angle,)
    rates = [_term_rate(term, moving) for term in terms]
    return None if None in rates else add(*rates)


def _turning(angle: Tree, bodies: Sequence[Motion], moving: Collection[str]) -> tuple[str, ...]:
    """The bodies that turn as an angle does."""
    rate = angle_rate(angle, moving)
    return tuple(body.body for body in bodies if rate is not None and not is_zero(rate) and body.omega == rate)


def _term_rate(term: Tree, moving: Collection[str]) -> Tree | None:
    changing = [letter for letter in symbols(term) if letter.name in moving]
    if not changing:
        return number(0)
    factors = term.factors if isinstance(term, Mul) else (term,)
    if len(changing) > 1 or changing[0] not in factors:
        return None
    letter = changing[0]
    return mul(*(Sym(letter.name, letter.dots + 1) if factor == letter else factor for factor in factors))


def _word(name: str) -> str:
    return re.sub(r"\W+", "", re.sub(r"\[(\d+)\]", lambda found: subscript(found[1]), name)) or "1"


def _rate(name: str) -> Written:
    return Written(f"d{name}/dt", direction(name, 1))

"""The motion of a point through a body's frame, or by a chain of bodies, as terms that have names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from freebody.core import Pair
from freebody.document.blocks import Written
from freebody.equations.derivation import preamble
from freebody.equations.derivation.directions import Directions
from freebody.equations.topics.common import own
from freebody.solve.symbolic_state import Arrow, Direction, SymbolicState
from freebody.symbolic.evaluate import evaluate
from freebody.symbolic.formula import GAP, THIN, Atom, Formula, Script, bold, word
from freebody.symbolic.nomenclature import SymbolEntry
from freebody.symbolic.tree import ONE, ZERO, Tree, is_zero, read

LEVELS = ("r", "v", "a")


@dataclass(frozen=True)
class Term:
    """A part of the position (``level`` r), velocity (v) or acceleration (a) of a point: what it is, ``Coriolis``, along which
    ``body`` turns; ``written`` as ``2 ω × v_rel``. ``arrow`` is it symbolically, ``own`` its components along the axes of the body,
    ``value`` those along x and y in numbers, SI."""

    level: str
    name: str
    body: str
    written: Written
    arrow: Arrow
    own: tuple[Tree, Tree]
    value: Pair

    @property
    def vanishes(self) -> bool:
        """Whether it is 0 whatever the symbols are."""
        return all(map(is_zero, self.arrow.xy))


@dataclass(frozen=True)
class PointKinematics:
    """A point seen through ``frames``, each from the one before; through none by the chain of bodies that leads to it."""

    subject: SymbolicState
    point: str
    frames: Sequence[str]

    @cached_property
    def stated(self) -> Mapping[str, Any]:
        """What the core says of it."""
        return self.subject.ask([{"ask": "through", "point": self.point, "frames": list(self.frames)}])[0]

    @cached_property
    def stretches(self) -> list[Mapping[str, Any]]:
        """From the pin of each body to the next, and to the point; those of a chain that have a length."""
        every = self.stated["stretches"]
        return [each for each in every if not all(is_zero(read(x)) for x in each["r"]["xy"])] or every[:1]

    @cached_property
    def bodies(self) -> list[str]:
        """Those by whose frames it goes."""
        return [each["body"] for each in self.stretches]

    @cached_property
    def single(self) -> bool:
        """Whether there is one frame, so that its origin is O′ and nothing needs a body's name."""
        return len(self.stretches) == 1

    @property
    def way(self) -> str:
        """By which frames, in words."""
        return f"through the frame of {self.bodies[0]}" if self.single else f"by the chain {', '.join(self.bodies)}"

    @cached_property
    def places(self) -> list[str]:
        """The names of the pins, and of the point."""
        last = [name.rpartition(".")[2] for name in self.subject.points]
        short = self.point.rpartition(".")[2]
        return [each["pin"] for each in self.stretches] + [short if last.count(short) == 1 else self.point]

    @cached_property
    def turns(self) -> list[SymbolEntry]:
        """ω and α of each body."""
        words = (("angular velocity", "omega", "rad/s"), ("angular acceleration", "alpha", "rad/s^2"))
        return [
            own(self.subject, "coordinate", unit, f"{what} of {b}", *[letter] * self.single, f"{letter}_{b}")
            for b in self.bodies
            for what, letter, unit in words
        ]

    @cached_property
    def whole(self) -> dict[str, Arrow]:
        """Position, velocity and acceleration of the point."""
        return {level: Arrow.read(data) for level, data in self.stated["point"].items()}

    @cached_property
    def terms(self) -> tuple[Term, ...]:
        """All of them, those that vanish, too."""
        at = "O′" if self.single else self.places[0]
        made = [self._term(x, f"of {at}", "", below(x, at), self.stated["origin"][x]) for x in LEVELS]
        for i, each in enumerate(self.stretches):
            arm, w, alpha, v, a = self._letters(i)
            parts = {
                "r": ("r", f"in the frame of {each['body']}", arm),
                "turned": ("v", "transport", _times(w, arm)),
                "v_relative": ("v", "relative", v),
                "tangential": ("a", "tangential", _times(alpha, arm)),
                "centripetal": ("a", "centripetal", _times(w, _bracketed(_times(w, arm)))),
                "coriolis": ("a", "Coriolis", _twice(_times(w, v))),
                "a_relative": ("a", "relative", a),
            }
            made += [self._term(level, name, each["body"], left, each[key]) for key, (level, name, left) in parts.items()]
        return tuple(sorted(made, key=lambda term: LEVELS.index(term.level)))

    def _letters(self, i: int) -> tuple[Written, ...]:
        """r′, ω, α, v_rel and a_rel of a stretch, or with the names of its ends and its body."""
        turns = [Written.of(entry.written, bold=True) for entry in self.turns[2 * i : 2 * i + 2]]
        if self.single:
            return _PRIMED, *turns, below("v", "rel"), below("a", "rel")
        end, seen = self.places[i + 1], f"{self.places[i + 1]}/{self.bodies[i]}"
        return below("r", f"{end}/{self.places[i]}"), *turns, below("v", seen), below("a", seen)

    def _term(self, level: str, name: str, body: str, written: Written, data: Mapping[str, Any]) -> Term:
        arrow = Arrow.read(data)
        x, y = map(read, data["own"]) if body else arrow.xy
        return Term(level, name, body, written, arrow, (x, y), self.value(arrow))

    def value(self, arrow: Arrow) -> Pair:
        """A vector in numbers, along x and y."""
        x, y = (float(evaluate(tree, self.subject.values, self.subject.tables)) for tree in arrow.xy)
        return x, y

    @cached_property
    def directions(self) -> Directions:
        """The unit directions of the frames and of what moves in them."""
        frames = [Arrow((Direction(read(each["angle"]), ONE, ZERO),), ZERO, ZERO, (ZERO, ZERO)) for each in self.stretches]
        turning = [arrow for arrow, each in zip(frames, self.stretches, strict=True) if not is_zero(read(each["omega"]))]
        return preamble.directions(self.subject, [*turning, *self.whole.values(), *(term.arrow for term in self.terms)])


def below(stem: str, name: str) -> Written:
    """A vector with the name of a place behind it: r_P."""
    letters = (*word(name.removesuffix("′")), *(_PRIME if name.endswith("′") else ()))
    return Written(f"{stem}_{name}", (Script(bold(stem), letters),))


_PRIME: Formula = (Atom("′", "sign"),)
_PRIMED = Written("r′", (*bold("r"), *_PRIME))
_CROSS: Formula = (THIN, Atom("×", "sign"), THIN)


def _times(left: Written, right: Written) -> Written:
    return Written(f"{left.text} × {right.text}", (*left.formula, *_CROSS, *right.formula))


def _bracketed(inner: Written) -> Written:
    return Written(f"({inner.text})", (Atom("(", "open"), *inner.formula, Atom(")", "close")))


def _twice(inner: Written) -> Written:
    return Written(f"2 {inner.text}", (Atom("2", "number"), GAP, *inner.formula))

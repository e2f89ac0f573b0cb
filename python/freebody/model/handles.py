"""What the builder hands back: points, bodies, joints and expressions, all of which a model can be written with."""

from __future__ import annotations

from functools import partialmethod
from typing import Any

from .names import spell


class Expression(str):
    """The text of an expression; arithmetic on it makes longer ones: ``2*T`` → ``2*T`` in the model."""

    __slots__ = ()

    def _join(self, sign: str, other: Any, swapped: bool = False) -> Expression:
        left, right = (other, self) if swapped else (self, other)
        return Expression(f"{_operand(left)} {sign} {_operand(right)}")

    def __neg__(self) -> Expression:
        return Expression(f"-{_operand(self)}")


for _word, _sign in {"add": "+", "sub": "-", "mul": "*", "truediv": "/", "pow": "^"}.items():
    setattr(Expression, f"__{_word}__", partialmethod(Expression._join, _sign))
    if _word != "pow":
        setattr(Expression, f"__r{_word}__", partialmethod(Expression._join, _sign, swapped=True))


def _operand(value: Any) -> str:
    text = str(value)
    alone = text.replace("_", "").replace(".", "").isalnum()
    return text if alone else f"({text})"


class Mark(str):
    """A named point, line or curve of a body, ``body.name``."""

    __slots__ = ()


class Marked:
    """A body or the ground. Its points, lines and curves are attributes: ``rod.start``, ``m.ground.O``."""

    def __init__(self, mechanism: Any, name: str, points: tuple[str, ...] = ()) -> None:
        self._mechanism = mechanism
        self.name = name
        for point in points:
            self._has(point)

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<{type(self).__name__.lower()} {self.name}>"

    def point(self, name: str, at: Any) -> Mark:
        """Names a point: coordinates in the body's frame, or the name of another point of it. Also ``body.name`` from now on."""
        at = at.removeprefix(f"{self.name}.") if isinstance(at, str) else at
        self._mechanism.mark(self.name, "points", name, at)
        return self._has(name)

    def line(self, name: str, through: Any, towards: Any = None, *, angle: Any = None) -> Mark:
        """Names a line through a point, towards another one or at an angle from the body's x axis."""
        turned = {"through": str(through), "angle": 0 if angle is None else angle}
        self._mechanism.mark(self.name, "lines", name, turned if towards is None else [str(through), str(towards)])
        return self._has(name)

    def curve(self, name: str, shape: Any = None, **coordinates: Any) -> Mark:
        """Names a curve: ``x=``, ``y=`` as expressions of s, or ``{"arc": …}``, or a list of lines and arcs."""
        self._mechanism.mark(self.name, "curves", name, coordinates or shape)
        return self._has(name)

    def _has(self, name: str) -> Mark:
        mark = self[name]
        if name.isidentifier() and not hasattr(type(self), name):
            setattr(self, name, mark)
        return mark

    def _ipython_key_completions_(self) -> list[str]:
        return [str(value).partition(".")[2] for value in vars(self).values() if isinstance(value, Mark)]

    def __getitem__(self, name: str) -> Mark:
        """The point, line or curve of that name, also when it is no Python word."""
        return Mark(f"{self.name}.{name}")


class Body(Marked):
    """A body of a mechanism under construction."""


class Ground(Marked):
    """The ground; ``ground.O`` is the origin."""


class Element:
    """A joint, force, motion, contact, string or stop of a mechanism under construction."""

    def __init__(self, name: str, coordinates: list[str]) -> None:
        self.name = name
        self.coordinates = [Expression(spell(c)) for c in coordinates]

    def __str__(self) -> str:
        return self.name

    def __repr__(self) -> str:
        return f"<{self.name}>"

    @property
    def coordinate(self) -> Expression:
        """The first coordinate of a joint, for use in expressions."""
        return self.coordinates[0]

    def __getitem__(self, part: str) -> Expression:
        """What a report may read: ``joint["Fx"]``, ``force["power"]``."""
        return Expression(f"{spell(self.name)}.{part}")

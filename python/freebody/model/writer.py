"""The words of a model in the core's terms: numbers in SI, full names, checked dimensions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from freebody.core import Spec, cards
from freebody.symbolic.dimensions import Dimension
from freebody.symbolic.tree import Fn, Node, Num, Sym, unsigned, walk

from . import syntax, units
from .arithmetic import Number
from .errors import ModelProblem, Path
from .meanings import Meanings
from .names import TOKEN, replace_names, spell, suggestion, unquote
from .scope import Scope
from .switches import SurfaceShape
from .values import Circle, Through

Unit = str | Dimension | None
_OF_ANGLES = ("sin", "cos", "tan")


@dataclass
class Writer:
    """Writes what one scope says into the ``spec`` of the core. Every method takes the path of the item; what is wrong is noted there.

    Of the whole model: ``lines``; ``places``, the coordinates of its named points in their bodies; ``tracks``, its curves of lines and
    arcs as surfaces; ``items`` leads from what is made beside the items of the file to where it was written, ``hand_over`` from an event
    to the file that it goes on as, and where it says so; ``turns`` is said, by name, of angles that may have been meant in degrees,
    ``angles`` are names that stand for angles; ``looks`` says of bodies how they are drawn."""

    scope: Scope
    meanings: Meanings
    spec: Spec = field(default_factory=dict)
    lines: dict[str, Spec] = field(default_factory=dict)
    places: dict[str, list[Number]] = field(default_factory=lambda: {"ground.O": [0.0, 0.0]})
    tracks: dict[str, Spec] = field(default_factory=dict)
    items: dict[str, tuple[Scope, Path]] = field(default_factory=dict)
    hand_over: dict[str, tuple[Scope, Path, str]] = field(default_factory=dict)
    turns: dict[str, str] = field(default_factory=dict)
    angles: set[str] = field(default_factory=set)
    looks: dict[str, dict[str, Any]] = field(default_factory=dict)

    @property
    def prefix(self) -> str:
        """What stands before the names of this scope in the whole model."""
        return self.scope.prefix

    def owner(self, body: str) -> str:
        """What stands before the names of points, lines and curves of a body or of the ground."""
        return f"ground.{self.prefix}" if body == "ground" else f"{body}."

    # -- numbers and expressions

    def number(self, path: Path, value: Any, unit: Unit = None, positive: str = "") -> Number:
        """A number of the model. ``positive`` says what may not be negative (``a mass``)."""
        with self.scope.noting(path):
            found, dimension = self.number_of(value)
            self._check_dimension(path, value, dimension, unit)
            if dimension is None and unit in ("rad", units.ANGLE):
                self._read_as_angle(path, found)
            if positive and (size := self.scope.parameters.number(value)) < 0:
                raise ModelProblem(f"{positive} cannot be negative; `{value}` is {size:g}", "check its sign")
            return found
        return 0.0

    def fraction(self, path: Path, value: Any, what: str) -> Number:
        """A number from 0 to 1; ``what`` says which (``a restitution``)."""
        found = self.number(path, value, "", what)
        if (size := self.size(value)) is not None and size > 1:
            self.scope.complain(path, f"{what} is at most 1; `{value}` is {size:g}", "1 gives back all speed, 0 none")
        return found

    def size(self, value: Any) -> float | None:
        """The value of a number of the model; None where it has none."""
        try:
            return self.scope.parameters.number(value)
        except ModelProblem:
            return None

    def numbers(self, path: Path, values: list[Any], unit: Unit = "m") -> list[Number]:
        """Several numbers of one unit."""
        return [self.number((*path, i), value, unit) for i, value in enumerate(values)]

    def expression(self, path: Path, text: Any, unit: Unit = None, local: str = "") -> str:
        """An expression of the configuration, of time or of answers; the core knows which of them may stand where.

        ``unit`` is what it must measure (None: anything); ``local`` is a name that only this expression knows (``s`` of
        a curve).
        """
        with self.scope.noting(path):
            found, dimension = self.measured(text, local)
            self._check_dimension(path, text, dimension, unit)
            return found
        return "0"

    def dimension(self, text: Any) -> Dimension | None:
        """The dimension of an expression; None when it fits anywhere or is wrong."""
        try:
            return self.measured(text)[1]
        except ModelProblem:
            return None

    def measured(self, text: Any, local: str = "") -> tuple[str, Dimension | None]:
        """An expression with its dimension (None: fits anywhere). Raises ``ModelProblem``."""
        if not isinstance(text, str):
            return repr(float(text)), None
        expression = syntax.parse(text, lambda name: name == local or self.full(name) in self.meanings.values, self._in_full)
        self._check_arguments(expression.tree)
        self._read_angles(expression)

        def lookup(name: str) -> Dimension | None:
            return None if name == local else self.meanings.dimension(name, self.scope)

        measure = syntax.Measure(expression, lookup, self.meanings.tables.__contains__)
        return expression.text, measure.of(expression.tree)

    def number_of(self, value: Any) -> tuple[Number, Dimension | None]:
        """A number of the model with its dimension (None: fits anywhere). Raises ``ModelProblem``."""
        if not isinstance(value, str):
            return float(value), None
        expression = syntax.parse(value, self.scope.parameters.__contains__, self._in_full)
        if isinstance(expression.tree, Num):
            return float(expression.tree.value), expression.numbers[expression.tree.span]
        for name in syntax.names(expression.tree):
            kind = self.meanings.values.get(name, ("constant" if name == "pi" else "",))[0]
            if name == "t" or kind not in ("parameter", "constant", ""):
                what = "the time" if name == "t" else f"a {kind}"
                raise ModelProblem(
                    f"`{name}` is {what}; this number cannot change with the motion", "it may depend on parameters only"
                )
            if not kind:
                raise self.meanings.unknown(name, self.scope)
        self._read_angles(expression)
        _, dimension = self.scope.parameters.measured(value)
        return expression.text, dimension

    def _check_dimension(self, path: Path, text: Any, found: Dimension | None, unit: Unit) -> None:
        if unit is None or found is None:
            return
        wanted = units.unit(unit).dimension if isinstance(unit, str) else unit
        if found.fits(wanted):
            return
        name = next((f"`{step}`" for step in reversed(path) if isinstance(step, str)), "this")
        words = [t[0] for t in TOKEN.finditer(str(text)) if t.lastgroup == "name" and t[0] in self.scope.model.parameters]
        hint = f"write it in {wanted.unit()}, or in a unit of the same kind" if wanted.unit() else "write a plain number"
        if words and units.quantity(str(text)) is not None:
            hint = f"after a number, `{words[0]}` is read as a unit; for the parameter write a product, `*{words[0]}`"
        raise ModelProblem(f"{name} is {wanted.words()}; `{text}` is {found.words()}", hint)

    def _read_as_angle(self, path: Path, found: Number) -> None:
        if isinstance(found, str):
            self.angles.add(found.lstrip("-"))
        else:
            name = self.full(str(path[-1])) if path[0] == "initial" else ".".join(map(str, path))
            self.turns |= units.many_turns(name, found)

    def _read_angles(self, expression: syntax.Expression) -> None:
        for call in walk(expression.tree):
            if isinstance(call, Fn) and call.name in _OF_ANGLES:
                for given in call.args:
                    angle = unsigned(given)
                    if isinstance(angle, Sym):
                        self.angles.add(angle.name)
                    elif isinstance(angle, Num) and expression.numbers[angle.span] is None:
                        self._read_as_angle((f"the angle in {call.name}({angle.value:g})",), float(angle.value))

    def _check_arguments(self, tree: Node) -> None:
        calls = (call for call in walk(tree) if isinstance(call, Fn) and call.name not in self.meanings.tables)
        for name, arguments in ((call.name, call.args) for call in calls if call.name in cards.functions()):
            function = cards.functions()[name]
            kinds = function.takes
            if len(arguments) != len(kinds) and not (function.optional and not arguments):
                count = f"{len(kinds) or 'no'} argument{'s'[: len(kinds) != 1]}"
                raise ModelProblem(f"`{name}` takes {count}, not {len(arguments)}", f"write `{name}({', '.join(kinds)})`")
            for kind, argument in zip(kinds, arguments, strict=False):
                if not isinstance(argument, Sym):
                    raise ModelProblem(f"`{name}` reads a {kind}, not a number", "write its name")
                self._known(argument.name, kind)

    def _in_full(self, text: str) -> str:
        def token(text: str, is_call: bool) -> str:
            name = unquote(text)
            if is_call:
                return spell(self.prefix + name) if self.prefix + name in self.meanings.tables else text
            full = self.full(name)
            return text if full == name and "'" not in text else spell(full)

        return replace_names(text, token)

    def full(self, name: str) -> str:
        """The name under which the whole model knows what this file calls ``name``."""
        head, _, rest = name.partition(".")
        if head == "ground" and rest:
            own = name if rest in ("O", "origin") else f"ground.{self.prefix}{rest}"
        else:
            own = self.prefix + name if head in self.scope.heads else name
        return self.meanings.alias.get(own, own)

    # -- places

    def point(self, path: Path, name: str, body: str = "") -> str:
        """The full name of a point; within a ``body``, its own points need not name it."""
        return self.place(path, name, "point", body)

    def line(self, path: Path, line: Any, body: str = "") -> dict[str, Any]:
        """A point with a direction."""
        if isinstance(line, list):
            first, second = (self.point((*path, i), name, body) for i, name in enumerate(line))
            if first == second or body_of(first) != body_of(second):
                why = "are the same" if first == second else "belong to two bodies"
                self.scope.complain(path, f"the points of a line {why}", "a line goes through two points of one body")
            return {"point": first, "towards": second}
        if isinstance(line, (Through, SurfaceShape)):
            point = self.point((*path, "through"), line.through, body)
            return {"point": point, "angle": self.number((*path, "angle"), line.angle, "rad")}
        return dict(self.lines.get(self.place(path, line, "line", body), {"point": "ground.O", "angle": 0.0}))

    def circle(self, path: Path, circle: Circle | SurfaceShape) -> dict[str, Any]:
        """A centre and a radius."""
        centre = self.point((*path, "centre"), circle.centre)
        return {"centre": centre, "radius": self.number((*path, "radius"), circle.radius, "m", "a radius")}

    def place(self, path: Path, name: str, kind: str, body: str = "") -> str:
        """The full name of a point, line, curve or body."""
        name = unquote(name).strip()
        own = f"{body}.{name}"
        with self.scope.noting(path):
            if body and (known := self.meanings.alias.get(own, own)) in self.meanings.called(kind):
                return known
            return self._known(self.full(name if "." in name or not body else own.removeprefix(self.prefix)), kind)
        return "ground" if kind == "body" else "ground.O"

    def _known(self, name: str, kind: str) -> str:
        meanings, short = self.meanings, name.removeprefix(self.prefix)
        known = meanings.called(kind)
        if name in known:
            return name
        if kind not in ("body", "string"):
            raise meanings.place(name, kind, known, self.scope)
        is_point = kind == "body" and name in meanings.points
        what = f"`{short}` is a point, and a body is needed" if is_point else f"there is no {kind} `{short}`"
        word = short.split(".")[0] if kind == "body" else short
        raise ModelProblem(what, suggestion(word, meanings.seen_from(self.scope, known), f"{kind}s"))


def body_of(point: str) -> str:
    """The body of the full name of a point."""
    return "ground" if point.startswith("ground.") else point.rpartition(".")[0]

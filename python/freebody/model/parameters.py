"""Parameters of a model as numbers and dimensions, each worked out after those it uses."""

from __future__ import annotations

from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter

from freebody.symbolic.dimensions import Dimension

from . import syntax
from .errors import Consequence, ModelProblem
from .names import suggestion

Number = float | int | str


class Parameters:
    """Named numbers that may use one another.

    ``overruled`` gives some of them another number and dimension from outside. What is wrong with a parameter is
    kept in ``faults`` and raised when its value is asked for.
    """

    def __init__(self, given: Mapping[str, Number], overruled: Mapping[str, tuple[float, Dimension | None]]) -> None:
        self.given, self.overruled = given, overruled
        self.faults: dict[str, ModelProblem] = {}
        self._values = {name: value for name, (value, _) in self.overruled.items()}
        self._dimensions = {name: dimension for name, (_, dimension) in self.overruled.items()}
        self.children: dict[str, Parameters] = {}
        for name in self._order():
            if name in given and name not in self._values and name not in self.faults:
                try:
                    self._values[name], self._dimensions[name] = self.measured(given[name])
                except ModelProblem as complaint:
                    self.faults[name] = complaint

    def __contains__(self, name: object) -> bool:
        return name in self.given or (isinstance(name, str) and self._child(name) is not None)

    def value(self, name: str) -> float:
        """The value in SI. Raises ``ModelProblem``."""
        if child := self._child(name):
            return child[0].value(child[1])
        if name in self.faults:
            raise Consequence(f"the parameter `{name}` has no value", self.faults[name].what)
        if name not in self._values:
            raise ModelProblem(f"there is no parameter `{name}`", suggestion(name, self.given, "parameters"))
        return self._values[name]

    def dimension(self, name: str) -> Dimension | None:
        """The dimension; None when it fits anywhere or is not known."""
        if child := self._child(name):
            return child[0].dimension(child[1])
        return self._dimensions.get(name)

    def number(self, text: Number) -> float:
        """The value of a number of the model. Raises ``ModelProblem``."""
        return syntax.number(text, self.value, self.__contains__)

    def whole(self, text: str) -> int:
        """The value of a whole number, for repetitions and indices. Raises ``ModelProblem``."""
        value = self.number(text)
        if not abs(value) <= 1e9 or value != round(value):
            what = f"`{text}` is {value:g}, which is no whole number"
            raise ModelProblem(what, "repetitions and indices count in whole numbers")
        return round(value)

    def measured(self, text: Number) -> tuple[float, Dimension | None]:
        """Value and dimension of a number of the model. Raises ``ModelProblem``."""
        return self.number(text), syntax.dimension(text, self.dimension, self.__contains__)

    def _order(self) -> list[str]:
        uses: dict[str, list[str]] = {}
        for name, text in self.given.items():
            try:
                uses[name] = syntax.names(syntax.parse(text, self.__contains__).tree) if isinstance(text, str) else []
            except ModelProblem as complaint:
                self.faults[name], uses[name] = complaint, []
        while True:
            try:
                return list(TopologicalSorter(uses).static_order())
            except CycleError as error:
                circle = list(dict.fromkeys(reversed(error.args[1])))
                what = f"parameters are defined by one another in a circle: {' → '.join([*circle, circle[0]])}"
                self.faults |= dict.fromkeys(circle, ModelProblem(what, "give one of them a number"))
                uses |= {name: [] for name in circle}

    def _child(self, name: str) -> tuple[Parameters, str] | None:
        head, dot, rest = name.partition(".")
        return (self.children[head], rest) if dot and head in self.children else None

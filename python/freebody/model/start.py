"""How a motion starts: the section ``initial`` as arguments of the core's ``assemble``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, TypedDict

from numpy.typing import NDArray

from freebody.symbolic.dimensions import TIME, Dimension

from . import syntax, units
from .errors import ModelProblem, Path
from .names import suggestion
from .writer import Number, Writer

_SIGNS = {"positive": 1, "negative": -1}
_RESTLESS = ("`at_rest` and `rates` contradict each other", "leave one of them out")
_LIKE = {"s": "`5` or `200 ms`", "": "`1e-9`"}
WORDS = ("rates", "at_rest", "guess", "points", "branch")


@dataclass
class Start:
    """The section ``initial`` in the core's terms; numbers may be expressions of parameters. ``turns`` is said, by name, of angles that
    may have been meant in degrees; ``angles`` are the parameters that stand for angles."""

    fixed: dict[str, Number] = field(default_factory=dict)
    guess: dict[str, Number] = field(default_factory=dict)
    rates: dict[str, Number] = field(default_factory=dict)
    points: dict[str, list[Number]] = field(default_factory=dict)
    branch: dict[str, int] = field(default_factory=dict)
    equilibrium: bool = False
    turns: dict[str, str] = field(default_factory=dict)
    angles: set[str] = field(default_factory=set)
    coordinates: dict[str, Dimension | None] = field(default_factory=dict)
    parameters: dict[str, Dimension | None] = field(default_factory=dict)


class Assembly(TypedDict):
    """Arguments of ``CompiledModel.assemble``."""

    p: NDArray[Any]
    fixed: dict[str, float]
    guess: dict[str, float]
    rates: dict[str, float]
    points: dict[str, list[float]]
    branch: dict[str, int]


def write(writer: Writer, start: Start) -> None:
    """Adds to the start the coordinates and parameters of the model, and the section ``initial`` of one scope."""
    known, scope, initial = writer.meanings.values, writer.scope, writer.scope.model.initial
    start.coordinates = {name: d for name, (kind, d) in known.items() if kind == "coordinate"}
    start.parameters = {name: d for name, (kind, d) in known.items() if kind in ("parameter", "state")}
    if initial is None:
        return
    path: Path = ("initial",)
    start.fixed |= _values(writer, start, path, initial.model_extra or {}, 0)
    start.guess |= _values(writer, start, (*path, "guess"), initial.guess, 0)
    if initial.at_rest:  # what a part of this scope says of its rates is overruled
        start.rates = {n: rate for n, rate in start.rates.items() if not n.startswith(scope.prefix)}
        if initial.rates:
            scope.complain((*path, "rates"), *_RESTLESS)
    start.rates |= _values(writer, start, (*path, "rates"), initial.rates, 1)
    for name, at in initial.points.items():
        here = (*path, "points", name)
        start.points[writer.point(here, name)] = writer.numbers(here, at)
    if "equilibrium" in initial.model_fields_set:
        start.equilibrium = initial.equilibrium
    for text, sign in initial.branch.items():
        start.branch[writer.expression((*path, "branch", text), text)] = _SIGNS[sign]


def _values(writer: Writer, start: Start, path: Path, given: Mapping[str, Any], order: int) -> dict[str, Number]:
    found: dict[str, Number] = {}
    for name, value in given.items():
        full, here = writer.full(name), (*path, name)
        if full in start.coordinates:
            writer.turns.pop(full, None)
            found[full] = writer.number(here, value, _dimension(start, full, order))
        else:
            kind = writer.meanings.values.get(full, ("",))[0]
            words = (*WORDS, "equilibrium") if len(here) == 2 else ()
            known = [*writer.meanings.seen_from(writer.scope, start.coordinates), *words]
            hint = f"`initial` sets coordinates; a {kind} has its value under `{kind}s`"
            hint = hint if kind in ("parameter", "state") else suggestion(name, known, "coordinates")
            what = f"`{name}` is a {kind}, not a coordinate" if kind else f"there is no coordinate `{name}`"
            writer.scope.complain(here, what, hint, True)
    return found


def initial_state(start: Start, core: Any, overrides: Mapping[str, Any] | None = None) -> Assembly:
    """Arguments for ``core.assemble``: the start of the model with ``overrides``.

    ``overrides`` maps coordinates and parameters to numbers or quantities (``{"phi2": "90 deg", "T": 2}``); the words
    of ``initial`` (``rates``, ``guess``, ``points``, ``branch``, ``at_rest``) are understood as well. Raises ``ModelProblem``.
    """
    given = dict(overrides or {})
    words = {word: given.pop(word) for word in WORDS if word in given}
    unknown = [name for name in given if name not in start.coordinates and name not in start.parameters]
    if unknown:
        known = [*start.coordinates, *start.parameters, *WORDS]
        raise ModelProblem(f"there is no coordinate or parameter `{unknown[0]}`", suggestion(unknown[0], known))
    if words.get("at_rest") and words.get("rates"):
        raise ModelProblem(*_RESTLESS)
    p = core.bind({n: _plain(n, v, start.parameters[n], {}) for n, v in given.items() if n in start.parameters})
    values = parameter_values(core, p)

    def plain(stated: Mapping[str, Any], order: int = 0) -> dict[str, float]:
        return {n: _plain(n, v, _dimension(start, n, order), values) for n, v in stated.items()}

    points = start.points | dict(words.get("points", {}))
    return {
        "p": p,
        "fixed": plain(start.fixed | {n: v for n, v in given.items() if n in start.coordinates}),
        "guess": plain(start.guess | dict(words.get("guess", {}))),
        "rates": {} if words.get("at_rest") else plain(start.rates | dict(words.get("rates", {})), 1),
        "points": {n: [_plain(n, v, units.LENGTH, values) for v in at] for n, at in points.items()},
        "branch": start.branch | {text: _sign(sign) for text, sign in dict(words.get("branch", {})).items()},
    }


def many_turns(start: Start, initial: Mapping[str, Any] | None, changes: Mapping[str, Any]) -> list[str]:
    """What is worth saying of angles at a start that may have been meant in degrees; the arguments are those of ``initial_state``."""
    given = {**(initial or {}), **changes}
    named = given | dict(given.get("guess") or {})
    said = {
        name: note
        for name, note in start.turns.items()
        if name not in named and (initial is None or name not in start.coordinates)
    }
    for name, value in named.items():
        if name in start.angles or start.coordinates.get(name) == units.ANGLE:
            said |= units.many_turns(name, value)
    return list(said.values())


def parameter_values(core: Any, p: NDArray[Any]) -> dict[str, float]:
    """The parameters of a compiled mechanism by name."""
    names = [parameter["name"] for parameter in core.metadata["parameters"]]
    return {name: float(value) for name, value in zip(names, p, strict=True)}


def evaluate(number: Any, values: Mapping[str, float]) -> float:
    """A bare number, a quantity, or an expression of parameters with these values. Raises ``ModelProblem``."""
    return _plain("the number", number, None, values)


def quantity(name: str, number: Any, unit: str, values: Mapping[str, float] | None = None) -> float:
    """A number in SI, a quantity that fits a ``unit``, or an expression of parameters with these ``values``; ``name`` says what
    it is of. Raises ``ModelProblem``."""
    try:
        return _plain(name, number, units.unit(unit).dimension, values or {})
    except ModelProblem as problem:
        stated = problem.what if problem.what.startswith(f"`{name}` ") else f"`{name}` is `{number}`: {problem.what}"
        raise ModelProblem(stated, problem.hint or f"write e.g. {_LIKE.get(unit, 'a number')}") from None


def _plain(name: str, number: Any, dimension: Dimension | None, values: Mapping[str, float]) -> float:
    quantity = units.quantity(number) if isinstance(number, str) else None
    if quantity and dimension is not None and not quantity.dimension.fits(dimension):
        raise ModelProblem(f"`{name}` is {dimension.words()}; `{number}` is {quantity.dimension.words()}")

    def value(parameter: str) -> float:
        if parameter not in values:
            raise ModelProblem(f"there is no parameter `{parameter}`", suggestion(parameter, values))
        return values[parameter]

    return syntax.number(number, value, values.__contains__)


def _dimension(start: Start, name: str, order: int) -> Dimension | None:
    """The dimension of a coordinate, or of its rate."""
    if name not in start.coordinates:
        raise ModelProblem(f"there is no coordinate `{name}`", suggestion(name, start.coordinates))
    dimension = start.coordinates[name]
    return dimension and dimension.times(TIME, -order)


def _sign(sign: Any) -> int:
    if sign in (*_SIGNS, 1, -1):
        return _SIGNS.get(sign) or int(sign)
    raise ModelProblem(f"`{sign}` is no branch", "write `positive` or `negative`")

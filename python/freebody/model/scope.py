"""A model in use: repetitions written out, parameters worked out, parts opened."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any, Protocol

from pydantic import ValidationError

from freebody.core import cards
from freebody.symbolic.dimensions import Dimension

from . import elements, reading
from .errors import Consequence, ModelFileError, ModelProblem, Path, Problem, Where, path_text
from .expand import Expansion, repeats
from .parameters import Parameters
from .schema import Model

MAX_DEPTH = 16


class Places(Protocol):
    """Whatever knows where the items of a model were written: a file, or Python calls."""

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item, or of the nearest that holds it."""


@dataclass
class Folder:
    """Where parts are looked for: relative to ``here``, never outside ``root``."""

    here: FilePath
    root: FilePath
    opened: tuple[FilePath, ...] = ()

    @classmethod
    def of(cls, file: str | FilePath | None) -> Folder:
        """The folder of a model file, or the current one for a model made in Python."""
        path = FilePath(file).resolve() if file else None
        here = path.parent if path else FilePath.cwd()
        return cls(here, here, (path,) if path else ())

    def beside(self, name: str) -> FilePath:
        """A file by its name relative to here. Raises ``ModelProblem``."""
        path = (self.here / name).resolve()
        if FilePath(name).is_absolute() or not path.is_relative_to(self.root):
            raise ModelProblem(f"the file `{name}` is outside the folder of the model", f"put it under {self.root}")
        return path

    def file(self, name: str) -> FilePath:
        """The file of a part. Raises ``ModelProblem``."""
        path = self.beside(name)
        if path in self.opened:
            circle = " → ".join(p.name for p in (*self.opened[self.opened.index(path) :], path))
            raise ModelProblem(f"model files are parts of one another in a circle: {circle}", "a mechanism cannot hold itself")
        if len(self.opened) >= MAX_DEPTH:
            raise ModelProblem(f"parts are nested more than {MAX_DEPTH} deep")
        return path

    def inside(self, path: FilePath) -> Folder:
        """The folder as seen from a part."""
        return Folder(path.parent, self.root, (*self.opened, path))


@dataclass
class Scope:
    """One model file in use, as a whole or as a part under ``prefix`` (e.g. ``leg.``)."""

    prefix: str
    model: Model
    places: Places
    parameters: Parameters
    problems: list[Problem]
    origin: dict[Path, Path] = field(default_factory=dict)
    parts: dict[str, Scope] = field(default_factory=dict)
    heads: set[str] = field(default_factory=set)

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item as it was written."""
        for length in range(len(path), 0, -1):
            if path[:length] in self.origin:
                return self.places.where((*self.origin[path[:length]], *path[length:]), at_key)
        return self.places.where(path, at_key)

    def complain(self, path: Path, what: str, hint: str = "", at_key: bool = False) -> None:
        """Notes a problem."""
        where = self.where(path, at_key)
        self.problems.append(
            Problem(
                where if where.path else Where(where.file, where.line, where.column, path_text(path), where.excerpt), what, hint
            )
        )

    def all(self) -> list[Scope]:
        """This scope and those of all parts, outer ones first."""
        return [self] + [inner for part in self.parts.values() for inner in part.all()]


def open_scope(
    model: Model,
    places: Places,
    folder: Folder,
    problems: list[Problem],
    prefix: str = "",
    overruled: dict[str, tuple[float, Dimension | None]] | None = None,
) -> Scope:
    """The model in use. What is wrong goes to ``problems``; the scope is then as complete as can be."""
    parameters, model, origin = _written_out(model, places, problems, overruled or {})
    scope = Scope(prefix, model, places, parameters, problems, origin)
    for name, fault in parameters.faults.items():
        if not isinstance(fault, Consequence):
            scope.complain(("parameters", name), fault.what, fault.hint)
    for name in model.parts:
        _open_part(scope, name, folder)
    scope.heads = _heads(scope)
    return scope


Written = tuple[Parameters, Model, dict[Path, Path]]


def _written_out(
    model: Model, places: Places, problems: list[Problem], overruled: dict[str, tuple[float, Dimension | None]]
) -> Written:
    data = model.written()
    if not repeats(data):
        return Parameters(model.parameters, overruled), model, {}

    def complain(path: Path, what: str, hint: str, at_key: bool) -> None:
        problems.append(Problem(places.where(path, at_key), what, hint))

    try:
        known = Parameters(model.parameters, overruled)
        data["parameters"] = Expansion(known.whole, complain).of(data.get("parameters", {}), ("parameters",), ("parameters",))
        parameters = Parameters(data["parameters"], overruled)
        expansion = Expansion(parameters.whole, complain)
        return parameters, Model.model_validate(expansion.of(data)), expansion.origin
    except ModelProblem as complaint:
        problems.append(Problem(places.where(()), complaint.what, complaint.hint))
    except ValidationError as error:
        scope = Scope("", model, places, parameters, problems, expansion.origin)
        for path, what, hint, at_key in reading.complaints(error):
            scope.complain(path, what, hint, at_key)
    raise ModelFileError(problems)


def _open_part(scope: Scope, name: str, folder: Folder) -> None:
    part = scope.model.parts[name]
    try:
        path = folder.file(part.file)
    except ModelProblem as complaint:
        return scope.complain(("parts", name, "file"), complaint.what, complaint.hint)
    try:
        model, source = reading.read(path)
    except ModelFileError as error:
        missing = not path.exists()
        scope.problems += [] if missing else error.problems
        if missing:
            scope.complain(("parts", name, "file"), f"there is no file `{part.file}`", error.problems[0].hint)
        return None
    inner = open_scope(
        model, source, folder.inside(path), scope.problems, f"{scope.prefix}{name}.", _overruled(scope, name, model)
    )
    scope.parts[name] = inner
    scope.parameters.children[name] = inner.parameters
    return None


def _overruled(scope: Scope, name: str, model: Model) -> dict[str, tuple[float, Dimension | None]]:
    from .names import suggestion

    found: dict[str, tuple[float, Dimension | None]] = {}
    for parameter, text in scope.model.parts[name].parameters.items():
        path = ("parts", name, "parameters", parameter)
        if parameter not in model.parameters:
            scope.complain(
                path,
                f"`{scope.model.parts[name].file}` has no parameter `{parameter}`",
                suggestion(parameter, model.parameters),
                True,
            )
            continue
        try:
            found[parameter] = scope.parameters.measured(text)
        except ModelProblem as complaint:
            scope.complain(path, complaint.what, complaint.hint)
    return found


def coordinate_names(name: str, joint: Any) -> list[tuple[str, cards.Coordinate]]:
    """The coordinates of a joint with their cards; those without a name of their own are ``joint.angle`` and the like."""
    card = cards.joints()[joint.type]
    named = [c if isinstance(c, str) else c.name for c in elements.coordinates(joint)]
    usual = [f"{name}.{c.name}" for c in card.coordinates]
    # More names than the card has coordinates: a pin of several bodies repeats them.
    return (
        [(own, card.coordinates[i % len(card.coordinates)]) for i, own in enumerate(named + usual[len(named) :])] if usual else []
    )


def _heads(scope: Scope) -> set[str]:
    """What a name of this scope may begin with."""
    m = scope.model
    named: set[str] = {c.split(".")[0] for name, joint in m.joints.items() for c, _ in coordinate_names(name, joint)}
    for section in (m.parameters, m.tables, m.parts, m.bodies, m.gauges, m.joints, m.forces, m.motions, m.events):
        named.update(section)
    for section in (m.contacts, m.strings, m.stops):
        named.update(section)
    named.update(weld for name, event in m.events.items() for weld, _, _ in event.welds(name))
    return named

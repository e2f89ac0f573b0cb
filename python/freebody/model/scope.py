"""A model in use: repetitions written out, parameters worked out, parts opened."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import cycle
from pathlib import Path as FilePath
from typing import Any, Protocol

from pydantic import ValidationError

from freebody.core import cards
from freebody.symbolic.dimensions import Dimension

from . import elements, reading
from .errors import Consequence, ModelFileError, ModelProblem, Path, Problem, Where
from .expand import Expansion, Size, repeats
from .names import suggestion
from .parameters import Parameters
from .schema import Model
from .source import Source

MAX_DEPTH = 16
MAX_PARTS = 1000  # of a whole model, parts of parts included
ITEMS = (
    "parameters", "tables", "bodies", "gauges", "states", "joints", "forces", "motions", "contacts", "strings", "stops", "events",
)  # fmt: skip
"""Sections of named items."""


class Places(Protocol):
    """Whatever knows where the items of a model were written: a file, or Python calls."""

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item, or of the nearest that holds it."""


@dataclass
class Folder:
    """Where parts and the files of tables are looked for: relative to ``here``, never outside ``root``; ``opened`` leads here, ``parts`` are all so far,
    and ``size`` what they have made; a file is ``read`` once."""

    here: FilePath
    root: FilePath
    opened: tuple[FilePath, ...] = ()
    parts: list[FilePath] = field(default_factory=list)
    size: Size = field(default_factory=Size)
    read: dict[FilePath, tuple[Model, Source]] = field(default_factory=dict)

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
        if len(self.parts) >= MAX_PARTS:
            raise ModelProblem(f"a model has at most {MAX_PARTS} parts, parts of parts included", "use fewer")
        self.parts.append(path)
        return path

    def inside(self, path: FilePath) -> Folder:
        """The folder as seen from a part."""
        return Folder(path.parent, self.root, (*self.opened, path), self.parts, self.size, self.read)


@dataclass
class Scope:
    """One model file in use, as a whole or as a part under ``prefix`` (e.g. ``leg.``)."""

    prefix: str
    model: Model
    places: Places
    parameters: Parameters
    problems: list[Problem]
    folder: Folder
    origin: dict[Path, Path] = field(default_factory=dict)
    parts: dict[str, Scope] = field(default_factory=dict)

    def where(self, path: Path, at_key: bool = False) -> Where:
        """The place of an item as it was written."""
        for length in range(len(path), 0, -1):
            if path[:length] in self.origin:
                return self.places.where((*self.origin[path[:length]], *path[length:]), at_key)
        return self.places.where(path, at_key)

    def complain(self, path: Path, what: str, hint: str = "", at_key: bool = False) -> None:
        """Notes a problem."""
        self.problems.append(Problem(self.where(path, at_key), what, hint))

    def noting(self, path: Path, at_key: bool = False) -> Noting:
        """Notes the ``ModelProblem`` that is raised within and goes on behind; what only follows from another is not said again."""
        return Noting(self, path, at_key)

    def all(self) -> list[Scope]:
        """This scope and those of all parts, outer ones first."""
        return [self] + [inner for part in self.parts.values() for inner in part.all()]

    @cached_property
    def heads(self) -> set[str]:
        """What a name of this scope may begin with."""
        m = self.model
        own = {c.split(".")[0] for name, joint in m.joints.items() for c, _ in coordinate_names(name, joint)}
        welds = {weld for name, event in m.events.items() for weld, _, _ in event.welds(name)}
        return own | welds | {name for section in (*ITEMS, "parts") for name in getattr(m, section)}


class Noting:
    """What notes a ``ModelProblem``; a model asks for so many that each must be cheap."""

    __slots__ = ("at_key", "path", "scope")

    def __init__(self, scope: Scope, path: Path, at_key: bool) -> None:
        self.scope, self.path, self.at_key = scope, path, at_key

    def __enter__(self) -> None:
        pass

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> bool:
        if isinstance(error, ModelProblem) and not isinstance(error, Consequence):
            self.scope.complain(self.path, error.what, error.hint, self.at_key)
        return isinstance(error, ModelProblem)


Overruled = dict[str, tuple[float, Dimension | None]]
"""Values and dimensions that parameters of a part are given from outside."""


def open_scope(
    model: Model, places: Places, folder: Folder, problems: list[Problem], prefix: str = "", overruled: Overruled | None = None
) -> Scope:
    """The model in use. What is wrong goes to ``problems``; the scope is then as complete as can be."""
    parameters, model, origin = _written_out(model, places, problems, overruled or {}, folder)
    scope = Scope(prefix, model, places, parameters, problems, folder, origin)
    for name, fault in parameters.faults.items():
        with scope.noting(("parameters", name)):
            raise fault
    for name in model.parts:
        _open_part(scope, name, folder)
    return scope


def _written_out(
    model: Model, places: Places, problems: list[Problem], overruled: Overruled, folder: Folder
) -> tuple[Parameters, Model, dict[Path, Path]]:
    data, parameters = model.written(), Parameters(model.parameters, overruled)
    if not repeats(data):
        return parameters, model, {}
    scope = Scope("", model, places, parameters, problems, folder)
    with scope.noting(()):
        given = Expansion(parameters.whole, scope, folder.size).of(data.get("parameters", {}), ("parameters",), ("parameters",))
        parameters = Parameters(given, overruled)
        expansion = Expansion(parameters.whole, scope, folder.size)
        written = expansion.of(data | {"parameters": given})
        try:
            return parameters, Model.model_validate(written), expansion.origin
        except ValidationError as error:
            scope.origin = expansion.origin
            for complaint in reading.complaints(error):
                scope.complain(*complaint)
    raise ModelFileError(problems)


def _open_part(scope: Scope, name: str, folder: Folder) -> None:
    part, at = scope.model.parts[name], ("parts", name, "file")
    with scope.noting(at):
        path = folder.file(part.file)
        try:
            model, source = folder.read[path] = folder.read.get(path) or reading.read(path)
        except ModelFileError as error:
            if not path.exists():
                raise ModelProblem(f"there is no file `{part.file}`", error.problems[0].hint) from None
            scope.problems += error.problems
            return
        folder.size.grow(scope, at, 0, len(source.values))
        overruled: Overruled = {}
        for parameter, text in part.parameters.items():
            with scope.noting((*at[:2], "parameters", parameter), parameter not in model.parameters):
                if parameter not in model.parameters:
                    hint = suggestion(parameter, model.parameters)
                    raise ModelProblem(f"`{part.file}` has no parameter `{parameter}`", hint)
                overruled[parameter] = scope.parameters.measured(text)
        prefix = f"{scope.prefix}{name}."
        scope.parts[name] = inner = open_scope(model, source, folder.inside(path), scope.problems, prefix, overruled)
        scope.parameters.children[name] = inner.parameters


def coordinate_names(name: str, joint: Any) -> list[tuple[str, cards.Coordinate]]:
    """The coordinates of a joint with their cards; those without a name of their own are ``joint.angle`` and the like."""
    card = cards.joints()[joint.type]
    named = [c if isinstance(c, str) else c.name for c in elements.coordinates(joint)]
    # A pin of several bodies is one of each with the first, named after the other body.
    others = (getattr(joint, "of", None) or [])[1:]
    owners = [name] if len(others) < 2 else [f"{name}.{point.rpartition('.')[0]}" for point in others]
    own = named + [f"{owner}.{c.name}" for owner in owners for c in card.coordinates][len(named) :]
    return list(zip(own, cycle(card.coordinates), strict=False))

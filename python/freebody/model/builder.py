"""The builder: says in Python what a model file says, with the same words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from freebody.core import CompiledModel, ReportItem, Settings

from . import file, reading, schema
from .answers import fault, numbers, timed
from .edition import Edition
from .errors import ModelFileError, ModelProblem, Path, Problem
from .handles import Body, Element, Expression, Ground
from .lower import Lowered, lower
from .meanings import EVERY_BODY, SHAPE_POINTS
from .names import spell, suggestion
from .scope import Folder
from .source import Source, SourceLocations, called, caller
from .start import Assembly, Start, initial_state, parameter_values


def plain(value: Any) -> Any:
    """Handles as the words of the model; arrays and tuples as lists."""
    if isinstance(value, str):
        return str(value)
    if isinstance(value, (Body, Ground, Element)):
        return value.name
    if isinstance(value, Mapping):
        return {str(plain(k)): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
        listed = value.tolist() if hasattr(value, "tolist") else value
        return [plain(v) for v in listed] if isinstance(listed, (list, tuple)) else listed
    return value


class Overrules(MutableMapping[str, Any]):
    """The parameters of a model as they are written (``"400 mm"``), those of its parts as ``part.name``. Unknown names raise
    ``ModelFileError``."""

    def __init__(self, builder: Builder) -> None:
        self._builder, self._model = builder, builder.model

    def __getitem__(self, name: str) -> Any:
        known, rest, _ = self._place(name)
        return known[rest]

    def __setitem__(self, name: str, value: Any) -> None:
        known, rest, path = self._place(name)
        known[rest] = self._builder.validated({"parameters": {rest: plain(value)}}, path).parameters[rest]
        self._builder.noted(path)

    def __delitem__(self, name: str) -> None:
        raise TypeError("a parameter cannot be taken out of a model that may use it")

    def __iter__(self) -> Iterator[str]:
        return iter(self._model.parameters)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __len__(self) -> int:
        return len(self._model.parameters)

    def _place(self, name: str) -> tuple[dict[str, Any], str, Path]:
        model, (part, dot, rest) = self._model, name.partition(".")
        if name in model.parameters:
            return model.parameters, name, ("parameters", name)
        if dot and part in model.parts:
            model.parts[part].model_fields_set.add("parameters")
            return model.parts[part].parameters, rest, ("parts", part, "parameters", rest)
        hint = suggestion(name, model.parameters, "parameters")
        raise self._builder.error(("parameters", name), f"there is no parameter `{name}`", hint)


class Builder:
    """A mechanism under construction: ``model`` is what has been said so far, ``others`` the mechanisms made in Python
    that it continues with, by the names of files that stand for them.

    Wrong words raise ``ModelFileError`` at once; names and units are checked by ``lowered()`` and ``compile()``.
    ``Mechanism`` adds a method for each shape, joint and force.
    """

    def __init__(self, name: str = "", gravity: Any = None) -> None:
        self.model = schema.Model(freebody=schema.VERSION)
        self.others: dict[str, Builder] = {}
        self.ground = Ground(self, "ground", ("O",))
        self._locations, self._file, self._text = SourceLocations(), None, ""
        self._opened: dict[FilePath, Builder] = {}
        self._lowered: tuple[object, str, Lowered] | None = None
        self._locations.note(())
        for section, value in (("name", name or None), ("gravity", gravity)):
            if value is not None:
                self._assign(section, value)

    # -- files

    @classmethod
    def load(cls, path: str | FilePath) -> Any:
        """The mechanism of a model file. Raises ``ModelFileError``."""
        return cls.of(*reading.read(path), str(path))

    @classmethod
    def loads(cls, text: str, name: str = "model") -> Any:
        """The mechanism of the text of a model file. Raises ``ModelFileError``."""
        return cls.of(*reading.reads(text, name))

    @classmethod
    def of(cls, model: schema.Model, source: Source | None = None, path: str | None = None) -> Any:
        """The mechanism of a model, with the text and the path of its file if it has one."""
        made = cls()
        made.model, made._locations, made._file = model, SourceLocations(source), path
        made._text = source.text if source else ""
        for name in (model.ground or schema.Ground()).points:
            made.ground._has(name)
        return made

    def copy(self) -> Any:
        """A mechanism that starts as this one."""
        made = self.of(self.model.model_copy(deep=True), None, self._file)
        made.others = dict(self.others)
        return made

    def save(self, path: str | FilePath) -> None:
        """Writes the model, and beside it those made in Python that it continues with; the comments of the file that it was
        loaded from stay."""
        self._save(FilePath(path), set())

    def _save(self, path: FilePath, saved: set[FilePath]) -> None:
        file.save(self.model, path, self._text)
        saved.add(path)
        for name, other in self.others.items():
            if (beside := path.parent / name) not in saved:
                other._save(beside, saved)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Builder) and self.model == other.model

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        m = self.model
        return f"<mechanism {m.name!r}: {len(m.bodies)} bodies, {len(m.joints)} joints, {len(m.forces)} forces>"

    # -- what the model says, piece by piece

    @property
    def parameters(self) -> Overrules:
        """The parameters by name; those that the model has can be given other numbers."""
        return Overrules(self)

    def parameter(self, name: str, value: Any) -> Expression:
        """Names a number; the answer stands for it in arithmetic: ``2*T``."""
        self.put("parameters", name, value)
        return Expression(spell(name))

    def gauge(self, name: str, expression: Any) -> Expression:
        """Names an expression of the configuration."""
        self.put("gauges", name, expression)
        return Expression(spell(name))

    def table(
        self, name: str, x: Any, y: Any, interpolation: str = "linear", periodic: bool = False, file: str | None = None
    ) -> str:
        """A function given by points, called in expressions as ``name(x)``; ``interpolation`` is ``linear``, ``pchip`` or ``spline``.

        In a CSV ``file``, ``x`` and ``y`` are its columns, ``{"column": "angle", "unit": "deg"}``."""
        given = {"interpolation": interpolation} | _given({"periodic": periodic or None, "file": file})
        self.put("tables", name, {"x": x, "y": y} | given)
        return name

    def state(self, name: str, rate: Any, start: Any = 0) -> str:
        """A quantity with a ``rate`` of its own, an expression of time and of the state; ``start`` is its value at the start."""
        self.put("states", name, _given({"rate": rate, "start": start if start != 0 else None}))
        return name

    def part(self, name: str, file: str, **parameters: Any) -> str:
        """Puts another model file here under ``name``, with its parameters overruled."""
        self.put("parts", name, {"file": file} | ({"parameters": parameters} if parameters else {}))
        return name

    def motion(self, name: str, of: Any, is_: Any, level: str = "position", by: Any = None, engaged: bool = True) -> Element:
        """Prescribes a motion of a gauge; ``is_`` is its law (``is`` in a file)."""
        return self._switched("motions", name, {"of": of, "level": level, "by": by, "engaged": engaged, "is": is_})

    def contact(self, name: str, *of: Any, **words: Any) -> Element:
        """Two surfaces that can push each other: bodies, points, lines or ``{"centre": P, "radius": r}`` and the like.

        ``words`` are those of a file: ``restitution``, ``friction``, ``static_friction``, ``rough``, ``engaged``.
        """
        return self._switched("contacts", name, words | {"of": list(of)})

    def string(self, name: str, *ends: Any, **words: Any) -> Element:
        """A string between two ends, points or ``{"drum": P, …}``.

        ``words`` are those of a file: ``over``, ``length`` (m), ``restitution``, ``engaged``.
        """
        return self._switched("strings", name, words | {"ends": list(ends)})

    def stop(self, name: str, of: Any, **words: Any) -> Element:
        """Ends of the way of a coordinate or gauge: ``least``, ``most`` (in its unit), ``restitution``, ``engaged``."""
        return self._switched("stops", name, words | {"of": of})

    def _switched(self, section: str, name: str, words: Mapping[str, Any]) -> Element:
        self.put(section, name, _given(words))
        return Element(name, [])

    def event(
        self, name: str, when: Any = None, direction: str = "any", if_: Any = None, then: Any = "record", at: Any = None
    ) -> str:
        """Watches for a zero of ``when``, or for the time ``at`` (s, or ``"start"``); ``if_`` is its condition (``if`` in a file).

        ``then`` is in the words of a file; handles stand for names, and ``{"hand_over": …}`` takes a ``Mechanism``, too.
        """
        given = {"when": when, "at": at, "direction": direction, "then": self._with_files(then), "if": if_}
        self.put("events", name, _given(given))
        return name

    def _with_files(self, action: Any) -> Any:
        """An action with names of files in place of mechanisms, which are kept under them."""
        if isinstance(action, Builder):
            usual = FilePath(action._file).name if action._file else f"{action.model.name or 'next'}.yaml"
            taken = [name for name, other in self.others.items() if other is not action]
            name = next(n for i in range(len(taken) + 1) if (n := f"{i + 1} {usual}" if i else usual) not in taken)
            self.others[name] = action
            return name
        if isinstance(action, Mapping):
            return {word: self._with_files(value) for word, value in action.items()}
        return [self._with_files(value) for value in action] if isinstance(action, (list, tuple)) else action

    def handed(self, file: str) -> Any:
        """The mechanism of a model that this one continues with; its file as the model names it. Raises ``ModelFileError``."""
        if file in self.others:
            return self.others[file]
        folder = Folder.of(self._file)
        path = folder.beside(file)
        self._opened |= dict.fromkeys(folder.opened, self)
        if path not in self._opened:
            self._opened[path] = type(self).load(path)
            self._opened[path]._opened = self._opened
        return self._opened[path]

    def initial(self, **values: Any) -> None:
        """Sets coordinates at the start, and ``rates``, ``guess``, ``points``, ``branch``, ``at_rest``, ``equilibrium``; adds
        to what is there."""
        self._assign("initial", (self.model.initial.written() if self.model.initial else {}) | values)

    def run_settings(self, **values: Any) -> None:
        """Sets ``until``, ``method``, ``rtol``, ``every``, ``max_step``, ``step``, ``impacts``, ``painleve``; adds to what is
        there."""
        self._assign("run", (self.model.run.written() if self.model.run else {}) | values)

    def report(self, label: str, quantity: Any) -> None:
        """Asks for a quantity: ``"speed(P) @ end"``, or a mapping."""
        self.put("report", label, quantity)

    def body(self, name: str, **words: Any) -> Body:
        """A body of any shape, with the words of a model file."""
        self.put("bodies", name, words)
        return self[name]

    def mark(self, body: str, section: str, name: str, value: Any) -> None:
        """Names a point, line or curve (``section``) of a body or of the ground."""
        path: Path = ("ground",) if body == "ground" else ("bodies", body)
        marked = self.model.ground if body == "ground" else self.model.bodies[body]
        before = marked.written() if marked else {}
        before[section] = before.get(section, {}) | {name: value}
        self._locations.note((*path, section, name))
        if body == "ground":
            self._assign("ground", before, note=False)
        else:
            self.put("bodies", body, before, note=False)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self.model.bodies)

    def __getitem__(self, name: str) -> Body:
        """The body of that name."""
        body = self.model.bodies[name]
        return Body(self, name, (*EVERY_BODY, *SHAPE_POINTS.get(body.shape, ()), *body.points))

    def put(self, section: str, name: str, value: Any, note: bool = True) -> None:
        """Adds an item to a section. Raises ``ModelFileError`` when its words are wrong."""
        name, old = str(plain(name)), getattr(self.model, section)
        if note:
            if name in old:
                raise self.error((section, name), f"`{name}` is used twice in {section}", "give one of them another name")
            self._locations.note((section, name))
        # Validated alone, so that making many items takes linear time.
        made = getattr(self.validated({section: {name: plain(value)}}, (section, name)), section)[name]
        self.model.model_fields_set.add(section)
        old[name] = made

    def _assign(self, section: str, value: Any, note: bool = True) -> None:
        if note:
            self._locations.note((section,))
        setattr(self.model, section, getattr(self.validated({section: plain(value)}, (section,)), section))

    def validated(self, data: dict[str, Any], path: Path) -> schema.Model:
        """A model of that data alone. Raises ``ModelFileError``."""
        try:
            return schema.Model.model_validate({"freebody": schema.VERSION} | data)
        except ValidationError as error:
            found = [Problem(self._locations.where(at), what, hint) for at, what, hint, _ in reading.complaints(error)]
            self._locations.made.pop(path, None)
            raise ModelFileError(found) from None

    def wrong(self, path: Path, what: str, hint: str) -> ModelFileError:
        """The error about an item, where it was written."""
        return ModelFileError([Problem(self._locations.where(path), what, hint)])

    def error(self, path: Path, what: str, hint: str) -> ModelFileError:
        """The error about an item, at the Python call that is being executed."""
        return ModelFileError([Problem(called(*caller(), path), what, hint)])

    def noted(self, path: Path) -> None:
        """Remembers that the item was made by the call that is being executed."""
        self._locations.note(path)

    # -- what others make of it

    def lowered(self) -> Lowered:
        """The model in the core's terms; made again only when the model has changed. Raises ``ModelFileError`` with all that is
        wrong."""
        known, edition = self._lowered, Edition.now
        if known is None or known[0] is not edition:
            self.model.take_up()
            text = self.model.model_dump_json(by_alias=True, exclude_unset=True)
            same = known is not None and known[1] == text
            made = known[2] if same else lower(self.model, self._locations, self._file, self.others)
            known = self._lowered = (edition, text, made)
        return known[2]

    def compile(self) -> CompiledModel:
        """The compiled model. Raises ``ModelFileError``."""
        return self.lowered().compiled

    def source(self, notes: Sequence[str] = ()) -> CompiledModel:
        """The compiled mechanism with all that views want to know of it. Raises ``ModelFileError``."""
        lowered = self.lowered()
        if lowered.source is None:
            model = self.model.model_dump(mode="json", by_alias=True, exclude_unset=True)
            told = {"report": tuple(self.report_items()), "plots": tuple(lowered.plots), "looks": lowered.looks}
            lowered.source = replace(lowered.compiled, model=model, **told)
        return lowered.source.with_notes(notes)

    def initial_state(self, changes: Mapping[str, Any] | None = None, initial: Mapping[str, Any] | None = None) -> Assembly:
        """Arguments for ``compile().assemble``: the section ``initial`` (or ``initial`` in its place) with ``changes``. What is guessed
        and on which branch things are goes on where ``initial`` says nothing of it.

        Raises ``ModelFileError``.
        """
        start = self.lowered().start
        if initial is not None:
            guess = {n: value for n, value in start.guess.items() if n not in initial}
            start = Start(guess=guess, branch=start.branch, coordinates=start.coordinates, parameters=start.parameters)
        try:
            return initial_state(start, self.compile(), {**(initial or {}), **(changes or {})})
        except ModelProblem as complaint:
            raise self.error((), complaint.what, complaint.hint) from None

    def run_numbers(self, parameters: Mapping[str, float] | None = None) -> Settings:
        """The settings of ``run`` as numbers, for these parameters (the model's by default)."""
        given = self.lowered().run
        values = self._values(parameters) if any(isinstance(value, str) for value in given.values()) else {}
        found = Settings(**numbers(given, values))
        if wrong := fault(found):
            raise self.wrong(("run", wrong[0]), *wrong[1:])
        return found

    def report_items(self, parameters: Mapping[str, float] | None = None) -> list[ReportItem]:
        """The quantities to report, for these parameters (the model's by default)."""
        values = self._values(parameters)
        return [timed(item, values) for item in self.lowered().report]

    def _values(self, parameters: Mapping[str, float] | None) -> Mapping[str, float]:
        return parameter_values(self.compile(), self.compile().bind({})) if parameters is None else parameters


def _given(words: Mapping[str, Any]) -> dict[str, Any]:
    """What differs from its default, so that builder and file write the same."""
    usual = {"level": "position", "direction": "any", "then": "record", "engaged": True}
    return {key: value for key, value in words.items() if value is not None and value != usual.get(key)}

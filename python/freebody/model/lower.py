"""From a model to the spec of the core: everything explicit, in SI, under full names."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from freebody.core import CompiledModel, ModelError, ReportItem, cards
from freebody.symbolic.dimensions import TIME

from . import elements, meanings, scope, units
from .answers import AnswerWriter
from .bodies import BodyWriter
from .errors import ModelFileError, ModelProblem, Path, Problem, Where
from .events import EventWriter
from .guides import GuideWriter
from .limits import LimitWriter
from .outlines import Outlines
from .schema import Model, Motion
from .scope import Folder, Places, Scope
from .start import Start, StartWriter
from .writer import Writer

Spec = dict[str, Any]
_ITEMS = ("parameters", "tables", "bodies", "gauges", "joints", "forces", "motions", "contacts", "strings", "stops", "events")
_SECTIONS = (*_ITEMS, "points", "lines", "curves")
_ZEROS = {"right": "0", "up": "pi/2", "left": "pi", "down": "-pi/2"}
_STEP = re.compile(r"\.?([^.\[\]]+)|\[(\d+)\]")


@dataclass
class Lowered:
    """A model as the core takes it, and what the core does not need: start, run, report.

    ``hand_over`` holds the events that go on as another model, with its file. ``items`` leads from an item of the spec
    (``joints.pivot``) to where it was written.
    """

    spec: Spec
    start: Start
    run: dict[str, Any]
    report: list[ReportItem]
    root: Scope
    hand_over: dict[str, str] = field(default_factory=dict)
    items: dict[str, tuple[Scope, Path]] = field(default_factory=dict)

    def where(self, core_path: str) -> Where:
        """The place of what the core calls ``joints.pivot.of[1]``."""
        known = core_path
        while known not in self.items and known:
            known = known[: max(known.rfind("."), known.rfind("["), 0)]
        if not known:
            return self.root.where(_steps(core_path))
        found, path = self.items[known]
        return found.where((*path, *_steps(core_path[len(known) :])))

    def compile(self) -> CompiledModel:
        """The model compiled. Raises ``ModelFileError`` with the place of what it complains about."""
        try:
            return CompiledModel.of(self.spec)
        except ModelError as error:
            raise ModelFileError([Problem(self.where(error.path), error.what, error.hint)]) from None


def _steps(text: str) -> Path:
    return tuple(int(index) if index else word for word, index in _STEP.findall(text) if word != "with")


def lower(model: Model, places: Places, file: str | FilePath | None = None, others: Iterable[str] = ()) -> Lowered:
    """The model in the core's terms; parts, and models that it continues with, are looked for beside ``file``.

    ``others`` need not be there as files. Raises ``ModelFileError`` with all that is wrong.
    """
    problems: list[Problem] = []
    folder = Folder.of(file)
    root = scope.open_scope(model, places, folder, problems)
    lowering = _Lowering(root, folder, others)
    lowered = lowering.all()
    if problems:
        raise ModelFileError(problems)
    return lowered


class _Lowering:
    def __init__(self, root: Scope, folder: Folder, others: Iterable[str]) -> None:
        self.root = root
        self.folder = folder
        self.others = others
        self.made: dict[str, tuple[Scope, Path]] = {}
        self.hand_over: dict[str, str] = {}
        self.meanings = meanings.meanings(root)
        self.spec: Spec = {"name": root.model.name, "gravity": None} | {section: [] for section in _SECTIONS}
        lines: dict[str, Any] = {}
        self.writers = [Writer(s, self.meanings, lines) for s in root.all()]

    def all(self) -> Lowered:
        bodies = [BodyWriter(write, self.spec) for write in self.writers]
        for writer in bodies:
            writer.all_points()
        for writer in bodies:
            writer.all_lines()
        sections = [_Sections(write, self.spec) for write in self.writers]
        for section in sections:
            section.values()
        places = {name: at for writer in bodies for name, at in writer.places.items()}
        for section in sections:
            section.items(GuideWriter(section.write, self.spec, places, self.made))
        self._switches({name: track for writer in bodies for name, track in writer.tracks.items()})
        self.spec["gravity"] = self._gravity()
        start = Start()
        for write in reversed(self.writers):  # what the whole says of a part's coordinates overrules what the part says
            StartWriter(write, start).all()
        answers = AnswerWriter(self.writers[0])
        return Lowered(self.spec, start, answers.run(), answers.report(), self.root, self.hand_over, self._items())

    def _switches(self, tracks: dict[str, Spec]) -> None:
        """Contacts, strings and stops; then events, which may name anything."""
        outlines = Outlines(self.writers, self.spec)
        for write in self.writers:
            LimitWriter(write, self.spec, outlines, tracks).all()
        events = [
            EventWriter(
                write, self.spec, self.made, self.hand_over, self.folder if write is self.writers[0] else None, self.others
            )
            for write in self.writers
        ]
        for writer in events:
            writer.welds()
        for writer in events:
            writer.all()

    def _gravity(self) -> list[Any] | None:
        value = self.root.model.gravity
        if value == "none":
            return None
        if isinstance(value, list):
            return self.writers[0].pair(("gravity",), value, "m/s^2")
        size = self.writers[0].number(("gravity",), value, "m/s^2")
        return [0.0, -size if isinstance(size, float) else f"-({size})"]

    def _items(self) -> dict[str, tuple[Scope, Path]]:
        found = dict(self.made)
        for s in self.root.all():
            for section in _ITEMS:
                found |= {f"{section}.{s.prefix}{name}": (s, (section, name)) for name in getattr(s.model, section)}
            marked = [("bodies", name, f"{s.prefix}{name}.", body) for name, body in s.model.bodies.items()]
            if s.model.ground:
                marked.append(("ground", "", f"ground.{s.prefix}", s.model.ground))
            for first, name, owner, body in marked:
                path: Path = (first, name) if name else (first,)
                for section in ("points", "lines", "curves"):
                    found[f"{section}.{owner}".rstrip(".")] = (s, path)
                    found |= {f"{section}.{owner}{mark}": (s, (*path, section, mark)) for mark in getattr(body, section)}
        return found


class _Sections:
    """Everything but the bodies of one scope."""

    def __init__(self, write: Writer, spec: Spec) -> None:
        self.write = write
        self.spec = spec
        self.scope = write.scope
        self.model = write.scope.model
        self.prefix = write.scope.prefix

    def values(self) -> None:
        """Parameters, tables and gauges."""
        for name, value in self.model.parameters.items():
            self.spec["parameters"].append(self._parameter(name, value))
        for name, table in self.model.tables.items():
            x, y = (self._numbers(("tables", name, axis), getattr(table, axis)) for axis in "xy")
            if len(x) != len(y) or len(x) < 2:
                self.scope.complain(
                    ("tables", name), f"the table has {len(x)} arguments and {len(y)} values", "it needs two points or more"
                )
            elif rows := [i for i in range(1, len(x)) if x[i] <= x[i - 1]]:
                self.scope.complain(
                    ("tables", name, "x", rows[0]), "the arguments of a table must grow", "put its points in order"
                )
            self.spec["tables"].append({"name": self.prefix + name, "x": x, "y": y, "interpolation": table.interpolation})
        for name, text in self.model.gauges.items():
            self.spec["gauges"].append({"name": self.prefix + name, "value": self.write.expression(("gauges", name), text)})
            self.write.meanings.values[self.prefix + name] = ("gauge", self.write.dimension(text))

    def items(self, guides: GuideWriter) -> None:
        """Joints, forces and motions."""
        for name, joint in self.model.joints.items():
            written = self._element(("joints", name), joint, cards.joints()[joint.type]) | self._friction(name, joint)
            written |= {"coordinates": self._coordinates(name, joint)}
            self.spec["joints"].append(written)
            guides.joint(name, joint, written)
        for name, force in self.model.forces.items():
            self.spec["forces"].append(self._element(("forces", name), force, cards.forces()[force.type]))
        for name, motion in self.model.motions.items():
            self.spec["motions"].append(self._motion(name, motion))

    def _parameter(self, name: str, value: Any) -> Spec:
        full, parameters = self.prefix + name, self.scope.parameters
        if name in parameters.faults:
            return {"name": full, "value": 0.0}
        dimension = parameters.dimension(name)
        unit = dimension.unit() if dimension else ""
        overruled = parameters.overruled.get(name)
        written = overruled[0] if overruled else self.write.number(("parameters", name), value)
        return {"name": full, "value": written, "unit": unit}

    def _numbers(self, path: Path, values: list[Any]) -> list[float]:
        found: list[float] = []
        for i, value in enumerate(values):
            try:
                found.append(self.scope.parameters.number(value))
            except ModelProblem as complaint:
                self.scope.complain((*path, i), complaint.what, complaint.hint)
        return found

    # -- joints and forces

    def _element(self, path: Path, element: elements.Element, card: cards.Card) -> Spec:
        gauge = elements.given(element, "along") if any(f.kind == "gauge" and f.name == "along" for f in card.fields) else None
        # The fields of a force along a gauge that is no length have units of their own.
        dimension = self.write.dimension(gauge) if gauge else None
        loose = gauge is not None and (dimension is None or not dimension.fits(units.LENGTH))
        fields = {}
        for card_field in card.fields:
            value = elements.given(element, card_field.name)
            if value is not None:
                unit = None if loose else card_field.unit
                fields[card_field.name] = self._field((*path, card_field.name), card_field.kind, value, unit)
        return {"name": self.prefix + str(path[1]), "type": card.type, "with": fields, "engaged": element.engaged}

    def _field(self, path: Path, kind: str, value: Any, unit: str | None) -> Any:
        write = self.write
        match kind:
            case "point":
                return write.point(path, value)
            case "points":
                return [write.point((*path, i), name) for i, name in enumerate(value)]
            case "line":
                return write.line(path, value)
            case "circle":
                return write.circle(path, value)
            case "curve":
                return write.curve(path, value)
            case "body":
                return write.body(path, value)
            case "number":
                return write.number(path, value, unit)
            case "numbers":
                return [write.number((*path, i), number, unit) for i, number in enumerate(value)]
            case "law" | "gauge":
                return write.expression(path, value, unit)
        return value

    def _friction(self, name: str, joint: elements.Element) -> Spec:
        words = {"kinetic": "friction", "fixed": "static_friction", "radius": "bearing_radius"}
        given = {key: word for key, word in words.items() if elements.given(joint, word) is not None}
        if not given:
            return {}
        if "kinetic" not in given:
            word = min(given.values())
            self.scope.complain(("joints", name, word), f"`{word}` goes with `friction`", "give the coefficient of sliding, too")
        return {"friction": {key: self._share(name, joint, word) for key, word in given.items()}}

    def _share(self, name: str, joint: elements.Element, word: str) -> Any:
        return self.write.number(("joints", name, word), elements.given(joint, word), "m" if word == "bearing_radius" else "")

    def _coordinates(self, name: str, joint: elements.Element) -> list[Spec]:
        named = scope.coordinate_names(name, joint)
        given = elements.coordinates(joint)
        at: Path = ("joints", name, "coordinates" if elements.given(joint, "coordinates") else "coordinate")
        return [
            self._coordinate((*at, i) if at[-1] == "coordinates" else at, c, card)
            for i, (c, (_, card)) in enumerate(zip(given, named, strict=False))
        ]

    def _coordinate(self, path: Path, given: Any, card: cards.Coordinate) -> Spec:
        if isinstance(given, str):
            return {"name": self.prefix + given}
        zero, angle = given.zero, card.unit == "rad"
        if zero in _ZEROS and angle:
            zero = _ZEROS[zero]
        elif zero in _ZEROS or (given.absolute and not angle):
            word = "zero" if zero in _ZEROS else "absolute"
            self.scope.complain(
                (*path, word), f"`{word}: {getattr(given, word)}` goes with an angle; `{given.name}` is a length", "leave it out"
            )
            zero = 0.0
        sense = -1 if given.sense in ("clockwise", "backward") else 1
        return {
            "name": self.prefix + given.name,
            "zero": self.write.number((*path, "zero"), zero, card.unit or None),
            "sense": sense,
            "absolute": given.absolute,
        }

    # -- motions

    def _motion(self, name: str, motion: Motion) -> Spec:
        path: Path = ("motions", name)
        power = ("position", "velocity", "acceleration").index(motion.level)
        of = self.write.expression((*path, "of"), motion.of)
        dimension = self.write.dimension(motion.of)
        law = self.write.expression((*path, "is"), motion.law, dimension and dimension.times(TIME, -power))
        by = self.write.expression((*path, "by"), motion.by) if motion.by is not None else None
        return {"name": self.prefix + name, "of": of, "is": law, "level": motion.level, "by": by, "engaged": motion.engaged}

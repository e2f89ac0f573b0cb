"""From a model to the spec of the core: everything explicit, in SI, under full names."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from freebody.core import CompiledModel, ModelError, ReportItem, Spec, cards
from freebody.symbolic.dimensions import TIME

from . import elements, meanings, scope, units
from .answers import AnswerWriter
from .bodies import BodyWriter
from .errors import ModelFileError, ModelProblem, Path, Problem, Where
from .events import EventWriter
from .guides import GuideWriter
from .limits import LimitWriter
from .outlines import Outlines
from .schema import Model
from .scope import Folder, Places, Scope
from .start import Start, StartWriter
from .writer import Writer

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
    spec: Spec = {"name": root.model.name, "gravity": None} | {section: [] for section in _SECTIONS}
    known, items, lines = meanings.meanings(root), {}, {}
    writers = [Writer(each, known, spec, lines, items) for each in root.all()]
    bodies, sections = [BodyWriter(write) for write in writers], [_Sections(write) for write in writers]
    for step in (BodyWriter.all_points, BodyWriter.all_lines):
        for writer in bodies:
            step(writer)
    for section in sections:
        section.values()
    places_of_points = {name: at for writer in bodies for name, at in writer.places.items()}
    for section in sections:
        section.elements(GuideWriter(section.write, places_of_points))
    tracks = {name: track for writer in bodies for name, track in writer.tracks.items()}
    outlines, hand_over = Outlines(writers, spec), {}
    for write in writers:
        LimitWriter(write, outlines, tracks).all()
    events = [EventWriter(write, hand_over, folder if write is writers[0] else None, others) for write in writers]
    # Welds first: events may name anything.
    for step in (EventWriter.welds, EventWriter.all):
        for writer in events:
            step(writer)
    spec["gravity"] = _gravity(writers[0])
    start = Start()
    for write in reversed(writers):  # what the whole says of a part's coordinates overrules what the part says
        StartWriter(write, start).all()
    answers = AnswerWriter(writers[0])
    lowered = Lowered(spec, start, answers.run(), answers.report(), root, hand_over, items | _items(root))
    if problems:
        raise ModelFileError(problems)
    return lowered


def _gravity(write: Writer) -> list[Any] | None:
    value = write.scope.model.gravity
    if value == "none":
        return None
    if isinstance(value, list):
        return write.numbers(("gravity",), value, "m/s^2")
    size = write.number(("gravity",), value, "m/s^2")
    return [0.0, -size if isinstance(size, float) else f"-({size})"]


def _items(root: Scope) -> dict[str, tuple[Scope, Path]]:
    """Where each item of the spec was written."""
    found = {}
    for s in root.all():
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

    def __init__(self, write: Writer) -> None:
        self.write, self.spec, self.scope, self.prefix = write, write.spec, write.scope, write.prefix
        self.model = write.scope.model

    def values(self) -> None:
        """Parameters, tables and gauges."""
        parameters = self.scope.parameters
        for name, value in self.model.parameters.items():
            written: Spec = {"name": self.prefix + name, "value": 0.0}
            if name not in parameters.faults:
                if name in parameters.overruled:
                    written["value"] = parameters.overruled[name][0]
                else:
                    written["value"] = self.write.number(("parameters", name), value)
                dimension = parameters.dimension(name)
                written["unit"] = dimension.unit() if dimension else ""
            self.spec["parameters"].append(written)
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

    def elements(self, guides: GuideWriter) -> None:
        """Joints, forces and motions."""
        for name, joint in self.model.joints.items():
            written = self._element(("joints", name), joint, cards.joints()[joint.type]) | self._friction(name, joint)
            written |= {"coordinates": self._coordinates(name, joint)}
            self.spec["joints"].append(written)
            guides.joint(name, joint, written)
        for name, force in self.model.forces.items():
            self.spec["forces"].append(self._element(("forces", name), force, cards.forces()[force.type]))
        for name, motion in self.model.motions.items():
            path: Path = ("motions", name)
            power = ("position", "velocity", "acceleration").index(motion.level)
            of = self.write.expression((*path, "of"), motion.of)
            dimension = self.write.dimension(motion.of)
            law = self.write.expression((*path, "is"), motion.law, dimension and dimension.times(TIME, -power))
            by = self.write.expression((*path, "by"), motion.by) if motion.by is not None else None
            stated = {"of": of, "is": law, "level": motion.level, "by": by, "engaged": motion.engaged}
            self.spec["motions"].append({"name": self.prefix + name} | stated)

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
            case "line" | "circle":
                return getattr(write, kind)(path, value)
            case "curve" | "body":
                return write.place(path, value, kind)
            case "number":
                return write.number(path, value, unit)
            case "numbers":
                return write.numbers(path, value, unit)
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
        written = {
            key: self.write.number(("joints", name, word), elements.given(joint, word), "m" if key == "radius" else "")
            for key, word in given.items()
        }
        return {"friction": written}

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
